"""Normal laws written in Python: to try an idea before it becomes a law of the catalogue."""

from __future__ import annotations

import copy
import math
import sys
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._columns import Columns
from .collision import Collisions
from .curves import tabulated
from .errors import InputError, RunError
from .laws import Law
from .probing import ProbeCurve

__all__ = ["PythonLaw"]

#: A force from overlap [m], closing rate [m/s] and the memory of the contact.
Force = Callable[[float, float, dict[str, Any]], float]

#: Contact times after which a collision is given up.
_LONGEST = 100


class PythonLaw:
    """A force along the line of centres as a function of Python.

    It is called once a step, which costs about a microsecond beside what the function does: some milliseconds for a
    collision, a hundred times as much as a law of the catalogue by the method of the engine. It cannot be used in a
    :class:`pulvis.Simulation`.

    Parameters
    ----------
    force : callable
        ``force(overlap, rate, memory)``: the force [N], repulsion positive, at an overlap [m] that closes with a rate [m/s].
        `memory` is the dictionary of the contact, which the function may change; it is called once for each step, in the
        order of time, and only while the overlap is positive.
    memory : dict, optional
        What a contact remembers before its first touch.

    Examples
    --------
    >>> import pulvis
    >>> def walton_braun(overlap, rate, memory, k1=100.0, k2=400.0):
    ...     memory["deepest"] = max(memory["deepest"], overlap)
    ...     rest = (1 - k1 / k2) * memory["deepest"]
    ...     return min(k1 * overlap, max(k2 * (overlap - rest), 0.0))
    >>> law = pulvis.PythonLaw(walton_braun, {"deepest": 0.0})
    >>> hits = law.collide(radius=1e-3, density=2000, velocity=0.1, contact_time=6e-4)
    >>> round(float(hits.restitution), 3)  # sqrt(k1/k2), Walton & Braun 1986
    0.5
    """

    def __init__(self, force: Force, memory: dict[str, Any] | None = None) -> None:
        if not callable(force):
            raise InputError(f"expected a function of overlap, rate and memory, found {type(force).__name__}")
        self.force = force
        self.memory = dict(memory or {})

    def _ask(self, overlap: float, rate: float, memory: dict[str, Any]) -> float:
        force = float(self.force(overlap, rate, memory)) if overlap > 0 else 0.0
        if not math.isfinite(force):
            raise RunError(f"the force is {force} N at an overlap of {overlap} m and a rate of {rate} m/s")
        return force

    def probe(
        self, *, overlap: ArrayLike | Sequence[float], points: int = 200, speed: float = 0.0
    ) -> ProbeCurve:
        """Leads the contact along a path of overlaps, straight between its turning points.

        Parameters
        ----------
        overlap : m
            The overlap at each turning point, from 0 or below on.
        points : int
            Steps between two turning points.
        speed : m/s
            How fast the overlap changes; the function sees a rate of 0 if it is left out.

        Returns
        -------
        ProbeCurve
            With the columns ``overlap``, ``force`` and ``work`` (by the trapezoidal rule).
        """
        turns = np.asarray(overlap, dtype=float)
        if turns.ndim != 1 or len(turns) < 2 or not np.all(np.isfinite(turns)) or turns[0] > 0:
            raise InputError("overlap: expected two or more turning points [m], the first at 0 or below", key="overlap")
        if points < 1:
            raise InputError(f"points: {points} steps lead nowhere", key="points")
        legs = [np.linspace(a, b, points + 1)[1:] for a, b in zip(turns, turns[1:])]
        path = np.concatenate([turns[:1], *legs])
        memory = copy.deepcopy(self.memory)
        rates = np.append(0.0, np.sign(np.diff(path)) * speed)
        force = np.array([self._ask(d, v, memory) for d, v in zip(path.tolist(), rates.tolist())])
        work = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(path)))
        return ProbeCurve({"overlap": path, "force": force, "work": work})

    def to_tabulated(self, overlap_max: float, points: int = 100) -> Law:
        """The law ``tabulated`` with the curves of this function, which runs at full speed in beds.

        The contact is pressed to `overlap_max` and unloaded, infinitely slowly. Only what these two curves say is kept: it is
        a good copy of a law without rate and attraction whose unloading curve depends on the load as that of
        :func:`pulvis.tabulated` does. Compare the two by :meth:`probe` before you trust it.

        Parameters
        ----------
        overlap_max : m
            How deep the contacts will be pressed.
        points : int
            Points of each curve, 100 at the most.

        Returns
        -------
        Law

        Raises
        ------
        InputError
            The function pulls, does not grow while it is loaded, or unloads more softly than it loads.
        """
        if not (math.isfinite(overlap_max) and overlap_max > 0):
            raise InputError(f"overlap_max: {overlap_max} is out of range; expected a number greater than 0")
        curve = self.probe(overlap=[0.0, overlap_max, 0.0], points=max(points - 1, 1))
        turn = int(np.argmax(curve.overlap))
        load, unload = slice(0, turn + 1), slice(len(curve.overlap) - 1, turn - 1, -1)
        overlap, force = curve.overlap[unload], curve.force[unload]
        if np.any(force < 0):
            raise InputError("the function pulls; a tabulated law only pushes, attractions have a role of their own")
        # The residual overlap lies between the last point without a force and the first one with one.
        pressed = np.flatnonzero(force > 0)
        if len(pressed) < 2:
            raise InputError("the function gives no force while it is unloaded")
        first, second = pressed[:2]
        slope = (force[second] - force[first]) / (overlap[second] - overlap[first])
        residual = max(overlap[first] - force[first] / slope, 0.0) if slope > 0 else 0.0
        if first > 0:
            residual = max(residual, float(overlap[first - 1]))
        overlap, force = np.append(residual, overlap[first:]), np.append(0.0, force[first:])
        return tabulated(curve.overlap[load], curve.force[load], overlap, force)

    def collide(
        self,
        *,
        radius: float,
        velocity: ArrayLike,
        contact_time: float,
        density: float | None = None,
        mass: float | None = None,
        bodies: str = "pair",
        steps_per_contact: int = 2000,
        record: bool = False,
    ) -> Collisions:
        """Collides two equal spheres, or a sphere and a plane, head on.

        The motion is integrated by synchronised velocity Verlet steps of ``contact_time / steps_per_contact``; errors fall
        with the square of the step, with the step itself where the force jumps. The rate that the function sees is that of
        the middle of the step.

        Parameters
        ----------
        radius : m
        velocity : m/s
            Relative speeds; an array computes one collision for each.
        contact_time : s
            About how long a contact lasts, which sets the step.
        density, mass : kg/m^3, kg
            One of the two.
        bodies : {"pair", "wall"}
        steps_per_contact : int
        record : bool
            Whether the courses are kept in ``trajectories``.

        Returns
        -------
        Collisions
            With the columns ``velocity``, ``restitution``, ``overlap_max``, ``regime``, ``contact_duration`` and
            ``energy_dissipated``.

        Raises
        ------
        RunError
            The function gives no finite number, or a collision does not end.
        """
        if (density is None) == (mass is None):
            raise InputError("either `density` or `mass` is needed", key="density")
        if bodies not in ("pair", "wall"):
            raise InputError(f"bodies: found {bodies!r}, expected 'pair' or 'wall'", key="bodies")
        whole = mass if mass is not None else (density or 0.0) * 4 / 3 * math.pi * radius**3
        speeds = np.asarray(velocity, dtype=float)
        for name, value in (("radius", radius), ("contact_time", contact_time), ("mass", whole)):
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"{name}: {value} is out of range; expected a number greater than 0", key=name)
        if not np.all(np.isfinite(speeds) & (speeds > 0)):
            raise InputError("velocity: expected velocities [m/s] greater than 0", key="velocity")
        if steps_per_contact < 1:
            raise InputError(f"steps_per_contact: {steps_per_contact} is less than 1", key="steps_per_contact")
        reduced = whole / 2 if bodies == "pair" else whole
        step = contact_time / steps_per_contact
        results, courses = [], []
        for speed in speeds.ravel().tolist():
            course: list[tuple[float, float, float, float]] | None = [] if record else None
            results.append(self._collide(speed, reduced, step, _LONGEST * steps_per_contact, course))
            if course is not None:
                rows = np.array(course).T
                courses.append(Columns(dict(zip(("time", "overlap", "velocity", "force"), rows))))
        names = ("restitution", "overlap_max", "contact_duration", "energy_dissipated")
        table = np.array(results).T.reshape(len(names), *speeds.shape)
        columns: dict[str, NDArray[Any]] = {"velocity": speeds.copy(), **dict(zip(names, table))}
        columns["regime"] = np.where(columns["restitution"] > 0, "rebound", "stick")
        return Collisions(columns, ["velocity"], courses)

    def _collide(
        self,
        speed: float,
        mass: float,
        step: float,
        most_steps: int,
        course: list[tuple[float, float, float, float]] | None,
    ) -> tuple[float, float, float, float]:
        """Restitution, largest overlap, duration and lost energy of one collision."""
        memory = copy.deepcopy(self.memory)
        overlap, rate, deepest = 0.0, speed, 0.0
        # A dashpot acts from the first touch on.
        force = self._ask(sys.float_info.min, speed, memory)
        energy = 0.5 * mass * speed**2
        for number in range(1, most_steps + 1):
            middle = rate - 0.5 * step * force / mass
            before, overlap = overlap, overlap + step * middle
            if overlap <= 0:
                # It opens within the step, under the force at its start.
                part = before / (before - overlap)
                rate -= part * step * force / mass
                if course is not None:
                    course.append(((number - 1 + part) * step, 0.0, rate, 0.0))
                return -rate / speed, deepest, (number - 1 + part) * step, energy - 0.5 * mass * rate**2
            force = self._ask(overlap, middle, memory)
            outward, rate = rate < 0, middle - 0.5 * step * force / mass
            deepest = max(deepest, overlap)
            if course is not None:
                course.append((number * step, overlap, rate, force))
            if outward and rate >= 0:
                # It came to a stop on the way out.
                return 0.0, deepest, math.nan, math.nan
        raise RunError(
            f"the collision at {speed} m/s is not over after {most_steps} steps ({most_steps * step:.3e} s); "
            "is `contact_time` right?"
        )
