//! Candidate contacts of one contact model, in blocks of eight.

use pulvis_contact::ContactModel;
use pulvis_math::{Mask, Real, Vector3};

use super::kernel::ContactTotals;
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

/// Blocks in a group at the most: a group is what one thread works on at a time.
pub(crate) const BLOCKS: usize = 64;

/// Contacts in a group at the most.
pub(crate) const CAPACITY: usize = BLOCKS * WIDTH;

/// Up to [`CAPACITY`] candidate contacts that one model rules: particle pairs of two materials, or
/// particles of one material near one wall.
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
    /// The smallest gap that any contact of the block had to its reach when it was listed [m]: until
    /// bodies have moved that far, the block needs no look.
    pub(crate) gap: Vec<f64>,
    /// Forces of live blocks: for each block, one value of eight lanes a component.
    pub(crate) forces: Vec<Lane>,
    /// What the last sweep added up to.
    pub(crate) totals: ContactTotals,
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
            gap: Vec::new(),
            forces: Vec::new(),
            totals: ContactTotals::default(),
            count: 0,
        }
    }

    /// Components of force and torque of each contact: the force on the first body, and with friction
    /// the torques on both.
    #[inline(always)]
    pub(crate) fn components(&self) -> usize {
        if self.model.composition.has_friction() { 9 } else { 3 }
    }

    /// Whether no further contact fits in.
    pub(crate) fn is_full(&self) -> bool {
        self.count == CAPACITY
    }

    /// Force and torque of a contact on its first body, or on its second one; `None` for a contact in
    /// a block that does not act.
    #[inline(always)]
    pub(crate) fn force_on(&self, place: usize, second: bool) -> Option<(Vector3, Vector3)> {
        let (block, lane) = (place / WIDTH, place % WIDTH);
        if !self.live[block] {
            return None;
        }
        let components = self.components();
        let forces = &self.forces[block * components..(block + 1) * components];
        let vector = |first: usize| {
            Vector3::new(forces[first].0[lane], forces[first + 1].0[lane], forces[first + 2].0[lane])
        };
        let torque = |first: usize| if components == 9 { vector(first) } else { Vector3::zero() };
        Some(if second { (-vector(0), torque(6)) } else { (vector(0), torque(3)) })
    }

    /// Number of candidate contacts.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Memory of the candidates, of what they remember and of their forces [byte].
    pub(crate) fn memory_size(&self) -> usize {
        size_of_val(&self.first[..])
            + size_of_val(&self.second[..])
            + size_of_val(&self.memory[..])
            + size_of_val(&self.forces[..])
            + size_of_val(&self.gap[..])
            + self.live.len()
    }

    /// Adds a candidate contact with its gap [m], and with its memory where it has any.
    pub(crate) fn push(&mut self, first: u32, second: u32, gap: f64, remembered: Option<&[f64]>) {
        let lane = self.count % WIDTH;
        if lane == 0 {
            self.first.push([first; WIDTH]);
            if self.partner == Partner::Particle {
                self.second.push([second; WIDTH]);
            }
            self.memory.resize(self.memory.len() + self.layout.columns(), Lane::default());
            let components = self.components();
            self.forces.resize(self.forces.len() + components, Lane::default());
            self.live.push(false);
            self.gap.push(gap);
        }
        let block = self.first.len() - 1;
        self.gap[block] = self.gap[block].min(gap);
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
