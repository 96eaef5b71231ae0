//! Candidate contacts of one contact model, in blocks of eight.

use pulvis_contact::{ContactEnergies, ContactModel};
use pulvis_math::{Lanes, Mask, Octet, Vector3};

use super::layout::{Lane, Layout};

/// Contacts in a block.
pub(crate) const WIDTH: usize = 8;

/// Numbers in a quad, and in a load. Rows are kept as the places of their numbers: processors multiply an
/// index by the size of a number on the way, but not by that of a quad.
pub(crate) const QUAD: u32 = 4;
pub(crate) const LOAD: u32 = 8;

/// What the first body of a group's contacts may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Partner {
    /// Other particles.
    Particle,
    /// Walls. All contacts of a block are with the same one, whose place in the list of walls stands for the
    /// rows of the second bodies.
    Wall,
}

/// Places for the first and for the second bodies of eight contacts; an incomplete block repeats its first
/// contact.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Places(pub(crate) [[u32; WIDTH]; 2]);

/// Candidate contacts of one piece that one model rules: particle pairs of two materials, or particles
/// of one material near one wall.
#[derive(Clone, Debug)]
pub(crate) struct ContactGroup {
    pub(crate) model: ContactModel,
    pub(crate) layout: Layout,
    pub(crate) partner: Partner,
    /// Rows of the bodies of each block, times [`QUAD`].
    pub(crate) rows: Vec<Places>,
    /// Where their loads are summed: places among those of the piece, times [`LOAD`]; those of walls mean
    /// nothing. Apart from the rows: blocks that are looked at and found not to act need none.
    pub(crate) sums: Vec<Places>,
    /// How many contacts each block holds: eight, but in the last one and where another wall follows.
    pub(crate) filled: Vec<u8>,
    /// Memory: for each block, one value of eight lanes a column.
    pub(crate) memory: Vec<Lane>,
    /// Whether any contact of the block acted when it was last looked at. Blocks that did not, and
    /// do not, are passed over.
    pub(crate) live: Vec<bool>,
    /// The smallest gap that any contact of the block had to its reach when it was listed [m]: until
    /// bodies have moved that far, the block needs no look.
    pub(crate) gap: Vec<f64>,
    /// What the last sweep added up to, lane by lane.
    pub(crate) energies: ContactEnergies<Lane>,
    /// The forces of the last sweep on the first bodies [N], wall by wall; empty for particles.
    pub(crate) wall_forces: Vec<Vector3>,
}

/// A candidate contact as it is listed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    /// Rows of the bodies; of a wall its place.
    pub(crate) rows: [u32; 2],
    /// Where their loads are summed.
    pub(crate) sums: [u32; 2],
    /// Gap to the reach [m].
    pub(crate) gap: f64,
}

impl ContactGroup {
    /// A group without contacts, in the memory of a `spare` one.
    pub(crate) fn new(model: ContactModel, partner: Partner, spare: Option<Self>) -> Self {
        let layout = Layout::of(&model);
        let energies = ContactEnergies::default();
        let Some(mut group) = spare else {
            return Self {
                model,
                layout,
                partner,
                rows: Vec::new(),
                sums: Vec::new(),
                filled: Vec::new(),
                memory: Vec::new(),
                live: Vec::new(),
                gap: Vec::new(),
                energies,
                wall_forces: Vec::new(),
            };
        };
        group.rows.clear();
        group.sums.clear();
        group.filled.clear();
        group.memory.clear();
        group.live.clear();
        group.gap.clear();
        group.wall_forces.clear();
        Self { model, layout, partner, energies, ..group }
    }

    /// Number of candidate contacts.
    pub(crate) fn len(&self) -> usize {
        self.filled.iter().map(|&filled| usize::from(filled)).sum()
    }

    /// Memory of the candidates and of what they remember [byte].
    pub(crate) fn memory_size(&self) -> usize {
        size_of_val(&self.rows[..])
            + size_of_val(&self.sums[..])
            + size_of_val(&self.memory[..])
            + size_of_val(&self.gap[..])
            + self.live.len()
            + self.filled.len()
    }

    /// Adds a candidate contact, with its memory where it has any.
    pub(crate) fn push(&mut self, candidate: &Candidate, remembered: Option<&[f64]>) {
        let rows = candidate.rows.map(|row| row * QUAD);
        let sums = candidate.sums.map(|place| place * LOAD);
        let last = self.rows.last().zip(self.filled.last());
        let goes_on = last.is_some_and(|(last, &filled)| {
            usize::from(filled) < WIDTH && (self.partner == Partner::Particle || last.0[1][0] == rows[1])
        });
        if !goes_on {
            let all = |place: u32| [place; WIDTH];
            self.rows.push(Places(rows.map(all)));
            self.sums.push(Places(sums.map(all)));
            self.filled.push(0);
            self.memory.resize(self.memory.len() + self.layout.columns(), Lane::default());
            self.live.push(false);
            self.gap.push(candidate.gap);
        }
        let block = self.rows.len() - 1;
        let lane = self.filled(block);
        self.gap[block] = self.gap[block].min(candidate.gap);
        for body in 0..2 {
            self.rows[block].0[body][lane] = rows[body];
            self.sums[block].0[body][lane] = sums[body];
        }
        if let Some(record) = remembered {
            let columns = self.layout.columns();
            for (column, &value) in self.memory[block * columns..].iter_mut().zip(record) {
                column.0[lane] = value;
            }
            self.live[block] = true;
        }
        self.filled[block] += 1;
    }

    /// Row of the first body of a contact.
    pub(crate) fn first_row(&self, block: usize, lane: usize) -> u32 {
        self.rows[block].0[0][lane] / QUAD
    }

    /// Row of the second body of a contact between particles; the place of a wall.
    pub(crate) fn second_row(&self, block: usize, lane: usize) -> u32 {
        self.rows[block].0[1][lane] / QUAD
    }

    /// The columns of memory of a block.
    pub(crate) fn columns(&self, block: usize) -> &[Lane] {
        let columns = self.layout.columns();
        &self.memory[block * columns..(block + 1) * columns]
    }

    /// How many contacts the block holds.
    #[inline(always)]
    pub(crate) fn filled(&self, block: usize) -> usize {
        usize::from(self.filled[block])
    }

    /// Calls `action` with block, lane and memory of every contact that remembers anything.
    pub(crate) fn for_each_memory(&self, mut action: impl FnMut(usize, usize, &[f64])) {
        let columns = self.layout.columns();
        let mut record = vec![0.0; columns];
        for block in (0..self.rows.len()).filter(|&block| self.live[block]) {
            let memory = self.columns(block);
            for lane in 0..self.filled(block) {
                for (slot, column) in record.iter_mut().zip(memory) {
                    *slot = column.0[lane];
                }
                if record.iter().any(|&value| value != 0.0) {
                    action(block, lane, &record);
                }
            }
        }
    }
}

/// True in the first `filled` lanes.
#[inline(always)]
pub(crate) fn filled_lanes<R: Octet>(filled: u8) -> R::Mask {
    if usize::from(filled) == WIDTH {
        return Mask::splat(true);
    }
    const NUMBERS: Lane = Lanes([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    R::load(&NUMBERS).lt(R::splat(f64::from(filled)))
}
