//! Distributions of particle radii.

mod pieces;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use pulvis_math::elementary;
use rand::RngExt;
use thiserror::Error;

use super::Random;
use super::gaussian::standard_normal;
use pieces::Pieces;

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
    /// Rosin and Rammler, also called Weibull: the share of radii above r is exp(-(r/scale)^exponent), cut off at both ends.
    ///
    /// # Source
    /// P. Rosin, E. Rammler, J. Inst. Fuel 7, 29 (1933), where shares are those of mass: see [`ByMass`](Self::ByMass).
    RosinRammler {
        /// The radius above which a share of 1/e lies before the distribution is cut off [m].
        scale: f64,
        /// Exponent [1]; the larger, the narrower.
        exponent: f64,
        /// Smallest radius [m].
        minimum: f64,
        /// Largest radius [m].
        maximum: f64,
    },
    /// A cumulative table, straight between its points.
    Table {
        /// Radii [m], rising.
        radii: Vec<f64>,
        /// The share of smaller radii at each, not falling; only ratios of differences count [1].
        cumulative: Vec<f64>,
    },
    /// The shares of another distribution are shares of mass, not of number.
    ByMass(Box<Self>),
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
            | Self::LogNormal { minimum, maximum, .. }
            | Self::RosinRammler { minimum, maximum, .. } => (*minimum, *maximum),
            Self::Table { radii, cumulative } => pieces::table_limits(radii, cumulative),
            Self::ByMass(of) => of.limits(),
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
            Self::RosinRammler { scale, exponent, minimum, maximum } => {
                positive("scale", *scale)?;
                positive("exponent", *exponent)?;
                in_order(*minimum, *maximum)?;
                let [below, above] =
                    [*minimum, *maximum].map(|radius| weibull_above(radius, *scale, *exponent));
                has_share("scale", below - above)
            }
            Self::Table { radii, cumulative } => pieces::check_table(radii, cumulative),
            Self::ByMass(of) => of.check(),
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
            Self::RosinRammler { scale, exponent, minimum, maximum } => {
                let [low, high] = [minimum, maximum].map(|radius| weibull_above(radius, scale, exponent));
                let radius = |above: f64| scale * elementary::powf(-elementary::ln(above), 1.0 / exponent);
                let mut draw = || radius(low + (high - low) * random.random::<f64>());
                Ok((0..count).map(|_| draw().clamp(minimum, maximum)).collect())
            }
            Self::Table { ref radii, ref cumulative } => {
                let pieces = Pieces::of_table(radii, cumulative);
                Ok((0..count).map(|_| pieces.radius(random.random::<f64>())).collect())
            }
            Self::ByMass(ref of) => of.draw_by_mass(count, random),
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

impl RadiusDistribution {
    /// Draws radii of a distribution that has been checked, whose shares are those of mass: the number of particles of a share
    /// goes with 1/r³.
    fn draw_by_mass(&self, count: usize, random: &mut Random) -> Result<Vec<f64>, InvalidDistribution> {
        let density: Box<dyn Fn(f64) -> f64> = match *self {
            // A share of one size is the same by number and mass; shares of mass of shares of mass are these.
            Self::Fixed { .. } | Self::ByMass(_) => return self.draw(count, random),
            Self::List { ref values, ref weights } => {
                let shares = values.iter().zip(weights);
                let numbers: Vec<f64> =
                    shares.map(|(radius, weight)| weight / elementary::powi(*radius, 3)).collect();
                return Ok(from_list(values, &numbers, count, random));
            }
            Self::Table { ref radii, ref cumulative } => {
                let pieces = Pieces::of_table(radii, cumulative).by_mass();
                return Ok((0..count).map(|_| pieces.radius(random.random::<f64>())).collect());
            }
            Self::Uniform { .. } => Box::new(|_| 1.0),
            Self::Normal { mean, standard_deviation, .. } => {
                Box::new(move |radius| gaussian((radius - mean) / standard_deviation))
            }
            Self::LogNormal { median, sigma, .. } => {
                Box::new(move |radius| gaussian(elementary::ln(radius / median) / sigma) / radius)
            }
            Self::RosinRammler { scale, exponent, .. } => Box::new(move |radius| {
                elementary::powf(radius / scale, exponent - 1.0) * weibull_above(radius, scale, exponent)
            }),
        };
        let (minimum, maximum) = self.range_by_mass();
        let pieces = Pieces::of_density(density, minimum, maximum).by_mass();
        Ok((0..count).map(|_| pieces.radius(random.random::<f64>())).collect())
    }

    /// Between these radii [m] lie all numbers of particles of a distribution by mass that can be told from none, so that its pieces
    /// are not spent on limits that are far away.
    fn range_by_mass(&self) -> (f64, f64) {
        // exp(-FAR²/2) = 1e-22: less than a random number resolves.
        const FAR: f64 = 10.0;
        let (minimum, maximum) = self.limits();
        let (low, high) = match *self {
            Self::Normal { mean, standard_deviation, .. } => {
                // Numbers fall with 1/r³, which outweighs the Gaussian only where the mean is within FAR deviations of zero.
                (mean - 1.5 * FAR * standard_deviation, mean + FAR * standard_deviation)
            }
            // By number the median is that of the mass times exp(-3 sigma²), with the same sigma (Hatch and Choate 1929).
            Self::LogNormal { median, sigma, .. } => (
                median * elementary::exp(-sigma * (3.0 * sigma + FAR)),
                median * elementary::exp(FAR * sigma),
            ),
            Self::RosinRammler { scale, exponent, .. } => {
                let high = scale * elementary::powf(0.5 * FAR * FAR, 1.0 / exponent);
                // Numbers grow with r^(n - 3): from n = 4 on there are none at zero.
                let low = if exponent > 4.0 {
                    scale * elementary::exp(-0.5 * FAR * FAR / (exponent - 3.0))
                } else {
                    0.0
                };
                (low, high)
            }
            _ => (minimum, maximum),
        };
        let (low, high) = (low.max(minimum), high.min(maximum));
        // Limits that lie out there themselves stay.
        if low < high { (low, high) } else { (minimum, maximum) }
    }
}

/// exp(-z²/2).
fn gaussian(z: f64) -> f64 {
    elementary::exp(-0.5 * z * z)
}

/// The share of a Rosin-Rammler distribution above a radius.
fn weibull_above(radius: f64, scale: f64, exponent: f64) -> f64 {
    elementary::exp(-elementary::powf(radius / scale, exponent))
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
    has_share(parameter, gaussian_share(lower, upper))
}

/// Refuses limits between which there is too small a share of the distribution.
fn has_share(parameter: &'static str, share: f64) -> Result<(), InvalidDistribution> {
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
