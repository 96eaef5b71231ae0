//! The report on figures that were computed.

use super::judge::Judged;
use super::run::Attempt;
use super::snapshots::snapshot_files;
use super::{Reproduction, ReproductionError, Snapshot};
use pulvis_input::figure::{Experiment, Feature, FigureData, FigureScenario};
use pulvis_io::report::{Block, Image, Report, Section, SummaryRow, Verdict};
use pulvis_io::table::{Cell, Table, significant};

/// What the report is about.
const LEAD: &str = "Figures of the two papers on the contact model for adhesive, elasto-plastic meso-particles, computed anew. \
    S1: A. Singh, V. Magnanimo, S. Luding, Contact model for sticking of adhesive meso-particles, arXiv:1503.03720. \
    S0: the same authors, Sticking of adhesive particles in elasto-plastic collisions. Lines are closed forms unless the \
    legend says otherwise. Rings: the exact method, good to about 1e-12. Crosses: the engine's integrator at the automatic \
    time step, 50 steps in the shortest contact time. Figures of many particles show time series of the engine.";

/// Heads of the summary.
const SUMMARY: [&str; 7] = [
    "figure",
    "shows",
    "reproduces",
    "exact method: largest deviation",
    "engine: largest deviation",
    "time",
    "verdict",
];

/// The report on all attempts; `facts` say who computed them, when, on what.
///
/// # Errors
/// A picture cannot be drawn.
pub fn report(attempts: &[Attempt], facts: Vec<(String, String)>) -> Result<Report, ReproductionError> {
    let sections = attempts.iter().map(section).collect::<Result<_, _>>()?;
    Ok(Report {
        title: "Reproduced figures".to_owned(),
        lead: LEAD.split_whitespace().collect::<Vec<_>>().join(" "),
        facts,
        summary_columns: SUMMARY.map(str::to_owned).to_vec(),
        summary: attempts.iter().map(summary).collect(),
        sections,
    })
}

/// Names of the files that belong to a figure.
pub fn files(figure: &FigureScenario) -> Vec<String> {
    let name = &figure.name;
    let mut files: Vec<String> =
        ["png", "svg", "csv"].iter().map(|ending| format!("{name}.{ending}")).collect();
    if !figure.features.is_empty() {
        files.push(feature_file(figure));
    }
    files.extend(snapshot_files(figure));
    files
}

/// The file of what is seen in runs.
pub(super) fn feature_file(figure: &FigureScenario) -> String {
    format!("{}-features.csv", figure.name)
}

fn verdict(attempt: &Attempt) -> Verdict {
    match &attempt.outcome {
        Err(_) => Verdict::Failed,
        Ok(reproduction) if reproduction.passes() => Verdict::Passed,
        Ok(_) => Verdict::Missed,
    }
}

fn summary(attempt: &Attempt) -> SummaryRow {
    let worst = |of_engine: bool| {
        let checks = attempt.outcome.as_ref().map(|reproduction| reproduction.checks.as_slice());
        let own = checks.unwrap_or_default().iter().filter(|check| check.of_engine == of_engine);
        // A count of collisions is no deviation.
        let measured = own.filter(|check| check.most > 0.0);
        let closest = measured
            .max_by(|one, other| (one.deviation / one.most).total_cmp(&(other.deviation / other.most)));
        closest.map_or(String::new(), |check| {
            format!("{} ({} allowed)", significant(check.deviation, 2), significant(check.most, 2))
        })
    };
    let figure = &attempt.figure;
    let features = attempt.outcome.as_ref().map(|reproduction| reproduction.features.as_slice());
    let features = features.unwrap_or_default();
    let seen = features.iter().filter(|feature| feature.is_seen()).count();
    let of_engine = match features.len() {
        0 => worst(true),
        count => format!("{seen} of {count} features seen"),
    };
    SummaryRow {
        cells: vec![
            figure.name.clone(),
            figure.title.clone(),
            figure.reproduces.join(", "),
            worst(false),
            of_engine,
            format!("{:.1} s", attempt.duration),
        ],
        verdict: verdict(attempt),
    }
}

fn section(attempt: &Attempt) -> Result<Section, ReproductionError> {
    let figure = &attempt.figure;
    let mut blocks = Vec::new();
    if !figure.reproduces.is_empty() {
        blocks.push(Block::Paragraph(format!("Reproduces {}.", figure.reproduces.join(", "))));
    }
    match &attempt.outcome {
        Ok(reproduction) => {
            blocks.push(Block::Picture {
                svg: reproduction.picture.to_svg()?,
                file: format!("{}.png", figure.name),
                alternative: figure.title.clone(),
            });
            blocks.push(Block::Caption(figure.caption.clone()));
            blocks.extend(snapshots(reproduction));
            blocks.push(remark("Compared with the paper.", &figure.compared));
            blocks.extend(figure.notes.iter().map(|note| remark(&format!("{}.", note.key), &note.text)));
            blocks.extend(checks(reproduction)?);
            blocks.extend(feature_table(figure, reproduction)?.map(Block::Table));
            blocks.push(Block::Files(files(figure)));
        }
        Err(error) => blocks.push(remark("This figure could not be computed.", &error.to_string())),
    }
    blocks.push(remark("Command.", &format!("pulvis reproduce {}", figure.name)));
    blocks.extend(listings(figure));
    Ok(Section {
        anchor: figure.name.clone(),
        title: format!("{}: {}", figure.name, figure.title),
        verdict: verdict(attempt),
        blocks,
    })
}

