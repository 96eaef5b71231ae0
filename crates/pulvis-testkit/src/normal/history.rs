//! What a contact remembers and what it does not.

use pulvis_contact::{Memory, NormalLaw};

use super::{Bench, columns};
use crate::draw::Draw;

pub(super) fn an_open_contact_is_forceless_and_forgets<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let (mut memory, _) = bench.with_a_past(draw);
    let open = bench.respond(0.0, &mut memory);
    let law = bench.law;
    assert_eq!(open.force, 0.0, "{law:?}");
    assert_eq!(open.stored_energy, 0.0, "{law:?}");
    assert_eq!(open.friction_reference, 0.0, "{law:?}");
    let virgin = <N::Memory<f64>>::default();
    assert_eq!(columns(&memory), columns(&virgin), "{law:?} remembers an open contact");
    let reloaded = <N::Memory<f64>>::load(|index| columns(&memory)[index]);
    assert_eq!(columns(&reloaded), columns(&memory), "{law:?}: load and store are inverse");
    let overlap = bench.span * draw.unit();
    let (mut first, mut second) = (virgin, memory);
    assert_eq!(bench.respond(overlap, &mut first), bench.respond(overlap, &mut second), "{law:?}");
}

pub(super) fn only_the_end_of_a_monotone_step_matters<N: NormalLaw>(bench: &Bench<N>, draw: &mut Draw) {
    let (memory, start) = bench.with_a_past(draw);
    let target = bench.span * draw.between(0.001, 1.0);
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
    let energy = force * bench.span;
    let close = |one: f64, other: f64, tolerance: f64, what: &str| {
        assert!((one - other).abs() <= tolerance, "{:?}: {what} {one} and in steps {other}", bench.law);
    };
    close(whole.force, part.force, force, "force");
    close(whole.friction_reference, part.friction_reference, force, "friction reference");
    close(whole.stored_energy, part.stored_energy, energy, "stored energy");
    close(whole.dissipated_plastic, plastic, energy, "plastic loss");
    close(whole.dissipated_adhesive, adhesive, energy, "adhesive loss");
    close(whole.hardening, part.hardening, 1e-10, "hardening");
    for (one, other) in columns(&once).into_iter().zip(columns(&often)) {
        close(one, other, 1e-11 * one.abs().max(other.abs()), "memory");
    }
}
