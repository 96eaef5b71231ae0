//! What a contact remembers and what it does not.

use pulvis_contact::{Memory, NormalLaw, NormalMotion};

use super::{Bench, bits, columns};
use crate::draw::Draw;
use crate::loading::ask;

pub(super) fn out_of_range_a_contact_is_forceless_and_forgets<N: NormalLaw>(
    bench: &Bench<N>,
    draw: &mut Draw,
) {
    let (mut memory, _) = bench.with_a_past(draw);
    let apart = bench.respond(-bench.range * (1.0 + 1e-12), &mut memory);
    let law = bench.law;
    assert_eq!((apart.force, apart.applied_force), (0.0, 0.0), "{law:?}");
    assert_eq!((apart.stored_energy, apart.adhesive_potential), (0.0, 0.0), "{law:?}");
    assert_eq!(apart.friction_reference, 0.0, "{law:?}");
    assert!(!apart.in_contact, "{law:?}");
    let virgin = <N::Memory<f64>>::default();
    assert_eq!(columns(&memory), columns(&virgin), "{law:?} remembers a contact out of its range");
    let reloaded = <N::Memory<f64>>::load(|index| columns(&memory)[index]);
    assert_eq!(columns(&reloaded), columns(&memory), "{law:?}: load and store are inverse");
    let overlap = bench.random_overlap(draw);
    let (mut first, mut second) = (virgin, memory);
    let answers = [bench.respond(overlap, &mut first), bench.respond(overlap, &mut second)];
    assert_eq!(bits(&answers[0], 0), bits(&answers[1], 0), "{law:?}");
}

pub(super) fn only_the_end_of_a_monotone_step_matters<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    if !N::PATH_ONLY {
        return;
    }
    let (memory, start) = bench.with_a_past(draw);
    let target =
        if draw.chance(0.7) { bench.span * draw.between(0.001, 1.0) } else { bench.random_overlap(draw) };
    let mut once = memory;
    let whole = bench.respond(target, &mut once);
    let mut often = memory;
    let steps = 2 + (draw.unit() * 60.0) as u32;
    let (mut plastic, mut adhesive) = (0.0, 0.0);
    let mut part = whole;
    for step in 1..=steps {
        let overlap = start + (target - start) * f64::from(step) / f64::from(steps);
        part = bench.respond(if step == steps { target } else { overlap }, &mut often);
        plastic += part.dissipated_plastic;
        adhesive += part.dissipated_adhesive;
    }
    // Round-off only, gathered over up to sixty steps.
    let force = 1e-11 * bench.force;
    let energy = force * (bench.span + bench.range);
    let close = |one: f64, other: f64, tolerance: f64, what: &str| {
        assert!((one - other).abs() <= tolerance, "{:?}: {what} {one} and in steps {other}", bench.law);
    };
    close(whole.force, part.force, force, "force");
    close(whole.friction_reference, part.friction_reference, force, "friction reference");
    close(whole.stored_energy, part.stored_energy, energy, "stored energy");
    close(whole.adhesive_potential, part.adhesive_potential, energy, "adhesive potential");
    close(whole.dissipated_plastic, plastic, energy, "plastic loss");
    close(whole.dissipated_adhesive, adhesive, energy, "adhesive loss");
    close(whole.hardening, part.hardening, 1e-10, "hardening");
    let before = columns(&memory);
    for (index, (one, other)) in columns(&once).into_iter().zip(columns(&often)).enumerate() {
        close(one, other, 1e-11 * one.abs().max(other.abs()).max(before[index].abs()), "memory");
    }
}

/// Steps to and fro, as an engine makes them: what the parts of an answer say about each other.
pub(super) fn an_answer_agrees_with_itself<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let law = bench.law;
    let mut memory = <N::Memory<f64>>::default();
    let mut overlap = -1.2 * bench.range;
    let (mut acted, mut sure) = (false, bench.range > 0.0);
    let mut branch_before = law.branch(&bench.pair, overlap, &memory).0;
    for _ in 0..40 {
        let next = draw.between(-1.2 * bench.range - 0.1 * bench.span, bench.span);
        let motion = NormalMotion {
            growth: next - overlap,
            closing_rate: draw.between(-1.0, 1.0),
            time_step: 1e-6,
            ..NormalMotion::at_rest(&bench.pair, next)
        };
        let answer = ask(&law, &motion, &mut memory);
        let state = format!("{law:?}: {answer:?} at {next} m");
        if sure && answer.in_contact {
            assert_eq!(answer.was_in_contact, acted, "{state}, from {overlap} m");
        }
        let branch = law.branch(&bench.pair, next, &memory).0;
        if law.is_passive() && (!N::JUMPS || (answer.in_contact == acted && branch == branch_before)) {
            assert_eq!(answer.applied_force, answer.force, "{state}: nothing jumps here");
        }
        assert!(answer.friction_reference >= 0.0, "{state}");
        assert!(answer.contact_radius >= 0.0 && answer.stiffness >= 0.0, "{state}");
        assert!(answer.stored_energy >= 0.0, "{state}");
        assert!((0.0..=1.0 + 1e-12).contains(&answer.hardening), "{state}");
        let (least, most) = (0.0, law.dashpot(&bench.pair, &bench.loading) * (1.0 + 1e-12));
        assert!((least..=most).contains(&answer.dashpot), "{state}: at most {most} kg/s");
        let most = bench.max_stiffness * (1.0 + 1e-9);
        assert!(!answer.in_contact || answer.stiffness <= most, "{state}: at most {most} N/m");
        if !answer.in_contact {
            assert_eq!((answer.stored_energy, answer.friction_reference), (0.0, 0.0), "{state}");
        }
        if branch == 0 {
            assert_eq!((answer.force, answer.adhesive_potential), (0.0, 0.0), "{state}");
        }
        branch_before = branch;
        // Whether a contact was closed before is taken from its growth: not to be told at the very edge.
        sure = next.abs() > 1e-6 * bench.span;
        (overlap, acted) = (next, answer.in_contact);
    }
}
