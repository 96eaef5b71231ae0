//! Bonds: frequencies, breaking, and what two bonded bodies keep while they tumble.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::bond::{self, BROKEN, INTACT};
use pulvis_contact::catalogue::Values;
use pulvis_contact::theory::bond::{Beam, breaking_speed, jiang_shear_strength, restitution};
use pulvis_contact::{Bond, ContactKinematics, ContactModel, Linear, Normal, Pair};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::contact::{Dance, closing_errors, deficits, random_bond, rigid_rotation};
use pulvis_testkit::for_each_case;
use pulvis_testkit::oscillation::oscillates_at;

const X: Vector3 = Vector3::new(1.0, 0.0, 0.0);
const Y: Vector3 = Vector3::new(0.0, 1.0, 0.0);
const Z: Vector3 = Vector3::new(0.0, 0.0, 1.0);
/// Masses of two spheres with the reduced mass 1e-6 kg.
const MASS: f64 = 2e-6;
const RADIUS: f64 = 1e-3;

fn values(numbers: &[(&str, f64)]) -> Values {
    numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number))
}

fn bond_of(name: &str, numbers: &[(&str, f64)]) -> Bond {
    bond::build(name, &values(numbers)).unwrap().unwrap().unwrap()
}

/// A bond beside a contact that is hardly felt.
fn alone(bond: Bond) -> ContactModel {
    beside(bond, Linear::new(f64::MIN_POSITIVE, 0.0))
}

fn beside(bond: Bond, normal: impl Into<Normal>) -> ContactModel {
    let mut model = ContactModel::frictionless(normal);
    model.laws.bond = Some(bond);
    model
}

/// Two spheres that touch, one above the other, bonded from the start.
fn couple(model: &ContactModel, velocity: Vector3, angular_velocity: Vector3) -> Couple {
    let mut first = Sphere::at_rest(MASS, RADIUS, Z * (2.0 * RADIUS));
    (first.velocity, first.angular_velocity) = (velocity, angular_velocity);
    let mut second = Sphere::at_rest(MASS, RADIUS, Vector3::zero());
    second.angular_velocity = -angular_velocity;
    Couple::new(model, first, Some(second))
}

const STIFFNESS: f64 = 1e3;
const STRENGTH: f64 = 1e-3;

/// The bond of contact-laws 10.5.
fn published() -> Bond {
    bond_of("elastic-brittle", &[("normal_stiffness", STIFFNESS), ("tensile_strength", STRENGTH)])
}

#[test]
fn bonded_spheres_oscillate_at_the_frequencies_of_all_modes() {
    let strong = [("tensile_strength", 1e9), ("normal_stiffness", STIFFNESS)];
    // Along the line of centres √(k_n/m_r).
    let model = alone(bond_of("elastic-brittle", &strong));
    oscillates_at(3.16227766e4, || couple(&model, Z * 1e-7, Vector3::zero()), |now| -now.overlap);
    // 1/I_i + 1/I_j = 5/(m a²) for two spheres; springs against turning √(k 5/(m a²)).
    let turning = STIFFNESS * RADIUS * RADIUS;
    let expected = (turning * 5.0 / (MASS * RADIUS * RADIUS)).sqrt();
    let model =
        alone(bond_of("elastic-brittle", &[strong.as_slice(), &[("bending_stiffness", turning)]].concat()));
    oscillates_at(expected, || couple(&model, Vector3::zero(), Y * 1e-6), |now| now.springs().bond_bending.y);
    let model =
        alone(bond_of("elastic-brittle", &[strong.as_slice(), &[("torsion_stiffness", turning)]].concat()));
    oscillates_at(expected, || couple(&model, Vector3::zero(), Z * 1e-6), |now| now.springs().bond_twist);
    // Shear moves and turns both: 1/m_r + a²/I_i + a²/I_j = 7/m.
    let model =
        alone(bond_of("elastic-brittle", &[strong.as_slice(), &[("shear_stiffness", STIFFNESS)]].concat()));
    let expected = (STIFFNESS * 7.0 / MASS).sqrt();
    let start = || couple(&model, X * 1e-7, Vector3::zero());
    oscillates_at(expected, start, |now| now.springs().bond_shear.x);
}

