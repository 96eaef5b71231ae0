//! What must not matter, for random laws, parameters, radii and boxes; and what must not be gained.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use proptest::prelude::*;
use proptest::test_runner::Config;
use pulvis_contact::normal::Interpolation;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, ExpectedLoading, Hertz, Linear, Luding, Normal};
use pulvis_core::walls::{Cylinder, CylinderSide, Wall, WallShape};
use pulvis_core::{Domain, Setup, Simulation};
use pulvis_math::Vector3;

/// Steps of each run.
const STEPS: usize = 400;

/// Collisions multiply rounding errors: over a run of this length by less than this, in units of the differences of
/// [`difference`].
const ROUND_OFF: f64 = 1e-8;

/// Cases of each property.
fn cases(count: u32) -> Config {
    Config { cases: count, failure_persistence: None, ..Config::default() }
}

/// Any normal law, with or without dashpots, and springs against sliding and rolling.
fn any_model() -> impl Strategy<Value = ContactModel> {
    let normal = prop_oneof![
        (200.0..2000.0_f64).prop_map(|k| Normal::from(Linear::new(k, 0.0))),
        (1e7..1e8_f64).prop_map(|effective_modulus| Normal::from(Hertz { effective_modulus })),
        (50.0..200.0_f64, 1.5..8.0_f64, 0.0..1.0_f64, 0.02..0.2_f64).prop_map(
            |(k1, ratio, adhesion, phi_f)| {
                let interpolation = Interpolation::Linear;
                Normal::from(Luding { k1, kp: ratio * k1, kc: adhesion * k1, phi_f, interpolation })
            }
        ),
    ];
    (normal, 0.0..2e-3_f64, 20.0..100.0_f64, 0.05..1.0_f64, 0.0..0.3_f64).prop_map(
        |(normal, gamma_0, stiffness, friction, rolling)| {
            let mut model = ContactModel::frictionless(Linear::new(1.0, 0.0));
            model.normal = normal;
            // Faster than any pair here.
            model.laws.expected = ExpectedLoading { speed: 1.5, force: 0.0, overlap: 0.0 };
            model.laws.viscosity = Viscosity::Constant(Constant { gamma_0 });
            model.laws.sliding = Some(slider(stiffness, 0.1 * gamma_0, friction));
            model.laws.rolling = Some(slider(0.5 * stiffness, 0.05 * gamma_0, rolling));
            model
        },
    )
}

/// Grains of radii up to five times the smallest that fall together in a cube, which is that large.
fn any_cluster() -> impl Strategy<Value = (Setup, f64)> {
    (any_model(), 8..25_usize, 0..1000_u64, 1.0..5.0_f64).prop_map(|(model, count, seed, ratio)| {
        let edge = 2.2 * RADIUS * (count as f64 * 8.0).cbrt();
        let mut setup = implosion(count, edge, seed, model);
        // Every third grain shrinks about its centre: nothing touches that did not before.
        for particle in setup.particles.iter_mut().step_by(3) {
            particle.radius /= ratio;
            particle.mass /= ratio.powi(3);
        }
        (setup, edge)
    })
}

fn run(setup: Setup) -> Vec<State> {
    let mut simulation = start(setup, 40.0);
    advance(&mut simulation, STEPS);
    states(&simulation)
}

fn any_vector(most: f64) -> impl Strategy<Value = Vector3> {
    prop::array::uniform3(-most..most).prop_map(Vector3::from)
}

fn periodic(edge: f64) -> Domain {
    Domain::periodic(Vector3::zero(), vector(edge, edge, edge), [true; 3])
}

