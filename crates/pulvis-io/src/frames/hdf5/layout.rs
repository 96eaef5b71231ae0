//! What stands where in the files.

use super::super::{Bounds, Instant, Precision, Series};
use super::imp::Entry;
use super::name_of;
use crate::vtk::{Numbers, PolyData};
use hdf5_metno::types::VarLenUnicode;
use hdf5_metno::{Dataset, File, Group, H5Type, Location, Result as Written};

/// Versions of H5MD and of its module `units` that the files follow.
const H5MD: [i32; 2] = [1, 1];
const UNITS: [i32; 2] = [1, 0];

/// Rows that are compressed together: about 100 kB of a column, 400 kB of a vector.
const ROWS: usize = 1 << 14;

/// Zlib does little better at higher levels, and takes its time.
const LEVEL: u8 = 4;

/// How numbers are written.
#[derive(Debug)]
pub(super) struct Style {
    precision: Precision,
    compressed: bool,
    particle_units: Vec<(String, String)>,
    contact_units: Vec<(String, String)>,
}

impl Style {
    pub(super) fn new(series: &Series<'_>) -> Self {
        Self {
            precision: series.precision,
            compressed: series.compressed,
            particle_units: series.units.particles.to_vec(),
            contact_units: series.units.contacts.to_vec(),
        }
    }

    /// Numbers, of 64 or 32 bits.
    fn floats(&self, group: &Group, values: &[f64], shape: &[usize]) -> Written<Dataset> {
        match self.precision {
            Precision::Double => self.array(group, values, shape),
            Precision::Single => {
                let values: Vec<f32> = values.iter().map(|&value| value as f32).collect();
                self.array(group, &values, shape)
            }
        }
    }

    fn array<T: H5Type>(&self, group: &Group, values: &[T], shape: &[usize]) -> Written<Dataset> {
        let mut builder = group.new_dataset_builder().obj_track_times(false);
        if self.compressed && !values.is_empty() {
            let chunk: Vec<usize> = shape.iter().map(|&length| length.min(ROWS)).collect();
            builder = builder.chunk(chunk).shuffle().deflate(LEVEL);
        }
        let dataset = builder.empty::<T>().shape(shape.to_vec()).create("value")?;
        if !values.is_empty() {
            dataset.write_raw(values)?;
        }
        Ok(dataset)
    }

    /// An element: a group with `step`, `time` and `value`.
    fn element(&self, parent: &Group, name: &str, numbers: &Numbers, unit: Option<&str>) -> Written<()> {
        let group = clocked(parent, name)?;
        let dataset = match numbers {
            Numbers::Scalar(values) => self.floats(&group, values, &[1, values.len()]),
            Numbers::Vector(values) => self.floats(&group, values.as_flattened(), &[1, values.len(), 3]),
            Numbers::Tensor(values) => self.floats(&group, values.as_flattened(), &[1, values.len(), 3, 3]),
            Numbers::Integer(values) => self.array(&group, values, &[1, values.len()]),
        }?;
        unit.map_or(Ok(()), |unit| text(&dataset, "unit", unit))
    }
}

/// Writes an instant into an empty file.
pub(super) fn write_instant(file: &File, instant: &Instant<'_>, style: &Style) -> Written<()> {
    describe(file)?;
    numbers(file, "step", &[instant.step])?;
    let time = numbers(file, "time", &[instant.time])?;
    text(&time, "unit", "s")?;
    let materials: Vec<VarLenUnicode> =
        instant.materials.iter().map(|name| unicode(name)).collect::<Written<_>>()?;
    let parameters = group(&group(file, "parameters")?, "materials")?;
    parameters.new_attr::<VarLenUnicode>().shape(materials.len()).create("names")?.write_raw(&materials)?;
    let particles = group(&group(file, "particles")?, "all")?;
    write_box(&particles, &instant.bounds)?;
    let data = &instant.frame.particles;
    style.element(&particles, "position", &Numbers::Vector(data.points.clone()), Some("m"))?;
    columns(&particles, data, style, &style.particle_units)?;
    columns(&group(file, "contacts")?, &instant.frame.contacts, style, &style.contact_units)
}

fn columns(parent: &Group, data: &PolyData, style: &Style, units: &[(String, String)]) -> Written<()> {
    for (name, numbers) in &data.columns {
        let unit = units.iter().find(|(known, _)| known == name).map(|(_, unit)| unit.as_str());
        style.element(parent, name_of(name), numbers, unit)?;
    }
    Ok(())
}

