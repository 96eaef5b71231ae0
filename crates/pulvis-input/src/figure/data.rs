//! What a figure computes: scenarios beside its file.

use super::Surroundings;
use super::quantity::limited_pair;
use crate::collision::{CollisionCase, CollisionScenario, luding_pair};
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
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
        }
    }

    /// What its contacts are called.
    pub fn contacts(&self) -> Vec<&str> {
        match &self.experiment {
            Experiment::Collisions(scenario) => scenario.labels.iter().map(String::as_str).collect(),
            Experiment::Probe(scenario) => {
                scenario.contacts.iter().map(|contact| contact.label.as_str()).collect()
            }
        }
    }
}

/// Reads all `[[data]]`.
pub(super) fn read_data(
    root: &mut TableReader<'_>,
    around: &Surroundings<'_>,
) -> Result<Vec<FigureData>, Reported> {
    let tables = root.tables("data")?;
    if tables.is_empty() {
        let expected = "one table [[data]] for each scenario that the figure needs".to_owned();
        return Err(root.refuse("data", Problem::MissingKey { key: "data".to_owned(), expected }));
    }
    let mut all: Vec<Result<FigureData, Reported>> = Vec::new();
    for table in tables {
        let before: Vec<String> = all.iter().flatten().map(|data| data.name.clone()).collect();
        all.push(read_one(table, &before, around));
    }
    all.into_iter().collect()
}

fn read_one(
    mut table: TableReader<'_>,
    before: &[String],
    around: &Surroundings<'_>,
) -> Result<FigureData, Reported> {
    let file = table.required("file", Text);
    let name = table.optional("name", Text);
    let (file, name) = (file?, name?);
    let path = around.folder.join(&file);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = name.unwrap_or(stem);
    if before.contains(&name) {
        let key = if table.value("name").is_some() { "name" } else { "file" };
        return Err(table.refuse(
            key,
            Problem::rule(format!("two [[data]] are called `{name}`"), "a `name` of its own for each"),
        ));
    }
    let loaded = load(&path).map_err(|errors| {
        let mistakes = errors.errors().len() + errors.omitted();
        around.elsewhere.borrow_mut().extend(errors.into_errors());
        let found = format!("`{file}` has {mistakes} mistake{}", if mistakes == 1 { "" } else { "s" });
        table.refuse("file", Problem::rule(found, "a scenario of `pulvis collide` or `pulvis probe`"))
    });
    let loaded = loaded.and_then(|(text, experiment)| match &experiment {
        Experiment::Collisions(scenario) if !scenario.cases.iter().all(has_exact_method) => {
            let found = "oblique collisions, and laws that relax with time, have no exact method";
            Err(table.refuse("file", Problem::rule(found, "head-on collisions under other laws")))
        }
        _ => Ok((text, experiment)),
    });
    table.finish();
    let (text, experiment) = loaded?;
    Ok(FigureData { name, file: path, text, experiment })
}

fn has_exact_method(case: &CollisionCase) -> bool {
    case.incidence.is_none() && !case.contact.normal.depends_on_time()
}

fn load(path: &std::path::Path) -> Result<(String, Experiment), InputErrors> {
    let document = Document::load(path)?;
    let text = document.text().to_owned();
    // Which of the two it is, its tables say. What is neither gets the messages of a collision, which names them.
    let experiment = if document.has("probe") {
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
