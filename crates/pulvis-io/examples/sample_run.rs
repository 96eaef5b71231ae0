//! Writes a small run folder for `scripts/check_vtk.py`: `cargo run -p pulvis-io --example sample_run -- <folder>`.
//!
//! The values follow formulas that the script knows, so it can tell whether a reader got them right.
#![allow(clippy::print_stderr)]

use pulvis_io::IoError;
use pulvis_io::vtk::{Column, ContactFrame, ParticleFrame, SeriesWriter, WallFrame};

fn main() -> std::process::ExitCode {
    let Some(folder) = std::env::args_os().nth(1) else {
        eprintln!("usage: sample_run <folder>");
        return std::process::ExitCode::from(2);
    };
    match write(folder.into()) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

/// Frames of a row of spheres, one of them without contacts and walls; the last one is empty. Readers must bear both.
fn write(folder: std::path::PathBuf) -> Result<(), IoError> {
    let mut series = SeriesWriter::create(folder, "")?;
    let frames = [(0.0, 5_u32, true), (0.0625, 7, false), (0.125, 4000, true), (1.0e-3 + 0.25, 0, true)];
    for (time, count, touching) in frames {
        let id: Vec<u32> = (1..=count).collect();
        let radius: Vec<f64> = id.iter().map(|&id| 1.0e-3 * (1.0 + f64::from(id).recip())).collect();
        let positions: Vec<[f64; 3]> = id.iter().map(|&id| [2.0e-3 * f64::from(id), time, -1.0]).collect();
        let velocity: Vec<[f64; 3]> = id.iter().map(|&id| [f64::from(id), 0.5, time]).collect();
        let material: Vec<i64> = id.iter().map(|&id| i64::from(id % 2) + 1).collect();
        let ends: Vec<[[f64; 3]; 2]> = positions
            .windows(2)
            .map(|pair| [pair[0], pair[1]])
            .take(if touching { usize::MAX } else { 0 })
            .collect();
        let force: Vec<[f64; 3]> = (0..ends.len()).map(|row| [row as f64, -0.5, 1.0e-9]).collect();
        let overlap: Vec<f64> = force.iter().map(|force| 1.0e-6 * force[0]).collect();
        let (id1, id2) = (&id[..ends.len()], &id[id.len() - ends.len()..]);
        let particles = ParticleFrame {
            positions: &positions,
            columns: &[
                Column::index("id", &id),
                Column::integer("type", &material),
                Column::scalar("radius", &radius),
                Column::vector("v", &velocity),
            ],
        };
        let contacts = ContactFrame {
            ends: &ends,
            columns: &[
                Column::index("id1", id1),
                Column::index("id2", id2),
                Column::vector("force", &force),
                Column::scalar("overlap", &overlap),
            ],
        };
        let walls = if touching {
            WallFrame { ends: &[[[0.0; 3], [1.0, 0.0, 0.0]]], radii: &[0.5] }
        } else {
            WallFrame { ends: &[], radii: &[] }
        };
        series.write(time, &particles, &contacts, &walls)?;
    }
    Ok(())
}
