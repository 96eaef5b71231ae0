//! The laws of the contact, read as the catalogue describes them.

use crate::context::Reported;
use crate::parameters::{read_parameters, refuse_parameter};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_contact::catalogue::{InvalidParameter, LawEntry, Role, Values};
use pulvis_contact::{Composition, ContactModel, NonContact, Normal, Viscosity};

/// A contact and the descriptions of its laws.
pub(super) struct ContactLaws {
    pub(super) model: ContactModel,
    pub(super) entries: Vec<&'static LawEntry>,
}

impl ContactLaws {
    /// The law that plays `role`, a key such as `normal`.
    pub(super) fn entry(&self, role: &str) -> Option<&'static LawEntry> {
        self.entries.iter().copied().find(|entry| entry.role.key() == role)
    }
}

/// Reads the laws along the line of centres; a head-on collision knows no other.
pub(super) fn read_contact(mut table: TableReader<'_>) -> Result<ContactLaws, Reported> {
    let normal = table
        .required_table(Role::Normal.key())
        .and_then(|table| read_law(table, Normal::ENTRIES, Normal::build));
    let noncontact = optional_law(&mut table, Role::NonContact, NonContact::ENTRIES, NonContact::build);
    let viscosity = optional_law(&mut table, Role::Viscosity, Viscosity::ENTRIES, Viscosity::build);
    table.finish();
    let (normal, entry) = normal?;
    let mut composition = Composition::default();
    let mut entries = vec![entry];
    if let Some((law, entry)) = noncontact? {
        composition.noncontact = law;
        entries.push(entry);
    }
    if let Some((law, entry)) = viscosity? {
        composition.viscosity = law;
        entries.push(entry);
    }
    Ok(ContactLaws { model: ContactModel { normal, composition }, entries })
}

type Build<L> = fn(&str, &Values) -> Option<Result<L, InvalidParameter>>;

fn optional_law<L>(
    table: &mut TableReader<'_>,
    role: Role,
    entries: &'static [LawEntry],
    build: Build<L>,
) -> Result<Option<(L, &'static LawEntry)>, Reported> {
    let law = table.optional_table(role.key())?;
    law.map(|law| read_law(law, entries, build)).transpose()
}

/// Reads `law` and the parameters of the law that it names.
fn read_law<L>(
    mut table: TableReader<'_>,
    entries: &'static [LawEntry],
    build: Build<L>,
) -> Result<(L, &'static LawEntry), Reported> {
    let names: Vec<&str> = entries.iter().map(|entry| entry.name).collect();
    let name = table.required("law", Name(&names))?;
    let unknown = |table: &TableReader<'_>| table.refuse("law", Problem::unknown_choice(name, &names));
    let Some(entry) = entries.iter().find(|entry| entry.name == name) else { return Err(unknown(&table)) };
    let values = read_parameters(&mut table, entry.parameters);
    let law = values.and_then(|values| match build(name, &values) {
        Some(Ok(law)) => Ok(law),
        Some(Err(error)) => Err(refuse_parameter(&table, error)),
        None => Err(unknown(&table)),
    });
    table.finish();
    Ok((law?, entry))
}
