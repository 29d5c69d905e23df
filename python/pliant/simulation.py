"""Simulations: a scene that is stepped, read, changed and drawn."""
from __future__ import annotations

import math
import operator
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import BreakdownError, InputError, in_pythons_words
from .picture import Animation, Picture
from .scene import Overrides, Scene, warn_all

Floats = npt.NDArray[np.float64]
Vector = Sequence[float] | Floats

CONTACT = np.dtype([("vertices", np.int64, 4), ("weights", np.float64, 4), ("impulse", np.float64, 3)])
"""The type of contacts: see Simulation.contacts."""


@dataclass(frozen=True)
class Body:
    """What a simulation knows of a body.

    Attributes:
        index: place among the bodies.
        kind: ``soft``, ``static`` or ``scripted``.
        vertices: its rows in arrays of vertices, as in ``simulation.positions[body.vertices]``.
        triangles: its rows in ``simulation.triangles``.
        stiffness: of every pair's spring [N/m].
        vertex_mass: [kg].
        damping: [kg/s].
        radius: largest distance of a vertex from the centroid, at rest [m].
    """

    name: str
    index: int
    kind: Literal["soft", "static", "scripted"]
    vertices: slice
    triangles: slice
    stiffness: float
    vertex_mass: float
    damping: float
    radius: float


class Measurement(NamedTuple):
    """Energies and momenta of all bodies together, in fp64.

    Attributes:
        kinetic, elastic, gravitational: energies [J]. That of gravity is zero at the world's origin.
        momentum: (3,) [kg m/s].
        angular_momentum: (3,) about the world's origin [kg m^2/s].
    """

    kinetic: float
    elastic: float
    gravitational: float
    momentum: Floats
    angular_momentum: Floats

    @property
    def energy(self) -> float:
        """The sum of the energies [J]."""
        return self.kinetic + self.elastic + self.gravitational


@dataclass(frozen=True)
class Intersections:
    """Triangles of different bodies that touch: how many pairs, and the names of their bodies."""

    pairs: int
    bodies: list[str]


