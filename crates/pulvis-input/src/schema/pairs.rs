//! Scenarios of `pulvis collide` and `pulvis probe`, and studies.

use super::laws::contact;
use super::scenario::temperature;
use super::shapes::*;
use crate::figure::Value as Reduction;
use serde_json::{Value, json};

/// One value, or one for each body.
fn of_bodies() -> Value {
    either([quantity(), list(quantity())])
}

/// Ends, number and spacing of values, or a list of them.
fn spacing() -> [(&'static str, Value); 5] {
    [
        ("values", list(any_quantity())),
        ("from", any_quantity()),
        ("to", any_quantity()),
        ("points", whole(2)),
        ("spacing", choice(["linear", "log"])),
    ]
}

/// What both kinds have around their own table.
fn around(page: Page<'_>, key: &str, own: Value) -> Value {
    let mut root = page.table(
        [("title", text()), ("temperature", temperature()), ("compare", tables(contact(true, false)))],
        &[],
    );
    root["properties"][key] = own;
    root["properties"]["contact"] = contact(true, true);
    root["properties"]["contact"]["description"] =
        json!("The laws of the contact, each a table with `law` and its parameters.");
    root["required"] = json!([key, "contact"]);
    root
}

/// A collision.
pub(super) fn collision(page: Page<'_>) -> Value {
    let variable = || [("variable", text())];
    let over = |words: &str| {
        let mut table = page.table(variable().into_iter().chain(spacing()), &["variable"]);
        table["description"] = json!(words);
        table
    };
    let sweep = over("The variable that is swept.");
    let family = over("A second variable, one curve for each of its values.");
    let spin = || either([any_quantity(), exactly(3, any_quantity())]);
    let mut own = page.table(
        [
            ("bodies", choice(["pair", "wall"])),
            ("radius", of_bodies()),
            ("density", of_bodies()),
            ("mass", of_bodies()),
            ("angle", any_quantity()),
            ("spin_i", spin()),
            ("spin_j", spin()),
            ("method", choice(["exact", "engine"])),
            ("steps_per_contact", number()),
            ("time_after_sticking", quantity()),
            ("velocity", quantity()),
            ("normal_velocity", quantity()),
            ("chi", number()),
            ("zeta", number()),
            ("charge", of_bodies()),
            ("shell_thickness", of_bodies()),
            ("sweep", sweep),
            ("family", family),
        ],
        &["bodies", "radius"],
    );
    own["description"] = json!("The two bodies, and how they meet.");
    around(page, "collision", own)
}

/// A contact on a prescribed path.
pub(super) fn probe(page: Page<'_>) -> Value {
    let mut own = page.table(
        [
            ("bodies", choice(["pair", "wall"])),
            ("radius", of_bodies()),
            ("density", of_bodies()),
            ("mass", of_bodies()),
            ("overlap", list(quantity())),
            ("shear", list(quantity())),
            ("roll", list(quantity())),
            ("twist", list(quantity())),
            ("points", whole(1)),
            ("speed", quantity()),
            ("durations", list(quantity())),
            ("charge", of_bodies()),
            ("shell_thickness", of_bodies()),
        ],
        &["bodies", "radius", "overlap"],
    );
    own["description"] = json!("The two bodies, and the path of their contact.");
    around(page, "probe", own)
}

/// A study.
pub(super) fn study(page: Page<'_>) -> Value {
    let over = page.at("`[[study.over]]`");
    let around = || [("label", text()), ("log", boolean())];
    let values = ("values", list(either([any_quantity(), text(), boolean()])));
    let keys = [("key", text()), values].into_iter().chain(spacing().into_iter().skip(1));
    let one_key = over.table(keys.chain(around()), &["key"]);
    let together = [("set", tables(named(anything()))), ("names", list(text()))];
    let together = over.table(together.into_iter().chain(around()), &["set"]);
    let over = either([one_key, together]);
    let own = page.table(
        [
            ("title", text()),
            ("scenario", text()),
            ("seeds", list(whole(0))),
            ("set", named(anything())),
            ("over", tables(over)),
        ],
        &["title", "scenario"],
    );
    let measure = measure(page);
    let mut root = page.table([("measures", tables(measure))], &["study", "measures"]);
    root["properties"]["study"] = own;
    root["properties"]["study"]["description"] =
        json!("The scenario, its seeds, and the values that it runs over.");
    root
}

fn measure(page: Page<'_>) -> Value {
    let page = page.at("`[[measures]]`");
    let within = table_of(
        [
            ("column", Some("A column of the time series, or a formula of columns.".to_owned()), text()),
            ("from", Some("Least value, in SI.".to_owned()), number()),
            ("to", Some("Largest value, in SI.".to_owned()), number()),
        ],
        &["column", "from", "to"],
    );
    let formula = table_of(
        [
            ("amplitude", Some("y at the start, in SI.".to_owned()), number()),
            ("scale", Some("What x - start is compared with, in SI.".to_owned()), number()),
            ("exponent", Some("The power.".to_owned()), number()),
            ("start", Some("x at the start, in SI.\n\nDefault: 0".to_owned()), number()),
            ("offset", Some("What is added, in SI.\n\nDefault: 0".to_owned()), number()),
        ],
        &["amplitude", "scale", "exponent"],
    );
    let reduction = || {
        vec![
            ("value", choice(Reduction::NAMED.iter().map(|(name, _)| *name))),
            ("y", text()),
            ("x", text()),
            ("stage", text()),
            ("within", within.clone()),
            ("cycles", exactly(2, number())),
            ("formula", formula.clone()),
        ]
    };
    let over = page.table(reduction(), &[]);
    let own = vec![
        ("key", text()),
        ("what", text()),
        ("unit", text()),
        ("over", over),
        ("expected", either([number(), list(number())])),
        ("tolerance", number()),
        ("source", text()),
        ("certainty", choice(["A", "B", "C"])),
    ];
    page.table(own.into_iter().chain(reduction()), &["key", "what", "value", "y"])
}
