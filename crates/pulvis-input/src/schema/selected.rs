//! Tables in which one key decides which others belong there: `law`, `kind`, `control`.
//!
//! Editors complete what stands under `properties` and show its texts, and few look into conditions. So all keys of all cases
//! stand there, and conditions say which of them belong into which case: a wrong key is then named in the message.

use serde_json::{Map, Value, json};

/// One case of such a table.
pub(super) struct Case<'k> {
    /// The value of the key that decides.
    pub(super) name: &'k str,
    /// The other keys, with hover texts and shapes.
    pub(super) keys: Vec<(&'k str, String, Value)>,
    /// Those that must be there.
    pub(super) required: Vec<&'k str>,
    /// What the case is.
    pub(super) words: String,
}

/// A key in all cases that have it.
struct Shared<'k> {
    key: &'k str,
    /// Each text once, with the cases that have it.
    texts: Vec<(String, Vec<&'k str>)>,
    /// Each shape once.
    shapes: Vec<Value>,
}

/// The table; `default` is the case that holds where the key is left out.
pub(super) fn selected(selector: &str, default: Option<&str>, cases: &[Case<'_>]) -> Value {
    let mut all: Vec<Shared<'_>> = Vec::new();
    for case in cases {
        for (key, words, shape) in &case.keys {
            let place = all.iter().position(|shared| shared.key == *key).unwrap_or_else(|| {
                all.push(Shared { key, texts: Vec::new(), shapes: Vec::new() });
                all.len() - 1
            });
            all[place].add(case.name, words, shape);
        }
    }
    let names: Vec<&str> = cases.iter().map(|case| case.name).collect();
    let lines: Vec<String> =
        cases.iter().map(|case| format!("- \"{}\": {}", case.name, first_line(&case.words))).collect();
    let mut properties = Map::new();
    properties.insert(selector.to_owned(), json!({ "enum": names, "description": lines.join("\n") }));
    properties.extend(all.iter().map(|shared| (shared.key.to_owned(), shared.property())));
    let mixed = |key: &str| all.iter().any(|shared| shared.key == key && shared.shapes.len() > 1);
    let conditions: Vec<Value> = cases
        .iter()
        .map(|case| {
            let is_it = json!({ "properties": { selector: { "const": case.name } }, "required": [selector] });
            let condition = if default == Some(case.name) {
                json!({ "anyOf": [is_it, { "not": { "required": [selector] } }] })
            } else {
                is_it
            };
            json!({ "if": condition, "then": case.demands(selector, mixed) })
        })
        .collect();
    let mut table = json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "allOf": conditions,
    });
    if default.is_none() {
        table["required"] = json!([selector]);
    }
    table
}

impl Case<'_> {
    /// What holds in this case; shapes of keys that are `mixed`, other ones in other cases, with it.
    fn demands(&self, selector: &str, mixed: impl Fn(&str) -> bool) -> Value {
        let names: Vec<&str> =
            std::iter::once(selector).chain(self.keys.iter().map(|(key, ..)| *key)).collect();
        let mut demands = json!({ "propertyNames": { "enum": names } });
        if !self.required.is_empty() {
            demands["required"] = json!(self.required);
        }
        let own = self.keys.iter().filter(|(key, ..)| mixed(key));
        let shapes: Map<String, Value> =
            own.map(|(key, _, shape)| ((*key).to_owned(), shape.clone())).collect();
        if !shapes.is_empty() {
            demands["properties"] = Value::Object(shapes);
        }
        demands
    }
}

impl<'k> Shared<'k> {
    fn add(&mut self, case: &'k str, words: &str, shape: &Value) {
        match self.texts.iter_mut().find(|(known, _)| known == words) {
            Some((_, cases)) => cases.push(case),
            None => self.texts.push((words.to_owned(), vec![case])),
        }
        if !self.shapes.contains(shape) {
            self.shapes.push(shape.clone());
        }
    }

    fn property(&self) -> Value {
        let words = match &self.texts[..] {
            [(words, _)] => words.clone(),
            several => {
                let lines = several.iter().map(|(words, cases)| format!("{}: {words}", cases.join(", ")));
                lines.collect::<Vec<_>>().join("\n\n")
            }
        };
        let mut property = match &self.shapes[..] {
            [shape] => shape.clone(),
            several => json!({ "anyOf": several }),
        };
        property["description"] = json!(words);
        property
    }
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or_default()
}
