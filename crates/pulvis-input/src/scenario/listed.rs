//! Particles that the scenario itself lists, one by one.

use super::arrangement::Grain;
use super::materials::Material;
use crate::context::Reported;
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Name, Shape};
use pulvis_math::{Dimension, Vector3};

/// Reads the keys of an arrangement of the kind `list`: positions, and as many of each other quantity that is given.
pub(super) fn read_list(table: &mut TableReader<'_>, materials: &[Material]) -> Result<Vec<Grain>, Reported> {
    let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    let positions = table.required("positions", List::of(Vector::of(Dimension::LENGTH)).at_least(1));
    let count = positions.as_ref().ok().map(Vec::len);
    let radii = as_many(table, "radii", QuantityRule::of(Dimension::LENGTH).above(0.0), count);
    let velocities = as_many(table, "velocities", Vector::of(Dimension::VELOCITY), count);
    let angular_velocities = as_many(table, "angular_velocities", Vector::of(Dimension::RATE), count);
    let of_grains = as_many(table, "materials", Name(&names), count);
    let (positions, radii, velocities) = (positions?, radii?, velocities?);
    let (angular_velocities, of_grains) = (angular_velocities?, of_grains?);
    let vector = |list: &Option<Vec<[f64; 3]>>, number: usize| {
        list.as_ref().and_then(|list| list.get(number)).map(|&vector| Vector3::from(vector))
    };
    let grain = |(number, position): (usize, [f64; 3])| Grain {
        position: position.into(),
        radius: radii.as_ref().and_then(|radii| radii.get(number)).copied(),
        velocity: vector(&velocities, number),
        angular_velocity: vector(&angular_velocities, number),
        material: of_grains
            .as_ref()
            .and_then(|of_grains| of_grains.get(number))
            .and_then(|name| names.iter().position(|known| known == name)),
    };
    Ok(positions.into_iter().enumerate().map(grain).collect())
}

/// A list, if it is given, of as many items as there are positions; how many these are is not known where they are wrong.
fn as_many<S: Shape>(
    table: &mut TableReader<'_>,
    key: &str,
    item: S,
    count: Option<usize>,
) -> Result<Option<Vec<S::Output>>, Reported> {
    let list = table.optional(key, List::of(item))?;
    match (&list, count) {
        (Some(items), Some(count)) if items.len() != count => {
            let found = format!("{} values for {count} positions", items.len());
            Err(table.refuse(key, Problem::rule(found, "one for each position")))
        }
        _ => Ok(list),
    }
}
