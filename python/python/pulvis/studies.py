"""Studies: many runs of one scenario."""

from __future__ import annotations

import hashlib
import itertools
import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from . import _toml
from .errors import InputError
from .runs import Run, resume, run
from .scenarios import Scenario

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import pandas

__all__ = ["Case", "Study", "study"]

#: Values by their dotted keys to be combined with each other, or the settings of each run.
Over = Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]]

#: What is kept of a run.
Results = Callable[[Run], Mapping[str, float]]


@dataclass(frozen=True)
class Case:
    """One run of a study: what was set, its folder, what was kept of it, and why it failed if it did."""

    settings: dict[str, Any]
    folder: Path
    values: dict[str, float]
    error: str | None

    @property
    def run(self) -> Run:
        """The run, to be read."""
        return Run(self.folder / "run")


class Study(Sequence[Case]):
    """The runs of a study, in the order of their settings."""

    def __init__(self, cases: Sequence[Case]) -> None:
        self.cases = list(cases)

    def __getitem__(self, index: Any) -> Any:
        return self.cases[index]

    def __len__(self) -> int:
        return len(self.cases)

    def __iter__(self) -> Iterator[Case]:
        return iter(self.cases)

    @property
    def failed(self) -> list[Case]:
        """The runs that have failed."""
        return [case for case in self.cases if case.error is not None]

    def to_dataframe(self) -> pandas.DataFrame:
        """A row for each run: settings, what was kept, the error, and the folder."""
        import pandas

        rows = [{**c.settings, **c.values, "error": c.error, "folder": str(c.folder)} for c in self.cases]
        return pandas.DataFrame(rows)

    def __repr__(self) -> str:
        return f"<Study of {len(self)} runs, {len(self.failed)} of them failed>"


def study(
    scenario: Scenario,
    over: Over,
    folder: str | os.PathLike[str],
    *,
    results: Results | None = None,
    processes: int | None = None,
    executor: Executor | None = None,
) -> Study:
    """Runs a scenario with other values, each in a folder of its own, on one thread.

    A run that fails is recorded and the others go on. Called again with the same folder, runs that have ended or failed are
    not repeated, and one that was interrupted goes on from its checkpoint; a failed one is repeated if its folder is removed.

    Parameters
    ----------
    scenario : path or dict
        As for :func:`pulvis.run`.
    over : dict or list of dict
        Sequences of values by their dotted keys, all of which are combined; or the values of each run.
    folder : path
        Gets a folder ``case_0001`` and so on for each run, with ``case.json`` and the folder ``run``.
    results : callable, optional
        What is kept of a :class:`pulvis.Run`, as numbers by name; the last row of the time series if it is left out. With
        processes it must be a function of a module.
    processes : int, optional
        As many as there are processors if it is left out. A script that calls this needs the guard
        ``if __name__ == "__main__":``.
    executor : concurrent.futures.Executor, optional
        Where the runs are submitted to, in the place of processes of this machine.

    Returns
    -------
    Study

    Raises
    ------
    InputError
        The folder holds a study of another scenario or of other values.
    """
    settings = _settings(over)
    text = _toml.dumps(scenario) if isinstance(scenario, Mapping) else Path(scenario).read_text(encoding="utf-8")
    home = _open(Path(folder), text, settings)
    folders = [home / f"case_{number:04d}" for number in range(1, len(settings) + 1)]
    left = [number for number, case in enumerate(folders) if not (case / "case.json").is_file()]
    tasks = [(scenario, settings[number], str(folders[number]), results) for number in left]
    if executor is not None:
        _complete(executor, tasks)
    elif tasks:
        # Imported where they are needed: they take as long as all of the package.
        import multiprocessing
        from concurrent.futures import ProcessPoolExecutor

        # Threads of this process would not be those of a copy of it.
        context = multiprocessing.get_context("spawn")
        most = min(processes or os.cpu_count() or 1, len(tasks))
        with ProcessPoolExecutor(most, mp_context=context) as own:
            _complete(own, tasks)
    return Study([_read(case) for case in folders])


def _settings(over: Over) -> list[dict[str, Any]]:
    if isinstance(over, Mapping):
        combined = itertools.product(*(list(values) for values in over.values()))
        settings = [dict(zip(over, values)) for values in combined]
    else:
        settings = [dict(one) for one in over]
    # Numbers of numpy are written as those of Python.
    plain: list[dict[str, Any]] = json.loads(json.dumps(settings, default=lambda number: number.item()))
    if not plain:
        raise InputError("there is nothing to study: no values are given", key="over")
    return plain


def _open(home: Path, scenario: str, settings: list[dict[str, Any]]) -> Path:
    """The folder of the study, which must be new or that of the same study."""
    home.mkdir(parents=True, exist_ok=True)
    record = {"scenario": hashlib.sha256(scenario.encode()).hexdigest(), "settings": settings}
    file = home / "study.json"
    if not file.is_file():
        if any(home.iterdir()):
            raise InputError(f"{home} is not empty and holds no study; name another folder", file=str(home))
        _write(file, record)
    elif json.loads(file.read_text(encoding="utf-8")) != record:
        raise InputError(
            f"{home} holds a study of another scenario or of other values; name another folder", file=str(home)
        )
    return home


def _write(file: Path, record: Any) -> None:
    """Writes a file that is there as a whole or not at all."""
    draft = file.with_suffix(".tmp")
    draft.write_text(json.dumps(record, indent=1), encoding="utf-8")
    draft.replace(file)


def _complete(executor: Executor, tasks: list[tuple[Any, ...]]) -> None:
    from concurrent.futures import as_completed

    futures = [executor.submit(_case, *task) for task in tasks]
    try:
        for future in as_completed(futures):
            future.result()
    except BaseException:
        for future in futures:
            future.cancel()
        raise


def _case(scenario: Scenario, settings: dict[str, Any], folder: str, results: Results | None) -> None:
    """Runs one case and records what came of it."""
    home = Path(folder)
    home.mkdir(exist_ok=True)
    error, values = None, {}
    try:
        done = _run(scenario, settings, home / "run")
        kept = results(done) if results else {name: column[-1] for name, column in done.timeseries.items()}
        values = {name: float(value) for name, value in kept.items()}
    except Exception as failure:  # whatever it is, the other runs go on
        error = f"{type(failure).__name__}: {failure}"
    _write(home / "case.json", {"settings": settings, "values": values, "error": error})


def _run(scenario: Scenario, settings: dict[str, Any], folder: Path) -> Run:
    if (folder / "run.toml").is_file():
        try:
            return resume(folder, threads=1)
        except InputError:
            # It has ended, or cannot go on.
            return run(scenario, folder, set=settings, threads=1, force=True)
    return run(scenario, folder, set=settings, threads=1)


def _read(folder: Path) -> Case:
    case = json.loads((folder / "case.json").read_text(encoding="utf-8"))
    return Case(case["settings"], folder, case["values"], case["error"])
