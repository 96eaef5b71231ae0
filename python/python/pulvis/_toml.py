"""Dictionaries as TOML texts, whose numbers are in SI."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import InputError


def dumps(table: Mapping[str, Any]) -> str:
    """A dictionary as a TOML text: tables and lists of tables with headers, everything else as ``key = value``."""
    lines: list[str] = []
    _write(table, "", lines)
    return "\n".join(lines) + "\n"


def _write(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    below: list[tuple[str, Any]] = []
    for key, value in table.items():
        if isinstance(value, Mapping) or _is_tables(value):
            below.append((_key(key), value))
        elif value is not None:
            lines.append(f"{_key(key)} = {_value(value, key)}")
    for key, value in below:
        full = f"{path}.{key}" if path else key
        if isinstance(value, Mapping):
            lines.append(f"[{full}]")
            _write(value, full, lines)
        else:
            for item in value:
                lines.append(f"[[{full}]]")
                _write(item, full, lines)


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(v, Mapping) for v in value)


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise InputError(f"keys of a scenario are texts, and {key!r} is none")
    plain = key != "" and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else json.dumps(key, ensure_ascii=False)


def _value(value: Any, key: str) -> str:
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item, key) for item in value) + "]"
    if isinstance(value, Mapping):
        items = (f"{_key(k)} = {_value(v, k)}" for k, v in value.items() if v is not None)
        return "{ " + ", ".join(items) + " }"
    raise InputError(
        f"{key}: a {type(value).__name__} has no place in a scenario; "
        "expected numbers (SI), texts, truth values, lists or dictionaries",
        key=key,
    )
