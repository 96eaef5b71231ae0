//! Atomics, locks and threads: those of the standard library, or in tests of all orders those of loom.

#[cfg(not(loom))]
pub(crate) use std::sync::{Arc, Mutex, MutexGuard, atomic};
#[cfg(not(loom))]
pub(crate) use std::thread;

#[cfg(loom)]
pub(crate) use loom::cell::UnsafeCell;
#[cfg(loom)]
pub(crate) use loom::sync::{Arc, Mutex, MutexGuard, atomic};
#[cfg(loom)]
pub(crate) use loom::thread;

/// `std::cell::UnsafeCell` with the functions of loom's, which sees who uses it at the same time.
#[cfg(not(loom))]
#[derive(Debug)]
pub(crate) struct UnsafeCell<T>(std::cell::UnsafeCell<T>);

#[cfg(not(loom))]
impl<T> UnsafeCell<T> {
    pub(crate) fn new(value: T) -> Self {
        Self(std::cell::UnsafeCell::new(value))
    }

    /// For reading.
    pub(crate) fn with<A>(&self, read: impl FnOnce(*const T) -> A) -> A {
        read(self.0.get())
    }

    /// For writing.
    pub(crate) fn with_mut<A>(&self, write: impl FnOnce(*mut T) -> A) -> A {
        write(self.0.get())
    }
}

/// Rounds of waiting before a thread lets others have its processor, and before it sleeps: some microseconds, and some
/// ten milliseconds. Loom needs one of each kind at most.
pub(crate) const SPINS: u32 = if cfg!(loom) { 0 } else { 4_000 };
pub(crate) const YIELDS: u32 = if cfg!(loom) { 0 } else { 20_000 };

/// One round of waiting.
pub(crate) fn wait(rounds: &mut u32) {
    *rounds += 1;
    if *rounds < SPINS {
        std::hint::spin_loop();
    } else {
        thread::yield_now();
    }
}