/// The speed of two bodies that part with `speed`, over it, and the error of the energy over what was there, when their bond
/// has broken and they have left its range; `None` where it holds. With `steps` in a period of the bond.
fn parted(bond: Bond, speed: f64, steps: f64) -> Option<[f64; 2]> {
    let mut pair = couple(&alone(bond), Z * speed, Vector3::zero());
    let energy = pair.kinetic_energy();
    let dt = std::f64::consts::TAU / (STIFFNESS / 1e-6).sqrt() / steps;
    for _ in 0..(2.0 * steps) as u64 {
        pair.step(dt);
    }
    if pair.contact().column("bond_state") != Some(BROKEN) {
        return None;
    }
    let relative = pair.i.velocity.z - pair.j.unwrap().velocity.z;
    Some([relative / speed, (pair.kinetic_energy() + pair.stored + pair.lost) / energy - 1.0])
}

#[test]
fn a_bond_breaks_beyond_its_speed_and_takes_the_energy_of_breaking() {
    let slowest = breaking_speed(STRENGTH, STIFFNESS, 1e-6);
    assert!((slowest / 3.16227766e-2 - 1.0).abs() < 1e-9, "{slowest}");
    // The bond is asked at the ends of steps, the peak of the force may lie half a step away: (ω dt)²/8 of it.
    for (factor, breaks) in [(0.9999, false), (1.0001, true)] {
        assert_eq!(parted(published(), factor * slowest, 1000.0).is_some(), breaks, "{factor}");
    }
    let expected = restitution(0.05, slowest);
    assert!((expected / 0.7745966692 - 1.0).abs() < 1e-9, "{expected}");
    // Wherever in its step the bond breaks: second order, 8e-4 and 1.2e-3 at 50 steps a period. The weight (θ − ½) F of a
    // force that does not change within the step leaves twice as much.
    for (steps, restitution_error, energy_error) in [(50.0, 1e-3, 1.5e-3), (500.0, 1.2e-5, 1.8e-5)] {
        let (mut worst, mut unbalanced) = (0.0_f64, 0.0_f64);
        for phase in 0..20 {
            let [found, missing] = parted(published(), 0.05, steps + f64::from(phase) / 2.0).unwrap();
            worst = worst.max((found - expected).abs());
            unbalanced = unbalanced.max(missing.abs());
        }
        assert!(worst < restitution_error, "{steps}: {worst}");
        assert!(unbalanced < energy_error, "{steps}: {unbalanced}");
    }
}

#[test]
fn a_broken_bond_stays_broken() {
    let model = alone(published());
    let mut columns = vec![0.0; model.memory_layout().columns()];
    let state = |columns: &[f64]| columns[model.memory_layout().column("bond_state").unwrap()];
    let pair = Pair::spheres(MASS, MASS, RADIUS, RADIUS);
    let go = |overlap: f64, columns: &mut [f64]| model.respond(&pair, &at_rest(overlap), 0.0, columns);
    assert!(!model.form_bond(-1e-9, &mut columns), "the distance is zero");
    assert!(model.form_bond(0.0, &mut columns) && state(&columns) == INTACT);
    assert!(!model.form_bond(0.0, &mut columns), "it is there");
    assert!((go(-0.9e-6, &mut columns).normal_force + 0.9e-3).abs() < 1e-15);
    let breaking = go(-1.1e-6, &mut columns);
    assert_eq!((breaking.force, state(&columns)), (Vector3::zero(), BROKEN));
    // Without a step, what it stores is lost as it is: k x²/2.
    assert!((breaking.energies.dissipated_fracture / (0.5 * 1e3 * 1.1e-6 * 1.1e-6) - 1.0).abs() < 1e-12);
    for overlap in [-0.5e-6, 1e-6, -1e-3, 0.0] {
        assert_eq!(go(overlap, &mut columns).energies.elastic_bond, 0.0);
        assert!(!model.form_bond(overlap, &mut columns) && state(&columns) == BROKEN);
    }
}

