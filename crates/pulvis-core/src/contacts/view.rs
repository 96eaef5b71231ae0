//! Contacts one at a time, with forces, for output and analysis.

use pulvis_contact::{
    ContactInputs, ContactKinematics, ContactResponse, MemoryLayout, Pair, ROOM_TEMPERATURE, levels,
};
use pulvis_math::Vector3;

use super::block::{ContactGroup, Partner};
use crate::particles::{ParticleId, Particles};
use crate::walls::{WallFeature, WallNow};
use pulvis_boundary::{Images, UpperTriangular};

/// The second body of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactPartner {
    /// A particle.
    Particle(ParticleId),
    /// The wall at this index in the list of walls.
    Wall(usize),
}

/// One contact at the present time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactView<'a> {
    /// The first body.
    pub first: ParticleId,
    /// The second body.
    pub second: ContactPartner,
    /// Centre of the first body [m].
    pub centre_first: Vector3,
    /// Centre of the second body at its image nearest to the first; of a wall, the nearest point of its
    /// surface [m].
    pub centre_second: Vector3,
    /// Overlap, negative where attraction acts at a distance [m].
    pub overlap: f64,
    /// Force on the first body [N].
    pub force: Vector3,
    /// Its part along the normal, repulsion positive [N].
    pub normal_force: f64,
    /// What its laws have stored: springs, bonds, and the potential of attractions [J].
    pub stored_energy: f64,
    /// Memory of the contact, column by column as `layout` names them.
    pub memory: &'a [f64],
    /// The names and units of its columns.
    pub layout: &'a MemoryLayout,
}

/// A candidate contact and how deep it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deep {
    /// Rows of the bodies; the second one of a wall means nothing.
    pub(crate) rows: [usize; 2],
    /// The feature of a wall, if it is with one.
    pub(crate) wall: Option<WallFeature>,
    /// Overlap [m].
    pub(crate) overlap: f64,
}

#[derive(Clone, Copy)]
pub(crate) struct Views<'a> {
    pub(crate) group: &'a ContactGroup,
    pub(crate) particles: &'a Particles,
    pub(crate) images: Images,
    /// The velocity gradient of the flow that carries all particles along [1/s].
    pub(crate) rate: UpperTriangular,
    /// How walls lie and move.
    pub(crate) walls: &'a [WallNow],
}

/// Calls `see` with every contact of a group that acts, and the rows of its bodies; of a wall the second one means
/// nothing. The forces are computed again from a copy of the memory, over a step of zero duration, so that the contacts do
/// not change.
pub(crate) fn view_contacts(views: Views<'_>, see: &mut dyn FnMut(&ContactView<'_>, [usize; 2])) {
    let group = views.group;
    views.each(&mut |block, lane, view| {
        let rows = [group.first_row(block, lane), group.second_row(block, lane)];
        see(view, rows.map(|row| row as usize));
    });
}

/// The response of a contact of a group over a step of zero duration; `columns` are its memory. As that of
/// [`ContactModel::respond`](pulvis_contact::ContactModel::respond), which lays the memory out anew for every call.
pub(super) fn respond(group: &ContactGroup, seen: &Seen, columns: &mut [f64]) -> ContactResponse<f64> {
    let (laws, slots) = (&group.model.laws, *group.layout.slots());
    let (time_step, temperature) = (0.0, ROOM_TEMPERATURE);
    let inputs = ContactInputs { pair: &seen.pair, motion: &seen.motion, time_step, temperature };
    let bonded = laws.bond.as_ref().map(|bond| bond.respond(inputs, slots.bond(), columns));
    let beside = bonded.as_ref().map_or(seen.motion, |bonded| bonded.beside(&seen.motion));
    let inputs = ContactInputs { motion: &beside, ..inputs };
    let mut response =
        laws.respond::<f64, _, _, { levels::ALL }>(&group.model.normal, &slots, inputs, columns);
    if let Some(bonded) = bonded {
        bonded.add_to(&mut response);
    }
    response
}

impl<'a> Views<'a> {
    /// Calls `see` with block, lane and view of every contact of the group that acts.
    pub(super) fn each(&self, see: &mut dyn FnMut(usize, usize, &ContactView<'_>)) {
        let group = self.group;
        let (mut memory, mut after) = (Vec::new(), Vec::new());
        for block in (0..group.rows.len()).filter(|&block| group.active[block]) {
            for lane in 0..group.occupancy(block) {
                memory.clear();
                memory.extend(group.columns(block).iter().map(|column| column.0[lane]));
                after.clone_from(&memory);
                if let Some(view) = self.look(block, lane, &memory, &mut after) {
                    see(block, lane, &view);
                }
            }
        }
    }

    /// How deep each contact of a block is.
    pub(crate) fn overlaps(self, block: usize) -> impl Iterator<Item = Deep> + 'a {
        (0..self.group.occupancy(block)).filter_map(move |lane| {
            let first = self.group.first_row(block, lane) as usize;
            let overlap = self.geometry(first, block, lane)?.motion.overlap;
            Some(match self.group.partner {
                Partner::Particle => {
                    Deep { rows: [first, self.group.second_row(block, lane) as usize], wall: None, overlap }
                }
                Partner::Wall => {
                    let feature = WallFeature::from_number(self.group.second_row(block, lane));
                    Deep { rows: [first; 2], wall: Some(feature), overlap }
                }
            })
        })
    }

