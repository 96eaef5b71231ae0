//! The tablet: a small lattice between six walls, pressed from above.

use pulvis_contact::ContactModel;
use pulvis_core::Setup;
use pulvis_core::walls::{Velocity, Wall, WallMotion};
use pulvis_math::{Vector3, elementary};
use pulvis_packing::{Lattice, Structure, random_stream};

use super::{RADIUS, of_one_material, sphere};
use crate::failure::Failure;

/// Distance of neighbours over the diameter: all six contacts are closed from the start [1].
const SPACING: f64 = 0.99;
/// Up to this fraction of the spacing the spheres are moved off their sites [1].
const JITTER: f64 = 0.002;
/// Speed of the pressing wall [m/s].
const PRESSING_SPEED: f64 = 0.05;

/// A tablet of `count` equal spheres.
pub(crate) fn setup(count: usize, model: ContactModel) -> Result<Setup, Failure> {
    let per_edge = elementary::cbrt(count as f64).round() as usize;
    if count == 0 || per_edge.pow(3) != count {
        return Err(Failure::NoCube(count));
    }
    let spacing = SPACING * 2.0 * RADIUS;
    let lattice = Lattice {
        lower: Vector3::zero(),
        counts: [per_edge; 3],
        spacing,
        jitter: JITTER,
        structure: Structure::SimpleCubic,
    };
    let sites = lattice.positions(&mut random_stream(216));
    let particles = sites.into_iter().map(|site| sphere(site, RADIUS, Vector3::zero())).collect();
    Ok(Setup { walls: walls(per_edge as f64 * spacing), ..of_one_material(particles, model) })
}

/// Six walls around a cube of the given edge [m]; the upper one moves down.
fn walls(edge: f64) -> Vec<Wall> {
    let (origin, far) = (Vector3::zero(), Vector3::new(edge, edge, edge));
    let axes = [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0), Vector3::new(0.0, 0.0, 1.0)];
    let mut walls = Vec::new();
    for (axis, name) in axes.into_iter().zip(["x", "y", "z"]) {
        walls.push(Wall::fixed(&format!("{name} lower"), 0, origin, axis));
        walls.push(Wall::fixed(&format!("{name} upper"), 0, far, -axis));
    }
    if let Some(upper) = walls.last_mut() {
        upper.motion = WallMotion::Velocity(Velocity { velocity: Vector3::new(0.0, 0.0, -PRESSING_SPEED) });
    }
    walls
}
