//! Many figures, on all processors.

use super::{Reproduction, ReproductionError, reproduce};
use pulvis_input::figure::FigureScenario;
use std::num::NonZero;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::Instant;

/// A figure that was computed, or why it could not be.
#[derive(Debug)]
pub struct Attempt {
    /// The figure.
    pub figure: FigureScenario,
    /// What came of it.
    pub outcome: Result<Reproduction, ReproductionError>,
    /// Time that it took, pictures included [s].
    pub duration: f64,
}

impl Attempt {
    /// Whether it was computed and fulfils all its checks.
    pub fn passes(&self) -> bool {
        self.outcome.as_ref().is_ok_and(Reproduction::passes)
    }
}

/// Computes figures and writes picture, with `dpi` pixels to the inch, and table of each into `folder`, which exists. A figure that fails does not stop the
/// others. `done` is told of each figure that is finished. Figures that have not begun when `stop` is set are left out.
pub fn run_all(
    figures: Vec<FigureScenario>,
    (folder, dpi): (&Path, u32),
    stop: &AtomicBool,
    done: &mut dyn FnMut(&Attempt),
) -> Vec<Attempt> {
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get).min(figures.len());
    let next = AtomicUsize::new(0);
    let mut attempts: Vec<(usize, Attempt)> = Vec::with_capacity(figures.len());
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..threads {
            let (sender, next, figures) = (sender.clone(), &next, &figures);
            scope.spawn(move || {
                while !stop.load(Ordering::Relaxed) {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(figure) = figures.get(number) else { break };
                    // Nobody listens any more only if the receiving side is gone, and then nothing matters.
                    let _ = sender.send((number, attempt(figure, folder, dpi)));
                }
            });
        }
        drop(sender);
        for (number, attempt) in receiver {
            done(&attempt);
            attempts.push((number, attempt));
        }
    });
    attempts.sort_by_key(|(number, _)| *number);
    attempts.into_iter().map(|(_, attempt)| attempt).collect()
}

fn attempt(figure: &FigureScenario, folder: &Path, dpi: u32) -> Attempt {
    let start = Instant::now();
    let outcome = reproduce(figure).and_then(|reproduction| {
        let file = |ending: &str| folder.join(format!("{}.{ending}", figure.name));
        reproduction.picture.clone().dpi(dpi).write(&file("png"))?;
        reproduction.picture.write(&file("svg"))?;
        reproduction.table.write(&file("csv"))?;
        Ok(reproduction)
    });
    Attempt { figure: figure.clone(), outcome, duration: start.elapsed().as_secs_f64() }
}
