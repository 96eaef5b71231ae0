//! Sums over all chunks along a binary tree.
//!
//! A node of level n has the chunks from `index` 2ⁿ to (`index` + 1) 2ⁿ, and its sums are those of its two halves. The shape
//! depends on the numbers of the chunks only: whoever has a part of them, as a rank does, adds up the nodes that lie
//! within it, and where parts come together, in whatever order that happens, the same nodes come out with the same
//! bits. Of n chunks in a row, no more than 2 log₂ n nodes are left to be told.

use pulvis_math::max_or_nan;
use pulvis_parallel::exchange::{ExchangeError, Message};

use crate::ranks::message::Numbers;

/// Chunks that follow each other, added up as far as they are halves of one node.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChunkTree {
    /// How many numbers of a node are sums; of the others, the largest counts.
    sums: usize,
    /// How many numbers a node has.
    width: usize,
    nodes: Vec<Node>,
    /// Those of all nodes.
    numbers: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Node {
    level: u32,
    index: usize,
}

impl ChunkTree {
    /// Nothing, of nodes with so many sums and maxima.
    pub(crate) fn begin(&mut self, sums: usize, maxima: usize) {
        (self.sums, self.width) = (sums, sums + maxima);
        self.forget();
    }

    fn forget(&mut self) {
        self.nodes.clear();
        self.numbers.clear();
    }

    /// Adds the next chunk, whose numbers `write` appends.
    #[inline(always)]
    pub(crate) fn push(&mut self, chunk: usize, write: impl FnOnce(&mut Vec<f64>)) {
        write(&mut self.numbers);
        self.settle(Node { level: 0, index: chunk });
    }

    /// Takes in a node whose numbers stand at the end.
    fn settle(&mut self, node: Node) {
        self.nodes.push(node);
        debug_assert_eq!(self.numbers.len(), self.nodes.len() * self.width, "numbers of a node");
        while let [.., one, other] = self.nodes[..]
            && one.level == other.level
            && one.index.is_multiple_of(2)
            && other.index == one.index + 1
        {
            self.join(Node { level: one.level + 1, index: one.index / 2 });
        }
    }

    /// Joins the last two nodes.
    fn join(&mut self, node: Node) {
        self.nodes.truncate(self.nodes.len() - 2);
        self.nodes.push(node);
        let last = self.numbers.len() - self.width;
        let (lower, upper) = self.numbers.split_at_mut(last);
        let first = last - self.width;
        for (number, (one, &other)) in lower[first..].iter_mut().zip(upper.iter()).enumerate() {
            *one = if number < self.sums { *one + other } else { max_or_nan(*one, other) };
        }
        self.numbers.truncate(last);
    }

    /// Appends all nodes to a message.
    pub(crate) fn tell(&self, message: &mut Message) {
        for (node, numbers) in self.nodes.iter().zip(self.numbers.chunks_exact(self.width.max(1))) {
            message.extend([f64::from(node.level), node.index as f64]);
            message.extend_from_slice(numbers);
        }
    }

    /// Becomes what two messages tell of chunks that follow each other.
    ///
    /// # Errors
    /// A message is damaged.
    pub(crate) fn hear(&mut self, lower: &[f64], upper: &[f64]) -> Result<(), ExchangeError> {
        self.forget();
        for message in [lower, upper] {
            let mut numbers = Numbers::of(message);
            while !numbers.is_empty() {
                let (level, index) = (numbers.next_index()? as u32, numbers.next_index()?);
                self.numbers.extend_from_slice(numbers.take(self.width)?);
                self.settle(Node { level, index });
            }
        }
        Ok(())
    }

    /// The numbers of all chunks, first sums, then maxima; `None` if there is no chunk. What is no half of a node is added from
    /// the last node to the first.
    pub(crate) fn root(&mut self) -> Option<&[f64]> {
        while let [.., one, _] = self.nodes[..] {
            self.join(one);
        }
        (!self.nodes.is_empty()).then_some(&self.numbers[..])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// Numbers whose sum depends on the order in which they are added.
    fn leaf(chunk: usize) -> [f64; 3] {
        let value = ((chunk * 7919 + 13) % 1009) as f64 / 7.0;
        [value * 1e3, 1.0 / (value + 0.1), -value]
    }

    fn tree(chunks: std::ops::Range<usize>) -> ChunkTree {
        let mut tree = ChunkTree::default();
        tree.begin(2, 1);
        chunks.for_each(|chunk| tree.push(chunk, |numbers| numbers.extend(leaf(chunk))));
        tree
    }

    fn told(tree: &ChunkTree) -> Message {
        let mut message = Message::new();
        tree.tell(&mut message);
        message
    }

    #[test]
    fn a_sum_has_the_same_bits_however_its_chunks_are_shared_out_and_in_whatever_order_parts_come_together() {
        for chunks in [1, 2, 3, 8, 13, 100, 127] {
            let whole = tree(0..chunks).root().unwrap().to_vec();
            let exact: f64 = (0..chunks).map(|chunk| leaf(chunk)[0]).sum();
            assert!((whole[0] / exact - 1.0).abs() < 1e-14, "{} for {exact}", whole[0]);
            let largest = (0..chunks).map(|chunk| leaf(chunk)[2]).fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(whole[2], largest);
            for (first, second) in [(0, chunks), (chunks / 3, chunks / 2), (chunks / 2, chunks - 1), (1, 1)] {
                let parts = [0..first, first..second.max(first), second.max(first)..chunks];
                let [one, two, three] = parts.map(|part| told(&tree(part)));
                let mut joined = tree(0..0);
                // The lower two first, and the upper two first.
                joined.hear(&one, &two).unwrap();
                let lower = told(&joined);
                joined.hear(&lower, &three).unwrap();
                assert_eq!(joined.root().unwrap(), whole);
                joined.hear(&two, &three).unwrap();
                let upper = told(&joined);
                joined.hear(&one, &upper).unwrap();
                assert_eq!(joined.root().unwrap(), whole);
            }
        }
    }

    #[test]
    fn few_nodes_are_told_of_many_chunks_and_none_of_none() {
        let part = tree(12_345..98_765);
        assert!(part.nodes.len() <= 2 * 17, "{} nodes", part.nodes.len());
        assert_eq!(tree(3..3).root(), None);
    }

    #[test]
    fn a_number_that_is_none_is_not_lost() {
        let mut tree = tree(0..0);
        for chunk in 0..5 {
            let bad = if chunk == 2 { f64::NAN } else { 1.0 };
            tree.push(chunk, |numbers| numbers.extend([1.0, bad, bad]));
        }
        let root = tree.root().unwrap();
        assert!(root[0] == 5.0 && root[1].is_nan() && root[2].is_nan(), "{root:?}");
    }

    #[test]
    fn a_damaged_message_is_refused() {
        let message = told(&tree(0..3));
        assert!(tree(0..0).hear(&message[..message.len() - 1], &[]).is_err());
    }
}
