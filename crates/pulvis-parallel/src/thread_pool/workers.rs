//! The threads of a pool and how they come together for a region: work that all of them share.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::PoisonError;

use crate::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering, fence};
use crate::sync::thread::{self, JoinHandle};
use crate::sync::{Arc, Mutex, MutexGuard, SPINS, UnsafeCell, YIELDS, wait};

pub(super) type Job<'a> = dyn Fn(usize) + Sync + 'a;

/// A counter with a cache line of its own.
#[derive(Debug)]
#[repr(align(128))]
pub(super) struct Cursor(pub(super) AtomicUsize);

/// What the leader and its helpers share.
pub(super) struct SharedState {
    /// The number of the region, whether it is open, and how many helpers have joined it.
    state: AtomicU64,
    /// The work of the open region; valid for those who have joined until they are `done`.
    job: UnsafeCell<Option<*const Job<'static>>>,
    /// Helpers that have joined the present region and finished.
    done: AtomicU64,
    stop: AtomicBool,
    sleeping: Vec<AtomicBool>,
    /// The next number of every worker.
    pub(super) cursors: Vec<Cursor>,
    /// What a helper has panicked with in the present region.
    panic: Mutex<Option<Box<dyn Any + Send>>>,
    /// Whether any worker has panicked in the present region.
    pub(super) panicked: AtomicBool,
}

/// Parts of `state`: helpers in the lower half, then one bit, then the region.
const OPEN: u64 = 1 << 32;
const HELPERS: u64 = OPEN - 1;
const REGION: u64 = OPEN << 1;

// SAFETY: `job` is written by the leader only, before it opens a region (release) and after all who had
// joined the last one are done (acquire); helpers read it only between joining (acquire) and being done
// (release), and none can join a region that the leader has closed.
unsafe impl Sync for SharedState {}
// SAFETY: the pointer in `job` is to something that is `Sync`.
unsafe impl Send for SharedState {}

impl SharedState {
    fn of(threads: usize) -> Self {
        let sleeping = (0..threads).map(|_| AtomicBool::new(false)).collect();
        let cursors = (0..threads).map(|_| Cursor(AtomicUsize::new(0))).collect();
        Self {
            state: AtomicU64::new(0),
            job: UnsafeCell::new(None),
            done: AtomicU64::new(0),
            stop: AtomicBool::new(false),
            sleeping,
            cursors,
            panic: Mutex::new(None),
            panicked: AtomicBool::new(false),
        }
    }
}

impl std::fmt::Debug for SharedState {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("SharedState").finish_non_exhaustive()
    }
}

#[derive(Debug)]
pub(super) struct Workers {
    pub(super) shared: Arc<SharedState>,
    pub(super) helpers: Vec<JoinHandle<()>>,
    /// Held by the thread that leads a region: systems may share a pool.
    leader: Mutex<()>,
}

impl Workers {
    pub(super) fn start(threads: usize) -> std::io::Result<Self> {
        let shared = Arc::new(SharedState::of(threads));
        let mut workers = Self { shared, helpers: Vec::new(), leader: Mutex::new(()) };
        for worker in 1..threads {
            let shared = Arc::clone(&workers.shared);
            let builder = thread::Builder::new().name(format!("pulvis-{worker}"));
            // Should one fail, dropping the workers stops those that have started.
            workers.helpers.push(builder.spawn(move || help(&shared, worker))?);
        }
        Ok(workers)
    }

    pub(super) fn lead(&self) -> MutexGuard<'_, ()> {
        self.leader.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Calls `job` with the number of every worker that comes in time, on that worker's thread, this one
    /// first of all, and waits for those. Helpers that have not come when this thread has finished are not
    /// waited for: other programs may have taken their processors.
    pub(super) fn region(&self, _lead: &MutexGuard<'_, ()>, job: &Job<'_>) {
        let shared: &SharedState = &self.shared;
        // SAFETY: only the lifetime changes; no helper uses the job after it is done, for which this
        // function waits, also if its own share panics.
        let job_for_helpers: *const Job<'static> =
            unsafe { std::mem::transmute::<*const Job<'_>, *const Job<'static>>(&raw const *job) };
        // SAFETY: the last region is closed and all who joined it are done, see `Sync for SharedState`.
        shared.job.with_mut(|job| unsafe { *job = Some(job_for_helpers) });
        shared.done.store(0, Ordering::Relaxed);
        let region = shared.state.load(Ordering::Relaxed) / REGION + 1;
        shared.state.store(region * REGION + OPEN, Ordering::Release);
        // Either this thread sees below that a helper sleeps, or the helper sees the new region before it does.
        fence(Ordering::SeqCst);
        for (helper, sleeping) in self.helpers.iter().zip(&shared.sleeping[1..]) {
            if sleeping.load(Ordering::Relaxed) {
                helper.thread().unpark();
            }
        }
        let own = catch_unwind(AssertUnwindSafe(|| job(0)));
        if own.is_err() {
            shared.panicked.store(true, Ordering::Relaxed);
        }
        let joined = shared.state.fetch_and(!OPEN, Ordering::AcqRel) & HELPERS;
        let mut rounds = 0;
        while shared.done.load(Ordering::Acquire) != joined {
            wait(&mut rounds);
        }
        shared.panicked.store(false, Ordering::Relaxed);
        // Taken in any case: it belongs to this region and to no later one.
        let of_helper = shared.panic.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(panic) = own.err().or(of_helper) {
            resume_unwind(panic);
        }
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Relaxed);
        self.shared.state.fetch_add(REGION, Ordering::Release);
        for helper in self.helpers.drain(..) {
            helper.thread().unpark();
            // A helper catches what its work panics with; there is nothing to learn here.
            let _ = helper.join();
        }
    }
}

/// The life of a helper.
fn help(shared: &SharedState, worker: usize) {
    let mut seen = 0;
    loop {
        let mut rounds = 0;
        while shared.state.load(Ordering::Acquire) / REGION == seen {
            if rounds < SPINS + YIELDS {
                wait(&mut rounds);
                continue;
            }
            shared.sleeping[worker].store(true, Ordering::Relaxed);
            // Looked at once more: the leader may have begun a region without seeing the flag.
            fence(Ordering::SeqCst);
            if shared.state.load(Ordering::Acquire) / REGION == seen {
                thread::park();
            }
            shared.sleeping[worker].store(false, Ordering::Relaxed);
        }
        let (region, joined) = join(shared);
        seen = region;
        if !joined {
            // Asked after joining: the region that this helper comes too late for may be the one that says so.
            if shared.stop.load(Ordering::Relaxed) {
                return;
            }
            continue;
        }
        // SAFETY: this helper has joined and is not done, see `Sync for SharedState`.
        let job = shared.job.with(|job| unsafe { *job });
        // SAFETY: the leader keeps the job alive until this helper is done.
        let outcome = catch_unwind(AssertUnwindSafe(|| job.map(|job| unsafe { (*job)(worker) })));
        if let Err(panic) = outcome {
            shared.panicked.store(true, Ordering::Relaxed);
            *shared.panic.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic);
        }
        shared.done.fetch_add(1, Ordering::Release);
    }
}

/// Joins the present region. Answers with its number, and whether it was still open.
fn join(shared: &SharedState) -> (u64, bool) {
    let mut state = shared.state.load(Ordering::Acquire);
    while state & OPEN != 0 {
        let next = shared.state.compare_exchange_weak(state, state + 1, Ordering::AcqRel, Ordering::Acquire);
        match next {
            Ok(_) => return (state / REGION, true),
            Err(now) => state = now,
        }
    }
    (state / REGION, false)
}