#[test]
fn a_bond_by_touch_has_no_force_at_touch_and_never_forms_again() {
    let with = |numbers: &[(&str, f64)]| {
        let values = values(numbers).with_choice("form", "first-touch");
        bond::build("elastic-brittle", &values).unwrap().unwrap().unwrap()
    };
    let model = alone(with(&[("normal_stiffness", 1e3), ("tensile_strength", 1e-3)]));
    let column = |couple: &Couple, name: &str| couple.contact().column(name).unwrap();
    let mut first = Sphere::at_rest(MASS, RADIUS, Z * (2.0 * RADIUS + 1e-7));
    first.velocity = Z * -0.05;
    let second = Sphere::at_rest(MASS, RADIUS, Vector3::zero());
    let mut pair = Couple::new(&model, first, Some(second));
    let energy = pair.kinetic_energy();
    let dt = 1e-7;
    assert_eq!(column(&pair, "bond_state"), 0.0);
    pair.step_until(dt, 1000, |now| now.overlap > 0.0);
    assert_eq!((column(&pair, "bond_state"), column(&pair, "bond_overlap")), (INTACT, 0.0));
    assert!((pair.normal_force - 1e3 * pair.overlap).abs() < 1e-12, "{}", pair.normal_force);
    // It goes in and comes back, faster than the bond can bear.
    pair.step_until(dt, 10_000, |now| now.overlap < -2e-6);
    assert_eq!(column(&pair, "bond_state"), BROKEN);
    let relative = pair.i.velocity.z - pair.j.unwrap().velocity.z;
    assert!((relative / 0.05 - 0.7745966692).abs() < 1e-3, "{relative}");
    // The step in which it broke, and that in which it formed: second order in ω dt = 3e-3.
    assert!(((pair.kinetic_energy() + pair.lost) / energy - 1.0).abs() < 1e-4, "{}", pair.lost);
    pair.i.velocity.z = pair.j.unwrap().velocity.z - 0.05;
    pair.step_until(dt, 10_000, |now| now.overlap > 0.0);
    assert_eq!((column(&pair, "bond_state"), pair.normal_force < 1e-300), (BROKEN, true));
    // Bodies that overlap in a first look have no force at their overlap.
    let mut columns = vec![0.0; model.memory_layout().columns()];
    let look = model.respond(&Pair::wall(MASS, RADIUS), &at_rest(1e-5), 0.0, &mut columns);
    assert!(look.normal_force < 1e-300 && look.energies.elastic_bond == 0.0, "{look:?}");
}

fn at_rest(overlap: f64) -> ContactKinematics<f64> {
    let zero = Vector3::zero();
    ContactKinematics {
        normal: X,
        overlap,
        inverse_distance: 0.0,
        normal_rate: None,
        radius_i: RADIUS,
        radius_j: RADIUS,
        velocity: zero,
        velocity_mid: zero,
        angular_velocity_i: zero,
        angular_velocity_j: zero,
        angular_velocity_i_mid: zero,
        angular_velocity_j_mid: zero,
    }
}

/// A bond that is led by one step each of pressing, shear, bending and twist, all small against the radius.
struct Led {
    model: ContactModel,
    columns: Vec<f64>,
    overlap: f64,
}

impl Led {
    fn new(model: &ContactModel) -> Self {
        let mut columns = vec![0.0; model.memory_layout().columns()];
        assert!(model.form_bond(0.0, &mut columns));
        Self { model: *model, columns, overlap: 0.0 }
    }

    /// Adds to the overlap and to shear [m], bending and twist [rad] in a step of 1 s; whether the bond holds.
    fn go(&mut self, [overlap, shear, bending, twist]: [f64; 4]) -> bool {
        let before = self.overlap;
        self.overlap += overlap;
        let mut motion = at_rest(self.overlap);
        motion.velocity_mid = Vector3::new(before - self.overlap, shear, 0.0);
        motion.angular_velocity_i_mid = Vector3::new(0.5 * twist, 0.0, 0.5 * bending);
        motion.angular_velocity_j_mid = -motion.angular_velocity_i_mid;
        let pair = Pair::spheres(MASS, MASS, RADIUS, RADIUS);
        self.model.respond(&pair, &motion, 1.0, &mut self.columns);
        self.columns[self.model.memory_layout().column("bond_state").unwrap()] == INTACT
    }
}

