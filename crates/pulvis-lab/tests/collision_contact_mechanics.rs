//! Collisions of elastic spheres, with and without adhesion and dashpot, against the closed forms of contact mechanics.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::theory::hertz::HertzPair;
use pulvis_contact::theory::jkr::JkrPair;
use pulvis_input::Document;
use pulvis_input::collision::CollisionScenario;
use pulvis_lab::collision::{Collision, Observation, Outcome, Regime, Sampling, SweepPoint, collide, sweep};

const MASS: f64 = 5e-6;
const RADIUS: f64 = 5e-4;
const MODULUS: f64 = 1e8;

/// A sphere of 5e-6 kg and 0.5 mm that meets a wall at some speeds [m/s].
fn points(method: &str, speeds: &str, laws: &str) -> Vec<SweepPoint> {
    let text = format!(
        "[collision]\nbodies = \"wall\"\nradius = \"0.5 mm\"\nmass = \"5e-6 kg\"\n{method}\n\
         [collision.sweep]\nvariable = \"velocity\"\nvalues = [{speeds}]\n{laws}"
    );
    let document = Document::from_str("test.toml", &text).unwrap();
    let scenario = CollisionScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
    sweep(&scenario, false).unwrap()
}

const HERTZ: &str = "[contact.normal]\nlaw = \"hertz\"\neffective_modulus = \"1e8 Pa\"\n";
const JKR: &str =
    "[contact.normal]\nlaw = \"jkr\"\neffective_modulus = \"1e8 Pa\"\nwork_of_adhesion = \"0.5 N/m\"\n";
const EXACT: &str = "method = \"exact\"";

fn outcomes(points: &[SweepPoint]) -> impl Iterator<Item = (f64, Outcome)> {
    points.iter().map(|point| (point.case.velocity, point.collision.outcome))
}

#[test]
fn elastic_spheres_touch_as_long_as_hertz_says_and_press_as_hard() {
    let theory = HertzPair::new(MODULUS, RADIUS, MASS).unwrap();
    let points = points(EXACT, "0.001, 0.5, 20.0", HERTZ);
    for point in &points {
        let (speed, outcome) = (point.case.velocity, point.collision.outcome);
        let within =
            |got: f64, expected: f64| assert!((got / expected - 1.0).abs() < 1e-10, "{got} {expected}");
        assert_eq!(outcome.regime, Regime::Rebound);
        within(outcome.overlap_max, theory.overlap_max(speed));
        within(outcome.contact_duration.unwrap(), theory.contact_duration(speed));
        within(outcome.restitution, 1.0);
        // The force at the turning point, sampled there: flat in time, so half a contact time is exact enough.
        let turn = Sampling::At(vec![0.5 * theory.contact_duration(speed)]);
        let observation = Observation { sampling: turn, ..Observation::default() };
        let Collision { course, .. } = collide(&point.case, &observation).unwrap();
        within(course[0].force, theory.force_max(speed));
    }
    // Two published examples: E* = 1e8 Pa, R = 0.5 mm, m = 5e-6 kg, v = 0.5 m/s.
    let outcome = points[1].collision.outcome;
    assert!((outcome.overlap_max / 1.223_935_453_0e-5 - 1.0).abs() < 1e-10);
    assert!((outcome.contact_duration.unwrap() / 7.204_757_691_8e-5 - 1.0).abs() < 1e-10);
}

#[test]
fn tsujis_dashpot_gives_one_restitution_at_any_speed() {
    let damped = format!("{HERTZ}[contact.viscosity]\nlaw = \"tsuji\"\nrestitution = 0.7\n");
    for (speed, outcome) in outcomes(&points(EXACT, "0.001, 0.5, 20.0", &damped)) {
        assert!((outcome.restitution - 0.7).abs() < 1e-10, "{speed}: {}", outcome.restitution);
    }
}

#[test]
fn adhesive_spheres_part_where_the_neck_breaks_and_stick_below_the_published_speed() {
    let theory = JkrPair::new(MODULUS, 0.5, RADIUS).unwrap();
    let limit = theory.sticking_velocity(MASS);
    let speeds = [0.3 * limit, (1.0 - 1e-6) * limit, (1.0 + 1e-6) * limit, 2.0 * limit, 50.0 * limit];
    let listed: Vec<String> = speeds.iter().map(|speed| format!("{speed:e}")).collect();
    for (speed, outcome) in outcomes(&points(EXACT, &listed.join(", "), JKR)) {
        let expected = theory.restitution(speed, MASS);
        // What is left after the loss is e² of the energy, and so is its round-off.
        let squared = outcome.restitution * outcome.restitution;
        assert!((squared - expected * expected).abs() < 1e-10, "{speed}: {squared} for {expected}");
        if speed > limit {
            assert_eq!(outcome.regime, Regime::Rebound, "{speed}");
            assert!((outcome.overlap_end / theory.separation_overlap() - 1.0).abs() < 1e-10);
            assert!((outcome.energy_dissipated / theory.collision_loss() - 1.0).abs() < 1e-9);
        } else {
            assert_eq!(outcome.regime, Regime::Stick, "{speed}");
        }
    }
}

