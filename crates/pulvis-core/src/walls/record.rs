//! What a wall's motion keeps between steps, as numbers with names.

use super::{WallForce, WallState};
use crate::columns::{NameError, NamedNumbers, NumberReader, NumberWriter};

impl WallState {
    /// All of it.
    pub(crate) fn numbers(&self) -> NamedNumbers {
        let Self {
            velocity,
            velocity_mid,
            velocity_predicted,
            angular_velocity,
            load: WallForce { force, torque },
            work_prescribed,
            work_servo,
            travelled,
            displacement,
            // Measured anew in every step.
            area: _,
        } = self;
        let mut writer = NumberWriter::default();
        writer.vector("velocity", *velocity);
        writer.vector("velocity_mid", *velocity_mid);
        writer.vector("velocity_predicted", *velocity_predicted);
        writer.number("angular_velocity", *angular_velocity);
        writer.vector("force", *force);
        writer.number("torque", *torque);
        writer.number("work_prescribed", *work_prescribed);
        writer.number("work_servo", *work_servo);
        writer.vector("travelled", *travelled);
        writer.vector("displacement", *displacement);
        writer.finish()
    }

    /// From all of it.
    pub(crate) fn from_numbers(mut reader: NumberReader<'_>) -> Result<Self, NameError> {
        let state = Self {
            velocity: reader.vector("velocity")?,
            velocity_mid: reader.vector("velocity_mid")?,
            velocity_predicted: reader.vector("velocity_predicted")?,
            angular_velocity: reader.number("angular_velocity")?,
            load: WallForce { force: reader.vector("force")?, torque: reader.number("torque")? },
            work_prescribed: reader.number("work_prescribed")?,
            work_servo: reader.number("work_servo")?,
            travelled: reader.vector("travelled")?,
            displacement: reader.vector("displacement")?,
            area: None,
        };
        reader.finish()?;
        Ok(state)
    }
}
