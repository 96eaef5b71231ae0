//! How walls are moved: motions as they describe themselves, read from a scenario and written back.

use super::resolved::writer::{Writer, quantity, text, vector};
use super::walls::Wall;
use crate::context::Reported;
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_boundary::motion::{Parameter, Presence, Range, Slot};
use pulvis_boundary::{Shape, WallMotion};

/// What happens to a wall at the start of a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallControl {
    /// It moves in this way from now on.
    Motion(WallMotion),
    /// It is taken away, for good.
    Removed,
}

const REMOVED: &str = "removed";

impl WallControl {
    /// The name in a scenario.
    pub fn name(&self) -> &'static str {
        self.motion().map_or(REMOVED, |motion| motion.name())
    }

    /// How the wall moves, if it is there.
    pub fn motion(&self) -> Option<WallMotion> {
        match self {
            Self::Motion(motion) => Some(*motion),
            Self::Removed => None,
        }
    }

    /// After which time the wall stands still [s]; `None` for motions without end.
    pub fn duration(&self) -> Option<f64> {
        self.motion()?.law().duration()
    }
}

/// Reads `[stages.walls.NAME]`.
pub(super) fn read_control(mut table: TableReader<'_>, wall: &Wall) -> Result<WallControl, Reported> {
    let names: Vec<&str> = WallMotion::NAMES.iter().copied().chain([REMOVED]).collect();
    let name = table.selector("control", &names)?;
    let read = match WallMotion::named(name) {
        Some(motion) => read_motion(&mut table, motion, wall).map(WallControl::Motion),
        None => Ok(WallControl::Removed),
    };
    table.finish();
    read
}

/// Reads the parameters of a motion and checks it with the wall that it is for.
fn read_motion(
    table: &mut TableReader<'_>,
    mut motion: WallMotion,
    wall: &Wall,
) -> Result<WallMotion, Reported> {
    let mut failure = None;
    let mut numbers: Vec<(&str, f64)> = Vec::new();
    for parameter in motion.parameters() {
        failure = read_parameter(table, parameter, &mut numbers).err().or(failure);
    }
    if let Some(problem) = unfit(&motion, wall) {
        return Err(table.refuse("control", problem));
    }
    if let Some(reported) = failure {
        return Err(reported);
    }
    match motion.law().check() {
        Ok(()) => Ok(motion),
        Err(invalid) => Err(table.refuse(invalid.parameter, Problem::rule(invalid.found, invalid.expected))),
    }
}

/// Why a wall cannot move in this way.
fn unfit(motion: &WallMotion, wall: &Wall) -> Option<Problem> {
    let (motion, name) = (motion.law(), &wall.name);
    let kind = wall.shape.name();
    let (found, expected) = if motion.is_pushed() && wall.shape.direction_of_push().is_none() {
        let found = format!("the wall {name} is a {kind}, which no pressure can move");
        (found, "a plane, a disk, a plane-with-hole or a mesh".to_owned())
    } else if motion.needs_area() && wall.face.is_none() && wall.area.is_none() {
        let found = format!("the wall {name} has no area for the pressure to act on");
        (found, format!("`area` in [walls.{name}]"))
    } else if motion.needs_axis() && wall.shape.axis().is_none() {
        let found = format!("the wall {name} is a {kind}, which has no axis to rotate about");
        (found, "a wall with an axis: any kind but \"plane\"".to_owned())
    } else {
        return None;
    };
    Some(Problem::rule(found, expected))
}

/// Reads a parameter to where its value stands. `numbers` are those read before, by their keys.
pub(super) fn read_parameter(
    table: &mut TableReader<'_>,
    parameter: Parameter<'_>,
    numbers: &mut Vec<(&'static str, f64)>,
) -> Result<(), Reported> {
    let Parameter { name, dimension, range, presence, value } = parameter;
    let required = presence == Presence::Required;
    match value {
        Slot::Vector(vector) => {
            let rule = Vector::of(dimension);
            let read =
                if required { table.required(name, rule).map(Some) } else { table.optional(name, rule) };
            *vector = read?.map_or(*vector, Into::into);
        }
        Slot::Number(number) => {
            let rule = match range {
                Range::Any => QuantityRule::of(dimension),
                Range::NonNegative => QuantityRule::of(dimension).at_least(0.0),
                Range::Positive => QuantityRule::of(dimension).above(0.0),
            };
            let read =
                if required { table.required(name, rule).map(Some) } else { table.optional(name, rule) };
            let earlier = |key: &str| numbers.iter().find(|(name, _)| *name == key).map(|(_, value)| *value);
            *number = match (read?, presence) {
                (Some(read), _) => read,
                (None, Presence::SameAs(key)) => earlier(key).unwrap_or(*number),
                (None, _) => *number,
            };
            numbers.push((name, *number));
        }
    }
    Ok(())
}

/// Writes `[stages.walls.NAME]`.
pub(super) fn write_control(writer: &mut Writer, control: &WallControl) {
    writer.key("control", text(control.name()));
    let Some(mut motion) = control.motion() else { return };
    write_parameters(writer, motion.parameters());
}

/// Writes the parameters of a motion.
pub(super) fn write_parameters(writer: &mut Writer, parameters: Vec<Parameter<'_>>) {
    for Parameter { name, dimension, value, .. } in parameters {
        let value = match value {
            Slot::Number(number) => quantity(*number, dimension),
            Slot::Vector(components) => vector(*components, dimension),
        };
        writer.key(name, value);
    }
}
