//! What can go wrong in a collision.

use pulvis_core::{SetupError, StepError};
use thiserror::Error;

/// A collision that cannot be computed.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CollisionError {
    /// The motion takes more steps than any collision should.
    #[error(
        "the collision at {velocity} m/s is not over after {steps} steps ({time:.3e} s); {}",
        if *.damped { "is the dashpot far beyond critical damping?" } else { "there is no dashpot, so check the magnitudes of radii, densities and stiffnesses" }
    )]
    TooLong {
        /// Relative speed before the collision [m/s].
        velocity: f64,
        /// Steps taken [1].
        steps: u64,
        /// Time simulated [s].
        time: f64,
        /// Whether the contact has a dashpot, which may be the cause.
        damped: bool,
    },
    /// The state is no longer a number.
    #[error(
        "the collision at {velocity} m/s left the range of numbers at {time:.3e} s; check the magnitudes of masses and stiffnesses"
    )]
    NotFinite {
        /// Relative speed before the collision [m/s].
        velocity: f64,
        /// Time simulated [s].
        time: f64,
    },
    /// The exact method knows the line of centres only.
    #[error("oblique collisions, and those with spin, are integrated by the method `engine`")]
    ObliqueExact,
    /// The engine cannot be set up for this collision.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The engine lost a particle.
    #[error(transparent)]
    Step(#[from] StepError),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dashpot_is_blamed_only_where_there_is_one() {
        let message =
            |damped| CollisionError::TooLong { velocity: 1.0, steps: 9, time: 2.0, damped }.to_string();
        assert!(message(true).ends_with("is the dashpot far beyond critical damping?"));
        assert!(message(false).contains("there is no dashpot") && !message(false).contains("critical"));
    }
}
