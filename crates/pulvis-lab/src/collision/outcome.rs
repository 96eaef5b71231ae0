//! What comes of a collision.

use super::oblique::{ObliqueOutcome, ObliqueSample};

/// How a collision ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// The bodies separate.
    Rebound,
    /// The bodies stay bound: their motion came to a stop on the way out, or came to rest.
    Stick,
}

impl Regime {
    /// The word in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rebound => "rebound",
            Self::Stick => "stick",
        }
    }
}

/// The end of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// How it ended.
    pub regime: Regime,
    /// The branch of the law on which a pair that sticks stopped first.
    pub stop_branch: Option<&'static str>,
    /// Relative speed after over before, both outside the range of all forces; 0 where the pair
    /// sticks. Of an oblique collision, along the line of centres before [1].
    pub restitution: f64,
    /// Largest overlap [m].
    pub overlap_max: f64,
    /// Where a pair that sticks has no kinetic energy for the first time on the way out; for a pair
    /// that separates, where its interaction ends (0 without attraction at a distance) [m].
    pub overlap_end: f64,
    /// Time from touch to opening; `None` where the pair does not open [s].
    pub contact_duration: Option<f64>,
    /// Energy lost until the end, of a pair that sticks until its first stop: the sum of the accounts
    /// of all laws [J].
    pub energy_dissipated: f64,
    /// Energy before minus all accounts at the end, over the largest energy that took part: zero but
    /// for errors of the integration [1].
    pub energy_error: f64,
    /// The tangential motion after an oblique collision.
    pub oblique: Option<ObliqueOutcome>,
}

/// One instant of a collision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time since the bodies came within reach of their forces [s].
    pub time: f64,
    /// Overlap δ [m].
    pub overlap: f64,
    /// Closing rate dδ/dt, positive on approach [m/s].
    pub velocity: f64,
    /// Total force, repulsion positive [N].
    pub force: f64,
    /// The largest overlap that the law remembers (capped at δ_p, shrinking on the adhesive branch);
    /// of a law without memory the largest so far [m].
    pub delta_max: f64,
    /// Kinetic energy of the relative motion, ½ m_r u² [J].
    pub kinetic: f64,
    /// Elastic energy that unloading from here would give back, f_hys²/(2 k2) (S1 Fig. 15 b, d) [J].
    pub potential_available: f64,
    /// The branch's own potential k1 δ²/2, f_hys²/(2 k2) or −kc δ²/2 (S1 Fig. 15 a, c): plastic, partly
    /// lost already, and not to be added to the other energies [J].
    pub potential_plastic: f64,
    /// Potential of the attraction, zero out of reach [J].
    pub potential_attraction: f64,
    /// Energy lost so far [J].
    pub dissipated: f64,
    /// The tangential motion in an oblique collision. Kinetic and available energies are then those of all motions.
    pub oblique: Option<ObliqueSample>,
}

/// A collision and, if asked for, its course.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// The end.
    pub outcome: Outcome,
    /// The course, in time; empty unless asked for.
    pub course: Vec<Sample>,
}

/// Which instants of a collision are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Sampling {
    /// None.
    #[default]
    None,
    /// Every step, none longer than this [s], and both sides of a jump of the force.
    Every(f64),
    /// These times since the bodies came within reach, in increasing order [s].
    At(Vec<f64>),
}

/// How a collision is observed.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Which instants are kept.
    pub sampling: Sampling,
    /// How long a pair that stuck is followed [s].
    pub time_after_sticking: f64,
    /// Steps after which the collision is given up; `None` is a number of the method that no collision should take.
    pub most_steps: Option<u64>,
    /// Engine only: which part of a step the bodies fly before they come within reach [1].
    pub phase: f64,
}

impl Default for Observation {
    fn default() -> Self {
        Self { sampling: Sampling::None, time_after_sticking: 0.0, most_steps: None, phase: 0.5 }
    }
}
