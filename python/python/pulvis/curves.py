"""The law `tabulated` from arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .errors import InputError
from .laws import Law, law

__all__ = ["tabulated"]

#: The largest number of points of a curve of the law `tabulated`.
_MOST_POINTS = 100


def tabulated(
    overlap: ArrayLike,
    force: ArrayLike,
    unloading_overlap: ArrayLike | None = None,
    unloading_force: ArrayLike | None = None,
    *,
    reference_radius: float | str | None = None,
) -> Law:
    """The law ``tabulated`` from arrays of any length, as a measurement or a finite element computation gives them.

    Curves of more than 100 points are thinned out: 100 points in equal steps of the overlap, straight in between.

    Parameters
    ----------
    overlap, force : m, N
        The loading curve, growing from (0, 0) on.
    unloading_overlap, unloading_force : m, N, optional
        An unloading curve in the order of growing overlaps, from the force 0 on; without it the contact is elastic.
    reference_radius : m, optional
        Effective radius of the bodies of the curves; contacts of other bodies are then geometrically similar.

    Returns
    -------
    Law

    Raises
    ------
    InputError
        A curve does not grow, or unloading is softer than loading, so that a closed path would create energy.

    Examples
    --------
    >>> import numpy as np, pulvis
    >>> overlap = np.linspace(0, 10e-6, 1000)
    >>> law = pulvis.tabulated(overlap, 100 * overlap, overlap, 400 * overlap)
    >>> hit = pulvis.collide(law, radius=1e-3, density=2000.0, velocity=0.1)
    >>> round(float(hit.restitution), 6)  # sqrt(100/400)
    0.5
    """

    def curve(name: str, x: ArrayLike, y: ArrayLike) -> tuple[list[float], list[float]]:
        try:
            xs, ys = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError(f"{name}: expected arrays of numbers in SI units", key=f"{name}_overlap") from None
        if xs.ndim != 1 or xs.shape != ys.shape:
            text = f"{name}: found arrays of the shapes {xs.shape} and {ys.shape}, expected a force for each overlap"
            raise InputError(text, key=f"{name}_force")
        if len(xs) > _MOST_POINTS and np.all(np.diff(xs) > 0):
            thinned = np.linspace(xs[0], xs[-1], _MOST_POINTS)
            xs, ys = thinned, np.interp(thinned, xs, ys)
        return xs.tolist(), ys.tolist()

    load_overlap, load_force = curve("loading", overlap, force)
    parameters: dict[str, Any] = {"loading_overlap": load_overlap, "loading_force": load_force}
    if unloading_overlap is not None and unloading_force is not None:
        unload_overlap, unload_force = curve("unloading", unloading_overlap, unloading_force)
        parameters |= {"unloading_overlap": unload_overlap, "unloading_force": unload_force}
    elif unloading_overlap is not None or unloading_force is not None:
        raise InputError("an unloading curve is overlaps and forces: one of the two is missing", key="unloading_force")
    if reference_radius is not None:
        parameters["reference_radius"] = reference_radius
    return law("tabulated", **parameters)