/// The most of a load that a bond bears after `first`.
fn strength(model: &ContactModel, first: [f64; 4], load: [f64; 4]) -> f64 {
    let holds = |part: f64| {
        let mut led = Led::new(model);
        assert!(led.go(first));
        led.go(load.map(|load| load * part))
    };
    let (mut low, mut high) = (0.0, 1.0);
    assert!(holds(low) && !holds(high), "{model:?}");
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

#[test]
fn a_bond_bears_what_its_strengths_say() {
    let springs = [
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 5e2),
        ("bending_stiffness", 1e-4),
        ("torsion_stiffness", 2e-4),
        ("tensile_strength", 1e-3),
        ("compressive_strength", 1e-2),
        ("shear_strength", 2e-3),
        ("bending_strength", 3e-7),
        ("torsion_strength", 4e-7),
    ];
    let model = alone(bond_of("elastic-brittle", &springs));
    for (load, stiffness, expected) in [
        ([-1e-4, 0.0, 0.0, 0.0], 1e3, 1e-3),
        ([1e-4, 0.0, 0.0, 0.0], 1e3, 1e-2),
        ([0.0, 1e-4, 0.0, 0.0], 5e2, 2e-3),
        ([0.0, 0.0, 1e-2, 0.0], 1e-4, 3e-7),
        ([0.0, 0.0, 0.0, 1e-2], 2e-4, 4e-7),
    ] {
        let most = strength(&model, [0.0; 4], load);
        let scale: f64 = load.iter().map(|load: &f64| load.abs()).sum();
        assert!((most * scale * stiffness / expected - 1.0).abs() < 1e-9, "{load:?}: {most}");
    }
}

#[test]
fn the_envelope_of_jiang_is_the_published_one() {
    let numbers = [
        ("normal_stiffness", 1e6),
        ("shear_stiffness", 1e6),
        ("bending_stiffness", 1.0),
        ("tensile_strength", 1.0),
        ("compressive_strength", 10.0),
        ("shear_factor", 1.38),
        ("shear_exponent", 0.59),
        ("moment_factor", 0.8),
        ("moment_exponent", 0.7),
    ];
    let model = alone(bond_of("jiang", &numbers));
    for (normal_force, expected) in [(0.0, 2.311952522), (3.0, 5.557692483)] {
        let theory = jiang_shear_strength(normal_force, 1.0, 10.0, 1.38, 0.59);
        let pressed = [normal_force / 1e6, 0.0, 0.0, 0.0];
        let most = strength(&model, pressed, [0.0, 1e-4, 0.0, 0.0]) * 1e-4 * 1e6;
        assert!((theory / expected - 1.0).abs() < 1e-9, "{theory}");
        assert!((most / theory - 1.0).abs() < 1e-12, "{normal_force} N: {most}, {theory}");
        // The moment alone, and both together on the ellipse.
        let turning = jiang_shear_strength(normal_force, 1.0, 10.0, 0.8, 0.7) * RADIUS;
        let most = strength(&model, pressed, [0.0, 0.0, 1e-1, 0.0]) * 1e-1;
        assert!((most / turning - 1.0).abs() < 1e-9, "{normal_force} N: {most}, {turning}");
        let both = [0.0, 0.6 * theory * 2.0 / 1e6, 0.8 * turning * 2.0, 0.0];
        assert!((strength(&model, pressed, both) - 0.5).abs() < 1e-9);
    }
    // Closed at both ends.
    assert!((strength(&model, [0.0; 4], [-1e-5, 0.0, 0.0, 0.0]) * 1e-5 * 1e6 - 1.0).abs() < 1e-9);
    assert!((strength(&model, [0.0; 4], [1e-4, 0.0, 0.0, 0.0]) * 1e-4 * 1e6 - 10.0).abs() < 1e-8);
}

