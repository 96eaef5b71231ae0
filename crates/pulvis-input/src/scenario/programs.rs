//! Parameters that change over the time of a stage: `[stages.programs]` holds dotted paths of keys and points of time and
//! value.

use super::contacts::Contact;
use super::resolved::writer::{Writer, quantity, text};
use super::switches::{Switch, is_switchable};
use super::until::StopRules;
use crate::any_quantity::AnyQuantity;
use crate::context::Reported;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Integer;
use crate::value_reader::ValueReader;
use pulvis_boundary::Background;
use pulvis_math::Dimension;

/// Updates of the parameters in a stage, unless it says otherwise.
const UPDATES: i64 = 100;
const MOST_UPDATES: i64 = 10_000;

/// What changes during a stage, straight between points of time, in as many equal updates.
#[derive(Clone, Debug, PartialEq)]
pub struct Programs {
    /// The keys that change.
    pub keys: Vec<Program>,
    /// Everything that stages can switch, at the start and after each update.
    pub states: Vec<ProgramState>,
}

/// A key that changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Its dotted path.
    pub path: String,
    /// The dimension of its values.
    pub dimension: Dimension,
    /// Times since the start of the stage [s], growing, and values in SI; two or more.
    pub points: Vec<(f64, f64)>,
}

/// What holds from one update to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgramState {
    /// One contact for every pair of materials that can meet.
    pub contacts: Vec<Contact>,
    /// Gravity and drag.
    pub background: Background,
}

impl Programs {
    /// When the last value is reached, after the start of the stage [s].
    pub fn duration(&self) -> f64 {
        duration(&self.keys)
    }

    /// Number of updates.
    pub fn updates(&self) -> usize {
        self.states.len() - 1
    }

    /// When an update is due, after the start of the stage [s].
    pub fn time_of(&self, update: usize) -> f64 {
        self.duration() * (update as f64 / self.updates() as f64)
    }

    /// The last update that is due at a time after the start of the stage [s].
    pub fn due(&self, elapsed: f64) -> usize {
        let guess = (elapsed / self.duration() * self.updates() as f64) as usize;
        // Exactly by the times themselves, so that nobody comes to another end by rounding.
        let mut update = guess.saturating_add(1).min(self.updates());
        while update > 0 && elapsed < self.time_of(update) {
            update -= 1;
        }
        update
    }
}

fn duration(keys: &[Program]) -> f64 {
    let ends = keys.iter().filter_map(|key| key.points.last());
    ends.fold(0.0, |latest, (time, _)| latest.max(*time))
}

impl Program {
    /// Its value at a time after the start of the stage [s].
    fn at(&self, time: f64) -> f64 {
        let next = self.points.partition_point(|(point, _)| *point <= time);
        let of = |index: usize| self.points.get(index).copied();
        match (next.checked_sub(1).and_then(of), of(next)) {
            (Some((start, from)), Some((end, to))) => from + (to - from) * ((time - start) / (end - start)),
            (Some((_, value)), None) | (None, Some((_, value))) => value,
            // There are two points or more.
            (None, None) => f64::NAN,
        }
    }
}

/// Programs as they stand in the file.
pub(super) struct PlannedPrograms {
    pub(super) keys: Vec<Program>,
    /// The first values, as the file writes them: what is wrong with a key shows with them.
    pub(super) starts: Vec<Switch>,
    updates: i64,
}

impl PlannedPrograms {
    /// What is set at each update after the start.
    pub(super) fn settings(&self) -> impl Iterator<Item = Vec<Switch>> + '_ {
        (1..=self.updates).map(|update| {
            let time = duration(&self.keys) * (update as f64 / self.updates as f64);
            let set = |(key, start): (&Program, &Switch)| start.with_number(key.at(time));
            self.keys.iter().zip(&self.starts).map(set).collect()
        })
    }
}

/// Reads `[stages.programs]` and `program_updates`.
pub(super) fn read_programs(
    stage: &mut TableReader<'_>,
    until: Option<&StopRules>,
) -> Result<Option<PlannedPrograms>, Reported> {
    let given = stage.value("program_updates").is_some();
    let updates = stage.or("program_updates", Integer::between(1, MOST_UPDATES), UPDATES);
    let Some(mut table) = stage.optional_table("programs")? else {
        let problem = Problem::rule("there are no [stages.programs] to update", "no `program_updates`");
        return if given { Err(stage.refuse("program_updates", problem)) } else { updates.map(|_| None) };
    };
    let mut programs = PlannedPrograms { keys: Vec::new(), starts: Vec::new(), updates: UPDATES };
    let mut failure = None;
    for path in table.keys() {
        let Some(value) = table.value(path) else { continue };
        match read_program(&value, path) {
            Ok((program, start)) => {
                programs.keys.push(program);
                programs.starts.push(start);
            }
            Err(reported) => failure = Some(reported),
        }
    }
    table.finish();
    if let Some(reported) = failure {
        return Err(reported);
    }
    programs.updates = updates?;
    let end = duration(&programs.keys);
    if let Some(time) = until.and_then(|until| until.time).filter(|time| *time < end) {
        let found = format!("the programs take {end:?} s, but the stage ends after {time:?} s");
        let expected = "programs that end within the stage";
        return Err(stage.refuse("programs", Problem::rule(found, expected)));
    }
    Ok(Some(programs).filter(|programs| !programs.keys.is_empty()))
}

