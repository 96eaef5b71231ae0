//! One sweep over the contacts, compiled for each instruction set that the engine chooses from.

use std::fmt;

use pulvis_contact::{ContactEnergies, ContactLaws, NormalLaw, Pair, resistance};
use pulvis_math::{F64Array, InstructionSet, Kernel, Real, Simd8};

use super::contacts::{Contacts, Store};
use super::stored::{MemoryColumns, Stored, load_motion, store_vector};

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
pub(super) struct Sweep<'a, S, N, const RESISTANCE: u8, const LEDGER: bool> {
    pub(super) law: N,
    pub(super) laws: ContactLaws,
    pub(super) contacts: &'a Contacts<S>,
    pub(super) store: &'a mut Store<S>,
    pub(super) sweeps: usize,
}

impl<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Sweep<'_, f64, N, RESISTANCE, LEDGER> {
    /// Sweeps over one contact at a time.
    #[inline(never)]
    pub(super) fn one_at_a_time(self) {
        self.with::<f64>();
    }
}

impl<N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Kernel
    for Sweep<'_, F64Array<8>, N, RESISTANCE, LEDGER>
{
    type Output = ();
    #[inline(always)]
    fn run<R: Simd8>(self) {
        self.with::<R>();
    }
}

impl<S, N: NormalLaw, const RESISTANCE: u8, const LEDGER: bool> Sweep<'_, S, N, RESISTANCE, LEDGER> {
    /// The law's text as the engine calls it. Forces are stored and losses summed, as in all steps but the last
    /// of an advance, or else the compiler would leave them out.
    #[inline(always)]
    fn with<R: Real>(self)
    where
        S: Stored<R>,
    {
        let Self { law, laws, contacts, store, sweeps } = self;
        let places = MemoryColumns::<RESISTANCE>::of::<N>(&laws);
        let columns = places.count();
        let mut energies = ContactEnergies::<R>::default();
        let with_memory = laws.remembers_normal_motion::<N>();
        for turn in 0..sweeps {
            let motions = &contacts.motions[turn % 2];
            for (group, stored) in motions.iter().enumerate() {
                let [inverse_mass_i, inverse_mass_j, inverse_radius_i, inverse_radius_j] =
                    &contacts.inverses[group];
                let inverse_masses: R = inverse_mass_i.load() + inverse_mass_j.load();
                let inverse_radii: R = inverse_radius_i.load() + inverse_radius_j.load();
                let pair = Pair::from_sums(inverse_masses, inverse_radii);
                let motion = load_motion::<R, S>(stored);
                let slots = &mut store.memory[group * columns..(group + 1) * columns];
                let mut memory = places.load::<R, S, N::Memory<R>>(slots);
                let answer = laws.respond::<R, N, RESISTANCE>(&law, &pair, &motion, TIME_STEP, &mut memory);
                places.store(&memory, slots);
                let [force, torque_i, torque_j] = &mut store.forces_and_torques[group];
                store_vector(force, answer.force);
                if RESISTANCE != resistance::NONE {
                    store_vector(torque_i, answer.torque_i);
                    store_vector(torque_j, answer.torque_j);
                }
                if LEDGER {
                    energies.add_dissipated::<RESISTANCE>(&answer.energies, with_memory);
                }
            }
        }
        store.energies += energies.sum_lanes();
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_contact::NormalLawVisitor;

    use super::*;
    use crate::kernels::cases::cases;

    const COUNT: usize = 64;

    /// Force and torque of every contact after some sweeps, as bits.
    fn bits<S: Real>(store: &Store<S>) -> Vec<u64> {
        let contact = |contact: usize| {
            let forces_and_torques = store.forces_and_torques[contact / S::LANES];
            forces_and_torques.into_iter().flat_map(move |vector| vector.lane(contact % S::LANES).to_array())
        };
        (0..COUNT).flat_map(contact).map(f64::to_bits).collect()
    }

    struct EveryBuild(ContactLaws);

    impl NormalLawVisitor for EveryBuild {
        type Output = Vec<Vec<u64>>;
        fn visit<N: NormalLaw>(self, law: N) -> Vec<Vec<u64>> {
            fn swept<S: Real, N: NormalLaw>(
                (law, laws): (N, ContactLaws),
                run: impl Fn(Sweep<'_, S, N, { resistance::ALL }, true>),
            ) -> Vec<u64> {
                let contacts = Contacts::<S>::new();
                assert_eq!(contacts.count(), COUNT);
                let mut store = Store::new::<N, { resistance::ALL }>(&contacts, &laws);
                run(Sweep { law, laws, contacts: &contacts, store: &mut store, sweeps: 5 });
                bits(&store)
            }
            let model = (law, self.0);
            let run = |build| match build {
                Build::Scalar => swept(model, |sweep| sweep.one_at_a_time()),
                Build::Eight(set) => swept(model, |sweep| set.run(sweep)),
            };
            Build::available().into_iter().map(run).collect()
        }
    }

    #[test]
    fn every_build_computes_the_same_forces_and_torques() {
        for case in cases().unwrap() {
            let mut answers = case.model.normal.accept(EveryBuild(case.model.laws)).into_iter();
            let scalar = answers.next().unwrap();
            assert!(scalar.iter().any(|&bits| bits != 0), "{}", case.name);
            assert!(answers.all(|eight| eight == scalar), "{}", case.name);
        }
    }
}
