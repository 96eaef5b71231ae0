//! Particles that are held or led are pieces of wall: against closed forms, and in the ledger.

use std::f64::consts::{PI, TAU};

use super::common::*;
use pulvis_boundary::motion::{AxisRotation, Cosine, Velocity};
use pulvis_contact::catalogue::{Law, Values};
use pulvis_contact::viscosity::{Constant, Restitution, Viscosity};
use pulvis_contact::{ContactModel, Hertz, Linear};
use pulvis_core::{Domain, GroupMotion, Region, Setup, SetupError, Simulation};
use pulvis_math::Vector3;

const G: f64 = 9.81;
const MASS: f64 = 4.0 / 3.0 * PI * 2500.0 * RADIUS * RADIUS * RADIUS;

fn at_rest(position: Vector3) -> pulvis_core::Particle {
    sphere(position, Vector3::zero(), RADIUS)
}

/// A system whose first particles, so many, are a group that moves in this way.
fn held(setup: Setup, steps_per_contact: f64, members: u32, motion: GroupMotion) -> Simulation {
    let mut simulation = start(setup, steps_per_contact);
    simulation.set_group("held", &(0..members).collect::<Vec<_>>()).unwrap();
    simulation.set_group_motion("held", motion).unwrap();
    simulation
}

fn load(simulation: &Simulation) -> Vector3 {
    simulation.group_load(simulation.group("held").unwrap()).force
}

fn velocity(velocity: Vector3) -> GroupMotion {
    GroupMotion::Velocity(Velocity { velocity })
}

/// A dashpot that gives the linear spring of `elastic` a restitution.
fn bouncing(restitution: f64) -> ContactModel {
    let mut model = elastic();
    let log = restitution.ln();
    let gamma = -2.0 * log * (1000.0 * MASS / (PI * PI + log * log)).sqrt();
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: gamma });
    model
}

#[test]
fn a_grain_bounces_off_a_held_grain_as_off_a_wall_with_the_restitution_of_its_own_mass() {
    // m x'' = −k x − γ x' with the mass of the grain alone: e = exp(−π γ/√(4 k m − γ²)), here chosen as 0.8.
    let falling = |z: f64| sphere(vector(0.0, 0.0, z), vector(0.0, 0.0, -0.1), RADIUS);
    let particles = vec![at_rest(Vector3::zero()), falling(2.1 * RADIUS)];
    let mut on_grain = held(setup(particles, bouncing(0.8)), 200.0, 1, GroupMotion::Fixed);
    let mut on_wall =
        start(Setup { walls: vec![floor()], ..setup(vec![falling(1.1 * RADIUS)], bouncing(0.8)) }, 200.0);
    let mut impulse = 0.0;
    while states(&on_grain)[1].velocity.z <= 0.0 || states(&on_grain)[1].position.z < 2.01 * RADIUS {
        let before = load(&on_grain).z;
        on_grain.step().unwrap();
        impulse += 0.5 * on_grain.time_step() * (before + load(&on_grain).z);
    }
    while states(&on_wall)[0].velocity.z <= 0.0 || states(&on_wall)[0].position.z < 1.01 * RADIUS {
        on_wall.step().unwrap();
    }
    let rebound = states(&on_grain)[1].velocity.z;
    // The contact ends where the spring does, with a force that still pulls: a step of 1/200 of the contact.
    assert!((rebound / 0.08 - 1.0).abs() < 5e-3, "{rebound}");
    assert!((rebound - states(&on_wall)[0].velocity.z).abs() < 5e-3 * rebound);
    // What the grain takes, the held one gets: exactly, step by step.
    assert!((impulse / (-MASS * (rebound + 0.1)) - 1.0).abs() < 1e-12, "{impulse}");
    let ledger = on_grain.ledger();
    assert_eq!((states(&on_grain)[0].position, ledger.work_walls), (Vector3::zero(), 0.0));
    assert!(ledger.relative_error().abs() < 1e-3, "{ledger:?}");
    // The dashpot that laws choose by the reduced mass gives the same: it is the mass of the grain.
    let values = Values::new().with("restitution", 0.8).with("stiffness", 1000.0);
    let mut model = elastic();
    model.laws.viscosity = Viscosity::Restitution(Restitution::from_values(&values).unwrap());
    let particles = vec![at_rest(Vector3::zero()), falling(2.1 * RADIUS)];
    let mut chosen = held(setup(particles, model), 200.0, 1, GroupMotion::Fixed);
    chosen.advance(on_grain.steps()).unwrap();
    assert!((states(&chosen)[1].velocity.z / rebound - 1.0).abs() < 5e-3);
}

