//! Who does the work: this thread, or several.

use std::any::Any;
use std::cell::UnsafeCell;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{JoinHandle, Thread};

use crate::shared::Shared;

/// One thread, or several that stay ready between the regions of a step.
///
/// A step of a small system lasts some ten microseconds: threads that sleep between regions would be
/// woken for as long as they work. These angular velocity, and sleep only when nothing has come for a while.
/// The results do not depend on how many there are: work is cut into the same chunks for any number of
/// threads, and sums are taken chunk by chunk in a fixed order.
#[derive(Clone, Debug, Default)]
pub struct ThreadPool {
    workers: Option<Arc<Workers>>,
}

impl ThreadPool {
    /// A pool of `threads` threads, this one among them.
    ///
    /// # Errors
    /// The system cannot start that many threads.
    pub fn of(threads: usize) -> std::io::Result<Self> {
        if threads <= 1 {
            return Ok(Self::default());
        }
        Ok(Self { workers: Some(Arc::new(Workers::start(threads)?)) })
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.workers.as_ref().map_or(1, |workers| workers.helpers.len() + 1)
    }

    /// Does `work` for every number below `count`, each once, in an order that depends on the threads.
    /// `work` is told which worker of the pool does it, counted from zero.
    pub(crate) fn for_each_number(&self, count: usize, work: impl Fn(usize, usize) + Sync) {
        self.for_each_number_in_turns(count, work, |_, _| {});
    }

    /// The same; between its turns every worker calls `between`: when it has no number of its own left to
    /// begin with, and when nobody has any, though others may still be at their last ones.
    ///
    /// Every worker begins with numbers of its own, the same in every region, so that what it has in its
    /// caches is of use again; then it helps the others.
    pub(crate) fn for_each_number_in_turns(
        &self,
        count: usize,
        work: impl Fn(usize, usize) + Sync,
        between: impl Fn(usize, &Phase<'_>) + Sync,
    ) {
        let Some(workers) = &self.workers else {
            (0..count).for_each(|number| work(0, number));
            between(0, &Phase { last: true, panicked: None });
            return;
        };
        let threads = self.threads();
        let guard = workers.lead();
        for (worker, cursor) in workers.shared.cursors.iter().enumerate() {
            cursor.0.store(count * worker / threads, Ordering::Relaxed);
        }
        let cursors = &workers.shared.cursors;
        let panicked = Some(&workers.shared.panicked);
        workers.region(&guard, &|worker| {
            for turn in 0..threads {
                let owner = (worker + turn) % threads;
                let end = count * (owner + 1) / threads;
                loop {
                    let number = cursors[owner].0.fetch_add(1, Ordering::Relaxed);
                    if number >= end {
                        break;
                    }
                    work(worker, number);
                }
                if turn == 0 {
                    between(worker, &Phase { last: false, panicked });
                }
            }
            between(worker, &Phase { last: true, panicked });
        });
    }

    /// The sums of what `part` answers for stretches of all rows. The stretches do not depend on the
    /// threads and are summed in their order.
    pub(crate) fn sum_over<const SUMS: usize>(
        &self,
        rows: usize,
        part: impl Fn(Range<usize>) -> [f64; SUMS] + Sync,
    ) -> [f64; SUMS] {
        self.parts_over(rows, [0.0; SUMS], part).iter().fold([0.0; SUMS], |mut total, sums| {
            total.iter_mut().zip(sums).for_each(|(total, sum)| *total += sum);
            total
        })
    }

    /// The largest of what `part` answers for stretches of all rows, zero at least.
    pub(crate) fn largest_over(&self, rows: usize, part: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
        self.parts_over(rows, 0.0, part).into_iter().fold(0.0, f64::max)
    }

    fn parts_over<T: Copy + Send>(
        &self,
        rows: usize,
        none: T,
        part: impl Fn(Range<usize>) -> T + Sync,
    ) -> Vec<T> {
        let mut parts = vec![none; rows.div_ceil(STRETCH)];
        self.for_each(&mut parts, |number, answer| *answer = part(stretch(number, rows)));
        parts
    }

    /// The column filled with the `value` of every row.
    pub(crate) fn fill<T: Copy + Default + Send + Sync>(
        &self,
        column: &mut Vec<T>,
        rows: usize,
        value: impl Fn(usize) -> T + Sync,
    ) {
        column.resize(rows, T::default());
        let column = Shared::new(column);
        self.for_each_number(rows.div_ceil(STRETCH), |_, number| {
            let rows = stretch(number, rows);
            // SAFETY: stretches have different rows.
            let part = unsafe { column.range_mut(rows.clone()) };
            for (slot, row) in part.iter_mut().zip(rows) {
                *slot = value(row);
            }
        });
    }

    /// The column in a new order: row k becomes what was row `order[k]`. `spare` is exchanged for it.
    pub(crate) fn reorder<T: Copy + Default + Send + Sync>(
        &self,
        column: &mut Vec<T>,
        order: &[u32],
        spare: &mut Vec<T>,
    ) {
        spare.resize(order.len(), T::default());
        let (from, to) = (&column[..], Shared::new(spare));
        self.for_each_number(order.len().div_ceil(STRETCH), |_, number| {
            let rows = stretch(number, order.len());
            // SAFETY: stretches have different rows.
            let to = unsafe { to.range_mut(rows.clone()) };
            for (slot, &row) in to.iter_mut().zip(&order[rows]) {
                *slot = from[row as usize];
            }
        });
        std::mem::swap(column, spare);
    }

    /// Does `work` on every item, with its index.
    pub(crate) fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
        let count = items.len();
        let items = Shared::new(items);
        // SAFETY: every number is handed out once.
        self.for_each_number(count, |_, number| work(number, unsafe { items.get_mut(number) }));
    }
}

