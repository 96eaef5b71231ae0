"""Laws of which curves are given, against those of the catalogue and areas under the curves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import pulvis

BODIES = {"radius": 1.1e-3, "density": 2000.0}
MASS = 4 / 3 * math.pi * 1.1e-3**3 * 2000.0 / 2


def test_straight_curves_are_the_spring_of_walton_and_braun() -> None:
    overlap = np.linspace(0, 1e-4, 3)
    own = pulvis.tabulated(overlap, 100 * overlap, overlap, 400 * overlap)
    other = pulvis.law("walton-braun", k1=100, k2=400)
    path = [0, 3e-5, 2.3e-5, 2.9e-5, 4e-5, 0, 1e-5, -1e-6]
    found, expected = (law.probe(**BODIES, overlap=path, points=50) for law in (own, other))
    for name in ("force", "stored_energy", "dissipated"):
        # Both are straight lines: round-off.
        np.testing.assert_allclose(found[name], expected[name], atol=1e-12 * np.abs(expected[name]).max())


def test_restitution_is_the_root_of_the_ratio_of_areas() -> None:
    load_overlap, load_force = np.array([0, 1e-5, 2e-5, 4e-5]), np.array([0, 1e-3, 3e-3, 7e-3])
    unload_overlap, unload_force = np.array([3e-5, 3.3e-5, 4e-5]), np.array([0, 1.2e-3, 7e-3])
    law = pulvis.tabulated(load_overlap, load_force, unload_overlap, unload_force)
    work_in = np.sum(0.5 * np.diff(load_overlap) * (load_force[1:] + load_force[:-1]))
    work_out = np.sum(0.5 * np.diff(unload_overlap) * (unload_force[1:] + unload_force[:-1]))
    hit = pulvis.collide(law, **BODIES, velocity=math.sqrt(2 * work_in / MASS))
    # Exact collisions are good to 1e-11.
    assert float(hit.overlap_max) == pytest.approx(4e-5, rel=1e-10)
    assert float(hit.restitution) == pytest.approx(math.sqrt(work_out / work_in), rel=1e-10)


def test_bodies_of_another_size_are_similar_where_a_radius_is_given() -> None:
    overlap = np.linspace(0, 5e-5, 200)
    force = 4 / 3 * 1e9 * math.sqrt(0.55e-3) * overlap**1.5
    law = pulvis.tabulated(overlap, force, reference_radius=0.55e-3)
    hertz = pulvis.law("hertz", effective_modulus=1e9)
    for radius in (1.1e-3, 4.4e-3):
        path = [0, 0.02 * radius]
        found, expected = (one.probe(radius=radius, density=2000, overlap=path, points=40) for one in (law, hertz))
        # A hundred chords of the curve over its range; the least overlaps are worst.
        np.testing.assert_allclose(found.force, expected.force, atol=2e-4 * expected.force.max())


def test_curves_that_create_energy_or_do_not_grow_are_refused() -> None:
    overlap = np.linspace(0, 1e-5, 5)
    with pytest.raises(pulvis.InputError, match="creates energy on a closed path") as refused:
        pulvis.tabulated(overlap, 100 * overlap, overlap, 90 * overlap)
    assert refused.value.key == "unloading_overlap"
    with pytest.raises(pulvis.InputError, match="grow from point to point"):
        pulvis.tabulated(overlap, [0, 1, 2, 2, 3])
    with pytest.raises(pulvis.InputError, match="a force for each overlap"):
        pulvis.tabulated(overlap, overlap[1:])
    with pytest.raises(pulvis.InputError, match="one of the two is missing"):
        pulvis.tabulated(overlap, 100 * overlap, overlap)
    with pytest.raises(pulvis.InputError, match="as many as"):
        pulvis.law("tabulated", loading_overlap=[0, 1e-6], loading_force=["0 N", "1 mN", "2 mN"])


def test_other_parameters_are_swept_beside_curves() -> None:
    overlap = np.linspace(0, 1e-5, 5)
    law = pulvis.tabulated(overlap, 100 * overlap, overlap, 400 * overlap)
    contact = pulvis.contact(law, viscosity=pulvis.law("constant", gamma_0=np.array([0.0, 1e-3])))
    hits = pulvis.collide(contact, **BODIES, velocity=[[0.1], [0.2]])
    assert hits.restitution.shape == (2, 2) and np.all(hits.restitution[:, 1] < 0.5)
    np.testing.assert_allclose(hits.restitution[:, 0], 0.5, rtol=1e-10)


def test_a_function_of_python_becomes_a_law_of_beds(gas: dict[str, Any]) -> None:
    def walton_braun(overlap: float, rate: float, memory: dict[str, Any]) -> float:
        memory["deepest"] = max(memory["deepest"], overlap)
        return min(1000 * overlap, max(3000 * (overlap - 2 / 3 * memory["deepest"]), 0.0))

    law = pulvis.PythonLaw(walton_braun, {"deepest": 0.0}).to_tabulated(1e-4)
    hit = pulvis.collide(law, **BODIES, velocity=0.1)
    # The residual overlap is known to a point of the curve.
    assert float(hit.restitution) == pytest.approx(math.sqrt(1 / 3), rel=1e-2)
    gas["contacts"]["glass-glass"] = {"normal": law.table()}
    one, other = pulvis.Simulation(gas, threads=1), pulvis.Simulation(gas, threads=2)
    one.run(), other.run()
    assert np.array_equal(one.particles.position, other.particles.position)
    ledger = one.ledger
    assert ledger["dissipated_plastic"] > 0 and abs(ledger["relative_error"]) < 1e-3
