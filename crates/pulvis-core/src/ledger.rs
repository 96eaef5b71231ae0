//! The energy ledger: all energies of a simulation, account by account.

mod record;

use pulvis_contact::ContactEnergies;

/// All accounts at one time: stored energy, dissipated energy and external work. Their balance is the
/// [closing error](Ledger::closing_error).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Kinetic energy of translation [J]; that of particles with a prescribed motion is not counted.
    pub kinetic_translation: f64,
    /// Kinetic energy of rotation [J], of the same particles.
    pub kinetic_rotation: f64,
    /// −dt²/8 Σ (f²/m + τ²/I): the part of the discrete energy that velocity-Verlet conserves beside the kinetic energy. With
    /// the work of the forces by the trapezoidal rule, K − dt²/8 Σ f²/m changes by exactly that work in every step. Without
    /// this term the ledger would show an error where there is none [J].
    pub kinetic_discretisation: f64,
    /// Stored by normal laws on their elastic branches [J].
    pub elastic_normal: f64,
    /// Stored in sliding springs [J].
    pub elastic_sliding: f64,
    /// Stored in rolling springs [J].
    pub elastic_rolling: f64,
    /// Stored in torsion springs [J].
    pub elastic_torsion: f64,
    /// Stored in the springs of bonds [J].
    pub elastic_bond: f64,
    /// Potential of attraction at a distance [J].
    pub adhesive: f64,
    /// Potential of liquid bridges, zero where they break [J].
    pub capillary: f64,
    /// Potential of charges [J].
    pub electrostatic: f64,
    /// Potential in the gravity field [J].
    pub gravity: f64,
    /// Dissipated by plastic deformation of contacts [J].
    pub dissipated_plastic: f64,
    /// Dissipated on adhesive limit branches and by attraction that sets in suddenly [J].
    pub dissipated_adhesive: f64,
    /// Dissipated by liquid bridges, when they form: nobody does the work that it takes to break them [J].
    pub dissipated_capillary: f64,
    /// Dissipated by bonds that broke [J].
    pub dissipated_fracture: f64,
    /// Dissipated because parameters of contacts changed with time or temperature; work that such a change did on contacts
    /// counts as negative [J].
    pub dissipated_thermal: f64,
    /// Dissipated by dashpots of contacts [J].
    pub dissipated_viscous: f64,
    /// Dissipated by sliding [J].
    pub dissipated_sliding: f64,
    /// Dissipated by rolling slip [J].
    pub dissipated_rolling: f64,
    /// Dissipated by torsion slip [J].
    pub dissipated_torsion: f64,
    /// Dissipated by background drag [J].
    pub dissipated_background: f64,
    /// Work done on the particles by walls, and by particles, with a prescribed motion [J].
    pub work_walls: f64,
    /// Work done on the particles by servo-controlled walls [J].
    pub work_servo: f64,
    /// Work done on the particles by the deformation of the periodic cell [J].
    pub work_cell: f64,
    /// Change of the stored energy by switches of laws, walls or the time step, and by what a program sets between steps; work of
    /// forces that a program applies [J].
    pub switched: f64,
    /// Energy of inserted particles, with that stored in their contacts [J].
    pub inflow: f64,
    /// Energy of removed particles, with that stored in their contacts [J].
    pub outflow: f64,
    /// Stored energy at the start [J].
    pub initial: f64,
    /// The largest sum of kinetic, elastic and dissipated energy so far: the scale of relative errors [J].
    pub scale: f64,
}

impl Ledger {
    /// Kinetic energy [J].
    pub fn kinetic(&self) -> f64 {
        self.kinetic_translation + self.kinetic_rotation
    }

    /// Elastic energy of all springs [J].
    pub fn elastic(&self) -> f64 {
        self.elastic_normal
            + self.elastic_sliding
            + self.elastic_rolling
            + self.elastic_torsion
            + self.elastic_bond
    }

    /// Potential of all attraction at a distance [J].
    pub fn attraction(&self) -> f64 {
        self.adhesive + self.capillary + self.electrostatic
    }

    /// All stored energy [J].
    pub fn stored(&self) -> f64 {
        self.kinetic() + self.kinetic_discretisation + self.elastic() + self.attraction() + self.gravity
    }

    /// All dissipated energy [J].
    pub fn dissipated(&self) -> f64 {
        self.dissipated_plastic
            + self.dissipated_adhesive
            + self.dissipated_capillary
            + self.dissipated_fracture
            + self.dissipated_thermal
            + self.dissipated_viscous
            + self.dissipated_sliding
            + self.dissipated_rolling
            + self.dissipated_torsion
            + self.dissipated_background
    }

    /// All external work [J].
    pub fn work(&self) -> f64 {
        self.work_walls + self.work_servo + self.work_cell + self.switched
    }

    /// Stored + dissipated + carried out − work − carried in − stored at the start: zero for exact integration [J].
    pub fn closing_error(&self) -> f64 {
        self.stored() + self.dissipated() - self.work() - self.initial + (self.outflow - self.inflow)
    }

    /// The closing error over the scale [1]; zero where nothing has moved yet, and NaN where any energy is NaN or
    /// infinite.
    pub fn relative_error(&self) -> f64 {
        if self.scale == 0.0 { 0.0 } else { self.closing_error() / self.scale }
    }

