//! A pool of threads that share the work of parallel regions.

mod workers;

use std::ops::Range;

use crate::shared::Shared;
use crate::sync::Arc;
use crate::sync::atomic::{AtomicBool, Ordering};
use workers::Workers;

/// One thread, or several that stay ready between the regions of a step.
///
/// A step of a small system takes some ten microseconds, about as long as it takes to wake a sleeping thread. So the
/// threads of the pool wait actively, and sleep only after a longer pause. Results do not depend on the number of threads:
/// work is cut into the same chunks for any number, and sums are taken chunk by chunk in a fixed order.
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
    pub fn for_each_number(&self, count: usize, work: impl Fn(usize, usize) + Sync) {
        self.for_each_number_in_phases(count, work, |_, _| {});
    }

    /// The same; between its phases every worker calls `between`: when it has no number of its own left to
    /// begin with, and when nobody has any, though others may still be at their last ones.
    ///
    /// Every worker begins with numbers of its own, the same in every region, so that what it has in its
    /// caches is of use again; then it helps the others.
    pub fn for_each_number_in_phases(
        &self,
        count: usize,
        work: impl Fn(usize, usize) + Sync,
        between: impl Fn(usize, &Phase<'_>) + Sync,
    ) {
        let Some(workers) = &self.workers else {
            (0..count).for_each(|number| work(0, number));
            between(0, &Phase::alone());
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
            for round in 0..threads {
                let owner = (worker + round) % threads;
                let end = count * (owner + 1) / threads;
                loop {
                    let number = cursors[owner].0.fetch_add(1, Ordering::Relaxed);
                    if number >= end {
                        break;
                    }
                    work(worker, number);
                }
                if round == 0 {
                    between(worker, &Phase { last: false, panicked });
                }
            }
            between(worker, &Phase { last: true, panicked });
        });
    }

    /// The sums of what `part` answers for row ranges. The ranges do not depend on the
    /// threads and are summed in their order.
    pub fn sum_over<const SUMS: usize>(
        &self,
        rows: usize,
        part: impl Fn(Range<usize>) -> [f64; SUMS] + Sync,
    ) -> [f64; SUMS] {
        self.parts_over(rows, [0.0; SUMS], part).iter().fold([0.0; SUMS], |mut total, sums| {
            total.iter_mut().zip(sums).for_each(|(total, sum)| *total += sum);
            total
        })
    }

    /// The largest of what `part` answers for row ranges, zero at least.
    pub fn largest_over(&self, rows: usize, part: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
        self.parts_over(rows, 0.0, part).into_iter().fold(0.0, pulvis_math::max_or_nan)
    }

    fn parts_over<T: Copy + Send + Sync>(
        &self,
        rows: usize,
        none: T,
        part: impl Fn(Range<usize>) -> T + Sync,
    ) -> Vec<T> {
        let mut parts = vec![none; rows.div_ceil(ROWS)];
        self.for_each(&mut parts, |number, answer| *answer = part(row_range(number, rows)));
        parts
    }

    /// The column filled with the `value` of every row.
    pub fn fill<T: Copy + Default + Send + Sync>(
        &self,
        column: &mut Vec<T>,
        rows: usize,
        value: impl Fn(usize) -> T + Sync,
    ) {
        column.resize(rows, T::default());
        let column = Shared::new(column);
        self.for_each_number(rows.div_ceil(ROWS), |_, number| {
            let rows = row_range(number, rows);
            // SAFETY: the ranges have no common rows.
            let part = unsafe { column.range_mut(rows.clone()) };
            for (slot, row) in part.iter_mut().zip(rows) {
                *slot = value(row);
            }
        });
    }

    /// The column in a new order: row k becomes what was row `order[k]`. `spare` is exchanged for it.
    pub fn reorder<T: Copy + Default + Send + Sync>(
        &self,
        column: &mut Vec<T>,
        order: &[u32],
        spare: &mut Vec<T>,
    ) {
        spare.resize(order.len(), T::default());
        let (from, to) = (&column[..], Shared::new(spare));
        self.for_each_number(order.len().div_ceil(ROWS), |_, number| {
            let rows = row_range(number, order.len());
            // SAFETY: the ranges have no common rows.
            let to = unsafe { to.range_mut(rows.clone()) };
            for (slot, &row) in to.iter_mut().zip(&order[rows]) {
                *slot = from[row as usize];
            }
        });
        std::mem::swap(column, spare);
    }

    /// Does `work` on every item, with its index.
    pub fn for_each<T: Send + Sync>(&self, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
        let count = items.len();
        let items = Shared::new(items);
        // SAFETY: every number is handed out once.
        self.for_each_number(count, |_, number| work(number, unsafe { items.get_mut(number) }));
    }
}

/// Where a worker of the pool stands in a region.
#[derive(Clone, Copy, Debug)]
pub struct Phase<'a> {
    last: bool,
    panicked: Option<&'a AtomicBool>,
}

impl Phase<'_> {
    /// The first phase, in tests that have no pool.
    #[cfg(all(test, loom))]
    pub(crate) fn first() -> Self {
        Self { last: false, panicked: None }
    }

    /// The last phase of a thread that works without others.
    pub(crate) fn alone() -> Self {
        Self { last: true, panicked: None }
    }

    /// Whether there is no number left to begin with.
    pub fn is_last(&self) -> bool {
        self.last
    }

    /// Whether another worker has panicked: it is of no use to wait for what it should have done.
    pub fn is_given_up(&self) -> bool {
        self.panicked.is_some_and(|panicked| panicked.load(Ordering::Relaxed))
    }
}

/// Rows that are summed or moved in one go.
const ROWS: usize = 4096;

fn row_range(number: usize, rows: usize) -> Range<usize> {
    number * ROWS..((number + 1) * ROWS).min(rows)
}

#[cfg(all(test, not(loom)))]
mod tests;
