//! `cargo xtask experiments`: the experiments that are short, through the command line, against their
//! `expected.toml`.

use std::path::{Path, PathBuf};
use std::process::Command;

use pulvis_input::figure::FigureScenario;

use crate::Outcome;
use crate::expected::{Collisions, Demand, collisions, demands};
use crate::process::{pulvis, root, run as run_command, scratch, target, text};
use crate::table::Table;
use crate::tests::read_by_vtk;

/// The largest relative closing error of the energy ledger that a run may have, at the automatic time
/// step.
const LEDGER_TOLERANCE: f64 = 1e-4;

/// Runs the experiments of the folders, or of one.
pub fn run(only: Option<&str>) -> Outcome {
    let pulvis = pulvis()?;
    let folders = folders(only)?;
    // A run is short if its folder says so by a file `short.toml`; the whole one is for patience.
    let short: Vec<&PathBuf> = folders.iter().filter(|folder| folder.join(SHORT).exists()).collect();
    // Each of them has one thread; the others keep the second processor busy meanwhile.
    let others = std::thread::scope(|scope| {
        let runs: Vec<_> = short.iter().map(|folder| scope.spawn(|| run_stages(&pulvis, folder))).collect();
        let others = run_others(&pulvis, &folders, only)?;
        for run in runs {
            run.join().map_err(|_| "a run panicked".to_owned())??;
        }
        Ok::<usize, String>(others)
    })?;
    for folder in &short {
        check_stages(folder)?;
    }
    if others + short.len() == 0 { Err("no experiment was found".to_owned()) } else { Ok(()) }
}

/// The scenario of a short run.
const SHORT: &str = "short.toml";

/// Collisions, studies and figures; answers with how many there are.
fn run_others(pulvis: &Path, folders: &[PathBuf], only: Option<&str>) -> Outcome<usize> {
    let mut ran = 0;
    for folder in folders {
        let collision = folder.join("experiment.toml");
        if is_collision(&collision)? {
            collide(pulvis, folder, &collision)?;
            ran += 1;
        }
        let study = folder.join("study.toml");
        let is_quick = QUICK_STUDIES.iter().any(|quick| folder.ends_with(quick));
        if study.exists() && (is_quick || only.is_some()) {
            run_study(pulvis, &study)?;
            ran += 1;
        }
    }
    if only.is_none_or(|name| name == FIGURES) {
        reproduce(pulvis)?;
        ran += 1;
    }
    Ok(ran)
}

/// Studies that take seconds; the others are run if they are named.
const QUICK_STUDIES: [&str; 1] = ["study-restitution"];

/// A study judges itself.
fn run_study(pulvis: &Path, study: &Path) -> Outcome {
    let output = scratch("study")?;
    run_command(Command::new(pulvis).arg("study").arg(study).arg("--output").arg(output))
}

/// The folder of the papers' figures.
const FIGURES: &str = "figures";

/// The printed figures of the papers that are quick; maps and windows, which search for limits, take longer.
fn reproduce(pulvis: &Path) -> Outcome {
    let folder = root().join("experiments").join(FIGURES);
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name().to_string_lossy().into_owned();
        let is_printed = ["s0-", "s1-"].iter().any(|paper| name.starts_with(paper));
        if is_printed
            && !FigureScenario::load(folder.join(&name)).map_err(|errors| errors.to_string())?.is_long
        {
            names.push(name);
        }
    }
    names.sort();
    let output = scratch("reproduced")?;
    let mut command = Command::new(pulvis);
    command.arg("reproduce").args(&names).arg("--from").arg(&folder).arg("--output").arg(&output);
    run_command(&mut command)
}

fn folders(only: Option<&str>) -> Outcome<Vec<PathBuf>> {
    let all = root().join("experiments");
    let failed = |error: std::io::Error| format!("{}: {error}", all.display());
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(&all).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let named = only.is_none_or(|name| path.file_name().is_some_and(|own| own == name));
        if path.is_dir() && named {
            folders.push(path);
        }
    }
    folders.sort();
    Ok(folders)
}

fn is_collision(path: &Path) -> Outcome<bool> {
    if !path.exists() {
        return Ok(false);
    }
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(text.lines().any(|line| line.trim() == "[collision]"))
}

/// Every restitution of the sweep agrees with theory, and with the numbers of `expected.toml`.
fn collide(pulvis: &Path, folder: &Path, scenario: &Path) -> Outcome {
    let csv = text(Command::new(pulvis).arg("collide").arg(scenario).args(["--format", "csv"]))?;
    let table = Table::parse(&csv)?;
    let expected = collisions(&folder.join("expected.toml"))?;
    let rows =
        check_collisions(&table, &expected).map_err(|message| format!("{}: {message}", name(folder)))?;
    println!("{}: {rows} collisions as expected", name(folder));
    Ok(())
}

/// Restitutions below this are none.
const ROUND_OFF: f64 = 1e-7;

fn check_collisions(table: &Table, expected: &Collisions) -> Outcome<usize> {
    let (chi, restitution) = (table.numbers("chi")?, table.numbers("restitution")?);
    let theory = table.numbers("restitution_theory")?;
    // At χ = 1/2, where the pair begins to stick, what is left is the root of round-off.
    let near = |got: f64, value: f64| {
        (got - value).abs() <= expected.tolerance * value.abs() || got.max(value) < ROUND_OFF
    };
    for ((&chi, &got), &value) in chi.iter().zip(&restitution).zip(&theory) {
        let stated =
            expected.points.iter().find(|(at, _)| (at - chi).abs() < 1e-9).map_or(value, |point| point.1);
        if !near(got, value) || !near(got, stated) {
            return Err(format!("e({chi}) = {got}, theory says {value}, expected.toml {stated}"));
        }
    }
    Ok(chi.len())
}

