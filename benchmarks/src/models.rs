//! The contact models of the workloads, written as a scenario would write them.

use clap::ValueEnum;
use pulvis_contact::ContactModel;
use pulvis_input::{Document, read_contact_model};

use crate::failure::Failure;

/// Which laws act between the particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LawChoice {
    /// Linear spring and dashpot, sliding.
    Linear,
    /// Luding's hysteretic law, sliding.
    Luding,
    /// Luding's hysteretic law, sliding, rolling, torsion.
    LudingFull,
    /// Hertz's law, Tsuji's dashpot, Mindlin's sliding.
    Hertz,
    /// The law of Johnson, Kendall and Roberts, Tsuji's dashpot, Mindlin's sliding.
    Jkr,
}

/// Whose reading of the same laws is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ConventionChoice {
    /// Pulvis's own: Luding 2008.
    Own,
    /// That of the code which the law is compared with: LAMMPS gran/hooke/history for the linear law,
    /// LIGGGHTS for the hysteretic ones.
    Peer,
}

const SLIDING: &str = "[sliding]\nlaw = \"spring-slider\"\nkt = \"80 N/m\"\nmu = 0.5\n";

/// LIGGGHTS's `luding` model gives the tangential spring the stiffness k1, whatever else its input says.
const SLIDING_OF_LUDING: &str = "[sliding]\nlaw = \"spring-slider\"\nkt = \"100 N/m\"\nmu = 0.5\n";

/// The peers' inputs have no torsion; the values are those of their rolling spring.
const ROLLING_AND_TORSION: &str = "\
[rolling]\nlaw = \"spring-slider\"\nkr = \"80 N/m\"\nmu_r = 0.1
[torsion]\nlaw = \"spring-slider\"\nko = \"80 N/m\"\nmu_o = 0.1\n";

/// LIGGGHTS sets the dashpot of its `luding` model by a coefficient of restitution of the spring k1.
/// With 0.6 it is 2.597e-3 kg/s for two spheres of the mean mass, where the linear law has 2.618e-3.
const LUDING: &str = "\
[normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"50 N/m\"\nphi_f = 0.05
[viscosity]\nlaw = \"restitution\"\nrestitution = 0.6\nstiffness = \"100 N/m\"\n";

const LAMMPS: &str = "\
[conventions]\nfriction_reference = \"total\"\nlever_arm = \"radius\"\nspring_rotation = \"project\"\n";

/// Young's modulus 10 MPa, Poisson's ratio 0.3, restitution 0.6: E* = E/(2 (1 − ν²)), G* = E/(4 (2 − ν)(1 + ν)).
const ELASTIC: &str = "effective_modulus = \"5.494505494505495e6 Pa\"\n";
const TSUJI: &str = "[viscosity]\nlaw = \"tsuji\"\nrestitution = 0.6\n";
const MINDLIN: &str =
    "[sliding]\nlaw = \"mindlin\"\neffective_shear_modulus = \"1.1312217194570136e6 Pa\"\nmu = 0.5\n";

/// Its `tangential history` limits friction by the normal force alone; its `tan_luding` adds kc δ.
const LIGGGHTS: &str = "\
[conventions]\nfriction_reference = \"total\"\nspring_rotation = \"project\"\n";

/// The contact model of a workload; `damping_rate` is the linear law's dashpot over the reduced mass
/// [1/s].
pub(crate) fn model(
    law: LawChoice,
    damping_rate: f64,
    conventions: ConventionChoice,
) -> Result<ContactModel, Failure> {
    let (normal, sliding) = match law {
        LawChoice::Linear => {
            let dashpot = format!("damping_rate = \"{damping_rate} 1/s\"\n");
            (format!("[normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n{dashpot}"), SLIDING)
        }
        LawChoice::Luding | LawChoice::LudingFull => (LUDING.to_owned(), SLIDING_OF_LUDING),
        LawChoice::Hertz => (format!("[normal]\nlaw = \"hertz\"\n{ELASTIC}{TSUJI}"), MINDLIN),
        // LAMMPS's 0.01 J/m² is that of one surface.
        LawChoice::Jkr => {
            let adhesion = "work_of_adhesion = \"0.02 N/m\"\n";
            (format!("[normal]\nlaw = \"jkr\"\n{ELASTIC}{adhesion}{TSUJI}"), MINDLIN)
        }
    };
    let turning = if law == LawChoice::LudingFull { ROLLING_AND_TORSION } else { "" };
    let conventions = match (conventions, law) {
        (ConventionChoice::Own, _) => "",
        (ConventionChoice::Peer, LawChoice::Linear | LawChoice::Hertz | LawChoice::Jkr) => LAMMPS,
        (ConventionChoice::Peer, _) => LIGGGHTS,
    };
    read(&format!("{normal}{sliding}{turning}{conventions}"))
}

/// A contact model from the text of its tables.
pub(crate) fn read(text: &str) -> Result<ContactModel, Failure> {
    Ok(Document::from_str("contact", text)?.read(read_contact_model)?)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_math::elementary;

    use super::*;

    #[test]
    fn every_law_can_be_read_in_both_conventions() {
        for &law in LawChoice::value_variants() {
            for &conventions in ConventionChoice::value_variants() {
                let model = model(law, 4000.0, conventions).unwrap();
                assert!(model.laws.sliding.is_some());
                assert_eq!(model.laws.torsion.is_some(), law == LawChoice::LudingFull);
            }
        }
    }

    #[test]
    fn both_laws_damp_the_mean_pair_alike_within_one_percent() {
        use pulvis_contact::Pair;
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 2500.0 * elementary::powi(0.5e-3, 3);
        let pair = Pair::spheres(mass, mass, 0.5e-3, 0.5e-3);
        let luding = model(LawChoice::Luding, 0.0, ConventionChoice::Own).unwrap();
        let dashpot = luding.laws.viscosity.largest_coefficient(&pair, 500.0);
        assert!((dashpot / (4000.0 * pair.reduced_mass()) - 1.0).abs() < 1e-2);
    }
}
