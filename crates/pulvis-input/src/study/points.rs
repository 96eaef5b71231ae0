//! The points of a study: the scenario with every combination of the values.

use super::Surroundings;
use super::variable::{StudyVariable, plain};
use crate::context::{Location, Reported};
use crate::document::Document;
use crate::error::InputErrors;
use crate::figure::settings::Settings;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::scenario::Scenario;
use std::path::Path;

/// A point of a study.
#[derive(Clone, Debug)]
pub struct StudyPoint {
    /// The name of its folder.
    pub name: String,
    /// The index of its value of each variable.
    pub choice: Vec<usize>,
    /// The scenario, with the seed of its file.
    pub scenario: Scenario,
}

/// All points, and the text of the scenario.
pub(super) struct Combined {
    pub(super) points: Vec<StudyPoint>,
    pub(super) scenario_text: String,
}

/// Longer names of folders are cut.
const LONGEST_NAME: usize = 100;

/// Reads the scenario at every point. What is wrong in it is told with the values that cause it.
pub(super) fn combine(
    table: &TableReader<'_>,
    file: &Path,
    set: &Settings,
    variables: &[StudyVariable],
    around: &Surroundings<'_>,
) -> Result<Combined, Reported> {
    let refuse = |errors: InputErrors, location: &Location, with: &str| {
        let count = errors.errors().len() + errors.omitted();
        around.elsewhere.borrow_mut().extend(errors.into_errors());
        let found =
            format!("{} has {count} mistake{}{with}", file.display(), if count == 1 { "" } else { "s" });
        table.refuse_at(
            location,
            Problem::rule(found, "a scenario of `pulvis run` with values that it can have"),
        )
    };
    let plain = (around.load)(file).map_err(|errors| refuse(errors, &table.location("scenario"), ""))?;
    let base = plain.with_overrides(set);
    let base = base.map_err(|errors| refuse(errors, &table.location("set"), " with these values"))?;
    // Mistakes that no value changes are those of the scenario alone.
    let own =
        Scenario::from_document(&base, Some(file)).map_or_else(|errors| headlines(&errors), |_| Vec::new());
    let mut points: Vec<StudyPoint> = Vec::new();
    let mut refused: Vec<(Location, Reported)> = Vec::new();
    for choice in choices(variables) {
        let name = name(variables, &choice);
        match scenario(&base, file, variables, &choice) {
            Ok(scenario) => points.push(StudyPoint { name, choice, scenario }),
            Err(errors) => {
                let blamed = culprit(variables, &choice, &errors)
                    .filter(|_| !headlines(&errors).iter().all(|headline| own.contains(headline)));
                let with = blamed.as_ref().map(|_| format!(" with {}", words(variables, &choice)));
                let location = blamed.unwrap_or(table.location("scenario"));
                // A value that no combination can have is told once.
                if !refused.iter().any(|(known, _)| *known == location) {
                    let reported = refuse(errors, &location, &with.unwrap_or_default());
                    refused.push((location, reported));
                }
            }
        }
    }
    match refused.first() {
        Some((_, reported)) => Err(*reported),
        None => Ok(Combined { points, scenario_text: base.text().to_owned() }),
    }
}

/// The mistakes, as they are told.
fn headlines(errors: &InputErrors) -> Vec<String> {
    errors.errors().iter().map(crate::InputError::headline).collect()
}

/// Every combination of the values, those of the last variable first.
fn choices(variables: &[StudyVariable]) -> Vec<Vec<usize>> {
    variables.iter().fold(vec![Vec::new()], |all, variable| {
        let with = |choice: &Vec<usize>| {
            let choice = choice.clone();
            (0..variable.values.len()).map(move |value| choice.iter().copied().chain([value]).collect())
        };
        all.iter().flat_map(with).collect()
    })
}

fn scenario(
    base: &Document,
    file: &Path,
    variables: &[StudyVariable],
    choice: &[usize],
) -> Result<Scenario, InputErrors> {
    let chosen = chosen(variables, choice);
    let set: Settings = chosen.flat_map(|(_, value)| value.set.iter().cloned()).collect();
    Scenario::from_document(&base.with_overrides(&set)?, Some(file))
}

