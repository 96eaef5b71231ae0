//! Closed forms of elastic and adhesive spheres against printed numbers, and against each other.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::theory::hertz::{tsuji_coefficient, tsuji_restitution};
use pulvis_contact::theory::{HertzPair, JkrPair, TheoryError, WaltonJohnsonPair};

/// `printed` carries `digits` significant digits: the last one may be off by one.
#[track_caller]
fn assert_printed(value: f64, printed: f64, digits: i32) {
    let tolerance = 10_f64.powi(1 - digits) * printed.abs();
    assert!((value - printed).abs() <= tolerance, "{value:.16e} is printed as {printed:.16e}");
}

#[test]
fn a_hertz_collision_has_the_printed_overlap_force_and_duration() {
    let cases = [
        ((1e8, 5e-4, 5e-6), 0.5, 1.2239354530e-5, 0.12766196095, 7.2047576918e-5),
        ((2e11, 5e-3, 0.0163362818), 1.0, 1.6362279160e-5, 1248.0139257619, 4.8158690209e-5),
    ];
    for ((modulus, radius, mass), velocity, overlap, force, duration) in cases {
        let pair = HertzPair::new(modulus, radius, mass).unwrap();
        // The second mass is given to nine digits.
        assert_printed(pair.overlap_max(velocity), overlap, 9);
        assert_printed(pair.force_max(velocity), force, 9);
        assert_printed(pair.contact_duration(velocity), duration, 9);
        // All kinetic energy is stored at the largest overlap.
        let kinetic = 0.5 * mass * velocity * velocity;
        assert!((pair.energy(pair.overlap_max(velocity)) / kinetic - 1.0).abs() < 1e-14);
        // δ_max ~ v^(4/5), t_c ~ v^(-1/5): 2^4 and 2^(-1) for a velocity 2^5 times as high.
        assert!((pair.overlap_max(32.0 * velocity) / pair.overlap_max(velocity) - 16.0).abs() < 1e-13);
        let durations = pair.contact_duration(32.0 * velocity) / pair.contact_duration(velocity);
        assert!((durations - 0.5).abs() < 1e-14, "{durations}");
        assert!((pair.contact_radius(overlap) / (radius * overlap).sqrt() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn the_dashpot_of_tsuji_has_the_printed_coefficients_and_restitutions() {
    assert_printed(tsuji_restitution(0.1), 0.8688046288, 10);
    assert_printed(tsuji_restitution(1.0), 0.2078795764, 10);
    assert_printed(tsuji_coefficient(0.5).unwrap(), 0.4817692578, 10);
    assert_printed(tsuji_coefficient(0.9).unwrap(), 0.0749495307, 9);
    for restitution in [1e-6, 0.1, 0.7, 1.0] {
        let back = tsuji_restitution(tsuji_coefficient(restitution).unwrap());
        assert!((back / restitution - 1.0).abs() < 1e-13, "{restitution}: {back}");
    }
    assert_eq!(tsuji_restitution(5.0_f64.sqrt()), 0.0);
    assert_eq!(tsuji_coefficient(0.0), Err(TheoryError::RestitutionOutOfRange { value: 0.0 }));
}

/// Reduced mass of a sphere of 1 µm and 2000 kg/m3 at a wall [kg].
const MASS: f64 = 2000.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-18;

#[test]
fn adhesive_spheres_have_the_printed_forces_distances_and_energies() {
    let soft = JkrPair::new(1e9, 0.1, 1e-6).unwrap();
    assert_printed(soft.pull_off_force(), 4.712388980e-7, 10);
    assert_printed(soft.separation_overlap(), -3.465994308e-9, 10);
    assert_printed(soft.collision_loss(), 1.527967303e-15, 10);
    assert_printed(soft.sticking_velocity(MASS), 0.6039663267, 10);
    assert_printed(soft.restitution(3.0, MASS), 0.9795250934, 10);
    // Along the curve, at radii that the two printed overlaps are inverted to.
    for (overlap, force) in [(2.0993765440e-9, -2.493586709e-7), (8.3975061761e-9, 6.772722067e-7)] {
        assert_printed(soft.force(radius_at(&soft, overlap)), force, 9);
    }
    let hard = JkrPair::new(4e10, 0.05, 5e-4).unwrap();
    assert_printed(hard.pull_off_force(), 1.178097245e-4, 10);
    assert_printed(hard.separation_overlap(), -1.481691725e-9, 10);
    assert_printed(hard.collision_loss(), 1.632992085e-13, 10);
    // The mass is printed to seven digits.
    assert_printed(hard.sticking_velocity(5.235988e-6), 2.497512821e-4, 7);
}

/// The radius of the contact area on the stable branch, by bisection [m].
fn radius_at(pair: &JkrPair, overlap: f64) -> f64 {
    let (mut low, mut high) = (pair.separation_radius(), 1e4 * pair.separation_radius());
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if pair.overlap(middle) < overlap { low = middle } else { high = middle }
    }
    low
}

#[test]
fn the_points_of_the_adhesive_curve_lie_on_it() {
    for (modulus, adhesion, radius) in [(1e9, 0.1, 1e-6), (4e10, 0.05, 5e-4), (3e6, 0.03, 2e-3)] {
        let pair = JkrPair::new(modulus, adhesion, radius).unwrap();
        let close = |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-13, "{one} {other}");
        let pull_off = pair.pull_off_force();
        close(pair.overlap(pair.separation_radius()), pair.separation_overlap());
        close(pair.force(pair.separation_radius()), pair.separation_force());
        // Forces vanish where their two terms, of 6 F_c each, cancel.
        assert!(pair.force(pair.unloaded_radius()).abs() < 1e-13 * pull_off);
        // At δ = 0 the radius is (2 π Γ R²/E*)^(1/3), and the force −(8/9) F_c.
        let touching = (2.0 * std::f64::consts::PI * adhesion * radius * radius / modulus).cbrt();
        close(pair.force(touching), -8.0 / 9.0 * pull_off);
        // The loss is the work of the curve from δ_sep to 0, ∫ F dδ over the radius: Simpson's rule, whose error
        // falls with the fourth power of 1/2000.
        let (from, points) = (pair.separation_radius(), 2000);
        let step = (touching - from) / f64::from(points);
        let mut work = 0.0;
        for point in 0..=points {
            let a = from + step * f64::from(point);
            let slope = 2.0 * a / radius - (std::f64::consts::PI * adhesion / (2.0 * modulus * a)).sqrt();
            let weight = match point {
                0 => 1.0,
                _ if point == points => 1.0,
                odd if odd % 2 == 1 => 4.0,
                _ => 2.0,
            };
            work -= weight * step / 3.0 * pair.force(a) * slope;
        }
        assert!((work / pair.collision_loss() - 1.0).abs() < 1e-11, "{work} {}", pair.collision_loss());
        assert_eq!(pair.restitution(0.999 * pair.sticking_velocity(1.0), 1.0), 0.0);
    }
}

#[test]
fn the_reconstructed_law_of_walton_and_johnson_has_the_printed_numbers() {
    let mass = 5.575e-6;
    let cases = [
        ((1e-4, 0.05, 50.0), 2.180571895e-4, 1.280229167e-5, 0.4804267329),
        ((0.0, 0.2, 400.0), 4.722287581e-4, 1.534743464e-5, 0.4795831523),
    ];
    for ((f_0, kappa, k_tail), pull_off, end, restitution) in cases {
        let pair = WaltonJohnsonPair::new([100.0, 400.0, k_tail], f_0, kappa, mass).unwrap();
        let overlap = pair.overlap_max(0.1);
        assert_printed(pair.pull_off_force(overlap), pull_off, 10);
        assert_printed(pair.end_overlap(overlap), end, 10);
        assert_printed(pair.restitution(0.1), restitution, 10);
    }
    // Without a pull-off force it is the law of Walton and Braun: e = √(k1/k2).
    let plain = WaltonJohnsonPair::new([100.0, 400.0, 50.0], 0.0, 0.0, mass).unwrap();
    assert!((plain.restitution(0.1) - 0.5).abs() < 1e-15);
    assert!(matches!(
        WaltonJohnsonPair::new([100.0, 99.0, 50.0], 0.0, 0.0, mass),
        Err(TheoryError::SofterUnloading { .. })
    ));
}

#[test]
fn pairs_without_size_mass_or_stiffness_are_refused() {
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(HertzPair::new(wrong, 1.0, 1.0).is_err() && HertzPair::new(1.0, wrong, 1.0).is_err());
        assert!(HertzPair::new(1.0, 1.0, wrong).is_err());
        assert!(JkrPair::new(wrong, 1.0, 1.0).is_err() && JkrPair::new(1.0, wrong, 1.0).is_err());
        assert!(JkrPair::new(1.0, 1.0, wrong).is_err());
    }
}
