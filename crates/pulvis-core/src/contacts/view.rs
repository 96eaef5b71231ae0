//! Contacts as others see them: one at a time, with forces, for output and analysis.

use pulvis_contact::{NormalLaw, NormalLawVisitor, Pair, PairMotion};
use pulvis_math::{Lanes, Real, Vector3};

use super::block::{ContactGroup, Partner, WIDTH};
use super::kernel::{Moving, WallMotionNow, respond};
use super::layout::Lane;
use crate::domain::Images;
use crate::particles::ParticleId;

/// The second body of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactPartner {
    /// A particle.
    Particle(ParticleId),
    /// The wall at this place in the list of walls.
    Wall(usize),
}

/// One contact at the present time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactView {
    /// The first body.
    pub first: ParticleId,
    /// The second body.
    pub second: ContactPartner,
    /// Centre of the first body [m].
    pub centre_first: Vector3,
    /// Centre of the second body at its image nearest to the first; of a wall, the foot of the
    /// perpendicular [m].
    pub centre_second: Vector3,
    /// Overlap, negative where attraction acts at a distance [m].
    pub overlap: f64,
    /// Force on the first body [N].
    pub force: Vector3,
    /// Its part along the normal, repulsion positive [N].
    pub normal_force: f64,
    /// First column of the normal law's memory (Luding: largest overlap), zero where it has none [m].
    pub memory: f64,
}

pub(crate) struct Views<'a> {
    pub(crate) group: &'a ContactGroup,
    pub(crate) moving: Moving<'a>,
    pub(crate) ids: &'a [ParticleId],
    pub(crate) images: Images,
    /// For walls: how the wall lies and moves.
    pub(crate) wall: Option<WallMotionNow>,
}

/// Hands every contact of a group that acts to `see`. The forces are computed anew from a copy of the
/// memory, over a step of no duration, so that looking changes nothing.
pub(crate) fn view_contacts(views: Views<'_>, see: &mut dyn FnMut(&ContactView)) {
    let normal = views.group.model.normal;
    normal.accept(Looking { views, see });
}

struct Looking<'a, 'b> {
    views: Views<'a>,
    see: &'b mut dyn FnMut(&ContactView),
}

impl NormalLawVisitor for Looking<'_, '_> {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let group = self.views.group;
        for block in (0..group.first.len()).filter(|&block| group.live[block]) {
            for lane in 0..group.filled(block) {
                if let Some(view) = self.views.look(&law, block, lane) {
                    (self.see)(&view);
                }
            }
        }
    }
}

impl Views<'_> {
    fn look<N: NormalLaw>(&self, law: &N, block: usize, lane: usize) -> Option<ContactView> {
        let (motion, pair, second, centre_second) = self.geometry(block, lane)?;
        let group = self.group;
        let first = group.first[block][lane] as usize;
        let composition = &group.model.composition;
        if motion.overlap.lane(0) <= -composition.noncontact.reach() {
            return None;
        }
        let columns = group.layout.columns();
        let block_memory = &group.memory[block * columns..(block + 1) * columns];
        let mut memory: Vec<Lane> = block_memory.iter().map(|column| Lane::splat(column.0[lane])).collect();
        let answer = respond::<N, true>(law, composition, &group.layout, &pair, &motion, 0.0, &mut memory);
        let force = answer.force.lane(0);
        let at_distance = motion.overlap.lane(0) <= 0.0;
        if at_distance && force == Vector3::zero() {
            return None;
        }
        Some(ContactView {
            first: self.ids[first],
            second,
            centre_first: self.moving.position[first],
            centre_second,
            overlap: motion.overlap.lane(0),
            force,
            normal_force: answer.normal_force.lane(0),
            memory: group.layout.normal_memory(&memory).first().map_or(0.0, |column| column.lane(0)),
        })
    }

    /// The contact in one lane, as a block of eight equal ones.
    #[allow(clippy::type_complexity)] // private, taken apart at once
    fn geometry(
        &self,
        block: usize,
        lane: usize,
    ) -> Option<(PairMotion<Lane>, Pair<Lane>, ContactPartner, Vector3)> {
        let moving = &self.moving;
        let i = self.group.first[block][lane] as usize;
        let spread = Vector3::<Lane>::splat;
        let number = |value: f64| Lanes::<WIDTH>::splat(value);
        match self.group.partner {
            Partner::Particle => {
                let j = self.group.second[block][lane] as usize;
                let separation = self.images.nearest(moving.position[i] - moving.position[j]);
                let distance = separation.norm();
                let velocity = moving.velocity[i] - moving.velocity[j];
                let motion = PairMotion {
                    normal: spread(separation * (1.0 / distance)),
                    overlap: number(moving.radius[i] + moving.radius[j] - distance),
                    inverse_distance: number(1.0 / distance),
                    radius_i: number(moving.radius[i]),
                    radius_j: number(moving.radius[j]),
                    velocity: spread(velocity),
                    velocity_mid: spread(velocity),
                    spin_i: spread(moving.spin[i]),
                    spin_j: spread(moving.spin[j]),
                    spin_i_mid: spread(moving.spin[i]),
                    spin_j_mid: spread(moving.spin[j]),
                };
                let pair = Pair::spheres(
                    number(moving.mass[i]),
                    number(moving.mass[j]),
                    motion.radius_i,
                    motion.radius_j,
                );
                let centre = moving.position[i] - separation;
                Some((motion, pair, ContactPartner::Particle(self.ids[j]), centre))
            }
            Partner::Wall(place) => {
                let wall = self.wall?;
                let distance = moving.position[i].dot(wall.normal) - wall.offset;
                let velocity = moving.velocity[i] - wall.velocity;
                let motion = PairMotion {
                    normal: spread(wall.normal),
                    overlap: number(moving.radius[i] - distance),
                    inverse_distance: number(0.0),
                    radius_i: number(moving.radius[i]),
                    radius_j: number(0.0),
                    velocity: spread(velocity),
                    velocity_mid: spread(velocity),
                    spin_i: spread(moving.spin[i]),
                    spin_j: spread(Vector3::zero()),
                    spin_i_mid: spread(moving.spin[i]),
                    spin_j_mid: spread(Vector3::zero()),
                };
                let pair = Pair::wall(number(moving.mass[i]), motion.radius_i);
                let foot = moving.position[i] - wall.normal * distance;
                Some((motion, pair, ContactPartner::Wall(place), foot))
            }
        }
    }
}
