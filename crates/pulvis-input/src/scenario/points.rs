//! Tables of particle positions in files.

use super::arrangement::Grain;
use crate::problem::{LONGEST_VALUE, shortened};
use pulvis_math::Vector3;
use std::path::Path;
use thiserror::Error;

/// Why a file of positions cannot be used.
#[derive(Debug, Error)]
pub enum PointsError {
    /// No such file.
    #[error("there is no file {file}")]
    Missing {
        /// The path of the file.
        file: String,
    },
    /// The file cannot be read.
    #[error("{file} cannot be read: {reason}")]
    Unreadable {
        /// The path of the file.
        file: String,
        /// The refusal of the operating system.
        reason: std::io::Error,
    },
    /// No particle stands in the file.
    #[error("{file} holds no particles; expected a line of numbers for each")]
    Empty {
        /// The path of the file.
        file: String,
    },
    /// Names of columns that are not known, or in another order.
    #[error(
        "{file}:{line}: found the columns {found}; expected x,y,z or x,y,z,radius, then vx,vy,vz or nothing"
    )]
    Columns {
        /// The path of the file.
        file: String,
        /// The number of the line, the first is 1.
        line: usize,
        /// The columns.
        found: String,
    },
    /// A line with too few or too many values.
    #[error("{file}:{line}: found {found} values; expected {expected}, as in the lines before")]
    Count {
        /// The path of the file.
        file: String,
        /// The number of the line.
        line: usize,
        /// Number of values.
        found: usize,
        /// Number of columns.
        expected: usize,
    },
    /// A value that is no finite number, or a radius that is not positive.
    #[error("{file}:{line}: {column} is {found}; expected {expected}")]
    Value {
        /// The path of the file.
        file: String,
        /// The number of the line.
        line: usize,
        /// The column.
        column: &'static str,
        /// The value as written.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
}

/// The columns of a table.
#[derive(Clone, Copy)]
struct Columns {
    radius: bool,
    velocity: bool,
}

impl Columns {
    fn names(self) -> Vec<&'static str> {
        let mut names = vec!["x", "y", "z"];
        names.extend(self.radius.then_some("radius"));
        names.extend(self.velocity.then_some(["vx", "vy", "vz"]).into_iter().flatten());
        names
    }

    fn from_header(header: &[&str]) -> Option<Self> {
        Self::all().into_iter().find(|columns| columns.names() == header)
    }

    /// What a table without header means by its number of columns.
    fn from_count(count: usize) -> Option<Self> {
        match count {
            3 => Some(Self { radius: false, velocity: false }),
            4 => Some(Self { radius: true, velocity: false }),
            7 => Some(Self { radius: true, velocity: true }),
            _ => None,
        }
    }

    fn all() -> [Self; 4] {
        [(false, false), (true, false), (false, true), (true, true)]
            .map(|(radius, velocity)| Self { radius, velocity })
    }
}

/// Reads a file of positions.
pub(super) fn read_points(path: &Path) -> Result<Vec<Grain>, PointsError> {
    let file = path.display().to_string();
    match std::fs::read_to_string(path) {
        Ok(text) => parse_points(&file, &text),
        Err(reason) if reason.kind() == std::io::ErrorKind::NotFound => Err(PointsError::Missing { file }),
        Err(reason) => Err(PointsError::Unreadable { file, reason }),
    }
}

fn parse_points(file: &str, text: &str) -> Result<Vec<Grain>, PointsError> {
    let mut grains = Vec::new();
    let mut columns = None;
    for (index, content) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = index + 1;
        let names = columns.is_none();
        // The header of a whitespace table is often a comment.
        let content = if names { content.trim_start_matches(['#', ' ']) } else { content };
        let content = content.split('#').next().unwrap_or_default();
        let cells: Vec<&str> = if content.contains(',') {
            content.split(',').map(str::trim).collect()
        } else {
            content.split_whitespace().collect()
        };
        if cells.is_empty() {
            continue;
        }
        let header = cells.first().is_some_and(|cell| cell.parse::<f64>().is_err());
        let known = match columns {
            Some(columns) => columns,
            None => {
                let found =
                    if header { Columns::from_header(&cells) } else { Columns::from_count(cells.len()) };
                let unknown = || PointsError::Columns {
                    file: file.to_owned(),
                    line,
                    found: shortened(&cells.join(","), 120),
                };
                let found = found.ok_or_else(unknown)?;
                columns = Some(found);
                if header {
                    continue;
                }
                found
            }
        };
        grains.push(parse_grain(file, line, &cells, known)?);
    }
    if grains.is_empty() {
        return Err(PointsError::Empty { file: file.to_owned() });
    }
    Ok(grains)
}

