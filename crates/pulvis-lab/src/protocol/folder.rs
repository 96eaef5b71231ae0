//! The folder that a run writes into: who may write there, and what `--force` may remove.
//!
//! A run holds a lock on its folder, which the system releases when the process ends, however it ends. It
//! lists every file before making it, so that a later `--force` removes what the old run has made and
//! nothing else.

use std::collections::HashSet;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use pulvis_io::IoError;
use pulvis_io::checkpoint::write_text;
use pulvis_io::name_of_temporary;

use super::averages::AVERAGES;
use super::checkpoint::is_checkpoint;
use super::error::{PrepareError, RunError};
use super::explain::ALARM;
use super::fields::FIELDS;
use super::lock::{LOCK, Lock, lock};
use super::observers::is_histogram;
use super::status::STATUS;

/// The record of the files of a run.
pub(super) const LIST: &str = "run.files";

/// The resolved scenario.
pub(crate) const RECORD: &str = "run.toml";

/// The first line of [`LIST`].
const HEADING: &str = "# The files of this Pulvis run; `pulvis run --force` removes them and nothing else.";

/// The folder of a run under way.
#[derive(Debug)]
pub(super) struct OutputFolder {
    path: PathBuf,
    list: File,
    listed: HashSet<String>,
    /// The same in the order of the list.
    names: Vec<String>,
    /// Released by the system at the end of the process.
    _lock: Option<File>,
}

impl OutputFolder {
    /// Makes the folder, or makes sure that it is empty; with `force`, removes the files of the run that is in
    /// it. Nobody else can open it until this is dropped.
    ///
    /// # Errors
    /// It holds something else than a run that has ended, or cannot be written.
    pub(super) fn open(folder: &Path, force: bool) -> Result<Self, PrepareError> {
        let failed = |source| PrepareError::Folder { folder: PathBuf::from(folder), source };
        // Before anything is written into a folder that may be somebody else's.
        look(folder, force)?;
        fs::create_dir_all(folder).map_err(failed)?;
        let lock = lock(folder, if force { Lock::Needed } else { Lock::IfPossible })?;
        // Once more: another run may have come and gone before the lock was had.
        for name in look(folder, force)? {
            match fs::remove_file(folder.join(name)) {
                Err(error) if error.kind() != ErrorKind::NotFound => return Err(failed(error)),
                _ => {}
            }
        }
        let mut list = File::create(folder.join(LIST)).map_err(failed)?;
        writeln!(list, "{HEADING}\n{LIST}").map_err(failed)?;
        let listed = HashSet::from([LIST.to_owned()]);
        Ok(Self { path: folder.to_owned(), list, listed, names: vec![LIST.to_owned()], _lock: lock })
    }

    /// Opens the folder of a run that has ended, however it ended, to go on with it.
    ///
    /// # Errors
    /// It holds no run, or one that goes on, or cannot be written.
    pub(super) fn reopen(folder: &Path) -> Result<Self, PrepareError> {
        let failed = |source| PrepareError::Folder { folder: PathBuf::from(folder), source };
        let is_run = || files_of_run(folder).is_some() && folder.join(RECORD).is_file();
        if !is_run() {
            return Err(PrepareError::NothingToResume { folder: PathBuf::from(folder) });
        }
        let lock = lock(folder, Lock::OrDeadProcess)?;
        let names = files_of_run(folder).unwrap_or_default();
        let list = OpenOptions::new().append(true).open(folder.join(LIST)).map_err(failed)?;
        let listed = names.iter().cloned().collect();
        Ok(Self { path: folder.to_owned(), list, listed, names, _lock: lock })
    }

    /// The files of the run, in the order of its list.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether the list begins with these files.
    ///
    /// # Errors
    /// It does not.
    pub(super) fn check_list(&self, files: &[String]) -> Result<(), RunError> {
        if self.names.starts_with(files) {
            return Ok(());
        }
        let problem = "it does not list the files of the checkpoint".to_owned();
        Err(IoError::Changed { path: self.path.join(LIST), problem }.into())
    }

    /// Removes all files of the run but for `kept`, which are the first ones of its list, and what was being written when
    /// it ended.
    ///
    /// # Errors
    /// The list does not begin with them, or a file cannot be removed.
    pub(super) fn cut_back(&mut self, kept: &[String]) -> Result<(), RunError> {
        self.check_list(kept)?;
        let path = self.path.join(LIST);
        let later = self.names.split_off(kept.len());
        let of_killed = temporaries(&self.path, |name| self.listed.contains(name));
        for name in later.into_iter().chain(of_killed) {
            let file = self.path.join(name);
            match fs::remove_file(&file) {
                Err(source) if source.kind() != ErrorKind::NotFound => {
                    return Err(RunError::File { file, source });
                }
                _ => {}
            }
        }
        self.listed = self.names.iter().cloned().collect();
        write_text(&path, &format!("{HEADING}\n{}\n", self.names.join("\n")))?;
        let reopened = OpenOptions::new().append(true).open(&path);
        self.list = reopened.map_err(|source| RunError::File { file: path, source })?;
        Ok(())
    }

