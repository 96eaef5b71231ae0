//! The laws of a contact, from the catalogue.

use super::selected::{Case, selected};
use super::shapes::{between, choice, number, quantity, table_of, text};
use crate::contact::entries;
use pulvis_contact::catalogue::{Kind, LawEntry, Parameter, Presence, Role};
use pulvis_math::Dimension;
use serde_json::Value;

/// A contact: a table for each role. With a `label` where contacts are compared; `whole` where nothing else gives the normal law.
pub(super) fn contact(label: bool, whole: bool) -> Value {
    let roles =
        Role::ALL.into_iter().map(|role| (role.key(), Some(words(role).to_owned()), role_table(role)));
    let label = label.then(|| {
        let words = "What the contact is called in tables and pictures.".to_owned();
        ("label", Some(words), text())
    });
    let required: &[&str] = if whole { &["normal"] } else { &[] };
    table_of(roles.chain(label), required)
}

/// What a role is.
fn words(role: Role) -> &'static str {
    match role {
        Role::Normal => "Force while the bodies overlap: `law` and its parameters.",
        Role::NonContact => "Attraction at a distance: `law` and its parameters.",
        Role::Viscosity => "Dashpot along the line of centres: `law` and its parameters.",
        Role::Sliding => "Resistance against sliding: `law` and its parameters.",
        Role::Rolling => "Resistance against rolling: `law` and its parameters.",
        Role::Torsion => "Resistance against torsion: `law` and its parameters.",
        Role::Bond => "Springs that hold two bodies together until they break: `law` and its parameters.",
        Role::Conventions => "Choices in which codes differ.",
        Role::Expected => "Speed, force and overlap that contacts are expected to go through.",
    }
}

fn role_table(role: Role) -> Value {
    if matches!(role, Role::Conventions | Role::Expected) {
        let keys = entries(role).into_iter().flat_map(|entry| keys(entry));
        return table_of(keys.map(|(key, words, shape)| (key, Some(words), shape)), &[]);
    }
    let cases: Vec<Case<'_>> = entries(role).into_iter().map(case).collect();
    selected("law", None, &cases)
}

fn keys(entry: &'static LawEntry) -> Vec<(&'static str, String, Value)> {
    entry
        .parameters
        .iter()
        .map(|parameter| (parameter.name, described(parameter), shape(parameter)))
        .collect()
}

/// The table of a law.
fn case(entry: &'static LawEntry) -> Case<'static> {
    let must =
        |parameter: &&Parameter| parameter.presence == Presence::Required && parameter.mixing.is_none();
    Case {
        name: entry.name,
        keys: keys(entry),
        required: entry.parameters.iter().filter(must).map(|parameter| parameter.name).collect(),
        words: entry.summary.to_owned(),
    }
}

fn described(parameter: &Parameter) -> String {
    let Parameter { symbol, meaning, .. } = parameter;
    let mut text = if symbol.is_empty() { (*meaning).to_owned() } else { format!("{symbol}: {meaning}") };
    if let Kind::Number { .. } | Kind::Numbers { .. } = parameter.kind {
        text += &format!(" [{}], {}", parameter.unit(), parameter.allowed());
    }
    if let Kind::Choice(options) = parameter.kind {
        for option in options {
            text += &format!("\n- \"{}\": {}", option.name, option.meaning);
        }
    }
    let default = parameter.default_text();
    if default.is_empty() { text } else { text + &format!("\n\nDefault: {default}") }
}

fn shape(parameter: &Parameter) -> Value {
    match parameter.kind {
        Kind::Number { dimension, .. } if dimension == Dimension::NONE => number(),
        Kind::Number { .. } => quantity(),
        Kind::Numbers { length: (least, most), .. } => between(least, most, quantity()),
        Kind::Choice(options) => choice(options.iter().map(|option| option.name)),
    }
}
