//! A small schema that uses every kind of value.

use pulvis_input::*;
use std::path::Path;

#[derive(Debug, PartialEq)]
pub struct Case {
    pub title: Option<String>,
    pub radius: Vec<f64>,
    pub gravity: [f64; 3],
    pub law: f64,
    pub k1: f64,
    pub kp: f64,
    pub reach: f64,
    pub materials: Vec<(String, f64, f64)>,
    pub stages: Vec<Stage>,
}

#[derive(Debug, PartialEq)]
pub struct Stage {
    pub duration: f64,
    pub steps: i64,
    pub gravity: bool,
    pub name: String,
}

pub fn load(path: &Path) -> Result<Case, InputErrors> {
    Document::load(path)?.read(case)
}

pub fn case(mut root: TableReader<'_>) -> Result<Case, Reported> {
    let title = root.optional("title", Text);
    let radius = root.required("radius", List::of(Dimension::LENGTH).exactly(2));
    let gravity = root.or("gravity", Vector::of(Dimension::ACCELERATION), [0.0, 0.0, -9.81]);
    let contact = root.required_table("contact").and_then(contact);
    let materials: Vec<_> = root
        .named_tables("materials")
        .map(|tables| tables.into_iter().map(|(name, table)| material(name, table)).collect())?;
    let stages: Vec<_> = root.tables("stages")?.into_iter().map(stage).collect();
    root.finish();
    let (law, k1, kp, reach) = contact?;
    Ok(Case {
        title: title?,
        radius: radius?,
        gravity: gravity?,
        law,
        k1,
        kp,
        reach,
        materials: materials.into_iter().collect::<Result<_, _>>()?,
        stages: stages.into_iter().collect::<Result<_, _>>()?,
    })
}

fn contact(mut table: TableReader<'_>) -> Result<(f64, f64, f64, f64), Reported> {
    let stiffness = QuantityRule::of(Dimension::STIFFNESS).above(0.0);
    let law = table.required("interpolation", Choice(&[("linear", 1.0), ("square-root", 0.5)]));
    let k1 = table.required("k1", stiffness);
    let kp = table.required("kp", stiffness);
    let reach = table.or("kc_a", stiffness.or_infinite(), f64::INFINITY);
    if let (Ok(k1), Ok(kp)) = (k1, kp)
        && kp < k1
    {
        let found = format!("{kp} N/m is smaller than k1 = {k1} N/m");
        table.refuse("kp", Problem::rule(found, "kp >= k1"));
    }
    table.finish();
    Ok((law?, k1?, kp?, reach?))
}

fn material(name: String, mut table: TableReader<'_>) -> Result<(String, f64, f64), Reported> {
    let density = table.required("density", Dimension::DENSITY);
    let friction = table.required("friction", QuantityRule::of(Dimension::NONE).at_least(0.0));
    table.finish();
    Ok((name, density?, friction?))
}

fn stage(mut table: TableReader<'_>) -> Result<Stage, Reported> {
    let name = table.required("name", Name(&["fill", "press"]));
    let duration = table.required("duration", Dimension::TIME);
    let steps = table.or("steps", Integer::at_least(1), 1);
    let gravity = table.or("gravity", Boolean, true);
    table.finish();
    Ok(Stage { name: name?.to_owned(), duration: duration?, steps: steps?, gravity: gravity? })
}
