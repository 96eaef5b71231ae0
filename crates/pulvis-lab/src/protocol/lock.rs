//! The lock on the folder of a run, which the system releases when the process ends, however it ends.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::error::PrepareError;

/// The file that is locked. It stays behind, empty of meaning: to remove it would let two runs lock two
/// files of the same name.
pub(crate) const LOCK: &str = ".pulvis-lock";

/// What is asked of a lock where the file system knows none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lock {
    /// A fresh folder may be used all the same.
    IfPossible,
    /// The process that has locked it before must have ended, as far as this machine knows.
    OrDeadProcess,
    /// Files will be removed.
    Needed,
}

/// Whether a process of this machine has the number; `false` where nobody can tell.
fn is_alive(process: &str) -> bool {
    let other = process.parse().is_ok_and(|number: u32| number != std::process::id());
    other && Path::new("/proc").join(process).exists()
}

/// Whether a process holds the lock on a folder; `None` on a file system without locks.
pub(crate) fn is_locked(folder: &Path) -> Option<bool> {
    let Ok(file) = File::open(folder.join(LOCK)) else { return Some(false) };
    // Released at the end; for this instant a run that begins would have to wait, see [`lock`].
    match file.try_lock_shared() {
        Ok(()) => Some(false),
        Err(TryLockError::WouldBlock) => Some(true),
        Err(TryLockError::Error(_)) => {
            process_of(folder).filter(|process| is_alive(&process.to_string())).map(|_| true)
        }
    }
}

/// The number of the process that has locked a folder last.
pub(crate) fn process_of(folder: &Path) -> Option<u32> {
    fs::read_to_string(folder.join(LOCK)).ok()?.parse().ok()
}

/// Time after which a lock is tried for once more: somebody may just have asked whether there is one.
const ONCE_MORE: Duration = Duration::from_millis(50);

/// Locks a folder for this process. `None` on a file system without locks.
pub(crate) fn lock(folder: &Path, wanted: Lock) -> Result<Option<File>, PrepareError> {
    let failed = |source| PrepareError::Folder { folder: PathBuf::from(folder), source };
    let path = folder.join(LOCK);
    let mut file = OpenOptions::new().create(true).truncate(false).write(true).open(&path).map_err(failed)?;
    let locked = file.try_lock().or_else(|error| match error {
        TryLockError::WouldBlock => {
            std::thread::sleep(ONCE_MORE);
            file.try_lock()
        }
        error => Err(error),
    });
    match locked {
        Ok(()) => {
            // For the message of a run that comes while this one goes on.
            file.set_len(0).and_then(|()| write!(file, "{}", std::process::id())).map_err(failed)?;
            Ok(Some(file))
        }
        Err(TryLockError::WouldBlock) => {
            let process = fs::read_to_string(&path).ok().filter(|text| !text.is_empty());
            Err(PrepareError::RunGoesOn { folder: PathBuf::from(folder), process })
        }
        Err(TryLockError::Error(source)) if wanted == Lock::Needed => Err(failed(source)),
        Err(TryLockError::Error(_)) => {
            let process = fs::read_to_string(&path).ok().filter(|process| is_alive(process));
            match process {
                Some(process) if wanted == Lock::OrDeadProcess => {
                    Err(PrepareError::RunGoesOn { folder: PathBuf::from(folder), process: Some(process) })
                }
                _ => Ok(None),
            }
        }
    }
}
