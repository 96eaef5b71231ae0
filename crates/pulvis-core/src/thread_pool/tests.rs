#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use pulvis_math::elementary;

#[test]
fn every_item_is_worked_on_once_by_teams_of_any_size() {
    for threads in [1, 2, 3, 8] {
        let pool = ThreadPool::of(threads).unwrap();
        assert_eq!(pool.threads(), threads);
        let mut items = vec![0_usize; 1000];
        for round in 0..200 {
            pool.for_each(&mut items, |index, item| *item += index + round);
        }
        let expected = |index: usize| 200 * index + 199 * 100;
        assert!(items.iter().enumerate().all(|(index, &item)| item == expected(index)), "{threads}");
    }
}

#[test]
fn sums_and_orders_are_the_same_for_teams_of_any_size() {
    let rows = 3 * STRETCH + 17;
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
fn a_team_that_slept_wakes_up() {
    let pool = ThreadPool::of(2).unwrap();
    for _ in 0..3 {
        std::thread::sleep(std::time::Duration::from_millis(60));
        let mut items = [0; 16];
        pool.for_each(&mut items, |_, item| *item += 1);
        assert_eq!(items, [1; 16]);
    }
}

#[test]
fn members_that_wait_for_one_that_panics_are_told() {
    let pool = ThreadPool::of(3).unwrap();
    let done = AtomicUsize::new(0);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let work = |_, number| {
            assert!(number != 70, "number {number}");
            done.fetch_add(1, Ordering::Relaxed);
        };
        pool.for_each_number_in_turns(100, work, |_, turn| {
            while turn.is_last() && done.load(Ordering::Relaxed) < 100 && !turn.is_given_up() {
                std::hint::spin_loop();
            }
        });
    }));
    assert!(outcome.is_err());
}

#[test]
fn a_panic_of_any_member_reaches_the_leader() {
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
