"""Collisions against closed forms that are written here once more."""

from __future__ import annotations

import _thread
import math
import threading
import time

import numpy as np
import pytest
from numpy.typing import NDArray

import pulvis

RADIUS, DENSITY = 1.1e-3, 2000.0
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY
BODIES = {"radius": RADIUS, "density": DENSITY}
VELOCITIES = np.geomspace(0.02, 20, 60)


def restitution_of_luding(k1: float, kp: float, kc: float, phi_f: float, mass: float, speed: float) -> float:
    """Work along the branches of Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. (5)-(10), for equal spheres."""
    incoming = 0.5 * mass * speed**2
    limit = kp / (kp - k1) * phi_f * RADIUS
    overlap = min(speed * math.sqrt(mass / k1), limit)
    k2 = k1 + (kp - k1) * overlap / limit
    force_free = (1 - k1 / k2) * overlap
    adhesive = k2 * force_free / (k2 + kc)
    lost_to_plasticity = 0.5 * k1 * overlap**2 - 0.5 * k2 * (overlap - force_free) ** 2
    lost_to_adhesion = 0.5 * k2 * (force_free - adhesive) ** 2 + 0.5 * kc * adhesive**2
    left = incoming - lost_to_plasticity - lost_to_adhesion
    return math.sqrt(left / incoming) if left > 0 else 0.0


def test_restitution_of_the_luding_law_is_what_its_branches_leave(luding: pulvis.Law) -> None:
    hits = pulvis.collide(luding, **BODIES, velocity=VELOCITIES)
    expected = [restitution_of_luding(100, 500, 100, 0.05, MASS / 2, v) for v in VELOCITIES]
    # Exact collisions are good to 1e-12; near sticking the root of what is left enlarges that.
    np.testing.assert_allclose(hits.restitution, expected, atol=1e-9)
    assert set(hits.regime) == {"rebound", "stick"}
    assert np.array_equal(hits.restitution == 0, hits.regime == "stick")
    assert np.max(np.abs(hits.energy_error)) < 1e-11


def test_a_wall_is_a_sphere_of_infinite_mass_and_radius() -> None:
    spring = pulvis.law("linear", k=1e3, gamma_0=0.02)
    hits = pulvis.collide(spring, **BODIES, bodies="wall", velocity=1.0)
    rate = 0.02 / (2 * MASS)
    frequency = math.sqrt(1e3 / MASS - rate**2)
    assert hits.restitution.shape == ()
    # The closed form of a damped oscillator, to the 1e-12 of exact collisions.
    assert float(hits.restitution) == pytest.approx(math.exp(-math.pi * rate / frequency), rel=1e-11)
    assert float(hits.contact_duration) == pytest.approx(math.pi / frequency, rel=1e-11)


def test_hertz_contacts_last_as_hertz_has_it() -> None:
    modulus = 1e9
    hits = pulvis.collide(pulvis.law("hertz", effective_modulus=modulus), **BODIES, velocity=VELOCITIES)
    stiffness = 4 / 3 * modulus * math.sqrt(RADIUS / 2)
    deepest = (5 * (MASS / 2) * VELOCITIES**2 / (4 * stiffness)) ** 0.4
    # Landau & Lifshitz, Theory of Elasticity, section 9: T = 2.9432... deepest/v, the integral of 2/sqrt(1 - x^(5/2)).
    duration = 4 * math.sqrt(math.pi) * math.gamma(0.4) / (5 * math.gamma(0.9)) * deepest / VELOCITIES
    np.testing.assert_allclose(hits.overlap_max, deepest, rtol=1e-10)
    np.testing.assert_allclose(hits.contact_duration, duration, rtol=1e-10)
    np.testing.assert_allclose(hits.restitution, 1.0, rtol=1e-10)


def test_bodies_that_slide_throughout_take_mu_times_the_normal_impulse() -> None:
    contact = pulvis.contact(pulvis.law("linear", k=1e8), pulvis.law("spring-slider", kt=3e7, mu=0.2))
    steep = np.radians([60.0, 70.0, 80.0])
    hits = pulvis.collide(contact, **BODIES, normal_velocity=0.1, angle=steep)
    # The bodies move on meanwhile, by 2e-4 of a diameter at most, and the line of centres turns with them.
    np.testing.assert_allclose(hits.impulse_ratio, 0.2, rtol=2e-3)
    assert np.max(np.abs(hits.angular_momentum_error)) < 1e-12


def test_arrays_are_broadcast_and_each_element_is_a_collision_of_its_own(luding: pulvis.Law) -> None:
    strength = np.array([1.0, 50.0, 100.0])
    speed = np.array([0.05, 0.3])[:, None]
    hits = pulvis.collide(luding.replace(kc=strength), **BODIES, velocity=speed)
    assert hits.restitution.shape == hits.kc.shape == (2, 3)
    for row, v in enumerate(speed[:, 0]):
        for column, kc in enumerate(strength):
            one = pulvis.collide(luding.replace(kc=kc), **BODIES, velocity=v)
            assert hits.restitution[row, column] == one.restitution
    expected = [[restitution_of_luding(100, 500, kc, 0.05, MASS / 2, v) for kc in strength] for v in speed[:, 0]]
    np.testing.assert_allclose(hits.restitution, expected, atol=1e-9)


def test_results_do_not_depend_on_the_number_of_threads(luding: pulvis.Law) -> None:
    def collide(threads: int) -> NDArray[np.float64]:
        return pulvis.collide(luding, **BODIES, velocity=VELOCITIES, threads=threads).restitution

    one = collide(1)
    for threads in (2, 5):
        assert np.array_equal(one, collide(threads))


