//! Which contact model rules which pair of materials.

use pulvis_contact::{ContactModel, Pair};

use crate::particles::MaterialIndex;

/// A symmetric table of contact models, one for every pair of materials that can meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Interactions {
    materials: usize,
    models: Vec<Option<ContactModel>>,
    /// How far beyond touching the contacts of each group act [m], between the largest bodies that there are.
    ranges: Vec<f64>,
}

impl Interactions {
    /// No model yet for any pair of `materials` materials.
    pub fn new(materials: usize) -> Self {
        Self {
            materials,
            models: vec![None; materials * materials],
            ranges: vec![0.0; materials * materials],
        }
    }

    /// Sets the model of a pair of materials, in either order; the table grows where it must.
    pub fn set(&mut self, one: MaterialIndex, other: MaterialIndex, model: ContactModel) {
        let needed = usize::from(one.max(other)) + 1;
        if needed > self.materials {
            let mut grown = Self::new(needed);
            for (index, known) in self.models.iter().enumerate() {
                let moved = index / self.materials * needed + index % self.materials;
                (grown.models[moved], grown.ranges[moved]) = (*known, self.ranges[index]);
            }
            *self = grown;
        }
        let index = self.group(one, other);
        self.models[index] = Some(model);
    }

    /// The model of a pair of materials, if there is one.
    pub fn get(&self, one: MaterialIndex, other: MaterialIndex) -> Option<&ContactModel> {
        // Beyond the table, the index would be that of another pair.
        let listed = usize::from(one.max(other)) < self.materials;
        if listed { self.models[self.group(one, other)].as_ref() } else { None }
    }

    /// How many groups of pairs there can be.
    pub(crate) fn groups(&self) -> usize {
        self.models.len()
    }

    /// The group of a pair of materials, the same in either order.
    #[inline(always)]
    pub(crate) fn group(&self, one: MaterialIndex, other: MaterialIndex) -> usize {
        let (low, high) = if one <= other { (one, other) } else { (other, one) };
        usize::from(low) * self.materials + usize::from(high)
    }

    /// The model of a group.
    pub(crate) fn model(&self, group: usize) -> Option<&ContactModel> {
        self.models[group].as_ref()
    }

    /// All models.
    pub(crate) fn models(&self) -> impl Iterator<Item = &ContactModel> {
        self.models.iter().flatten()
    }

    /// Takes in the largest radius of the particles of each material [m], on which the range of some laws depends; a
    /// material without particles is one of walls.
    pub(crate) fn fit(&mut self, largest_radii: &[(MaterialIndex, f64)]) {
        let radius = |material: usize| {
            largest_radii.iter().find(|(known, _)| usize::from(*known) == material).map(|(_, radius)| *radius)
        };
        for (group, model) in self.models.iter().enumerate() {
            let Some(model) = model else { continue };
            let (one, other) = (radius(group / self.materials), radius(group % self.materials));
            let between = one.zip(other).map(|(one, other)| Pair::spheres(1.0, 1.0, one, other));
            // Either material may be that of a wall, at which the effective radius is largest.
            let at_walls = [one, other].into_iter().flatten().map(|radius| Pair::wall(1.0, radius));
            let ranges = at_walls.chain(between).map(|pair| model.interaction_range(&pair));
            self.ranges[group] = ranges.fold(0.0, f64::max);
        }
    }

    /// How far beyond touching the contacts of a group act [m].
    pub(crate) fn range(&self, group: usize) -> f64 {
        self.ranges[group]
    }

    /// The longest range of all groups [m].
    pub(crate) fn longest_range(&self) -> f64 {
        self.ranges.iter().copied().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_contact::Linear;

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
}
