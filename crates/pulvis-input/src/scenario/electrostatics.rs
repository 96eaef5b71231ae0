//! Charges that act on each other over all distances.

use super::columns::{ParticleColumn, Reader, needs_quantity};
use super::contacts::Contact;
use super::particles::PlacedGroup;
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_boundary::{Domain, Electrostatics};
use pulvis_contact::catalogue::{Parameter, Range};
use pulvis_math::Dimension;

/// What all particles must have then.
const CHARGE: Parameter =
    Parameter::number("charge", "q", Dimension::CHARGE, Range::Any, "charge of a particle");

/// Reads `[electrostatics]`.
pub(super) fn read_electrostatics(
    root: &mut TableReader<'_>,
    domain: Option<&Domain>,
) -> Result<Option<Electrostatics>, Reported> {
    let Some(mut table) = root.optional_table("electrostatics")? else { return Ok(None) };
    let permittivity =
        table.or("relative_permittivity", QuantityRule::of(Dimension::NONE).at_least(1.0), 1.0);
    table.finish();
    let relative_permittivity = permittivity?;
    if domain.is_some() {
        let problem = Problem::rule(
            "the domain is periodic",
            "charges in open space: a sum over all images of the domain is not built in",
        );
        let help = "leave [domain] out, or take the attraction `coulomb` of contacts, which ends at a cutoff";
        return Err(root.refuse_with_help("electrostatics", problem, help));
    }
    Ok(Some(Electrostatics { relative_permittivity }))
}

/// Whether `particles` and `inlets` have a charge, and no law of a contact reads it beside.
pub(super) fn check_charges(
    root: &TableReader<'_>,
    columns: &[(&str, &[ParticleColumn])],
    contacts: &[Contact],
) -> Result<(), Reported> {
    columns.iter().try_for_each(|columns| needs_quantity(root, *columns, &CHARGE, Reader::Electrostatics))?;
    let reads =
        |contact: &&Contact| contact.model.particle_quantities().any(|quantity| quantity.name == CHARGE.name);
    match contacts.iter().find(reads) {
        None => Ok(()),
        Some(contact) => {
            let name = contact.model.laws.noncontact.entry().name;
            let found = format!("the law \"{name}\" of a contact reads the charge, too");
            let expected = "either [electrostatics] or such a law: each charge would act twice";
            let help = "leave the law out: [electrostatics] acts from contact to any distance";
            Err(root.refuse_with_help("electrostatics", Problem::rule(found, expected), help))
        }
    }
}

/// Refuses more charges than a sum over all pairs is meant for.
pub(super) fn check_number_of_charges(
    root: &TableReader<'_>,
    groups: &[PlacedGroup],
) -> Result<(), Reported> {
    let is_charged = |group: &&PlacedGroup| {
        group.0.columns.iter().any(|column| column.name == CHARGE.name && column.value != 0.0)
    };
    let found: usize = groups.iter().filter(is_charged).map(|(group, _)| group.count).sum();
    let most = Electrostatics::MOST_CHARGES;
    if found <= most {
        return Ok(());
    }
    let problem = Problem::rule(
        format!("{found} particles have a charge"),
        format!("at most {most}: every step takes the forces of all pairs"),
    );
    let help = "take fewer particles, or the attraction `coulomb` of contacts, which ends at a cutoff";
    Err(root.refuse_with_help("electrostatics", problem, help))
}
