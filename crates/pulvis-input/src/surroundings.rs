//! What laws ask for beside the bodies and their motion: a temperature, and quantities of particles.

use crate::context::Reported;
use crate::list::List;
use crate::parameters::rule;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Shape;
use crate::value_reader::ValueReader;
use pulvis_boundary::{InvalidProgram, TemperatureProgram};
use pulvis_contact::catalogue::{Kind, Parameter};
use pulvis_contact::{ContactModel, Quantities};
use pulvis_math::Dimension;

/// What laws between two bodies may ask for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Temperature over time, from the start on; where it is given.
    pub temperature: Option<TemperatureProgram>,
    /// Quantities of the bodies that laws read.
    pub quantities: Vec<BodyQuantity>,
}

/// A quantity of both bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyQuantity {
    /// Its name.
    pub name: &'static str,
    /// Its SI unit.
    pub unit: String,
    /// Its values; zero of a wall.
    pub values: [f64; 2],
}

impl Surroundings {
    /// The values of a quantity, zero where it is not given.
    fn values(&self, name: &str) -> [f64; 2] {
        let found = self.quantities.iter().find(|quantity| quantity.name == name);
        found.map_or([0.0; 2], |quantity| quantity.values)
    }

    /// The quantities that the laws of a contact read.
    pub fn quantities_of(&self, contact: &ContactModel) -> Quantities {
        contact.quantities(|name| self.values(name))
    }

    /// The contact knowing how large the quantities are.
    pub(crate) fn bound(&self, contact: &ContactModel) -> ContactModel {
        contact.bounded_by(|name| self.values(name).into_iter().collect())
    }
}

/// Reads what the laws of `contacts` ask for: `temperature` at the root, and their quantities among the keys of the
/// bodies.
pub(crate) fn read_surroundings<'m>(
    temperature: Result<Option<TemperatureProgram>, Reported>,
    bodies: &mut TableReader<'_>,
    at_wall: bool,
    contacts: impl Iterator<Item = &'m ContactModel> + Clone,
) -> Result<Surroundings, Reported> {
    let temperature = temperature?;
    needs_temperature(bodies, temperature.as_ref(), contacts.clone())?;
    let mut quantities: Vec<BodyQuantity> = Vec::new();
    for quantity in contacts.flat_map(ContactModel::particle_quantities) {
        if quantities.iter().all(|known| known.name != quantity.name) {
            quantities.push(read_quantity(bodies, quantity, at_wall)?);
        }
    }
    Ok(Surroundings { temperature, quantities })
}

fn read_quantity(
    table: &mut TableReader<'_>,
    quantity: &'static Parameter,
    at_wall: bool,
) -> Result<BodyQuantity, Reported> {
    let values = List::of(rule_of(quantity)).at_least(1).at_most(if at_wall { 1 } else { 2 }).or_single();
    let values = table.required(quantity.name, values)?;
    let first = values.first().copied().unwrap_or_default();
    let second = if at_wall { 0.0 } else { values.get(1).copied().unwrap_or(first) };
    Ok(BodyQuantity { name: quantity.name, unit: quantity.unit(), values: [first, second] })
}

/// The rule of a quantity that laws read.
fn rule_of(quantity: &Parameter) -> QuantityRule {
    match quantity.kind {
        Kind::Number { dimension, range, may_be_infinite } => rule(dimension, range, may_be_infinite),
        Kind::Choice(_) | Kind::Numbers { .. } => QuantityRule::of(Dimension::NONE),
    }
}

/// Refuses contacts that read the temperature where there is none.
pub(crate) fn needs_temperature<'m>(
    root: &TableReader<'_>,
    temperature: Option<&TemperatureProgram>,
    mut contacts: impl Iterator<Item = &'m ContactModel>,
) -> Result<(), Reported> {
    let reads = contacts.find(|contact| contact.needs_temperature());
    match reads.filter(|_| temperature.is_none()) {
        None => Ok(()),
        Some(contact) => {
            let name = contact.normal.entry().name;
            let expected = format!("a temperature at the root of the file, which the law \"{name}\" reads");
            let problem = Problem::MissingKey { key: "temperature".to_owned(), expected };
            let help = "add for example `temperature = \"300 K\"`, or a [temperature] with a program";
            Err(root.refuse_with_help("temperature", problem, help))
        }
    }
}

/// Reads `temperature`: one for all time, or a table with a `program`.
pub(crate) fn read_temperature(root: &mut TableReader<'_>) -> Result<Option<TemperatureProgram>, Reported> {
    let Some(value) = root.value("temperature") else { return Ok(None) };
    if value.is_table() {
        let mut table = value.table()?;
        let program = table.required("program", Program);
        table.finish();
        return program.map(Some);
    }
    let temperature = value.read(temperature_rule())?;
    Ok(TemperatureProgram::new(vec![(0.0, temperature)]).ok())
}

fn temperature_rule() -> QuantityRule {
    QuantityRule::of(Dimension::TEMPERATURE).above(0.0)
}

/// Points of a program: times and temperatures.
struct Program;

impl Shape for Program {
    type Output = TemperatureProgram;

    fn describe(&self) -> String {
        "a list of points [time, temperature]".to_owned()
    }

    fn example(&self) -> Option<String> {
        Some("[[\"0 s\", \"300 K\"], [\"1 ms\", \"505 K\"]]".to_owned())
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<TemperatureProgram, Reported> {
        let items = value.items(&self.describe())?;
        let point = |item: &ValueReader<'_>| -> Result<(f64, f64), Reported> {
            let expected = "a point [time, temperature]";
            let parts = item.items(expected)?;
            let [time, temperature] = &parts[..] else {
                let problem = Problem::WrongLength { found: parts.len(), expected: expected.to_owned() };
                return Err(item.refuse(problem));
            };
            let time = time.read(QuantityRule::of(Dimension::TIME));
            let temperature = temperature.read(temperature_rule());
            Ok((time?, temperature?))
        };
        let points: Vec<_> = items.iter().map(point).collect();
        let points = points.into_iter().collect::<Result<Vec<_>, _>>()?;
        let before = |index: usize| points.get(index.wrapping_sub(1)).map_or(0.0, |(time, _)| *time);
        TemperatureProgram::new(points.clone()).map_err(|invalid| match invalid {
            InvalidProgram::Empty => {
                value.refuse(Problem::WrongLength { found: 0, expected: "one point or more".to_owned() })
            }
            InvalidProgram::Time(index) | InvalidProgram::Temperature(index) => {
                let found = format!("point {} is not after the one before", index + 1);
                let problem = Problem::rule(found, format!("a time greater than {:?} s", before(index)));
                items.get(index).unwrap_or(value).refuse(problem)
            }
        })
    }
}
