//! Range, ticks and tick labels of one axis.

use super::chart::Axis;
use super::unit::plain_orders;
use crate::table::significant;
use std::ops::RangeInclusive;

/// Numbers beyond this cannot be spread over an axis without overflow; they count as infinite.
pub(super) const LARGEST: f64 = 1.0e300;

/// Share of the span that is left free at each end of an automatic range.
pub(super) const PADDING: f64 = 0.04;

/// An axis with a definite range, ready to place values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scale {
    /// Ends in axis coordinates: the value itself, or its decimal logarithm.
    low: f64,
    high: f64,
    logarithmic: bool,
    /// Orders of magnitude that are shown without a common power of ten.
    plain: RangeInclusive<i32>,
}

/// A place on the axis that is labelled.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// Place from 0 (low end) to 1 (high end).
    pub(crate) place: f64,
    /// Text; empty for a minor tick.
    pub(crate) label: String,
}

impl Scale {
    /// The range that the axis fixes, or else the one that fits `values`.
    pub(crate) fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let (logarithmic, plain) = (axis.logarithmic, plain_orders(&axis.label));
        let coordinate = |value: f64| coordinate(value, logarithmic);
        let fixed = axis.range.map(|range| range.map(coordinate));
        if let Some([Some(low), Some(high)]) = fixed
            && (high - low).abs() > 1.0e-300
        {
            return Self { low, high, logarithmic, plain };
        }
        let ends = values.filter_map(coordinate).fold(None, |ends: Option<(f64, f64)>, value| {
            Some(ends.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
        });
        let (low, high) = ends.unwrap_or((0.0, 1.0));
        let middle = 0.5 * (low + high);
        // A span lost in rounding (all values equal) gets a tenth of the value, or half a decade, or one.
        let least = if logarithmic { 0.5 } else { 1.0e-9 * middle.abs() };
        let span = high - low;
        let (low, high) = if span > least.max(1.0e-290) {
            (low - PADDING * span, high + PADDING * span)
        } else {
            let half = if logarithmic {
                0.5
            } else if middle.abs() > 1.0e-280 {
                0.1 * middle.abs()
            } else {
                1.0
            };
            (middle - half, middle + half)
        };
        Self { low, high, logarithmic, plain }
    }

    /// Place of a value: 0 at the low end, 1 at the high end; `None` for a gap.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        coordinate(value, self.logarithmic).map(|x| (x - self.low) / (self.high - self.low))
    }

    /// Ticks for an axis that has room for about `room` labels, and the exponent that the labels leave out.
    pub(crate) fn ticks(&self, room: f64) -> (Vec<Tick>, i32) {
        let (low, high) = (self.low.min(self.high), self.low.max(self.high));
        if !self.logarithmic {
            let (values, step) = round_values(low, high, room);
            let (values, exponent, decimals) = common_exponent(values, step, &self.plain);
            let unit = 10_f64.powi(-exponent);
            let label = |value: f64| clear_sign(format!("{:.decimals$}", value * unit));
            return (values.into_iter().filter_map(|v| self.tick(v, label(v))).collect(), exponent);
        }
        let decades = high - low;
        let ticks = if decades < 1.0 {
            let (values, _) = round_values(10_f64.powf(low), 10_f64.powf(high), room);
            values.into_iter().filter_map(|value| self.tick(value, significant(value, 4))).collect()
        } else {
            self.decade_ticks(low, high, room)
        };
        (ticks, 0)
    }

    /// Powers of ten with labels, and the multiples between them as minor ticks (labelled where there is room).
    fn decade_ticks(&self, low: f64, high: f64, room: f64) -> Vec<Tick> {
        let stride = ((high - low) / room.max(1.0)).ceil().max(1.0) as i32;
        let multiples: &[i32] = if stride > 1 { &[1] } else { &[1, 2, 3, 4, 5, 6, 7, 8, 9] };
        // With few decades the plain numbers 0.2, 0.5, 1 say more than powers.
        let few = (high - low) * 3.0 <= room;
        let mut ticks = Vec::new();
        let decades = low.floor() as i32..=high.ceil() as i32;
        // Hundreds of decades: ticks without a label would only blacken the axis.
        for decade in decades.filter(|decade| stride <= 10 || decade.rem_euclid(stride) == 0) {
            for &multiple in multiples {
                let value = f64::from(multiple) * 10_f64.powi(decade);
                let label = match multiple {
                    1 if decade.rem_euclid(stride) == 0 && few && (-3..4).contains(&decade) => {
                        significant(value, 4)
                    }
                    1 if decade.rem_euclid(stride) == 0 => power_of_ten(decade),
                    2 | 5 if few && (-3..4).contains(&decade) => significant(value, 4),
                    _ => String::new(),
                };
                ticks.extend(self.tick(value, label));
            }
        }
        ticks
    }

    fn tick(&self, value: f64, label: String) -> Option<Tick> {
        let place = self.place(value)?;
        (-1.0e-9..=1.0 + 1.0e-9).contains(&place).then_some(Tick { place, label })
    }
}

