#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Barrier;
use std::sync::atomic::{AtomicUsize, Ordering};

use pulvis_math::elementary;

use super::*;

/// Interpreted by Miri, a round takes seconds.
const ROUNDS: usize = if cfg!(miri) { 4 } else { 200 };

#[test]
fn every_item_is_worked_on_once_by_pools_of_any_size() {
    for threads in [1, 2, 3, 8] {
        let pool = ThreadPool::of(threads).unwrap();
        assert_eq!(pool.threads(), threads);
        let mut items = vec![0_usize; 1000];
        for round in 0..ROUNDS {
            pool.for_each(&mut items, |index, item| *item += index + round);
        }
        let expected = |index: usize| ROUNDS * index + ROUNDS * (ROUNDS - 1) / 2;
        assert!(items.iter().enumerate().all(|(index, &item)| item == expected(index)), "{threads}");
    }
}

#[test]
fn sums_and_orders_are_the_same_for_pools_of_any_size() {
    let rows = 3 * ROWS + 17;
    let values: Vec<f64> = (0..rows).map(|row| elementary::sin(row as f64)).collect();
    let order: Vec<u32> = (0..rows as u32).rev().collect();
    let of = |threads: usize| {
        let pool = ThreadPool::of(threads).unwrap();
        let [sum] = pool.sum_over(rows, |rows| [values[rows].iter().sum()]);
        let (mut column, mut spare) = (values.clone(), Vec::new());
        pool.reorder(&mut column, &order, &mut spare);
        (sum.to_bits(), column)
    };
    let alone = of(1);
    assert!(alone.1.iter().eq(values.iter().rev()));
    for threads in [2, 3, 8] {
        assert!(of(threads) == alone, "{threads}");
    }
}

#[test]
fn a_pool_that_slept_wakes_up() {
    let pool = ThreadPool::of(2).unwrap();
    for _ in 0..3 {
        std::thread::sleep(std::time::Duration::from_millis(60));
        let mut items = [0; 16];
        pool.for_each(&mut items, |_, item| *item += 1);
        assert_eq!(items, [1; 16]);
    }
}

#[test]
fn workers_that_wait_for_one_that_panics_are_told() {
    let pool = ThreadPool::of(3).unwrap();
    let done = AtomicUsize::new(0);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let work = |_, number| {
            assert!(number != 70, "number {number}");
            done.fetch_add(1, Ordering::Relaxed);
        };
        pool.for_each_number_in_phases(100, work, |_, phase| {
            while phase.is_last() && done.load(Ordering::Relaxed) < 100 && !phase.is_given_up() {
                std::hint::spin_loop();
            }
        });
    }));
    assert!(outcome.is_err());
}

#[test]
fn a_panic_of_any_worker_reaches_the_leader() {
    let pool = ThreadPool::of(3).unwrap();
    for bad in [0, 50, 99] {
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            pool.for_each_number(100, |_, number| assert!(number != bad, "number {number}"));
        }));
        assert!(outcome.is_err());
    }
    let mut items = [0; 9];
    pool.for_each(&mut items, |_, item| *item = 1);
    assert_eq!(items, [1; 9]);
}

#[test]
fn a_panic_of_a_helper_is_not_raised_by_a_later_region() {
    let pool = ThreadPool::of(2).unwrap();
    // Leader and helper meet, so that both panic in the same region.
    let both = Barrier::new(2);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        pool.for_each_number(2, |worker, number| {
            both.wait();
            panic!("worker {worker} at {number}");
        });
    }));
    assert!(outcome.is_err());
    let mut items = [0; 9];
    pool.for_each(&mut items, |_, item| *item = 1);
    assert_eq!(items, [1; 9]);
}
