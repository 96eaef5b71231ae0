//! When bonds form, and what becomes of the contact.

use super::memory::{BondMemory, INTACT};
use crate::catalogue::{InvalidParameter, Values};
use crate::kinematics::{ContactInputs, ContactKinematics};
use crate::memory::{self, Memory};
use crate::model::ContactModel;

/// When a bond forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// At the start of a stage that says so, between bodies within a distance.
    StageStart,
    /// When the bodies first touch.
    FirstTouch,
}

/// What becomes of the contact's own laws while the bodies are bonded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactSpring {
    /// They act beside the bond.
    On,
    /// They do not act. After breaking they begin at the present overlap, without a force.
    Off,
}

/// When bonds form, and what becomes of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formation {
    /// When.
    pub form: Form,
    /// The largest distance of the surfaces at which a bond forms at the start of a stage; zero for bonds that form by
    /// touch [m].
    pub distance: f64,
    /// What becomes of the contact.
    pub contact_spring: ContactSpring,
}

impl Formation {
    pub(super) fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let form = match values.choice("form")? {
            "first-touch" => Form::FirstTouch,
            _ => Form::StageStart,
        };
        let contact_spring = match values.choice("contact_spring")? {
            "off" => ContactSpring::Off,
            _ => ContactSpring::On,
        };
        let distance = match form {
            Form::StageStart => values.number("distance")?,
            Form::FirstTouch => 0.0,
        };
        Ok(Self { form, distance, contact_spring })
    }
}

impl ContactModel {
    /// The motion as the contact's own laws see it beside its bond. The bond's memory in `columns` changes as in a
    /// [response](Self::respond).
    pub fn beside_bond(&self, inputs: ContactInputs<'_, f64>, columns: &mut [f64]) -> ContactKinematics<f64> {
        let start = self.memory_layout().slots().bond;
        let bond = self.laws.bond.as_ref();
        bond.map_or(*inputs.motion, |bond| bond.respond(inputs, start, columns).beside(inputs.motion))
    }

    /// Bonds bodies at an overlap [m], if their bond forms at the start of a stage, they are near enough, and were never
    /// bonded before. Answers with whether it did. The memory stands in `columns`.
    pub fn form_bond(&self, overlap: f64, columns: &mut [f64]) -> bool {
        let Some(bond) = &self.laws.bond else { return false };
        let start = self.memory_layout().slots().bond;
        let before: BondMemory<f64> = memory::load(columns, start);
        let forms = bond.formation.form == Form::StageStart
            && before.state == 0.0
            && overlap >= -bond.formation.distance;
        if forms {
            let memory = BondMemory { overlap, state: INTACT, ..BondMemory::default() };
            memory.store(|column, value| columns[start + column] = value);
        }
        forms
    }
}
