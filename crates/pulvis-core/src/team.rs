//! Who does the work: this thread, or several.

use std::sync::Arc;

use rayon::iter::{IntoParallelRefMutIterator, ParallelIterator};

/// One thread, or a pool of them. The results do not depend on how many there are: work is cut into
/// the same pieces for any number of threads, and sums are taken piece by piece in a fixed order.
#[derive(Clone, Debug, Default)]
pub enum Team {
    /// This thread alone.
    #[default]
    Alone,
    /// A pool of threads.
    Pool(Arc<rayon::ThreadPool>),
}

impl Team {
    /// A team of `threads` threads.
    ///
    /// # Errors
    /// The system cannot start that many threads.
    pub fn of(threads: usize) -> Result<Self, rayon::ThreadPoolBuildError> {
        if threads <= 1 {
            return Ok(Self::Alone);
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        Ok(Self::Pool(Arc::new(pool)))
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        match self {
            Self::Alone => 1,
            Self::Pool(pool) => pool.current_num_threads(),
        }
    }

    /// Runs `work` as a member of the team: many steps done within one call spare each step the way
    /// into the pool.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match self {
            Self::Alone => work(),
            Self::Pool(pool) => pool.install(work),
        }
    }

    /// Does `work` on every item.
    pub(crate) fn for_each<T: Send>(&self, items: &mut [T], work: impl Fn(&mut T) + Send + Sync) {
        match self {
            Self::Alone => items.iter_mut().for_each(work),
            Self::Pool(pool) => pool.install(|| items.par_iter_mut().for_each(work)),
        }
    }
}
