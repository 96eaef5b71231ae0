//! A study: a scenario of `pulvis run` over seeds and over every combination of some values, the numbers that are taken out
//! of its runs, and what they are expected to be.
//!
//! `docs/study.md` describes the file key by key.

mod expected;
mod measures;
mod points;
mod variable;

pub use expected::Expected;
pub use measures::StudyMeasure;
pub use points::StudyPoint;
pub use variable::{StudyKey, StudyValue, StudyVariable};

use crate::context::Reported;
use crate::document::Document;
use crate::error::{InputError, InputErrors};
use crate::figure::settings::{Settings, read_settings};
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::scenario::Scenario;
use crate::shape::{Integer, Text};
use measures::read_measures;
use points::{Combined, combine};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use variable::read_variables;

/// More runs than anybody waits for; a slip of the pen should not fill the memory.
const MOST_RUNS: usize = 10_000;

/// A study as its file describes it.
#[derive(Clone, Debug)]
pub struct Study {
    /// What it is about, in one line.
    pub title: String,
    /// The file, as the user named it.
    pub file: PathBuf,
    /// The scenario.
    pub scenario: PathBuf,
    /// The text of the scenario.
    pub scenario_text: String,
    /// The seeds of each point, at least one.
    pub seeds: Vec<u64>,
    /// What differs from point to point.
    pub variables: Vec<StudyVariable>,
    /// Every combination of the values, those of the last variable first; at least one.
    pub points: Vec<StudyPoint>,
    /// The numbers that are taken out of each run.
    pub measures: Vec<StudyMeasure>,
    document: Document,
}

/// Loads a scenario's file, with what it has from the run that it starts from.
pub type LoadDocument<'l> = &'l dyn Fn(&Path) -> Result<Document, InputErrors>;

/// What the parts of a study share while it is read.
struct Surroundings<'s> {
    folder: &'s Path,
    load: LoadDocument<'s>,
    /// Mistakes in the scenario.
    elsewhere: RefCell<Vec<InputError>>,
}

impl Study {
    /// Reads a study, and its scenario at every point.
    ///
    /// # Errors
    /// All mistakes of the file, and those of the scenario with the values that cause them.
    pub fn load(file: &Path, load: LoadDocument<'_>) -> Result<Self, InputErrors> {
        Self::from_document(&Document::load(file)?, file, load)
    }

