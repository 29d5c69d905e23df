"""Triangle meshes."""
from __future__ import annotations

import json
from os import PathLike, fspath
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core


class Mesh(NamedTuple):
    """A triangle surface.

    Attributes:
        positions: (n, 3) float, of the vertices [mesh units].
        triangles: (m, 3) int, vertex numbers from 0, counter-clockwise seen from outside.
    """

    positions: npt.NDArray[Any]
    triangles: npt.NDArray[Any]

    def subdivide(self, count: int = 1, scheme: Literal["midpoint", "loop"] = "midpoint") -> Mesh:
        """Returns the mesh with each triangle split in four, ``count`` times.

        ``midpoint`` keeps the surface, ``loop`` makes it smooth. Vertices keep their numbers. Raises InputError if there would be
        too many triangles.
        """
        return Mesh(*_core.subdivide(self.positions, self.triangles, count, scheme))

    def report(self) -> dict[str, Any]:
        """Returns what the mesh consists of and what is wrong with it: the keys of ``pliant mesh --json``."""
        report: dict[str, Any] = json.loads(_core.report_mesh(self.positions, self.triangles))
        return report

    def write(self, path: str | PathLike[str]) -> None:
        """Writes an OBJ or PLY file, by the path's extension. Positions keep every bit."""
        _core.write_mesh(fspath(path), self.positions, self.triangles)


def mesh(description: str | PathLike[str]) -> Mesh:
    """Returns a generated mesh, such as ``"icosphere:3"``, or one from an OBJ file.

    Generators are those of scenes: see docs/scenes.md. Warns of flaws by SceneWarning. Raises InputError if the file is missing or
    malformed.
    """
    from .scene import warn_all

    (positions, triangles), warnings = _core.load_mesh(fspath(description), ".")
    warn_all(warnings, stacklevel=2)
    return Mesh(np.asarray(positions), np.asarray(triangles))
