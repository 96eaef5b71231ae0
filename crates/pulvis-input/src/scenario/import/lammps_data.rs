//! Data files of LAMMPS, atom style sphere.
//!
//! # Source
//! LAMMPS documentation, page `read_data`: a first line for people, lines `N atoms` and so on, then sections. With `atom_style
//! sphere`, `Atoms` has id, type, diameter, density, x, y, z and maybe three numbers of images, `Velocities` has id, velocity
//! and angular velocity. Masses follow from the densities of the scenario.

use super::rows::{Columns, structure};
use super::{FileReading, PointsError};
use crate::scenario::arrangement::Grain;
use std::collections::HashMap;

/// Columns of the section `Atoms`.
const ATOMS: [&str; 10] =
    ["id", "type", "diameter", "density", "x", "y", "z", "image_x", "image_y", "image_z"];

/// What velocities are read as: positions stand first, so that nothing but motion is taken from them.
const VELOCITIES: [&str; 7] = ["id", "vx", "vy", "vz", "omegax", "omegay", "omegaz"];

pub(super) fn parse(file: &str, text: &str, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    let lines: Vec<&str> =
        text.lines().map(|line| line.split('#').next().unwrap_or_default().trim()).collect();
    let (mut count, mut atoms, mut velocities) = (None, None, None);
    // The first line means nothing.
    for (index, line) in lines.iter().enumerate().skip(1) {
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            [number, "atoms"] => {
                let number = number.parse::<usize>();
                count =
                    Some(number.map_err(|_| structure(file, index + 1, Some(line), "the number of atoms"))?);
            }
            ["Atoms"] => {
                let style = text
                    .lines()
                    .nth(index)
                    .and_then(|line| line.split_once('#'))
                    .map(|(_, style)| style.trim());
                if let Some(style) = style.filter(|style| !style.is_empty() && *style != "sphere") {
                    return Err(structure(file, index + 1, Some(style), "the atom style sphere"));
                }
                atoms = Some(index);
            }
            ["Velocities"] => velocities = Some(index),
            _ => {}
        }
    }
    let count = count.ok_or_else(|| structure(file, lines.len() + 1, None, "a line `N atoms`"))?;
    let atoms = atoms.ok_or_else(|| structure(file, lines.len() + 1, None, "the section Atoms"))?;
    let rows = section(file, &lines, atoms, count)?;
    let Some((first, cells)) = rows.first() else { return Ok(Vec::new()) };
    let columns = Columns::named(file, *first, &ATOMS[..if cells.len() == 7 { 7 } else { 10 }], reading)?;
    let mut places = HashMap::new();
    let mut grains = Vec::with_capacity(rows.len());
    for (line, cells) in &rows {
        let grain = columns.grain(file, *line, cells, reading)?;
        if places.insert(cells[0], grains.len()).is_some() {
            return Err(structure(file, *line, Some(cells[0]), "an id that no other particle has"));
        }
        grains.push(grain);
    }
    if let Some(velocities) = velocities {
        move_grains(file, &section(file, &lines, velocities, count)?, &places, &mut grains, reading)?;
    }
    Ok(grains)
}

/// The lines of a section with their numbers.
fn section<'a>(
    file: &str,
    lines: &[&'a str],
    header: usize,
    count: usize,
) -> Result<Vec<(usize, Vec<&'a str>)>, PointsError> {
    let body = lines.iter().enumerate().skip(header + 1).skip_while(|(_, line)| line.is_empty());
    let rows: Vec<_> = body
        .take_while(|(_, line)| line.starts_with(|c: char| c.is_ascii_digit()))
        .take(count)
        .map(|(index, line)| (index + 1, line.split_whitespace().collect()))
        .collect();
    if rows.len() == count {
        return Ok(rows);
    }
    let line = rows.last().map_or(header + 1, |(line, _)| *line) + 1;
    let expected = format!("{count} lines of the section {}, and there are {}", lines[header], rows.len());
    Err(structure(file, line, lines.get(line - 1).copied(), &expected))
}

/// Gives particles the velocities of a section.
fn move_grains(
    file: &str,
    rows: &[(usize, Vec<&str>)],
    places: &HashMap<&str, usize>,
    grains: &mut [Grain],
    reading: &FileReading,
) -> Result<(), PointsError> {
    // Positions are what every line of particles has: here zeros stand for them.
    let names: Vec<&str> = ["x", "y", "z"].into_iter().chain(VELOCITIES).collect();
    let reading = FileReading { materials: None, ..reading.clone() };
    let Some((first, _)) = rows.first() else { return Ok(()) };
    let columns = Columns::named(file, *first, &names, &reading)?;
    for (line, cells) in rows {
        if cells.len() != VELOCITIES.len() {
            let (found, expected) = (cells.len(), VELOCITIES.len());
            return Err(PointsError::Count { file: file.to_owned(), line: *line, found, expected });
        }
        let place = places.get(cells[0]);
        let place = *place.ok_or_else(|| {
            structure(file, *line, Some(cells[0]), "the id of a particle of the section Atoms")
        })?;
        let cells: Vec<&str> = ["0"; 3].into_iter().chain(cells.iter().copied()).collect();
        let moving = columns.grain(file, *line, &cells, &reading)?;
        (grains[place].velocity, grains[place].angular_velocity) = (moving.velocity, moving.angular_velocity);
    }
    Ok(())
}