#[test]
fn a_parallel_bond_breaks_by_the_stress_at_its_edge() {
    let numbers = [
        ("normal_stiffness_per_area", 1e9),
        ("shear_stiffness_per_area", 4e8),
        ("radius_ratio", 0.5),
        ("tensile_strength", 1e3),
        ("shear_strength", 2e3),
    ];
    let model = alone(bond_of("parallel-bond", &numbers));
    let (r, pi) = (0.5 * RADIUS, std::f64::consts::PI);
    let (area, second_moment) = (pi * r * r, pi * r * r * r * r / 4.0);
    let most = |first, load| strength(&model, first, load);
    // σ = K_n u, and of bending σ = M r/I = K_n θ r; of a bond that is pressed by 300 Pa as well, more.
    assert!((most([0.0; 4], [-1e-5, 0.0, 0.0, 0.0]) * 1e-5 * 1e9 / 1e3 - 1.0).abs() < 1e-9);
    let moment = most([3e-7, 0.0, 0.0, 0.0], [0.0, 0.0, 0.1, 0.0]) * 0.1 * 1e9 * second_moment;
    assert!((moment * r / second_moment / 1.3e3 - 1.0).abs() < 1e-9, "{moment}");
    // τ = F_s/A + M_o r/J.
    let force = most([0.0; 4], [0.0, 1e-4, 0.0, 0.0]) * 1e-4 * 4e8 * area;
    assert!((force / area / 2e3 - 1.0).abs() < 1e-9, "{force}");
    let twisted = most([0.0, 1e-6, 0.0, 0.0], [0.0, 0.0, 0.0, 0.1]) * 0.1 * 4e8 * 2.0 * second_moment;
    let stress = 1e-6 * 4e8 + twisted * r / (2.0 * second_moment);
    assert!((stress / 2e3 - 1.0).abs() < 1e-9, "{stress}");
    // Where it acts at all.
    let range = model.interaction_range(&Pair::wall(MASS, RADIUS), [RADIUS, 0.0]);
    assert!((range / 1e-6 - 1.0).abs() < 1e-12, "{range}");
}

#[test]
fn a_beam_bond_has_the_stiffness_matrix_of_a_beam() {
    for shear_deforms in [true, false] {
        for (radius_i, radius_j) in [(RADIUS, RADIUS), (RADIUS, 0.6 * RADIUS)] {
            let length = radius_i + radius_j;
            let beam = Beam { length, radius: 4e-4, young_modulus: 1e9, poisson_ratio: 0.25, shear_deforms };
            let theory = if shear_deforms { "timoshenko" } else { "euler-bernoulli" };
            let numbers = [
                ("young_modulus", beam.young_modulus),
                ("poisson_ratio", beam.poisson_ratio),
                ("bond_radius", beam.radius),
                ("tensile_strength", 1e9),
            ];
            let values = values(&numbers).with_choice("beam_theory", theory);
            let model = alone(bond::build("elastic-brittle", &values).unwrap().unwrap().unwrap());
            let matrix = beam.bending_matrix();
            for end in 0..4 {
                let forces = end_forces(&model, [radius_i, radius_j], end, 1e-9 * RADIUS);
                let scale = [1.0, length, 1.0, length]
                    .map(|unit| matrix[0][0] * unit * if end.is_multiple_of(2) { 1.0 } else { length });
                for (row, force) in forces.into_iter().enumerate() {
                    let error = (force - matrix[row][end]).abs() / scale[row];
                    // Displacements of 1e-9 of the length: the turn of the normal is of that order.
                    assert!(error < 1e-8, "{row} {end}: {force}, {}", matrix[row][end]);
                }
            }
        }
    }
}

