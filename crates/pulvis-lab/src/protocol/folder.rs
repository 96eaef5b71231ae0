//! The folder that a run writes into.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::error::PrepareError;

/// Files that a run makes: what `--force` may remove. Anything else in the folder is left alone.
fn is_ours(name: &str) -> bool {
    let numbered = ["particles_", "contacts_", "frame_"].iter().any(|prefix| name.starts_with(prefix))
        && [".vtp", ".vtm"].iter().any(|ending| name.ends_with(ending));
    let plot = name.ends_with(".png");
    numbered || plot || ["run.toml", "timeseries.csv", "series.pvd", "stages.csv"].contains(&name)
}

/// Makes the folder, or makes sure that it is empty; with `force`, removes the run that is in it.
pub(super) fn open(folder: &Path, force: bool) -> Result<(), PrepareError> {
    let failed = |source| PrepareError::Folder { folder: PathBuf::from(folder), source };
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return fs::create_dir_all(folder).map_err(failed);
        }
        Err(error) => return Err(failed(error)),
    };
    let names: Vec<String> = entries
        .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, std::io::Error>>()
        .map_err(failed)?;
    if names.is_empty() {
        return probe(folder).map_err(failed);
    }
    if !force {
        return Err(PrepareError::FolderInUse { folder: PathBuf::from(folder) });
    }
    for name in names.iter().filter(|name| is_ours(name)) {
        fs::remove_file(folder.join(name)).map_err(failed)?;
    }
    Ok(())
}

/// Whether files can be made in an empty folder.
fn probe(folder: &Path) -> Result<(), std::io::Error> {
    let probe = folder.join(".pulvis-probe");
    fs::File::create_new(&probe)?;
    fs::remove_file(probe)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_folder_in_use_is_refused_and_force_removes_runs_only() {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        open(&run, false).unwrap();
        open(&run, false).unwrap();
        fs::write(run.join("timeseries.csv"), "old").unwrap();
        fs::write(run.join("notes.txt"), "mine").unwrap();
        assert!(matches!(open(&run, false), Err(PrepareError::FolderInUse { .. })));
        assert!(run.join("timeseries.csv").exists());
        open(&run, true).unwrap();
        assert!(!run.join("timeseries.csv").exists());
        assert_eq!(fs::read_to_string(run.join("notes.txt")).unwrap(), "mine");
    }

    #[test]
    fn a_file_in_the_folders_place_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(matches!(open(&file, true), Err(PrepareError::Folder { .. })));
    }
}
