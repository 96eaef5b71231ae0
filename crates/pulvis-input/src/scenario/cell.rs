//! How a stage deforms the periodic cell.

use super::resolved::writer::{Writer, number, quantity};
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Boolean;
use pulvis_boundary::motion::PressureRamp;
use pulvis_boundary::{CellControl, CellMotion, Domain, UpperTriangular};
use pulvis_math::Dimension;

const ISOTROPIC: &str = "isotropic";

/// The six components and the mean of the normal ones, by their keys, with a value where it is given.
type Components = [Option<f64>; 7];

/// Reads `[stages.cell]`. `wall` is one that is there in this stage.
pub(super) fn read_cell(
    stage: &mut TableReader<'_>,
    domain: Option<&Domain>,
    wall: Option<&str>,
) -> Result<Option<CellMotion>, Reported> {
    let Some(mut table) = stage.optional_table("cell")? else { return Ok(None) };
    let fixed = table.or("fixed", Boolean, false);
    let rate = read_components(&mut table, "rate", Dimension::RATE, false);
    let stress = read_components(&mut table, "stress", Dimension::PRESSURE, true);
    let from = read_components(&mut table, "from", Dimension::PRESSURE, true);
    let ramp = table.or("ramp", QuantityRule::of(Dimension::TIME).at_least(0.0), 0.0);
    let inertial = QuantityRule::of(Dimension::NONE).above(0.0);
    let inertial_number = table.or("inertial_number", inertial, CellMotion::QUASI_STATIC);
    let plan = Plan {
        fixed: fixed?,
        rate: rate?,
        stress: stress?,
        from: from?,
        ramp: ramp?,
        inertial_number: inertial_number?,
    };
    let motion = plan.motion(&table).and_then(|motion| {
        check_surroundings(&table, &motion, domain, wall)?;
        Ok(motion)
    });
    table.finish();
    motion.map(Some)
}

/// Reads a table of components, an absent one as none. Only stresses have a mean.
fn read_components(
    table: &mut TableReader<'_>,
    key: &str,
    dimension: Dimension,
    mean: bool,
) -> Result<Components, Reported> {
    let mut values = [None; 7];
    let Some(mut components) = table.optional_table(key)? else { return Ok(values) };
    let mut failure = None;
    for (name, value) in UpperTriangular::NAMES.into_iter().chain(mean.then_some(ISOTROPIC)).zip(&mut values)
    {
        match components.optional(name, dimension) {
            Ok(read) => *value = read,
            Err(reported) => failure = Some(reported),
        }
    }
    components.finish();
    failure.map_or(Ok(values), Err)
}

/// What stands in the table.
struct Plan {
    fixed: bool,
    rate: Components,
    stress: Components,
    from: Components,
    ramp: f64,
    inertial_number: f64,
}

impl Plan {
    fn motion(&self, table: &TableReader<'_>) -> Result<CellMotion, Reported> {
        self.check(table)?;
        let ramp = |component: usize| {
            self.stress[component].map(|to| {
                let duration = self.ramp;
                PressureRamp { from: self.from[component].unwrap_or(to), to, duration }
            })
        };
        let control = |component: usize| match (self.rate[component], ramp(component)) {
            (Some(rate), _) => CellControl::Rate(rate),
            (None, Some(ramp)) => CellControl::Stress(ramp),
            (None, None) => CellControl::Fixed,
        };
        let motion = CellMotion {
            components: std::array::from_fn(control),
            isotropic: ramp(6),
            inertial_number: self.inertial_number,
        };
        if motion.targets().next().is_some() && motion.largest_target() == 0.0 {
            let expected = "a stress other than 0: the servo is as fast as its largest stress says";
            return Err(table.refuse("stress", Problem::rule("all stresses are 0", expected)));
        }
        Ok(motion)
    }

