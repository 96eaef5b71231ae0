//! Properties of materials that contact laws ask for.

use pulvis_contact::catalogue::mixing::MATERIAL_PROPERTIES;

use crate::context::Reported;
use crate::parameters::rule;
use crate::reader::TableReader;

/// The properties of a material that contact laws ask for, by name, in SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialProperties(Vec<(&'static str, f64)>);

impl MaterialProperties {
    /// The value [SI] of a property, if it is given.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }

    /// Names and values [SI], in the order of the catalogue.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.0.iter().copied()
    }
}

/// Reads what is given of the properties that laws can ask for.
///
/// # Errors
/// A property is of another shape or out of range; all of that has been reported.
pub(crate) fn read_properties(table: &mut TableReader<'_>) -> Result<MaterialProperties, Reported> {
    let mut properties = MaterialProperties::default();
    let mut failure = None;
    for property in MATERIAL_PROPERTIES {
        match table.optional(property.name, rule(property.dimension, property.range, false)) {
            Ok(Some(value)) => properties.0.push((property.name, value)),
            Ok(None) => {}
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(properties), Err)
}
