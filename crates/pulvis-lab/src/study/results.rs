//! What came of the runs of a study: means, standard errors, verdicts.

use pulvis_input::study::{Expected, Study};
use pulvis_io::report::Verdict;
use std::path::PathBuf;

/// How far a run has come.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// To its end.
    Complete,
    /// It was stopped by what is said.
    Failed(String),
    /// The user has stopped it; it can go on.
    Interrupted,
    /// It has not begun.
    Waiting,
}

impl Status {
    /// In a word.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Failed(_) => "failed",
            Self::Interrupted => "interrupted",
            Self::Waiting => "waiting",
        }
    }
}

/// A run of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyRun {
    /// The index of its point.
    pub point: usize,
    /// Its seed.
    pub seed: u64,
    /// Its folder, relative to that of the study.
    pub folder: PathBuf,
    /// How far it has come.
    pub status: Status,
    /// Every measure, where it is complete.
    pub values: Vec<f64>,
    /// Wall-clock time of this call [s].
    pub duration: f64,
    /// Whether it was complete before.
    pub was_there: bool,
}

/// A measure over the runs of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointResult {
    /// Runs that are complete.
    pub runs: usize,
    /// Runs that have failed.
    pub failed: usize,
    /// Runs that have not ended.
    pub open: usize,
    /// Their mean; not a number without any.
    pub mean: f64,
    /// The standard error of the mean, spread/√runs; `None` for a single run.
    pub standard_error: Option<f64>,
    /// The standard deviation between runs, with the divisor runs − 1; `None` for a single run.
    pub spread: Option<f64>,
    /// By how much the mean may differ from what is expected, where something is and it can be judged.
    pub allowed: Option<f64>,
    /// How it has turned out; `None` where nothing is expected.
    pub verdict: Option<Verdict>,
}

impl PointResult {
    /// The values of one measure in the runs of a point, which has so many seeds.
    fn of(runs: &[(&StudyRun, Option<f64>)], expected: Option<(&Expected, f64)>) -> Self {
        let values: Vec<f64> = runs.iter().filter_map(|(_, value)| *value).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let spread = (values.len() > 1).then(|| (squares / (count - 1.0)).sqrt());
        let failed = runs.iter().filter(|(run, _)| matches!(run.status, Status::Failed(_))).count();
        let mut result = Self {
            runs: values.len(),
            failed,
            open: runs.len() - values.len() - failed,
            mean,
            standard_error: spread.map(|spread| spread / count.sqrt()),
            spread,
            allowed: None,
            verdict: None,
        };
        result.judge(runs.len(), expected);
        result
    }

    /// |mean − value| ≤ tolerance + 2 standard errors, where there are several seeds.
    fn judge(&mut self, seeds: usize, expected: Option<(&Expected, f64)>) {
        let can_be_judged = self.open == 0 && self.mean.is_finite() && (self.runs > 1 || seeds == 1);
        self.verdict = match expected {
            None if self.mean.is_finite() => None,
            None => Some(Verdict::Failed),
            Some(_) if !can_be_judged => Some(Verdict::Failed),
            Some((expected, value)) => {
                let allowed = expected.tolerance + 2.0 * self.standard_error.unwrap_or(0.0);
                self.allowed = Some(allowed);
                let passes = (self.mean - value).abs() <= allowed;
                Some(if passes { Verdict::Passed } else { Verdict::Missed })
            }
        };
    }
}

/// What came of a study.
#[derive(Clone, Debug)]
pub struct StudyResults {
    /// Every run, point by point.
    pub runs: Vec<StudyRun>,
    /// Every measure at every point.
    pub points: Vec<Vec<PointResult>>,
}

impl StudyResults {
    /// Takes the runs together.
    pub(super) fn new(study: &Study, runs: Vec<StudyRun>) -> Self {
        let of_point = |point: usize| {
            let own: Vec<&StudyRun> = runs.iter().filter(|run| run.point == point).collect();
            let of_measure = |number: usize| {
                let value = |run: &&StudyRun| {
                    run.values.get(number).copied().filter(|_| run.status == Status::Complete)
                };
                let own: Vec<(&StudyRun, Option<f64>)> = own.iter().map(|run| (*run, value(run))).collect();
                let expected = study.measures.get(number).and_then(|measure| measure.expected.as_ref());
                PointResult::of(
                    &own,
                    expected.and_then(|expected| Some((expected, *expected.values.get(point)?))),
                )
            };
            (0..study.measures.len()).map(of_measure).collect()
        };
        let points = (0..study.points.len()).map(of_point).collect();
        Self { runs, points }
    }

