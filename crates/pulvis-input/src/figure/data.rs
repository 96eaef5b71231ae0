//! What a figure computes: scenarios beside its file.

use super::Surroundings;
use super::quantity::limited_pair;
use super::runs::{Runs, plan};
use super::settings::{Settings, Variant, read_settings};
use crate::collision::{CollisionCase, CollisionScenario, luding_pair};
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::list::List;
use crate::probe::ProbeScenario;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;
use pulvis_contact::theory::LudingPair;
use std::path::PathBuf;

/// What a scenario of a figure is.
#[derive(Clone, Debug)]
pub enum Experiment {
    /// One of `pulvis collide`.
    Collisions(Box<CollisionScenario>),
    /// One of `pulvis probe`.
    Probe(Box<ProbeScenario>),
    /// One of `pulvis run`, in the variants of the figure.
    Runs(Runs),
}

/// A scenario of a figure.
#[derive(Clone, Debug)]
pub struct FigureData {
    /// By which series and checks name it.
    pub name: String,
    /// Its file.
    pub file: PathBuf,
    /// The text of the file.
    pub text: String,
    /// What it says.
    pub experiment: Experiment,
}

impl FigureData {
    /// The pair of its first contact, by which its quantities can be measured; `None` where that has no plastic limit.
    pub fn reference_pair(&self) -> Option<LudingPair> {
        match &self.experiment {
            Experiment::Collisions(scenario) => limited_pair(scenario.cases.first()?),
            Experiment::Probe(scenario) => {
                let contact = &scenario.contacts.first()?.contact.model;
                luding_pair(contact, &scenario.bodies.pair()).filter(|pair| pair.dp().is_finite())
            }
            Experiment::Runs(_) => None,
        }
    }

    /// What its contacts are called.
    pub fn contacts(&self) -> Vec<&str> {
        match &self.experiment {
            Experiment::Collisions(scenario) => scenario.labels.iter().map(String::as_str).collect(),
            Experiment::Probe(scenario) => {
                scenario.contacts.iter().map(|contact| contact.label.as_str()).collect()
            }
            Experiment::Runs(_) => Vec::new(),
        }
    }
}

