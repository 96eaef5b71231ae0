//! The name of what rules a contact.

use pulvis_contact::{ContactModel, Pair};

/// The branch of the normal law at an overlap [m], or that of the attraction where the bodies are apart and the normal
/// law does not act; "bonded" where the contact's own laws leave them to a bond, or only that acts. The bodies have these
/// `radii` [m], zero for a wall; the memory stands in `columns`, laid out as the contact says.
pub(crate) fn ruling_branch(
    contact: &ContactModel,
    pair: &Pair,
    radii: [f64; 2],
    overlap: f64,
    columns: &[f64],
) -> &'static str {
    let slots = *contact.memory_layout().slots();
    let bond = contact.laws.bond.as_ref();
    let bonded = bond.map(|bond| (bond.branch(radii, overlap, columns, slots.bond()), bond.hides_contact()));
    let normal = contact.normal.branch(pair, overlap, columns);
    if let Some(((1.., name), alone)) = bonded
        && (alone || (overlap <= 0.0 && normal.0 == 0))
    {
        return name;
    }
    if overlap > 0.0 || normal.0 != 0 {
        return normal.1;
    }
    contact.laws.noncontact.branch(pair, overlap, columns, slots.attraction()).1
}
