//! Decimal numbers as they stand in a text, kept as digits until the unit is known.

use crate::unit::Unit;

/// A decimal number as written: digits, and the power of ten.
pub(crate) struct Decimal<'t> {
    /// Sign, digits and point.
    pub(crate) mantissa: &'t str,
    /// Power of ten.
    exponent: i64,
}

impl Decimal<'_> {
    /// The number in SI, rounded once where the unit is a power of ten; `None` beyond the range of `f64`.
    pub(crate) fn in_si(&self, unit: &Unit) -> Option<f64> {
        let exponent = self.exponent + i64::from(unit.decimal);
        let decimal: f64 = format!("{}e{exponent}", self.mantissa).parse().ok()?;
        let value = decimal * unit.numerator / unit.denominator;
        let lost = value == 0.0 && self.mantissa.contains(|digit| ('1'..='9').contains(&digit));
        (value.is_finite() && !lost).then_some(value)
    }
}

/// Splits `inf N/m` and `nan` into value and unit.
pub(crate) fn split_special(text: &str) -> Option<(f64, &str)> {
    let (sign, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    let words = [("infinity", f64::INFINITY), ("inf", f64::INFINITY), ("nan", f64::NAN)];
    words.into_iter().find_map(|(word, value)| {
        let head = unsigned.get(..word.len())?;
        let rest = unsigned.get(word.len()..)?;
        let whole = head.eq_ignore_ascii_case(word) && !rest.starts_with(char::is_alphanumeric);
        whole.then_some((sign * value, rest))
    })
}

/// Splits the longest number off the front.
pub(crate) fn split_number(text: &str) -> Option<(Decimal<'_>, &str)> {
    let bytes = text.as_bytes();
    let digits_from =
        |start: usize| bytes.iter().skip(start).take_while(|byte| byte.is_ascii_digit()).count();
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits_from(sign);
    let mut end = sign + whole;
    let mut digits = whole;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits_from(end + 1);
        digits += fraction;
        end += 1 + fraction;
    }
    if digits == 0 {
        return None;
    }
    let mantissa = text.get(..end)?;
    let mut exponent = 0;
    // `5EJ` is five exajoule: an `e` belongs to the number only where digits follow.
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let count = digits_from(end + 1 + signed);
        if count > 0 {
            let stop = end + 1 + signed + count;
            // Far outside the range of f64 the exact power no longer matters.
            let clamped = if bytes.get(end + 1) == Some(&b'-') { -1_000_000 } else { 1_000_000 };
            exponent =
                text.get(end + 1..stop)?.parse::<i64>().unwrap_or(clamped).clamp(-1_000_000, 1_000_000);
            end = stop;
        }
    }
    Some((Decimal { mantissa, exponent }, text.get(end..)?))
}