fn read_program(value: &ValueReader<'_>, path: &str) -> Result<(Program, Switch), Reported> {
    if !is_switchable(path) {
        let found = format!("a program cannot change `{path}`");
        let expected = "a path in quotes that begins with contacts, background or gravity";
        return Err(value.refuse(Problem::rule(found, expected)));
    }
    let shape = "a list of points [time, value]";
    let items = value.items(shape)?;
    if items.len() < 2 {
        let expected = "two points [time, value] or more".to_owned();
        return Err(value.refuse(Problem::WrongLength { found: items.len(), expected }));
    }
    let mut points: Vec<(f64, f64)> = Vec::new();
    let mut first: Option<(Dimension, Replacement)> = None;
    for item in &items {
        let parts = item.items("a point [time, value]")?;
        let [time, given] = &parts[..] else {
            let expected = "a point [time, value]".to_owned();
            return Err(item.refuse(Problem::WrongLength { found: parts.len(), expected }));
        };
        let time = time.read(QuantityRule::of(Dimension::TIME).at_least(0.0))?;
        if let Some((before, _)) = points.last().filter(|(before, _)| time <= *before) {
            let expected = format!("a time greater than {before:?} s");
            return Err(
                item.refuse(Problem::rule(format!("{time:?} s is not after the point before"), expected))
            );
        }
        let (number, dimension) = given.read(AnyQuantity)?;
        let (known, _) = first.get_or_insert_with(|| (dimension, given.replacement()));
        if *known != dimension {
            let expected = format!("values in {}, as in the first point", known.unit());
            return Err(given.refuse(Problem::rule(format!("a value in {}", dimension.unit()), expected)));
        }
        points.push((time, number));
    }
    // There are two points or more.
    let (dimension, start) = first.unwrap_or((Dimension::NONE, Replacement::Number(0.0)));
    let program = Program { path: path.to_owned(), dimension, points };
    Ok((program, Switch::new(path.to_owned(), start, value.location())))
}

/// Writes them into a resolved scenario.
pub(super) fn write_programs(writer: &mut Writer, programs: &Programs) {
    writer.table("stages.programs");
    for Program { path, dimension, points } in &programs.keys {
        let point = |(time, value): &(f64, f64)| {
            format!("[{}, {}]", quantity(*time, Dimension::TIME), quantity(*value, *dimension))
        };
        let points: Vec<String> = points.iter().map(point).collect();
        writer.key(&text(path), format!("[{}]", points.join(", ")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn programs(points: &[(f64, f64)], updates: usize) -> Programs {
        let program = Program { path: "p".to_owned(), dimension: Dimension::NONE, points: points.to_vec() };
        let state = ProgramState { contacts: Vec::new(), background: Background::default() };
        Programs { keys: vec![program], states: vec![state; updates + 1] }
    }

    #[test]
    fn an_update_is_due_at_its_time_and_not_before() {
        let programs = programs(&[(0.0, 1.0), (0.3, 4.0)], 3);
        for update in 0..=3 {
            let time = programs.time_of(update);
            assert_eq!(programs.due(time), update);
            assert_eq!(programs.due(time * (1.0 - 1e-15) - f64::MIN_POSITIVE), update.saturating_sub(1));
        }
        assert_eq!(programs.due(1e9), 3);
        assert_eq!(programs.due(-1.0), 0);
    }

    #[test]
    fn values_are_straight_between_points_and_constant_outside() {
        let programs = programs(&[(0.1, 1.0), (0.3, 4.0), (0.4, 0.0)], 4);
        let at = |time: f64| programs.keys[0].at(time);
        for (time, value) in [(0.0, 1.0), (0.1, 1.0), (0.2, 2.5), (0.35, 2.0), (9.0, 0.0)] {
            assert!((at(time) - value).abs() < 1e-12, "{time}: {}", at(time));
        }
    }
}
