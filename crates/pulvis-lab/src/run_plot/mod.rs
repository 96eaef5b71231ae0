//! Charts of the time series of a run, also of one that is under way.

use std::path::{Path, PathBuf};

use pulvis_input::Problem;
use pulvis_input::figure::Expression;
use pulvis_io::plot::{Chart, Figure, Series};
use serde::Deserialize;
use thiserror::Error;

use crate::protocol::{FIELDS, RECORD, TIME_SERIES, scenario_from_text};

/// Why a chart cannot be drawn: the input is to blame.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunPlotError {
    /// There is no run.
    #[error("{} holds no run of Pulvis; name the output folder of a run", .0.display())]
    NoRun(PathBuf),
    /// Its time series cannot be read.
    #[error("{}: {reason}", .file.display())]
    TimeSeries {
        /// The file.
        file: PathBuf,
        /// Why not.
        reason: String,
    },
    /// A quantity that it does not have.
    #[error("{}: {problem}", .file.display())]
    Column {
        /// The file.
        file: PathBuf,
        /// The name, and those there are.
        problem: Box<Problem>,
    },
    /// A formula that is none.
    #[error("`{text}` {reason}")]
    Formula {
        /// The formula.
        text: String,
        /// What is wrong.
        reason: String,
    },
    /// A stage that the run does not have.
    #[error("there is no stage {found}; expected a number from 1 to {count}, or one of: {names}")]
    Stage {
        /// What was asked for.
        found: String,
        /// Number of stages.
        count: usize,
        /// Their names.
        names: String,
    },
}

/// What is drawn.
#[derive(Clone, Debug, Default)]
pub struct RunPlot {
    /// Columns, or formulas of columns; those of one unit share a chart.
    pub quantities: Vec<String>,
    /// The abscissa; the time where `None`.
    pub abscissa: Option<String>,
    /// Number or name of a stage; `None`: all.
    pub stage: Option<String>,
    /// Whether the axes are logarithmic.
    pub logarithmic: [bool; 2],
}

/// What is drawn unless told otherwise.
const DEFAULT: [&str; 3] = ["kinetic", "elastic", "dissipated"];

/// The time series of a run.
#[derive(Clone, Debug)]
pub struct RunSeries {
    file: PathBuf,
    title: String,
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
    /// Meaning and unit of each column.
    descriptions: Vec<(String, String)>,
    stages: Vec<String>,
}

/// Quantities of one unit, each with its values.
type Group<'p> = (String, Vec<(&'p str, Vec<f64>)>);

/// A line of the file that describes all columns.
#[derive(Deserialize)]
struct Field {
    file: String,
    field: String,
    meaning: String,
    unit: String,
}

impl RunSeries {
    /// Reads the files of a run. A line that the run has not completed yet is left out.
    ///
    /// # Errors
    /// There is no run, or its time series is none.
    pub fn read(folder: &Path) -> Result<Self, RunPlotError> {
        let file = folder.join(TIME_SERIES);
        let record = std::fs::read_to_string(folder.join(RECORD)).ok();
        if record.is_none() && !file.is_file() {
            return Err(RunPlotError::NoRun(folder.to_owned()));
        }
        let failed = |reason: String| RunPlotError::TimeSeries { file: file.clone(), reason };
        let text =
            std::fs::read_to_string(&file).map_err(|error| failed(format!("cannot be read: {error}")))?;
        let mut lines = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n'));
        let columns: Vec<String> = lines.next().unwrap_or_default().split(',').map(str::to_owned).collect();
        let row = |(line, number): (&str, usize)| {
            let cells: Option<Vec<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
            let whole = cells.filter(|cells| cells.len() == columns.len());
            whole.ok_or_else(|| failed(format!("line {number} does not hold {} numbers", columns.len())))
        };
        let rows = lines.zip(2..).map(row).collect::<Result<Vec<_>, _>>()?;
        let fields = std::fs::read_to_string(folder.join(FIELDS)).ok();
        let fields: Vec<Field> = fields.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
        let of_series: Vec<&Field> = fields.iter().filter(|field| field.file == TIME_SERIES).collect();
        let describe = |column: &String| {
            let field = of_series.iter().find(|field| field.field == *column);
            field.map_or_else(Default::default, |field| (field.meaning.clone(), field.unit.clone()))
        };
        let descriptions = columns.iter().map(describe).collect();
        // Title and names of stages; a chart without them is better than none.
        let scenario = record.and_then(|text| scenario_from_text(RECORD, &text).ok());
        let stages = scenario.iter().flat_map(|scenario| &scenario.stages).map(|stage| stage.name.clone());
        let stages = stages.collect();
        let title = scenario.and_then(|scenario| scenario.title).unwrap_or_default();
        Ok(Self { file, title, columns, rows, descriptions, stages })
    }