/// The box: vectors of its edges, lower corner, which directions are periodic.
fn write_box(particles: &Group, bounds: &Bounds) -> Written<()> {
    let Bounds { lower, upper, tilt: [xy, xz, yz], periodic } = *bounds;
    let [x, y, z] = [0, 1, 2].map(|axis| upper[axis] - lower[axis]);
    let group = group(particles, "box")?;
    group.new_attr::<i32>().create("dimension")?.write_scalar(&3)?;
    let words = periodic.map(|periodic| unicode(if periodic { "periodic" } else { "none" }));
    let words: Vec<VarLenUnicode> = words.into_iter().collect::<Written<_>>()?;
    group.new_attr::<VarLenUnicode>().shape(3).create("boundary")?.write_raw(&words)?;
    let exact = Style {
        precision: Precision::Double,
        compressed: false,
        particle_units: Vec::new(),
        contact_units: Vec::new(),
    };
    let edges = [x, 0.0, 0.0, xy, y, 0.0, xz, yz, z];
    let edges = exact.floats(&clocked(&group, "edges")?, &edges, &[1, 3, 3])?;
    text(&edges, "unit", "m")?;
    let offset = exact.floats(&clocked(&group, "offset")?, &lower, &[1, 3])?;
    text(&offset, "unit", "m")
}

/// Writes the index of these instants into an empty file.
pub(super) fn write_index(file: &File, entries: &[Entry]) -> Written<()> {
    describe(file)?;
    let whole = |value: fn(&Entry) -> u64| entries.iter().map(value).collect::<Vec<u64>>();
    numbers(file, "step", &whole(|entry| entry.step))?;
    let times: Vec<f64> = entries.iter().map(|entry| entry.time).collect();
    let time = numbers(file, "time", &times)?;
    text(&time, "unit", "s")?;
    numbers(file, "particle_count", &whole(|entry| entry.particles))?;
    numbers(file, "contact_count", &whole(|entry| entry.contacts))?;
    let frames = group(file, "frames")?;
    entries
        .iter()
        .enumerate()
        .try_for_each(|(number, entry)| frames.link_external(&entry.file, "/", &format!("{number:04}")))
}

/// The instants of an index; `name` tells their files.
pub(super) fn read_index(file: &File, name: impl Fn(usize) -> String) -> Written<Vec<Entry>> {
    let whole = |name| file.dataset(name).and_then(|data| data.read_raw::<u64>());
    let (steps, times) = (whole("step")?, file.dataset("time")?.read_raw::<f64>()?);
    let (particles, contacts) = (whole("particle_count")?, whole("contact_count")?);
    let counts = particles.into_iter().zip(contacts);
    let entries = steps.into_iter().zip(times).zip(counts).enumerate();
    let entry = |(number, ((step, time), (particles, contacts)))| Entry {
        file: name(number),
        step,
        time,
        particles,
        contacts,
    };
    Ok(entries.map(entry).collect())
}

/// The group `h5md`: what the file is, and who wrote it.
fn describe(file: &File) -> Written<()> {
    let root = group(file, "h5md")?;
    root.new_attr::<i32>().shape(2).create("version")?.write_raw(&H5MD)?;
    // H5MD wants an author; files of a run know of none.
    let author = group(&root, "author")?;
    text(&author, "name", "unknown")?;
    let creator = group(&root, "creator")?;
    text(&creator, "name", "Pulvis")?;
    text(&creator, "version", env!("CARGO_PKG_VERSION"))?;
    let units = group(&group(&root, "modules")?, "units")?;
    units.new_attr::<i32>().shape(2).create("version")?.write_raw(&UNITS)?;
    text(&units, "system", "SI")
}

/// A group without the time at which it was made: the same input gives the same bytes.
fn group(parent: &Group, name: &str) -> Written<Group> {
    parent.create_group_builder().obj_track_times(false).create(name)
}

/// A group that shares the step and the time of the file.
fn clocked(parent: &Group, name: &str) -> Written<Group> {
    let group = group(parent, name)?;
    group.link_hard("/step", "step")?;
    group.link_hard("/time", "time")?;
    Ok(group)
}

fn numbers<T: H5Type>(file: &File, name: &str, values: &[T]) -> Written<Dataset> {
    let builder = file.new_dataset_builder().obj_track_times(false).empty::<T>();
    let dataset = builder.shape(values.len()).create(name)?;
    if !values.is_empty() {
        dataset.write_raw(values)?;
    }
    Ok(dataset)
}

fn text(object: &Location, name: &str, value: &str) -> Written<()> {
    object.new_attr::<VarLenUnicode>().create(name)?.write_scalar(&unicode(value)?)
}

fn unicode(text: &str) -> Written<VarLenUnicode> {
    text.parse().map_err(|error| format!("{text:?} is no text of HDF5: {error:?}").into())
}
