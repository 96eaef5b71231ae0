//! Results as a picture: restitution over the swept variable, force loops, energies over time.

mod comparison;

use super::closed_form::closed_form;
use super::error::CollisionError;
use super::outcome::{Collision, Observation, Regime, Sample, Sampling};
use super::problem::Problem;
use super::{SweepPoint, collide};
use pulvis_contact::theory::LudingPair;
use pulvis_input::collision::{CollisionCase, CollisionScenario, SweptVariable, luding_pair};
use pulvis_io::plot::{Chart, Figure, Series};
use pulvis_math::elementary;

/// Points of a theory line.
const LINE_POINTS: u32 = 600;

/// Force loops in one chart: more cannot be told apart.
const LOOPS: usize = 4;

/// How long a stuck pair is drawn, in shortest contact times, where the scenario does not say.
const AFTER_STICKING: f64 = 4.0;

/// Draws a sweep, or a single collision, which has no first chart.
///
/// # Errors
/// A collision that cannot be computed; some are computed again to record their course.
pub fn figure(scenario: &CollisionScenario, points: &[SweepPoint]) -> Result<Figure, CollisionError> {
    if scenario.labels.len() > 1 {
        return comparison::figure(scenario, points);
    }
    let mut figure = Figure::new();
    if let Some(title) = &scenario.title {
        figure = figure.title(title);
    }
    if points.len() > 1 {
        figure = figure.panel(restitution_chart(scenario, points));
        figure = comparison::tangential_charts(scenario, points).into_iter().fold(figure, Figure::panel);
    }
    let chosen = representatives(points);
    let mut courses = Vec::new();
    for point in &chosen {
        courses.push((*point, drawn_course(scenario, &point.case)?));
    }
    let mut loops =
        Chart::new("Force over overlap").x_label("overlap δ [m]").y_label("force f [N]").zero_line();
    for (point, course) in &courses {
        let line = course.course.iter().map(|sample| (sample.overlap, sample.force));
        loops = loops.series(Series::line(case_label(scenario, &point.case), line));
    }
    figure = figure.panel(loops);
    // A pair that sticks shows most; otherwise the middle one.
    let sticking = courses.iter().find(|(point, _)| point.collision.outcome.regime == Regime::Stick);
    if let Some((point, course)) = sticking.or(courses.get(courses.len() / 2)) {
        figure = figure.panel(energy_chart(&case_label(scenario, &point.case), course));
    }
    Ok(figure)
}

/// The longest step between recorded instants: a sixtieth of the shortest contact time [s].
pub fn sampling_interval(case: &CollisionCase) -> f64 {
    Problem::new(case).shortest_time / 60.0
}

/// A collision with its course; a pair that sticks is followed for a while.
pub(crate) fn drawn_course(
    scenario: &CollisionScenario,
    case: &CollisionCase,
) -> Result<Collision, CollisionError> {
    let time_after_sticking = if scenario.time_after_sticking > 0.0 {
        scenario.time_after_sticking
    } else {
        AFTER_STICKING * Problem::new(case).shortest_time
    };
    let sampling = Sampling::Every(sampling_interval(case));
    collide(case, &Observation { sampling, time_after_sticking, ..Observation::default() })
}

/// A few points over the whole sweep.
fn representatives(points: &[SweepPoint]) -> Vec<&SweepPoint> {
    if points.len() <= LOOPS {
        return points.iter().collect();
    }
    let place = |number: usize| (2 * number + 1) * points.len() / (2 * LOOPS);
    (0..LOOPS).filter_map(|number| points.get(place(number))).collect()
}

/// The swept variable of a collision and its value.
pub(crate) fn case_label(scenario: &CollisionScenario, case: &CollisionCase) -> String {
    let symbol = axis_symbol(&scenario.variable);
    if is_angle(&scenario.variable) {
        return format!("{symbol} = {}°", pulvis_io::table::significant(case.value.to_degrees(), 4));
    }
    let value = pulvis_io::table::significant(case.value, 4);
    match scenario.variable.unit() {
        "1" => format!("{symbol} = {value}"),
        unit => format!("{symbol} = {value} {unit}"),
    }
}

fn axis_symbol(variable: &SweptVariable) -> &str {
    match variable {
        SweptVariable::Single | SweptVariable::Velocity => "v",
        SweptVariable::NormalVelocity => "v_{n}",
        SweptVariable::Chi => "χ",
        SweptVariable::Zeta => "ζ",
        SweptVariable::Key { path, .. } => path.rsplit('.').next().unwrap_or(path),
    }
}

/// Whether an angle is swept, which pictures show in degrees.
fn is_angle(variable: &SweptVariable) -> bool {
    matches!(variable, SweptVariable::Key { unit, .. } if unit == "rad")
}

/// The place of a collision on the axis of the swept variable.
fn axis_value(scenario: &CollisionScenario, point: &SweepPoint) -> f64 {
    let value = point.case.value;
    if is_angle(&scenario.variable) { value.to_degrees() } else { value }
}

