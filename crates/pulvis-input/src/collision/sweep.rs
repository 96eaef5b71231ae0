//! What differs from collision to collision.

use super::incidence;
use super::speed::{Measure, Speed};
use crate::comparison::LabelledContact;
use crate::contact::{NamedContact, NamedLaw, entries};
use crate::context::Reported;
use crate::problem::{LONGEST_VALUE, Problem, shortened};
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Text;
use crate::similar::similar;
use crate::spacing::read_values;
use pulvis_contact::catalogue::{Kind, LawEntry, Parameter, Value};
use pulvis_math::Dimension;

/// More collisions than any picture needs; a slip of the pen should not fill the memory (a collision takes 1 to 2 kB).
const MOST_COLLISIONS: usize = 100_000;

/// The key of the engine's resolution, which can be swept beside law parameters.
pub(super) const STEPS: &str = "collision.steps_per_contact";

/// The variable of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub enum SweptVariable {
    /// Nothing is swept: one collision.
    Single,
    /// Relative speed outside the range of all forces [m/s].
    Velocity,
    /// Its part along the line of centres [m/s].
    NormalVelocity,
    /// χ = v_i/v_p0 with the touch velocity v_i, S1 (28a).
    Chi,
    /// ζ = v_i/v_p with the touch velocity v_i and f_a in v_p, S1 (28b).
    Zeta,
    /// A number in the scenario.
    Key {
        /// Its dotted path.
        path: String,
        /// Its unit.
        unit: String,
    },
}

impl SweptVariable {
    /// How a column or an axis is called.
    pub fn name(&self) -> &str {
        match self {
            Self::Single | Self::Velocity => "velocity",
            Self::NormalVelocity => "normal_velocity",
            Self::Chi => "chi",
            Self::Zeta => "zeta",
            Self::Key { path, .. } => path,
        }
    }

    /// The unit of the values.
    pub fn unit(&self) -> &str {
        match self {
            Self::Single | Self::Velocity | Self::NormalVelocity => "m/s",
            Self::Chi | Self::Zeta => "1",
            Self::Key { unit, .. } => unit,
        }
    }
}

/// One value of the sweep.
pub(super) struct Point {
    pub(super) value: f64,
    /// Set where the speed itself is swept.
    pub(super) speed: Option<Speed>,
}

/// A sweep as read.
pub(super) struct Sweep {
    pub(super) variable: SweptVariable,
    pub(super) logarithmic: bool,
    pub(super) points: Vec<Point>,
}

impl Sweep {
    /// No sweep: one collision.
    pub(super) fn single() -> Self {
        Self { variable: SweptVariable::Single, logarithmic: false, points: Vec::new() }
    }
}

/// Refuses a sweep that, once for each of so many `curves` (contacts, or values of a second variable), is too long.
pub(super) fn refuse_too_many(table: &TableReader<'_>, sweep: &Sweep, curves: usize) -> Result<(), Reported> {
    let points = sweep.points.len();
    if points.saturating_mul(curves) <= MOST_COLLISIONS {
        return Ok(());
    }
    let found = format!("{points} collisions for each of {curves} curves");
    Err(table.refuse("sweep", Problem::rule(found, format!("at most {MOST_COLLISIONS} in all"))))
}

/// What can be swept: how its values are written, and how the law judges them.
struct Sweepable {
    variable: SweptVariable,
    measure: Option<Measure>,
    rule: QuantityRule,
    parameter: Option<&'static Parameter>,
}

/// Reads `[collision.sweep]`.
pub(super) fn read_sweep(
    mut table: TableReader<'_>,
    contacts: &[LabelledContact],
) -> Result<Sweep, Reported> {
    let name = table.required("variable", Text)?;
    let Some(LabelledContact { contact, .. }) = contacts.first() else { return Ok(Sweep::single()) };
    let sweepable = find(&table, &name, contact)?;
    if sweepable.parameter.is_some() && contacts.len() > 1 {
        let found = format!("`{name}` belongs to one of the contacts that are compared");
        return Err(table.refuse("variable", Problem::rule(found, "a speed, or a key of `collision`")));
    }
    let (values, logarithmic) = read_values(&mut table, sweepable.rule)?;
    let mut points = Vec::new();
    for (index, value) in values.into_iter().enumerate() {
        let location =
            table.value("values").and_then(|list| Some(list.items("").ok()?.get(index)?.location()));
        let location = location.unwrap_or_else(|| table.location("from"));
        if let Some(parameter) = sweepable.parameter
            && let Err(error) = parameter.check(&Value::Number(value))
        {
            return Err(table.refuse_at(&location, Problem::Refused(Box::new(error))));
        }
        points.push(Point {
            value,
            speed: sweepable.measure.map(|measure| Speed { measure, value, location }),
        });
    }
    table.finish();
    Ok(Sweep { variable: sweepable.variable, logarithmic, points })
}

