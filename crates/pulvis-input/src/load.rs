//! From a path to the text of a scenario file.

use crate::error::{InputError, InputErrors};
use crate::problem::Problem;
use crate::similar::similar;
use crate::source::Source;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Scenarios are kilobytes; whoever names a result file by mistake should hear it at once in MiB.
const LARGEST: u64 = 16;

/// Reads a whole file as text.
pub(crate) fn read_source(path: &Path) -> Result<Source, InputErrors> {
    let name = path.display().to_string();
    let bytes = read_bytes(path).map_err(|problem| {
        let help = match problem {
            Problem::NoSuchFile => neighbour(path).map(|file| format!("did you mean `{file}`?")),
            _ => None,
        };
        InputErrors::from(InputError { help, ..InputError::of_file(&name, problem) })
    })?;
    decode(name, bytes)
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, Problem> {
    if path.is_dir() {
        return Err(Problem::Folder);
    }
    let refused = |reason: io::Error| match reason.kind() {
        io::ErrorKind::NotFound => Problem::NoSuchFile,
        _ => Problem::Unreadable { reason },
    };
    let mut bytes = Vec::new();
    // `take` and not the size of the file: a device or pipe has no size.
    File::open(path)
        .and_then(|file| file.take((LARGEST << 20) + 1).read_to_end(&mut bytes))
        .map_err(refused)?;
    if bytes.len() as u64 > LARGEST << 20 {
        return Err(Problem::TooLarge { limit: LARGEST });
    }
    Ok(bytes)
}

/// A file beside the missing one with a similar name.
fn neighbour(path: &Path) -> Option<String> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    let name = similar(path.file_name()?.to_str()?, names.iter().map(String::as_str))?;
    Some(path.with_file_name(name).display().to_string())
}

/// Bytes to text, without byte order mark.
fn decode(name: String, bytes: Vec<u8>) -> Result<Source, InputErrors> {
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(&name, &text)),
        Err(error) => {
            let valid = error.utf8_error().valid_up_to();
            let byte = error.as_bytes().get(valid).copied().unwrap_or_default();
            // Up to the bad byte both texts are the same, so its place can be shown.
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            let place = Source { name: name.clone(), text }.place(&(valid..valid + 1));
            Err(InputError { place: Some(place), ..InputError::of_file(&name, Problem::NotText { byte }) }
                .into())
        }
    }
}
