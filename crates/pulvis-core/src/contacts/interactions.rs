//! The contact model of each pair of materials.

use pulvis_boundary::{Electrostatics, MOST_HOLLOW};
use pulvis_contact::{ContactModel, Pair, Sizes};
use pulvis_math::max_or_nan;

use crate::particles::MaterialIndex;

/// A symmetric table of contact models, one for every pair of materials that can meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Interactions {
    materials: usize,
    models: Vec<Option<ContactModel>>,
    /// The medium through which charges act over all distances, if they do.
    electrostatics: Option<Electrostatics>,
    /// The pairs of materials that can meet among the present particles and walls.
    groups: Vec<Group>,
    /// The group of each pair of materials.
    group_of: Vec<u32>,
}

/// A pair of materials that can meet.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Group {
    /// Its index in the table of models.
    pair: usize,
    /// How far beyond touching its contacts act [m], for the largest present bodies.
    range: f64,
}

/// The group of materials that never meet.
const NO_GROUP: u32 = u32::MAX;

impl Interactions {
    /// No model yet for any pair of `materials` materials.
    pub fn new(materials: usize) -> Self {
        Self {
            materials,
            models: vec![None; materials * materials],
            electrostatics: None,
            groups: Vec::new(),
            group_of: vec![NO_GROUP; materials * materials],
        }
    }

    /// Sets the model of a pair of materials, in either order; the table grows where it must.
    pub fn set(&mut self, one: MaterialIndex, other: MaterialIndex, model: ContactModel) {
        let needed = usize::from(one.max(other)) + 1;
        if needed > self.materials {
            let mut grown = Self { electrostatics: self.electrostatics, ..Self::new(needed) };
            for (index, known) in self.models.iter().enumerate() {
                grown.models[index / self.materials * needed + index % self.materials] = *known;
            }
            *self = grown;
        }
        let index = self.pair(one, other);
        self.models[index] = Some(model);
    }

    /// The model of a pair of materials, if there is one.
    pub fn get(&self, one: MaterialIndex, other: MaterialIndex) -> Option<&ContactModel> {
        // Outside the table, the index would be that of another pair.
        let listed = usize::from(one.max(other)) < self.materials;
        if listed { self.models[self.pair(one, other)].as_ref() } else { None }
    }

    /// Lets all charges (the quantity `charge` of the particles [C]) act on each other over all distances, with q_i q_j/(4 π ε_0
    /// ε_r r²) from centre to centre; `None`: they do not. In open space only, and not beside contact laws that read charges.
    pub fn set_electrostatics(&mut self, electrostatics: Option<Electrostatics>) {
        self.electrostatics = electrostatics;
    }

    /// The medium through which charges act over all distances, if they do.
    pub fn electrostatics(&self) -> Option<&Electrostatics> {
        self.electrostatics.as_ref()
    }

    /// Number of groups. Pairs of materials that no present body has are not among them.
    pub(crate) fn groups(&self) -> usize {
        self.groups.len()
    }

    /// The group of a pair of present materials, the same in either order.
    #[inline(always)]
    pub(crate) fn group(&self, one: MaterialIndex, other: MaterialIndex) -> usize {
        self.group_of[self.pair(one, other)] as usize
    }

    /// The index of a pair of materials in the table of models, the same in either order.
    #[inline(always)]
    fn pair(&self, one: MaterialIndex, other: MaterialIndex) -> usize {
        let (low, high) = if one <= other { (one, other) } else { (other, one) };
        usize::from(low) * self.materials + usize::from(high)
    }

    /// The model of a group.
    pub(crate) fn model(&self, group: usize) -> Option<&ContactModel> {
        self.models[self.groups[group].pair].as_ref()
    }

    /// All models.
    pub(crate) fn models(&self) -> impl Iterator<Item = &ContactModel> {
        self.models.iter().flatten()
    }