/// Forces and moments that hold a beam between j at the origin and i, for a unit displacement of u_j, θ_j, u_i or θ_i
/// across it; made by one small step of size `small`.
fn end_forces(model: &ContactModel, radii: [f64; 2], end: usize, small: f64) -> [f64; 4] {
    let [radius_i, radius_j] = radii;
    let length = radius_i + radius_j;
    let mut columns = vec![0.0; model.memory_layout().columns()];
    assert!(model.form_bond(0.0, &mut columns));
    let size = if end.is_multiple_of(2) { small } else { small / length };
    let given = |which: usize| if which == end { size } else { 0.0 };
    let motion = ContactKinematics {
        inverse_distance: 1.0 / length,
        radius_i,
        radius_j,
        velocity_mid: Y * (given(2) - given(0)),
        angular_velocity_i_mid: Z * given(3),
        angular_velocity_j_mid: Z * given(1),
        ..at_rest(0.0)
    };
    let pair = Pair::spheres(MASS, MASS, radius_i, radius_j);
    let answer = model.respond(&pair, &motion, 1.0, &mut columns);
    // What the bond does to the bodies is the opposite of what holds them.
    [answer.force.y, -answer.torque_j.z, -answer.force.y, -answer.torque_i.z].map(|force| force / size)
}

/// A bond of all modes that does not break.
fn strong() -> [(&'static str, f64); 5] {
    [
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 5e2),
        ("bending_stiffness", 2e-4),
        ("torsion_stiffness", 1e-4),
        ("tensile_strength", 1e9),
    ]
}

#[test]
fn a_bonded_pair_that_turns_as_one_body_keeps_its_springs() {
    let model = alone(bond_of("elastic-brittle", &strong()));
    for axis in [Vector3::new(0.6, 0.8, 0.0), Z, Vector3::new(0.48, 0.64, 0.6)] {
        let turned = |steps| rigid_rotation(&model, 1e-4, axis, 6.0, steps);
        let relative = |after: Vector3, before: Vector3| (after - before).norm() / before.norm();
        let bending = |steps| {
            let turn = turned(steps);
            relative(turn.after.bond_bending, turn.before.bond_bending)
        };
        // The chord that replaces the arc of a step, of 2 mm against a shear of 0.1 mm, stretches the spring as well.
        let shear = |steps| {
            let turn = turned(steps);
            relative(turn.after.bond_shear, turn.before.bond_shear)
        };
        for (deviation, most) in [(&bending as &dyn Fn(u32) -> f64, 1e-4), (&shear, 2e-2)] {
            let [coarse, medium, fine] = [100, 200, 400].map(deviation);
            // Second order in the angle of a step, 0.06 to 0.015: a fourth each time.
            assert!(medium < coarse / 3.5 + 1e-12 && fine < medium / 3.5 + 1e-12, "{coarse} {medium} {fine}");
            assert!(fine < most, "{axis:?}: {fine}");
        }
        let turn = turned(400);
        let lengths = [
            turn.after.bond_bending.norm() / turn.before.bond_bending.norm(),
            turn.after.bond_twist / turn.before.bond_twist,
        ];
        // A rigid rotation neither bends nor twists: round-off of 400 steps.
        assert!(lengths.iter().all(|length| (length - 1.0).abs() < 1e-12), "{axis:?}: {lengths:?}");
    }
}

#[test]
fn a_tumbling_bonded_pair_keeps_momentum_angular_momentum_and_energy() {
    let model = alone(bond_of("elastic-brittle", &strong()));
    let start = || {
        let mut first = Sphere::at_rest(MASS, RADIUS, Z * (1.7 * RADIUS));
        first.velocity = Vector3::new(0.3, -0.1, 0.05);
        first.angular_velocity = Vector3::new(40.0, 10.0, -30.0);
        let mut second = Sphere::at_rest(1.5 * MASS, 0.7 * RADIUS, Vector3::zero());
        second.angular_velocity = Vector3::new(-20.0, 50.0, 15.0);
        Couple::new(&model, first, Some(second))
    };
    let momenta = |pair: &Couple| {
        let bodies = [pair.i, pair.j.unwrap()];
        let linear = bodies.map(|body| body.velocity * body.mass);
        let angular = bodies.map(|body| {
            body.position.cross(body.velocity) * body.mass + body.angular_velocity * body.inertia()
        });
        [linear[0] + linear[1], angular[0] + angular[1]]
    };
    let energy_error = |dt: f64, steps: u64| {
        let mut pair = start();
        let (before, energy) = (momenta(&pair), pair.kinetic_energy() + pair.stored);
        let mut worst = 0.0_f64;
        for _ in 0..steps {
            pair.step(dt);
            worst = worst.max(((pair.kinetic_energy() + pair.stored) / energy - 1.0).abs());
        }
        for (now, before) in momenta(&pair).into_iter().zip(before) {
            // Round-off of so many steps.
            assert!((now - before).norm() < 1e-12 * before.norm(), "{now:?} {before:?}");
        }
        worst
    };
    // Some ten turns of the pair, a thousand periods of the bond.
    let (coarse, fine) = (energy_error(2e-6, 20_000), energy_error(1e-6, 40_000));
    assert!(coarse < 2e-2 && fine < coarse / 3.0, "{coarse} {fine}");
}

