"""Scenes: what there is to simulate, before anything is loaded or built."""
from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np

from . import _core, _toml
from .errors import _VALUES, InputError, SceneWarning, in_pythons_words
from .mesh import Mesh

Overrides = Mapping[str, Any]
"""Values by their keys, such as ``{"body.left.stiffness": 50, "simulation.time_step": 1e-3}``."""


def warn_all(texts: Iterable[str], stacklevel: int) -> None:
    """Issues a SceneWarning for each text. The caller's caller is blamed if ``stacklevel`` is 2, as in warnings.warn."""
    for text in texts:
        warnings.warn(in_pythons_words(text), SceneWarning, stacklevel=stacklevel + 1)


def _texts(overrides: Overrides | None) -> list[str]:
    return [f"{key}={_toml.value(value, key)}" for key, value in (overrides or {}).items()]


class Scene:
    """A scene, from Python values or a TOML file. It never changes, and can be pickled.

    ``tables`` are the tables of a scene file, as docs/scenes.md lists them. A body's ``mesh`` may also be a ``Mesh``, or a pair of
    arrays (positions, triangles)::

        scene = pliant.Scene({
            "simulation": {"duration": 1.0, "gravity": [0, -9.81, 0]},
            "body": [{"name": "ball", "mesh": "icosphere:3", "position": [0, 1, 0], "damping": 0.1}],
            "ground": [{"height": 0}],
        })

    Args:
        tables: the scene's tables.
        set: values that replace those of the tables, by keys such as ``"body.ball.stiffness"``.
        folder: where relative paths of meshes start.

    Raises:
        InputError: a key is unknown, or a value is out of range.
    """

    def __init__(self, tables: Mapping[str, Any], *, set: Overrides | None = None, folder: str | PathLike[str] = ".") -> None:
        described = dict(tables)
        meshes = _take_meshes(described)
        self._begin(_toml.document(described), Path(folder) / _VALUES, _texts(set), meshes)

    @staticmethod
    def load(path: str | PathLike[str], *, set: Overrides | None = None) -> Scene:
        """Returns the scene of a TOML file. Paths of meshes start in its folder. Raises InputError that names the line."""
        file = Path(path)
        return Scene._of(_core.read_text(fspath(file)), file, _texts(set), {})

    @staticmethod
    def parse(text: str, *, set: Overrides | None = None, folder: str | PathLike[str] = ".") -> Scene:
        """Returns the scene of a TOML text. Paths of meshes start in ``folder``. Raises InputError that names the line."""
        return Scene._of(text, Path(folder) / "scene", _texts(set), {})

    def override(self, set: Overrides) -> Scene:
        """Returns the scene with other values, by keys such as ``"body.left.stiffness"``. Later ones replace earlier ones."""
        return Scene._of(self._text, self._file, self._overrides + _texts(set), self._meshes)

    @property
    def title(self) -> str:
        return str(self._told["title"])

    @property
    def name(self) -> str:
        """Its title, or else the name of its file."""
        return self.title or self._file.stem.strip("<>")

    @property
    def duration(self) -> float:
        """How long a run simulates [s]."""
        return float(self._told["duration"])

    @property
    def frame_rate(self) -> float:
        """Frames per simulated second."""
        return float(self._told["frame_rate"])

    @property
    def bodies(self) -> list[str]:
        """The names of the bodies, in their order."""
        return list(self._told["bodies"])

    @property
    def text(self) -> str:
        """The TOML that the scene was made of, without overrides and meshes in memory."""
        return self._text

    def __repr__(self) -> str:
        count = len(self.bodies)
        return f"<pliant.Scene {self.name!r}, {count} {'body' if count == 1 else 'bodies'}, {self.duration:g} s>"

    @classmethod
    def _of(cls, text: str, file: Path, overrides: list[str], meshes: dict[str, Mesh]) -> Scene:
        scene = cls.__new__(cls)
        scene._begin(text, file, overrides, meshes)
        return scene

    def _begin(self, text: str, file: Path, overrides: list[str], meshes: dict[str, Mesh]) -> None:
        self._text, self._file, self._overrides, self._meshes = text, file, overrides, meshes
        self._told = _core.read_scene(text, fspath(file), overrides)


def _take_meshes(tables: dict[str, Any]) -> dict[str, Mesh]:
    """Returns copies of the meshes in memory, by names that stand in their place from then on. The same arrays are one mesh."""
    meshes: dict[str, Mesh] = {}
    names: dict[tuple[int, int], str] = {}

    def name_of(positions: Any, triangles: Any) -> str:
        arrays = id(positions), id(triangles)
        if arrays not in names:
            mesh = Mesh(np.array(positions, dtype=float), _vertex_numbers(triangles))
            _core.check_mesh(*mesh)
            names[arrays] = f"array:{len(meshes)}"
            meshes[names[arrays]] = mesh
        return names[arrays]

    bodies = tables.get("body")
    if isinstance(bodies, Mapping):
        raise InputError("Scene: body", "is one body alone", "write a list of bodies, as in \"body\": [{...}]")
    if isinstance(bodies, (list, tuple)):
        tables["body"] = [{**body, "mesh": name_of(*body["mesh"])} if _has_arrays(body) else body for body in bodies]
    return meshes


def _vertex_numbers(triangles: Any) -> np.ndarray[Any, np.dtype[np.int64]]:
    numbers = np.asarray(triangles)
    if numbers.size == 0:
        return np.zeros((0, 3), np.int64)
    if not np.issubdtype(numbers.dtype, np.integer):
        raise InputError("triangles", f"are {numbers.dtype}", "give vertex numbers, which are whole")
    return np.array(numbers, dtype=np.int64)


def _has_arrays(body: Any) -> bool:
    mesh = body.get("mesh") if isinstance(body, Mapping) else None
    return isinstance(mesh, (tuple, list)) and len(mesh) == 2
