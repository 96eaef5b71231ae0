//! The force over the displacement of one stage of tension.

use pulvis_input::scenario::{Scenario, WallControl, WallMotion};

use super::Rows;
use crate::Outcome;

/// What a stage of tension gives.
pub(super) struct Tension {
    /// Amplitude D [d0].
    pub(super) amplitude: f64,
    /// Rows of the stage.
    pub(super) rows: Vec<usize>,
    /// Phase of each row, in cycles.
    phases: Vec<f64>,
    cycles: usize,
}

impl Tension {
    /// All stages in which a wall moves by a cosine, in the order of the run.
    pub(super) fn of_run(scenario: &Scenario, rows: &Rows) -> Outcome<Vec<Self>> {
        let scale = scenario.output.dimensionless.ok_or("the run has no [output.dimensionless]")?.length;
        let mut found = Vec::new();
        for (stage, plan) in scenario.stages.iter().enumerate() {
            let Some((_, WallControl::Motion(WallMotion::Cosine(motion)))) = plan.controls.first() else {
                continue;
            };
            let own = rows.of_stage(stage);
            let first = *own.first().ok_or_else(|| format!("the run did not come to stage {}", stage + 1))?;
            let phases = own.iter().map(|&row| (rows.time[row] - rows.time[first]) / motion.period).collect();
            // To the last digits that a scenario is written with.
            let amplitude = (1e6 * motion.displacement.x.abs() / scale).round() / 1e6;
            let cycles = motion.cycles.round();
            found.push(Self { amplitude, rows: own, phases, cycles: cycles as usize });
        }
        if found.is_empty() { Err("no stage moves a wall by a cosine".to_owned()) } else { Ok(found) }
    }

    /// Displacement and force of the rows with phases in a range.
    pub(super) fn course(&self, rows: &Rows, from: f64, to: f64) -> Vec<(f64, f64)> {
        let phased = self.rows.iter().zip(&self.phases).filter(|&(_, &phase)| phase >= from && phase <= to);
        phased.map(|(&row, _)| (rows.displacement[row], rows.force[row])).collect()
    }

    fn force_range(&self, rows: &Rows) -> f64 {
        let forces = || self.rows.iter().map(|&row| rows.force[row]);
        forces().fold(f64::NEG_INFINITY, f64::max) - forces().fold(f64::INFINITY, f64::min)
    }

    /// Stiffness −dF*/dD and R² over the middle 60 % of the first way back, by least squares.
    pub(super) fn return_branch(&self, rows: &Rows) -> (f64, f64) {
        let mut course = self.course(rows, 0.5, 1.0);
        course.retain(|(displacement, _)| (0.2..=0.8).contains(&(displacement / self.amplitude)));
        line(&course)
    }

    /// The largest ∮F dD of cycles 2 to 4, over (F_max − F_min) D.
    pub(super) fn loop_area(&self, rows: &Rows) -> f64 {
        let area = |cycle: usize| {
            let course = self.course(rows, cycle as f64, (cycle + 1) as f64);
            let parts = course.windows(2).map(|two| 0.5 * (two[0].1 + two[1].1) * (two[1].0 - two[0].0));
            parts.sum::<f64>().abs()
        };
        (1..self.cycles).map(area).fold(0.0, f64::max) / (self.force_range(rows) * self.amplitude)
    }

    /// How much the force at zero strain differs between the ends of the cycles, over F_max − F_min. The
    /// force is a mean over a tenth of a cycle, so that waves in the sample do not count.
    pub(super) fn zero_force_scatter(&self, rows: &Rows) -> f64 {
        let mean = |cycle: usize| {
            let course = self.course(rows, cycle as f64 - 0.05, cycle as f64 + 0.05);
            course.iter().map(|(_, force)| force).sum::<f64>() / course.len() as f64
        };
        let means: Vec<f64> = (1..=self.cycles).map(mean).collect();
        let most = means.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = means.iter().copied().fold(f64::INFINITY, f64::min);
        (most - least) / self.force_range(rows)
    }
}

/// −slope and R² of the straight line through points.
pub(super) fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|point| of(point.0 - x, point.1 - y)).sum::<f64>();
    let [xx, xy, yy] = [sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y)];
    (-xy / xx, xy * xy / (xx * yy))
}
