//! How the loops call bonds: through a pointer once per batch, before the laws of the contact.

use pulvis_contact::bond::BondResponse;
use pulvis_contact::{Bond, ContactInputs, ContactKinematics, ContactResponse, MemorySlots};
use pulvis_math::{F64Array, Pointer, Real, Routine, Simd8, Task};

use super::batch::{BATCH, BlockColumns, GatheredBlock};
use super::normal::StepMiddle;

/// Eight contacts at a time.
type F64x8 = F64Array<8>;

/// Overlap of two bodies and distance of their centres [m].
#[derive(Clone, Copy)]
pub(super) struct Distance<R> {
    pub(super) overlap: R,
    pub(super) length: R,
}

impl<R: Real> Distance<R> {
    #[inline(always)]
    pub(super) fn of(motion: &ContactKinematics<R>) -> Self {
        let overlap = motion.overlap;
        Self { overlap, length: motion.radius_i + motion.radius_j - overlap }
    }
}

/// The bonds of a group, and what they answer for the blocks of a batch.
pub(super) struct BondCall<R: Simd8> {
    bond: Bond,
    pointer: Pointer<BondTask, R>,
    slots: MemorySlots,
    advance: StepMiddle,
    answers: [BondResponse<R>; BATCH],
    /// Overlaps and distances of the bodies, which the laws of the contact may see otherwise.
    distances: [Distance<R>; BATCH],
}

impl<R: Simd8> BondCall<R> {
    /// Calls of a bond, with the memory where `slots` says.
    #[inline(always)]
    pub(super) fn new(bond: Bond, slots: MemorySlots, advance: StepMiddle) -> Self {
        let pointer = R::pointer::<BondTask, BondRoutine>();
        let nowhere = Distance { overlap: R::zero(), length: R::zero() };
        let (answers, distances) = ([BondResponse::default(); BATCH], [nowhere; BATCH]);
        Self { bond, pointer, slots, advance, answers, distances }
    }

    /// Computes the bonds of the blocks, and turns the blocks into what the laws of the contact see beside the bonds.
    #[inline(always)]
    pub(super) fn prepare(&mut self, blocks: &mut [GatheredBlock<R>], memory: &mut [F64x8]) {
        self.pointer.call(&mut BondBatch {
            bond: &self.bond,
            slots: &self.slots,
            advance: self.advance,
            blocks,
            answers: &mut self.answers,
            distances: &mut self.distances,
            memory,
        });
    }

    /// How far apart the bodies of block `index` are.
    #[inline(always)]
    pub(super) fn distance(&self, index: usize) -> Distance<R> {
        self.distances[index]
    }

    /// Adds the bonds of block `index` to the answer of the laws of the contact.
    #[inline(always)]
    pub(super) fn add_to(&self, index: usize, answer: &mut ContactResponse<R>) {
        self.answers[index].add_to(answer);
    }
}

/// The inputs and outputs of the routine.
pub(super) struct BondBatch<'a, R: Simd8> {
    bond: &'a Bond,
    slots: &'a MemorySlots,
    advance: StepMiddle,
    blocks: &'a mut [GatheredBlock<R>],
    answers: &'a mut [BondResponse<R>; BATCH],
    distances: &'a mut [Distance<R>; BATCH],
    memory: &'a mut [F64x8],
}

/// Computes the bonds of a batch of blocks.
pub(super) struct BondTask;

impl Task for BondTask {
    type Data<'a, R: Simd8> = BondBatch<'a, R>;
}

/// The routine of all bonds.
struct BondRoutine;

impl Routine<BondTask> for BondRoutine {
    #[inline(always)]
    fn call<R: Simd8>(data: &mut BondBatch<'_, R>) {
        let (bond, slots) = (*data.bond, *data.slots);
        let StepMiddle { time_step, temperature } = data.advance;
        let places = data.answers.iter_mut().zip(&mut *data.distances);
        for (block, (answer, distance)) in data.blocks.iter_mut().zip(places) {
            // SAFETY: every gathered block has its memory.
            let mut columns = unsafe { BlockColumns::of(data.memory, block.block, slots.columns()) };
            let pair = block.pair();
            let inputs = ContactInputs { pair: &pair, motion: &block.motion, time_step, temperature };
            *answer = bond.respond(inputs, slots.bond(), &mut columns);
            *distance = Distance::of(&block.motion);
            block.motion = answer.beside(&block.motion);
        }
    }
}