#[test]
fn a_hertzian_impact_on_a_held_grain_is_as_deep_as_mass_and_both_curvatures_tell() {
    // ½ m v² = (2/5) k δ^(5/2) with k = 4/3 E* √R*, 1/R* = 1/R + 1/R' (Hertz; Johnson, Contact Mechanics, 11.4).
    let (modulus, speed, large) = (1e8, 0.1, 3.0 * RADIUS);
    let mut resting = at_rest(Vector3::zero());
    (resting.radius, resting.mass) = (large, 27.0 * MASS);
    let coming = sphere(vector(0.0, 0.0, large + 1.01 * RADIUS), vector(0.0, 0.0, -speed), RADIUS);
    let mut setup =
        setup(vec![resting, coming], ContactModel::frictionless(Hertz { effective_modulus: modulus }));
    setup.time_step = 2e-8;
    let mut simulation = Simulation::new(setup).unwrap();
    simulation.set_group("held", &[0]).unwrap();
    simulation.set_group_motion("held", GroupMotion::Fixed).unwrap();
    let mut deepest = 0.0_f64;
    while states(&simulation)[1].velocity.z < 0.0 {
        simulation.step().unwrap();
        deepest = deepest.max(simulation.contact_totals().overlap_max);
    }
    let radius = RADIUS * large / (RADIUS + large);
    let stiffness = 4.0 / 3.0 * modulus * radius.sqrt();
    let expected = (5.0 / 4.0 * MASS * speed * speed / stiffness).powf(0.4);
    assert!((deepest / expected - 1.0).abs() < 1e-3, "{deepest} {expected}");
}

#[test]
fn held_grains_carry_the_weight_of_what_lies_on_them() {
    // A pocket of three held grains, and one on top of it.
    let on_circle = |angle: f64| at_rest(vector(angle.cos(), angle.sin(), 0.0) * (1.2 * RADIUS));
    let mut particles: Vec<_> = (0..3).map(|corner| on_circle(f64::from(corner) * TAU / 3.0)).collect();
    particles.push(at_rest(vector(0.0, 0.0, 1.65 * RADIUS)));
    let bed = Setup { background: gravity(G), ..setup(particles, bouncing(0.5)) };
    let mut simulation = held(bed, 50.0, 3, GroupMotion::Fixed);
    simulation.advance(20_000).unwrap();
    let (load, weight) = (load(&simulation), MASS * G);
    assert!((load.z / -weight - 1.0).abs() < 1e-6, "{load:?} {weight}");
    assert!(load.x.abs() + load.y.abs() < 1e-9 * weight, "{load:?}");
    let group = simulation.group("held").unwrap();
    // The load goes through the middle of the three.
    assert!(simulation.group_load(group).torque.norm() < 1e-9 * weight * RADIUS);
    let ledger = simulation.ledger();
    // The dashpot sets in within a step, of 50 in a contact.
    assert!(ledger.relative_error().abs() < 2e-3 && ledger.kinetic() < 1e-9 * ledger.elastic(), "{ledger:?}");
}

