//! The bodies and bonds of these tests.

use pulvis_contact::catalogue::Values;
use pulvis_contact::{Bond, ContactKinematics, ContactModel, Linear, Normal, bond};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};

pub const X: Vector3 = Vector3::new(1.0, 0.0, 0.0);
pub const Y: Vector3 = Vector3::new(0.0, 1.0, 0.0);
pub const Z: Vector3 = Vector3::new(0.0, 0.0, 1.0);
/// Masses of two spheres with the reduced mass 1e-6 kg.
pub const MASS: f64 = 2e-6;
pub const RADIUS: f64 = 1e-3;

pub fn values(numbers: &[(&str, f64)]) -> Values {
    numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number))
}

pub fn bond_of(name: &str, numbers: &[(&str, f64)]) -> Bond {
    bond::build(name, &values(numbers)).unwrap().unwrap().unwrap()
}

/// A bond beside a contact that is hardly felt.
pub fn alone(bond: Bond) -> ContactModel {
    beside(bond, Linear::new(f64::MIN_POSITIVE, 0.0))
}

pub fn beside(bond: Bond, normal: impl Into<Normal>) -> ContactModel {
    let mut model = ContactModel::frictionless(normal);
    model.laws.bond = Some(bond);
    model
}

/// Two spheres that touch, one above the other, bonded from the start.
pub fn couple(model: &ContactModel, velocity: Vector3, angular_velocity: Vector3) -> Couple {
    let mut first = Sphere::at_rest(MASS, RADIUS, Z * (2.0 * RADIUS));
    (first.velocity, first.angular_velocity) = (velocity, angular_velocity);
    let mut second = Sphere::at_rest(MASS, RADIUS, Vector3::zero());
    second.angular_velocity = -angular_velocity;
    Couple::new(model, first, Some(second))
}

pub const STIFFNESS: f64 = 1e3;
pub const STRENGTH: f64 = 1e-3;

/// The bond of contact-laws 10.5.
pub fn published() -> Bond {
    bond_of("elastic-brittle", &[("normal_stiffness", STIFFNESS), ("tensile_strength", STRENGTH)])
}

pub fn at_rest(overlap: f64) -> ContactKinematics<f64> {
    let zero = Vector3::zero();
    ContactKinematics {
        normal: X,
        overlap,
        inverse_distance: 0.0,
        normal_rate: None,
        radius_i: RADIUS,
        radius_j: RADIUS,
        velocity: zero,
        velocity_mid: zero,
        angular_velocity_i: zero,
        angular_velocity_j: zero,
        angular_velocity_i_mid: zero,
        angular_velocity_j_mid: zero,
    }
}

/// A bond of all modes that does not break.
pub fn strong() -> [(&'static str, f64); 5] {
    [
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 5e2),
        ("bending_stiffness", 2e-4),
        ("torsion_stiffness", 1e-4),
        ("tensile_strength", 1e9),
    ]
}
