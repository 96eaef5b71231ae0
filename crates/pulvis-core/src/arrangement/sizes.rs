//! Distributions of particle radii.

use pulvis_math::elementary;
use rand::RngExt;
use thiserror::Error;

use super::Random;
use super::gaussian::standard_normal;

/// A distribution of radii [m].
#[derive(Clone, Debug, PartialEq)]
pub enum Sizes {
    /// Every particle the same.
    Fixed(f64),
    /// Equally likely between a smallest and a largest radius.
    Uniform {
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// Gaussian, cut off at both ends.
    Normal {
        /// Mean before the cut [m].
        mean: f64,
        /// Standard deviation before the cut [m].
        standard_deviation: f64,
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// Log-normal, cut off at both ends.
    LogNormal {
        /// Median before the cut [m].
        median: f64,
        /// Standard deviation of the logarithm [1].
        sigma: f64,
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// One of several radii [m], each with its weight.
    List(Vec<(f64, f64)>),
}

/// A distribution that has no radii.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum InvalidSizes {
    /// Parameters outside their range.
    #[error("the parameters of the distribution are not finite, positive and in order")]
    Parameters,
    /// Almost everything is cut off.
    #[error("less than 0.1 % of the distribution lies between its minimum and maximum")]
    CutOff,
    /// No radius in the list has any weight.
    #[error("no radius in the list has a positive weight")]
    NoWeight,
}

const ATTEMPTS: usize = 100_000;

impl Sizes {
    /// Draws radii [m].
    pub fn draw(&self, count: usize, random: &mut Random) -> Result<Vec<f64>, InvalidSizes> {
        match *self {
            Self::Fixed(radius) => Ok(vec![radius; count]),
            Self::Uniform { minimum, maximum } => {
                Ok((0..count).map(|_| minimum + (maximum - minimum) * random.random::<f64>()).collect())
            }
            Self::Normal { mean, standard_deviation, minimum, maximum } => {
                check_width(mean, standard_deviation)?;
                let draw = |random: &mut Random| mean + standard_deviation * standard_normal(random);
                cut(draw, minimum, maximum, count, random)
            }
            Self::LogNormal { median, sigma, minimum, maximum } => {
                check_width(elementary::ln(median), sigma)?;
                let draw = |random: &mut Random| median * elementary::exp(sigma * standard_normal(random));
                cut(draw, minimum, maximum, count, random)
            }
            Self::List(ref radii) => from_list(radii, count, random),
        }
    }
}

/// Refuses a centre or a width that is not finite, and a negative width.
fn check_width(centre: f64, width: f64) -> Result<(), InvalidSizes> {
    if centre.is_finite() && width.is_finite() && width >= 0.0 {
        Ok(())
    } else {
        Err(InvalidSizes::Parameters)
    }
}

/// Draws by rejection what lies between the ends.
fn cut(
    draw: impl Fn(&mut Random) -> f64,
    minimum: f64,
    maximum: f64,
    count: usize,
    random: &mut Random,
) -> Result<Vec<f64>, InvalidSizes> {
    (0..count)
        .map(|_| {
            let mut trials = (0..ATTEMPTS).map(|_| draw(random));
            trials.find(|radius| (minimum..=maximum).contains(radius)).ok_or(InvalidSizes::CutOff)
        })
        .collect()
}

fn from_list(radii: &[(f64, f64)], count: usize, random: &mut Random) -> Result<Vec<f64>, InvalidSizes> {
    let total: f64 = radii.iter().map(|(_, weight)| weight).sum();
    let Some(&(last, _)) = radii.last().filter(|_| total > 0.0) else { return Err(InvalidSizes::NoWeight) };
    let mut draw = || {
        let mut left = total * random.random::<f64>();
        let chosen = radii.iter().find(|(_, weight)| {
            left -= weight;
            left < 0.0
        });
        chosen.map_or(last, |&(radius, _)| radius)
    };
    Ok((0..count).map(|_| draw()).collect())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::super::random_stream;
    use super::*;

    fn moments(sizes: &Sizes) -> (f64, f64) {
        let drawn = sizes.draw(40_000, &mut random_stream(5)).unwrap();
        let mean = drawn.iter().sum::<f64>() / drawn.len() as f64;
        let variance = drawn.iter().map(|r| elementary::powi(r - mean, 2)).sum::<f64>() / drawn.len() as f64;
        (mean, variance.sqrt())
    }

    // 40 000 draws: the mean is good to σ/200, the standard deviation to about σ/280; three of those.
    #[test]
    fn distributions_have_their_mean_and_width() {
        let (mean, width) = moments(&Sizes::Uniform { minimum: 0.9, maximum: 1.1 });
        assert!((mean - 1.0).abs() < 9e-4 && (width - 0.1 / 3.0_f64.sqrt()).abs() < 7e-4);
        let normal = Sizes::Normal { mean: 1.0, standard_deviation: 0.1, minimum: 0.3, maximum: 1.7 };
        let (mean, width) = moments(&normal);
        assert!((mean - 1.0).abs() < 1.5e-3 && (width - 0.1).abs() < 1.1e-3);
        let log_normal = Sizes::LogNormal { median: 2.0, sigma: 0.2, minimum: 0.1, maximum: 10.0 };
        let (mean, _) = moments(&log_normal);
        assert!((mean / (2.0 * elementary::exp(0.02)) - 1.0).abs() < 4e-3);
        let (mean, _) = moments(&Sizes::List(vec![(1.0, 3.0), (2.0, 1.0)]));
        assert!((mean - 1.25).abs() < 7e-3);
    }

    #[test]
    fn a_distribution_that_is_all_cut_off_is_refused() {
        let sizes = Sizes::Normal { mean: 1.0, standard_deviation: 0.01, minimum: 3.0, maximum: 4.0 };
        assert_eq!(sizes.draw(1, &mut random_stream(1)), Err(InvalidSizes::CutOff));
        assert_eq!(Sizes::List(vec![]).draw(1, &mut random_stream(1)), Err(InvalidSizes::NoWeight));
    }
}
