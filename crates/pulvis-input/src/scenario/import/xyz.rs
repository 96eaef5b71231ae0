//! XYZ files, extended or plain.
//!
//! # Source
//! The extended XYZ specification (`libAtoms/extxyz`): `Properties=name:kind:columns:...` in the second line of an instant.
//! Without it, the columns are a species and a position.

use super::rows::{Columns, structure, wanted};
use super::{FileReading, PointsError};
use crate::scenario::arrangement::Grain;

const AXES: [&str; 3] = ["x", "y", "z"];

pub(super) fn parse(file: &str, text: &str, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    let lines: Vec<&str> = text.lines().collect();
    let mut frames = Vec::new();
    let mut at = 0;
    while let Some(line) = lines.get(at) {
        if line.trim().is_empty() && lines[at..].iter().all(|line| line.trim().is_empty()) {
            break;
        }
        let count = line.trim().parse::<usize>();
        let count = count.map_err(|_| structure(file, at + 1, Some(line), "the number of particles"))?;
        let end = at.saturating_add(2).saturating_add(count);
        if end > lines.len() {
            let expected = format!("{count} particles, as line {} says", at + 1);
            return Err(structure(file, lines.len() + 1, None, &expected));
        }
        frames.push((at + 1, count));
        at = end;
    }
    let Some((comment, count)) = wanted(file, frames, reading)? else { return Ok(Vec::new()) };
    let names = properties(file, comment + 1, lines[comment])?;
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let columns = Columns::named(file, comment + 1, &names, reading)?;
    let particles = lines.iter().enumerate().skip(comment + 1).take(count);
    particles
        .map(|(index, line)| {
            columns.grain(file, index + 1, &line.split_whitespace().collect::<Vec<_>>(), reading)
        })
        .collect()
}

/// The names of the columns, after the second line of an instant.
fn properties(file: &str, line: usize, comment: &str) -> Result<Vec<String>, PointsError> {
    let value = comment.split_whitespace().find_map(|word| word.strip_prefix("Properties="));
    let value = value.unwrap_or("species:S:1:pos:R:3").trim_matches('"');
    let words: Vec<&str> = value.split(':').collect();
    let (triples, rest) = words.as_chunks::<3>();
    let mut names = Vec::new();
    for [name, _, columns] in triples {
        let columns = columns.parse::<usize>().ok().filter(|columns| (1..=1000).contains(columns));
        let Some(columns) = columns else {
            return Err(structure(file, line, Some(value), "Properties=name:kind:columns:..."));
        };
        let stem = match *name {
            "pos" | "position" => "",
            "velo" | "vel" | "velocity" | "velocities" => "v",
            "omega" | "angular_velocity" => "omega",
            "type" if names.iter().any(|name| name == "species") => "type",
            other => other,
        };
        match columns {
            1 => names.push(stem.to_owned()),
            3 => names.extend(AXES.map(|axis| format!("{stem}{axis}"))),
            _ => names.extend((0..columns).map(|number| format!("{name}_{number}"))),
        }
    }
    if !rest.is_empty() {
        return Err(structure(file, line, Some(value), "Properties=name:kind:columns:..."));
    }
    Ok(names)
}
