//! Markdown, with pictures as files beside it.

use super::{Block, DIGITS, Image, Report, Section, marked_up};
use crate::table::{Cell, Table, significant};

fn escape(text: &str) -> String {
    text.replace('\\', "\\\\")
        .replace('<', "&lt;")
        .replace('|', "\\|")
        .replace('_', "\\_")
        .replace('*', "\\*")
}

fn text(text: &str) -> String {
    marked_up(text, escape)
}

pub(super) fn render(report: &Report) -> String {
    let mut page = format!("# {}\n\n{}\n\n", text(&report.title), text(&report.lead));
    for (name, value) in &report.facts {
        page += &format!("- {}: {}\n", text(name), text(value));
    }
    page += "\n";
    let rows = report.summary.iter().map(|row| {
        let cells = row.cells.iter().map(|cell| text(cell));
        cells.chain([row.verdict.word().to_owned()]).collect()
    });
    page += &grid(&report.summary_columns, rows);
    for section in &report.sections {
        page += &self::section(section);
    }
    page
}

fn section(section: &Section) -> String {
    let mut page = format!("\n## {} ({})\n", text(&section.title), section.verdict.word());
    for block in &section.blocks {
        page += "\n";
        page += &match block {
            Block::Paragraph(words) | Block::Caption(words) => format!("{}\n", text(words)),
            Block::Remark { head, text: words } => format!("**{}** {}\n", text(head), text(words)),
            Block::Picture { file, alternative, .. } => format!("![{}]({file})\n", text(alternative)),
            Block::Images(images) => {
                let image = |image: &Image| format!("![{}]({})", text(&image.caption), image.file);
                images.iter().map(image).collect::<Vec<_>>().join(" ") + "\n"
            }
            Block::Table(table) => self::table(table),
            // No links: a report is also kept without all its files.
            Block::Files(files) => format!("Files: {}\n", text(&files.join(", "))),
            Block::Listing { head, text: listing } => {
                format!("{}:\n\n```toml\n{}\n```\n", text(head), listing.trim_end())
            }
        };
    }
    page
}

fn table(table: &Table) -> String {
    let cell = |cell: &Cell| match cell {
        Cell::Number(value) => significant(*value, DIGITS),
        Cell::Text(words) => text(words),
        Cell::Empty => String::new(),
    };
    grid(table.columns(), table.rows().iter().map(|row| row.iter().map(cell).collect()))
}

fn grid(columns: &[String], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let head = line(columns.iter().map(|name| text(name)).collect());
    let rule = line(columns.iter().map(|_| "---".to_owned()).collect());
    head + &rule + &rows.map(line).collect::<String>()
}
