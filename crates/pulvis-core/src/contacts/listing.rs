//! Listing the candidates of a piece.

use pulvis_contact::ContactModel;
use pulvis_math::{Quad, Vector3};

use super::block::{Candidate, ContactGroup, Partner, WIDTH};
use super::candidates::{Near, Search};
use super::piece::{Closed, Piece};
use super::rebuild::{LayoutNumber, MemoryStore, wall_partner};
use super::row_set::RowSet;
use super::table::Surroundings;
use crate::counting_sort::counting_sort;
use crate::neighbours::{CellGrid, Stretch};
use crate::phases::Phases;

/// Candidates are sorted into blocks by their gap over the thickest skin, up to these bounds and beyond: what touches
/// now fills whole blocks, and blocks of what is far apart are passed over until something has moved.
const GAP_CLASSES: [f64; 3] = [0.01, 0.06, 0.3];
/// In each class, pairs across a periodic boundary come last.
const CLASSES: usize = 2 * (GAP_CLASSES.len() + 1);

/// Room for the candidates of one piece after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Listing {
    stretches: Vec<Stretch>,
    near: Vec<Near>,
    /// Of each pair that is near, by group and class of gaps; what is too far apart comes last.
    classes: Vec<u32>,
    /// The pairs by class, then in cell order, and where each class begins.
    order: Vec<u32>,
    class_starts: Vec<u32>,
    /// The rows of later pieces.
    halo: RowSet,
    candidates: Vec<Candidate>,
}

/// What the list of candidates is made from.
#[derive(Clone, Copy)]
pub(super) struct Sources<'a> {
    pub(super) around: &'a Surroundings<'a>,
    pub(super) grid: &'a CellGrid,
    pub(super) memory: &'a MemoryStore,
}

impl Listing {
    /// Lists the candidates of a piece anew; contacts keep their memory.
    pub(super) fn list(&mut self, piece: &mut Piece, sources: Sources<'_>) {
        let mut spare = std::mem::take(&mut piece.groups).into_iter();
        piece.incoming.clear();
        piece.dependents.clear();
        piece.closed = Closed::default();
        piece.phases = Phases::default();
        self.find_near(piece, sources);
        self.list_pairs(piece, sources, &mut spare);
        self.list_walls(piece, sources, &mut spare);
    }

    /// Memory [byte].
    pub(super) fn memory_size(&self) -> usize {
        size_of_val(&self.stretches[..])
            + size_of_val(&self.near[..])
            + size_of_val(&self.classes[..])
            + size_of_val(&self.order[..])
            + size_of_val(&self.candidates[..])
            + self.halo.memory_size()
    }

    /// Finds the pairs that may touch before the next list, and sorts them.
    fn find_near(&mut self, piece: &Piece, Sources { around, grid, .. }: Sources<'_>) {
        let Surroundings { particles, interactions, images, skin, instructions, .. } = *around;
        let (skinned, material) = (skin.places(), &particles.material);
        let Self { stretches, near, classes, .. } = self;
        stretches.clear();
        let rows = piece.rows.start as u32..piece.rows.end as u32;
        grid.for_each_stretch_of(rows, skinned, |stretch| stretches.push(stretch));
        near.clear();
        let margin = interactions.reach();
        instructions.run(Search { stretches, places: skinned, images, margin, near });
        // What has no model is never near.
        let reach = |group| interactions.model(group).map_or(f64::NEG_INFINITY, ContactModel::reach);
        let reaches: Vec<f64> = (0..interactions.groups()).map(reach).collect();
        let bounds = GAP_CLASSES.map(|bound| bound * skin.thickest);
        let skin_of = |row: u32| skinned[row as usize].scalar - particles.place[row as usize].scalar;
        let far = reaches.len() * CLASSES;
        classes.clear();
        classes.extend(near.iter_mut().map(|Near { rows: [one, other], gap }| {
            let group = interactions.group(material[*one as usize], material[*other as usize]);
            // So far between skins.
            *gap -= reaches[group];
            let skins_meet = *gap < 0.0;
            *gap += skin_of(*one) + skin_of(*other);
            // Without branches: gaps follow no pattern.
            let class: usize = bounds.iter().map(|bound| usize::from(*gap > *bound)).sum();
            let [first, second] = [*one, *other].map(|row| skinned[row as usize].vector);
            let class = 2 * class + usize::from(images.are_crossed(first - second));
            (if skins_meet { group * CLASSES + class } else { far }) as u32
        }));
        counting_sort(classes, far + 1, &mut self.class_starts, &mut self.order);
    }

