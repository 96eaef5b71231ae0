//! A contact on a prescribed path, against closed forms and the balance of energy.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use std::f64::consts::PI;

use pulvis_contact::Normal;
use pulvis_input::Document;
use pulvis_input::probe::ProbeScenario;
use pulvis_lab::probe::{ProbeSample, probe};

/// A probe of a sphere of 1 mm at a wall, or of a pair, with the tables `contact`.
fn samples(probe_keys: &str, contact: &str) -> Vec<ProbeSample> {
    let text = format!("[probe]\ndensity = \"2000 kg/m^3\"\n{probe_keys}\n{contact}");
    let document = Document::from_str("probe.toml", &text).unwrap();
    let scenario = ProbeScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
    let mut curves = probe(&scenario).unwrap();
    assert_eq!(curves.len(), 1);
    curves.remove(0).samples
}

/// Whether two numbers agree within a part of the larger one of them and `scale`.
fn near(one: f64, other: f64, scale: f64, tolerance: f64) -> bool {
    (one - other).abs() <= tolerance * one.abs().max(other.abs()).max(scale)
}

const LOOP: &str =
    "bodies = \"wall\"\nradius = \"1 mm\"\noverlap = [\"-1 um\", \"20 um\", \"5 um\", \"30 um\", \"-9 um\"]";

#[test]
fn hertz_follows_its_formula_on_every_leg() {
    let samples = samples(LOOP, "[contact.normal]\nlaw = \"hertz\"\neffective_modulus = \"1 MPa\"\n");
    assert_eq!(samples.len(), 801);
    for sample in &samples {
        let depth = sample.overlap.max(0.0);
        let force = 4.0 / 3.0 * 1e6 * 1e-3_f64.sqrt() * depth.powf(1.5);
        assert!(near(sample.force, force, 1e-9, 1e-13), "{sample:?}: {force}");
        assert!(near(sample.contact_radius, (1e-3 * depth).sqrt(), 1e-9, 1e-13), "{sample:?}");
        assert_eq!(sample.time, None);
        assert_eq!(sample.dissipated, 0.0);
    }
}

#[test]
fn jkr_lies_on_the_curve_of_johnson_kendall_and_roberts_and_parts_where_it_ends() {
    let (modulus, adhesion, radius) = (1e9, 0.1, 1e-6);
    let samples = samples(
        "bodies = \"wall\"\nradius = \"1 um\"\noverlap = [\"-5 nm\", \"20 nm\", \"-10 nm\"]\npoints = 1000",
        "[contact.normal]\nlaw = \"jkr\"\neffective_modulus = \"1 GPa\"\nwork_of_adhesion = \"0.1 N/m\"\n",
    );
    let pull_off = 1.5 * PI * adhesion * radius;
    let separation = -3.0 * (PI * adhesion / (8.0 * modulus)).powf(2.0 / 3.0) * radius.cbrt();
    let mut least = 0.0_f64;
    for sample in &samples {
        let a = sample.contact_radius;
        let closing = sample.leg <= 1.0;
        let attached = if closing { sample.overlap >= 0.0 } else { sample.overlap > separation };
        assert_eq!(sample.branch == "attached", attached, "{sample:?}");
        if attached {
            // δ and F of the radius a, Johnson (1985) section 5.5.
            let overlap = a * a / radius - (2.0 * PI * adhesion * a / modulus).sqrt();
            let force = 4.0 * modulus * a.powi(3) / (3.0 * radius)
                - (8.0 * PI * adhesion * modulus * a.powi(3)).sqrt();
            assert!(near(sample.overlap, overlap, 1e-9, 1e-12), "{sample:?}: {overlap}");
            assert!(near(sample.force, force, pull_off, 1e-12), "{sample:?}: {force}");
        } else {
            assert_eq!((sample.force, a), (0.0, 0.0));
        }
        least = least.min(sample.force);
    }
    // A parabola about its minimum; the points lie 0.03 nm apart.
    assert!(near(-least, pull_off, 0.0, 1e-4), "{least}");
    // Lost for good in the loop: 1.5279673 fJ, `contact-laws` reference; the work is a sum over 2000 steps.
    let end = samples.last().unwrap();
    assert!(near(end.dissipated, 1.527_967_303e-15, 0.0, 1e-9), "{end:?}");
    assert!(near(end.work, end.dissipated, 0.0, 1e-3), "{end:?}");
}

