//! Moments and quantiles of what is drawn, against closed forms.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::super::random_stream;
use super::*;

fn moments(distribution: &RadiusDistribution) -> (f64, f64) {
    let drawn = distribution.draw(40_000, &mut random_stream(5)).unwrap();
    let mean = drawn.iter().sum::<f64>() / drawn.len() as f64;
    let variance = drawn.iter().map(|r| elementary::powi(r - mean, 2)).sum::<f64>() / drawn.len() as f64;
    (mean, variance.sqrt())
}

fn normal(mean: f64, standard_deviation: f64, minimum: f64, maximum: f64) -> RadiusDistribution {
    RadiusDistribution::Normal { mean, standard_deviation, minimum, maximum }
}

fn list(values: &[f64], weights: &[f64]) -> RadiusDistribution {
    RadiusDistribution::List { values: values.to_vec(), weights: weights.to_vec() }
}

// 40 000 draws: the mean is good to σ/200, the standard deviation to about σ/280; three of those.
#[test]
fn distributions_have_their_mean_and_width() {
    let (mean, width) = moments(&RadiusDistribution::Uniform { minimum: 0.9, maximum: 1.1 });
    assert!((mean - 1.0).abs() < 9e-4 && (width - 0.1 / 3.0_f64.sqrt()).abs() < 7e-4);
    let (mean, width) = moments(&normal(1.0, 0.1, 0.3, 1.7));
    assert!((mean - 1.0).abs() < 1.5e-3 && (width - 0.1).abs() < 1.1e-3);
    let (median, sigma) = (2.0, 0.2);
    let (mean, _) = moments(&RadiusDistribution::LogNormal { median, sigma, minimum: 0.1, maximum: 10.0 });
    assert!((mean / (2.0 * elementary::exp(0.02)) - 1.0).abs() < 4e-3);
    let (mean, _) = moments(&list(&[1.0, 2.0], &[3.0, 1.0]));
    assert!((mean - 1.25).abs() < 7e-3);
}

#[test]
fn a_distribution_of_which_a_hundredth_is_left_can_be_drawn_and_one_with_less_is_refused() {
    // Within ±0.01253 standard deviations of the mean there is 1.000 % of a Gaussian.
    let narrow = |half_width: f64| normal(1.0, 1e-2, 1.0 - half_width, 1.0 + half_width);
    let drawn = narrow(1.26e-4).draw(2000, &mut random_stream(1)).unwrap();
    assert!(drawn.iter().all(|radius| (radius - 1.0).abs() <= 1.26e-4));
    let refused = narrow(1.24e-4).draw(1, &mut random_stream(1)).unwrap_err();
    assert_eq!(refused.parameter, "standard_deviation");
    assert_eq!(refused.expected, "1 % or more; or take distribution = \"uniform\"");
}

#[test]
fn every_parameter_out_of_its_range_is_refused_by_its_name() {
    use RadiusDistribution::{Fixed, LogNormal, Uniform};
    let (minimum, maximum) = (1.0, 2.0);
    let refused = [
        (Fixed { value: f64::NAN }, "value"),
        (Fixed { value: -1.0 }, "value"),
        (Uniform { minimum: 0.0, maximum }, "minimum"),
        (Uniform { minimum, maximum: f64::INFINITY }, "maximum"),
        (Uniform { minimum, maximum: 1.0 }, "maximum"),
        (normal(3.0, 1.0, minimum, maximum), "mean"),
        (normal(1.5, f64::NAN, minimum, maximum), "standard_deviation"),
        (LogNormal { median: 0.5, sigma: 1.0, minimum, maximum }, "median"),
        (LogNormal { median: 1.5, sigma: 0.0, minimum, maximum }, "sigma"),
        (list(&[1.0, 0.0], &[1.0, 1.0]), "values"),
        (list(&[], &[]), "weights"),
        (list(&[1.0], &[1.0, 2.0]), "weights"),
        (list(&[1.0, 2.0], &[1.0, -2.0]), "weights"),
        (list(&[1.0, 2.0], &[0.0, 0.0]), "weights"),
    ];
    for (distribution, parameter) in refused {
        let error = distribution.draw(1, &mut random_stream(1)).unwrap_err();
        assert_eq!(error.parameter, parameter, "{distribution:?}: {error}");
    }
}

#[test]
fn a_radius_without_weight_is_never_drawn() {
    let drawn = list(&[1.0, 2.0, 3.0], &[0.0, 1.0, 0.0]).draw(1000, &mut random_stream(3)).unwrap();
    assert!(drawn.iter().all(|radius| *radius == 2.0));
    assert_eq!(list(&[1.0, 2.0, 3.0], &[0.0, 1.0, 0.0]).limits(), (2.0, 2.0));
}

