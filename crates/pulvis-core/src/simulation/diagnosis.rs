//! What a simulation can say of why it went wrong: the first contact that was deeper than contacts should be.

use pulvis_contact::Partner;
use pulvis_math::Vector3;

use super::Simulation;
use super::errors::{Alarm, StepError};
use crate::contacts::{ContactPartner, Deep};
use crate::particles::ParticleId;
use crate::walls::WallFeature;

/// Overlap over the smaller radius from which a contact is taken down as the first deep one [1]. Laws of contacts are
/// made for overlaps that are small beside the radius; where a run explodes, the contact that began it passed this first.
const DEEP: f64 = 0.3;

/// The first contact that was deeper than 0.3 of the smaller radius, as it was when it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeepContact {
    /// The first body.
    pub first: ParticleId,
    /// The second body.
    pub second: ContactPartner,
    /// Overlap over the smaller radius, at a wall over the radius [1].
    pub overlap: f64,
    /// The smaller radius [m].
    pub radius: f64,
    /// Speed at which the bodies approached each other, negative where they parted [m/s].
    pub closing_speed: f64,
    /// Duration of the shortest motion that the contact can make [s].
    pub contact_time: f64,
    /// The time step [s].
    pub time_step: f64,
    /// In which step.
    pub step: u64,
    /// When [s].
    pub time: f64,
}

impl Simulation {
    /// The first contact that was deeper than 0.3 of the smaller radius since the simulation was set up or imported, where
    /// a [limit](crate::Limits::overlap) of overlaps is set. Looked for when a list is made anew and every 64 steps.
    pub fn first_deep_contact(&self) -> Option<&DeepContact> {
        self.first_deep.as_ref()
    }

    /// Duration of the shortest motion that a contact of these bodies can make [s]; `None` where they are not there or
    /// cannot meet.
    pub fn contact_time(&self, first: ParticleId, second: ContactPartner) -> Option<f64> {
        let row = |id: ParticleId| self.particles.id.iter().position(|known| *known == id);
        match second {
            ContactPartner::Particle(other) => self.contact_time_of([row(first)?, row(other)?], None),
            ContactPartner::Wall(wall) => self.contact_time_of([row(first)?; 2], Some(wall)),
        }
    }

    fn contact_time_of(&self, rows: [usize; 2], wall: Option<usize>) -> Option<f64> {
        let particles = &self.particles;
        // A prescribed motion is that of an infinite mass.
        let mass =
            |row: usize| if particles.is_prescribed(row) { f64::INFINITY } else { particles.mass[row] };
        let [one, other] = rows.map(|row| (mass(row), particles.radius[row]));
        let material = particles.material[rows[0]];
        match wall {
            Some(wall) => {
                let wall = self.walls.get(wall)?;
                let surface = Partner::Wall { mean_curvature: wall.shape.least_mean_curvature_for(one.1) };
                Some(self.interactions.get(material, wall.material)?.shortest_contact_time(one, surface))
            }
            None => {
                let model = self.interactions.get(material, particles.material[rows[1]])?;
                Some(model.shortest_contact_time(one, Some(other)))
            }
        }
    }

    /// Whether no contact is deeper than contacts can be. Takes down the first deep one.
    pub(super) fn check_overlaps(&mut self) -> Result<(), StepError> {
        let most = self.limits.overlap;
        if most == f64::INFINITY {
            return Ok(());
        }
        let least = if self.first_deep.is_some() { most } else { most.min(DEEP) };
        let found = self.deepest(least);
        if self.is_shared() {
            let is_anywhere = self.on_any_rank(found.is_some());
            if !self.agreed(is_anywhere)? {
                return Ok(());
            }
            // It is rare: all ranks look at everything, see the same, and share the work out anew.
            let gathered = self.gather_state();
            self.agreed(gathered)?;
            let checked = self.check_overlaps();
            self.share_out()?;
            return checked;
        }
        let Some((deep, overlap, radius)) = found else { return Ok(()) };
        if self.first_deep.is_none() && overlap > DEEP {
            self.first_deep = self.deep_contact(deep, overlap, radius);
        }
        if overlap <= most {
            return Ok(());
        }
        let [first, second] = deep.rows.map(|row| self.particles.id[row]);
        Err(self.alarm(match deep.wall {
            Some(feature) => {
                Alarm::BehindWall { id: first, wall: self.walls[feature.wall()].name.clone(), overlap, most }
            }
            None => Alarm::Overlap { id: first, other: second, overlap, most },
        }))
    }

    /// The same between two lists: costs nothing where the deepest contact of the last pass is not deep.
    pub(super) fn survey_overlaps(&mut self) -> Result<(), StepError> {
        let most = self.limits.overlap;
        let least = if self.first_deep.is_some() { most } else { most.min(DEEP) };
        let deepest = self.pass.observed.overlap_max;
        if deepest <= least * self.smallest_radius() { Ok(()) } else { self.check_overlaps() }
    }

    pub(super) fn smallest_radius(&self) -> f64 {
        self.particles.radius.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The contact that is deepest by its overlap over the smaller radius, if that is more than `least`: with both.
    fn deepest(&self, least: f64) -> Option<(Deep, f64, f64)> {
        let radius = &self.particles.radius;
        let walls = self.walls_at_rest();
        let images = self.domain.images();
        let deep = self.contacts.deeper_than(least * self.smallest_radius(), &self.particles, images, &walls);
        let mut deepest = None;
        let mut most = least;
        for deep in deep {
            let [first, second] = deep.rows;
            let smaller = if deep.wall.is_some() { radius[first] } else { radius[first].min(radius[second]) };
            let overlap = deep.overlap / smaller;
            // NaN is no overlap that a contact can have: nothing is deeper.
            if overlap > most || overlap.is_nan() {
                (deepest, most) = (Some((deep, overlap, smaller)), overlap);
            }
        }
        deepest
    }

    fn deep_contact(&self, deep: Deep, overlap: f64, radius: f64) -> Option<DeepContact> {
        let Deep { rows: [one, other], wall, .. } = deep;
        let particles = &self.particles;
        let second = match wall {
            Some(feature) => ContactPartner::Wall(feature.wall()),
            None => ContactPartner::Particle(particles.id[other]),
        };
        Some(DeepContact {
            first: particles.id[one],
            second,
            overlap,
            radius,
            closing_speed: self.closing_speed(one, other, wall),
            contact_time: self.contact_time_of(deep.rows, wall.map(WallFeature::wall))?,
            time_step: self.time_step,
            step: self.step,
            time: self.time,
        })
    }

    fn closing_speed(&self, one: usize, other: usize, wall: Option<WallFeature>) -> f64 {
        let particles = &self.particles;
        let (centre, velocity) = (particles.position[one].vector, particles.velocity[one].vector);
        let (normal, relative) = match wall {
            Some(feature) => {
                let (wall, state) = (&self.walls[feature.wall()], &self.wall_states[feature.wall()]);
                let seen = state.now_at_rest(wall).feature(feature, centre, f64::INFINITY);
                let normal = seen.map_or(Vector3::zero(), |(surface, _)| surface.normal);
                (normal, velocity - state.velocity)
            }
            None => {
                let separation = self.domain.images().nearest(centre - particles.position[other].vector);
                let distance = separation.norm();
                let normal = if distance > 0.0 { separation * (1.0 / distance) } else { Vector3::zero() };
                (normal, velocity - particles.velocity[other].vector)
            }
        };
        -relative.dot(normal)
    }
}
