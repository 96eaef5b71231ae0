"""Whole runs with their files."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _native
from ._columns import Columns
from .errors import InputError, checked_threads
from .scenarios import Scenario, Settings, StageEnd, source_of

__all__ = ["Run", "resume", "run"]


class Run:
    """The folder of a run.

    Parameters
    ----------
    folder : path
        The output folder of ``pulvis run`` or :func:`pulvis.run`.

    Attributes
    ----------
    folder : pathlib.Path
    summary : dict
        What :func:`pulvis.run` found out; empty of a run that is only read.
    """

    def __init__(self, folder: str | os.PathLike[str], summary: Mapping[str, Any] | None = None) -> None:
        self.folder = Path(folder)
        self.summary = dict(summary or {})
        if not (self.folder / "run.toml").is_file():
            raise InputError(f"{self.folder} holds no run of Pulvis", file=str(self.folder))

    @property
    def stages(self) -> list[StageEnd]:
        """The stages that have ended."""
        return [StageEnd(*end) for end in self.summary.get("stages", ())]

    @property
    def timeseries(self) -> Columns:
        """The columns of ``timeseries.csv``."""
        file = self.folder / "timeseries.csv"
        with file.open(encoding="utf-8") as lines:
            names = lines.readline().strip().split(",")
            rows = np.genfromtxt(lines, delimiter=",", ndmin=2)
        return Columns(dict(zip(names, rows.T))) if rows.size else Columns({n: np.empty(0) for n in names})

    @property
    def scenario(self) -> str:
        """The scenario with all defaults filled in and in SI units."""
        return (self.folder / "run.toml").read_text(encoding="utf-8")

    def __repr__(self) -> str:
        return f"<Run in {self.folder}>"


def run(
    scenario: Scenario,
    output: str | os.PathLike[str] | None = None,
    *,
    set: Settings | None = None,
    force: bool = False,
    threads: int | None = None,
    svg: bool = False,
    progress: Callable[[dict[str, Any]], object] | None = None,
) -> Run:
    """Runs a scenario with all its stages and files, as ``pulvis run`` does it.

    Parameters
    ----------
    scenario : path or dict
        A scenario file, or a dictionary of the same structure whose bare numbers are in SI units.
    output : path, optional
        The output folder, instead of the scenario's own.
    set : dict, optional
        Values that replace those of the scenario, by their dotted keys.
    force : bool
        Whether to write over a run that is in the folder and has ended.
    threads : int, optional
    svg : bool
        Whether plots are written as SVG too.
    progress : callable, optional
        Called some times a second with a dictionary: ``stage``, ``number``, ``stages``, ``time``, ``steps``,
        ``steps_per_second``, ``fraction``, ``remaining``, ``energy_error``, ``ending``.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        The scenario cannot be run, or the folder not be used.
    RunError
        What happened cannot be right; files are complete up to there.
    KeyboardInterrupt
        Ctrl-C: files are complete, and a checkpoint is written, from which :func:`resume` goes on.
    """
    folder = None if output is None else os.fspath(output)
    arguments = (list((set or {}).items()), folder, force, checked_threads(threads), svg, False, progress)
    summary = _native.run(source_of(scenario), *arguments)
    return Run(summary["folder"], summary)


def resume(
    folder: str | os.PathLike[str],
    *,
    threads: int | None = None,
    progress: Callable[[dict[str, Any]], object] | None = None,
) -> Run:
    """Goes on with an interrupted run, from the latest checkpoint in its folder. All files become what they would have
    become without the interruption, byte by byte.

    Raises
    ------
    InputError
        There is no run, it goes on or has ended, or its checkpoint cannot be used.
    """
    summary = _native.run(os.fspath(folder), [], None, False, checked_threads(threads), False, True, progress)
    return Run(summary["folder"], summary)
