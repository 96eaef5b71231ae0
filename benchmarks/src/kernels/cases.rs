//! The models that are measured: every law of the catalogue, with the parameters of its example.

use pulvis_contact::catalogue::{LawEntry, Role};
use pulvis_contact::{ContactModel, NonContact, Normal, Viscosity, friction};

use crate::failure::Failure;
use crate::models::read;

/// A named model.
pub(super) struct Case {
    pub(super) name: String,
    pub(super) model: ContactModel,
}

/// Every normal law alone, with sliding, and with sliding, rolling and torsion; every dashpot and every
/// attraction on a linear spring.
pub(super) fn cases() -> Result<Vec<Case>, Failure> {
    let sliding = resistance(Role::Sliding);
    let all = sliding.clone() + &resistance(Role::Rolling) + &resistance(Role::Torsion);
    let mut cases = Vec::new();
    let mut add = |name: String, text: String| -> Result<(), Failure> {
        cases.push(Case { name, model: read(&text)? });
        Ok(())
    };
    for law in Normal::ENTRIES {
        let normal = table(Role::Normal, law);
        add(law.name.to_owned(), normal.clone())?;
        add(format!("{} + sliding", law.name), normal.clone() + &sliding)?;
        add(format!("{} + sliding + rolling + torsion", law.name), normal + &all)?;
    }
    let spring = "[normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n";
    for (role, entries) in [(Role::Viscosity, Viscosity::ENTRIES), (Role::NonContact, NonContact::ENTRIES)] {
        for law in entries.iter().filter(|law| law.name != "none") {
            add(format!("linear + {} {}", role.key(), law.name), format!("{spring}{}", table(role, law)))?;
        }
    }
    Ok(cases)
}

/// The law's example as a table of a contact.
fn table(role: Role, law: &LawEntry) -> String {
    format!("[{}]\n{}\n", role.key(), law.example)
}

/// The first law in a role that resists.
fn resistance(role: Role) -> String {
    let law = friction::entries(role).into_iter().find(|law| law.name != "none");
    law.map_or(String::new(), |law| table(role, law))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn every_law_of_the_catalogue_is_measured() {
        let names: Vec<_> = cases().unwrap().into_iter().map(|case| case.name).collect();
        for law in Normal::ENTRIES {
            for resistance in ["", " + sliding", " + sliding + rolling + torsion"] {
                let name = format!("{}{resistance}", law.name);
                assert!(names.contains(&name), "{name}: {names:?}");
            }
        }
        for (role, entries) in
            [(Role::Viscosity, Viscosity::ENTRIES), (Role::NonContact, NonContact::ENTRIES)]
        {
            for law in entries.iter().filter(|law| law.name != "none") {
                let name = format!("linear + {} {}", role.key(), law.name);
                assert!(names.contains(&name), "{name}: {names:?}");
            }
        }
    }
}
