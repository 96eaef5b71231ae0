//! Oblique collisions and spins: against the laws of rigid bodies, conservation laws, and their own time step.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::disallowed_methods,
    clippy::print_stderr
)]

use std::f64::consts::PI;

use pulvis_input::Document;
use pulvis_input::collision::{CollisionCase, CollisionScenario, Method};
use pulvis_lab::collision::{CollisionError, ObliqueOutcome, Observation, Outcome, Regime, collide};

fn case(collision: &str, contact: &str) -> CollisionCase {
    let text = format!("[collision]\ndensity = \"2500 kg/m^3\"\n{collision}\n{contact}");
    let document = Document::from_str("oblique.toml", &text).unwrap();
    let scenario = CollisionScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
    scenario.cases[0].clone()
}

fn collided(case: &CollisionCase) -> (Outcome, ObliqueOutcome) {
    let outcome = collide(case, &Observation::default()).unwrap().outcome;
    (outcome, outcome.oblique.unwrap())
}

fn near(one: f64, other: f64, tolerance: f64) -> bool {
    (one - other).abs() <= tolerance * other.abs().max(1.0)
}

const WALL: &str = "bodies = \"wall\"\nradius = \"1 mm\"";
const PAIR: &str = "bodies = \"pair\"\nradius = [\"1 mm\", \"2 mm\"]";

/// Overlaps of a few nm, 1e-5 of the radius: lever arms are shorter by half of that, and the line of centres of a pair
/// turns by as little. Forces that end by a jump at opening err by the order of a step.
const STIFF: &str = "[contact.normal]\nlaw = \"linear\"\nk = \"1e8 N/m\"\n";

#[test]
fn a_contact_that_slides_throughout_obeys_the_laws_of_rigid_bodies() {
    // Walton 1993; Foerster et al. 1994: J_t = μ J_n; sliding throughout from tan θ = (7/2) μ (1 + e) on.
    for (bodies, mass_ratio) in [(WALL, [1.0, 0.0]), (PAIR, [8.0 / 9.0, 1.0 / 9.0])] {
        for (restitution, degrees) in [(1.0, 55.0_f64), (0.8, 60.0), (0.5, 80.0)] {
            let contact = format!(
                "{STIFF}restitution = {restitution}\n[contact.sliding]\nlaw = \"spring-slider\"\nkt = \"3e7 N/m\"\nmu = 0.15\n"
            );
            let case = case(
                &format!(
                    "{bodies}\nnormal_velocity = \"1 cm/s\"\nangle = \"{degrees} deg\"\nsteps_per_contact = 20000"
                ),
                &contact,
            );
            let (outcome, oblique) = collided(&case);
            let tangent = degrees.to_radians().tan();
            let impulse = 0.15 * (1.0 + restitution);
            let (normal, across) = (0.01, 0.01 * tangent);
            assert!(tangent > 3.5 * impulse);
            assert!(near(case.velocity, 0.01 / degrees.to_radians().cos(), 1e-13));
            assert!(near(outcome.restitution, restitution, 1e-4), "{}", outcome.restitution);
            assert!(near(oblique.impulse_ratio, 0.15, 1e-4), "{}", oblique.impulse_ratio);
            assert!(near(oblique.restitution_tangential.unwrap(), 1.0 - impulse / tangent, 1e-4));
            assert!(near(oblique.restitution_contact.unwrap(), -1.0 + 3.5 * impulse / tangent, 1e-4));
            // Quotients of numbers that err by 1e-4.
            let left = (across - impulse * normal) / (restitution * normal);
            assert!(near(oblique.rebound_angle.tan(), left, 3e-4));
            let left = (across - 3.5 * impulse * normal) / (restitution * normal);
            assert!(near(oblique.rebound_angle_contact.tan(), left, 3e-4));
            // ω' = (5/2) J_t/(m a) of each body, in the same sense.
            for (body, radius) in [1e-3, 2e-3].into_iter().enumerate() {
                let spin = 2.5 * impulse * normal * mass_ratio[body] / radius;
                let got = oblique.angular_velocities[body];
                assert!(near(got.z, spin, 1e-4) && got.x == 0.0 && got.y == 0.0, "{body}: {got:?}, {spin}");
            }
        }
    }
}

