//! Materials, and finding one by its name.

use crate::context::Reported;
use crate::material::{MaterialProperties, read_properties};
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
    /// What contact laws may ask for.
    pub properties: MaterialProperties,
}

/// Reads `[materials.NAME]`. The second value tells whether all of them are fit for use; the names are
/// good in any case, so that the rest of the file can be read for more mistakes.
pub(super) fn read_materials(
    root: &mut TableReader<'_>,
) -> Result<(Vec<Material>, Result<(), Reported>), Reported> {
    let tables = root.named_tables("materials")?;
    if tables.is_empty() {
        let expected = "a table [materials.NAME] for each material".to_owned();
        let problem = Problem::MissingKey { key: "materials".to_owned(), expected };
        return Err(root.refuse("materials", problem));
    }
    let mut fit = Ok(());
    let mut materials = Vec::new();
    for (name, table) in tables {
        let ((density, properties), read) = match read_material(&name, table) {
            Ok(material) => (material, Ok(())),
            // Not `None`, which would be reported once more for each group of particles.
            Err(reported) => ((Some(f64::NAN), MaterialProperties::default()), Err(reported)),
        };
        materials.push(Material { name, density, properties });
        fit = fit.and(read);
    }
    Ok((materials, fit))
}

fn read_material(
    name: &str,
    mut table: TableReader<'_>,
) -> Result<(Option<f64>, MaterialProperties), Reported> {
    let plain = name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let named = if plain {
        Ok(())
    } else {
        // A hyphen would make the key of a contact, `a-b`, ambiguous.
        let found = format!("\"{name}\" is no name of a material");
        Err(table.refuse("", Problem::rule(found, "only letters, digits and underscores")))
    };
    let density = table.optional("density", QuantityRule::of(Dimension::DENSITY).above(0.0));
    let properties = read_properties(&mut table);
    table.finish();
    named?;
    Ok((density?, properties?))
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

/// The same of a material that particles are made of, which has a density.
pub(super) fn read_material_with_density(
    table: &mut TableReader<'_>,
    materials: &[Material],
) -> Result<usize, Reported> {
    let index = read_material_name(table, "material", materials)?;
    needs_density(table, "material", materials, index)
}

/// Refuses a material without a density, named at `key`: particles are made of it.
pub(super) fn needs_density(
    table: &TableReader<'_>,
    key: &str,
    materials: &[Material],
    index: usize,
) -> Result<usize, Reported> {
    match materials.get(index) {
        Some(Material { name, density: None, .. }) => {
            let found = format!("{name} has no density");
            let expected = format!("`density` in [materials.{name}], because particles are made of it");
            Err(table.refuse(key, Problem::rule(found, expected)))
        }
        _ => Ok(index),
    }
}
