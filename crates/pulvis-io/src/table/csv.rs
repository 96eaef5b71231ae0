//! Comma-separated values.

use super::number::exact;
use super::{Cell, Format, Table};
use std::io::{self, Write};

/// Comma-separated values after RFC 4180, lines ending in a line feed.
pub(super) const FORMAT: Format = Format {
    name: "csv",
    extension: "csv",
    summary: "comma-separated values with a header line, exact numbers, for spreadsheets and pandas",
    write,
};

fn write(table: &Table, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(table.columns())?;
    for row in table.rows() {
        writer.write_record(row.iter().map(show))?;
    }
    writer.flush()
}

fn show(cell: &Cell) -> String {
    match cell {
        Cell::Number(value) => exact(*value),
        Cell::Text(words) => words.clone(),
        Cell::Empty => String::new(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn words_with_commas_and_quotes_come_back() {
        let mut table = Table::new(["a, b", "c"]);
        table.push([Cell::from("say \"x\"\nand y"), Cell::Number(f64::NEG_INFINITY)]).unwrap();
        let text = table.to_string(&FORMAT).unwrap();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        assert_eq!(reader.headers().unwrap(), vec!["a, b", "c"]);
        assert_eq!(reader.records().next().unwrap().unwrap(), vec!["say \"x\"\nand y", "-inf"]);
    }
}
