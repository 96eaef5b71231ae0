//! Van der Waals attraction of spheres after Hamaker, with a cutoff.

use pulvis_math::{Dimension, Mask, Real};

use super::{NonContactLaw, NonContactResponse, branch_by_distance};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Attraction −A_H R/(6 (s + z0)²) of spheres at the distance s = max(−δ, 0), less its value at the cutoff s_c, where it
/// so ends without a jump; constant in contact. R = a_i a_j/(a_i + a_j).
///
/// The shift takes A_H R/(6 (s_c + z0)²) from the pull-off force A_H R/(6 z0²) and more from its work: 0.8 % and 17 % at
/// s_c = 10 z0, 0.1 % and 6 % at 30 z0.
///
/// # Source
/// H. C. Hamaker, Physica 4, 1058 (1937), near contact; z0 as in J. N. Israelachvili, *Intermolecular and Surface
/// Forces*. The shift of force and potential is that of molecular dynamics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hamaker {
    /// A_H/6 [J].
    strength: f64,
    /// Distance of surfaces in contact z0 [m].
    z0: f64,
    /// Cutoff s_c [m].
    cutoff: f64,
}

/// Below so many z0 the cutoff takes a fifth of the work of adhesion.
const LEAST_CUTOFF: f64 = 10.0;

pub(crate) const HAMAKER: Parameter =
    Parameter::number("hamaker", "A_H", Dimension::ENERGY, Range::Positive, "Hamaker constant");

pub(crate) const Z0: Parameter = Parameter::number(
    "z0",
    "z0",
    Dimension::LENGTH,
    Range::Positive,
    "distance of surfaces in contact, 0.16 to 0.4 nm",
);

impl Law for Hamaker {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "hamaker",
        summary: "van der Waals attraction of spheres, shifted to end at a cutoff",
        equations: "\
f   = −(A_H R/6) [1/(s + z0)² − 1/(s_c + z0)²]     for s < s_c,  s = max(−δ, 0)
U   = −(A_H R/6) (s_c − s)²/((s + z0) (s_c + z0)²) for δ ≤ 0,  U(0) + f(0) δ in contact",
        source: "Hamaker, Physica 4, 1058 (1937), near contact, force shifted to zero at the cutoff",
        parameters: &[
            HAMAKER,
            Z0,
            Parameter::number(
                "cutoff",
                "s_c",
                Dimension::LENGTH,
                Range::Positive,
                "distance at which the attraction ends, at least 10 z0; 30 z0 leave 94 % of the work",
            ),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "pull-off force of published examples, work between two distances (tests of the law)",
        example: "law = \"hamaker\"\nhamaker = \"6.5e-20 J\"\nz0 = \"4e-10 m\"\ncutoff = \"2e-8 m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let (z0, cutoff) = (values.number("z0")?, values.number("cutoff")?);
        if cutoff < LEAST_CUTOFF * z0 {
            return Err(InvalidParameter::Inconsistent {
                name: "cutoff",
                found: format!("{cutoff} m"),
                expected: format!("at least 10 z0 = {} m", LEAST_CUTOFF * z0),
                reason: "a shorter cutoff takes more than a sixth of the work of adhesion",
            });
        }
        Ok(Self { strength: values.number("hamaker")? / 6.0, z0, cutoff })
    }
}

impl NonContactLaw for Hamaker {
    type Memory<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, _memory: &mut ()) -> NonContactResponse<R> {
        let (one, zero) = (R::one(), R::zero());
        let cutoff = R::splat(self.cutoff);
        let distance = (-motion.overlap).max(zero);
        let acts = distance.lt(cutoff);
        let (mut force, mut potential) = (zero, zero);
        if acts.any() {
            let strength = R::splat(0.5 * self.strength) / motion.pair.inverse_harmonic_radius();
            let near = one / (distance + R::splat(self.z0));
            let least = 1.0 / (self.cutoff + self.z0);
            let least_squared = R::splat(least * least);
            let left = cutoff - distance;
            // 1/(s + z0)² − 1/(s_c + z0)² without the difference of nearly equal numbers.
            let reach = R::splat(self.cutoff + 2.0 * self.z0) + distance;
            force = (-strength * left * reach * (near * near) * least_squared).keep_where(acts);
            let well = -strength * (left * left) * near * least_squared;
            potential = (well + force * motion.depth).keep_where(acts);
        }
        NonContactResponse { force, applied_force: force, potential, dissipated: zero }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.cutoff
    }

    /// Half as much again as the steepest slope, A_H R/(3 z0³): the slope falls by half within a quarter of z0, and so a
    /// collision with 50 steps in its shortest contact time errs by less than 1e-3 of its energy (tests of the law).
    fn max_stiffness(&self, pair: &Pair<f64>) -> f64 {
        1.5 * self.strength * pair.harmonic_radius() / (self.z0 * self.z0 * self.z0)
    }

    fn acts_on_approach(&self) -> bool {
        true
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, _memory: &()) -> (u8, &'static str) {
        branch_by_distance(overlap, self.cutoff, "attraction")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(law: &Hamaker, radius: f64, overlap: f64) -> NonContactResponse {
        law.respond(&NormalMotion::at_rest(&Pair::wall(1e-6, radius), overlap), &mut ())
    }

    #[test]
    fn the_pull_off_force_is_that_of_two_published_examples_less_the_shift() {
        for (hamaker, radius, pull_off) in
            [(6.5e-20, 1e-6, 6.770833333333333e-08), (1e-19, 5e-7, 5.2083333333333327e-08)]
        {
            for ratio in [10.0, 30.0, 100.0, 1e4] {
                let law = Hamaker { strength: hamaker / 6.0, z0: 4e-10, cutoff: ratio * 4e-10 };
                let share = 1.0 - 1.0 / ((1.0 + ratio) * (1.0 + ratio));
                let force = at(&law, radius, 0.0).force;
                assert!((force / (-pull_off * share) - 1.0).abs() < 1e-14, "{force}");
                assert_eq!(at(&law, radius, 1e-7).force, force, "constant in contact");
                // Without the shift, A_H R/(6 z0): the share that recipe tables give for 10, 30 and 100 z0.
                let work = -at(&law, radius, 0.0).potential / (pull_off * 4e-10);
                let expected = (ratio / (1.0 + ratio)) * (ratio / (1.0 + ratio));
                assert!((work / expected - 1.0).abs() < 1e-14, "{work}");
            }
        }
    }

    #[test]
    fn the_work_between_two_distances_is_that_of_the_integrated_force() {
        let law = Hamaker { strength: 1e-20, z0: 4e-10, cutoff: 2e-8 };
        let (from, to, radius, points) = (1e-10, 1.5e-8, 1e-6, 4000);
        let step = (to - from) / f64::from(points);
        // Simpson's rule; its error falls with the fourth power of step/z0 = 0.01.
        let work: f64 = (0..=points)
            .map(|point| {
                let weight = match point {
                    0 => 1.0,
                    _ if point == points => 1.0,
                    odd if odd % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                -weight * step / 3.0 * at(&law, radius, -(from + step * f64::from(point))).force
            })
            .sum();
        let rise = at(&law, radius, -to).potential - at(&law, radius, -from).potential;
        assert!((work / rise - 1.0).abs() < 1e-9, "{work} {rise}");
    }
}
