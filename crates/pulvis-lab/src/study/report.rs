//! The report on a study.

use super::results::{Status, StudyResults};
use super::{chart, tables};
use pulvis_input::study::{Study, StudyMeasure};
use pulvis_io::IoError;
use pulvis_io::report::{Block, Report, Section, SummaryRow, Verdict};
use pulvis_io::table::{Cell, Table, significant};

/// What the numbers mean.
const LEAD: &str = "Means are over the runs of a point that are complete, one for each seed. The spread is the standard deviation \
    between them, the standard error the spread over the root of their number; bars in the pictures are one standard error up \
    and down. A mean passes if it differs from what is expected by no more than the tolerance and two standard errors; a single \
    run has no standard error and is held against the tolerance alone.";

/// The report; `facts` say who computed it, when, on what.
pub(super) fn report(
    study: &Study,
    results: &StudyResults,
    facts: Vec<(String, String)>,
) -> Result<Report, IoError> {
    let mut sections = vec![of_runs(study, results)?];
    let mut summary = vec![SummaryRow {
        cells: vec!["runs".to_owned(), counts(results), String::new()],
        verdict: verdict_of_runs(results),
    }];
    for (number, measure) in study.measures.iter().enumerate() {
        let verdict = results.verdict_of(number);
        let expected = measure.expected.as_ref().map_or("nothing is expected".to_owned(), |expected| {
            let certainty =
                expected.certainty.as_ref().map_or(String::new(), |grade| format!(", certainty {grade}"));
            format!("{}{certainty}", expected.source)
        });
        let verdict = verdict.unwrap_or(Verdict::Unjudged);
        summary
            .push(SummaryRow { cells: vec![measure.key.clone(), measure.what.clone(), expected], verdict });
        sections.push(of_measure(study, results, (number, measure), verdict)?);
    }
    Ok(Report {
        title: study.title.clone(),
        lead: LEAD.split_whitespace().collect::<Vec<_>>().join(" "),
        facts,
        summary_columns: ["measure", "what", "expected by", "verdict"].map(str::to_owned).to_vec(),
        summary,
        sections,
    })
}

fn counts(results: &StudyResults) -> String {
    let states = [Status::Complete, Status::Failed(String::new()), Status::Interrupted, Status::Waiting];
    let counted = states.iter().map(|status| (status.word(), results.count(status.word())));
    let told: Vec<String> =
        counted.filter(|(_, count)| *count > 0).map(|(word, count)| format!("{count} {word}")).collect();
    told.join(", ")
}

fn verdict_of_runs(results: &StudyResults) -> Verdict {
    let complete = results.count(Status::Complete.word()) == results.runs.len();
    if complete { Verdict::Passed } else { Verdict::Failed }
}

fn of_runs(study: &Study, results: &StudyResults) -> Result<Section, IoError> {
    let about = format!(
        "{} points with {} run{} each: {}.",
        study.points.len(),
        study.seeds.len(),
        if study.seeds.len() == 1 { "" } else { "s" },
        counts(results)
    );
    let mut blocks = vec![Block::Paragraph(about)];
    let mut failed = Table::new(["point", "seed", "why it failed"]);
    for run in &results.runs {
        if let Status::Failed(message) = &run.status {
            let point = study.points.get(run.point).map_or("", |point| point.name.as_str());
            failed.push([
                Cell::from(point),
                Cell::from(run.seed.to_string()),
                Cell::from(message.as_str()),
            ])?;
        }
    }
    if !failed.rows().is_empty() {
        blocks.push(Block::Table(failed));
    }
    blocks.push(Block::Files(["runs.csv", "study.csv", "study.json"].map(str::to_owned).to_vec()));
    let listing = |head: String, text: &str| Block::Listing { head, text: text.to_owned() };
    blocks.push(listing(study.file.display().to_string(), study.text()));
    blocks.push(listing(study.scenario.display().to_string(), &study.scenario_text));
    let verdict = verdict_of_runs(results);
    Ok(Section { anchor: "runs".to_owned(), title: "Runs".to_owned(), verdict, blocks })
}

fn of_measure(
    study: &Study,
    results: &StudyResults,
    (number, measure): (usize, &StudyMeasure),
    verdict: Verdict,
) -> Result<Section, IoError> {
    let files = ["png", "svg"].map(|ending| format!("{}.{ending}", measure.key));
    let mut blocks = vec![Block::Picture {
        svg: chart::figure(study, results, number).to_svg()?,
        file: files[0].clone(),
        alternative: measure.what.clone(),
    }];
    if let Some(expected) = &measure.expected {
        let certainty = match expected.certainty.as_deref() {
            Some("A") => " Certainty A: exact, or stands in the source.",
            Some("B") => " Certainty B: read off, or disputed.",
            Some(_) => " Certainty C: an estimate.",
            None => "",
        };
        let text =
            format!("{}, tolerance {}.{certainty}", expected.source, significant(expected.tolerance, 3));
        blocks.push(Block::Remark { head: "Expected.".to_owned(), text });
    }
    blocks.push(Block::Table(tables::of_measure(study, results, number)?));
    blocks.push(Block::Files(files.to_vec()));
    let title = format!("{}: {}", measure.key, measure.what);
    Ok(Section { anchor: format!("measure-{}", measure.key), title, verdict, blocks })
}
