//! Numbers with names: columns of them, and records that are written and read back so that none is forgotten.

use pulvis_math::Vector3;
use thiserror::Error;

/// One number for each of something, with a name and a unit: a quantity of particles that no part of the engine
/// needs to know, such as a charge or a temperature.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedColumn {
    /// What the numbers mean, in a word for files: `charge`.
    pub name: String,
    /// SI unit of the values, for people: `C`; `1` for pure numbers.
    pub unit: String,
    /// The numbers.
    pub values: Vec<f64>,
}

/// Numbers by their names.
pub(crate) type NamedNumbers = Vec<(String, f64)>;

/// A number that has a name is missing, or nothing is known of it.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{owner} {problem} `{name}`; the state is damaged, or of another version")]
pub struct NameError {
    /// What the number belongs to.
    pub owner: String,
    /// Whether it is missing or unknown.
    pub problem: &'static str,
    /// Its name.
    pub name: String,
}

/// Writes numbers down by their names.
#[derive(Debug, Default)]
pub(crate) struct NumberWriter(NamedNumbers);

impl NumberWriter {
    pub(crate) fn number(&mut self, name: &str, value: f64) {
        self.0.push((name.to_owned(), value));
    }

    pub(crate) fn vector(&mut self, name: &str, vector: Vector3) {
        for (axis, value) in ["x", "y", "z"].into_iter().zip(vector.to_array()) {
            self.number(&format!("{name}_{axis}"), value);
        }
    }

    pub(crate) fn finish(self) -> NamedNumbers {
        self.0
    }
}

/// Reads back what a [`NumberWriter`] has written, in the same order.
#[derive(Debug)]
pub(crate) struct NumberReader<'a> {
    owner: &'a str,
    numbers: std::slice::Iter<'a, (String, f64)>,
}

impl<'a> NumberReader<'a> {
    /// Of the numbers of `owner`.
    pub(crate) fn new(owner: &'a str, numbers: &'a [(String, f64)]) -> Self {
        Self { owner, numbers: numbers.iter() }
    }

    /// The next number, which must have this name.
    pub(crate) fn number(&mut self, name: &str) -> Result<f64, NameError> {
        match self.numbers.next() {
            Some((found, value)) if found == name => Ok(*value),
            _ => Err(self.refuse("lacks", name)),
        }
    }

    /// The next three numbers.
    pub(crate) fn vector(&mut self, name: &str) -> Result<Vector3, NameError> {
        let mut along = |axis: &str| self.number(&format!("{name}_{axis}"));
        Ok(Vector3::new(along("x")?, along("y")?, along("z")?))
    }

    /// Refuses what has not been read.
    pub(crate) fn finish(mut self) -> Result<(), NameError> {
        match self.numbers.next() {
            None => Ok(()),
            Some((name, _)) => Err(self.refuse("holds something unknown,", name)),
        }
    }

    fn refuse(&self, problem: &'static str, name: &str) -> NameError {
        NameError { owner: self.owner.to_owned(), problem, name: name.to_owned() }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn what_is_written_is_read_and_nothing_is_forgotten() {
        let mut writer = NumberWriter::default();
        writer.number("mass", 2.0);
        writer.vector("force", Vector3::new(1.0, -0.0, 3.0));
        let numbers = writer.finish();
        let mut reader = NumberReader::new("wall", &numbers);
        assert_eq!(reader.number("mass").unwrap(), 2.0);
        assert_eq!(reader.vector("force").unwrap().y.to_bits(), (-0.0_f64).to_bits());
        reader.finish().unwrap();
        let mut short = NumberReader::new("wall", &numbers[..3]);
        short.number("mass").unwrap();
        assert_eq!(
            short.vector("force").unwrap_err().to_string(),
            "wall lacks `force_z`; the state is damaged, or of another version"
        );
        let unread = NumberReader::new("wall", &numbers).finish().unwrap_err();
        assert_eq!(unread.name, "mass");
    }
}
