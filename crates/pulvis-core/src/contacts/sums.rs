//! Where a worker adds up forces and torques.

use crate::particles::ForceTorque;

/// Two buffers of a worker: one for the forces and torques of the present chunk, one for those of the next.
///
/// The next buffer is zeroed bit by bit while the present chunk is computed: all at once, the processor would wait for
/// its caches.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    present: Vec<ForceTorque>,
    next: Vec<ForceTorque>,
    /// Entries of `next` that are known to be zero.
    next_zeroed: usize,
}

/// The buffers while a chunk is computed.
pub(super) struct ChunkSums<'a> {
    /// The sums of this chunk, zero to begin with.
    pub(super) sums: &'a mut [ForceTorque],
    /// Those of the next chunk, which may be zeroed on the way.
    pub(super) next: &'a mut [ForceTorque],
    /// To be set to how many of `next` have been zeroed.
    pub(super) next_zeroed: &'a mut usize,
}

impl Sums {
    /// Exchanges the buffers: `count` sums for the present chunk, and for the next one as many as it is likely to need.
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
