//! What values can be, in the words of JSON schema.

use super::manual::Manual;
use super::selected::{Case, selected};
use serde_json::{Map, Value, json};

/// A text that is not empty.
pub(super) fn text() -> Value {
    json!({ "type": "string", "minLength": 1 })
}

/// A number with a unit, as text.
pub(super) fn quantity() -> Value {
    json!({ "type": "string", "pattern": r"^\s*[+-]?(\.?[0-9]|inf)" })
}

/// A pure number, bare or as text.
pub(super) fn number() -> Value {
    json!({ "anyOf": [{ "type": "number" }, quantity()] })
}

/// Any quantity or number.
pub(super) fn any_quantity() -> Value {
    number()
}

/// A whole number; large ones may be written as 1e6.
pub(super) fn whole(least: i64) -> Value {
    json!({ "type": "number", "minimum": least })
}

pub(super) fn boolean() -> Value {
    json!({ "type": "boolean" })
}

pub(super) fn list(item: Value) -> Value {
    json!({ "type": "array", "items": item })
}

/// As many items.
pub(super) fn exactly(count: usize, item: Value) -> Value {
    between(count, count, item)
}

/// So many items.
pub(super) fn between(least: usize, most: usize, item: Value) -> Value {
    json!({ "type": "array", "items": item, "minItems": least, "maxItems": most })
}

/// Three quantities.
pub(super) fn vector() -> Value {
    exactly(3, quantity())
}

/// Three pure numbers.
pub(super) fn direction() -> Value {
    exactly(3, number())
}

/// One of some names.
pub(super) fn choice<'n>(names: impl IntoIterator<Item = &'n str>) -> Value {
    json!({ "enum": names.into_iter().collect::<Vec<_>>() })
}

/// One of several shapes.
pub(super) fn either(shapes: impl IntoIterator<Item = Value>) -> Value {
    json!({ "anyOf": shapes.into_iter().collect::<Vec<_>>() })
}

/// Anything at all.
pub(super) fn anything() -> Value {
    json!({})
}

/// A section of a page of the manual, from which keys have their hover texts.
#[derive(Clone, Copy)]
pub(super) struct Page<'m> {
    pub(super) manual: &'m Manual,
    /// A part of its heading.
    pub(super) section: &'static str,
}

impl Page<'_> {
    /// The same page, another section.
    pub(super) fn at(self, section: &'static str) -> Self {
        Self { section, ..self }
    }

    /// A table with these keys and no others; each has the hover text of its row.
    pub(super) fn table(
        self,
        keys: impl IntoIterator<Item = (&'static str, Value)>,
        required: &[&str],
    ) -> Value {
        let described =
            keys.into_iter().map(|(key, shape)| (key, self.manual.text(self.section, key), shape));
        table_of(described, required)
    }

    /// A table whose `selector` decides which other keys belong into it; every variant has the hover text of its row.
    pub(super) fn variants(
        self,
        selector: &'static str,
        default: Option<&str>,
        variants: impl IntoIterator<Item = Variant>,
    ) -> Value {
        let described = |(name, keys, required): Variant| {
            let words = self.manual.text(self.section, name);
            let words = words.or_else(|| self.manual.text(self.section, selector)).unwrap_or_default();
            let keys = keys.into_iter().map(|(key, shape)| {
                let own = self.manual.text(self.section, key);
                (key, own.unwrap_or_else(|| words.clone()), shape)
            });
            Case { name, keys: keys.collect(), required: required.to_vec(), words: words.clone() }
        };
        selected(selector, default, &variants.into_iter().map(described).collect::<Vec<_>>())
    }
}

/// Name, keys and required keys of one variant of a table.
pub(super) type Variant = (&'static str, Vec<(&'static str, Value)>, &'static [&'static str]);

/// A table of keys with their hover texts.
pub(super) fn table_of<'k>(
    keys: impl IntoIterator<Item = (&'k str, Option<String>, Value)>,
    required: &[&str],
) -> Value {
    let mut properties = Map::new();
    for (key, words, mut shape) in keys {
        if let (Some(words), Some(object)) = (words, shape.as_object_mut()) {
            object.insert("description".to_owned(), Value::String(words));
        }
        properties.insert(key.to_owned(), shape);
    }
    let mut table = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        table["required"] = json!(required);
    }
    table
}

/// A list of such tables.
pub(super) fn tables(item: Value) -> Value {
    list(item)
}

/// Tables or values under names of the user's choice.
pub(super) fn named(item: Value) -> Value {
    json!({ "type": "object", "additionalProperties": item })
}

/// Component names of a symmetric tensor and their shape.
pub(super) fn components(names: &[&'static str], item: fn() -> Value) -> Value {
    table_of(names.iter().map(|name| (*name, None, item())), &[])
}
