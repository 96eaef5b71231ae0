//! A batch of blocks in the contact loop: gathered, computed, added up.

use pulvis_contact::normal::NormalSource;
use pulvis_contact::{
    Columns, ContactEnergies, ContactInputs, ContactKinematics, ContactLaws, MemorySlots, Pair, Quantities,
    levels,
};
use pulvis_math::{F64Array, Packed4, Simd4, Simd4Pair, Simd8, Vector3};

use super::super::block::{ContactGroup, LaneIndices, Partner, WIDTH};
use super::super::totals::GroupTotals;
use super::bonds::Distance;
use super::normal::NormalCall;
use crate::columns::NamedColumn;
use crate::particles::ForceTorque;
use crate::shared::Shared;

/// Blocks per batch: all are gathered, then all computed, then all added up. One block has more instructions than a
/// processor looks ahead. Short loops one after the other let it work on several blocks at a time, and need fewer
/// registers.
pub(super) const BATCH: usize = 2;

/// Eight contacts at a time.
type F64x8 = F64Array<8>;

/// The columns of memory of one block.
pub(super) struct BlockColumns<'a>(&'a mut [F64x8]);

impl<'a> BlockColumns<'a> {
    /// Those of `block` among the memory of a group with so many `columns` a block.
    ///
    /// # Safety
    /// The memory holds that of the block.
    #[inline(always)]
    pub(super) unsafe fn of(memory: &'a mut [F64x8], block: usize, columns: usize) -> Self {
        // SAFETY: the caller's.
        Self(unsafe { memory.get_unchecked_mut(block * columns..(block + 1) * columns) })
    }
}

impl<R: Simd8> Columns<R> for BlockColumns<'_> {
    #[inline(always)]
    fn get(&self, column: usize) -> R {
        R::load(&self.0[column])
    }
    #[inline(always)]
    fn set(&mut self, column: usize, value: R) {
        value.store(&mut self.0[column]);
    }
}

/// A block that has been gathered.
#[derive(Clone, Copy)]
pub(super) struct GatheredBlock<R> {
    pub(super) block: usize,
    /// 1/m_i + 1/m_j [1/kg], of a wall contact 1/m_i.
    pub(super) inverse_mass: R,
    /// 1/a_i + 1/a_j [1/m], of a wall contact 1/a_i and the mean curvature of the wall.
    pub(super) inverse_radius: R,
    pub(super) motion: ContactKinematics<R>,
}

impl<R: Simd8> GatheredBlock<R> {
    /// The constants of the bodies, without quantities.
    #[inline(always)]
    pub(super) fn pair(&self) -> Pair<R> {
        Pair::from_sums(self.inverse_mass, self.inverse_radius)
    }
}

/// A block that has been computed.
#[derive(Clone, Copy)]
pub(super) struct ContactResponses<R> {
    pub(super) force: Vector3<R>,
    torque_i: Vector3<R>,
    pub(super) torque_j: Vector3<R>,
}

/// The inputs of computing the blocks of a group.
pub(super) struct Response<C> {
    pub(super) call: C,
    pub(super) laws: ContactLaws,
    pub(super) slots: MemorySlots,
    /// The step that led to the present positions [s].
    pub(super) time_step: f64,
    /// Temperature in the middle of that step [K].
    pub(super) temperature: f64,
    /// Whether energy can be dissipated along the normal.
    pub(super) with_memory: bool,
    /// Whether energies are summed up.
    pub(super) ledger: bool,
    /// Whether stored energies are summed, beside dissipated ones.
    pub(super) stored: bool,
    /// Whether sums for observation are made.
    pub(super) observed: bool,
}

/// The sums over the blocks of a group.
#[derive(Clone, Copy)]
pub(super) struct BlockSums<R> {
    pub(super) energies: ContactEnergies<R>,
    /// Sums for observation.
    pub(super) totals: GroupTotals<R>,
    /// The largest k/m_r of the contacts [1/s²], where it is monitored.
    pub(super) rate_squared: R,
}

impl<R: Simd8> BlockSums<R> {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { energies: ContactEnergies::default(), totals: GroupTotals::default(), rate_squared: R::zero() }
    }
}

