//! Archives of NumPy arrays.
//!
//! # Source
//! `numpy.lib.format` (version 1.0 of the array files) and PKWARE's APPNOTE 6.3.3, sections 4.3.7, 4.3.12 and 4.3.16: members
//! are stored, not compressed.

use super::numbered::Numbered;
use super::{Format, Instant, Precision};
use crate::vtk::{Numbers, PolyData};
use crate::{IoError, file};
use std::io::{self, Write};
use std::path::PathBuf;

/// `NAME_0000.npz`.
pub(super) const FORMAT: Format = Format {
    name: "npz",
    summary: "arrays of particles and contacts, one archive per instant, for numpy.load",
    open: |series| Ok(Numbered::open(series, names, write)),
    missing: None,
};

/// Sizes and offsets in the archive have 32 bits.
const MOST_BYTES: u64 = u32::MAX as u64;

fn names(name: &str, number: u64) -> Vec<String> {
    vec![format!("{name}_{number:04}.npz")]
}

fn write(paths: &[PathBuf], instant: &Instant<'_>, precision: Precision) -> Result<(), IoError> {
    let mut members = vec![
        ("time".to_owned(), array("<f8", &[], words([instant.time]))),
        ("step".to_owned(), array("<i8", &[], instant.step.to_le_bytes().to_vec())),
        (
            "box".to_owned(),
            array("<f8", &[2, 3], words([instant.bounds.lower, instant.bounds.upper].concat())),
        ),
        ("tilt".to_owned(), array("<f8", &[3], words(instant.bounds.tilt))),
        ("periodic".to_owned(), array("|b1", &[3], instant.bounds.periodic.map(u8::from).to_vec())),
    ];
    let particles = &instant.frame.particles;
    members.push((
        "position".to_owned(),
        floats(particles.points.as_flattened(), particles.points.len(), &[3], precision),
    ));
    members.extend(columns(particles, "", precision));
    members.extend(columns(&instant.frame.contacts, "contact_", precision));
    let total: u64 =
        members.iter().map(|(name, bytes)| 2 * (name.len() as u64 + 60) + bytes.len() as u64).sum();
    let Some(path) = paths.first() else { return Ok(()) };
    if total > MOST_BYTES {
        let reason = io::Error::new(
            io::ErrorKind::FileTooLarge,
            "an npz file holds up to 4 GiB; write fewer fields, with `precision = \"single\"`, or as vtk",
        );
        return Err(IoError::system("write", path, reason));
    }
    file::replace(path, |out| archive(out, &members))
}

fn columns<'a>(
    data: &'a PolyData,
    prefix: &'a str,
    precision: Precision,
) -> impl Iterator<Item = (String, Vec<u8>)> + 'a {
    data.columns.iter().map(move |(name, numbers)| {
        let bytes = match numbers {
            Numbers::Scalar(values) => floats(values, values.len(), &[], precision),
            Numbers::Vector(values) => floats(values.as_flattened(), values.len(), &[3], precision),
            Numbers::Tensor(values) => floats(values.as_flattened(), values.len(), &[3, 3], precision),
            Numbers::Integer(values) => {
                array("<i8", &[values.len()], values.iter().flat_map(|value| value.to_le_bytes()).collect())
            }
        };
        (format!("{prefix}{name}"), bytes)
    })
}

fn words(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(f64::to_le_bytes).collect()
}

/// An array of `rows` values of this shape.
fn floats(values: &[f64], rows: usize, shape: &[usize], precision: Precision) -> Vec<u8> {
    let shape = [&[rows], shape].concat();
    match precision {
        Precision::Double => array("<f8", &shape, words(values.iter().copied())),
        Precision::Single => {
            array("<f4", &shape, values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect())
        }
    }
}

/// An array file, version 1.0: magic, length of the header, the header as a Python dictionary, the numbers.
fn array(kind: &str, shape: &[usize], numbers: Vec<u8>) -> Vec<u8> {
    let mut words = shape.iter().map(|count| format!("{count},")).collect::<Vec<_>>().join(" ");
    if shape.len() > 1 {
        words.pop();
    }
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({words}), }}");
    // The numbers begin at a multiple of 64 bytes, after a line break.
    let blanks = 63 - (10 + header.len()) % 64;
    header.extend(std::iter::repeat_n(' ', blanks));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(numbers);
    bytes
}

/// Version of the archive format that stored members need, 2.0.
const VERSION: u16 = 20;

/// The first day that an archive can name, 1 January 1980: the same input gives the same bytes.
const DATE: u16 = 0b0000_0000_0010_0001;

fn archive(out: &mut impl Write, members: &[(String, Vec<u8>)]) -> io::Result<()> {
    let mut directory = Vec::new();
    let mut offset: u32 = 0;
    for (name, bytes) in members {
        let name = format!("{name}.npy");
        let (checksum, size) = (crc32fast::hash(bytes), bytes.len() as u32);
        // Flags, method (stored), time, date, checksum, sizes, lengths of name and extra field.
        let mut common = Vec::new();
        for word in [VERSION, 0, 0, 0, DATE] {
            common.extend(word.to_le_bytes());
        }
        for word in [checksum, size, size] {
            common.extend(word.to_le_bytes());
        }
        common.extend((name.len() as u16).to_le_bytes());
        common.extend(0_u16.to_le_bytes());
        out.write_all(b"PK\x03\x04")?;
        out.write_all(&common)?;
        out.write_all(name.as_bytes())?;
        out.write_all(bytes)?;
        directory.extend(b"PK\x01\x02");
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&common);
        // Comment, disk, attributes inside and outside.
        directory.extend([0; 2 + 2 + 2 + 4]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
        offset += (4 + common.len() + name.len() + bytes.len()) as u32;
    }
    out.write_all(&directory)?;
    out.write_all(b"PK\x05\x06")?;
    let count = (members.len() as u16).to_le_bytes();
    out.write_all(&[&[0; 4][..], &count, &count].concat())?;
    out.write_all(&(directory.len() as u32).to_le_bytes())?;
    out.write_all(&offset.to_le_bytes())?;
    out.write_all(&[0; 2])
}
