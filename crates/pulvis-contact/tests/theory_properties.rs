//! What must hold for every parameter set: bounds, continuity, and agreement between formulas found on
//! different ways.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use proptest::prelude::*;
use pulvis_contact::theory::{
    Interpolation, LinearSpringDashpot, LudingPair, LudingParameters, NonContact, Regime, Stage, TheoryError,
    dimensionless, sticking,
};

const INTERPOLATIONS: [Interpolation; 3] =
    [Interpolation::Linear, Interpolation::SquareRoot, Interpolation::Constant];

/// A number between `10^low` and `10^high`, all magnitudes alike.
fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|exponent| 10_f64.powf(exponent))
}

/// Pairs without adhesive force: `eta` and `beta` over many magnitudes, their zeros included.
fn plain_parameters() -> impl Strategy<Value = LudingParameters> {
    let eta = prop_oneof![1 => Just(0.0), 9 => magnitude(-6.0, 3.0)];
    let beta = prop_oneof![1 => Just(0.0), 9 => magnitude(-4.0, 3.0)];
    let scales = (magnitude(0.0, 5.0), magnitude(-9.0, -0.5), magnitude(-9.0, 0.0), magnitude(-6.0, -1.0));
    (eta, beta, scales, 0..3_usize).prop_map(|(eta, beta, (k1, phi_f, mass, radius), interpolation)| {
        LudingParameters::new(k1, k1 * (1.0 + eta), k1 * beta, phi_f, mass, radius)
            .with_interpolation(INTERPOLATIONS[interpolation])
    })
}

/// Pairs with an adhesive force: `k1 phi_f a12` times a small number, zero range or not, reversible or
/// jump-in.
fn adhesive_parameters() -> impl Strategy<Value = LudingParameters> {
    let range = prop_oneof![Just(f64::INFINITY), magnitude(-2.0, 2.0)];
    (plain_parameters(), magnitude(-6.0, 0.5), range, any::<bool>()).prop_map(
        |(p, force, range, reversible)| {
            let rule = if reversible { NonContact::Reversible } else { NonContact::JumpIn };
            p.with_adhesion(rule, force * p.k1 * p.phi_f * p.harmonic_radius, range * p.k1)
        },
    )
}

/// A velocity that suits the pair: `v_p0` where there is one, else that of the overlap `phi_f a12`.
fn velocity_scale(pair: &LudingPair) -> f64 {
    let p = pair.parameters();
    if pair.dp().is_finite() {
        pair.v_p0()
    } else {
        (p.k1 / p.reduced_mass).sqrt() * pair.limit_force_free_overlap()
    }
}

