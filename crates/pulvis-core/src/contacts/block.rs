//! Neighbour pairs of one contact model, in blocks of eight.

use std::borrow::Cow;

use pulvis_contact::{ContactEnergies, ContactModel, MOST_QUANTITIES, MemoryLayout, Quantities, bond};
use pulvis_math::{F64Array, Mask, Simd8};

use crate::columns::NamedColumn;
use crate::walls::{WallFeature, WallForce};

use super::totals::GroupTotals;

/// Eight contacts at a time.
pub(crate) type F64x8 = F64Array<8>;

/// Contacts in a block.
pub(crate) const WIDTH: usize = 8;

/// Numbers in a [`Packed4`], and in a [`ForceTorque`]. Blocks keep the index of the first *number* of a row or slot, not
/// the row itself: a load instruction can scale an index by 8 bytes, but not by 32 or 64.
pub(crate) const PACKED4_NUMBERS: u32 = 4;
pub(crate) const FORCE_TORQUE_NUMBERS: u32 = 8;

/// What the second bodies of a group's contacts are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Partner {
    /// Other particles.
    Particle,
    /// Walls. All contacts of a block are with the same wall; the number of its [`WallFeature`] stands in place of the
    /// rows of the second bodies.
    Wall,
}

/// Indices for the first and for the second bodies of eight contacts; an incomplete block repeats its first
/// contact.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct LaneIndices(pub(crate) [[u32; WIDTH]; 2]);

/// The neighbour pairs of one chunk with one contact model: pairs of particles of two materials, or particles of one
/// material near walls of another.
#[derive(Clone, Debug)]
pub(crate) struct ContactGroup {
    /// The number of its pair of materials among the groups of [`Interactions`](super::Interactions).
    pub(crate) number: usize,
    pub(crate) model: ContactModel,
    pub(crate) layout: MemoryLayout,
    /// How far beyond touching its contacts act [m].
    pub(crate) interaction_range: f64,
    /// Where the quantities that the normal law and the attraction read stand among the columns of the particles.
    quantity_columns: [[Option<usize>; MOST_QUANTITIES]; 2],
    /// The largest k/m_r of the last pass [1/s²], where the law does not bound its stiffness; otherwise zero.
    pub(crate) rate_squared: f64,
    pub(crate) partner: Partner,
    /// Rows of the bodies of each block, times [`PACKED4_NUMBERS`].
    pub(crate) rows: Vec<LaneIndices>,
    /// Where their forces and torques are summed: slots of the chunk, times [`FORCE_TORQUE_NUMBERS`]; without meaning for
    /// walls. Not beside the rows in memory, because blocks that do not act need rows only.
    pub(crate) sums: Vec<LaneIndices>,
    /// Number of contacts of each block: eight, except in the last block of the group or of a wall.
    pub(crate) occupancy: Vec<u8>,
    /// Memory of the contacts: for each block, one value of eight lanes per column.
    pub(crate) memory: Vec<F64x8>,
    /// Whether any contact of the block acted when it was last computed. A block must be computed once more after that,
    /// so that its laws can forget.
    pub(crate) active: Vec<bool>,
    /// The smallest gap to the interaction range of any contact of the block at the last rebuild [m]. A block that is not
    /// active is skipped until the bodies can have moved that far.
    pub(crate) gap: Vec<f64>,
    /// Number of batches of blocks that the last pass computed.
    pub(crate) batches: usize,
    /// Whether any pair of the block was across a periodic boundary at the last rebuild. This does not change until the
    /// next rebuild.
    pub(crate) crosses_boundary: Vec<bool>,
    /// Energies of the last pass, lane by lane.
    pub(crate) energies: ContactEnergies<F64x8>,
    /// Sums over the contacts in the last pass of an advance.
    pub(crate) totals: GroupTotals<F64x8>,
    /// Forces and torques of the last pass on the first bodies, wall by wall; empty for pairs of particles.
    pub(crate) wall_forces: Vec<WallForce>,
}