    fn check(&self, table: &TableReader<'_>) -> Result<(), Reported> {
        let Self { fixed, rate, stress, from, ramp, .. } = self;
        let given = |values: &Components| values.iter().any(Option::is_some);
        let refuse =
            |key: &str, found: String, expected: &str| Err(table.refuse(key, Problem::rule(found, expected)));
        if *fixed == (given(rate) || given(stress)) {
            let found =
                if *fixed { "the cell is fixed, and deforms" } else { "the cell neither deforms nor stops" };
            return refuse("fixed", found.to_owned(), "`rate` or `stress`, or else `fixed = true`");
        }
        for (component, name) in UpperTriangular::NAMES.into_iter().chain([ISOTROPIC]).enumerate() {
            let (rated, stressed) = (rate[component].is_some(), stress[component].is_some());
            if rated && stressed {
                return refuse(
                    "stress",
                    format!("{name} has a rate and a stress"),
                    "one of them for each component",
                );
            }
            if component < 3 && (rated || stressed) && stress[6].is_some() {
                let found = format!("{name} is controlled beside the mean of xx, yy and zz");
                return refuse("stress", found, "`isotropic`, or single components");
            }
            if from[component].is_some() && !stressed {
                return refuse("from", format!("{name} follows no stress"), "components of `stress`");
            }
            let ramps = from[component].is_some() && from[component] != stress[component];
            if ramps && *ramp == 0.0 {
                let found = format!("{name} differs from `stress`, but the ramp takes no time");
                return refuse("from", found, "a `ramp` greater than 0");
            }
        }
        if *ramp > 0.0 && !given(from) {
            return refuse(
                "ramp",
                "there is no `from` to begin with".to_owned(),
                "`from` and `ramp`, or none of them",
            );
        }
        Ok(())
    }
}

/// Refuses a cell whose deformation has no direction to go, or something in its way.
fn check_surroundings(
    table: &TableReader<'_>,
    motion: &CellMotion,
    domain: Option<&Domain>,
    wall: Option<&str>,
) -> Result<(), Reported> {
    if !motion.moves() {
        return Ok(());
    }
    let Some(domain) = domain else {
        let problem = Problem::rule("there is no periodic cell to deform", "a [domain]");
        return Err(table.refuse("", problem));
    };
    for (component, axes) in UpperTriangular::INDICES.into_iter().enumerate() {
        let open = axes.into_iter().find(|&axis| !domain.periodic[axis]);
        if let (true, Some(axis)) = (motion.deforms(component), open) {
            let (name, axis) = (UpperTriangular::NAMES[component], ["x", "y", "z"][axis]);
            let found = format!("{name} deforms, but the domain is not periodic along {axis}");
            return Err(table.refuse("", Problem::rule(found, format!("{axis} in `periodic` of [domain]"))));
        }
    }
    if let Some(name) = wall {
        let found = format!("the wall {name} is there, which cannot follow the cell");
        return Err(table.refuse("", Problem::rule(found, "a cell without walls, or walls that are removed")));
    }
    Ok(())
}

/// Writes `[stages.cell]`.
pub(super) fn write_cell(writer: &mut Writer, motion: &CellMotion) {
    let controls = motion.components.iter().copied().zip(UpperTriangular::NAMES);
    let rates: Vec<String> = controls
        .clone()
        .filter_map(|(control, name)| match control {
            CellControl::Rate(rate) => Some(format!("{name} = {}", quantity(rate, Dimension::RATE))),
            CellControl::Fixed | CellControl::Stress(_) => None,
        })
        .collect();
    let ramps: Vec<(&str, PressureRamp)> = controls
        .filter_map(|(control, name)| match control {
            CellControl::Stress(ramp) => Some((name, ramp)),
            CellControl::Fixed | CellControl::Rate(_) => None,
        })
        .chain(motion.isotropic.map(|ramp| (ISOTROPIC, ramp)))
        .collect();
    if rates.is_empty() && ramps.is_empty() {
        writer.key("fixed", "true");
        return;
    }
    let table = |entries: &[String]| format!("{{ {} }}", entries.join(", "));
    if !rates.is_empty() {
        writer.key("rate", table(&rates));
    }
    let Some((_, first)) = ramps.first() else { return };
    let pressures = |value: fn(&PressureRamp) -> f64| -> Vec<String> {
        let entry = |(name, ramp): &(&str, PressureRamp)| {
            format!("{name} = {}", quantity(value(ramp), Dimension::PRESSURE))
        };
        ramps.iter().map(entry).collect()
    };
    writer.key("stress", table(&pressures(|ramp| ramp.to)));
    if first.duration > 0.0 {
        writer.key("from", table(&pressures(|ramp| ramp.from)));
        writer.key("ramp", quantity(first.duration, Dimension::TIME));
    }
    writer.key("inertial_number", number(motion.inertial_number));
}
