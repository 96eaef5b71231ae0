//! The two bodies of a collision.

use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Name;
use pulvis_contact::Pair;
use pulvis_math::{Dimension, elementary};
use std::f64::consts::PI;

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Radius a [m].
    pub radius: f64,
    /// Mass [kg].
    pub mass: f64,
}

/// The two bodies of a collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bodies {
    /// Two spheres.
    Pair([Sphere; 2]),
    /// A sphere and a plane that does not give way.
    Wall(Sphere),
}

impl Bodies {
    /// The constants that contact laws see.
    pub fn pair(&self) -> Pair {
        match self {
            Self::Pair([i, j]) => Pair::spheres(i.mass, j.mass, i.radius, j.radius),
            Self::Wall(sphere) => Pair::wall(sphere.mass, sphere.radius),
        }
    }

    /// The radii of both bodies [m], zero for the wall.
    pub fn radii(&self) -> [f64; 2] {
        match self {
            Self::Pair([i, j]) => [i.radius, j.radius],
            Self::Wall(sphere) => [sphere.radius, 0.0],
        }
    }

    /// Mass [kg] and radius [m] of both bodies; `None` is the wall.
    pub fn masses_and_radii(&self) -> ((f64, f64), Option<(f64, f64)>) {
        let of = |sphere: &Sphere| (sphere.mass, sphere.radius);
        match self {
            Self::Pair([i, j]) => (of(i), Some(of(j))),
            Self::Wall(sphere) => (of(sphere), None),
        }
    }
}

/// What is wrong with a sphere whose mass or moment of inertia is not a normal number: everything that is
/// computed from it would be zero or infinite.
pub(crate) fn unfit_for_numbers(sphere: &Sphere) -> Option<Problem> {
    let Sphere { radius, mass } = *sphere;
    let inertia = 0.4 * mass * radius * radius;
    let (name, value, unit) = match (mass.is_normal(), inertia.is_normal()) {
        (false, _) => ("mass", mass, "kg"),
        (true, false) => ("moment of inertia", inertia, "kg m^2"),
        (true, true) => return None,
    };
    let found = format!("a sphere of radius {radius:?} m has the {name} {value:?} {unit}");
    Some(Problem::rule(found, "a size that numbers can hold (1e-307 to 1e308); are the units right?"))
}

/// Reads `bodies`, `radius` and one of `density` and `mass`. A pair whose spheres are equal may give
/// one value for both.
pub(crate) fn read_bodies(table: &mut TableReader<'_>) -> Result<Bodies, Reported> {
    let kind = table.required("bodies", Name(&["pair", "wall"]));
    let most = if matches!(kind, Ok("wall")) { 1 } else { 2 };
    let list =
        |dimension| List::of(QuantityRule::of(dimension).above(0.0)).at_least(1).at_most(most).or_single();
    let radii = table.required("radius", list(Dimension::LENGTH));
    let density = table.optional("density", list(Dimension::DENSITY));
    let mass = table.optional("mass", list(Dimension::MASS));
    let (kind, radii, density, mass) = (kind?, radii?, density?, mass?);
    let at = |values: &[f64], index: usize| values.get(index).or(values.first()).copied().unwrap_or(f64::NAN);
    let sphere = |index: usize| -> Result<Sphere, Reported> {
        let radius = at(&radii, index);
        let mass = match (&density, &mass) {
            (Some(density), None) => at(density, index) * 4.0 / 3.0 * PI * elementary::powi(radius, 3),
            (None, Some(mass)) => at(mass, index),
            (Some(_), Some(_)) => {
                let problem = Problem::rule("given beside `density`", "either `density` or `mass`");
                return Err(table.refuse("mass", problem));
            }
            (None, None) => {
                let expected = "densities [kg/m^3], or `mass` in its place".to_owned();
                return Err(table.refuse_with_help(
                    "density",
                    Problem::MissingKey { key: "density".to_owned(), expected },
                    "add for example `density = \"2000 kg/m^3\"`",
                ));
            }
        };
        let sphere = Sphere { radius, mass };
        match unfit_for_numbers(&sphere) {
            Some(problem) => Err(table.refuse("radius", problem)),
            None => Ok(sphere),
        }
    };
    let first = sphere(0)?;
    if kind == "wall" { Ok(Bodies::Wall(first)) } else { Ok(Bodies::Pair([first, sphere(1)?])) }
}
