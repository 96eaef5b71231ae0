//! What every normal law promises (see `pulvis_contact::normal::NormalLaw`).

use pulvis_contact::{Memory, Normal, NormalLaw, NormalLawVisitor, NormalResponse, Pair};

use crate::draw::Draw;
use crate::for_each_case;
use crate::parameters::{random_law, random_pair};

mod energy;
mod history;
mod lanes;
mod shape;

/// Checks every normal law of the catalogue with `count` random sets of parameters.
pub fn check_all(count: u64) {
    for entry in Normal::ENTRIES {
        for_each_case(entry.name, count, |draw| {
            random_law(entry, draw, Normal::build).accept(Suite { draw });
        });
    }
}

struct Suite<'a> {
    draw: &'a mut Draw,
}

impl NormalLawVisitor for Suite<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let draw = self.draw;
        let bench = Bench::new(law, draw);
        history::an_open_contact_is_forceless_and_forgets(&bench, draw);
        history::only_the_end_of_a_monotone_step_matters(&bench, draw);
        shape::the_force_is_continuous_and_no_steeper_than_stiffest(&bench, draw);
        shape::a_branch_has_one_name_and_no_kink(&bench, draw);
        energy::work_is_stored_or_dissipated(&bench, draw);
        lanes::lanes_give_the_bits_of_the_plain_number(law, draw);
    }
}

/// One law at one pair of bodies.
struct Bench<N: NormalLaw> {
    law: N,
    pair: Pair,
    /// The largest overlap of the tests [m].
    span: f64,
    /// Stiffness [N/m] times the largest overlap: what forces are measured against [N].
    force: f64,
}

impl<N: NormalLaw> Bench<N> {
    fn new(law: N, draw: &mut Draw) -> Self {
        let pair = random_pair(draw);
        let mut virgin = <N::Memory<f64>>::default();
        let scale =
            law.respond(&pair, 1e-9 * pair.harmonic_radius(), &mut virgin).inverse_overlap_scale.recip();
        assert!(scale > 0.0 && scale.is_finite(), "{law:?}: the overlap scale is {scale}");
        // Around the law's own scale, where that is a possible overlap; smaller where not.
        let span = scale.min(0.3 * pair.harmonic_radius()) * draw.log_between(0.1, 3.0);
        let max_stiffness = law.max_stiffness(&pair);
        assert!(
            max_stiffness > 0.0 && max_stiffness.is_finite(),
            "{law:?}: the steepest slope is {max_stiffness}"
        );
        Self { law, pair, span, force: max_stiffness * span }
    }

    fn respond(&self, overlap: f64, memory: &mut N::Memory<f64>) -> NormalResponse {
        self.law.respond(&self.pair, overlap, memory)
    }

    /// A contact with a random past; and its overlap [m].
    fn with_a_past(&self, draw: &mut Draw) -> (N::Memory<f64>, f64) {
        let mut memory = <N::Memory<f64>>::default();
        let mut overlap = 0.0;
        let turns = 1 + (draw.unit() * 5.0) as usize;
        for _ in 0..turns {
            let target = self.span * draw.between(0.02, 1.0);
            // Some steps on the way, so that the past is one that an engine could have made.
            for step in 1..=7 {
                self.respond(overlap + (target - overlap) * f64::from(step) / 7.0, &mut memory);
            }
            overlap = target;
        }
        (memory, overlap)
    }
}

/// The columns of a memory.
fn columns<M: Memory<f64>>(memory: &M) -> Vec<f64> {
    let mut columns = vec![f64::NAN; M::COLUMNS];
    memory.store(|index, value| columns[index] = value);
    columns
}
