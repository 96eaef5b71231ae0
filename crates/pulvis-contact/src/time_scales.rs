//! How fast a contact can move: what time steps have to resolve.

use std::f64::consts::PI;

use crate::bond::{Bond, BondStiffness};
use crate::friction::Friction;
use crate::model::ContactModel;
use crate::pair::Pair;

/// What a sphere meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    /// Another sphere.
    Sphere {
        /// Its mass [kg].
        mass: f64,
        /// Its radius [m].
        radius: f64,
    },
    /// A wall that does not give way.
    Wall {
        /// Mean of the principal curvatures of its surface, positive where it bulges towards the sphere [1/m].
        mean_curvature: f64,
    },
}

/// A mass [kg] and a radius [m], or a plane wall.
impl From<Option<(f64, f64)>> for Partner {
    fn from(sphere: Option<(f64, f64)>) -> Self {
        sphere.map_or(Self::Wall { mean_curvature: 0.0 }, |(mass, radius)| Self::Sphere { mass, radius })
    }
}

impl Partner {
    /// The pair of a sphere with mass [kg] and radius [m] and this partner.
    pub fn pair_with(self, (mass_i, radius_i): (f64, f64)) -> Pair {
        match self {
            Self::Sphere { mass, radius } => Pair::spheres(mass_i, mass, radius_i, radius),
            Self::Wall { mean_curvature } => Pair::from_sums(1.0 / mass_i, 1.0 / radius_i + mean_curvature),
        }
    }

    /// The radii of a sphere with mass [kg] and radius [m] and of this partner, zero for a wall [m].
    fn radii_with(self, (_, radius_i): (f64, f64)) -> [f64; 2] {
        match self {
            Self::Sphere { radius, .. } => [radius_i, radius],
            Self::Wall { .. } => [radius_i, 0.0],
        }
    }
}

impl ContactModel {
    /// Shortest duration [s] of any motion that the contact can make: π over its highest frequency,
    /// over all branches and springs, for a sphere with mass [kg] and radius [m] and what it meets. Laws whose
    /// stiffness has no bound take it from the loading that is expected. A contact that changes at rest counts with the
    /// [rate](crate::NormalLaw::relaxation_rate) at which it does, if steps must resolve that.
    ///
    /// Squares of the frequencies: k/m_r along the normal; k_o L² (1/I_i + 1/I_j) of torsion; and the
    /// larger one of the two modes into which sliding, k_t (1/m_r + a_i²/I_i + a_j²/I_j), and rolling,
    /// k_r L² (1/I_i + 1/I_j), combine where a_i/I_i differs from a_j/I_j. Dashpots count with their
    /// rates γ/m_r and so on. Solid spheres, I = 2/5 m a². A bond adds the squares and rates of its own modes: shear
    /// and bending combine as sliding and rolling do, with the lever arms of its springs.
    pub fn shortest_contact_time(&self, body_i: (f64, f64), body_j: impl Into<Partner>) -> f64 {
        let body_j = body_j.into();
        let pair = body_j.pair_with(body_i);
        let lever = pair.harmonic_radius();
        let modes = Modes::new(&pair, body_i, body_j, body_j.radii_with(body_i), lever);
        let bond =
            self.laws.bond.map(|bond| BondModes::new(&bond, &pair, body_i, body_j)).unwrap_or_default();
        let laws = &self.laws;
        let scale = self.scale(&pair);
        let stiffness = |law: &Option<Friction>| law.as_ref().map_or(0.0, |law| law.max_stiffness(&scale));
        let dashpot = |law: &Option<Friction>| law.as_ref().map_or(0.0, Friction::dashpot);
        let (normal_stiffness, normal_dashpot) = self.steepest_normal(body_i, body_j);
        let relaxation = self.normal.relaxation_rate(&pair, &laws.expected);
        let squares = (normal_stiffness * pair.inverse_reduced_mass())
            .max(modes.highest(stiffness(&laws.sliding), stiffness(&laws.rolling)) + bond.sideways[0])
            .max(modes.turning * stiffness(&laws.torsion) + bond.twisting[0]);
        let rates = (normal_dashpot * pair.inverse_reduced_mass())
            .max(modes.highest(dashpot(&laws.sliding), dashpot(&laws.rolling)) + bond.sideways[1])
            .max(modes.turning * dashpot(&laws.torsion) + bond.twisting[1]);
        PI / squares.sqrt().max(rates).max(relaxation)
    }

