//! The coefficient of restitution over velocity and one parameter.

use super::parallel::in_parallel;
use super::{Outcome, column, document, words};
use crate::message::Question;
use pulvis_input::collision::{CollisionCase, CollisionScenario};
use pulvis_input::{Document, Replacement};
use pulvis_lab::collision::{Observation, VelocityLimit, closed_form, collide, velocity_limits};
use serde_json::{Value, json};
use std::time::Instant;

/// More rows or columns than a screen shows.
const MOST: usize = 512;

/// Steps after which a collision is given up, as in the search of sticking: strongly damped pairs creep.
const MOST_STEPS: u64 = 20_000;

/// The collisions of the file's sweep with one value of the parameter, or why the law refuses that value.
type Row = Result<Vec<CollisionCase>, String>;

/// What the page asks for.
struct Wanted {
    /// The parameter by its path in the file.
    parameter: String,
    /// Its values, one for each row.
    values: Vec<f64>,
    /// Every so-manieth row is computed.
    row_stride: usize,
    /// Every so-manieth collision of a row is computed.
    stride: usize,
    /// Every so-manieth of them is known already; zero: none.
    known: usize,
}

/// Restitution of the collisions of a file at each of the `values` of a `parameter`, a row for each value. Where there is a closed form,
/// all of them, with the limits between regimes as lines. Where not, a coarse map is there at once and is refined: each `stride`th
/// collision of each `row_stride`th row, less each `known`th. `null`: not computed.
pub(super) fn answer(question: &Question) -> Outcome {
    let began = Instant::now();
    let mut wanted = Wanted::read(question)?;
    let document = document(&question.body)?;
    let coarse = rows(&document, &wanted);
    let covered = |row: &Option<Row>| match row {
        Some(Ok(cases)) => cases.iter().all(|case| closed_form(case).is_some()),
        _ => true,
    };
    let closed = coarse.iter().all(covered);
    let all = wanted.row_stride == 1;
    if closed {
        (wanted.stride, wanted.row_stride, wanted.known) = (1, 1, 0);
    }
    let rows = if closed && !all { rows(&document, &wanted) } else { coarse };
    let refused = rows.iter().flatten().find_map(|row| row.as_ref().err());
    let Some(first) = rows.iter().flatten().find_map(|row| row.as_ref().ok()) else {
        return Err(refused.cloned().unwrap_or_else(|| "the map has no rows".to_owned()));
    };
    if first.len() > MOST || first.iter().any(|case| case.incidence.is_some()) {
        return Err(format!("the map is of at most {MOST} head-on collisions in a row"));
    }
    Ok(json!({
        "velocity": column(first, |case| case.velocity),
        "value": wanted.values,
        "restitution": restitution(&rows, &wanted, closed),
        "from": if closed { "closed form" } else { "collisions" },
        "limits": lines(&wanted.values, &rows),
        "allowed": rows.iter().map(|row| row.as_ref().map(Result::is_ok)).collect::<Vec<Option<bool>>>(),
        "refused": refused,
        "seconds": began.elapsed().as_secs_f64(),
    }))
}

impl Wanted {
    fn read(question: &Question) -> Result<Self, String> {
        let text = |name: &str| question.parameter(name).ok_or_else(|| format!("`{name}` is missing"));
        let whole = |name: &str| question.parameter(name).and_then(|text| text.parse().ok()).unwrap_or(0);
        let values: Result<Vec<f64>, _> = text("values")?.split(',').map(str::parse).collect();
        let values =
            values.map_err(|_| "`values` is a list of numbers, with commas between them".to_owned())?;
        if values.len() > MOST {
            return Err(format!("the map has at most {MOST} rows"));
        }
        let [stride, row_stride] = ["stride", "row_stride"].map(|name| whole(name).max(1));
        Ok(Self { parameter: text("parameter")?, values, row_stride, stride, known: whole("known") })
    }

    /// Whether a collision of a row is asked for.
    fn has(&self, column: usize) -> bool {
        column.is_multiple_of(self.stride) && !(self.known > 0 && column.is_multiple_of(self.known))
    }
}

/// Every so-manieth row; `None`: not asked for.
fn rows(document: &Document, wanted: &Wanted) -> Vec<Option<Row>> {
    let places: Vec<(usize, f64)> = wanted.values.iter().copied().enumerate().collect();
    let lost = || Err("a row could not be computed".to_owned());
    in_parallel(&places, |(place, value)| {
        place.is_multiple_of(wanted.row_stride).then(|| row(document, &wanted.parameter, *value))
    })
    .into_iter()
    .map(|row| row.unwrap_or_else(|| Some(lost())))
    .collect()
}

fn row(document: &Document, parameter: &str, value: f64) -> Row {
    let replaced = document.with_override(parameter, Replacement::Si(value)).map_err(words)?;
    Ok(CollisionScenario::from_document(&replaced).map_err(words)?.cases)
}

/// The cells that are asked for.
fn restitution(rows: &[Option<Row>], wanted: &Wanted, closed: bool) -> Value {
    let observation = Observation { most_steps: Some(MOST_STEPS), ..Observation::default() };
    let one = |case: &CollisionCase| {
        if closed {
            return closed_form(case).map(|theory| theory.restitution);
        }
        collide(case, &observation).ok().map(|collision| collision.outcome.restitution)
    };
    let readable =
        rows.iter().enumerate().filter_map(|(place, row)| Some((place, row.as_ref()?.as_ref().ok()?)));
    let asked: Vec<(usize, usize, &CollisionCase)> = readable
        .flat_map(|(row, cases)| cases.iter().enumerate().map(move |(column, case)| (row, column, case)))
        .filter(|(_, column, _)| wanted.has(*column))
        .collect();
    let found = in_parallel(&asked, |(_, _, case)| one(case));
    let mut cells = vec![Value::Null; rows.len()];
    for ((row, column, _), found) in asked.iter().zip(found) {
        let Some(Some(Ok(cases))) = rows.get(*row) else { continue };
        if cells[*row].is_null() {
            cells[*row] = json!(vec![Value::Null; cases.len()]);
        }
        cells[*row][*column] = json!(found.flatten());
    }
    json!(cells)
}

/// The limits between regimes, each with its values of the parameter and velocities. A limit that ends begins a line of its own where
/// it comes back.
fn lines(values: &[f64], rows: &[Option<Row>]) -> Value {
    let mut lines: Vec<(VelocityLimit, Vec<[f64; 2]>, usize)> = Vec::new();
    let computed = values.iter().zip(rows).filter_map(|(value, row)| Some((value, row.as_ref()?)));
    for (number, (value, row)) in computed.enumerate() {
        let first = row.as_ref().ok().and_then(|cases| cases.first());
        for limit in first.map(velocity_limits).unwrap_or_default() {
            let point = [*value, limit.velocity];
            match lines.iter_mut().find(|(known, _, last)| known.symbol == limit.symbol && last + 1 == number)
            {
                Some((_, points, last)) => {
                    points.push(point);
                    *last = number;
                }
                None => lines.push((limit, vec![point], number)),
            }
        }
    }
    lines
        .iter()
        .map(|(limit, points, _)| {
            json!({
                "symbol": limit.symbol,
                "meaning": limit.meaning,
                "value": column(points, |point| point[0]),
                "velocity": column(points, |point| point[1]),
            })
        })
        .collect()
}
