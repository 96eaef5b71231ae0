//! A latching spring with an attraction over the area of overlap, after Kempton et al.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Mask, Real};

use super::walton_braun::{K1, K2, WaltonBraun};
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// The spring of Walton and Braun and an attraction c A(δ) over the area in which the spheres intersect.
///
/// ```text
/// f = max(k2 (δ − δ_0), 0) − c A     k1 δ − c A while the largest overlap D grows, δ_0 = (1 − k1/k2) D
/// A = (π/4) δ (2 s − δ) (1 − (g/x)²) s = a_i + a_j,  g = a_i − a_j,  x = s − δ
/// A = π δ (2 a − δ)                  wall
/// ```
///
/// The attraction has a potential, −c ∫ A dδ, and acts only while the bodies overlap. At a curved wall the effective radius
/// of the pair stands for a. The bonds of the publication's agglomerates are the bond `elastic-brittle` with a normal
/// stiffness alone, which adds to this contact: f = k_b (δ − δ_b) until −f > F_b.
///
/// # Source
/// L. Kempton, D. Pinson, S. Chew, P. Zulli, A. Yu, Powder Technol. 223, 19 (2012), for the composition; the form of the
/// area that does not cancel is derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kempton {
    /// The plastic contact.
    pub spring: WaltonBraun,
    /// Energy density of cohesion c [J/m³].
    pub cohesion_density: f64,
}

impl Law for Kempton {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "kempton",
        summary: "plastic contact with an attraction over the area of overlap",
        equations: "\
f = max(k2 (δ − δ_0), 0) − c A            k1 δ − c A while the largest overlap D grows;  δ_0 = (1 − k1/k2) D
A = (π/4) δ (2 s − δ) (1 − (g/(s − δ))²)  s = a_i + a_j,  g = a_i − a_j
A = π δ (2 a − δ)                         wall
bonds of the agglomerates: [contacts.A-B.bond], law elastic-brittle with a normal stiffness alone",
        source: "Kempton, Pinson, Chew, Zulli & Yu, Powder Technol. 223, 19 (2012), for the composition of spring, attraction and bond; its magnitudes could not be confirmed against the original",
        parameters: &[
            K1,
            K2,
            Parameter::number(
                "cohesion_density",
                "c",
                Dimension::PRESSURE,
                Range::NonNegative,
                "energy density of cohesion, 1e3 to 1e6 J/m^3 (1 J/m^3 = 1 Pa)",
            ),
        ],
        particle_quantities: &[],
        memory: &["overlap_max [m]"],
        closed_form: "area of overlap (law_plastic); with a bond the sum of both (law_bond)",
        example: "law = \"kempton\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\"\ncohesion_density = \"1e4 Pa\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self {
            spring: WaltonBraun::from_values(values)?,
            cohesion_density: values.number("cohesion_density")?,
        })
    }
}

/// The area in which two spheres intersect, over π/4 [m²], and its integral over the overlap [m³].
#[inline(always)]
fn lens<R: Real>(motion: &NormalMotion<R>) -> (R, R) {
    let number = R::splat;
    let depth = motion.depth;
    let third = number(1.0 / 3.0) * depth;
    let sum = motion.radius_i + motion.radius_j;
    let difference = motion.radius_i - motion.radius_j;
    let inverse = R::one() / (sum - depth);
    let slant = difference * inverse;
    let area = depth * (sum + sum - depth) * ((R::one() - slant) * (R::one() + slant));
    let integral = depth * depth * (sum - third - difference * slant);
    let wall = motion.radius_j.le(R::zero());
    if !wall.any() {
        return (area, integral);
    }
    let radius = R::splat(0.5) / motion.pair.inverse_harmonic_radius();
    let flat_area = number(4.0) * depth * (radius + radius - depth);
    let flat_integral = number(4.0) * depth * depth * (radius - third);
    (R::select(wall, flat_area, area), R::select(wall, flat_integral, integral))
}

impl NormalLaw for Kempton {
    /// The largest overlap.
    type Memory<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NormalResponse<R> {
        let spring = self.spring.respond(motion, memory);
        let (area, integral) = lens(motion);
        let density = R::splat(-0.25 * PI * self.cohesion_density);
        let force = spring.force + (density * area).keep_where(motion.touching);
        NormalResponse {
            force,
            applied_force: force,
            // The distance from what the attraction alone gives.
            friction_reference: spring.force,
            adhesive_potential: (density * integral).keep_where(motion.touching),
            ..spring
        }
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        self.spring.branch(pair, overlap, memory)
    }

    /// The area grows fastest at touch, by π a12.
    fn max_stiffness(&self, pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.spring.k2.max(self.cohesion_density * PI * pair.harmonic_radius())
    }

    fn remembered_overlap(&self, memory: &[f64; 1]) -> Option<f64> {
        Some(memory[0])
    }
}