    fn list_pairs(
        &mut self,
        piece: &mut Piece,
        Sources { around, memory, .. }: Sources<'_>,
        spare: &mut impl Iterator<Item = ContactGroup>,
    ) {
        let id = &around.particles.id;
        let Self { near, classes, order, class_starts, halo, candidates, .. } = self;
        let (start, end) = (piece.rows.start as u32, piece.rows.end as u32);
        let near_ones = class_starts[class_starts.len() - 2] as usize;
        halo.begin(around.particles.len());
        order[..near_ones].iter().for_each(|&pair| halo.insert(near[pair as usize].rows[1]));
        halo.count_from(end, &mut piece.halo);
        for (place, starts) in class_starts.windows(CLASSES + 1).step_by(CLASSES).enumerate() {
            let Some(&model) = around.interactions.model(place) else { continue };
            candidates.clear();
            let pairs = &order[starts[0] as usize..starts[CLASSES] as usize];
            candidates.extend(pairs.iter().map(|&pair| {
                let Near { rows: [one, other], gap } = near[pair as usize];
                let across = classes[pair as usize] % 2 == 1;
                let own = one - start;
                let beyond = end - start + halo.place(other);
                let others = if other < end { other - start } else { beyond };
                // The first body of a contact is the one of the lower id: what the contact remembers
                // does not change its sign when rows change their order.
                if id[one as usize] < id[other as usize] {
                    Candidate { rows: [one, other], sums: [own, others], gap, across }
                } else {
                    Candidate { rows: [other, one], sums: [others, own], gap, across }
                }
            }));
            let mut group = ContactGroup::new(model, Partner::Particle, spare.next());
            let number = memory.layout_number(&group);
            group.reserve(candidates.len());
            for block in candidates.chunks(WIDTH) {
                group.push_block(block, |group, lane| {
                    let [first, second] = block[lane].rows;
                    memory.find([around.order[first as usize], around.order[second as usize]], group, number)
                });
            }
            piece.keep(group);
        }
    }

    /// Lists what may touch walls: one group for each model, in it wall by wall.
    fn list_walls(
        &mut self,
        piece: &mut Piece,
        Sources { around, memory, .. }: Sources<'_>,
        spare: &mut impl Iterator<Item = ContactGroup>,
    ) {
        let Surroundings { particles, interactions, walls, skin, .. } = *around;
        let candidates = &mut self.candidates;
        let mut groups: Vec<Option<(ContactGroup, LayoutNumber)>> = vec![None; interactions.groups()];
        for (wall_number, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.present) {
            for &material in around.materials {
                let Some(&model) = interactions.get(material, wall.material) else { continue };
                let (group, number) =
                    groups[interactions.group(material, wall.material)].get_or_insert_with(|| {
                        let group = ContactGroup::new(model, Partner::Wall, spare.next());
                        let number = memory.layout_number(&group);
                        (group, number)
                    });
                group.wall_forces.resize(walls.len(), Vector3::zero());
                let touch = wall.offset() + model.reach();
                candidates.clear();
                for row in piece.rows.clone().filter(|&row| particles.material[row] == material) {
                    let Quad { vector, scalar } = particles.place[row];
                    let gap = vector.dot(wall.normal) - scalar - touch;
                    if gap < skin.of_walls() + (skin.places()[row].scalar - scalar) {
                        let sum = (row - piece.rows.start) as u32;
                        let rows = [row as u32, wall_number as u32];
                        candidates.push(Candidate { rows, sums: [sum, 0], gap, across: false });
                    }
                }
                for block in candidates.chunks(WIDTH) {
                    group.push_block(block, |group, lane| {
                        let row = around.order[block[lane].rows[0] as usize];
                        memory.find([row, wall_partner(wall_number)], group, *number)
                    });
                }
            }
        }
        groups.into_iter().flatten().for_each(|(group, _)| piece.keep(group));
    }
}
