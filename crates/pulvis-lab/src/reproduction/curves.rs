//! The points of one series of a panel: one curve for each contact or collision that fits.

mod over_places;

use super::limits::{self, Limits};
use super::quantity::{of_approximation, of_case, of_outcome, of_probe, of_sample, of_theory};
use super::results::{Kind, OfData, Results, course};
use super::series::FinishedRun;
use super::{ReproductionError, SeenFeature};
use crate::collision::{Regime, SweepPoint, case_label, closed_form, fine_cases};
use crate::probe::ProbeCurve;
use over_places::of_features;
use pulvis_input::collision::{CollisionCase, CollisionScenario};
use pulvis_input::figure::{
    Approximation, Family, FigureAxis, FigurePanel, FigureSeries, Formula, ReferenceTable, Show,
};
use pulvis_io::plot::SeriesStyle;

/// What curves of one colour have in common: data, contact, collision, quantity.
pub(super) type Identity = (usize, usize, Option<usize>, &'static str);

/// In place of data or contact, where curves show limits.
const LIMITS: usize = usize::MAX;

/// In place of a variant, where curves show a closed form or a table beside runs.
const FORMULA: usize = usize::MAX - 1;
const TABLE: usize = usize::MAX - 2;

/// A curve with all that a chart needs.
pub(super) struct Curve {
    pub identity: Identity,
    /// What it belongs to, where there are others of its kind.
    pub subject: Option<String>,
    /// What it is.
    pub method: &'static str,
    pub style: SeriesStyle,
    pub points: Vec<(f64, f64)>,
    /// Points at which arrows show the direction.
    pub arrows: Vec<usize>,
    pub thick: bool,
}

impl Curve {
    /// A plain curve.
    fn plain(
        identity: Identity,
        subject: Option<String>,
        (method, style): (&'static str, SeriesStyle),
        points: Vec<(f64, f64)>,
    ) -> Self {
        Self { identity, subject, method, style, points, arrows: Vec::new(), thick: false }
    }
}

/// All curves of a series, in the units of the panel's axes.
pub(super) fn curves(
    panel: &FigurePanel,
    series: &FigureSeries,
    results: &Results<'_>,
    features: &[SeenFeature],
) -> Result<Vec<Curve>, ReproductionError> {
    if panel.family == Family::Feature {
        return Ok(of_features(panel, series, features));
    }
    let Some(of_data) = results.of(series.data) else { return Ok(Vec::new()) };
    let (scenario, exact, engine, searched) = match &of_data.kind {
        Kind::Collisions { scenario, exact, engine, searched } => (scenario, exact, engine, searched),
        Kind::Probe(_) => return Ok(of_paths(panel, series, of_data)),
        Kind::Runs(runs) => return of_runs(panel, series, of_data, runs),
    };
    let sweep = Sweep { panel, series, of_data, scenario, exact, engine, searched };
    match panel.family {
        Family::Course => sweep.courses(),
        _ => sweep.collisions(),
    }
}

struct Sweep<'r> {
    panel: &'r FigurePanel,
    series: &'r FigureSeries,
    of_data: &'r OfData<'r>,
    scenario: &'r CollisionScenario,
    exact: &'r [SweepPoint],
    engine: &'r [SweepPoint],
    searched: &'r [(usize, Limits)],
}

impl Sweep<'_> {
    fn contacts(&self) -> Vec<usize> {
        let all = 0..self.scenario.labels.len();
        all.filter(|contact| self.series.contact.is_none_or(|only| only == *contact)).collect()
    }

    fn subject(&self, contact: usize) -> Option<String> {
        (self.scenario.labels.len() > 1).then(|| self.scenario.labels.get(contact).cloned()).flatten()
    }

    /// What the series has on the vertical axis.
    fn y(&self) -> &'static str {
        self.series.y.unwrap_or(self.panel.y.quantity).name
    }

    /// A point in the units of the axes; no number where a quantity has none.
    fn point(&self, case: &CollisionCase, of: impl Fn(&str) -> Option<f64>) -> (f64, f64) {
        let on = |name, axis: &FigureAxis| {
            axis.factor * of(name).unwrap_or(f64::NAN) / self.of_data.unit(axis.scale, Some(case))
        };
        (on(self.panel.x.quantity.name, &self.panel.x), on(self.y(), &self.panel.y))
    }

    fn collisions(&self) -> Result<Vec<Curve>, ReproductionError> {
        if matches!(self.series.show, Show::Limits | Show::SearchedLimits) {
            return Ok(self.limits());
        }
        let curve = |contact: usize| {
            let points = match &self.series.show {
                Show::Theory => self.theory(contact)?,
                Show::Approximation(approximation) => self.approximation(contact, *approximation),
                Show::Exact => self.computed(contact, self.exact, |_| true),
                Show::Engine => self.computed(contact, self.engine, |_| true),
                Show::Regime { sticks } => {
                    let wanted = if *sticks { Regime::Stick } else { Regime::Rebound };
                    self.computed(contact, self.engine, |regime| regime == wanted)
                }
                Show::Limits | Show::SearchedLimits | Show::Run(_) | Show::Formula(_) | Show::Features(_) => {
                    Vec::new()
                }
                Show::Reference(table) => {
                    let first = self.scenario.cases.iter().find(|case| case.contact_number == contact);
                    self.reference(table, first)
                }
            };
            let look = method(&self.series.show, false);
            // A map has one colour for each way to end.
            let (colour, subject) = match self.series.show {
                Show::Regime { sticks } => (usize::from(sticks), None),
                _ => (contact, self.subject(contact)),
            };
            let identity = (self.series.data, colour, None, self.y());
            Ok(Curve::plain(identity, subject, look, points))
        };
        self.contacts().into_iter().map(curve).collect()
    }

    /// A curve for each of the three limits, a point for each contact.
    fn limits(&self) -> Vec<Curve> {
        let searching = self.series.show == Show::SearchedLimits;
        let mut points = [const { Vec::new() }; 3];
        for contact in self.contacts() {
            let Some(case) = limits::first_case(self.scenario, contact) else { continue };
            let searched = self.searched.iter().find(|(number, _)| *number == contact);
            let found =
                if searching { searched.map(|(_, limits)| *limits) } else { Some(limits::in_theory(case)) };
            for (points, velocity) in points.iter_mut().zip(found.unwrap_or_default()) {
                let Some(velocity) = velocity else { continue };
                let case = CollisionCase { velocity, ..case.clone() };
                points.push(self.point(&case, |name| of_case(name, &case)));
            }
        }
        let look = method(&self.series.show, false);
        // Limits of something that has a name have its colour; else each limit has one.
        let colour = |number: usize| match self.series.label {
            Some(_) => (self.series.data, LIMITS, None, self.y()),
            None => (LIMITS, number, None, self.y()),
        };
        let curve = |(number, points): (usize, Vec<(f64, f64)>)| {
            let subject = limits::NAMES.get(number).map(|name| (*name).to_owned());
            Curve::plain(colour(number), subject, look, points)
        };
        points.into_iter().enumerate().filter(|(_, points)| !points.is_empty()).map(curve).collect()
    }

    fn theory(&self, contact: usize) -> Result<Vec<(f64, f64)>, ReproductionError> {
        let cases = fine_cases(self.scenario, contact);
        let point = |case: &CollisionCase| {
            let theory = closed_form(case)?;
            Some(self.point(case, |name| of_theory(name, case, &theory)))
        };
        let points: Vec<_> = cases.iter().filter_map(point).collect();
        if points.is_empty() {
            return Err(ReproductionError::NoTheory { data: self.of_data.data.name.clone() });
        }
        Ok(points)
    }

    fn approximation(&self, contact: usize, approximation: Approximation) -> Vec<(f64, f64)> {
        let cases = fine_cases(self.scenario, contact);
        let point =
            |case: &CollisionCase| self.point(case, |name| of_approximation(name, case, approximation));
        cases.iter().map(point).collect()
    }

    fn computed(
        &self,
        contact: usize,
        points: &[SweepPoint],
        wanted: impl Fn(Regime) -> bool,
    ) -> Vec<(f64, f64)> {
        let own = points
            .iter()
            .filter(|point| point.case.contact_number == contact && wanted(point.collision.outcome.regime));
        let place = |point: &SweepPoint| {
            self.point(&point.case, |name| of_outcome(name, &point.case, &point.collision.outcome))
        };
        own.map(place).collect()
    }

    fn courses(&self) -> Result<Vec<Curve>, ReproductionError> {
        let mut curves = Vec::new();
        for contact in self.contacts() {
            let cases = self.scenario.cases.iter().filter(|case| case.contact_number == contact);
            let several = cases.clone().count() > 1;
            for (number, case) in cases.enumerate() {
                if self.series.case.is_some_and(|only| only != number) {
                    continue;
                }
                let points = match &self.series.show {
                    Show::Reference(table) => self.reference(table, Some(case)),
                    show => {
                        let course = course(self.scenario, case, *show == Show::Engine)?;
                        let point = |sample| self.point(case, |name| Some(of_sample(name, sample)));
                        course.iter().map(point).collect()
                    }
                };
                let look = method(&self.series.show, true);
                let mut subject = self.subject(contact);
                if several && self.series.case.is_none() {
                    let own = case_label(self.scenario, case);
                    subject = Some(subject.map_or(own.clone(), |contact| format!("{contact}, {own}")));
                }
                let identity = (self.series.data, contact, several.then_some(number), self.y());
                curves.push(Curve::plain(identity, subject, look, points));
            }
        }
        Ok(curves)
    }

    fn reference(&self, table: &ReferenceTable, case: Option<&CollisionCase>) -> Vec<(f64, f64)> {
        let on = |name, axis: &FigureAxis| {
            let unit = self.of_data.unit(axis.scale, case);
            let column = table.column(name).unwrap_or_default();
            column.into_iter().map(move |value| axis.factor * value / unit).collect::<Vec<_>>()
        };
        let x = on(self.panel.x.quantity.name, &self.panel.x);
        x.into_iter().zip(on(self.y(), &self.panel.y)).collect()
    }
}

