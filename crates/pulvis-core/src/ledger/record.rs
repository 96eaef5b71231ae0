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
        let ContactEnergies {
            elastic_normal,
            elastic_sliding,
            elastic_rolling,
            elastic_torsion,
            adhesive_potential,
            dissipated_plastic,
            dissipated_adhesive,
            dissipated_sliding,
            dissipated_rolling,
            dissipated_torsion,
            viscous_power,
        } = contacts;
        let mut writer = NumberWriter::default();
        for (name, value) in [
            ("elastic_normal", elastic_normal),
            ("elastic_sliding", elastic_sliding),
            ("elastic_rolling", elastic_rolling),
            ("elastic_torsion", elastic_torsion),
            ("adhesive_potential", adhesive_potential),
            ("dissipated_plastic", dissipated_plastic),
            ("dissipated_adhesive", dissipated_adhesive),
            ("dissipated_sliding", dissipated_sliding),
            ("dissipated_rolling", dissipated_rolling),
            ("dissipated_torsion", dissipated_torsion),
            ("viscous_power", viscous_power),
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
        let contacts = ContactEnergies {
            elastic_normal: reader.number("elastic_normal")?,
            elastic_sliding: reader.number("elastic_sliding")?,
            elastic_rolling: reader.number("elastic_rolling")?,
            elastic_torsion: reader.number("elastic_torsion")?,
            adhesive_potential: reader.number("adhesive_potential")?,
            dissipated_plastic: reader.number("dissipated_plastic")?,
            dissipated_adhesive: reader.number("dissipated_adhesive")?,
            dissipated_sliding: reader.number("dissipated_sliding")?,
            dissipated_rolling: reader.number("dissipated_rolling")?,
            dissipated_torsion: reader.number("dissipated_torsion")?,
            viscous_power: reader.number("viscous_power")?,
        };
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
