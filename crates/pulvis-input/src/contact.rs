//! All laws of one contact, read as the catalogue describes them.

use crate::context::Reported;
use crate::material::MaterialProperties;
use crate::parameters::{read_parameters, refuse_parameter};
use crate::problem::Problem;
use crate::reader::TableReader;
use pulvis_contact::catalogue::mixing::Mixing;
use pulvis_contact::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Role, Value, Values};
use pulvis_contact::{
    ContactLaws, ContactModel, Conventions, ExpectedLoading, Friction, NonContact, Normal, Pair, Viscosity,
    bond, friction,
};
use std::fmt;

/// A law by its name in the catalogue, with its parameters.
#[derive(Clone, Debug)]
pub struct NamedLaw {
    /// Which part of the contact it is.
    pub role: Role,
    /// Its name in the catalogue.
    pub name: &'static str,
    /// Its parameters in SI, defaults filled in.
    pub values: Values,
    /// The rules of those parameters that follow from the properties of the materials, by the parameters' names.
    pub mixed: Vec<(&'static str, &'static Mixing)>,
}

// A law with the same parameters is the same law, wherever they are from.
impl PartialEq for NamedLaw {
    fn eq(&self, other: &Self) -> bool {
        (self.role, self.name, &self.values) == (other.role, other.name, &other.values)
    }
}

/// The name and the parameters: `hertz: effective_modulus = 3.8e10 Pa (effective-modulus of the materials)`.
impl fmt::Display for NamedLaw {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name)?;
        let entry = entries(self.role).into_iter().find(|entry| entry.name == self.name);
        let parameters = entry.map_or(&[][..], |entry| entry.parameters);
        let given =
            parameters.iter().filter_map(|parameter| Some((parameter, self.values.get(parameter.name)?)));
        for (number, (parameter, value)) in given.enumerate() {
            out.write_str(if number == 0 { ": " } else { ", " })?;
            match (value, parameter.unit().as_str()) {
                (Value::Choice(name), _) => write!(out, "{} = {name}", parameter.name)?,
                (Value::Number(number), "1") => write!(out, "{} = {}", parameter.name, six_digits(*number))?,
                (Value::Number(number), unit) => {
                    write!(out, "{} = {} {unit}", parameter.name, six_digits(*number))?;
                }
                (Value::Numbers(numbers), unit) => {
                    let last = six_digits(numbers.last().copied().unwrap_or(f64::NAN));
                    write!(out, "{} = {} values up to {last} {unit}", parameter.name, numbers.len())?;
                }
            }
            if let Some((_, mixing)) = self.mixed.iter().find(|(name, _)| *name == parameter.name) {
                write!(out, " (of the materials by {})", mixing.name)?;
            }
        }
        Ok(())
    }
}

/// A number with at most six digits.
fn six_digits(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    let size = rounded.abs();
    if rounded == 0.0 || (1e-3..1e6).contains(&size) || !rounded.is_finite() {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// A contact, ready to be computed, and the names and parameters that it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedContact {
    /// The contact.
    pub model: ContactModel,
    /// Its laws, one of each role, in the order of [`Role::ALL`].
    pub laws: Vec<NamedLaw>,
}

/// Reads the tables `normal`, `noncontact`, … of one contact. All but `normal` may be left out.
///
/// # Errors
/// Laws or parameters are missing, unknown, out of range or contradict each other.
pub fn read_contact_model(table: TableReader<'_>) -> Result<ContactModel, Reported> {
    read_contact(table, None).map(|contact| contact.model)
}

/// As [`read_contact_model`], with the names and parameters of the laws. Parameters that follow from the properties of
/// the two materials need not be given where the `materials` have these.
///
/// # Errors
/// As of [`read_contact_model`].
pub fn read_contact(
    table: TableReader<'_>,
    materials: Option<[&MaterialProperties; 2]>,
) -> Result<NamedContact, Reported> {
    read_laws(table, Known { materials, base: None })
}

/// As [`read_contact`], where laws that the table leaves out are those of `base`.
pub(crate) fn read_contact_beside(
    table: TableReader<'_>,
    base: &NamedContact,
) -> Result<NamedContact, Reported> {
    read_laws(table, Known { materials: None, base: Some(base) })
}

/// What is known of a contact beside its own table.
#[derive(Clone, Copy)]
struct Known<'k> {
    /// The properties of the two materials.
    materials: Option<[&'k MaterialProperties; 2]>,
    /// The contact whose laws stand in for those that are left out.
    base: Option<&'k NamedContact>,
}

impl Known<'_> {
    /// The law that stands in for one that is left out.
    fn law(&self, role: Role) -> Option<NamedLaw> {
        self.base?.laws.iter().find(|law| law.role == role).cloned()
    }
}

