//! Files of all formats, read without the code that wrote them.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use crate::vtk::{Numbers, PolyData};
use std::collections::BTreeMap;

fn frame(number: usize) -> Frame {
    let third = |row: usize| (row + number) as f64 / 3.0;
    let rows = || 0..4_usize;
    let tensor = |row: usize| std::array::from_fn(|part| third(row) * 1e-9 + part as f64);
    Frame {
        particles: PolyData {
            points: rows().map(|row| [third(row), -2e-7 * row as f64, f64::MIN_POSITIVE]).collect(),
            columns: vec![
                ("id".to_owned(), Numbers::Integer(rows().map(|row| 2 * row as i64).collect())),
                ("type".to_owned(), Numbers::Integer(rows().map(|row| row as i64 % 2).collect())),
                ("radius".to_owned(), Numbers::Scalar(rows().map(third).collect())),
                ("v".to_owned(), Numbers::Vector(rows().map(|row| [third(row), 0.0, -1e300]).collect())),
                ("stress".to_owned(), Numbers::Tensor(rows().map(tensor).collect())),
                ("charge".to_owned(), Numbers::Scalar(vec![f64::NAN, f64::INFINITY, -0.0, 1e15])),
            ],
        },
        contacts: PolyData {
            points: vec![[0.0; 3], [1.0; 3]],
            columns: vec![
                ("id1".to_owned(), Numbers::Integer(vec![0])),
                ("id2".to_owned(), Numbers::Integer(vec![-1])),
                ("force".to_owned(), Numbers::Vector(vec![[0.1, 0.2, 0.3]])),
            ],
        },
        walls: PolyData {
            points: Vec::new(),
            columns: vec![("radius".to_owned(), Numbers::Scalar(Vec::new()))],
        },
        surfaces: PolyData::default(),
    }
}

fn write(writer: &mut dyn FrameWriter, numbers: std::ops::Range<usize>, bounds: Bounds) {
    let materials = ["glass".to_owned(), "soft steel".to_owned()];
    for number in numbers {
        let frame = frame(number);
        let (time, step) = (number as f64 / 7.0, 100 * number as u64);
        writer.write(&Instant { time, step, bounds, materials: &materials, frame: &frame }).unwrap();
    }
}

const BOUNDS: Bounds = Bounds {
    lower: [0.0, -1.0, 0.5],
    upper: [2.0, 1.0, 3.5],
    tilt: [0.25, -0.5, 0.0],
    periodic: [true, true, false],
};

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&path).unwrap()))
        .collect()
}

fn series<'a>(folder: &'a Path, resume: Option<&'a FramePosition>) -> Series<'a> {
    let (precision, units) = (Precision::Double, Units { particles: &[], contacts: &[] });
    Series { folder, name: "sample", precision, compressed: false, contacts: true, units, resume }
}

#[test]
fn every_format_goes_on_where_a_checkpoint_was_with_the_same_bytes() {
    for format in FORMATS.iter().filter(|format| format.missing.is_none()) {
        let [whole, resumed] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        write(&mut *(format.open)(&series(whole.path(), None)).unwrap(), 0..5, BOUNDS);
        let mut first = (format.open)(&series(resumed.path(), None)).unwrap();
        write(&mut *first, 0..2, BOUNDS);
        let position = first.position().unwrap();
        // What a killed run wrote after its last checkpoint.
        write(&mut *first, 2..4, BOUNDS);
        drop(first);
        let mut second = (format.open)(&series(resumed.path(), Some(&position))).unwrap();
        assert_eq!(second.position().unwrap(), position, "{}", format.name);
        write(&mut *second, 2..5, BOUNDS);
        assert!(files(resumed.path()) == files(whole.path()), "{}", format.name);
    }
}