#[test]
fn a_contact_that_sticks_reverses_the_contact_point_by_the_ratio_of_two_frequencies() {
    // v_ct'/v_ct = cos(π √(7 k_t/(2 k))): solid spheres of whatever size, no slip.
    for (stiffness, expected) in [(2e7, -0.871_203_570_4), (2e8 / 7.0, -1.0), (5e7, -0.528_177_257_7)] {
        for bodies in [WALL, PAIR] {
            let contact = format!(
                "{STIFF}[contact.sliding]\nlaw = \"spring-slider\"\nkt = \"{stiffness:?} N/m\"\nmu = 1e9\n"
            );
            for motion in [
                "angle = \"20 deg\"",
                "angle = 0\nspin_i = \"40 rad/s\"",
                "angle = \"30 deg\"\nspin_i = [\"0 rad/s\", \"30 rad/s\", \"-10 rad/s\"]",
            ] {
                let case = case(
                    &format!("{bodies}\nvelocity = \"1 cm/s\"\nsteps_per_contact = 20000\n{motion}"),
                    &contact,
                );
                let (outcome, oblique) = collided(&case);
                assert!(near(outcome.restitution, 1.0, 1e-5), "{motion}: {}", outcome.restitution);
                let got = -oblique.restitution_contact.unwrap();
                assert!(near(got, expected, 1e-4), "{bodies}, {motion}: {got}, {expected}");
            }
        }
    }
}

#[test]
fn without_friction_only_the_part_along_the_line_of_centres_changes() {
    let case = case(
        &format!(
            "{WALL}\nnormal_velocity = \"1 cm/s\"\nangle = \"70 deg\"\nspin_i = [\"5 rad/s\", \"6 rad/s\", \"7 rad/s\"]"
        ),
        &format!("{STIFF}restitution = 0.7\n"),
    );
    let (outcome, oblique) = collided(&case);
    // The dashpot sets in by a jump: an error of the order of a step of the 2000.
    assert!(near(outcome.restitution, 0.7, 2e-4), "{}", outcome.restitution);
    // Sums over thousands of steps in which nothing is added.
    assert!(near(oblique.restitution_tangential.unwrap(), 1.0, 1e-14));
    let spin = oblique.angular_velocities[0];
    assert_eq!([spin.x, spin.y, spin.z], [5.0, 6.0, 7.0]);
}

const SOFT: &str = "[contact.normal]\nlaw = \"luding\"\nk1 = \"1000 N/m\"\nkp = \"4000 N/m\"\nkc = \"200 N/m\"\nphi_f = 0.05\n\
[contact.sliding]\nlaw = \"spring-slider\"\nkt = \"300 N/m\"\nmu = 0.4\ngamma_t = \"1e-4 kg/s\"\n\
[contact.rolling]\nlaw = \"spring-slider\"\nkr = \"100 N/m\"\nmu_r = 0.1\n\
[contact.torsion]\nlaw = \"spring-slider\"\nko = \"100 N/m\"\nmu_o = 0.1\n";
const SPINNING: &str = "velocity = \"30 cm/s\"\nangle = \"35 deg\"\nspin_i = [\"50 rad/s\", \"-90 rad/s\", \"120 rad/s\"]\nspin_j = [\"-20 rad/s\", \"10 rad/s\", \"60 rad/s\"]";

#[test]
fn linear_and_angular_momentum_of_a_pair_are_conserved_to_round_off() {
    let hertz = "[contact.normal]\nlaw = \"hertz\"\neffective_modulus = \"10 MPa\"\n[contact.sliding]\nlaw = \"mindlin\"\neffective_shear_modulus = \"3 MPa\"\nmu = 0.3\n[contact.viscosity]\nlaw = \"tsuji\"\nrestitution = 0.8\n";
    for contact in [SOFT, hertz] {
        let (outcome, oblique) = collided(&case(&format!("{PAIR}\n{SPINNING}"), contact));
        assert_eq!(outcome.regime, Regime::Rebound);
        let [linear, angular] = oblique.momentum_errors.unwrap();
        // A few thousand steps with some roundings each.
        assert!(linear < 1e-13 && angular < 1e-13, "{linear}, {angular}");
        // The collision did something to all of it.
        let [i, j] = oblique.angular_velocities;
        assert!((i.x - 50.0).abs() + (i.y + 90.0).abs() > 1.0 && (i.z - 120.0).abs() > 1.0, "{i:?}");
        assert!((j.z - 60.0).abs() > 1.0, "{j:?}");
    }
    let radius = format!("{SOFT}[contact.conventions]\nlever_arm = \"radius\"\n");
    let [linear, angular] =
        collided(&case(&format!("{PAIR}\n{SPINNING}"), &radius)).1.momentum_errors.unwrap();
    assert!(linear < 1e-13 && angular > 1e-6, "lever arms that do not add up to the distance: {angular}");
}

