//! The report on figures that were computed.

use super::judge::Judged;
use super::run::Attempt;
use super::{Reproduction, ReproductionError};
use pulvis_input::figure::FigureData;
use pulvis_io::report::{Block, Report, Section, SummaryRow, Verdict};
use pulvis_io::table::{Cell, Table, significant};

/// What the report is about.
const LEAD: &str = "Figures of the two papers on the contact model for adhesive, elasto-plastic meso-particles, computed anew. \
    S1: A. Singh, V. Magnanimo, S. Luding, Contact model for sticking of adhesive meso-particles, arXiv:1503.03720. \
    S0: the same authors, Sticking of adhesive particles in elasto-plastic collisions. Lines are closed forms unless the \
    legend says otherwise. Rings: the exact method, good to about 1e-12. Crosses: the engine's integrator at the automatic \
    time step, 50 steps in the shortest contact time.";

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
pub fn files(name: &str) -> Vec<String> {
    ["png", "svg", "csv"].iter().map(|ending| format!("{name}.{ending}")).collect()
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
    SummaryRow {
        cells: vec![
            figure.name.clone(),
            figure.title.clone(),
            figure.reproduces.join(", "),
            worst(false),
            worst(true),
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
            blocks.push(remark("Compared with the paper.", &figure.compared));
            blocks.extend(figure.notes.iter().map(|note| remark(&format!("{}.", note.key), &note.text)));
            blocks.extend(checks(reproduction)?);
            blocks.push(Block::Files(files(&figure.name)));
        }
        Err(error) => blocks.push(remark("This figure could not be computed.", &error.to_string())),
    }
    blocks.push(remark("Command.", &format!("pulvis reproduce {}", figure.name)));
    blocks.extend(figure.data.iter().map(listing));
    Ok(Section {
        anchor: figure.name.clone(),
        title: format!("{}: {}", figure.name, figure.title),
        verdict: verdict(attempt),
        blocks,
    })
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

/// The scenario, which holds all parameters.
fn listing(data: &FigureData) -> Block {
    let name = data.file.file_name().unwrap_or_default().to_string_lossy();
    Block::Listing { head: format!("Parameters: {name}"), text: data.text.clone() }
}
