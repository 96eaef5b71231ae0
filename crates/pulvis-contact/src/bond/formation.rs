//! When bonds form, and what becomes of the contact.

use crate::catalogue::{InvalidParameter, Values};

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