#[test]
fn the_ledger_closes_with_the_square_of_the_time_step() {
    for bodies in [PAIR, WALL] {
        let spins = if bodies == WALL { SPINNING.split("\nspin_j").next().unwrap() } else { SPINNING };
        let case = case(&format!("{bodies}\n{spins}"), SOFT);
        let error = |steps: f64| {
            let error = |part: usize| {
                let steps_per_contact = steps * (1.0 + 0.01 * part as f64);
                let case = CollisionCase { method: Method::Engine { steps_per_contact }, ..case.clone() };
                let (outcome, _) = collided(&case);
                assert!(outcome.energy_error.is_finite() && outcome.energy_dissipated > 0.0);
                outcome.energy_error.abs()
            };
            (0..8).map(error).sum::<f64>() / 8.0
        };
        let (coarse, fine) = (error(200.0), error(1600.0));
        eprintln!("{bodies}: {coarse:e} {fine:e}");
        assert!(coarse < 2e-3, "{coarse}");
        // The dashpot sets in with touch, by a jump: between first and second order.
        assert!(coarse / fine > 8.0, "{coarse} to {fine}");
    }
}

#[test]
fn zero_degrees_are_head_on() {
    let head_on =
        case(&format!("{PAIR}\nvelocity = \"30 cm/s\"\nmethod = \"engine\"\nsteps_per_contact = 300"), SOFT);
    let zero =
        case(&format!("{PAIR}\nvelocity = \"30 cm/s\"\nangle = \"0 deg\"\nsteps_per_contact = 300"), SOFT);
    let (one, other) = (collide(&head_on, &Observation::default()).unwrap().outcome, collided(&zero).0);
    assert_eq!(
        (one.restitution, one.overlap_max, one.regime),
        (other.restitution, other.overlap_max, other.regime)
    );
    assert!(one.oblique.is_none());
    let exact = CollisionCase { method: Method::Exact, ..zero };
    assert_eq!(collide(&exact, &Observation::default()), Err(CollisionError::ObliqueExact));
}

/// The contact time of a linear spring, and the peak of the tangential force where the contact sticks.
#[test]
fn the_course_of_an_oblique_collision_has_its_tangential_motion() {
    let contact = format!("{STIFF}[contact.sliding]\nlaw = \"spring-slider\"\nkt = \"2e7 N/m\"\nmu = 1e9\n");
    let case = case(&format!("{WALL}\nvelocity = \"1 cm/s\"\nangle = \"45 deg\""), &contact);
    let observation =
        Observation { sampling: pulvis_lab::collision::Sampling::Every(0.0), ..Observation::default() };
    let collision = collide(&case, &observation).unwrap();
    let mass = 4.0 / 3.0 * PI * 1e-9 * 2500.0;
    assert!(near(collision.outcome.contact_duration.unwrap() / (PI * (mass / 1e8_f64).sqrt()), 1.0, 1e-5));
    let peak = collision.course.iter().map(|sample| -sample.oblique.unwrap().force).fold(0.0, f64::max);
    // Half a turn of the tangential oscillator passes within the contact: f = k_t v_t/ω.
    let rate = (3.5 * 2e7 / mass).sqrt();
    let expected = 2e7 * 0.01 * (0.5_f64).sqrt() / rate;
    assert!(near(peak / expected, 1.0, 1e-4), "{peak}, {expected}");
    let energy = |sample: &pulvis_lab::collision::Sample| {
        sample.kinetic + sample.potential_available + sample.dissipated
    };
    let before = energy(&collision.course[0]);
    let worst =
        collision.course.iter().map(|sample| (energy(sample) / before - 1.0).abs()).fold(0.0, f64::max);
    // Kinetic energies swing by dt²/8 f²/m: of the order of (π/2000)².
    assert!(worst < 5e-6, "{worst}");
}
