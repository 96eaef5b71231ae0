//! Further files of particles and contacts: in which format, when, and what of them.

use super::observers::check_region;
use super::output::{Interval, read_either};
use super::region::{read_region, write_region};
use super::resolved::writer::{Writer, list, quantity, text};
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::{Boolean, Choice, Shape, Text};
use crate::value::Value;
use crate::value_reader::ValueReader;
use pulvis_boundary::{Cuboid, Domain, Region};
use pulvis_math::Dimension;

/// Files of one format that a run writes beside those of the key `vtk`.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputFiles {
    /// How the names of the files begin; no two blocks have the same.
    pub name: String,
    /// The format.
    pub format: FileFormat,
    /// How often, beside the start and the end of each stage; `None`: only there.
    pub every: Option<Interval>,
    /// Names of what is written of particles, each once; `None` is [`DEFAULT_PARTICLE_FIELDS`] and all columns that the
    /// particles have.
    pub fields: Option<Vec<String>>,
    /// What is written of contacts.
    pub contacts: ContactFields,
    /// Where particles and contact points must lie; `None` is everywhere.
    pub region: Option<Region>,
    /// Whether numbers have 32 bits instead of 64.
    pub single_precision: bool,
    /// Whether files are compressed; VTK and HDF5 files only.
    pub compressed: bool,
}

/// What is written of contacts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ContactFields {
    /// Nothing.
    None,
    /// [`DEFAULT_CONTACT_FIELDS`].
    Default,
    /// What has these names, each once.
    Named(Vec<String>),
}

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileFormat {
    /// VTK, a set of files per instant.
    Vtk,
    /// Text dumps of LAMMPS.
    LammpsDump,
    /// Extended XYZ.
    Xyz,
    /// Archives of NumPy arrays.
    Npz,
    /// Comma-separated values.
    Csv,
    /// HDF5 after H5MD.
    Hdf5,
}

impl FileFormat {
    /// All of them, with their names in a scenario.
    pub const ALL: [(&'static str, Self); 6] = [
        ("vtk", Self::Vtk),
        ("lammps-dump", Self::LammpsDump),
        ("xyz", Self::Xyz),
        ("npz", Self::Npz),
        ("csv", Self::Csv),
        ("hdf5", Self::Hdf5),
    ];

    /// The name in a scenario.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, format)| *format == self).map_or("", |(name, _)| name)
    }
}

/// What can be written of particles, beside the columns of `[particles.columns]`.
pub const PARTICLE_FIELDS: [&str; 15] = [
    "id",
    "type",
    "radius",
    "v",
    "omega",
    "f",
    "torque",
    "coordination",
    "mass",
    "stress",
    "kinetic_translation",
    "kinetic_rotation",
    "stored_energy",
    "cluster",
    "cluster_size",
];

/// What is written of particles where nothing is said: the first of [`PARTICLE_FIELDS`].
pub const DEFAULT_PARTICLE_FIELDS: &[&str] = PARTICLE_FIELDS.split_at(8).0;

/// What can be written of contacts.
pub const CONTACT_FIELDS: [&str; 11] = [
    "id1",
    "id2",
    "force",
    "normal_force",
    "overlap",
    "memory",
    "normal",
    "branch",
    "point",
    "tangential_force",
    "stored_energy",
];

/// What is written of contacts where nothing is said: the first of [`CONTACT_FIELDS`].
pub const DEFAULT_CONTACT_FIELDS: &[&str] = CONTACT_FIELDS.split_at(6).0;

/// What a block of files may refer to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sample<'a> {
    /// The periodic domain.
    pub(super) domain: Option<&'a Domain>,
    /// The box.
    pub(super) enclosure: Option<&'a Cuboid>,
    /// Names of the further quantities of particles; `None` where these could not be read, or come from another run.
    pub(super) columns: Option<&'a [String]>,
}

impl OutputFiles {
    /// How the names of the files of a block begin that has no name.
    pub const DEFAULT_NAME: &str = "sample";
}