    /// The folder.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Lists a file that is about to be made; answers with its path. A file may be listed again.
    ///
    /// # Errors
    /// There is a file of this name that the run has not made, or the list cannot be written.
    pub(super) fn file(&mut self, name: &str) -> Result<PathBuf, RunError> {
        let path = self.path.join(name);
        if self.listed.contains(name) {
            return Ok(path);
        }
        let failed = |source| RunError::File { file: self.path.join(name), source };
        if path.symlink_metadata().is_ok() {
            return Err(failed(ErrorKind::AlreadyExists.into()));
        }
        // One call, so that a list is never cut off within a line.
        self.list.write_all(format!("{name}\n").as_bytes()).map_err(failed)?;
        self.listed.insert(name.to_owned());
        self.names.push(name.to_owned());
        Ok(path)
    }
}

/// Removes the files of the run that is in a folder.
///
/// # Errors
/// It holds something else than a run that has ended, or a file cannot be removed.
pub(crate) fn clear(folder: &Path) -> Result<(), PrepareError> {
    OutputFolder::open(folder, true).map(drop)
}

/// Whether a run could write into `folder`, without touching it; answers with the names of the files that it
/// would remove first.
///
/// # Errors
/// A run would be refused.
pub(super) fn look(folder: &Path, force: bool) -> Result<Vec<String>, PrepareError> {
    let failed = |source| PrepareError::Folder { folder: PathBuf::from(folder), source };
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return ancestor_is_writable(folder).map(|()| Vec::new()).map_err(failed);
        }
        Err(error) => return Err(failed(error)),
    };
    let names: Vec<String> = entries
        .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, io::Error>>()
        .map_err(failed)?;
    if fs::metadata(folder).map_err(failed)?.permissions().readonly() {
        return Err(failed(ErrorKind::PermissionDenied.into()));
    }
    if names.iter().all(|name| name == LOCK) {
        return Ok(Vec::new());
    }
    let folder = PathBuf::from(folder);
    let Some(old) = files_of_run(&folder) else {
        return Err(if force {
            PrepareError::NoRun { folder }
        } else {
            PrepareError::FolderInUse { folder }
        });
    };
    if !force {
        return Err(PrepareError::RunInFolder { folder });
    }
    let in_the_way = |name: &&String| !old.contains(name) && may_be_written(name);
    match names.iter().find(in_the_way) {
        Some(name) => Err(PrepareError::FileInTheWay { file: folder.join(name) }),
        None => {
            let of_killed = temporaries(&folder, |name| old.iter().any(|old| old == name));
            Ok(old.into_iter().chain(of_killed).collect())
        }
    }
}

/// The files that the run in a folder has made by its own record; `None` where no run is recorded.
fn files_of_run(folder: &Path) -> Option<Vec<String>> {
    let text = fs::read_to_string(folder.join(LIST)).ok()?;
    let names = text.strip_prefix(HEADING)?.lines().filter(|name| !name.is_empty());
    // A scenario of the user that has come into the folder later is not ours.
    let record = fs::read_to_string(folder.join(RECORD));
    if record.is_ok_and(|record| !record.starts_with("# Pulvis ")) {
        return None;
    }
    // Only files of this very folder, whoever has written the list.
    let is_plain = |name: &&str| Path::new(name).file_name().is_some_and(|plain| plain == *name);
    let others = names.filter(|name| *name != LIST).filter(is_plain);
    Some([LIST].into_iter().chain(others).map(str::to_owned).collect())
}

/// The files that a killed process was writing, in the place of those that `is_own`.
fn temporaries(folder: &Path, is_own: impl Fn(&str) -> bool) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    names.filter(|name| name_of_temporary(name).is_some_and(&is_own)).collect()
}

/// Whether a run may write a file of this name.
fn may_be_written(name: &str) -> bool {
    let numbered = || -> Option<bool> {
        let (kind, rest) = name.split_once('_')?;
        let (number, ending) = rest.split_once('.')?;
        let digits = number.len() >= 4 && number.bytes().all(|byte| byte.is_ascii_digit());
        Some(
            digits
                && ["particles", "contacts", "walls", "surfaces", "frame"].contains(&kind)
                && ["vtp", "vtm"].contains(&ending),
        )
    };
    let is_picture = || match name.rsplit_once('.') {
        Some((name, "png" | "svg")) => ["energies", "stress", "force_displacement"].contains(&name),
        _ => false,
    };
    let others =
        [RECORD, LIST, ALARM, AVERAGES, FIELDS, STATUS, "timeseries.csv", "series.pvd", "particles.png"];
    is_checkpoint(name)
        || is_histogram(name)
        || is_picture()
        || others.contains(&name)
        || numbered() == Some(true)
}

