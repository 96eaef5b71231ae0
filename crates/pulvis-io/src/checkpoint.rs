//! Checkpoint files: a header for people, compressed contents, a checksum.
//!
//! ```text
//! Pulvis checkpoint 6        the version of the format
//! step = 1200                lines of the header, which `head` shows
//!                            an empty line
//! ....                       the contents, in LZ4 frames
//! ........                   XXH3 of all bytes before, little endian
//! ```
//!
//! A file is written under another name, handed to the disk, and then renamed: a process that is killed and a power cut
//! leave the file whole, or the one before it.

use crate::file::{sync_folder, temporary_name};
use crate::{IoError, file};
use lz4_flex::frame::{BlockSize, FrameDecoder, FrameEncoder, FrameInfo};
use std::fs::{self, File};
use std::hash::Hasher;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path;
use twox_hash::XxHash3_64;

/// The version of the format that this program writes, and the only one that it reads. Version 3 came with walls that turn,
/// inlets and outlets, programs of parameters, and several kinds of files; version 5 with groups of particles; version 6 with
/// forces that a program applies and walls that it leads.
pub const VERSION: u32 = 6;

const HEADING: &str = "Pulvis checkpoint ";

/// Headers are some lines; what has no end within these bytes is something else.
const LONGEST_HEADER: usize = 1 << 16;

/// Why a checkpoint file cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The operating system refused to read it.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// It begins as no checkpoint does.
    #[error("is no checkpoint of Pulvis")]
    Foreign,
    /// A newer program has written it.
    #[error(
        "has version {found} of the format, and this program reads version {VERSION}; take a newer Pulvis"
    )]
    Newer {
        /// Its version.
        found: u32,
    },
    /// An older program has written it.
    #[error(
        "has version {found} of the format, and this program reads version {VERSION}; take the Pulvis that its header names"
    )]
    Older {
        /// Its version.
        found: u32,
    },
    /// Its bytes are not those that were written.
    #[error("is damaged or cut off: its checksum is another one")]
    Damaged,
}

