//! How two bodies meet beside their speed: under an angle, and spinning.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_math::Dimension;
use std::f64::consts::FRAC_PI_2;

/// The keys of an oblique collision, which can be swept.
pub(super) const KEYS: [&str; 3] = ["angle", "spin_i", "spin_j"];

/// Angle and spins of an oblique collision. The x-axis is the line of centres when the bodies come within the range of
/// their forces, from j to i, at a wall its normal; i moves against x and along y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Incidence {
    /// Angle between the relative velocity and the line of centres [rad].
    pub angle: f64,
    /// Angular velocities of i and j before [rad/s].
    pub spins: [[f64; 3]; 2],
}

/// What a value of one of the [`KEYS`] must be.
pub(super) fn rule(key: &str) -> QuantityRule {
    if key == "angle" {
        QuantityRule::of(Dimension::NONE).at_least(0.0)
    } else {
        QuantityRule::of(Dimension::RATE)
    }
}

/// Reads angle and spins; `None` where the bodies meet head on without spin.
pub(super) fn read_incidence(
    table: &mut TableReader<'_>,
    at_wall: bool,
) -> Result<Option<Incidence>, Reported> {
    let angle = table.optional("angle", rule("angle"));
    let spin = |table: &mut TableReader<'_>, key| {
        let list = List::of(rule(key)).at_least(1).at_most(3).or_single();
        match table.optional(key, list)?.as_deref() {
            None => Ok(None),
            Some([z]) => Ok(Some([0.0, 0.0, *z])),
            Some([x, y, z]) => Ok(Some([*x, *y, *z])),
            Some(_) => {
                let expected =
                    "one value, about the axis across the plane of motion, or the three of a vector";
                Err(table.refuse(key, Problem::rule("two values", expected)))
            }
        }
    };
    let spins = [spin(table, "spin_i"), spin(table, "spin_j")];
    let (angle, [spin_i, spin_j]) = (angle?, spins);
    let (spin_i, spin_j) = (spin_i?, spin_j?);
    if at_wall && spin_j.is_some() {
        return Err(
            table.refuse("spin_j", Problem::rule("given for a wall", "`spin_i` alone: a wall does not spin"))
        );
    }
    if angle.is_some_and(|angle| angle >= FRAC_PI_2) {
        let problem =
            Problem::rule("bodies that do not move towards each other never meet", "less than 90 deg");
        return Err(table.refuse("angle", problem));
    }
    let given = angle.is_some() || spin_i.is_some() || spin_j.is_some();
    let spins = [spin_i.unwrap_or_default(), spin_j.unwrap_or_default()];
    Ok(given.then(|| Incidence { angle: angle.unwrap_or_default(), spins }))
}
