//! The closed forms against numbers printed to ten or more digits in the specification, and against the
//! papers' limits.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::theory::{
    Interpolation, LinearSpringDashpot, LudingPair, LudingParameters, NonContact, Regime, Stage, TheoryError,
    asymptotes, dimensionless, sticking, tuning,
};

/// Radius 1.1 mm, density 2000 kg/m3: the reference pair of both papers.
const REDUCED_MASS: f64 = 5.575_279_762_570_687_5e-6;
const RADIUS: f64 = 1.1e-3;

fn parameters(phi_f: f64) -> LudingParameters {
    LudingParameters::new(1e2, 5e2, 1e2, phi_f, REDUCED_MASS, RADIUS)
}

fn reference_pair() -> LudingPair {
    LudingPair::new(parameters(0.05)).unwrap()
}

fn adhesive_pair(phi_f: f64, noncontact: NonContact, force: f64, stiffness: f64) -> LudingPair {
    LudingPair::new(parameters(phi_f).with_adhesion(noncontact, force, stiffness)).unwrap()
}

/// `printed` carries `digits` significant digits: the last one may be off by one.
#[track_caller]
fn assert_printed(value: f64, printed: f64, digits: i32) {
    let tolerance = 10_f64.powi(1 - digits) * printed.abs();
    assert!((value - printed).abs() <= tolerance, "{value:.16e} is printed as {printed:.16e}");
}

#[test]
fn the_reference_pair_has_the_printed_dimensionless_numbers() {
    let pair = reference_pair();
    assert_printed(pair.dp(), 6.875e-5, 14);
    assert_printed(pair.v_p0(), 0.291_165_135_069_286_54, 15);
    assert_printed(pair.eta(), 4.0, 15);
    assert_printed(pair.beta(), 1.0, 15);
    assert_printed(sticking::chi_onset(4.0, 1.0), 0.5, 15);
    assert_printed(sticking::chi_end(4.0, 1.0), 1.154_700_538_38, 12);
    assert_printed(sticking::critical_adhesivity(4.0).unwrap(), 1.0 / 3.0, 15);
    assert_printed(dimensionless::restitution_squared_plastic(4.0, 1.0, 1.0), -1.0 / 3.0, 15);
}

#[test]
fn the_table_of_the_reference_pair_is_met() {
    let pair = reference_pair();
    let stop = f64::NAN;
    let tensile = Regime::Stick(Stage::Tensile);
    let free = Regime::Rebound;
    let rows = [
        (
            0.1,
            free,
            0.816_496_580_928,
            0.1,
            0.028_571_428_571_4,
            0.016_666_666_666_7,
            stop,
            7.656_468_916_55e-4,
        ),
        (
            0.34,
            free,
            0.436_435_780_472,
            0.34,
            0.195_932_203_390,
            0.137_619_047_619,
            stop,
            8.721_510_187_46e-4,
        ),
        (0.69, tensile, 0.0, 0.69, 0.506_489_361_702, 0.400_084_033_613, 0.275_709_931_607, stop),
        (1.1, tensile, 0.0, 1.086_356_421_27, 0.8, 0.666_666_666_667, 0.351_188_458_428, stop),
        (1.37, free, 0.538_153_093_478, 1.264_090_508_41, 0.8, 0.666_666_666_667, stop, 7.003_937_965_21e-4),
        (2.0, free, 0.816_496_580_928, 1.6, 0.8, 0.666_666_666_667, stop, 5.402_733_509_01e-4),
    ];
    for (chi, regime, e, maximum, force_free, minimum, stop, duration) in rows {
        let velocity = chi * pair.v_p0();
        let result = pair.restitution(velocity);
        let dp = pair.dp();
        assert_eq!(result.regime, regime, "chi = {chi}");
        assert_printed(result.value, e, 11);
        assert_printed(result.overlap_max / dp, maximum, 11);
        assert_printed(pair.delta_0(result.history) / dp, force_free, 11);
        assert_printed(pair.delta_min(result.history) / dp, minimum, 11);
        if regime == tensile {
            assert_printed(result.overlap_end / dp, stop, 11);
            assert_eq!(pair.contact_duration(velocity), None);
        } else {
            assert_eq!(result.overlap_end, 0.0);
            assert_printed(pair.contact_duration(velocity).unwrap(), duration, 11);
        }
    }
}

