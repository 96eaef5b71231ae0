//! How far results are from what they have to be.

use super::ReproductionError;
use super::limits::{self, Limits};
use super::quantity::{of_outcome, of_probe, of_sample, of_theory};
use super::results::{Kind, OfData, Results, course_at};
use crate::collision::{SweepPoint, case_label};
use crate::probe::ProbeCurve;
use pulvis_contact::theory::LudingPair;
use pulvis_input::collision::{CollisionCase, CollisionScenario, luding_pair};
use pulvis_input::figure::{Against, FigureCheck, Quantity, ReferenceTable};

/// Next to a limit of sticking, relative to it, round-off or the error of a time step decides how a collision ends.
const NEXT_TO_LIMIT: f64 = 1e-3;

/// What a check found.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// What was compared.
    pub what: String,
    /// Whether the engine's integrator was judged.
    pub of_engine: bool,
    /// The largest deviation.
    pub deviation: f64,
    /// The largest that is allowed.
    pub most: f64,
    /// In which unit both are.
    pub unit: String,
    /// How many values were compared.
    pub compared: usize,
    /// Where the deviation is largest.
    pub place: String,
    /// Why so much is allowed.
    pub why: String,
}

impl Judged {
    /// Whether the deviation is small enough; what is no number is not.
    pub fn passes(&self) -> bool {
        self.deviation <= self.most
    }
}

/// The largest deviation so far.
#[derive(Default)]
struct Largest {
    deviation: f64,
    place: String,
    compared: usize,
}

impl Largest {
    /// Takes in a deviation; one that is no number is the largest of all.
    fn take(&mut self, deviation: f64, place: impl FnOnce() -> String) {
        let larger = self.compared == 0 || !(deviation <= self.deviation || self.deviation.is_nan());
        if larger {
            (self.deviation, self.place) = (deviation, place());
        }
        self.compared += 1;
    }
}

/// Carries out a check.
pub(super) fn judge(check: &FigureCheck, results: &Results<'_>) -> Result<Judged, ReproductionError> {
    let nothing = |data: &str| ReproductionError::NothingToCompare {
        data: data.to_owned(),
        quantity: check.quantity.name,
    };
    let Some(of_data) = results.of(check.data) else { return Err(nothing("")) };
    let largest = match &of_data.kind {
        Kind::Collisions { scenario, exact, engine, searched } => {
            let sweep = Sweep { check, of_data, scenario, exact, engine, searched };
            match &check.against {
                Against::Theory => sweep.against_theory()?,
                Against::Exact => sweep.against_exact(),
                Against::Reference { table, over } => sweep.against_table(table, *over)?,
            }
        }
        Kind::Probe(paths) => match &check.against {
            Against::Reference { table, over } => along_paths(check, of_data, paths, table, *over),
            Against::Theory | Against::Exact => Largest::default(),
        },
        // They have features in place of checks.
        Kind::Runs(_) => Largest::default(),
    };
    if largest.compared == 0 {
        return Err(nothing(&of_data.data.name));
    }
    let against = match &check.against {
        Against::Theory => "theory",
        Against::Exact => "the exact method",
        Against::Reference { .. } => "reference values",
    };
    let method = if check.of_engine { "engine" } else { "exact method" };
    Ok(Judged {
        what: format!("{}, {method} against {against}", check.quantity.words),
        of_engine: check.of_engine,
        deviation: largest.deviation,
        most: check.most,
        unit: check.scale.unit_symbol(&check.quantity),
        compared: largest.compared,
        place: largest.place,
        why: check.why.clone(),
    })
}

struct Sweep<'r> {
    check: &'r FigureCheck,
    of_data: &'r OfData<'r>,
    scenario: &'r CollisionScenario,
    exact: &'r [SweepPoint],
    engine: &'r [SweepPoint],
    searched: &'r [(usize, Limits)],
}

