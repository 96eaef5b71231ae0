"""Simulations step by step, and runs."""

from __future__ import annotations

import _thread
import gc
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pulvis


def test_steps_have_the_bits_of_a_run_however_they_are_divided(gas: dict[str, Any], tmp_path: Path) -> None:
    run = pulvis.run(gas, tmp_path / "run")
    series = run.timeseries
    whole = pulvis.Simulation(gas)
    ends = whole.run()
    assert [(end.name, end.time, end.steps) for end in ends] == [(e.name, e.time, e.steps) for e in run.stages]
    divided = pulvis.Simulation(gas, threads=2)
    sizes = np.random.default_rng(1).integers(1, 40, size=1000)
    for size in sizes:
        divided.advance(int(size))
    assert divided.is_over and divided.advance(10) == 0
    for simulation in (whole, divided):
        for name, value in simulation.measure().items():
            assert np.array_equal(value, series[name][-1], equal_nan=True), name
        for name in simulation.particles.names:
            assert np.array_equal(simulation.particles[name], whole.particles[name]), name
    assert np.array_equal(whole.contacts().force, divided.contacts().force)


def test_a_stage_gains_the_momentum_of_its_gravity(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)

    def momentum() -> np.ndarray[Any, Any]:
        particles = simulation.particles
        return np.sum(particles.mass[:, None] * particles.velocity, axis=0)

    before, scale = momentum(), np.sum(simulation.particles.mass) * 0.5
    [mixed] = simulation.run(until="mix")
    np.testing.assert_allclose(momentum(), before, atol=1e-13 * scale)
    [fallen] = simulation.run()
    weight = np.sum(simulation.particles.mass) * np.array([0, 0, -9.81])
    # Sums over 216 particles and some hundred steps, each of round-off.
    np.testing.assert_allclose(momentum() - before, weight * (fallen.time - mixed.time), atol=1e-12 * scale)
    assert abs(simulation.ledger["relative_error"]) < 1e-3