#[test]
fn a_growing_file_that_is_another_one_is_refused_and_stays() {
    for name in ["xyz", "lammps-dump"] {
        let folder = tempfile::tempdir().unwrap();
        let mut writer = (format(name).unwrap().open)(&series(folder.path(), None)).unwrap();
        write(&mut *writer, 0..2, BOUNDS);
        let position = writer.position().unwrap();
        let path = folder.path().join(&writer.growing()[0]);
        drop(writer);
        let text = std::fs::read_to_string(&path).unwrap();
        for (changed, problem) in [
            (text.replacen("0.5", "0.6", 1), "its frames are other ones"),
            (text[..text.len() / 2].to_owned(), "it has lost frames"),
        ] {
            std::fs::write(&path, &changed).unwrap();
            let error = (format(name).unwrap().open)(&series(folder.path(), Some(&position))).unwrap_err();
            assert!(error.to_string().contains(problem), "{error}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), changed);
        }
    }
}

#[test]
fn text_formats_hold_the_very_numbers_and_single_precision_the_nearest_of_32_bits() {
    for precision in [Precision::Double, Precision::Single] {
        for (name, file) in [("xyz", "a.xyz"), ("lammps-dump", "a.dump"), ("csv", "a_0000.csv")] {
            let folder = tempfile::tempdir().unwrap();
            let series = Series {
                folder: folder.path(),
                name: "a",
                precision,
                compressed: false,
                contacts: true,
                units: Units::default(),
                resume: None,
            };
            write(&mut *(format(name).unwrap().open)(&series).unwrap(), 1..2, BOUNDS);
            let text = std::fs::read_to_string(folder.path().join(file)).unwrap();
            let lines: Vec<&str> = text.lines().collect();
            let particles = frame(1).particles;
            let Some(Numbers::Tensor(stress)) = particles.column("stress") else { panic!("no tensor") };
            let [radius, charge] = ["radius", "charge"].map(|name| particles.scalar(name).unwrap());
            for (row, line) in lines[lines.len() - 4..].iter().enumerate() {
                // All three end in radius, velocity, stress and charge.
                let cells: Vec<&str> = line.split([' ', ',']).collect();
                let found = &cells[cells.len() - 14..];
                let expected = [radius[row], radius[row], 0.0, -1e300].into_iter();
                let expected = expected.chain(stress[row]).chain([charge[row]]);
                for (found, expected) in found.iter().zip(expected) {
                    let same = match precision {
                        Precision::Double => found.parse::<f64>().unwrap().to_bits() == expected.to_bits(),
                        Precision::Single => {
                            found.parse::<f32>().unwrap().to_bits() == (expected as f32).to_bits()
                        }
                    };
                    assert!(
                        same || expected.is_nan() && *found == "nan",
                        "{name}: {found} is not {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_dump_has_the_items_of_lammps_and_the_bounding_box_of_a_tilted_cell() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = (format("lammps-dump").unwrap().open)(&series(folder.path(), None)).unwrap();
    write(&mut *writer, 0..2, BOUNDS);
    drop(writer);
    let text = std::fs::read_to_string(folder.path().join("sample.dump")).unwrap();
    // LAMMPS, Howto_triclinic: xlo_bound = xlo + min(0, xy, xz, xy + xz) and so on.
    let head = "ITEM: UNITS\nsi\nITEM: TIME\n0\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n4\n\
                ITEM: BOX BOUNDS xy xz yz pp pp ff\n-0.5 2.25 0.25\n-1 1 -0.5\n0.5 3.5 0\n\
                ITEM: ATOMS id type x y z radius vx vy vz stress_xx stress_xy stress_xz stress_yx stress_yy stress_yz stress_zx stress_zy stress_zz charge\n1 1 ";
    assert!(text.starts_with(head), "{text}");
    assert_eq!(text.matches("ITEM: UNITS").count(), 1);
    assert_eq!(text.matches("ITEM: TIMESTEP").count(), 2);
    let contacts = std::fs::read_to_string(folder.path().join("sample.contacts.dump")).unwrap();
    assert!(contacts.contains("ITEM: NUMBER OF ENTRIES\n1\n"), "{contacts}");
    assert!(
        contacts.ends_with("ITEM: ENTRIES id1 id2 force_x force_y force_z\n1 -1 0.1 0.2 0.3\n"),
        "{contacts}"
    );
}

#[test]
fn an_extended_xyz_file_says_what_its_columns_are() {
    let folder = tempfile::tempdir().unwrap();
    write(&mut *(format("xyz").unwrap().open)(&series(folder.path(), None)).unwrap(), 0..1, BOUNDS);
    let text = std::fs::read_to_string(folder.path().join("sample.xyz")).unwrap();
    let head = "4\nLattice=\"2 0 0 0.25 2 0 -0.5 0 3\" Origin=\"0 -1 0.5\" pbc=\"T T F\" \
                Properties=species:S:1:pos:R:3:id:I:1:radius:R:1:velo:R:3:stress:R:9:charge:R:1 Time=0 Step=0\nglass 0 ";
    assert!(text.starts_with(head), "{text}");
    assert!(text.contains("\nsoft_steel "), "{text}");
}

#[test]
fn vtk_frames_of_single_precision_and_tensors_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let series = Series {
        folder: folder.path(),
        name: "s",
        precision: Precision::Single,
        compressed: false,
        contacts: true,
        units: Units::default(),
        resume: None,
    };
    write(&mut *(format("vtk").unwrap().open)(&series).unwrap(), 3..4, BOUNDS);
    let read = crate::vtk::read_frame(&folder.path().join("s_frame_0000.vtm")).unwrap();
    let written = frame(3);
    let (Some(Numbers::Tensor(found)), Some(Numbers::Tensor(expected))) =
        (read.particles.column("stress"), written.particles.column("stress"))
    else {
        panic!("no tensor")
    };
    assert_eq!(found.len(), 4);
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert_eq!(found.to_bits(), f64::from(*expected as f32).to_bits());
    }
    assert_eq!(read.particles.column("id"), written.particles.column("id"));
}

#[cfg(not(feature = "hdf5"))]
#[test]
fn a_format_that_is_not_built_in_says_how_to_build_it() {
    let folder = tempfile::tempdir().unwrap();
    let hdf5 = format("hdf5").unwrap();
    assert!(hdf5.missing.is_some());
    let error = (hdf5.open)(&series(folder.path(), None)).unwrap_err().to_string();
    assert!(
        error.starts_with("this program was built without the format `hdf5`; build it with `cargo"),
        "{error}"
    );
    assert!(error.contains("--features hdf5") && error.contains("libhdf5-dev"), "{error}");
    assert!(files(folder.path()).is_empty());
}

/// Values are compared by h5py: `scripts/check_formats.py`.
#[cfg(feature = "hdf5")]
#[test]
fn hdf5_files_are_whole_and_a_cut_index_is_refused_and_stays() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = (format("hdf5").unwrap().open)(&series(folder.path(), None)).unwrap();
    write(&mut *writer, 0..3, BOUNDS);
    let position = FramePosition { frames: 4, files: Vec::new() };
    let before = files(folder.path());
    let names: Vec<&str> = before.keys().map(String::as_str).collect();
    assert_eq!(names, ["sample.h5", "sample_0000.h5", "sample_0001.h5", "sample_0002.h5"]);
    let error = (format("hdf5").unwrap().open)(&series(folder.path(), Some(&position))).unwrap_err();
    assert!(error.to_string().contains("it lists 3 frames, and the checkpoint knows of 4"), "{error}");
    // No index at all, and one that is something else.
    let position = FramePosition { frames: 2, files: Vec::new() };
    std::fs::write(folder.path().join("sample.h5"), "something else").unwrap();
    let error = (format("hdf5").unwrap().open)(&series(folder.path(), Some(&position))).unwrap_err();
    assert!(error.to_string().starts_with("cannot read "), "{error}");
    std::fs::remove_file(folder.path().join("sample.h5")).unwrap();
    assert!((format("hdf5").unwrap().open)(&series(folder.path(), Some(&position))).is_err());
    // A folder that is not there any more is an error of the system.
    drop(folder);
    let frame = frame(3);
    let instant = Instant { time: 1.0, step: 1, bounds: BOUNDS, materials: &[], frame: &frame };
    let error = writer.write(&instant).unwrap_err().to_string();
    assert!(error.contains("create the folder first"), "{error}");
}

#[cfg(feature = "hdf5")]
#[test]
fn hdf5_files_bear_frames_without_particles_and_contacts() {
    for compressed in [false, true] {
        let folder = tempfile::tempdir().unwrap();
        let series = Series { compressed, ..series(folder.path(), None) };
        let mut writer = (format("hdf5").unwrap().open)(&series).unwrap();
        let mut frame = frame(0);
        for data in [&mut frame.particles, &mut frame.contacts] {
            data.points.clear();
            data.columns = vec![
                ("id".to_owned(), Numbers::Integer(Vec::new())),
                ("v".to_owned(), Numbers::Vector(Vec::new())),
            ];
        }
        let instant = Instant { time: 0.0, step: 0, bounds: BOUNDS, materials: &[], frame: &frame };
        writer.write(&instant).unwrap();
        assert_eq!(files(folder.path()).len(), 2);
    }
}
