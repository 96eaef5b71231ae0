//! Lists of candidates: when and how they are made anew.

use super::{Outcome, Simulation};
use crate::contacts::Surroundings;
use crate::neighbours::CellGrid;
use crate::particles::Load;
use crate::phases::Stopwatch;
use crate::shared::Shared;
use crate::walls::Wall;

/// The skin of the candidate list over the mean radius, in a packing and in a gas. Thicker lists are
/// renewed less often but hold more candidates that do not touch; a gas has few.
const SKIN_OF_PACKING: f64 = 0.3;
const SKIN_OF_GAS: f64 = 0.8;
/// The skin where periods leave no room for a better one.
const SKIN_OF_SHORT_PERIODS: f64 = 0.2;
/// Candidates per particle below which the one is taken for a gas, and above which it is for a packing.
const GAS: f64 = 1.0;
const PACKING: f64 = 3.0;

impl Simulation {
    /// The skin to begin with, as far as periods allow.
    pub(super) fn choose_first_skin(&mut self) {
        let count = self.particles.len().max(1) as f64;
        self.mean_radius = self.particles.radius.iter().sum::<f64>() / count;
        self.skin.thickness = SKIN_OF_PACKING * self.mean_radius;
        if self.check_periods().is_err() {
            self.skin.thickness = SKIN_OF_SHORT_PERIODS * self.mean_radius;
        }
    }

    pub(super) fn renew_candidates(&mut self) {
        let mut clock = Stopwatch::start(self.phases.is_some());
        self.phases = self.phases();
        self.choose_skin();
        self.contacts.remember(&mut self.memory, &self.team);
        self.rebuild();
        self.rebuilds += 1;
        if let Some(phases) = &mut self.phases {
            clock.lap(&mut phases.neighbours);
        }
    }

    /// Takes the skin that suits the number of candidates in the present list, as far as periods allow.
    /// Answers whether it is another one.
    pub(super) fn choose_skin(&mut self) -> bool {
        if !self.chooses_skin {
            return false;
        }
        let candidates = self.candidates() as f64 / self.particles.len().max(1) as f64;
        let suited = if candidates < GAS {
            SKIN_OF_GAS
        } else if candidates > PACKING {
            SKIN_OF_PACKING
        } else {
            return false;
        };
        let before = std::mem::replace(&mut self.skin.thickness, suited * self.mean_radius);
        if self.check_periods().is_err() {
            self.skin.thickness = before;
        }
        before.to_bits() != self.skin.thickness.to_bits()
    }

    /// Brings all positions back into the periodic box.
    fn wrap(&mut self) {
        let (domain, gravity) = (&self.domain, self.background.gravity);
        let masses = &self.particles.mass;
        let places = Shared::new(&mut self.particles.place);
        let [fallen] = self.team.sum_over(masses.len(), |rows| {
            // SAFETY: stretches have different rows.
            let places = unsafe { places.range_mut(rows.clone()) };
            let mut fallen = 0.0;
            for (place, mass) in places.iter_mut().zip(&masses[rows]) {
                let wrapped = domain.wrapped(place.vector);
                // Falling through a periodic boundary is falling on: the potential must not jump.
                fallen += mass * gravity.dot(wrapped - place.vector);
                place.vector = wrapped;
            }
            [fallen]
        });
        self.running.gravity_wrapped += fallen;
    }

    /// Puts the particles into cell order and lists all candidates within reach and skin.
    pub(super) fn rebuild(&mut self) {
        self.wrap();
        let margin = self.interactions.reach() + self.skin.thickness;
        let (grid, order) = CellGrid::sort(&self.domain, &self.particles.place, margin);
        self.particles.reorder(&order, &self.team);
        let around = Surroundings {
            particles: &self.particles,
            order: &order,
            materials: &self.materials,
            interactions: &self.interactions,
            walls: &self.walls,
            images: self.domain.images(),
            skin: self.skin.thickness,
            instructions: self.instructions,
        };
        let places = self.contacts.rebuild(&around, &grid, &self.memory, &self.team);
        self.particles.loads.resize(places, Load::default());
        self.outcomes.clear();
        self.outcomes.resize(self.contacts.pieces().len(), Outcome::default());
        self.skin.renew(&self.particles.place, self.walls.iter().map(Wall::offset));
    }
}
