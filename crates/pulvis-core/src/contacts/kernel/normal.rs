//! How the loops call normal laws: inlined, or through a pointer once per batch.

use std::marker::PhantomData;

use pulvis_contact::normal::{Computed, Inlined, NormalSource, answer};
use pulvis_contact::{
    ContactKinematics, ContactModel, ContactResponse, MemorySlots, Normal, NormalLaw, NormalLawVisitor,
    NormalMotion, NormalResponse, Pair, Quantities,
};
use pulvis_math::{F64Array, Pointer, Routine, Simd8, Task};

use super::super::block::ContactGroup;
use super::batch::{BATCH, BlockColumns, GatheredBlock, quantities_of};
use super::bonds::{BondCall, Distance};
use crate::columns::NamedColumn;

/// Eight contacts at a time.
type F64x8 = F64Array<8>;

/// How a loop calls the normal law.
pub(super) trait NormalCall<R: Simd8> {
    /// The source of the response for one block.
    type Source<'a>: NormalSource<R>
    where
        Self: 'a;

    /// Called once per batch, before any block of it is computed; `memory` is that of the group. Where bonds take the
    /// place of the contact's own laws, the blocks become what these laws see.
    fn prepare(&mut self, blocks: &mut [GatheredBlock<R>], memory: &mut [F64x8]);

    /// The response for block `index` of the batch.
    fn source(&self, index: usize) -> Self::Source<'_>;

    /// Gathers the quantities of the particles of `block`, number `index` of the batch, where laws read any.
    fn gather_quantities(
        &mut self,
        index: usize,
        group: &ContactGroup,
        columns: &[NamedColumn],
        block: usize,
    );

    /// The constants of the bodies of block `index` of the batch.
    fn pair(&self, index: usize, block: &GatheredBlock<R>) -> Pair<R>;

    /// How far apart the bodies of block `index` are, whose laws see the motion `seen`.
    fn distance(&self, index: usize, seen: &ContactKinematics<R>) -> Distance<R>;

    /// Adds what block `index` has beside the contact's own laws to their answer.
    fn complete(&self, index: usize, answer: &mut ContactResponse<R>);

    /// Whether the largest k/m_r is monitored.
    fn monitors_rate(&self) -> bool;
}

impl<R: Simd8, N: NormalLaw> NormalCall<R> for Inlined<N> {
    type Source<'a> = Self;

    #[inline(always)]
    fn prepare(&mut self, _blocks: &mut [GatheredBlock<R>], _memory: &mut [F64x8]) {}

    #[inline(always)]
    fn source(&self, _index: usize) -> Self {
        *self
    }

    /// Nothing: laws of common contacts read none.
    #[inline(always)]
    fn gather_quantities(&mut self, _: usize, _: &ContactGroup, _: &[NamedColumn], _: usize) {}

    #[inline(always)]
    fn pair(&self, _index: usize, block: &GatheredBlock<R>) -> Pair<R> {
        block.pair()
    }

    #[inline(always)]
    fn distance(&self, _index: usize, seen: &ContactKinematics<R>) -> Distance<R> {
        Distance::of(seen)
    }

    #[inline(always)]
    fn complete(&self, _index: usize, _answer: &mut ContactResponse<R>) {}

    #[inline(always)]
    fn monitors_rate(&self) -> bool {
        !N::STIFFNESS_IS_BOUNDED
    }
}

/// Which parts of a law's response a loop uses, beside force, friction reference and dashpot. The compiler moves
/// the computation of the other parts into branches that are not taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wants {
    /// Stored energy.
    pub(super) energy: bool,
    /// Dissipated energy.
    pub(super) losses: bool,
    /// Hardening, and the overlap scale.
    pub(super) hardening: bool,
    /// Elastic stiffness.
    pub(super) stiffness: bool,
    /// Radius of the contact area, and the force that pulls the bodies apart.
    pub(super) radius: bool,
    /// Whether the largest k/m_r is monitored.
    pub(super) rate: bool,
}

/// Length of the step [s], and temperature in its middle [K].
#[derive(Clone, Copy, Debug)]
pub(super) struct StepMiddle {
    pub(super) time_step: f64,
    pub(super) temperature: f64,
}

/// A normal law that is called through a pointer once per batch, for contacts that may be `CURVED`.
pub(super) struct Pointed<'a, R: Simd8, const CURVED: bool> {
    law: &'a Normal,
    pointer: Pointer<NormalTask, R>,
    answers: [NormalResponse<R>; BATCH],
    columns: usize,
    advance: StepMiddle,
    wants: Wants,
    bonds: Option<BondCall<R>>,
    quantities: [Quantities<R>; BATCH],
}

impl<'a, R: Simd8, const CURVED: bool> Pointed<'a, R, CURVED> {
    /// Calls of the normal law and of the bond of a model, with the memory where `slots` says.
    #[inline(always)]
    pub(super) fn new(
        model: &'a ContactModel,
        slots: &MemorySlots,
        advance: StepMiddle,
        wants: Wants,
    ) -> Self {
        let law = &model.normal;
        let pointer = law.accept(PointerOf::<R>(PhantomData));
        // No closure: these are not inlined by force.
        let mut bonds = None;
        if let Some(bond) = model.laws.bond {
            bonds = Some(BondCall::new(bond, *slots, advance));
        }
        let (answers, columns) = ([NormalResponse::none(); BATCH], slots.columns());
        let quantities = [Quantities::default(); BATCH];
        Self { law, pointer, answers, columns, advance, wants, bonds, quantities }
    }
}