#[test]
fn the_corrected_energies_of_the_misprinted_equations_are_met() {
    let pair = reference_pair();
    let (dp, p) = (pair.dp(), pair.parameters());
    // S0 (22b): the left side is (k1 dp)^2/(2 kp) plus the kinetic energy at dp.
    let velocity = 1.37 * pair.v_p0();
    let at_dp = 0.5 * REDUCED_MASS * (velocity * velocity - pair.v_p0() * pair.v_p0());
    assert_printed(0.5 * p.k1 * dp * (dp - pair.delta_0(dp)) + at_dp, 2.545_017_6e-7, 8);
    // S0 (31a) and the sticking overlap that follows from it, at chi = 0.69.
    let stuck = pair.restitution(0.69 * pair.v_p0());
    let missing = -0.5
        * p.kc
        * (pair.delta_min(stuck.history) * pair.delta_0(stuck.history) - stuck.overlap_end.powi(2));
    assert_printed(missing, -2.9924e-8, 5);
    assert_printed(pair.pull_off_force(stuck.history), -2.7506e-3, 5);
    assert_printed(tuning::tuned_limit_stiffness(1e2, 5e2, 1.0), 5e2, 14);
}

#[test]
fn the_adhesive_force_shifts_restitution_and_thresholds_as_printed() {
    let rows = [
        (
            1e-5,
            0.812_360_148_820,
            0.458_144_216_256,
            6.508_310_896e-5,
            0.289_042_288_555_2,
            4.322_187_299_865e-4,
        ),
        (
            1e-4,
            0.769_718_578_935,
            0.446_542_582_546,
            2.208_043_574_249e-3,
            0.269_415_165_156_7,
            5.149_414_417_671e-3,
        ),
    ];
    for (force, slow, fast, low_end, onset, low_end_with_range) in rows {
        let pair = adhesive_pair(0.1, NonContact::JumpIn, force, f64::INFINITY);
        let v_p = pair.v_p().unwrap();
        assert_printed(pair.restitution(0.1 * v_p).value, slow, 11);
        assert_printed(pair.restitution(1.3 * v_p).value, fast, 11);
        let critical = pair.critical_velocities();
        assert_printed(critical.low_end.unwrap(), low_end, 10);
        assert_printed(critical.high_onset.unwrap(), onset, 12);
        assert_printed(critical.high_end.unwrap(), 0.672_417_076_443_5, 12);
        let ranged = adhesive_pair(0.1, NonContact::JumpIn, force, 1e2);
        assert_printed(ranged.critical_velocities().low_end.unwrap(), low_end_with_range, 12);
    }
}

#[test]
fn the_critical_zeta_of_the_end_of_sticking_grows_with_the_adhesive_force() {
    // S1 section 4 calls it constant; constant is the velocity, not zeta.
    for (force, printed) in [(0.0, 1.154_701), (1e-5, 1.155_541), (1e-4, 1.163_191)] {
        let pair = adhesive_pair(0.1, NonContact::JumpIn, force, f64::INFINITY);
        let end = pair.critical_velocities().high_end.unwrap();
        assert_printed(end, 0.672_417_076_443_5, 12);
        assert_printed(pair.zeta(end).unwrap(), printed, 7);
    }
}

#[test]
fn the_reversible_attraction_speeds_the_pair_up_and_takes_it_back() {
    let pair = adhesive_pair(0.05, NonContact::Reversible, 1e-4, 50.0);
    let slow = pair.restitution(0.01);
    assert_printed(slow.pull_in, 1.165_644_196_63, 11);
    assert_printed(slow.contact, 0.762_983_011_829, 11);
    assert_printed(slow.pull_off, 0.739_239_226_359, 11);
    assert_printed(slow.value, 0.657_454_765_945, 11);
    let fast = pair.restitution(0.05);
    assert_printed(fast.pull_in, 1.007_148_973_95, 11);
    assert_printed(fast.contact, 0.594_339_502_512, 11);
    assert_printed(fast.pull_off, 0.979_772_066_94, 11);
    assert_printed(fast.value, 0.586_480_213_639, 11);
    for result in [slow, fast] {
        assert_printed(result.pull_in * result.contact * result.pull_off, result.value, 14);
    }
}