/// `10ⁿ` with the digits of the exponent raised.
pub(crate) fn power_of_ten(exponent: i32) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

fn coordinate(value: f64, logarithmic: bool) -> Option<f64> {
    if !value.is_finite() || value.abs() > LARGEST {
        None
    } else if logarithmic {
        (value > 0.0).then(|| value.log10())
    } else {
        Some(value)
    }
}

/// Multiples of 1, 2 or 5 times a power of ten between the ends, and their step.
fn round_values(low: f64, high: f64, room: f64) -> (Vec<f64>, f64) {
    let rough = (high - low) / room.max(1.0);
    let power = 10_f64.powi(rough.log10().floor() as i32);
    let step = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    let step = step.into_iter().find(|&step| step >= rough * (1.0 - 1.0e-9)).unwrap_or(10.0 * power);
    let first = (low / step - 1.0e-6).ceil();
    let count = ((high / step + 1.0e-6).floor() - first).clamp(0.0, 100.0) as usize;
    // `+ 0.0` turns a negative zero into zero.
    ((0..=count).map(|number| (first + number as f64) * step + 0.0).collect(), step)
}

/// Leaves out a common power of ten (in threes) where the plain labels would be long; also the decimals that remain.
fn common_exponent(values: Vec<f64>, step: f64, plain: &RangeInclusive<i32>) -> (Vec<f64>, i32, usize) {
    let largest = values.iter().fold(step, |largest, value| largest.max(value.abs()));
    let order = largest.log10().floor() as i32;
    let exponent = if plain.contains(&order) { 0 } else { 3 * order.div_euclid(3) };
    let decimals = -((step.log10() + 1.0e-6).floor() as i32 - exponent);
    (values, exponent, decimals.clamp(0, 12) as usize)
}

/// A real minus sign, as wide as a plus.
fn clear_sign(text: String) -> String {
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn labels(axis: &Axis, values: &[f64], room: f64) -> (Vec<String>, i32) {
        let (ticks, exponent) = Scale::new(axis, values.iter().copied()).ticks(room);
        let labels = ticks.into_iter().map(|tick| tick.label).filter(|label| !label.is_empty());
        (labels.collect(), exponent)
    }

    fn logarithmic() -> Axis {
        Axis { logarithmic: true, ..Axis::default() }
    }

    #[test]
    fn linear_ticks_are_round_numbers() {
        let expected = ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"].map(String::from).to_vec();
        assert_eq!(labels(&Axis::default(), &[0.0, 1.0], 6.0), (expected, 0));
        let expected = ["\u{2212}1", "0", "1", "2"].map(String::from).to_vec();
        assert_eq!(labels(&Axis::default(), &[-1.2e-6, 2.0e-6], 5.0), (expected, -6));
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        let expected = ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"].map(String::from).to_vec();
        assert_eq!(labels(&logarithmic(), &[1.0e-6, 1.0e-3], 6.0), (expected, 0));
        let expected = ["0.1", "0.2", "0.5", "1"].map(String::from).to_vec();
        assert_eq!(labels(&logarithmic(), &[0.1, 1.0], 6.0), (expected, 0));
    }

    #[test]
    fn strange_values_still_give_a_usable_axis() {
        let strange: &[&[f64]] = &[
            &[],
            &[f64::NAN],
            &[f64::INFINITY, f64::NEG_INFINITY],
            &[0.0],
            &[5e-324, 0.0],
            &[f64::MAX, f64::MIN],
            &[1e300, -1e300],
            &[7.0, 7.0],
            &[1.0, 1.0 + f64::EPSILON],
            &[-3.0, 0.0],
            &[1e-300, 1e300],
        ];
        for axis in [Axis::default(), logarithmic()] {
            for values in strange {
                let scale = Scale::new(&axis, values.iter().copied());
                assert!(
                    scale.low < scale.high && (scale.high - scale.low).is_finite(),
                    "{values:?}: {scale:?}"
                );
                let (ticks, _) = scale.ticks(6.0);
                assert!(ticks.len() < 200, "{values:?}");
                assert!(ticks.iter().all(|tick| tick.place.is_finite()), "{values:?}");
            }
        }
    }

    #[test]
    fn a_fixed_range_is_kept_and_a_useless_one_is_not() {
        let fixed = Axis { range: Some([0.0, 2.0]), ..Axis::default() };
        assert_eq!(Scale::new(&fixed, [5.0, 6.0].into_iter()).place(1.0), Some(0.5));
        for range in [[1.0, 1.0], [f64::NAN, 1.0]] {
            let useless = Axis { range: Some(range), ..Axis::default() };
            assert!(
                Scale::new(&useless, [5.0, 6.0].into_iter())
                    .place(5.5)
                    .is_some_and(|p| (p - 0.5).abs() < 1e-12)
            );
        }
        assert_eq!(Scale::new(&logarithmic(), [1.0, 10.0].into_iter()).place(-1.0), None);
    }
}