    /// The overlap of a contact [m]; `None` of one with a feature of a wall that the particle does not touch.
    pub(crate) fn overlap(&self, block: usize, lane: usize) -> Option<f64> {
        let first = self.group.first_row(block, lane) as usize;
        Some(self.geometry(first, block, lane)?.motion.overlap)
    }

    fn look<'b>(
        &self,
        block: usize,
        lane: usize,
        memory: &'b [f64],
        after: &mut [f64],
    ) -> Option<ContactView<'b>>
    where
        'a: 'b,
    {
        let group = self.group;
        let seen = self.geometry(group.first_row(block, lane) as usize, block, lane)?;
        if seen.motion.overlap <= -group.interaction_range {
            return None;
        }
        let answer = respond(group, &seen, after);
        if seen.motion.overlap <= 0.0 && answer.force == Vector3::zero() {
            return None;
        }
        Some(ContactView {
            first: seen.first,
            second: seen.second,
            centre_first: seen.centre_first,
            centre_second: seen.centre_second,
            overlap: seen.motion.overlap,
            force: answer.force,
            normal_force: answer.normal_force,
            stored_energy: answer.energies.stored(),
            memory,
            layout: &group.layout,
        })
    }

    /// Position and motion of the first body, in row `i`, relative to the second one.
    pub(super) fn geometry(&self, i: usize, block: usize, lane: usize) -> Option<Seen> {
        let particles = self.particles;
        let velocity = |row: usize| particles.velocity[row].vector;
        let angular_velocity = |row: usize| particles.angular_velocity[row].vector;
        let (centre, radius) = (particles.position[i].vector, &particles.radius);
        let inverse_mass = |row: usize| particles.velocity[row].scalar;
        let first = particles.id[i];
        match self.group.partner {
            Partner::Particle => {
                let j = self.group.second_row(block, lane) as usize;
                let separation = self.images.nearest(centre - particles.position[j].vector);
                let inverse_distance = 1.0 / separation.norm();
                let velocity = velocity(i) - velocity(j) + self.rate.times(separation);
                let motion = ContactKinematics {
                    normal: separation * inverse_distance,
                    overlap: radius[i] + radius[j] - separation.norm(),
                    inverse_distance,
                    normal_rate: None,
                    radius_i: radius[i],
                    radius_j: radius[j],
                    velocity,
                    velocity_mid: velocity,
                    angular_velocity_i: angular_velocity(i),
                    angular_velocity_j: angular_velocity(j),
                    angular_velocity_i_mid: angular_velocity(i),
                    angular_velocity_j_mid: angular_velocity(j),
                };
                let quantities = self.group.quantities(&particles.columns, i, Some(j));
                let inverse_radii = 1.0 / radius[i] + 1.0 / radius[j];
                let pair = Pair::from_sums(inverse_mass(i) + inverse_mass(j), inverse_radii)
                    .with_quantities(quantities);
                let second = ContactPartner::Particle(particles.id[j]);
                let centre_second = centre - separation;
                Some(Seen { motion, pair, first, second, centre_first: centre, centre_second })
            }
            Partner::Wall => {
                let index = self.group.wall(block);
                let wall = self.walls.get(index)?;
                let feature = WallFeature::from_number(self.group.second_row(block, lane));
                // What is farther away than this does not act.
                let limit = radius[i] + self.group.interaction_range;
                let (surface, normal_turning) = wall.feature(feature, centre, limit)?;
                let turning = wall.angular_velocity().unwrap_or(Vector3::zero());
                let mut motion = ContactKinematics {
                    normal: surface.normal,
                    overlap: radius[i] - surface.distance,
                    inverse_distance: 0.0,
                    normal_rate: None,
                    radius_i: radius[i],
                    radius_j: 0.0,
                    velocity: velocity(i),
                    velocity_mid: velocity(i),
                    angular_velocity_i: angular_velocity(i),
                    angular_velocity_j: turning,
                    angular_velocity_i_mid: angular_velocity(i),
                    angular_velocity_j_mid: turning,
                };
                wall.move_against(&surface, normal_turning, centre, &mut motion);
                let quantities = self.group.quantities(&particles.columns, i, None);
                let pair = Pair::from_sums(inverse_mass(i), 1.0 / radius[i] + surface.mean_curvature)
                    .with_quantities(quantities);
                let second = ContactPartner::Wall(index);
                let centre_second = centre - surface.normal * surface.distance;
                Some(Seen { motion, pair, first, second, centre_first: centre, centre_second })
            }
        }
    }
}

/// One contact before its response.
pub(super) struct Seen {
    pub(super) motion: ContactKinematics<f64>,
    pub(super) pair: Pair<f64>,
    first: ParticleId,
    second: ContactPartner,
    centre_first: Vector3,
    centre_second: Vector3,
}