proptest! {
    #[test]
    fn no_collision_creates_energy(p in adhesive_parameters(), relative in magnitude(-8.0, 8.0)) {
        let pair = LudingPair::new(p).unwrap();
        let velocity = relative * velocity_scale(&pair);
        let result = pair.restitution(velocity);
        prop_assert!((0.0..=1.0).contains(&result.value), "{result:?}");
        prop_assert!(result.energy_dissipated >= -1e-12 * p.reduced_mass * velocity * velocity, "{result:?}");
        prop_assert!(result.overlap_max.is_finite() && result.overlap_max >= result.history * (1.0 - 1e-15));
        prop_assert!(result.pull_in >= 1.0 && result.pull_off <= 1.0);
        if result.regime == Regime::Rebound {
            let kinetic = 0.5 * p.reduced_mass * velocity * velocity;
            let balance = kinetic * (1.0 - result.value * result.value) - result.energy_dissipated;
            prop_assert!(balance.abs() <= 1e-13 * kinetic, "{result:?}");
        }
    }

    #[test]
    fn the_coefficients_of_the_three_stages_multiply_to_the_whole(
        p in adhesive_parameters(), relative in magnitude(-3.0, 3.0),
    ) {
        let result = LudingPair::new(p).map(|pair| pair.restitution(relative * velocity_scale(&pair))).unwrap();
        let product = result.pull_in * result.contact * result.pull_off;
        // Squares of the factors carry the round-off of pull_in^2; the root divides by the small product.
        let round_off = 1e-14 * result.pull_in * result.pull_in / product.max(1e-7);
        prop_assert!((product - result.value).abs() <= 1e-13 + round_off, "{result:?}");
    }

    #[test]
    fn the_restitution_is_continuous_across_the_plastic_limit(p in adhesive_parameters(), force in 0.0..0.4_f64) {
        // Pairs that have a limit, and reach it not by adhesion alone.
        let interpolation =
            if p.interpolation == Interpolation::Constant { Interpolation::Linear } else { p.interpolation };
        let kp = p.kp.max(1.000_1 * p.k1);
        let p = LudingParameters { interpolation, kp, ..p };
        let dp = LudingPair::new(p).unwrap().dp();
        let p = LudingParameters { adhesion_force: force * p.k1 * dp, ..p };
        let pair = LudingPair::new(p).unwrap();
        let limit = pair.v_p();
        prop_assert!(limit.is_some());
        let outside = |touch: f64| match p.noncontact {
            NonContact::Reversible => (touch * touch - pair.v_fa().powi(2)).sqrt(),
            _ => touch,
        };
        let (below, above) = (outside(limit.unwrap() * (1.0 - 1e-11)), outside(limit.unwrap() * (1.0 + 1e-11)));
        // Slower than that, the whole collision is the adhesive well and e^2 has no finite slope in it.
        if below < 0.01 * limit.unwrap() {
            return Ok(());
        }
        let (before, after) = (pair.restitution(below), pair.restitution(above));
        // e^2 is continuous and changes by its slope times the step: slopes stay below 1e4 for below >
        // v_p/100.
        prop_assert!((before.value.powi(2) - after.value.powi(2)).abs() < 1e-6, "{before:?} {after:?}");
        prop_assert!((before.overlap_max / after.overlap_max - 1.0).abs() < 1e-6, "{before:?} {after:?}");
    }

    #[test]
    fn the_pair_sticks_exactly_between_its_critical_velocities(p in adhesive_parameters()) {
        let pair = LudingPair::new(p).unwrap();
        let critical = pair.critical_velocities();
        let close = 1e-7;
        for threshold in [critical.low_end, critical.high_onset, critical.high_end].into_iter().flatten() {
            if !(threshold.is_finite() && threshold > 0.0) {
                continue;
            }
            for velocity in [threshold * (1.0 - close), threshold * (1.0 + close)] {
                let sticks = pair.restitution(velocity).regime != Regime::Rebound;
                // Nearly merged ranges may be narrower than the step; `sticks` knows both ends.
                prop_assert_eq!(critical.sticks(velocity), sticks, "{:?} at {}", critical, velocity);
            }
        }
        for relative in [1e-6, 1e-3, 0.1, 0.5, 0.99, 1.01, 2.0, 30.0, 1e4] {
            let velocity = relative * velocity_scale(&pair);
            let sticks = pair.restitution(velocity).regime != Regime::Rebound;
            prop_assert_eq!(critical.sticks(velocity), sticks, "{:?} at {}", critical, velocity);
        }
    }

    #[test]
    fn a_vanishing_adhesive_force_leaves_the_plain_pair(
        p in plain_parameters(), relative in magnitude(-2.0, 2.0), reversible in any::<bool>(),
    ) {
        let plain = LudingPair::new(p).unwrap();
        let velocity = relative * velocity_scale(&plain);
        let rule = if reversible { NonContact::Reversible } else { NonContact::JumpIn };
        let force = 1e-12 * p.k1 * p.phi_f * p.harmonic_radius;
        let weak = LudingPair::new(p.with_adhesion(rule, force, p.k1)).unwrap();
        let (without, with) = (plain.restitution(velocity), weak.restitution(velocity));
        // E_f shifts by f_a D, a share 2e-12/relative of E_i (and eta times that above the limit), seen in
        // e^2.
        prop_assert!((without.value.powi(2) - with.value.powi(2)).abs() < 1e-8, "{without:?} {with:?}");
        prop_assert!((without.overlap_max / with.overlap_max - 1.0).abs() < 1e-8);
        let zero = LudingPair::new(p.with_adhesion(rule, 0.0, p.k1)).unwrap();
        prop_assert_eq!(zero.restitution(velocity), without);
        prop_assert_eq!(zero.critical_velocities(), plain.critical_velocities());
    }

    #[test]
    fn the_printed_formulas_agree_with_the_pair(p in plain_parameters(), chi in magnitude(-3.0, 2.0)) {
        // A pair with kp = k1 has no chi; the softest that has one takes its place.
        let p = LudingParameters { kp: p.kp.max(1.000_1 * p.k1), interpolation: Interpolation::Linear, ..p };
        let pair = LudingPair::new(p).unwrap();
        let (eta, beta) = (pair.eta(), pair.beta());
        let result = pair.restitution(chi * pair.v_p0());
        let printed = dimensionless::restitution(eta, beta, chi);
        prop_assert!((result.value.powi(2) - printed * printed).abs() < 1e-12, "{result:?} {printed}");
        let overlap = sticking::sticking_overlap(eta, beta, chi);
        if let (Some(overlap), Regime::Stick(stage)) = (overlap, result.regime) {
            // The stop is the root of an energy: round-off 1e-15 of it is 3e-8 of the overlap next to the
            // threshold.
            let error = overlap.powi(2) - (result.overlap_end / pair.dp()).powi(2);
            prop_assert!(error.abs() < 1e-12 * (1.0 + chi * chi * (1.0 + 1.0 / beta)), "{overlap} {result:?}");
            prop_assert!(stage != Stage::NonContact);
        }
        if let Some((onset, end)) = sticking::sticking_interval(eta, beta) {
            let critical = pair.critical_velocities();
            prop_assert!((critical.high_onset.unwrap() / pair.v_p0() / onset - 1.0).abs() < 1e-12);
            prop_assert!((critical.high_end.unwrap() / pair.v_p0() / end - 1.0).abs() < 1e-12);
            prop_assert!(beta >= sticking::critical_adhesivity(eta).unwrap() * (1.0 - 1e-14));
        }
    }

    #[test]
    fn the_history_on_the_tensile_branch_inverts_the_tensile_extremum(
        p in plain_parameters(), scaled in magnitude(-9.0, 0.0),
    ) {
        let pair = LudingPair::new(p).unwrap();
        let overlap_scale = if pair.dp().is_finite() { pair.dp() } else { pair.limit_force_free_overlap() };
        let history = scaled * overlap_scale;
        match pair.history_on_tensile_branch(pair.delta_min(history)) {
            // y -> X is monotone and its inverse well conditioned; some ten roundings.
            Some(found) => prop_assert!((found / history - 1.0).abs() < 1e-12, "{found} {history}"),
            None => prop_assert_eq!(pair.eta(), 0.0),
        }
    }

    #[test]
    fn the_motion_by_forces_loses_the_energy_that_the_balance_says(
        p in adhesive_parameters(), relative in magnitude(-2.0, 1.0),
    ) {
        let pair = LudingPair::new(p).unwrap();
        let velocity = relative * velocity_scale(&pair);
        let result = pair.restitution(velocity);
        let touch = pair.touch_velocity(velocity);
        let motion = pair.trajectory(touch);
        let end = if motion.end().is_finite() {
            motion.end()
        } else {
            20.0 * (p.reduced_mass / p.k1).sqrt()
        };
        let f_a = p.adhesion_force;
        let scale = 0.5 * p.reduced_mass * touch * touch + f_a * pair.overlap_max(touch);
        let (mut last, samples) = (f64::INFINITY, 200);
        for sample in 0..=samples {
            let state = motion.at(end * (f64::from(sample) / f64::from(samples))).unwrap();
            // What remains if the pair unloaded from here: it may only fall.
            let remaining = state.kinetic_energy + state.available_energy - f_a * state.overlap;
            prop_assert!(remaining <= last + 1e-9 * scale, "{state:?}");
            last = remaining;
        }
        // The phases know forces and times only; that their ends fit the energies of the restitution is a
        // check of both.
        let touch_loss = if p.noncontact == NonContact::JumpIn { pair.noncontact_energy() } else { 0.0 };
        let stuck = matches!(result.regime, Regime::Stick(Stage::Unloading | Stage::Tensile));
        if stuck == motion.end().is_infinite() {
            prop_assert_eq!(pair.stuck_oscillation(velocity).is_some(), stuck);
            // A weak tensile branch may take hundreds of units of time; by then the pair swings.
            let late = motion.end().min(1e6 * (p.reduced_mass / p.k1).sqrt());
            let state = motion.at(late).unwrap();
            let remaining = state.kinetic_energy + state.available_energy - f_a * state.overlap;
            let lost = 0.5 * p.reduced_mass * touch * touch - remaining + touch_loss;
            prop_assert!((lost - result.energy_dissipated).abs() < 1e-9 * scale, "{lost} {result:?}");
        } else if stuck {
            // The force f_a pulls the swing back into plastic loading; the known motion ends where that begins.
            let state = motion.at(motion.end()).unwrap();
            prop_assert!((state.overlap / state.history - 1.0).abs() < 1e-7, "{state:?}");
            prop_assert!(pair.stuck_oscillation(velocity).is_none());
        }
        let balance = pair.contact_duration(touch);
        if let Some(duration) = balance {
            prop_assert!((duration / motion.end() - 1.0).abs() < 1e-12);
            let state = motion.at(motion.end()).unwrap();
            prop_assert!(state.overlap.abs() < 1e-7 * pair.overlap_max(touch), "{state:?}");
        }
    }

    #[test]
    fn the_linear_spring_dashpot_is_inverted_by_its_inverses(
        restitution in 0.01..1.0_f64, stiffness in magnitude(0.0, 6.0), mass in magnitude(-9.0, 0.0),
    ) {
        let pair = LinearSpringDashpot::from_restitution(restitution, stiffness, mass).unwrap();
        prop_assert!((pair.restitution() / restitution - 1.0).abs() < 1e-13);
        prop_assert!(pair.restitution_to_zero_force() >= pair.restitution());
        let again = LinearSpringDashpot::from_duration(pair.contact_duration(), restitution, mass).unwrap();
        prop_assert!((again.stiffness() / stiffness - 1.0).abs() < 1e-13);
    }
}

