//! Work on several threads.

/// Threads of one question.
const THREADS: usize = 4;

/// What `one` makes of each of the items, which do not depend on each other; `None` where it panicked.
pub(super) fn in_parallel<T: Sync, R: Send>(items: &[T], one: impl Fn(&T) -> R + Sync) -> Vec<Option<R>> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(THREADS);
    // Each takes every so-manieth: slow ones lie side by side.
    let share = |thread: usize| items.iter().skip(thread).step_by(threads).map(&one).collect::<Vec<R>>();
    let shares: Vec<Vec<R>> = std::thread::scope(|scope| {
        let share = &share;
        let workers: Vec<_> = (0..threads).map(|thread| scope.spawn(move || share(thread))).collect();
        workers.into_iter().map(|worker| worker.join().unwrap_or_default()).collect()
    });
    let mut shares: Vec<_> = shares.into_iter().map(Vec::into_iter).collect();
    (0..items.len()).map(|number| shares[number % threads].next()).collect()
}

#[cfg(test)]
mod tests {
    use super::in_parallel;

    #[test]
    fn the_order_is_kept() {
        for count in [0, 1, 3, 17] {
            let items: Vec<usize> = (0..count).collect();
            let squares: Vec<Option<usize>> = items.iter().map(|item| Some(item * item)).collect();
            assert_eq!(in_parallel(&items, |item| item * item), squares);
        }
    }
}
