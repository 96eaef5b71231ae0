"""A simulation step by step."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import NDArray

from . import _native, _toml
from ._columns import Columns
from .errors import InputError, checked_threads

if TYPE_CHECKING:
    import pandas

__all__ = ["Particles", "Simulation", "StageEnd", "Wall"]

#: A file, or a scenario as a dictionary whose numbers are in SI.
Scenario = Union[str, "os.PathLike[str]", Mapping[str, Any]]

#: Values that replace those of the scenario, by their dotted keys.
Settings = Mapping[str, Any]

#: More steps than any stage has.
_ALL = 2**62


def source_of(scenario: Scenario) -> Any:
    """What the compiled part takes for a scenario."""
    if isinstance(scenario, Mapping):
        return ("<dict>", _toml.dumps(scenario), True)
    return os.fspath(scenario)


@dataclass(frozen=True)
class StageEnd:
    """A stage that has ended: its name, why, the time [s] and the number of steps."""

    name: str
    ending: str
    time: float
    steps: int


@dataclass(frozen=True)
class Wall:
    """A wall as it is now; of a wall that is no plane, `normal` is ``None``."""

    name: str
    present: bool
    motion: str
    point: NDArray[np.float64]
    normal: NDArray[np.float64] | None
    velocity: NDArray[np.float64]
    force: NDArray[np.float64]
    torque: float
    area: float | None


class Particles:
    """The particles of a simulation.

    Attributes are *copies* in the order of the ids, which never changes: ``id``, ``material`` (an index), ``radius`` [m],
    ``mass`` [kg], ``position`` [m], ``velocity`` [m/s], ``angular_velocity`` [rad/s], ``force`` [N], ``torque`` [N m], and
    further columns of the scenario. :meth:`view` looks at the engine's own columns without a copy.
    """

    def __init__(self, session: _native.Session) -> None:
        self._session = session

    def __len__(self) -> int:
        return self._session.particle_count

    @property
    def names(self) -> list[str]:
        """The names of all columns."""
        return self._session.column_names()

    def __getitem__(self, name: str) -> NDArray[Any]:
        column = self._session.column(name)
        if column is None:
            raise KeyError(f"no column `{name}`; there are {', '.join(self.names)}")
        return column

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.names]

    def view(self, name: str) -> NDArray[np.float64]:
        """The engine's own column, without a copy and read-only, in the order of its rows.

        Rows change when the neighbour search sorts them: :attr:`row_ids` says which particle stands in which. As long as
        the array, or any array that was cut from it, is alive, :meth:`Simulation.advance` refuses to go on with a
        :class:`pulvis.ViewError`, so that a view never shows freed or moving memory.

        Parameters
        ----------
        name : str
            A column of numbers or vectors.
        """
        view = self._session.view(name)
        if view is None:
            raise KeyError(f"no column `{name}` that can be viewed; there are {', '.join(self.names[2:])}")
        return view

    @property
    def row_ids(self) -> NDArray[np.uint32]:
        """The ids in the order of the rows of views."""
        return self._session.row_ids()

    def to_columns(self) -> Columns:
        """Copies of all columns."""
        return Columns({name: self[name] for name in self.names})

    def to_dataframe(self) -> pandas.DataFrame:
        """All columns as a table of pandas."""
        return self.to_columns().to_dataframe()

    def __repr__(self) -> str:
        return f"{len(self)} particles: {', '.join(self.names)}"


class Simulation:
    """The stages of a scenario, step by step and without files; :func:`pulvis.run` writes files.

    After any number of steps the state has the same bits as in ``pulvis run``, however the steps are divided into calls
    and for any number of threads.

    Parameters
    ----------
    scenario : path or dict
        A scenario file, or a dictionary of the same structure whose bare numbers are in SI units.
    set : dict, optional
        Values that replace those of the scenario, by their dotted keys, as ``--set`` does it.
    threads : int, optional
        As many as there are processors and work for them, if it is left out.

    Raises
    ------
    InputError
        The scenario cannot be run; the text lists all mistakes.

    Examples
    --------
    >>> import pulvis
    >>> simulation = pulvis.Simulation({
    ...     "materials": {"glass": {"density": 2500}},
    ...     "contacts": {"glass-glass": {"normal": {"law": "linear", "k": 1000}}},
    ...     "particles": [{
    ...         "material": "glass",
    ...         "radius": {"distribution": "fixed", "value": 1e-3},
    ...         "arrangement": {"kind": "lattice", "lower": [0, 0, 0], "counts": [2, 1, 1], "spacing": 2.1e-3},
    ...         "velocity": {"standard_deviation": 0.1},
    ...     }],
    ...     "stages": [{"name": "fly", "until": {"time": 1e-4}}],
    ... })
    >>> simulation.particles.position.shape
    (2, 3)
    >>> [end.ending for end in simulation.run()]
    ['time over']
    """

    def __init__(
        self, scenario: Scenario, *, set: Settings | None = None, threads: int | None = None
    ) -> None:
        self._start(source_of(scenario), set, threads)

    @classmethod
    def from_file(
        cls, path: str | os.PathLike[str], *, set: Settings | None = None, threads: int | None = None
    ) -> Simulation:
        """A simulation of a scenario file."""
        return cls(path, set=set, threads=threads)

    @classmethod
    def from_text(
        cls, text: str, *, name: str = "<text>", set: Settings | None = None, threads: int | None = None
    ) -> Simulation:
        """A simulation of a scenario that is written as TOML; quantities carry units as in a file."""
        simulation = cls.__new__(cls)
        simulation._start((name, text, False), set, threads)
        return simulation

    def _start(self, source: Any, set: Settings | None, threads: int | None) -> None:
        self._session = _native.Session(source, list((set or {}).items()), checked_threads(threads))
        self._callbacks: list[tuple[int, Callable[[Simulation], object]]] = []
        self._rows: list[NDArray[np.float64]] = []
        for text in self._session.warnings:
            warnings.warn(text, stacklevel=3)

    # Time and stages

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._session.time

    @property
    def time_step(self) -> float:
        """Time step [s]."""
        return self._session.time_step

    @property
    def steps(self) -> int:
        """Steps done."""
        return self._session.steps

    @property
    def stage(self) -> str:
        """Name of the present stage; of the last one when it has ended."""
        return self._session.stage

    @property
    def stages(self) -> list[str]:
        """Names of all stages."""
        return self._session.stage_names

    @property
    def ended(self) -> list[StageEnd]:
        """The stages that have ended."""
        return [StageEnd(*end) for end in self._session.results]

    @property
    def is_over(self) -> bool:
        """Whether the last stage has ended."""
        return self._session.is_over

    @property
    def threads(self) -> int:
        """Number of threads, which may be set at any time; results do not depend on it."""
        return self._session.threads

    @threads.setter
    def threads(self, threads: int) -> None:
        self._session.threads = checked_threads(threads) or 1

    def advance(self, steps: int = 1) -> int:
        """Takes steps; stages change on the way. Ctrl-C stops it between two steps within 0.2 s.

        Parameters
        ----------
        steps : int

        Returns
        -------
        int
            Steps taken: fewer than asked for if the last stage has ended.

        Raises
        ------
        RunError
            What happens cannot be right; the text tells the likely cause. The state can be looked at, and goes on no more.
        ViewError
            Views of particle columns are alive.
        """
        if steps < 0:
            raise InputError(f"{steps} steps cannot be taken", key="steps")
        return self._advance(steps, one_stage=False)[0]

    def run(self, until: str | None = None) -> list[StageEnd]:
        """Runs the stages that are left.

        Parameters
        ----------
        until : str, optional
            Name of the stage whose end is the last to come.

        Returns
        -------
        list of StageEnd
            The stages that have ended.
        """
        left = self.stages[len(self._session.results) :]
        if until is not None and until not in left:
            raise InputError(f"no stage that is left is called {until!r}: {', '.join(left) or 'none is left'}")
        ended: list[StageEnd] = []
        while not self.is_over and not (ended and ended[-1].name == until):
            ended += self._advance(_ALL, one_stage=True)[1]
        return ended

    def _advance(self, steps: int, one_stage: bool) -> tuple[int, list[StageEnd]]:
        taken, ended = 0, []
        while taken < steps and not self.is_over:
            chunk = steps - taken
            for every, _ in self._callbacks:
                chunk = min(chunk, every - self.steps % every)
            done, ends = self._session.advance(chunk, one_stage)
            taken += done
            ended += [StageEnd(*end) for end in ends]
            for every, function in list(self._callbacks):
                if done > 0 and self.steps % every == 0:
                    function(self)
            if one_stage and ended:
                break
        return taken, ended

    def every(self, steps: int, function: Callable[[Simulation], object]) -> None:
        """Calls a function with this simulation whenever the number of steps is a multiple of `steps`.

        A call costs some microseconds beside what the function does, and calls of few steps lose the joint kicks of
        successive steps. An exception in the function ends :meth:`advance` or :meth:`run` with the state intact.
        """
        if steps < 1:
            raise InputError(f"every {steps} steps is never", key="steps")
        self._callbacks.append((steps, function))

    # State

    @property
    def particles(self) -> Particles:
        """The particles."""
        return Particles(self._session)

    @property
    def materials(self) -> list[str]:
        """Names of the materials, by their index."""
        return self._session.material_names

    def contacts(self) -> Columns:
        """All contacts that act: ``id1``, ``id2`` (of a wall -1 minus its index), ``centre1``, ``centre2`` [m], ``force`` on
        the first body [N], ``normal_force`` [N] and ``overlap`` [m]. Forces are computed from the state, as for files."""
        return Columns(self._session.contacts())

    @property
    def walls(self) -> dict[str, Wall]:
        """The walls by their names, as they are now."""
        return {wall["name"]: Wall(**wall) for wall in self._session.walls()}

    @property
    def ledger(self) -> dict[str, float]:
        """The accounts of the energy ledger [J], their sums, and the closing error."""
        return self._session.ledger()

    # Time series

    def measure(self) -> dict[str, float]:
        """One row of the time series, with the names of ``timeseries.csv``."""
        return dict(zip(self._session.row_names(), self._session.row().tolist()))

    def record(self) -> None:
        """Keeps the present row for :attr:`timeseries`: ``simulation.every(100, Simulation.record)``."""
        self._rows.append(self._session.row())

    @property
    def timeseries(self) -> Columns:
        """The rows that were recorded, as columns."""
        names = self._session.row_names()
        rows = np.array(self._rows) if self._rows else np.empty((0, len(names)))
        return Columns(dict(zip(names, rows.T)))

    def to_toml(self) -> str:
        """The scenario with all defaults filled in and in SI units, as ``run.toml`` of a run holds it."""
        return self._session.to_toml()

    def __iter__(self) -> Iterator[StageEnd]:
        """Runs stage by stage: ``for end in simulation``."""
        while not self.is_over:
            yield from self._advance(_ALL, one_stage=True)[1]

    def __repr__(self) -> str:
        return (
            f"<Simulation of {len(self.particles)} particles, stage {self.stage!r}, "
            f"step {self.steps}, t = {self.time:.6g} s>"
        )
