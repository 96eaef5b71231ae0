//! Materials, and finding one by its name.

use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_math::Dimension;

/// A material; what it does in contact is up to the contacts of material pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name: letters, digits and underscores.
    pub name: String,
    /// Mass density [kg/m^3]; a material that particles are made of has one.
    pub density: Option<f64>,
}

/// Reads `[materials.NAME]`.
pub(super) fn read_materials(root: &mut TableReader<'_>) -> Result<Vec<Material>, Reported> {
    let tables = root.named_tables("materials")?;
    if tables.is_empty() {
        let expected = "a table [materials.NAME] for each material".to_owned();
        let problem = Problem::MissingKey { key: "materials".to_owned(), expected };
        return Err(root.refuse("materials", problem));
    }
    let materials: Vec<_> = tables.into_iter().map(|(name, table)| read_material(name, table)).collect();
    materials.into_iter().collect()
}

fn read_material(name: String, mut table: TableReader<'_>) -> Result<Material, Reported> {
    let plain = name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let named = if plain {
        Ok(())
    } else {
        // A hyphen would make the key of a contact, `a-b`, ambiguous.
        let found = format!("\"{name}\" is no name of a material");
        Err(table.refuse("", Problem::rule(found, "only letters, digits and underscores")))
    };
    let density = table.optional("density", QuantityRule::of(Dimension::DENSITY).above(0.0));
    table.finish();
    named?;
    Ok(Material { name, density: density? })
}

/// Reads the name of a material at `key` and gives its index.
pub(super) fn read_material_name(
    table: &mut TableReader<'_>,
    key: &str,
    materials: &[Material],
) -> Result<usize, Reported> {
    let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    let name = table.required(key, crate::shape::Name(&names))?;
    let index = names.iter().position(|known| *known == name);
    index.ok_or_else(|| table.refuse(key, Problem::unknown_choice(name, &names)))
}
