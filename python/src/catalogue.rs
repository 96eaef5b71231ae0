//! The catalogue of contact laws.

use pulvis_contact::catalogue::{InvalidParameter, Kind, Law, LawEntry, Parameter, Presence, Role, Values};
use pulvis_contact::{Conventions, ExpectedLoading, NonContact, Normal, Viscosity, bond, friction};
use pulvis_input::contact::entries;
use pulvis_input::{Document, Text, read_parameters, refuse_parameter};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::errors;

/// All laws of all roles, as dictionaries.
#[pyfunction]
pub fn catalogue(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let all = Role::ALL.into_iter().flat_map(entries).map(|entry| describe(py, entry));
    PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)
}

fn describe<'py>(py: Python<'py>, entry: &LawEntry) -> PyResult<Bound<'py, PyDict>> {
    let law = PyDict::new(py);
    law.set_item("role", entry.role.key())?;
    law.set_item("name", entry.name)?;
    law.set_item("summary", entry.summary)?;
    law.set_item("equations", entry.equations)?;
    law.set_item("source", entry.source)?;
    law.set_item("memory", entry.memory.to_vec())?;
    law.set_item("closed_form", entry.closed_form)?;
    law.set_item("example", entry.example)?;
    let all = |parameters: &[Parameter]| {
        parameters.iter().map(|parameter| describe_parameter(py, parameter)).collect::<PyResult<Vec<_>>>()
    };
    law.set_item("parameters", all(entry.parameters)?)?;
    law.set_item("particle_quantities", all(entry.particle_quantities)?)?;
    Ok(law)
}

fn describe_parameter<'py>(py: Python<'py>, parameter: &Parameter) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("name", parameter.name)?;
    described.set_item("symbol", parameter.symbol)?;
    described.set_item("unit", parameter.unit())?;
    described.set_item("allowed", parameter.allowed())?;
    described.set_item("default", parameter.default_text())?;
    described.set_item("meaning", parameter.meaning)?;
    described.set_item("required", parameter.presence == Presence::Required && parameter.mixing.is_none())?;
    let choices = match parameter.kind {
        Kind::Choice(options) => Some(options.iter().map(|option| (option.name, option.meaning)).collect()),
        Kind::Number { .. } | Kind::Numbers { .. } => None::<Vec<_>>,
    };
    described.set_item("is_list", matches!(parameter.kind, Kind::Numbers { .. }))?;
    described.set_item("choices", choices)?;
    Ok(described)
}

/// Refuses a law whose table of parameters, a TOML text with numbers in SI, is wrong.
#[pyfunction]
pub fn check_law(role: &str, name: &str, text: &str) -> PyResult<()> {
    let Some(role) = Role::ALL.into_iter().find(|known| known.key() == role) else {
        return Err(errors::misuse(format!("there is no role `{role}`")));
    };
    let Some(entry) = entries(role).into_iter().find(|entry| entry.name == name) else {
        return Err(errors::misuse(format!("there is no law `{name}` of the role `{}`", role.key())));
    };
    // A text without any key would be refused as an empty file.
    let named = format!("law = \"{name}\"");
    let document =
        Document::from_str(&format!("<law {name}>"), if text.trim().is_empty() { &named } else { text });
    let checked = document.and_then(|document| {
        document.with_numbers_in_si().read(|mut table| {
            // The name is part of the table in a scenario.
            let _ = table.optional("law", Text);
            let values = read_parameters(&mut table, entry.parameters);
            let built = values.and_then(|values| {
                let fitting = entry.complete(&values).and_then(|values| build(role, name, &values));
                fitting.map_err(|error| refuse_parameter(&table, error))
            });
            table.finish();
            built
        })
    });
    checked.map_err(|errors| errors::bad_input(&errors, ""))
}

/// Builds the law, to hear whether its parameters fit together.
fn build(role: Role, name: &str, values: &Values) -> Result<(), InvalidParameter> {
    let refused = match role {
        Role::Normal => Normal::build(name, values).and_then(Result::err),
        Role::NonContact => NonContact::build(name, values).and_then(Result::err),
        Role::Viscosity => Viscosity::build(name, values).and_then(Result::err),
        Role::Sliding | Role::Rolling | Role::Torsion => {
            friction::build(role, name, values).and_then(Result::err)
        }
        Role::Bond => bond::build(name, values).and_then(Result::err),
        Role::Conventions => Conventions::from_values(values).err(),
        Role::Expected => ExpectedLoading::from_values(values).err(),
    };
    refused.map_or(Ok(()), Err)
}