fn of_paths(panel: &FigurePanel, series: &FigureSeries, of_data: &OfData<'_>) -> Vec<Curve> {
    let Kind::Probe(paths) = &of_data.kind else { return Vec::new() };
    let chosen = |(number, _): &(usize, &ProbeCurve)| series.contact.is_none_or(|only| only == *number);
    let y = series.y.unwrap_or(panel.y.quantity).name;
    let curve = |(number, path): (usize, &ProbeCurve)| {
        let on = |name: &str, axis: &FigureAxis| {
            let values = match &series.show {
                Show::Reference(table) => table.column(name).unwrap_or_default(),
                _ => path.samples.iter().map(|sample| of_probe(name, sample)).collect(),
            };
            let unit = of_data.unit(axis.scale, None);
            values.into_iter().map(move |value| axis.factor * value / unit).collect::<Vec<f64>>()
        };
        let (method, style) = method(&series.show, true);
        let look = (if method == "exact" { "computed" } else { method }, style);
        let subject = (paths.len() > 1).then(|| path.label.clone());
        let points = on(panel.x.quantity.name, &panel.x).into_iter().zip(on(y, &panel.y)).collect();
        Curve::plain((series.data, number, None, y), subject, look, points)
    };
    paths.iter().enumerate().filter(chosen).map(curve).collect()
}

