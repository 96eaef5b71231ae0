//! The neighbour list of one chunk.

use pulvis_math::Packed4;

use super::block::{Candidate, ContactGroup, Partner, WIDTH};
use super::chunk::{Approach, Chunk};
use super::rebuild::{LayoutNumber, MemoryStore, wall_partner};
use super::row_set::RowSet;
use super::search::{Near, Search};
use super::table::Surroundings;
use crate::counting_sort::counting_sort;
use crate::neighbours::{CellGrid, RowRangePair};
use crate::particles::MaterialIndex;
use crate::phases::Phases;
use crate::walls::{Turned, WallFeature, WallForce};

/// Pairs are sorted into classes by their gap over the thickest skin; these are the upper bounds of all classes but the
/// last. Blocks are then full of contacts that touch, and blocks of pairs that are far apart can be skipped until the
/// bodies have moved.
const GAP_CLASSES: [f64; 3] = [0.01, 0.06, 0.3];
/// In each class of gaps, pairs across a periodic boundary come last.
const CLASSES: usize = 2 * (GAP_CLASSES.len() + 1);

/// Scratch memory to list one chunk after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Listing {
    row_ranges: Vec<RowRangePair>,
    near: Vec<Near>,
    /// The sort key of each pair in `near`: its group times [`CLASSES`] plus its class. Pairs that are too far apart have
    /// the last key.
    classes: Vec<u32>,
    /// The pairs sorted by key, and where each key begins. Pairs of one key stay in cell order.
    order: Vec<u32>,
    class_starts: Vec<u32>,
    /// The rows of later chunks that the chunk has contacts with.
    halo: RowSet,
    candidates: Vec<Candidate>,
    /// The features of a wall near a particle, with their distances [m].
    features: Vec<(u32, f64)>,
}

/// The inputs of a listing.
#[derive(Clone, Copy)]
pub(super) struct Sources<'a> {
    pub(super) around: &'a Surroundings<'a>,
    pub(super) grid: &'a CellGrid,
    pub(super) memory: &'a MemoryStore,
}

impl Listing {
    /// Lists the pairs of a chunk again; contacts get their memory back.
    pub(super) fn list(&mut self, chunk: &mut Chunk, sources: Sources<'_>) {
        let mut spare = std::mem::take(&mut chunk.groups).into_iter();
        chunk.approach = Approach::default();
        chunk.phases = Phases::default();
        self.find_near(chunk, sources);
        self.list_pairs(chunk, sources, &mut spare);
        self.list_walls(chunk, sources, &mut spare);
    }

    /// Memory [byte].
    pub(super) fn memory_size(&self) -> usize {
        size_of_val(&self.row_ranges[..])
            + size_of_val(&self.near[..])
            + size_of_val(&self.classes[..])
            + size_of_val(&self.order[..])
            + size_of_val(&self.candidates[..])
            + self.halo.memory_size()
    }

    /// Finds the pairs that may act before the next rebuild, and sorts them by group and class.
    ///
    /// The search returns gaps between the *skins* of two bodies. A pair is listed if this gap, less the interaction
    /// range of its group, is negative. What is kept is the gap between the *bodies* to their interaction range: with
    /// that the contact loop decides whether to skip a block.
    fn find_near(&mut self, chunk: &Chunk, Sources { around, grid, .. }: Sources<'_>) {
        let Surroundings { particles, interactions, images, skin, instructions, .. } = *around;
        let (skinned, material) = (skin.positions(), &particles.material);
        let Self { row_ranges, near, classes, .. } = self;
        row_ranges.clear();
        let rows = chunk.rows.start as u32..chunk.rows.end as u32;
        grid.for_each_row_range_pair_of(rows, skinned, |pair| row_ranges.push(pair));
        near.clear();
        let margin = interactions.longest_range();
        instructions.run(Search { row_ranges, positions: skinned, images, margin, near });
        // Materials without a contact model never interact.
        let range =
            |group| interactions.model(group).map_or(f64::NEG_INFINITY, |_| interactions.range(group));
        let ranges: Vec<f64> = (0..interactions.groups()).map(range).collect();
        let bounds = GAP_CLASSES.map(|bound| bound * skin.thickest);
        let skin_of = |row: u32| skinned[row as usize].scalar - particles.position[row as usize].scalar;
        let far = ranges.len() * CLASSES;
        classes.clear();
        classes.extend(near.iter_mut().map(|pair| {
            let [one, other] = pair.rows;
            let group = interactions.group(material[one as usize], material[other as usize]);
            let between_skins = pair.gap - ranges[group];
            pair.gap = between_skins + (skin_of(one) + skin_of(other));
            // Without branches, which would be unpredictable here.
            let class: usize = bounds.iter().map(|bound| usize::from(pair.gap > *bound)).sum();
            let [first, second] = [one, other].map(|row| skinned[row as usize].vector);
            let class = 2 * class + usize::from(images.are_crossed(first - second));
            (if between_skins < 0.0 { group * CLASSES + class } else { far }) as u32
        }));
        // What is held or led does not act on its like, as walls do not: neither could give way.
        if particles.any_prescribed {
            let prescribed = |&row: &u32| particles.is_prescribed(row as usize);
            let pairs = classes.iter_mut().zip(near.iter());
            pairs
                .filter(|(_, pair)| pair.rows.iter().all(prescribed))
                .for_each(|(class, _)| *class = far as u32);
        }
        counting_sort(classes, far + 1, &mut self.class_starts, &mut self.order);
    }

