//! Plastic contacts in straight lines, bare and adhesive, on single pairs: against closed forms and published values.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::catalogue::Values;
use pulvis_contact::normal::{Kempton, Molerus, WaltonBraun};
use pulvis_contact::theory::WaltonBraunPair;
use pulvis_contact::{ContactModel, Luding, Normal, NormalLaw, NormalLawVisitor, NormalMotion, Pair};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::loading::{Loading, assert_printed, built, refused};

/// A wall collision from touch until the force has come back to zero: velocity over that before, and duration [s].
fn rebound(law: &Normal, mass: f64, speed: f64, dt: f64) -> (f64, f64) {
    let radius = 1e-3;
    let mut sphere = Sphere::at_rest(mass, radius, Vector3::new(0.0, 0.0, radius));
    sphere.velocity.z = -speed;
    let mut couple = Couple::new(&ContactModel::frictionless(*law), sphere, None);
    let steps = couple.step_until(dt, 1_000_000, |couple| couple.normal_force == 0.0);
    (couple.i.velocity.z / speed, dt * steps as f64)
}

#[test]
fn walton_and_brauns_springs_rebound_as_their_closed_forms_say() {
    // Published: e, duration [s], k2 [N/m] and force-free overlap [m] at a speed [m/s].
    let constant = |k1, k2, mass| {
        let values = Values::new().with("k1", k1).with("k2", k2);
        (WaltonBraunPair::constant(k1, k2, mass).unwrap(), ("walton-braun", values))
    };
    let variable = |k1, slope, mass| {
        let values = Values::new().with("k1", k1).with("slope", slope);
        (WaltonBraunPair::variable(k1, slope, mass).unwrap(), ("walton-braun-variable", values))
    };
    let cases = [
        (constant(100.0, 400.0, 5.575e-6), 5.575e-6, 0.1, 0.5, 5.563313990019e-4),
        (constant(1e4, 1.5e4, 1e-3), 1e-3, 1.0, 0.816496580927726, 9.023072808872e-4),
        (variable(100.0, 5e4, 5.575e-6), 5.575e-6, 0.1, 0.6771966403347398, 6.220514355458e-4),
        (variable(1e4, 2e3, 1e-3), 1e-3, 1.0, 0.7826711399286465, 8.855051894254e-4),
    ];
    for ((theory, (name, values)), mass, speed, restitution, duration) in cases {
        assert_printed(theory.restitution(speed), restitution, 13);
        assert_printed(theory.contact_duration(speed), duration, 13);
        let law = Normal::build(name, &values).unwrap().unwrap();
        let (found, time) = rebound(&law, mass, speed, duration / 4000.3);
        // Second order, kinks where branches meet: (ω dt)²/24 = 1e-7 and the step of the kink.
        assert!((found - restitution).abs() < 1e-6, "{name}: {found}, expected {restitution}");
        // To within one of the 4000 steps.
        assert!((time / duration - 1.0).abs() < 3e-4, "{name}: {time}, expected {duration}");
    }
    let stiffening = WaltonBraunPair::variable(100.0, 5e4, 5.575e-6).unwrap();
    assert_printed(stiffening.unloading_stiffness(0.1), 218.05718953117594, 14);
    let latching = WaltonBraunPair::constant(100.0, 400.0, 5.575e-6).unwrap();
    assert_printed(latching.force_free_overlap(0.1), 1.7708578429676394e-5, 14);
    assert_printed(latching.overlap_max(0.1), 2.361143790623519e-5, 14);
    assert!(WaltonBraunPair::constant(100.0, 99.0, 1.0).is_err());
    assert!(WaltonBraunPair::variable(100.0, -1.0, 1.0).is_err());
}

