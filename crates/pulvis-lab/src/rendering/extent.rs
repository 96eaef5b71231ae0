//! What pictures of a sequence have in common: the box that they show, the ends of their colour bar, the thickest tube.

use std::collections::BTreeSet;

use pulvis_io::picture::Scene;
use pulvis_io::vtk::Frame;

use super::drawing::{Walls, radii};
use super::error::RenderError;
use super::plan::{Paints, Plan};
use super::quantity::{Contacts, Quantity};
use super::view::Direction;

/// Tubes of this share of all contacts, the strongest, are equally thick: a single peak would make all others hairs.
const STRONGEST: f64 = 0.01;

/// What frames have in common.
#[derive(Clone, Debug)]
pub(super) struct Extent {
    /// The box around all that is shown without clips \[m\].
    pub(super) limits: Option<[[f64; 3]; 2]>,
    /// Least and largest finite value, of particles or of contacts.
    pub(super) values: [f64; 2],
    /// The force of the thickest tube \[N\].
    pub(super) force: f64,
    /// Numbers of the materials that particles have.
    pub(super) materials: BTreeSet<usize>,
}

impl Extent {
    pub(super) fn of(frame: &Frame, plan: &Plan, paints: &Paints) -> Result<Self, RenderError> {
        let radii = radii(frame)?;
        let walls = Walls::of(frame);
        let scene = Scene {
            edges: &walls.edges,
            cylinders: &walls.cylinders,
            ..Scene::new(&frame.particles.points, &radii, &[])
        };
        let direction = Direction::of(plan.view.0);
        let of_particles = |quantity: &Quantity| quantity.values(frame, direction);
        let mut forces = Vec::new();
        if plan.contacts {
            forces = Contacts::of(frame)?.iter().map(|contact| contact.normal_force).collect();
        }
        let force = strong(&forces);
        let values = match paints {
            Paints::Particles(quantity) => of_particles(quantity)?,
            // The bar ends where the tubes grow no thicker.
            Paints::Forces => forces.iter().map(|value| value.clamp(-force, force)).collect(),
        };
        let values = values.into_iter().filter(|value| value.is_finite());
        let values = values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        let materials = of_particles(&Quantity::Material)?.into_iter().map(|kind| kind.max(0.0) as usize);
        Ok(Self { limits: scene.shown_limits(), values, force, materials: materials.collect() })
    }

    /// What both have in common.
    pub(super) fn and(self, other: Self) -> Self {
        let limits = match (self.limits, other.limits) {
            (Some([low, high]), Some([other_low, other_high])) => Some([
                std::array::from_fn(|axis| low[axis].min(other_low[axis])),
                std::array::from_fn(|axis| high[axis].max(other_high[axis])),
            ]),
            (one, other) => one.or(other),
        };
        let values = [self.values[0].min(other.values[0]), self.values[1].max(other.values[1])];
        let mut materials = self.materials;
        materials.extend(other.materials);
        Self { limits, values, force: self.force.max(other.force), materials }
    }

    /// Ends of the colour bar; `None` where a single value or none has to be shown.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        (self.values[0] < self.values[1]).then_some(self.values)
    }
}

/// A force that few contacts exceed.
fn strong(forces: &[f64]) -> f64 {
    let mut sizes: Vec<f64> =
        forces.iter().map(|force| force.abs()).filter(|force| force.is_finite() && *force > 0.0).collect();
    sizes.sort_by(f64::total_cmp);
    let below = ((1.0 - STRONGEST) * sizes.len() as f64) as usize;
    sizes.get(below.min(sizes.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_contacts_are_stronger_than_strong() {
        assert_eq!(strong(&[]), 0.0);
        assert_eq!(strong(&[0.0, -3.0]), 3.0);
        let forces: Vec<f64> = (1..=1000).map(f64::from).collect();
        assert_eq!(strong(&forces), 991.0);
    }
}
