//! Why a simulation cannot be set up, or a step failed.

use thiserror::Error;

use crate::particles::ParticleId;

/// Why a simulation cannot be set up.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// A particle has a number that no particle can have.
    #[error("particle {index}: {quantity} is {found}, expected {expected}")]
    Particle {
        /// Index in the list of particles.
        index: usize,
        /// Which quantity, and its unit.
        quantity: &'static str,
        /// The number; of a vector, the first component that cannot be.
        found: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// A wall has a number that no wall can have.
    #[error("wall {index}: {quantity} is {found}, expected {expected}")]
    Wall {
        /// Index in the list of walls.
        index: usize,
        /// Which quantity; a parameter of its motion by the key that it has in a scenario.
        quantity: &'static str,
        /// The number; of a vector, the first component that cannot be.
        found: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// The face of a wall ranges up to a wall that is not there.
    #[error("wall {index}: its face ranges up to wall {other}, but there are {walls} walls, counted from 0")]
    NoSuchWall {
        /// Index in the list of walls.
        index: usize,
        /// The index that is too large.
        other: usize,
        /// How many walls there are.
        walls: usize,
    },
    /// Gravity or drag is a number that cannot be.
    #[error("{quantity} is {found}, expected {expected}")]
    Background {
        /// Which quantity, and its unit.
        quantity: &'static str,
        /// The number; of a vector, the first component that cannot be.
        found: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// Two bodies can meet for which there is no contact model.
    #[error("no contact model for materials {one} and {other}, which can meet")]
    NoModel {
        /// Index of a material.
        one: u16,
        /// Index of the other material.
        other: u16,
    },
    /// A period is too short for the rule of the nearest image.
    #[error(
        "the period {period} m along axis {axis} is shorter than {least} m, twice the search radius; a particle would meet two images of another one"
    )]
    ShortPeriod {
        /// 0 is x, 1 is y, 2 is z.
        axis: usize,
        /// The period [m].
        period: f64,
        /// The shortest one possible [m].
        least: f64,
    },
    /// A wall stands across a periodic direction: a particle that leaves through the boundary would
    /// come back on the wall's other side.
    #[error(
        "wall {wall} stands across axis {axis}, which is periodic; a plane's normal must have no part along a periodic axis, and a cylinder's axis must be along it"
    )]
    WallAcrossPeriod {
        /// Index in the list of walls.
        wall: usize,
        /// 0 is x, 1 is y, 2 is z.
        axis: usize,
    },
    /// A wall follows a pressure, but its area is unknown.
    #[error("wall {wall} follows a pressure, but the area of its face is unknown")]
    NoArea {
        /// Index in the list of walls.
        wall: usize,
    },
    /// A wall that is no plane is to follow a pressure.
    #[error("wall {wall} follows a pressure, but is no plane")]
    ServoNeedsPlane {
        /// Index in the list of walls.
        wall: usize,
    },
    /// A wall without an axis is to rotate.
    #[error("wall {wall} rotates, but its shape has no axis")]
    RotationNeedsAxis {
        /// Index in the list of walls.
        wall: usize,
    },
    /// A wall's shape cannot be.
    #[error("wall `{name}`: {reason}")]
    WallShape {
        /// Name of the wall.
        name: String,
        /// What is wrong.
        reason: String,
    },
    /// More walls than can be told apart.
    #[error("{found} walls are more than {most}, the most that contacts can tell apart")]
    TooManyWalls {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// The threads cannot be started.
    #[error("cannot start {0} threads; ask for fewer")]
    Threads(usize),
    /// More particles than rows can be numbered.
    #[error("{found} particles are more than {most}, the most that one simulation can number")]
    TooMany {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// All ids have been given away: particles that are inserted get new ones, and none is given twice.
    #[error("{inserted} more particles cannot be numbered: the next id is {next} of at most {most}")]
    IdsUsedUp {
        /// How many were to be inserted.
        inserted: usize,
        /// The id that the first of them would get.
        next: ParticleId,
        /// The largest id that there can be.
        most: ParticleId,
    },
    /// A quantity of the particles is not given as it must be.
    #[error("quantity `{name}` of the particles: {problem}")]
    Column {
        /// Its name.
        name: String,
        /// What is wrong.
        problem: String,
    },
    /// A particle was to be removed that is not there.
    #[error("there is no particle {id} to be removed: it was never there, or it has been removed before")]
    UnknownParticle {
        /// Its id.
        id: ParticleId,
    },
    /// The time step is no positive number.
    #[error("the time step is {0} s, expected a number greater than zero")]
    TimeStep(f64),
}

/// Why a step failed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A position is no number any more.
    #[error(
        "particle {id} was lost in step {step} (t = {time} s): its position is not a number; the time step is too long for the forces that act"
    )]
    Lost {
        /// Which particle.
        id: ParticleId,
        /// In which step.
        step: u64,
        /// When [s].
        time: f64,
    },
}