/// A small-step integration of the loading part with `f_a`, then of the whole, on nothing but the straight
/// lines.
#[test]
fn the_duration_with_adhesive_force_agrees_with_a_small_step_integration() {
    let base = LudingParameters::new(1e2, 5e2, 1e2, 0.1, 5.575e-6, 1.1e-3);
    for (force, kc, relative) in [(1e-4, 1e2, 0.2), (1e-3, 0.0, 0.3), (1e-4, 50.0, 1.6), (0.0, 1e2, 0.3)] {
        let p = LudingParameters { kc, ..base }.with_adhesion(NonContact::JumpIn, force, f64::INFINITY);
        let pair = LudingPair::new(p).unwrap();
        let touch = relative * pair.v_p0();
        let duration = pair.contact_duration(touch).unwrap();
        let steps = 200_000.0;
        let dt = duration / steps;
        let (mut overlap, mut velocity, mut history, mut time) = (0.0, touch, 0.0_f64, 0.0);
        let mut acceleration = force / p.reduced_mass;
        loop {
            let last = overlap;
            velocity += 0.5 * dt * acceleration;
            overlap += dt * velocity;
            if overlap <= 0.0 {
                time += dt * last / (last - overlap);
                break;
            }
            history = history.max(overlap.min(pair.dp()));
            let elastic = pair.k2(history) * (overlap - pair.delta_0(history));
            let total = elastic.max(-p.kc * overlap) - force;
            acceleration = -total / p.reduced_mass;
            velocity += 0.5 * dt * acceleration;
            time += dt;
        }
        // Second order in the step with corners of the force: (w dt)^2 of about 1e-9, and the linear last
        // step.
        assert!((time / duration - 1.0).abs() < 1e-7, "{time} {duration} for {p:?}");
    }
}

