#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use proptest::prelude::*;

fn message(text: &str, rule: impl Into<QuantityRule>) -> String {
    parse_quantity(text, rule).unwrap_err().to_string()
}

#[test]
fn a_quantity_is_the_nearest_number_to_its_decimal_value() {
    for (text, dimension, value) in [
        ("1.1 mm", Dimension::LENGTH, 1.1e-3),
        ("5 um", Dimension::LENGTH, 5e-6),
        ("0.7mm", Dimension::LENGTH, 7e-4),
        (" 2000 kg/m^3 ", Dimension::DENSITY, 2000.0),
        ("2.65 g/cm3", Dimension::DENSITY, 2650.0),
        ("5e-3 kg/s", Dimension::DASHPOT, 5e-3),
        ("70 GPa", Dimension::PRESSURE, 70e9),
        ("1e-5 N", Dimension::FORCE, 1e-5),
        ("20 kN/m", Dimension::STIFFNESS, 2e4),
        ("0.3 m/s", Dimension::VELOCITY, 0.3),
        ("36 km/h", Dimension::VELOCITY, 10.0),
        ("10 rad/s", Dimension::RATE, 10.0),
        ("1/s", Dimension::RATE, 1.0),
        ("3 us", Dimension::TIME, 3e-6),
        ("2 min", Dimension::TIME, 120.0),
        ("180 deg", Dimension::NONE, std::f64::consts::PI),
        ("5 %", Dimension::NONE, 0.05),
        ("-.5", Dimension::NONE, -0.5),
        ("5 EJ", Dimension::ENERGY, 5e18),
        ("5EJ", Dimension::ENERGY, 5e18),
    ] {
        assert_eq!(parse_quantity(text, dimension), Ok(value), "{text}");
    }
}

#[test]
fn infinity_is_a_value_only_where_it_is_allowed() {
    let rule = QuantityRule::of(Dimension::STIFFNESS).or_infinite();
    assert_eq!(parse_quantity("inf", rule), Ok(f64::INFINITY));
    assert_eq!(parse_quantity("inf N/m", rule), Ok(f64::INFINITY));
    assert_eq!(
        message("inf", Dimension::STIFFNESS),
        "\"inf\" is not finite; expected a finite value, a stiffness [N/m]"
    );
    assert!(parse_quantity("-inf", rule).is_err());
    assert_eq!(
        message("inf N", rule),
        "\"inf N\" is a force [N], expected a stiffness [N/m]; write for example \"1 N/m\""
    );
    assert_eq!(message("nan", rule), "\"nan\" is not a number; expected a stiffness [N/m]");
    assert_eq!(message("-NaN N/m", rule), "\"-NaN N/m\" is not a number; expected a stiffness [N/m]");
}

#[test]
fn a_message_says_what_was_found_what_was_expected_and_how_to_write_it() {
    assert_eq!(
        message("2 kN", Dimension::STIFFNESS),
        "\"2 kN\" is a force [N], expected a stiffness [N/m]; write for example \"2 N/m\""
    );
    assert_eq!(
        parse_bare("2.5", Dimension::LENGTH.into()).unwrap_err().to_string(),
        "2.5 has no unit; expected a length, write for example \"2.5 mm\""
    );
    assert_eq!(
        message("2", Dimension::ENERGY),
        "\"2\" has no unit; expected an energy, write for example \"2 J\""
    );
    assert_eq!(
        message("2 mm", Dimension::NONE),
        "\"2 mm\" is a length [m], expected a pure number; write for example 2"
    );
    assert_eq!(
        message("3 N s", Dimension::ENERGY),
        "\"3 N s\" is a quantity in [kg^1 m^1 s^-1], expected an energy [J]; write for example \"3 J\""
    );
    assert_eq!(
        message("3 kn", Dimension::FORCE),
        "\"3 kn\": unknown unit `kn`; expected a force [N]; did you mean `kN`?"
    );
    assert_eq!(
        message("large", Dimension::FORCE),
        "\"large\" does not begin with a number; expected a force [N], write for example \"1 N\""
    );
    assert_eq!(
        message("", Dimension::FORCE),
        "\"\" does not begin with a number; expected a force [N], write for example \"1 N\""
    );
}

