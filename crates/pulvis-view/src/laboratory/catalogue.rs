//! The laws with all that a page needs to offer them: parameters, units, ranges, and the values of their examples.

use super::NAME;
use pulvis_contact::catalogue::{
    Kind, LawEntry, Parameter, Presence, Range, Role, Value as LawValue, Values,
};
use pulvis_input::contact::entries;
use pulvis_input::{Document, NamedContact, read_contact};
use serde_json::{Map, Value, json};

/// Normal laws beside which the examples of other laws can be read: sliding may need the contact area.
const HOSTS: [&str; 3] = [
    "law = \"linear\"\nk = \"100 N/m\"",
    "law = \"hertz\"\neffective_modulus = \"1e8 Pa\"",
    "law = \"jkr\"\neffective_modulus = \"1e8 Pa\"\nwork_of_adhesion = \"0.1 N/m\"",
];

/// All laws.
pub(super) fn laws() -> Value {
    Role::ALL.into_iter().flat_map(entries).map(law).collect()
}

fn law(entry: &'static LawEntry) -> Value {
    json!({
        "role": entry.role.key(),
        "name": entry.name,
        "summary": entry.summary,
        "equations": entry.equations,
        "source": entry.source,
        "verified": entry.closed_form,
        "parameters": entry.parameters.iter().map(parameter).collect::<Value>(),
        "quantities": entry.particle_quantities.iter().map(parameter).collect::<Value>(),
        "example": example(entry).map(|values| written(&values)),
    })
}

fn parameter(parameter: &Parameter) -> Value {
    let Parameter { name, symbol, kind, presence, meaning, mixing: _ } = parameter;
    let mut value = json!({
        "name": name,
        "symbol": symbol,
        "meaning": meaning,
        "unit": parameter.unit(),
        "allowed": parameter.allowed(),
        "required": *presence == Presence::Required,
    });
    value["default"] = match presence {
        Presence::Required | Presence::Optional => Value::Null,
        Presence::Default(number) => number_or_word(*number),
        Presence::DefaultChoice(name) => json!(name),
    };
    match kind {
        Kind::Number { range, .. } => value["range"] = limits(*range),
        Kind::Numbers { .. } => value["list"] = json!(true),
        Kind::Choice(options) => {
            let options =
                options.iter().map(|option| json!({"name": option.name, "meaning": option.meaning}));
            value["options"] = options.collect();
        }
    }
    value
}

/// Ends of a range, `null` where there is none, and whether the lower one belongs to it.
fn limits(range: Range) -> Value {
    let (low, high, closed) = match range {
        Range::Any => (None, None, false),
        Range::Positive => (Some(0.0), None, false),
        Range::NonNegative => (Some(0.0), None, true),
        Range::AtLeast(least) => (Some(least), None, true),
        Range::Within(above, up_to) => (Some(above), Some(up_to), false),
        Range::Between(from, up_to) => (Some(from), Some(up_to), true),
    };
    json!({ "low": low, "high": high, "closed": closed })
}

/// JSON knows no infinity.
fn number_or_word(number: f64) -> Value {
    if number == f64::INFINITY { json!("inf") } else { json!(number) }
}

/// Values by their names.
pub(super) fn written(values: &Values) -> Value {
    let pairs = values.iter().map(|(name, value)| {
        let value = match value {
            LawValue::Number(number) => number_or_word(*number),
            LawValue::Choice(name) => json!(name),
            LawValue::Numbers(numbers) => json!(numbers),
        };
        (name.to_owned(), value)
    });
    Value::Object(pairs.collect::<Map<_, _>>())
}

/// The values of the example of a law, defaults filled in.
fn example(entry: &LawEntry) -> Option<Values> {
    let table = |role: Role, law: &str| format!("[contact.{}]\n{law}\n", role.key());
    let own = table(entry.role, entry.example);
    let texts: Vec<String> = if entry.role == Role::Normal {
        vec![own]
    } else {
        HOSTS.iter().map(|host| table(Role::Normal, host) + &own).collect()
    };
    let contact = texts.iter().find_map(|text| contact(text))?;
    contact.laws.into_iter().find(|law| law.role == entry.role).map(|law| law.values)
}

fn contact(text: &str) -> Option<NamedContact> {
    let document = Document::from_str(NAME, text).ok()?;
    let read = document.read(|mut root| {
        let contact = read_contact(root.required_table("contact")?, None);
        root.finish();
        contact
    });
    read.ok()
}