#[test]
fn the_jump_in_force_stops_slow_elastic_and_plastic_pairs_as_printed() {
    // S0 Fig. 5: f_a = 5e-7 N, k_c^a = 100 N/m.
    let plastic = adhesive_pair(0.05, NonContact::JumpIn, 5e-7, 1e2);
    assert_printed(plastic.v_fa(), 2.117_565e-5, 7);
    assert_printed(plastic.restitution(2.5e-5).value, 0.528_298_335_972, 11);
    assert_printed(plastic.restitution(1e-4).value, 0.976_002_231_271, 11);
    let elastic = LudingPair::new(LudingParameters { kp: 1e2, kc: 0.0, ..*plastic.parameters() }).unwrap();
    assert_printed(elastic.restitution(2.5e-5).value, 0.531_551_703_704, 11);
    assert_printed(elastic.restitution(1e-4).value, 0.977_322_465_135, 11);
    assert_printed(elastic.critical_velocities().low_end.unwrap(), elastic.v_fa(), 14);
    assert_eq!(elastic.restitution(2e-5).regime, Regime::Stick(Stage::NonContact));
}

#[test]
fn a_stuck_pair_swings_softer_than_it_unloaded() {
    let pair = reference_pair();
    let swing = pair.stuck_oscillation(0.69 * pair.v_p0()).unwrap();
    assert_printed(swing.overlap_lower / pair.dp(), 0.275_709_931_607, 11);
    assert_printed(swing.overlap_upper / pair.dp(), 0.451_565_713_867, 11);
    assert_printed(swing.period, 8.378_192_295_98e-4, 11);
    assert_printed(swing.stiffness / 1e2, 3.135_636_804_92, 11);
    assert!(swing.stiffness < pair.k2(0.69 * pair.dp()));
    assert_printed(sticking::maximum_sticking_overlap(4.0, 1.0).unwrap(), (1.0_f64 / 3.0).sqrt(), 15);
}

#[test]
fn a_strongly_cohesive_pair_stops_before_the_tensile_branch() {
    // S1 (39) gives 0.57735 dp here, which lies beyond the tensile extremum at 0.5 dp.
    let pair = LudingPair::new(LudingParameters { kc: 3e2, ..parameters(0.05) }).unwrap();
    let result = pair.restitution(pair.v_p0() * (1.0 - 1e-15));
    assert_eq!(result.regime, Regime::Stick(Stage::Unloading));
    assert_printed(result.overlap_end / pair.dp(), 0.6, 12);
    assert_printed(sticking::tensile_stop_plastic(4.0, 3.0, 1.0).unwrap(), 0.577_350_269_19, 11);
    assert_printed(sticking::maximum_sticking_overlap(4.0, 3.0).unwrap(), 0.6, 14);
    let swing = pair.stuck_oscillation(0.9 * pair.v_p0()).unwrap();
    assert_printed(swing.overlap_upper, 0.9 * pair.dp(), 12);
}

#[test]
fn the_tuned_pair_keeps_its_soft_contacts() {
    for (ratio, printed) in
        [(2.0, 827.921_561_087_4), (5.0, 1_794.427_190_999_9), (10.0, 3_397.056_274_847_7)]
    {
        assert_printed(tuning::tuned_limit_stiffness(1e2, 5e2, ratio), printed, 14);
    }
    let pair = reference_pair();
    let tuned = pair.tuned(0.5).unwrap();
    for fraction in [1e-6, 0.1, 0.6, 0.999] {
        let overlap = fraction * pair.dp();
        assert_printed(tuned.k2(overlap), pair.k2(overlap), 14);
    }
    assert!(tuned.dp() > 3.0 * pair.dp());
    let walton = LudingPair::new(parameters(0.05).with_interpolation(Interpolation::Constant)).unwrap();
    assert_eq!(walton.tuned(0.5), Err(TheoryError::NotLinearInterpolation));
}

