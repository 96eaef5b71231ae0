//! What every normal law promises (see `pulvis_contact::normal::NormalLaw`).

use pulvis_contact::{
    ExpectedLoading, Memory, Normal, NormalLaw, NormalLawVisitor, NormalMotion, NormalResponse, Pair,
};
use pulvis_math::{Mask, Real};

use crate::draw::Draw;
use crate::for_each_case;
use crate::loading::ask;
use crate::parameters::{loaded_to, random_law, random_pair, with_random_quantities};

mod collision;
mod energy;
mod history;
mod lanes;
mod paths;
mod shape;

use collision::{Collisions, a_collision_at_the_automatic_step_keeps_its_energy};

/// Checks every normal law of the catalogue with `count` random sets of parameters.
pub fn check_all(count: u64) {
    for entry in Normal::ENTRIES {
        let mut collisions = Collisions::default();
        for_each_case(entry.name, count, |draw| {
            let law = random_law(entry, draw, Normal::build);
            law.accept(Suite { draw });
            a_collision_at_the_automatic_step_keeps_its_energy(&law, draw, &mut collisions);
        });
        collisions.are_nearly_always_right(entry.name);
    }
}

struct Suite<'a> {
    draw: &'a mut Draw,
}

impl NormalLawVisitor for Suite<'_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: &N) {
        let draw = self.draw;
        let bench = Bench::new(*law, draw);
        history::out_of_range_a_contact_is_forceless_and_forgets(&bench, draw);
        history::only_the_end_of_a_monotone_step_matters(&bench, draw);
        history::an_answer_agrees_with_itself(&bench, draw);
        shape::the_force_is_continuous_and_no_steeper_than_max_stiffness(&bench, draw);
        shape::a_branch_has_one_name_and_no_kink(&bench, draw);
        energy::work_is_stored_or_dissipated(&bench, draw);
        paths::no_path_creates_energy(&bench, draw);
        lanes::lanes_give_the_bits_of_the_plain_number(*law, draw);
    }
}

/// One law at one pair of bodies.
struct Bench<N: NormalLaw> {
    law: N,
    pair: Pair,
    /// How far beyond touching the law acts [m].
    range: f64,
    /// The largest overlap of the tests [m].
    span: f64,
    /// The loading up to 1.3 times the largest overlap.
    loading: ExpectedLoading,
    /// Steepest slope of the force up to 1.3 times the largest overlap [N/m].
    max_stiffness: f64,
    /// Stiffness times the length of all paths, and what acts at touch: what forces are measured against [N].
    force: f64,
}

impl<N: NormalLaw> Bench<N> {
    fn new(law: N, draw: &mut Draw) -> Self {
        let pair = with_random_quantities(random_pair(draw), &N::ENTRY, None, draw);
        let mut virgin = <N::Memory<f64>>::default();
        let touch = NormalMotion::at_rest(&pair, 1e-9 * pair.harmonic_radius());
        let touches = ask(&law, &touch, &mut virgin);
        let scale = touches.inverse_overlap_scale.recip();
        assert!(scale > 0.0 && scale.is_finite(), "{law:?}: the overlap scale is {scale}");
        let range = law.interaction_range(&pair);
        assert!(range >= 0.0 && range.is_finite(), "{law:?}: acts at a distance of {range} m");
        // Laws with a scale of their own are looked at there as often as near the end of their range.
        let own_scale = scale < 0.99 * pair.harmonic_radius();
        let span = if range > 0.0 && !(own_scale && draw.chance(0.5)) {
            // Deep enough to leave the attraction behind, not so deep that it is lost in a step.
            range * draw.log_between(0.3, 30.0)
        } else {
            // Around the law's own scale, where that is a possible overlap; smaller where not.
            scale.min(0.3 * pair.harmonic_radius()) * draw.log_between(0.1, 3.0)
        };
        let loading = loaded_to(1.3 * span, &pair);
        let max_stiffness = law.max_stiffness(&pair, &loading);
        assert!(
            max_stiffness > 0.0 && max_stiffness.is_finite(),
            "{law:?}: the steepest slope is {max_stiffness}"
        );
        let force = max_stiffness * (span + range) + touches.force.abs();
        Self { law, pair, range, span, loading, max_stiffness, force }
    }

    fn respond(&self, overlap: f64, memory: &mut N::Memory<f64>) -> NormalResponse {
        ask(&self.law, &NormalMotion::at_rest(&self.pair, overlap), memory)
    }

    /// An overlap at which the law may act [m].
    fn random_overlap(&self, draw: &mut Draw) -> f64 {
        draw.between(-0.98 * self.range, self.span)
    }

    /// A contact with a random past; and its overlap [m].
    fn with_a_past(&self, draw: &mut Draw) -> (N::Memory<f64>, f64) {
        let mut memory = <N::Memory<f64>>::default();
        let mut overlap = 0.0;
        let turns = 1 + (draw.unit() * 5.0) as usize;
        for turn in 0..turns {
            let target =
                if turn == 0 { self.span * draw.between(0.02, 1.0) } else { self.random_overlap(draw) };
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

/// The bits of all that a law answers.
fn bits<R: Real>(answer: &NormalResponse<R>, lane: usize) -> Vec<u64> {
    let numbers = [
        answer.force,
        answer.applied_force,
        answer.friction_reference,
        answer.contact_radius,
        answer.stiffness,
        answer.dashpot,
        answer.hardening,
        answer.inverse_overlap_scale,
        answer.stored_energy,
        answer.adhesive_potential,
        answer.dissipated_plastic,
        answer.dissipated_adhesive,
        answer.dissipated_thermal,
    ];
    let masks = [answer.in_contact, answer.was_in_contact].map(|mask| u64::from(mask.lane(lane)));
    numbers.iter().map(|number| number.lane(lane).to_bits()).chain(masks).collect()
}
