//! Parameter values of a law: those of its example, and random ones around them.

use pulvis_contact::catalogue::{
    InvalidParameter, Kind, LawEntry, Parameter, Presence, Range, Value, Values,
};
use pulvis_contact::{ExpectedLoading, Friction, Pair, Quantities, friction};
use pulvis_math::{Dimension, elementary};

use crate::draw::Draw;

/// The name and the values that the example of `entry` gives. Examples are written in the unit of
/// the catalogue, so that they need no conversion.
pub fn example(entry: &LawEntry) -> (String, Values) {
    let table: toml::Table = entry.example.parse().expect("the example is TOML");
    let mut name = entry.name.to_owned();
    let mut values = Values::new();
    for (key, item) in &table {
        if key == "law" {
            item.as_str().expect("a law's name is text").clone_into(&mut name);
            continue;
        }
        let parameter = entry.parameter(key).unwrap_or_else(|| panic!("{}: unknown key {key}", entry.name));
        values.set(key, value(parameter, item));
    }
    (name, values)
}

fn value(parameter: &Parameter, item: &toml::Value) -> Value {
    match (parameter.kind, item) {
        (Kind::Choice(_), toml::Value::String(text)) => Value::Choice(text.clone()),
        (Kind::Number { .. }, toml::Value::String(text)) => {
            let (number, unit) = text.split_once(' ').expect("a number and a unit");
            assert_eq!(unit, parameter.unit(), "{}: the unit of the example", parameter.name);
            Value::Number(number.parse().expect("a number"))
        }
        (Kind::Number { .. }, toml::Value::Float(number)) => bare(parameter, *number),
        (Kind::Number { .. }, toml::Value::Integer(number)) => bare(parameter, *number as f64),
        (Kind::Numbers { .. }, toml::Value::Array(items)) => {
            let number = |item: &toml::Value| {
                let (number, unit) = item.as_str()?.split_once(' ')?;
                (unit == parameter.unit()).then(|| number.parse::<f64>().ok())?
            };
            Value::Numbers(items.iter().map(|item| number(item).expect("a number and its unit")).collect())
        }
        _ => panic!("{}: the example's value is of the wrong kind", parameter.name),
    }
}

fn bare(parameter: &Parameter, number: f64) -> Value {
    assert_eq!(parameter.unit(), "1", "{}: only pure numbers go without a unit", parameter.name);
    Value::Number(number)
}

/// A law of random parameters: those of the example times a factor up to thirty, now and then at the
/// end of the range or equal to another parameter. Draws again where the parameters do not fit.
pub fn random_law<L>(
    entry: &LawEntry,
    draw: &mut Draw,
    build: impl Fn(&str, &Values) -> Option<Result<L, InvalidParameter>>,
) -> L {
    for _ in 0..1000 {
        let values = random_values(entry, draw);
        match build(entry.name, &values).expect("a listed law") {
            Ok(law) => return law,
            Err(InvalidParameter::Inconsistent { .. } | InvalidParameter::Missing { .. }) => {}
            Err(error) => panic!("{}: a value inside its range is refused: {error}", entry.name),
        }
    }
    panic!("{}: a thousand draws and no set of parameters that fits", entry.name)
}

/// A friction law of random parameters.
pub fn random_friction(entry: &LawEntry, draw: &mut Draw) -> Option<Friction> {
    random_law(entry, draw, |name, values| friction::build(entry.role, name, values))
}

fn random_values(entry: &LawEntry, draw: &mut Draw) -> Values {
    let (_, around) = example(entry);
    let mut values = Values::new();
    for parameter in entry.parameters {
        let needed = parameter.presence == Presence::Required;
        let in_example = around.get(parameter.name).is_some();
        // What the example names is mostly kept: laws with several ways of being given have one there.
        let given = needed || draw.chance(if in_example { 0.8 } else { 0.3 });
        if !given {
            continue;
        }
        let chosen = match parameter.kind {
            Kind::Choice(options) => Value::Choice(draw.one_of(options).name.to_owned()),
            Kind::Numbers { .. } => Value::Numbers(random_list(entry, parameter, (&around, &values), draw)),
            Kind::Number { range, may_be_infinite, .. } => {
                let center = center(parameter, &around);
                let alike = values_alike(entry, parameter, &values);
                Value::Number(random_number(range, may_be_infinite, center, &alike, draw))
            }
        };
        values.set(parameter.name, chosen);
    }
    values
}

/// The list of the example in a unit of another size, in steps of other lengths. Lists of one dimension have one unit, so
/// that they fit each other about as well as those of the example.
fn random_list(
    entry: &LawEntry,
    parameter: &Parameter,
    (around, drawn): (&Values, &Values),
    draw: &mut Draw,
) -> Vec<f64> {
    let example = around.numbers(parameter.name).expect("the example has every list");
    let alike = entry.parameters.iter().filter(|other| other.unit() == parameter.unit());
    let mut sizes = alike.filter_map(|other| {
        let (drawn, example) = (drawn.numbers(other.name).ok()?, around.numbers(other.name).ok()?);
        Some(drawn.last()? / example.last()?)
    });
    let size = sizes.next().unwrap_or_else(|| draw.log_between(1.0 / 30.0, 30.0));
    let mut last = example.first().copied().unwrap_or_default() * size;
    let mut list = vec![last];
    for two in example.windows(2) {
        last += (two[1] - two[0]) * size * draw.log_between(0.7, 1.4);
        list.push(last);
    }
    list
}

