//! The springs and dashpots of a bond.

use std::f64::consts::PI;

use pulvis_math::Real;

/// How the stiffnesses of a bond are given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Elasticity {
    /// The same for every pair.
    Direct(BondStiffness),
    /// Over the area of the cross-section: k_n = K_n A, k_s = K_s A, k_b = K_n I, k_o = K_s J.
    PerArea {
        /// K_n [Pa/m].
        normal: f64,
        /// K_s [Pa/m].
        shear: f64,
    },
    /// A straight beam from centre to centre.
    Beam {
        /// Young's modulus E [Pa].
        young_modulus: f64,
        /// Shear modulus G = E/(2 (1 + ν)) [Pa].
        shear_modulus: f64,
        /// Whether shear deforms it.
        theory: BeamTheory,
    },
}

/// Whether shear deforms a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BeamTheory {
    /// No.
    EulerBernoulli,
    /// Yes, with the shear coefficient κ.
    Timoshenko {
        /// κ = 6 (1 + ν)/(7 + 6 ν) of a round cross-section (Cowper 1966) [1].
        shear_coefficient: f64,
    },
}

/// The cross-section of a bond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    /// None: stiffnesses are given directly.
    None,
    /// Of this radius [m].
    Radius(f64),
    /// Of this part of the smaller body's radius [1].
    Ratio(f64),
}

/// The stiffnesses of one bond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BondStiffness<R = f64> {
    /// k_n [N/m].
    pub normal: R,
    /// k_s [N/m].
    pub shear: R,
    /// k_b [N m].
    pub bending: R,
    /// k_o [N m].
    pub torsion: R,
    /// Radius of the cross-section, zero where there is none [m].
    pub section_radius: R,
}

/// The dashpots of a bond.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dashpots {
    /// γ_n [kg/s].
    pub normal: f64,
    /// γ_s [kg/s].
    pub shear: f64,
    /// γ_b [N m s].
    pub bending: f64,
    /// γ_o [N m s].
    pub torsion: f64,
    /// τ, which adds τ k to each of them [s].
    pub damping_time: f64,
}

/// The springs and dashpots of a bond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BondSprings {
    /// The stiffnesses.
    pub elasticity: Elasticity,
    /// The cross-section.
    pub section: Section,
    /// The dashpots.
    pub dashpots: Dashpots,
}

impl BondSprings {
    /// The stiffnesses of a bond of this length, the distance of the centres when it formed [m], at bodies the smaller of
    /// which has this radius [m].
    #[inline(always)]
    pub fn stiffness<R: Real>(&self, length: R, smaller_radius: R) -> BondStiffness<R> {
        let number = R::splat;
        let radius = match self.section {
            Section::None => R::zero(),
            Section::Radius(radius) => number(radius),
            Section::Ratio(ratio) => number(ratio) * smaller_radius,
        };
        let square = radius * radius;
        // I = A r²/4 and J = 2 I.
        let (area, second_moment) = (number(PI) * square, number(0.25 * PI) * square * square);
        match self.elasticity {
            Elasticity::Direct(BondStiffness { normal, shear, bending, torsion, .. }) => BondStiffness {
                normal: number(normal),
                shear: number(shear),
                bending: number(bending),
                torsion: number(torsion),
                section_radius: radius,
            },
            Elasticity::PerArea { normal, shear } => BondStiffness {
                normal: number(normal) * area,
                shear: number(shear) * area,
                bending: number(normal) * second_moment,
                torsion: number(2.0 * shear) * second_moment,
                section_radius: radius,
            },
            Elasticity::Beam { young_modulus, shear_modulus, theory } => {
                let inverse = R::one() / length;
                let bending = number(young_modulus) * second_moment * inverse;
                let mut shear = number(12.0) * bending * (inverse * inverse);
                if let BeamTheory::Timoshenko { shear_coefficient } = theory {
                    // 12 E I/(κ G A L²) with I/A = r²/4.
                    let factor = 3.0 * young_modulus / (shear_coefficient * shear_modulus);
                    let slender = radius * inverse;
                    shear = shear / (R::one() + number(factor) * (slender * slender));
                }
                BondStiffness {
                    normal: number(young_modulus) * area * inverse,
                    shear,
                    bending,
                    torsion: number(2.0 * shear_modulus) * second_moment * inverse,
                    section_radius: radius,
                }
            }
        }
    }

    /// Whether the springs sit at mid-length between the centres, as those of a beam, and not between the surfaces.
    #[inline(always)]
    pub fn at_mid_length(&self) -> bool {
        matches!(self.elasticity, Elasticity::Beam { .. })
    }

    /// Coefficients of the dashpots beside springs of these stiffnesses.
    #[inline(always)]
    pub(crate) fn dashpots<R: Real>(&self, stiffness: &BondStiffness<R>) -> [R; 4] {
        let Dashpots { normal, shear, bending, torsion, damping_time } = self.dashpots;
        let time = R::splat(damping_time);
        [
            R::splat(normal) + time * stiffness.normal,
            R::splat(shear) + time * stiffness.shear,
            R::splat(bending) + time * stiffness.bending,
            R::splat(torsion) + time * stiffness.torsion,
        ]
    }

    /// Whether there are any dashpots.
    pub fn has_dashpot(&self) -> bool {
        self.dashpots != Dashpots::default()
    }
}

/// The radius of the smaller body [m]; a wall, which has none, is larger than any.
pub(super) fn smaller(radii: [f64; 2]) -> f64 {
    if radii[1] > 0.0 { radii[0].min(radii[1]) } else { radii[0] }
}

/// The harmonic mean of the radii, of a wall contact twice that of the body [m].
pub(super) fn harmonic(radii: [f64; 2]) -> f64 {
    if radii[1] > 0.0 { 2.0 * radii[0] * radii[1] / (radii[0] + radii[1]) } else { 2.0 * radii[0] }
}
