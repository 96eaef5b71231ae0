//! The graph of particles that contacts join.

use pulvis_core::{ContactPartner, ContactView, Simulation};
use pulvis_input::scenario::ClusterRule;
use pulvis_math::Vector3;

/// Which particles hang together. Particles are named by their ids.
pub(in crate::protocol) struct Graph {
    groups: Groups,
    /// Number of particles in the group of each root.
    members: Vec<usize>,
    joints: Joints,
}

/// What contacts join.
#[derive(Default)]
struct Joints {
    /// Two particles, and the way from the centre of the second to that of the first [m].
    pairs: Vec<(usize, usize, Vector3)>,
    /// Particles, and the walls that they are joined to.
    at_walls: Vec<(usize, usize)>,
}

impl Joints {
    fn take_in(&mut self, contact: &ContactView<'_>) {
        let first = contact.first as usize;
        match contact.second {
            ContactPartner::Particle(other) => {
                let branch = contact.centre_first - contact.centre_second;
                self.pairs.push((first, other as usize, branch));
            }
            ContactPartner::Wall(wall) => self.at_walls.push((first, wall)),
        }
    }

    fn of(simulation: &Simulation, rule: ClusterRule) -> Self {
        let parts: Vec<Self> = match rule {
            ClusterRule::Never => Vec::new(),
            ClusterRule::Acting => simulation.gather_contacts(Self::take_in),
            ClusterRule::Bound => simulation.gather_bindings(|joints: &mut Self, contact, binding| {
                if binding.is_bound() {
                    joints.take_in(contact);
                }
            }),
        };
        let mut all = Self::default();
        for part in parts {
            all.pairs.extend(part.pairs);
            all.at_walls.extend(part.at_walls);
        }
        all
    }
}

impl Graph {
    /// The groups at the present time, by the contacts that the rule takes.
    pub(in crate::protocol) fn new(simulation: &Simulation, rule: ClusterRule) -> Self {
        let ids = simulation.particles().ids();
        let size = ids.iter().max().map_or(0, |most| *most as usize + 1);
        let mut groups = Groups::new(size);
        let joints = Joints::of(simulation, rule);
        for &(first, second, _) in &joints.pairs {
            groups.join(first, second);
        }
        let mut members = vec![0_usize; size];
        for &id in ids {
            members[groups.root(id as usize)] += 1;
        }
        Self { groups, members, joints }
    }

    /// The smallest id of the group of a particle.
    pub(in crate::protocol) fn root(&self, id: usize) -> usize {
        self.groups.root(id)
    }

    /// Number of particles in the group of a particle.
    pub(in crate::protocol) fn size_around(&self, id: usize) -> usize {
        self.members[self.root(id)]
    }

    /// Sizes of all groups, the largest first.
    pub(super) fn sizes(&self) -> Vec<usize> {
        let mut sizes: Vec<usize> = self.members.iter().copied().filter(|size| *size > 0).collect();
        sizes.sort_unstable_by(|one, other| other.cmp(one));
        sizes
    }

    /// The root of the largest group; of equal ones that with the smallest id.
    pub(super) fn largest(&self) -> Option<usize> {
        let most = self.members.iter().max().filter(|most| **most > 0)?;
        self.members.iter().position(|size| size == most)
    }

    /// Particles and the walls that they are joined to.
    pub(super) fn at_walls(&self) -> &[(usize, usize)] {
        &self.joints.at_walls
    }

    /// Where the particles of a group lie from the one with the smallest id, along contacts, so that no period cuts the group
    /// in two [m]. Ids in ascending order.
    pub(super) fn layout(&self, root: usize) -> Vec<(usize, Vector3)> {
        let mut neighbours: Vec<Vec<(usize, Vector3)>> = vec![Vec::new(); self.members.len()];
        for &(first, second, branch) in &self.joints.pairs {
            neighbours[first].push((second, Vector3::zero() - branch));
            neighbours[second].push((first, branch));
        }
        let mut found: Vec<Option<Vector3>> = vec![None; self.members.len()];
        found[root] = Some(Vector3::zero());
        let mut waiting = vec![(root, Vector3::zero())];
        while let Some((particle, at)) = waiting.pop() {
            for &(next, way) in &neighbours[particle] {
                if found[next].is_none() {
                    found[next] = Some(at + way);
                    waiting.push((next, at + way));
                }
            }
        }
        found.into_iter().enumerate().filter_map(|(id, at)| Some((id, at?))).collect()
    }
}

/// Disjoint groups of numbers. The root of a group is its smallest number.
struct Groups {
    parent: Vec<usize>,
}

impl Groups {
    /// Each number is a group of its own.
    fn new(size: usize) -> Self {
        Self { parent: (0..size).collect() }
    }

    /// The number that stands for a group.
    fn root(&self, mut member: usize) -> usize {
        while self.parent[member] != member {
            member = self.parent[member];
        }
        member
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one_root, other_root) = (self.root(one), self.root(other));
        let root = one_root.min(other_root);
        self.parent[one_root.max(other_root)] = root;
        // Shorter ways for later questions.
        for mut member in [one, other] {
            while self.parent[member] != member {
                (self.parent[member], member) = (root, self.parent[member]);
            }
        }
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
