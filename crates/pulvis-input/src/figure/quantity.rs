//! What the axes of a figure can show, and in which units.

use crate::collision::{CollisionCase, luding_pair};
use pulvis_contact::theory::LudingPair;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// What a quantity is a property of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// A whole collision.
    Collision,
    /// An instant of a collision.
    Course,
    /// An instant of a contact on a prescribed path.
    Path,
    /// A row of the time series of a run.
    Run,
    /// A number that was seen in runs.
    Feature,
}

/// A quantity that an axis can show or a check can judge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Its key, which is the name of a column in the tables of `pulvis collide` and `pulvis probe`.
    pub name: &'static str,
    /// In words.
    pub words: &'static str,
    /// Its symbol; subscripts stand in `_{}`.
    pub symbol: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

const fn quantity(
    name: &'static str,
    words: &'static str,
    symbol: &'static str,
    unit: &'static str,
) -> Quantity {
    Quantity { name, words, symbol, unit }
}

/// Quantities of whole collisions.
pub const OF_COLLISIONS: &[Quantity] = &[
    quantity("velocity", "relative velocity", "v", "m/s"),
    quantity("chi", "impact velocity", "χ = v/v_{p0}", "1"),
    quantity("zeta", "impact velocity", "ζ = v/v_{p}", "1"),
    quantity("eta", "plasticity", "η", "1"),
    quantity("beta", "adhesivity", "β", "1"),
    quantity("alpha", "attraction at a distance", "α = f_{a}/(v √(k_{1} m_{r}))", "1"),
    quantity("radius", "radius", "a", "m"),
    quantity("restitution", "coefficient of restitution", "e", "1"),
    quantity("returned_energy", "returned part of the energy", "e²", "1"),
    quantity("overlap_max", "largest overlap", "δ_{max}", "m"),
    quantity("overlap_end", "overlap of the first stop", "δ_{c}", "m"),
    quantity("contact_duration", "contact duration", "t", "s"),
];

/// What checks of whole collisions can judge beside them.
pub const JUDGED: &[Quantity] = &[
    quantity("limits", "limits of sticking, relative", "", "1"),
    quantity("regime", "number of collisions that end otherwise", "", "1"),
];

/// Quantities along the course of a collision.
pub const OF_COURSES: &[Quantity] = &[
    quantity("time", "time", "t", "s"),
    quantity("overlap", "overlap", "δ", "m"),
    quantity("force", "force", "f", "N"),
    quantity("delta_max", "remembered overlap", "δ_{max}", "m"),
    quantity("kinetic", "kinetic energy", "E_{kin}", "J"),
    quantity("potential_available", "available potential energy", "E_{pot}", "J"),
    quantity("potential_plastic", "potential energy of the branch", "E_{pot}", "J"),
    quantity("dissipated", "dissipated energy", "D", "J"),
];

/// Quantities along the path of a probe.
pub const OF_PATHS: &[Quantity] = &[
    quantity("overlap", "overlap", "δ", "m"),
    quantity("force", "force", "f", "N"),
    quantity("leg", "legs of the path", "", "1"),
    quantity("stored_energy", "stored energy", "E", "J"),
    quantity("dissipated", "dissipated energy", "D", "J"),
    quantity("shear", "displacement along the surface", "s", "m"),
    quantity("shear_force", "force against sliding", "f_{t}", "N"),
];

/// Columns of the time series of runs that axes can show.
pub const OF_RUNS: &[Quantity] = &[
    quantity("time", "time", "t", "s"),
    quantity("D_x", "displacement", "D_{x} = (L − L_{0})/d_{0}", "1"),
    quantity("D_y", "displacement", "D_{y} = (L − L_{0})/d_{0}", "1"),
    quantity("D_z", "displacement", "D_{z} = (L − L_{0})/d_{0}", "1"),
    quantity("F_x", "force", "F* = F/(k_{p} d_{0})", "1"),
    quantity("F_y", "force", "F* = F/(k_{p} d_{0})", "1"),
    quantity("F_z", "force", "F* = F/(k_{p} d_{0})", "1"),
    quantity("strain_x", "strain", "ε_{x}", "1"),
    quantity("strain_y", "strain", "ε_{y}", "1"),
    quantity("strain_z", "strain", "ε_{z}", "1"),
    quantity("wall_stress_x", "stress on the walls", "σ_{x}", "Pa"),
    quantity("wall_stress_y", "stress on the walls", "σ_{y}", "Pa"),
    quantity("wall_stress_z", "stress on the walls", "σ_{z}", "Pa"),
    quantity("kinetic", "kinetic energy", "E_{kin}", "J"),
    quantity("elastic", "elastic energy", "E_{el}", "J"),
    quantity("dissipated", "dissipated energy", "D", "J"),
    quantity("contacts", "contacts of particles", "", "1"),
    quantity("wall_contacts", "contacts with walls", "", "1"),
    quantity("coordination", "contacts of a particle", "Z", "1"),
    quantity("solid_fraction", "solid fraction", "φ", "1"),
    quantity("clusters", "pieces", "", "1"),
    quantity("largest_cluster", "particles of the largest piece", "", "1"),
    quantity("second_cluster", "particles of the second largest piece", "", "1"),
    quantity("monomers", "single particles", "", "1"),
    quantity("mean_cluster", "mean size of the piece of a particle", "", "1"),
    quantity("gyration_radius", "radius of gyration of the largest piece", "R_{g}", "m"),
    quantity("deposited", "deposited particles", "", "1"),
    quantity("deposited_mass", "deposited mass", "", "kg"),
];

