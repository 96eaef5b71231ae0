//! One page: style and pictures inside.

use super::{Block, DIGITS, Image, Report, Section, Verdict, marked_up};
use crate::table::{Cell, Table, significant};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;

/// For screens light and dark, wide and narrow, and for paper.
const STYLE: &str = include_str!("style.css");

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn text(text: &str) -> String {
    marked_up(text, escape)
}

fn badge(verdict: Verdict) -> String {
    let word = verdict.word();
    format!("<span class=\"badge {word}\">{word}</span>")
}

pub(super) fn render(report: &Report) -> String {
    let title = text(&report.title);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<main>\n<h1>{title}</h1>\n<p>{}</p>\n",
        text(&report.lead)
    );
    page += "<dl class=\"facts\">\n";
    for (name, value) in &report.facts {
        // Writing to a string never fails.
        let _ = writeln!(page, "<div><dt>{}</dt><dd>{}</dd></div>", text(name), text(value));
    }
    page += "</dl>\n";
    page += &summary(report);
    for section in &report.sections {
        page += &self::section(section);
    }
    page + "</main>\n</body>\n</html>\n"
}

fn summary(report: &Report) -> String {
    let head: String = report.summary_columns.iter().map(|name| format!("<th>{}</th>", text(name))).collect();
    let mut rows = String::new();
    for (row, section) in report.summary.iter().zip(&report.sections) {
        rows += "<tr>";
        for (number, cell) in row.cells.iter().enumerate() {
            let cell = text(cell);
            let cell = if number == 0 { format!("<a href=\"#{}\">{cell}</a>", section.anchor) } else { cell };
            let _ = write!(rows, "<td>{cell}</td>");
        }
        let _ = writeln!(rows, "<td>{}</td></tr>", badge(row.verdict));
    }
    format!(
        "<div class=\"wide\"><table class=\"summary\">\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

fn section(section: &Section) -> String {
    let Section { anchor, title, verdict, blocks } = section;
    let mut html = format!("<section id=\"{anchor}\">\n<h2>{} {}</h2>\n", text(title), badge(*verdict));
    for block in blocks {
        html += &match block {
            Block::Paragraph(words) => format!("<p>{}</p>\n", text(words)),
            Block::Caption(words) => format!("<p class=\"caption\">{}</p>\n", text(words)),
            Block::Remark { head, text: words } => {
                format!("<p class=\"remark\"><b>{}</b> {}</p>\n", text(head), text(words))
            }
            Block::Picture { svg, alternative, .. } => format!(
                "<figure role=\"img\" aria-label=\"{}\">{}</figure>\n",
                escape(alternative),
                svg.trim()
            ),
            Block::Images(images) => {
                format!("<div class=\"images\">{}</div>\n", images.iter().map(image).collect::<String>())
            }
            Block::Table(table) => self::table(table),
            Block::Files(files) => {
                let links = files.iter().map(|file| format!("<a href=\"{0}\">{0}</a>", escape(file)));
                format!("<p class=\"files\">{}</p>\n", links.collect::<Vec<_>>().join(" · "))
            }
            Block::Listing { head, text: listing } => format!(
                "<details><summary>{}</summary><pre>{}</pre></details>\n",
                text(head),
                escape(listing)
            ),
        };
    }
    html + "</section>\n"
}

fn image(image: &Image) -> String {
    let Image { png, caption, .. } = image;
    format!(
        "<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>",
        escape(caption),
        STANDARD.encode(png),
        text(caption)
    )
}

fn table(table: &Table) -> String {
    let head: String = table.columns().iter().map(|name| format!("<th>{}</th>", text(name))).collect();
    let cell = |cell: &Cell| match cell {
        Cell::Number(value) => format!("<td class=\"number\">{}</td>", significant(*value, DIGITS)),
        Cell::Text(words) => format!("<td>{}</td>", text(words)),
        Cell::Empty => "<td></td>".to_owned(),
    };
    let row = |row: &Vec<Cell>| format!("<tr>{}</tr>\n", row.iter().map(cell).collect::<String>());
    let rows: String = table.rows().iter().map(row).collect();
    format!(
        "<div class=\"wide\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}
