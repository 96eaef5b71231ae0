//! The time series of a run that has ended.

use super::ReproductionError;
use pulvis_input::figure::{Expression, Measure, OfRun};
use pulvis_input::scenario::{Scenario, WallControl, WallMotion};
use std::path::{Path, PathBuf};

/// A run and its time series.
pub(crate) struct FinishedRun<'f> {
    /// Number of the variant.
    pub variant: usize,
    /// What the variant is called.
    pub variant_name: String,
    pub scenario: &'f Scenario,
    /// Where its files are.
    pub folder: PathBuf,
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl<'f> FinishedRun<'f> {
    /// Reads what a run has written into its folder, and computes what is `wanted` of its columns.
    pub fn read(
        (variant, variant_name): (usize, String),
        scenario: &'f Scenario,
        folder: &Path,
        wanted: &[&str],
    ) -> Result<Self, ReproductionError> {
        let file = folder.join("timeseries.csv");
        let unreadable = |reason: String| ReproductionError::TimeSeries { file: file.clone(), reason };
        let text = std::fs::read_to_string(&file).map_err(|error| unreadable(error.to_string()))?;
        let mut lines = text.lines();
        let columns: Vec<String> = lines.next().unwrap_or_default().split(',').map(str::to_owned).collect();
        let row = |(line, number): (&str, usize)| {
            let cells = line.split(',').map(|cell| cell.parse::<f64>().ok());
            let cells: Option<Vec<f64>> = cells.collect();
            cells
                .filter(|cells| cells.len() == columns.len())
                .ok_or_else(|| unreadable(format!("line {number} does not hold {} numbers", columns.len())))
        };
        let rows = lines.zip(2..).map(row).collect::<Result<_, _>>()?;
        let folder = folder.to_owned();
        let mut run = Self { variant, variant_name, scenario, folder, columns, rows };
        wanted.iter().try_for_each(|text| run.add(text))?;
        Ok(run)
    }

    /// Adds the column of a formula, unless it is there.
    fn add(&mut self, text: &str) -> Result<(), ReproductionError> {
        if self.columns.iter().any(|column| column == text) {
            return Ok(());
        }
        let formula = Expression::parse(text).map_err(|reason| ReproductionError::TimeSeries {
            file: self.folder.join("timeseries.csv"),
            reason: format!("\"{text}\" {reason}"),
        })?;
        let columns: Vec<usize> =
            formula.columns().iter().map(|name| self.column(name)).collect::<Result<_, _>>()?;
        let first = self.rows.first().cloned().unwrap_or_default();
        let of = |row: &[f64], number: usize| {
            columns.get(number).and_then(|column| row.get(*column)).copied().unwrap_or(f64::NAN)
        };
        for row in &mut self.rows {
            let value = formula.value(&|number| of(row, number), &|number| of(&first, number));
            row.push(value);
        }
        self.columns.push(text.to_owned());
        Ok(())
    }

    /// The index of a column.
    pub fn column(&self, name: &str) -> Result<usize, ReproductionError> {
        let position = self.columns.iter().position(|column| column == name);
        position.ok_or_else(|| ReproductionError::NoColumn {
            data: self.scenario.title.clone().unwrap_or_default(),
            column: name.to_owned(),
            known: self.columns.join(", "),
        })
    }

    /// The rows of a stage, all where `None`, each with its phase: the cycles that the wall has done since the stage began. It
    /// is no number where no wall goes through cycles.
    pub fn rows(&self, stage: Option<usize>) -> Vec<Phased<'_>> {
        let of_stage = self.columns.iter().position(|column| column == "stage");
        let time = self.columns.iter().position(|column| column == "time");
        let cell = |row: &[f64], column: Option<usize>| column.and_then(|column| row.get(column)).copied();
        let belongs = |row: &&Vec<f64>| {
            stage.is_none_or(|stage| cell(row, of_stage).is_some_and(|number| number == (stage + 1) as f64))
        };
        let period = stage.and_then(|stage| period(self.scenario, stage)).unwrap_or(f64::NAN);
        let own = || self.rows.iter().filter(belongs);
        let start = own().next().and_then(|row| cell(row, time)).unwrap_or(f64::NAN);
        own()
            .map(|row| Phased { row, phase: (cell(row, time).unwrap_or(f64::NAN) - start) / period })
            .collect()
    }

    /// The cycles that the wall goes through in a stage.
    pub fn cycles(&self, stage: usize) -> f64 {
        cosine(self.scenario, stage).map_or(0.0, |(_, cycles)| cycles)
    }

    /// The rows that a measure is made of.
    pub fn measured(&self, measure: &Measure) -> Result<Vec<Phased<'_>>, ReproductionError> {
        let mut rows = self.rows(measure.stage);
        if let Some([from, to]) = measure.cycles {
            rows.retain(|row| in_cycles(row.phase, from, to));
        }
        if let Some(within) = &measure.within {
            let column = self.column(&within.column)?;
            let [from, to] = within.ends;
            rows.retain(|row| (from.min(to)..=from.max(to)).contains(&row.at(column)));
        }
        Ok(rows)
    }

    /// The rows that a curve shows.
    pub fn drawn(&self, show: &OfRun) -> Vec<Phased<'_>> {
        let mut rows = self.rows(show.stage);
        if let Some([from, to]) = show.cycles {
            rows.retain(|row| in_cycles(row.phase, from, to));
        }
        rows
    }
}

/// A row and when it was written.
pub(crate) struct Phased<'r> {
    row: &'r [f64],
    /// Cycles since the stage began [1].
    pub phase: f64,
}

impl Phased<'_> {
    /// The number in a column.
    pub fn at(&self, column: usize) -> f64 {
        self.row.get(column).copied().unwrap_or(f64::NAN)
    }
}

/// Whether a phase lies in a part of the cycles; times are sums of steps, so ends have some room.
pub(super) fn in_cycles(phase: f64, from: f64, to: f64) -> bool {
    const ROOM: f64 = 1e-6;
    phase >= from - ROOM && phase <= to + ROOM
}

fn period(scenario: &Scenario, stage: usize) -> Option<f64> {
    cosine(scenario, stage).map(|(period, _)| period)
}

/// Period [s] and number of cycles of the wall that moves by a cosine in a stage.
fn cosine(scenario: &Scenario, stage: usize) -> Option<(f64, f64)> {
    scenario.stages.get(stage)?.controls.iter().find_map(|(_, control)| match control {
        WallControl::Motion(WallMotion::Cosine(motion)) => Some((motion.period, motion.cycles)),
        _ => None,
    })
}

impl<'r> Phased<'r> {
    /// A row, and the cycles since the stage began.
    pub fn new(row: &'r [f64], phase: f64) -> Self {
        Self { row, phase }
    }
}