/// Cosine of the angle from the vertical at which a grain leaves a held one from whose top it comes down, starting at rest
/// at this angle.
fn leaves_at(model: ContactModel, start_angle: f64) -> f64 {
    let place = vector(start_angle.sin(), 0.0, start_angle.cos()) * (2.0 * RADIUS);
    let bed =
        Setup { background: gravity(G), ..setup(vec![at_rest(Vector3::zero()), at_rest(place)], model) };
    let mut simulation = held(bed, 30.0, 1, GroupMotion::Fixed);
    let mut apart = 0;
    // It bounces a little where it is put down.
    while apart < 2_000 {
        simulation.step().unwrap();
        apart = if simulation.contact_totals().pairs == 0.0 { apart + 1 } else { 0 };
        assert!(simulation.time() < 1.0);
    }
    // Back along the parabola to where it left.
    let (state, time) = (states(&simulation)[1], 2_000.0 * simulation.time_step());
    let height = state.position.z - state.velocity.z * time - 0.5 * G * time * time;
    height / (2.0 * RADIUS)
}

#[test]
fn a_grain_slides_off_a_held_one_at_two_thirds_and_rolls_off_at_ten_seventeenths() {
    // ½ m v² (1 + j) = m g L (cos θ0 − cos θ), and it leaves where m v²/L = m g cos θ: cos θ = 2/(3 + j) cos θ0 with
    // j = 2/5 of a solid sphere that rolls, 0 of one that slides (a standard problem of mechanics, e.g. Goldstein, chapter 2).
    let soft = |k: f64| {
        let mut model = ContactModel::frictionless(Linear::new(k, 0.0));
        model.laws.viscosity = bouncing(0.3).laws.viscosity;
        model
    };
    let start_angle = 0.3_f64;
    let sliding = leaves_at(soft(1000.0), start_angle);
    assert!((sliding / (2.0 / 3.0 * start_angle.cos()) - 1.0).abs() < 5e-3, "{sliding}");
    let mut rough = soft(1000.0);
    // Never slips: the spring carries all; its dashpot settles it.
    rough.laws.sliding = Some(slider(300.0, 1e-3, 1e9));
    let rolling = leaves_at(rough, start_angle);
    assert!((rolling / (10.0 / 17.0 * start_angle.cos()) - 1.0).abs() < 5e-3, "{rolling}");
}

#[test]
fn a_led_grain_throws_another_one_with_twice_its_speed_and_does_that_work() {
    let speed = 0.1;
    let particles = vec![at_rest(Vector3::zero()), at_rest(vector(2.05 * RADIUS, 0.0, 0.0))];
    let mut simulation = held(setup(particles, elastic()), 200.0, 1, velocity(vector(speed, 0.0, 0.0)));
    while states(&simulation)[1].position.x < 2.3 * RADIUS {
        simulation.step().unwrap();
    }
    let (ledger, thrown) = (simulation.ledger(), states(&simulation)[1].velocity.x);
    assert!((thrown / (2.0 * speed) - 1.0).abs() < 1e-4, "{thrown}");
    // The kinetic energy is that of the free one: 2 m u².
    assert!((ledger.kinetic() / (2.0 * MASS * speed * speed) - 1.0).abs() < 1e-4);
    assert!((ledger.work_walls / ledger.kinetic() - 1.0).abs() < 1e-3, "{ledger:?}");
    assert_eq!(states(&simulation)[0].velocity.x, speed);
    let way = states(&simulation)[0].position.x;
    assert!((way / (speed * simulation.time()) - 1.0).abs() < 1e-12, "{way}");
}

#[test]
fn an_oscillating_grain_compresses_two_springs_in_a_row_and_gets_its_work_back() {
    // Led grain, free grain, wall: k/2 over an amplitude A, slowly: ½ (k/2) A².
    let particles = vec![at_rest(vector(0.0, 0.0, 3.0 * RADIUS)), at_rest(vector(0.0, 0.0, RADIUS))];
    let bed = Setup { walls: vec![floor()], ..setup(particles, elastic()) };
    let (amplitude, period) = (0.05 * RADIUS, 100.0 * contact_time(&bed));
    let displacement = vector(0.0, 0.0, -amplitude);
    let motion = GroupMotion::Cosine(Cosine { displacement, period, cycles: 1.0 });
    let mut simulation = held(bed, 50.0, 1, motion);
    let steps = (0.5 * period / simulation.time_step()).round() as u64;
    simulation.advance(steps).unwrap();
    let (work, expected) = (simulation.ledger().work_walls, 0.25 * 1000.0 * amplitude * amplitude);
    // Inertia: (t_c/period)² of it.
    assert!((work / expected - 1.0).abs() < 1e-3, "{work} {expected}");
    assert!((load(&simulation).z / (500.0 * amplitude) - 1.0).abs() < 1e-2, "{:?}", load(&simulation));
    simulation.advance(steps).unwrap();
    let ledger = simulation.ledger();
    assert!(
        ledger.work_walls.abs() < 1e-3 * work && ledger.closing_error().abs() < 1e-4 * work,
        "{ledger:?}"
    );
    assert_eq!(simulation.group("held").unwrap().work(), ledger.work_walls);
}

