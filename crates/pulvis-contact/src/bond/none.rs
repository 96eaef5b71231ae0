//! No bond.

use crate::catalogue::{LawEntry, Role};

pub(super) static ENTRY: LawEntry = LawEntry {
    role: Role::Bond,
    name: "none",
    summary: "bodies are not bonded",
    equations: "f = 0",
    source: "none needed",
    parameters: &[],
    particle_quantities: &[],
    memory: &[],
    closed_form: "the contact is that of its other laws",
    example: "law = \"none\"",
};
