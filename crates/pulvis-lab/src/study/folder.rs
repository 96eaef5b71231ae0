//! The output folder of a study: who may write there, and what is its own.
//!
//! Runs have folders of their own below it, which the protocol guards. What the study writes beside them is listed before it is
//! made, so that nothing else is ever written over.

use crate::protocol::{LOCK, Lock, PrepareError, lock};
use pulvis_input::study::Study;
use pulvis_io::checkpoint::write_text;
use pulvis_io::name_of_temporary;
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The record of the files of a study.
const LIST: &str = "study.files";

/// Its first line.
const HEADING: &str =
    "# The files of this Pulvis study, beside those of its runs; it writes over these and nothing else.";

/// The folder of the runs.
const RUNS: &str = "runs";

/// The folder of a study under way.
#[derive(Debug)]
pub(super) struct StudyFolder {
    pub(super) path: PathBuf,
    /// Released by the system at the end of the process.
    _lock: Option<File>,
}

/// The files that a study writes beside its runs.
pub(super) fn names(study: &Study) -> Vec<String> {
    let tables = ["runs.csv", "study.csv", "study.json", "report.md", "report.html"].map(str::to_owned);
    let pictures = study
        .measures
        .iter()
        .flat_map(|measure| ["png", "svg"].map(|ending| format!("{}.{ending}", measure.key)));
    tables.into_iter().chain(pictures).collect()
}

/// Whether a study could write files of these names into `folder`, without touching it; answers with the files that the study
/// in it has made.
///
/// # Errors
/// The folder holds something else, or one of the files is not that of a study.
pub(super) fn look(folder: &Path, names: &[String]) -> Result<Vec<String>, PrepareError> {
    let failed = |source| PrepareError::Folder { folder: folder.to_owned(), source };
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(failed(error)),
    };
    let present = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let present: Vec<String> = present.collect::<Result<_, std::io::Error>>().map_err(failed)?;
    if present.iter().all(|name| name == LOCK) {
        return Ok(Vec::new());
    }
    let list = fs::read_to_string(folder.join(LIST)).ok();
    let Some(list) = list.as_deref().and_then(|list| list.strip_prefix(HEADING)) else {
        return Err(PrepareError::FolderInUse { folder: folder.to_owned() });
    };
    let own: Vec<String> = list.lines().filter(|name| !name.is_empty()).map(str::to_owned).collect();
    let in_the_way = |name: &&String| present.contains(name) && !own.contains(name);
    match names.iter().find(in_the_way) {
        Some(name) => Err(PrepareError::FileInTheWay { file: folder.join(name) }),
        None => Ok(own),
    }
}

impl StudyFolder {
    /// Makes the folder or goes on in it, and lists the files that will be made. Nobody else can open it until this is dropped.
    ///
    /// # Errors
    /// It holds something else, a study goes on in it, or it cannot be written.
    pub(super) fn open(folder: &Path, names: &[String]) -> Result<Self, PrepareError> {
        let failed = |source| PrepareError::Folder { folder: folder.to_owned(), source };
        // Before anything is written into a folder that may be somebody else's.
        look(folder, names)?;
        fs::create_dir_all(folder.join(RUNS)).or_else(|error| unmake(folder, error)).map_err(failed)?;
        let lock = lock(folder, Lock::OrDeadProcess)?;
        let mut all = if folder.join(LIST).is_file() { look(folder, names)? } else { Vec::new() };
        for name in names {
            if !all.contains(name) {
                all.push(name.clone());
            }
        }
        let text = format!("{HEADING}\n{}\n", all.join("\n"));
        write_text(&folder.join(LIST), &text).map_err(|error| failed(std::io::Error::other(error)))?;
        remove_temporaries(folder, &all);
        Ok(Self { path: folder.to_owned(), _lock: lock })
    }

    /// Where a file of the study is.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }
}

/// Leaves no folder that a study has begun and cannot use.
fn unmake(folder: &Path, error: std::io::Error) -> Result<(), std::io::Error> {
    // It is empty if this study has made it; what is not empty stays.
    let _ = fs::remove_dir(folder);
    Err(error)
}

/// Removes what a killed process was writing.
fn remove_temporaries(folder: &Path, own: &[String]) {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    for name in names.filter(|name| name_of_temporary(name).is_some_and(|of| own.iter().any(|own| own == of)))
    {
        // It is of no use and does no harm.
        let _ = fs::remove_file(folder.join(name));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_study_writes_over_its_own_files_and_over_no_other() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("study");
        let names = ["runs.csv".to_owned(), "phi.png".to_owned()];
        let first = StudyFolder::open(&folder, &names).unwrap();
        let refused = StudyFolder::open(&folder, &names).unwrap_err();
        assert!(matches!(refused, PrepareError::RunGoesOn { .. }), "{refused}");
        fs::write(first.file("runs.csv"), "old").unwrap();
        drop(first);
        drop(StudyFolder::open(&folder, &names).unwrap());
        // A picture that a new measure would write over.
        fs::write(folder.join("mu.png"), "mine").unwrap();
        let more = [names[0].clone(), "mu.png".to_owned()];
        let refused = StudyFolder::open(&folder, &more).unwrap_err();
        assert!(matches!(&refused, PrepareError::FileInTheWay { file } if file.ends_with("mu.png")));
        StudyFolder::open(&folder, &names).unwrap();
        // A folder of somebody else.
        let other = parent.path().join("other");
        fs::create_dir(&other).unwrap();
        fs::write(other.join(LIST), "phi.png\n").unwrap();
        let refused = StudyFolder::open(&other, &names).unwrap_err();
        assert!(matches!(refused, PrepareError::FolderInUse { .. }), "{refused}");
        assert_eq!(fs::read_dir(&other).unwrap().count(), 1);
    }
}
