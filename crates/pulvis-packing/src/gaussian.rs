//! Gaussian random numbers.

use pulvis_math::{Vector3, elementary};
use rand::RngExt;

use super::Random;

/// A Gaussian random number with zero mean and unit variance.
///
/// Crates of distributions take their logarithm from the standard library or from libm by how they were built,
/// which other crates of the same build decide; this one gives the same bits in every build on every machine.
///
/// # Source
/// G. Marsaglia, T. A. Bray, SIAM Review 6, 260 (1964): polar method. Its second number is not used, so that
/// the stream of random numbers is the only state.
pub(super) fn standard_normal(random: &mut Random) -> f64 {
    loop {
        let mut coordinate = || 2.0 * random.random::<f64>() - 1.0;
        let (x, y) = (coordinate(), coordinate());
        let square = x * x + y * y;
        if square > 0.0 && square < 1.0 {
            return x * (-2.0 * elementary::ln(square) / square).sqrt();
        }
    }
}

/// A vector of three independent Gaussian components with zero mean and unit variance.
pub fn gaussian_vector(random: &mut Random) -> Vector3 {
    let mut component = || standard_normal(random);
    Vector3::new(component(), component(), component())
}

#[cfg(test)]
mod tests {
    use super::super::random_stream;
    use super::*;

    #[test]
    fn gaussian_numbers_have_the_moments_and_the_tails_of_the_normal_distribution() {
        const COUNT: usize = 1_000_000;
        let mut random = random_stream(11);
        let drawn: Vec<f64> = (0..COUNT).map(|_| standard_normal(&mut random)).collect();
        let moment =
            |order: i32| drawn.iter().map(|&x| elementary::powi(x, order)).sum::<f64>() / COUNT as f64;
        // Four standard errors √(Var(xⁿ)/N); the variances are 1, 2, 15 and 96.
        for (order, expected, variance) in [(1, 0.0, 1.0), (2, 1.0, 2.0), (3, 0.0, 15.0), (4, 3.0, 96.0)] {
            let allowed = 4.0 * f64::sqrt(variance / COUNT as f64);
            assert!((moment(order) - expected).abs() < allowed, "moment {order}: {}", moment(order));
        }
        // Share beyond 1, 2 and 3 standard deviations (Abramowitz and Stegun, table 26.1), four standard errors.
        for (limit, share) in [(1.0, 0.317_310_5), (2.0, 0.045_500_3), (3.0, 0.002_699_8)] {
            let found = drawn.iter().filter(|x| x.abs() > limit).count() as f64 / COUNT as f64;
            assert!((found - share).abs() < 4.0 * f64::sqrt(share / COUNT as f64), "beyond {limit}: {found}");
        }
    }
}
