//! Distributions of particle radii.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Choice;
use pulvis_math::Dimension;
use pulvis_packing::RadiusDistribution;

/// Reads `[particles.radius]`.
pub(super) fn read_radius(mut table: TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let names = ["fixed", "uniform", "normal", "log-normal", "rosin-rammler", "table", "list"];
    let name = table.selector("distribution", &names)?;
    let read = match name {
        "fixed" => length(&mut table, "value").map(|value| RadiusDistribution::Fixed { value }),
        "uniform" => {
            read_limits(&mut table).map(|(minimum, maximum)| RadiusDistribution::Uniform { minimum, maximum })
        }
        "normal" => read_normal(&mut table),
        "log-normal" => read_log_normal(&mut table),
        "rosin-rammler" => read_rosin_rammler(&mut table),
        "table" => read_cumulative(&mut table),
        _ => read_list(&mut table),
    };
    // Rosin and Rammler weighed what was left on sieves.
    let default = name == "rosin-rammler";
    let by_mass = if name == "fixed" {
        Ok(false)
    } else {
        table.or("by", Choice(&[("number", false), ("mass", true)]), default)
    };
    let read = read.and_then(|distribution| {
        Ok(if by_mass? { RadiusDistribution::ByMass(Box::new(distribution)) } else { distribution })
    });
    let checked = read.and_then(|distribution| match distribution.check() {
        Ok(()) => Ok(distribution),
        Err(invalid) => Err(table.refuse(invalid.parameter, Problem::rule(invalid.found, invalid.expected))),
    });
    table.finish();
    checked
}

fn length(table: &mut TableReader<'_>, key: &str) -> Result<f64, Reported> {
    table.required(key, QuantityRule::of(Dimension::LENGTH).above(0.0))
}

fn read_limits(table: &mut TableReader<'_>) -> Result<(f64, f64), Reported> {
    let (minimum, maximum) = (length(table, "minimum"), length(table, "maximum"));
    Ok((minimum?, maximum?))
}

fn read_normal(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let mean = length(table, "mean");
    let standard_deviation = length(table, "standard_deviation");
    let limits = read_limits(table);
    let (mean, standard_deviation, (minimum, maximum)) = (mean?, standard_deviation?, limits?);
    Ok(RadiusDistribution::Normal { mean, standard_deviation, minimum, maximum })
}

fn read_log_normal(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let median = length(table, "median");
    let sigma = table.required("sigma", QuantityRule::of(Dimension::NONE).above(0.0));
    let limits = read_limits(table);
    let (median, sigma, (minimum, maximum)) = (median?, sigma?, limits?);
    Ok(RadiusDistribution::LogNormal { median, sigma, minimum, maximum })
}

fn read_rosin_rammler(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let scale = length(table, "scale");
    let exponent = table.required("exponent", QuantityRule::of(Dimension::NONE).above(0.0));
    let limits = read_limits(table);
    let (scale, exponent, (minimum, maximum)) = (scale?, exponent?, limits?);
    Ok(RadiusDistribution::RosinRammler { scale, exponent, minimum, maximum })
}

fn read_cumulative(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let lengths = List::of(QuantityRule::of(Dimension::LENGTH).above(0.0)).at_least(2);
    let radii = table.required("radii", lengths);
    let shares = List::of(QuantityRule::of(Dimension::NONE).at_least(0.0)).at_least(2);
    let cumulative = table.required("cumulative", shares);
    Ok(RadiusDistribution::Table { radii: radii?, cumulative: cumulative? })
}

fn read_list(table: &mut TableReader<'_>) -> Result<RadiusDistribution, Reported> {
    let values =
        table.required("values", List::of(QuantityRule::of(Dimension::LENGTH).above(0.0)).at_least(1));
    let weights = table.optional("weights", List::of(QuantityRule::of(Dimension::NONE).at_least(0.0)));
    let values = values?;
    let weights = weights?.unwrap_or_else(|| vec![1.0; values.len()]);
    if weights.len() != values.len() {
        let expected = format!("one weight for each of the {} radii", values.len());
        return Err(table.refuse("weights", Problem::WrongLength { found: weights.len(), expected }));
    }
    Ok(RadiusDistribution::List { values, weights })
}
