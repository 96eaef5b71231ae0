//! Text dumps as LAMMPS writes them (`dump custom` and `dump local`).
//!
//! # Source
//! LAMMPS documentation, pages `dump`, `dump_modify` and `Howto_triclinic`: order of the items, `ITEM: UNITS` once and
//! `ITEM: TIME` per frame, the bounding box of a tilted cell.

use super::growing::Growing;
use super::names::{Particles, component_names, components, number};
use super::{Bounds, Format, FramePosition, FrameWriter, Instant, Precision, Series};
use crate::IoError;
use crate::vtk::{Numbers, PolyData};
use std::io::{self, Write};

/// `NAME.dump` and `NAME.contacts.dump`.
pub(super) const FORMAT: Format = Format {
    name: "lammps-dump",
    summary: "text dumps of particles and, as a local dump, of contacts, for OVITO, LAMMPS and VMD",
    open: |series| Ok(Box::new(Dump::open(series)?)),
    missing: None,
};

#[derive(Debug)]
struct Dump {
    particles: Growing,
    contacts: Option<Growing>,
    precision: Precision,
    frames: u64,
}

impl Dump {
    fn open(series: &Series<'_>) -> Result<Self, IoError> {
        let at = |index: usize| series.resume.and_then(|position| position.files.get(index).copied());
        let open =
            |index, ending: &str| Growing::open(series.folder, format!("{}{ending}", series.name), at(index));
        Ok(Self {
            particles: open(0, ".dump")?,
            contacts: if series.contacts { Some(open(1, ".contacts.dump")?) } else { None },
            precision: series.precision,
            frames: series.resume.map_or(0, |position| position.frames),
        })
    }
}

impl FrameWriter for Dump {
    fn next_files(&self, _instant: &Instant<'_>) -> Vec<String> {
        self.growing()
    }

    fn growing(&self) -> Vec<String> {
        [Some(&self.particles), self.contacts.as_ref()].into_iter().flatten().map(Growing::name).collect()
    }

    fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError> {
        let (precision, is_first) = (self.precision, self.frames == 0);
        self.particles.add(|out| {
            head(out, instant, is_first, "ATOMS", instant.frame.particles.points.len(), precision)?;
            atoms(out, &instant.frame.particles, precision)
        })?;
        if let Some(contacts) = &mut self.contacts {
            contacts.add(|out| {
                head(out, instant, is_first, "ENTRIES", instant.frame.contacts.points.len() / 2, precision)?;
                entries(out, &instant.frame.contacts, precision)
            })?;
        }
        self.frames += 1;
        Ok(())
    }

    fn position(&mut self) -> Result<FramePosition, IoError> {
        let files = [Some(&self.particles), self.contacts.as_ref()].into_iter().flatten();
        Ok(FramePosition { frames: self.frames, files: files.map(Growing::position).collect() })
    }
}

/// Units, time, step, number of rows and box.
fn head(
    out: &mut impl Write,
    instant: &Instant<'_>,
    is_first: bool,
    what: &str,
    rows: usize,
    precision: Precision,
) -> io::Result<()> {
    if is_first {
        writeln!(out, "ITEM: UNITS\nsi")?;
    }
    // Times in full: readers tell frames apart by them.
    writeln!(out, "ITEM: TIME")?;
    number(out, instant.time, Precision::Double)?;
    writeln!(out, "\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF {what}\n{rows}", instant.step)?;
    bounds(out, &instant.bounds, precision)
}

fn bounds(out: &mut impl Write, bounds: &Bounds, precision: Precision) -> io::Result<()> {
    let Bounds { lower, upper, tilt: [xy, xz, yz], periodic } = *bounds;
    let sides = periodic.map(|periodic| if periodic { "pp" } else { "ff" }).join(" ");
    let is_tilted = bounds.tilt != [0.0; 3];
    // The bounding box of the tilted cell, from which readers take the tilt off again.
    let least = [0.0_f64.min(xy).min(xz).min(xy + xz), 0.0_f64.min(yz), 0.0];
    let most = [0.0_f64.max(xy).max(xz).max(xy + xz), 0.0_f64.max(yz), 0.0];
    writeln!(out, "ITEM: BOX BOUNDS {}{sides}", if is_tilted { "xy xz yz " } else { "" })?;
    for axis in 0..3 {
        number(out, lower[axis] + least[axis], precision)?;
        out.write_all(b" ")?;
        number(out, upper[axis] + most[axis], precision)?;
        if is_tilted {
            out.write_all(b" ")?;
            number(out, bounds.tilt[axis], precision)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

fn atoms(out: &mut impl Write, data: &PolyData, precision: Precision) -> io::Result<()> {
    let particles = Particles::of(data);
    let names = particles.others.iter().flat_map(|(name, numbers)| component_names(name, numbers));
    let names: Vec<String> =
        ["id", "type", "x", "y", "z"].map(str::to_owned).into_iter().chain(names).collect();
    writeln!(out, "ITEM: ATOMS {}", names.join(" "))?;
    for (row, point) in data.points.iter().enumerate() {
        // Ids and types of LAMMPS begin at 1.
        let id = particles.ids.map_or(row as i64, |ids| ids[row]) + 1;
        let kind = particles.materials.map_or(0, |materials| materials[row]) + 1;
        write!(out, "{id} {kind}")?;
        for &coordinate in point {
            out.write_all(b" ")?;
            number(out, coordinate, precision)?;
        }
        for (_, numbers) in &particles.others {
            components(out, numbers, row, b" ", precision)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

fn entries(out: &mut impl Write, data: &PolyData, precision: Precision) -> io::Result<()> {
    let names = data.columns.iter().flat_map(|(name, numbers)| component_names(name, numbers));
    writeln!(out, "ITEM: ENTRIES {}", names.collect::<Vec<_>>().join(" "))?;
    let is_id = |name: &str| ["id1", "id2"].contains(&name);
    for row in 0..data.points.len() / 2 {
        for (number, (name, numbers)) in data.columns.iter().enumerate() {
            let separator: &[u8] = if number == 0 { b"" } else { b" " };
            match numbers {
                // As the ids of particles, from 1; walls stay negative, none is 0.
                Numbers::Integer(values) if is_id(name) => {
                    out.write_all(separator)?;
                    write!(out, "{}", values[row] + i64::from(values[row] >= 0))?;
                }
                _ => components(out, numbers, row, separator, precision)?,
            }
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}
