//! Export and import of contact memory by the ids of the bodies.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use thiserror::Error;

use super::ContactTable;
use super::block::{ContactGroup, Partner};
use crate::particles::ParticleId;
use crate::walls::WallFeature;

/// The memory of contacts with the same columns, one entry per contact. Remembered vectors have the sign
/// for the first body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactRecords {
    /// Whether the second bodies are walls.
    pub with_walls: bool,
    /// Ids of the first bodies.
    pub first: Vec<ParticleId>,
    /// Ids of the second bodies; for a wall the number of its feature, which is the index of the wall if it has only one.
    pub second: Vec<u32>,
    /// Columns of memory.
    pub columns: Vec<MemoryColumn>,
}

/// A column of contact memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MemoryColumn {
    /// Name of the law that remembers it.
    pub law: String,
    /// Its name with its unit: `overlap_max [m]`.
    pub name: String,
    /// What each contact remembers.
    pub values: Vec<f64>,
}

/// Why contact memory cannot be imported.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MemoryError {
    /// A column is too short or too long.
    #[error(
        "the column `{name}` of contact memory has {found} entries, expected {expected}; the state is damaged"
    )]
    Length {
        /// Name of the column.
        name: String,
        /// How many entries it has.
        found: usize,
        /// How many it must have.
        expected: usize,
    },
    /// A number is NaN or infinite.
    #[error(
        "the contact of particle {first} remembers {value}, expected a finite number; the state is damaged"
    )]
    Value {
        /// Id of the first body.
        first: ParticleId,
        /// What it remembers.
        value: f64,
    },
    /// The contact is there twice.
    #[error("the contact of particle {first} with {second} is there twice; the state is damaged")]
    Twice {
        /// Id of the first body.
        first: ParticleId,
        /// The second body.
        second: String,
    },
    /// The contact is not in the neighbour list.
    #[error(
        "particle {first} and {second}, which remember their contact, are not in the neighbour list; the state is damaged"
    )]
    NoContact {
        /// Id of the first body.
        first: ParticleId,
        /// The second body.
        second: String,
    },
    /// The contact follows another law.
    #[error(
        "the contact of particle {first} with {second} remembers {found}, but its contact model remembers {expected}; give the contact models of the exported simulation"
    )]
    Law {
        /// Id of the first body.
        first: ParticleId,
        /// The second body.
        second: String,
        /// What the record holds.
        found: String,
        /// What the contact model keeps.
        expected: String,
    },
}

/// Whether the second body is a wall, and the two bodies.
pub(super) type Key = (bool, u32, u32);

impl ContactRecords {
    /// No records yet of contacts like those of a group.
    fn like(group: &ContactGroup) -> Self {
        let column = |(law, name): (&str, &str)| MemoryColumn {
            law: law.to_owned(),
            name: name.to_owned(),
            values: Vec::new(),
        };
        let columns = group.layout.laws().zip(group.layout.names()).map(column).collect();
        Self { with_walls: group.partner == Partner::Wall, columns, ..Self::default() }
    }

    fn is_like(&self, group: &ContactGroup) -> bool {
        let mut columns = self.columns.iter().zip(group.layout.laws().zip(group.layout.names()));
        self.with_walls == (group.partner == Partner::Wall)
            && self.columns.len() == group.layout.columns()
            && columns.all(|(column, (law, name))| column.law == law && column.name == name)
    }

    fn check(&self) -> Result<(), MemoryError> {
        let expected = self.first.len();
        let columns = self.columns.iter().map(|column| (&column.name[..], column.values.len()));
        let mut lengths = columns.chain([("second", self.second.len())]);
        if let Some((name, found)) = lengths.find(|&(_, found)| found != expected) {
            return Err(MemoryError::Length { name: name.to_owned(), found, expected });
        }
        for MemoryColumn { values, .. } in &self.columns {
            if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                return Err(MemoryError::Value { first: self.first[index], value: values[index] });
            }
        }
        Ok(())
    }
}

fn name_of((with_wall, _, second): Key) -> String {
    if with_wall {
        format!("wall {}", WallFeature::from_number(second).wall())
    } else {
        format!("particle {second}")
    }
}

