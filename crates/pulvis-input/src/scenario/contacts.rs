//! Contacts of material pairs, and whether every pair that can meet has one.

use super::materials::Material;
use crate::contact::{NamedContact, NamedLaw, read_contact};
use crate::context::Reported;
use crate::problem::Problem;
use crate::reader::TableReader;
use pulvis_contact::ContactModel;

/// All laws between two materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Indices of the materials, the smaller one first.
    pub materials: [usize; 2],
    /// The contact, ready to be computed.
    pub model: ContactModel,
    /// The laws that it was made from, one of each role.
    pub laws: Vec<NamedLaw>,
}

/// The materials that particles and walls are made of.
#[derive(Clone, Debug, Default)]
pub(super) struct MaterialUse {
    /// Materials of particles, without repetition.
    pub(super) particles: Vec<usize>,
    /// Materials of which there is one particle, which has nothing of its own kind to meet.
    pub(super) lone: Vec<usize>,
    /// Materials of walls, without repetition.
    pub(super) walls: Vec<usize>,
}

impl MaterialUse {
    /// The pairs that can meet, each once and sorted.
    fn pairs(&self) -> Vec<[usize; 2]> {
        let mut pairs = self.pairs_of_materials();
        pairs.retain(|&[one, other]| one != other || !self.is_lone(one));
        pairs
    }

    /// Whether a single particle is made of the material, and no wall. Its contact with its like may be
    /// given: the number of particles is often varied.
    fn is_lone(&self, material: usize) -> bool {
        self.lone.contains(&material) && !self.walls.contains(&material)
    }

    /// All pairs of materials of particles, and of particles and walls.
    fn pairs_of_materials(&self) -> Vec<[usize; 2]> {
        let others = || self.particles.iter().chain(&self.walls);
        let mut pairs: Vec<[usize; 2]> =
            self.particles.iter().flat_map(|&one| others().map(move |&other| sorted(one, other))).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}

fn sorted(one: usize, other: usize) -> [usize; 2] {
    [one.min(other), one.max(other)]
}

/// Reads `[contacts.A-B]`, one for each pair of materials that can meet and for no other, in the order
/// of the materials. Where the use of the materials is not known because of other mistakes, only the
/// laws are checked.
pub(super) fn read_contacts(
    root: &mut TableReader<'_>,
    materials: &[Material],
    used: Option<&MaterialUse>,
) -> Result<Vec<Contact>, Reported> {
    let needed = used.map(MaterialUse::pairs);
    let allowed = used.map(MaterialUse::pairs_of_materials);
    let name = |index: usize| materials.get(index).map_or("", |material| material.name.as_str());
    let mut contacts = Vec::new();
    let mut met: Vec<([usize; 2], String)> = Vec::new();
    let mut failure = None;
    let mut named = true;
    for (key, table) in root.named_tables("contacts")? {
        let pair = pair_of(&key, &table, materials);
        named &= pair.is_ok();
        let read = pair.and_then(|pair| {
            if let Some((_, first)) = met.iter().find(|(known, _)| *known == pair) {
                let found = format!("`{first}` and `{key}` are the same contact");
                return Err(table.refuse("", Problem::rule(found, "only one of them")));
            }
            met.push((pair, key));
            if allowed.as_ref().is_some_and(|allowed| !allowed.contains(&pair)) {
                let found = format!("{} and {} never meet", name(pair[0]), name(pair[1]));
                let expected = "contacts between materials of particles, or of particles and walls";
                return Err(table.refuse("", Problem::rule(found, expected)));
            }
            let [one, other] = pair.map(|index| materials.get(index).map(|material| &material.properties));
            let properties = one.zip(other).map(|(one, other)| [one, other]);
            let NamedContact { model, laws } = read_contact(table, properties)?;
            Ok(Contact { materials: pair, model, laws })
        });
        match read {
            Ok(contact) => contacts.push(contact),
            Err(reported) => failure = Some(reported),
        }
    }
    // A misspelled contact is not reported as a missing one, too.
    for pair in needed.unwrap_or_default().into_iter().filter(|_| named) {
        if !met.iter().any(|(known, _)| *known == pair) {
            let (one, other) = (name(pair[0]), name(pair[1]));
            let key = format!("contacts.{one}-{other}");
            let expected = format!("a table [{key}.normal] with the law between {one} and {other}");
            failure = Some(root.refuse("contacts", Problem::MissingKey { key, expected }));
        }
    }
    contacts.sort_by_key(|contact| contact.materials);
    failure.map_or(Ok(contacts), Err)
}

/// The materials that the key `A-B` names.
fn pair_of(key: &str, table: &TableReader<'_>, materials: &[Material]) -> Result<[usize; 2], Reported> {
    let Some((one, other)) = key.split_once('-') else {
        let found = format!("`{key}` names no pair of materials");
        return Err(table.refuse("", Problem::rule(found, "two materials joined by a hyphen, `grain-wall`")));
    };
    let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    let index = |name: &str| {
        let position = names.iter().position(|known| *known == name);
        position.ok_or_else(|| table.refuse("", Problem::unknown_choice(name, &names)))
    };
    let (one, other) = (index(one), index(other));
    Ok(sorted(one?, other?))
}