#[test]
fn a_range_is_part_of_the_expectation() {
    let stiffness = QuantityRule::of(Dimension::STIFFNESS).above(0.0);
    assert_eq!(
        message("-1 N/m", stiffness),
        "\"-1 N/m\" is out of range; expected a stiffness [N/m] greater than 0"
    );
    assert_eq!(
        message("0 N/m", stiffness),
        "\"0 N/m\" is out of range; expected a stiffness [N/m] greater than 0"
    );
    let share = QuantityRule::of(Dimension::NONE).at_least(0.0).below(1.0);
    assert_eq!(parse_quantity("0", share), Ok(0.0));
    assert_eq!(
        message("1", share),
        "\"1\" is out of range; expected a pure number of at least 0 and smaller than 1"
    );
}

#[test]
fn a_number_beyond_the_range_of_doubles_is_refused_not_rounded_to_zero_or_infinity() {
    for text in ["1e999 m", "1e-999 m", "1e308 km", "1e99999999999999999999 m", "1e-99999999999999999999 m"] {
        let error = parse_quantity(text, Dimension::LENGTH).unwrap_err();
        assert!(matches!(error, QuantityError::NotRepresentable { .. }), "{text}: {error}");
    }
    assert_eq!(parse_quantity("0e-999 m", Dimension::LENGTH), Ok(0.0));
}

#[test]
fn a_bare_number_is_si_only_where_the_caller_says_so() {
    let rule = QuantityRule::of(Dimension::VELOCITY).or_bare();
    assert_eq!(parse_bare("0.1", rule), Ok(0.1));
    assert_eq!(parse_quantity("10 cm/s", rule), Ok(0.1));
}

/// Units whose factor is a power of ten.
const DECIMAL: &[(&str, Dimension)] = &[
    ("mm", Dimension::LENGTH),
    ("ym", Dimension::LENGTH),
    ("g", Dimension::MASS),
    ("kN/m", Dimension::STIFFNESS),
    ("g/cm^3", Dimension::DENSITY),
    ("GPa", Dimension::PRESSURE),
    ("%", Dimension::NONE),
    ("mm^2 ng/us", Dimension::ROTATIONAL_DASHPOT),
];

/// Units with another factor, and the factor as a reader would compute it.
const OTHER: &[(&str, Dimension, f64)] = &[
    ("min", Dimension::TIME, 60.0),
    ("m/h^2", Dimension::ACCELERATION, 1.0 / (3600.0 * 3600.0)),
    ("deg/s", Dimension::RATE, std::f64::consts::PI / 180.0),
];

proptest! {
    #[test]
    fn every_number_written_in_a_decimal_unit_comes_back_bit_for_bit(
        value in prop::num::f64::NORMAL,
        (unit, dimension) in prop::sample::select(DECIMAL),
    ) {
        let shift = Unit::parse(unit).unwrap().decimal;
        let text = format!("{value:e}");
        let (mantissa, exponent) = text.split_once('e').unwrap();
        let written = format!("{mantissa}e{} {unit}", exponent.parse::<i32>().unwrap() - shift);
        prop_assert_eq!(parse_quantity(&written, dimension), Ok(value), "{}", written);
    }

    #[test]
    fn other_units_multiply_by_their_factor(
        value in -1e100..1e100_f64,
        (unit, dimension, factor) in prop::sample::select(OTHER),
    ) {
        let read = parse_quantity(&format!("{value} {unit}"), dimension).unwrap();
        // Both sides round a handful of times.
        prop_assert!((read - value * factor).abs() <= 4.0 * f64::EPSILON * (value * factor).abs());
    }

    #[test]
    fn no_text_whatever_makes_the_reader_stumble(text in ".*") {
        if let Ok(value) = parse_quantity(&text, Dimension::LENGTH) {
            prop_assert!(value.is_finite());
        }
    }

    #[test]
    fn no_text_that_looks_like_a_quantity_makes_it_stumble(text in "[-+.0-9eEinfa µm/^*²³%]{0,16}") {
        if let Ok(value) = parse_quantity(&text, Dimension::LENGTH) {
            prop_assert!(value.is_finite());
        }
    }
}

#[test]
fn numbers_of_any_length_are_not_repeated_in_full() {
    let digits = "9".repeat(5000);
    for text in [format!("{digits} m"), digits.clone(), format!("{digits} m^{digits}")] {
        let message = parse_quantity(&text, Dimension::VELOCITY).unwrap_err().to_string();
        assert!(message.len() < 400, "{} letters", message.len());
    }
}
