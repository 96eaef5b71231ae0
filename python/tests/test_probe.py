"""One contact on a prescribed path."""

from __future__ import annotations

import math

import numpy as np
import pytest

import pulvis

BODIES = {"radius": 1e-3, "density": 2000.0}


def test_hertz_spheres_are_pressed_as_hertz_has_it() -> None:
    curve = pulvis.law("hertz", effective_modulus="2 GPa").probe(**BODIES, overlap=[0, 1e-5])
    expected = 4 / 3 * 2e9 * math.sqrt(0.5e-3) * curve.overlap**1.5
    np.testing.assert_allclose(curve.force, expected, rtol=1e-13)
    np.testing.assert_allclose(curve.contact_radius, np.sqrt(0.5e-3 * curve.overlap), rtol=1e-13)


def test_jkr_pulls_off_at_one_and_a_half_pi() -> None:
    work, radius = 0.1, 0.5e-6
    law = pulvis.law("jkr", effective_modulus=1e9, work_of_adhesion=work)
    curve = law.probe(radius=1e-6, density=2000, overlap=[0, 2e-8, -2e-8], points=20000)
    # Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 301 (1971), eq. (21); the grid finds the extremum to its square.
    assert curve.force.min() == pytest.approx(-1.5 * math.pi * work * radius, rel=1e-6)


def test_work_is_stored_or_dissipated(luding: pulvis.Law) -> None:
    curve = luding.probe(**BODIES, overlap=[0, 5e-5, -1e-6, 3e-5, -1e-6], points=1000)
    scale = curve.work.max()
    # Steps that pass a corner of the law are off by the square of their length.
    np.testing.assert_allclose(curve.work, curve.stored_energy + curve.dissipated, atol=1e-5 * scale)
    assert np.all(np.diff(curve.dissipated) >= -1e-12 * scale)


def test_a_path_may_be_given_point_by_point(luding: pulvis.Law) -> None:
    dense = np.linspace(0, 2e-5, 51)
    by_points = luding.probe(**BODIES, overlap=dense, points=1)
    by_legs = luding.probe(**BODIES, overlap=[0, 2e-5], points=50)
    np.testing.assert_allclose(by_points.force, by_legs.force, rtol=1e-12)


def test_mistakes_are_named(luding: pulvis.Law) -> None:
    with pytest.raises(pulvis.InputError, match="the path begins at an overlap") as refused:
        luding.probe(**BODIES, overlap=[1e-6, 0])
    assert refused.value.key == "probe.overlap[0]"
    damped = pulvis.contact(luding, pulvis.law("constant", gamma_0=1e-3))
    with pytest.raises(pulvis.InputError, match="depend on the rate"):
        damped.probe(**BODIES, overlap=[0, 1e-6])
    assert damped.probe(**BODIES, overlap=[0, 1e-6], speed="1 mm/s").force[1] > 0