#[test]
fn luding_loads_along_k1_unloads_along_k2_and_is_limited_by_kc() {
    let (k1, kp, kc, phi_f, a12) = (100.0, 500.0, 100.0, 0.05, 2e-3);
    let limit = kp / (kp - k1) * phi_f * a12;
    let samples = samples(
        LOOP,
        "[contact.normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"100 N/m\"\nphi_f = 0.05\n",
    );
    let mut overlap_max = 0.0_f64;
    for sample in samples.iter().filter(|sample| sample.leg < 3.5) {
        overlap_max = overlap_max.max(sample.overlap);
        let k2 = k1 + (kp - k1) * overlap_max / limit;
        let zero = (1.0 - k1 / k2) * overlap_max;
        let force = (k2 * (sample.overlap - zero)).min(k1 * sample.overlap).max(-kc * sample.overlap);
        let force = if sample.overlap > 0.0 { force } else { 0.0 };
        assert!(near(sample.force, force, 1e-6, 1e-12), "{sample:?}: {force}");
    }
    let branches: Vec<&str> = samples.iter().map(|sample| sample.branch).collect();
    for name in ["none", "k1", "k2", "kc"] {
        assert!(branches.contains(&name), "{name}");
    }
}

#[test]
fn a_dashpot_sees_the_speed_and_dissipates_what_it_must() {
    let samples = samples(
        "bodies = \"wall\"\nradius = \"1 mm\"\noverlap = [\"0 um\", \"20 um\", \"0 um\"]\nspeed = \"2 mm/s\"",
        "[contact.normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n[contact.viscosity]\nlaw = \"constant\"\ngamma_0 = \"0.01 kg/s\"\n",
    );
    for sample in samples.iter().filter(|sample| sample.overlap > 0.0) {
        let time = sample.time.unwrap();
        let rate = if sample.leg < 1.0 || (sample.leg == 1.0 && sample.force > 2e-3) { 2e-3 } else { -2e-3 };
        let force = 100.0 * sample.overlap + 0.01 * rate;
        assert!(near(sample.force, force, 1e-6, 1e-12), "{sample:?}: {force}");
        // γ v² t, but for the half of the first step in which the trapezoidal rule misses the dashpot.
        let power = 0.01 * 4e-6;
        assert!((sample.dissipated - power * time).abs() < 0.51 * power * 5e-5, "{sample:?}");
    }
    let turning = samples.iter().filter(|sample| sample.leg == 1.0).count();
    assert_eq!(turning, 2, "both sides of the jump");
    assert!(near(samples.last().unwrap().time.unwrap(), 0.02, 0.0, 1e-12));
}

const RESISTANCE: &str = "[contact.normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n\
[contact.sliding]\nlaw = \"spring-slider\"\nkt = \"30 N/m\"\nmu = 0.4\n\
[contact.rolling]\nlaw = \"spring-slider\"\nkr = \"20 N/m\"\nmu_r = 0.1\n\
[contact.torsion]\nlaw = \"spring-slider\"\nko = \"10 N/m\"\nmu_o = 0.05\n";

/// The springs and limits of the three resistances at a constant normal force of 2 mN.
#[test]
fn shear_roll_and_twist_stretch_their_own_springs_and_no_other() {
    let still = ["0 m", "0 m", "0 m", "0 m"];
    let moved = ["0 m", "0 m", "50 um", "-50 um"];
    for (bodies, a12) in [
        ("bodies = \"wall\"\nradius = \"1 mm\"", 2e-3),
        ("bodies = \"pair\"\nradius = [\"1 mm\", \"3 mm\"]", 1.5e-3),
    ] {
        for convention in [
            "",
            "[contact.conventions]\nlever_arm = \"radius\"\n",
            "[contact.conventions]\nspring_rotation = \"twist\"\n",
        ] {
            for motion in 0..3 {
                let path = |key: usize| format!("{:?}", if key == motion { moved } else { still });
                let keys = format!(
                    "{bodies}\noverlap = [\"0 m\", \"20 um\", \"20 um\", \"20 um\"]\nshear = {}\nroll = {}\ntwist = {}",
                    path(0),
                    path(1),
                    path(2)
                );
                for sample in samples(&keys, &format!("{RESISTANCE}{convention}")) {
                    let got = [sample.shear_force, sample.roll_torque / a12, sample.twist_torque / a12];
                    for (number, (stiffness, coefficient)) in
                        [(30.0, 0.4), (20.0, 0.1), (10.0, 0.05)].into_iter().enumerate()
                    {
                        let arc = [sample.shear, sample.roll, sample.twist][number];
                        let limit: f64 = coefficient * 2e-3;
                        let force = if number != motion || sample.leg <= 1.0 {
                            0.0
                        } else if sample.leg <= 2.0 {
                            (stiffness * arc).min(limit)
                        } else {
                            // Back from the limit, or from the end of the spring.
                            let turned = (stiffness * 50e-6).min(limit);
                            (turned - stiffness * (50e-6 - arc)).max(-limit)
                        };
                        // Sums over 200 steps.
                        assert!(
                            near(got[number], force, limit, 1e-11),
                            "{number}, {motion}: {sample:?}: {force}"
                        );
                    }
                }
            }
        }
    }
}

