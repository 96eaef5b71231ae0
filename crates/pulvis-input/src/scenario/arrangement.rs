//! Where the particles of a group start.

use super::columns::ParticleColumn;
use super::domain::read_extent;
use super::import::{FileReading, GrainColumn, PointsError, PointsFormat, read_points};
use super::listed::read_list;
use super::materials::{Material, read_material_name};
use crate::context::Reported;
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Choice, Integer, Shape, Text};
use crate::value::Value;
use crate::value_reader::ValueReader;
use pulvis_boundary::Cuboid;
use pulvis_math::{Dimension, Vector3};
use pulvis_packing::{Growth, Lattice, Structure};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where the particles of a group start.
#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// On a cubic lattice.
    Lattice(Lattice),
    /// At random, whole and without overlap, in this block.
    Random(Cuboid),
    /// At random in this block, where they have grown until they had their size.
    Dense(Cuboid),
    /// Touching each other in an aggregate that has grown at random.
    Aggregate {
        /// Its centre of mass [m].
        centre: Vector3,
        /// How it has grown.
        growth: Growth,
    },
    /// As a file says.
    File {
        /// The absolute path of the file.
        path: PathBuf,
        /// How it is read.
        reading: FileReading,
        /// What stands in it; a quantity is given for all grains or for none.
        grains: Vec<Grain>,
        /// Further quantities of them, as far as the file has any.
        columns: Vec<GrainColumn>,
    },
    /// As listed; a quantity is given for all grains or for none.
    List(Vec<Grain>),
}

impl Arrangement {
    /// What a file or a list says of each particle; nothing where a rule arranges them.
    pub fn grains(&self) -> &[Grain] {
        match self {
            Self::File { grains, .. } | Self::List(grains) => grains,
            Self::Lattice(_) | Self::Random(_) | Self::Dense(_) | Self::Aggregate { .. } => &[],
        }
    }

    /// What a file says of a further quantity, for each particle.
    pub fn column(&self, name: &str) -> Option<&GrainColumn> {
        match self {
            Self::File { columns, .. } => columns.iter().find(|column| column.name == name),
            _ => None,
        }
    }

    /// Whether a quantity is given for each particle.
    pub(super) fn gives<T>(&self, quantity: impl Fn(&Grain) -> Option<T>) -> bool {
        !self.grains().is_empty() && self.grains().iter().all(|grain| quantity(grain).is_some())
    }

    /// Whether it tells the materials of its particles, so that the group has none.
    pub(super) fn gives_materials(&self) -> bool {
        match self {
            Self::File { reading, .. } => reading.materials.is_some(),
            _ => self.gives(|grain| grain.material),
        }
    }
}

/// A particle of a file or a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Position of the centre [m].
    pub position: Vector3,
    /// Radius [m], if it is given.
    pub radius: Option<f64>,
    /// Velocity [m/s], if it is given.
    pub velocity: Option<Vector3>,
    /// Angular velocity [rad/s], if it is given.
    pub angular_velocity: Option<Vector3>,
    /// Index of the material, if it is given.
    pub material: Option<usize>,
}

/// More particles than this do not fit into any memory: the number is a slip.
pub(super) const MOST_PARTICLES: i64 = 10_000_000_000;

/// Reads `[particles.arrangement]`; paths of files are relative to `folder`.
pub(super) fn read_arrangement(
    mut table: TableReader<'_>,
    materials: &[Material],
    folder: &Path,
) -> Result<Arrangement, Reported> {
    let read = match table.selector("kind", &["lattice", "random", "dense", "aggregate", "file", "list"])? {
        "lattice" => read_lattice(&mut table).map(Arrangement::Lattice),
        "random" => read_extent(&mut table).map(Arrangement::Random),
        "dense" => read_extent(&mut table).map(Arrangement::Dense),
        "aggregate" => {
            let centre = table.required("centre", Vector::of(Dimension::LENGTH));
            let growth = table.required("growth", Choice(&Growth::ALL));
            centre.and_then(|centre| Ok(Arrangement::Aggregate { centre: centre.into(), growth: growth? }))
        }
        "file" => read_file(&mut table, materials, folder),
        _ => read_list(&mut table, materials).map(Arrangement::List),
    };
    table.finish();
    read
}

