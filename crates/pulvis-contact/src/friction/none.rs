//! No resistance.

use crate::catalogue::{LawEntry, Role};

const fn described(role: Role) -> LawEntry {
    LawEntry {
        role,
        name: "none",
        summary: "no resistance",
        equations: "f = 0",
        source: "none needed",
        parameters: &[],
        particle_quantities: &[],
        memory: &[],
        closed_form: "the motion is not resisted",
        example: "law = \"none\"",
    }
}

static SLIDING: LawEntry = described(Role::Sliding);
static ROLLING: LawEntry = described(Role::Rolling);
static TORSION: LawEntry = described(Role::Torsion);

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    match role {
        Role::Sliding => Some(&SLIDING),
        Role::Rolling => Some(&ROLLING),
        Role::Torsion => Some(&TORSION),
        _ => None,
    }
}
