//! How cells are shared out among ranks, and what that makes each of them read of others.

use clap::ValueEnum;

/// Blocks have eight cells along each edge, like those of the engine.
const BLOCK: usize = 8;

/// The order in which blocks of cells are shared out; within blocks it does not matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Order {
    /// Line by line, layer by layer: the order of the engine.
    Lines,
    /// Along the curve of Morton.
    Morton,
    /// Along the curve of Hilbert.
    Hilbert,
    /// No order: the body is halved along its longest edge again and again.
    Bisection,
}

/// What a rank reads of another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reading {
    pub(crate) reader: usize,
    pub(crate) owner: usize,
    pub(crate) cells: usize,
}

/// The ranks of the cells of a cube with this many cells along each edge, a multiple of 16 and, but for lines and bisection, a
/// power of two.
pub(crate) fn ranks_of_cells(order: Order, edge: usize, ranks: usize) -> Vec<u32> {
    if order == Order::Bisection {
        let mut owners = vec![0; edge * edge * edge];
        bisect([[0, edge]; 3], 0..ranks, edge, &mut owners);
        return owners;
    }
    let blocks = edge / BLOCK;
    let bits = blocks.ilog2();
    let place = |block: [usize; 3]| match order {
        Order::Morton => morton(block, bits),
        Order::Hilbert => hilbert(block, bits),
        Order::Lines | Order::Bisection => (block[2] * blocks + block[1]) * blocks + block[0],
    };
    // Cells follow each other block by block: borders may lie within a block, where cells are in Morton order.
    let (in_block, cells) = (BLOCK * BLOCK * BLOCK, edge * edge * edge);
    let owner = |cell: [usize; 3]| {
        let number = place(cell.map(|c| c / BLOCK)) * in_block + morton(cell.map(|c| c % BLOCK), 3);
        (number * ranks / cells) as u32
    };
    each_cell(edge).map(owner).collect()
}

fn each_cell(edge: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..edge).flat_map(move |z| (0..edge).flat_map(move |y| (0..edge).map(move |x| [x, y, z])))
}

/// Gives a cuboid of cells to some ranks, in proportion.
fn bisect(body: [[usize; 2]; 3], ranks: std::ops::Range<usize>, edge: usize, owners: &mut [u32]) {
    if ranks.len() < 2 {
        let [xs, ys, zs] = body.map(|[from, to]| from..to);
        for z in zs {
            for y in ys.clone() {
                xs.clone().for_each(|x| owners[(z * edge + y) * edge + x] = ranks.start as u32);
            }
        }
        return;
    }
    let lengths = body.map(|[from, to]| to - from);
    let axis = (0..3).fold(0, |longest, axis| if lengths[axis] > lengths[longest] { axis } else { longest });
    let middle = ranks.start + ranks.len() / 2;
    let share = (lengths[axis] * (ranks.len() / 2)).div_ceil(ranks.len());
    let (mut lower, mut upper) = (body, body);
    lower[axis][1] = body[axis][0] + share;
    upper[axis][0] = lower[axis][1];
    bisect(lower, ranks.start..middle, edge, owners);
    bisect(upper, middle..ranks.end, edge, owners);
}

/// The bits of three coordinates in turn, those of the last one highest.
fn morton(coordinates: [usize; 3], bits: u32) -> usize {
    (0..bits).fold(0, |number, bit| {
        let part = (0..3).map(|axis| (coordinates[axis] >> bit & 1) << axis).sum::<usize>();
        number | part << (3 * bit)
    })
}

/// The place on the curve of Hilbert, by the transpose of Skilling (2004), AIP Conference Proceedings 707, 381-387.
fn hilbert(coordinates: [usize; 3], bits: u32) -> usize {
    let mut x = coordinates;
    for bit in (1..bits).rev() {
        let (q, p) = (1 << bit, (1 << bit) - 1);
        for axis in 0..3 {
            if x[axis] & q != 0 {
                x[0] ^= p;
            } else {
                let change = (x[0] ^ x[axis]) & p;
                x[0] ^= change;
                x[axis] ^= change;
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let change =
        (1..bits).filter(|&bit| x[2] & 1 << bit != 0).fold(0, |change, bit| change ^ ((1 << bit) - 1));
    // The first coordinate has the highest bits.
    let [first, second, third] = x.map(|coordinate| coordinate ^ change);
    morton([third, second, first], bits)
}

/// Who reads how many cells of whom: cells that touch one of the reader's, of ranks with higher numbers, whose contacts with the
/// reader's are the reader's to compute.
pub(crate) fn readings(owners: &[u32], edge: usize) -> Vec<Reading> {
    let mut pairs = Vec::new();
    let mut readers = Vec::new();
    for (number, cell) in each_cell(edge).enumerate() {
        readers.clear();
        let around = cell.map(|c| c.saturating_sub(1)..(c + 2).min(edge));
        for z in around[2].clone() {
            for y in around[1].clone() {
                let line = (z * edge + y) * edge;
                let lower = around[0].clone().map(|x| owners[line + x]).filter(|&rank| rank < owners[number]);
                readers.extend(lower);
            }
        }
        readers.sort_unstable();
        readers.dedup();
        pairs.extend(readers.iter().map(|&reader| (reader, owners[number])));
    }
    pairs.sort_unstable();
    let of_a_pair = |pairs: &[(u32, u32)]| {
        let (reader, owner) = pairs[0];
        Reading { reader: reader as usize, owner: owner as usize, cells: pairs.len() }
    };
    pairs.chunk_by(|one, other| one == other).map(of_a_pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORDERS: [Order; 4] = [Order::Lines, Order::Morton, Order::Hilbert, Order::Bisection];

    #[test]
    fn every_rank_has_its_share_of_the_cells() {
        for order in ORDERS {
            for ranks in [1, 2, 8, 64] {
                let owners = ranks_of_cells(order, 32, ranks);
                let share = owners.len() / ranks;
                let fair =
                    (0..ranks as u32).all(|rank| owners.iter().filter(|&&one| one == rank).count() == share);
                assert!(fair, "{order:?} for {ranks} ranks");
            }
        }
    }

    #[test]
    fn the_curve_of_hilbert_goes_from_block_to_neighbouring_block_and_to_each_once() {
        for bits in 1..4 {
            let edge = 1 << bits;
            let mut blocks: Vec<_> = each_cell(edge).map(|block| (hilbert(block, bits), block)).collect();
            blocks.sort_unstable();
            assert!(blocks.iter().enumerate().all(|(place, (number, _))| place == *number), "{bits} bits");
            let far = blocks.windows(2).find(|pair| {
                let steps: usize = (0..3).map(|axis| pair[0].1[axis].abs_diff(pair[1].1[axis])).sum();
                steps != 1
            });
            assert_eq!(far, None);
        }
    }

    #[test]
    fn halves_read_one_layer_and_slabs_have_two_neighbours() {
        for order in ORDERS {
            let halves = readings(&ranks_of_cells(order, 16, 2), 16);
            assert_eq!(halves, [Reading { reader: 0, owner: 1, cells: 256 }], "{order:?}");
        }
        let slabs = readings(&ranks_of_cells(Order::Lines, 32, 4), 32);
        assert!(slabs.iter().all(|one| one.owner == one.reader + 1 && one.cells == 32 * 32), "{slabs:?}");
    }
}
