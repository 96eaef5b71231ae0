//! What a run refuses by itself, and an expert may have all the same.

use crate::context::Reported;
use crate::list::List;
use crate::reader::TableReader;
use crate::shape::Name;

/// A refusal that an author may lift, by `allow` in the scenario or `--allow` on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// A given time step is longer than a tenth of the shortest motion; a contact becomes stiffer than its step resolves.
    TimeStep,
    /// The dashpot of a contact is beyond critical.
    Overdamped,
    /// Bodies overlap by more than a tenth of the smaller radius at the start.
    Overlap,
    /// A particle or wall moves too far in a time step.
    Speed,
    /// A servo presses harder than any contact can carry.
    Pressure,
    /// Walls that face each other pass each other.
    CrossingWalls,
    /// The particles need more memory than there is.
    Memory,
    /// The output needs more room than the disk has.
    Disk,
}

impl Refusal {
    /// All refusals that can be lifted.
    pub const ALL: [Self; 8] = [
        Self::TimeStep,
        Self::Overdamped,
        Self::Overlap,
        Self::Speed,
        Self::Pressure,
        Self::CrossingWalls,
        Self::Memory,
        Self::Disk,
    ];

    /// Their names, in the same order.
    pub const NAMES: [&str; 8] =
        ["time-step", "overdamped", "overlap", "speed", "pressure", "crossing-walls", "memory", "disk"];

    /// The name in a scenario and on the command line.
    pub fn name(self) -> &'static str {
        let place = Self::ALL.iter().position(|refusal| *refusal == self);
        Self::NAMES[place.unwrap_or(0)]
    }

    /// The refusal of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|refusal| refusal.name() == name)
    }

    /// What is let pass, in words.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::TimeStep => "time steps that do not resolve the shortest motion",
            Self::Overdamped => "contacts with dashpots beyond critical",
            Self::Overlap => "overlaps of more than 10 % of the smaller radius at the start",
            Self::Speed => {
                "particles and walls that move more than 0.25 of the smallest radius in a time step"
            }
            Self::Pressure => "servo pressures beyond what any contact can carry",
            Self::CrossingWalls => "walls that pass each other",
            Self::Memory => "more particles than fit into the memory",
            Self::Disk => "more output than fits onto the disk",
        }
    }
}

/// Reads `allow`.
pub(super) fn read_allow(root: &mut TableReader<'_>) -> Result<Vec<Refusal>, Reported> {
    let names = root.or("allow", List::of(Name(&Refusal::NAMES)), Vec::new())?;
    let mut allowed: Vec<Refusal> = names.into_iter().filter_map(Refusal::named).collect();
    allowed.sort_unstable();
    allowed.dedup();
    Ok(allowed)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn every_refusal_has_a_name_of_its_own() {
        for (refusal, name) in Refusal::ALL.into_iter().zip(Refusal::NAMES) {
            assert_eq!((refusal.name(), Refusal::named(name)), (name, Some(refusal)));
        }
        assert_eq!(Refusal::named("everything"), None);
    }
}
