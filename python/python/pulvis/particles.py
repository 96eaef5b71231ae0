"""The particles of a simulation, as columns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._columns import Columns
from .errors import InputError

if TYPE_CHECKING:
    import pandas

__all__ = ["Particles"]

#: Vectors that can be set.
_VECTORS = ("position", "velocity", "angular_velocity")

#: Columns that follow from how particles were made, or from the others.
_FIXED = ("id", "material", "radius", "mass", "force", "torque", "applied_force")


class Particles:
    """The particles of a simulation.

    Attributes are *copies* in the order of the ids, which never changes: ``id``, ``material`` (an index), ``radius`` [m],
    ``mass`` [kg], ``position`` [m], ``velocity`` [m/s], ``angular_velocity`` [rad/s], ``force`` [N], ``torque`` [N m],
    ``applied_force`` [N], which :meth:`Simulation.apply` sets and ``force`` holds, and further columns of the scenario.
    :meth:`view` looks at the engine's own columns without a copy.

    ``position``, ``velocity``, ``angular_velocity`` and the columns of the scenario can be set, all particles at once and in
    the order of the ids: ``particles.velocity = array``, ``particles["charge"] = array``. The forces are computed anew, and
    the ledger books the change of the energy as ``switched``. A position that is set is no path: contacts keep what they
    remember.
    """

    _session: _native.Session

    def __init__(self, session: _native.Session) -> None:
        object.__setattr__(self, "_session", session)

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

    def __setitem__(self, name: str, values: ArrayLike) -> None:
        try:
            array = np.ascontiguousarray(values, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError(f"{name}: expected numbers in SI units", key=name) from None
        if name in _VECTORS:
            array = np.array(np.broadcast_to(array, (len(self), 3))) if array.ndim == 1 else array
            if array.shape != (len(self), 3):
                text = f"{name}: found an array of shape {array.shape}, expected {(len(self), 3)}"
                raise InputError(text, key=name)
            self._session.set_vectors(name, array)
        elif name in _FIXED:
            text = f"{name} cannot be set; {', '.join(_VECTORS)} and further columns can, and forces by `Simulation.apply`"
            raise InputError(text, key=name)
        elif name in self.names:
            self._session.set_column(name, None, np.array(np.broadcast_to(array, (len(self),))))
        else:
            text = f"no column `{name}`; there are {', '.join(self.names)}; `add` makes a new one"
            raise KeyError(text)

    def __setattr__(self, name: str, values: Any) -> None:
        try:
            self[name] = values
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def add(self, name: str, unit: str, values: ArrayLike) -> None:
        """Gives all particles a new quantity, which laws may read and files of runs hold.

        Parameters
        ----------
        name, unit : str
            Such as ``charge`` and ``C``.
        values : array
            In SI units, in the order of the ids.
        """
        array = np.array(np.broadcast_to(np.asarray(values, dtype=np.float64), (len(self),)))
        self._session.set_column(name, unit, array)

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
