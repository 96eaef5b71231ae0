//! Scenarios that end within a second, and readers of what they write.

#![allow(dead_code)] // every test program uses a part of it

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{self, PictureOptions, Progress, RunError, RunOptions, RunSummary};
use pulvis_parallel::exchange::{Exchange, ThreadRank};

/// The small tablet with some texts replaced; each of them must be there.
pub fn tablet(changes: &[(&str, &str)]) -> Scenario {
    let mut text = include_str!("tablet.toml").to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "the scenario has no `{old}`");
        text = text.replace(old, new);
    }
    scenario(&text)
}

/// The small tablet as it stands.
pub fn small_tablet() -> Scenario {
    tablet(&[])
}

pub fn scenario(text: &str) -> Scenario {
    Scenario::from_str("test.toml", text).unwrap_or_else(|errors| panic!("{errors}"))
}

pub fn options(folder: &Path) -> RunOptions {
    RunOptions {
        folder: Some(folder.to_path_buf()),
        force: false,
        threads: Some(1),
        instructions: None,
        version: "test".to_owned(),
        pictures: PictureOptions::default(),
        exchange: None,
        warn: |_| {},
    }
}

pub fn run(scenario: &Scenario, folder: &Path) -> RunSummary {
    run_with(scenario, &options(folder), &AtomicBool::new(false), &mut |_| {}).unwrap()
}

pub fn run_with(
    scenario: &Scenario,
    options: &RunOptions,
    stop: &AtomicBool,
    watch: &mut (dyn FnMut(&Progress) + Send),
) -> Result<RunSummary, RunError> {
    protocol::run(scenario, options, stop, watch)
}

/// Runs a scenario on so many ranks, which are threads.
pub fn on_ranks(scenario: &Scenario, folder: &Path, ranks: usize) -> RunSummary {
    let mut team = ThreadRank::team(ranks).into_iter();
    let first: Arc<dyn Exchange> = Arc::new(team.next().unwrap());
    std::thread::scope(|scope| {
        for rank in team {
            scope.spawn(|| {
                let rank: Arc<dyn Exchange> = Arc::new(rank);
                let options = RunOptions { exchange: Some(Arc::clone(&rank)), ..options(folder) };
                let following = protocol::Following::Scenario(scenario);
                let followed = protocol::follow(following, &options, &rank, &AtomicBool::new(false));
                assert!(matches!(followed, Ok(protocol::Followed::ToTheEnd)), "{followed:?}");
            });
        }
        let options = RunOptions { exchange: Some(first), ..options(folder) };
        run_with(scenario, &options, &AtomicBool::new(false), &mut |_| {}).unwrap()
    })
}

/// A time series as a run has written it.
pub struct Series {
    header: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Series {
    /// Reads it; every line must be whole.
    pub fn read(folder: &Path) -> Self {
        let text = fs::read_to_string(folder.join("timeseries.csv")).unwrap();
        assert!(text.ends_with('\n'), "the last line is cut off");
        let mut lines = text.lines().map(|line| line.split(','));
        let header: Vec<String> = lines.next().unwrap().map(str::to_owned).collect();
        // An empty cell is what does not exist.
        let number = |cell: &str| if cell.is_empty() { f64::NAN } else { cell.parse().unwrap() };
        let rows: Vec<Vec<f64>> = lines.map(|line| line.map(number).collect()).collect();
        assert!(rows.iter().all(|row| row.len() == header.len()), "a line is not whole");
        Self { header, rows }
    }

    pub fn column(&self, name: &str) -> Vec<f64> {
        let place = self.header.iter().position(|column| column == name);
        let place = place.unwrap_or_else(|| panic!("no column `{name}`"));
        self.rows.iter().map(|row| row[place]).collect()
    }

    /// The values of a column in a stage, which is counted from 1.
    pub fn of_stage(&self, name: &str, stage: usize) -> Vec<f64> {
        let stages = self.column("stage");
        let column = self.column(name).into_iter().zip(stages);
        column.filter(|(_, of)| *of == stage as f64).map(|(value, _)| value).collect()
    }
}
