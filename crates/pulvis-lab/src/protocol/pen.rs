//! Frames are written beside the computation: a thread for each of them, one after the other for each series.

use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};

use pulvis_io::IoError;
use pulvis_io::frames::{Bounds, FramePosition, FrameWriter, Instant};
use pulvis_io::vtk::Frame;

/// An instant with all that it is made of.
#[derive(Debug)]
pub(super) struct Page {
    pub(super) time: f64,
    pub(super) step: u64,
    pub(super) bounds: Bounds,
    pub(super) materials: Arc<[String]>,
    pub(super) frame: Frame,
}

impl Page {
    fn instant(&self) -> Instant<'_> {
        let Self { time, step, bounds, materials, frame } = self;
        Instant { time: *time, step: *step, bounds: *bounds, materials, frame }
    }
}

/// A writer of frames, and the thread in which it is at work.
///
/// Whoever asks for its state waits for that thread: the files and their order are those of a writer without one. A pen that is
/// dropped has written what it was asked for.
#[derive(Debug)]
pub(super) struct Pen {
    writer: Arc<Mutex<Box<dyn FrameWriter>>>,
    growing: Vec<String>,
    at_work: Option<JoinHandle<Result<(), IoError>>>,
}

impl Pen {
    pub(super) fn new(writer: Box<dyn FrameWriter>) -> Self {
        let growing = writer.growing();
        Self { writer: Arc::new(Mutex::new(writer)), growing, at_work: None }
    }

    /// Names of the files that every instant changes; the same at all times.
    pub(super) fn growing(&self) -> &[String] {
        &self.growing
    }

    /// Waits for what is being written.
    ///
    /// # Errors
    /// A file could not be written.
    pub(super) fn settle(&mut self) -> Result<(), IoError> {
        match self.at_work.take().map(JoinHandle::join) {
            None => Ok(()),
            Some(Ok(written)) => written,
            Some(Err(panic)) => std::panic::resume_unwind(panic),
        }
    }

    /// Tells whether something went wrong, but waits for nothing.
    ///
    /// # Errors
    /// A file could not be written.
    pub(super) fn look(&mut self) -> Result<(), IoError> {
        match &self.at_work {
            Some(thread) if thread.is_finished() => self.settle(),
            _ => Ok(()),
        }
    }

    /// Names of the files that this page, the next one, will fill.
    pub(super) fn next_files(&self, page: &Page) -> Vec<String> {
        lock(&self.writer).next_files(&page.instant())
    }

    /// Writes a page, beside what follows; waits for the one before.
    ///
    /// # Errors
    /// A file of the page before could not be written, or there is no thread for this one.
    pub(super) fn write(&mut self, page: Page) -> Result<(), IoError> {
        self.settle()?;
        let writer = Arc::clone(&self.writer);
        let write = move || lock(&writer).write(&page.instant());
        let thread = thread::Builder::new().name("frames".to_owned()).spawn(write);
        let refused = |source: io::Error| IoError::System {
            action: "start the thread that writes",
            path: self.growing.first().map(Into::into).unwrap_or_default(),
            source,
        };
        self.at_work = Some(thread.map_err(refused)?);
        Ok(())
    }

    /// How far the writer has come, with all that it was asked for.
    ///
    /// # Errors
    /// A file could not be written.
    pub(super) fn position(&mut self) -> Result<FramePosition, IoError> {
        self.settle()?;
        lock(&self.writer).position()
    }
}

impl Drop for Pen {
    fn drop(&mut self) {
        if let Some(thread) = self.at_work.take() {
            // Nobody is left who could be told.
            let _ = thread.join();
        }
    }
}

/// A panic of the writer is passed on by [`Pen::settle`]; it leaves no lock behind that matters.
fn lock(writer: &Mutex<Box<dyn FrameWriter>>) -> MutexGuard<'_, Box<dyn FrameWriter>> {
    writer.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;
    use std::path::PathBuf;
    use std::sync::mpsc::{Receiver, channel};

    /// Writes when it is told to; from the third page on its disk is full.
    #[derive(Debug)]
    struct Slow {
        go: Receiver<()>,
        written: Arc<Mutex<Vec<u64>>>,
    }

    impl FrameWriter for Slow {
        fn next_files(&self, instant: &Instant<'_>) -> Vec<String> {
            vec![format!("{}", instant.step)]
        }

        fn growing(&self) -> Vec<String> {
            vec!["all".to_owned()]
        }

        fn write(&mut self, instant: &Instant<'_>) -> Result<(), IoError> {
            self.go.recv().unwrap();
            if instant.step > 2 {
                let source = io::Error::from(io::ErrorKind::StorageFull);
                return Err(IoError::System { action: "write", path: PathBuf::from("all"), source });
            }
            self.written.lock().unwrap().push(instant.step);
            Ok(())
        }

        fn position(&mut self) -> Result<FramePosition, IoError> {
            Ok(FramePosition { frames: self.written.lock().unwrap().len() as u64, files: Vec::new() })
        }
    }

    fn page(step: u64) -> Page {
        let (bounds, materials) = (Bounds::default(), Vec::new().into());
        Page { time: 0.0, step, bounds, materials, frame: Frame::default() }
    }

    #[test]
    fn pages_are_written_beside_in_their_order_and_errors_are_told_at_the_next_look() {
        let ((go, wait), written) = (channel(), Arc::new(Mutex::new(Vec::new())));
        let mut pen = Pen::new(Box::new(Slow { go: wait, written: Arc::clone(&written) }));
        assert_eq!(pen.next_files(&page(1)), ["1"]);
        pen.write(page(1)).unwrap();
        // It waits for a word; nobody waits for it.
        pen.look().unwrap();
        assert_eq!((pen.growing(), written.lock().unwrap().len()), (&["all".to_owned()][..], 0));
        go.send(()).unwrap();
        pen.write(page(2)).unwrap();
        assert_eq!(*written.lock().unwrap(), [1]);
        go.send(()).unwrap();
        assert_eq!(pen.position().unwrap().frames, 2);
        assert_eq!(*written.lock().unwrap(), [1, 2]);
        pen.write(page(3)).unwrap();
        go.send(()).unwrap();
        while !pen.at_work.as_ref().unwrap().is_finished() {
            thread::yield_now();
        }
        assert!(matches!(pen.look(), Err(IoError::System { action: "write", .. })));
        pen.look().unwrap();
        pen.write(page(4)).unwrap();
        go.send(()).unwrap();
        assert!(pen.write(page(5)).is_err());
        assert_eq!(*written.lock().unwrap(), [1, 2]);
    }

    #[test]
    fn a_pen_that_is_dropped_has_written_its_page() {
        let ((go, wait), written) = (channel(), Arc::new(Mutex::new(Vec::new())));
        let mut pen = Pen::new(Box::new(Slow { go: wait, written: Arc::clone(&written) }));
        pen.write(page(1)).unwrap();
        go.send(()).unwrap();
        drop(pen);
        assert_eq!(*written.lock().unwrap(), [1]);
    }
}