#[test]
fn a_grain_that_is_turned_about_an_axis_comes_back_and_is_lifted_by_its_weight_times_its_height() {
    let axis = AxisRotation { point: Vector3::zero(), axis: vector(0.0, 3.0, 0.0), angular_velocity: TAU };
    let bed =
        Setup { background: gravity(G), ..setup(vec![at_rest(vector(0.0, 0.0, -10.0 * RADIUS))], elastic()) };
    let mut simulation = held(bed, 20.0, 1, GroupMotion::Rotation(axis));
    let steps = (0.5 / simulation.time_step()).round() as u64;
    simulation.advance(steps).unwrap();
    let up = states(&simulation)[0];
    // As many steps as fit into half a turn: a step is 2e-5 of one.
    assert!((up.position - vector(0.0, 0.0, 10.0 * RADIUS)).norm() < 1e-2 * RADIUS, "{up:?}");
    assert!((up.velocity.norm() / (TAU * 10.0 * RADIUS) - 1.0).abs() < 1e-9);
    assert_eq!(up.angular_velocity, vector(0.0, TAU, 0.0));
    let lifted = MASS * G * (up.position.z + 10.0 * RADIUS);
    let ledger = simulation.ledger();
    // The force is the same all the way: the trapezoidal rule is exact.
    assert!((ledger.work_walls / lifted - 1.0).abs() < 1e-9, "{}", ledger.work_walls);
    assert!(ledger.closing_error().abs() < 1e-9 * lifted && ledger.kinetic() == 0.0);
    // No contact: gravity is not a load.
    assert!(load(&simulation).norm() < 1e-12 * MASS * G);
}

#[test]
fn who_is_set_free_falls_and_who_is_inserted_later_does_not_belong() {
    let bed = Setup { background: gravity(G), ..setup(vec![at_rest(Vector3::zero())], elastic()) };
    let mut simulation = held(bed, 50.0, 1, GroupMotion::Fixed);
    simulation.advance(500).unwrap();
    assert_eq!(states(&simulation)[0].position, Vector3::zero());
    simulation.insert(&[at_rest(vector(0.01, 0.0, 0.0))]).unwrap();
    simulation.set_group_motion("held", GroupMotion::Free).unwrap();
    simulation.advance(1_000).unwrap();
    let fallen = 0.5 * G * (1_000.0 * simulation.time_step()).powi(2);
    for state in states(&simulation) {
        assert!((state.position.z / -fallen - 1.0).abs() < 1e-12, "{state:?}");
    }
    assert!(simulation.ledger().closing_error().abs() < 1e-12 * MASS * G * fallen);
    assert_eq!(simulation.group("held").unwrap().ids(), [0]);
    simulation.remove(&[0]).unwrap();
    assert!(simulation.group("held").unwrap().ids().is_empty());
}

#[test]
fn held_grains_that_overlap_each_other_or_a_wall_feel_nothing_and_are_crossed_by_others_of_their_kind() {
    let particles = vec![at_rest(vector(0.0, 0.0, 0.5 * RADIUS)), at_rest(vector(RADIUS, 0.0, 0.5 * RADIUS))];
    let bed = Setup { walls: vec![floor()], ..setup(particles, bouncing(0.5)) };
    let mut simulation = held(bed, 50.0, 2, GroupMotion::Fixed);
    assert_eq!(simulation.candidates(), 0);
    simulation.advance(200).unwrap();
    let ledger = simulation.ledger();
    assert_eq!((ledger.kinetic(), ledger.elastic(), load(&simulation)), (0.0, 0.0, Vector3::zero()));
    assert!(ledger.closing_error().abs() < 1e-12 * ledger.switched.abs(), "{ledger:?}");
}