/// Whether the next folder above that exists lets one be made in it, as far as can be told without trying.
fn ancestor_is_writable(folder: &Path) -> Result<(), io::Error> {
    let mut ancestors = folder.ancestors().skip(1);
    let above = ancestors.find(|above| above.as_os_str().is_empty() || above.exists());
    let above = above.filter(|above| !above.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let data = fs::metadata(above)?;
    match (data.is_dir(), data.permissions().readonly()) {
        (false, _) => Err(ErrorKind::NotADirectory.into()),
        (true, true) => Err(ErrorKind::PermissionDenied.into()),
        (true, false) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    /// A folder in which a run has made some files, and its temporary parent.
    fn ended_run() -> (tempfile::TempDir, PathBuf) {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("run");
        let mut run = OutputFolder::open(&folder, false).unwrap();
        for name in [RECORD, "timeseries.csv", "particles_0000.vtp"] {
            fs::write(run.file(name).unwrap(), "# Pulvis 1").unwrap();
        }
        (parent, folder)
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.retain(|name| name != LOCK);
        names.sort();
        names
    }

    #[test]
    fn force_removes_what_the_old_run_has_listed_and_nothing_else() {
        let (_parent, folder) = ended_run();
        for name in ["notes.txt", "particles_final.vtp", "mine.png", "frame_1.vtm"] {
            fs::write(folder.join(name), "mine").unwrap();
        }
        assert!(matches!(OutputFolder::open(&folder, false), Err(PrepareError::RunInFolder { .. })));
        let run = OutputFolder::open(&folder, true).unwrap();
        assert_eq!(names(&folder), ["frame_1.vtm", "mine.png", "notes.txt", "particles_final.vtp", LIST]);
        drop(run);
        // What has been written so far is all that a run which was killed has listed.
        assert_eq!(files_of_run(&folder).unwrap(), [LIST]);
    }

    #[test]
    fn a_folder_without_a_run_is_refused_with_force_too_and_stays_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let stranger = |name: &str, text: &str| {
            fs::write(folder.path().join(name), text).unwrap();
            let refused = OutputFolder::open(folder.path(), true);
            assert!(matches!(refused, Err(PrepareError::NoRun { .. })), "{refused:?}");
            assert_eq!(fs::read_to_string(folder.path().join(name)).unwrap(), text);
        };
        stranger("stress.png", "mine");
        stranger(LIST, "particles_0000.vtp\n");
        stranger(RECORD, "title = \"my scenario\"");
        // A list of ours beside a scenario that is not.
        stranger(LIST, &format!("{HEADING}\n{RECORD}\n"));
        assert!(!folder.path().join(LOCK).exists());
    }

    #[test]
    fn a_run_that_goes_on_keeps_its_folder_and_one_that_has_ended_does_not() {
        let (_parent, folder) = ended_run();
        let first = OutputFolder::open(&folder, true).unwrap();
        let before = names(&folder);
        let refused = OutputFolder::open(&folder, true).unwrap_err();
        assert!(refused.to_string().starts_with("a run is going on in the output folder"), "{refused}");
        assert!(refused.to_string().contains(&format!("(process {})", std::process::id())), "{refused}");
        assert_eq!(names(&folder), before);
        drop(first);
        OutputFolder::open(&folder, true).unwrap();
    }

    #[test]
    fn a_file_of_the_user_is_never_written_over() {
        let (_parent, folder) = ended_run();
        fs::write(folder.join("particles_0007.vtp"), "mine").unwrap();
        let refused = OutputFolder::open(&folder, true).unwrap_err();
        assert!(
            matches!(&refused, PrepareError::FileInTheWay { file } if file.ends_with("particles_0007.vtp"))
        );
        assert!(folder.join("timeseries.csv").exists(), "nothing is removed before all is known");
        fs::remove_file(folder.join("particles_0007.vtp")).unwrap();
        let mut run = OutputFolder::open(&folder, true).unwrap();
        // One that comes while the run goes on.
        fs::write(folder.join("energies.png"), "mine").unwrap();
        assert!(matches!(run.file("energies.png"), Err(RunError::File { .. })));
        assert_eq!(fs::read_to_string(folder.join("energies.png")).unwrap(), "mine");
    }

    #[test]
    fn a_list_that_names_files_elsewhere_removes_none_of_them() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("run");
        fs::create_dir(&folder).unwrap();
        fs::write(parent.path().join("precious"), "mine").unwrap();
        fs::write(folder.join(LIST), format!("{HEADING}\n../precious\n/etc/none\n..\n.\n")).unwrap();
        OutputFolder::open(&folder, true).unwrap();
        assert_eq!(fs::read_to_string(parent.path().join("precious")).unwrap(), "mine");
    }

    #[test]
    fn looking_at_a_folder_says_what_opening_it_would_and_makes_nothing() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("deep/er");
        assert!(look(&folder, false).unwrap().is_empty());
        assert!(!folder.exists());
        let file = parent.path().join("file");
        fs::write(&file, "").unwrap();
        for folder in [file.clone(), file.join("below")] {
            assert!(matches!(look(&folder, true), Err(PrepareError::Folder { .. })), "{folder:?}");
            assert!(matches!(OutputFolder::open(&folder, true), Err(PrepareError::Folder { .. })));
        }
    }
}
