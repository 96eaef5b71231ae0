//! Distributions of particle radii.

use std::f64::consts::PI;

use pulvis_math::elementary;
use rand::RngExt;
use thiserror::Error;

use super::Random;
use super::gaussian::standard_normal;

/// How the radii of particles are distributed. All radii are positive, and minimum < maximum.
#[derive(Clone, Debug, PartialEq)]
pub enum RadiusDistribution {
    /// All equal.
    Fixed {
        /// Radius [m].
        value: f64,
    },
    /// Every radius between two limits equally likely.
    Uniform {
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// Gaussian, cut off at both ends.
    Normal {
        /// Mean of the distribution before it is cut off [m].
        mean: f64,
        /// Standard deviation before it is cut off [m].
        standard_deviation: f64,
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// The logarithm of the radius is Gaussian, cut off at both ends.
    LogNormal {
        /// Median of the distribution before it is cut off [m].
        median: f64,
        /// Standard deviation of ln(radius) [1].
        sigma: f64,
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// A few radii, drawn in proportion to their weights.
    List {
        /// The radii [m].
        values: Vec<f64>,
        /// As many weights, not negative, of which one is positive [1].
        weights: Vec<f64>,
    },
}

/// A parameter of a distribution that is out of its range.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("`{parameter}`: {found}; expected {expected}")]
pub struct InvalidDistribution {
    /// Name of the parameter, as in a scenario.
    pub parameter: &'static str,
    /// What was found, as a clause.
    pub found: String,
    /// What must hold.
    pub expected: String,
}

/// The least share of a distribution that may lie between its minimum and maximum (1 %). With less,
/// the shape of the distribution is lost. A radius is drawn by rejection: with this share it takes 100
/// trials on average, and the chance that 100 000 do not suffice is 0.99^100000 ≈ 1e-437.
pub const LEAST_SHARE: f64 = 0.01;

impl RadiusDistribution {
    /// Smallest and largest radius that can be drawn [m].
    pub fn limits(&self) -> (f64, f64) {
        match self {
            Self::Fixed { value } => (*value, *value),
            Self::Uniform { minimum, maximum }
            | Self::Normal { minimum, maximum, .. }
            | Self::LogNormal { minimum, maximum, .. } => (*minimum, *maximum),
            Self::List { values, weights } => {
                let drawn =
                    || values.iter().zip(weights).filter(|(_, weight)| **weight > 0.0).map(|(a, _)| *a);
                (drawn().fold(f64::INFINITY, f64::min), drawn().fold(0.0, f64::max))
            }
        }
    }

    /// Checks all parameters.
    ///
    /// # Errors
    /// The first parameter that is not finite, not positive, out of order, or leaves less than
    /// [`LEAST_SHARE`] of the distribution between its limits.
    pub fn check(&self) -> Result<(), InvalidDistribution> {
        match self {
            Self::Fixed { value } => positive("value", *value),
            Self::Uniform { minimum, maximum } => in_order(*minimum, *maximum),
            Self::Normal { mean, standard_deviation, minimum, maximum } => {
                positive("mean", *mean)?;
                positive("standard_deviation", *standard_deviation)?;
                in_order(*minimum, *maximum)?;
                within("mean", *mean, *minimum, *maximum)?;
                let standard = |radius: f64| (radius - mean) / standard_deviation;
                has_enough("standard_deviation", standard(*minimum), standard(*maximum))
            }
            Self::LogNormal { median, sigma, minimum, maximum } => {
                positive("median", *median)?;
                positive("sigma", *sigma)?;
                in_order(*minimum, *maximum)?;
                within("median", *median, *minimum, *maximum)?;
                let standard = |radius: f64| elementary::ln(radius / median) / sigma;
                has_enough("sigma", standard(*minimum), standard(*maximum))
            }
            Self::List { values, weights } => check_list(values, weights),
        }
    }

    /// Draws radii [m].
    ///
    /// # Errors
    /// See [`check`](Self::check).
    pub fn draw(&self, count: usize, random: &mut Random) -> Result<Vec<f64>, InvalidDistribution> {
        self.check()?;
        match *self {
            Self::Fixed { value } => Ok(vec![value; count]),
            Self::Uniform { minimum, maximum } => {
                Ok((0..count).map(|_| minimum + (maximum - minimum) * random.random::<f64>()).collect())
            }
            Self::Normal { mean, standard_deviation, minimum, maximum } => {
                let draw = |z: f64| mean + standard_deviation * z;
                Ok(cut(draw, minimum, maximum, count, random))
            }
            Self::LogNormal { median, sigma, minimum, maximum } => {
                let draw = |z: f64| median * elementary::exp(sigma * z);
                Ok(cut(draw, minimum, maximum, count, random))
            }
            Self::List { ref values, ref weights } => Ok(from_list(values, weights, count, random)),
        }
    }
}

fn invalid(parameter: &'static str, found: String, expected: impl Into<String>) -> InvalidDistribution {
    InvalidDistribution { parameter, found, expected: expected.into() }
}

fn positive(parameter: &'static str, value: f64) -> Result<(), InvalidDistribution> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(invalid(parameter, format!("found {value}"), "a finite number greater than 0"))
}

fn in_order(minimum: f64, maximum: f64) -> Result<(), InvalidDistribution> {
    positive("minimum", minimum)?;
    positive("maximum", maximum)?;
    if minimum < maximum {
        return Ok(());
    }
    let found = format!("{maximum} m is not above minimum = {minimum} m");
    Err(invalid("maximum", found, "minimum < maximum"))
}

fn within(
    parameter: &'static str,
    value: f64,
    minimum: f64,
    maximum: f64,
) -> Result<(), InvalidDistribution> {
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    let found = format!("{value} m is not between minimum = {minimum} m and maximum = {maximum} m");
    Err(invalid(parameter, found, format!("minimum <= {parameter} <= maximum")))
}

/// Refuses limits, in standard deviations from the mean, between which there is too little.
fn has_enough(parameter: &'static str, lower: f64, upper: f64) -> Result<(), InvalidDistribution> {
    let share = gaussian_share(lower, upper);
    if share >= LEAST_SHARE {
        return Ok(());
    }
    let found = format!("only {:.2} % of the distribution lies between minimum and maximum", 100.0 * share);
    let expected = format!("{} % or more; or take distribution = \"uniform\"", 100.0 * LEAST_SHARE);
    Err(invalid(parameter, found, expected))
}

/// The share of a standard Gaussian between two bounds, by Simpson's rule to about 1e-6.
fn gaussian_share(lower: f64, upper: f64) -> f64 {
    // Beyond 8 standard deviations there is 1e-15 left.
    let (lower, upper) = (lower.max(-8.0), upper.min(8.0));
    let intervals = 200;
    let width = (upper - lower) / f64::from(intervals);
    let density = |z: f64| elementary::exp(-0.5 * z * z) / (2.0 * PI).sqrt();
    let weight = |number: i32| match number {
        _ if number == 0 || number == intervals => 1.0,
        _ if number % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 =
        (0..=intervals).map(|number| weight(number) * density(lower + width * f64::from(number))).sum();
    sum * width / 3.0
}

fn check_list(values: &[f64], weights: &[f64]) -> Result<(), InvalidDistribution> {
    values.iter().try_for_each(|value| positive("values", *value))?;
    if weights.len() != values.len() {
        let expected = format!("one weight for each of the {} radii", values.len());
        return Err(invalid("weights", format!("found {} values", weights.len()), expected));
    }
    if let Some(weight) = weights.iter().find(|weight| !(**weight >= 0.0 && weight.is_finite())) {
        return Err(invalid("weights", format!("found {weight}"), "finite numbers of at least 0"));
    }
    if weights.iter().all(|weight| *weight == 0.0) {
        return Err(invalid("weights", "all weights are 0".to_owned(), "a weight greater than 0"));
    }
    Ok(())
}

/// Draws by rejection what lies between the limits of a distribution that has been checked; `radius` makes a
/// radius [m] of a standard Gaussian number.
fn cut(
    radius: impl Fn(f64) -> f64,
    minimum: f64,
    maximum: f64,
    count: usize,
    random: &mut Random,
) -> Vec<f64> {
    let mut draw = || {
        loop {
            let drawn = radius(standard_normal(random));
            if (minimum..=maximum).contains(&drawn) {
                return drawn;
            }
        }
    };
    (0..count).map(|_| draw()).collect()
}

fn from_list(values: &[f64], weights: &[f64], count: usize, random: &mut Random) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    let drawn = || values.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
    // Rounding can leave a little of the sum beyond the last weight.
    let last = drawn().next_back().map_or(f64::NAN, |(radius, _)| *radius);
    let mut draw = || {
        let mut left = total * random.random::<f64>();
        let chosen = drawn().find(|(_, weight)| {
            left -= **weight;
            left < 0.0
        });
        chosen.map_or(last, |(radius, _)| *radius)
    };
    (0..count).map(|_| draw()).collect()
}

#[cfg(test)]
mod tests {
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
        let (mean, _) =
            moments(&RadiusDistribution::LogNormal { median, sigma, minimum: 0.1, maximum: 10.0 });
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
}
