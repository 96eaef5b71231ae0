//! What Python changes in a simulation between steps.

use numpy::PyReadonlyArray2;
use pulvis_lab::protocol::{MotionValue, Session};
use pyo3::prelude::*;

use crate::errors;

/// A parameter of a motion.
#[derive(FromPyObject)]
pub enum Value {
    /// A number.
    #[pyo3(transparent)]
    Number(f64),
    /// Three components.
    #[pyo3(transparent)]
    Vector([f64; 3]),
}

/// Sets vectors of all particles by id; false where there are no vectors of this name.
pub fn set_vectors(session: &mut Session, name: &str, vectors: &PyReadonlyArray2<'_, f64>) -> PyResult<bool> {
    let array = vectors.as_array();
    if array.ncols() != 3 {
        return Err(errors::misuse(format!("{name}: expected vectors of three components")));
    }
    let vectors: Vec<_> = array.rows().into_iter().map(|row| [row[0], row[1], row[2]].into()).collect();
    match session.set_vectors(name, &vectors) {
        None => Ok(false),
        Some(set) => set.map(|()| true).map_err(errors::misuse),
    }
}

/// Moves a wall in another way from now on.
pub fn set_wall_motion(
    session: &mut Session,
    wall: usize,
    motion: &str,
    parameters: Vec<(String, Value)>,
) -> PyResult<()> {
    let parameters: Vec<_> = parameters
        .into_iter()
        .map(|(name, value)| {
            let value = match value {
                Value::Number(number) => MotionValue::Number(number),
                Value::Vector(vector) => MotionValue::Vector(vector),
            };
            (name, value)
        })
        .collect();
    session.set_wall_motion(wall, motion, &parameters).map_err(errors::misuse)
}
