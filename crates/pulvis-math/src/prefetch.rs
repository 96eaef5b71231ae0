//! Telling the processor what will be needed soon.

/// Asks for the cache line that holds `item` to be brought into the second-level cache. Does nothing on
/// processors other than x86-64.
#[inline(always)]
pub fn prefetch<T>(item: *const T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        // SAFETY: a hint, whatever the address: it reads nothing and never faults.
        unsafe { _mm_prefetch::<_MM_HINT_T1>(item.cast()) }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = item;
}
