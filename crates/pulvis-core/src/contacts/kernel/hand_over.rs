//! Contacts that pass from one feature of a mesh to the next.

use super::super::block::{ContactGroup, F64x8};
use super::KinematicColumns;
use crate::walls::{WallFeature, WallNow};

/// Where a contact stands in a group.
#[derive(Clone, Copy, PartialEq)]
struct Place {
    block: usize,
    lane: usize,
}

/// Gives what contacts with meshes remember to the features that the contacts have passed to in this step: a spring or a
/// plastic overlap belongs to the place where two bodies touch, whatever this part of the mesh is called.
///
/// A contact has passed on if its feature is no longer touched and another one is that remembers nothing yet.
///
/// # Safety
/// The group's rows lie within the columns of `moving`, and nobody writes those meanwhile.
pub(super) unsafe fn hand_over(group: &mut ContactGroup, walls: &[WallNow], moving: KinematicColumns<'_>) {
    let columns = group.layout.columns();
    if columns == 0 || !walls.iter().any(WallNow::has_many_features) {
        return;
    }
    for block in 0..group.rows.len() {
        let wall = &walls[group.wall(block)];
        if !group.active[block] || !wall.has_many_features() {
            continue;
        }
        for lane in 0..group.occupancy(block) {
            let place = Place { block, lane };
            if !remembers(group, place) {
                continue;
            }
            // SAFETY: as the caller vouches.
            let position = unsafe { moving.position.get_at_number(group.rows[block].0[0][lane]) };
            let (centre, reach) = (position.vector, position.scalar + group.interaction_range);
            let distance = |place: Place, limit: f64| {
                let feature = WallFeature::from_number(group.second_row(place.block, place.lane));
                Some(wall.feature(feature, centre, limit)?.0.distance)
            };
            // A contact that has just ended, farther away, has passed to no other.
            if distance(place, reach + position.scalar).is_some() {
                continue;
            }
            let others = siblings(group, place).filter(|&other| !remembers(group, other));
            let touched = others.filter_map(|other| Some((other, distance(other, reach)?)));
            let Some((next, _)) = touched.min_by(|one, other| one.1.total_cmp(&other.1)) else { continue };
            for column in 0..columns {
                let value = std::mem::take(&mut group.memory[place.block * columns + column].0[place.lane]);
                group.memory[next.block * columns + column].0[next.lane] = value;
            }
            group.active[next.block] = true;
        }
    }
}

/// Whether a contact has a column of memory that is not zero.
fn remembers(group: &ContactGroup, place: Place) -> bool {
    group.columns(place.block).iter().any(|column: &F64x8| column.0[place.lane] != 0.0)
}

/// The other contacts of the same particle with the same wall: they are listed one after the other.
fn siblings(group: &ContactGroup, place: Place) -> impl Iterator<Item = Place> + '_ {
    let bodies = |place: Place| (group.first_row(place.block, place.lane), group.wall(place.block));
    let own = bodies(place);
    let before = std::iter::successors(Some(place), |place| match place.lane.checked_sub(1) {
        Some(lane) => Some(Place { lane, ..*place }),
        None => {
            let block = place.block.checked_sub(1)?;
            Some(Place { block, lane: group.occupancy(block).checked_sub(1)? })
        }
    });
    let after = std::iter::successors(Some(place), |place| {
        if place.lane + 1 < group.occupancy(place.block) {
            return Some(Place { lane: place.lane + 1, ..*place });
        }
        let block = place.block + 1;
        (block < group.rows.len()).then_some(Place { block, lane: 0 })
    });
    let before = before.skip(1).take_while(move |&other| bodies(other) == own);
    before.chain(after.skip(1).take_while(move |&other| bodies(other) == own))
}
