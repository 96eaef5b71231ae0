//! What is coarse-grained: particles and contacts at one instant.

use std::f64::consts::PI;

use pulvis_boundary::Domain;
use pulvis_input::scenario::Scenario;
use pulvis_io::vtk::{Frame, Numbers};
use pulvis_math::Vector3;

use super::AnalysisError;

/// Particles and contacts at one instant.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Time \[s\].
    pub time: f64,
    /// The periodic domain.
    pub domain: Domain,
    pub(super) particles: Vec<Grain>,
    pub(super) contacts: Vec<Link>,
}

/// A particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grain {
    pub(super) position: Vector3,
    pub(super) velocity: Vector3,
    pub(super) radius: f64,
    pub(super) mass: f64,
    /// Σ n ⊗ n over its touching contacts, symmetric: xx, yy, zz, xy, xz, yz.
    pub(super) fabric: [f64; 6],
}

/// A contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Centre of the first body, and of the second one next to it; of a wall the nearest point of its surface \[m\].
    pub(super) ends: [Vector3; 2],
    /// Force on the first body \[N\].
    pub(super) force: Vector3,
    pub(super) at_wall: bool,
}

impl Grain {
    /// Volume \[m³\].
    pub(super) fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius * self.radius * self.radius
    }
}

impl Sample {
    /// What a frame of a run holds. Masses follow from radii and the densities of the materials.
    ///
    /// # Errors
    /// The frame lacks a column that is needed.
    pub fn of_frame(
        scenario: &Scenario,
        domain: Domain,
        time: f64,
        frame: &Frame,
    ) -> Result<Self, AnalysisError> {
        let particles = grains(scenario, frame)?;
        let mut sample = Self { time, domain, particles, contacts: Vec::new() };
        sample.add_contacts(frame)?;
        Ok(sample)
    }

    fn add_contacts(&mut self, frame: &Frame) -> Result<(), AnalysisError> {
        let contacts = &frame.contacts;
        if contacts.points.is_empty() {
            return Ok(());
        }
        let whole = |name: &'static str| match contacts.column(name) {
            Some(Numbers::Integer(values)) => Ok(values),
            _ => Err(AnalysisError::Column { block: "contacts", column: name }),
        };
        let Some(Numbers::Vector(forces)) = contacts.column("force") else {
            return Err(AnalysisError::Column { block: "contacts", column: "force" });
        };
        let (first, second) = (whole("id1")?, whole("id2")?);
        let overlaps = contacts
            .scalar("overlap")
            .ok_or(AnalysisError::Column { block: "contacts", column: "overlap" })?;
        let Some(Numbers::Integer(ids)) = frame.particles.column("id") else {
            return Err(AnalysisError::Column { block: "particles", column: "id" });
        };
        // Frames are in the order of the ids.
        let place = |id: i64| ids.binary_search(&id).ok();
        for (number, ends) in contacts.lines().into_iter().enumerate() {
            let ends = ends.map(Vector3::from);
            let branch = ends[0] - ends[1];
            let normal = branch * (1.0 / branch.norm());
            if overlaps[number] > 0.0 {
                for grain in [first[number], second[number]].into_iter().filter_map(place) {
                    let [x, y, z] = normal.to_array();
                    let outer = [x * x, y * y, z * z, x * y, x * z, y * z];
                    self.particles[grain].fabric.iter_mut().zip(outer).for_each(|(sum, part)| *sum += part);
                }
            }
            let at_wall = second[number] < 0;
            self.contacts.push(Link { ends, force: forces[number].into(), at_wall });
        }
        Ok(())
    }

    /// Σ m over all particles \[kg\].
    pub fn total_mass(&self) -> f64 {
        self.particles.iter().map(|grain| grain.mass).sum()
    }

    /// Σ f ⊗ b over all contacts \[J\]: the stress of observers times its volume, row by row.
    pub fn total_virial(&self) -> [f64; 9] {
        let mut sum = [0.0; 9];
        for link in &self.contacts {
            let branch = link.ends[0] - link.ends[1];
            for (part, sum) in sum.iter_mut().enumerate() {
                *sum += link.force[part / 3] * branch[part % 3];
            }
        }
        sum
    }
}

fn grains(scenario: &Scenario, frame: &Frame) -> Result<Vec<Grain>, AnalysisError> {
    let data = &frame.particles;
    let missing = |column| AnalysisError::Column { block: "particles", column };
    let radii = data.scalar("radius").ok_or(missing("radius"))?;
    let Some(Numbers::Integer(materials)) = data.column("type") else { return Err(missing("type")) };
    let Some(Numbers::Vector(velocities)) = data.column("v") else { return Err(missing("v")) };
    let density = |material: i64| {
        let found = usize::try_from(material).ok().and_then(|index| scenario.materials.get(index));
        found.and_then(|material| material.density).ok_or(missing("type"))
    };
    let grain = |(row, position): (usize, &[f64; 3])| {
        let mut grain = Grain {
            position: (*position).into(),
            velocity: velocities[row].into(),
            radius: radii[row],
            mass: 0.0,
            fabric: [0.0; 6],
        };
        grain.mass = density(materials[row])? * grain.volume();
        Ok(grain)
    };
    data.points.iter().enumerate().map(grain).collect()
}
