//! Numbers as text: exact for files, rounded for people.

/// The shortest text that reads back as the same number; `nan`, `inf`, `-inf` for the rest.
///
/// Exponents appear outside 10⁻⁴ ... 10¹⁵, where plain digits would be hard to count.
pub(crate) fn exact(value: f64) -> String {
    if let Some(word) = not_finite(value) {
        return word.to_owned();
    }
    let plain = value == 0.0 || (1.0e-4..1.0e15).contains(&value.abs());
    if plain { format!("{value}") } else { format!("{value:e}") }
}

/// A number rounded to `digits` significant digits (at least one), without trailing zeros.
///
/// Exponents appear below 10⁻⁴ and where the digits before the point would exceed the significant ones.
///
/// ```
/// use pulvis_io::table::significant;
///
/// assert_eq!(significant(0.012345, 3), "0.0123");
/// assert_eq!(significant(6.25e9, 3), "6.25e9");
/// assert_eq!(significant(f64::NAN, 3), "nan");
/// ```
pub fn significant(value: f64, digits: usize) -> String {
    if let Some(word) = not_finite(value) {
        return word.to_owned();
    }
    // Seventeen digits tell every f64 apart; more would be noise.
    let digits = digits.clamp(1, 17);
    // The exponent after rounding: 9.996 to three digits is 1.00e1.
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..(digits as i32).max(6)).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        // Whole numbers of up to six digits are shown whole: 123456 reads better than 1.235e5.
        trim(&format!("{value:.decimals$}")).to_owned()
    } else {
        format!("{}e{exponent}", trim(mantissa))
    }
}

fn not_finite(value: f64) -> Option<&'static str> {
    if value.is_nan() {
        Some("nan")
    } else if value.is_infinite() {
        Some(if value > 0.0 { "inf" } else { "-inf" })
    } else {
        None
    }
}

fn trim(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn exact_text_reads_back_as_the_same_bits() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut values = vec![0.0, -0.0, 1.0, 0.1, 1e-4, 9.999e14, 1e15, f64::MAX, f64::MIN_POSITIVE, 5e-324];
        for _ in 0..2000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            values.push(f64::from_bits(state));
        }
        for value in values.into_iter().filter(|value| value.is_finite()) {
            let text = exact(value);
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
            assert!(text.len() < 26, "{text}");
        }
    }

    #[test]
    fn rounding_keeps_the_significant_digits_only() {
        let cases = [
            (0.0, 4, "0"),
            (9.996, 3, "10"),
            (-0.000123456, 3, "-0.000123"),
            (1.5e-7, 3, "1.5e-7"),
            (123456.0, 3, "123456"),
            (1234567.0, 3, "1.23e6"),
            (20000.0, 6, "20000"),
            (0.5, 0, "0.5"),
            (f64::NEG_INFINITY, 3, "-inf"),
        ];
        for (value, digits, expected) in cases {
            assert_eq!(significant(value, digits), expected);
        }
    }
}
