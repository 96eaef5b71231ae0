//! Level 1 of the house: how several threads share the work of a step.
//!
//! Nothing here knows physics. A [`ThreadPool`](thread_pool::ThreadPool) hands out work by number,
//! [`Shared`](shared::Shared) lets its workers write different parts of one slice, and a
//! [`HandOver`](hand_over::HandOver) finds out which worker finishes a chunk that several contribute to. The engine shares memory between threads
//! through these three only. Processes that share no memory work together through an
//! [`Exchange`](exchange::Exchange).
//!
//! `cargo xtask loom` tests the pool and the hand-over in every order of their operations (up to a number of switches
//! between threads), `cargo xtask miri` looks for undefined behaviour.
//!
//! ```
//! use pulvis_parallel::thread_pool::ThreadPool;
//!
//! let pool = ThreadPool::of(2)?;
//! let mut squares = vec![0; 100];
//! pool.for_each(&mut squares, |index, square| *square = index * index);
//! assert_eq!(squares[9], 81);
//! # Ok::<(), std::io::Error>(())
//! ```

pub mod exchange;
pub mod hand_over;
pub mod shared;
mod sync;
pub mod thread_pool;

#[cfg(all(test, loom))]
mod loom_tests;