#[test]
fn the_square_root_power_law_needs_the_corrected_sign_of_its_exponent() {
    let squared = dimensionless::restitution_squared_square_root(50.0, 0.0, 1.0);
    assert_printed(squared.sqrt(), 0.140_028_01, 8);
    assert_printed(asymptotes::power_law_square_root(50.0, 1.0), 0.141_421_36, 8);
    // Towards large eta sqrt(chi) the ratio tends to 1 like 1/(2 s).
    let ratio = dimensionless::restitution_squared_square_root(1e6, 0.0, 1.0).sqrt()
        / asymptotes::power_law_square_root(1e6, 1.0);
    assert!((ratio - 1.0).abs() < 1e-6);
}

#[test]
fn the_local_exponent_crosses_a_quarter_and_ends_at_a_half() {
    assert_printed(asymptotes::local_exponent(50.0, 0.0, 0.02), -0.25, 14);
    assert!((asymptotes::local_exponent(1e9, 0.0, 1.0) + 0.5).abs() < 1e-8);
    assert!((asymptotes::local_exponent_square_root(1e9, 0.0, 1.0) + 0.25).abs() < 1e-8);
    // Against a central difference of the exact formula, with cohesion: second order in the step.
    let logarithm = |chi: f64| 0.5 * dimensionless::restitution_squared_plastic(50.0, 0.3, chi).ln();
    let (chi, step) = (0.03_f64, 1e-4_f64);
    let difference = (logarithm(chi * step.exp()) - logarithm(chi * (-step).exp())) / (2.0 * step);
    assert!((difference - asymptotes::local_exponent(50.0, 0.3, chi)).abs() < 1e-6);
}

#[test]
fn the_weak_cohesion_and_walton_braun_forms_agree_with_the_exact_formula() {
    let (eta, beta, chi) = (1e4, 1e-5, 0.5);
    let exact = dimensionless::restitution(eta, beta, chi);
    // Relative error 1/(2 eta chi) and of order beta.
    assert!((asymptotes::weakly_cohesive(eta, beta, chi).unwrap() / exact - 1.0).abs() < 2e-4);
    assert!((asymptotes::power_law(eta, chi) / asymptotes::cohesionless(eta, chi) - 1.0).abs() < 2e-4);
    assert_eq!(asymptotes::weakly_cohesive(50.0, 1.0, 1.0), None);
    let pair = LudingPair::new(LudingParameters { kc: 0.0, ..parameters(0.05) }).unwrap();
    let velocity = 0.3 * pair.v_p0();
    let stiffening = (5e2 - 1e2) / (1e2 * pair.dp());
    let walton = asymptotes::walton_braun(stiffening, (1e2 / REDUCED_MASS).sqrt(), velocity);
    assert_printed(walton, pair.restitution(velocity).value, 14);
}

#[test]
fn the_printed_equations_with_adhesion_agree_with_the_energy_balance() {
    let pair = adhesive_pair(0.1, NonContact::JumpIn, 1e-4, f64::INFINITY);
    for velocity in [3e-3, 0.01, 0.1, 0.25] {
        let (alpha, psi) = (pair.alpha(velocity), pair.psi(velocity));
        assert_printed(dimensionless::scaled_overlap(alpha, psi), pair.scaled_overlap(velocity), 14);
        let printed = dimensionless::restitution_squared_plastic_adhesive(4.0, 1.0, alpha, psi);
        assert_printed(pair.restitution(velocity).value, printed.sqrt(), 11);
    }
    let fast = 1.3 * pair.v_p0();
    let printed = dimensionless::restitution_squared_limit_adhesive(4.0, 1.0, pair.psi(fast));
    assert_printed(pair.restitution(fast).value, printed.sqrt(), 13);
}

