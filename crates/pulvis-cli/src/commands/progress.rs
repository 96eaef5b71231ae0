//! What a run says on its way: one line that is written over and over in a terminal; elsewhere, a line now
//! and then and one at the end of each stage.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use pulvis_lab::protocol::{Progress, ProgressRecord};

use super::words::duration;

/// How a run says how far it has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Style {
    /// A line that is written over in a terminal, else lines
    Auto,
    /// A line of text now and then
    Lines,
    /// A line of JSON now and then
    Json,
    /// Nothing
    None,
}

/// The progress of a run on the standard error stream.
pub struct ProgressLine {
    bar: Option<ProgressBar>,
    style: Style,
    rhythm: Rhythm,
}

impl ProgressLine {
    /// `every`: time between two lines.
    pub fn new(style: Style, every: Duration) -> Self {
        let in_place = style == Style::Auto && std::io::stderr().is_terminal();
        let bar = in_place.then(|| {
            let bar = ProgressBar::new(1000);
            // The template is a constant; without it the bar shows less.
            if let Ok(style) = ProgressStyle::with_template("{bar:20} {msg}") {
                bar.set_style(style);
            }
            bar
        });
        Self { bar, style, rhythm: Rhythm::new(every, Instant::now()) }
    }

    pub fn show(&mut self, progress: &Progress) {
        let has_ended = progress.ending.is_some();
        match &self.bar {
            Some(bar) if has_ended => bar.println(describe(progress)),
            Some(bar) => {
                bar.set_position((1000.0 * progress.fraction.unwrap_or(0.0)) as u64);
                bar.set_message(describe(progress));
            }
            None if self.style != Style::None && self.rhythm.is_due(has_ended, Instant::now()) => {
                let line = match self.style {
                    Style::Json => ProgressRecord::new(progress).to_json(),
                    _ => describe(progress),
                };
                // Nobody is left to be told if the standard error stream is closed.
                let _ = writeln!(std::io::stderr(), "{line}");
            }
            None => {}
        }
    }

    pub fn close(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// When to say something again.
#[derive(Debug)]
struct Rhythm {
    every: Duration,
    last: Instant,
}

impl Rhythm {
    fn new(every: Duration, now: Instant) -> Self {
        Self { every, last: now }
    }

    /// Whether something is to be said at `now`: always what is `important`, else if nothing was for a while.
    fn is_due(&mut self, important: bool, now: Instant) -> bool {
        let due = important || now.duration_since(self.last) >= self.every;
        if due {
            self.last = now;
        }
        due
    }
}

fn describe(progress: &Progress) -> String {
    let stage = format!("[{}/{}] {}", progress.number, progress.stages, progress.stage);
    let state = match (progress.ending, progress.remaining) {
        (Some(ending), _) => format!("{} after step {}", ending.text(), progress.steps),
        (None, Some(remaining)) => {
            format!("{:.0} steps/s, {} left", progress.steps_per_second, duration(remaining))
        }
        (None, None) => format!("{:.0} steps/s", progress.steps_per_second),
    };
    format!("{stage}: t = {:.4e} s, {state}, energy error {:.1e}", progress.time, progress.energy_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_file_gets_a_line_each_half_minute_and_at_the_end_of_each_stage() {
        let start = Instant::now();
        let mut rhythm = Rhythm::new(Duration::from_secs(30), start);
        // Five calls a second over two minutes, one of which tells the end of a stage.
        let said: Vec<u64> = (1..=600)
            .filter(|&call| rhythm.is_due(call == 200, start + call * Duration::from_millis(200)))
            .map(u64::from)
            .collect();
        assert_eq!(said, [150, 200, 350, 500]);
    }
}