#[test]
fn a_contact_of_walton_and_braun_remembers_its_largest_overlap_until_the_bodies_part() {
    let values = Values::new().with("k1", 100.0).with("k2", 400.0);
    let mut contact = Loading::<WaltonBraun>::new(built("walton-braun", &values), Pair::wall(1e-6, 1e-3));
    assert!((contact.go(4e-6).force / 4e-4 - 1.0).abs() < 1e-15);
    // Force-free at 3 µm; below it nothing, and re-loading follows k2.
    assert_eq!(contact.go(1e-6).force, 0.0);
    // But for round-off of forces of 1e-3 N.
    assert!(contact.go(3e-6).force.abs() < 1e-18);
    assert!((contact.go(3.5e-6).force / 2e-4 - 1.0).abs() < 1e-14);
    assert!((contact.go(8e-6).force / 8e-4 - 1.0).abs() < 1e-15);
    contact.go(0.0);
    assert!((contact.go(1e-6).force / 1e-4 - 1.0).abs() < 1e-15, "parted bodies have forgotten");
}

#[test]
fn the_pull_off_force_after_molerus_grows_with_the_load() {
    // F_H0, F_N, p_vdw, p_f and F_H.
    let cases = [([1e-9, 1e-7, 3e7, 3e8], 1.11e-8), ([5e-9, 2e-6, 5e7, 4e8], 2.55625e-7)];
    for ([f_h0, load, vdw, yields], pull_off) in cases {
        let values = Values::new().with("k1", 10.0).with("k2", 40.0).with("f_h0", f_h0);
        let law: Molerus = built("molerus", &values.with("vdw_pressure", vdw).with("yield_pressure", yields));
        let mut contact = Loading::new(law, Pair::wall(1e-14, 1e-6));
        let overlap_max = (load + f_h0) / 10.0;
        assert!((contact.go(overlap_max).force / load - 1.0).abs() < 1e-14);
        for overlap in [0.5, 0.3, 0.01] {
            let force = contact.go(overlap * overlap_max).force;
            assert!((force / -pull_off - 1.0).abs() < 1e-13, "{force}, expected {pull_off}");
        }
        // Re-loaded to less, it pulls as after the largest load.
        contact.go(0.9 * overlap_max);
        assert!((contact.go(0.02 * overlap_max).force / -pull_off - 1.0).abs() < 1e-13);
        let work_before = contact.lost;
        let apart = contact.go(-1e-12);
        assert_eq!((apart.force, apart.stored_energy, apart.adhesive_potential), (0.0, 0.0, 0.0));
        assert!(contact.lost > work_before, "what was stored is lost");
    }
    let values = Values::new().with("k1", 10.0).with("k2", 10.9).with("f_h0", 0.0);
    let values = values.with("vdw_pressure", 3e7).with("yield_pressure", 3e8);
    assert!(refused("molerus", &values).contains("at least (1 + vdw_pressure/yield_pressure) k1 = 11 N/m"));
}

