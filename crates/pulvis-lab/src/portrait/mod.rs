//! The picture of a law: what the example of its description does, as `pulvis probe` or `pulvis collide` draws it.
//!
//! Paths are found by trial: overlaps, displacements and durations are varied over decades, and those are taken that
//! show most of the law, every branch and, where there is attraction, attraction beside repulsion.

mod path;
mod scene;

use pulvis_contact::catalogue::{LawEntry, Role};
use pulvis_input::collision::CollisionScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_input::{Document, InputErrors};
use pulvis_io::plot::Figure;
use thiserror::Error;

use crate::collision::{self, CollisionError};
use crate::probe::{self, ProbeError};
use scene::Scene;

/// The picture of a law, and the scenario that it was drawn from.
#[derive(Debug)]
pub struct Portrait {
    /// The command that draws the scenario: `probe` or `collide`.
    pub command: &'static str,
    /// The scenario, as a file.
    pub scenario: String,
    /// The picture.
    pub figure: Figure,
}

/// A picture that cannot be drawn.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PortraitError {
    /// No scenario around the example of the law can be read.
    #[error("no scenario shows the example of `{law}`; the last one that was tried: {problems}")]
    Unreadable {
        /// The law.
        law: &'static str,
        /// What is wrong with the last scenario that was tried.
        problems: String,
    },
    /// The contact cannot be computed on any path.
    #[error(transparent)]
    Probe(#[from] ProbeError),
    /// The collision cannot be computed.
    #[error(transparent)]
    Collision(#[from] CollisionError),
}

/// Draws a law; `None` for what has no picture: conventions, expectations, and laws called `none`.
///
/// # Errors
/// No scenario shows the law, or the one that does cannot be computed.
pub fn portrait(entry: &LawEntry) -> Result<Option<Portrait>, PortraitError> {
    match entry.role {
        _ if entry.name == "none" => Ok(None),
        Role::Conventions | Role::Expected => Ok(None),
        Role::Viscosity => collided(entry).map(Some),
        _ => probed(entry).map(Some),
    }
}

/// A dashpot, in a collision.
fn collided(entry: &LawEntry) -> Result<Portrait, PortraitError> {
    let read = |text: &str| CollisionScenario::from_document(&Document::from_str("portrait.toml", text)?);
    let texts = scene::collisions(entry);
    first_readable(entry, texts.clone(), read)?;
    let collided = texts.into_iter().filter_map(|text| {
        let scenario = read(&text).ok()?;
        let points = collision::sweep(&scenario, false).ok()?;
        let restitution = points.first()?.collision.outcome.restitution;
        Some((path::score_of_loss(1.0 - restitution * restitution), text, scenario, points))
    });
    let (_, scenario, read, points) = best(collided).ok_or_else(|| nowhere(entry))?;
    Ok(Portrait { command: "collide", scenario, figure: collision::figure(&read, &points)? })
}

/// Any other law, on a path.
fn probed(entry: &LawEntry) -> Result<Portrait, PortraitError> {
    let read = |text: &str| ProbeScenario::from_document(&Document::from_str("portrait.toml", text)?);
    let scenes = Scene::all(entry);
    let drafts = scenes.iter().map(Scene::draft).collect();
    let (found, _) = first_readable(entry, drafts, read)?;
    let scene = scenes.iter().find(|scene| scene.draft() == found);
    let candidates = scene.map(Scene::candidates).unwrap_or_default();
    let drawn = candidates.into_iter().filter_map(|text| {
        let scenario = read(&text).ok()?;
        let curves = probe::probe(&scenario).ok()?;
        let score = path::score(entry.role, &curves.first()?.samples);
        Some((score, text, scenario.title, curves))
    });
    let (_, scenario, title, curves) = best(drawn).ok_or_else(|| nowhere(entry))?;
    Ok(Portrait { command: "probe", scenario, figure: probe::figure(title.as_deref(), &curves) })
}

/// The first of those with the highest score.
fn best<A, B, C>(scored: impl Iterator<Item = (f64, A, B, C)>) -> Option<(f64, A, B, C)> {
    scored.reduce(|best, next| if next.0 > best.0 { next } else { best })
}

fn nowhere(entry: &LawEntry) -> PortraitError {
    ProbeError::NotFinite { label: entry.name.to_owned(), overlap: f64::NAN }.into()
}

/// The first of the texts that can be read, and what it says.
fn first_readable<T>(
    entry: &LawEntry,
    texts: Vec<String>,
    read: impl Fn(&str) -> Result<T, InputErrors>,
) -> Result<(String, T), PortraitError> {
    let mut problems = String::new();
    for text in texts {
        match read(&text) {
            Ok(scenario) => return Ok((text, scenario)),
            Err(errors) => problems = errors.to_string(),
        }
    }
    Err(PortraitError::Unreadable { law: entry.name, problems })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use pulvis_input::contact::entries;

    #[test]
    fn every_law_has_a_picture() {
        for entry in Role::ALL.into_iter().flat_map(entries) {
            let drawn = portrait(entry).unwrap_or_else(|error| panic!("{}: {error}", entry.name));
            let shown = !matches!(entry.role, Role::Conventions | Role::Expected) && entry.name != "none";
            assert_eq!(drawn.is_some(), shown, "{}", entry.name);
        }
    }
}
