//! What a study says on its way: a bar over all runs in a terminal; elsewhere, a line for each run.

use std::io::{IsTerminal, Write as _};
use std::sync::{Mutex, PoisonError};

use indicatif::{ProgressBar, ProgressStyle};
use pulvis_input::study::Study;
use pulvis_lab::study::{Status, StudyRun, Told};

/// Parts of the bar that one run fills.
const PARTS: f64 = 1000.0;

/// The progress of a study on the standard error stream.
pub struct StudyProgress<'s> {
    study: &'s Study,
    bar: Option<ProgressBar>,
    quiet: bool,
    state: Mutex<State>,
}

struct State {
    /// How far each run has come, from 0 to 1.
    fractions: Vec<f64>,
    ended: usize,
}

impl<'s> StudyProgress<'s> {
    pub fn new(study: &'s Study, runs: usize, quiet: bool) -> Self {
        let bar = (!quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new((PARTS * runs as f64) as u64);
            // The template is a constant; without it the bar shows less.
            if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}, {elapsed}, {eta} left") {
                bar.set_style(style);
            }
            bar.set_message(format!("0 of {runs} runs"));
            bar
        });
        Self { study, bar, quiet, state: Mutex::new(State { fractions: vec![0.0; runs], ended: 0 }) }
    }

    pub fn tell(&self, told: &Told<'_>) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let (number, fraction) = match told {
            Told::Progress { run, fraction } => (*run, *fraction),
            Told::Ended { run, .. } => (*run, 1.0),
        };
        if let Some(slot) = state.fractions.get_mut(number) {
            *slot = fraction;
        }
        if let Told::Ended { result, .. } = told {
            state.ended += 1;
            let line = self.describe(state.ended, state.fractions.len(), result);
            match &self.bar {
                Some(bar) => bar.println(line),
                // What fails is told in any case. Nobody is left to be told if the stream is closed.
                None if !self.quiet || matches!(result.status, Status::Failed(_)) => {
                    let _ = writeln!(std::io::stderr(), "{line}");
                }
                None => {}
            }
        }
        if let Some(bar) = &self.bar {
            bar.set_position((PARTS * state.fractions.iter().sum::<f64>()) as u64);
            bar.set_message(format!("{} of {} runs", state.ended, state.fractions.len()));
        }
    }

    pub fn close(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    /// One line on a run that has ended.
    fn describe(&self, number: usize, runs: usize, run: &StudyRun) -> String {
        let point = self.study.points.get(run.point).map_or("", |point| point.name.as_str());
        let state = match &run.status {
            Status::Complete if run.was_there => "was there".to_owned(),
            Status::Failed(message) => format!("failed: {message}"),
            status => format!("{} ({:.1} s)", status.word(), run.duration),
        };
        format!("[{number}/{runs}] {point} seed {}: {state}", run.seed)
    }
}
