//! The springs and dashpots of a bond.

use std::f64::consts::PI;

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Values};

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
        let of = |own: f64, stiffness: R| R::splat(own) + R::splat(damping_time) * stiffness;
        [
            of(normal, stiffness.normal),
            of(shear, stiffness.shear),
            of(bending, stiffness.bending),
            of(torsion, stiffness.torsion),
        ]
    }

    /// Whether there are any dashpots.
    pub fn has_dashpot(&self) -> bool {
        self.dashpots != Dashpots::default()
    }

    pub(super) fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let dashpots = Dashpots {
            normal: values.number("normal_dashpot")?,
            shear: values.number("shear_dashpot")?,
            bending: values.number("bending_dashpot")?,
            torsion: values.number("torsion_dashpot")?,
            damping_time: values.number("damping_time")?,
        };
        let elasticity = elasticity(values)?;
        let section = section(values)?;
        if section == Section::None && !matches!(elasticity, Elasticity::Direct(_)) {
            return Err(InvalidParameter::Missing { name: "bond_radius" });
        }
        Ok(Self { elasticity, section, dashpots })
    }

    /// Refuses cross-sections that strengths as forces have no use for: those of springs that need none, and those that
    /// follow the bodies, of which the smaller ones would act farther than the larger ones.
    pub(super) fn fit_forces(&self) -> Result<(), InvalidParameter> {
        let (name, value, reason) = match (self.section, self.elasticity) {
            (Section::Ratio(ratio), _) => {
                ("radius_ratio", ratio, "a strength that is a force belongs to one cross-section")
            }
            (Section::Radius(radius), Elasticity::Direct(_)) => {
                ("bond_radius", radius, "neither these springs nor these strengths have a cross-section")
            }
            _ => return Ok(()),
        };
        Err(InvalidParameter::Inconsistent {
            name,
            found: value.to_string(),
            expected: "none, or strengths as stresses (`parallel-bond`)".to_owned(),
            reason,
        })
    }
}

/// The one way in which stiffnesses are given.
fn elasticity(values: &Values) -> Result<Elasticity, InvalidParameter> {
    let number = |name| values.optional_number(name);
    let ways = ["normal_stiffness", "young_modulus", "normal_stiffness_per_area"];
    let mut given = ways.into_iter().filter(|name| number(name).is_some());
    let (way, another) = (given.next(), given.next());
    if let (Some(way), Some(another)) = (way, another) {
        return Err(InvalidParameter::Inconsistent {
            name: another,
            found: format!("given beside `{way}`"),
            expected: "only one of `normal_stiffness`, `young_modulus`, `normal_stiffness_per_area`"
                .to_owned(),
            reason: "each of them sets the stiffness of the bond",
        });
    }
    let belongs = |name: &'static str, to: &'static str| match number(name) {
        Some(_) if way != Some(to) => Err(InvalidParameter::Inconsistent {
            name,
            found: format!("given without `{to}`"),
            expected: format!("it beside `{to}`"),
            reason: "stiffnesses are given directly, by a beam, or per area",
        }),
        value => Ok(value.unwrap_or(0.0)),
    };
    let shear = belongs("shear_stiffness", "normal_stiffness")?;
    let bending = belongs("bending_stiffness", "normal_stiffness")?;
    let torsion = belongs("torsion_stiffness", "normal_stiffness")?;
    let shear_per_area = belongs("shear_stiffness_per_area", "normal_stiffness_per_area")?;
    let value = |name: &'static str| values.number(name);
    match way {
        Some("young_modulus") => {
            let (young_modulus, poisson_ratio) = (value("young_modulus")?, value("poisson_ratio")?);
            let shear_coefficient = 6.0 * (1.0 + poisson_ratio) / (7.0 + 6.0 * poisson_ratio);
            let theory = match values.choice("beam_theory")? {
                "euler-bernoulli" => BeamTheory::EulerBernoulli,
                _ => BeamTheory::Timoshenko { shear_coefficient },
            };
            let shear_modulus = young_modulus / (2.0 * (1.0 + poisson_ratio));
            Ok(Elasticity::Beam { young_modulus, shear_modulus, theory })
        }
        Some("normal_stiffness_per_area") => {
            Ok(Elasticity::PerArea { normal: value("normal_stiffness_per_area")?, shear: shear_per_area })
        }
        Some(_) => {
            let (normal, section_radius) = (value("normal_stiffness")?, 0.0);
            Ok(Elasticity::Direct(BondStiffness { normal, shear, bending, torsion, section_radius }))
        }
        None => Err(InvalidParameter::Inconsistent {
            name: "normal_stiffness",
            found: "missing".to_owned(),
            expected: "`normal_stiffness`, `young_modulus` or `normal_stiffness_per_area`".to_owned(),
            reason: "one of them sets the stiffness of the bond",
        }),
    }
}

fn section(values: &Values) -> Result<Section, InvalidParameter> {
    match (values.optional_number("bond_radius"), values.optional_number("radius_ratio")) {
        (Some(_), Some(ratio)) => Err(InvalidParameter::Inconsistent {
            name: "radius_ratio",
            found: ratio.to_string(),
            expected: "only one of `bond_radius`, `radius_ratio`".to_owned(),
            reason: "each of them sets the cross-section",
        }),
        (Some(radius), None) => Ok(Section::Radius(radius)),
        (None, Some(ratio)) => Ok(Section::Ratio(ratio)),
        (None, None) => Ok(Section::None),
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