impl Sweep<'_> {
    /// Whether a collision is one of those that are checked.
    fn chosen(&self, case: &CollisionCase) -> bool {
        let same_value = |number: usize| {
            let mut own = self.scenario.cases.iter().filter(|one| one.contact_number == case.contact_number);
            own.nth(number).is_some_and(|one| one.value == case.value)
        };
        self.check.contact.is_none_or(|only| only == case.contact_number)
            && self.check.case.is_none_or(same_value)
    }

    fn points(&self) -> impl Iterator<Item = (usize, &SweepPoint)> {
        let points = if self.check.of_engine { self.engine } else { self.exact };
        points.iter().enumerate().filter(|(_, point)| self.chosen(&point.case))
    }

    fn place(&self, case: &CollisionCase) -> String {
        let own = case_label(self.scenario, case);
        match self.scenario.labels.get(case.contact_number).filter(|_| self.scenario.labels.len() > 1) {
            Some(contact) => format!("{contact}, {own}"),
            None => own,
        }
    }

    fn against_theory(&self) -> Result<Largest, ReproductionError> {
        let mut largest = Largest::default();
        let name = self.check.quantity.name;
        if name == limits::QUANTITY {
            return Ok(self.limits());
        }
        for (_, SweepPoint { case, collision, theory }) in self.points() {
            let no_theory = || ReproductionError::NoTheory { data: self.of_data.data.name.clone() };
            let theory = theory.as_ref().ok_or_else(no_theory)?;
            let outcome = &collision.outcome;
            if name == "regime" {
                self.count(&mut largest, case, outcome.regime == theory.regime);
                continue;
            }
            let (got, expected) = (of_outcome(name, case, outcome), of_theory(name, case, theory));
            if let (Some(got), Some(expected)) = (got, expected) {
                let unit = self.of_data.unit(self.check.scale, Some(case));
                largest.take((got - expected).abs() / unit, || self.place(case));
            }
        }
        Ok(largest)
    }

    /// The limits of sticking that were searched for, against the closed forms.
    fn limits(&self) -> Largest {
        let mut largest = Largest::default();
        for (contact, found) in self.searched {
            let Some(case) = limits::first_case(self.scenario, *contact) else { continue };
            let label = self.scenario.labels.get(*contact).map_or("", String::as_str);
            for (deviation, name) in limits::deviations(case, *found) {
                largest.take(deviation, || format!("{label}, {name}"));
            }
        }
        largest
    }

    /// Counts a collision that ends otherwise than expected, unless it is next to a limit.
    fn count(&self, largest: &mut Largest, case: &CollisionCase, agrees: bool) {
        let next_to_limit = luding_pair(&case.contact, &case.bodies.pair())
            .is_some_and(|pair| is_next_to_limit(&pair, case.velocity));
        largest.compared += 1;
        if !agrees && !next_to_limit {
            if largest.deviation == 0.0 {
                largest.place = self.place(case);
            }
            largest.deviation += 1.0;
        }
    }

    fn against_exact(&self) -> Largest {
        let mut largest = Largest::default();
        let name = self.check.quantity.name;
        for (number, point) in self.points() {
            let Some(exact) = self.exact.get(number) else { continue };
            let (got, expected) = (&point.collision.outcome, &exact.collision.outcome);
            if name == "regime" {
                self.count(&mut largest, &point.case, got.regime == expected.regime);
                continue;
            }
            let both = of_outcome(name, &point.case, got).zip(of_outcome(name, &exact.case, expected));
            if let Some((got, expected)) = both {
                let unit = self.of_data.unit(self.check.scale, Some(&point.case));
                largest.take((got - expected).abs() / unit, || self.place(&point.case));
            }
        }
        largest
    }

    /// Along the course of each collision that is chosen.
    fn against_table(&self, table: &ReferenceTable, over: Quantity) -> Result<Largest, ReproductionError> {
        let mut largest = Largest::default();
        let times = table.column(over.name).unwrap_or_default();
        let expected = table.column(self.check.quantity.name).unwrap_or_default();
        for (_, SweepPoint { case, .. }) in self.points() {
            let samples = course_at(case, self.check.of_engine, &times)?;
            let unit = self.of_data.unit(self.check.scale, Some(case));
            for ((time, expected), number) in times.iter().zip(&expected).zip(0..) {
                // A course that ends before the table does is not what the table tells of.
                let got = samples
                    .get(number)
                    .map_or(f64::NAN, |sample| of_sample(self.check.quantity.name, sample));
                largest.take((got - expected).abs() / unit, || {
                    format!("{}, t = {time:.4e} s", self.place(case))
                });
            }
        }
        Ok(largest)
    }
}

fn is_next_to_limit(pair: &LudingPair, velocity: f64) -> bool {
    let limits = pair.critical_velocities();
    let near = |limit: f64| (velocity / limit - 1.0).abs() < NEXT_TO_LIMIT;
    [limits.low_end, limits.high_onset, limits.high_end].into_iter().flatten().any(near)
}

fn along_paths(
    check: &FigureCheck,
    of_data: &OfData<'_>,
    paths: &[ProbeCurve],
    table: &ReferenceTable,
    over: Quantity,
) -> Largest {
    let mut largest = Largest::default();
    let places = table.column(over.name).unwrap_or_default();
    let expected = table.column(check.quantity.name).unwrap_or_default();
    let unit = of_data.unit(check.scale, None);
    let chosen =
        paths.iter().enumerate().filter(|(number, _)| check.contact.is_none_or(|only| only == *number));
    for (_, path) in chosen {
        for (place, expected) in places.iter().zip(&expected) {
            let near = |value: f64| (value - place).abs() <= 1e-9 * place.abs();
            let sample = path.samples.iter().find(|sample| near(of_probe(over.name, sample)));
            let got = sample.map_or(f64::NAN, |sample| of_probe(check.quantity.name, sample));
            let at = || format!("{}, {} {place:.4e}", path.label, over.words);
            largest.take((got - expected).abs() / unit, at);
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deviation_that_is_no_number_is_the_largest_and_passes_no_check() {
        let mut largest = Largest::default();
        for (deviation, place) in [(1e-9, "a"), (f64::NAN, "b"), (1.0, "c")] {
            largest.take(deviation, || place.to_owned());
        }
        assert!(largest.deviation.is_nan() && largest.place == "b" && largest.compared == 3);
        let judged = Judged {
            what: String::new(),
            of_engine: false,
            deviation: largest.deviation,
            most: f64::INFINITY,
            unit: String::new(),
            compared: 3,
            place: String::new(),
            why: String::new(),
        };
        assert!(!judged.passes());
    }
}