def test_a_sweep_of_everything_has_the_bits_of_its_collisions_alone(luding: pulvis.Law) -> None:
    random = np.random.default_rng(5)
    count = 60
    swept = {
        "radius": random.uniform(0.5e-3, 2e-3, count),
        "density": random.uniform(1500, 3000, count),
        "velocity": random.uniform(0.02, 2, count),
    }
    # Few values of a parameter of the law, so that collisions with the same laws are side by side in the processor.
    strength = random.choice([50.0, 100.0, 150.0], count)
    together = pulvis.collide(luding.replace(kc=strength), **swept)
    for index in range(count):
        one = {name: values[index] for name, values in swept.items()}
        alone = pulvis.collide(luding.replace(kc=strength[index]), **one)
        for name in ("restitution", "overlap_max", "overlap_end", "contact_duration", "energy_dissipated", "energy_error"):
            assert np.array_equal(together[name][index], alone[name], equal_nan=True), (name, index)
        assert together.regime[index] == alone.regime and together.stop_branch[index] == alone.stop_branch


def test_other_ways_to_give_the_speed_are_swept_alike(luding: pulvis.Law) -> None:
    chi = np.linspace(0.05, 1.4, 40)
    hits = pulvis.collide(luding, **BODIES, chi=chi)
    again = pulvis.collide(luding, **BODIES, velocity=hits.velocity)
    assert np.array_equal(hits.restitution, again.restitution)
    np.testing.assert_allclose(hits["chi"], chi, rtol=1e-12)


def test_ctrl_c_stops_a_sweep(luding: pulvis.Law) -> None:
    asked: list[float] = []

    def interrupt() -> None:
        time.sleep(0.5)
        asked.append(time.monotonic())
        _thread.interrupt_main()

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        pulvis.collide(luding, **BODIES, velocity=np.geomspace(0.02, 20, 1_000_000), threads=1)
    # Promised are 0.2 s; a machine with other work may be late.
    assert time.monotonic() - asked[0] < 1.0


def test_a_tuple_gives_each_body_its_own_value(luding: pulvis.Law) -> None:
    one = pulvis.collide(luding, radius=(1e-3, 2e-3), density=2000, velocity=0.1)
    other = pulvis.collide(luding, radius=(2e-3, np.array([1e-3])), density=2000, velocity=0.1)
    assert other.restitution.shape == (1,)
    assert float(one.restitution) == pytest.approx(other.restitution[0], rel=1e-12)


def test_the_element_and_the_key_of_a_mistake_are_named(luding: pulvis.Law) -> None:
    with pytest.raises(pulvis.InputError, match="element 40: .*velocity: -1 m/s is out of range") as refused:
        pulvis.collide(luding, **BODIES, velocity=np.append(np.full(40, 0.1), [-1.0, -2.0]))
    assert refused.value.key == "collision.velocity"
    with pytest.raises(pulvis.InputError, match="element 1: .*kp >= k1") as refused:
        pulvis.collide(luding.replace(kp=[500.0, 50.0]), **BODIES, velocity=0.1)
    assert refused.value.key == "contact.normal.kp"
    with pytest.raises(pulvis.InputError, match="missing `density`"):
        pulvis.collide(luding, radius=1e-3, velocity=1.0)
    with pytest.raises(pulvis.InputError, match="at least 1"):
        pulvis.collide(luding, **BODIES, velocity=0.1, threads=0)
    with pytest.raises(pulvis.InputError, match=r"collision.velocity \(2,\), contact.normal.kc \(3,\)"):
        pulvis.collide(luding.replace(kc=[1.0, 2.0, 3.0]), **BODIES, velocity=[0.1, 0.2])
    with pytest.raises(pulvis.InputError, match="an array is empty"):
        pulvis.collide(luding, **BODIES, velocity=[])
    with pytest.raises(pulvis.InputError, match="unknown key") as refused:
        pulvis.collide(luding, **BODIES, velocity=0.1, colour=3)
    assert refused.value.key == "collision.colour"


def test_a_collision_that_cannot_be_computed_is_a_run_error_of_its_element() -> None:
    spring = pulvis.law("linear", k=1e300)
    with pytest.raises(pulvis.RunError, match="element 1: the time step is 0 s"):
        pulvis.collide(spring, radius=1.0, mass=[1e300, 1e-300], velocity=1.0, method="engine")


def test_trajectories_end_where_the_collision_does(luding: pulvis.Law) -> None:
    hits = pulvis.collide(luding, **BODIES, velocity=[0.05, 0.3], record=True)
    assert len(hits.trajectories) == 2
    for course, deepest in zip(hits.trajectories, hits.overlap_max):
        assert course.overlap.max() == pytest.approx(deepest, rel=1e-12)
        total = course.kinetic + course.potential_available + course.dissipated
        np.testing.assert_allclose(total, total[0], rtol=1e-11)


def test_a_table_of_pandas_has_a_row_for_each_collision(luding: pulvis.Law) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pulvis.collide(luding.replace(kc=[10.0, 20.0]), **BODIES, velocity=[[0.1], [0.2]]).to_dataframe()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == 4
    assert list(frame["velocity"]) == [0.1, 0.1, 0.2, 0.2]
    assert list(frame["contact.normal.kc"]) == [10.0, 20.0, 10.0, 20.0]


def test_results_draw_themselves(luding: pulvis.Law) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    hits = pulvis.collide(luding.replace(kc=[10.0, 20.0]), **BODIES, velocity=[[0.1], [0.2], [0.3]])
    axes = hits.plot(ax=Figure().subplots())
    assert len(axes.lines) == 2 and axes.get_ylabel() == "restitution"
    curve = luding.probe(**BODIES, overlap=[0, 1e-5, 0])
    assert len(curve.plot(ax=Figure().subplots(), color="k").lines[0].get_xdata()) == len(curve.overlap)