/// Pictures of particles, those with one title beside one another.
fn snapshots(reproduction: &Reproduction) -> Vec<Block> {
    let together = reproduction.snapshots.chunk_by(|one, other| one.title == other.title);
    let blocks = together.map(|snapshots| {
        let image = |snapshot: &Snapshot| Image {
            png: snapshot.png.clone(),
            file: snapshot.file.clone(),
            caption: snapshot.stage.clone(),
        };
        let title = snapshots.first().map_or("", |snapshot| snapshot.title.as_str());
        [Block::Images(snapshots.iter().map(image).collect()), Block::Caption(title.to_owned())]
    });
    blocks.flatten().collect()
}

fn remark(head: &str, text: &str) -> Block {
    Block::Remark { head: head.to_owned(), text: text.to_owned() }
}

fn checks(reproduction: &Reproduction) -> Result<Option<Block>, ReproductionError> {
    if reproduction.checks.is_empty() {
        return Ok(None);
    }
    let mut table = Table::new([
        "check",
        "values",
        "largest deviation",
        "allowed",
        "unit",
        "where",
        "verdict",
        "why so much is allowed",
    ]);
    for check in &reproduction.checks {
        let Judged { what, deviation, most, unit, compared, place, why, .. } = check;
        let verdict = if check.passes() { Verdict::Passed } else { Verdict::Missed };
        table.push([
            Cell::from(what.as_str()),
            Cell::from(compared.to_string()),
            Cell::from(*deviation),
            Cell::from(*most),
            Cell::from(unit.as_str()),
            Cell::from(place.as_str()),
            Cell::from(verdict.word()),
            Cell::from(why.as_str()),
        ])?;
    }
    Ok(Some(Block::Table(table)))
}

/// What is seen in runs, with a column for each variant; none where nothing was looked for.
pub(super) fn feature_table(
    figure: &FigureScenario,
    reproduction: &Reproduction,
) -> Result<Option<Table>, ReproductionError> {
    let seen = &reproduction.features;
    if seen.is_empty() {
        return Ok(None);
    }
    let used =
        |number: &usize| seen.iter().any(|one| one.values.iter().any(|(variant, _)| variant == number));
    let variants: Vec<usize> = (0..figure.variants.len()).filter(used).collect();
    let name = |number: &usize| {
        let name = figure.variants.get(*number).map_or("", |variant| variant.name.as_str());
        if name.is_empty() { "value".to_owned() } else { name.to_owned() }
    };
    let several = variants.len() > 1;
    let mut columns = vec!["feature".to_owned(), "what".to_owned(), "asked for".to_owned()];
    columns.extend(variants.iter().map(name));
    columns.extend(["mean", "spread", "standard error"].into_iter().filter(|_| several).map(str::to_owned));
    columns.extend(["verdict", "why these bounds"].map(str::to_owned));
    let mut table = Table::new(columns);
    for one in seen {
        let feature = &one.feature;
        let of_variant = |number: &usize| {
            let value = one.values.iter().find(|(variant, _)| variant == number);
            value.map_or(Cell::from(""), |(_, value)| marked(*value, one.allows(*value)))
        };
        let mut row = vec![Cell::from(feature.key.as_str()), Cell::from(feature.what.as_str())];
        row.push(Cell::from(bounds(feature)));
        row.extend(variants.iter().map(of_variant));
        if several {
            let unless_nan = |value: f64| if value.is_nan() { Cell::from("") } else { Cell::from(value) };
            let [spread, error] = [one.deviation(), one.standard_error()].map(unless_nan);
            row.extend([Cell::from(one.mean()), spread, error]);
        }
        let verdict = match (one.is_seen(), &feature.known_to_miss) {
            (true, _) => "seen".to_owned(),
            (false, Some(reason)) => format!("not seen: {reason}"),
            (false, None) => Verdict::Missed.word().to_owned(),
        };
        row.extend([Cell::from(verdict), Cell::from(feature.why.as_str())]);
        table.push(row)?;
    }
    Ok(Some(table))
}

/// A value; a mark stands behind one that is not as it has to be.
fn marked(value: f64, is_allowed: bool) -> Cell {
    if is_allowed { Cell::from(value) } else { Cell::from(format!("{} (!)", significant(value, 3))) }
}

/// Bounds in words.
fn bounds(feature: &Feature) -> String {
    let [least, most] = [feature.least, feature.most].map(|bound| significant(bound, 3));
    match (feature.least.is_finite(), feature.most.is_finite()) {
        (true, true) => format!("{least} to {most}"),
        (true, false) => format!("at least {least}"),
        _ => format!("at most {most}"),
    }
}

/// The scenarios, which hold all parameters; each file once.
fn listings(figure: &FigureScenario) -> Vec<Block> {
    let mut blocks = Vec::new();
    for (number, data) in figure.data.iter().enumerate() {
        let own = figure.data.iter().filter(|other| other.file == data.file);
        let is_first = figure.data.iter().position(|other| other.file == data.file) == Some(number);
        if is_first {
            let changed: Vec<String> = own.filter_map(changes).collect();
            let changed =
                if changed.is_empty() { String::new() } else { format!(" ({})", changed.join("; ")) };
            let name = data.file.file_name().unwrap_or_default().to_string_lossy();
            blocks.push(Block::Listing {
                head: format!("Parameters: {name}{changed}"),
                text: data.text.clone(),
            });
        }
    }
    blocks
}

/// What a figure sets in a scenario.
fn changes(data: &FigureData) -> Option<String> {
    let Experiment::Runs(runs) = &data.experiment else { return None };
    let set: Vec<String> = runs.set.iter().map(|(key, value)| format!("{key} = {value}")).collect();
    (!set.is_empty()).then(|| format!("{}: {}", data.name, set.join(", ")))
}
