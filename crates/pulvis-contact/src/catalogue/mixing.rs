//! How parameters of a contact follow from the properties of the two materials.

use pulvis_math::Dimension;

use super::Range;

/// A property that materials may carry because laws ask for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialProperty {
    /// The key in a material: `young_modulus`.
    pub name: &'static str,
    /// The symbol in equations.
    pub symbol: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// The numbers allowed, in SI units.
    pub range: Range,
    /// What it means, in one sentence.
    pub meaning: &'static str,
}

const YOUNG_MODULUS: MaterialProperty = MaterialProperty {
    name: "young_modulus",
    symbol: "E",
    dimension: Dimension::PRESSURE,
    range: Range::Positive,
    meaning: "Young's modulus",
};
const POISSON_RATIO: MaterialProperty = MaterialProperty {
    name: "poisson_ratio",
    symbol: "ν",
    dimension: Dimension::NONE,
    // Strictly above −1; 1/2 is incompressible.
    range: Range::Within(-1.0, 0.5),
    meaning: "Poisson's ratio",
};

/// Every property that a law can ask for.
pub const MATERIAL_PROPERTIES: &[MaterialProperty] = &[YOUNG_MODULUS, POISSON_RATIO];

/// A rule that makes a parameter of a contact from properties of its two materials.
#[derive(Clone, Copy, Debug)]
pub struct Mixing {
    /// Its name.
    pub name: &'static str,
    /// Its equation.
    pub equation: &'static str,
    /// The properties that it needs of both materials.
    pub needs: &'static [MaterialProperty],
    /// The parameter [SI] from the two materials' properties [SI], each in the order of `needs`.
    pub rule: fn(&[f64], &[f64]) -> f64,
}

// Rules are told apart by their names: pointers to functions have no lasting identity.
impl PartialEq for Mixing {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j. Johnson, *Contact Mechanics* (1985), eq. (4.20).
pub static EFFECTIVE_MODULUS: Mixing = Mixing {
    name: "effective-modulus",
    equation: "1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j",
    needs: &[YOUNG_MODULUS, POISSON_RATIO],
    rule: |i, j| 1.0 / (compliance(i) + compliance(j)),
};

fn compliance(material: &[f64]) -> f64 {
    let (young, poisson) = (material[0], material[1]);
    (1.0 - poisson * poisson) / young
}

/// 1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j with G = E/(2 (1 + ν)). Johnson, *Contact Mechanics* (1985), eq. (7.43).
pub static EFFECTIVE_SHEAR_MODULUS: Mixing = Mixing {
    name: "effective-shear-modulus",
    equation: "1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j,  G = E/(2 (1 + ν))",
    needs: &[YOUNG_MODULUS, POISSON_RATIO],
    rule: |i, j| 1.0 / (shear_compliance(i) + shear_compliance(j)),
};

fn shear_compliance(material: &[f64]) -> f64 {
    let (young, poisson) = (material[0], material[1]);
    2.0 * (2.0 - poisson) * (1.0 + poisson) / young
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_materials_share_the_compliance() {
        let glass = [70e9, 0.2];
        let modulus = (EFFECTIVE_MODULUS.rule)(&glass, &glass);
        assert!((modulus / (0.5 * 70e9 / 0.96) - 1.0).abs() < 1e-15);
        let shear = (EFFECTIVE_SHEAR_MODULUS.rule)(&glass, &glass);
        assert!((shear / (0.5 * (70e9 / 2.4) / 1.8) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_rigid_partner_leaves_the_compliance_of_the_soft_one() {
        let (soft, rigid) = ([1e7, 0.3], [1e30, 0.3]);
        assert!(((EFFECTIVE_MODULUS.rule)(&soft, &rigid) / (1e7 / 0.91) - 1.0).abs() < 1e-12);
    }
}
