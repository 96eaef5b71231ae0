//! The state of a simulation as version 6 of the format has it.
//!
//! [`State`] may change with the engine; what stands in files may not. The conversions list every field, so that the compiler
//! asks about each new one: another version of the format is due then.

use pulvis_boundary::Cuboid;
use pulvis_core::{
    Background, BrokenBond, ContactRecords, ContactTotals, Domain, GroupRecord, ListState, MemoryColumn,
    NamedColumn, ParticleState, State, TemperatureProgram, WallRecord,
};
use pulvis_math::Vector3;
use serde::{Deserialize, Serialize};

use super::cell::{CellEntry, domain_of};
use super::groups::GroupEntry;
use super::planes;

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct StateRecord {
    pub(super) step: u64,
    pub(super) time: f64,
    time_step: f64,
    lower: [f64; 3],
    upper: [f64; 3],
    periodic: [bool; 3],
    tilts: [f64; 3],
    cell: CellEntry,
    gravity: [f64; 3],
    drag: f64,
    rotational_drag: f64,
    temperature: Option<Vec<(f64, f64)>>,
    keeps_ledger: bool,
    next_id: u32,
    pub(super) particles: ParticleColumns,
    walls: Vec<WallEntry>,
    groups: Vec<GroupEntry>,
    list: ListColumns,
    memory: Vec<MemoryTable>,
    totals: Totals,
    broken_bonds: Vec<(bool, u32, u32)>,
    ledger: Vec<(String, f64)>,
}

#[derive(Debug, Serialize, Deserialize)]
struct Totals {
    pairs: f64,
    at_walls: f64,
    overlap_max: f64,
    virial: [[f64; 3]; 3],
}

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ParticleColumns {
    #[serde(with = "planes")]
    pub(super) id: Vec<u32>,
    #[serde(with = "planes")]
    material: Vec<u16>,
    #[serde(with = "planes")]
    radius: Vec<f64>,
    #[serde(with = "planes")]
    mass: Vec<f64>,
    #[serde(with = "planes")]
    position: Vec<[f64; 3]>,
    #[serde(with = "planes")]
    velocity: Vec<[f64; 3]>,
    #[serde(with = "planes")]
    angular_velocity: Vec<[f64; 3]>,
    #[serde(with = "planes")]
    force: Vec<[f64; 3]>,
    #[serde(with = "planes")]
    torque: Vec<[f64; 3]>,
    #[serde(with = "planes")]
    applied_force: Vec<[f64; 3]>,
    columns: Vec<Column>,
}

/// A further quantity of the particles: name, unit and values; or what a law remembers: law, name with unit, and values.
#[derive(Debug, Serialize, Deserialize)]
struct Column {
    first: String,
    second: String,
    #[serde(with = "planes")]
    values: Vec<f64>,
}

#[derive(Debug, Serialize, Deserialize)]
struct WallEntry {
    name: String,
    present: bool,
    point: [f64; 3],
    listed_point: [f64; 3],
    angle: f64,
    listed_angle: f64,
    motion_start: f64,
    motion: Vec<(String, f64)>,
}

#[derive(Debug, Serialize, Deserialize)]
struct ListColumns {
    rebuilds: u64,
    steps: u64,
    chooses_skin: bool,
    mean_radius: f64,
    skin_thickest: f64,
    skin_thinnest: f64,
    #[serde(with = "planes")]
    position: Vec<[f64; 3]>,
    #[serde(with = "planes")]
    radius_with_skin: Vec<f64>,
    #[serde(with = "planes")]
    former_row: Vec<u32>,
    #[serde(with = "planes")]
    displacement_largest: Vec<f64>,
    #[serde(with = "planes")]
    displacement_second: Vec<f64>,
    #[serde(with = "planes")]
    remaining_skin: Vec<f64>,
    #[serde(with = "planes")]
    active: Vec<bool>,
}

#[derive(Debug, Serialize, Deserialize)]
struct MemoryTable {
    with_walls: bool,
    #[serde(with = "planes")]
    first: Vec<u32>,
    #[serde(with = "planes")]
    second: Vec<u32>,
    columns: Vec<Column>,
}

