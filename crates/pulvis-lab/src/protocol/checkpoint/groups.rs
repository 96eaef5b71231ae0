//! Groups of particles in a checkpoint.

use pulvis_boundary::motion::Slot;
use pulvis_core::{GroupMotion, GroupRecord};
use pulvis_math::Vector3;
use serde::{Deserialize, Serialize};

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct GroupEntry {
    name: String,
    ids: Vec<u32>,
    motion: String,
    /// The parameters of the motion by their keys, vectors in three.
    parameters: Vec<(String, f64)>,
    start: f64,
    travelled: [f64; 3],
    work: f64,
}

/// What cannot be a motion of this program.
const UNKNOWN: &str = "a group of it moves in a way that this program does not know";

impl From<GroupRecord> for GroupEntry {
    fn from(record: GroupRecord) -> Self {
        let GroupRecord { name, ids, mut motion, start, travelled, work } = record;
        let mut parameters = Vec::new();
        for parameter in motion.parameters() {
            let values = match parameter.value {
                Slot::Number(number) => vec![*number],
                Slot::Vector(vector) => vector.to_array().to_vec(),
            };
            parameters.extend(values.into_iter().map(|value| (parameter.name.to_owned(), value)));
        }
        let motion = motion.name().to_owned();
        Self { name, ids, motion, parameters, start, travelled, work }
    }
}

impl TryFrom<GroupEntry> for GroupRecord {
    type Error = &'static str;

    fn try_from(entry: GroupEntry) -> Result<Self, &'static str> {
        let GroupEntry { name, ids, motion, parameters, start, travelled, work } = entry;
        let mut motion = GroupMotion::named(&motion).ok_or(UNKNOWN)?;
        let mut values = parameters.into_iter();
        let mut next = |key: &str| match values.next() {
            Some((name, value)) if name == key => Ok(value),
            _ => Err(UNKNOWN),
        };
        for parameter in motion.parameters() {
            match parameter.value {
                Slot::Number(number) => *number = next(parameter.name)?,
                Slot::Vector(vector) => {
                    let [x, y, z] = [next(parameter.name)?, next(parameter.name)?, next(parameter.name)?];
                    *vector = Vector3::new(x, y, z);
                }
            }
        }
        Ok(Self { name, ids, motion, start, travelled, work })
    }
}
