//! Values that another program computed, one quantity a row.

/// The file; see the README beside it.
const FILE: &str = include_str!("models.csv");

/// One quantity of one contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// The model.
    pub model: &'static str,
    /// Names and numbers in SI units, `k=100.0 m_r=5e-6`.
    pub parameters: &'static str,
    /// What it is.
    pub quantity: &'static str,
    /// Its value, in SI units.
    pub value: f64,
}

impl Row {
    fn read(line: &'static str) -> Option<Self> {
        let mut cells = line.split(',');
        let (model, parameters, quantity) = (cells.next()?, cells.next()?, cells.next()?);
        let value = cells.nth(1)?.parse().ok()?;
        Some(Self { model, parameters, quantity, value })
    }

    /// A parameter, if the row has it.
    pub fn get(&self, name: &str) -> Option<f64> {
        let pairs = self.parameters.split(' ').filter_map(|word| word.split_once('='));
        pairs.into_iter().find(|(known, _)| *known == name)?.1.parse().ok()
    }
}

/// Every row of the file.
pub(super) fn rows() -> impl Iterator<Item = Row> {
    FILE.lines().skip(1).filter_map(Row::read)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn every_line_of_the_file_is_read() {
        assert_eq!(rows().count(), FILE.lines().count() - 1);
        let row = rows().find(|row| row.model == "hertz_elastic" && row.quantity == "tc").unwrap();
        assert_eq!((row.get("E"), row.get("nonsense")), (Some(1e8), None));
        assert_eq!(row.value, 7.204757691773086e-05);
        assert!(rows().all(|row| row.value.is_finite()));
        let infinite = rows().filter(|row| row.parameters.contains("=inf"));
        assert!(
            infinite
                .into_iter()
                .all(|row| ["R2", "m2", "a2"].iter().any(|of| row.get(of) == Some(f64::INFINITY)))
        );
    }
}
