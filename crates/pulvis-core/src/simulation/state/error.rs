//! Why a state cannot be taken in.

use thiserror::Error;

use crate::columns::NameError;
use crate::contacts::MemoryError;
use crate::particles::ParticleId;
use crate::simulation::SetupError;

/// Why a [`State`](crate::State) cannot be taken in: it is damaged, or it is that of another system.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StateError {
    /// A column has not one entry for each of what it is about.
    #[error("column `{column}` has {found} entries, expected {expected}; the state is damaged")]
    Length {
        /// Name of the column.
        column: String,
        /// How many entries it has.
        found: usize,
        /// How many it must have.
        expected: usize,
    },
    /// A number is not what it can be.
    #[error("entry {index} of `{column}` is {value}, expected {expected}; the state is damaged")]
    Value {
        /// Name of the column.
        column: String,
        /// Which entry.
        index: usize,
        /// What stands there.
        value: f64,
        /// What could stand there.
        expected: &'static str,
    },
    /// Two particles have the same id, or one has an id that has not been given yet.
    #[error("particle id {id} {problem}; the state is damaged")]
    Id {
        /// The id.
        id: ParticleId,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A number that has a name is missing, or nothing is known of it.
    #[error(transparent)]
    Name(#[from] NameError),
    /// The walls are not those of the state.
    #[error(
        "wall {index} of the state is {found}, expected {expected}; give the walls of the exported simulation"
    )]
    Wall {
        /// Index in the list of walls.
        index: usize,
        /// Its name in the state.
        found: String,
        /// What was given.
        expected: String,
    },
    /// The rows do not come into the order that they had: positions, skins or the order are not those of one list.
    #[error(
        "the neighbour list cannot be made again: {problem}; the state is damaged, or of a system with other contact models or another domain"
    )]
    List {
        /// What does not fit.
        problem: String,
    },
    /// What contacts remember does not fit.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The system cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
}
