"""Soft bodies of all-pairs springs, simulated on GPUs and CPUs.

    import pliant

    sim = pliant.Simulation(pliant.Scene.load("scenes/two_spheres.toml"))
    sim.advance_to(0.5)
    print(sim.positions.mean(axis=0), sim.measure().energy)

Lengths are in metres, masses in kilograms, times in seconds, and y points up. docs/python.md has more.
"""
from __future__ import annotations

import json as _json
from typing import Any as _Any

from . import _core
from ._sweep import run_to_end, sweep
from .errors import BreakdownError, DeviceError, Error, InputError, SceneWarning
from .mesh import Mesh, mesh
from .picture import Animation, Picture
from .scene import Scene
from .simulation import CONTACT, Body, Intersections, Measurement, Simulation

__version__: str = _core.version

__all__ = ["Animation", "Body", "BreakdownError", "CONTACT", "DeviceError", "Error", "InputError", "Intersections", "Measurement",
           "Mesh", "Picture", "Scene", "SceneWarning", "Simulation", "info", "integrators", "mesh", "run_to_end", "sweep"]


def info() -> dict[str, _Any]:
    """Returns the version, the CPU and the GPUs: the keys of ``pliant info --json``."""
    told: dict[str, _Any] = _json.loads(_core.info())
    return told


def integrators() -> list[dict[str, _Any]]:
    """Returns the integrators: the keys of ``pliant info --integrators --json``."""
    told: list[dict[str, _Any]] = _json.loads(_core.info_of_integrators())
    return told
