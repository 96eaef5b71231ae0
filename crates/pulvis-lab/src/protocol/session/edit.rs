//! What a program changes between steps.

use pulvis_boundary::WallMotion;
use pulvis_boundary::motion::{InvalidMotion, Range, Slot};
use pulvis_core::{NamedColumn, SetupError};
use pulvis_math::Vector3;
use thiserror::Error;

use super::Session;

/// Why a change is refused. Nothing has changed then.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EditError {
    /// The engine refuses it.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A motion whose parameters contradict each other.
    #[error(transparent)]
    Motion(#[from] InvalidMotion),
    /// A motion, or a parameter of one.
    #[error("{0}")]
    Unknown(String),
    /// A session that has failed in the middle of a step.
    #[error("the simulation has failed in the middle of a step and cannot be changed")]
    Broken,
}

/// A parameter of a motion, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionValue {
    /// A number.
    Number(f64),
    /// Three components.
    Vector([f64; 3]),
}

/// Vectors and values are in the order of the ids.
impl Session {
    fn whole(&self) -> Result<(), EditError> {
        if self.broken { Err(EditError::Broken) } else { Ok(()) }
    }

    /// Sets `position` [m], `velocity` [m/s], `angular_velocity` [rad/s] or `applied_force` [N] of all particles. The last one
    /// acts in all steps from then on, until other ones are set or, with an empty list, none. `None` where there are no such
    /// vectors.
    ///
    /// # Errors
    /// There is not one finite vector for each particle.
    pub fn set_vectors(&mut self, name: &str, vectors: &[Vector3]) -> Option<Result<(), EditError>> {
        let set = match name {
            "position" => pulvis_core::Simulation::set_positions,
            "velocity" => pulvis_core::Simulation::set_velocities,
            "angular_velocity" => pulvis_core::Simulation::set_angular_velocities,
            "applied_force" => pulvis_core::Simulation::set_applied_forces,
            _ => return None,
        };
        Some(self.whole().and_then(|()| Ok(set(&mut self.simulation, vectors)?)))
    }

    /// Sets a quantity of all particles in SI, one that they have or, with a unit, a new one.
    ///
    /// # Errors
    /// There is not one finite value for each particle; a law reads the quantity and does not take them; a new one has no
    /// unit.
    pub fn set_column(&mut self, name: &str, unit: Option<&str>, values: Vec<f64>) -> Result<(), EditError> {
        self.whole()?;
        let known = self.simulation.particles().column(name).map(|column| column.unit.clone());
        let unit = match (known, unit) {
            (Some(known), None) => known,
            (Some(known), Some(unit)) if known == unit => known,
            (Some(known), Some(unit)) => {
                return Err(EditError::Unknown(format!("`{name}` has the unit `{known}`, found `{unit}`")));
            }
            (None, Some(unit)) => unit.to_owned(),
            (None, None) => {
                return Err(EditError::Unknown(format!(
                    "particles have no `{name}`; a new quantity needs a unit"
                )));
            }
        };
        Ok(self.simulation.set_column(NamedColumn { name: name.to_owned(), unit, values })?)
    }

    /// Moves a wall in another way from now on, until a stage of the scenario controls it.
    ///
    /// # Errors
    /// There is no such motion, it has not these parameters, or a wall of this shape cannot have it.
    pub fn set_wall_motion(
        &mut self,
        wall: usize,
        motion: &str,
        parameters: &[(String, MotionValue)],
    ) -> Result<(), EditError> {
        self.whole()?;
        let motion = motion_of(motion, parameters)?;
        self.simulation.set_wall_motion(wall, motion)?;
        self.led_walls.insert(wall);
        Ok(())
    }

    /// Takes a wall away, or puts it back.
    ///
    /// # Errors
    /// The session has failed.
    pub fn set_wall_present(&mut self, wall: usize, present: bool) -> Result<(), EditError> {
        self.whole()?;
        self.simulation.set_wall_present(wall, present);
        self.led_walls.insert(wall);
        Ok(())
    }
}

/// A motion by its name, with parameters by their keys in a scenario.
fn motion_of(name: &str, given: &[(String, MotionValue)]) -> Result<WallMotion, EditError> {
    let Some(mut motion) = WallMotion::named(name) else {
        let known = WallMotion::NAMES.join(", ");
        return Err(EditError::Unknown(format!("no motion is called `{name}`; there are {known}")));
    };
    let known: Vec<&str> = motion.parameters().iter().map(|parameter| parameter.name).collect();
    if let Some((unknown, _)) = given.iter().find(|(given, _)| !known.contains(&given.as_str())) {
        let known = known.join(", ");
        return Err(EditError::Unknown(format!("the motion `{name}` has no `{unknown}`; it has {known}")));
    }
    for parameter in motion.parameters() {
        let refuse = |what: &str| Err(EditError::Unknown(format!("`{}` of a wall: {what}", parameter.name)));
        let value = given.iter().find(|(given, _)| given == parameter.name).map(|(_, value)| *value);
        match (parameter.value, value) {
            (_, None) if parameter.presence == pulvis_boundary::motion::Presence::Required => {
                return refuse("it is missing");
            }
            (_, None) => {}
            (Slot::Number(slot), Some(MotionValue::Number(number))) => {
                let fits = match parameter.range {
                    Range::Any => number.is_finite(),
                    Range::NonNegative => number >= 0.0 && number.is_finite(),
                    Range::Positive => number > 0.0 && number.is_finite(),
                };
                if !fits {
                    return refuse(&format!("{number} is out of range"));
                }
                *slot = number;
            }
            (Slot::Vector(slot), Some(MotionValue::Vector(vector))) => {
                if !vector.iter().all(|component| component.is_finite()) {
                    return refuse("expected finite components");
                }
                *slot = Vector3::from(vector);
            }
            (Slot::Number(_), Some(_)) => return refuse("expected a number"),
            (Slot::Vector(_), Some(_)) => return refuse("expected three components"),
        }
    }
    motion.law().check()?;
    Ok(motion)
}
