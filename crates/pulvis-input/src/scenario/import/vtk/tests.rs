//! Files that VTK 9.7 has written itself, and files that are broken.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use crate::scenario::import::PointsFormat;

fn read_points(path: &Path, reading: &FileReading) -> Result<Vec<Grain>, PointsError> {
    crate::scenario::import::read_points(path, reading, None).map(|(grains, _)| grains)
}
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::fs;
use std::io::Write;
use std::path::PathBuf;

/// Files of the same three particles, written by `vtkXMLPolyDataWriter` and `vtkXMLUnstructuredGridWriter` of VTK 9.7.2: decimals,
/// base64 and bytes, in their places and appended, with zlib and without, headers of 4 and 8 bytes.
const FILES: [&str; 7] = [
    "ascii.vtp",
    "inline.vtp",
    "inline_compressed.vtp",
    "appended.vtp",
    "appended_base64.vtp",
    "appended_raw.vtp",
    "grid.vtu",
];

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good/vtk").join(name)
}

fn reading() -> FileReading {
    FileReading { format: PointsFormat::Vtk, frame: None, length_unit: 1.0, time_unit: 1.0, materials: None }
}

fn refusal(bytes: &[u8], reading: &FileReading) -> String {
    parse(Path::new("a"), bytes, reading, &[], &["Collection"]).unwrap_err().to_string()
}

#[test]
fn what_vtk_writes_in_any_of_its_ways_gives_the_same_particles_in_the_units_asked_for() {
    for name in FILES {
        assert_eq!(PointsFormat::of_path(&path(name)), PointsFormat::Vtk);
        let materials = Some([("0".to_owned(), 4), ("1".to_owned(), 2)].into());
        let reading = FileReading { length_unit: 1e-3, time_unit: 1e-6, materials, ..reading() };
        let grains = read_points(&path(name), &reading).unwrap();
        let vector = |x: f64, y: f64, z: f64, unit: f64| Vector3::new(x, y, z) * unit;
        let grain = |position, radius: f64, velocity, angular_velocity, material| Grain {
            position,
            radius: Some(radius * 0.5e-3),
            velocity: Some(velocity),
            angular_velocity: Some(angular_velocity),
            material: Some(material),
        };
        let (mm, speed, rate) = (1e-3, 1e-3 / 1e-6, 1.0 / 1e-6);
        let expected = [
            grain(
                vector(1.0, 2.0, 3.0, mm),
                0.5,
                vector(1.0, 0.0, 0.0, speed),
                vector(0.0, 1.0, 2.0, rate),
                2,
            ),
            grain(
                vector(4.0, 5.0, 6.0, mm),
                0.25,
                vector(0.0, 0.5, 0.0, speed),
                vector(3.0, 4.0, 5.0, rate),
                4,
            ),
            grain(
                vector(0.1, -7.25, 1e-3, mm),
                0.125,
                vector(0.0, 0.0, -2.0, speed),
                vector(6.0, 7.0, 8.0, rate),
                2,
            ),
        ];
        assert_eq!(grains, expected, "{name}");
    }
}

#[test]
fn a_vtk_file_cut_off_anywhere_is_refused_with_its_line() {
    for name in FILES {
        let bytes = fs::read(path(name)).unwrap();
        let whole = parse(Path::new("a"), &bytes, &reading(), &[], &[]).unwrap();
        for end in (0..bytes.len()).step_by(31) {
            match parse(Path::new("a"), &bytes[..end], &reading(), &[], &[]) {
                // Nothing of the particles stands behind their positions.
                Ok(grains) => assert!(grains == whole && end > bytes.len() / 3, "{name}: {end}"),
                Err(error) => {
                    let text = error.to_string();
                    let line = text.strip_prefix("a:").and_then(|rest| rest.split(':').next());
                    assert!(line.is_some_and(|line| line.parse::<usize>().is_ok()), "{name}: {end}: {text}");
                }
            }
        }
    }
}