impl<R: Simd8, const CURVED: bool> NormalCall<R> for Pointed<'_, R, CURVED> {
    type Source<'a>
        = Computed<'a, R, CURVED>
    where
        Self: 'a;

    #[inline(always)]
    fn prepare(&mut self, blocks: &mut [GatheredBlock<R>], memory: &mut [F64x8]) {
        if let Some(bonds) = &mut self.bonds {
            bonds.prepare(blocks, memory);
        }
        let Self { law, pointer, answers, columns, advance, wants, quantities, .. } = self;
        let (columns, advance, wants) = (*columns, *advance, *wants);
        pointer.call(&mut NormalBatch { law, blocks, quantities, answers, memory, columns, advance, wants });
    }

    #[inline(always)]
    fn gather_quantities(
        &mut self,
        index: usize,
        group: &ContactGroup,
        columns: &[NamedColumn],
        block: usize,
    ) {
        let quantities = quantities_of(group, columns, block);
        let gathered = &mut self.quantities[index];
        for (into, from) in
            [(&mut gathered.normal, &quantities.normal), (&mut gathered.attraction, &quantities.attraction)]
        {
            for (into, from) in into.iter_mut().zip(from) {
                (into[0], into[1]) = (R::load(&from[0]), R::load(&from[1]));
            }
        }
    }

    #[inline(always)]
    fn pair(&self, index: usize, block: &GatheredBlock<R>) -> Pair<R> {
        block.pair().with_quantities(self.quantities[index])
    }

    #[inline(always)]
    fn source(&self, index: usize) -> Computed<'_, R, CURVED> {
        Computed(&self.answers[index])
    }

    #[inline(always)]
    fn distance(&self, index: usize, seen: &ContactKinematics<R>) -> Distance<R> {
        match &self.bonds {
            Some(bonds) => bonds.distance(index),
            None => Distance::of(seen),
        }
    }

    #[inline(always)]
    fn complete(&self, index: usize, answer: &mut ContactResponse<R>) {
        if let Some(bonds) = &self.bonds {
            bonds.add_to(index, answer);
        }
    }

    #[inline(always)]
    fn monitors_rate(&self) -> bool {
        self.wants.rate
    }
}

/// The inputs and outputs of a law's routine.
pub(super) struct NormalBatch<'a, R: Simd8> {
    law: &'a Normal,
    blocks: &'a [GatheredBlock<R>],
    quantities: &'a [Quantities<R>; BATCH],
    answers: &'a mut [NormalResponse<R>; BATCH],
    memory: &'a mut [F64x8],
    columns: usize,
    advance: StepMiddle,
    wants: Wants,
}

/// Computes the responses of a normal law for a batch of blocks.
pub(super) struct NormalTask;

impl Task for NormalTask {
    type Data<'a, R: Simd8> = NormalBatch<'a, R>;
}

/// The routine of one law.
struct RoutineOf<N>(PhantomData<N>);

impl<N: NormalLaw> Routine<NormalTask> for RoutineOf<N> {
    #[inline(always)]
    fn call<R: Simd8>(data: &mut NormalBatch<'_, R>) {
        let Some(law) = N::of(data.law) else { return };
        // By value: otherwise the compiler reads them again after every store.
        let (law, wants, StepMiddle { time_step, temperature }) = (*law, data.wants, data.advance);
        let places = data.quantities.iter().zip(&mut *data.answers);
        for (block, (quantities, slot)) in data.blocks.iter().zip(places) {
            let pair = block.pair().with_quantities(*quantities);
            let motion = NormalMotion::new(&pair, &block.motion, time_step, temperature);
            // SAFETY: every gathered block has its memory.
            let mut columns = unsafe { BlockColumns::of(data.memory, block.block, data.columns) };
            let answer = answer(&law, &motion, &mut columns);
            slot.force = answer.force;
            slot.applied_force = answer.applied_force;
            slot.in_contact = answer.in_contact;
            slot.was_in_contact = answer.was_in_contact;
            slot.friction_reference = answer.friction_reference;
            slot.dashpot = answer.dashpot;
            if wants.energy {
                slot.stored_energy = answer.stored_energy;
                slot.adhesive_potential = answer.adhesive_potential;
            }
            if wants.losses {
                slot.dissipated_plastic = answer.dissipated_plastic;
                slot.dissipated_adhesive = answer.dissipated_adhesive;
                slot.dissipated_thermal = answer.dissipated_thermal;
            }
            if wants.hardening {
                slot.hardening = answer.hardening;
                slot.inverse_overlap_scale = answer.inverse_overlap_scale;
            }
            if wants.stiffness {
                slot.stiffness = answer.stiffness;
            }
            if wants.radius {
                slot.contact_radius = answer.contact_radius;
                slot.pull_off_force = answer.pull_off_force;
            }
        }
    }
}

/// The pointer to the routine of a law.
struct PointerOf<R>(PhantomData<R>);

impl<R: Simd8> NormalLawVisitor for PointerOf<R> {
    type Output = Pointer<NormalTask, R>;

    #[inline(always)]
    fn visit<N: NormalLaw>(self, _law: &N) -> Pointer<NormalTask, R> {
        R::pointer::<NormalTask, RoutineOf<N>>()
    }
}
