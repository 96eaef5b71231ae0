//! Powers of ten of an axis, moved into the unit of its label: "time \[s\]" with 10⁻⁶ becomes "time \[µs\]".

use super::axis::power_of_ten;
use crate::table::significant;
use std::ops::RangeInclusive;

/// Units whose first symbol may take a prefix. (Not kg, which has one; not m², whose prefix would be squared.)
const PREFIXABLE: [&str; 14] =
    ["s", "m", "N", "J", "W", "Pa", "Hz", "V", "m/s", "m/s²", "N/m", "N m", "J/m²", "Pa s"];

/// Prefixes of the International System, from 10⁻²⁴ to 10²⁴ in steps of three.
const PREFIXES: [&str; 17] =
    ["y", "z", "a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P", "E", "Z", "Y"];

/// Quantity and unit of a label.
fn split(label: &str) -> (&str, Option<&str>) {
    let inside = label.trim_end().strip_suffix(']').and_then(|rest| rest.rsplit_once('['));
    inside.map_or((label.trim(), None), |(quantity, unit)| (quantity.trim(), Some(unit.trim())))
}

fn prefix(unit: &str, exponent: i32) -> Option<&'static str> {
    let number = usize::try_from(exponent.div_euclid(3) + 8).ok()?;
    (PREFIXABLE.contains(&unit) && exponent.rem_euclid(3) == 0).then(|| PREFIXES.get(number).copied())?
}

/// Orders of magnitude that an axis with this label shows as plain numbers.
pub(super) fn plain_orders(label: &str) -> RangeInclusive<i32> {
    let has_prefixes = split(label).1.is_some_and(|unit| PREFIXABLE.contains(&unit));
    if has_prefixes { -1..=3 } else { -3..=4 }
}

/// The label of an axis whose numbers leave out a power of ten.
pub(crate) fn label(label: &str, exponent: i32) -> String {
    if exponent == 0 {
        return label.to_owned();
    }
    let power = power_of_ten(exponent);
    match split(label) {
        (quantity, Some(unit)) => match prefix(unit, exponent) {
            Some(prefix) => format!("{quantity} [{prefix}{unit}]"),
            None if unit == "1" || unit == "-" => format!("{quantity} [{power}]"),
            None => format!("{quantity} [{power} {unit}]"),
        },
        ("", None) => format!("[{power}]"),
        (quantity, None) => format!("{quantity} [{power}]"),
    }
}

/// A value on an axis with the axis' quantity: "time = 3.2 µs".
pub(super) fn quote(label: &str, value: f64) -> String {
    let quantity = split(label).0;
    format!("{} = {}", if quantity.is_empty() { "x" } else { quantity }, amount(label, value))
}

/// A value with the unit of the label it belongs to, rounded: 3.2e-6 of "time \[s\]" is "3.2 µs".
pub fn amount(label: &str, value: f64) -> String {
    let unit = split(label).1.filter(|unit| !matches!(*unit, "1" | "-")).unwrap_or("");
    let order = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    let exponent = 3 * order.div_euclid(3);
    let (value, prefix) =
        prefix(unit, exponent).map_or((value, ""), |prefix| (value / 10_f64.powi(exponent), prefix));
    format!("{} {prefix}{unit}", significant(value, 4).replace('-', "\u{2212}")).trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_of_ten_becomes_the_prefix_of_the_unit_where_it_has_one() {
        let cases = [
            ("time [s]", -6, "time [µs]"),
            ("stress [Pa]", 9, "stress [GPa]"),
            ("velocity v [m/s]", -3, "velocity v [mm/s]"),
            ("area [m²]", -6, "area [10⁻⁶ m²]"),
            ("mass [kg]", -9, "mass [10⁻⁹ kg]"),
            ("relative error [1]", -6, "relative error [10⁻⁶]"),
            ("energy [J]", -30, "energy [10⁻³⁰ J]"),
            ("energy [J]", 0, "energy [J]"),
            ("count", 6, "count [10⁶]"),
            ("", 6, "[10⁶]"),
        ];
        for (given, exponent, expected) in cases {
            assert_eq!(label(given, exponent), expected);
        }
    }

    #[test]
    fn a_value_is_quoted_with_quantity_and_unit() {
        assert_eq!(quote("time [s]", 3.2164e-6), "time = 3.216 µs");
        assert_eq!(quote("χ [1]", 0.5), "χ = 0.5");
        assert_eq!(quote("", 7.0e-9), "x = 7e\u{2212}9");
        assert_eq!(quote("time [s]", 0.0), "time = 0 s");
    }
}