#[test]
fn elastic_pairs_return_everything_at_any_velocity() {
    for interpolation in INTERPOLATIONS {
        let p =
            LudingParameters::new(1e2, 1e2, 1e2, 0.05, 5.575e-6, 1.1e-3).with_interpolation(interpolation);
        let pair = LudingPair::new(p).unwrap();
        assert_eq!(pair.dp(), f64::INFINITY);
        for velocity in [0.0, 1e-200, 1e-9, 1.0, 1e100] {
            assert_eq!(pair.restitution(velocity).value, 1.0);
        }
        let half_period = std::f64::consts::PI * (5.575e-6_f64 / 1e2).sqrt();
        assert!((pair.contact_duration(1.0).unwrap() / half_period - 1.0).abs() < 1e-15);
    }
}

#[test]
fn extreme_velocities_and_depths_have_their_limits() {
    let p = LudingParameters::new(1e2, 5e2, 1e2, 0.05, 5.575e-6, 1.1e-3);
    let pair = LudingPair::new(p).unwrap();
    assert_eq!(pair.restitution(0.0).value, 1.0);
    assert_eq!(pair.restitution(1e-200).value, 1.0);
    assert_eq!(pair.restitution(1e100).value, 1.0);
    // Nearly no plastic depth: everything is on the limit branch, elastic with kp.
    let shallow = LudingPair::new(LudingParameters { phi_f: 1e-30, ..p }).unwrap();
    let stiff = (5.575e-6_f64 / 5e2).sqrt();
    assert!((shallow.overlap_max(1.0) / stiff - 1.0).abs() < 1e-14);
    assert_eq!(shallow.restitution(1.0).value, 1.0);
    // Walton and Braun: e = sqrt(k1/kp) at every velocity, 0 and underflowing ones included.
    let walton =
        LudingPair::new(LudingParameters { kc: 0.0, ..p.with_interpolation(Interpolation::Constant) });
    for velocity in [0.0, 1e-200, 0.1, 1e100] {
        assert!((walton.unwrap().restitution(velocity).value - 0.2_f64.sqrt()).abs() < 1e-15);
    }
}