/// The bodies of a contact, by their ids.
pub(super) fn key_of(group: &ContactGroup, ids: &[ParticleId], block: usize, lane: usize) -> Key {
    let first = ids[group.first_row(block, lane) as usize];
    let second = group.second_row(block, lane);
    match group.partner {
        Partner::Particle => (false, first, ids[second as usize]),
        Partner::Wall => (true, first, second),
    }
}

impl ContactTable {
    /// The memory of all contacts, and which blocks are active. `ids` are those of the rows.
    pub(crate) fn export(&self, ids: &[ParticleId]) -> (Vec<ContactRecords>, Vec<bool>) {
        let mut tables: Vec<ContactRecords> = Vec::new();
        let mut active = Vec::new();
        for group in self.groups() {
            active.extend_from_slice(&group.active);
            if group.layout.columns() == 0 {
                continue;
            }
            let known = tables.iter().position(|table| table.is_like(group));
            let number = known.unwrap_or(tables.len());
            if known.is_none() {
                tables.push(ContactRecords::like(group));
            }
            let table = &mut tables[number];
            for block in 0..group.rows.len() {
                let columns = group.columns(block);
                for lane in 0..group.occupancy(block) {
                    // Also columns of negative zero, and blocks that are not active: all bits are restored.
                    if columns.iter().all(|column| column.0[lane].to_bits() == 0) {
                        continue;
                    }
                    let (_, first, second) = key_of(group, ids, block, lane);
                    table.first.push(first);
                    table.second.push(second);
                    for (MemoryColumn { values, .. }, column) in table.columns.iter_mut().zip(columns) {
                        values.push(column.0[lane]);
                    }
                }
            }
        }
        tables.retain(|table| !table.first.is_empty());
        (tables, active)
    }

    /// Number of blocks of contacts.
    pub(crate) fn blocks(&self) -> usize {
        self.groups().map(|group| group.rows.len()).sum()
    }

    /// Fills in the memory of all contacts, which have none yet. `active` has one entry for each of the
    /// [`blocks`](Self::blocks).
    ///
    /// # Errors
    /// The records are not those of the listed contacts.
    pub(crate) fn import(
        &mut self,
        ids: &[ParticleId],
        tables: &[ContactRecords],
        active: &[bool],
    ) -> Result<(), MemoryError> {
        let mut records: HashMap<Key, (usize, usize)> = HashMap::new();
        for (number, table) in tables.iter().enumerate() {
            table.check()?;
            for (index, (&first, &second)) in table.first.iter().zip(&table.second).enumerate() {
                let key = (table.with_walls, first, second);
                match records.entry(key) {
                    Entry::Vacant(vacant) => vacant.insert((number, index)),
                    Entry::Occupied(_) => {
                        return Err(MemoryError::Twice { first, second: name_of(key) });
                    }
                };
            }
        }
        let mut active = active.iter();
        for group in self.groups_mut() {
            group.active.iter_mut().zip(active.by_ref()).for_each(|(flag, &acts)| *flag = acts);
            let width = group.layout.columns();
            for block in 0..group.rows.len() {
                for lane in 0..group.occupancy(block) {
                    let key = key_of(group, ids, block, lane);
                    let Some((number, index)) = records.remove(&key) else { continue };
                    let table = &tables[number];
                    if !table.is_like(group) {
                        return Err(another_law(key, table, group));
                    }
                    let columns = group.memory[block * width..].iter_mut().zip(&table.columns);
                    for (column, MemoryColumn { values, .. }) in columns {
                        column.0[lane] = values[index];
                    }
                }
            }
        }
        match records.into_keys().min() {
            Some(key) => Err(MemoryError::NoContact { first: key.1, second: name_of(key) }),
            None => Ok(()),
        }
    }
}

fn another_law(key: Key, table: &ContactRecords, group: &ContactGroup) -> MemoryError {
    let described = |records: &ContactRecords| {
        let columns =
            records.columns.iter().map(|MemoryColumn { law, name, .. }| format!("`{name}` of `{law}`"));
        columns.collect::<Vec<_>>().join(", ")
    };
    MemoryError::Law {
        first: key.1,
        second: name_of(key),
        found: described(table),
        expected: described(&ContactRecords::like(group)),
    }
}