    /// The steepest slope [N/m] of the force along the normal over all branches, and the largest coefficient of its
    /// dashpots [kg/s], for a sphere with mass [kg] and radius [m] and what it meets. Laws whose stiffness has no bound
    /// take it from the loading that is expected.
    pub fn steepest_normal(&self, body_i: (f64, f64), body_j: impl Into<Partner>) -> (f64, f64) {
        let body_j = body_j.into();
        let pair = body_j.pair_with(body_i);
        let elastic = self.normal.max_stiffness(&pair, &self.laws.expected);
        let dashpot = self.normal.dashpot(&pair, &self.laws.expected)
            + self.laws.viscosity.largest_coefficient(&pair, elastic);
        let stiffness = elastic.max(self.laws.noncontact.max_stiffness(&pair));
        let Some(bond) = &self.laws.bond else { return (stiffness, dashpot) };
        let of_bond = bond.stiffness_at_touch(body_j.radii_with(body_i));
        (stiffness + of_bond.normal, dashpot + bond.springs.dashpots(&of_bond)[0])
    }
}

/// Inverse inertias [1/kg] against which the springs of a contact work.
struct Modes {
    /// 1/m_r + a_i²/I_i + a_j²/I_j, of sliding.
    sliding: f64,
    /// L² (1/I_i + 1/I_j), of rolling and torsion.
    turning: f64,
    /// L (a_i/I_i − a_j/I_j): a sliding force rolls the contact unless the bodies are alike.
    coupling: f64,
}

impl Modes {
    /// With the arms a_i and a_j [m] of the force and the length L [m] of the moment.
    fn new(pair: &Pair, body_i: (f64, f64), body_j: Partner, [arm_i, arm_j]: [f64; 2], lever: f64) -> Self {
        // A wall has 1/I_j = 0.
        let inverse_inertia = |(mass, radius): (f64, f64)| 1.0 / (0.4 * mass * radius * radius);
        let turn_i = inverse_inertia(body_i);
        let turn_j = match body_j {
            Partner::Sphere { mass, radius } => inverse_inertia((mass, radius)),
            Partner::Wall { .. } => 0.0,
        };
        Self {
            sliding: pair.inverse_reduced_mass() + arm_i * arm_i * turn_i + arm_j * arm_j * turn_j,
            turning: lever * lever * (turn_i + turn_j),
            coupling: lever * (arm_i * turn_i - arm_j * turn_j),
        }
    }

    /// The larger eigenvalue of the coupled motion for the coefficients of sliding and rolling.
    fn highest(&self, sliding: f64, rolling: f64) -> f64 {
        let (first, second) = (sliding * self.sliding, rolling * self.turning);
        let coupling = sliding * rolling * self.coupling * self.coupling;
        0.5 * (first + second + ((first - second) * (first - second) + 4.0 * coupling).sqrt())
    }
}

/// The modes of a bond across the line of centres, and about it: squares of frequencies [1/s²], rates of dashpots [1/s].
#[derive(Default)]
struct BondModes {
    sideways: [f64; 2],
    twisting: [f64; 2],
}

impl BondModes {
    fn new(bond: &Bond, pair: &Pair, body_i: (f64, f64), body_j: Partner) -> Self {
        let radii = body_j.radii_with(body_i);
        let [radius_i, radius_j] = radii;
        // The longest arms: those of bonds that formed at a distance.
        let gap = bond.formation.distance;
        let arms = if bond.springs.at_mid_length() {
            [0.5 * (radius_i + radius_j + gap); 2]
        } else {
            radii.map(|radius| radius + 0.5 * gap)
        };
        let modes = Modes::new(pair, body_i, body_j, arms, 1.0);
        let stiffness = bond.stiffness_at_touch(radii);
        let BondStiffness { shear, bending, torsion, .. } = stiffness;
        let [_, of_shear, of_bending, of_torsion] = bond.springs.dashpots(&stiffness);
        Self {
            sideways: [modes.highest(shear, bending), modes.highest(of_shear, of_bending)],
            twisting: [modes.turning * torsion, modes.turning * of_torsion],
        }
    }
}
