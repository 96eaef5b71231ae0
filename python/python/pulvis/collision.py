"""Pair collisions, many at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native, _toml
from ._columns import Columns, from_native
from .errors import InputError, checked_threads
from .laws import Contact, Law, as_contact

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Collisions", "collide"]

#: A number in SI, a text with its unit, an array of numbers to be swept, or a tuple of one value for each body.
Value = Union[float, str, ArrayLike, tuple[Any, ...]]


class Collisions(Columns):
    """Results of :func:`pulvis.collide`: the columns of ``pulvis collide``, and those of all arrays that were swept.

    Attributes
    ----------
    trajectories : list of Columns
        The course of each collision, in the order of the flattened arrays, if it was recorded.
    """

    def __init__(
        self, columns: dict[str, NDArray[Any]], swept: list[str], trajectories: list[Columns]
    ) -> None:
        super().__init__(columns)
        self.swept = swept
        self.trajectories = trajectories

    def plot(self, y: str = "restitution", x: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws a column over another one with matplotlib.

        Parameters
        ----------
        y, x : str
            Names of columns; `x` is the first one that was swept, or the velocity.
        ax : matplotlib Axes, optional
            Where to draw; a new figure if it is left out.

        Returns
        -------
        matplotlib Axes
        """
        import matplotlib.pyplot as plt

        axes: Axes = plt.gca() if ax is None else ax
        x = x or next(iter(self.swept), "velocity")
        # Of two axes, the second one gives a curve for each of its elements.
        axes.plot(self[x], self[y], ".-")
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        return axes


def collide(
    contact: Law | Contact,
    *,
    radius: Value,
    density: Value | None = None,
    mass: Value | None = None,
    velocity: Value | None = None,
    normal_velocity: Value | None = None,
    chi: Value | None = None,
    zeta: Value | None = None,
    bodies: str = "pair",
    angle: Value | None = None,
    spin_i: Value | None = None,
    spin_j: Value | None = None,
    method: str | None = None,
    steps_per_contact: Value | None = None,
    time_after_sticking: float | str | None = None,
    temperature: Any = None,
    record: bool = False,
    threads: int | None = None,
    **quantities: Value,
) -> Collisions:
    """Collides two spheres, or a sphere and a plane.

    Every number, and every parameter of the laws, may be an array: arrays are broadcast against each other as numpy does
    it, and the results have their common shape. A *tuple* is no array but one value for each of the two bodies, or a
    vector. All processors compute, without the interpreter lock; results do not depend on their number.

    Parameters
    ----------
    contact : Law or Contact
        The laws.
    radius : m
        Of both spheres, or a tuple of two.
    density, mass : kg/m^3, kg
        One of the two.
    velocity, normal_velocity, chi, zeta : m/s, m/s, 1, 1
        One of the four: relative speed outside the range of all forces; its part along the line of centres; the speed of
        touch over that which reaches the plastic limit, without and with the attraction.
    bodies : {"pair", "wall"}
        Two spheres, or one and a plane.
    angle : rad
        Between the relative velocity and the line of centres.
    spin_i, spin_j : rad/s
        Angular velocities across the plane of motion, or tuples of three components.
    method : {"exact", "engine"}
        Integrated to round-off, or with steps of one length as the engine does it; oblique collisions by the engine.
    steps_per_contact : 1
        Steps of the engine in the shortest contact time.
    time_after_sticking : s
        How long a pair that stuck is followed, where the course is recorded.
    temperature : K
        For laws that read it.
    record : bool
        Whether the course of every collision is kept.
    threads : int, optional
        All processors if it is left out.
    **quantities
        Quantities of particles that laws read, such as ``charge``.

    Returns
    -------
    Collisions

    Raises
    ------
    InputError
        Something that was given is wrong; `key` names it, and the text the element of an array.
    RunError
        A collision does not end, or leaves the range of numbers.

    Examples
    --------
    >>> import numpy as np, pulvis
    >>> luding = pulvis.law("luding", k1=100, kp=500, kc=100, phi_f=0.05)
    >>> hits = pulvis.collide(luding, radius=1.1e-3, density=2000.0, velocity=np.array([0.1, 0.18, 0.73]))
    >>> hits.restitution.round(3)
    array([0.431, 0.   , 0.888])
    >>> hits.regime
    array(['rebound', 'stick', 'rebound'], dtype='<U7')
    """
    given: dict[str, Any] = {
        "bodies": bodies,
        "radius": radius,
        "density": density,
        "mass": mass,
        "velocity": velocity,
        "normal_velocity": normal_velocity,
        "chi": chi,
        "zeta": zeta,
        "angle": angle,
        "spin_i": spin_i,
        "spin_j": spin_j,
        "method": method,
        "steps_per_contact": steps_per_contact,
        "time_after_sticking": time_after_sticking,
        **quantities,
    }
    arrays: dict[str, NDArray[np.float64]] = {}
    scenario = {
        "temperature": temperature,
        "collision": _without_arrays(given, "collision", arrays),
        "contact": {
            role: _without_arrays(table, f"contact.{role}", arrays)
            for role, table in as_contact(contact).tables().items()
        },
    }
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{path} {array.shape}" for path, array in arrays.items())
        raise InputError(f"arrays of these shapes cannot be broadcast against each other: {shapes}") from None
    full = {path: np.broadcast_to(array, shape) for path, array in arrays.items()}
    size = int(np.prod(shape, dtype=int))
    if size == 0:
        raise InputError("an array is empty: there is nothing to collide")
    values = np.empty((len(full), size))
    for row, array in zip(values, full.values()):
        row[:] = array.ravel()
    native, courses = _native.collide(_toml.dumps(scenario), list(full), values, record, checked_threads(threads))
    columns = {name: column.reshape(shape) for name, column in from_native(native).items()}
    swept = []
    for path, array in full.items():
        # A speed and an angle are columns already; whatever else was swept stands by its key.
        name = path.removeprefix("collision.")
        swept.append(name)
        columns.setdefault(name, array.copy())
    return Collisions(columns, swept, [Columns(from_native(course)) for course in courses])


def _without_arrays(
    table: dict[str, Any], path: str, arrays: dict[str, NDArray[np.float64]]
) -> dict[str, Any]:
    """The table with the first element in the place of each array; the arrays by their dotted paths."""

    def single(value: Any, path: str) -> Any:
        if isinstance(value, tuple):
            return [single(item, f"{path}[{index}]") for index, item in enumerate(value)]
        if value is None or isinstance(value, str) or np.ndim(value) == 0:
            return value
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            key = path.removeprefix("collision.")
            raise InputError(f"{key}: expected an array of numbers in SI units", key=key) from None
        arrays[path] = array
        return float(array.flat[0]) if array.size else 1.0

    return {key: single(value, f"{path}.{key}") for key, value in table.items()}
