//! How walls are moved.

use super::walls::Wall;
use crate::context::Reported;
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_math::{Dimension, Vector3};

/// How a wall moves from the start of a stage on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallControl {
    /// It stays where it is.
    Fixed,
    /// It moves with a constant velocity [m/s].
    Velocity(Vector3),
    /// It goes to and fro.
    Cosine(CosineMotion),
    /// It follows the pressure of the particles.
    Servo(Servo),
    /// It is taken away, for good.
    Removed,
}

impl WallControl {
    /// The name in a scenario.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Velocity(_) => "velocity",
            Self::Cosine(_) => "cosine",
            Self::Servo(_) => "servo",
            Self::Removed => "removed",
        }
    }
}

/// The motion X(t) = X0 + displacement/2 (1 − cos(2π t/period)); after its cycles the wall stays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CosineMotion {
    /// Displacement at half a period [m].
    pub displacement: Vector3,
    /// Period [s].
    pub period: f64,
    /// Number of periods, not always whole [1].
    pub cycles: f64,
}

impl CosineMotion {
    /// The time that all cycles take [s].
    pub fn duration(&self) -> f64 {
        self.period * self.cycles
    }
}

/// A wall with mass and damping that moves along its normal until the particles push back with a
/// pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Pressure after the ramp, compression positive [Pa].
    pub pressure: f64,
    /// Pressure at the start of the stage [Pa].
    pub from: f64,
    /// Duration of the ramp between the two, half a cosine [s].
    pub ramp: f64,
    /// Mass of the wall [kg].
    pub mass: f64,
    /// Coefficient of its dashpot [kg/s].
    pub damping: f64,
}

const NAMES: [&str; 5] = ["fixed", "velocity", "cosine", "servo", "removed"];

/// Reads `[stages.walls.NAME]`.
pub(super) fn read_control(mut table: TableReader<'_>, wall: &Wall) -> Result<WallControl, Reported> {
    let control = table.required("control", Name(&NAMES))?;
    let read = match control {
        "velocity" => table
            .required("velocity", Vector::of(Dimension::VELOCITY))
            .map(|v| WallControl::Velocity(v.into())),
        "cosine" => read_cosine(&mut table),
        "servo" => read_servo(&mut table, wall),
        "removed" => Ok(WallControl::Removed),
        _ => Ok(WallControl::Fixed),
    };
    table.finish();
    read
}

fn read_cosine(table: &mut TableReader<'_>) -> Result<WallControl, Reported> {
    let displacement = table.required("displacement", Vector::of(Dimension::LENGTH)).and_then(|vector| {
        if vector == [0.0; 3] {
            let problem = Problem::rule("the displacement is zero", "a motion, or control = \"fixed\"");
            return Err(table.refuse("displacement", problem));
        }
        Ok(Vector3::from(vector))
    });
    let period = table.required("period", QuantityRule::of(Dimension::TIME).above(0.0));
    let cycles = table.or("cycles", QuantityRule::of(Dimension::NONE).above(0.0), 1.0);
    let (displacement, period, cycles) = (displacement?, period?, cycles?);
    Ok(WallControl::Cosine(CosineMotion { displacement, period, cycles }))
}

fn read_servo(table: &mut TableReader<'_>, wall: &Wall) -> Result<WallControl, Reported> {
    let pressure = table.required("pressure", Dimension::PRESSURE);
    let from = table.optional("from", Dimension::PRESSURE);
    let ramp = table.or("ramp", QuantityRule::of(Dimension::TIME).at_least(0.0), 0.0);
    let mass = table.required("mass", QuantityRule::of(Dimension::MASS).above(0.0));
    let damping = table.required("damping", QuantityRule::of(Dimension::DASHPOT).at_least(0.0));
    let sized = if wall.face.is_some() || wall.area.is_some() {
        Ok(())
    } else {
        let found = format!("the wall {} has no area for the pressure to act on", wall.name);
        Err(table.refuse("control", Problem::rule(found, format!("`area` in [walls.{}]", wall.name))))
    };
    let (pressure, from, ramp) = (pressure?, from?, ramp?);
    if from.is_some_and(|from| from != pressure) && ramp == 0.0 {
        let found = "`from` differs from `pressure`, but the ramp takes no time";
        return Err(table.refuse("from", Problem::rule(found, "a `ramp` greater than 0")));
    }
    sized?;
    let from = from.unwrap_or(pressure);
    Ok(WallControl::Servo(Servo { pressure, from, ramp, mass: mass?, damping: damping? }))
}