fn parse_grain(file: &str, line: usize, cells: &[&str], columns: Columns) -> Result<Grain, PointsError> {
    let names = columns.names();
    if cells.len() != names.len() {
        let (found, expected) = (cells.len(), names.len());
        return Err(PointsError::Count { file: file.to_owned(), line, found, expected });
    }
    let mut values = Vec::with_capacity(names.len());
    for (column, cell) in names.into_iter().zip(cells) {
        let refused = |expected| PointsError::Value {
            file: file.to_owned(),
            line,
            column,
            found: format!("\"{}\"", shortened(cell, LONGEST_VALUE)),
            expected,
        };
        match cell.parse::<f64>() {
            Ok(value) if !value.is_finite() => return Err(refused("a finite number")),
            Ok(value) if column == "radius" && value <= 0.0 => return Err(refused("a radius above 0 m")),
            Ok(value) => values.push(value),
            Err(_) => return Err(refused("a number in SI")),
        }
    }
    let mut values = values.into_iter();
    let mut next = || values.next().unwrap_or_default();
    let position = Vector3::new(next(), next(), next());
    let radius = columns.radius.then(&mut next);
    let velocity = columns.velocity.then(|| Vector3::new(next(), next(), next()));
    Ok(Grain { position, radius, velocity })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    fn refusal(text: &str) -> String {
        parse_points("grains.csv", text).unwrap_err().to_string()
    }

    #[test]
    fn commas_and_blanks_give_the_same_grains() {
        let comma = parse_points("a", "x,y,z,radius\n1,2,3,0.5\n# a comment\n\n4, 5, 6, 0.25\n").unwrap();
        let blank = parse_points("a", "# x y z radius\n1 2 3 0.5\n4  5\t6 2.5e-1 # last\n").unwrap();
        let bare = parse_points("a", "1 2 3 0.5\n4 5 6 0.25").unwrap();
        assert_eq!(comma, blank);
        assert_eq!(comma, bare);
        assert_eq!(comma[1].radius, Some(0.25));
    }

    #[test]
    fn velocities_follow_positions_or_radii() {
        let grains = parse_points("a", "x,y,z,vx,vy,vz\n1,2,3,4,5,6").unwrap();
        let expected = Grain {
            position: Vector3::new(1.0, 2.0, 3.0),
            radius: None,
            velocity: Some(Vector3::new(4.0, 5.0, 6.0)),
        };
        assert_eq!(grains, [expected]);
    }

    #[test]
    fn a_wrong_line_is_named() {
        let header = "x,y,z,radius\n1,2,3,0.5\n";
        assert_eq!(refusal(""), "grains.csv holds no particles; expected a line of numbers for each");
        assert_eq!(
            refusal("x,y,radius\n"),
            "grains.csv:1: found the columns x,y,radius; expected x,y,z or x,y,z,radius, then vx,vy,vz or nothing"
        );
        assert_eq!(
            refusal(&format!("{header}1,2,3")),
            "grains.csv:3: found 3 values; expected 4, as in the lines before"
        );
        assert_eq!(
            refusal(&format!("{header}1,2,NaN,0.5")),
            "grains.csv:3: z is \"NaN\"; expected a finite number"
        );
        assert_eq!(
            refusal(&format!("{header}1,2,3,-0.5")),
            "grains.csv:3: radius is \"-0.5\"; expected a radius above 0 m"
        );
        assert_eq!(
            refusal(&format!("{header}1,two,3,0.5")),
            "grains.csv:3: y is \"two\"; expected a number in SI"
        );
    }
}
