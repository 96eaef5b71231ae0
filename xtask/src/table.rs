//! The CSV tables that `pulvis` writes.

use crate::Outcome;

/// A table of numbers and names.
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a table; no cell of ours holds a comma.
    pub fn parse(text: &str) -> Outcome<Self> {
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = lines.next().ok_or("the table is empty")?;
        let rows: Vec<_> = lines.collect();
        match rows.iter().position(|row| row.len() != header.len()) {
            Some(row) => Err(format!("row {} of the table has not {} cells", row + 1, header.len())),
            None => Ok(Self { header, rows }),
        }
    }

    /// A column of texts.
    pub fn texts(&self, name: &str) -> Outcome<Vec<&str>> {
        let place = self.header.iter().position(|column| column == name);
        let place = place.ok_or_else(|| format!("the table has no column `{name}`"))?;
        Ok(self.rows.iter().map(|row| row[place].as_str()).collect())
    }

    /// A column of numbers; an empty cell is NaN.
    pub fn numbers(&self, name: &str) -> Outcome<Vec<f64>> {
        let texts = self.texts(name)?;
        let number = |text: &&str| match *text {
            "" => Ok(f64::NAN),
            text => text.parse().map_err(|_| format!("column `{name}`: `{text}` is no number")),
        };
        texts.iter().map(number).collect()
    }
}
