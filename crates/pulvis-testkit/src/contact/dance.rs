//! Two bodies on prescribed smooth paths, so that every quantity of a contact changes at once.

use std::f64::consts::TAU;

use pulvis_contact::{ContactModel, NormalLaw, NormalLawVisitor, NormalMotion, Pair};
use pulvis_math::{Vector3, elementary};

use crate::bodies::Kinematics;
use crate::draw::Draw;
use crate::parameters::{loaded_to, pair_of, random_bodies, with_random_quantities};

/// A smooth prescribed motion of two spheres.
#[derive(Clone, Debug)]
pub struct Dance {
    /// Constants of the pair.
    pub pair: Pair,
    /// Radius of i [m].
    pub radius_i: f64,
    /// Radius of j [m].
    pub radius_j: f64,
    /// Duration [s].
    pub duration: f64,
    /// Mean overlap and its amplitude [m]; a larger amplitude opens the contact.
    overlap: (f64, f64),
    axis: [Vector3; 3],
    angular_velocities: [[Vector3; 2]; 2],
    twist: f64,
    phase: [f64; 4],
}

impl Dance {
    /// A random motion at the overlaps of the normal law, now and then apart, that turns by about one
    /// radian and slips by a few overlaps.
    pub fn random(model: &ContactModel, draw: &mut Draw) -> Self {
        let opening = draw.log_between(0.3, 2.0);
        Self::with_opening(model, draw, opening)
    }

    /// A random motion that keeps the bodies in contact.
    pub fn in_contact(model: &ContactModel, draw: &mut Draw) -> Self {
        let opening = draw.between(0.1, 0.8);
        Self::with_opening(model, draw, opening)
    }

    fn with_opening(model: &ContactModel, draw: &mut Draw, opening: f64) -> Self {
        let (body_i, body_j) = random_bodies(draw);
        let body_j = body_j.unwrap_or((3.0 * body_i.0, 1.5 * body_i.1));
        let pair = pair_of(body_i, Some(body_j));
        let attraction = model.laws.noncontact.entry();
        let pair = with_random_quantities(pair, model.normal.entry(), Some(attraction), draw);
        let range = model.normal.interaction_range(&pair);
        // Laws that act at a distance are looked at near there as often as at the scale of the bodies.
        let scale = if range > 0.0 && draw.chance(0.5) {
            10.0 * range
        } else {
            model.normal.accept(OverlapScale(pair))
        };
        let depth = scale.min(0.05 * pair.harmonic_radius()) * draw.log_between(0.05, 0.8);
        let max_stiffness = model.normal.max_stiffness(&pair, &loaded_to(2.0 * depth, &pair));
        // Slow enough for springs to follow, fast enough for dashpots to be felt.
        let duration = 20.0 * (pair.reduced_mass() / max_stiffness).sqrt();
        // The arcs of deep contacts; of overlaps that are lost against the chords of a step less.
        let turn = (1e3 * depth * pair.inverse_harmonic_radius()).min(1.0);
        let slip = depth * draw.log_between(0.3, 10.0) / duration;
        let mut angular_velocity = || draw.vector() * (slip / body_i.1);
        let angular_velocities =
            [[angular_velocity(), angular_velocity()], [angular_velocity(), angular_velocity()]];
        Self {
            pair,
            radius_i: body_i.1,
            radius_j: body_j.1,
            duration,
            overlap: (depth, opening * depth),
            axis: [draw.direction(), draw.vector() * (0.5 * turn), draw.vector() * (0.3 * turn)],
            angular_velocities,
            twist: draw.between(-1.0, 1.0) / duration,
            phase: std::array::from_fn(|_| draw.between(0.0, TAU)),
        }
    }

    /// A sine of `cycles` over the duration, and its rate.
    fn wave(&self, cycles: f64, phase: f64, time: f64) -> (f64, f64) {
        let frequency = TAU * cycles / self.duration;
        let angle = frequency * time + phase;
        (elementary::sin(angle), frequency * elementary::cos(angle))
    }

    /// Unit normal and its rate.
    fn normal(&self, time: f64) -> (Vector3, Vector3) {
        let (first, first_rate) = self.wave(0.7, self.phase[0], time);
        let (second, second_rate) = self.wave(1.3, self.phase[1], time);
        let along = self.axis[0] + self.axis[1] * first + self.axis[2] * second;
        let rate = self.axis[1] * first_rate + self.axis[2] * second_rate;
        let length = along.norm();
        let normal = along * (1.0 / length);
        (normal, rate.tangential_to(normal) * (1.0 / length))
    }

    /// Positions, velocities and angular velocities of i and j.
    fn at(&self, time: f64) -> [(Vector3, Vector3, Vector3); 2] {
        let (normal, turning) = self.normal(time);
        let (wave, wave_rate) = self.wave(2.0, self.phase[2], time);
        let (mean, amplitude) = self.overlap;
        let distance = self.radius_i + self.radius_j - mean - amplitude * wave;
        let between = normal * distance;
        let rate = turning * distance - normal * (amplitude * wave_rate);
        let (drift, drift_rate) = self.wave(0.5, self.phase[3], time);
        let center = self.axis[1] * (self.radius_i * drift);
        let center_rate = self.axis[1] * (self.radius_i * drift_rate);
        // As one body the pair angular velocities with the normal; what is added slips, rolls and twists.
        let rigid = normal.cross(turning) + normal * self.twist;
        let angular_velocity = |body: usize| {
            let [first, second] = self.angular_velocities[body];
            rigid + first * self.wave(1.0, self.phase[body], time).0 + second
        };
        [
            (center + between * 0.5, center_rate + rate * 0.5, angular_velocity(0)),
            (center - between * 0.5, center_rate - rate * 0.5, angular_velocity(1)),
        ]
    }

    /// Both bodies at the end of step `index` of `count`, and in the middle of that step.
    pub fn step(&self, index: usize, count: usize) -> [Kinematics; 2] {
        let dt = self.duration / count as f64;
        let time = index as f64 * dt;
        let (before, mid, now) = (self.at(time - dt), self.at(time - 0.5 * dt), self.at(time));
        std::array::from_fn(|body| Kinematics {
            position: now[body].0,
            velocity: now[body].1,
            // The velocity that moves the body from the one position to the other.
            velocity_mid: (now[body].0 - before[body].0) * (1.0 / dt),
            angular_velocity: now[body].2,
            angular_velocity_mid: mid[body].2,
        })
    }
}

/// The overlap that a law takes as its scale [m].
struct OverlapScale(Pair);

impl NormalLawVisitor for OverlapScale {
    type Output = f64;
    fn visit<N: NormalLaw>(self, law: &N) -> f64 {
        let mut memory = <N::Memory<f64>>::default();
        law.respond(&NormalMotion::at_rest(&self.0, 0.0), &mut memory).inverse_overlap_scale.recip()
    }
}
