//! Several ranks that share the steps: threads, or processes that `mpirun` has started.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use pulvis_parallel::exchange::{Exchange, ExchangeError, Message, ThreadRank, Waiting};

use crate::failure::Failure;

/// An exchange that counts.
#[derive(Debug)]
pub(crate) struct Counted {
    inner: Arc<dyn Exchange>,
    /// Bytes of what this rank has sent to neighbours, and of what it has told all.
    swapped: AtomicU64,
    told: AtomicU64,
    /// Time within the exchange, with that of waiting for others [ns].
    nanoseconds: AtomicU64,
}

impl Counted {
    fn new(inner: Arc<dyn Exchange>) -> Arc<Self> {
        let zero = || AtomicU64::new(0);
        Arc::new(Self { inner, swapped: zero(), told: zero(), nanoseconds: zero() })
    }

    /// Begins to count anew.
    pub(crate) fn reset(&self) {
        for counter in [&self.swapped, &self.told, &self.nanoseconds] {
            counter.store(0, Ordering::Relaxed);
        }
    }

    /// What was counted in so many steps, in words.
    pub(crate) fn report(&self, steps: u64, rows: usize, wall: f64) -> String {
        let of = |counter: &AtomicU64| counter.load(Ordering::Relaxed) as f64;
        let per_step = |counter: &AtomicU64| of(counter) / steps.max(1) as f64;
        format!(
            "rank {} of {}: reads {rows} rows of others; sends {:.0} bytes to neighbours and tells {:.0} bytes to all in a step; {:.1} % of the time in the exchange",
            self.inner.rank(),
            self.inner.ranks(),
            per_step(&self.swapped),
            per_step(&self.told),
            1e-7 * of(&self.nanoseconds) / wall,
        )
    }

    fn timed<T>(&self, work: impl FnOnce() -> T) -> T {
        let began = Instant::now();
        let done = work();
        self.nanoseconds.fetch_add(began.elapsed().as_nanos() as u64, Ordering::Relaxed);
        done
    }
}

const NUMBER: usize = size_of::<f64>();

impl Exchange for Counted {
    fn rank(&self) -> usize {
        self.inner.rank()
    }

    fn ranks(&self) -> usize {
        self.inner.ranks()
    }

    fn swap(
        &self,
        outgoing: &[(usize, Message)],
        from: &[usize],
        incoming: &mut Vec<Message>,
        waiting: Waiting,
    ) -> Result<(), ExchangeError> {
        let numbers: usize = outgoing.iter().map(|(_, message)| message.len()).sum();
        self.swapped.fetch_add((numbers * NUMBER) as u64, Ordering::Relaxed);
        self.timed(|| self.inner.swap(outgoing, from, incoming, waiting))
    }

    fn gather(&self, own: &[f64], all: &mut Vec<Message>, waiting: Waiting) -> Result<(), ExchangeError> {
        self.told.fetch_add((own.len() * NUMBER) as u64, Ordering::Relaxed);
        self.timed(|| self.inner.gather(own, all, waiting))
    }
}

/// The ranks of this process: one that `mpirun` has started, or as many threads as asked for; none where it works alone.
pub(crate) fn exchanges(ranks: usize) -> Result<Vec<Arc<Counted>>, Failure> {
    #[cfg(feature = "mpi")]
    if let Some(exchange) = pulvis_mpi::exchange().map_err(Failure::Ranks)? {
        return Ok(vec![Counted::new(exchange)]);
    }
    if ranks < 2 {
        return Ok(Vec::new());
    }
    Ok(ThreadRank::team(ranks).into_iter().map(|rank| Counted::new(Arc::new(rank))).collect())
}

/// Leaves MPI.
pub(crate) fn finish() {
    #[cfg(feature = "mpi")]
    pulvis_mpi::finish();
}
