//! One sweep over the contacts, compiled for each instruction set that the engine chooses from.

use std::fmt;

use pulvis_contact::{ContactEnergies, ContactInputs, ContactModel, Pair, ROOM_TEMPERATURE, levels};
use pulvis_math::{F64Array, InstructionSet, Kernel, Real, Simd8};

use super::contacts::{Contacts, Store};
use super::stored::{Slots, Stored, load_motion, store_vector};

/// The step that springs are advanced by [s].
const TIME_STEP: f64 = 4e-6;

/// What the code is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Build {
    /// One contact at a time, with what every processor of the family has.
    Scalar,
    /// Eight at a time.
    Eight(InstructionSet),
}

impl Build {
    /// Everything that this processor can run.
    pub(super) fn available() -> Vec<Self> {
        let sets = InstructionSet::available().into_iter().map(Self::Eight);
        std::iter::once(Self::Scalar).chain(sets).collect()
    }
}

impl fmt::Display for Build {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scalar => out.write_str("scalar"),
            Self::Eight(set) => write!(out, "{set} x 8"),
        }
    }
}

/// The sweeps to be done over contacts that are kept in columns of `S`.
pub(super) struct Sweep<'a, S> {
    pub(super) model: ContactModel,
    pub(super) contacts: &'a Contacts<S>,
    pub(super) store: &'a mut Store<S>,
    pub(super) sweeps: usize,
    /// Whether losses are summed up.
    pub(super) ledger: bool,
}

impl Sweep<'_, f64> {
    /// Sweeps over one contact at a time.
    #[inline(never)]
    pub(super) fn one_at_a_time(self) {
        self.with::<f64>();
    }
}

impl Kernel for Sweep<'_, F64Array<8>> {
    type Output = ();
    #[inline(always)]
    fn run<R: Simd8>(self) {
        self.with::<R>();
    }
}

impl<S> Sweep<'_, S> {
    /// All laws in one text, chosen while it runs: the engine's loops for common contacts are faster by that choice.
    /// Forces are stored and losses summed, as in all steps but the last of an advance, or else the compiler would
    /// leave them out.
    #[inline(always)]
    fn with<R: Real>(self)
    where
        S: Stored<R>,
    {
        let Self { model, contacts, store, sweeps, ledger } = self;
        let slots = *model.memory_layout().slots();
        let columns = slots.columns();
        let mut energies = ContactEnergies::<R>::default();
        let with_memory = model.laws.remembers_normal_motion(&slots);
        for turn in 0..sweeps {
            let motions = &contacts.motions[turn % 2];
            for (group, stored) in motions.iter().enumerate() {
                let [inverse_mass_i, inverse_mass_j, inverse_radius_i, inverse_radius_j] =
                    &contacts.inverses[group];
                let inverse_masses: R = inverse_mass_i.load() + inverse_mass_j.load();
                let inverse_radii: R = inverse_radius_i.load() + inverse_radius_j.load();
                let pair = Pair::from_sums(inverse_masses, inverse_radii);
                let motion = load_motion::<R, S>(stored);
                let mut memory = Slots(&mut store.memory[group * columns..(group + 1) * columns]);
                let inputs = ContactInputs {
                    pair: &pair,
                    motion: &motion,
                    time_step: TIME_STEP,
                    temperature: ROOM_TEMPERATURE,
                };
                let answer = model.laws.respond::<R, _, _, { levels::ALL }>(
                    &model.normal,
                    &slots,
                    inputs,
                    &mut memory,
                );
                let [force, torque_i, torque_j] = &mut store.forces_and_torques[group];
                store_vector(force, answer.force);
                store_vector(torque_i, answer.torque_i);
                store_vector(torque_j, answer.torque_j);
                if ledger {
                    energies.add_dissipated::<{ levels::ALL }>(&answer.energies, with_memory, true);
                }
            }
        }
        store.energies += energies.sum_lanes();
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::kernels::{cases::cases, on_a_deep_stack};

    const COUNT: usize = 64;

    /// Force and torque of every contact after some sweeps, as bits.
    fn bits<S: Real>(store: &Store<S>) -> Vec<u64> {
        let contact = |contact: usize| {
            let forces_and_torques = store.forces_and_torques[contact / S::LANES];
            forces_and_torques.into_iter().flat_map(move |vector| vector.lane(contact % S::LANES).to_array())
        };
        (0..COUNT).flat_map(contact).map(f64::to_bits).collect()
    }

    fn swept<S: Real>(model: ContactModel, run: impl Fn(Sweep<'_, S>)) -> Vec<u64> {
        let contacts = Contacts::<S>::new();
        assert_eq!(contacts.count(), COUNT);
        let mut store = Store::new(&contacts, &model);
        run(Sweep { model, contacts: &contacts, store: &mut store, sweeps: 5, ledger: true });
        bits(&store)
    }

    fn by_every_build(model: ContactModel) -> impl Iterator<Item = Vec<u64>> {
        let run = move |build| match build {
            Build::Scalar => swept(model, |sweep| sweep.one_at_a_time()),
            Build::Eight(set) => swept(model, |sweep| set.run(sweep)),
        };
        Build::available().into_iter().map(run)
    }

    #[test]
    fn every_build_computes_the_same_forces_and_torques() {
        for case in cases().unwrap() {
            let answers: Vec<_> = on_a_deep_stack(|| by_every_build(case.model).collect()).unwrap();
            let (scalar, eights) = answers.split_first().unwrap();
            assert!(scalar.iter().any(|&bits| bits != 0), "{}", case.name);
            assert!(eights.iter().all(|eight| eight == scalar), "{}", case.name);
        }
    }
}
