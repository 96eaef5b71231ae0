//! Contacts as a settled bed has them, without the bed.

use std::f64::consts::TAU;

use pulvis_contact::{ContactEnergies, ContactKinematics, ContactModel};
use pulvis_math::{Real, Vector3, elementary};

/// Contacts in all: what they need stays in the first-level cache.
const COUNT: usize = 64;

/// Constants and motions of the contacts, in columns of `S`: numbers, or eight numbers each. The motions
/// come twice, so that contacts load and unload.
pub(super) struct Contacts<S> {
    /// One over the masses of i and j [1/kg] and over their radii [1/m].
    pub(super) inverses: Vec<[S; 4]>,
    pub(super) motions: [Vec<ContactKinematics<S>>; 2],
}

/// What the sweeps write.
pub(super) struct Store<S> {
    /// Contact memory: its columns of one group of contacts after those of the other.
    pub(super) memory: Vec<S>,
    /// Force [N], torque on i and torque on j [N m].
    pub(super) forces_and_torques: Vec<[Vector3<S>; 3]>,
    pub(super) energies: ContactEnergies,
}

impl<S: Real> Contacts<S> {
    /// The same contacts whatever `S` is.
    pub(super) fn new() -> Self {
        let groups = COUNT / S::LANES;
        let spread =
            |group: usize, value: &dyn Fn(usize) -> f64| S::from_fn(|lane| value(group * S::LANES + lane));
        let inverses = |group: usize| {
            [
                spread(group, &|contact| 1.0 / mass(radius(2 * contact))),
                spread(group, &|contact| 1.0 / mass(radius(2 * contact + 1))),
                spread(group, &|contact| 1.0 / radius(2 * contact)),
                spread(group, &|contact| 1.0 / radius(2 * contact + 1)),
            ]
        };
        let motion = |group: usize, turn: usize| {
            let vector = |value: fn(usize, usize, usize) -> f64| {
                let along = |axis: usize| spread(group, &|contact| value(contact, turn, axis));
                Vector3::new(along(0), along(1), along(2))
            };
            ContactKinematics {
                normal: vector(|contact, turn, axis| normal(contact, turn)[axis]),
                overlap: spread(group, &|contact| overlap(contact, turn)),
                inverse_distance: spread(group, &|contact| {
                    1.0 / (radius(2 * contact) + radius(2 * contact + 1) - overlap(contact, turn))
                }),
                normal_rate: None,
                radius_i: spread(group, &|contact| radius(2 * contact)),
                radius_j: spread(group, &|contact| radius(2 * contact + 1)),
                velocity: vector(|contact, turn, axis| velocity(5 * contact, turn, axis)),
                velocity_mid: vector(|contact, turn, axis| velocity(5 * contact, turn, axis)),
                angular_velocity_i: vector(|contact, turn, axis| 2e3 * velocity(5 * contact + 1, turn, axis)),
                angular_velocity_j: vector(|contact, turn, axis| 2e3 * velocity(5 * contact + 2, turn, axis)),
                angular_velocity_i_mid: vector(|contact, turn, axis| {
                    2e3 * velocity(5 * contact + 1, turn, axis)
                }),
                angular_velocity_j_mid: vector(|contact, turn, axis| {
                    2e3 * velocity(5 * contact + 2, turn, axis)
                }),
            }
        };
        Self {
            inverses: (0..groups).map(inverses).collect(),
            motions: [0, 1].map(|turn| (0..groups).map(|group| motion(group, turn)).collect()),
        }
    }

    /// Number of contacts.
    pub(super) fn count(&self) -> usize {
        self.inverses.len() * S::LANES
    }
}

impl<S: Real> Store<S> {
    /// Virgin contacts.
    pub(super) fn new(contacts: &Contacts<S>, model: &ContactModel) -> Self {
        let groups = contacts.inverses.len();
        let columns = model.memory_layout().columns();
        Self {
            memory: vec![S::zero(); groups * columns],
            forces_and_torques: vec![Default::default(); groups],
            energies: ContactEnergies::default(),
        }
    }
}

/// Numbers between −1 and 1 that follow no pattern.
fn noise(seed: usize) -> f64 {
    elementary::sin(1e4 * elementary::sin(1.0 + seed as f64))
}

/// 0.5 mm ± 20 %.
fn radius(body: usize) -> f64 {
    0.5e-3 * (1.0 + 0.2 * noise(body))
}

fn mass(radius: f64) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * 2500.0 * elementary::powi(radius, 3)
}

/// Up to 1 % of the diameter, 10 % less in every other sweep: contacts load and unload.
fn overlap(contact: usize, turn: usize) -> f64 {
    5e-6 * (1.1 + noise(1000 + contact)) * (1.0 - 0.1 * turn as f64)
}

/// Some mm/s, forth and back.
fn velocity(seed: usize, turn: usize, axis: usize) -> f64 {
    5e-3 * noise(2000 + 3 * seed + axis) * (1.0 - 2.0 * turn as f64)
}

/// Turning by what such velocities turn it within a step: springs have to follow.
fn normal(contact: usize, turn: usize) -> [f64; 3] {
    let (height, angle) = (noise(5000 + contact), TAU * noise(6000 + contact) + 2e-5 * turn as f64);
    let radius = (1.0 - height * height).sqrt();
    [radius * elementary::cos(angle), radius * elementary::sin(angle), height]
}
