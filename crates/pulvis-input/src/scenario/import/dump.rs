//! Text dumps of LAMMPS.
//!
//! # Source
//! LAMMPS documentation, page `dump`: `ITEM: ATOMS` names the columns; an instant begins with `ITEM: TIMESTEP`, before
//! which `ITEM: UNITS` and `ITEM: TIME` may stand.

use super::rows::{Columns, structure, wanted};
use super::{FileReading, PointsError};
use crate::scenario::arrangement::Grain;

/// Where the lines of an instant begin.
struct Frame<'a> {
    columns: Vec<&'a str>,
    /// Index of the line of the names; the particles follow.
    header: usize,
    count: usize,
}

pub(super) fn parse(file: &str, text: &str, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    let lines: Vec<&str> = text.lines().collect();
    let mut frames = Vec::new();
    let (mut at, mut count) = (0, None);
    while let Some(line) = lines.get(at) {
        let Some(item) = line.strip_prefix("ITEM: ") else {
            return Err(structure(file, at + 1, Some(line), "a line that begins with ITEM:"));
        };
        let next = lines.get(at + 1).copied();
        if item.starts_with("NUMBER OF ATOMS") {
            let number = next.and_then(|next| next.trim().parse::<usize>().ok());
            count = Some(number.ok_or_else(|| structure(file, at + 2, next, "the number of particles"))?);
            at += 2;
        } else if let Some(names) = item.strip_prefix("ATOMS") {
            let count = count.take().ok_or_else(|| {
                structure(file, at + 1, Some(line), "ITEM: NUMBER OF ATOMS before the particles")
            })?;
            let end = at.saturating_add(1).saturating_add(count);
            if end > lines.len() {
                let expected = format!("{count} particles, as ITEM: NUMBER OF ATOMS says");
                return Err(structure(file, lines.len() + 1, None, &expected));
            }
            frames.push(Frame { columns: names.split_whitespace().collect(), header: at, count });
            at = end;
        } else {
            let body = match item.split_whitespace().next() {
                Some("TIMESTEP" | "TIME" | "UNITS") => 1,
                Some("BOX") => 3,
                _ => return Err(structure(file, at + 1, Some(line), "an item of a dump of particles")),
            };
            at += 1 + body;
        }
    }
    let Some(Frame { columns, header, count }) = wanted(file, frames, reading)? else {
        return Ok(Vec::new());
    };
    let columns = Columns::named(file, header + 1, &columns, reading)?;
    let particles = lines.iter().enumerate().skip(header + 1).take(count);
    particles
        .map(|(index, line)| {
            columns.grain(file, index + 1, &line.split_whitespace().collect::<Vec<_>>(), reading)
        })
        .collect()
}