fn center(parameter: &Parameter, around: &Values) -> f64 {
    match (around.optional_number(parameter.name), parameter.presence) {
        (Some(number), _) | (None, Presence::Default(number)) if number > 0.0 && number.is_finite() => number,
        _ => 0.5,
    }
}

/// The numbers among `values` that have the dimension of a parameter.
fn values_alike(entry: &LawEntry, parameter: &Parameter, values: &Values) -> Vec<f64> {
    let unit = parameter.unit();
    let number = |(name, value): (&str, &Value)| match value {
        Value::Number(number) if entry.parameter(name).is_some_and(|other| other.unit() == unit) => {
            Some(*number)
        }
        _ => None,
    };
    values.iter().filter_map(number).collect()
}

fn random_number(range: Range, may_be_infinite: bool, center: f64, others: &[f64], draw: &mut Draw) -> f64 {
    if may_be_infinite && draw.chance(0.2) {
        return f64::INFINITY;
    }
    if draw.chance(0.15) {
        match range {
            Range::NonNegative => return 0.0,
            Range::AtLeast(end) | Range::Within(_, end) | Range::Between(_, end) => return end,
            Range::Any | Range::Positive => {}
        }
    }
    let fits = |number: &f64| range.holds(*number) && (number.is_finite() || may_be_infinite);
    let equal: Vec<f64> = others.iter().copied().filter(fits).collect();
    if !equal.is_empty() && draw.chance(0.1) {
        return *draw.one_of(&equal);
    }
    let number = draw.log_between(center / 30.0, center * 30.0);
    match range {
        Range::Between(from, end) => from + (end - from) * draw.unit(),
        Range::Within(above, end) => above + (end - above) * draw.between(0.01, 1.0),
        Range::AtLeast(least) => number.max(least),
        _ => number,
    }
}

/// Masses [kg] and radii [m] of two random spheres; every third time `None`, a wall, for the second.
pub fn random_bodies(draw: &mut Draw) -> ((f64, f64), Option<(f64, f64)>) {
    let mut body = |near: f64| {
        let radius = near * draw.log_between(0.3, 3.0);
        let density = draw.between(500.0, 8000.0);
        (density * 4.0 / 3.0 * std::f64::consts::PI * elementary::powi(radius, 3), radius)
    };
    let near = 1e-3;
    let (first, second) = (body(near), body(near));
    (first, draw.chance(0.67).then_some(second))
}

/// The pair of two bodies, each a mass [kg] and a radius [m].
pub fn pair_of((mass_i, radius_i): (f64, f64), body_j: Option<(f64, f64)>) -> Pair {
    match body_j {
        Some((mass_j, radius_j)) => Pair::spheres(mass_i, mass_j, radius_i, radius_j),
        None => Pair::wall(mass_i, radius_i),
    }
}

/// A pair of random bodies.
pub fn random_pair(draw: &mut Draw) -> Pair {
    let (body_i, body_j) = random_bodies(draw);
    pair_of(body_i, body_j)
}

/// The pair with random values of the particle quantities that the two laws along the line of centres read.
pub fn with_random_quantities(
    pair: Pair,
    normal: &LawEntry,
    attraction: Option<&LawEntry>,
    draw: &mut Draw,
) -> Pair {
    let length = pair.harmonic_radius();
    let mut random = |quantity: &Parameter| -> [f64; 2] {
        let Kind::Number { dimension, range, .. } = quantity.kind else { panic!("no number: {quantity:?}") };
        let size = if dimension == Dimension::LENGTH {
            length * draw.log_between(1e-5, 0.05)
        } else if dimension == Dimension::VOLUME {
            length * length * length * draw.log_between(1e-6, 1e-2)
        } else if dimension == Dimension::CHARGE {
            draw.log_between(1e-13, 1e-10)
        } else {
            draw.log_between(0.1, 10.0)
        };
        std::array::from_fn(|_| {
            let value = size * draw.log_between(0.3, 3.0) * if draw.chance(0.5) { 1.0 } else { -1.0 };
            if range.holds(value) { value } else { -value }
        })
    };
    let mut quantities = Quantities::default();
    for (slot, quantity) in quantities.normal.iter_mut().zip(normal.particle_quantities) {
        *slot = random(quantity);
    }
    let of_attraction = attraction.map_or(&[][..], |entry| entry.particle_quantities);
    for (slot, quantity) in quantities.attraction.iter_mut().zip(of_attraction) {
        *slot = random(quantity);
    }
    pair.with_quantities(quantities)
}

/// The loading of contacts that are pressed to an overlap [m]: laws without a steepest slope take their stiffness from
/// it.
pub fn loaded_to(overlap: f64, pair: &Pair) -> ExpectedLoading {
    // Over the effective radius, half the harmonic mean.
    ExpectedLoading { speed: 0.0, force: 0.0, overlap: 2.0 * overlap * pair.inverse_harmonic_radius() }
}