fn chosen<'v>(
    variables: &'v [StudyVariable],
    choice: &'v [usize],
) -> impl Iterator<Item = (&'v StudyVariable, &'v super::StudyValue)> {
    variables
        .iter()
        .zip(choice)
        .filter_map(|(variable, value)| Some((variable, variable.values.get(*value)?)))
}

/// The place of the value that is to blame, as far as the mistakes tell: its key is among theirs.
fn culprit(variables: &[StudyVariable], choice: &[usize], errors: &InputErrors) -> Option<Location> {
    let is_named = |path: &str| errors.errors().iter().any(|error| error.key == path);
    let blamed =
        chosen(variables, choice).find(|(_, value)| value.set.iter().any(|(path, _)| is_named(path)));
    blamed.or_else(|| chosen(variables, choice).last()).map(|(_, value)| value.location.clone())
}

/// The values of a point in words.
fn words(variables: &[StudyVariable], choice: &[usize]) -> String {
    let all: Vec<String> = chosen(variables, choice)
        .map(|(variable, value)| format!("{} = {}", variable.label, value.name))
        .collect();
    all.join(", ")
}

/// The name of a point's folder. It depends on its values alone, so that a study to which values are added finds its runs.
fn name(variables: &[StudyVariable], choice: &[usize]) -> String {
    let parts: Vec<String> = chosen(variables, choice)
        .map(|(variable, value)| format!("{}={}", plain(&variable.label), plain(&value.name)))
        .collect();
    match parts.join("_") {
        none if none.is_empty() => "scenario".to_owned(),
        short if short.chars().count() <= LONGEST_NAME => short,
        long => {
            let start: String = long.chars().take(LONGEST_NAME - 17).collect();
            format!("{start}-{:016x}", hash(&long))
        }
    }
}

/// FNV-1a: the same on every machine and in every version.
fn hash(text: &str) -> u64 {
    text.bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use crate::document::Document;
    use crate::study::Study;
    use std::path::Path;

    /// A study of a sphere at a wall, with these tables of variables.
    fn study(over: &str) -> Study {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_studies/scenarios");
        let text = format!(
            "[study]\ntitle = 'a'\nscenario = {:?}\nseeds = [3, 4]\n{over}\n[[measures]]\nkey = 'E'\nwhat = 'e'\nvalue = 'last'\ny = 'kinetic'\n",
            folder.join("press.toml")
        );
        let document = Document::from_str("study.toml", &text).unwrap();
        Study::from_document(&document, Path::new("study.toml"), &|path| Document::load(path)).unwrap()
    }

    #[test]
    fn points_are_all_combinations_and_their_names_depend_on_their_own_values_alone() {
        let over = "[[study.over]]\nkey = 'contacts.grain-plate.normal.kc'\nfrom = '1 N/m'\nto = '100 N/m'\npoints = 3\nspacing = 'log'\n\
                    [[study.over]]\nlabel = 'grain'\nnames = ['soft', 'hard']\nset = [{ 'contacts.grain-plate.normal.k1' = '100 N/m', \
                    'contacts.grain-plate.normal.kp' = '300 N/m' }, { 'contacts.grain-plate.normal.kp' = '900 N/m', \
                    'contacts.grain-plate.normal.k1' = '0.2 kN/m' }]";
        let both = study(over);
        let names: Vec<&str> = both.points.iter().map(|point| point.name.as_str()).collect();
        let expected = ["kc=1-N-m_grain=soft", "kc=1-N-m_grain=hard", "kc=10-N-m_grain=soft"];
        assert_eq!((names.len(), &names[..3]), (6, &expected[..]));
        assert!(both.variables[0].logarithmic && !both.variables[1].logarithmic);
        let numbers: Vec<Option<f64>> =
            both.variables[1].values.iter().map(|value| value.numbers[0]).collect();
        assert_eq!(
            numbers,
            [Some(100.0), Some(200.0)],
            "the same key of each value, in whatever order they stand"
        );
        let resolved = both.points[3].scenario.to_resolved_toml("0");
        for value in ["kc = \"10.0 N/m\"", "k1 = \"200.0 N/m\"", "kp = \"900.0 N/m\""] {
            assert!(resolved.contains(value), "{value}: {resolved}");
        }
        let one = study(&over.replace("points = 3", "points = 2"));
        assert_eq!(one.points[1].name, names[1]);
        assert_eq!(study("").points[0].name, "scenario");
    }
}
