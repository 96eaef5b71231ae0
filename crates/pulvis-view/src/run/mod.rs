//! The frames of a run, its time series and its files.

mod files;
mod frame;
mod particle;
mod series;

use crate::ViewError;
use crate::message::{Answer, Question};
use pulvis_input::scenario::Scenario;
use pulvis_io::IoError;
use pulvis_io::vtk::{Entry, Frame, read_frame, read_series};
use serde_json::{Value, json};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

pub(crate) use frame::{column_names, scalars};

/// The index of frames in the folder of a run.
const INDEX: &str = "series.pvd";

/// The record of a run.
const RECORD: &str = "run.toml";

/// The description of all columns of a run.
const FIELDS: &str = "fields.json";

/// Frames that are kept in memory: the one that is shown, and those around it.
const KEPT: usize = 4;

/// The folder of a run.
#[derive(Debug)]
pub(crate) struct Run {
    folder: PathBuf,
    /// Frames that were read last, by their files.
    kept: Mutex<Vec<(PathBuf, Arc<Frame>)>>,
}

impl Run {
    /// # Errors
    /// There is no run.
    pub(crate) fn open(folder: &Path) -> Result<Self, ViewError> {
        if folder.is_file() {
            return Err(ViewError::NoFolder(folder.to_owned()));
        }
        // Links are followed once and for all: files are compared with where the folder really is.
        let Ok(real) = folder.canonicalize() else { return Err(ViewError::Nothing(folder.to_owned())) };
        if !real.join(INDEX).is_file() && !real.join(RECORD).is_file() {
            return Err(ViewError::NoRun(folder.to_owned()));
        }
        Ok(Self { folder: real, kept: Mutex::default() })
    }

    /// Time and file of all frames so far.
    ///
    /// # Errors
    /// The index cannot be read.
    pub(crate) fn entries(&self) -> Result<Vec<Entry>, IoError> {
        let index = self.folder.join(INDEX);
        if index.is_file() { read_series(&index) } else { Ok(Vec::new()) }
    }

    /// A frame by its number; `None` where there is none, or where its file lies elsewhere.
    pub(crate) fn frame(&self, number: usize) -> Result<Option<(f64, Arc<Frame>)>, IoError> {
        let Some(Entry { time, file }) = self.entries()?.into_iter().nth(number) else { return Ok(None) };
        let Some(path) = files::inside(&self.folder, &file) else { return Ok(None) };
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, frame)) = kept.iter().find(|(known, _)| *known == path) {
            return Ok(Some((time, Arc::clone(frame))));
        }
        // Reading holds the lock: the same frame is not read twice at a time.
        let frame = Arc::new(read_frame(&path)?);
        if kept.len() >= KEPT {
            kept.remove(0);
        }
        kept.push((path, Arc::clone(&frame)));
        Ok(Some((time, frame)))
    }

    /// What the run was, where its record can be read.
    pub(crate) fn scenario(&self) -> Option<Scenario> {
        let text = std::fs::read_to_string(self.folder.join(RECORD)).ok()?;
        pulvis_lab::protocol::scenario_from_text(RECORD, &text).ok()
    }

    /// Title, times of frames, names of materials and walls, and what stands in each column.
    pub(crate) fn summary(&self) -> Result<Value, IoError> {
        let times: Vec<f64> = self.entries()?.iter().map(|entry| entry.time).collect();
        let scenario = self.scenario();
        let names = |of: fn(&Scenario) -> Vec<&str>| scenario.as_ref().map(of).unwrap_or_default();
        let fields = std::fs::read_to_string(self.folder.join(FIELDS)).ok();
        let fields: Value =
            fields.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_else(|| json!([]));
        Ok(json!({
            "title": scenario.as_ref().and_then(|scenario| scenario.title.clone()),
            "folder": self.folder.file_name().map(|name| name.to_string_lossy()),
            "times": times,
            "materials": names(|scenario| scenario.materials.iter().map(|one| one.name.as_str()).collect()),
            "walls": names(|scenario| scenario.walls.iter().map(|one| one.name.as_str()).collect()),
            "fields": fields,
            "alarm": std::fs::read_to_string(self.folder.join("alarm.txt")).ok(),
        }))
    }

    /// The time series, whole lines only.
    pub(crate) fn series(&self) -> Option<series::Series> {
        series::Series::read(&self.folder.join("timeseries.csv"))
    }

    /// A file of the run by its name, as sent.
    pub(crate) fn file(&self, name: &str) -> Answer {
        files::answer(&self.folder, name)
    }
}

/// Whether a name leads down only.
fn leads_down(name: &str) -> bool {
    let mut components = Path::new(name).components().peekable();
    components.peek().is_some() && components.all(|part| matches!(part, Component::Normal(_)))
}

/// Answers a question about the run; `None`: it is not one.
pub(crate) fn answer(name: &str, question: &Question, run: Option<&Run>) -> Option<Answer> {
    if question.method != "GET" {
        return None;
    }
    let Some(run) = run else {
        // The page asks what there is to be shown.
        return (name == "run").then(|| Answer::json(&Value::Null));
    };
    let number = || question.parameter("number").and_then(|text| text.parse::<usize>().ok());
    let row = || question.parameter("row").and_then(|text| text.parse::<usize>().ok());
    let outcome = match name {
        "run" => run.summary().map(|value| Some(Answer::json(&value))),
        "frame" => with_frame(run, number(), |time, frame| {
            let column = question.parameter("column");
            Some(Answer::of("application/octet-stream", frame::particles(time, frame, column.as_deref())?))
        }),
        "contacts" => with_frame(run, number(), |_, frame| {
            Some(Answer::of("application/octet-stream", frame::contacts(frame)))
        }),
        "particle" => {
            with_frame(run, number(), |_, frame| Some(Answer::json(&particle::values(frame, row()?)?)))
        }
        "series" => Ok(run.series().map(|series| {
            let columns = question.parameter("columns").unwrap_or_default();
            Answer::json(&series.columns(columns.split(',')))
        })),
        _ => return None,
    };
    match outcome {
        Ok(answer) => {
            answer.or_else(|| Some(Answer::refused(404, "the run has no such frame, column or particle")))
        }
        Err(error) => Some(Answer::refused(500, error.to_string())),
    }
}

fn with_frame(
    run: &Run,
    number: Option<usize>,
    answer: impl FnOnce(f64, &Frame) -> Option<Answer>,
) -> Result<Option<Answer>, IoError> {
    let Some(number) = number else { return Ok(None) };
    Ok(run.frame(number)?.and_then(|(time, frame)| answer(time, &frame)))
}