#[test]
fn the_attraction_after_kempton_acts_over_the_area_in_which_the_spheres_intersect() {
    let density = 1e6;
    let values = Values::new().with("k1", 1e-3).with("k2", 1e-3).with("cohesion_density", density);
    let law: Kempton = built("kempton", &values);
    let area = |radius_i: f64, radius_j: f64, overlap: f64| {
        let pair = match radius_j {
            0.0 => Pair::wall(1e-6, radius_i),
            _ => Pair::spheres(1e-6, 1e-6, radius_i, radius_j),
        };
        let motion = NormalMotion::at_rest(&pair, overlap).between(radius_i, radius_j);
        let answer = law.respond(&motion, &mut [0.0]);
        (answer.friction_reference - answer.force) / density
    };
    // R_i, R_j [m] at δ = 1e-5 m and the area [m²].
    let cases = [
        (1e-3, 1e-3, 3.133738671955827e-8),
        (1e-3, 2e-3, 4.178306545070039e-8),
        (1e-3, 0.0, 6.251769380643692e-8),
    ];
    for (radius_i, radius_j, expected) in cases {
        let found = area(radius_i, radius_j, 1e-5);
        // The value itself was computed from differences of lengths, which cancel to 1e-14.
        assert!((found / expected - 1.0).abs() < 1e-13, "{found}, expected {expected}");
        assert!((area(radius_j.max(radius_i), radius_j.min(radius_i), 1e-5) / found - 1.0).abs() < 1e-13);
        // Slight touch: 2 π R δ of the effective radius, to the order δ/R.
        let effective = if radius_j > 0.0 { radius_i * radius_j / (radius_i + radius_j) } else { radius_i };
        let leading = 2.0 * std::f64::consts::PI * effective * 1e-13;
        assert!((area(radius_i, radius_j, 1e-13) / leading - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_tuned_plasticity_depth_moves_the_limit_and_leaves_softer_contacts_alone() {
    let values = Values::new().with("k1", 100.0).with("kp", 500.0).with("kc", 100.0 / 9.0);
    // φ_f, φ_f' and kp' as printed for S1 figure 9.
    for (phi_f, tuned_phi_f, kp) in
        [(0.05, 0.1, 827.9215610874), (0.1, 0.5, 1794.4271909999), (0.05, 0.5, 3397.0562748477)]
    {
        let values = values.clone().with("phi_f", phi_f);
        let plain: Luding = built("luding", &values);
        let tuned: Luding = built("luding", &values.clone().with("tuned_phi_f", tuned_phi_f));
        assert_printed(tuned.kp, kp, 13);
        assert_eq!((tuned.phi_f, tuned.k1, tuned.kc), (tuned_phi_f, plain.k1, plain.kc));
        let pair = Pair::wall(1e-6, 1e-3);
        let limit: f64 = plain.plastic_limit(&pair);
        for share in [0.1, 0.5, 0.99] {
            let forces = [plain, tuned].map(|law| {
                let mut contact = Loading::new(law, pair);
                contact.go(share * limit);
                contact.go(0.8 * share * limit).force
            });
            assert!((forces[0] / forces[1] - 1.0).abs() < 1e-13, "{share}: {forces:?}");
        }
    }
    let error = refused(
        "luding",
        &values.with("phi_f", 0.05).with("tuned_phi_f", 0.5).with_choice("interpolation", "square-root"),
    );
    assert!(error.starts_with("`tuned_phi_f` is given beside another interpolation"), "{error}");
}

#[test]
fn a_cold_contact_that_could_melt_is_one_of_luding() {
    let values = Values::new().with("k1", 100.0).with("kp", 500.0).with("kc", 20.0).with("phi_f", 0.05);
    // Far below the melting point.
    let melting = values.clone().with("t_melt", 1e4).with("t_width", 10.0).with("time_scale", 1.0);
    let pair = Pair::wall(1e-6, 1e-3);
    let luding = Normal::build("luding", &values).unwrap().unwrap();
    for variant in ["passive", "published"] {
        let values = melting.clone().with_choice("variant", variant);
        let cold = Normal::build("sinter-luding", &values).unwrap().unwrap();
        // Loaded, unloaded and loaded again, beyond δ_p = 1.25e-4 m, along the tensile limit until the bodies part, and once
        // more from there. On the tensile limit k2 of Luding falls, that of this law does not.
        let turns = [0.0, 6e-5, 4.5e-5, 7e-5, 6e-5, 9e-5, 2e-4, 1.5e-4, -1e-5, 3e-5, 2e-5];
        let path = |law: &Normal| law.accept(AlongPath { pair, turns: &turns });
        let (expected, found) = (path(&luding), path(&cold));
        let largest = expected.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
        assert!(largest > 0.03, "{largest}");
        for (step, (one, other)) in expected.iter().zip(&found).enumerate() {
            assert!(
                (one - other).abs() < 1e-12 * largest,
                "{variant}, step {step}: {other} N, expected {one} N"
            );
        }
    }
}

/// The forces [N] of a contact along straight ways between overlaps [m].
struct AlongPath<'a> {
    pair: Pair,
    turns: &'a [f64],
}

impl NormalLawVisitor for AlongPath<'_> {
    type Output = Vec<f64>;

    fn visit<N: NormalLaw>(self, law: &N) -> Vec<f64> {
        let mut loading = Loading::new(*law, self.pair);
        let mut forces = Vec::new();
        for legs in self.turns.windows(2) {
            forces.extend(
                (1..=20).map(|step| loading.go(legs[0] + (legs[1] - legs[0]) * f64::from(step) / 20.0).force),
            );
        }
        forces
    }
}
