//! All that the scenarios of a figure compute.

use super::ReproductionError;
use super::chain::{finished, run_chain};
use super::limits::{self, Limits};
use super::series::FinishedRun;
use super::workplace::Workplace;
use crate::collision::{
    Collision, Observation, Sample, Sampling, SweepPoint, closed_form, collide, drawn_course,
    sampling_interval,
};
use crate::probe::{ProbeCurve, probe};
use pulvis_contact::theory::LudingPair;
use pulvis_input::collision::{CollisionCase, CollisionScenario, Method};
use pulvis_input::figure::{Experiment, FigureData, FigureScenario, Scale, Show};
use pulvis_input::scenario::TimeStep;

/// The results of a figure's data.
pub(super) struct Results<'f> {
    all: Vec<OfData<'f>>,
}

/// The results of one scenario.
pub(super) struct OfData<'f> {
    pub data: &'f FigureData,
    reference: Option<LudingPair>,
    pub kind: Kind<'f>,
}

pub(super) enum Kind<'f> {
    Collisions {
        scenario: &'f CollisionScenario,
        /// By the exact method.
        exact: Vec<SweepPoint>,
        /// By the engine's integrator; none where nothing asks for it.
        engine: Vec<SweepPoint>,
        /// Limits of sticking of some contacts, with their numbers; none where nothing asks for them.
        searched: Vec<(usize, Limits)>,
    },
    Probe(Vec<ProbeCurve>),
    /// One for each variant.
    Runs(Vec<FinishedRun<'f>>),
}

impl<'f> Results<'f> {
    pub fn compute(figure: &'f FigureScenario, workplace: &Workplace<'_>) -> Result<Self, ReproductionError> {
        run_chain(figure, workplace)?;
        let _seat = workplace.seats.take();
        let uses_engine = |number: usize| {
            let drawn = figure.panels.iter().flat_map(|panel| &panel.series);
            let mut drawn = drawn.filter(|series| series.data == number);
            let mut checked = figure.checks.iter().filter(|check| check.data == number);
            drawn.any(|series| matches!(series.show, Show::Engine | Show::Regime { .. }))
                || checked.any(|check| check.of_engine)
        };
        let searches = |number: usize| {
            let drawn = figure.panels.iter().flat_map(|panel| &panel.series);
            let mut drawn = drawn.filter(|series| series.data == number);
            let mut checked = figure.checks.iter().filter(|check| check.data == number);
            drawn.any(|series| series.show == Show::SearchedLimits)
                || checked.any(|check| check.quantity.name == limits::QUANTITY)
        };
        let of = |(number, data): (usize, &'f FigureData)| {
            let kind = match &data.experiment {
                Experiment::Probe(scenario) => Kind::Probe(probe(scenario)?),
                Experiment::Runs(runs) => Kind::Runs(finished(figure, number, runs, workplace)?),
                Experiment::Collisions(scenario) => Kind::Collisions {
                    scenario,
                    exact: points(scenario, false)?,
                    engine: if uses_engine(number) { points(scenario, true)? } else { Vec::new() },
                    searched: if searches(number) { limits::search(scenario)? } else { Vec::new() },
                },
            };
            Ok(OfData { data, reference: data.reference_pair(), kind })
        };
        let all = figure.data.iter().enumerate().map(of).collect::<Result<_, ReproductionError>>()?;
        Ok(Self { all })
    }

    /// The results of the data with this number.
    pub fn of(&self, data: usize) -> Option<&OfData<'f>> {
        self.all.get(data)
    }
}

impl OfData<'_> {
    /// How large the unit of a scale is for a collision, or along a path [SI].
    pub fn unit(&self, scale: Scale, case: Option<&CollisionCase>) -> f64 {
        let energy = case.map_or(f64::NAN, |case| {
            let touch = self.reference.map_or(case.velocity, |pair| pair.touch_velocity(case.velocity));
            0.5 * case.bodies.pair().reduced_mass() * touch * touch
        });
        match (scale, &self.reference) {
            (Scale::Si, _) => 1.0,
            (scale, Some(pair)) => scale.unit(pair, energy),
            (Scale::ImpactEnergy, None) => energy,
            // Refused when the figure was read.
            (_, None) => f64::NAN,
        }
    }
}

/// The same collision by the engine's integrator, with as many steps as runs take unless told otherwise.
fn by_engine(case: &CollisionCase) -> CollisionCase {
    CollisionCase { method: Method::Engine { steps_per_contact: TimeStep::DEFAULT_STEPS }, ..case.clone() }
}

fn with_method(case: &CollisionCase, engine: bool) -> CollisionCase {
    if engine { by_engine(case) } else { CollisionCase { method: Method::Exact, ..case.clone() } }
}

fn points(scenario: &CollisionScenario, engine: bool) -> Result<Vec<SweepPoint>, ReproductionError> {
    let point = |case: &CollisionCase| {
        let case = with_method(case, engine);
        let collision = collide(&case, &Observation::default())?;
        Ok(SweepPoint { theory: closed_form(&case), case, collision })
    };
    scenario.cases.iter().map(point).collect()
}

/// The course of a collision, as pictures show it.
pub(super) fn course(
    scenario: &CollisionScenario,
    case: &CollisionCase,
    engine: bool,
) -> Result<Vec<Sample>, ReproductionError> {
    Ok(drawn_course(scenario, &with_method(case, engine))?.course)
}

/// The state of a collision at the times since touch, which increase.
pub(super) fn course_at(
    case: &CollisionCase,
    engine: bool,
    times: &[f64],
) -> Result<Vec<Sample>, ReproductionError> {
    let case = with_method(case, engine);
    // The engine's steps are not cut to fit: all of them, and what lies between by a straight line.
    let sampling =
        if engine { Sampling::Every(sampling_interval(&case)) } else { Sampling::At(times.to_vec()) };
    let time_after_sticking = times.iter().copied().fold(0.0, f64::max);
    let observation = Observation { sampling, time_after_sticking, phase: 0.0, ..Observation::default() };
    let Collision { course, .. } = collide(&case, &observation)?;
    if !engine {
        return Ok(course);
    }
    let between = |time: f64| {
        let after = course.iter().position(|sample| sample.time >= time)?;
        let (after, before) = (course.get(after)?, course.get(after.saturating_sub(1))?);
        let length = after.time - before.time;
        let share = if length > 0.0 { (time - before.time) / length } else { 1.0 };
        Some(mixed(before, after, share))
    };
    Ok(times.iter().filter_map(|time| between(*time)).collect())
}

/// A state between two.
fn mixed(before: &Sample, after: &Sample, share: f64) -> Sample {
    let mix = |of: fn(&Sample) -> f64| of(before) + share * (of(after) - of(before));
    Sample {
        time: mix(|sample| sample.time),
        overlap: mix(|sample| sample.overlap),
        velocity: mix(|sample| sample.velocity),
        force: mix(|sample| sample.force),
        delta_max: mix(|sample| sample.delta_max),
        kinetic: mix(|sample| sample.kinetic),
        potential_available: mix(|sample| sample.potential_available),
        potential_plastic: mix(|sample| sample.potential_plastic),
        potential_attraction: mix(|sample| sample.potential_attraction),
        dissipated: mix(|sample| sample.dissipated),
        oblique: None,
    }
}
