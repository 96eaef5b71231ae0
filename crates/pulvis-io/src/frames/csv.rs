//! Tables of particles and contacts as comma-separated values. Pulvis reads those of particles back.

use super::names::{Particles, component_names, components, number};
use super::numbered::Numbered;
use super::{Format, Instant, Precision};
use crate::vtk::PolyData;
use crate::{IoError, file};
use std::io::{self, Write};
use std::path::PathBuf;

/// Comma-separated values: `NAME_0000.csv` and `NAME_contacts_0000.csv`.
pub(super) const FORMAT: Format = Format {
    name: "csv",
    summary: "tables with a header line, for pandas and spreadsheets; Pulvis reads the particles back",
    open: |series| Ok(Numbered::open(series, if series.contacts { both_names } else { name }, write)),
    missing: None,
};

fn name(name: &str, number: u64) -> Vec<String> {
    vec![format!("{name}_{number:04}.csv")]
}

fn both_names(name: &str, number: u64) -> Vec<String> {
    vec![format!("{name}_{number:04}.csv"), format!("{name}_contacts_{number:04}.csv")]
}

fn write(paths: &[PathBuf], instant: &Instant<'_>, precision: Precision) -> Result<(), IoError> {
    let mut paths = paths.iter();
    if let Some(particles) = paths.next() {
        file::replace(particles, |out| write_particles(out, instant, precision))?;
    }
    if let Some(contacts) = paths.next() {
        file::replace(contacts, |out| write_contacts(out, &instant.frame.contacts, precision))?;
    }
    Ok(())
}

fn write_particles(out: &mut impl Write, instant: &Instant<'_>, precision: Precision) -> io::Result<()> {
    let data = &instant.frame.particles;
    let particles = Particles::of(data);
    let mut header: Vec<String> = ["x", "y", "z"].map(str::to_owned).into();
    header.extend(particles.others.iter().flat_map(|(name, numbers)| component_names(name, numbers)));
    writeln!(out, "id,material,{}", header.join(","))?;
    for (row, point) in data.points.iter().enumerate() {
        write!(out, "{},", particles.ids.map_or(row as i64, |ids| ids[row]))?;
        let material = particles.materials.and_then(|materials| {
            instant.materials.get(usize::try_from(materials[row]).unwrap_or(usize::MAX))
        });
        out.write_all(quoted(material.map_or("", String::as_str)).as_bytes())?;
        for &coordinate in point {
            out.write_all(b",")?;
            number(out, coordinate, precision)?;
        }
        for (_, numbers) in &particles.others {
            components(out, numbers, row, b",", precision)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

fn write_contacts(out: &mut impl Write, data: &PolyData, precision: Precision) -> io::Result<()> {
    let names = data.columns.iter().flat_map(|(name, numbers)| component_names(name, numbers));
    writeln!(out, "{}", names.collect::<Vec<_>>().join(","))?;
    for row in 0..data.points.len() / 2 {
        for (number, (_, numbers)) in data.columns.iter().enumerate() {
            let separator: &[u8] = if number == 0 { b"" } else { b"," };
            components(out, numbers, row, separator, precision)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// A text as a field after RFC 4180.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
