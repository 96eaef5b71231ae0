//! Groups of particles in a checkpoint.

use pulvis_core::{GroupMotion, GroupRecord};
use serde::{Deserialize, Serialize};

use super::motion::{Parameters, read, written};

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct GroupEntry {
    name: String,
    ids: Vec<u32>,
    motion: String,
    parameters: Parameters,
    start: f64,
    travelled: [f64; 3],
    work: f64,
}

/// What cannot be a motion of this program.
const UNKNOWN: &str = "a group of it moves in a way that this program does not know";

impl From<GroupRecord> for GroupEntry {
    fn from(record: GroupRecord) -> Self {
        let GroupRecord { name, ids, mut motion, start, travelled, work } = record;
        let parameters = written(motion.parameters());
        let motion = motion.name().to_owned();
        Self { name, ids, motion, parameters, start, travelled, work }
    }
}

impl TryFrom<GroupEntry> for GroupRecord {
    type Error = &'static str;

    fn try_from(entry: GroupEntry) -> Result<Self, &'static str> {
        let GroupEntry { name, ids, motion, parameters, start, travelled, work } = entry;
        let mut motion = GroupMotion::named(&motion).ok_or(UNKNOWN)?;
        if !read(motion.parameters(), &parameters) {
            return Err(UNKNOWN);
        }
        Ok(Self { name, ids, motion, start, travelled, work })
    }
}
