//! Sequences of pictures in one file: animated PNG, which browsers play.

use super::Picture;
use crate::{IoError, file};
use png::{BitDepth, ColorType, Compression, Encoder, Writer};
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// An animated PNG file that is being written; it gets its name when it is complete.
pub struct Film {
    path: PathBuf,
    temporary: PathBuf,
    /// `None` once the file is complete.
    writer: Option<Writer<BufWriter<File>>>,
    size: [u32; 2],
}

impl Film {
    /// Begins a film of so many pictures of one size \[pixel\], shown at this rate \[1/s\] over and over.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(path: &Path, size: [u32; 2], pictures: u32, per_second: u16) -> Result<Self, IoError> {
        let temporary = file::temporary_name(path);
        let begin = || -> io::Result<_> {
            let out = BufWriter::with_capacity(1 << 16, File::create(&temporary)?);
            let mut encoder = Encoder::new(out, size[0], size[1]);
            encoder.set_color(ColorType::Rgb);
            encoder.set_depth(BitDepth::Eight);
            encoder.set_compression(Compression::Balanced);
            encoder.set_animated(pictures, 0).map_err(io::Error::other)?;
            encoder.set_frame_delay(1, per_second).map_err(io::Error::other)?;
            encoder.validate_sequence(true);
            encoder.write_header().map_err(io::Error::other)
        };
        let writer = begin().map_err(|source| {
            let _ = fs::remove_file(&temporary);
            IoError::system("write", path, source)
        })?;
        Ok(Self { path: path.to_owned(), temporary, writer: Some(writer), size })
    }

    /// Adds the next picture.
    ///
    /// # Errors
    /// A picture of another size, more pictures than were announced, or a file that cannot be written.
    pub fn add(&mut self, picture: &Picture) -> Result<(), IoError> {
        if picture.size() != self.size {
            let [[width, height], [found_width, found_height]] = [self.size, picture.size()];
            return Err(IoError::drawing(format!(
                "a picture of {found_width} x {found_height} pixels in a film of {width} x {height}"
            )));
        }
        let Some(writer) = &mut self.writer else { return Ok(()) };
        let written = writer.write_image_data(picture.pixels()).map_err(io::Error::other);
        written.map_err(|source| IoError::system("write", &self.path, source))
    }

    /// Completes the file.
    ///
    /// # Errors
    /// Fewer pictures than were announced, or a file that cannot be written.
    pub fn finish(mut self) -> Result<(), IoError> {
        let Some(writer) = self.writer.take() else { return Ok(()) };
        // Dropping the buffer would lose its error; the encoder hands everything on before it ends.
        let done = writer.finish().map_err(io::Error::other);
        let done = done.and_then(|()| fs::rename(&self.temporary, &self.path));
        done.map_err(|source| {
            let _ = fs::remove_file(&self.temporary);
            IoError::system("write", &self.path, source)
        })
    }
}

impl std::fmt::Debug for Film {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Film").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        if self.writer.take().is_some() {
            // A film that was given up.
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use crate::picture::{Scene, render};

    #[test]
    fn a_film_holds_its_pictures_in_their_order() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.apng");
        let pictures: Vec<Picture> = [0.2, 0.5, 1.0]
            .iter()
            .map(|&radius| {
                let (radii, limits) = ([radius], Some([[-1.0; 3], [1.0; 3]]));
                let scene =
                    Scene { width: 64, height: 64, limits, ..Scene::new(&[[0.0; 3]], &radii, &[0.0]) };
                render(&scene, 1).unwrap()
            })
            .collect();
        let mut film = Film::create(&path, [64, 64], 3, 10).unwrap();
        for picture in &pictures {
            film.add(picture).unwrap();
        }
        film.finish().unwrap();
        let mut reader =
            png::Decoder::new(io::BufReader::new(File::open(&path).unwrap())).read_info().unwrap();
        assert_eq!(reader.info().animation_control().unwrap().num_frames, 3);
        for picture in &pictures {
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            assert_eq!(reader.info().frame_control().unwrap().delay_den, 10);
            assert!(pixels == picture.pixels());
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
    }

    #[test]
    fn a_film_that_is_given_up_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.apng");
        let mut film = Film::create(&path, [64, 64], 2, 10).unwrap();
        let scene = Scene { width: 64, height: 64, ..Scene::new(&[], &[], &[]) };
        film.add(&render(&scene, 1).unwrap()).unwrap();
        assert!(film.add(&render(&Scene { width: 65, ..scene }, 1).unwrap()).is_err());
        drop(film);
        let short = Film::create(&path, [64, 64], 2, 10).unwrap();
        assert!(short.finish().is_err(), "two pictures were announced");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