/// A curve for each variant that is chosen.
fn of_runs(
    panel: &FigurePanel,
    series: &FigureSeries,
    of_data: &OfData<'_>,
    runs: &[FinishedRun<'_>],
) -> Result<Vec<Curve>, ReproductionError> {
    let y = series.y.unwrap_or(panel.y.quantity).name;
    let show = match &series.show {
        Show::Run(show) => show,
        Show::Formula(formula) => return of_formula(panel, series, formula, runs),
        Show::Reference(table) => return Ok(vec![of_table(panel, series, table, y)]),
        _ => return Ok(Vec::new()),
    };
    let mut curves = Vec::new();
    let shown = || runs.iter().filter(|run| show.variant.is_none_or(|only| only == run.variant));
    let several = shown().count() > 1;
    for run in shown() {
        let (across, up) = (run.column(panel.x.quantity.name)?, run.column(y)?);
        let rows = run.drawn(show);
        let points = rows.iter().map(|row| (panel.x.factor * row.at(across), panel.y.factor * row.at(up)));
        let identity = (series.data, if several { run.variant } else { 0 }, None, y);
        let look = method(&series.show, true);
        let name = if several { &run.variant_name } else { &of_data.data.name };
        let mut curve = Curve::plain(identity, Some(name.clone()), look, points.collect());
        let first = |phase: &f64| rows.iter().position(|row| row.phase >= *phase);
        curve.arrows = show.arrows.iter().filter_map(first).collect();
        curve.thick = show.thick;
        curves.push(curve);
    }
    Ok(curves)
}

/// Points of a closed form.
const FORMULA_POINTS: usize = 200;

/// A closed form, from its start to the last row of any run.
fn of_formula(
    panel: &FigurePanel,
    series: &FigureSeries,
    formula: &Formula,
    runs: &[FinishedRun<'_>],
) -> Result<Vec<Curve>, ReproductionError> {
    let mut ends = [formula.start; 2];
    for run in runs {
        let across = run.column(panel.x.quantity.name)?;
        for row in run.rows(None) {
            ends[1] = ends[1].max(row.at(across));
        }
    }
    let point = |number: usize| {
        // Closer at the start, where it changes most.
        let share = number as f64 / FORMULA_POINTS as f64;
        let x = ends[0] + (ends[1] - ends[0]) * share * share;
        (panel.x.factor * x, panel.y.factor * formula.at(x))
    };
    let identity = (series.data, FORMULA, None, panel.y.quantity.name);
    let look = method(&series.show, true);
    Ok(vec![Curve::plain(identity, None, look, (0..=FORMULA_POINTS).map(point).collect())])
}

/// A table beside runs.
fn of_table(panel: &FigurePanel, series: &FigureSeries, table: &ReferenceTable, y: &'static str) -> Curve {
    let on = |name: &str, axis: &FigureAxis| {
        let column = table.column(name).unwrap_or_default();
        column.into_iter().map(|value| axis.factor * value).collect::<Vec<f64>>()
    };
    let points = on(panel.x.quantity.name, &panel.x).into_iter().zip(on(y, &panel.y)).collect();
    Curve::plain((series.data, TABLE, None, y), None, method(&series.show, true), points)
}

/// What a series is in words, and how it looks.
fn method(show: &Show, course: bool) -> (&'static str, SeriesStyle) {
    match show {
        Show::Theory => ("theory", SeriesStyle::Line),
        Show::Approximation(Approximation::Slow) => ("1 − ηχ/2", SeriesStyle::Dashed),
        Show::Approximation(Approximation::Plastic) => ("1/√(ηχ)", SeriesStyle::Dashed),
        Show::Approximation(Approximation::WeakAdhesion) => ("√(1/(ηχ) − β)", SeriesStyle::Dashed),
        Show::Approximation(Approximation::SquareRoot) => ("1/√(η√χ)", SeriesStyle::Dashed),
        Show::Exact if course => ("exact", SeriesStyle::Line),
        Show::Exact => ("exact", SeriesStyle::Rings),
        Show::Engine => ("engine", SeriesStyle::Crosses),
        Show::Regime { sticks: true } => ("engine: sticks", SeriesStyle::Points),
        Show::Regime { sticks: false } => ("engine: rebounds", SeriesStyle::Rings),
        Show::Limits => ("theory", SeriesStyle::Line),
        Show::SearchedLimits => ("searched by collisions", SeriesStyle::Rings),
        Show::Reference(_) => ("reference", SeriesStyle::Rings),
        Show::Run(_) => ("run", SeriesStyle::Line),
        Show::Formula(_) => ("closed form", SeriesStyle::Line),
        Show::Features(_) => ("mean", SeriesStyle::Rings),
    }
}
