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
        "wall {wall} stands across axis {axis}, which is periodic; a plane's normal must have no part along a periodic axis, a cylinder's axis must be along it, and shapes with edges stand in open space only"
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
    /// A wall without a direction for it is to follow a pressure.
    #[error("wall {wall} follows a pressure, but its shape has no direction to be pushed in")]
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
    /// Bonds with a mesh: a bond belongs to one flat part, edge or corner, and could not pass on to the next.
    #[error("wall `{name}` is a mesh, and the contacts with it may be bonded, which a mesh cannot be")]
    BondWithMesh {
        /// Name of the wall.
        name: String,
    },
    /// More walls than can be told apart.
    #[error("{found} walls are more than {most}, the most that contacts can tell apart")]
    TooManyWalls {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// The periodic cell cannot deform as it should.
    #[error("the cell cannot deform: {problem}")]
    Cell {
        /// What is wrong.
        problem: String,
    },
    /// Charges cannot act over all distances; why.
    #[error("charges cannot act over all distances: {0}")]
    Electrostatics(String),
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
    /// A group has a particle that is not there.
    #[error("group `{name}`: there is no particle {id}")]
    NotInGroup {
        /// Name of the group.
        name: String,
        /// The id.
        id: ParticleId,
    },
    /// There is no group of this name.
    #[error("there is no group `{name}`")]
    NoGroup {
        /// The name.
        name: String,
    },
    /// A group cannot move in this way.
    #[error("group `{name}`: {problem}")]
    GroupMotion {
        /// Name of the group.
        name: String,
        /// What is wrong.
        problem: String,
    },
    /// The time step is no positive number.
    #[error("the time step is {0} s, expected a number greater than zero")]
    TimeStep(f64),
}

/// Why a step failed: what happened in it cannot be right.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("step {step} (t = {time:.6e} s): {alarm}")]
pub struct StepError {
    /// In which step.
    pub step: u64,
    /// When [s].
    pub time: f64,
    /// What happened.
    pub alarm: Alarm,
}

