//! One contact at rest at one overlap after the other, as in an indenter.

use pulvis_contact::catalogue::Values;
use pulvis_contact::{Memory, Normal, NormalLaw, NormalMotion, NormalResponse, Pair};
use pulvis_math::Real;

/// A normal law by its name, taken out of the catalogue.
pub fn built<N: NormalLaw>(name: &str, values: &Values) -> N {
    *N::of(&Normal::build(name, values).unwrap().unwrap()).unwrap()
}

/// Why a normal law is not to be had with these values.
pub fn refused(name: &str, values: &Values) -> String {
    Normal::build(name, values).unwrap().unwrap_err().to_string()
}

/// Panics unless `found` is the `printed` number, which has so many digits.
pub fn assert_printed(found: f64, printed: f64, digits: i32) {
    let allowed = 0.51 * pulvis_math::elementary::powi(10.0, 1 - digits);
    assert!((found / printed - 1.0).abs() < allowed, "{found}, printed {printed}");
}

/// The answer of a law, compiled once for each law. Laws are inlined wherever they are asked, which is right for loops;
/// here it would be most of what there is to compile.
#[inline(never)]
pub(crate) fn ask<R: Real, N: NormalLaw>(
    law: &N,
    motion: &NormalMotion<R>,
    memory: &mut N::Memory<R>,
) -> NormalResponse<R> {
    law.respond(motion, memory)
}

/// A contact and what it has lost.
#[derive(Clone, Debug)]
pub struct Loading<N: NormalLaw> {
    /// Its law.
    pub law: N,
    /// Its bodies.
    pub pair: Pair,
    /// What it remembers.
    pub memory: N::Memory<f64>,
    /// Energy that it has lost so far [J].
    pub lost: f64,
}

impl<N: NormalLaw> Loading<N> {
    /// A contact without a past.
    pub fn new(law: N, pair: Pair) -> Self {
        Self { law, pair, memory: Default::default(), lost: 0.0 }
    }

    /// Goes to an overlap [m] in one step.
    pub fn go(&mut self, overlap: f64) -> NormalResponse {
        let answer = ask(&self.law, &NormalMotion::at_rest(&self.pair, overlap), &mut self.memory);
        self.lost += answer.dissipated_plastic + answer.dissipated_adhesive + answer.dissipated_thermal;
        answer
    }

    /// The work done until this answer, as the books say [J].
    pub fn work(&self, answer: &NormalResponse) -> f64 {
        self.lost + answer.stored_energy + answer.adhesive_potential
    }

    /// The columns of the memory.
    pub fn columns(&self) -> Vec<f64> {
        let mut columns = vec![0.0; <N::Memory<f64> as Memory<f64>>::COLUMNS];
        self.memory.store(|index, value| columns[index] = value);
        columns
    }
}
