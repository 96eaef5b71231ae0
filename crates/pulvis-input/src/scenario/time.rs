//! The length of time steps.

use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_math::Dimension;

/// How long a time step is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// A fraction of the shortest contact time over all pairs and branches.
    Auto {
        /// Steps in the shortest contact time [1].
        steps_per_contact_time: f64,
    },
    /// As the user demands it [s].
    Fixed(f64),
}

impl Default for TimeStep {
    fn default() -> Self {
        Self::Auto { steps_per_contact_time: Self::DEFAULT_STEPS }
    }
}

impl TimeStep {
    /// Steps in the shortest contact time where nothing is said [1]. Velocity-Verlet then errs by
    /// (π/50)²/24 = 2e-4 in the frequency of the max_stiffness contact.
    pub const DEFAULT_STEPS: f64 = 50.0;
    /// With fewer steps than this a contact is no longer resolved [1].
    pub const LEAST_STEPS: f64 = 10.0;
}

/// Reads `step` and `steps_per_contact_time` of `[time]` or `[stages.time]`; what is left out stays as
/// it was.
pub(super) fn read_time(parent: &mut TableReader<'_>, before: TimeStep) -> Result<TimeStep, Reported> {
    let Some(mut table) = parent.optional_table("time")? else { return Ok(before) };
    let given = match table.value("step") {
        Some(value) if value.text().map(str::trim) == Some("auto") => Ok(Some(None)),
        Some(value) => value.read(QuantityRule::of(Dimension::TIME).above(0.0)).map(|step| Some(Some(step))),
        None => Ok(None),
    };
    let steps = table.optional(
        "steps_per_contact_time",
        QuantityRule::of(Dimension::NONE).at_least(TimeStep::LEAST_STEPS),
    );
    let time = given.and_then(|given| combine(&table, before, given, steps?));
    table.finish();
    time
}

fn combine(
    table: &TableReader<'_>,
    before: TimeStep,
    step: Option<Option<f64>>,
    steps: Option<f64>,
) -> Result<TimeStep, Reported> {
    let fixed = match (step, before) {
        (Some(step), _) => step,
        (None, TimeStep::Fixed(step)) => Some(step),
        (None, TimeStep::Auto { .. }) => None,
    };
    match (fixed, steps, before) {
        (Some(step), None, _) => Ok(TimeStep::Fixed(step)),
        (Some(step), Some(_), _) => {
            let found = format!("the step is {step} s");
            let expected = "steps_per_contact_time only where step = \"auto\"";
            Err(table.refuse("steps_per_contact_time", Problem::rule(found, expected)))
        }
        (None, Some(steps_per_contact_time), _) => Ok(TimeStep::Auto { steps_per_contact_time }),
        (None, None, TimeStep::Auto { steps_per_contact_time }) => {
            Ok(TimeStep::Auto { steps_per_contact_time })
        }
        (None, None, TimeStep::Fixed(_)) => Ok(TimeStep::default()),
    }
}