#[test]
fn the_energy_balance_of_bonded_contacts_closes_at_its_order() {
    for_each_case("energy balance of bonds", 60, |draw| {
        let Some(mut bond) = random_bond(draw) else { panic!("a bond") };
        // Strong enough to hold.
        let numbers = [("normal_stiffness", 1.0), ("tensile_strength", f64::MAX)];
        bond.criterion = bond_of("elastic-brittle", &numbers).criterion;
        // The contact beside it is as stiff as the motion is slow.
        let model = beside(bond, Linear::new(1e3, 0.0));
        let dance = Dance::random(&model, draw);
        let [fine, coarse @ ..] = closing_errors(&model, &dance, [8000, 900, 1000, 1100]);
        let coarse = coarse.into_iter().fold(0.0, f64::max);
        assert!(fine <= coarse / 16.0 + 1e-9, "{coarse} falls to {fine}: {model:?}");
        assert!(fine < 1e-2, "{fine}: {model:?}");
    });
}

#[test]
fn no_path_gains_energy_from_bonds_that_break() {
    for_each_case("passivity of bonds", 100, |draw| {
        let Some(bond) = random_bond(draw) else { panic!("a bond") };
        let model = beside(bond, Linear::new(1e3, 0.0));
        let dance = Dance::random(&model, draw);
        // In the step of an event the books are half-way: first order.
        let [fine, coarse] = deficits(&model, &dance, [16_000, 2000]);
        assert!(fine <= 0.3 * coarse + 1e-4, "{coarse} falls to {fine}: {model:?}");
        assert!(fine < 1e-2, "{fine}: {model:?}");
    });
}

#[test]
fn a_contact_whose_place_the_bond_took_begins_without_force() {
    let values = values(&[
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 1e3),
        ("shear_strength", 1e-4),
        ("tensile_strength", 1e9),
    ])
    .with_choice("contact_spring", "off");
    let bond = bond::build("elastic-brittle", &values).unwrap().unwrap().unwrap();
    let model = beside(bond, Linear::new(2e3, 0.0));
    let (overlap, pair) = (1e-5, Pair::spheres(MASS, MASS, RADIUS, RADIUS));
    let mut columns = vec![0.0; model.memory_layout().columns()];
    assert!(model.form_bond(overlap, &mut columns));
    let mut motion = at_rest(overlap);
    let mut ask =
        |motion: &ContactKinematics<f64>, step: f64| model.respond(&pair, motion, step, &mut columns);
    // The bond alone carries it.
    let pressed = ask(&at_rest(overlap + 1e-6), 0.0);
    assert!((pressed.normal_force - 1e-3).abs() < 1e-15 && pressed.energies.elastic_normal == 0.0);
    motion.velocity_mid = Y * 1e-3;
    let breaking = ask(&motion, 1e-3);
    assert!(breaking.energies.dissipated_fracture > 0.0 && breaking.energies.elastic_normal == 0.0);
    // At the overlap of breaking the contact has no force; beyond it has its stiffness, and none once the bodies part less.
    for (deeper, force) in [(0.0, 0.0), (1e-6, 2e-3), (-1e-6, 0.0)] {
        // To 1e-11 of the overlap, at which the contact may begin later.
        assert!((ask(&at_rest(overlap + deeper), 0.0).normal_force - force).abs() < 2e-13, "{deeper}");
    }
    // After they have come apart, the contact is an ordinary one.
    ask(&at_rest(-1e-9), 0.0);
    assert!((ask(&at_rest(1e-6), 0.0).normal_force - 2e-3).abs() < 1e-15);
}