fn read_lattice(table: &mut TableReader<'_>) -> Result<Lattice, Reported> {
    let lower = table.required("lower", Vector::of(Dimension::LENGTH));
    let counts = table.required("counts", List::of(Integer::between(1, MOST_PARTICLES)).exactly(3));
    let spacing = table.required("spacing", QuantityRule::of(Dimension::LENGTH).above(0.0));
    // Beyond half a spacing a particle could change places with its neighbour.
    let jitter = table.or("jitter", QuantityRule::of(Dimension::NONE).at_least(0.0).at_most(0.5), 0.0);
    let structure = table.or("structure", Choice(&Structure::ALL), Structure::default());
    let (counts, structure) = (counts?, structure?);
    let one = Lattice { counts: [1; 3], lower: Vector3::zero(), spacing: 1.0, jitter: 0.0, structure };
    let of_cell = i64::try_from(one.site_count()).unwrap_or(i64::MAX);
    let sites = counts.iter().fold(of_cell, |sites, count| sites.saturating_mul(*count));
    if sites > MOST_PARTICLES {
        let problem = Problem::rule(format!("the lattice has {sites} sites"), "1e10 or fewer");
        return Err(table.refuse("counts", problem));
    }
    let mut cells = [1; 3];
    for (cell, count) in cells.iter_mut().zip(counts) {
        *cell = usize::try_from(count).unwrap_or(usize::MAX);
    }
    Ok(Lattice { lower: lower?.into(), counts: cells, spacing: spacing?, jitter: jitter?, structure })
}

fn read_file(
    table: &mut TableReader<'_>,
    materials: &[Material],
    folder: &Path,
) -> Result<Arrangement, Reported> {
    let given = table.required("path", Text)?;
    let path = folder.join(given);
    let path = std::path::absolute(&path).unwrap_or(path);
    let reading = read_reading(table, materials, &path)?;
    match read_points(&path, &reading, table.checkpoint_reader()) {
        Ok((grains, columns)) => Ok(Arrangement::File { path, reading, grains, columns }),
        Err(error @ (PointsError::Missing { .. } | PointsError::Unreadable { .. })) => Err(table
            .refuse_with_help(
                "path",
                Problem::Refused(Box::new(error)),
                "the path is relative to the folder of the scenario",
            )),
        Err(error) => Err(table.refuse("path", Problem::Refused(Box::new(error)))),
    }
}

/// Refuses further quantities of a file that have another dimension than the scenario says, or values that are no numbers.
pub(super) fn check_columns(
    table: &TableReader<'_>,
    arrangement: &Arrangement,
    columns: &[ParticleColumn],
) -> Result<(), Reported> {
    for own in columns {
        let Some(given) = arrangement.column(&own.name) else { continue };
        let unit = own.dimension.unit();
        if given.unit != unit {
            let found = format!("`{}` is in {} in the file, and in {unit} here", own.name, given.unit);
            return Err(
                table.refuse("columns", Problem::rule(found, "the unit of the file, or another name"))
            );
        }
        if let Some(row) = given.values.iter().position(|value| !value.is_finite()) {
            let found = format!("`{}` of particle {row} is {} in the file", own.name, given.values[row]);
            return Err(table.refuse("columns", Problem::rule(found, "finite numbers")));
        }
    }
    Ok(())
}

/// How the file is read.
fn read_reading(
    table: &mut TableReader<'_>,
    materials: &[Material],
    path: &Path,
) -> Result<FileReading, Reported> {
    let format = table.or("format", Choice(&PointsFormat::ALL), PointsFormat::of_path(path));
    let frame = table.optional("frame", Integer::at_least(0));
    let length_unit = table.or("length_unit", QuantityRule::of(Dimension::LENGTH).above(0.0), 1.0);
    let time_unit = table.or("time_unit", QuantityRule::of(Dimension::TIME).above(0.0), 1.0);
    let words = read_words(table, materials);
    let (format, frame) = (format?, frame?);
    if frame.is_some()
        && matches!(format, PointsFormat::Table | PointsFormat::LammpsData | PointsFormat::Checkpoint)
    {
        let found = format!("a file of the format {:?} holds one instant", format.name());
        return Err(table.refuse("frame", Problem::rule(found, "no `frame`")));
    }
    Ok(FileReading {
        format,
        frame: frame.map(|frame| usize::try_from(frame).unwrap_or(usize::MAX)),
        length_unit: length_unit?,
        time_unit: time_unit?,
        materials: words?,
    })
}

/// What the words of the file mean: all names of materials themselves, or what a table says.
fn read_words(
    table: &mut TableReader<'_>,
    materials: &[Material],
) -> Result<Option<BTreeMap<String, usize>>, Reported> {
    let Some(value) = table.value("materials") else { return Ok(None) };
    if !value.is_table() {
        let wanted = value.read(MaterialsShape)?;
        let themselves = materials.iter().enumerate().map(|(index, material)| (material.name.clone(), index));
        return Ok(wanted.then(|| themselves.collect()));
    }
    let mut words = value.table()?;
    let keys = words.keys();
    let read: Vec<_> = keys
        .into_iter()
        .map(|word| Ok((word.to_owned(), read_material_name(&mut words, word, materials)?)))
        .collect();
    words.finish();
    read.into_iter().collect::<Result<BTreeMap<_, _>, _>>().map(Some)
}

/// `true`, `false` or a table, as the message names it.
struct MaterialsShape;

impl Shape for MaterialsShape {
    type Output = bool;

    fn describe(&self) -> String {
        "true (the file has names of materials) or a table like { 1 = \"glass\", 2 = \"steel\" }".to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<bool, Reported> {
        match value.raw() {
            Value::Boolean(wanted) => Ok(*wanted),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}