/// Reads all `[[data]]`.
pub(super) fn read_data(
    root: &mut TableReader<'_>,
    variants: &[Variant],
    around: &Surroundings<'_>,
) -> Result<Vec<FigureData>, Reported> {
    let tables = root.tables("data")?;
    if tables.is_empty() {
        let expected = "one table [[data]] for each scenario that the figure needs".to_owned();
        return Err(root.refuse("data", Problem::MissingKey { key: "data".to_owned(), expected }));
    }
    let mut all: Vec<FigureData> = Vec::new();
    let mut failure = None;
    for table in tables {
        match read_one(table, (&all, failure), variants, around) {
            Ok(data) => all.push(data),
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(all), Err)
}

fn read_one(
    mut table: TableReader<'_>,
    (before, failure): (&[FigureData], Option<Reported>),
    variants: &[Variant],
    around: &Surroundings<'_>,
) -> Result<FigureData, Reported> {
    let file = table.required("file", Text);
    let name = table.optional("name", Text);
    let runs = read_run_keys(&mut table, (before, failure), variants);
    let (file, name, runs) = (file?, name?, runs?);
    let path = around.folder.join(&file);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = name.unwrap_or(stem);
    if before.iter().any(|data| data.name == name) {
        let key = if table.value("name").is_some() { "name" } else { "file" };
        return Err(table.refuse(
            key,
            Problem::rule(format!("two [[data]] are called `{name}`"), "a `name` of its own for each"),
        ));
    }
    let loaded = load(&path, &runs, before, variants).map_err(|errors| {
        let mistakes = errors.errors().len() + errors.omitted();
        around.elsewhere.borrow_mut().extend(errors.into_errors());
        let found = format!("`{file}` has {mistakes} mistake{}", if mistakes == 1 { "" } else { "s" });
        let expected = "a scenario of `pulvis collide`, `pulvis probe` or `pulvis run`";
        table.refuse("file", Problem::rule(found, expected))
    });
    let loaded = loaded.and_then(|(text, experiment)| {
        fits(&table, &runs, &experiment)?;
        Ok((text, experiment))
    });
    table.finish();
    let (text, experiment) = loaded?;
    Ok(FigureData { name, file: path, text, experiment })
}

/// What `[[data]]` says about runs.
struct RunKeys {
    after: Option<usize>,
    set: Settings,
    /// Numbers of the variants.
    variants: Vec<usize>,
}

fn read_run_keys(
    table: &mut TableReader<'_>,
    (before, failure): (&[FigureData], Option<Reported>),
    variants: &[Variant],
) -> Result<RunKeys, Reported> {
    let after = table.optional("after", Text);
    let set = read_settings(table);
    let chosen = table.optional("variants", List::of(Text));
    let after = match after? {
        None => None,
        Some(name) => {
            let is_run = |data: &&FigureData| matches!(data.experiment, Experiment::Runs(_));
            let known: Vec<&str> = before.iter().filter(is_run).map(|data| data.name.as_str()).collect();
            let position = before.iter().position(|data| data.name == name && is_run(&data));
            // It may be the one that has mistakes of its own.
            let missing = || {
                failure.unwrap_or_else(|| {
                    let found = format!("no run above is called `{name}`");
                    let known = if known.is_empty() { "there is none".to_owned() } else { known.join(", ") };
                    let expected = format!("the name of a run that stands before this one ({known})");
                    table.refuse("after", Problem::rule(found, expected))
                })
            };
            Some(position.ok_or_else(missing)?)
        }
    };
    let parent = after.and_then(|after| match &before.get(after)?.experiment {
        Experiment::Runs(runs) => Some(runs.planned.iter().map(|run| run.variant).collect()),
        _ => None,
    });
    let possible: Vec<usize> = parent.unwrap_or_else(|| (0..variants.len()).collect());
    let variants = match chosen? {
        None => possible,
        Some(names) => {
            let find = |name: &String| {
                let found = possible
                    .iter()
                    .copied()
                    .find(|number| variants.get(*number).is_some_and(|one| one.name == *name));
                found.ok_or_else(|| {
                    let known: Vec<&str> = possible
                        .iter()
                        .filter_map(|number| Some(variants.get(*number)?.name.as_str()))
                        .collect();
                    table.refuse("variants", Problem::unknown_choice(name, &known))
                })
            };
            names.iter().map(find).collect::<Result<_, _>>()?
        }
    };
    Ok(RunKeys { after, set: set?, variants })
}

/// Refuses keys of runs beside other scenarios, starts that do not fit, and collisions that have no exact method.
fn fits(table: &TableReader<'_>, keys: &RunKeys, experiment: &Experiment) -> Result<(), Reported> {
    match experiment {
        Experiment::Runs(runs) => {
            let starts = runs.planned.iter().any(|run| run.scenario.start_from.is_some());
            if keys.after.is_some() && !starts {
                let expected = "a scenario that starts from another run, or no `after`";
                let problem = Problem::rule("the scenario has no `start_from`", expected);
                return Err(table.refuse("after", problem));
            }
            Ok(())
        }
        _ if keys.after.is_some() || !keys.set.is_empty() => {
            let key = if keys.after.is_some() { "after" } else { "set" };
            Err(table.refuse(key, Problem::rule("no scenario of `pulvis run`", "a file with [[stages]]")))
        }
        Experiment::Collisions(scenario) if !scenario.cases.iter().all(has_exact_method) => {
            let found = "oblique collisions, and laws that relax with time, have no exact method";
            Err(table.refuse("file", Problem::rule(found, "head-on collisions under other laws")))
        }
        _ => Ok(()),
    }
}

fn has_exact_method(case: &CollisionCase) -> bool {
    case.incidence.is_none() && !case.contact.normal.depends_on_time()
}

fn load(
    path: &std::path::Path,
    keys: &RunKeys,
    before: &[FigureData],
    variants: &[Variant],
) -> Result<(String, Experiment), InputErrors> {
    let document = Document::load(path)?;
    let text = document.text().to_owned();
    // Which of the three it is, its tables say. What is neither gets the messages of a collision, which names them.
    let experiment = if document.has("stages") {
        let folder = path.parent().unwrap_or(std::path::Path::new(""));
        if let (Some((_, place)), None) = (document.start_from(folder)?, keys.after) {
            let expected = "`after` in its [[data]], with the name of that run";
            return Err(document
                .error_at(&place, Problem::rule("it starts from another run", expected))
                .into());
        }
        let parent = keys.after.and_then(|after| match &before.get(after)?.experiment {
            Experiment::Runs(runs) => Some(runs),
            _ => None,
        });
        let chosen: Vec<_> =
            keys.variants.iter().filter_map(|number| Some((*number, variants.get(*number)?))).collect();
        let planned = plan(&document, path, &keys.set, &chosen, parent)?;
        Experiment::Runs(Runs { after: keys.after, set: keys.set.clone(), planned })
    } else if document.has("probe") {
        Experiment::Probe(Box::new(ProbeScenario::from_document(&document)?))
    } else {
        Experiment::Collisions(Box::new(CollisionScenario::from_document(&document)?))
    };
    Ok((text, experiment))
}

/// The data that a table names; without a name the only one.
pub(super) fn chosen(table: &mut TableReader<'_>, data: &[FigureData]) -> Result<usize, Reported> {
    let known: Vec<&str> = data.iter().map(|data| data.name.as_str()).collect();
    match (table.optional("data", Text)?, data) {
        (None, [_]) => Ok(0),
        (None, _) => {
            let expected = format!("the name of one of the [[data]]: {}", known.join(", "));
            Err(table.refuse("data", Problem::MissingKey { key: "data".to_owned(), expected }))
        }
        (Some(name), data) => data
            .iter()
            .position(|data| data.name == name)
            .ok_or_else(|| table.refuse("data", Problem::unknown_choice(&name, &known))),
    }
}

/// The contact of some data that a table names.
pub(super) fn contact(table: &mut TableReader<'_>, data: &FigureData) -> Result<Option<usize>, Reported> {
    let Some(label) = table.optional("contact", Text)? else { return Ok(None) };
    let known = data.contacts();
    let position = known.iter().position(|known| *known == label);
    position.map(Some).ok_or_else(|| table.refuse("contact", Problem::unknown_choice(&label, &known)))
}