class Simulation:
    """A scene that is simulated.

    Steps give the bits of ``pliant run`` on the same device. Other Python threads run during a call. A simulation on a GPU
    belongs to the thread that made it, and another one that has drawn to the thread that drew first.

    Args:
        scene: a Scene, or the path of a scene's file.
        device: ``auto`` (a hardware GPU, else the CPU), ``cpu``, ``gpu``, or ``gpu:1`` for a second GPU.
        precision: bits of the forces, 32 or 64. 64 needs the CPU.
        threads: of the CPU. 0 is one a processor.
        set: values that replace those of the scene, by keys such as ``"simulation.time_step"``.

    Raises:
        InputError: the scene can't be simulated, for example because bodies begin in each other.
        DeviceError: the device is missing or has no room.

    Warns:
        SceneWarning: of what is probably not meant, such as a time step beyond the stability bound.
    """

    def __init__(self, scene: Scene | str | PathLike[str], device: str = "auto", *, precision: Literal[32, 64] | None = None,
                 threads: int = 0, set: Overrides | None = None) -> None:
        described = scene if isinstance(scene, Scene) else Scene.load(scene)
        self.expect_choices(device, precision, threads)
        self.scene: Scene = described.override(set) if set else described
        self._core = _core.Simulation(self.scene._text, str(self.scene._file), self.scene._overrides, self.scene._meshes, device,
                                      precision, threads)
        self._begin()
        warn_all(self.warnings, stacklevel=2)

    @staticmethod
    def expect_choices(device: str, precision: int | None, threads: int) -> None:
        """Raises InputError if no simulation could have these."""
        if not re.fullmatch(r"auto|cpu|gpu(:\d{1,3})?", device):
            raise InputError("device", f"{device!r} is no device", "write auto, cpu, gpu, or gpu:N for one of several GPUs")
        if precision not in (None, 32, 64):
            raise InputError("precision", f"{precision!r} is no choice", "write 32 or 64")
        if precision == 64 and device.startswith("gpu"):
            raise InputError("precision", "64 bits need the CPU", "write device=\"cpu\", or leave precision out")
        if not 0 <= operator.index(threads) <= 4096:
            raise InputError("threads", f"{threads} is out of range", "use a number from 0 to 4096")

    def _begin(self) -> None:
        self._plan = self._core.plan()
        self._bodies = {told["name"]: Body(index=index, **told) for index, told in enumerate(self._core.bodies())}

    # What there is

    @property
    def bodies(self) -> Mapping[str, Body]:
        """The bodies by their names, in the scene's order."""
        return self._bodies

    @property
    def vertex_count(self) -> int:
        return int(self._plan["vertices"])

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """(m, 3) uint32: vertex numbers of all triangles, counter-clockwise seen from outside."""
        return self._core.triangles()

    @property
    def integrator(self) -> str:
        return str(self._plan["integrator"])

    @property
    def time_step(self) -> float | None:
        """Length of a step [s]. None if a tolerance governs it."""
        step: float | None = self._plan["time_step"]
        return step

    @property
    def step_bound(self) -> float:
        """Largest stable step [s]."""
        return float(self._plan["step_bound"])

    @property
    def duration(self) -> float:
        """How long ``pliant run`` would simulate [s]. A simulation may go on for longer."""
        return float(self._plan["duration"])

    @property
    def warnings(self) -> list[str]:
        """What SceneWarnings said of the scene."""
        return [in_pythons_words(text) for text in self._plan["warnings"]]

    @property
    def device(self) -> str:
        """The device's name."""
        return str(self._plan["device"])

    @property
    def precision(self) -> int:
        """Bits of the forces: 32 or 64."""
        return int(self._plan["precision"])

    # Steps

    def advance(self, steps: int = 1) -> None:
        """Makes steps. With a tolerance they also end at the scene's frames, as those of ``pliant run`` do.

        On a GPU a single step may still be running when this returns. Reading waits for it. Ctrl-C ends steps early, perhaps
        within one, and the next call goes on from there.

        Raises:
            BreakdownError: numbers have gone wrong. On a GPU that shows within 32 calls.
        """
        if operator.index(steps) < 0:
            raise InputError("advance", f"{steps} steps can't be made", "use a number from 0")
        if self._core.advance(steps):
            self._raise_breakdown()

    def advance_to(self, time: float) -> None:
        """Goes on to a time [s]. With a tolerance a step ends exactly there, and others at the scene's frames. Steps of a fixed
        length go on to the one that ends nearest to it.

        Raises:
            InputError: the time is before now.
            BreakdownError: numbers have gone wrong.
        """
        if not math.isfinite(time):
            raise InputError("advance_to", f"{time} is no time", "use a finite number of seconds")
        if self._core.advance_to(time):
            self._raise_breakdown()

    def _raise_breakdown(self) -> None:
        found = self.report()["breakdown"]
        what = "is not finite"
        if found["is_finite"]:
            what = "needs more steps than a run may have" if found["takes_too_many"] else "can't meet the tolerance"
        problem = f"vertex {found['vertex']} {what} in step {found['step']}"
        raise BreakdownError(f"body \"{found['body']}\"", problem, "use a shorter time_step, a looser tolerance, or softer springs")

    @property
    def time(self) -> float:
        """Of the state [s]."""
        return self._core.time()

    @property
    def steps(self) -> int:
        """Steps made since the start."""
        return self._core.steps()

    # Reading

    @property
    def positions(self) -> Floats:
        """(n, 3) float64: where the vertices are [m]. A copy. They are those of ``final_state.csv``."""
        return self.read_positions(np.empty((self.vertex_count, 3)))

    def read_positions(self, out: Floats) -> Floats:
        """Reads positions [m] into an array of shape (n, 3) that is there, and returns it. It saves making one each time."""
        if out.shape != (self.vertex_count, 3) or out.dtype != np.float64 or not (out.flags.c_contiguous and out.flags.writeable):
            raise InputError("out", f"is {out.dtype} of shape {out.shape}, or not contiguous or writable",
                             f"give it float64 of shape ({self.vertex_count}, 3)")
        self._core.read_positions(out)
        return out

    @property
    def drawn_positions(self) -> npt.NDArray[np.float32]:
        """(n, 3) float32: positions [m], rounded once, as pictures are drawn from them. A copy, and the fastest to read."""
        return self._core.drawn_positions()[:, :3]

    @property
    def velocities(self) -> Floats:
        """(n, 3) float64: velocities of the vertices [m/s]. A copy."""
        return self._core.velocities()

    def measure(self) -> Measurement:
        """Measures energies and momenta. Sums every spring of bodies that have moved: n^2 / 2 for n vertices, fewer if clustered."""
        return Measurement(**self._core.measure())

    def contacts(self) -> npt.NDArray[np.void]:
        """Returns the contacts of the latest step that gave an impulse, in no fixed order, as an array of CONTACT.

        - ``vertices`` (4,): its vertices, -1 where it has fewer. A contact with a ground has one.
        - ``weights`` (4,): of the vertices, above 0 on the first body, below 0 on the second.
        - ``impulse`` (3,): on the first body [N s].

        There are none with ``response = "reflect"``: see touching_vertices.
        """
        vertices, weights, impulses = self._core.contacts()
        found = np.empty(len(vertices), CONTACT)
        found["vertices"], found["weights"], found["impulse"] = vertices, weights, impulses
        return found

    def touching_vertices(self) -> npt.NDArray[np.uint32]:
        """Returns the vertices that touched another body in the latest step, ascending. Only ``response = "reflect"`` marks them."""
        return self._core.touching_vertices()

    def intersections(self) -> Intersections:
        """Tests all triangles of different bodies, where they are."""
        return Intersections(*self._core.intersections())

    def report(self) -> dict[str, Any]:
        """Returns what was done, as numbers, texts, lists and dicts that ``json.dumps`` takes.

        - ``steps`` and ``time`` [s] count from the start. All else counts from the latest change of state or material.
        - ``breakdown`` says where numbers went wrong, ``adaptive`` what a tolerance did, and ``clusters`` what checks of clustered
          bodies found. Each is None if there is nothing to say.
        - ``contacts`` has the energies that contacts gave and took, what friction took of them, and what scripted bodies gave [J].
          ``contact_steps`` and ``contact_pairs_max`` count contacts.
        - ``substeps`` and ``held_parts`` say how often steps were divided or held, so that bodies stay apart.
        - The others count work that was done or left out. ``pliant run`` tells the same: see docs/output.md.
        """
        return self._core.report()

    # Changing

    def set_state(self, *, positions: npt.ArrayLike | None = None, velocities: npt.ArrayLike | None = None) -> None:
        """Goes on from other positions [m] or velocities [m/s], (n, 3) each. What is None stays.

        Rows of static and scripted bodies must stay as they are. This builds trees and arrays anew, which takes as long as making
        a simulation. To push bodies in every step, use pull.

        Raises:
            InputError: the state has numbers that are not finite, or surfaces would intersect. Nothing has changed then.
        """
        self._core.set_state(_array(positions), _array(velocities))

    def set_material(self, body: str, *, stiffness: float | None = None, vertex_mass: float | None = None,
                     damping: float | None = None) -> None:
        """Goes on with another material of a body: stiffness [N/m], mass of a vertex [kg], damping [kg/s]. What is None stays.

        An automatic time step follows. This takes as long as set_state.
        """
        if self._body(body).kind != "soft":
            raise InputError("body", f"{body!r} is {self._body(body).kind}, so it has no material", "name a soft body")
        for name, value, lowest in (("stiffness", stiffness, 0), ("vertex_mass", vertex_mass, 1e-30), ("damping", damping, 0)):
            if value is not None and not lowest <= value <= 1e30:
                raise InputError(name, f"{value} is out of range", f"use a number from {lowest:g} to 1e30")
        rows = np.array([[b.stiffness, b.vertex_mass, b.damping] for b in self._bodies.values()])
        row = rows[self._bodies[body].index]
        row[:] = [old if new is None else new for old, new in zip(row, (stiffness, vertex_mass, damping))]
        self._core.set_materials(rows)
        self._begin()
        if self.time_step is not None and self.time_step > self.step_bound:
            warn_all([f"the time step {self.time_step:.6g} s is {self.time_step / self.step_bound:.3g} times the stability bound, "
                      f"{self.step_bound:.6g} s: expect growing motion"], stacklevel=2)

    def pull(self, vertex: int, target: Vector, seconds: float | None = None) -> None:
        """Pulls the body around a vertex to a place [m], between two steps, as a mouse does in the viewer.

        Changes velocities as if for so long [s], which is the time step if None. Call it after each step for a steady pull.
        """
        if not 0 <= vertex < self.vertex_count:
            raise InputError("vertex", f"there is no vertex {vertex}", f"use a number from 0 to {self.vertex_count - 1}")
        seconds = self.time_step if seconds is None else seconds
        if seconds is None:
            raise InputError("seconds", "a tolerance gives steps no fixed length", "say for how long to pull")
        self._core.pull(vertex, _vector(target, "target"), _positive(seconds, "seconds"))

    def send(self, body: str, target: Vector, seconds: float) -> None:
        """Sends a scripted body from where it is to another place of its centre, the mean of its vertices [m]. It arrives after so
        long [s], and rests there.

        It begins with the velocity that it has, so it may be sent elsewhere at any time without a jerk. If that velocity leads
        away, it overshoots. It waits where a body that it would press into stands in its way. The body's path must have two keys
        or more and not repeat: ``"path": [{"time": 0}, {"time": 1}]`` keeps it where it is until it is sent.
        """
        index = self._body(body).index
        self._core.send(index, _vector(target, "target"), _positive(seconds, "seconds"))

    def _body(self, name: str) -> Body:
        if name not in self._bodies:
            raise InputError("body", f"there is no body {name!r}", f"known here: {', '.join(self._bodies)}")
        return self._bodies[name]

    # Saving

    def save(self) -> bytes:
        """Returns all that later steps depend on."""
        return self._core.save()

    def restore(self, saved: bytes) -> None:
        """Goes on from bytes of save(), of this simulation or of another one of the same scene: on the same device bit for bit.

        Raises:
            InputError: the bytes are damaged, or of another scene or version. Nothing has changed then.
        """
        if not isinstance(saved, bytes):
            raise TypeError(f"restore() takes bytes of save(), not {type(saved).__name__}")
        self._core.restore(saved)
        self._begin()

    # Drawing

    def render(self, size: tuple[int, int] | None = None, *, camera: Mapping[str, Any] | None = None,
               coloring: Literal["body", "deformation"] | None = None,
               contacts: bool | None = None) -> npt.NDArray[np.uint8]:
        """Draws the bodies as they are. Returns (height, width, 3) uint8: red, green and blue in sRGB, from the top left.

        Args:
            size: width and height [pixels].
            camera: ``{"eye": [x, y, z], "target": [x, y, z], "field_of_view": degrees}``. The scene's if None, or one that shows
                where the bodies begin.
            coloring: ``deformation`` colours by strain: from dark purple for none to yellow for 30 % and more (matplotlib's
                ``viridis``).
            contacts: whether to mark contacts.

        Raises:
            DeviceError: there is no OpenGL 4.5 with EGL.
        """
        if size is not None and not (len(size) == 2 and all(1 <= operator.index(s) <= 16384 for s in size)):
            raise InputError("size", f"{size} is no size of a picture", "write (width, height), each from 1 to 16384")
        if coloring not in (None, "body", "deformation"):
            raise InputError("coloring", f"{coloring!r} is no choice", "write one of body, deformation")
        by_strain = None if coloring is None else coloring == "deformation"
        return self._core.render(size, _camera(camera), by_strain, contacts)

    def show(self, seconds: float | None = None, *, size: tuple[int, int] = (640, 360), frame_rate: float = 25,
             **how: Any) -> Picture | Animation:
        """Returns a picture for a notebook. With ``seconds`` it goes on for so long, and returns an animation of that.

        Other arguments are those of render. Outside of notebooks, ``show().save("picture.png")`` writes a file.
        """
        if seconds is None:
            return Picture(self.render(size, **how))
        count = round(_positive(seconds, "seconds") * _positive(frame_rate, "frame_rate"))
        if count > 10000:
            raise InputError("seconds", f"{count} frames are no short animation", "make at most 10000")
        begin = self.time
        frames = [self.render(size, **how)]
        for frame in range(1, count + 1):
            self.advance_to(max(begin + frame / frame_rate, self.time))
            frames.append(self.render(size, **how))
        return Animation(frames, frame_rate)

    def __repr__(self) -> str:
        return f"<pliant.Simulation {self.scene.name!r} at {self.time:g} s on {self.device}>"


