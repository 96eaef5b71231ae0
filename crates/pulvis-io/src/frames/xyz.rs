//! Extended XYZ: all instants in one file.
//!
//! # Source
//! The extended XYZ specification (`libAtoms/extxyz`): `Lattice` row by row of box vectors, `Properties` as
//! name:kind:columns. `Origin`, and the names `velo` and `radius`, are those of OVITO.

use super::growing::Growing;
use super::names::{Particles, components, number};
use super::{Bounds, Format, FramePosition, FrameWriter, Instant, Precision, Series};
use crate::IoError;
use crate::vtk::Numbers;
use std::io::{self, Write};

/// `NAME.xyz`; no contacts.
pub(super) const FORMAT: Format = Format {
    name: "xyz",
    summary: "extended XYZ, all instants in one file, for OVITO and ASE; particles only",
    open: |series| Ok(Box::new(Xyz::open(series)?)),
    missing: None,
};

#[derive(Debug)]
struct Xyz {
    file: Growing,
    precision: Precision,
    frames: u64,
}

impl Xyz {
    fn open(series: &Series<'_>) -> Result<Self, IoError> {
        let at = series.resume.and_then(|position| position.files.first().copied());
        let file = Growing::open(series.folder, format!("{}.xyz", series.name), at)?;
        let frames = series.resume.map_or(0, |position| position.frames);
        Ok(Self { file, precision: series.precision, frames })
    }
}

impl FrameWriter for Xyz {
    fn next_files(&self, _instant: &Instant<'_>) -> Vec<String> {
        self.growing()
    }

    fn growing(&self) -> Vec<String> {
        vec![self.file.name()]
    }

    fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError> {
        let precision = self.precision;
        self.file.add(|out| write(out, instant, precision))?;
        self.frames += 1;
        Ok(())
    }

    fn position(&mut self) -> Result<FramePosition, IoError> {
        Ok(FramePosition { frames: self.frames, files: vec![self.file.position()] })
    }
}

fn write(out: &mut impl Write, instant: &Instant<'_>, precision: Precision) -> io::Result<()> {
    let data = &instant.frame.particles;
    let particles = Particles::of(data);
    writeln!(out, "{}", data.points.len())?;
    lattice(out, &instant.bounds, precision)?;
    write!(out, " Properties=species:S:1:pos:R:3:id:I:1")?;
    for (name, numbers) in &particles.others {
        let (kind, columns) = match numbers {
            Numbers::Integer(_) => ("I", 1),
            Numbers::Scalar(_) => ("R", 1),
            Numbers::Vector(_) => ("R", 3),
            Numbers::Tensor(_) => ("R", 9),
        };
        let name = match *name {
            "v" => "velo",
            "f" => "forces",
            other => other,
        };
        write!(out, ":{name}:{kind}:{columns}")?;
    }
    // Times in full: readers tell frames apart by them.
    write!(out, " Time=")?;
    number(out, instant.time, Precision::Double)?;
    writeln!(out, " Step={}", instant.step)?;
    // Blanks would end the word.
    let species: Vec<String> =
        instant.materials.iter().map(|name| name.split_whitespace().collect::<Vec<_>>().join("_")).collect();
    for (row, point) in data.points.iter().enumerate() {
        let material = particles.materials.map_or(0, |materials| materials[row]);
        let name = usize::try_from(material).ok().and_then(|material| species.get(material));
        write!(out, "{}", name.map_or("X", String::as_str))?;
        for &coordinate in point {
            out.write_all(b" ")?;
            number(out, coordinate, precision)?;
        }
        write!(out, " {}", particles.ids.map_or(row as i64, |ids| ids[row]))?;
        for (_, numbers) in &particles.others {
            components(out, numbers, row, b" ", precision)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// Box vectors, corner and periodic directions.
fn lattice(out: &mut impl Write, bounds: &Bounds, precision: Precision) -> io::Result<()> {
    let Bounds { lower, upper, tilt: [xy, xz, yz], periodic } = *bounds;
    let size = [0, 1, 2].map(|axis| upper[axis] - lower[axis]);
    let vectors = [size[0], 0.0, 0.0, xy, size[1], 0.0, xz, yz, size[2]];
    for (key, values) in [("Lattice", &vectors[..]), (" Origin", &lower[..])] {
        write!(out, "{key}=\"")?;
        for (index, &value) in values.iter().enumerate() {
            out.write_all(if index == 0 { b"" } else { b" " })?;
            number(out, value, precision)?;
        }
        out.write_all(b"\"")?;
    }
    write!(out, " pbc=\"{}\"", periodic.map(|periodic| if periodic { "T" } else { "F" }).join(" "))
}