/// The descriptions of a contact's laws.
fn laws(contact: &NamedContact) -> Vec<&'static LawEntry> {
    let entry = |law: &NamedLaw| entries(law.role).into_iter().find(|entry| entry.name == law.name);
    contact.laws.iter().filter_map(entry).collect()
}

/// The variable called `name`.
fn find(table: &TableReader<'_>, name: &str, contact: &NamedContact) -> Result<Sweepable, Reported> {
    if let Some((_, measure)) = Measure::ALL.into_iter().find(|(known, _)| *known == name) {
        let variable = match measure {
            Measure::Velocity => SweptVariable::Velocity,
            Measure::NormalVelocity => SweptVariable::NormalVelocity,
            Measure::Chi => SweptVariable::Chi,
            Measure::Zeta => SweptVariable::Zeta,
        };
        return Ok(Sweepable { variable, measure: Some(measure), rule: measure.rule(), parameter: None });
    }
    let key = |unit: String| SweptVariable::Key { path: name.to_owned(), unit };
    if name == STEPS {
        let rule = QuantityRule::of(Dimension::NONE).at_least(1.0);
        return Ok(Sweepable { variable: key("1".to_owned()), measure: None, rule, parameter: None });
    }
    if let Some(motion) = name.strip_prefix("collision.").filter(|motion| incidence::KEYS.contains(motion)) {
        let unit = if motion == "angle" { "rad" } else { "rad/s" };
        let variable = key(unit.to_owned());
        return Ok(Sweepable {
            variable,
            measure: None,
            rule: incidence::rule(motion).or_bare(),
            parameter: None,
        });
    }
    if let Some((parameter, dimension, rule)) = swept_parameter(name, contact) {
        let variable = key(dimension.unit());
        return Ok(Sweepable { variable, measure: None, rule, parameter: Some(parameter) });
    }
    match parameter_at(name, contact) {
        Some(_) => Err(table.refuse("variable", Problem::rule(format!("`{name}` is a choice"), "a number"))),
        None => Err(unknown(table, name, contact)),
    }
}

/// The parameter of a law at `contact.<role>.<parameter>`.
fn parameter_at(path: &str, contact: &NamedContact) -> Option<&'static Parameter> {
    let (role, parameter) = path.strip_prefix("contact.")?.split_once('.')?;
    laws(contact).into_iter().find(|entry| entry.role.key() == role)?.parameter(parameter)
}

/// A number of a law, its dimension, and how its values are written.
pub(super) fn swept_parameter(
    path: &str,
    contact: &NamedContact,
) -> Option<(&'static Parameter, Dimension, QuantityRule)> {
    let parameter = parameter_at(path, contact)?;
    let Kind::Number { dimension, may_be_infinite, .. } = parameter.kind else { return None };
    let rule = QuantityRule::of(dimension).or_bare();
    Some((parameter, dimension, if may_be_infinite { rule.or_infinite() } else { rule }))
}

/// Reports a variable that does not exist.
fn unknown(table: &TableReader<'_>, name: &str, contact: &NamedContact) -> Reported {
    let mut known: Vec<String> = Measure::ALL.iter().map(|(name, _)| (*name).to_owned()).collect();
    for entry in laws(contact) {
        let numbers =
            entry.parameters.iter().filter(|parameter| matches!(parameter.kind, Kind::Number { .. }));
        known.extend(numbers.map(|parameter| format!("contact.{}.{}", entry.role.key(), parameter.name)));
    }
    known.push(STEPS.to_owned());
    known.extend(incidence::KEYS.iter().map(|key| format!("collision.{key}")));
    let suggestion = similar(name, known.iter().map(String::as_str)).map(str::to_owned);
    table.refuse_with_help(
        "variable",
        Problem::UnknownChoice {
            found: shortened(name, LONGEST_VALUE),
            choices: vec![
                "velocity".to_owned(),
                "chi".to_owned(),
                "zeta".to_owned(),
                "collision.<key>".to_owned(),
                "contact.<role>.<parameter>".to_owned(),
            ],
            similar: suggestion,
        },
        format!("known variables here: {}", known.join(", ")),
    )
}
