//! Which particles hang together by contacts.

use pulvis_core::{ContactPartner, Simulation};
use pulvis_input::scenario::Scenario;

use super::fracture::{Sphere, roughness as rough};
use super::setup::box_walls;
use std::collections::BTreeSet;

/// Groups of particles that are joined by contacts. Walls join nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Clusters {
    /// Number of groups; a particle without a contact is one of its own.
    pub count: usize,
    /// Particles of the largest group.
    pub largest: usize,
    /// Whether one group touches both box walls of an axis; `None` where one of them is missing.
    pub spans: [Option<bool>; 3],
    /// How rough the surfaces are along which a sample has parted along an axis, the mean of both [m]: those of the groups that
    /// touch the low and the high wall of the box.
    pub roughness: [Option<f64>; 3],
}

/// The clusters at the present time: contacts that act now join.
pub(super) fn clusters(scenario: &Scenario, simulation: &Simulation) -> Clusters {
    let ids = simulation.particles().ids();
    let size = ids.iter().max().map_or(0, |most| *most as usize + 1);
    let mut groups = Groups::new(size);
    let mut at_walls: Vec<(usize, usize)> = Vec::new();
    let gathered = simulation.gather_contacts(|pairs: &mut Vec<(usize, ContactPartner)>, contact| {
        pairs.push((contact.first as usize, contact.second));
    });
    for (first, second) in gathered.into_iter().flatten() {
        match second {
            ContactPartner::Particle(other) => groups.join(first, other as usize),
            ContactPartner::Wall(wall) => at_walls.push((first, wall)),
        }
    }
    let mut members = vec![0_usize; size];
    for &id in ids {
        members[groups.root(id as usize)] += 1;
    }
    let mut touching = |wall: usize| {
        let own = at_walls.iter().filter(|(_, touched)| *touched == wall);
        own.map(|(particle, _)| groups.root(*particle)).collect::<BTreeSet<usize>>()
    };
    let ends = [0, 1, 2].map(|axis| match box_walls(scenario, axis) {
        [Some(low), Some(high)] if [low, high].iter().all(|wall| simulation.walls()[*wall].present) => {
            Some([touching(low), touching(high)])
        }
        _ => None,
    });
    let mut roughness = [None; 3];
    for (axis, ends) in ends.iter().enumerate() {
        let Some([low, high]) = ends else { continue };
        if low.is_disjoint(high) {
            let surfaces = [(low, 1.0), (high, -1.0)].map(|(piece, outward)| {
                rough(&spheres(simulation, |id| piece.contains(&groups.root(id))), axis, outward)
            });
            roughness[axis] = surfaces[0].zip(surfaces[1]).map(|(low, high)| 0.5 * (low + high));
        }
    }
    Clusters {
        count: members.iter().filter(|members| **members > 0).count(),
        largest: members.iter().copied().max().unwrap_or(0),
        spans: ends.map(|ends| ends.map(|[low, high]| !low.is_disjoint(&high))),
        roughness,
    }
}

/// The particles that are wanted.
fn spheres(simulation: &Simulation, mut wanted: impl FnMut(usize) -> bool) -> Vec<Sphere> {
    let particles = simulation.particles();
    let all = particles.ids().iter().zip(particles.positions().iter()).zip(particles.radii());
    all.filter(|((id, _), _)| wanted(**id as usize))
        .map(|((_, centre), radius)| (centre.to_array(), *radius))
        .collect()
}

/// Disjoint groups of numbers.
struct Groups {
    parent: Vec<usize>,
}

impl Groups {
    /// Each number is a group of its own.
    fn new(size: usize) -> Self {
        Self { parent: (0..size).collect() }
    }

    /// The number that stands for a group; ways to it become shorter with each question.
    fn root(&mut self, mut member: usize) -> usize {
        while self.parent[member] != member {
            self.parent[member] = self.parent[self.parent[member]];
            member = self.parent[member];
        }
        member
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.parent[one.max(other)] = one.min(other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_that_are_joined_have_one_root() {
        let mut groups = Groups::new(6);
        for (one, other) in [(4, 5), (1, 0), (5, 1), (4, 0)] {
            groups.join(one, other);
        }
        assert_eq!([0, 1, 2, 3, 4, 5].map(|member| groups.root(member)), [0, 0, 2, 3, 0, 0]);
    }
}