/// Where a worker of the pool stands in a region.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase<'a> {
    last: bool,
    panicked: Option<&'a AtomicBool>,
}

impl Phase<'_> {
    /// Whether there is no number left to begin with.
    pub(crate) fn is_last(&self) -> bool {
        self.last
    }

    /// Whether another worker has panicked: it is of no use to wait for what it should have done.
    pub(crate) fn is_given_up(&self) -> bool {
        self.panicked.is_some_and(|panicked| panicked.load(Ordering::Relaxed))
    }
}

/// Rows that are summed or moved in one go.
const STRETCH: usize = 4096;

fn stretch(number: usize, rows: usize) -> Range<usize> {
    number * STRETCH..((number + 1) * STRETCH).min(rows)
}

type Job<'a> = dyn Fn(usize) + Sync + 'a;

/// Rounds of waiting before a thread lets others have its processor, and before it sleeps: some
/// microseconds, and some ten milliseconds.
const SPINS: u32 = 4_000;
const YIELDS: u32 = 20_000;

/// A counter with a cache line of its own.
#[derive(Debug, Default)]
#[repr(align(128))]
struct Cursor(AtomicUsize);

/// What the leader and its helpers share.
#[derive(Default)]
struct SharedState {
    /// The number of the region, whether it is open, and how many helpers have joined it.
    state: AtomicU64,
    /// The work of the open region; valid for those who have joined until they are `done`.
    job: UnsafeCell<Option<*const Job<'static>>>,
    /// Helpers that have joined the present region and finished.
    done: AtomicU64,
    stop: AtomicBool,
    sleeping: Vec<AtomicBool>,
    cursors: Vec<Cursor>,
    panic: Mutex<Option<Box<dyn Any + Send>>>,
    /// Whether any worker has panicked in the present region.
    panicked: AtomicBool,
}

/// Parts of the state of a shared_state: helpers in the lower half, then one bit, then the region.
const OPEN: u64 = 1 << 32;
const HELPERS: u64 = OPEN - 1;
const REGION: u64 = OPEN << 1;

// SAFETY: `job` is written by the leader only, before it opens a region (release) and after all who had
// joined the last one are done (acquire); helpers read it only between joining (acquire) and being done
// (release), and none can join a region that the leader has closed.
unsafe impl Sync for SharedState {}
// SAFETY: the pointer in `job` is to something that is `Sync`.
unsafe impl Send for SharedState {}

impl std::fmt::Debug for SharedState {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("SharedState").finish_non_exhaustive()
    }
}

#[derive(Debug)]
struct Workers {
    shared: Arc<SharedState>,
    helpers: Vec<JoinHandle<()>>,
    /// Held by the thread that leads a region: systems may share a pool.
    leader: Mutex<()>,
}

impl Workers {
    fn start(threads: usize) -> std::io::Result<Self> {
        let mut shared_state = SharedState::default();
        shared_state.sleeping.resize_with(threads, AtomicBool::default);
        shared_state.cursors.resize_with(threads, Cursor::default);
        let mut workers =
            Self { shared: Arc::new(shared_state), helpers: Vec::new(), leader: Mutex::new(()) };
        for worker in 1..threads {
            let shared_state = Arc::clone(&workers.shared);
            let name = format!("pulvis-{worker}");
            // Should one fail, dropping the workers stops those that have started.
            workers
                .helpers
                .push(std::thread::Builder::new().name(name).spawn(move || help(&shared_state, worker))?);
        }
        Ok(workers)
    }

