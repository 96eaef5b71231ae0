//! Coulomb's force between charged spheres, with a cutoff.

use pulvis_math::{Dimension, Mask, Real};

use super::{NonContactLaw, NonContactResponse, branch_by_distance};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::energy::AttractionAccount;
use crate::kinematics::NormalMotion;
use crate::pair::{Pair, Sizes};

/// Force K (1/r² − 1/r_c²), K = q_i q_j/(4 π ε_0), of charges in the centres of two spheres at the distance r, shifted so
/// that it and its potential K (r_c − r)²/(r r_c²) end without a jump at r_c = a_i + a_j + s_c; constant in contact. Walls
/// carry no charge.
///
/// Beyond the cutoff charges do not feel each other: the order that they make over long distances, for which others sum
/// after Ewald, is lost. The shift takes the share 1 − (s_c/r_c)² from the potential at touch.
///
/// # Source
/// C. A. de Coulomb, 1785; the shift of force and potential is that of molecular dynamics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coulomb {
    /// Distance s_c of the surfaces at which the force ends [m].
    cutoff: f64,
    /// The largest |q| of any particle [C].
    largest_charge: f64,
}

/// 1/(4 π ε_0), CODATA 2018 [N m²/C²].
pub const COULOMB_CONSTANT: f64 = 8.987_551_792_3e9;

/// The name of the particle quantity.
const CHARGE: &str = "charge";

impl Law for Coulomb {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "coulomb",
        summary: "force between charged spheres, shifted to end at a cutoff; not an Ewald sum",
        equations: "\
f   = K (1/r² − 1/r_c²)          for r < r_c = a_i + a_j + s_c,  K = q_i q_j/(4 π ε_0);  as at touch in contact
U   = K (r_c − r)²/(r r_c²)      for δ ≤ 0,  U(0) + f(0) δ in contact;  walls carry no charge",
        source: "Coulomb (1785), force shifted to zero at the cutoff: order over longer distances is lost, other than with an Ewald sum",
        parameters: &[Parameter::number(
            "cutoff",
            "s_c",
            Dimension::LENGTH,
            Range::Positive,
            "distance of the surfaces at which the force ends",
        )],
        particle_quantities: &[Parameter::number(
            CHARGE,
            "q",
            Dimension::CHARGE,
            Range::Any,
            "charge of a particle",
        )],
        memory: &[],
        closed_form: "escape speed and sticking of two opposite charges (pulvis verify)",
        example: "law = \"coulomb\"\ncutoff = \"1e-2 m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { cutoff: values.number("cutoff")?, largest_charge: 0.0 })
    }
}

impl NonContactLaw for Coulomb {
    type Memory<R: Real> = ();

    const ACCOUNT: AttractionAccount = AttractionAccount::Electrostatic;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, _memory: &mut ()) -> NonContactResponse<R> {
        let (one, zero) = (R::one(), R::zero());
        let cutoff = R::splat(self.cutoff);
        let distance = (-motion.overlap).max(zero);
        let acts = distance.lt(cutoff);
        let (mut force, mut potential) = (zero, zero);
        if acts.any() {
            let [charge_i, charge_j] = motion.pair.quantities().attraction[0];
            let strength = R::splat(COULOMB_CONSTANT) * charge_i * charge_j;
            let touching = motion.radius_i + motion.radius_j;
            let (centres, end) = (touching + distance, touching + cutoff);
            let left = cutoff - distance;
            let inverse = one / (centres * end);
            // 1/r² − 1/r_c² without the difference of nearly equal numbers.
            force = (strength * left * (end + centres) * (inverse * inverse)).keep_where(acts);
            let well = strength * (left * left) * inverse / end;
            potential = (well + force * motion.depth).keep_where(acts);
        }
        NonContactResponse { force, applied_force: force, potential, dissipated: zero }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.cutoff
    }

    /// The slope at touch, 2 K/(a_i + a_j)³, of the pair's own charges or of the largest ones that there are; the sum of
    /// the radii is at least twice their harmonic mean.
    fn max_stiffness(&self, pair: &Pair<f64>) -> f64 {
        let [charge_i, charge_j] = pair.quantities().attraction[0];
        let charges = (charge_i * charge_j).abs().max(self.largest_charge * self.largest_charge);
        let radii = 2.0 * pair.harmonic_radius();
        2.0 * COULOMB_CONSTANT * charges / (radii * radii * radii)
    }

    fn bounded_by(self, sizes: &dyn Fn(&str) -> Sizes) -> Self {
        Self { largest_charge: sizes(CHARGE).largest, ..self }
    }

    fn acts_on_approach(&self) -> bool {
        true
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, _memory: &()) -> (u8, &'static str) {
        branch_by_distance(overlap, self.cutoff, "charged")
    }
}