#[test]
fn two_thirds_of_a_gaussian_lie_within_one_standard_deviation() {
    // Tabulated: 0.682689492137; Simpson's rule with 200 intervals errs by far less than 1e-9.
    assert!((gaussian_share(-1.0, 1.0) - 0.682_689_492_137).abs() < 1e-9);
    assert!((gaussian_share(-1e9, 1e9) - 1.0).abs() < 1e-9);
}

const COUNT: usize = 40_000;

fn drawn(distribution: &RadiusDistribution) -> Vec<f64> {
    let radii = distribution.draw(COUNT, &mut random_stream(9)).unwrap();
    let (minimum, maximum) = distribution.limits();
    assert!(radii.iter().all(|radius| (minimum..=maximum).contains(radius)));
    radii
}

fn by_mass(of: RadiusDistribution) -> RadiusDistribution {
    RadiusDistribution::ByMass(Box::new(of))
}

/// The share of radii above one, by number.
fn share_above(radii: &[f64], limit: f64) -> f64 {
    radii.iter().filter(|radius| **radius > limit).count() as f64 / radii.len() as f64
}

/// The share of mass above a radius.
fn mass_above(radii: &[f64], limit: f64) -> f64 {
    let cube = |radius: &f64| elementary::powi(*radius, 3);
    let above: f64 = radii.iter().filter(|radius| **radius > limit).map(cube).sum();
    above / radii.iter().map(cube).sum::<f64>()
}

// Four standard errors of a share are 2/sqrt(40000) = 0.01 at most.
#[test]
fn rosin_rammler_has_its_quantiles_by_number_and_by_mass() {
    let (scale, exponent, minimum, maximum) = (1.0, 3.0, 0.2, 2.5);
    let plain = RadiusDistribution::RosinRammler { scale, exponent, minimum, maximum };
    let above = |radius: f64| elementary::exp(-elementary::powf(radius / scale, exponent));
    // Of what lies between the limits.
    let expected = |radius: f64| (above(radius) - above(maximum)) / (above(minimum) - above(maximum));
    let numbers = drawn(&plain);
    for radius in [0.5, 0.8, 1.0, 1.3] {
        let found = share_above(&numbers, radius);
        assert!((found - expected(radius)).abs() < 0.01, "above {radius}: {found}, not {}", expected(radius));
    }
    let masses = drawn(&by_mass(plain));
    for radius in [0.5, 0.8, 1.0, 1.3] {
        let found = mass_above(&masses, radius);
        // Few large particles carry much of the mass: the error of a share of mass is up to five times as large.
        assert!((found - expected(radius)).abs() < 0.03, "above {radius}: {found}, not {}", expected(radius));
    }
}

#[test]
fn a_log_normal_distribution_by_mass_is_one_by_number_about_a_smaller_median() {
    // Hatch and Choate: J. Franklin Inst. 207, 369 (1929): ln(median by number) = ln(median by mass) - 3 sigma^2.
    let (median, sigma) = (1.0, 0.25);
    let radii = drawn(&by_mass(RadiusDistribution::LogNormal { median, sigma, minimum: 0.2, maximum: 5.0 }));
    let mean = radii.iter().map(|radius| elementary::ln(*radius)).sum::<f64>() / COUNT as f64;
    // Four standard errors of the mean of ln r, sigma/sqrt(N), are 0.005; the pieces err by less.
    assert!((mean + 3.0 * sigma * sigma).abs() < 0.006, "{mean}");
    let variance =
        radii.iter().map(|radius| elementary::powi(elementary::ln(*radius) - mean, 2)).sum::<f64>()
            / COUNT as f64;
    assert!((variance.sqrt() - sigma).abs() < 0.004, "{variance}");
    assert!((mass_above(&radii, median) - 0.5).abs() < 0.02);
    // Where nearly all particles are smaller than the smallest radius, drawing again would never end.
    let fine = by_mass(RadiusDistribution::LogNormal { median, sigma: 1.0, minimum: 0.9, maximum: 1.1 });
    // In so narrow a range ln r is even to 0.5 %, in mass.
    let expected = elementary::ln(1.1) / elementary::ln(1.1 / 0.9);
    assert!((mass_above(&drawn(&fine), 1.0) - expected).abs() < 0.013);
}

