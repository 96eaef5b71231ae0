//! What a simulation refuses to start from: numbers that no body or wall can have.

use pulvis_boundary::motion::{Range, Slot};
use pulvis_boundary::{Background, CellControl, CellMotion, Domain, UpperTriangular};
use pulvis_math::Vector3;

use super::cell::MOST_STRAIN;
use super::{Setup, SetupError};
use crate::particles::Particle;
use crate::walls::{Extent, FaceArea, Wall, WallMotion};

/// A number that cannot be, for [`SetupError`] to say whose it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Refused {
    quantity: &'static str,
    found: f64,
    expected: &'static str,
}

type Check = Result<(), Refused>;

/// Refuses what is found unless it `holds`.
fn require(holds: bool, quantity: &'static str, found: f64, expected: &'static str) -> Check {
    if holds { Ok(()) } else { Err(Refused { quantity, found, expected }) }
}

fn positive(quantity: &'static str, found: f64) -> Check {
    require(found > 0.0 && found.is_finite(), quantity, found, "a finite number greater than zero")
}

fn not_negative(quantity: &'static str, found: f64) -> Check {
    require(found >= 0.0 && found.is_finite(), quantity, found, "a finite number of at least zero")
}

fn finite(quantity: &'static str, found: f64) -> Check {
    require(found.is_finite(), quantity, found, "a finite number")
}

fn finite_vector(quantity: &'static str, found: Vector3) -> Check {
    found.to_array().into_iter().try_for_each(|component| finite(quantity, component))
}

/// Refuses a setup with numbers that cannot be. Models, areas and periods are checked elsewhere, as they can change.
pub(super) fn check_setup(setup: &Setup) -> Result<(), SetupError> {
    check_particles(&setup.particles)?;
    check_background(&setup.background)?;
    for (index, wall) in setup.walls.iter().enumerate() {
        let refused =
            |Refused { quantity, found, expected }| SetupError::Wall { index, quantity, found, expected };
        check_wall(wall).map_err(refused)?;
        check_extents(index, wall, setup.walls.len())?;
    }
    Ok(())
}

/// Refuses particles with numbers that cannot be.
pub(super) fn check_particles(particles: &[Particle]) -> Result<(), SetupError> {
    for (index, particle) in particles.iter().enumerate() {
        check_particle(particle).map_err(|Refused { quantity, found, expected }| SetupError::Particle {
            index,
            quantity,
            found,
            expected,
        })?;
    }
    Ok(())
}

fn check_particle(particle: &Particle) -> Check {
    positive("radius [m]", particle.radius)?;
    positive("mass [kg]", particle.mass)?;
    finite_vector("position [m]", particle.position)?;
    finite_vector("velocity [m/s]", particle.velocity)?;
    finite_vector("angular velocity [rad/s]", particle.angular_velocity)
}

/// Refuses gravity and drag that cannot be.
pub(super) fn check_background(background: &Background) -> Result<(), SetupError> {
    finite_vector("gravity [m/s²]", background.gravity)
        .and_then(|()| not_negative("drag [kg/s]", background.drag))
        .and_then(|()| not_negative("rotational drag [kg/s]", background.rotational_drag))
        .map_err(|Refused { quantity, found, expected }| SetupError::Background { quantity, found, expected })
}

/// Refuses a motion that no wall can have; `index` is that of the wall.
pub(super) fn check_wall_motion(index: usize, motion: WallMotion) -> Result<(), SetupError> {
    check_motion(motion).map_err(|Refused { quantity, found, expected }| SetupError::Wall {
        index,
        quantity,
        found,
        expected,
    })
}

/// The shape checks itself, against the largest particle.
fn check_wall(wall: &Wall) -> Check {
    finite_vector("point [m]", wall.point)?;
    finite("angle [rad]", wall.angle)?;
    check_area(&wall.area)?;
    check_motion(wall.motion)
}

fn check_area(area: &FaceArea) -> Check {
    match area {
        FaceArea::Unknown => Ok(()),
        FaceArea::Given(area) => positive("area [m²]", *area),
        FaceArea::Product(extents) => extents.iter().try_for_each(|extent| match *extent {
            Extent::Given(length) => positive("extent of the face [m]", length),
            Extent::Between(..) => Ok(()),
        }),
    }
}

/// Refuses a motion with numbers out of the ranges that it states itself.
fn check_motion(mut motion: WallMotion) -> Check {
    motion.parameters().into_iter().try_for_each(|parameter| match (parameter.value, parameter.range) {
        (Slot::Vector(vector), _) => finite_vector(parameter.name, *vector),
        (Slot::Number(number), Range::Any) => finite(parameter.name, *number),
        (Slot::Number(number), Range::NonNegative) => not_negative(parameter.name, *number),
        (Slot::Number(number), Range::Positive) => positive(parameter.name, *number),
    })
}

/// Refuses a face that ranges between walls that are not there.
fn check_extents(index: usize, wall: &Wall, walls: usize) -> Result<(), SetupError> {
    let FaceArea::Product(extents) = &wall.area else { return Ok(()) };
    let named = extents.iter().flat_map(|extent| match *extent {
        Extent::Given(_) => [None, None],
        Extent::Between(one, other) => [Some(one), Some(other)],
    });
    match named.flatten().find(|&other| other >= walls) {
        Some(other) => Err(SetupError::NoSuchWall { index, other, walls }),
        None => Ok(()),
    }
}

/// Refuses what no cell of this domain can do with time steps of this length [s].
pub(super) fn check_cell_motion(
    motion: &CellMotion,
    domain: &Domain,
    time_step: f64,
) -> Result<(), SetupError> {
    let refused = |problem: String| Err(SetupError::Cell { problem });
    for (component, indices) in UpperTriangular::INDICES.into_iter().enumerate() {
        let open = indices.into_iter().find(|&axis| domain.period(axis).is_none());
        if let (true, Some(axis)) = (motion.deforms(component), open) {
            let (name, axis) = (UpperTriangular::NAMES[component], ["x", "y", "z"][axis]);
            return refused(format!("{name} deforms, but {axis} is not periodic"));
        }
        let normal = component < 3 && motion.components[component] != CellControl::Fixed;
        if normal && motion.isotropic.is_some() {
            let name = UpperTriangular::NAMES[component];
            return refused(format!("{name} is controlled, and the mean of the normal stresses too"));
        }
    }
    let rates = motion.prescribed();
    let strain = rates.bound() * time_step;
    // Not `>`: NaN is no small strain.
    let fits = strain <= MOST_STRAIN;
    if !fits {
        return refused(format!("its rates strain it by {strain} in a time step, more than {MOST_STRAIN}"));
    }
    for ramp in motion.targets() {
        let numbers = [ramp.from, ramp.to, ramp.duration, motion.inertial_number];
        let sound = numbers.into_iter().all(f64::is_finite)
            && ramp.duration >= 0.0
            && motion.inertial_number > 0.0
            && motion.largest_target() > 0.0;
        if !sound {
            return refused("a stress to follow is no number, or none differs from zero, or the inertial number is not above zero".to_owned());
        }
    }
    Ok(())
}