    /// Sets the present materials: those of particles, with the largest radius of each [m], and those of walls, with the
    /// least mean curvature of each wall [1/m]. `sizes` are those of the particles' quantities by name.
    pub(crate) fn fit(
        &mut self,
        largest_radii: &[(MaterialIndex, f64)],
        walls: &[(MaterialIndex, f64)],
        sizes: impl Fn(&str) -> Sizes,
    ) {
        let radius = |material: usize| {
            largest_radii.iter().find(|(known, _)| usize::from(*known) == material).map(|(_, radius)| *radius)
        };
        let of_wall = |material: usize| walls.iter().any(|(known, _)| usize::from(*known) == material);
        // A plane where nothing is hollow.
        let least_curvature = |pair: [usize; 2]| {
            let of_pair = walls.iter().filter(|(known, _)| pair.contains(&usize::from(*known)));
            of_pair.map(|(_, curvature)| *curvature).fold(0.0, f64::min)
        };
        let there: Vec<usize> =
            (0..self.materials).filter(|&material| radius(material).is_some() || of_wall(material)).collect();
        self.groups.clear();
        self.group_of.fill(NO_GROUP);
        for (index, &low) in there.iter().enumerate() {
            for &high in &there[index..] {
                let radii = [radius(low), radius(high)];
                if radii == [None, None] {
                    continue;
                }
                let pair = low * self.materials + high;
                self.group_of[pair] = self.groups.len() as u32;
                let curvature = least_curvature([low, high]);
                let range = self.models[pair]
                    .map_or(0.0, |model| longest_range(&model.bounded_by(&sizes), radii, curvature));
                self.groups.push(Group { pair, range });
            }
        }
    }

    /// How far beyond touching the contacts of a group act [m].
    pub(crate) fn range(&self, group: usize) -> f64 {
        self.groups[group].range
    }

    /// The longest range of all groups [m].
    pub(crate) fn longest_range(&self) -> f64 {
        self.groups.iter().map(|group| group.range).fold(0.0, max_or_nan)
    }
}

/// How far beyond touching a model acts [m] between bodies of two materials with these largest radii [m], `None` for
/// walls alone. Either material may be that of a wall, too, at which the effective radius is largest: where the mean
/// curvature [1/m] is least.
fn longest_range(model: &ContactModel, [one, other]: [Option<f64>; 2], curvature: f64) -> f64 {
    let between = one.zip(other).map(|(one, other)| (Pair::spheres(1.0, 1.0, one, other), [one, other]));
    let at_walls = [one, other].into_iter().flatten();
    let at_walls = at_walls.map(|radius| {
        let curvature = curvature.max(-MOST_HOLLOW / radius);
        (Pair::from_sums(1.0, 1.0 / radius + curvature), [radius, 0.0])
    });
    at_walls.chain(between).map(|(pair, radii)| model.interaction_range(&pair, radii)).fold(0.0, max_or_nan)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_contact::{Jkr, Linear};
    use pulvis_math::elementary;

    use super::*;

    fn model(stiffness: f64) -> ContactModel {
        ContactModel::frictionless(Linear::new(stiffness, 0.0))
    }

    #[test]
    fn materials_beyond_the_table_have_no_model_and_do_not_borrow_that_of_others() {
        let mut interactions = Interactions::new(3);
        interactions.set(1, 2, model(1.0));
        assert_eq!(interactions.get(0, 5), None);
        assert_eq!(interactions.get(9, 9), None);
        interactions.set(0, 5, model(2.0));
        assert_eq!(interactions.get(5, 0), Some(&model(2.0)));
        assert_eq!(interactions.get(2, 1), Some(&model(1.0)));
        assert_eq!(interactions.get(0, 0), None);
    }

    #[test]
    fn adhesion_reaches_farther_from_hollow_walls_and_no_nearer_than_from_planes() {
        let mut interactions = Interactions::new(2);
        interactions.set(0, 1, ContactModel::frictionless(Jkr::new(1e7, 0.1)));
        let mut range = |curvatures: &[f64]| {
            let walls: Vec<(MaterialIndex, f64)> =
                curvatures.iter().map(|&curvature| (1, curvature)).collect();
            interactions.fit(&[(0, 1e-3)], &walls, |_| std::iter::empty().collect());
            interactions.range(interactions.group(0, 1))
        };
        let plane = range(&[0.0]);
        assert!(plane > 0.0);
        // JKR contacts end at a distance that grows with the cubic root of the effective radius, here 1/(1 − 0.2) times
        // that at a plane.
        let drum = range(&[0.0, -200.0]);
        assert!((drum / plane - elementary::cbrt(1.0 / 0.8)).abs() < 1e-14, "{drum} {plane}");
        assert_eq!(range(&[400.0, 0.0]), plane);
    }
}
