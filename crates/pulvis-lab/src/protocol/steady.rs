//! Whether a column of the time series is steady: the stop rule `steady`.
//!
//! ```text
//! b = Σ (x_i − x̄) (y_i − ȳ)/S,   S = Σ (x_i − x̄)²,   s_b² = Σ (y_i − ȳ − b (x_i − x̄))²/((n − 2) S)
//! ```
//!
//! y_i are the means of the last n blocks, x_i their numbers. The column is steady where the drift over all of them, |b| (n − 1), is
//! no larger than its standard error, s_b (n − 1), or than a share of |ȳ|. The share is for what comes to rest without noise:
//! of an exponential the slope is larger than its error for ever.
//!
//! # Source
//! The standard error of the slope of a straight line by least squares: any text book of statistics, for example
//! N. R. Draper and H. Smith, Applied Regression Analysis, 3rd ed. (1998), section 1.4. Means of blocks, which are longer than the time
//! over which samples are correlated, in place of samples: H. Flyvbjerg and H. G. Petersen, J. Chem. Phys. 91, 461 (1989).

use pulvis_input::Problem;
use pulvis_input::scenario::{Scenario, SteadyRule};
use serde::{Deserialize, Serialize};

use super::error::PrepareError;
use super::measure::column_names;
use super::setup::StagePlan;
use super::stage::LOOK_EVERY;

/// Looks in a block, at the least.
const LEAST_LOOKS: u64 = 10;

/// What has been seen of the column.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Steady {
    /// The block that is under way, its sum and its number of samples.
    block: u64,
    sum: f64,
    samples: u64,
    /// The means of the last blocks.
    means: Vec<f64>,
}

impl Steady {
    /// Takes in a value at a time since the start of the stage [s]. Answers whether the column is steady.
    pub(super) fn look(&mut self, rule: &SteadyRule, elapsed: f64, value: f64) -> bool {
        // Not negative: times of a stage.
        let block = (elapsed / rule.block) as u64;
        let has_ended = block > self.block;
        if has_ended {
            let most = rule.blocks as usize;
            // A block without a sample has no mean: NaN, which is not steady.
            self.means.push(self.sum / self.samples as f64);
            let surplus = self.means.len().saturating_sub(most);
            self.means.drain(..surplus);
            (self.block, self.sum, self.samples) = (block, 0.0, 0);
        }
        (self.sum, self.samples) = (self.sum + value, self.samples + 1);
        has_ended && self.means.len() == rule.blocks as usize && is_steady(&self.means, rule.tolerance)
    }
}

/// Whether means of blocks do not drift.
fn is_steady(means: &[f64], tolerance: f64) -> bool {
    let count = means.len() as f64;
    let (mean, middle) = (means.iter().sum::<f64>() / count, 0.5 * (count - 1.0));
    let points = || means.iter().enumerate().map(|(number, y)| (number as f64 - middle, y - mean));
    let spread: f64 = points().map(|(x, _)| x * x).sum();
    let slope = points().map(|(x, y)| x * y).sum::<f64>() / spread;
    let rest: f64 = points().map(|(x, y)| (y - slope * x) * (y - slope * x)).sum();
    let error = (rest / ((count - 2.0) * spread)).sqrt();
    let drift = slope.abs() * (count - 1.0);
    // Not `>`: NaN is not steady.
    drift <= error * (count - 1.0) || drift <= tolerance * mean.abs()
}

/// Refuses rules that look at no column, and blocks of few samples.
pub(super) fn check_steady(scenario: &Scenario, plans: &[StagePlan]) -> Result<(), PrepareError> {
    for (number, (stage, plan)) in scenario.stages.iter().zip(plans).enumerate() {
        let Some(rule) = &stage.until.steady else { continue };
        let mistake = |key: &str, problem: Problem, help: &str| {
            let path = format!("stages[{number}].until.steady.{key}");
            Err(scenario.mistake(&[&path], problem, help).into())
        };
        let columns = column_names(scenario);
        if !columns.contains(&rule.column) {
            let names: Vec<&str> = columns.iter().map(String::as_str).collect();
            let problem = Problem::unknown_choice(&rule.column, &names);
            return mistake("column", problem, "take a column of the time series of this scenario");
        }
        let least = (LEAST_LOOKS * LOOK_EVERY) as f64 * plan.time_step;
        if rule.block < least {
            let found = format!("{} s are {:.0} time steps", rule.block, rule.block / plan.time_step);
            let expected = format!("{} steps or more, {least:.4e} s", LEAST_LOOKS * LOOK_EVERY);
            return mistake("block", Problem::rule(found, expected), "take longer blocks");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods)] // of expected values

    use super::*;

    #[test]
    fn noise_about_a_mean_is_steady_and_a_line_or_an_exponential_is_not() {
        // Without drift by symmetry.
        assert!(is_steady(&[1.0, 1.2, 0.9, 1.2, 1.0], 0.0));
        let line: Vec<f64> = (0..8).map(|number| 1.0 + 0.1 * f64::from(number)).collect();
        assert!(!is_steady(&line, 0.5) && is_steady(&line, 0.7 / 1.35 * 1.01));
        let falling = |from: i32| -> Vec<f64> { (from..from + 6).map(|x| 1.0 + 0.5_f64.powi(x)).collect() };
        // Over six blocks from number k on it falls by about a half of 2^−k.
        assert!(
            !is_steady(&falling(0), 1e-3) && !is_steady(&falling(6), 1e-3) && is_steady(&falling(12), 1e-3)
        );
        assert!(!is_steady(&falling(12), 0.0));
        assert!(is_steady(&[2.0; 4], 0.0), "what does not change at all");
        assert!(!is_steady(&[1.0, f64::NAN, 1.0, 1.0], 1.0));
    }

    #[test]
    fn the_slope_and_its_error_are_those_of_a_worked_example() {
        // y = 1, 3, 2, 5, 4 over 0 to 4: b = 0.8, residuals −0.4, 0.8, −1, 1.2, −0.6 of 3.6 in all, s_b = √(3.6/(3 · 10)) = 0.3464.
        // 0.8 is more than twice its error; raised by tolerance: 3.2 over the mean 3.
        let means = [1.0, 3.0, 2.0, 5.0, 4.0];
        assert!(!is_steady(&means, 1.06) && is_steady(&means, 1.07));
        // y = 1, 3, 1, 3, 2: b = 0.2, residuals of 3.6 again: 0.2 is less than 0.3464.
        assert!(is_steady(&[1.0, 3.0, 1.0, 3.0, 2.0], 0.0));
    }

    #[test]
    fn only_whole_blocks_count_and_the_last_ones_alone() {
        let rule = SteadyRule { column: "kinetic".to_owned(), block: 1.0, blocks: 3, tolerance: 0.0 };
        let mut steady = Steady::default();
        let mut look = |time: f64, value: f64| steady.look(&rule, time, value);
        // A ramp for three blocks, then a constant: steady when the last three are.
        for tenth in 0..30 {
            assert!(!look(f64::from(tenth) * 0.1 + 0.05, f64::from(tenth)));
        }
        let ended: Vec<i32> = (30..70).filter(|&tenth| look(f64::from(tenth) * 0.1 + 0.05, 30.0)).collect();
        assert_eq!(ended, [60]);
    }
}
