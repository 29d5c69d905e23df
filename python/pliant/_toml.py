"""Writes Python values as TOML, which the library reads scenes from."""
from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any

from .errors import InputError


def _quoted(text: str) -> str:
    escapes = {'"': '\\"', "\\": "\\\\"}
    plain = (escapes.get(c) or (c if c.isprintable() else f"\\U{ord(c):08x}") for c in text)
    return '"' + "".join(plain) + '"'


def _name(key: Any) -> str:
    """Returns a key, bare if it may be."""
    text = str(key)
    return text if re.fullmatch(r"[A-Za-z0-9_-]+", text) else _quoted(text)


def value(of: Any, key: str) -> str:
    """Returns a value as TOML. Numpy's scalars and arrays count as numbers and lists. ``key`` names it in errors."""
    if hasattr(of, "tolist"):
        of = of.tolist()
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, int):
        return str(of)
    if isinstance(of, float):
        return repr(of) if math.isfinite(of) else ("nan" if of != of else "inf" if of > 0 else "-inf")
    if isinstance(of, (str, PathLike)):
        return _quoted(str(of))
    if isinstance(of, Mapping):
        return "{" + ", ".join(f"{_name(k)} = {value(v, f'{key}.{k}')}" for k, v in of.items()) + "}"
    if isinstance(of, Iterable):
        return "[" + ", ".join(value(v, f"{key}[{k}]") for k, v in enumerate(of)) + "]"
    raise InputError(f"Scene: {key}" if key else "Scene", f"{type(of).__name__} is nothing that a scene can hold",
                     "use numbers, texts, lists and dicts")


def document(tables: Mapping[str, Any]) -> str:
    """Returns a document with a line for each value and a table for each dict, so that people can read it."""
    lines: list[str] = []
    tables_behind: list[str] = []

    def add_table(head: str, table: Mapping[str, Any], key: str) -> None:
        tables_behind.extend(["", head])
        tables_behind.extend(f"{_name(k)} = {value(v, f'{key}.{k}')}" for k, v in table.items())

    for key, of in tables.items():
        if isinstance(of, Mapping):
            add_table(f"[{_name(key)}]", of, str(key))
        elif isinstance(of, (list, tuple)) and of and all(isinstance(item, Mapping) for item in of):
            for index, item in enumerate(of):
                add_table(f"[[{_name(key)}]]", item, f"{key}[{index}]")
        else:
            lines.append(f"{_name(key)} = {value(of, str(key))}")
    lines += tables_behind
    return "\n".join(lines) + "\n"