/// Reads `[[output.files]]`, if there are.
pub(super) fn read_output_files(
    output: &mut TableReader<'_>,
    sample: &Sample<'_>,
) -> Result<Vec<OutputFiles>, Reported> {
    let mut all: Vec<OutputFiles> = Vec::new();
    let mut failure = None;
    for table in output.tables("files")? {
        match read_block(table, sample, &all) {
            Ok(files) => all.push(files),
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(all), Err)
}

fn read_block(
    mut table: TableReader<'_>,
    sample: &Sample<'_>,
    before: &[OutputFiles],
) -> Result<OutputFiles, Reported> {
    let format = table.required("format", Choice(&FileFormat::ALL));
    let name = table.or("name", Text, OutputFiles::DEFAULT_NAME.to_owned());
    let name = name.and_then(|name| check_name(&table, name, format.as_ref().ok().copied(), before));
    let every = read_either(&mut table);
    let own = sample.columns.unwrap_or_default();
    let known: Vec<&str> = PARTICLE_FIELDS.into_iter().chain(own.iter().map(String::as_str)).collect();
    let is_known = |name: &str| sample.columns.is_none() || known.contains(&name);
    let fields = table.optional("fields", List::of(Text).at_least(1)).and_then(|fields| {
        fields.map(|fields| check_fields(&table, "fields", fields, &known, is_known)).transpose()
    });
    let contacts = read_contacts(&mut table, &format);
    let region = read_region(&mut table, "region").and_then(|region| {
        region.map(|region| check_region(&table, region, sample.domain, sample.enclosure)).transpose()
    });
    let compressed = table.or("compressed", Boolean, false).and_then(|compressed| match &format {
        Ok(format) if compressed && !matches!(format, FileFormat::Vtk | FileFormat::Hdf5) => {
            let found = format!("`compressed` for the format {:?}", format.name());
            Err(table.refuse(
                "compressed",
                Problem::rule(found, "the format \"vtk\" or \"hdf5\", or no `compressed`"),
            ))
        }
        _ => Ok(compressed),
    });
    let precision = table.or("precision", Choice(&[("double", false), ("single", true)]), false);
    table.finish();
    Ok(OutputFiles {
        name: name?,
        format: format?,
        every: every?,
        fields: fields?,
        contacts: contacts?,
        region: region?,
        single_precision: precision?,
        compressed: compressed?,
    })
}

/// Longest name of a block: file systems take names of 255 bytes, and numbers and endings follow it.
const LONGEST_NAME: usize = 100;

fn check_name(
    table: &TableReader<'_>,
    name: String,
    format: Option<FileFormat>,
    before: &[OutputFiles],
) -> Result<String, Reported> {
    if name.len() > LONGEST_NAME {
        let found = format!("a name of {} letters", name.len());
        return Err(table.refuse("name", Problem::rule(found, format!("at most {LONGEST_NAME} letters"))));
    }
    // `NAME_contacts_0000.csv` holds the contacts of a block, or the particles of one with this longer name.
    let mut tables =
        before.iter().filter(|files| files.format == FileFormat::Csv && format == Some(FileFormat::Csv));
    let is_taken = |one: &str, other: &str| one.eq_ignore_ascii_case(&format!("{other}_contacts"));
    if let Some(files) = tables.find(|files| is_taken(&files.name, &name) || is_taken(&name, &files.name)) {
        let found = format!(
            "the files of contacts and particles of this block and of {:?} have the same names",
            files.name
        );
        return Err(table.refuse("name", Problem::rule(found, "another name for each block")));
    }
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let found = format!("{name:?} is no beginning of a file name");
        return Err(table.refuse("name", Problem::rule(found, "only letters, digits and underscores")));
    }
    // Some file systems do not tell small letters from large ones.
    if before.iter().any(|files| files.name.eq_ignore_ascii_case(&name)) {
        let found = format!("the files of two blocks are called {name:?}");
        let help = "give each block a `name`";
        return Err(table.refuse_with_help(
            "name",
            Problem::rule(found, "another name for each block"),
            help,
        ));
    }
    Ok(name)
}

/// Names that are known, each once.
fn check_fields(
    table: &TableReader<'_>,
    key: &str,
    fields: Vec<String>,
    known: &[&str],
    is_known: impl Fn(&str) -> bool,
) -> Result<Vec<String>, Reported> {
    if let Some(unknown) = fields.iter().find(|name| !is_known(name)) {
        return Err(table.refuse(key, Problem::unknown_choice(unknown, known)));
    }
    match fields.iter().enumerate().find(|(index, name)| fields[..*index].contains(name)) {
        Some((_, twice)) => {
            let found = format!("{twice:?} stands here twice");
            Err(table.refuse(key, Problem::rule(found, "each field once")))
        }
        None => Ok(fields),
    }
}

fn read_contacts(
    table: &mut TableReader<'_>,
    format: &Result<FileFormat, Reported>,
) -> Result<ContactFields, Reported> {
    let none = matches!(format, Ok(FileFormat::Xyz));
    let Some(value) = table.value("contacts") else {
        return Ok(if none { ContactFields::None } else { ContactFields::Default });
    };
    let contacts = match value.raw() {
        Value::Boolean(false) => ContactFields::None,
        Value::Boolean(true) => ContactFields::Default,
        _ => {
            let names = value.read(ContactShape)?;
            let is_known = |name: &str| CONTACT_FIELDS.contains(&name);
            ContactFields::Named(check_fields(table, "contacts", names, &CONTACT_FIELDS, is_known)?)
        }
    };
    if none && contacts != ContactFields::None {
        let problem =
            Problem::rule("an xyz file holds particles only", "no `contacts`, or a format that has them");
        return Err(table.refuse("contacts", problem));
    }
    Ok(contacts)
}

/// A list of names, as the message names it.
struct ContactShape;

impl Shape for ContactShape {
    type Output = Vec<String>;

    fn describe(&self) -> String {
        "true, false or a list of names".to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<Vec<String>, Reported> {
        match value.raw() {
            Value::List(_) => value.read(List::of(Text).at_least(1)),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}

/// Writes `[[output.files]]`.
pub(super) fn write_output_files(writer: &mut Writer, all: &[OutputFiles]) {
    for files in all {
        let OutputFiles { name, format, every, fields, contacts, region, single_precision, compressed } =
            files;
        writer.item("output.files");
        writer.key("name", text(name));
        writer.key("format", text(format.name()));
        match every {
            None => {}
            Some(Interval::Steps(steps)) => writer.key("steps", steps.to_string()),
            Some(Interval::Time(time)) => writer.key("interval", quantity(*time, Dimension::TIME)),
        }
        let names = |names: &[String]| list(names.iter().map(|name| text(name)));
        if let Some(fields) = fields {
            writer.key("fields", names(fields));
        }
        match contacts {
            ContactFields::None => writer.key("contacts", "false"),
            ContactFields::Default => writer.key("contacts", "true"),
            ContactFields::Named(fields) => writer.key("contacts", names(fields)),
        }
        writer.key("precision", text(if *single_precision { "single" } else { "double" }));
        if *compressed {
            writer.key("compressed", "true");
        }
        if let Some(region) = region {
            writer.table("output.files.region");
            write_region(writer, region);
        }
    }
}
