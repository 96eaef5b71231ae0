//! Independent tasks on several threads.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

/// Does `work` for the numbers of all tasks, in their order, by so many threads. This thread is told of each that is `done`,
/// in the order in which they end. Tasks that have not begun when `stop` is set are left out.
pub(crate) fn at_once<T: Send>(
    tasks: usize,
    threads: usize,
    stop: &AtomicBool,
    work: &(dyn Fn(usize) -> T + Sync),
    done: &mut dyn FnMut(usize, T),
) {
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..threads.clamp(1, tasks.max(1)) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while !stop.load(Ordering::Relaxed) {
                    let task = next.fetch_add(1, Ordering::Relaxed);
                    if task >= tasks {
                        break;
                    }
                    // Nobody listens any more only if the receiving side is gone, and then nothing matters.
                    let _ = sender.send((task, work(task)));
                }
            });
        }
        drop(sender);
        for (task, result) in receiver {
            done(task, result);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_is_done_once_by_any_number_of_threads_and_none_begins_after_the_stop() {
        for threads in [0, 1, 3, 20] {
            let stop = AtomicBool::new(false);
            let mut all = vec![0; 7];
            at_once(7, threads, &stop, &|task| 10 * task, &mut |task, result| {
                assert_eq!(result, 10 * task);
                all[task] += 1;
            });
            assert_eq!(all, [1; 7], "{threads} threads");
        }
        let stop = AtomicBool::new(false);
        let mut done = Vec::new();
        let work = |task: usize| stop.store(task == 2, Ordering::Relaxed);
        at_once(7, 1, &stop, &work, &mut |task, ()| done.push(task));
        assert_eq!(done, [0, 1, 2]);
    }
}