/// Adds eight forces and torques to the sums, one after the other: several lanes may have the same index.
macro_rules! add_force_torques {
    ($sums:expr, $slots:expr, $sum:ident, $forces_and_torques:expr) => {
        for lane in 0..WIDTH {
            // SAFETY: slots lie within the sums, as the caller vouches.
            let packed = unsafe { $sums.get_mut_at_number($slots[lane]) }.packed_mut();
            R::Simd4Pair::load(packed).$sum($forces_and_torques[lane]).store(packed);
        }
    };
}

/// The same for forces alone.
macro_rules! add_forces {
    ($sums:expr, $slots:expr, $sum:ident, $forces:expr) => {
        for lane in 0..WIDTH {
            // SAFETY: slots lie within the sums, as the caller vouches.
            let force = unsafe { &mut $sums.get_mut_at_number($slots[lane]).force };
            R::Simd4::load(force).$sum($forces[lane]).store(force);
        }
    };
}

/// Up to [`BATCH`] blocks.
pub(super) struct Batch<R> {
    blocks: [GatheredBlock<R>; BATCH],
    responses: [ContactResponses<R>; BATCH],
    count: usize,
}

impl<R: Simd8> Batch<R> {
    /// No blocks yet.
    #[inline(always)]
    pub(super) fn new() -> Self {
        let (zero, none) = (R::zero(), Vector3::zero());
        let motion = ContactKinematics {
            normal: none,
            overlap: zero,
            inverse_distance: zero,
            normal_rate: None,
            radius_i: zero,
            radius_j: zero,
            velocity: none,
            velocity_mid: none,
            angular_velocity_i: none,
            angular_velocity_j: none,
            angular_velocity_i_mid: none,
            angular_velocity_j_mid: none,
        };
        let block = GatheredBlock { block: 0, inverse_mass: zero, inverse_radius: zero, motion };
        let responses = ContactResponses { force: none, torque_i: none, torque_j: none };
        Self { blocks: [block; BATCH], responses: [responses; BATCH], count: 0 }
    }

    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.count == BATCH
    }

    /// Room for one more block. Fields that are never written stay zero, so that values that a contact does not use need not
    /// be written for each block.
    #[inline(always)]
    pub(super) fn add(&mut self) -> &mut GatheredBlock<R> {
        self.count += 1;
        &mut self.blocks[self.count - 1]
    }

    /// Where `block` stands, if it is the one that was added last.
    #[inline(always)]
    pub(super) fn index_of_last(&self, block: usize) -> Option<usize> {
        let last = self.count.checked_sub(1)?;
        (self.blocks[last].block == block).then_some(last)
    }

    /// Computes all blocks, updates their `memory`, and adds up their energies if the ledger is kept.
    ///
    /// # Safety
    /// `memory` holds that of every block, as `response` lays it out.
    #[inline(always)]
    pub(super) unsafe fn respond<C: NormalCall<R>, const RESISTANCE: u8, const LEDGER: bool>(
        &mut self,
        response: &mut Response<C>,
        memory: &mut [F64x8],
        totals: &mut BlockSums<R>,
    ) {
        let columns = response.slots.columns();
        response.call.prepare(&mut self.blocks[..self.count], memory);
        for index in 0..self.count {
            let gathered = &self.blocks[index];
            let (motion, pair) = (&gathered.motion, response.call.pair(index, gathered));
            // SAFETY: the caller's.
            let mut columns = unsafe { BlockColumns::of(memory, gathered.block, columns) };
            let Response { time_step, temperature, .. } = *response;
            let inputs = ContactInputs { pair: &pair, motion, time_step, temperature };
            let mut answer = response.laws.respond::<R, C::Source<'_>, _, RESISTANCE>(
                &response.call.source(index),
                &response.slots,
                inputs,
                &mut columns,
            );
            response.call.complete(index, &mut answer);
            self.responses[index] = ContactResponses {
                force: answer.force,
                torque_i: answer.torque_i,
                torque_j: answer.torque_j,
            };
            if response.call.monitors_rate() {
                totals.rate_squared = totals.rate_squared.max(answer.stiffness * pair.inverse_reduced_mass());
            }
            if response.observed {
                let Distance { overlap, length } = response.call.distance(index, motion);
                totals.totals.add(overlap, motion.normal, length, answer.force);
            }
            if LEDGER && response.ledger {
                let common = <C::Source<'_> as NormalSource<R>>::COMMON.is_some();
                totals.energies.add_dissipated::<RESISTANCE>(&answer.energies, response.with_memory, common);
                // The compiler moves the computation of stored energies into this branch.
                if response.stored {
                    totals.energies.add_stored(&answer.energies);
                }
            }
        }
    }

    /// How many blocks there are.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// A block, and what has been computed of it.
    #[inline(always)]
    pub(super) fn response(&self, index: usize) -> (usize, &ContactResponses<R>) {
        (self.blocks[index].block, &self.responses[index])
    }

    /// Adds the forces and torques to `sums`, at the `slots` of each block; the batch is empty afterwards.
    ///
    /// # Safety
    /// Every block has its slots, and they lie within the sums.
    #[inline(always)]
    pub(super) unsafe fn add_up<const RESISTANCE: u8, const PAIRS: bool>(
        &mut self,
        slots: &[LaneIndices],
        sums: Shared<'_, ForceTorque>,
    ) {
        for index in 0..self.count {
            let (block, answer) = (self.blocks[index].block, &self.responses[index]);
            // SAFETY: the caller's.
            let [first, second] = unsafe { &slots.get_unchecked(block).0 };
            if RESISTANCE == levels::NONE {
                let forces = R::rows(columns_of(answer.force));
                add_forces!(sums, first, plus, forces);
                if PAIRS {
                    add_forces!(sums, second, minus, forces);
                }
                continue;
            }
            let forces_and_torques = R::row_pairs(columns_of(answer.force), columns_of(answer.torque_i));
            add_force_torques!(sums, first, plus, forces_and_torques);
            if PAIRS {
                let forces_and_torques = R::row_pairs(columns_of(answer.force), columns_of(answer.torque_j));
                add_force_torques!(sums, second, minus_plus, forces_and_torques);
            }
        }
        self.count = 0;
    }
}

