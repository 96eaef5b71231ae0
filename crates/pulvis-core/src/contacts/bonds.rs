//! Bonds of all contacts: how they form, how many there are, and which have broken.

use pulvis_contact::bond::{BROKEN, INTACT};

use super::ContactTable;
use super::block::{ContactGroup, F64x8};
use super::records::{Key, key_of};
use super::view::Views;
use crate::particles::{ParticleId, Particles};
use crate::thread_pool::ThreadPool;
use crate::walls::WallNow;
use pulvis_boundary::{Images, UpperTriangular};

/// Two bodies whose bond has broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BrokenBond {
    /// Whether the second body is a wall.
    pub with_wall: bool,
    /// Id of the first body.
    pub first: ParticleId,
    /// Id of the second body; for a wall the number of its feature, which is the index of the wall if it has only one.
    pub second: u32,
}

impl From<Key> for BrokenBond {
    fn from((with_wall, first, second): Key) -> Self {
        Self { with_wall, first, second }
    }
}

/// Numbers of bonds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BondCount {
    /// Bonds that hold [1].
    pub intact: u64,
    /// Bonds that have broken so far, those of removed particles among them [1].
    pub broken: u64,
}

/// All pairs whose bond has broken. What contacts remember ends when the bodies leave the neighbour list; that a bond has
/// broken is remembered for good.
#[derive(Clone, Debug, Default)]
pub(crate) struct BrokenBonds {
    /// In ascending order.
    pairs: Vec<BrokenBond>,
}

impl BrokenBonds {
    /// From pairs in any order.
    pub(crate) fn new(pairs: &[BrokenBond]) -> Self {
        let mut pairs = pairs.to_vec();
        pairs.sort_unstable();
        pairs.dedup();
        Self { pairs }
    }

    /// All pairs, in ascending order.
    pub(crate) fn pairs(&self) -> &[BrokenBond] {
        &self.pairs
    }

    /// Takes in pairs, some of which may be known.
    pub(crate) fn take_in(&mut self, broken: impl Iterator<Item = BrokenBond>) {
        let new: Vec<BrokenBond> = broken.filter(|pair| !self.contains(*pair)).collect();
        if !new.is_empty() {
            self.pairs.extend(new);
            self.pairs.sort_unstable();
        }
    }

    /// Memory [byte].
    pub(crate) fn memory_size(&self) -> usize {
        size_of_val(&self.pairs[..])
    }

    fn contains(&self, pair: BrokenBond) -> bool {
        self.pairs.binary_search(&pair).is_ok()
    }
}

/// The bodies of a group's contacts whose bond has this `state`. All blocks count: also those that do not act remember.
fn in_state<'a>(
    group: &'a ContactGroup,
    ids: &'a [ParticleId],
    state: f64,
) -> impl Iterator<Item = BrokenBond> + 'a {
    let blocks = group.bond_state().map(|column| (0..group.rows.len()).map(move |block| (block, column)));
    blocks.into_iter().flatten().flat_map(move |(block, column)| {
        let states = group.columns(block)[column].0;
        let lanes = (0..group.occupancy(block)).filter(move |&lane| states[lane] == state);
        lanes.map(move |lane| key_of(group, ids, block, lane).into())
    })
}

impl ContactTable {
    /// The pairs of listed contacts whose bond has broken.
    pub(crate) fn broken<'a>(&'a self, ids: &'a [ParticleId]) -> impl Iterator<Item = BrokenBond> + 'a {
        self.groups().flat_map(|group| in_state(group, ids, BROKEN))
    }

    /// The bonds that hold, and those that have broken: the pairs `known` as such, and those listed since.
    pub(crate) fn count_bonds(&self, ids: &[ParticleId], known: &BrokenBonds) -> BondCount {
        let intact = self.groups().flat_map(|group| in_state(group, ids, INTACT)).count();
        let new = self.broken(ids).filter(|pair| !known.contains(*pair)).count();
        BondCount { intact: intact as u64, broken: (known.pairs.len() + new) as u64 }
    }

    /// Lets the contacts of a new list know which of them had a bond that has broken.
    pub(crate) fn restore_broken(&mut self, ids: &[ParticleId], broken: &BrokenBonds, pool: &ThreadPool) {
        if broken.pairs.is_empty() {
            return;
        }
        pool.for_each(self.chunks_mut(), |_, chunk| {
            for group in &mut chunk.groups {
                let Some(column) = group.bond_state() else { continue };
                for block in 0..group.rows.len() {
                    for lane in 0..group.occupancy(block) {
                        let state = state_of(group, block, column).0[lane];
                        if state == 0.0 && broken.contains(key_of(group, ids, block, lane).into()) {
                            state_of(group, block, column).0[lane] = BROKEN;
                        }
                    }
                }
            }
        });
    }

    /// Bonds all pairs that are near enough and whose bonds form at the start of a stage; answers with their number.
    pub(crate) fn form_bonds(&mut self, particles: &Particles, images: Images, walls: &[WallNow]) -> u64 {
        let mut formed = 0;
        let (mut record, mut overlaps) = (Vec::new(), Vec::new());
        for group in self.groups_mut() {
            if group.bond_state().is_none() {
                continue;
            }
            let (model, width) = (group.model, group.layout.columns());
            for block in 0..group.rows.len() {
                let views = Views { group, particles, images, rate: UpperTriangular::ZERO, walls };
                overlaps.clear();
                overlaps.extend((0..group.occupancy(block)).map(|lane| views.overlap(block, lane)));
                for (lane, overlap) in overlaps.iter().enumerate() {
                    let Some(overlap) = *overlap else { continue };
                    let columns = &mut group.memory[block * width..(block + 1) * width];
                    record.clear();
                    record.extend(columns.iter().map(|column| column.0[lane]));
                    if model.form_bond(overlap, &mut record) {
                        formed += 1;
                        for (column, value) in columns.iter_mut().zip(&record) {
                            column.0[lane] = *value;
                        }
                    }
                }
            }
        }
        formed
    }
}

/// The states of the bonds of a block.
fn state_of(group: &mut ContactGroup, block: usize, column: usize) -> &mut F64x8 {
    let width = group.layout.columns();
    &mut group.memory[block * width + column]
}
