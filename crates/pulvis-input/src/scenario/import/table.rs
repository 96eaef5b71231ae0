//! Tables: values separated by commas or blanks, with names of columns or without.

use super::rows::Columns;
use super::{FileReading, PointsError};
use crate::scenario::arrangement::Grain;

/// What the columns of a table without names are.
const BARE: [&str; 7] = ["x", "y", "z", "radius", "vx", "vy", "vz"];

pub(super) fn parse(file: &str, text: &str, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    let mut grains = Vec::new();
    let mut columns: Option<Columns> = None;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        // The header of a table with blanks is often a comment.
        let content = if columns.is_none() { content.trim_start_matches(['#', ' ']) } else { content };
        let content = content.split('#').next().unwrap_or_default();
        let cells: Vec<&str> = if content.contains(',') {
            content.split(',').map(str::trim).collect()
        } else {
            content.split_whitespace().collect()
        };
        if cells.is_empty() {
            continue;
        }
        let known = match &mut columns {
            Some(columns) => columns,
            None if cells.iter().all(|cell| cell.parse::<f64>().is_err()) => {
                columns = Some(Columns::named(file, line, &cells, reading)?);
                continue;
            }
            None => {
                if ![3, 4, 7].contains(&cells.len()) {
                    return Err(PointsError::Headless { file: file.to_owned(), line, found: cells.len() });
                }
                columns.insert(Columns::named(file, line, &BARE[..cells.len()], reading)?)
            }
        };
        grains.push(known.grain(file, line, &cells, reading)?);
    }
    Ok(grains)
}
