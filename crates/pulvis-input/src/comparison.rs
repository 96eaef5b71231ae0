//! Contacts that are compared: `[contact]`, and one more for each `[[compare]]`.

use crate::contact::{NamedContact, read_contact, read_contact_beside};
use crate::context::{Location, Reported};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;

/// One of the contacts that a scenario compares.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledContact {
    /// What it is called in tables and pictures.
    pub label: String,
    /// The contact.
    pub contact: NamedContact,
}

/// Reads `[contact]` and all `[[compare]]`, which take the laws that they leave out from `[contact]`.
///
/// # Errors
/// Laws or parameters that are refused, or two contacts of the same label.
pub fn read_compared(root: &mut TableReader<'_>) -> Result<Vec<LabelledContact>, Reported> {
    let base = root.required_table("contact").and_then(|table| Draft::read(table, None));
    let variants = root.tables("compare");
    let (base, variants) = (base?, variants?);
    let mut drafts: Vec<_> =
        variants.into_iter().map(|table| Draft::read(table, Some(&base.contact))).collect();
    drafts.insert(0, Ok(base));
    let drafts = drafts.into_iter().collect::<Result<Vec<_>, _>>()?;
    for (number, draft) in drafts.iter().enumerate() {
        if drafts.iter().take(number).any(|earlier| earlier.label == draft.label) {
            let found = format!("two contacts are called `{}`", draft.label);
            let problem = Problem::rule(found, "a `label` of its own for each");
            return Err(root.refuse_at(&draft.location, problem));
        }
    }
    let finished = |draft: Draft| LabelledContact { label: draft.label, contact: draft.contact };
    Ok(drafts.into_iter().map(finished).collect())
}

/// A contact whose label may not be its own.
struct Draft {
    label: String,
    location: Location,
    contact: NamedContact,
}

impl Draft {
    fn read(mut table: TableReader<'_>, base: Option<&NamedContact>) -> Result<Self, Reported> {
        let location = table.location("label");
        let label = table.optional("label", Text);
        let given: Vec<String> = table.keys().into_iter().map(str::to_owned).collect();
        let contact = match base {
            Some(base) => read_contact_beside(table, base),
            None => read_contact(table, None),
        };
        let (label, contact) = (label?, contact?);
        Ok(Self { label: label.unwrap_or_else(|| names(&contact, &given)), location, contact })
    }
}

/// The names of the laws that stand in the tables `given`.
fn names(contact: &NamedContact, given: &[String]) -> String {
    let laws = contact.laws.iter().filter(|law| given.iter().any(|key| key == law.role.key()));
    laws.map(|law| law.name).collect::<Vec<_>>().join(" + ")
}
