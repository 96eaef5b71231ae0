//! Aligned text for a terminal.

use super::{Cell, Format, Table, significant};

/// Six digits: more than a measurement has, fewer than a terminal line can bear.
const DIGITS: usize = 6;

/// Aligned text.
pub(super) const FORMAT: Format = Format {
    name: "text",
    extension: "txt",
    summary: "aligned columns for reading, numbers rounded to six digits",
    write: |table, out| out.write_all(render(table, DIGITS).as_bytes()),
};

/// Columns of numbers end, columns of words begin, under one another; no blanks end a line.
pub(super) fn render(table: &Table, digits: usize) -> String {
    let rows: Vec<Vec<String>> =
        table.rows().iter().map(|row| row.iter().map(|cell| show(cell, digits)).collect()).collect();
    let columns = table.columns().iter().enumerate().map(|(number, name)| Layout {
        width: rows.iter().map(|row| width(&row[number])).max().unwrap_or(0).max(width(name)),
        words: table.rows().iter().any(|row| matches!(row[number], Cell::Text(_))),
    });
    let columns: Vec<Layout> = columns.collect();
    let rule: Vec<String> = columns.iter().map(|column| "-".repeat(column.width)).collect();
    let mut text = String::new();
    for line in [table.columns(), &rule].into_iter().chain(rows.iter().map(Vec::as_slice)) {
        push_line(&mut text, line, &columns);
    }
    text
}

struct Layout {
    width: usize,
    words: bool,
}

fn push_line(text: &mut String, cells: &[String], columns: &[Layout]) {
    let start = text.len();
    for (cell, column) in cells.iter().zip(columns) {
        let padding = " ".repeat(column.width - width(cell));
        let separator = if text.len() == start { "" } else { "  " };
        let (before, after) = if column.words { ("", padding.as_str()) } else { (padding.as_str(), "") };
        text.push_str(separator);
        text.push_str(before);
        text.push_str(cell);
        text.push_str(after);
    }
    text.truncate(start + text[start..].trim_end().len());
    text.push('\n');
}

fn show(cell: &Cell, digits: usize) -> String {
    match cell {
        Cell::Number(value) => significant(*value, digits),
        // A line break would tear the row apart.
        Cell::Text(words) => words.replace(['\n', '\r', '\t'], " "),
        Cell::Empty => String::new(),
    }
}

/// Characters, not bytes: `µ` and `²` take one place in a terminal.
fn width(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn numbers_end_and_words_begin_under_one_another() {
        let mut table = Table::new(["µ [-]", "law"]);
        table.push([Cell::Number(0.5), Cell::from("luding")]).unwrap();
        table.push([Cell::Number(1.25e-9), Cell::from("two\nlines")]).unwrap();
        table.push([Cell::Empty, Cell::Empty]).unwrap();
        assert_eq!(
            table.to_text(3),
            "  µ [-]  law\n-------  ---------\n    0.5  luding\n1.25e-9  two lines\n\n"
        );
    }
}