    /// As [`Self::load`], of a parsed file that stands at `file`.
    ///
    /// # Errors
    /// As of [`Self::load`].
    pub fn from_document(
        document: &Document,
        file: &Path,
        load: LoadDocument<'_>,
    ) -> Result<Self, InputErrors> {
        let folder = file.parent().unwrap_or(Path::new(""));
        let around = Surroundings { folder, load, elsewhere: RefCell::default() };
        let read = document.read(|root| walk(root, file, document, &around));
        let mut mistakes = around.elsewhere.into_inner();
        match read {
            Ok(study) if mistakes.is_empty() => Ok(study),
            Ok(_) => Err(InputErrors::in_order(mistakes)),
            // The scenario's own mistakes come first: those of the study follow from them.
            Err(errors) => {
                mistakes.extend(errors.into_errors());
                Err(InputErrors::in_order(mistakes))
            }
        }
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// A mistake that shows only after reading, at a dotted path of the study's file.
    pub fn mistake(&self, path: &str, problem: Problem, help: impl Into<String>) -> InputError {
        self.document.mistake(path, problem, help)
    }

    /// Refuses measures of columns that a time series will not have; `columns` tells those of a scenario.
    ///
    /// # Errors
    /// All measures that name such a column.
    pub fn check_columns(&self, columns: impl Fn(&Scenario) -> Vec<String>) -> Result<(), InputErrors> {
        let Some(point) = self.points.first() else { return Ok(()) };
        let known = columns(&point.scenario);
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let named = self.measures.iter().flat_map(|measure| &measure.columns);
        let unknown = named.filter(|(column, _)| !known.contains(&column.as_str()));
        let mistakes: Vec<InputError> = unknown
            .map(|(column, location)| {
                let help = "`clusters = true` and `dimensionless` in [output] of the scenario add columns";
                let problem = Problem::unknown_choice(column, &known);
                InputError { help: Some(help.to_owned()), ..self.document.error_at(location, problem) }
            })
            .collect();
        if mistakes.is_empty() { Ok(()) } else { Err(InputErrors::new(mistakes)) }
    }
}

fn walk(
    mut root: TableReader<'_>,
    file: &Path,
    document: &Document,
    around: &Surroundings<'_>,
) -> Result<Study, Reported> {
    let own = root.required_table("study").and_then(|table| read_own(table, around));
    let measures = match &own {
        Ok(own) => read_measures(&mut root, &own.combined),
        // Without a scenario nobody knows what can be measured.
        Err(reported) => root.value("measures").map_or(Err(*reported), |_| Err(*reported)),
    };
    root.finish();
    let Own { title, scenario, seeds, variables, combined } = own?;
    let Combined { points, scenario_text } = combined;
    let measures = measures?;
    let file = file.to_owned();
    let document = document.clone();
    Ok(Study { title, file, scenario, scenario_text, seeds, variables, points, measures, document })
}

/// What the table `[study]` says.
struct Own {
    title: String,
    scenario: PathBuf,
    seeds: Vec<u64>,
    variables: Vec<StudyVariable>,
    combined: Combined,
}

fn read_own(mut table: TableReader<'_>, around: &Surroundings<'_>) -> Result<Own, Reported> {
    let title = table.required("title", Text);
    let scenario = table.required("scenario", Text).map(|name| around.folder.join(name));
    let seeds = read_seeds(&mut table);
    let set = read_settings(&mut table);
    let variables = read_variables(&mut table);
    let (set, seeds, variables) = match (set, seeds, variables) {
        (Ok(set), Ok(seeds), Ok(variables)) => (set, seeds, variables),
        (Err(reported), ..) | (_, Err(reported), _) | (.., Err(reported)) => {
            table.finish();
            return Err(reported);
        }
    };
    refuse_seed_as_key(&table, &set, &variables)?;
    let counts = variables.iter().map(|variable| variable.values.len());
    let runs = counts.fold(seeds.len().max(1), usize::saturating_mul);
    if runs > MOST_RUNS {
        let problem = Problem::rule(format!("{runs} runs"), format!("at most {MOST_RUNS} in all"));
        return Err(table.refuse("over", problem));
    }
    let combined = combine(&table, &scenario?, &set, &variables, around);
    table.finish();
    let combined = combined?;
    let own_seed = combined.points.first().map(|point| point.scenario.seed);
    let seeds = if seeds.is_empty() { own_seed.into_iter().collect() } else { seeds };
    let scenario = combined.points.first().and_then(|point| point.scenario.source.path.clone());
    Ok(Own { title: title?, scenario: scenario.unwrap_or_default(), seeds, variables, combined })
}

/// The seeds; none where the scenario's own is meant.
fn read_seeds(table: &mut TableReader<'_>) -> Result<Vec<u64>, Reported> {
    let seeds = table.or("seeds", List::of(Integer::at_least(0)), Vec::new())?;
    let seeds: Vec<u64> = seeds.into_iter().map(i64::unsigned_abs).collect();
    let twice =
        seeds.iter().enumerate().find(|(index, seed)| seeds.iter().take(*index).any(|one| one == *seed));
    match twice {
        Some((_, seed)) => {
            let problem = Problem::rule(format!("the seed {seed} stands there twice"), "each seed once");
            Err(table.refuse("seeds", problem))
        }
        None => Ok(seeds),
    }
}

/// Refuses the seed as a value like others: means are over seeds.
fn refuse_seed_as_key(
    table: &TableReader<'_>,
    set: &Settings,
    variables: &[StudyVariable],
) -> Result<(), Reported> {
    let problem = || Problem::rule("the seed is no value like others", "`seeds` in [study]");
    if set.iter().any(|(key, _)| key == "seed") {
        return Err(table.refuse("set", problem()));
    }
    let of_seed = |variable: &&StudyVariable| variable.keys.iter().any(|key| key.path == "seed");
    match variables.iter().find(of_seed) {
        Some(variable) => Err(table.refuse_at(&variable.location, problem())),
        None => Ok(()),
    }
}
