//! A file that grows by one instant after the other.

use crate::IoError;
use crate::table::SeriesPosition;
use std::fs::{File, OpenOptions};
use std::hash::Hasher;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use twox_hash::XxHash3_64;

/// Bytes that are handed to the system at once.
const BUFFER: usize = 1 << 16;

/// A file that grows. Its length and hash tell a resumed run whether it is still the same, and where to cut it off.
pub(super) struct Growing {
    path: PathBuf,
    name: String,
    /// There is none before the first instant.
    file: Option<File>,
    /// What is not handed to the system yet; taken into the hash in the same pieces, because numbers come one by one.
    waiting: Vec<u8>,
    bytes: u64,
    hash: XxHash3_64,
}

impl std::fmt::Debug for Growing {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { path, bytes, .. } = self;
        formatter.debug_struct("Growing").field("path", path).field("bytes", bytes).finish_non_exhaustive()
    }
}

impl Growing {
    /// The file `name` in `folder`, which is created with the first instant, or goes on at a position.
    ///
    /// # Errors
    /// The file cannot be read or written, or is another one up to that position.
    pub(super) fn open(folder: &Path, name: String, at: Option<SeriesPosition>) -> Result<Self, IoError> {
        let path = folder.join(&name);
        let failed = |source| IoError::system("write", &path, source);
        let mut hash = XxHash3_64::with_seed(0);
        let (file, bytes) = match at {
            None => (None, 0),
            Some(at) => {
                let mut file = OpenOptions::new().read(true).write(true).open(&path).map_err(failed)?;
                let changed =
                    |problem: &str| IoError::Changed { path: path.clone(), problem: problem.to_owned() };
                if hash_up_to(&mut file, at.bytes, &mut hash).map_err(failed)? != at.bytes {
                    return Err(changed("it has lost frames"));
                }
                if hash.finish() != at.hash {
                    return Err(changed("its frames are other ones"));
                }
                file.set_len(at.bytes).map_err(failed)?;
                file.seek(SeekFrom::End(0)).map_err(failed)?;
                (Some(file), at.bytes)
            }
        };
        Ok(Self { file, waiting: Vec::with_capacity(2 * BUFFER), path, name, bytes, hash })
    }

    /// The name of the file.
    pub(super) fn name(&self) -> String {
        self.name.clone()
    }

    /// Adds what `write` writes and hands it to the system, so that a reader finds whole instants.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn add(&mut self, write: impl FnOnce(&mut Self) -> io::Result<()>) -> Result<(), IoError> {
        let written = self.create().and_then(|()| write(self)).and_then(|()| self.flush());
        written.map_err(|source| IoError::system("write", &self.path, source))
    }

    fn create(&mut self) -> io::Result<()> {
        if self.file.is_none() {
            self.file = Some(File::create(&self.path)?);
        }
        Ok(())
    }

    /// How far the file has come.
    pub(super) fn position(&self) -> SeriesPosition {
        SeriesPosition { bytes: self.bytes, hash: self.hash.finish() }
    }
}

impl Write for Growing {
    #[inline]
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.waiting.extend_from_slice(bytes);
        if self.waiting.len() >= BUFFER {
            self.flush()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if let Some(file) = &mut self.file {
            file.write_all(&self.waiting)?;
        }
        self.hash.write(&self.waiting);
        self.bytes += self.waiting.len() as u64;
        self.waiting.clear();
        Ok(())
    }
}

/// Takes the first `bytes` of a file into a hash; answers with how many there are.
fn hash_up_to(file: &mut File, bytes: u64, hash: &mut XxHash3_64) -> io::Result<u64> {
    let mut left = Read::by_ref(file).take(bytes);
    let mut buffer = vec![0; BUFFER];
    let mut seen = 0;
    loop {
        match left.read(&mut buffer)? {
            0 => return Ok(seen),
            count => {
                hash.write(&buffer[..count]);
                seen += count as u64;
            }
        }
    }
}