/// Writes a checkpoint file and hands it to the disk. `header` is made of lines; `contents` are compressed on their way. The
/// file that has the name now becomes `previous`, if that is given. Answers with the size of the new file \[byte\].
///
/// # Errors
/// It cannot be written; all files then are as they were.
pub fn write(
    path: &Path,
    previous: Option<&Path>,
    header: &str,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<u64, IoError> {
    let temporary = temporary_name(path);
    let written = write_whole(&temporary, header, contents).and_then(|size| {
        match previous.map(|previous| fs::rename(path, previous)) {
            Some(Err(error)) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        fs::rename(&temporary, path)?;
        sync_folder(path)?;
        Ok(size)
    });
    written.map_err(|source| {
        // The leftover is of no use; that it cannot be removed either is not the error worth telling.
        let _ = fs::remove_file(&temporary);
        IoError::system("write", path, source)
    })
}

fn write_whole(
    path: &Path,
    header: &str,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<u64> {
    let file = BufWriter::with_capacity(1 << 16, File::create(path)?);
    let mut out = Hashed { inner: file, hash: XxHash3_64::with_seed(0), bytes: 0, failed: None };
    write!(out, "{HEADING}{VERSION}\n{}\n\n", header.trim_end())?;
    let blocks = FrameInfo::new().block_size(BlockSize::Max1MB);
    let mut packed = FrameEncoder::with_frame_info(blocks, &mut out);
    let done = contents(&mut packed).and_then(|()| packed.finish().map(drop).map_err(io::Error::from));
    // Serialisers forget why a write has failed; the file has not.
    if let Some(reason) = out.failed.take() {
        return Err(reason);
    }
    done?;
    let Hashed { mut inner, hash, bytes, .. } = out;
    inner.write_all(&hash.finish().to_le_bytes())?;
    inner.flush()?;
    inner.get_ref().sync_all()?;
    Ok(bytes + 8)
}

/// The header of a checkpoint file, of which nothing else is read: it may be damaged all the same.
///
/// # Errors
/// It does not begin as a checkpoint does.
pub fn peek_header(path: &Path) -> Result<String, CheckpointError> {
    let mut bytes = Vec::new();
    File::open(path)?.take(LONGEST_HEADER as u64).read_to_end(&mut bytes)?;
    if !bytes.starts_with(HEADING.as_bytes()) {
        return Err(CheckpointError::Foreign);
    }
    let (header, _) = split_header(&bytes)?;
    Ok(header.to_owned())
}

/// The header of a checkpoint file whose checksum is right.
///
/// # Errors
/// It is none, or it is damaged.
pub fn read_header(path: &Path) -> Result<String, CheckpointError> {
    Ok(read_whole(path)?.0)
}

/// Header and contents of a checkpoint file.
///
/// # Errors
/// It is none, or it is damaged.
pub fn read(path: &Path) -> Result<(String, Vec<u8>), CheckpointError> {
    let (header, bytes, begin) = read_whole(path)?;
    let mut contents = Vec::new();
    let packed = bytes.get(begin..bytes.len() - 8).ok_or(CheckpointError::Damaged)?;
    FrameDecoder::new(packed).read_to_end(&mut contents).map_err(|_| CheckpointError::Damaged)?;
    Ok((header, contents))
}

/// The header, all bytes, and where the contents begin.
fn read_whole(path: &Path) -> Result<(String, Vec<u8>, usize), CheckpointError> {
    let mut file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::Error::from(io::ErrorKind::IsADirectory).into());
    }
    let mut bytes = vec![0; HEADING.len()];
    // A file of the user may be huge: look at its first bytes first.
    if file.read_exact(&mut bytes).is_err() || bytes != HEADING.as_bytes() {
        return Err(CheckpointError::Foreign);
    }
    file.read_to_end(&mut bytes)?;
    let (header, begin) = split_header(&bytes)?;
    let header = header.to_owned();
    let sum = bytes.len().checked_sub(8).filter(|&sum| sum >= begin).ok_or(CheckpointError::Damaged)?;
    if XxHash3_64::oneshot(&bytes[..sum]).to_le_bytes() != bytes[sum..] {
        return Err(CheckpointError::Damaged);
    }
    Ok((header, bytes, begin))
}

/// The header in the first bytes of a file that begins with the heading, and where the contents begin.
fn split_header(bytes: &[u8]) -> Result<(&str, usize), CheckpointError> {
    let text = &bytes[..bytes.len().min(LONGEST_HEADER)];
    let line_end = text.iter().position(|&byte| byte == b'\n').ok_or(CheckpointError::Damaged)?;
    let version = std::str::from_utf8(&text[HEADING.len().min(line_end)..line_end]).ok();
    match version.and_then(|version| version.parse::<u32>().ok()) {
        None => return Err(CheckpointError::Damaged),
        Some(found) if found > VERSION => return Err(CheckpointError::Newer { found }),
        Some(found) if found < VERSION => return Err(CheckpointError::Older { found }),
        Some(_) => {}
    }
    let length =
        text[line_end..].windows(2).position(|two| two == b"\n\n").ok_or(CheckpointError::Damaged)?;
    let header = text.get(line_end + 1..line_end + length).unwrap_or_default();
    let header = std::str::from_utf8(header).map_err(|_| CheckpointError::Damaged)?;
    Ok((header, line_end + length + 2))
}

/// Hands files to the disk that were written without that, so that a power cut cannot take them any more; and their
/// folder.
///
/// # Errors
/// One of them cannot be opened or synced.
pub fn sync(files: &[impl AsRef<Path>]) -> Result<(), IoError> {
    for path in files {
        let path = path.as_ref();
        match File::open(path).and_then(|file| file.sync_all()) {
            // Whoever takes files of a run away while it goes on knows it.
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(IoError::system("write", path, error));
            }
            _ => {}
        }
    }
    let Some(first) = files.first().map(AsRef::as_ref) else { return Ok(()) };
    sync_folder(first).map_err(|source| IoError::system("write", first, source))
}

/// Writes a text file whole, as [`write()`] does, without a checksum.
///
/// # Errors
/// It cannot be written; an older file of this name is then as it was.
pub fn write_text(path: &Path, text: &str) -> Result<(), IoError> {
    file::replace(path, |out| out.write_all(text.as_bytes()))
}