    /// Every column with its meaning and unit.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &str, &str)> {
        let names = self.columns.iter().zip(&self.descriptions);
        names.map(|(name, (meaning, unit))| (name.as_str(), meaning.as_str(), unit.as_str()))
    }

    /// The charts, one for each unit.
    ///
    /// # Errors
    /// A quantity or stage that the run does not have.
    pub fn charts(&self, plot: &RunPlot) -> Result<Vec<Chart>, RunPlotError> {
        let wanted: Vec<&str> = match &plot.quantities[..] {
            [] => DEFAULT.into_iter().filter(|name| self.columns.iter().any(|own| own == name)).collect(),
            names => names.iter().map(String::as_str).collect(),
        };
        let abscissa = plot.abscissa.as_deref().unwrap_or("time");
        let stage = plot.stage.as_deref().map(|stage| self.stage(stage)).transpose()?;
        let x = self.values(abscissa)?;
        let mut groups: Vec<Group<'_>> = Vec::new();
        for name in wanted {
            let (values, unit) = (self.values(name)?, self.unit(name));
            match groups.iter_mut().find(|(known, _)| *known == unit) {
                Some((_, group)) => group.push((name, values)),
                None => groups.push((unit, vec![(name, values)])),
            }
        }
        let stages = self.values("stage")?;
        let keep = |row: &usize| stage.is_none_or(|stage| stages[*row] == stage as f64);
        let kept: Vec<usize> = (0..self.rows.len()).filter(keep).collect();
        let chart = |(unit, group): &Group<'_>| {
            let mut chart = self.frame(abscissa, &kept, stage.is_none(), &stages, &x);
            chart = match &group[..] {
                [(name, _)] => chart.y_label(with_unit(name, unit)),
                _ => chart.y_label(with_unit("", unit)),
            };
            chart = if plot.logarithmic[0] { chart.log_x() } else { chart };
            chart = if plot.logarithmic[1] { chart.log_y() } else { chart };
            for (name, values) in group {
                let label = if group.len() > 1 { *name } else { "" };
                chart = chart.series(Series::line(label, kept.iter().map(|&row| (x[row], values[row]))));
            }
            chart
        };
        Ok(groups.iter().map(chart).collect())
    }

    /// The charts in one picture.
    ///
    /// # Errors
    /// As of [`Self::charts`].
    pub fn figure(&self, plot: &RunPlot) -> Result<Figure, RunPlotError> {
        let figure = Figure::new().title(self.title.clone());
        Ok(self.charts(plot)?.into_iter().fold(figure, Figure::panel))
    }

    /// A chart without curves; over the time, stages are marked.
    fn frame(&self, abscissa: &str, kept: &[usize], all: bool, stages: &[f64], x: &[f64]) -> Chart {
        let mut chart = Chart::new("").x_label(with_unit(abscissa, &self.unit(abscissa)));
        if !all || abscissa != "time" {
            return chart;
        }
        let mut before = f64::NAN;
        for &row in kept {
            if stages[row] != before {
                before = stages[row];
                let name = (before as usize).checked_sub(1).and_then(|index| self.stages.get(index));
                chart = chart.section(x[row], name.map_or("", String::as_str));
            }
        }
        chart
    }

    fn unit(&self, name: &str) -> String {
        let place = self.columns.iter().position(|column| column == name);
        place.map_or(String::new(), |place| self.descriptions[place].1.clone())
    }

    /// The number of a stage, from 1.
    fn stage(&self, wanted: &str) -> Result<usize, RunPlotError> {
        let number = self.stages.iter().position(|name| name == wanted).map(|index| index + 1);
        let number =
            number.or_else(|| wanted.parse().ok().filter(|number| (1..=self.stages.len()).contains(number)));
        number.ok_or_else(|| RunPlotError::Stage {
            found: wanted.to_owned(),
            count: self.stages.len(),
            names: self.stages.join(", "),
        })
    }

    /// The values of a column, or of a formula of columns, in all rows.
    fn values(&self, text: &str) -> Result<Vec<f64>, RunPlotError> {
        if let Some(place) = self.columns.iter().position(|column| column == text) {
            return Ok(self.rows.iter().map(|row| row[place]).collect());
        }
        let formula = Expression::parse(text)
            .map_err(|reason| RunPlotError::Formula { text: text.to_owned(), reason })?;
        let mut places = Vec::new();
        for name in formula.columns() {
            let known: Vec<&str> = self.columns.iter().map(String::as_str).collect();
            let place = self.columns.iter().position(|column| column == name);
            places.push(place.ok_or_else(|| RunPlotError::Column {
                file: self.file.clone(),
                problem: Box::new(Problem::unknown_choice(name, &known)),
            })?);
        }
        let Some(first) = self.rows.first() else { return Ok(Vec::new()) };
        let value =
            |row: &Vec<f64>| formula.value(&|number| row[places[number]], &|number| first[places[number]]);
        Ok(self.rows.iter().map(value).collect())
    }
}

fn with_unit(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]").trim_start().to_owned(),
    }
}
