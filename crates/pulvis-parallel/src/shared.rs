//! Memory that several threads work on at the same time, each in its own part.

use std::marker::PhantomData;
use std::ops::Range;

/// A slice whose parts are handed to different threads. Who takes a part must know that nobody else
/// writes it meanwhile.
///
/// Several threads may read one item, so that only items that may be shared can be in it:
///
/// ```
/// fn shared_with_threads<T: Sync>(_: T) {}
/// # use pulvis_parallel::shared::Shared;
/// shared_with_threads(Shared::new(&mut [1, 2]));
/// ```
/// ```compile_fail,E0277
/// fn shared_with_threads<T: Sync>(_: T) {}
/// # use pulvis_parallel::shared::Shared;
/// shared_with_threads(Shared::new(&mut [std::cell::Cell::new(1)]));
/// ```
#[derive(Debug)]
pub struct Shared<'a, T> {
    start: *mut T,
    length: usize,
    slice: PhantomData<&'a mut [T]>,
}

impl<T> Clone for Shared<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Shared<'_, T> {}

// SAFETY: hands out `&T` and `&mut T` on any thread, by functions whose callers vouch for their being no conflicts.
unsafe impl<T: Send + Sync> Send for Shared<'_, T> {}
// SAFETY: as above.
unsafe impl<T: Send + Sync> Sync for Shared<'_, T> {}

impl<'a, T> Shared<'a, T> {
    /// Shares a slice until it is used again by its owner.
    pub fn new(slice: &'a mut [T]) -> Self {
        Self { start: slice.as_mut_ptr(), length: slice.len(), slice: PhantomData }
    }

    /// Prefetches an item; any index is allowed.
    #[inline(always)]
    pub fn prefetch(&self, index: usize) {
        pulvis_math::prefetch(self.start.wrapping_add(index));
    }

    /// One item, for reading.
    ///
    /// # Safety
    /// `index` lies within the slice, and nobody writes the item while the reference lives.
    #[inline(always)]
    pub unsafe fn get(&self, index: usize) -> &'a T {
        debug_assert!(index < self.length);
        // SAFETY: the caller's.
        unsafe { &*self.start.add(index) }
    }

    /// One item, by the index of its first number: processors scale an index by the size of a number on
    /// the way, but not by that of a larger item.
    ///
    /// # Safety
    /// `number` is the index of an item within the slice, in numbers, and nobody writes the item while
    /// the reference lives.
    #[inline(always)]
    pub unsafe fn get_at_number(&self, number: u32) -> &'a T {
        debug_assert!(number as usize * size_of::<f64>() < self.length * size_of::<T>());
        // SAFETY: the caller's.
        unsafe { &*self.start.cast::<f64>().add(number as usize).cast::<T>() }
    }

    /// One item, for writing.
    ///
    /// # Safety
    /// `index` lies within the slice, and nobody else uses the item while the reference lives.
    #[inline(always)]
    pub unsafe fn get_mut(&self, index: usize) -> &'a mut T {
        debug_assert!(index < self.length);
        // SAFETY: the caller's.
        unsafe { &mut *self.start.add(index) }
    }

    /// One item, for writing, by the index of its first number as in
    /// [`get_at_number`](Self::get_at_number).
    ///
    /// # Safety
    /// As there, and nobody else uses the item while the reference lives.
    #[inline(always)]
    pub unsafe fn get_mut_at_number(&self, number: u32) -> &'a mut T {
        debug_assert!(number as usize * size_of::<f64>() < self.length * size_of::<T>());
        // SAFETY: the caller's.
        unsafe { &mut *self.start.cast::<f64>().add(number as usize).cast::<T>() }
    }

    /// A range of items, for writing.
    ///
    /// # Safety
    /// Nobody else uses these items while the reference lives.
    ///
    /// # Panics
    /// The range is not within the slice.
    #[inline]
    pub unsafe fn range_mut(&self, range: Range<usize>) -> &'a mut [T] {
        assert!(range.start <= range.end && range.end <= self.length);
        // SAFETY: within the slice; the rest is the caller's.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(range.start), range.len()) }
    }
}
