//! The checkpoint to go on from.

use std::cmp::Reverse;
use std::fs;
use std::path::{Path, PathBuf};

use pulvis_input::scenario::StartFrom;
use pulvis_io::checkpoint::{CheckpointError, peek_header, read_header};
use thiserror::Error;

use super::{Checkpoint, END_OF_RUN, LATEST, PREVIOUS, is_checkpoint};

/// A checkpoint and its file.
#[derive(Debug)]
pub(in crate::protocol) struct Found {
    pub(in crate::protocol) path: PathBuf,
    pub(in crate::protocol) checkpoint: Checkpoint,
}

/// Why there is no checkpoint to go on from.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FindError {
    /// It cannot be used.
    #[error(
        "{} {reason}{}",
        .file.display(),
        .other.as_ref().map_or(String::new(), |(other, step)| format!("; {} (step {step}) is whole, name it instead", other.display()))
    )]
    Unusable {
        /// The file.
        file: PathBuf,
        /// Why not.
        reason: CheckpointError,
        /// One that can be used, and its step.
        other: Option<(PathBuf, String)>,
    },
    /// A folder without checkpoints.
    #[error("there is no checkpoint in {}", .0.display())]
    None(PathBuf),
    /// A folder without one of the end of this stage.
    #[error("there is no checkpoint of the end of the stage \"{stage}\" in {}{}", .folder.display(), list_of(.known))]
    NoStage {
        /// The folder.
        folder: PathBuf,
        /// The stage.
        stage: String,
        /// Stages of which there is one.
        known: Vec<String>,
    },
}

fn list_of(stages: &[String]) -> String {
    if stages.is_empty() {
        "; runs keep them with `checkpoints = { stage_ends = true }` in [output]".to_owned()
    } else {
        format!("; there are some of {}", stages.join(", "))
    }
}

/// The checkpoint files of a run, the latest first; before them those that do not even begin as a checkpoint does.
pub fn checkpoint_files(folder: &Path) -> Vec<PathBuf> {
    let names = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<String> = names.filter(|name| is_checkpoint(name)).collect();
    names.sort_by_cached_key(|name| {
        let header = peek_header(&folder.join(name)).ok();
        let step: Option<u64> = header.and_then(|header| value(&header, "step")?.parse().ok());
        let kind = [LATEST, PREVIOUS].iter().position(|known| known == name).unwrap_or(2);
        (Reverse(step.unwrap_or(u64::MAX)), kind, name.clone())
    });
    names.into_iter().map(|name| folder.join(name)).collect()
}

/// Whether the run in a folder has come to its end.
pub fn has_ended(folder: &Path) -> bool {
    let header = peek_header(&folder.join(LATEST)).ok();
    header.and_then(|header| value(&header, "where")).is_some_and(|place| place == END_OF_RUN)
}

/// The latest checkpoint of a folder, or the one in a file. `None` for a folder that has none.
pub(in crate::protocol) fn find(path: &Path) -> Result<Option<Found>, FindError> {
    let file = if path.is_dir() { checkpoint_files(path).into_iter().next() } else { Some(path.to_owned()) };
    file.map(read).transpose()
}

fn read(file: PathBuf) -> Result<Found, FindError> {
    match Checkpoint::read(&file) {
        Ok(checkpoint) => Ok(Found { path: file, checkpoint }),
        Err(reason) => {
            let folder = file.parent().unwrap_or(Path::new(""));
            let others = checkpoint_files(folder).into_iter().filter(|other| *other != file);
            let other = others.filter_map(|other| Some((value(&read_header(&other).ok()?, "step")?, other)));
            let other = other.map(|(step, path)| (path, step)).next();
            Err(FindError::Unusable { file, reason, other })
        }
    }
}

/// The checkpoint that a scenario starts from.
pub(in crate::protocol) fn of_run(start: &StartFrom) -> Result<Found, FindError> {
    let StartFrom { path, stage } = start;
    let Some(stage) = stage else {
        return find(path)?.ok_or_else(|| FindError::None(path.clone()));
    };
    let mut known = Vec::new();
    for file in checkpoint_files(path) {
        let Ok(header) = peek_header(&file) else { continue };
        let has_ended = value(&header, "where").is_some_and(|place| place.starts_with("end "));
        match value(&header, "stage") {
            Some(name) if has_ended && name == *stage => return read(file),
            Some(name) if has_ended && !known.contains(&name) => known.push(name),
            _ => {}
        }
    }
    Err(FindError::NoStage { folder: path.clone(), stage: stage.clone(), known })
}

/// A value of a header.
fn value(header: &str, key: &str) -> Option<String> {
    let mut lines = header.lines().filter_map(|line| line.split_once(" = "));
    let (_, value) = lines.find(|(name, _)| *name == key)?;
    let quoted = value.strip_prefix('"').and_then(|value| value.strip_suffix('"'));
    // Names are written as Rust does it, with a backslash before quotes and backslashes.
    Some(quoted.map_or(value.to_owned(), |text| text.replace("\\\"", "\"").replace("\\\\", "\\")))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn checkpoints_come_in_the_order_of_their_steps_and_what_cannot_be_one_before_them() {
        let folder = tempfile::tempdir().unwrap();
        let [early, late, cut] = [1, 2, 10].map(|number| format!("checkpoint.stage-{number}.pulvis"));
        for (name, step) in
            [(&*early, 100), (&*late, 900), (LATEST, 700), (PREVIOUS, 100), ("notes.pulvis", 999)]
        {
            fs::write(folder.path().join(name), format!("Pulvis checkpoint 6\nstep = {step}\n\n")).unwrap();
        }
        fs::write(folder.path().join(&cut), "").unwrap();
        let found = checkpoint_files(folder.path());
        let found: Vec<_> = found.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(found, [&cut, &late, LATEST, PREVIOUS, &early]);
    }

    #[test]
    fn values_of_a_header_are_read_with_quotes_in_them() {
        let header = format!("step = 12\nstage = {:?}", "a \"b\" \\ c");
        assert_eq!(value(&header, "stage").unwrap(), "a \"b\" \\ c");
        assert_eq!(value(&header, "step").unwrap(), "12");
        assert_eq!(value(&header, "time"), None);
    }
}
