"""The walls of a simulation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .errors import InputError

__all__ = ["Wall"]


class Wall:
    """A wall of a simulation. Attributes are read as they are now; motions can be set.

    What a program sets holds until a stage of the scenario controls the wall. Checkpoints hold it.
    """

    def __init__(self, session: _native.Session, index: int, name: str) -> None:
        self._session = session
        self._index = index
        self._name = name

    def _now(self, key: str) -> Any:
        return self._session.walls()[self._index][key]

    @property
    def name(self) -> str:
        """Its name in the scenario."""
        return self._name

    @property
    def motion(self) -> str:
        """The name of its motion: ``fixed``, ``velocity``, ``cosine``, ``servo`` or ``rotation``."""
        return str(self._now("motion"))

    @property
    def point(self) -> NDArray[np.float64]:
        """Its reference point [m]."""
        point: NDArray[np.float64] = self._now("point")
        return point

    @property
    def normal(self) -> NDArray[np.float64] | None:
        """The normal that points to the particles; ``None`` of a wall that is no plane."""
        normal: NDArray[np.float64] | None = self._now("normal")
        return normal

    @property
    def force(self) -> NDArray[np.float64]:
        """The force of the wall on the particles [N]."""
        force: NDArray[np.float64] = self._now("force")
        return force

    @property
    def torque(self) -> float:
        """The torque of the wall on the particles about its axis [N m]."""
        return float(self._now("torque"))

    @property
    def area(self) -> float | None:
        """Area of its face [m^2], where it is known."""
        area: float | None = self._now("area")
        return area

    @property
    def velocity(self) -> NDArray[np.float64]:
        """Its velocity [m/s]; setting it moves the wall with that velocity from now on."""
        velocity: NDArray[np.float64] = self._now("velocity")
        return velocity

    @velocity.setter
    def velocity(self, velocity: ArrayLike) -> None:
        self.move("velocity", velocity=velocity)

    @property
    def present(self) -> bool:
        """Whether it is there; a wall can be taken away and put back."""
        return bool(self._now("present"))

    @present.setter
    def present(self, present: bool) -> None:
        self._session.set_wall_present(self._index, bool(present))

    def move(self, motion: str, /, **parameters: ArrayLike) -> None:
        """Moves the wall in another way from now on.

        Parameters
        ----------
        motion : str
            ``fixed``, ``velocity``, ``cosine``, ``servo`` or ``rotation``.
        **parameters
            Those of the motion by their keys in a scenario, in SI units.

        Raises
        ------
        InputError
            There is no such motion, it has other parameters, or a wall of this shape cannot have it.

        Examples
        --------
        >>> lid.move("servo", pressure=1e3, mass=1e-3)  # doctest: +SKIP
        """
        given: list[tuple[str, float | list[float]]] = []
        for key, value in parameters.items():
            try:
                array = np.asarray(value, dtype=np.float64)
            except (TypeError, ValueError):
                raise InputError(f"{key}: expected numbers in SI units, found {value!r}", key=key) from None
            if array.shape not in ((), (3,)):
                text = f"{key}: expected a number or three components, found an array of shape {array.shape}"
                raise InputError(text, key=key)
            given.append((key, float(array) if array.ndim == 0 else [float(c) for c in array]))
        self._session.set_wall_motion(self._index, motion, given)

    def __repr__(self) -> str:
        return f"<wall {self.name}: {self.motion}, force {self.force.tolist()} N>"