/// What cannot be right in the state of a simulation.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Alarm {
    /// Another rank does not answer any more, or not as it should.
    #[error("the ranks cannot go on together: {reason}; the last checkpoint is the state to go on from")]
    RankLost {
        /// What happened.
        reason: String,
    },
    /// A quantity of a particle is NaN or infinite.
    #[error(
        "the {quantity} of particle {id} is not a finite number; the time step is too long for the forces that act, or two centres coincide"
    )]
    ParticleLost {
        /// Which particle.
        id: ParticleId,
        /// Position, velocity or angular velocity.
        quantity: &'static str,
    },
    /// The position or velocity of a wall is NaN or infinite.
    #[error(
        "the {quantity} of wall `{wall}` is not a finite number; the time step is too long for its mass, its damping or the forces on it"
    )]
    WallLost {
        /// Name of the wall.
        wall: String,
        /// Position or velocity.
        quantity: &'static str,
    },
    /// A particle moves so far in a step that it can pass through others unseen.
    #[error(
        "particle {id} moves {radii:.3} radii of the smallest particle in one time step, more than {most}; it is too fast for this time step"
    )]
    ParticleTooFast {
        /// Which particle.
        id: ParticleId,
        /// Its way in a step, over the smallest radius [1].
        radii: f64,
        /// The limit [1].
        most: f64,
    },
    /// A particle is faster than the limit that was set.
    #[error("particle {id} moves at {speed:.4e} m/s, faster than the limit of {most:e} m/s")]
    BeyondSpeed {
        /// Which particle.
        id: ParticleId,
        /// Its speed [m/s].
        speed: f64,
        /// The limit [m/s].
        most: f64,
    },
    /// A wall moves so far in a step that particles can pass through it unseen.
    #[error(
        "wall `{wall}` moves {radii:.3} radii of the smallest particle in one time step, more than {most}; its pressure is too high for its mass, or it is driven too fast"
    )]
    WallTooFast {
        /// Name of the wall.
        wall: String,
        /// Its way in a step, over the smallest radius [1].
        radii: f64,
        /// The limit [1].
        most: f64,
    },
    /// Two walls that face each other have passed each other.
    #[error(
        "wall `{wall}` has passed wall `{opposite}`, which it faces, by {depth:.4e} m; what is between them cannot stop it: its motion goes too far, or its pressure is too high"
    )]
    WallsCrossed {
        /// Name of a wall.
        wall: String,
        /// Name of the other one.
        opposite: String,
        /// How far they have passed each other [m].
        depth: f64,
    },
    /// A particle has left the space in front of a wall.
    #[error(
        "the centre of particle {id} is behind wall `{wall}`: they overlap by {overlap:.3} of its radius, more than {most}; the contact is too soft for the forces that act, or the particle is too fast"
    )]
    BehindWall {
        /// Which particle.
        id: ParticleId,
        /// Name of the wall.
        wall: String,
        /// Overlap over the radius [1].
        overlap: f64,
        /// The limit [1].
        most: f64,
    },
    /// Two particles are pressed into each other.
    #[error(
        "particles {id} and {other} overlap by {overlap:.3} of the smaller radius, more than {most}; the contact is too soft for the forces that act, or they are too fast"
    )]
    Overlap {
        /// A particle.
        id: ParticleId,
        /// The other one.
        other: ParticleId,
        /// Overlap over the smaller radius [1].
        overlap: f64,
        /// The limit [1].
        most: f64,
    },
    /// A contact is stiffer than the time step resolves.
    #[error(
        "a contact has become so stiff that it lasts only {steps:.2} time steps, fewer than {least}; it is loaded more than was expected when the time step was chosen: expect a higher velocity, overlap or pressure, or take a shorter step"
    )]
    TooStiff {
        /// Time steps in its duration [1].
        steps: f64,
        /// The limit [1].
        least: f64,
    },
    /// The cell has become too narrow for the rule of the nearest image.
    #[error(
        "the period along axis {axis} has become {period:.4e} m, shorter than {least:.4e} m, twice the search radius; a particle would meet two images of another one: stop the deformation earlier, or take more particles"
    )]
    CellTooNarrow {
        /// 0 is x, 1 is y, 2 is z.
        axis: usize,
        /// The period [m].
        period: f64,
        /// The shortest one possible [m].
        least: f64,
    },
    /// The cell deforms too fast for the time step.
    #[error(
        "the cell is strained by {strain:.3e} in one time step, more than {most}; its rate is too high, or the stress that it follows is too far away"
    )]
    CellTooFast {
        /// The strain [1].
        strain: f64,
        /// The limit [1].
        most: f64,
    },
    /// A wall stands in a cell that deforms.
    #[error("the wall `{wall}` is there while the cell deforms, which it cannot follow")]
    WallInMovingCell {
        /// Name of the wall.
        wall: String,
    },
    /// An account of the energy ledger is NaN or infinite.
    #[error(
        "the account `{account}` of the energy ledger is not a finite number; the time step is too long for the forces that act"
    )]
    EnergyNotFinite {
        /// Name of the account.
        account: &'static str,
    },
    /// The energy ledger does not close.
    #[error(
        "the energy ledger does not close: its error is {error:.2e} of the largest energy in motion, more than {most:e}; the time step is too long for the forces that act"
    )]
    EnergyError {
        /// Relative closing error [1].
        error: f64,
        /// The limit [1].
        most: f64,
    },
}

impl Alarm {
    /// Whether it is about a rank and not about the state.
    pub fn is_lost_rank(&self) -> bool {
        matches!(self, Self::RankLost { .. })
    }

    /// The particles that it is about, at most two.
    pub fn particles(&self) -> Vec<ParticleId> {
        match *self {
            Self::ParticleLost { id, .. }
            | Self::ParticleTooFast { id, .. }
            | Self::BeyondSpeed { id, .. }
            | Self::BehindWall { id, .. } => vec![id],
            Self::Overlap { id, other, .. } => vec![id, other],
            Self::RankLost { .. }
            | Self::WallLost { .. }
            | Self::WallTooFast { .. }
            | Self::WallsCrossed { .. }
            | Self::TooStiff { .. }
            | Self::CellTooNarrow { .. }
            | Self::CellTooFast { .. }
            | Self::WallInMovingCell { .. }
            | Self::EnergyNotFinite { .. }
            | Self::EnergyError { .. } => Vec::new(),
        }
    }
}
