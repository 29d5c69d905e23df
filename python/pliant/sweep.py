"""The command ``pliant sweep``, or ``python3 -m pliant.sweep``: makes the runs that a file lists. docs/sweeps.md has its keys."""
from __future__ import annotations

import argparse
import contextlib
import importlib
import math
import sys
import tomllib
import types
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import numpy as np

from ._sweep import Row, sweep
from .errors import DeviceError, Error, InputError
from .scene import Scene

_KEYS = {"scene": str, "table": str, "device": str, "runs_per_gpu": int, "precision": int, "threads": int, "values": dict}
_RANGE_KEYS = {"from", "to", "count", "spacing"}


def _read(file: Path) -> dict[str, Any]:
    """Returns what a sweep's file says. Raises InputError that names the key."""
    try:
        described = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(str(file), f"can't be read: {error}", "name a file of a sweep") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(str(file), str(error), "correct the TOML") from error
    for key, value in described.items():
        if key not in _KEYS:
            raise InputError(f"{file}: {key}", "unknown key", f"known here: {', '.join(_KEYS)}")
        if not isinstance(value, _KEYS[key]) or isinstance(value, bool):
            raise InputError(f"{file}: {key}", f"is {value!r}", f"write {_KEYS[key].__name__}")
    for key in ("scene", "values"):
        if key not in described:
            raise InputError(str(file), f"has no {key}", f"write {key} = ..." if key == "scene" else "add the table [values]")
    described["values"] = {key: _values(value, f"{file}: values.{key}") for key, value in _flat(described["values"])}
    return described


def _flat(tables: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Keys with dots may be written with quotation marks or without."""
    for key, value in tables.items():
        if isinstance(value, dict) and not _RANGE_KEYS & set(value):
            yield from _flat(value, f"{before}{key}.")
        else:
            yield before + key, value


def _values(value: Any, place: str) -> list[Any]:
    if isinstance(value, list):
        return value
    if not isinstance(value, dict):
        return [value]
    if not _RANGE_KEYS >= set(value) or not {"from", "to", "count"} <= set(value):
        raise InputError(place, f"has the keys {', '.join(value)}", "write from, to, count and maybe spacing")
    first, last, count, spacing = value["from"], value["to"], value["count"], value.get("spacing", "linear")
    if type(count) is not int or not 1 <= count <= 10**6:
        raise InputError(f"{place}.count", f"is {count!r}", "write a whole number from 1 to 1000000")
    if spacing not in ("linear", "logarithmic"):
        raise InputError(f"{place}.spacing", f"is {spacing!r}", "write one of linear, logarithmic")
    ends_are_numbers = all(type(end) in (int, float) and math.isfinite(end) for end in (first, last))
    if not ends_are_numbers or (spacing == "logarithmic" and not min(first, last) > 0):
        raise InputError(place, f"goes from {first!r} to {last!r}", "write numbers, above 0 if they are spaced logarithmically")
    numbers = np.linspace(first, last, count) if spacing == "linear" else np.geomspace(first, last, count)
    return [float(number) for number in numbers]


def _module(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise DeviceError("--executor", f"needs {name}, which is not there: {error}", f"install {package}") from error


@contextlib.contextmanager
def _executor(name: str) -> Iterator[Executor | None]:
    """Yields what runs the workers: None for processes, or an executor of Dask or mpi4py."""
    kind, _, address = name.partition(":")
    if kind == "processes":
        yield None
    elif kind == "dask":
        with _module("distributed", "python3-distributed").Client(address or None) as client:
            yield client.get_executor(pure=False)
    elif kind == "mpi":
        with _module("mpi4py.futures", "python3-mpi4py").MPIPoolExecutor() as executor:
            yield executor
    else:
        raise InputError("--executor", f"{name!r} is no choice", "write one of processes, dask:ADDRESS, mpi")


def _show(rows: Sequence[Row], table: Path) -> int:
    """Returns the exit code."""
    failed = [row for row in rows if row["error"]]
    broken = sum(bool(row.get("breakdown")) for row in rows)
    print(f"table: {table} ({len(rows)} runs"
          + (f", {len(failed)} with an error" if failed else "") + (f", {broken} with a breakdown" if broken else "") + ")")
    if failed:
        print(f"pliant: the first error: {failed[0]['error']}", file=sys.stderr)
    return 3 if failed else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Returns the exit code: 0, 2 for the command line, 3 for the file or if a run had an error, 4 where something is missing, 130
    after Ctrl-C."""
    parser = argparse.ArgumentParser("pliant sweep", description="Makes the runs of a scene that a file lists, side by side.")
    parser.add_argument("file", type=Path, help="TOML file with the keys scene, values and others")
    parser.add_argument("--out", type=Path, help="the table to write (CSV); runs that it has are not made again")
    parser.add_argument("--workers", type=int, help="processes, or workers of the executor (default: one a processor)")
    parser.add_argument("--device", help="cpu, gpu or gpu:N (default: as the file says, else cpu)")
    parser.add_argument("--executor", default="processes", help="processes, dask:ADDRESS or mpi (default: processes)")
    parser.add_argument("--quiet", action="store_true", help="show no progress")
    given = parser.parse_args(arguments)
    table = given.out or Path(given.file.stem + ".csv")
    try:
        if given.workers is not None and given.workers < 1:
            raise InputError("--workers", f"{given.workers} is below 1", "name at least one")
        described = _read(given.file)
        folder = given.file.parent
        table = given.out or folder / described.get("table", given.file.stem + ".csv")
        options = {key: described[key] for key in ("runs_per_gpu", "precision", "threads") if key in described}
        with _executor(given.executor) as executor:
            rows = sweep(Scene.load(folder / described["scene"]), described["values"], out=table, executor=executor,
                         workers=given.workers, device=given.device or described.get("device", "cpu"),
                         progress=False if given.quiet else None, **options)
        return _show(rows, table)
    except Error as error:
        print(f"pliant: {error}", file=sys.stderr)
        return 4 if isinstance(error, DeviceError) else 2 if error.place.startswith("--") else 3
    except OSError as error:
        print(f"pliant: {error.filename or table}: {error.strerror or error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\npliant: stopped; the table has the runs so far, and the same command makes the others", file=sys.stderr)
        return 130


class _CallableModule(types.ModuleType):
    """Whoever imports this module finds it by the name of the function. So it can be called like that."""

    def __call__(self, *arguments: Any, **named: Any) -> list[Row]:
        return sweep(*arguments, **named)


if __name__ == "__main__":
    sys.exit(main())
sys.modules[__name__].__class__ = _CallableModule
