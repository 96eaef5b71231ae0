//! Distributions of particle radii.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_math::{Dimension, elementary};
use std::f64::consts::PI;

/// How the radii of a group are distributed. All radii are positive, and minimum < maximum.
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
}

/// With less than this share between minimum and maximum the shape of the distribution is lost (1 %),
/// and drawing by rejection becomes slow.
const LEAST_SHARE: f64 = 0.01;

/// Reads `[particles.radius]`.
pub(super) fn read_radius(mut table: TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let names = ["fixed", "uniform", "normal", "log-normal", "list"];
    let read = match table.required("distribution", Name(&names))? {
        "fixed" => length(&mut table, "value").map(|value| RadiusDistribution::Fixed { value }),
        "uniform" => {
            read_limits(&mut table).map(|(minimum, maximum)| RadiusDistribution::Uniform { minimum, maximum })
        }
        "normal" => read_normal(&mut table),
        "log-normal" => read_log_normal(&mut table),
        _ => read_list(&mut table),
    };
    table.finish();
    read
}

fn length(table: &mut TableReader<'_>, key: &str) -> Result<f64, Reported> {
    table.required(key, QuantityRule::of(Dimension::LENGTH).above(0.0))
}

fn read_limits(table: &mut TableReader<'_>) -> Result<(f64, f64), Reported> {
    let (minimum, maximum) = (length(table, "minimum"), length(table, "maximum"));
    let (minimum, maximum) = (minimum?, maximum?);
    if minimum >= maximum {
        let found = format!("{maximum} m is not above minimum = {minimum} m");
        return Err(table.refuse("maximum", Problem::rule(found, "minimum < maximum")));
    }
    Ok((minimum, maximum))
}

fn read_normal(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let mean = length(table, "mean");
    let standard_deviation = length(table, "standard_deviation");
    let limits = read_limits(table);
    let (mean, standard_deviation, (minimum, maximum)) = (mean?, standard_deviation?, limits?);
    is_between(table, "mean", mean, (minimum, maximum))?;
    let share = gaussian_share((minimum - mean) / standard_deviation, (maximum - mean) / standard_deviation);
    has_enough(table, "standard_deviation", share)?;
    Ok(RadiusDistribution::Normal { mean, standard_deviation, minimum, maximum })
}

fn read_log_normal(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let median = length(table, "median");
    let sigma = table.required("sigma", QuantityRule::of(Dimension::NONE).above(0.0));
    let limits = read_limits(table);
    let (median, sigma, (minimum, maximum)) = (median?, sigma?, limits?);
    is_between(table, "median", median, (minimum, maximum))?;
    let share =
        gaussian_share(elementary::ln(minimum / median) / sigma, elementary::ln(maximum / median) / sigma);
    has_enough(table, "sigma", share)?;
    Ok(RadiusDistribution::LogNormal { median, sigma, minimum, maximum })
}

fn is_between(table: &TableReader<'_>, key: &str, value: f64, limits: (f64, f64)) -> Result<(), Reported> {
    let (minimum, maximum) = limits;
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    let found = format!("{value} m is not between minimum = {minimum} m and maximum = {maximum} m");
    Err(table.refuse(key, Problem::rule(found, format!("minimum <= {key} <= maximum"))))
}

fn has_enough(table: &TableReader<'_>, key: &str, share: f64) -> Result<(), Reported> {
    if share >= LEAST_SHARE {
        return Ok(());
    }
    let found = format!("only {:.2} % of the distribution lies between minimum and maximum", 100.0 * share);
    let expected = format!("{} % or more; or take distribution = \"uniform\"", 100.0 * LEAST_SHARE);
    Err(table.refuse(key, Problem::rule(found, expected)))
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

fn read_list(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let values =
        table.required("values", List::of(QuantityRule::of(Dimension::LENGTH).above(0.0)).at_least(1));
    let weights = table.optional("weights", List::of(QuantityRule::of(Dimension::NONE).at_least(0.0)));
    let values = values?;
    let weights = weights?.unwrap_or_else(|| vec![1.0; values.len()]);
    if weights.len() != values.len() {
        let expected = format!("one weight for each of the {} radii", values.len());
        return Err(table.refuse("weights", Problem::WrongLength { found: weights.len(), expected }));
    }
    if weights.iter().all(|weight| *weight == 0.0) {
        return Err(table.refuse("weights", Problem::rule("all weights are 0", "a weight greater than 0")));
    }
    Ok(RadiusDistribution::List { values, weights })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_thirds_of_a_gaussian_lie_within_one_standard_deviation() {
        // Tabulated: 0.682689492137; Simpson's rule with 200 intervals errs by far less than 1e-9.
        assert!((gaussian_share(-1.0, 1.0) - 0.682_689_492_137).abs() < 1e-9);
        assert!((gaussian_share(-1e9, 1e9) - 1.0).abs() < 1e-9);
    }
}
