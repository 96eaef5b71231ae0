"""Forces that a program applies to particles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError
from .particles import Particles

__all__ = ["forces_on_all", "forces_on_some"]


def forces_on_all(particles: Particles, forces: ArrayLike) -> NDArray[np.float64]:
    """A vector for each particle."""
    array = _numbers(forces)
    expected = (len(particles), 3)
    if array.shape != expected:
        text = (
            f"forces: found an array of shape {array.shape}, expected {expected}: a vector for each particle that is there "
            "now, in the order of `particles.id`; with `ids=` for some of them"
        )
        raise InputError(text, key="forces")
    return array


def forces_on_some(particles: Particles, forces: ArrayLike, ids: ArrayLike) -> NDArray[np.float64]:
    """A vector for each particle: new for those with these ids, as before for all others."""
    wanted, known = np.atleast_1d(np.asarray(ids)), particles["id"]
    if wanted.ndim != 1 or not (wanted.size == 0 or np.issubdtype(wanted.dtype, np.integer)):
        raise InputError("ids: expected a list of whole numbers", key="ids")
    missing = np.setdiff1d(wanted, known)
    if len(missing) > 0:
        text = f"ids: there is no particle {missing[0]} now; `particles.id` lists those that are there"
        raise InputError(text, key="ids")
    if len(np.unique(wanted)) < len(wanted):
        raise InputError("ids: one stands there twice; give each once", key="ids")
    array = _numbers(forces)
    if array.shape not in ((3,), (len(wanted), 3)):
        text = f"forces: found an array of shape {array.shape}, expected {(len(wanted), 3)}, a vector for each of the ids"
        raise InputError(text, key="forces")
    applied: NDArray[np.float64] = particles["applied_force"]
    applied[np.searchsorted(known, wanted)] = array
    return applied


def _numbers(forces: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.ascontiguousarray(forces, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError("forces: expected an array of numbers [N]", key="forces") from None
