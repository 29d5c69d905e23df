"""What pliant raises. Each error says where it lies, what is wrong and what helps."""
from __future__ import annotations

import re


class Error(Exception):
    """Any error of pliant.

    Attributes:
        place: names a file, key, argument or body. Empty if there is nothing to name.
        problem: what is wrong.
        remedy: what to do about it. Empty if nothing is known.
    """

    def __init__(self, place: str, problem: str, remedy: str = "") -> None:
        super().__init__(place, problem, remedy)
        self.place = place
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        place = f"{self.place}: " if self.place else ""
        remedy = f"; {self.remedy}" if self.remedy else ""
        return place + self.problem + remedy


class InputError(Error, ValueError):
    """A scene, a mesh, an array or an argument is wrong."""


class DeviceError(Error, RuntimeError):
    """A device is missing, has no room, or failed."""


class BreakdownError(Error, ArithmeticError):
    """Numbers have gone wrong: a vertex is not finite, or steps with a tolerance have become too short.

    Nothing moves after that. The state can still be read, and ``report()["breakdown"]`` says more.
    """


class SceneWarning(UserWarning):
    """Something about a scene that is probably not meant, such as a time step beyond the stability bound."""


# What the library calls a scene that has no file, and an override of a value.
_VALUES = "<values>"
_OVERRIDE = "--set "


def in_pythons_words(place: str) -> str:
    """Returns a place as users know it. The lines of a text that Python values became mean nothing to them."""
    if place.startswith(_OVERRIDE):
        return "set: " + place.removeprefix(_OVERRIDE)
    return re.sub(rf"^\S*{_VALUES}(:\d+)?", "Scene", place)


def _from_core(kind: str, place: str, problem: str, remedy: str) -> Error:
    """Returns the error for one of the library."""
    return (DeviceError if kind == "device" else InputError)(in_pythons_words(place), problem, remedy)
