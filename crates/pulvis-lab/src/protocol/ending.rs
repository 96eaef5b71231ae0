//! Why a stage ended.

/// Why a stage ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Its time was over.
    Time,
    /// The kinetic energy had fallen far enough below the elastic one.
    AtRest,
    /// The strain was reached.
    Strain,
    /// The stress was reached.
    Stress,
    /// The wall or the group had done its cycles.
    Cycles,
    /// Enough had passed an inlet or outlet.
    Passed,
    /// A column of the time series no longer drifted.
    Steady,
    /// The user stopped the run.
    Interrupted,
}

impl Ending {
    /// All endings, in the order of their numbers in checkpoints.
    const ALL: [Self; 8] = [
        Self::Time,
        Self::AtRest,
        Self::Strain,
        Self::Stress,
        Self::Cycles,
        Self::Interrupted,
        Self::Passed,
        Self::Steady,
    ];

    /// Its number in checkpoints.
    pub(super) fn number(self) -> u8 {
        Self::ALL.iter().position(|ending| *ending == self).unwrap_or(0) as u8
    }

    /// The ending of a number.
    pub(super) fn from_number(number: u8) -> Option<Self> {
        Self::ALL.get(usize::from(number)).copied()
    }

    /// The ending in words.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Time => "time over",
            Self::AtRest => "at rest",
            Self::Strain => "strain reached",
            Self::Stress => "stress reached",
            Self::Cycles => "cycles done",
            Self::Passed => "enough has passed",
            Self::Steady => "steady",
            Self::Interrupted => "interrupted",
        }
    }
}