/// Columns of observers that have names of their own on axes; `_` and the name of the observer follow.
const OF_OBSERVERS: &[Quantity] = &[
    quantity("pressure", "pressure", "p", "Pa"),
    quantity("deviatoric_stress", "deviatoric stress", "q", "Pa"),
    quantity("solid_fraction", "solid fraction", "φ", "1"),
    quantity("granular_temperature", "granular temperature", "T", "J"),
    quantity("corrected_coordination", "contacts of a particle, without rattlers", "Z*", "1"),
    quantity("coordination", "contacts of a particle", "Z", "1"),
    quantity("rattlers", "rattlers", "N_{r}", "1"),
    quantity("fabric_deviator", "deviator of the fabric", "F_{dev}", "1"),
    quantity("normal_force_mean", "mean normal force", "f_{n}", "N"),
    quantity("tensile_share", "part of the contacts that pull", "", "1"),
];

/// What panels of features show.
pub const OF_FEATURES: &[Quantity] = &[quantity("at", "at", "", "1"), quantity("value", "value", "", "1")];

/// A name that lasts as long as the program, as those above do. Figures have some dozens of them, whatever is reproduced.
fn lasting(name: &str) -> &'static str {
    static NAMES: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = names.get(name) {
        return known;
    }
    let lasting: &'static str = Box::leak(name.to_owned().into_boxed_str());
    names.insert(lasting);
    lasting
}

impl Quantity {
    /// A column of a time series that no list above has, or what is computed from columns.
    pub(super) fn of_expression(text: &str) -> Self {
        let of_observer = |known: &&Self| {
            let rest = text.strip_prefix(known.name).and_then(|rest| rest.strip_prefix('_'));
            rest.is_some_and(|name| name.chars().all(|letter| letter.is_alphanumeric() || letter == '_'))
        };
        let name = lasting(text);
        match OF_OBSERVERS.iter().find(of_observer) {
            Some(known) => Self { name, ..*known },
            None => Self { name, words: name, symbol: "", unit: "1" },
        }
    }
}

impl Family {
    /// All its quantities.
    pub const fn quantities(self) -> &'static [Quantity] {
        match self {
            Self::Collision => OF_COLLISIONS,
            Self::Course => OF_COURSES,
            Self::Path => OF_PATHS,
            Self::Run => OF_RUNS,
            Self::Feature => OF_FEATURES,
        }
    }

    /// The quantity of this name.
    pub fn find(self, name: &str) -> Option<Quantity> {
        self.quantities().iter().find(|quantity| quantity.name == name).copied()
    }
}

/// In units of what a quantity is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Its SI unit.
    Si,
    /// The plastic limit overlap δ_p.
    PlasticLimit,
    /// The force k1 δ_p.
    PlasticForce,
    /// The speed v_p0 = √(k1/m_r) δ_p.
    PlasticVelocity,
    /// The time √(m_r/k1).
    LoadingTime,
    /// The kinetic energy of the relative motion before.
    ImpactEnergy,
}

impl Scale {
    /// Name in files, symbol in labels and unit of each.
    pub const NAMED: [(&'static str, Self, &'static str, &'static str); 5] = [
        ("delta_p", Self::PlasticLimit, "δ_{p}", "m"),
        ("k1 delta_p", Self::PlasticForce, "(k_{1} δ_{p})", "N"),
        ("v_p0", Self::PlasticVelocity, "v_{p0}", "m/s"),
        ("sqrt(m_r/k1)", Self::LoadingTime, "√(m_{r}/k_{1})", "s"),
        ("E_i", Self::ImpactEnergy, "E_{i}", "J"),
    ];

    /// How large its unit is: of the `reference` pair, and of the collision itself [SI].
    pub fn unit(self, reference: &LudingPair, impact_energy: f64) -> f64 {
        let parameters = reference.parameters();
        match self {
            Self::Si => 1.0,
            Self::PlasticLimit => reference.dp(),
            Self::PlasticForce => parameters.k1 * reference.dp(),
            Self::PlasticVelocity => reference.v_p0(),
            Self::LoadingTime => (parameters.reduced_mass / parameters.k1).sqrt(),
            Self::ImpactEnergy => impact_energy,
        }
    }

    /// What it is called where a value of a quantity stands.
    pub fn unit_symbol(self, quantity: &Quantity) -> String {
        let named = Self::NAMED.into_iter().find(|(_, scale, _, _)| *scale == self);
        named.map_or(quantity.unit, |(_, _, symbol, _)| symbol).trim_matches(['(', ')']).to_owned()
    }

    /// The axis label of a quantity in this unit.
    pub fn label(self, quantity: &Quantity) -> String {
        let Quantity { words, symbol, unit, .. } = quantity;
        let named = Self::NAMED.into_iter().find(|(_, scale, _, _)| *scale == self);
        match named {
            Some((_, _, per, _)) => format!("{words} {symbol}/{per} [1]"),
            None if symbol.is_empty() => format!("{words} [{unit}]"),
            None => format!("{words} {symbol} [{unit}]"),
        }
    }
}

/// The pair of a collision, if its contact has a plastic limit to measure by.
pub fn limited_pair(case: &CollisionCase) -> Option<LudingPair> {
    luding_pair(&case.contact, &case.bodies.pair()).filter(|pair| pair.dp().is_finite())
}
