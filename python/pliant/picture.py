"""Pictures and short animations, which notebooks show. Both are PNG: browsers play animated ones."""
from __future__ import annotations

import base64
import struct
import zlib
from collections.abc import Sequence
from os import PathLike
from pathlib import Path

import numpy as np
import numpy.typing as npt

from .errors import InputError

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _header(pixels: npt.NDArray[np.uint8]) -> bytes:
    height, width, _ = pixels.shape
    return _SIGNATURE + _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))


def _compressed(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Each row is the difference to the row above (filter type 2), which compresses well."""
    rows = pixels.reshape(len(pixels), -1)
    filtered = np.full((rows.shape[0], rows.shape[1] + 1), 2, np.uint8)
    filtered[:, 1:] = rows
    filtered[1:, 1:] -= rows[:-1]
    return zlib.compress(filtered.tobytes(), 6)


def _checked(pixels: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.size == 0:
        raise InputError("pixels", f"are {pixels.dtype} of shape {pixels.shape}", "give uint8 of shape (height, width, 3)")
    return pixels


def _changed(before: npt.NDArray[np.uint8], after: npt.NDArray[np.uint8]) -> tuple[slice, slice]:
    """Returns the smallest part, rows then columns, that has all that differs. It has one pixel at least."""
    differs = (before != after).any(axis=2)
    rows, columns = differs.any(axis=1).nonzero()[0], differs.any(axis=0).nonzero()[0]
    if len(rows) == 0:
        return slice(0, 1), slice(0, 1)
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


class Picture:
    """A picture.

    Attributes:
        pixels: (height, width, 3) uint8, red, green and blue in sRGB, from the top left.
    """

    def __init__(self, pixels: npt.NDArray[np.uint8]) -> None:
        self.pixels = _checked(pixels)

    def png(self) -> bytes:
        """Returns the picture as a PNG file."""
        return _header(self.pixels) + _chunk(b"IDAT", _compressed(self.pixels)) + _chunk(b"IEND", b"")

    def save(self, path: str | PathLike[str]) -> None:
        """Writes a PNG file."""
        Path(path).write_bytes(self.png())

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        height, width, _ = self.pixels.shape
        return f"<pliant.Picture {width} x {height}>"


class Animation:
    """Pictures of the same size, played over and over.

    Attributes:
        frames: (height, width, 3) uint8 each.
        frame_rate: frames per second.
    """

    def __init__(self, frames: Sequence[npt.NDArray[np.uint8]], frame_rate: float) -> None:
        self.frames = [_checked(frame) for frame in frames]
        self.frame_rate = frame_rate
        if len({frame.shape for frame in self.frames}) != 1:
            raise InputError("frames", "are none, or of several sizes", "give one or more of the same size")
        if not 0.2 <= frame_rate <= 1000:
            raise InputError("frame_rate", f"{frame_rate} is out of range", "use a number from 0.2 to 1000")

    def png(self) -> bytes:
        """Returns the animation as an animated PNG file, which browsers and most viewers play."""
        parts = [_header(self.frames[0]), _chunk(b"acTL", struct.pack(">II", len(self.frames), 0))]
        number = 0  # of chunks in their order
        for before, pixels in zip([None, *self.frames], self.frames):
            changed = slice(None), slice(None)
            if before is not None:
                changed = _changed(before, pixels)
            part = pixels[changed]
            place = struct.pack(">IIII", part.shape[1], part.shape[0], changed[1].start or 0, changed[0].start or 0)
            delay = struct.pack(">HH", round(10000 / self.frame_rate), 10000)
            parts.append(_chunk(b"fcTL", struct.pack(">I", number) + place + delay + b"\0\0"))
            number += 1
            if before is None:
                parts.append(_chunk(b"IDAT", _compressed(part)))
            else:
                parts.append(_chunk(b"fdAT", struct.pack(">I", number) + _compressed(part)))
                number += 1
        return b"".join(parts) + _chunk(b"IEND", b"")

    def save(self, path: str | PathLike[str]) -> None:
        """Writes an animated PNG file."""
        Path(path).write_bytes(self.png())

    def _repr_html_(self) -> str:
        height, width, _ = self.frames[0].shape
        data = base64.b64encode(self.png()).decode("ascii")
        return f'<img width="{width}" height="{height}" src="data:image/png;base64,{data}">'

    def __repr__(self) -> str:
        height, width, _ = self.frames[0].shape
        return f"<pliant.Animation {len(self.frames)} frames, {width} x {height}>"
