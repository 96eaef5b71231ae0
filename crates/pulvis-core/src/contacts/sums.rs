//! Where a worker adds up forces and torques.

use crate::particles::ForceTorque;

/// Two buffers of a worker: sums of forces and torques for the present chunk, and for the next one.
///
/// The next buffer is zeroed in small parts while the present chunk is computed. Zeroing it all at once would wait for
/// the caches.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    present: Vec<ForceTorque>,
    next: Vec<ForceTorque>,
    /// Entries of `next` that are known to be zero.
    next_zeroed: usize,
}

/// The buffers while a chunk is computed.
pub(super) struct ChunkSums<'a> {
    /// The sums of this chunk, initially zero.
    pub(super) sums: &'a mut [ForceTorque],
    /// The sums of the next chunk; the pass over this chunk may zero them.
    pub(super) next: &'a mut [ForceTorque],
    /// Set this to the number of entries of `next` that have been zeroed.
    pub(super) next_zeroed: &'a mut usize,
}

impl Sums {
    /// Swaps the buffers: what was `next` becomes the `count` sums of this chunk, of which only the part that is not yet
    /// zero is filled. `next_count` is how many sums the next chunk is likely to need.
    pub(super) fn of_chunk(&mut self, count: usize, next_count: usize) -> ChunkSums<'_> {
        std::mem::swap(&mut self.present, &mut self.next);
        let zeroed = std::mem::take(&mut self.next_zeroed).min(count);
        for (buffer, count) in [(&mut self.present, count), (&mut self.next, next_count)] {
            if buffer.len() < count {
                buffer.resize(count, ForceTorque::default());
            }
        }
        let sums = &mut self.present[..count];
        sums[zeroed..].fill(ForceTorque::default());
        ChunkSums { sums, next: &mut self.next[..next_count], next_zeroed: &mut self.next_zeroed }
    }

    /// Memory [byte].
    pub(super) fn memory_size(&self) -> usize {
        size_of_val(&self.present[..]) + size_of_val(&self.next[..])
    }
}

#[cfg(test)]
mod tests {
    use pulvis_math::Packed4;

    use super::*;

    fn all_zero(sums: &[ForceTorque]) -> bool {
        sums.iter().all(|sum| sum.force == Packed4::default() && sum.torque == Packed4::default())
    }

    #[test]
    fn sums_begin_at_zero_even_if_the_chunk_before_was_given_up() {
        let mut sums = Sums::default();
        let mut one = ForceTorque::default();
        one.force.scalar = 1.0;
        for _ in 0..3 {
            // The next chunk's sums are touched but not reported as zeroed, as by a panic on the way.
            let ChunkSums { sums: present, next, .. } = sums.of_chunk(4, 5);
            assert!(all_zero(present));
            present.fill(one);
            next.fill(one);
        }
        let ChunkSums { next, next_zeroed, .. } = sums.of_chunk(4, 5);
        next[..3].fill(ForceTorque::default());
        *next_zeroed = 3;
        assert!(all_zero(sums.of_chunk(5, 0).sums));
    }
}
