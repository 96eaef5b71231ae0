//! `start_from`: another run whose state this one starts from.

use crate::context::{Location, Reported};
use crate::reader::TableReader;
use crate::shape::Text;
use crate::value_reader::ValueReader;
use std::path::{Path, PathBuf};

/// The state that a run starts from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartFrom {
    /// The absolute path of the folder of a run, or of one of its checkpoint files.
    pub path: PathBuf,
    /// The stage at whose end the state was written; the latest checkpoint where `None`.
    pub stage: Option<String>,
}

/// Reads `start_from`; paths are relative to `folder`.
pub(crate) fn read_start(
    root: &mut TableReader<'_>,
    folder: &Path,
) -> Result<Option<(StartFrom, Location)>, Reported> {
    let place = root.location("start_from");
    let Some(value) = root.value("start_from") else { return Ok(None) };
    let (path, stage) = if value.is_table() { read_table(&value)? } else { (value.read(StartShape)?, None) };
    let path = folder.join(path);
    let path = std::path::absolute(&path).unwrap_or(path);
    Ok(Some((StartFrom { path, stage }, place)))
}

fn read_table(value: &ValueReader<'_>) -> Result<(String, Option<String>), Reported> {
    let mut table = value.table()?;
    let run = table.required("run", Text);
    let stage = table.optional("stage", Text);
    table.finish();
    Ok((run?, stage?))
}

/// A path or a table, as the message names it.
struct StartShape;

impl crate::shape::Shape for StartShape {
    type Output = String;

    fn describe(&self) -> String {
        "the folder of a run, one of its checkpoint files, or { run = \"FOLDER\", stage = \"NAME\" }"
            .to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<String, Reported> {
        match value.raw() {
            crate::value::Value::Text(path) => Ok(path.clone()),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}
