//! A stuck pair that turns in space as one body.

use pulvis_contact::ContactModel;
use pulvis_math::{Vector3, elementary};

use crate::bodies::{Kinematics, pair_motion};
use crate::live::{LiveContact, Springs};
use crate::parameters::pair_of;

/// A stuck pair before and after a rotation.
#[derive(Clone, Copy, Debug)]
pub struct RigidRotation {
    /// Springs before.
    pub before: Springs,
    /// Springs after, turned back by the rotation: equal to `before` for an objective contact.
    pub after: Springs,
    /// Energy of the springs before [J].
    pub energy_before: f64,
    /// Energy of the springs after [J].
    pub energy_after: f64,
    /// Booked as lost during the rotation [J].
    pub lost: f64,
}

/// Loads the springs of two unequal spheres by a small shear, roll and twist at the overlap `overlap`
/// [m], then turns the pair as one body by `angle` [rad] about `axis` in `steps` steps.
///
/// The line of centres lies along z. The springs take up about half of the overlap each, so that strong
/// friction holds them.
pub fn rigid_rotation(
    model: &ContactModel,
    overlap: f64,
    axis: Vector3,
    angle: f64,
    steps: u32,
) -> RigidRotation {
    let (radius_i, radius_j) = (1.0e-3, 0.7e-3);
    let mut contact = LiveContact::new(model, pair_of((1e-5, radius_i), Some((4e-6, radius_j))));
    let distance = radius_i + radius_j - overlap;
    let z = Vector3::new(0.0, 0.0, 1.0);
    let at = |position: Vector3, velocity: Vector3, angular_velocity: Vector3| Kinematics {
        position,
        velocity,
        velocity_mid: velocity,
        angular_velocity,
        angular_velocity_mid: angular_velocity,
    };
    let load = 0.5 * overlap;
    let time = 1.0;
    let shear = at(
        z * distance,
        Vector3::new(load / time, 0.5 * load / time, 0.0),
        Vector3::new(0.3, -0.4, 1.0) * (load / radius_i / time),
    );
    let still = at(Vector3::zero(), Vector3::zero(), Vector3::zero());
    let loaded = contact.respond(&pair_motion(radius_i, &shear, Some((radius_j, &still))), time);
    let before = contact.springs();

    let dt = time / f64::from(steps);
    let angular_velocity = axis * (angle / time);
    let turned = |step: u32, vector: Vector3| turn(axis, angle * f64::from(step) / f64::from(steps), vector);
    let (mut energies, mut lost) = (loaded.energies, 0.0);
    for step in 1..=steps {
        let (old, new) = (turned(step - 1, z * distance), turned(step, z * distance));
        let i = Kinematics {
            position: new,
            velocity: angular_velocity.cross(new),
            velocity_mid: (new - old) * (1.0 / dt),
            angular_velocity,
            angular_velocity_mid: angular_velocity,
        };
        let j = at(Vector3::zero(), Vector3::zero(), angular_velocity);
        energies = contact.respond(&pair_motion(radius_i, &i, Some((radius_j, &j))), dt).energies;
        lost += energies.dissipated_sliding + energies.dissipated_rolling + energies.dissipated_torsion;
    }
    let springs = contact.springs();
    let back = |vector: Vector3| turn(axis, -angle, vector);
    let after = Springs {
        sliding: back(springs.sliding),
        rolling: back(springs.rolling),
        bond_shear: back(springs.bond_shear),
        bond_bending: back(springs.bond_bending),
        ..springs
    };
    let energy = |e: pulvis_contact::ContactEnergies<f64>| {
        e.elastic_sliding + e.elastic_rolling + e.elastic_torsion + e.elastic_bond
    };
    RigidRotation {
        before,
        after,
        energy_before: energy(loaded.energies),
        energy_after: energy(energies),
        lost,
    }
}

/// Rodrigues' rotation.
fn turn(axis: Vector3, angle: f64, vector: Vector3) -> Vector3 {
    let (sine, cosine) = elementary::sin_cos(angle);
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
}