/// Work done along a path is stored or dissipated; the trapezoidal rule of the work errs by the square of the step,
/// where a force jumps by the step.
#[test]
fn work_along_a_path_is_stored_or_dissipated() {
    let friction = "[contact.sliding]\nlaw = \"mindlin\"\neffective_shear_modulus = \"0.3 MPa\"\nmu = 0.3\n\
        [contact.rolling]\nlaw = \"spring-slider\"\nkr = \"20 N/m\"\nmu_r = 0.1\n\
        [contact.torsion]\nlaw = \"spring-slider\"\nko = \"10 N/m\"\nmu_o = 0.05\n";
    let linear_friction = friction.replace(
        "law = \"mindlin\"\neffective_shear_modulus = \"0.3 MPa\"",
        "law = \"spring-slider\"\nkt = \"60 N/m\"",
    );
    let luding = "[contact.normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"100 N/m\"\nphi_f = 0.05\n";
    let contacts = [
        (format!("[contact.normal]\nlaw = \"hertz\"\neffective_modulus = \"1 MPa\"\n{friction}"), 3.0),
        (
            format!(
                "[contact.normal]\nlaw = \"jkr\"\neffective_modulus = \"1 MPa\"\nwork_of_adhesion = \"0.1 N/m\"\n{friction}"
            ),
            3.0,
        ),
        (format!("{luding}{linear_friction}"), 3.0),
        (
            format!(
                "{luding}{linear_friction}[contact.noncontact]\nlaw = \"reversible\"\nf_a = \"0.2 mN\"\nkc_a = \"100 N/m\"\n"
            ),
            3.0,
        ),
        (
            format!(
                "{luding}{linear_friction}[contact.noncontact]\nlaw = \"jump-in\"\nf_a = \"0.2 mN\"\nkc_a = \"100 N/m\"\n"
            ),
            1.5,
        ),
        (
            format!(
                "{luding}{linear_friction}[contact.viscosity]\nlaw = \"constant\"\ngamma_0 = \"0.01 kg/s\"\n"
            ),
            1.5,
        ),
        (
            format!(
                "[contact.normal]\nlaw = \"walton-johnson\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\"\nf_0 = \"0.2 mN\"\nkappa = 0.5\nk_tail = \"100 N/m\"\n{linear_friction}"
            ),
            1.5,
        ),
    ];
    for (contact, order) in contacts {
        let error = |points: u32| {
            let keys = format!(
                "{LOOP}\nshear = [\"0 m\", \"0 m\", \"9 um\", \"-11 um\", \"2 um\"]\nroll = [\"0 m\", \"3 um\", \"9 um\", \"-4 um\", \"2 um\"]\n\
                 twist = [\"0 m\", \"8 um\", \"9 um\", \"-4 um\", \"1 um\"]\nspeed = \"1 mm/s\"\npoints = {points}"
            );
            let samples = samples(&keys, &contact);
            let scale = samples.iter().map(|sample| sample.work).fold(0.0, f64::max);
            let balance = |sample: &ProbeSample| sample.work - sample.stored_energy - sample.dissipated;
            let worst = samples.iter().map(|sample| (balance(sample) / scale).abs()).fold(0.0, f64::max);
            assert!(scale > 1e-10 && samples.iter().all(|sample| balance(sample).is_finite()));
            worst
        };
        // The part of a step in which something sets in scatters: errors are means over step lengths.
        let mean = |points: u32| (0..6).map(|more| error(points + more * points / 40)).sum::<f64>() / 6.0;
        let (coarse, fine) = (mean(400), mean(1600));
        assert!(fine < 2e-3, "{contact}: {fine}");
        // Four times the points: 16 or 4 times less, and what the scatter leaves of it.
        assert!(coarse / fine > order || coarse < 1e-9, "{contact}: {coarse} to {fine}");
    }
}

/// Laws say whether they depend on time; those that do not give the same forces at any speed.
#[test]
fn contacts_that_do_not_depend_on_time_do_not() {
    let mut checked = 0;
    for entry in Normal::ENTRIES {
        let run = |speed: &str| {
            let keys = format!("{LOOP}\nspeed = \"{speed}\"");
            let quantities = entry.particle_quantities.iter();
            let quantities = quantities.map(|of| format!("{} = \"1e-6 {}\"\n", of.name, of.unit()));
            let text = format!(
                "temperature = \"300 K\"\n[probe]\ndensity = \"2000 kg/m^3\"\n{keys}\n{}[contact.normal]\n{}\n",
                quantities.collect::<String>(),
                entry.example
            );
            let document = Document::from_str(entry.name, &text).unwrap();
            let scenario =
                ProbeScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
            let timed = scenario.contacts[0].contact.model.depends_on_time(&scenario.bodies.pair());
            (timed, probe(&scenario).unwrap().remove(0).samples)
        };
        let ((timed, slow), (_, fast)) = (run("1 nm/h"), run("1 km/s"));
        if timed {
            continue;
        }
        checked += 1;
        let scale = slow.iter().map(|sample| sample.force.abs()).fold(0.0, f64::max);
        for (slow, fast) in slow.iter().zip(&fast) {
            // The growth of the overlap is a rate times a time.
            assert!(near(slow.force, fast.force, scale, 1e-9), "{}: {slow:?} {fast:?}", entry.name);
        }
    }
    assert!(checked >= 4, "{checked}");
}
