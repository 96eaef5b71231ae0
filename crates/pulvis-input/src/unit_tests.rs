#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;

fn decimal_unit(text: &str) -> (Dimension, i32) {
    let unit = Unit::parse(text).unwrap();
    assert_eq!((unit.numerator, unit.denominator), (1.0, 1.0), "{text}");
    (unit.dimension, unit.decimal)
}

#[test]
fn units_of_mechanics_have_their_dimension_and_power_of_ten() {
    for (text, dimension, decimal) in [
        ("mm", Dimension::LENGTH, -3),
        ("um", Dimension::LENGTH, -6),
        ("µm", Dimension::LENGTH, -6),
        ("μm", Dimension::LENGTH, -6),
        ("mg", Dimension::MASS, -6),
        ("kg", Dimension::MASS, 0),
        ("kg/m^3", Dimension::DENSITY, 0),
        ("g/cm3", Dimension::DENSITY, 3),
        ("g cm⁻³", Dimension::DENSITY, 3),
        ("GPa", Dimension::PRESSURE, 9),
        ("N/mm^2", Dimension::PRESSURE, 6),
        ("kN/m", Dimension::STIFFNESS, 3),
        ("kg/s", Dimension::DASHPOT, 0),
        ("N s/m", Dimension::DASHPOT, 0),
        ("kg m^2/s", Dimension::ROTATIONAL_DASHPOT, 0),
        ("kg·m²/s", Dimension::ROTATIONAL_DASHPOT, 0),
        ("m / s^2", Dimension::ACCELERATION, 0),
        ("m/s/s", Dimension::ACCELERATION, 0),
        ("rad/s", Dimension::RATE, 0),
        ("1/s", Dimension::RATE, 0),
        ("/s", Dimension::RATE, 0),
        ("kHz", Dimension::RATE, 3),
        ("mJ", Dimension::ENERGY, -3),
        ("us", Dimension::TIME, -6),
        ("%", Dimension::NONE, -2),
        ("kg^2 m^0 s^1", Dimension::new(2, 0, 1), 0),
        ("pC", Dimension::CHARGE, -12),
        ("mA s", Dimension::CHARGE, -3),
        ("kV", Dimension::VOLTAGE, 3),
        ("K", Dimension::TEMPERATURE, 0),
    ] {
        assert_eq!(decimal_unit(text), (dimension, decimal), "{text}");
    }
}

#[test]
fn hours_and_degrees_carry_a_factor_that_is_no_power_of_ten() {
    let speed = Unit::parse("km/h").unwrap();
    assert_eq!((speed.dimension, speed.decimal, speed.denominator), (Dimension::VELOCITY, 3, 3600.0));
    let turn = Unit::parse("deg/min").unwrap();
    assert_eq!((turn.numerator, turn.denominator), (std::f64::consts::PI, 180.0 * 60.0));
}

#[test]
fn a_milli_minute_does_not_exist() {
    assert!(matches!(Unit::parse("mmin"), Err(UnitError::Unknown { .. })));
}

#[test]
fn a_wrong_case_is_recognised() {
    let similar = |text| Unit::parse(text).unwrap_err().similar().map(str::to_owned);
    assert_eq!(similar("kn/m").as_deref(), Some("kN"));
    assert_eq!(similar("pa").as_deref(), Some("Pa"));
    assert_eq!(similar("furlong"), None);
    assert_eq!(Unit::parse("furlong").unwrap_err().to_string(), "unknown unit `furlong`");
}

#[test]
fn doubtful_units_are_refused() {
    assert!(matches!(Unit::parse("N/m s"), Err(UnitError::ProductAfterSlash { .. })));
    assert!(matches!(Unit::parse("kg/"), Err(UnitError::NothingAfterSlash { .. })));
    assert!(matches!(Unit::parse("N//m"), Err(UnitError::NothingAfterSlash { .. })));
    assert!(matches!(Unit::parse("m^x"), Err(UnitError::Exponent { .. })));
    assert!(matches!(Unit::parse("m^1.5"), Err(UnitError::Exponent { .. })));
    assert!(matches!(Unit::parse("m^999999999999"), Err(UnitError::Exponent { .. })));
    assert!(matches!(Unit::parse("m**2"), Err(UnitError::Unknown { .. })));
    let product = ["m^12"; 20].join(" ");
    assert!(matches!(Unit::parse(&product), Err(UnitError::Exponent { .. })));
}