fn axis_label(variable: &SweptVariable) -> String {
    match variable {
        SweptVariable::NormalVelocity => "relative velocity along the line of centres v_{n} [m/s]".to_owned(),
        SweptVariable::Key { .. } if is_angle(variable) => "angle of incidence [deg]".to_owned(),
        SweptVariable::Single | SweptVariable::Velocity => "relative velocity v [m/s]".to_owned(),
        SweptVariable::Chi => "impact velocity χ = v/v_{p0} [1]".to_owned(),
        SweptVariable::Zeta => "impact velocity ζ = v/v_{p} [1]".to_owned(),
        SweptVariable::Key { path, unit } => format!("{path} [{unit}]"),
    }
}

/// e over the swept variable, with the theory line and the limits of the sticking ranges.
fn restitution_chart(scenario: &CollisionScenario, points: &[SweepPoint]) -> Chart {
    let mut chart = Chart::new("Coefficient of restitution")
        .x_label(axis_label(&scenario.variable))
        .y_label("restitution e [1]");
    if scenario.logarithmic {
        chart = chart.log_x();
    }
    if points.iter().any(|point| point.case.incidence.is_some()) {
        // Often it is the same at all angles: the axis shall not show round-off.
        chart = chart.zero_line();
    }
    let theory = theory_line(scenario, 0);
    if theory.iter().any(|(_, restitution)| restitution.is_finite()) {
        chart = chart.series(Series::line("theory", theory));
    }
    let computed =
        points.iter().map(|point| (axis_value(scenario, point), point.collision.outcome.restitution));
    chart = chart.series(Series::points("computed", computed));
    for (value, name) in sticking_limits(scenario, points) {
        chart = chart.marker(value, name);
    }
    chart
}

/// The closed form of the restitution from the first to the last value.
fn theory_line(scenario: &CollisionScenario, contact_number: usize) -> Vec<(f64, f64)> {
    let restitution = |case: &CollisionCase| closed_form(case).map_or(f64::NAN, |theory| theory.restitution);
    fine_cases(scenario, contact_number).iter().map(|case| (case.value, restitution(case))).collect()
}

/// The collisions of a contact from the first to the last value of the sweep, at many values of its own: a straight line
/// from point to point would be no theory. Values that the file refuses are left out.
pub(crate) fn fine_cases(scenario: &CollisionScenario, contact_number: usize) -> Vec<CollisionCase> {
    let cases = || scenario.cases.iter().filter(|case| case.contact_number == contact_number);
    let values = cases().map(|case| case.value).filter(|value| value.is_finite());
    let ends = values.fold(None, |ends: Option<(f64, f64)>, value| {
        Some(ends.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
    });
    let (Some((low, high)), Some(first)) = (ends, cases().next()) else { return Vec::new() };
    let unit = speed_unit(scenario, first);
    let case = |value: f64| match &unit {
        Some(unit) => Some(CollisionCase { value, velocity: unit.velocity(value), ..first.clone() }),
        None => scenario.case_at(value, contact_number),
    };
    let at = |number: u32| {
        let share = f64::from(number) / f64::from(LINE_POINTS);
        if scenario.logarithmic {
            low * elementary::powf(high / low, share)
        } else {
            low + (high - low) * share
        }
    };
    (0..=LINE_POINTS).filter_map(|number| case(at(number))).collect()
}

/// What one unit of the swept variable is in m/s, where it is a speed.
struct SpeedUnit {
    pair: Option<LudingPair>,
    /// [m/s].
    unit: f64,
}

impl SpeedUnit {
    /// The speed outside all ranges at a value of the variable [m/s].
    fn velocity(&self, value: f64) -> f64 {
        let touch = value * self.unit;
        match &self.pair {
            Some(pair) if pair.pull_in(touch) > 1.0 => {
                (touch * touch - elementary::powi(pair.v_fa(), 2)).max(0.0).sqrt()
            }
            _ => touch,
        }
    }

    /// The value of the variable at a speed outside all ranges [m/s].
    fn value(&self, velocity: f64) -> f64 {
        self.pair.as_ref().map_or(velocity, |pair| pair.touch_velocity(velocity)) / self.unit
    }
}

fn speed_unit(scenario: &CollisionScenario, case: &CollisionCase) -> Option<SpeedUnit> {
    let pair = luding_pair(&case.contact, &case.bodies.pair());
    match scenario.variable {
        SweptVariable::Velocity => Some(SpeedUnit { pair: None, unit: 1.0 }),
        SweptVariable::Chi => pair.map(|pair| SpeedUnit { pair: Some(pair), unit: pair.v_p0() }),
        SweptVariable::Zeta => {
            let pair = pair?;
            Some(SpeedUnit { pair: Some(pair), unit: pair.v_p()? })
        }
        SweptVariable::NormalVelocity | SweptVariable::Single | SweptVariable::Key { .. } => None,
    }
}

/// The limits of the sticking ranges within the chart; exact without a dashpot only, so else none.
pub(crate) fn sticking_limits(
    scenario: &CollisionScenario,
    points: &[SweepPoint],
) -> Vec<(f64, &'static str)> {
    let Some(first) = points.first() else { return Vec::new() };
    let Some(unit) = speed_unit(scenario, &first.case) else { return Vec::new() };
    if closed_form(&first.case).is_none() {
        return Vec::new();
    }
    let Some(pair) = luding_pair(&first.case.contact, &first.case.bodies.pair()) else { return Vec::new() };
    let velocities = pair.critical_velocities();
    let (low, high) = points.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), point| {
        (low.min(point.case.value), high.max(point.case.value))
    });
    [
        (velocities.low_end, "sticks below"),
        (velocities.high_onset, "sticks from"),
        (velocities.high_end, "sticks up to"),
    ]
    .into_iter()
    .filter_map(|(velocity, name)| Some((unit.value(velocity?), name)))
    .filter(|(value, _)| (low..=high).contains(value))
    .collect()
}

