use std::collections::BTreeSet;

use proptest::prelude::*;
use pulvis_math::{Vector3, elementary};
use rand::RngExt;

use super::*;
use pulvis_packing::random_stream;

/// A grid and what was sorted into it, in the new order.
struct Sorted {
    grid: CellGrid,
    order: Vec<u32>,
    domain: Domain,
    positions: Vec<Packed4>,
    margin: f64,
}

impl Sorted {
    fn new(domain: Domain, spheres: &[(Vector3, f64)], margin: f64) -> Self {
        let packed = |&(position, radius): &(Vector3, f64)| Packed4::new(domain.wrapped(position), radius);
        let positions: Vec<Packed4> = spheres.iter().map(packed).collect();
        let (grid, order) = CellGrid::sort(&domain, &positions, margin);
        let positions = order.iter().map(|&row| positions[row as usize]).collect();
        Self { grid, domain, positions, order, margin }
    }

    fn pairs_of(&self, rows: std::ops::Range<u32>) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        self.grid.for_each_row_range_pair_of(rows, &self.positions, |RowRangePair { ones, others }| {
            for one in ones.0..ones.1 {
                pairs.extend((others.0.max(one + 1)..others.1).map(|other| (one, other)));
            }
        });
        pairs
    }

    fn pairs(&self) -> Vec<(u32, u32)> {
        self.pairs_of(0..self.positions.len() as u32)
    }

    fn is_near(&self, one: u32, other: u32) -> bool {
        let (i, j) = (one as usize, other as usize);
        let apart = self.domain.images().nearest(self.positions[i].vector - self.positions[j].vector).norm();
        apart < self.positions[i].scalar + self.positions[j].scalar + self.margin
    }

    fn near_pairs(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let all = (0..self.positions.len() as u32).flat_map(|other| (0..other).map(move |one| (one, other)));
        all.filter(|&(one, other)| self.is_near(one, other))
    }
}

/// Radii from the largest down to a `ratio`-th of it, as likely in every octave.
fn radius(largest: f64, ratio: f64, index: f64) -> f64 {
    largest * elementary::powf(ratio, -index)
}

fn point() -> impl Strategy<Value = (f64, f64, f64, f64)> {
    (0.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64, 0.0..=1.0_f64)
}

/// Uniformly distributed centres in a cube [m], with the radius of each [m].
fn scattered(count: usize, edge: f64, radius: f64) -> Vec<(Vector3, f64)> {
    let mut random = random_stream(7);
    let mut along = || random.random_range(0.0..edge);
    (0..count).map(|_| (Vector3::new(along(), along(), along()), radius)).collect()
}

proptest! {
    #[test]
    fn no_near_pair_is_missed_or_doubled(
        points in prop::collection::vec(point(), 1..150),
        largest in 0.005..0.2_f64,
        ratio in prop::sample::select(vec![1.0, 1.9, 10.0, 50.0]),
        margin in prop::sample::select(vec![0.0, 0.003, 0.05]),
        flattened in prop::sample::select(vec![1.0, 0.3, 0.0]),
        periodic in prop::array::uniform3(any::<bool>()),
        cuts in prop::array::uniform3(0.0..1.0_f64),
    ) {
        let lower = Vector3::new(-0.5, 3.0, -0.2);
        let domain = Domain::periodic(lower, lower + Vector3::new(1.0, 1.0, 1.0), periodic);
        let spheres: Vec<_> = points
            .iter()
            .map(|&(x, y, z, size)| {
                (lower + Vector3::new(x, y, z * flattened), radius(largest, ratio, size))
            })
            .collect();
        let sorted = Sorted::new(domain, &spheres, margin);
        let rows: BTreeSet<u32> = sorted.order.iter().copied().collect();
        prop_assert_eq!(rows.len(), spheres.len());

        let pairs = sorted.pairs();
        let found: BTreeSet<(u32, u32)> = pairs.iter().copied().collect();
        prop_assert_eq!(found.len(), pairs.len(), "a pair is doubled");
        prop_assert!(pairs.iter().all(|(one, other)| one < other));
        prop_assert!(sorted.near_pairs().all(|pair| found.contains(&pair)), "a pair is missed");

        let count = spheres.len() as f64;
        let mut ends = cuts.map(|cut| (cut * count) as u32).to_vec();
        ends.extend([0, spheres.len() as u32]);
        ends.sort_unstable();
        let mut parts: Vec<_> = ends.windows(2).flat_map(|ends| sorted.pairs_of(ends[0]..ends[1])).collect();
        // Row by row; the order of a row's partners stays.
        let mut pairs = pairs;
        parts.sort_by_key(|&(one, _)| one);
        pairs.sort_by_key(|&(one, _)| one);
        prop_assert_eq!(parts, pairs, "ranges find something else than the whole");
    }

    #[test]
    fn what_is_nowhere_does_no_harm(
        index in prop::sample::select(vec![f64::NAN, f64::INFINITY, 1e300, -1e300]),
        periodic in prop::array::uniform3(any::<bool>()),
    ) {
        let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 1.0, 1.0), periodic);
        let mut spheres = scattered(100, 1.0, 0.03);
        spheres[50] = (Vector3::new(0.5, index, 0.5), 0.003);
        let sorted = Sorted::new(domain, &spheres, 0.01);
        let found: BTreeSet<_> = sorted.pairs().into_iter().collect();
        prop_assert!(sorted.near_pairs().all(|pair| found.contains(&pair)));
    }
}

