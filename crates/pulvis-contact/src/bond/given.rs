//! How the springs of a bond are given: directly, as a beam, or per area.

use super::springs::{BeamTheory, BondSprings, BondStiffness, Dashpots, Elasticity, Section};
use crate::catalogue::{InvalidParameter, Values};

impl BondSprings {
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