/// Momentum and angular momentum about the origin, and the sums of the sizes of their parts.
fn momenta(simulation: &Simulation) -> ([Vector3; 2], [f64; 2]) {
    let particles = simulation.particles();
    let (mut sums, mut scales) = ([Vector3::zero(); 2], [0.0; 2]);
    for row in 0..particles.len() {
        let (mass, radius) = (particles.masses()[row], particles.radii()[row]);
        let momentum = particles.velocities()[row] * mass;
        let orbit = particles.positions()[row].cross(momentum);
        let spin = particles.angular_velocities()[row] * (0.4 * mass * radius * radius);
        sums[0] += momentum;
        sums[1] += orbit + spin;
        scales[0] += momentum.norm();
        scales[1] += orbit.norm() + spin.norm();
    }
    (sums, scales)
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn free_clusters_of_unequal_frictional_grains_keep_momentum_and_angular_momentum((setup, _) in any_cluster()) {
        let mut cluster = start(setup, 40.0);
        let (before, scales) = momenta(&cluster);
        advance(&mut cluster, STEPS);
        let (after, _) = momenta(&cluster);
        for ((before, after), scale) in before.into_iter().zip(after).zip(scales) {
            let drift = (after - before).norm();
            prop_assert!(drift <= 1e-12 * scale, "{drift} of {scale}");
        }
    }

    #[test]
    fn a_shift_across_periodic_boundaries_changes_nothing((setup, edge) in any_cluster(), shift in any_vector(2.0)) {
        let domain = periodic(edge);
        let still = Setup { domain, ..setup };
        let mut shifted = still.clone();
        for particle in &mut shifted.particles {
            particle.position += shift * edge;
        }
        let back = |state: State| State { position: state.position - shift * edge, ..state };
        let shifted: Vec<State> = run(shifted).into_iter().map(back).collect();
        let difference = difference(&domain, &run(still), &shifted);
        prop_assert!(difference < ROUND_OFF, "{difference}");
    }

    #[test]
    fn a_common_velocity_and_a_rotation_change_nothing(
        (setup, _) in any_cluster(),
        wind in any_vector(0.5),
        axis in any_vector(1.0),
        angle in 0.0..6.0_f64,
    ) {
        let axis = if axis.norm() > 0.1 { axis * (1.0 / axis.norm()) } else { vector(0.0, 0.0, 1.0) };
        let (sine, cosine) = angle.sin_cos();
        // Rodrigues' formula.
        let turn = |v: Vector3| v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
        let mut moving = setup.clone();
        for particle in &mut moving.particles {
            particle.position = turn(particle.position);
            particle.velocity = turn(particle.velocity) + wind;
            particle.angular_velocity = turn(particle.angular_velocity);
        }
        let mut still = start(setup, 40.0);
        advance(&mut still, STEPS);
        let expected: Vec<State> = states(&still)
            .into_iter()
            .map(|state| State {
                position: turn(state.position) + wind * still.time(),
                velocity: turn(state.velocity) + wind,
                angular_velocity: turn(state.angular_velocity),
            })
            .collect();
        let difference = difference(&Domain::unbounded(), &run(moving), &expected);
        prop_assert!(difference < ROUND_OFF, "{difference}");
    }

    #[test]
    fn neither_the_numbering_nor_the_thickness_of_skins_matters(
        (setup, edge) in any_cluster(),
        turns in 1..50_usize,
        thickness in 0.05..1.0_f64,
    ) {
        let domain = periodic(edge);
        let first = Setup { domain, ..setup };
        let mut other = first.clone();
        let turns = turns % other.particles.len();
        other.particles.rotate_left(turns);
        other.time_step = contact_time(&other) / 40.0;
        let mut other = Simulation::new(other).unwrap();
        // A cube of so few grains has no room for the thickest skins.
        let _ = other.set_skin(thickness * RADIUS);
        advance(&mut other, STEPS);
        let mut others = states(&other);
        others.rotate_right(turns);
        let difference = difference(&domain, &run(first), &others);
        prop_assert!(difference < ROUND_OFF, "{difference}");
    }

    #[test]
    fn a_grazing_contact_with_a_wall_never_gains_energy(
        model in any_model(),
        speed in 0.05..1.0_f64,
        slope in 1e-4..0.2_f64,
        spin in any_vector(2000.0),
        hollow in 3.0..30.0_f64,
        kind in 0..3_usize,
    ) {
        let mut grain = sphere(vector(0.0, 0.0, 0.9995 * RADIUS), vector(speed, 0.0, -slope * speed), RADIUS);
        grain.angular_velocity = spin;
        let radius = hollow * RADIUS;
        let cylinder = |side, at: f64| {
            let shape = WallShape::from(Cylinder { axis: vector(0.0, 1.0, 0.0), radius, side });
            Wall::of_shape("drum", 0, vector(0.0, 0.0, at), shape)
        };
        let wall = match kind {
            0 => floor(),
            // The grain stands in the lowest part of a drum, or on top of a roll.
            1 => cylinder(CylinderSide::Inside, radius),
            _ => cylinder(CylinderSide::Outside, -radius),
        };
        let mut graze = start(Setup { walls: vec![wall], ..setup(vec![grain], model) }, 40.0);
        prop_assert_eq!(graze.contact_totals().at_walls, 1.0);
        let start = graze.ledger().stored();
        for _ in 0..60 {
            advance(&mut graze, 50);
            let now = graze.ledger().stored();
            // What the trapezoidal rule leaves at forty steps a contact, of either sign.
            prop_assert!(now <= start * (1.0 + 1e-4), "{now} of {start}");
        }
        let error = graze.ledger().relative_error().abs();
        prop_assert!(error < 1e-3, "{error}");
    }
}