/// The quantities of the particles of a block, in memory: few groups have laws that read them, and the loops of others
/// hold no code for it.
#[inline(never)]
pub(super) fn quantities_of(
    group: &ContactGroup,
    columns: &[NamedColumn],
    block: usize,
) -> Quantities<F64x8> {
    let pairs: [Quantities; WIDTH] = std::array::from_fn(|lane| {
        let second = match group.partner {
            Partner::Particle => Some(group.second_row(block, lane) as usize),
            Partner::Wall => None,
        };
        group.quantities(columns, group.first_row(block, lane) as usize, second)
    });
    Quantities::from_fn(|lane| pairs[lane])
}

/// The columns of eight rows.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
pub(super) unsafe fn gather<R: Simd8>(column: Shared<'_, Packed4>, rows: &[u32; WIDTH]) -> (Vector3<R>, R) {
    // SAFETY: the caller's.
    let [x, y, z, scalar] = R::columns(unsafe { load::<R>(column, rows) });
    (Vector3::new(x, y, z), scalar)
}

/// The vectors of eight rows less those of eight others, and the sums of the scalars.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
pub(super) unsafe fn gather_apart<R: Simd8>(
    column: Shared<'_, Packed4>,
    [ones, others]: &[[u32; WIDTH]; 2],
) -> (Vector3<R>, R) {
    // SAFETY: the caller's.
    let [x, y, z, scalar] = unsafe { R::apart(load::<R>(column, ones), load::<R>(column, others)) };
    (Vector3::new(x, y, z), scalar)
}

/// Eight rows.
///
/// # Safety
/// The rows lie within the column, and nobody writes them meanwhile.
#[inline(always)]
unsafe fn load<R: Simd8>(column: Shared<'_, Packed4>, rows: &[u32; WIDTH]) -> [R::Simd4; WIDTH] {
    // SAFETY: the caller's.
    unsafe {
        [
            R::Simd4::load(column.get_at_number(rows[0])),
            R::Simd4::load(column.get_at_number(rows[1])),
            R::Simd4::load(column.get_at_number(rows[2])),
            R::Simd4::load(column.get_at_number(rows[3])),
            R::Simd4::load(column.get_at_number(rows[4])),
            R::Simd4::load(column.get_at_number(rows[5])),
            R::Simd4::load(column.get_at_number(rows[6])),
            R::Simd4::load(column.get_at_number(rows[7])),
        ]
    }
}

/// The columns of a vector; the scalars are zero.
#[inline(always)]
fn columns_of<R: Simd8>(vector: Vector3<R>) -> [R; 4] {
    [vector.x, vector.y, vector.z, R::zero()]
}
