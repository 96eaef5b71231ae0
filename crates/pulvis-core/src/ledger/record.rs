//! What the ledger has added up, as numbers with names.

use pulvis_contact::ContactEnergies;

use super::Running;
use crate::columns::{NameError, NamedNumbers, NumberReader, NumberWriter};

impl Running {
    /// All of it.
    pub(crate) fn numbers(&self) -> NamedNumbers {
        let Self {
            contacts,
            viscous,
            background,
            background_power,
            gravity_wrapped,
            switched,
            inflow,
            outflow,
            initial,
            scale,
        } = *self;
        let mut writer = NumberWriter::default();
        for (name, value) in contacts.accounts() {
            writer.number(name, value);
        }
        for (name, value) in [
            ("viscous", viscous),
            ("background", background),
            ("background_power", background_power),
            ("gravity_wrapped", gravity_wrapped),
            ("switched", switched),
            ("inflow", inflow),
            ("outflow", outflow),
            ("initial", initial),
            ("scale", scale),
        ] {
            writer.number(name, value);
        }
        writer.finish()
    }

    /// From all of it.
    pub(crate) fn from_numbers(mut reader: NumberReader<'_>) -> Result<Self, NameError> {
        let contacts = ContactEnergies::from_accounts(|name| reader.number(name))?;
        let running = Self {
            contacts,
            viscous: reader.number("viscous")?,
            background: reader.number("background")?,
            background_power: reader.number("background_power")?,
            gravity_wrapped: reader.number("gravity_wrapped")?,
            switched: reader.number("switched")?,
            inflow: reader.number("inflow")?,
            outflow: reader.number("outflow")?,
            initial: reader.number("initial")?,
            scale: reader.number("scale")?,
        };
        reader.finish()?;
        Ok(running)
    }
}
