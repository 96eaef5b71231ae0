//! One sweep over the contacts, compiled for each instruction set that the engine chooses from.

use pulvis_contact::{Composition, NormalLaw, resistance};
use pulvis_math::Real;

use super::contacts::{Contacts, Store};

/// What the code is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Build {
    /// One contact at a time.
    Scalar,
    /// Eight at a time, with what every processor of the family has (x86-64: SSE2).
    Baseline,
    /// Eight at a time, AVX2.
    Avx2,
    /// Eight at a time, AVX-512.
    Avx512,
}

/// The sweeps to be done.
#[derive(Clone, Copy)]
pub(super) struct Sweep<'a, R: Real, N> {
    pub(super) law: &'a N,
    pub(super) composition: &'a Composition,
    pub(super) contacts: &'a Contacts<R>,
    pub(super) ledger: bool,
}

impl Build {
    pub(super) const ALL: [Self; 4] = [Self::Scalar, Self::Baseline, Self::Avx2, Self::Avx512];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Baseline => "baseline x 8",
            Self::Avx2 => "avx2 x 8",
            Self::Avx512 => "avx512 x 8",
        }
    }

    /// Whether this machine can run it.
    pub(super) fn is_available(self) -> bool {
        match self {
            Self::Scalar | Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => has_avx512(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// Sweeps over all contacts; falls back to the baseline where the machine lacks the instructions.
    pub(super) fn execute<R: Real, N: NormalLaw>(
        self,
        sweep: Sweep<'_, R, N>,
        store: &mut Store<R, N>,
        sweeps: usize,
    ) {
        match (self, self.is_available()) {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `is_available` has found the instructions.
            (Self::Avx2, true) => unsafe { sweep_avx2(sweep, store, sweeps) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `is_available` has found the instructions.
            (Self::Avx512, true) => unsafe { sweep_avx512(sweep, store, sweeps) },
            _ => sweep_baseline(sweep, store, sweeps),
        }
    }
}

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512bw")
}

#[inline(never)]
fn sweep_baseline<R: Real, N: NormalLaw>(sweep: Sweep<'_, R, N>, store: &mut Store<R, N>, sweeps: usize) {
    sweep_with_options(sweep, store, sweeps);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn sweep_avx2<R: Real, N: NormalLaw>(sweep: Sweep<'_, R, N>, store: &mut Store<R, N>, sweeps: usize) {
    sweep_with_options(sweep, store, sweeps);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn sweep_avx512<R: Real, N: NormalLaw>(sweep: Sweep<'_, R, N>, store: &mut Store<R, N>, sweeps: usize) {
    sweep_with_options(sweep, store, sweeps);
}

#[inline(always)]
fn sweep_with_options<R: Real, N: NormalLaw>(sweep: Sweep<'_, R, N>, store: &mut Store<R, N>, sweeps: usize) {
    match (sweep.composition.resistance_level(), sweep.ledger) {
        (resistance::NONE, true) => sweep_contacts::<R, N, { resistance::NONE }, true>(sweep, store, sweeps),
        (resistance::NONE, false) => {
            sweep_contacts::<R, N, { resistance::NONE }, false>(sweep, store, sweeps)
        }
        (resistance::SLIDING, true) => {
            sweep_contacts::<R, N, { resistance::SLIDING }, true>(sweep, store, sweeps)
        }
        (resistance::SLIDING, false) => {
            sweep_contacts::<R, N, { resistance::SLIDING }, false>(sweep, store, sweeps)
        }
        (_, true) => sweep_contacts::<R, N, { resistance::ALL }, true>(sweep, store, sweeps),
        (_, false) => sweep_contacts::<R, N, { resistance::ALL }, false>(sweep, store, sweeps),
    }
}

/// The law's text as the engine calls it. Forces are stored and energies summed, or else the compiler
/// would leave them out.
#[inline(always)]
fn sweep_contacts<R: Real, N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool>(
    sweep: Sweep<'_, R, N>,
    store: &mut Store<R, N>,
    sweeps: usize,
) {
    let Sweep { law, composition, contacts, .. } = sweep;
    // By value, as the engine has it: not to be read anew after every store.
    let (law, composition) = (*law, *composition);
    let mut energies = store.energies;
    for turn in 0..sweeps {
        let motions = &contacts.motions[turn % 2];
        let each = motions.iter().zip(&contacts.pairs).zip(&mut store.memory).zip(&mut store.forces);
        for (((motion, pair), memory), forces) in each {
            let answer = composition.respond::<R, N, RESISTANCE>(&law, pair, motion, 4e-6, memory);
            *forces = [answer.force, answer.torque_i, answer.torque_j];
            if LEDGER {
                energies += answer.energies;
            }
        }
    }
    store.energies = energies;
}