#[test]
fn even_shares_of_mass_are_numbers_that_fall_with_the_third_power_of_the_radius() {
    let radii = drawn(&by_mass(RadiusDistribution::Uniform { minimum: 1.0, maximum: 4.0 }));
    // The share of numbers of r^-3 above r: (r^-2 - b^-2)/(a^-2 - b^-2).
    for radius in [1.2, 2.0, 3.0] {
        let expected = (1.0 / (radius * radius) - 1.0 / 16.0) / (1.0 - 1.0 / 16.0);
        assert!((share_above(&radii, radius) - expected).abs() < 0.01, "{radius}");
    }
    let lists = drawn(&by_mass(list(&[1.0, 2.0], &[1.0, 1.0])));
    // Eight small ones weigh as much as a large one.
    assert!((share_above(&lists, 1.5) - 1.0 / 9.0).abs() < 0.007);
    let (mean, deviation) = (1.0, 0.1);
    let gauss = drawn(&by_mass(normal(mean, deviation, 0.6, 1.4)));
    assert!((mass_above(&gauss, 1.0) - 0.5).abs() < 0.013);
    assert_eq!(drawn(&by_mass(RadiusDistribution::Fixed { value: 2.0 }))[0], 2.0);
}

#[test]
fn a_table_is_straight_between_its_points() {
    let (radii, cumulative) = (vec![1.0, 2.0, 4.0, 5.0, 7.0], vec![0.0, 10.0, 10.0, 60.0, 100.0]);
    let table = RadiusDistribution::Table { radii, cumulative };
    assert_eq!(table.limits(), (1.0, 7.0));
    let numbers = drawn(&table);
    for (radius, expected) in [(1.5, 0.95), (2.0, 0.9), (3.9, 0.9), (4.5, 0.65), (6.0, 0.2)] {
        assert!((share_above(&numbers, radius) - expected).abs() < 0.01, "{radius}");
    }
    assert!(numbers.iter().all(|radius| !(2.0001..4.0).contains(radius)));
    let masses = drawn(&by_mass(table));
    for (radius, expected) in [(1.5, 0.95), (4.5, 0.65), (6.0, 0.2)] {
        assert!((mass_above(&masses, radius) - expected).abs() < 0.02, "{radius}");
    }
    // Pieces without a share at the ends cannot be drawn.
    let (radii, cumulative) = (vec![1.0, 2.0, 3.0, 4.0], vec![0.0, 0.0, 1.0, 1.0]);
    assert_eq!(RadiusDistribution::Table { radii, cumulative }.limits(), (2.0, 3.0));
}

#[test]
fn tables_and_exponents_out_of_range_are_refused_by_their_names() {
    let table = |radii: &[f64], cumulative: &[f64]| RadiusDistribution::Table {
        radii: radii.to_vec(),
        cumulative: cumulative.to_vec(),
    };
    let rosin = |scale: f64, exponent: f64| RadiusDistribution::RosinRammler {
        scale,
        exponent,
        minimum: 1.0,
        maximum: 2.0,
    };
    let refused = [
        (table(&[1.0], &[1.0]), "radii"),
        (table(&[1.0, 1.0], &[0.0, 1.0]), "radii"),
        (table(&[-1.0, 1.0], &[0.0, 1.0]), "radii"),
        (table(&[1.0, 2.0], &[0.0]), "cumulative"),
        (table(&[1.0, 2.0], &[0.0, f64::NAN]), "cumulative"),
        (table(&[1.0, 2.0, 3.0], &[0.0, 2.0, 1.0]), "cumulative"),
        (table(&[1.0, 2.0], &[1.0, 1.0]), "cumulative"),
        (rosin(0.0, 1.0), "scale"),
        (rosin(1.0, f64::NAN), "exponent"),
        (rosin(100.0, 5.0), "scale"),
    ];
    for (distribution, parameter) in refused {
        for distribution in [distribution.clone(), by_mass(distribution)] {
            let error = distribution.draw(1, &mut random_stream(1)).unwrap_err();
            assert_eq!(error.parameter, parameter, "{distribution:?}: {error}");
        }
    }
}

#[test]
fn limits_far_away_leave_a_narrow_distribution_by_mass_its_width() {
    let (mean, deviation) = (1.0, 1e-3);
    let sizes = [
        normal(mean, deviation, 1e-3, 100.0),
        RadiusDistribution::LogNormal { median: mean, sigma: deviation, minimum: 1e-3, maximum: 100.0 },
    ];
    for of in sizes {
        let (found, width) = moments(&by_mass(of.clone()));
        // By number the mean is three variances lower, 3e-6; of 40 000 draws the width is known to half a per cent.
        assert!(
            (found - mean).abs() < 4e-5 && (width / deviation - 1.0).abs() < 0.03,
            "{of:?}: {found} {width}"
        );
    }
    // ln r is a thousandth wide, too: half of the mass lies above scale (ln 2)^(1/n).
    let (scale, exponent) = (1.0, 1000.0);
    let radii =
        drawn(&by_mass(RadiusDistribution::RosinRammler { scale, exponent, minimum: 1e-3, maximum: 100.0 }));
    let half = elementary::powf(elementary::ln(2.0), 1.0 / exponent);
    assert!((mass_above(&radii, half) - 0.5).abs() < 0.02);
}