#[test]
fn rows_are_sorted_by_level_and_pairs_are_found_from_the_smaller_side() {
    let mut spheres = scattered(20, 1.0, 0.2);
    spheres.extend(scattered(200, 1.0, 0.01));
    spheres.extend(scattered(50, 1.0, 0.05));
    let sorted = Sorted::new(Domain::unbounded(), &spheres, 0.001);
    assert!(sorted.positions.is_sorted_by_key(|position| position.scalar));
    assert_eq!(sorted.grid.levels.len(), 3);
    assert!(sorted.pairs().iter().all(|&(one, other)| {
        sorted.positions[one as usize].scalar <= sorted.positions[other as usize].scalar
    }));
}

#[test]
fn a_narrow_distribution_has_one_level_and_no_particles_have_none() {
    let spheres: Vec<_> = scattered(100, 1.0, 0.02)
        .iter()
        .enumerate()
        .map(|(i, &(x, r))| (x, r * (1.0 + 0.009 * i as f64)))
        .collect();
    assert_eq!(Sorted::new(Domain::unbounded(), &spheres, 0.0).grid.levels.len(), 1);
    let none = Sorted::new(Domain::unbounded(), &[], 0.0);
    assert!(none.grid.levels.is_empty() && none.order.is_empty() && none.pairs().is_empty());
}

#[test]
fn points_in_one_place_are_all_near_each_other() {
    let sorted = Sorted::new(Domain::unbounded(), &[(Vector3::zero(), 0.0); 10], 0.0);
    assert_eq!(sorted.pairs().len(), 45);
}

#[test]
fn the_work_is_bounded_when_sizes_are_far_apart() {
    // Small spheres wherever no large one is.
    let large = scattered(6, 1.0, 0.25);
    let mut spheres = scattered(300_000, 1.0, 0.005);
    spheres.retain(|&(position, radius)| {
        large.iter().all(|&(other, largest)| (position - other).norm() > largest + radius)
    });
    assert!(spheres.len() > 100_000);
    spheres.extend(large);
    let sorted = Sorted::new(Domain::unbounded(), &spheres, 0.001);
    let pairs = sorted.pairs();
    let near = pairs.iter().filter(|&&(one, other)| sorted.is_near(one, other)).count();
    assert!(pairs.len() < 30 * near, "{} candidates for {near} near pairs", pairs.len());
}

#[test]
fn fragments_far_apart_do_not_blow_the_grid_up() {
    let far = Vector3::new(1e6, 1e6, 1e6);
    let spheres = [(Vector3::zero(), 0.5), (far, 0.5), (Vector3::new(0.1, 0.0, 0.0), 0.5)];
    let sorted = Sorted::new(Domain::unbounded(), &spheres, 0.0);
    assert!(sorted.grid.starts.len() < 100);
}

#[test]
fn a_few_that_fly_off_do_not_coarsen_the_cells_of_the_others() {
    let mut spheres = scattered(10_000, 1.0, 0.02);
    let together = Sorted::new(Domain::unbounded(), &spheres, 0.004).pairs().len();
    spheres[17].0 = Vector3::new(1e3, -1e4, 1e5);
    spheres[4711].0 = Vector3::new(-1e7, 0.0, 1e5);
    let sorted = Sorted::new(Domain::unbounded(), &spheres, 0.004);
    assert!(sorted.grid.starts.len() < 100_000);
    assert!(sorted.pairs().len() < 2 * together);
}

#[test]
fn a_stretch_of_rows_is_a_compact_body() {
    let spheres = scattered(64_000, 1.0, 0.012);
    let sorted = Sorted::new(Domain::unbounded(), &spheres, 0.001);
    let mut longest: Vec<f64> = Vec::new();
    let centres: Vec<Vector3> = sorted.positions.iter().map(|position| position.vector).collect();
    for rows in centres.chunks(1000) {
        let extent = |axis: usize| {
            let along = || rows.iter().map(|position| position[axis]);
            along().fold(0.0, f64::max) - along().fold(1.0, f64::min)
        };
        longest.push(extent(0).max(extent(1)).max(extent(2)));
    }
    // A thousand of them are two or three cell_blocks in a line, of edge one fifth; some turn to the next.
    longest.sort_unstable_by(f64::total_cmp);
    assert!(longest[longest.len() / 2] < 0.65);
}
