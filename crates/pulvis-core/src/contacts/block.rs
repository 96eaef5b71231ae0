//! Candidate contacts of one contact model, in blocks of eight.

use pulvis_contact::ContactModel;
use pulvis_math::{Mask, Real};

use super::layout::{Lane, Layout};

/// Contacts in a block.
pub(crate) const WIDTH: usize = 8;

/// What the first body of a group's contacts may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Partner {
    /// Other particles.
    Particle,
    /// The wall at this place in the list of walls.
    Wall(usize),
}

/// All candidate contacts that one model rules: particle pairs of two materials, or particles of one
/// material near one wall.
#[derive(Clone, Debug)]
pub(crate) struct ContactGroup {
    pub(crate) model: ContactModel,
    pub(crate) layout: Layout,
    pub(crate) partner: Partner,
    /// Rows of the first bodies; a last, incomplete block repeats its first contact.
    pub(crate) first: Vec<[u32; WIDTH]>,
    /// Rows of the second bodies; empty for walls.
    pub(crate) second: Vec<[u32; WIDTH]>,
    /// Memory: for each block, one value of eight lanes a column.
    pub(crate) memory: Vec<Lane>,
    /// Whether any contact of the block acted when it was last looked at. Blocks that did not, and
    /// do not, are passed over.
    pub(crate) live: Vec<bool>,
    count: usize,
}

impl ContactGroup {
    /// A group without contacts.
    pub(crate) fn new(model: ContactModel, partner: Partner) -> Self {
        Self {
            model,
            layout: Layout::of(&model),
            partner,
            first: Vec::new(),
            second: Vec::new(),
            memory: Vec::new(),
            live: Vec::new(),
            count: 0,
        }
    }

    /// Number of candidate contacts.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Memory of the candidates and of what they remember [byte].
    pub(crate) fn memory_size(&self) -> usize {
        size_of_val(&self.first[..]) + size_of_val(&self.second[..]) + size_of_val(&self.memory[..])
    }

    /// Adds a candidate contact, with its memory where it has any.
    pub(crate) fn push(&mut self, first: u32, second: u32, remembered: Option<&[f64]>) {
        let lane = self.count % WIDTH;
        if lane == 0 {
            self.first.push([first; WIDTH]);
            if self.partner == Partner::Particle {
                self.second.push([second; WIDTH]);
            }
            self.memory.resize(self.memory.len() + self.layout.columns(), Lane::default());
            self.live.push(false);
        }
        let block = self.first.len() - 1;
        self.first[block][lane] = first;
        if self.partner == Partner::Particle {
            self.second[block][lane] = second;
        }
        if let Some(record) = remembered {
            let columns = self.layout.columns();
            for (column, &value) in self.memory[block * columns..].iter_mut().zip(record) {
                column.0[lane] = value;
            }
            self.live[block] = true;
        }
        self.count += 1;
    }

    /// How many contacts the block holds.
    #[inline(always)]
    pub(crate) fn filled(&self, block: usize) -> usize {
        (self.count - block * WIDTH).min(WIDTH)
    }

    /// Calls `action` with block, lane and memory of every contact that remembers anything.
    pub(crate) fn for_each_memory(&self, mut action: impl FnMut(usize, usize, &[f64])) {
        let columns = self.layout.columns();
        let mut record = vec![0.0; columns];
        for block in (0..self.first.len()).filter(|&block| self.live[block]) {
            let memory = &self.memory[block * columns..(block + 1) * columns];
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
pub(crate) fn filled_lanes(filled: usize) -> <Lane as Real>::Mask {
    if filled == WIDTH {
        return Mask::splat(true);
    }
    Lane::from_lanes(|lane| lane as f64).lt(Lane::splat(filled as f64))
}
