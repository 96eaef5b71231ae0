//! Maxima and minima that NaN comes through.
//!
//! `f64::max` passes over a NaN: the maximum of errors looks good where one of them could not even be
//! computed.

/// The larger of two numbers; NaN if either is.
///
/// ```
/// let errors = [1e-6, f64::NAN, 1e-9];
/// assert!(errors.into_iter().fold(0.0, pulvis_math::max_or_nan).is_nan());
/// assert_eq!(errors.into_iter().fold(0.0, f64::max), 1e-6);
/// ```
pub fn max_or_nan(one: f64, other: f64) -> f64 {
    if one >= other || one.is_nan() { one } else { other }
}

/// The smaller of two numbers; NaN if either is.
pub fn min_or_nan(one: f64, other: f64) -> f64 {
    if one <= other || one.is_nan() { one } else { other }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_comes_through_from_either_side() {
        for number in [0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            for extreme in [max_or_nan, min_or_nan] {
                assert!(extreme(number, f64::NAN).is_nan() && extreme(f64::NAN, number).is_nan());
            }
        }
    }

    #[test]
    fn of_numbers_the_larger_and_the_smaller_one_are_found_in_either_order() {
        for (small, large) in [(-2.0, 1.0), (0.5, f64::INFINITY), (f64::NEG_INFINITY, 0.0)] {
            assert_eq!([max_or_nan(small, large), max_or_nan(large, small)], [large; 2]);
            assert_eq!([min_or_nan(small, large), min_or_nan(large, small)], [small; 2]);
        }
    }
}
