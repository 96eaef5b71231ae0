"""Laws written in Python, against those of the catalogue and closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import pulvis

BODIES = {"radius": 1.1e-3, "density": 2000.0}
MASS = 4 / 3 * math.pi * 1.1e-3**3 * 2000.0


def own_luding(overlap: float, rate: float, memory: dict[str, Any]) -> float:
    """Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. (5)-(10), below the plastic limit."""
    k1, kp, kc, phi_f = 100.0, 500.0, 100.0, 0.05
    limit = kp / (kp - k1) * phi_f * BODIES["radius"]
    deepest = memory["deepest"] = max(memory["deepest"], overlap)
    assert deepest < limit
    k2 = k1 + (kp - k1) * deepest / limit
    elastic = k2 * (overlap - (1 - k1 / k2) * deepest)
    if elastic < -kc * overlap:
        # On the tensile limit the largest overlap shrinks, so that the k2 line goes through the point.
        memory["deepest"] = _deepest_through(overlap, -kc * overlap, k1, (kp - k1) / limit)
        return -kc * overlap
    return elastic


def _deepest_through(overlap: float, force: float, k1: float, slope: float) -> float:
    """The largest overlap D whose line f = k2 (overlap - D) + k1 D, k2 = k1 + slope D, goes through a point."""
    # slope D^2 - slope overlap D + force - k1 overlap = 0
    half = 0.5 * overlap
    return half + math.sqrt(half * half - (force - k1 * overlap) / slope)


def test_a_law_of_the_catalogue_written_again_collides_as_that_does() -> None:
    speed = np.array([0.05, 0.1, 0.2, 0.25])
    own = pulvis.PythonLaw(own_luding, {"deepest": 0.0}).collide(**BODIES, velocity=speed, contact_time=8e-4)
    catalogue = pulvis.law("luding", k1=100, kp=500, kc=100, phi_f=0.05)
    expected = pulvis.collide(catalogue, **BODIES, velocity=speed)
    # Two thousand steps in a contact; the branches are met to a step.
    np.testing.assert_allclose(own.restitution, expected.restitution, atol=2e-3)
    np.testing.assert_allclose(own.overlap_max, expected.overlap_max, rtol=1e-5)
    assert own.regime.tolist() == expected.regime.tolist()


def test_a_damped_spring_rebounds_as_the_oscillator_does() -> None:
    law = pulvis.PythonLaw(lambda overlap, rate, memory: 1e3 * overlap + 0.02 * rate)
    hits = law.collide(**BODIES, bodies="wall", velocity=1.0, contact_time=5e-4, record=True)
    damping = 0.02 / (2 * MASS)
    frequency = math.sqrt(1e3 / MASS - damping**2)
    assert hits.restitution == pytest.approx(math.exp(-math.pi * damping / frequency), rel=1e-4)
    # A step is 7e-4 of it.
    assert hits.contact_duration == pytest.approx(math.pi / frequency, rel=2e-4)
    lost = 0.5 * MASS * (1 - hits.restitution**2)
    assert hits.energy_dissipated == pytest.approx(lost, rel=1e-9)
    assert hits.trajectories[0].overlap.max() == hits.overlap_max


def test_a_probe_gives_what_the_function_says() -> None:
    curve = pulvis.PythonLaw(own_luding, {"deepest": 0.0}).probe(overlap=[0, 2e-5, 1e-6, 1.5e-5], points=100)
    expected = pulvis.law("luding", k1=100, kp=500, kc=100, phi_f=0.05).probe(
        **BODIES, overlap=[0, 2e-5, 1e-6, 1.5e-5], points=100
    )
    np.testing.assert_allclose(curve.force, expected.force, atol=1e-12 * curve.force.max())
    np.testing.assert_allclose(curve.work, expected.work, rtol=1e-9, atol=1e-20)


def test_each_contact_begins_with_a_memory_of_its_own() -> None:
    law = pulvis.PythonLaw(own_luding, {"deepest": 0.0})
    one = law.collide(**BODIES, velocity=0.1, contact_time=8e-4, steps_per_contact=200)
    both = law.collide(**BODIES, velocity=[0.25, 0.1], contact_time=8e-4, steps_per_contact=200)
    assert both.restitution[1] == one.restitution and law.memory == {"deepest": 0.0}


def test_what_cannot_be_is_refused() -> None:
    law = pulvis.PythonLaw(lambda overlap, rate, memory: math.nan)
    with pytest.raises(pulvis.RunError, match="the force is nan N"):
        law.collide(**BODIES, velocity=0.1, contact_time=1e-4)
    spring = pulvis.PythonLaw(lambda overlap, rate, memory: overlap)
    with pytest.raises(pulvis.RunError, match="not over after"):
        spring.collide(**BODIES, velocity=0.1, contact_time=1e-5, steps_per_contact=10)
    with pytest.raises(pulvis.InputError, match="greater than 0"):
        spring.collide(**BODIES, velocity=[0.1, -1.0], contact_time=1e-4)
    with pytest.raises(pulvis.InputError, match="either `density` or `mass`"):
        spring.collide(radius=1e-3, velocity=0.1, contact_time=1e-4)
    with pytest.raises(pulvis.InputError, match="the first at 0 or below"):
        spring.probe(overlap=[1e-6, 0])
