//! Distributions in pieces: between two radii the density is even, or falls with the third power of the radius.

use pulvis_math::elementary;

use super::{InvalidDistribution, invalid, positive};

/// Pieces of a continuous density: inside a piece it is taken as even, which errs in the cumulative share by less than 1e-5 where
/// the density bends over a tenth of the range.
const PIECES: usize = 500;

/// A distribution in pieces.
pub(super) struct Pieces {
    /// The radii between pieces, one more than pieces, rising [m].
    radii: Vec<f64>,
    /// The share of all smaller radii at each of them, from 0 to 1.
    cumulative: Vec<f64>,
    /// Whether numbers in a piece go with 1/r³ instead of being even.
    cubic: bool,
}

impl Pieces {
    /// Of a table that has been checked.
    pub(super) fn of_table(radii: &[f64], cumulative: &[f64]) -> Self {
        let shares = cumulative.windows(2).map(|two| two[1] - two[0]);
        Self::of_shares(radii.to_vec(), shares, false)
    }

    /// Of a density between two radii [m], of any scale; pieces grow with the radius.
    pub(super) fn of_density(density: impl Fn(f64) -> f64, minimum: f64, maximum: f64) -> Self {
        let ratio = elementary::ln(maximum / minimum) / PIECES as f64;
        let radius = |number: usize| {
            if number == PIECES { maximum } else { minimum * elementary::exp(ratio * number as f64) }
        };
        let radii: Vec<f64> = (0..=PIECES).map(radius).collect();
        // Simpson's rule in each piece.
        let shares: Vec<f64> = radii
            .windows(2)
            .map(|ends| {
                let middle = density(0.5 * (ends[0] + ends[1]));
                (ends[1] - ends[0]) * (density(ends[0]) + 4.0 * middle + density(ends[1]))
            })
            .collect();
        Self::of_shares(radii, shares.into_iter(), false)
    }

    fn of_shares(radii: Vec<f64>, shares: impl Iterator<Item = f64>, cubic: bool) -> Self {
        let mut cumulative = vec![0.0];
        let mut sum = 0.0;
        for share in shares {
            sum += share;
            cumulative.push(sum);
        }
        cumulative.iter_mut().for_each(|share| *share /= sum);
        Self { radii, cumulative, cubic }
    }

    /// The numbers of particles, if the shares are those of mass.
    pub(super) fn by_mass(self) -> Self {
        let shares: Vec<f64> = self.cumulative.windows(2).map(|two| two[1] - two[0]).collect();
        // Radii over the largest one, so that no power overflows. The mean of r⁻³ between a and b is (a + b)/(2 a² b²).
        let scale = self.radii.last().copied().unwrap_or(1.0);
        let numbers = self.radii.windows(2).zip(shares).map(|(ends, share)| {
            let [low, high] = [ends[0] / scale, ends[1] / scale];
            share * (low + high) / (2.0 * low * low * high * high)
        });
        let numbers: Vec<f64> = numbers.collect();
        Self::of_shares(self.radii, numbers.into_iter(), true)
    }

    /// The radius below which a share lies [m].
    pub(super) fn radius(&self, share: f64) -> f64 {
        let last = self.radii.len() - 2;
        let piece = self.cumulative.partition_point(|below| *below <= share).saturating_sub(1).min(last);
        let (low, high) = (self.radii[piece], self.radii[piece + 1]);
        let (below, above) = (self.cumulative[piece], self.cumulative[piece + 1]);
        let part = ((share - below) / (above - below)).clamp(0.0, 1.0);
        let radius = if self.cubic {
            // Numbers of r⁻³ add up to low⁻² - r⁻².
            let ratio = low / high;
            low / (1.0 - part * (1.0 - ratio * ratio)).sqrt()
        } else {
            low + (high - low) * part
        };
        radius.clamp(low, high)
    }
}

/// The smallest and the largest radius of a table that can be drawn [m].
pub(super) fn table_limits(radii: &[f64], cumulative: &[f64]) -> (f64, f64) {
    let pieces = || radii.windows(2).zip(cumulative.windows(2)).filter(|(_, shares)| shares[1] > shares[0]);
    let first = pieces().next().map_or(f64::INFINITY, |(ends, _)| ends[0]);
    (first, pieces().next_back().map_or(0.0, |(ends, _)| ends[1]))
}

/// Refuses a table that does not rise.
pub(super) fn check_table(radii: &[f64], cumulative: &[f64]) -> Result<(), InvalidDistribution> {
    radii.iter().try_for_each(|radius| positive("radii", *radius))?;
    if radii.len() < 2 {
        return Err(invalid("radii", format!("found {} radii", radii.len()), "two or more"));
    }
    if let Some(two) = radii.windows(2).find(|two| two[0] >= two[1]) {
        return Err(invalid(
            "radii",
            format!("{} m is not above {} m before it", two[1], two[0]),
            "rising radii",
        ));
    }
    if cumulative.len() != radii.len() {
        let expected = format!("one share for each of the {} radii", radii.len());
        return Err(invalid("cumulative", format!("found {} values", cumulative.len()), expected));
    }
    if let Some(share) = cumulative.iter().find(|share| !(**share >= 0.0 && share.is_finite())) {
        return Err(invalid("cumulative", format!("found {share}"), "finite numbers of at least 0"));
    }
    if let Some(two) = cumulative.windows(2).find(|two| two[0] > two[1]) {
        let found = format!("{} is below {} before it", two[1], two[0]);
        return Err(invalid("cumulative", found, "shares of smaller radii, which do not fall"));
    }
    if cumulative.first() == cumulative.last() {
        return Err(invalid(
            "cumulative",
            "all shares are the same".to_owned(),
            "shares that rise from the first to the last",
        ));
    }
    Ok(())
}
