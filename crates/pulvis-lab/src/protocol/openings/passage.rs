//! What has passed an inlet or outlet.

use pulvis_core::Particle;
use pulvis_input::scenario::Amount;
use pulvis_math::Vector3;

/// Counters since the start of the run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Passage {
    /// Number of particles.
    pub(super) number: u64,
    /// Their mass [kg].
    pub(super) mass: f64,
    /// Their momentum [kg m/s].
    pub(super) momentum: Vector3,
    /// Their kinetic energy, that of rotation with it [J].
    pub(super) kinetic: f64,
    /// Mass at the start of the present stage [kg].
    pub(super) mass_before_stage: f64,
    /// Number and mass [kg] in classes of size: one more than there are radii between them.
    pub(super) classes: Vec<(u64, f64)>,
    /// The radii between classes [m].
    pub(super) bounds: Vec<f64>,
}

impl Passage {
    /// Nothing yet; `bounds` are the radii between classes of size [m].
    pub(super) fn new(bounds: &[f64]) -> Self {
        let count = if bounds.is_empty() { 0 } else { bounds.len() + 1 };
        Self {
            number: 0,
            mass: 0.0,
            momentum: Vector3::zero(),
            kinetic: 0.0,
            mass_before_stage: 0.0,
            classes: vec![(0, 0.0); count],
            bounds: bounds.to_vec(),
        }
    }

    /// A particle passes.
    pub(super) fn add(&mut self, particle: &Particle) {
        let &Particle { material: _, radius, mass, position: _, velocity, angular_velocity } = particle;
        self.number += 1;
        self.mass += mass;
        self.momentum += velocity * mass;
        // Solid spheres: I = 2/5 m a².
        let turning = 0.4 * radius * radius * angular_velocity.norm_squared();
        self.kinetic += 0.5 * mass * (velocity.norm_squared() + turning);
        let class = self.bounds.iter().filter(|bound| radius > **bound).count();
        if let Some((number, sum)) = self.classes.get_mut(class) {
            (*number, *sum) = (*number + 1, *sum + mass);
        }
    }

    /// A stage begins.
    pub(super) fn mark(&mut self) {
        self.mass_before_stage = self.mass;
    }

    /// Whether so much has passed.
    pub(super) fn holds(&self, amount: Amount) -> bool {
        match amount {
            Amount::Number(number) => self.number as f64 >= number,
            Amount::Mass(mass) => self.mass >= mass,
        }
    }

    /// The columns of an opening of this name with so many radii between classes of size.
    pub(super) fn columns(name: &str, bounds: usize) -> Vec<String> {
        let mut columns: Vec<String> =
            ["number", "mass", "flow", "energy"].map(|what| format!("{what}_{name}")).into();
        for class in 1..=if bounds == 0 { 0 } else { bounds + 1 } {
            columns.extend(["number", "mass"].map(|what| format!("{what}_{name}_class_{class}")));
        }
        columns
    }

    /// Their values, so many seconds after the start of the stage.
    pub(super) fn values(&self, elapsed: f64) -> Vec<f64> {
        let flow = if elapsed > 0.0 { (self.mass - self.mass_before_stage) / elapsed } else { f64::NAN };
        let mut values = vec![self.number as f64, self.mass, flow, self.kinetic];
        values.extend(self.classes.iter().flat_map(|(number, mass)| [*number as f64, *mass]));
        values
    }
}