/// The run ends well.
fn run_stages(pulvis: &Path, folder: &Path) -> Outcome {
    let (scenario, output) = (folder.join(SHORT), scratch(&place(folder))?);
    let mut command = Command::new(pulvis);
    command.arg("run").arg(scenario).args(["--quiet", "--threads", "1", "--force", "--output"]).arg(&output);
    run_command(&mut command)
}

/// Where the run of a folder writes.
fn place(folder: &Path) -> String {
    format!("experiments/{}", name(folder))
}

/// The ledger of a run closes, its files can be read and its series meet the demands.
fn check_stages(folder: &Path) -> Outcome {
    let output = target().join("xtask").join(place(folder));
    let series = output.join("timeseries.csv");
    let csv = std::fs::read_to_string(&series).map_err(|error| format!("{}: {error}", series.display()))?;
    let table = Table::parse(&csv)?;
    let errors = table.numbers("relative_error")?;
    let error = errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()));
    // Asked of each row, because a maximum passes over what is no number.
    if !errors.iter().all(|error| error.abs() < LEDGER_TOLERANCE) {
        let name = name(folder);
        return Err(format!("{name}: the ledger closes to {error:e} only, expected {LEDGER_TOLERANCE:e}"));
    }
    read_by_vtk(&output, &[])?;
    let expected = folder.join("expected.toml");
    let demands = if expected.exists() { demands(&expected, "short")? } else { Vec::new() };
    for demand in &demands {
        meets(&table, demand).map_err(|message| format!("{}: {message}", name(folder)))?;
    }
    println!("{}: ledger closes to {error:.1e}, {} demands met", name(folder), demands.len());
    Ok(())
}

fn meets(table: &Table, demand: &Demand) -> Outcome {
    let Demand { column, stage, pick, over, bounds: [least, most] } = demand;
    let mut value = picked(table, column, *stage, pick)?;
    if let Some(over) = over {
        value /= picked(table, over, *stage, pick)?;
    }
    // Fails for NaN.
    if value >= *least && value <= *most {
        return Ok(());
    }
    let of = stage.map_or(String::new(), |stage| format!(" of stage {stage}"));
    let over = over.as_ref().map_or(String::new(), |over| format!(" over that of {over}"));
    Err(format!("{pick} {column}{of}{over} is {value}, expected {least} to {most}"))
}

/// What a demand picks of a column, of the rows of a stage or of all.
fn picked(table: &Table, column: &str, stage: Option<f64>, pick: &str) -> Outcome<f64> {
    let stages = table.numbers("stage")?;
    let counts = |of: f64| stage.is_none_or(|stage| (stage - of).abs() < 0.5);
    let rows = table.numbers(column)?.into_iter().zip(stages).filter(|&(_, of)| counts(of));
    let values: Vec<f64> = rows.map(|(value, _)| value).collect();
    let [first, .., last] = values[..] else {
        return Err(format!("less than two rows of `{column}` in stage {stage:?}"));
    };
    // A minimum or maximum would pass over NaN; one row has nothing to do with the others.
    if !matches!(pick, "first" | "last") && values.iter().any(|value| value.is_nan()) {
        return Ok(f64::NAN);
    }
    Ok(match pick {
        "first" => first,
        "last" => last,
        "minimum" => values.into_iter().fold(f64::INFINITY, f64::min),
        "maximum" => values.into_iter().fold(f64::NEG_INFINITY, f64::max),
        "mean" => values.iter().sum::<f64>() / values.len() as f64,
        _ => last - first,
    })
}

fn name(folder: &Path) -> String {
    folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn value_of(pick: &str, stage: Option<f64>) -> f64 {
        let table = Table::parse("stage,x,y\n1,9,1\n2,1,2\n2,4,2\n2,-2,8\n").expect("a table");
        picked(&table, "x", stage, pick).expect("rows")
    }

    #[test]
    fn a_demand_picks_of_the_rows_of_its_stage() {
        let stage = Some(2.0);
        for (pick, expected) in [("first", 1.0), ("last", -2.0), ("minimum", -2.0), ("maximum", 4.0)] {
            assert_eq!(value_of(pick, stage), expected, "{pick}");
        }
        assert_eq!([value_of("mean", stage), value_of("change", stage)], [1.0, -3.0]);
        assert_eq!([value_of("mean", None), value_of("change", None)], [3.0, -11.0]);
    }

    #[test]
    fn a_ratio_is_one_of_picks_and_nothing_but_a_number_within_the_bounds_will_do() {
        let demand = |column: &str, over: &str, bounds| Demand {
            column: column.to_owned(),
            stage: Some(2.0),
            pick: "mean",
            over: Some(over.to_owned()),
            bounds,
        };
        let table = Table::parse("stage,x,y,z\n2,1,2,0\n2,4,2,\n2,-2,8,1\n").expect("a table");
        assert!(meets(&table, &demand("x", "y", [0.2, 0.3])).is_ok(), "1/4");
        let error = meets(&table, &demand("x", "y", [0.26, 0.3])).expect_err("too little");
        assert_eq!(error, "mean x of stage 2 over that of y is 0.25, expected 0.26 to 0.3");
        assert!(meets(&table, &demand("x", "z", [f64::NEG_INFINITY, f64::INFINITY])).is_err(), "no number");
    }
}
