//! A set of rows that knows the rank of each of its rows.

/// Rows per word.
const WIDTH: u32 = u64::BITS;

/// A set of rows as bits, which counts how many of its rows come before a given one without a search.
#[derive(Clone, Debug, Default)]
pub(super) struct RowSet {
    words: Vec<Word>,
    /// The words that are not empty.
    filled: Vec<u32>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Word {
    rows: u64,
    /// Rows in the words before this one.
    before: u32,
}

impl RowSet {
    /// Empties the set and makes room for rows below `rows`.
    pub(super) fn begin(&mut self, rows: usize) {
        for word in self.filled.drain(..) {
            self.words[word as usize].rows = 0;
        }
        self.words.resize(rows.div_ceil(WIDTH as usize), Word::default());
    }

    #[inline(always)]
    pub(super) fn insert(&mut self, row: u32) {
        let word = &mut self.words[(row / WIDTH) as usize];
        if word.rows == 0 {
            self.filled.push(row / WIDTH);
        }
        word.rows |= 1 << (row % WIDTH);
    }

    /// Drops the rows before `first`, writes the others into `rows` in ascending order, and prepares
    /// [`slot`](Self::slot).
    pub(super) fn count_from(&mut self, first: u32, rows: &mut Vec<u32>) {
        rows.clear();
        self.filled.sort_unstable();
        for &number in &self.filled {
            let word = &mut self.words[number as usize];
            let dropped = first.saturating_sub(number * WIDTH);
            word.rows &= u64::MAX.checked_shl(dropped).unwrap_or(0);
            word.before = rows.len() as u32;
            let mut left = word.rows;
            while left != 0 {
                rows.push(number * WIDTH + left.trailing_zeros());
                left &= left - 1;
            }
        }
    }

    /// Number of rows of the set that come before `row`. `row` must be one of them; for a row that was inserted and
    /// dropped the result has no meaning.
    #[inline(always)]
    pub(super) fn slot(&self, row: u32) -> u32 {
        let word = &self.words[(row / WIDTH) as usize];
        word.before + (word.rows & ((1 << (row % WIDTH)) - 1)).count_ones()
    }

    /// Memory [byte].
    pub(super) fn memory_size(&self) -> usize {
        size_of_val(&self.words[..]) + size_of_val(&self.filled[..])
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn rows_come_in_ascending_order_and_know_their_places(
            sets in prop::collection::vec((prop::collection::vec(0..1000_u32, 0..200), 0..1000_u32), 1..4),
        ) {
            let mut set = RowSet::default();
            for (rows, first) in sets {
                set.begin(1000);
                rows.iter().for_each(|&row| set.insert(row));
                let mut listed = vec![7];
                set.count_from(first, &mut listed);
                let expected: BTreeSet<u32> = rows.into_iter().filter(|&row| row >= first).collect();
                prop_assert!(expected.iter().eq(&listed));
                for (slot, &row) in listed.iter().enumerate() {
                    prop_assert_eq!(set.slot(row), slot as u32);
                }
            }
        }
    }
}
