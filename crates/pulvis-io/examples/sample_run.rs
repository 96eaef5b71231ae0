//! Writes a small run folder for `scripts/check_vtk.py` and `scripts/check_formats.py`:
//! `cargo run -p pulvis-io --example sample_run -- <folder>`.
//!
//! The values follow formulas that the script knows, so it can tell whether a reader got them right.
#![allow(clippy::print_stderr)]

use pulvis_io::IoError;
use pulvis_io::frames::{Bounds, FORMATS, Instant, Precision, Series, Units, format};
use pulvis_io::vtk::{
    Column, ContactFrame, Frame, ImageGrid, Numbers, ParticleFrame, PolyData, SeriesWriter, WallFrame,
    write_image,
};
use std::path::{Path, PathBuf};

fn main() -> std::process::ExitCode {
    let Some(folder) = std::env::args_os().nth(1) else {
        eprintln!("usage: sample_run <folder>");
        return std::process::ExitCode::from(2);
    };
    let folder = PathBuf::from(folder);
    let compressed = folder.join("compressed");
    let series = |folder: &Path| SeriesWriter::create(folder, "");
    let written = series(&folder)
        .and_then(write)
        .and_then(|()| write(series(&compressed)?.compressed(true)))
        .and_then(|()| write_formats(&folder.join("formats")));
    match written {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

/// Frames of a row of spheres, one of them without contacts and walls; the last one is empty. Readers must bear both.
fn write(mut series: SeriesWriter) -> Result<(), IoError> {
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

/// Three instants of seven spheres in every format, with 64 and with 32 bits.
fn write_formats(folder: &Path) -> Result<(), IoError> {
    std::fs::create_dir_all(folder).map_err(|source| IoError::System {
        action: "create the folder",
        path: folder.to_path_buf(),
        source,
    })?;
    let materials = ["glass".to_owned(), "steel".to_owned()];
    let bounds = Bounds {
        lower: [0.0, -1.0, 0.0],
        upper: [3.0, 1.0, 2.0],
        tilt: [0.5, 0.0, -0.25],
        periodic: [true, false, true],
    };
    for name in
        ["vtk", "hdf5"].into_iter().filter(|name| format(name).is_ok_and(|known| known.missing.is_none()))
    {
        let compressed = Series { compressed: true, name: &format!("{name}_compressed"), ..series(folder) };
        let mut writer = (format(name)?.open)(&compressed)?;
        for step in [0, 100, 200] {
            let time = step as f64 / 700.0;
            let frame = frame(time);
            writer.write(&Instant { time, step, bounds, materials: &materials, frame: &frame })?;
        }
    }
    // A grid of 4 x 3 x 2 cells.
    let values: Vec<f64> = (0..24).map(|cell| f64::from(cell) / 7.0).collect();
    let tensors: Vec<[f64; 9]> =
        (0..24).map(|cell| std::array::from_fn(|part| f64::from(cell) + part as f64 / 3.0)).collect();
    let grid = ImageGrid { origin: [-1.0, 0.0, 0.1], spacing: [0.5, 0.25, 1.0 / 3.0], cells: [4, 3, 2] };
    let columns = [Column::scalar("density", &values), Column::tensor("stress", &tensors)];
    write_image(&folder.join("image.vti"), &grid, &columns)?;
    let unit = |(name, unit): (&str, &str)| (name.to_owned(), unit.to_owned());
    let particles = [("radius", "m"), ("v", "m/s"), ("stress", "Pa")].map(unit);
    let contacts = [("force", "N")].map(unit);
    for (precision, end) in [(Precision::Double, "double"), (Precision::Single, "single")] {
        for format in FORMATS.iter().filter(|format| format.missing.is_none()) {
            let name = format!("{}_{end}", format.name.replace('-', "_"));
            let mut writer = (format.open)(&Series {
                folder,
                name: &name,
                precision,
                compressed: false,
                contacts: true,
                units: Units { particles: &particles, contacts: &contacts },
                resume: None,
            })?;
            for step in [0, 100, 200] {
                let time = step as f64 / 700.0;
                let frame = frame(time);
                writer.write(&Instant { time, step, bounds, materials: &materials, frame: &frame })?;
            }
        }
    }
    Ok(())
}

fn series(folder: &Path) -> Series<'_> {
    let (precision, units) = (Precision::Double, Units::default());
    Series { folder, name: "", precision, compressed: false, contacts: true, units, resume: None }
}

fn frame(time: f64) -> Frame {
    let ids: Vec<i64> = (0..7).collect();
    let value = |id: i64, part: usize| (id as f64 + 1.0) / 3.0 + 1.0e-7 * part as f64 + time;
    let vector = |start: usize| -> Vec<[f64; 3]> {
        ids.iter().map(|&id| std::array::from_fn(|axis| value(id, start + axis))).collect()
    };
    let points = vector(0);
    let tensor = ids.iter().map(|&id| std::array::from_fn(|part| value(id, 20 + part))).collect();
    let columns = [
        ("id", Numbers::Integer(ids.clone())),
        ("type", Numbers::Integer(ids.iter().map(|id| id % 2).collect())),
        ("radius", Numbers::Scalar(ids.iter().map(|&id| value(id, 10)).collect())),
        ("v", Numbers::Vector(vector(11))),
        ("omega", Numbers::Vector(vector(14))),
        ("f", Numbers::Vector(vector(17))),
        ("stress", Numbers::Tensor(tensor)),
    ];
    let contacts = [
        ("id1", Numbers::Integer(vec![0, 2])),
        ("id2", Numbers::Integer(vec![1, -1])),
        ("force", Numbers::Vector(vec![[0.1, 0.2, 0.3], [time, 0.0, -1.0e-9]])),
    ];
    let named = |(name, numbers): (&str, Numbers)| (name.to_owned(), numbers);
    Frame {
        contacts: PolyData {
            points: vec![points[0], points[1], points[2], [0.0; 3]],
            columns: contacts.map(named).into(),
        },
        particles: PolyData { points, columns: columns.map(named).into() },
        walls: PolyData {
            points: Vec::new(),
            columns: vec![("radius".to_owned(), Numbers::Scalar(Vec::new()))],
        },
        // A triangle that rises with time.
        surfaces: PolyData {
            points: vec![[0.0, 0.0, time], [1.0, 0.0, time], [0.0, 1.0, time]],
            columns: vec![("wall".to_owned(), Numbers::Integer(vec![2]))],
        },
    }
}