#[test]
fn what_a_program_sets_and_applies_leaves_led_grains_on_their_path_and_the_ledger_closed() {
    let particles = vec![at_rest(Vector3::zero()), at_rest(vector(9.0 * RADIUS, 0.0, 0.0))];
    let mut simulation = held(setup(particles, elastic()), 100.0, 1, velocity(vector(0.1, 0.0, 0.0)));
    simulation.set_velocities(&[vector(5.0, 0.0, 0.0), vector(0.0, 0.1, 0.0)]).unwrap();
    simulation.set_angular_velocities(&[vector(0.0, 9.0, 0.0), Vector3::zero()]).unwrap();
    simulation.set_applied_forces(&[vector(1e-3, 0.0, 0.0), vector(0.0, 1e-5, 0.0)]).unwrap();
    simulation.advance(500).unwrap();
    let [led, free] = states(&simulation)[..] else { panic!() };
    assert_eq!((led.velocity, led.angular_velocity), (vector(0.1, 0.0, 0.0), Vector3::zero()));
    assert!(free.velocity.y > 0.1);
    let ledger = simulation.ledger();
    // What the program pushes with, the one who leads holds against: 1e-3 N along the way.
    assert!((ledger.work_walls / (-1e-3 * led.position.x) - 1.0).abs() < 1e-9, "{ledger:?}");
    assert!(ledger.closing_error().abs() < 1e-9 * ledger.work_walls.abs(), "{ledger:?}");
    assert_eq!(load(&simulation), Vector3::zero());
}

fn refusal(simulation: &mut Simulation, name: &str, motion: GroupMotion) -> String {
    simulation.set_group_motion(name, motion).unwrap_err().to_string()
}

#[test]
fn motions_that_cannot_be_are_refused() {
    let upper = vector(1.0, 1.0, 1.0) * (20.0 * RADIUS);
    let domain = Domain::periodic(Vector3::zero(), upper, [true, false, false]);
    let particles = vec![at_rest(vector(0.0, 0.0, 0.0)), at_rest(vector(5.0 * RADIUS, 0.0, 0.0))];
    let mut simulation = start(Setup { domain, ..setup(particles, elastic()) }, 50.0);
    assert_eq!(refusal(&mut simulation, "floor", GroupMotion::Fixed), "there is no group `floor`");
    let missing = simulation.set_group("floor", &[0, 7]).unwrap_err();
    assert_eq!(missing, SetupError::NotInGroup { name: "floor".to_owned(), id: 7 });
    simulation.set_group("floor", &[1, 0, 1]).unwrap();
    simulation.set_group("one", &[1]).unwrap();
    simulation.set_group_motion("floor", GroupMotion::Fixed).unwrap();
    assert_eq!(
        refusal(&mut simulation, "one", GroupMotion::Fixed),
        "group `one`: its particle 1 is held or led by the group `floor`"
    );
    let rotation = |axis: Vector3| {
        GroupMotion::Rotation(AxisRotation { point: Vector3::zero(), axis, angular_velocity: 1.0 })
    };
    assert_eq!(
        refusal(&mut simulation, "floor", rotation(vector(0.0, 0.0, 1.0))),
        "group `floor`: it cannot rotate through x, which is periodic"
    );
    simulation.set_group_motion("floor", rotation(vector(-2.0, 0.0, 0.0))).unwrap();
    assert_eq!(
        refusal(&mut simulation, "floor", rotation(Vector3::zero())),
        "group `floor`: `axis`: the axis has no direction; expected a direction, for example [0, 0, 1]"
    );
    let removed = simulation.remove_within(&Region::Sphere { centre: Vector3::zero(), radius: RADIUS });
    assert_eq!((removed, simulation.group("floor").unwrap().ids()), (vec![0], &[1][..]));
}