/// Counts and hashes all bytes on their way, and remembers why the file refused some.
struct Hashed {
    inner: BufWriter<File>,
    hash: XxHash3_64,
    bytes: u64,
    failed: Option<io::Error>,
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.inner.write(bytes) {
            Ok(count) => {
                self.hash.write(&bytes[..count]);
                self.bytes += count as u64;
                Ok(count)
            }
            Err(error) => {
                let kind = error.kind();
                if kind != io::ErrorKind::Interrupted {
                    self.failed = Some(error);
                }
                Err(kind.into())
            }
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn save(path: &Path, previous: Option<&Path>, header: &str, contents: &[u8]) -> u64 {
        write(path, previous, header, |out| out.write_all(contents)).unwrap()
    }

    #[test]
    fn contents_come_back_and_the_two_last_files_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let [now, before] = ["now", "before"].map(|name| folder.path().join(name));
        let contents: Vec<u8> = (0..3_000_000_u32).map(|number| (number % 251) as u8).collect();
        for step in 1..=3 {
            let size = save(&now, Some(&before), &format!("step = {step}\n"), &contents[..step * 1_000_000]);
            assert_eq!(fs::metadata(&now).unwrap().len(), size);
            assert!(size < 100_000, "{size}: the contents repeat themselves");
        }
        assert_eq!(read(&now).unwrap(), ("step = 3".to_owned(), contents.clone()));
        assert_eq!(read(&before).unwrap(), ("step = 2".to_owned(), contents[..2_000_000].to_owned()));
        assert_eq!(read_header(&before).unwrap(), "step = 2");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "no temporary file stays");
        let text = String::from_utf8_lossy(&fs::read(&now).unwrap()).into_owned();
        assert!(text.starts_with("Pulvis checkpoint 6\nstep = 3\n\n"));
    }

    #[test]
    fn every_damaged_byte_and_every_cut_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c");
        save(&path, None, "step = 1", &[7; 300]);
        let sound = fs::read(&path).unwrap();
        for place in 0..sound.len() {
            let mut bytes = sound.clone();
            bytes[place] ^= 0x10;
            fs::write(&path, &bytes).unwrap();
            assert!(read(&path).is_err(), "byte {place}");
            fs::write(&path, &sound[..place]).unwrap();
            assert!(read(&path).is_err(), "cut after {place} bytes");
        }
        fs::write(&path, [&sound[..], b"x"].concat()).unwrap();
        assert!(matches!(read(&path), Err(CheckpointError::Damaged)));
    }

    #[test]
    fn what_is_no_checkpoint_and_what_is_newer_or_older_is_told_from_damage() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("c");
        for foreign in ["", "Pulvis", "title = \"a scenario\"\nseed = 3"] {
            fs::write(&path, foreign).unwrap();
            assert!(matches!(read(&path), Err(CheckpointError::Foreign)), "{foreign}");
        }
        fs::write(&path, format!("Pulvis checkpoint {}\nwhatever comes", VERSION + 1)).unwrap();
        assert!(matches!(read(&path), Err(CheckpointError::Newer { found }) if found == VERSION + 1));
        fs::write(&path, "Pulvis checkpoint 1\nwhatever came").unwrap();
        assert!(matches!(read(&path), Err(CheckpointError::Older { found: 1 })));
        fs::write(&path, "Pulvis checkpoint one\n\n").unwrap();
        assert!(matches!(read(&path), Err(CheckpointError::Damaged)));
        for missing in [folder.path().join("none"), folder.path().to_owned()] {
            assert!(matches!(read(&missing), Err(CheckpointError::Unreadable(_))));
        }
    }

    #[test]
    fn a_failed_write_keeps_both_files() {
        let folder = tempfile::tempdir().unwrap();
        let [now, before] = ["now", "before"].map(|name| folder.path().join(name));
        save(&now, Some(&before), "1", b"one");
        save(&now, Some(&before), "2", b"two");
        let failed = write(&now, Some(&before), "3", |_| Err(io::ErrorKind::StorageFull.into()));
        assert!(failed.unwrap_err().to_string().contains("free some space"));
        assert_eq!((read(&now).unwrap().1, read(&before).unwrap().1), (b"two".to_vec(), b"one".to_vec()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