    /// How many runs are in a state of this word.
    pub fn count(&self, word: &str) -> usize {
        self.runs.iter().filter(|run| run.status.word() == word).count()
    }

    /// Whether the user has stopped the study.
    pub fn interrupted(&self) -> bool {
        self.runs.iter().any(|run| matches!(run.status, Status::Interrupted | Status::Waiting))
    }

    /// How many means have this verdict.
    pub fn verdicts(&self, verdict: Verdict) -> usize {
        self.points.iter().flatten().filter(|result| result.verdict == Some(verdict)).count()
    }

    /// Whether all runs are complete and all means are numbers, as they are expected to be.
    pub fn passes(&self) -> bool {
        let good = |result: &PointResult| matches!(result.verdict, None | Some(Verdict::Passed));
        self.count(Status::Complete.word()) == self.runs.len() && self.points.iter().flatten().all(good)
    }

    /// The verdict on one measure over all points; `None` where nothing is wrong and nothing expected.
    pub fn verdict_of(&self, measure: usize) -> Option<Verdict> {
        let all: Vec<Option<Verdict>> = self
            .points
            .iter()
            .map(|results| results.get(measure).and_then(|result| result.verdict))
            .collect();
        [Verdict::Failed, Verdict::Missed, Verdict::Passed]
            .into_iter()
            .find(|verdict| all.contains(&Some(*verdict)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(status: Status) -> StudyRun {
        StudyRun {
            point: 0,
            seed: 0,
            folder: PathBuf::new(),
            status,
            values: Vec::new(),
            duration: 0.0,
            was_there: false,
        }
    }

    fn result(values: &[f64], failed: usize, expected: Option<(f64, f64)>) -> PointResult {
        let (complete, bad) = (run(Status::Complete), run(Status::Failed(String::new())));
        let good = values.iter().map(|value| (&complete, Some(*value)));
        let all: Vec<_> = good.chain((0..failed).map(|_| (&bad, None))).collect();
        let bound = expected.map(|(value, tolerance)| {
            (Expected { values: vec![value], tolerance, source: String::new(), certainty: None }, value)
        });
        PointResult::of(&all, bound.as_ref().map(|(expected, value)| (expected, *value)))
    }

    #[test]
    fn the_standard_error_is_the_spread_over_the_root_of_the_number_of_runs() {
        // Mean 5, squares 9 + 1 + 1 + 9 = 20: spread √(20/3), standard error √(20/12).
        let result = result(&[2.0, 4.0, 6.0, 8.0], 0, None);
        assert!((result.mean - 5.0).abs() < 1e-15);
        assert!(result.spread.is_some_and(|spread| (spread * spread - 20.0 / 3.0).abs() < 1e-14));
        assert!(result.standard_error.is_some_and(|error| (error * error - 20.0 / 12.0).abs() < 1e-14));
        assert_eq!((result.runs, result.verdict), (4, None));
    }

    #[test]
    fn a_mean_passes_within_tolerance_and_two_standard_errors_and_not_beyond() {
        // Two standard errors are √(20/3) = 2.582.
        let verdict =
            |value: f64, tolerance| result(&[2.0, 4.0, 6.0, 8.0], 0, Some((value, tolerance))).verdict;
        assert_eq!(verdict(7.58, 0.0), Some(Verdict::Passed));
        assert_eq!(verdict(7.59, 0.0), Some(Verdict::Missed));
        assert_eq!(verdict(8.0, 0.42), Some(Verdict::Passed));
        assert_eq!(verdict(2.0, 0.41), Some(Verdict::Missed));
    }

    #[test]
    fn one_seed_is_judged_by_the_tolerance_alone_and_one_survivor_of_several_not_at_all() {
        assert_eq!(result(&[1.0], 0, Some((1.05, 0.1))).verdict, Some(Verdict::Passed));
        assert_eq!(result(&[1.0], 0, Some((1.2, 0.1))).verdict, Some(Verdict::Missed));
        assert_eq!(result(&[1.0], 3, Some((1.05, 0.1))).verdict, Some(Verdict::Failed));
        let survivors = result(&[1.0, 1.0], 2, Some((1.05, 0.1)));
        assert_eq!((survivors.verdict, survivors.failed), (Some(Verdict::Passed), 2));
    }

    #[test]
    fn what_is_no_number_never_looks_right() {
        assert_eq!(result(&[1.0, f64::NAN], 0, Some((1.0, 10.0))).verdict, Some(Verdict::Failed));
        assert_eq!(result(&[f64::NAN], 0, None).verdict, Some(Verdict::Failed));
        assert_eq!(result(&[], 2, None).verdict, Some(Verdict::Failed));
    }
}