def test_forces_of_contacts_add_up_to_those_on_particles(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    simulation.run(until="mix")
    contacts = simulation.contacts()
    assert len(contacts.id1) > 50
    sums = np.zeros((len(simulation.particles), 3))
    np.add.at(sums, contacts.id1, contacts.force)
    np.add.at(sums, contacts.id2, -contacts.force)
    force = simulation.particles.force
    # Dashpots see velocities of the end of the step in files and predicted ones in the step.
    np.testing.assert_allclose(sums, force, atol=2e-2 * np.abs(force).max())


def test_views_are_the_columns_themselves_and_hold_them_fast(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    particles = simulation.particles
    view = particles.view("position")
    again = particles.view("position")
    assert view.__array_interface__["data"] == again.__array_interface__["data"]
    assert np.array_equal(view, particles.position[particles.row_ids])
    with pytest.raises(ValueError, match="read-only"):
        view[0, 0] = 0.0
    part = view[3:5, 1]
    del view, again
    gc.collect()
    with pytest.raises(pulvis.ViewError, match=r"1 view\(s\)") as refused:
        simulation.advance(1)
    assert isinstance(refused.value, BufferError) and simulation.steps == 0
    del part, refused
    gc.collect()
    assert simulation.advance(1) == 1


def test_a_view_outlives_its_simulation(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    view, copy = simulation.particles.view("velocity"), simulation.particles.velocity
    rows = simulation.particles.row_ids
    del simulation
    gc.collect()
    assert np.array_equal(view, copy[rows])


def test_views_of_many_particles_cost_no_memory(gas: dict[str, Any]) -> None:
    gas["particles"][0]["arrangement"]["counts"] = [6, 6, 6]
    simulation = pulvis.Simulation(gas)
    view = simulation.particles.view("force")
    assert not view.flags.owndata and view.strides == (64, 8)
    masses = simulation.particles.view("mass")
    assert not masses.flags.owndata and masses.flags.c_contiguous


def test_callbacks_come_at_their_steps_and_their_errors_leave_the_state_whole(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    seen: list[int] = []
    simulation.every(25, lambda now: seen.append(now.steps))
    simulation.every(10, pulvis.Simulation.record)
    simulation.advance(60)
    simulation.advance(41)
    assert seen == [25, 50, 75, 100]
    series = simulation.timeseries
    assert series.step.tolist() == list(range(10, 101, 10))
    assert series.time[-1] == pytest.approx(100 * simulation.time_step, rel=1e-12)

    def fail(now: pulvis.Simulation) -> None:
        raise KeyError("mine")

    simulation.every(103, fail)
    with pytest.raises(KeyError, match="mine"):
        simulation.advance(50)
    assert simulation.steps == 103


def test_ctrl_c_stops_between_two_steps(gas: dict[str, Any]) -> None:
    gas["stages"] = [{"name": "mix", "until": {"time": 1000}}]
    simulation = pulvis.Simulation(gas)
    asked: list[float] = []

    def interrupt() -> None:
        time.sleep(0.3)
        asked.append(time.monotonic())
        _thread.interrupt_main()

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    # Promised are 0.2 s; a machine with other work may be late.
    assert time.monotonic() - asked[0] < 1.0
    steps = simulation.steps
    assert steps > 0 and simulation.advance(10) == 10 and simulation.steps == steps + 10


def test_ctrl_c_completes_the_files_of_a_run_which_then_goes_on(gas: dict[str, Any], tmp_path: Path) -> None:
    whole = pulvis.run(gas, tmp_path / "whole")

    def stop(now: dict[str, Any]) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pulvis.run(gas, tmp_path / "stopped", progress=stop)
    try:
        resumed = pulvis.resume(tmp_path / "stopped")
    except pulvis.InputError as error:
        # The run is short: the first look may come at its end.
        assert "has ended" in str(error)
        resumed = pulvis.Run(tmp_path / "stopped")
    for name in ("timeseries.csv", "run.toml"):
        assert (resumed.folder / name).read_bytes() == (whole.folder / name).read_bytes()


def test_mistakes_of_a_scenario_are_told_with_their_keys(gas: dict[str, Any], tmp_path: Path) -> None:
    gas["particles"][0]["radius"]["value"] = -1
    with pytest.raises(pulvis.InputError, match="-1 m is out of range") as refused:
        pulvis.Simulation(gas)
    assert refused.value.key == "particles[0].radius.value" and refused.value.file == "<dict>"
    with pytest.raises(pulvis.InputError, match="there is no such file") as refused:
        pulvis.Simulation(tmp_path / "missing.toml")
    with pytest.raises(pulvis.InputError, match="has no unit"):
        pulvis.Simulation.from_text("[materials.glass]\ndensity = 2500\n")


def test_a_time_step_that_is_too_long_is_refused_before_the_first_step(gas: dict[str, Any]) -> None:
    with pytest.raises(pulvis.InputError, match="is longer than 1/") as refused:
        pulvis.Simulation({**gas, "time": {"step": 1e-3}})
    assert refused.value.key == "time.step"


def test_values_are_replaced_by_their_keys(gas: dict[str, Any]) -> None:
    softer = {"normal.k": 10, "sliding.kt": 3.0}
    soft = pulvis.Simulation(gas, set={f"contacts.glass-glass.{key}": value for key, value in softer.items()})
    hard = pulvis.Simulation(gas)
    # The shortest motion takes pi sqrt(m_r/k), but for a weak dashpot.
    assert soft.time_step / hard.time_step == pytest.approx(10, rel=0.05)


def test_what_goes_wrong_on_the_way_is_a_run_error_and_stays_one(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation({**gas, "limits": {"speed": 0.1}})
    with pytest.raises(pulvis.RunError, match="stage `mix`"):
        simulation.run()
    with pytest.raises(pulvis.RunError, match="not go on"):
        simulation.advance(1)
    assert np.all(np.isfinite(simulation.particles.position))


def test_walls_are_told_by_name() -> None:
    glass = {"density": 2500}
    simulation = pulvis.Simulation(
        {
            "materials": {"glass": glass, "plate": {}},
            "contacts": {
                "glass-glass": {"normal": {"law": "linear", "k": 1000}},
                "glass-plate": {"normal": {"law": "linear", "k": 1000, "gamma_0": 0.05}},
            },
            "gravity": [0, 0, -9.81],
            "box": {"lower": [0, 0, 0], "upper": [3e-3, 3e-3, 3e-3], "material": "plate"},
            "particles": [
                {
                    "material": "glass",
                    "radius": {"distribution": "fixed", "value": 1e-3},
                    "arrangement": {
                        "kind": "lattice",
                        "lower": [0.5e-3, 0.5e-3, 0.1e-3],
                        "counts": [1, 1, 1],
                        "spacing": 2.1e-3,
                    },
                }
            ],
            "stages": [{"name": "rest", "until": {"time": 0.05}}],
        }
    )
    simulation.run()
    floor = simulation.walls["z-low"]
    weight = simulation.particles.mass[0] * 9.81
    # The dashpot has taken all of the fall after fifty contact times.
    np.testing.assert_allclose(floor.force, [0, 0, -weight], rtol=1e-6, atol=1e-9 * weight)
    assert floor.present and floor.motion == "fixed" and floor.normal is not None
