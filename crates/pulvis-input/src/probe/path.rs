//! The path of a probe: turning points, straight in between.

use crate::collision::Bodies;
use crate::context::{Location, Reported};
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Integer;
use crate::value_reader::ValueReader;
use pulvis_math::Dimension;

/// Points on a leg, unless told otherwise.
const POINTS: i64 = 200;

/// More points than any curve needs; a slip of the pen should not fill the memory.
const MOST_POINTS: i64 = 1_000_000;

/// A path of a contact: poses at the turning points, and straight legs in between.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbePath {
    /// Overlap δ, displacement along the surface, rolling and twisting of i against j at each turning point; the last
    /// two as arcs, which are a12 times the angle [m].
    pub poses: Vec<[f64; 4]>,
    /// Which of the four the file prescribes.
    pub prescribed: [bool; 4],
    /// How long each leg takes [s]; `None`: infinitely slow.
    pub durations: Option<Vec<f64>>,
    /// Steps on each leg.
    pub points: u32,
}

impl ProbePath {
    /// Number of legs.
    pub fn legs(&self) -> usize {
        self.poses.len().saturating_sub(1)
    }
}

/// Reads the keys of the path.
pub(super) fn read_path(table: &mut TableReader<'_>, bodies: Option<&Bodies>) -> Result<ProbePath, Reported> {
    let length = QuantityRule::of(Dimension::LENGTH);
    let overlap = table.required("overlap", List::of(length).at_least(2));
    let points = table.or("points", Integer::between(1, MOST_POINTS), POINTS);
    let speed = table.or("speed", QuantityRule::of(Dimension::VELOCITY).at_least(0.0), 0.0);
    let turns = overlap.as_ref().map_or(0, Vec::len);
    let mut along = |key| match turns {
        // Their length cannot be judged.
        0 => table.value(key).map_or(Ok(None), |_| Ok(None)),
        turns => table.optional(key, List::of(length).exactly(turns)),
    };
    let others = [along("shear"), along("roll"), along("twist")];
    let durations = match turns {
        0 => table.value("durations").map_or(Ok(None), |_| Ok(None)),
        turns => {
            let time = QuantityRule::of(Dimension::TIME).above(0.0);
            table.optional("durations", List::of(time).exactly(turns - 1))
        }
    };
    let [shear, roll, twist] = others;
    let (overlap, points, speed) = (overlap?, points?, speed?);
    let overlaps = table.value("overlap").and_then(|list| list.items("").ok()).unwrap_or_default();
    let locations = overlaps.iter().map(ValueReader::location).collect();
    let lists = [Some(overlap), shear?, roll?, twist?];
    let prescribed = lists.each_ref().map(Option::is_some);
    let at = |turn: usize| {
        lists.each_ref().map(|list| list.as_ref().and_then(|list| list.get(turn)).map_or(0.0, |value| *value))
    };
    let poses: Vec<[f64; 4]> = (0..turns).map(at).collect();
    let draft = Draft { table, poses: &poses, locations };
    draft.check_points(points)?;
    draft.check_overlaps(bodies)?;
    let durations = draft.durations(speed, durations?)?;
    // At most a million.
    let points = u32::try_from(points).unwrap_or(u32::MAX);
    Ok(ProbePath { poses, prescribed, durations, points })
}

/// A path whose numbers are read, but not yet checked against each other.
struct Draft<'t, 'd> {
    table: &'t TableReader<'d>,
    poses: &'t [[f64; 4]],
    /// The places of the overlaps.
    locations: Vec<Location>,
}

impl Draft<'_, '_> {
    fn check_points(&self, points: i64) -> Result<(), Reported> {
        let legs = self.poses.len() as i64 - 1;
        let all = points.saturating_mul(legs);
        if all <= MOST_POINTS {
            return Ok(());
        }
        let problem = Problem::rule(format!("{all} points on {legs} legs"), format!("at most {MOST_POINTS}"));
        Err(self.table.refuse("points", problem))
    }

    /// Contacts remember how they began: so a path has to begin apart. Overlaps beyond the radius are slips of units.
    fn check_overlaps(&self, bodies: Option<&Bodies>) -> Result<(), Reported> {
        let overlap = |turn: usize| self.poses.get(turn).map_or(0.0, |pose| pose[0]);
        if overlap(0) > 0.0 {
            let found = format!("the path begins at an overlap of {:?} m", overlap(0));
            let problem =
                Problem::rule(found, "a start at 0 m or below: what a contact does depends on its past");
            return Err(self.refuse_overlap(0, problem));
        }
        let Some(bodies) = bodies else { return Ok(()) };
        let least = match bodies {
            Bodies::Pair([i, j]) => i.radius.min(j.radius),
            Bodies::Wall(sphere) => sphere.radius,
        };
        match (0..self.poses.len()).find(|turn| overlap(*turn) > least) {
            None => Ok(()),
            Some(turn) => {
                let found = format!("an overlap of {:?} m", overlap(turn));
                let problem = Problem::rule(found, format!("at most the radius, {least:?} m"));
                Err(self.refuse_overlap(turn, problem))
            }
        }
    }

    fn refuse_overlap(&self, turn: usize, problem: Problem) -> Reported {
        match self.locations.get(turn) {
            Some(location) => self.table.refuse_at(location, problem),
            None => self.table.refuse("overlap", problem),
        }
    }

    /// How long each leg takes.
    fn durations(&self, speed: f64, durations: Option<Vec<f64>>) -> Result<Option<Vec<f64>>, Reported> {
        let legs = || self.poses.iter().zip(self.poses.iter().skip(1));
        let refuse = |key: &str, leg: usize, found: &str, expected: &str| {
            let problem = Problem::rule(format!("leg {} {found}", leg + 1), expected);
            Err(self.table.refuse(key, problem))
        };
        if durations.is_some() {
            if speed > 0.0 {
                let problem = Problem::rule("given beside `durations`", "either `speed` or `durations`");
                return Err(self.table.refuse("speed", problem));
            }
            return Ok(durations);
        }
        if speed > 0.0 {
            if let Some(leg) = legs().position(|(from, to)| from[0] == to[0]) {
                let found = "keeps the overlap, so that a speed gives it no duration";
                return refuse("speed", leg, found, "`durations`, one for each leg");
            }
            return Ok(Some(legs().map(|(from, to)| (to[0] - from[0]).abs() / speed).collect()));
        }
        match legs().position(|(from, to)| from == to) {
            Some(leg) => refuse("overlap", leg, "moves nothing", "a motion, or `durations`"),
            None => Ok(None),
        }
    }
}
