//! The elementary functions against values of 60 digits, and where they are exact.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;

use pulvis_math::elementary::*;

/// The function of a row of the reference values and its allowed error in units in the last place. The columns x and y
/// are the first and the second argument.
fn evaluate(name: &str, x: f64, y: f64) -> (f64, f64) {
    match name {
        "sin" => (sin(x), 1.0),
        "cos" => (cos(x), 1.0),
        "tan" => (tan(x), 1.0),
        "asin" => (asin(x), 1.0),
        "acos" => (acos(x), 1.0),
        "atan" => (atan(x), 1.0),
        "sinh" => (sinh(x), 2.0),
        "cosh" => (cosh(x), 2.0),
        "tanh" => (tanh(x), 2.0),
        "asinh" => (asinh(x), 2.0),
        "exp" => (exp(x), 1.0),
        "exp_m1" => (exp_m1(x), 1.0),
        "ln" => (ln(x), 1.0),
        "ln_1p" => (ln_1p(x), 1.0),
        "log10" => (log10(x), 1.0),
        "cbrt" => (cbrt(x), 0.5),
        "atan2" => (atan2(x, y), 2.0),
        "hypot" => (hypot(x, y), 1.0),
        "powf" => (powf(x, y), 1.0),
        _ => panic!("no function {name}"),
    }
}

/// Distance between neighbouring doubles at `value`.
fn unit_in_the_last_place(value: f64) -> f64 {
    value.abs().next_up() - value.abs()
}

#[test]
fn every_function_is_as_accurate_as_its_module_says() {
    let mut functions = BTreeSet::new();
    let mut rows = 0;
    for line in include_str!("data/elementary.csv").lines().skip(1) {
        let [name, x, y, nearest, rest] = line.split(',').collect::<Vec<_>>()[..] else { panic!("{line}") };
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        let (x, y, nearest, rest) = (number(x), number(y), number(nearest), number(rest));
        let (found, allowed) = evaluate(name, x, y);
        let error = ((found - nearest) - rest).abs() / unit_in_the_last_place(nearest);
        // 1e-9: the rest itself is rounded.
        assert!(error <= allowed + 1e-9, "{name}({x:e}, {y:e}) = {found:e} is {error:.3} units off");
        functions.insert(name);
        rows += 1;
    }
    assert!(rows > 900 && functions.len() == 19, "{rows} rows of {} functions", functions.len());
}

#[test]
fn exact_values_are_exact() {
    for (found, expected) in [
        (sin(0.0), 0.0),
        (cos(0.0), 1.0),
        (exp(0.0), 1.0),
        (ln(1.0), 0.0),
        (ln_1p(0.0), 0.0),
        (log10(1000.0), 3.0),
        (cbrt(-27.0), -3.0),
        (hypot(3.0, 4.0), 5.0),
        (atan2(0.0, 1.0), 0.0),
        (powf(7.3, 0.0), 1.0),
        (powf(7.3, 1.0), 7.3),
        (powf(0.0, 0.5), 0.0),
        (powf(2.0, -3.0), 0.125),
        (powf(9.0, 0.5), 3.0),
        (powi(0.1, 0), 1.0),
        (powi(1.1, 3), 1.1 * (1.1 * 1.1)),
        (powi(1.1, 5), 1.1 * ((1.1 * 1.1) * (1.1 * 1.1))),
        (powi(2.0, -1074), 0.0),
        (powi(-2.0, i32::MIN), 0.0),
        (sin_cos(0.7).0, sin(0.7)),
        (sin_cos(0.7).1, cos(0.7)),
    ] {
        assert_eq!(found, expected);
    }
    for undefined in
        [ln(-1.0), ln_1p(-1.5), log10(-1.0), asin(1.5), acos(-1.5), powf(-8.0, 1.0 / 3.0), sin(f64::NAN)]
    {
        assert!(undefined.is_nan());
    }
}