#[test]
fn what_is_wrong_in_a_vtk_file_is_named() {
    let text = fs::read_to_string(path("ascii.vtp")).unwrap();
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        refusal(text.replacen(from, to, 1).as_bytes(), &reading())
    };
    for (from, to, expected) in [
        (
            "PolyData",
            "ImageData",
            "a:1: found a file of the kind \"ImageData\"; expected PolyData, or an index of such files",
        ),
        ("LittleEndian", "BigEndian", "a:1: found the byte order \"BigEndian\"; expected LittleEndian"),
        ("UInt32", "UInt16", "a:1: found headers of the type \"UInt16\"; expected UInt32 or UInt64"),
        (
            "NumberOfPoints=\"3\"",
            "NumberOfPoints=\"-3\"",
            "a:3: found -3; expected the number of points of the piece",
        ),
        ("NumberOfPoints=\"3\"", "NumberOfPoints=\"4\"", "a:50: the array Points has 9 numbers; expected 12"),
        (
            "Name=\"diameter\"",
            "Name=\"diameter\" NumberOfComponents=\"3\"",
            "a:28: the array diameter has 3 numbers for each particle; expected 1",
        ),
        (
            "0.5 0.25 0.125",
            "0.5 -0.25 0.125",
            "a:28: diameter of particle 2 is -0.25; expected a diameter above 0 m",
        ),
        (
            "0.5 0.25 0.125",
            "0.5 0.25 nan",
            "a:28: diameter of particle 3 is NaN; expected a diameter above 0 m",
        ),
        ("0.5 0.25 0.125", "0.5 0.25 few", "a:28: the array diameter has \"few\"; expected a number"),
        (
            "Float32",
            "Float16",
            "a:28: the array diameter has numbers of the type \"Float16\"; expected one like Float64",
        ),
        (
            "format=\"ascii\"",
            "format=\"words\"",
            "a:5: found words; expected the format ascii, binary or appended",
        ),
        ("</VTKFile>", "", "a:92: found the end of the file; expected </VTKFile>"),
    ] {
        assert_eq!(with(from, to), expected);
    }
    assert_eq!(
        refusal(b"x y z\n1 2 3\n", &reading()),
        "a:1: found no VTK file; expected the tag <VTKFile> first"
    );
    let materials = |words: &[&str]| {
        let words = words.iter().map(|word| ((*word).to_owned(), 0)).collect();
        FileReading { materials: Some(words), ..reading() }
    };
    assert_eq!(
        refusal(text.as_bytes(), &materials(&["glass", "steel"])),
        "a:43: type of particle 1 is \"1\"; expected one of glass, steel, as the key `materials` says"
    );
    assert_eq!(
        refusal(text.replace("\"type\"", "\"kind\"").as_bytes(), &materials(&["glass"])),
        "a:1: found the columns colour<1>,omega,diameter,v,kind,Points; expected `material`, `species` or `type` among them, for the key `materials`"
    );
    let frame = FileReading { frame: Some(1), ..reading() };
    assert_eq!(
        refusal(text.as_bytes(), &frame),
        "a holds 1 frames; expected more, for frame 1 counted from 0"
    );
}

/// A file of two particles with positions in several blocks, whose header has these numbers.
fn blocks(header: [u64; 3], sizes: Option<u64>) -> Vec<u8> {
    let bytes: Vec<u8> = [0.5_f64, 1.0, 2.0, 4.0, 8.0, 16.0].into_iter().flat_map(f64::to_le_bytes).collect();
    let pack = |block: &[u8]| {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(block).unwrap();
        encoder.finish().unwrap()
    };
    let packed: Vec<Vec<u8>> = bytes.chunks(20).map(pack).collect();
    let mut file =
        b"<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n\
        <PolyData><Piece NumberOfPoints=\"2\"><Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" \
        format=\"appended\" offset=\"0\"/>\n</Points></Piece></PolyData>\n<AppendedData encoding=\"raw\">\n_"
            .to_vec();
    let sizes = packed.iter().map(|block| sizes.unwrap_or(block.len() as u64));
    file.extend(header.into_iter().chain(sizes).flat_map(u64::to_le_bytes));
    file.extend(packed.concat());
    file.extend(b"\n</AppendedData>\n</VTKFile>\n");
    file
}

#[test]
fn blocks_are_put_together_and_headers_that_lie_are_found_out() {
    let whole = parse(Path::new("a"), &blocks([3, 20, 8], None), &reading(), &[], &[]).unwrap();
    let positions = [[0.5, 1.0, 2.0], [4.0, 8.0, 16.0]].map(Vector3::from);
    assert_eq!(whole.iter().map(|grain| grain.position).collect::<Vec<_>>(), positions);
    let refused = |header, sizes| refusal(&blocks(header, sizes), &reading());
    let most = u64::MAX;
    assert_eq!(
        refused([3, 20, 9], None),
        "a:3: the array Points announces 49 bytes; expected 48, as there are particles"
    );
    assert_eq!(
        refused([3, most, most], None),
        "a:3: the array Points announces 18446744073709551615 bytes; expected 48, as there are particles"
    );
    assert_eq!(
        refused([most, 20, 8], None),
        "a:3: the array Points breaks off: 18446744073709551615 bytes should follow"
    );
    assert_eq!(
        refused([3, 20, 8], Some(most / 2)),
        "a:3: the array Points breaks off: 18446744073709551615 bytes should follow"
    );
    let cut = refused([3, 20, 8], Some(4));
    assert!(cut.starts_with("a:3: the array Points cannot be unpacked in block 0: "), "{cut}");
    assert_eq!(
        refused([3, 16, 16], None),
        "a:3: the array Points announces 17 bytes; expected 16, as there are particles"
    );
    let beyond = String::from_utf8_lossy(&blocks([3, 20, 8], None)).replace("offset=\"0\"", "offset=\"999\"");
    assert_eq!(
        refusal(beyond.as_bytes(), &reading()),
        "a:3: the array Points begins at byte 999 of the appended data, where nothing is"
    );
    let mut changed = blocks([3, 20, 8], None);
    let last = changed.len() - "\n</AppendedData>\n</VTKFile>\n".len() - 1;
    changed[last] ^= 1;
    let text = refusal(&changed, &reading());
    assert!(text.starts_with("a:3: the array Points cannot be unpacked in block 2: "), "{text}");
}