#[test]
fn kemptons_agglomerates_are_his_contact_and_a_normal_bond() {
    let kempton =
        Normal::build("kempton", &values(&[("k1", 100.0), ("k2", 400.0), ("cohesion_density", 1e4)]));
    let Some(Ok(Normal::Kempton(law))) = kempton else { panic!("the law") };
    let model = beside(published(), law);
    let contact = ContactModel::frictionless(law);
    let pair = Pair::spheres(MASS, MASS, RADIUS, RADIUS);
    let (mut columns, mut without) =
        (vec![0.0; model.memory_layout().columns()], vec![0.0; contact.memory_layout().columns()]);
    let at_formation = 2e-6;
    contact.respond(&pair, &at_rest(at_formation), 0.0, &mut without);
    model.respond(&pair, &at_rest(at_formation), 0.0, &mut columns);
    assert!(model.form_bond(at_formation, &mut columns));
    // Bond and contact add up, in compression and in tension, and beyond touching the bond is alone.
    for overlap in [2e-6, 5e-6, 1.5e-6, -0.5e-6, 0.5e-6, 1.2e-6] {
        let both = model.respond(&pair, &at_rest(overlap), 0.0, &mut columns).normal_force;
        let alone = contact.respond(&pair, &at_rest(overlap), 0.0, &mut without).normal_force;
        let broken = columns[model.memory_layout().column("bond_state").unwrap()] == BROKEN;
        let expected = if broken { 0.0 } else { 1e3 * (overlap - at_formation) };
        // An extension of 2.5e-6 m is more than F_t/k_n.
        assert_eq!(broken, overlap < 1.5e-6, "{overlap}");
        assert!((both - alone - expected).abs() < 1e-15, "{overlap}: {both} {alone}");
    }
}

#[test]
fn a_bonded_pair_keeps_its_energy_at_the_automatic_step() {
    for_each_case("automatic step of bonds", 40, |draw| {
        let Some(mut bond) = random_bond(draw) else { panic!("a bond") };
        // Strong enough to hold; of any shape.
        let numbers = [("normal_stiffness", 1.0), ("tensile_strength", f64::MAX)];
        bond.criterion = bond_of("elastic-brittle", &numbers).criterion;
        bond.formation.distance = 0.0;
        let model = beside(bond, Linear::new(1e3, 0.0));
        let (body_i, body_j) =
            ((MASS, RADIUS), (MASS * draw.log_between(0.1, 10.0), RADIUS * draw.log_between(0.5, 2.0)));
        let dt = model.shortest_contact_time(body_i, Some(body_j)) / 50.0;
        // Motions of 1e-6 radii in a step, of all modes.
        let speed = 1e-6 * RADIUS / dt;
        let mut moving = |mut sphere: Sphere| {
            sphere.velocity = draw.vector() * speed;
            sphere.angular_velocity = draw.vector() * (speed / RADIUS);
            sphere
        };
        let first = moving(Sphere::at_rest(body_i.0, body_i.1, Z * (body_i.1 + body_j.1)));
        let second = moving(Sphere::at_rest(body_j.0, body_j.1, Vector3::zero()));
        let mut pair = Couple::new(&model, first, Some(second));
        let energy = pair.kinetic_energy();
        let mut worst = 0.0_f64;
        for _ in 0..2000 {
            pair.step(dt);
            worst = worst.max(((pair.kinetic_energy() + pair.stored + pair.lost) / energy - 1.0).abs());
        }
        // Undamped: velocity-Verlet at 100 steps in the shortest period, (π/50)²/8 = 5e-4. Dashpots as fast as the step allows
        // see velocities that are predicted.
        let most = if bond.springs.has_dashpot() { 2e-2 } else { 1e-3 };
        assert!(worst < most, "{worst}: {model:?}");
    });
}