fn read_laws(mut table: TableReader<'_>, known: Known<'_>) -> Result<NamedContact, Reported> {
    let normal = read_law(&mut table, known, Role::Normal, Normal::build);
    let noncontact = read_law(&mut table, known, Role::NonContact, NonContact::build);
    let viscosity = read_law(&mut table, known, Role::Viscosity, Viscosity::build);
    let mut slider =
        |role| read_law(&mut table, known, role, |name, values| friction::build(role, name, values));
    let (sliding, rolling, torsion) = (slider(Role::Sliding), slider(Role::Rolling), slider(Role::Torsion));
    let bond = read_law(&mut table, known, Role::Bond, bond::build);
    let conventions = read_choices(&mut table, known);
    let expected = read_choices(&mut table, known);
    let without_area =
        [&sliding, &rolling, &torsion].into_iter().find_map(|friction| lacks_area(&table, &normal, friction));
    table.finish();
    if let Some(reported) = without_area {
        return Err(reported);
    }
    let (normal, normal_law) = normal?;
    let (noncontact, noncontact_law) = noncontact?;
    let (viscosity, viscosity_law) = viscosity?;
    let (sliding, sliding_law) = sliding?;
    let (rolling, rolling_law) = rolling?;
    let (torsion, torsion_law) = torsion?;
    let (bond, bond_law) = bond?;
    let (conventions, choices) = conventions?;
    let (expected, expectation): (ExpectedLoading, _) = expected?;
    let laws = ContactLaws { noncontact, viscosity, sliding, rolling, torsion, bond, conventions, expected };
    let named = vec![
        normal_law,
        noncontact_law,
        viscosity_law,
        sliding_law,
        rolling_law,
        torsion_law,
        bond_law,
        choices,
        expectation,
    ];
    Ok(NamedContact { model: ContactModel { normal, laws }, laws: named })
}

/// Reports a friction law that takes its stiffness from the contact area, beside a normal law that knows none: it would
/// resist nothing.
fn lacks_area(
    contact: &TableReader<'_>,
    normal: &Result<(Normal, NamedLaw), Reported>,
    friction: &Result<(Option<Friction>, NamedLaw), Reported>,
) -> Option<Reported> {
    let (Ok((normal, normal_law)), Ok((Some(law), friction_law))) = (normal, friction) else { return None };
    let pair = Pair::spheres(1.0, 1.0, 1.0, 1.0);
    if !law.needs_contact_radius() || normal.expected_contact_radius(&pair, &ExpectedLoading::default()) > 0.0
    {
        return None;
    }
    let found = format!(
        "\"{}\" follows the radius of the contact area, which the normal law \"{}\" does not know",
        friction_law.name, normal_law.name
    );
    let expected =
        "a normal law of elastic spheres, such as \"hertz\" or \"jkr\", or another law here".to_owned();
    Some(contact.refuse(friction_law.role.key(), Problem::Rule { found, expected }))
}

/// The laws of the catalogue that can play a role.
pub fn entries(role: Role) -> Vec<&'static LawEntry> {
    match role {
        Role::Normal => Normal::ENTRIES.iter().collect(),
        Role::NonContact => NonContact::ENTRIES.iter().collect(),
        Role::Viscosity => Viscosity::ENTRIES.iter().collect(),
        Role::Sliding | Role::Rolling | Role::Torsion => friction::entries(role),
        Role::Bond => bond::entries(),
        Role::Conventions => vec![&Conventions::ENTRY],
        Role::Expected => vec![&ExpectedLoading::ENTRY],
    }
}