    fn list_pairs(
        &mut self,
        chunk: &mut Chunk,
        Sources { around, memory, .. }: Sources<'_>,
        spare: &mut impl Iterator<Item = ContactGroup>,
    ) {
        let id = &around.particles.id;
        let Self { near, classes, order, class_starts, halo, candidates, .. } = self;
        let (start, end) = (chunk.rows.start as u32, chunk.rows.end as u32);
        let near_count = class_starts[class_starts.len() - 2] as usize;
        halo.begin(around.particles.len());
        order[..near_count].iter().for_each(|&pair| halo.insert(near[pair as usize].rows[1]));
        halo.count_from(end, &mut chunk.halo);
        for (index, starts) in class_starts.windows(CLASSES + 1).step_by(CLASSES).enumerate() {
            let Some(&model) = around.interactions.model(index) else { continue };
            candidates.clear();
            let pairs = &order[starts[0] as usize..starts[CLASSES] as usize];
            candidates.extend(pairs.iter().map(|&pair| {
                let Near { rows: [one, other], gap } = near[pair as usize];
                let crosses_boundary = classes[pair as usize] % 2 == 1;
                let own = one - start;
                let beyond = end - start + halo.slot(other);
                let others = if other < end { other - start } else { beyond };
                // The first body of a contact is the one with the lower id: remembered vectors then keep their sign
                // when rows change their order.
                if id[one as usize] < id[other as usize] {
                    Candidate { rows: [one, other], sums: [own, others], gap, crosses_boundary }
                } else {
                    Candidate { rows: [other, one], sums: [others, own], gap, crosses_boundary }
                }
            }));
            let range = around.interactions.range(index);
            let mut group = ContactGroup::new(index, model, range, Partner::Particle, spare.next());
            group.find_quantities(&around.particles.columns);
            let number = memory.layout_number(&group);
            group.reserve(candidates.len());
            for block in candidates.chunks(WIDTH) {
                group.push_block(block, |group, lane| {
                    let [first, second] = block[lane].rows;
                    memory.find([around.order[first as usize], around.order[second as usize]], group, number)
                });
            }
            chunk.keep(group);
        }
    }

    /// Lists the pairs of a particle and a wall: one group for each model, in it wall by wall.
    fn list_walls(
        &mut self,
        chunk: &mut Chunk,
        Sources { around, memory, .. }: Sources<'_>,
        spare: &mut impl Iterator<Item = ContactGroup>,
    ) {
        let Surroundings { particles, interactions, walls, .. } = *around;
        let mut groups: Vec<Option<(ContactGroup, LayoutNumber)>> = vec![None; interactions.groups()];
        for (wall_number, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.present) {
            for &material in around.materials {
                let Some(&model) = interactions.get(material, wall.material) else { continue };
                let index = interactions.group(material, wall.material);
                let range = interactions.range(index);
                let (group, number) = groups[index].get_or_insert_with(|| {
                    let mut group = ContactGroup::new(index, model, range, Partner::Wall, spare.next());
                    group.find_quantities(&particles.columns);
                    let number = memory.layout_number(&group);
                    (group, number)
                });
                group.wall_forces.resize(walls.len(), WallForce::default());
                self.find_at_wall(chunk, around, wall_number, material, range);
                for block in self.candidates.chunks(WIDTH) {
                    group.push_block(block, |group, lane| {
                        let [row, feature] = block[lane].rows;
                        let partner = wall_partner(WallFeature::from_number(feature));
                        memory.find([around.order[row as usize], partner], group, *number)
                    });
                }
            }
        }
        groups.into_iter().flatten().for_each(|(group, _)| chunk.keep(group));
    }

    /// Puts the particles of one material near a wall, and the features of the wall near them, into the candidates.
    fn find_at_wall(
        &mut self,
        chunk: &Chunk,
        around: &Surroundings<'_>,
        wall_number: usize,
        material: MaterialIndex,
        range: f64,
    ) {
        let Surroundings { particles, skin, .. } = *around;
        let wall = &around.walls[wall_number];
        let turned = Turned::of(wall);
        let Self { candidates, features, .. } = self;
        candidates.clear();
        let meets_walls = |row: usize| !(particles.any_prescribed && particles.is_prescribed(row));
        let of_material = |&row: &usize| particles.material[row] == material && meets_walls(row);
        for row in chunk.rows.clone().filter(of_material) {
            let Packed4 { vector, scalar } = particles.position[row];
            let farthest = skin.of_walls() + (skin.positions()[row].scalar - scalar);
            let mut add = |feature: u32, gap: f64| {
                let rows = [row as u32, WallFeature::new(wall_number, feature).number()];
                let sums = [(row - chunk.rows.start) as u32, 0];
                candidates.push(Candidate { rows, sums, gap, crosses_boundary: false });
            };
            match wall.shape.edged() {
                None => {
                    let gap = wall.distance(vector) - scalar - range;
                    if gap < farthest {
                        add(0, gap);
                    }
                }
                Some(shape) => {
                    let centre = turned.backwards(vector - wall.point);
                    features.clear();
                    shape.features_near(centre, farthest + scalar + range, features);
                    for &(feature, distance) in features.iter() {
                        add(feature, distance - scalar - range);
                    }
                }
            }
        }
    }
}
