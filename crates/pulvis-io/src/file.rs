//! Whole files or none: write under a temporary name, then rename.

use crate::IoError;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes the file `path` through `write`, so that `path` is either what it was before or complete.
///
/// Nothing is synced to the disk: a killed *process* cannot leave half a file, since the rename comes after the last
/// byte was handed to the system. Surviving a power cut would cost one disk flush per frame; checkpoints pay that, output
/// that can be made again does not.
pub(crate) fn replace(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), IoError> {
    let temporary = temporary_name(path);
    let written = write_all(&temporary, write).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|source| {
        // The leftover is of no use; that it cannot be removed either is not the error worth telling.
        let _ = fs::remove_file(&temporary);
        IoError::system("write", path, source)
    })
}

/// Creates `folder` and its parents if they are missing.
pub(crate) fn create_folder(folder: &Path) -> Result<(), IoError> {
    fs::create_dir_all(folder).map_err(|source| IoError::system("create the folder", folder, source))
}

fn write_all(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let mut file = BufWriter::with_capacity(1 << 16, File::create(path)?);
    write(&mut file)?;
    // `into_inner` would lose the error in a drop; flush tells it.
    file.flush()
}

/// Hands the folder of a file to the disk: names are as lasting as contents then.
pub(crate) fn sync_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Only Unix opens folders.
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// The name that a temporary file would have got, had its process not been killed before; `None` for any other name.
pub fn name_of_temporary(name: &str) -> Option<&str> {
    let (rest, process) = name.strip_prefix('.')?.strip_suffix(".part")?.rsplit_once('.')?;
    (!process.is_empty() && process.bytes().all(|byte| byte.is_ascii_digit())).then_some(rest)
}

/// Same folder (a rename across file systems is a copy), hidden, and owned by this process: two runs that share a
/// folder by mistake do not mix their bytes.
pub(crate) fn temporary_name(path: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_failed_write_keeps_the_old_file_and_leaves_no_litter() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("data.txt");
        replace(&path, |file| file.write_all(b"first")).unwrap();
        let failed = replace(&path, |file| {
            file.write_all(b"half of the sec")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(matches!(failed, Err(IoError::System { action: "write", .. })));
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_an_error_not_a_surprise_folder() {
        let folder = tempfile::tempdir().unwrap();
        let error = replace(&folder.path().join("none/data.txt"), |_| Ok(())).unwrap_err();
        assert!(error.to_string().contains("create the folder first"), "{error}");
    }
}
