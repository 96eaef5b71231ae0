"""Scenarios from files, dictionaries, and tables one by one."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Union

from . import _toml
from .errors import InputError
from .laws import Contact, Law, as_contact

__all__ = ["Scenario", "Settings", "StageEnd", "built", "source_of"]

#: Longer than anybody simulates [s].
_LONG = 1e6

#: A file, or a scenario as a dictionary whose numbers are in SI.
Scenario = Union[str, "os.PathLike[str]", Mapping[str, Any]]

#: Values that replace those of the scenario, by their dotted keys.
Settings = Mapping[str, Any]


@dataclass(frozen=True)
class StageEnd:
    """A stage that has ended: its name, why, the time [s] and the number of steps."""

    name: str
    ending: str
    time: float
    steps: int


def source_of(scenario: Scenario) -> Any:
    """What the compiled part takes for a scenario."""
    if isinstance(scenario, Mapping):
        return ("<dict>", _toml.dumps(scenario), True)
    return os.fspath(scenario)


def built(scenario: Scenario | None, tables: Mapping[str, Any]) -> dict[str, Any]:
    """A scenario from its tables, over those of a dictionary."""
    if scenario is not None and not isinstance(scenario, Mapping):
        key = next(iter(tables))
        raise InputError(f"{key}: a file has its tables; replace values with `set=`, or give a dictionary", key=key)
    whole = {**(scenario or {}), **{key: value for key, value in tables.items() if value is not None}}
    contacts = whole.get("contacts")
    if isinstance(contacts, Mapping):
        laws = (Law, Contact)
        whole["contacts"] = {
            pair: as_contact(one).tables() if isinstance(one, laws) else one for pair, one in contacts.items()
        }
    if isinstance(whole.get("particles"), Mapping):
        whole["particles"] = [whole["particles"]]
    whole.setdefault("stages", [{"name": "open", "until": {"time": _LONG}}])
    return whole