/// Energies over time of one collision.
fn energy_chart(label: &str, collision: &Collision) -> Chart {
    let course = &collision.course;
    let curve = |of: fn(&Sample) -> f64| course.iter().map(move |sample| (sample.time, of(sample)));
    let mut chart = Chart::new(format!("Energies, {label}"))
        .x_label("time t [s]")
        .y_label("energy [J]")
        .zero_line()
        .series(Series::line("kinetic", curve(|sample| sample.kinetic)))
        .series(Series::line("available (elastic)", curve(|sample| sample.potential_available)))
        .series(Series::dashed("potential of the branch", curve(|sample| sample.potential_plastic)))
        .series(Series::line("dissipated", curve(|sample| sample.dissipated)));
    if course.iter().any(|sample| sample.potential_attraction != 0.0) {
        chart = chart.series(Series::line("attraction", curve(|sample| sample.potential_attraction)));
    }
    chart
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)]
    use super::super::sweep;
    use super::*;
    use pulvis_input::Document;

    fn scenario(kc: &str) -> CollisionScenario {
        let text = format!(
            "[collision]\nbodies = \"wall\"\nradius = \"1.1 mm\"\ndensity = \"2000 kg/m^3\"\nvelocity = \"0.3 m/s\"\n\
             [collision.sweep]\nvariable = \"contact.normal.kc\"\nvalues = {kc}\n\
             [contact.normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"1 N/m\"\nphi_f = 0.05\n"
        );
        let document = Document::from_str("sweep.toml", &text).unwrap();
        CollisionScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn the_theory_line_of_a_swept_parameter_is_theory_between_the_points_too() {
        let few = scenario("[0, 20, 300]");
        let line = theory_line(&few, 0);
        assert_eq!(line.len(), LINE_POINTS as usize + 1);
        let mut apart = 0.0_f64;
        // What is integrated, not the closed form, says what is right between the points.
        for number in [13, 30, 100, 200, 400] {
            let (kc, theory) = line[number];
            let between = scenario(&format!("[{kc:?}]"));
            let computed = sweep(&between, false).unwrap()[0].collision.outcome.restitution;
            // Next to sticking e² is good to round-off, and e to its root.
            assert!((theory - computed).abs() < 1e-6, "kc = {kc}: theory {theory}, computed {computed}");
            let [low, high] = if kc < 20.0 { [0, 40] } else { [40, 600] }.map(|end: usize| line[end]);
            let chord = low.1 + (high.1 - low.1) * (kc - low.0) / (high.0 - low.0);
            apart = apart.max((theory - chord).abs());
        }
        assert!(apart > 0.01, "no straight line from point to point: {apart} apart");
    }
    #[test]
    fn each_value_of_a_second_variable_has_its_own_contact_theory_and_label() {
        let text = "[collision]\nbodies = \"wall\"\nradius = \"1.1 mm\"\ndensity = \"2000 kg/m^3\"\n\
             [collision.sweep]\nvariable = \"chi\"\nvalues = [0.2, 0.4]\n\
             [collision.family]\nvariable = \"contact.normal.kc\"\nvalues = [\"10 N/m\", \"100 N/m\"]\n\
             [contact.normal]\nlaw = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"1 N/m\"\nphi_f = 0.05\n";
        let document = Document::from_str("family.toml", text).unwrap();
        let scenario =
            CollisionScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(scenario.labels, ["k_{c} = 10 N/m", "k_{c} = 100 N/m"]);
        let points = sweep(&scenario, false).unwrap();
        assert_eq!(points.len(), 4);
        for (number, beta) in [0.1, 1.0].into_iter().enumerate() {
            let line = theory_line(&scenario, number);
            let (chi, restitution) = line[LINE_POINTS as usize];
            // S1 (32), its two terms combined, at η χ = 1.6.
            let exact: f64 = (1.0 + beta - beta * 1.6) / (1.0 + beta + 1.6);
            assert!((chi - 0.4).abs() < 1e-15 && (restitution - exact.sqrt()).abs() < 1e-12, "{restitution}");
            let computed = points[2 * number + 1].collision.outcome.restitution;
            assert!((computed - restitution).abs() < 1e-10, "{computed}");
        }
    }
}
