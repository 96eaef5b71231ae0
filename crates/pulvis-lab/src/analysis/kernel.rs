//! Kernels of coarse graining.

#[cfg(test)]
use std::f64::consts::PI;

use pulvis_math::elementary;

/// A function of the distance that spreads what sits in a point over space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// Lucy's: 105/(16 π w³) (1 + 3 r/w) (1 − r/w)³ for r < w, with the width w.
    ///
    /// # Source
    /// L. B. Lucy, Astron. J. 82, 1013 (1977).
    Lucy,
    /// Gaussian with the standard deviation w, cut off at 3 w, where less than 3 % lie beyond.
    Gaussian,
}

/// Where the Gaussian ends, over its width.
const CUT: f64 = 3.0;

impl Kernel {
    /// All of them, with their names.
    pub const ALL: [(&'static str, Self); 2] = [("lucy", Self::Lucy), ("gaussian", Self::Gaussian)];

    /// The distance beyond which it is zero \[m\].
    pub fn reach(self, width: f64) -> f64 {
        match self {
            Self::Lucy => width,
            Self::Gaussian => CUT * width,
        }
    }

    /// Its value at a distance, up to a factor that makes the integral one: the deposition divides by the sum over the cells.
    pub(super) fn shape(self, distance: f64, width: f64) -> f64 {
        let ratio = distance / width;
        match self {
            _ if distance >= self.reach(width) => 0.0,
            Self::Lucy => (1.0 + 3.0 * ratio) * (1.0 - ratio) * (1.0 - ratio) * (1.0 - ratio),
            Self::Gaussian => elementary::exp(-0.5 * ratio * ratio),
        }
    }

    /// The integral of [`Self::shape`] over all space \[m³\], which sums over fine grids come to.
    #[cfg(test)]
    pub(super) fn integral(self, width: f64) -> f64 {
        let volume = width * width * width;
        match self {
            Self::Lucy => 16.0 * PI / 105.0 * volume,
            // (2 π)^(3/2) w³ (erf(c/√2) − √(2/π) c exp(−c²/2)) with c = 3: the share of a χ² of three degrees below 9.
            Self::Gaussian => 0.970_709_113_465_111_8 * (2.0 * PI) * (2.0 * PI).sqrt() * volume,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integrals_are_those_of_the_shapes() {
        for (name, kernel) in Kernel::ALL {
            let (width, parts) = (0.7, 20_000);
            let step = kernel.reach(width) / f64::from(parts);
            let shell = |number: i32| {
                let radius = (f64::from(number) + 0.5) * step;
                4.0 * PI * radius * radius * step * kernel.shape(radius, width)
            };
            let sum: f64 = (0..parts).map(shell).sum();
            // The midpoint rule errs by the square of the step.
            assert!((sum / kernel.integral(width) - 1.0).abs() < 1e-7, "{name}: {sum}");
        }
    }
}
