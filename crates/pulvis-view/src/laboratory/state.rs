//! Scenario files as the sliders of the page show them.

use super::catalogue::written;
use super::{NAME, Outcome, document, words};
use pulvis_contact::catalogue::{LawEntry, Role};
use pulvis_input::collision::{Bodies, CollisionScenario, Sphere};
use pulvis_input::comparison::read_compared;
use pulvis_input::contact::entries;
use pulvis_input::probe::{ProbePath, ProbeScenario};
use pulvis_input::{Document, LabelledContact, Surroundings};
use pulvis_lab::collision::typical_speed;
use pulvis_lab::portrait::portrait;
use pulvis_math::elementary;
use serde_json::{Map, Value, json};

/// The scenario that shows most of a law's example.
pub(super) fn start(role: &str, law: &str) -> Outcome {
    let entry = entry(role, law)?;
    let shown = portrait(entry).map_err(|error| error.to_string())?;
    let shown = shown.ok_or_else(|| format!("`{law}` ({role}) has no forces that could be drawn"))?;
    read(&shown.scenario)
}

fn entry(role: &str, law: &str) -> Result<&'static LawEntry, String> {
    let role = Role::ALL.into_iter().find(|known| known.key() == role).ok_or("there is no such role")?;
    let found = entries(role).into_iter().find(|entry| entry.name == law);
    found.ok_or_else(|| format!("no law is called `{law}`"))
}

/// Reads a file for `pulvis collide` or `pulvis probe`.
pub(super) fn read(text: &str) -> Outcome {
    let document = document(text)?;
    let (is_probe, contacts) = document
        .read(|mut root| {
            let contacts = read_compared(&mut root);
            let is_probe = root.keys().contains(&"probe");
            // The rest is read below.
            for key in root.keys() {
                root.value(key);
            }
            root.finish();
            Ok((is_probe, contacts?))
        })
        .map_err(words)?;
    let mut state = if is_probe { probe(&document)? } else { collision(&document)? };
    state["contacts"] = contacts.iter().map(contact).collect();
    Ok(state)
}

fn probe(document: &Document) -> Outcome {
    let ProbeScenario { title, bodies, path, surroundings, contacts } =
        ProbeScenario::from_document(document).map_err(words)?;
    let ProbePath { poses, prescribed: _, durations, points } = path;
    let mut state = surrounded(&bodies, &surroundings);
    state["title"] = json!(title);
    state["probe"] = json!({ "poses": poses, "durations": durations, "points": points });
    state["typical_speed"] =
        json!(contacts.first().map(|one| typical_speed(bodies, &one.contact.model, &surroundings)));
    Ok(state)
}

fn collision(document: &Document) -> Outcome {
    let scenario = CollisionScenario::from_document(document).map_err(words)?;
    let first = scenario.cases.first().ok_or_else(|| format!("{NAME} holds no collision"))?;
    let oblique = first.incidence.map(|_| oblique(&scenario)).transpose()?;
    let speeds = scenario.cases.iter().map(|case| case.velocity).filter(|speed| *speed > 0.0);
    let [low, high] =
        speeds.fold([f64::INFINITY, 0.0_f64], |[low, high], speed| [low.min(speed), high.max(speed)]);
    let mut state = surrounded(&first.bodies, &first.surroundings);
    state["title"] = json!(scenario.title);
    state["oblique"] = json!(oblique);
    state["speeds"] = json!([low, high]);
    state["typical_speed"] = json!(typical_speed(first.bodies, &first.contact, &first.surroundings));
    Ok(state)
}

/// Speed, angle \[°\] and spins of the collision in the middle of a sweep.
fn oblique(scenario: &CollisionScenario) -> Outcome {
    let case = scenario.cases.get(scenario.cases.len() / 2);
    let (velocity, incidence) = case.map(|case| (case.velocity, case.incidence)).unwrap_or_default();
    let incidence = incidence.unwrap_or_default();
    if incidence.spins.iter().any(|[x, y, _]| *x != 0.0 || *y != 0.0) {
        return Err(
            "the laboratory shows motion in a plane; this file has spins about axes within it".to_owned()
        );
    }
    // The value that the author wrote, not its neighbour.
    let degrees = (incidence.angle.to_degrees() * 1e9).round() / 1e9;
    Ok(json!({ "velocity": velocity, "angle": degrees, "spins": incidence.spins.map(|[_, _, z]| z) }))
}

/// The bodies, and what laws read beside them.
fn surrounded(bodies: &Bodies, surroundings: &Surroundings) -> Value {
    let (kind, spheres) = match bodies {
        Bodies::Pair(spheres) => ("pair", spheres.to_vec()),
        Bodies::Wall(sphere) => ("wall", vec![*sphere]),
    };
    let volume = |radius: f64| 4.0 / 3.0 * std::f64::consts::PI * elementary::powi(radius, 3);
    let density = |sphere: &Sphere| sphere.mass / volume(sphere.radius);
    let quantities = surroundings.quantities.iter();
    json!({
        "bodies": kind,
        "radius": spheres.iter().map(|sphere| sphere.radius).collect::<Vec<f64>>(),
        "density": spheres.iter().map(density).collect::<Vec<f64>>(),
        "temperature": surroundings.temperature.as_ref().map(|program| program.at(0.0)),
        "quantities": quantities.map(|one| (one.name.to_owned(), json!(one.values))).collect::<Map<_, _>>(),
    })
}

/// The laws that are there.
fn contact(labelled: &LabelledContact) -> Value {
    let laws = labelled.contact.laws.iter().filter(|law| law.name != "none");
    let laws = laws
        .map(|law| (law.role.key().to_owned(), json!({ "law": law.name, "values": written(&law.values) })));
    json!({ "label": labelled.label, "laws": laws.collect::<Map<_, _>>() })
}
