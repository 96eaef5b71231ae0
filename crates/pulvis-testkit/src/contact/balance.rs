//! The energy balance of a whole contact along a smooth motion.

use pulvis_contact::{ContactEnergies, ContactModel};

use super::Dance;
use crate::bodies::{Kinematics, pair_motion};
use crate::live::LiveContact;

/// Closing error of the energy balance of `model` along `dance`, once for each number of steps: the
/// largest part of the work done on the contact that is neither stored nor lost, over all the energy
/// that was turned over (work, what dashpots take, and the largest store).
///
/// The balance starts with the first answer, in contact: the jump of a dashpot at touch belongs to the
/// time integration and not to the law.
pub fn closing_errors<const N: usize>(model: &ContactModel, dance: &Dance, steps: [usize; N]) -> [f64; N] {
    steps.map(|count| balance(model, dance, count).missing)
}

/// The largest amount by which what `model` stores along `dance` exceeds the work that was done on it until then, over
/// all the energy that was turned over, once for each number of steps.
pub fn deficits<const N: usize>(model: &ContactModel, dance: &Dance, steps: [usize; N]) -> [f64; N] {
    steps.map(|count| balance(model, dance, count).deficit)
}

/// Parts of the energy that was turned over.
struct Balance {
    missing: f64,
    deficit: f64,
}

fn balance(model: &ContactModel, dance: &Dance, count: usize) -> Balance {
    let mut contact = LiveContact::new(model, dance.pair);
    let dt = dance.duration / count as f64;
    let mut before: Option<(Work, ContactEnergies<f64>)> = None;
    let (mut work, mut turned_over, mut lost, mut start) = (0.0, 0.0, 0.0, 0.0);
    let (mut worst, mut deficit, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for step in 0..=count {
        let [i, j] = dance.step(step, count);
        // The first answer is a look at the contact, as an engine takes it before its first step.
        let elapsed = if step == 0 { 0.0 } else { dt };
        let answer = contact.respond(&pair_motion(dance.radius_i, &i, Some((dance.radius_j, &j))), elapsed);
        let now = Work { force: answer.force, torques: [answer.torque_i, answer.torque_j] };
        let e = answer.energies;
        if let Some((then, earlier)) = &before {
            // As velocity-Verlet does the work: the mean force times the mid-step velocity.
            let done = -0.5 * dt * (then.power(&i, &j) + now.power(&i, &j));
            work += done;
            turned_over += done.abs() + 0.5 * dt * (e.viscous_power + earlier.viscous_power);
            lost += e.dissipated() + 0.5 * dt * (e.viscous_power + earlier.viscous_power);
            let surplus = work - (e.stored() - start);
            worst = worst.max((surplus - lost).abs());
            deficit = deficit.max(-surplus);
        } else {
            start = e.stored();
        }
        largest = largest.max(e.stored().abs());
        before = Some((now, e));
    }
    let all = turned_over + largest;
    Balance { missing: worst / all, deficit: deficit / all }
}

struct Work {
    force: pulvis_math::Vector3,
    torques: [pulvis_math::Vector3; 2],
}

impl Work {
    /// Power that the contact gives to the bodies at their mid-step velocities [W].
    fn power(&self, i: &Kinematics, j: &Kinematics) -> f64 {
        self.force.dot(i.velocity_mid - j.velocity_mid)
            + self.torques[0].dot(i.angular_velocity_mid)
            + self.torques[1].dot(j.angular_velocity_mid)
    }
}