/// Reads the table of one role: `law`, and the parameters of the law that it names.
fn read_law<L>(
    contact: &mut TableReader<'_>,
    known: Known<'_>,
    role: Role,
    build: impl Fn(&str, &Values) -> Option<Result<L, InvalidParameter>>,
) -> Result<(L, NamedLaw), Reported> {
    let entries = entries(role);
    let names: Vec<&str> = entries.iter().map(|entry| entry.name).collect();
    let table = match role {
        Role::Normal if known.base.is_none() => Some(contact.required_table(role.key())?),
        _ => contact.optional_table(role.key())?,
    };
    let Some(mut table) = table else {
        let unknown = || contact.refuse(role.key(), Problem::unknown_choice("none", &names));
        let none = || {
            let none = entries.iter().find(|entry| entry.name == "none")?;
            Some(NamedLaw { role, name: none.name, values: Values::new(), mixed: Vec::new() })
        };
        let named = known.law(role).or_else(none).ok_or_else(unknown)?;
        let law = build(named.name, &named.values).ok_or_else(unknown)?;
        return Ok((law.map_err(|error| refuse_parameter(contact, error))?, named));
    };
    let name = table.selector("law", &names)?;
    let unknown = |table: &TableReader<'_>| table.refuse("law", Problem::unknown_choice(name, &names));
    let entry = entries.iter().find(|entry| entry.name == name).ok_or_else(|| unknown(&table))?;
    let law = read_parameters(&mut table, entry.parameters).and_then(|mut values| {
        let mut mixed = Vec::new();
        for parameter in entry.parameters {
            mixed.extend(mix(&table, parameter, known.materials, &mut values)?);
        }
        let values = entry.complete(&values).map_err(|error| refuse_parameter(&table, error))?;
        let law = build(name, &values).ok_or_else(|| unknown(&table))?;
        let law = law.map_err(|error| refuse_parameter(&table, error))?;
        Ok((law, NamedLaw { role, name: entry.name, values, mixed }))
    });
    table.finish();
    law
}

/// Sets a parameter that is not given from the properties of the two materials, where there is a rule for that; answers
/// with its name and the rule.
fn mix(
    table: &TableReader<'_>,
    parameter: &'static Parameter,
    materials: Option<[&MaterialProperties; 2]>,
    values: &mut Values,
) -> Result<Option<(&'static str, &'static Mixing)>, Reported> {
    let Some(mixing) = parameter.mixing.filter(|_| values.get(parameter.name).is_none()) else {
        return Ok(None);
    };
    let of = |material: &MaterialProperties| -> Option<Vec<f64>> {
        mixing.needs.iter().map(|property| material.number(property.name)).collect()
    };
    if let Some([one, other]) = materials
        && let (Some(one), Some(other)) = (of(one), of(other))
    {
        values.set(parameter.name, Value::Number((mixing.rule)(&one, &other)));
        return Ok(Some((parameter.name, mixing)));
    }
    let needs: Vec<String> = mixing.needs.iter().map(|property| format!("`{}`", property.name)).collect();
    let needs = needs.join(" and ");
    let expected = format!("{} [{}], or {needs} of both materials", parameter.meaning, parameter.unit());
    Err(table.refuse(parameter.name, Problem::MissingKey { key: parameter.name.to_owned(), expected }))
}

/// Reads the table of a role that one entry plays, which holds parameters and names no law.
fn read_choices<L: Law>(contact: &mut TableReader<'_>, known: Known<'_>) -> Result<(L, NamedLaw), Reported> {
    let entry = &L::ENTRY;
    let given = match contact.optional_table(entry.role.key())? {
        Some(mut table) => {
            let values = read_parameters(&mut table, entry.parameters);
            table.finish();
            values?
        }
        None => known.law(entry.role).map_or_else(Values::new, |law| law.values),
    };
    let built = entry.complete(&given).and_then(|values| Ok((L::from_values(&values)?, values)));
    let (choices, values) = built.map_err(|error| refuse_parameter(contact, error))?;
    Ok((choices, NamedLaw { role: entry.role, name: entry.name, values, mixed: Vec::new() }))
}
