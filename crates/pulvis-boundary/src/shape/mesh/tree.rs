//! A tree of bounding boxes: which triangles are near a point.
//!
//! Two questions are asked, both with a point. A library for them would bring some forty crates along, so the tree is ours.

use pulvis_math::Vector3;

/// Triangles of a leaf.
const LEAF: usize = 4;

/// Depth of the stack of a search. The tree is balanced: 2⁶⁴ triangles are more than there can be.
const DEPTH: usize = 64;

/// The tree; the first node is the root.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// Triangles in the order of the leaves.
    items: Vec<u32>,
}

/// The box of some triangles. The first part of an inner node follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    low: [f64; 3],
    high: [f64; 3],
    /// The second part of an inner node, the first item of a leaf.
    next: u32,
    /// Items of a leaf; zero for an inner node.
    count: u32,
}

impl Tree {
    pub(super) fn new(triangles: &[[Vector3; 3]]) -> Self {
        let mut tree = Self { nodes: Vec::new(), items: (0..triangles.len() as u32).collect() };
        let mut items = std::mem::take(&mut tree.items);
        tree.build(triangles, &mut items, 0);
        tree.items = items;
        tree
    }

    fn build(&mut self, triangles: &[[Vector3; 3]], items: &mut [u32], first: usize) {
        let index = self.nodes.len();
        let corners = items.iter().flat_map(|&item| triangles[item as usize]);
        let (low, high) = bounds(corners);
        let count = if items.len() <= LEAF { items.len() as u32 } else { 0 };
        self.nodes.push(Node { low, high, next: first as u32, count });
        if count > 0 {
            return;
        }
        let middle = |item: &u32, axis: usize| -> f64 {
            triangles[*item as usize].iter().map(|corner| corner[axis]).sum()
        };
        let widest =
            (0..3).max_by(|&one, &other| (high[one] - low[one]).total_cmp(&(high[other] - low[other])));
        let axis = widest.unwrap_or(0);
        items.sort_unstable_by(|one, other| {
            middle(one, axis).total_cmp(&middle(other, axis)).then(one.cmp(other))
        });
        let half = items.len() / 2;
        let (left, right) = items.split_at_mut(half);
        self.build(triangles, left, first);
        self.nodes[index].next = self.nodes.len() as u32;
        self.build(triangles, right, first + half);
    }

    /// Calls `test` with the triangles whose boxes are within `limit` [m] of the point until it answers with true.
    pub(super) fn any_within(&self, point: Vector3, limit: f64, mut test: impl FnMut(usize) -> bool) -> bool {
        let mut stack = [0_usize; DEPTH];
        let mut left = usize::from(!self.nodes.is_empty());
        while left > 0 {
            left -= 1;
            let index = stack[left];
            let node = &self.nodes[index];
            // Not `>`: a point that is NaN is near nothing.
            let is_near = node.distance_squared(point) <= limit * limit;
            if !is_near {
                continue;
            }
            let next = node.next as usize;
            if node.count == 0 {
                (stack[left], stack[left + 1]) = (next, index + 1);
                left += 2;
            } else if self.items[next..next + node.count as usize].iter().any(|&item| test(item as usize)) {
                return true;
            }
        }
        false
    }

    /// The least of what `distance` answers for a triangle: its distance from the point [m].
    pub(super) fn nearest(&self, point: Vector3, mut distance: impl FnMut(usize) -> f64) -> f64 {
        let mut least = f64::INFINITY;
        let mut stack = [(0_usize, 0.0_f64); DEPTH];
        let mut left = usize::from(!self.nodes.is_empty());
        while left > 0 {
            left -= 1;
            let (index, apart) = stack[left];
            if apart > least * least {
                continue;
            }
            let node = &self.nodes[index];
            let next = node.next as usize;
            if node.count > 0 {
                let items = &self.items[next..next + node.count as usize];
                least = items.iter().fold(least, |least, &item| least.min(distance(item as usize)));
                continue;
            }
            // The nearer part comes off the stack first.
            let mut parts = [index + 1, next].map(|part| (part, self.nodes[part].distance_squared(point)));
            if parts[0].1 < parts[1].1 {
                parts.swap(0, 1);
            }
            stack[left..left + 2].copy_from_slice(&parts);
            left += 2;
        }
        least
    }
}

impl Node {
    fn distance_squared(&self, point: Vector3) -> f64 {
        (0..3)
            .map(|axis| {
                let beyond = (self.low[axis] - point[axis]).max(point[axis] - self.high[axis]).max(0.0);
                beyond * beyond
            })
            .sum()
    }
}

/// The box around some points: lower and upper corner [m].
pub(super) fn bounds(points: impl Iterator<Item = Vector3>) -> ([f64; 3], [f64; 3]) {
    points.fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(low, high), point| {
        (
            std::array::from_fn(|axis| low[axis].min(point[axis])),
            std::array::from_fn(|axis| high[axis].max(point[axis])),
        )
    })
}
