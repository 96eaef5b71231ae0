//! Which contact model rules which pair of materials.

use pulvis_contact::ContactModel;

use crate::particles::MaterialIndex;

/// A symmetric table of contact models, one for every pair of materials that can meet.
#[derive(Clone, Debug)]
pub struct Interactions {
    materials: usize,
    models: Vec<Option<ContactModel>>,
}

impl Interactions {
    /// No model yet for any pair of `materials` materials.
    pub fn new(materials: usize) -> Self {
        Self { materials, models: vec![None; materials * materials] }
    }

    /// Sets the model of a pair of materials, in either order.
    pub fn set(&mut self, one: MaterialIndex, other: MaterialIndex, model: ContactModel) {
        let place = self.group(one, other);
        self.models[place] = Some(model);
    }

    /// The model of a pair of materials.
    pub fn get(&self, one: MaterialIndex, other: MaterialIndex) -> Option<&ContactModel> {
        self.models[self.group(one, other)].as_ref()
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

    /// The largest reach of all models [m].
    pub fn reach(&self) -> f64 {
        self.models.iter().flatten().map(ContactModel::reach).fold(0.0, f64::max)
    }
}