def _array(values: npt.ArrayLike | None) -> Floats | None:
    return None if values is None else np.asarray(values, dtype=float)


def _vector(values: Any, name: str) -> list[float]:
    vector = np.asarray(values, dtype=float)
    if vector.shape != (3,) or not np.all(np.abs(vector) <= 1e9):
        raise InputError(name, f"{values!r} is no place", "write three numbers up to 1e9")
    return [float(number) for number in vector]


def _positive(value: float, name: str) -> float:
    if not 0 < value <= 1e30:
        raise InputError(name, f"{value} is out of range", "use a number above 0")
    return float(value)


def _camera(camera: Mapping[str, Any] | None) -> list[float] | None:
    if camera is None:
        return None
    unknown = set(camera) - {"eye", "target", "field_of_view"}
    if unknown or "eye" not in camera:
        raise InputError("camera", f"unknown: {', '.join(sorted(unknown))}" if unknown else "has no eye",
                         "write eye, target and field_of_view")
    eye, target = _vector(camera["eye"], "camera.eye"), _vector(camera.get("target", (0, 0, 0)), "camera.target")
    angle = camera.get("field_of_view", 40)
    if eye == target:
        raise InputError("camera", "eye and target are the same point", "move one of them")
    if not 1 <= angle <= 179:
        raise InputError("camera.field_of_view", f"{angle} is out of range", "use a number from 1 to 179")
    return [*eye, *target, float(angle)]