#[test]
fn the_linear_spring_dashpot_has_the_printed_duration_restitution_and_overlap() {
    let soft = LinearSpringDashpot::new(100.0, 5e-3, 5.575e-6).unwrap();
    assert_printed(soft.restitution(), 0.715_685_118_636_9, 13);
    assert_printed(soft.contact_duration(), 7.459_684_214_4e-4, 11);
    assert_printed(soft.overlap_max(1.0), 2.020_174_661_2e-4, 11);
    let stiff = LinearSpringDashpot::new(1e4, 0.5, 1e-3).unwrap();
    assert_printed(stiff.restitution(), 0.779_467_329_441_4, 13);
    assert_printed(stiff.contact_duration(), 9.965_780_142_4e-4, 11);
    assert_printed(stiff.overlap_max(1.0), 2.809_471_724_6e-4, 11);
}

#[test]
fn a_linear_contact_that_ends_at_zero_force_rebounds_faster() {
    let soft = LinearSpringDashpot::new(100.0, 5e-3, 5.575e-6).unwrap();
    assert_printed(soft.restitution_to_zero_force(), 0.732_036_890_0, 10);
    assert_printed(soft.duration_to_zero_force(), 6.955_913_453e-4, 10);
    let strong = LinearSpringDashpot::new(100.0, 4e-2, 5.575e-6).unwrap();
    assert_printed(strong.restitution(), 6.693_878_1e-3, 8);
    assert_printed(strong.restitution_to_zero_force(), 0.167_608_820_6, 10);
}

#[test]
fn the_linear_spring_dashpot_can_be_made_from_what_is_measured() {
    let soft = LinearSpringDashpot::from_restitution(0.5, 100.0, 5.575e-6).unwrap();
    assert_printed(soft.damping(), 1.017_434_624_5e-2, 11);
    let stiff = LinearSpringDashpot::from_restitution(0.9, 1e4, 1e-3).unwrap();
    assert_printed(stiff.damping(), 0.211_989_285_62, 11);
    let again =
        LinearSpringDashpot::from_duration(stiff.contact_duration(), stiff.restitution(), 1e-3).unwrap();
    assert_printed(again.stiffness(), 1e4, 13);
    assert_printed(again.damping(), stiff.damping(), 13);
    assert_eq!(
        LinearSpringDashpot::from_restitution(1.5, 1.0, 1.0),
        Err(TheoryError::RestitutionOutOfRange { value: 1.5 })
    );
}

#[test]
fn an_overdamped_linear_pair_never_opens_but_passes_through_zero_force() {
    // Continuous through critical damping, where gamma = 2 sqrt(k m) and e to zero force is exp(-2).
    for factor in [1.0 - 1e-6, 1.0, 1.0 + 1e-6] {
        let pair = LinearSpringDashpot::new(1.0, 2.0 * factor, 1.0).unwrap();
        assert!((pair.restitution_to_zero_force() - (-2.0_f64).exp()).abs() < 1e-5);
    }
    let pair = LinearSpringDashpot::new(1.0, 5.0, 1.0).unwrap();
    assert_eq!((pair.restitution(), pair.contact_duration()), (0.0, f64::INFINITY));
    // Exact solution: rates -1/2 (5 -+ sqrt 21), delta = (exp(r1 t) - exp(r2 t))/(r1 - r2).
    let (r1, r2) = (-0.5 * (5.0 - 21_f64.sqrt()), -0.5 * (5.0 + 21_f64.sqrt()));
    let time = pair.duration_to_zero_force();
    let overlap = ((r1 * time).exp() - (r2 * time).exp()) / (r1 - r2);
    let speed = (r1 * (r1 * time).exp() - r2 * (r2 * time).exp()) / (r1 - r2);
    assert!((overlap + 5.0 * speed).abs() < 1e-14, "the force vanishes");
    assert_printed(pair.restitution_to_zero_force(), -speed, 13);
    assert_printed(pair.overlap_at_zero_force(1.0), overlap, 13);
}