impl From<State> for StateRecord {
    fn from(state: State) -> Self {
        let State {
            step,
            time,
            time_step,
            domain: Domain { extent: Cuboid { lower, upper }, periodic, tilts },
            cell,
            background: Background { gravity, drag, rotational_drag },
            temperature,
            keeps_ledger,
            next_id,
            particles,
            walls,
            groups,
            list,
            memory,
            totals,
            broken_bonds,
            ledger,
        } = state;
        Self {
            step,
            time,
            time_step,
            lower: lower.to_array(),
            upper: upper.to_array(),
            periodic,
            tilts,
            cell: cell.into(),
            gravity: gravity.to_array(),
            drag,
            rotational_drag,
            temperature: temperature.map(|program| program.points().to_vec()),
            keeps_ledger,
            next_id,
            particles: particles.into(),
            walls: walls.into_iter().map(WallEntry::from).collect(),
            groups: groups.into_iter().map(GroupEntry::from).collect(),
            list: list.into(),
            memory: memory.into_iter().map(MemoryTable::from).collect(),
            totals: totals.into(),
            broken_bonds: broken_bonds
                .into_iter()
                .map(|BrokenBond { with_wall, first, second }| (with_wall, first, second))
                .collect(),
            ledger,
        }
    }
}

impl TryFrom<StateRecord> for State {
    type Error = &'static str;

    fn try_from(record: StateRecord) -> Result<Self, &'static str> {
        let StateRecord {
            step,
            time,
            time_step,
            lower,
            upper,
            periodic,
            tilts,
            cell,
            gravity,
            drag,
            rotational_drag,
            temperature,
            keeps_ledger,
            next_id,
            particles,
            walls,
            groups,
            list,
            memory,
            totals,
            broken_bonds,
            ledger,
        } = record;
        let temperature = temperature.map(TemperatureProgram::new).transpose();
        let bond = |(with_wall, first, second)| BrokenBond { with_wall, first, second };
        Ok(Self {
            step,
            time,
            time_step,
            domain: domain_of(lower, upper, periodic, tilts),
            cell: cell.into_state(periodic)?,
            background: Background { gravity: Vector3::from(gravity), drag, rotational_drag },
            temperature: temperature.map_err(|_| "its temperatures are none")?,
            keeps_ledger,
            next_id,
            particles: particles.into(),
            walls: walls.into_iter().map(WallRecord::from).collect(),
            groups: groups.into_iter().map(GroupRecord::try_from).collect::<Result<_, _>>()?,
            list: list.into(),
            memory: memory.into_iter().map(ContactRecords::from).collect(),
            totals: totals.into(),
            broken_bonds: broken_bonds.into_iter().map(bond).collect(),
            ledger,
        })
    }
}

/// Two types with the same fields, but for those that are converted.
macro_rules! same_fields {
    ($one:ident, $other:ident: $($field:ident),*; $($converted:ident with $there:expr, $back:expr),*) => {
        impl From<$one> for $other {
            fn from($one { $($field,)* $($converted),* }: $one) -> Self {
                Self { $($field,)* $($converted: $converted.into_iter().map($there).collect()),* }
            }
        }

        impl From<$other> for $one {
            fn from($other { $($field,)* $($converted),* }: $other) -> Self {
                Self { $($field,)* $($converted: $converted.into_iter().map($back).collect()),* }
            }
        }
    };
}

same_fields!(ParticleState, ParticleColumns:
    id, material, radius, mass, position, velocity, angular_velocity, force, torque,
    applied_force;
    columns with
        |NamedColumn { name, unit, values }| Column { first: name, second: unit, values },
        |Column { first, second, values }| NamedColumn { name: first, unit: second, values }
);

same_fields!(ContactTotals, Totals: pairs, at_walls, overlap_max, virial;);

same_fields!(WallRecord, WallEntry: name, present, point, listed_point, angle, listed_angle, motion_start, motion;);

same_fields!(ListState, ListColumns:
    rebuilds, steps, chooses_skin, mean_radius, skin_thickest, skin_thinnest, position, radius_with_skin, former_row,
    displacement_largest, displacement_second, remaining_skin, active;
);

same_fields!(ContactRecords, MemoryTable: with_walls, first, second;
    columns with
        |MemoryColumn { law, name, values }| Column { first: law, second: name, values },
        |Column { first, second, values }| MemoryColumn { law: first, name: second, values }
);