    /// The names of all accounts with their values [J], in the order of output tables.
    pub fn accounts(&self) -> [(&'static str, f64); 28] {
        [
            ("kinetic_translation", self.kinetic_translation),
            ("kinetic_rotation", self.kinetic_rotation),
            ("kinetic_discretisation", self.kinetic_discretisation),
            ("elastic_normal", self.elastic_normal),
            ("elastic_sliding", self.elastic_sliding),
            ("elastic_rolling", self.elastic_rolling),
            ("elastic_torsion", self.elastic_torsion),
            ("elastic_bond", self.elastic_bond),
            ("adhesive", self.adhesive),
            ("capillary", self.capillary),
            ("electrostatic", self.electrostatic),
            ("gravity", self.gravity),
            ("dissipated_plastic", self.dissipated_plastic),
            ("dissipated_adhesive", self.dissipated_adhesive),
            ("dissipated_capillary", self.dissipated_capillary),
            ("dissipated_fracture", self.dissipated_fracture),
            ("dissipated_thermal", self.dissipated_thermal),
            ("dissipated_viscous", self.dissipated_viscous),
            ("dissipated_sliding", self.dissipated_sliding),
            ("dissipated_rolling", self.dissipated_rolling),
            ("dissipated_torsion", self.dissipated_torsion),
            ("dissipated_background", self.dissipated_background),
            ("work_walls", self.work_walls),
            ("work_servo", self.work_servo),
            ("work_cell", self.work_cell),
            ("switched", self.switched),
            ("inflow", self.inflow),
            ("outflow", self.outflow),
        ]
    }
}

/// The sums that are carried from step to step, from which a [`Ledger`] is made when asked for.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Running {
    /// Stored energies and powers now, dissipated energies so far.
    pub(crate) contacts: ContactEnergies,
    pub(crate) viscous: f64,
    pub(crate) background: f64,
    background_power: f64,
    /// Correction of the gravity potential for wrapped positions: a particle that falls through a periodic boundary falls on.
    pub(crate) gravity_wrapped: f64,
    pub(crate) switched: f64,
    pub(crate) inflow: f64,
    pub(crate) outflow: f64,
    pub(crate) initial: f64,
    pub(crate) scale: f64,
}

impl Running {
    /// Resets dissipated energies: those of contacts that exist at the start are not booked.
    pub(crate) fn forget_losses(&mut self) {
        self.set_losses(&ContactEnergies::default());
    }

    /// Sets dissipated energies to those `before` an insertion: what inserted contacts dissipated earlier is not booked.
    pub(crate) fn set_losses(&mut self, before: &ContactEnergies) {
        self.contacts = self.contacts.with_dissipated_of(before);
    }

    /// Adds the energies of contacts and the power of the background at the end of a step. Powers are integrated by the
    /// trapezoidal rule: the work of a force over its two half kicks is exactly the force times the velocity at its time.
    pub(crate) fn take_in(&mut self, now: ContactEnergies, background_power: f64, time_step: f64) {
        self.viscous += 0.5 * time_step * (self.contacts.viscous_power + now.viscous_power);
        self.background += 0.5 * time_step * (self.background_power + background_power);
        self.background_power = background_power;
        self.contacts = now.plus_dissipated_of(&self.contacts);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_held_lost_and_done_must_balance() {
        let ledger = Ledger {
            kinetic_translation: 3.0,
            elastic_normal: 1.0,
            dissipated_plastic: 2.0,
            work_walls: 1.0,
            initial: 5.0,
            scale: 6.0,
            ..Ledger::default()
        };
        assert_eq!(ledger.closing_error(), 0.0);
        assert_eq!(Ledger { work_servo: 3.0, ..ledger }.relative_error(), -0.5);
        assert_eq!(Ledger { inflow: 2.0, outflow: 5.0, ..ledger }.closing_error(), 3.0);
    }

    #[test]
    fn an_energy_that_is_not_finite_is_no_small_error() {
        for energy in [f64::NAN, f64::INFINITY] {
            let ledger = Ledger { kinetic_translation: energy, scale: energy, ..Ledger::default() };
            assert!(ledger.relative_error().is_nan());
        }
        assert_eq!(Ledger::default().relative_error(), 0.0);
    }

    #[test]
    fn every_account_is_listed_and_summed() {
        let ledger = Ledger {
            kinetic_translation: 1.0,
            kinetic_rotation: 2.0,
            kinetic_discretisation: 4.0,
            elastic_normal: 8.0,
            elastic_sliding: 16.0,
            elastic_rolling: 32.0,
            elastic_torsion: 64.0,
            elastic_bond: 2048.0,
            adhesive: 128.0,
            gravity: 256.0,
            capillary: 512.0,
            electrostatic: 1024.0,
            ..Ledger::default()
        };
        let listed: f64 = ledger.accounts().iter().map(|(_, value)| value).sum();
        assert_eq!(listed, ledger.stored());
        assert_eq!(listed, 4095.0);
        let ledger = Ledger {
            dissipated_plastic: 1.0,
            dissipated_adhesive: 2.0,
            dissipated_capillary: 4.0,
            dissipated_fracture: 8.0,
            dissipated_thermal: 16.0,
            dissipated_viscous: 32.0,
            dissipated_sliding: 64.0,
            dissipated_rolling: 128.0,
            dissipated_torsion: 256.0,
            dissipated_background: 512.0,
            ..Ledger::default()
        };
        let listed: f64 = ledger.accounts().iter().map(|(_, value)| value).sum();
        assert_eq!((listed, ledger.dissipated()), (1023.0, 1023.0));
    }
}