#[test]
fn an_index_leads_to_the_instant_that_is_asked_for_and_not_around_in_circles() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = fs::read_to_string(path("ascii.vtp")).unwrap();
    fs::write(at("first.vtp"), &text).unwrap();
    fs::write(at("last.vtp"), text.replace("0.5 0.25 0.125", "2 2 2")).unwrap();
    let index = |files: &[(&str, &str)]| {
        let set = |(time, file): &(&str, &str)| format!("<DataSet timestep=\"{time}\" file=\"{file}\"/>\n");
        let sets: String = files.iter().map(set).collect();
        fs::write(at("series.pvd"), format!("<VTKFile type=\"Collection\">\n{sets}</VTKFile>\n")).unwrap();
    };
    let blocks = "<VTKFile type=\"vtkMultiBlockDataSet\">\n<DataSet name=\"Contacts\" file=\"no.vtp\"/>\n\
        <DataSet name=\"Particles\" file=\"last.vtp\"/>\n</VTKFile>\n";
    fs::write(at("frame.vtm"), blocks).unwrap();
    let radius = |frame| {
        read_points(&at("series.pvd"), &FileReading { frame, ..reading() }).map(|grains| grains[0].radius)
    };
    index(&[("0", "first.vtp"), ("0.5", "frame.vtm")]);
    assert_eq!(radius(Some(0)).unwrap(), Some(0.25));
    assert_eq!([radius(Some(1)).unwrap(), radius(None).unwrap()], [Some(1.0); 2]);
    let refused =
        |frame| radius(frame).unwrap_err().to_string().replace(&*folder.path().to_string_lossy(), "F");
    assert_eq!(
        refused(Some(2)),
        "F/series.pvd holds 2 frames; expected more, for frame 2 counted from 0"
            .replace('/', std::path::MAIN_SEPARATOR_STR)
    );
    index(&[("0", "first.vtp"), ("0", "last.vtp")]);
    assert!(
        refused(None)
            .ends_with("series.pvd:3: found a second file of the time 0; expected all particles in one")
    );
    index(&[("0", "series.pvd")]);
    assert!(refused(None).contains("found a file of the kind \"Collection\""), "{}", refused(None));
    index(&[("0", "nothing.vtp")]);
    assert!(refused(None).starts_with("there is no file F"), "{}", refused(None));
    index(&[]);
    assert!(
        refused(None).ends_with("found an index without particles; expected a file of them"),
        "{}",
        refused(None)
    );
    // The folder is none of a run: nothing says what its materials are called.
    let run = FileReading {
        format: PointsFormat::Run,
        materials: Some([("glass".to_owned(), 0)].into()),
        ..reading()
    };
    index(&[("0", "first.vtp")]);
    assert_eq!(PointsFormat::of_path(folder.path()), PointsFormat::Run);
    let error = read_points(folder.path(), &run).unwrap_err().to_string();
    assert!(error.starts_with("the names of the materials of the run cannot be read: "), "{error}");
    fs::write(at("run.toml"), "[materials.steel]\n[materials.glass]\n").unwrap();
    let grains = read_points(folder.path(), &run).unwrap_err().to_string();
    assert!(
        grains
            .ends_with("type of particle 2 is \"steel\"; expected one of glass, as the key `materials` says"),
        "{grains}"
    );
    let words = Some([("glass".to_owned(), 7), ("steel".to_owned(), 3)].into());
    let grains = read_points(folder.path(), &FileReading { materials: words, ..run }).unwrap();
    assert_eq!(grains.iter().map(|grain| grain.material).collect::<Vec<_>>(), [Some(7), Some(3), Some(7)]);
    fs::remove_file(at("series.pvd")).unwrap();
    let error = read_points(folder.path(), &reading_of_run()).unwrap_err().to_string();
    assert!(error.contains("has no series.pvd; expected the folder of a run"), "{error}");
}

fn reading_of_run() -> FileReading {
    FileReading { format: PointsFormat::Run, ..reading() }
}