#[test]
fn a_pair_carried_to_the_limit_by_adhesion_alone_has_no_limit_velocity() {
    // 2 f_a > k1 dp: S1 (19) would be the root of a negative number; (23e) still holds.
    let p = LudingParameters::new(1e2, 5e2, 0.0, 0.05, 5.575e-6, 1.1e-3);
    let force = 0.6 * 1e2 * LudingPair::new(p).unwrap().dp();
    let pair = LudingPair::new(p.with_adhesion(NonContact::JumpIn, force, f64::INFINITY)).unwrap();
    assert_eq!((pair.v_p(), pair.zeta(1.0)), (None, None));
    let critical = pair.critical_velocities();
    assert_eq!((critical.low_end, critical.high_onset), (None, None));
    assert!(pair.restitution(1e-6).history >= pair.dp());
    let squared = dimensionless::restitution_squared_limit(4.0, 0.0, 2.0);
    assert!((pair.restitution(2.0 * pair.v_p0()).value - squared.sqrt()).abs() < 1e-14);
}

#[test]
fn senseless_parameters_are_refused_with_their_name() {
    let p = LudingParameters::new(1e2, 5e2, 1e2, 0.05, 5.575e-6, 1.1e-3);
    let refusal = |p: LudingParameters| LudingPair::new(p).unwrap_err();
    assert_eq!(
        refusal(LudingParameters { kp: 50.0, ..p }),
        TheoryError::SofterUnloading { k1: 1e2, kp: 50.0 }
    );
    assert_eq!(
        refusal(LudingParameters { kc: -1.0, ..p }),
        TheoryError::Negative { name: "kc", value: -1.0 }
    );
    let force = LudingParameters { adhesion_force: 1e-6, ..p };
    assert_eq!(refusal(force), TheoryError::AdhesionWithoutRule { adhesion_force: 1e-6 });
    assert!(matches!(
        refusal(LudingParameters { k1: f64::NAN, ..p }),
        TheoryError::NotPositive { name: "k1", .. }
    ));
    assert!(LudingPair::new(p.with_adhesion(NonContact::JumpIn, 1e-6, 0.0)).is_err());
}

#[test]
fn the_printed_sticking_overlaps_agree_with_the_pair_on_both_branches() {
    let (mut tensile, mut unloading) = (0, 0);
    for eta in [1.5, 2.0, 4.0, 8.0, 50.0] {
        for beta in (1..80).map(|step| 0.05 * f64::from(step)) {
            let p = LudingParameters::new(1e2, 1e2 * (1.0 + eta), 1e2 * beta, 0.05, 5.575e-6, 1.1e-3);
            let pair = LudingPair::new(p).unwrap();
            for chi in (1..60).map(|step| 0.031 * f64::from(step)) {
                let result = pair.restitution(chi * pair.v_p0());
                let Some(overlap) = sticking::sticking_overlap(eta, beta, chi) else {
                    assert_eq!(result.regime, Regime::Rebound);
                    continue;
                };
                let on_tensile = sticking::stops_on_tensile_branch(eta, beta, chi);
                assert_eq!(result.regime == Regime::Stick(Stage::Tensile), on_tensile, "{eta} {beta} {chi}");
                let found = result.overlap_end / pair.dp();
                assert!((overlap - found).abs() < 1e-12, "{eta} {beta} {chi}: {overlap} {found}");
                *(if on_tensile { &mut tensile } else { &mut unloading }) += 1;
            }
        }
    }
    assert!(tensile > 1000 && unloading > 1000, "both branches are visited: {tensile} {unloading}");
}