/// Root mean square error of e² at several speeds and phases of the first touch, by the engine's integrator.
fn engine_error(steps: u32, laws: &str, restitution: impl Fn(f64) -> f64, speeds: &[f64]) -> f64 {
    let listed: Vec<String> = speeds.iter().map(|speed| format!("{speed:e}")).collect();
    let method = format!("method = \"engine\"\nsteps_per_contact = {steps}");
    let points = points(&method, &listed.join(", "), laws);
    let mut sum = 0.0;
    for point in &points {
        for phase in [0.1, 0.35, 0.6, 0.85] {
            let observation = Observation { phase, ..Observation::default() };
            let outcome = collide(&point.case, &observation).unwrap().outcome;
            let error = outcome.restitution.powi(2) - restitution(point.case.velocity).powi(2);
            sum += error * error / 4.0;
        }
    }
    (sum / points.len() as f64).sqrt()
}

#[test]
fn the_engine_comes_to_snap_in_and_snap_off_faster_than_at_first_order_although_the_force_jumps() {
    let theory = JkrPair::new(MODULUS, 0.5, RADIUS).unwrap();
    let limit = theory.sticking_velocity(MASS);
    let speeds = [1.7 * limit, 2.6 * limit, 4.3 * limit, 9.1 * limit];
    let error = |steps| engine_error(steps, JKR, |speed| theory.restitution(speed, MASS), &speeds);
    let (coarse, fine) = (error(100), error(800));
    // Applied for whole steps, a force that jumps would leave first order: a factor of 8, and errors of some 1e-2.
    // The slope of the force diverges at snap-off, so that the full second order, 64, is not reached either.
    assert!(coarse < 5e-4 && fine < coarse / 14.0, "{coarse} {fine}");
}

#[test]
fn the_engine_comes_to_hertz_at_second_order() {
    let (coarse, fine) =
        (engine_error(40, HERTZ, |_| 1.0, &[0.01, 1.0]), engine_error(320, HERTZ, |_| 1.0, &[0.01, 1.0]));
    assert!(coarse < 1e-3 && fine < coarse / 20.0, "{coarse} {fine}");
}

#[test]
fn theory_stands_beside_every_collision_that_has_a_closed_form() {
    let law = |text: &str| format!("[contact.normal]\n{text}\n");
    let tsuji = format!("{HERTZ}[contact.viscosity]\nlaw = \"tsuji\"\nrestitution = 0.7\n");
    let laws = [
        (HERTZ.to_owned(), 2),
        (tsuji, 0),
        (JKR.to_owned(), 0),
        (law("law = \"walton-braun\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\""), 1),
        (law("law = \"walton-braun-variable\"\nk1 = \"100 N/m\"\nslope = \"5e4 1/m\""), 1),
        (
            law(
                "law = \"walton-johnson\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\"\nf_0 = \"1e-4 N\"\nkappa = 0.05\nk_tail = \"50 N/m\"",
            ),
            1,
        ),
    ];
    for (laws, others) in &laws {
        let mut sticks = 0;
        for point in points(EXACT, "1e-3, 0.03, 0.3", laws) {
            let (got, theory) = (point.collision.outcome, point.theory.unwrap());
            assert_eq!(got.regime, theory.regime, "{laws}");
            // Round-off, of a contact with a dashpot that of its steps; theory has the series' last digits.
            let within = |got: f64, expected: f64| {
                assert!((got - expected).abs() <= 2e-9 * expected.abs(), "{laws}: {got} for {expected}");
            };
            within(got.restitution, theory.restitution);
            let known = [
                theory.overlap_max.zip(Some(got.overlap_max)),
                theory.contact_duration.zip(got.contact_duration),
            ];
            assert_eq!(known.iter().flatten().count(), *others, "{laws}");
            known.iter().flatten().for_each(|&(expected, got)| within(got, expected));
            sticks += usize::from(got.regime == Regime::Stick);
        }
        let adheres = laws.contains("jkr") || laws.contains("johnson");
        assert_eq!(sticks > 0, adheres, "{laws}");
    }
}
