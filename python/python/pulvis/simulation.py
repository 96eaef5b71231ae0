"""A simulation step by step."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._columns import Columns
from ._forces import forces_on_all, forces_on_some
from .errors import InputError, checked_threads
from .particles import Particles
from .scenarios import Scenario, Settings, StageEnd, built, source_of
from .walls import Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Simulation"]

#: Forces on the particles [N] in the order of the ids, none, or a function of the simulation that gives them.
Forces = Union[ArrayLike, None, "Callable[[Simulation], ArrayLike]"]

#: More steps than any stage has.
_ALL = 2**62


class Simulation:
    """The stages of a scenario, step by step and without files; :func:`pulvis.run` writes files.

    After any number of steps the state has the same bits as in ``pulvis run``, however the steps are divided into calls
    and for any number of threads.

    Parameters
    ----------
    scenario : path or dict, optional
        A scenario file, or a dictionary of the same structure whose bare numbers are in SI units.
    set : dict, optional
        Values that replace those of the scenario, by their dotted keys, as ``--set`` does it.
    threads : int, optional
        As many as there are processors and work for them, if it is left out.
    **tables
        Tables of a scenario one by one, in the place of `scenario` or beside a dictionary: ``materials=``, ``contacts=``
        (whose values may be laws and contacts), ``particles=``, ``walls=``, ``gravity=``, and so on. Without ``stages``
        there is one, which goes on for as long as steps are taken.

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
        self,
        scenario: Scenario | None = None,
        *,
        set: Settings | None = None,
        threads: int | None = None,
        **tables: Any,
    ) -> None:
        if scenario is None or tables:
            scenario = built(scenario, tables)
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

    @classmethod
    def resume(cls, path: str | os.PathLike[str], *, threads: int | None = None) -> Simulation:
        """Goes on from a checkpoint of :meth:`save`, or of a run: a file, or the folder of the run, which is not changed.

        What the program has set of particles, forces and walls is part of it. Functions are not: callbacks, and one that gives
        forces, have to be given again before the next step; until then the forces act on that it has given last. Recorded
        rows are not part of it either.
        """
        simulation = cls.__new__(cls)
        simulation._take(_native.Session.resume(os.fspath(path), checked_threads(threads)))
        return simulation

    def _start(self, source: Any, set: Settings | None, threads: int | None) -> None:
        self._take(_native.Session(source, list((set or {}).items()), checked_threads(threads)))

    def _take(self, session: _native.Session) -> None:
        self._session = session
        self._callbacks: list[tuple[int, Callable[[Simulation], object]]] = []
        self._rows: list[NDArray[np.float64]] = []
        self._forces: Callable[[Simulation], ArrayLike] | None = None
        for text in self._session.warnings:
            warnings.warn(text, stacklevel=4)

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
        if not self._callbacks and self._forces is None:
            return self._session.advance(steps, False)[0]
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
            if self._forces is not None:
                self._apply(self._forces(self))
                chunk = 1
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

    def apply(self, forces: Forces, ids: ArrayLike | None = None) -> None:
        """Applies forces to the particles, on top of contacts and gravity, in all steps from now on.

        Parameters
        ----------
        forces : array, callable or None
            Vectors [N], one for each particle in the order of the ids, which stay as they are until others are applied; a
            function of the simulation that is asked before every step; or ``None`` to apply none any more.
        ids : array, optional
            The particles that the vectors are for, one each; all others keep what is applied to them.

        Raises
        ------
        InputError
            There is not one vector for each particle, or no particle with such an id.

        Notes
        -----
        The work of the forces is booked in the ledger as ``switched``. A function is asked before each step and gives the
        force that holds in it; one of positions thus lags behind by half a step. Steps are then taken one by one, which costs
        some microseconds each beside what the function does. A force belongs to its particle, wherever that stands in the
        arrays after others have come or gone: particles that an inlet brings in have none until some are applied anew, those
        that an outlet takes away take theirs with them. ``particles.applied_force`` tells what is applied.

        Examples
        --------
        >>> def drag(simulation):  # of a fluid that flows along x
        ...     return 1e-6 * (np.array([0.1, 0, 0]) - simulation.particles.velocity)
        >>> simulation.apply(drag)  # doctest: +SKIP
        """
        if ids is not None:
            if forces is None or callable(forces):
                raise InputError("ids: they go with an array of forces", key="ids")
            forces = forces_on_some(self.particles, forces, ids)
        if forces is not None and callable(forces):
            self._forces = forces
            return
        self._apply(forces)
        self._forces = None

    def _apply(self, forces: ArrayLike | None) -> None:
        array = np.empty((0, 3)) if forces is None else forces_on_all(self.particles, forces)
        self._session.set_vectors("applied_force", array)

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
        the first body [N], ``normal_force`` [N], ``overlap`` [m], ``stored_energy`` [J], and what the laws remember, by its
        name in the catalogue (NaN where a contact has none). Forces are computed from the state, as for files.
        ``contacts().to_structured()`` gives one structured array."""
        return Columns(self._session.contacts())

    @property
    def walls(self) -> dict[str, Wall]:
        """The walls by their names: ``simulation.walls["lid"].velocity = (0, 0, -0.01)``."""
        names = [str(wall["name"]) for wall in self._session.walls()]
        return {name: Wall(self._session, index, name) for index, name in enumerate(names)}

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

    def plot(self, *names: str, x: str = "time", ax: Axes | None = None) -> Axes:
        """Draws columns of the rows that were recorded with matplotlib.

        Parameters
        ----------
        *names : str
            Names of columns; ``kinetic`` if none is given.
        x : str
        ax : matplotlib Axes, optional
            Where to draw; a new figure if it is left out.
        """
        import matplotlib.pyplot as plt

        axes: Axes = plt.gca() if ax is None else ax
        series = self.timeseries
        for name in names or ("kinetic",):
            axes.plot(series[x], series[name], label=name)
        axes.set_xlabel(x)
        axes.legend()
        return axes

    # Files

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes everything that the simulation is into a checkpoint, for :meth:`resume` and for ``start_from`` of scenarios:
        what the program has set of particles, forces and walls, too. The steps after it have the same bits as without it.

        Raises
        ------
        RunError
            No step was taken yet, or the file cannot be written.
        """
        self._session.save(os.fspath(path))

    def write(self, folder: str | os.PathLike[str], format: str = "vtk", *, contacts: bool = True) -> None:
        """Writes the present instant into a folder, as ``[[output.files]]`` of runs does it.

        Parameters
        ----------
        folder : path
            Is made if it does not exist. Later calls go on with the same files, or write those of the next number.
        format : str
            ``vtk``, ``lammps-dump``, ``xyz``, ``npz`` or ``csv``, or ``hdf5`` where it was built in.
        contacts : bool
            Whether contacts are written.
        """
        self._session.write_instant(os.fspath(folder), format, contacts)

    def picture(self, path: str | os.PathLike[str], *, dpi: int = 144) -> None:
        """Draws the particles into a PNG file, as runs do it at their end."""
        self._session.write_picture(os.fspath(path), dpi)

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