/// A neighbour pair as it is listed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    /// Rows of the bodies; for a wall the number of its feature.
    pub(crate) rows: [u32; 2],
    /// Where their forces and torques are summed.
    pub(crate) sums: [u32; 2],
    /// Gap to the interaction range [m].
    pub(crate) gap: f64,
    /// Whether the nearest image is across a periodic boundary.
    pub(crate) crosses_boundary: bool,
}

impl ContactGroup {
    /// A group without contacts, in the memory of a `spare` one.
    pub(crate) fn new(
        number: usize,
        model: ContactModel,
        interaction_range: f64,
        partner: Partner,
        spare: Option<Self>,
    ) -> Self {
        let layout = model.memory_layout();
        let quantity_columns = [[None; MOST_QUANTITIES]; 2];
        let rate_squared = 0.0;
        let (energies, totals) = (ContactEnergies::default(), GroupTotals::default());
        let Some(mut group) = spare else {
            return Self {
                number,
                model,
                layout,
                interaction_range,
                quantity_columns,
                rate_squared,
                partner,
                rows: Vec::new(),
                sums: Vec::new(),
                occupancy: Vec::new(),
                memory: Vec::new(),
                active: Vec::new(),
                crosses_boundary: Vec::new(),
                gap: Vec::new(),
                batches: 0,
                energies,
                totals,
                wall_forces: Vec::new(),
            };
        };
        group.rows.clear();
        group.sums.clear();
        group.occupancy.clear();
        group.memory.clear();
        group.active.clear();
        group.crosses_boundary.clear();
        group.gap.clear();
        group.wall_forces.clear();
        Self {
            number,
            model,
            layout,
            interaction_range,
            quantity_columns,
            rate_squared,
            partner,
            energies,
            totals,
            ..group
        }
    }

    /// Looks for the quantities that its laws read among the columns of the particles.
    pub(crate) fn find_quantities(&mut self, columns: &[NamedColumn]) {
        for (slots, read) in self.quantity_columns.iter_mut().zip(self.model.quantities_by_law()) {
            for (slot, quantity) in slots.iter_mut().zip(read) {
                *slot = columns.iter().position(|column| column.name == quantity.name);
            }
        }
    }

    /// Whether its laws read quantities of particles.
    pub(crate) fn reads_quantities(&self) -> bool {
        self.quantity_columns.iter().flatten().any(Option::is_some)
    }

    /// The quantities of the particles in two rows; zero of a wall, which has none.
    pub(crate) fn quantities(
        &self,
        columns: &[NamedColumn],
        first: usize,
        second: Option<usize>,
    ) -> Quantities {
        let of = |slots: &[Option<usize>; MOST_QUANTITIES]| {
            slots.map(|slot| {
                let at = |row: usize| slot.map_or(0.0, |column| columns[column].values[row]);
                [at(first), second.map_or(0.0, at)]
            })
        };
        let [normal, attraction] = &self.quantity_columns;
        Quantities { normal: of(normal), attraction: of(attraction) }
    }

    /// Number of neighbour pairs.
    pub(crate) fn len(&self) -> usize {
        self.occupancy.iter().map(|&occupancy| usize::from(occupancy)).sum()
    }

    /// Memory of the pairs and of their contacts [byte].
    pub(crate) fn memory_size(&self) -> usize {
        size_of_val(&self.rows[..])
            + size_of_val(&self.sums[..])
            + size_of_val(&self.memory[..])
            + size_of_val(&self.gap[..])
            + self.active.len()
            + self.crosses_boundary.len()
            + self.occupancy.len()
    }

    /// Makes room for more contacts.
    pub(crate) fn reserve(&mut self, contacts: usize) {
        let blocks = contacts.div_ceil(WIDTH);
        self.rows.reserve(blocks);
        self.sums.reserve(blocks);
        self.occupancy.reserve(blocks);
        self.memory.reserve(blocks * self.layout.columns());
        self.active.reserve(blocks);
        self.crosses_boundary.reserve(blocks);
        self.gap.reserve(blocks);
    }

