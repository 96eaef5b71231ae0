//! Spheres of a stiff core in a soft shell.

use pulvis_math::{Dimension, Real};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Two layers: f = k1 δ while the shells are not pressed through, t = t_i + t_j, and with the slope kp of the cores beyond.
/// A wall has no shell. Elastic; the stored energy is the area under the force, and losses are left to a dashpot.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, arXiv:1503.03720, section 1.2, names core-shell materials as a class and gives no
/// law; the two layers are this program's own, the simplest form of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoreShell {
    /// Stiffness of the shells k1 [N/m].
    pub k1: f64,
    /// Stiffness of the cores kp [N/m].
    pub kp: f64,
}

impl Law for CoreShell {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "core-shell",
        summary: "soft shells, and stiff cores behind them",
        equations: "\
f   = k1 δ                       up to δ = t = t_i + t_j, a wall has no shell
f   = k1 t + kp (δ − t)          when the shells are pressed through",
        source: "made for this program: Singh, Magnanimo & Luding, arXiv:1503.03720, section 1.2, name core-shell materials and give no law",
        parameters: &[
            Parameter::number("k1", "k₁", Dimension::STIFFNESS, Range::Positive, "stiffness of the shells"),
            Parameter::number(
                "kp",
                "k_p",
                Dimension::STIFFNESS,
                Range::Positive,
                "stiffness of the cores, at least k1",
            ),
        ],
        particle_quantities: &[Parameter::number(
            "shell_thickness",
            "t",
            Dimension::LENGTH,
            Range::NonNegative,
            "thickness of a particle's shell",
        )],
        memory: &[],
        closed_form: "largest overlap of a collision from the area under the force (pulvis verify)",
        example: "law = \"core-shell\"\nk1 = \"100 N/m\"\nkp = \"2000 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let law = Self { k1: values.number("k1")?, kp: values.number("kp")? };
        if law.kp < law.k1 {
            return Err(InvalidParameter::Inconsistent {
                name: "kp",
                found: format!("{} N/m", law.kp),
                expected: format!("kp >= k1 = {} N/m", law.k1),
                reason: "the time step is made for the cores",
            });
        }
        Ok(law)
    }
}

impl NormalLaw for CoreShell {
    type Memory<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, _memory: &mut ()) -> NormalResponse<R> {
        let (k1, kp, half) = (R::splat(self.k1), R::splat(self.kp), R::splat(0.5));
        let [thickness_i, thickness_j] = motion.pair.quantities().normal[0];
        let shells = thickness_i + thickness_j;
        let soft = motion.depth.min(shells);
        let hard = motion.depth - soft;
        let at_shells = k1 * soft;
        let force = at_shells + kp * hard;
        let stored = half * at_shells * soft + (at_shells + half * kp * hard) * hard;
        let stiffness = R::select(hard.gt(R::zero()), kp, k1);
        NormalResponse::elastic(motion, force, stored, stiffness)
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, _memory: &()) -> (u8, &'static str) {
        let [thickness_i, thickness_j] = pair.quantities().normal[0];
        if overlap <= 0.0 {
            (0, "open")
        } else if overlap <= thickness_i + thickness_j {
            (1, "shell")
        } else {
            (2, "core")
        }
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.kp
    }
}
