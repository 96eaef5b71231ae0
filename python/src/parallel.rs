//! Many independent pieces of work on all threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Instant;

use pyo3::prelude::*;

use crate::errors;
use crate::interrupt::PATIENCE;

/// Pieces that a thread takes at a time.
const CHUNK: usize = 16;

/// What came of a chunk that starts at an index.
type Chunk<T, E> = (usize, Vec<Result<T, E>>);

/// Does `work` for every index below `count`, on so many `threads` and without the interpreter lock. Results are in the
/// order of the indices, whatever the number of threads; of several errors the first counts, with its index. Ctrl-C ends it.
pub fn map<T: Send, E: Send>(
    py: Python<'_>,
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> Result<T, E> + Sync,
) -> PyResult<Result<Vec<T>, (usize, E)>> {
    let (next, end, stop) = (AtomicUsize::new(0), AtomicUsize::new(count), AtomicBool::new(false));
    let (sender, receiver) = channel::<Chunk<T, E>>();
    let worker = |sender: &Sender<Chunk<T, E>>| {
        loop {
            let start = next.fetch_add(CHUNK, Ordering::Relaxed);
            if start >= end.load(Ordering::Relaxed) || stop.load(Ordering::Relaxed) {
                return;
            }
            let mut results = Vec::with_capacity(CHUNK);
            for index in start..(start + CHUNK).min(count) {
                results.push(work(index));
                if results.last().is_some_and(Result::is_err) {
                    // Chunks are handed out in order: all that comes before is or will be done.
                    end.fetch_min(index, Ordering::Relaxed);
                    break;
                }
            }
            // The receiver lives longer than all senders.
            let _ = sender.send((start, results));
        }
    };
    let threads = threads.clamp(1, count.div_ceil(CHUNK).max(1));
    let outcome = py.detach(|| {
        let receiver = receiver;
        std::thread::scope(|scope| {
            let start = |sender: Sender<_>| {
                let worker = &worker;
                scope.spawn(move || catch_unwind(AssertUnwindSafe(|| worker(&sender))))
            };
            let handles: Vec<_> = (0..threads).map(|_| start(sender.clone())).collect();
            drop(sender);
            let (chunks, mut outcome) = collect(&receiver, &stop);
            for handle in handles {
                if let Err(payload) | Ok(Err(payload)) = handle.join() {
                    outcome = outcome.and(Err(errors::panicked(&*payload)));
                }
            }
            outcome.map(|()| chunks)
        })
    });
    let mut chunks = outcome?;
    py.check_signals()?;
    chunks.sort_unstable_by_key(|(start, _)| *start);
    let mut results = Vec::with_capacity(count);
    for (start, chunk) in chunks {
        for (index, result) in (start..).zip(chunk) {
            match result {
                Ok(result) => results.push(result),
                Err(error) => return Ok(Err((index, error))),
            }
        }
    }
    Ok(Ok(results))
}

/// All chunks until the last worker has gone; looks at Ctrl-C meanwhile.
fn collect<T, E>(receiver: &Receiver<Chunk<T, E>>, stop: &AtomicBool) -> (Vec<Chunk<T, E>>, PyResult<()>) {
    let (mut chunks, mut outcome) = (Vec::new(), Ok(()));
    let mut looked = Instant::now();
    loop {
        match receiver.recv_timeout(PATIENCE) {
            Ok(chunk) => chunks.push(chunk),
            Err(RecvTimeoutError::Disconnected) => return (chunks, outcome),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if outcome.is_ok() && looked.elapsed() >= PATIENCE {
            outcome = Python::attach(|py| py.check_signals());
            stop.store(outcome.is_err(), Ordering::Relaxed);
            looked = Instant::now();
        }
    }
}

/// As many threads as there are processors, or as are asked for.
pub fn threads(asked: Option<usize>) -> usize {
    asked.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get))
}
