"""What a program changes in a simulation between steps, and the files that it asks for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pulvis

BALL = {
    "material": "glass",
    "radius": {"distribution": "fixed", "value": 1e-3},
    "arrangement": {"kind": "lattice", "lower": [0.5e-3, 0.5e-3, 1e-3], "counts": [1, 1, 1], "spacing": 2.1e-3},
}


def ball_in_a_box(**tables: Any) -> pulvis.Simulation:
    """Built by calls, with laws as objects."""
    spring = pulvis.law("linear", k=1000)
    return pulvis.Simulation(
        materials={"glass": {"density": 2500}, "plate": {}},
        contacts={
            "glass-glass": spring,
            "glass-plate": pulvis.contact(spring, viscosity=pulvis.law("constant", gamma_0=0.05)),
        },
        box={"lower": [0, 0, 0], "upper": [3e-3, 3e-3, 8e-3], "material": "plate"},
        particles=BALL,
        **tables,
    )


def test_a_simulation_is_built_by_calls() -> None:
    simulation = ball_in_a_box(gravity=[0, 0, -9.81])
    assert simulation.stages == ["open"] and len(simulation.particles) == 1
    simulation.advance(10)
    assert simulation.particles.velocity[0, 2] == pytest.approx(-9.81 * simulation.time, rel=1e-12)
    with pytest.raises(pulvis.InputError, match="a file has its tables"):
        pulvis.Simulation("file.toml", gravity=[0, 0, 0])
    with pytest.raises(pulvis.InputError, match="unknown key"):
        ball_in_a_box(colour="red")


def test_particles_start_as_arrays_say() -> None:
    random = np.random.default_rng(1)
    position = np.stack(np.meshgrid(*[np.arange(5) * 2.5e-3] * 3), axis=-1).reshape(-1, 3)
    radius = random.uniform(0.8e-3, 1.2e-3, len(position))
    velocity = random.normal(0, 0.1, (len(position), 3))
    spin = random.normal(0, 10, (len(position), 3))
    listed = {"kind": "list", "positions": position, "radii": radius, "velocities": velocity}
    listed |= {"angular_velocities": spin, "materials": ["glass", "steel"] * 62 + ["glass"]}
    simulation = pulvis.Simulation(
        materials={"glass": {"density": 2500}, "steel": {"density": 7850}},
        contacts={pair: pulvis.law("linear", k=1000) for pair in ("glass-glass", "glass-steel", "steel-steel")},
        particles={"arrangement": listed},
    )
    particles = simulation.particles
    assert np.array_equal(particles.position, position) and np.array_equal(particles.radius, radius)
    assert np.array_equal(particles.velocity, velocity) and np.array_equal(particles.angular_velocity, spin)
    density = np.where(np.arange(len(position)) % 2 == 0, 2500, 7850)
    assert particles.mass == pytest.approx(density * 4 / 3 * np.pi * radius**3, rel=1e-12)
    with pytest.raises(pulvis.InputError, match=r"radii: 124 values for 125 positions"):
        pulvis.Simulation(
            materials={"glass": {"density": 2500}},
            contacts={"glass-glass": pulvis.law("linear", k=1000)},
            particles={
                "material": "glass",
                "arrangement": {"kind": "list", "positions": position, "radii": radius[1:]},
            },
        )


def test_positions_velocities_and_quantities_can_be_set(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    simulation.advance(200)
    particles = simulation.particles
    velocity = particles.velocity
    kinetic, error = simulation.ledger["kinetic_translation"], simulation.ledger["closing_error"]
    particles.velocity = 2 * velocity
    assert np.array_equal(particles.velocity, 2 * velocity)
    ledger = simulation.ledger
    assert ledger["kinetic_translation"] == pytest.approx(4 * kinetic, rel=1e-12)
    # The change is booked, so that the ledger stays as closed as it was.
    assert ledger["closing_error"] == pytest.approx(error, abs=1e-12 * kinetic)
    particles["angular_velocity"] = [0, 0, 3]
    assert np.array_equal(particles.angular_velocity, np.tile([0.0, 0.0, 3.0], (len(particles), 1)))
    forces = simulation.contacts().force
    shift = np.array([1e-3, 0, 0])
    particles.position = particles.position + shift
    # A shifted periodic system is the same system; overlaps are differences of positions that have other round-off.
    np.testing.assert_allclose(np.sort(simulation.contacts().force[:, 0]), np.sort(forces[:, 0]), atol=1e-9)
    particles.add("charge", "C", 1e-12)
    particles.charge = np.arange(len(particles)) * 1e-12
    assert particles.charge[5] == 5e-12
    simulation.advance(100)
    assert np.all(np.isfinite(particles.position)) and particles.charge[5] == 5e-12


def test_what_cannot_be_set_is_refused(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    particles = simulation.particles
    with pytest.raises(pulvis.InputError, match=r"shape \(2, 3\), expected \(216, 3\)"):
        particles.position = np.zeros((2, 3))
    with pytest.raises(pulvis.InputError, match="expected finite numbers"):
        particles.velocity = np.full((216, 3), np.nan)
    with pytest.raises(pulvis.InputError, match="mass cannot be set"):
        particles.mass = 1.0
    with pytest.raises(AttributeError, match="no column `colour`"):
        particles.colour = 1.0
    view = particles.view("velocity")
    with pytest.raises(pulvis.ViewError):
        particles.velocity = np.zeros((216, 3))
    del view
    particles.velocity = np.zeros((216, 3))


def test_forces_of_python_act_as_gravity_does() -> None:
    fallen, pushed, asked = ball_in_a_box(gravity=[0, 0, -9.81]), ball_in_a_box(), ball_in_a_box()
    weight = fallen.particles.mass[:, None] * np.array([0, 0, -9.81])
    pushed.apply(weight)
    seen: list[int] = []

    def force(simulation: pulvis.Simulation) -> Any:
        seen.append(simulation.steps)
        return weight

    asked.apply(force)
    for simulation in (fallen, pushed, asked):
        simulation.advance(3000)
    assert seen == list(range(3000))
    # It has fallen, bounced and lies: sums in another order.
    for simulation in (pushed, asked):
        np.testing.assert_allclose(simulation.particles.position, fallen.particles.position, rtol=1e-9)
        assert abs(simulation.ledger["relative_error"]) < 1e-6
    np.testing.assert_allclose(pushed.walls["z-low"].force, fallen.walls["z-low"].force, rtol=1e-6, atol=1e-12)
    asked.apply(None)
    asked.advance(1)
    assert len(seen) == 3000
    with pytest.raises(pulvis.InputError, match=r"expected \(1, 3\)"):
        pushed.apply([1.0, 2.0])


def test_walls_are_read_and_driven() -> None:
    simulation = ball_in_a_box()
    lid = simulation.walls["z-high"]
    assert lid.motion == "fixed" and lid.velocity.tolist() == [0, 0, 0]
    lid.velocity = (0, 0, -0.1)
    simulation.advance(100)
    assert lid.motion == "velocity" and lid.velocity.tolist() == [0, 0, -0.1]
    # A hundred sums of round-off.
    assert lid.point[2] == pytest.approx(8e-3 - 0.1 * simulation.time, rel=1e-12)
    lid.move("fixed")
    height = lid.point[2]
    simulation.advance(10)
    assert lid.point[2] == height
    lid.present = False
    assert not lid.present
    with pytest.raises(pulvis.InputError, match="no motion is called `jump`"):
        lid.move("jump")
    with pytest.raises(pulvis.InputError, match="has no `speed`; it has velocity"):
        lid.move("velocity", speed=1)
    with pytest.raises(pulvis.InputError, match="`velocity` of a wall: expected three components"):
        lid.move("velocity", velocity=1)


def test_a_saved_simulation_goes_on_with_the_same_bits(gas: dict[str, Any], tmp_path: Path) -> None:
    whole = pulvis.Simulation(gas)
    with pytest.raises(pulvis.RunError, match="before the first step"):
        whole.save(tmp_path / "early.pulvis")
    whole.advance(150)
    whole.save(tmp_path / "state.pulvis")
    whole.run()
    resumed = pulvis.Simulation.resume(tmp_path / "state.pulvis")
    assert resumed.steps == 150 and resumed.stage == "mix"
    resumed.run()
    assert resumed.steps == whole.steps and resumed.is_over
    for name in whole.particles.names:
        assert np.array_equal(resumed.particles[name], whole.particles[name]), name
    assert [end.name for end in resumed.ended] == ["mix", "fall"]
    whole.save(tmp_path / "end.pulvis")
    assert pulvis.Simulation.resume(tmp_path / "end.pulvis").is_over
    with pytest.raises(pulvis.InputError):
        pulvis.Simulation.resume(tmp_path / "missing.pulvis")


def test_a_simulation_goes_on_from_the_checkpoint_of_a_run(gas: dict[str, Any], tmp_path: Path) -> None:
    run = pulvis.run(gas, tmp_path / "run", set={})
    resumed = pulvis.Simulation.resume(run.folder)
    assert resumed.is_over and resumed.measure()["kinetic"] == run.timeseries.kinetic[-1]


def test_forces_and_walls_of_the_program_are_in_checkpoints(tmp_path: Path) -> None:
    whole = ball_in_a_box(gravity=[0, 0, -9.81])
    whole.apply([[1e-6, 2e-6, 0.0]])
    whole.walls["z-high"].velocity = (0, 0, -0.3)
    whole.walls["x-low"].move("cosine", displacement=(2e-4, 0, 0), period=0.01, cycles=3)
    whole.walls["y-high"].present = False
    whole.particles.add("charge", "C", 3e-12)
    whole.advance(500)
    whole.save(tmp_path / "state.pulvis")
    resumed = pulvis.Simulation.resume(tmp_path / "state.pulvis")
    assert np.array_equal(resumed.particles.applied_force, [[1e-6, 2e-6, 0.0]])
    for simulation in (whole, resumed):
        simulation.advance(1500)
    assert not resumed.walls["y-high"].present and resumed.walls["x-low"].motion == "cosine"
    for name, wall in whole.walls.items():
        again = resumed.walls[name]
        assert np.array_equal(again.point, wall.point) and np.array_equal(again.velocity, wall.velocity), name
    assert resumed.particles.names == whole.particles.names and "applied_force" in whole.particles.names
    for name in whole.particles.names:
        assert np.array_equal(resumed.particles[name], whole.particles[name]), name
    assert whole.particles.velocity[0, 1] > 0 and resumed.measure() == pytest.approx(whole.measure(), rel=0, nan_ok=True)


def test_a_function_that_gives_forces_goes_on_with_the_same_bits_if_it_is_given_again(
    gas: dict[str, Any], tmp_path: Path
) -> None:
    def drag(simulation: pulvis.Simulation) -> Any:
        return -1e-6 * simulation.particles.velocity

    whole = pulvis.Simulation(gas)
    whole.apply(drag)
    whole.advance(60)
    whole.save(tmp_path / "state.pulvis")
    resumed = pulvis.Simulation.resume(tmp_path / "state.pulvis")
    # Until then what it has said last acts on.
    assert np.array_equal(resumed.particles.applied_force, whole.particles.applied_force)
    resumed.apply(drag)
    for simulation in (whole, resumed):
        simulation.advance(60)
    for name in whole.particles.names:
        assert np.array_equal(resumed.particles[name], whole.particles[name]), name


STREAM: dict[str, Any] = {
    "materials": {"grain": {"density": 2500}},
    "contacts": {"grain-grain": {"normal": {"law": "linear", "k": 2000}}},
    "domain": {"lower": [0, 0, 0], "upper": [10e-3, 10e-3, 20e-3], "periodic": ["x", "y"]},
    "particles": [
        {
            "material": "grain",
            "radius": {"distribution": "fixed", "value": 0.4e-3},
            "arrangement": {"kind": "lattice", "lower": [0, 0, 2e-3], "counts": [3, 1, 1], "spacing": 3e-3},
        }
    ],
    "inlets": [
        {
            "name": "stream",
            "material": "grain",
            "number_rate": 20000,
            "region": {"kind": "cylinder", "start": [5e-3, 5e-3, 14e-3], "end": [5e-3, 5e-3, 18e-3], "radius": 3e-3},
            "radius": {"distribution": "fixed", "value": 0.4e-3},
            "velocity": {"mean": [0, 0, -1.0]},
        }
    ],
    "stages": [{"name": "flow", "until": {"time": 10e-3}}],
}


def test_a_force_belongs_to_its_particle_and_those_that_come_later_have_none(tmp_path: Path) -> None:
    simulation = pulvis.Simulation(STREAM)
    particles = simulation.particles
    first = np.array([[1e-6, 0, 0], [0, 2e-6, 0], [0, 0, 3e-6]])
    simulation.apply(first)
    time = simulation.time
    while len(particles) < 20:
        simulation.advance(50)
    expected = np.vstack([first, np.zeros((len(particles) - 3, 3))])
    assert np.array_equal(particles.id[:3], [0, 1, 2]) and np.array_equal(particles.applied_force, expected)
    # Nothing touches these three: force times time over mass, two kicks of round-off a step.
    gained = first * (simulation.time - time) / particles.mass[0]
    np.testing.assert_allclose(particles.velocity[:3], gained, rtol=1e-9)
    # Those that came move as they did, down the stream.
    assert np.array_equal(particles.velocity[-1], [0, 0, -1.0])
    count = len(particles)
    with pytest.raises(pulvis.InputError, match=rf"expected \({count}, 3\): a vector for each .* with `ids=`"):
        simulation.apply(first)
    # A refusal leaves what was.
    assert np.array_equal(particles.applied_force, expected)
    simulation.apply([0, 0, 5e-6], ids=particles.id[[1, -1]])
    expected[[1, -1]] = [0, 0, 5e-6]
    assert np.array_equal(particles.applied_force, expected)
    assert np.array_equal(particles.view("applied_force"), expected[particles.row_ids])
    simulation.save(tmp_path / "state.pulvis")
    resumed = pulvis.Simulation.resume(tmp_path / "state.pulvis")
    while len(particles) == count:
        for one in (simulation, resumed):
            one.advance(100)
    assert np.array_equal(particles.applied_force[:count], expected)
    assert np.array_equal(resumed.particles.velocity, particles.velocity)
    assert np.array_equal(resumed.particles.applied_force, particles.applied_force)


def test_forces_by_ids_that_cannot_be_are_refused() -> None:
    simulation = pulvis.Simulation(STREAM)
    for forces, ids, text in (
        ([[0, 0, 0]], [7], "there is no particle 7 now"),
        ([[0, 0, 0]] * 2, [1, 1], "twice"),
        ([[0, 0, 0]] * 2, [0, 1, 2], r"shape \(2, 3\), expected \(3, 3\)"),
        ([[0, 0, 0]], [0.5], "whole numbers"),
        ([["x", 0, 0]], [0], "array of numbers"),
        (None, [0], "go with an array"),
        (lambda now: now, [0], "go with an array"),
    ):
        with pytest.raises(pulvis.InputError, match=text):
            simulation.apply(forces, ids=ids)
    assert not simulation.particles.applied_force.any() and "applied_force" not in simulation.particles.names
    with pytest.raises(pulvis.InputError, match="Simulation.apply"):
        simulation.particles.applied_force = np.zeros((3, 3))


def test_instants_and_pictures_are_files(gas: dict[str, Any], tmp_path: Path) -> None:
    simulation = pulvis.Simulation(gas)
    for _ in range(2):
        simulation.advance(50)
        simulation.write(tmp_path / "vtk")
        simulation.write(tmp_path / "npz", "npz", contacts=False)
        simulation.write(tmp_path / "xyz", "xyz", contacts=False)
    assert [path.name for path in (tmp_path / "xyz").iterdir()] == ["sample.xyz"]
    assert len(list((tmp_path / "npz").glob("sample_*.npz"))) == 2
    assert len(list((tmp_path / "vtk").glob("particles_*.vtp"))) == 2
    [_, last] = sorted((tmp_path / "npz").glob("*.npz"))
    with np.load(last) as arrays:
        order = np.argsort(arrays["id"])
        assert np.array_equal(arrays["position"][order], simulation.particles.position)
    simulation.picture(tmp_path / "particles.png")
    assert (tmp_path / "particles.png").read_bytes()[:4] == b"\x89PNG"
    with pytest.raises(pulvis.RunError, match="lammps-dump"):
        simulation.write(tmp_path, "gif")


def test_contacts_are_one_structured_array(gas: dict[str, Any]) -> None:
    simulation = pulvis.Simulation(gas)
    simulation.run(until="mix")
    contacts = simulation.contacts()
    array = contacts.to_structured()
    assert array.dtype["force"].shape == (3,) and len(array) == len(contacts.id1)
    assert np.array_equal(array["force"], contacts.force) and array["id1"].dtype.kind == "i"
    # What the slider remembers is there by its name.
    assert any(name.startswith("sliding") or "spring" in name for name in array.dtype.names or ()), array.dtype.names
    assert contacts.stored_energy.sum() > 0


def test_rows_that_were_recorded_are_drawn(gas: dict[str, Any]) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    simulation = pulvis.Simulation(gas)
    simulation.every(10, pulvis.Simulation.record)
    simulation.advance(50)
    axes = simulation.plot("kinetic", "elastic", ax=Figure().subplots())
    assert len(axes.lines) == 2 and len(axes.lines[0].get_xdata()) == 5
