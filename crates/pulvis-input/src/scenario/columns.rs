//! Further quantities of particles: charge, temperature and whatever else.

use super::output_files::PARTICLE_FIELDS;
use crate::any_quantity::AnyQuantity;
use crate::context::Reported;
use crate::problem::Problem;
use crate::reader::TableReader;
use pulvis_contact::catalogue::{Kind, Parameter, Value};
use pulvis_math::Dimension;

/// A quantity that all particles of a group have.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticleColumn {
    /// Its name: letters, digits and underscores.
    pub name: String,
    /// Its value, in SI.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
}

/// Names that some format of output files has for its own columns and arrays, beside those that begin with `contact_`.
const NAMES_OF_FORMATS: [&str; 28] = [
    "x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz", "fx", "fy", "fz", "tqx", "tqy", "tqz",
    "position", "pos", "species", "velocity", "force", "material", "velo", "forces", "time", "step", "box",
    "tilt", "periodic",
];

/// Reads `[particles.columns]`, in the order of the file. All groups have the same quantities: those of the `first`
/// one, unless this is it.
pub(super) fn read_columns(
    group: &mut TableReader<'_>,
    first: Option<&[ParticleColumn]>,
) -> Result<Vec<ParticleColumn>, Reported> {
    let mut columns = Vec::new();
    if let Some(mut table) = group.optional_table("columns")? {
        let names = table.keys();
        let read: Vec<_> = names.into_iter().map(|name| read_column(&mut table, name)).collect();
        table.finish();
        columns = read.into_iter().collect::<Result<_, _>>()?;
    }
    let Some(first) = first else { return Ok(columns) };
    for column in first {
        match columns.iter().find(|own| own.name == column.name) {
            None => {
                let found = format!("there is no `{}`, which the first group has", column.name);
                return Err(group.refuse("columns", Problem::rule(found, "the same columns for all groups")));
            }
            Some(own) if own.dimension != column.dimension => {
                let [found, expected] = [own, column].map(|column| column.dimension.unit());
                let found = format!("`{}` is in {found}, but in {expected} in the first group", column.name);
                return Err(
                    group.refuse("columns", Problem::rule(found, "the same dimension for all groups"))
                );
            }
            Some(_) => {}
        }
    }
    if let Some(own) = columns.iter().find(|own| first.iter().all(|column| column.name != own.name)) {
        let found = format!("the first group has no `{}`", own.name);
        return Err(group.refuse("columns", Problem::rule(found, "the same columns for all groups")));
    }
    // In the order of the first group.
    columns.sort_by_key(|own| first.iter().position(|column| column.name == own.name));
    Ok(columns)
}

/// What reads a quantity of particles.
#[derive(Clone, Copy, Debug)]
pub(super) enum Reader {
    /// A law of a contact.
    Law,
    /// `[electrostatics]`.
    Electrostatics,
}

impl Reader {
    fn name(self) -> &'static str {
        match self {
            Self::Law => "a law",
            Self::Electrostatics => "[electrostatics]",
        }
    }
}

/// Refuses `particles` or `inlets` that lack a quantity that is read, or have one that is not taken.
pub(super) fn needs_quantity(
    root: &TableReader<'_>,
    (key, columns): (&str, &[ParticleColumn]),
    quantity: &Parameter,
    reader: Reader,
) -> Result<(), Reported> {
    let (name, unit) = (quantity.name, quantity.unit());
    let Some(column) = columns.iter().find(|column| column.name == name) else {
        let expected =
            format!("the {} [{unit}] in [{key}.columns], which {} reads", quantity.meaning, reader.name());
        let problem = Problem::MissingKey { key: format!("{key}.columns.{name}"), expected };
        return Err(root.refuse(key, problem));
    };
    let of_kind = matches!(quantity.kind, Kind::Number { dimension, .. } if dimension == column.dimension);
    if of_kind && quantity.check(&Value::Number(column.value)).is_ok() {
        return Ok(());
    }
    let found = format!("`{name}` of {key} is {:?} {}", column.value, column.dimension.unit());
    let expected = format!("the {} in {unit}, {}", quantity.meaning, quantity.allowed());
    Err(root.refuse(key, Problem::rule(found, expected)))
}

fn read_column(table: &mut TableReader<'_>, name: &str) -> Result<ParticleColumn, Reported> {
    let (value, dimension) = table.required(name, AnyQuantity)?;
    if !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') || name.is_empty() {
        let found = format!("\"{name}\" is no name of a column");
        return Err(table.refuse(name, Problem::rule(found, "only letters, digits and underscores")));
    }
    if PARTICLE_FIELDS.contains(&name) || NAMES_OF_FORMATS.contains(&name) || name.starts_with("contact_") {
        let found = format!("output files have a column `{name}` already");
        return Err(table.refuse(name, Problem::rule(found, "another name")));
    }
    Ok(ParticleColumn { name: name.to_owned(), value, dimension })
}
