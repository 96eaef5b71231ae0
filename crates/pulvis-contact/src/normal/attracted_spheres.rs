//! Elastic spheres that an attraction pulls together while they overlap: a function of the overlap alone.

use pulvis_math::{Real, elementary};

use super::NormalResponse;
use super::hertz::effective_radius;
use crate::events;
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// F = k_H δ^(3/2) − f R (1 + g δ) for δ > 0, with k_H = (4/3) E* √R and the potentials (2/5) k_H δ^(5/2) and
/// −f R δ (1 + g δ/2): conservative, but the force jumps by f R at touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AttractedSpheres {
    /// Effective modulus E* [Pa].
    pub modulus: f64,
    /// Attraction at touch over the effective radius, f [N/m].
    pub attraction: f64,
    /// How the attraction grows with the overlap, g [1/m].
    pub growth: f64,
}

impl AttractedSpheres {
    /// The answer to a motion. Friction refers to the elastic part of the force, which is zero where the bodies part.
    #[inline(always)]
    pub fn respond<R: Real>(&self, motion: &NormalMotion<R>) -> NormalResponse<R> {
        let (depth, number) = (motion.depth, R::splat);
        let radius = number(0.5) / motion.pair.inverse_harmonic_radius();
        let contact_radius = (radius * depth).sqrt();
        let stiffness = number(2.0 * self.modulus) * contact_radius;
        let repulsion = number(2.0 / 3.0) * stiffness * depth;
        let at_touch = number(-self.attraction) * radius;
        let growth = number(self.growth) * depth;
        let force = (repulsion + at_touch * (R::one() + growth)).keep_where(motion.touching);
        NormalResponse {
            applied_force: events::while_touching(motion, force, at_touch),
            friction_reference: repulsion,
            contact_radius,
            adhesive_potential: at_touch * depth * (R::one() + number(0.5) * growth),
            ..NormalResponse::elastic(motion, force, number(0.4) * repulsion * depth, stiffness)
        }
    }

    /// Branch name and number at an overlap [m].
    pub fn branch(overlap: f64) -> (u8, &'static str) {
        if overlap <= 0.0 { (0, "open") } else { (1, "elastic") }
    }

    /// The steepest slope under the expected loading [N/m]: from −f R g at touch to below 2 E* a.
    pub fn max_stiffness(&self, pair: &Pair, expected: &ExpectedLoading) -> f64 {
        let at_touch = self.attraction * effective_radius(pair) * self.growth;
        (2.0 * self.modulus * self.expected_contact_radius(pair, expected)).max(at_touch)
    }

    /// The radius of the contact area at the largest of the overlaps to which the expected speed, the expected force
    /// and the attraction itself press the bodies, and the expected overlap [m].
    pub fn expected_contact_radius(&self, pair: &Pair, expected: &ExpectedLoading) -> f64 {
        let radius = effective_radius(pair);
        let stiffness = 4.0 / 3.0 * self.modulus * radius.sqrt();
        let attraction = self.attraction * radius;
        let slope = attraction * self.growth;
        let energy = 0.5 * expected.speed * expected.speed * pair.reduced_mass();
        // Each starts where none of the three attracting terms reaches a third of the elastic one.
        let of_speed = largest_root(
            elementary::powf(7.5 * energy / stiffness, 0.4)
                .max(elementary::powf(7.5 * attraction / stiffness, 2.0 / 3.0))
                .max(elementary::powi(3.75 * slope / stiffness, 2)),
            |x| {
                let elastic = stiffness * x * x.sqrt();
                let value = 0.4 * elastic * x - attraction * x - 0.5 * slope * x * x - energy;
                (value, elastic - attraction - slope * x)
            },
        );
        let of_force = largest_root(
            elementary::powf(3.0 * expected.force / stiffness, 2.0 / 3.0)
                .max(elementary::powf(3.0 * attraction / stiffness, 2.0 / 3.0))
                .max(elementary::powi(3.0 * slope / stiffness, 2)),
            |x| {
                let root = stiffness * x.sqrt();
                (root * x - attraction - slope * x - expected.force, 1.5 * root - slope)
            },
        );
        (radius * of_speed.max(of_force).max(expected.overlap * radius)).sqrt()
    }
}

/// The largest root of a function, given with its slope, that is convex from there to `start`: Newton's method, which
/// falls until it is round-off.
fn largest_root(start: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut root = start;
    for _ in 0..100 {
        let (value, slope) = function(root);
        let next = root - value / slope;
        if !(next < root && next > 0.0) {
            break;
        }
        root = next;
    }
    root
}

/// Makes a law of a type whose field `spheres` says all.
macro_rules! attracted_spheres {
    ($law:ident) => {
        impl $crate::normal::NormalLaw for $law {
            type Memory<R: pulvis_math::Real> = ();

            const PATH_ONLY: bool = false;

            #[inline(always)]
            fn respond<R: pulvis_math::Real>(
                &self,
                motion: &$crate::kinematics::NormalMotion<R>,
                _memory: &mut (),
            ) -> $crate::normal::NormalResponse<R> {
                self.spheres.respond(motion)
            }

            fn branch(
                &self,
                _pair: &$crate::pair::Pair<f64>,
                overlap: f64,
                _memory: &(),
            ) -> (u8, &'static str) {
                AttractedSpheres::branch(overlap)
            }

            fn max_stiffness(
                &self,
                pair: &$crate::pair::Pair<f64>,
                expected: &$crate::expected::ExpectedLoading,
            ) -> f64 {
                self.spheres.max_stiffness(pair, expected)
            }

            const STIFFNESS_IS_BOUNDED: bool = false;

            fn expected_contact_radius(
                &self,
                pair: &$crate::pair::Pair<f64>,
                expected: &$crate::expected::ExpectedLoading,
            ) -> f64 {
                self.spheres.expected_contact_radius(pair, expected)
            }
        }
    };
}
pub(super) use attracted_spheres;
