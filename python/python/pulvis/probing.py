"""One contact on a prescribed path: what an indenter does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Union

from numpy.typing import ArrayLike

from . import _native, _toml
from ._columns import Columns, from_native
from .laws import Contact, Law, as_contact

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["ProbeCurve", "probe"]

#: Turning points: numbers in SI or texts with units.
Path = Union[ArrayLike, Sequence[str]]


class ProbeCurve(Columns):
    """Results of :func:`pulvis.probe`: the columns of ``pulvis probe``, one element an instant."""

    def plot(self, y: str = "force", x: str = "overlap", ax: Axes | None = None, **style: Any) -> Axes:
        """Draws a column over another one with matplotlib; `style` goes to its ``plot``.

        Returns
        -------
        matplotlib Axes
        """
        import matplotlib.pyplot as plt

        axes: Axes = plt.gca() if ax is None else ax
        axes.plot(self[x], self[y], **style)
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        return axes


def probe(
    contact: Law | Contact,
    *,
    radius: Any,
    overlap: Path,
    density: Any = None,
    mass: Any = None,
    bodies: str = "pair",
    shear: Path | None = None,
    roll: Path | None = None,
    twist: Path | None = None,
    points: int | None = None,
    speed: float | str | None = None,
    durations: Path | None = None,
    temperature: Any = None,
    **quantities: Any,
) -> ProbeCurve:
    """Leads a contact along a path of overlap, shear, roll and twist.

    Parameters
    ----------
    contact : Law or Contact
        The laws.
    radius : m
        Of both spheres, or a tuple of two.
    overlap : m
        The overlap at each turning point, in between the path is straight; it begins at 0 or below.
    density, mass : kg/m^3, kg
        One of the two.
    bodies : {"pair", "wall"}
    shear, roll, twist : m
        Displacements along the surface, and arcs of rolling and twisting, at each turning point.
    points : int
        Steps between two turning points (200); 1 if `overlap` holds the whole path.
    speed : m/s
        How fast the overlap changes; infinitely slowly if it is left out.
    durations : s
        How long each leg takes, in the place of `speed`.
    temperature : K
        For laws that read it.
    **quantities
        Quantities of particles that laws read.

    Returns
    -------
    ProbeCurve

    Raises
    ------
    InputError
        Something that was given is wrong; `key` names it.

    Examples
    --------
    >>> import pulvis
    >>> luding = pulvis.law("luding", k1=100, kp=500, kc=100, phi_f=0.05)
    >>> curve = luding.probe(radius=1e-3, density=2000, overlap=[0, 1e-5, -1e-6], points=2)
    >>> curve.branch.tolist()
    ['none', 'k1', 'k1', 'k2', 'none']
    >>> curve.force.round(7).tolist()
    [0.0, 0.0005, 0.001, 9.8e-05, -0.0]
    """
    table = {
        "bodies": bodies,
        "radius": radius,
        "density": density,
        "mass": mass,
        "overlap": overlap,
        "shear": shear,
        "roll": roll,
        "twist": twist,
        "points": points,
        "speed": speed,
        "durations": durations,
        **quantities,
    }
    scenario = {"temperature": temperature, "probe": table, "contact": as_contact(contact).tables()}
    [(_, columns)] = _native.probe(_toml.dumps(scenario))
    return ProbeCurve(from_native(columns))