    fn lead(&self) -> MutexGuard<'_, ()> {
        self.leader.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Calls `job` with the number of every worker that comes in time, on that worker's thread, this one
    /// first of all, and waits for those. Helpers that have not come when this thread has finished are not
    /// waited for: other programs may have taken their processors.
    fn region(&self, _lead: &MutexGuard<'_, ()>, job: &Job<'_>) {
        let shared_state = &*self.shared;
        // SAFETY: only the lifetime changes; no helper uses the job after it is done, for which this
        // function waits, also if its own share panics.
        let job_for_helpers: *const Job<'static> =
            unsafe { std::mem::transmute::<*const Job<'_>, *const Job<'static>>(&raw const *job) };
        // SAFETY: the last region is closed and all who joined it are done, see `Sync for SharedState`.
        unsafe { *shared_state.job.get() = Some(job_for_helpers) };
        shared_state.done.store(0, Ordering::Relaxed);
        let region = shared_state.state.load(Ordering::Relaxed) / REGION + 1;
        shared_state.state.store(region * REGION + OPEN, Ordering::SeqCst);
        for (helper, sleeping) in self.helpers.iter().zip(&shared_state.sleeping[1..]) {
            if sleeping.load(Ordering::SeqCst) {
                helper.thread().unpark();
            }
        }
        let own = catch_unwind(AssertUnwindSafe(|| job(0)));
        if own.is_err() {
            shared_state.panicked.store(true, Ordering::Relaxed);
        }
        let joined = shared_state.state.fetch_and(!OPEN, Ordering::AcqRel) & HELPERS;
        let mut rounds = 0;
        while shared_state.done.load(Ordering::Acquire) != joined {
            wait(&mut rounds);
        }
        shared_state.panicked.store(false, Ordering::Relaxed);
        if let Err(panic) = own {
            resume_unwind(panic);
        }
        let panic = shared_state.panic.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(panic) = panic {
            resume_unwind(panic);
        }
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::SeqCst);
        self.shared.state.fetch_add(REGION, Ordering::SeqCst);
        for helper in self.helpers.drain(..) {
            Thread::unpark(helper.thread());
            // A helper catches what its work panics with; there is nothing to learn here.
            let _ = helper.join();
        }
    }
}

/// One round of waiting.
pub(crate) fn wait(rounds: &mut u32) {
    *rounds += 1;
    if *rounds < SPINS {
        std::hint::spin_loop();
    } else {
        std::thread::yield_now();
    }
}

/// The life of a helper.
fn help(shared_state: &SharedState, worker: usize) {
    let mut seen = 0;
    loop {
        let mut rounds = 0;
        while shared_state.state.load(Ordering::Acquire) / REGION == seen {
            if rounds < SPINS + YIELDS {
                wait(&mut rounds);
                continue;
            }
            shared_state.sleeping[worker].store(true, Ordering::SeqCst);
            // Looked at once more: the leader may have begun a region without seeing the flag.
            if shared_state.state.load(Ordering::SeqCst) / REGION == seen {
                std::thread::park();
            }
            shared_state.sleeping[worker].store(false, Ordering::SeqCst);
        }
        if shared_state.stop.load(Ordering::SeqCst) {
            return;
        }
        let (region, joined) = join(shared_state);
        seen = region;
        if !joined {
            continue;
        }
        // SAFETY: this helper has joined and is not done, see `Sync for SharedState`; the leader keeps the job
        // alive until then.
        let outcome = catch_unwind(AssertUnwindSafe(|| unsafe {
            if let Some(job) = *shared_state.job.get() {
                (*job)(worker);
            }
        }));
        if let Err(panic) = outcome {
            shared_state.panicked.store(true, Ordering::Relaxed);
            *shared_state.panic.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic);
        }
        shared_state.done.fetch_add(1, Ordering::Release);
    }
}

/// Joins the present region. Answers with its number, and whether it was still open.
fn join(shared_state: &SharedState) -> (u64, bool) {
    let mut state = shared_state.state.load(Ordering::Acquire);
    while state & OPEN != 0 {
        let next =
            shared_state.state.compare_exchange_weak(state, state + 1, Ordering::AcqRel, Ordering::Acquire);
        match next {
            Ok(_) => return (state / REGION, true),
            Err(now) => state = now,
        }
    }
    (state / REGION, false)
}

#[cfg(test)]
mod tests;
