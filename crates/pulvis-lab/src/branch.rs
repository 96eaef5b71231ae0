//! The name of what rules a contact.

use pulvis_contact::{ContactModel, Pair};

/// The branch of the normal law at an overlap [m], or that of the attraction where the bodies are apart and the normal
/// law does not act. The memory stands in `columns`, laid out as the contact says.
pub(crate) fn ruling_branch(
    contact: &ContactModel,
    pair: &Pair,
    overlap: f64,
    columns: &[f64],
) -> &'static str {
    let normal = contact.normal.branch(pair, overlap, columns);
    if overlap > 0.0 || normal.0 != 0 {
        return normal.1;
    }
    let slots = *contact.memory_layout().slots();
    contact.laws.noncontact.branch(pair, overlap, columns, slots.attraction()).1
}