    /// Adds a block of up to eight pairs. `memory` returns the stored memory of a lane, if there is any.
    #[inline(always)]
    pub(crate) fn push_block<'a>(
        &mut self,
        candidates: &[Candidate],
        memory: impl Fn(&Self, usize) -> Option<Cow<'a, [f64]>>,
    ) {
        let Some(first) = candidates.first() else { return };
        let mut rows = LaneIndices(first.rows.map(|row| [row * PACKED4_NUMBERS; WIDTH]));
        let mut sums = LaneIndices(first.sums.map(|index| [index * FORCE_TORQUE_NUMBERS; WIDTH]));
        let mut gap = f64::INFINITY;
        for (lane, candidate) in candidates.iter().take(WIDTH).enumerate() {
            for body in 0..2 {
                rows.0[body][lane] = candidate.rows[body] * PACKED4_NUMBERS;
                sums.0[body][lane] = candidate.sums[body] * FORCE_TORQUE_NUMBERS;
            }
            gap = gap.min(candidate.gap);
        }
        let start = self.memory.len();
        self.memory.resize(start + self.layout.columns(), F64x8::default());
        let mut active = false;
        for lane in 0..candidates.len() {
            if let Some(record) = memory(self, lane) {
                for (column, &value) in self.memory[start..].iter_mut().zip(&*record) {
                    column.0[lane] = value;
                }
                active = true;
            }
        }
        self.rows.push(rows);
        self.sums.push(sums);
        self.occupancy.push(candidates.len() as u8);
        self.active.push(active);
        self.crosses_boundary.push(candidates.iter().any(|candidate| candidate.crosses_boundary));
        self.gap.push(gap);
    }

    /// Row of the first body of a contact.
    pub(crate) fn first_row(&self, block: usize, lane: usize) -> u32 {
        self.rows[block].0[0][lane] / PACKED4_NUMBERS
    }

    /// Row of the second body of a contact between particles; the index of a wall.
    pub(crate) fn second_row(&self, block: usize, lane: usize) -> u32 {
        self.rows[block].0[1][lane] / PACKED4_NUMBERS
    }

    /// The columns of memory of a block.
    pub(crate) fn columns(&self, block: usize) -> &[F64x8] {
        let columns = self.layout.columns();
        &self.memory[block * columns..(block + 1) * columns]
    }

    /// The column of memory that holds the state of the bond, if its contacts may be bonded.
    pub(crate) fn bond_state(&self) -> Option<usize> {
        self.model.laws.bond.map(|_| self.layout.slots().bond() + bond::STATE)
    }

    /// The index of the wall that the contacts of a block of walls are with.
    #[inline(always)]
    pub(crate) fn wall(&self, block: usize) -> usize {
        WallFeature::from_number(self.second_row(block, 0)).wall()
    }

    /// The features that the contacts of a block of walls are with.
    pub(crate) fn wall_features(&self, block: usize) -> [WallFeature; WIDTH] {
        std::array::from_fn(|lane| WallFeature::from_number(self.second_row(block, lane)))
    }

    /// How many contacts the block holds.
    #[inline(always)]
    pub(crate) fn occupancy(&self, block: usize) -> usize {
        usize::from(self.occupancy[block])
    }

    /// Appends the memory of every contact with a column that is not zero to `records`. Calls `action` with the block and
    /// lane of each, and the index where its record begins.
    pub(crate) fn for_each_memory(
        &self,
        records: &mut Vec<f64>,
        mut action: impl FnMut(usize, usize, usize),
    ) {
        for block in (0..self.rows.len()).filter(|&block| self.active[block]) {
            let memory = self.columns(block);
            for lane in 0..self.occupancy(block) {
                if memory.iter().any(|column| column.0[lane] != 0.0) {
                    action(block, lane, records.len());
                    records.extend(memory.iter().map(|column| column.0[lane]));
                }
            }
        }
    }
}

/// True in the first `occupancy` lanes.
#[inline(always)]
pub(crate) fn occupied_lanes<R: Simd8>(occupancy: u8) -> R::Mask {
    if usize::from(occupancy) == WIDTH {
        return Mask::splat(true);
    }
    const NUMBERS: F64x8 = F64Array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    R::load(&NUMBERS).lt(R::splat(f64::from(occupancy)))
}
