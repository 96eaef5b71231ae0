//! The shortest contact of a system, which sets its time step.

use crate::contacts::Interactions;
use crate::particles::{MaterialIndex, Particle};
use crate::walls::{Shape, Wall};
use pulvis_contact::Partner;

/// The shortest contact that a system can have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortestContact {
    /// Its duration: π over the highest frequency of any branch and spring [s].
    pub duration: f64,
    /// The material of the particle.
    pub material: MaterialIndex,
    /// The material of what it meets.
    pub partner: MaterialIndex,
    /// Whether that is a wall.
    pub at_wall: bool,
}

/// The shortest contact over all pairs of materials that can meet, or `None` without particles.
///
/// For each pair of materials the lightest and the heaviest particles are tried in all combinations:
/// springs along the normal are fastest between two light particles, rolling springs between a light
/// and a heavy one.
pub fn shortest_contact(
    particles: &[Particle],
    interactions: &Interactions,
    walls: &[Wall],
) -> Option<ShortestContact> {
    let extremes = extremes_by_material(particles);
    let mut shortest: Option<ShortestContact> = None;
    let mut consider = |candidate: ShortestContact| {
        if shortest.is_none_or(|known| candidate.duration < known.duration) {
            shortest = Some(candidate);
        }
    };
    for &(material, ref bodies) in &extremes {
        for &(partner, ref partners) in &extremes {
            let Some(model) = interactions.get(material, partner) else { continue };
            for &body in bodies {
                for &other in partners {
                    let duration = model.shortest_contact_time(body, Some(other));
                    consider(ShortestContact { duration, material, partner, at_wall: false });
                }
            }
        }
        for wall in walls.iter().filter(|wall| wall.present) {
            let partner = wall.material;
            let Some(model) = interactions.get(material, partner) else { continue };
            // Where a wall is most hollow, the effective radius is largest and Hertzian contacts are stiffest.
            let surface = Partner::Wall { mean_curvature: wall.shape.least_mean_curvature() };
            for &body in bodies {
                let duration = model.shortest_contact_time(body, surface);
                consider(ShortestContact { duration, material, partner, at_wall: true });
            }
        }
    }
    shortest
}

/// For each material, mass [kg] and radius [m] of its lightest and heaviest particles.
fn extremes_by_material(particles: &[Particle]) -> Vec<(MaterialIndex, [(f64, f64); 2])> {
    let mut extremes: Vec<(MaterialIndex, [(f64, f64); 2])> = Vec::new();
    for particle in particles {
        let body = (particle.mass, particle.radius);
        match extremes.iter_mut().find(|(material, _)| *material == particle.material) {
            None => extremes.push((particle.material, [body; 2])),
            Some((_, [lightest, heaviest])) => {
                if body.0 < lightest.0 {
                    *lightest = body;
                }
                if body.0 > heaviest.0 {
                    *heaviest = body;
                }
            }
        }
    }
    extremes
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_contact::{ContactModel, Hertz, Linear};
    use pulvis_math::Vector3;

    use super::*;
    use crate::walls::{Cylinder, CylinderSide, Plane, WallShape};
    use pulvis_math::elementary;

    fn sphere(material: MaterialIndex, radius: f64) -> Particle {
        let (position, velocity, angular_velocity) = (Vector3::zero(), Vector3::zero(), Vector3::zero());
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 2000.0 * elementary::powi(radius, 3);
        Particle { material, radius, mass, position, velocity, angular_velocity }
    }

    #[test]
    fn the_lightest_pair_of_the_stiffest_materials_sets_the_step() {
        let mut interactions = Interactions::new(2);
        interactions.set(0, 0, ContactModel::frictionless(Linear::new(100.0, 0.0)));
        interactions.set(0, 1, ContactModel::frictionless(Linear::new(900.0, 0.0)));
        let particles = [sphere(0, 2e-3), sphere(0, 1e-3)];
        let wall = Wall::fixed("floor", 1, Vector3::zero(), Vector3::new(0.0, 0.0, 1.0));
        let light = sphere(0, 1e-3).mass;
        let pair = shortest_contact(&particles, &interactions, &[]).unwrap();
        let expected = std::f64::consts::PI * (0.5 * light / 100.0).sqrt();
        assert!((pair.duration / expected - 1.0).abs() < 1e-14);
        let at_wall = shortest_contact(&particles, &interactions, &[wall]).unwrap();
        assert!(at_wall.at_wall);
        let expected = std::f64::consts::PI * (light / 900.0).sqrt();
        assert!((at_wall.duration / expected - 1.0).abs() < 1e-14);
    }

    #[test]
    fn hertzian_contacts_in_a_drum_are_those_of_the_larger_sphere_that_fits_a_plane_as_well() {
        let mut interactions = Interactions::new(2);
        interactions.set(0, 1, ContactModel::frictionless(Hertz { effective_modulus: 1e7 }));
        let body = sphere(0, 1e-3);
        let time_at = |shape: WallShape, body: Particle| {
            let wall = Wall::of_shape("wall", 1, Vector3::zero(), shape);
            shortest_contact(&[body], &interactions, &[wall]).unwrap()
        };
        let (axis, radius) = (Vector3::new(0.0, 1.0, 0.0), 1.25e-3);
        let plane = WallShape::from(Plane { normal: axis });
        for (side, sign) in [(CylinderSide::Inside, -1.0), (CylinderSide::Outside, 1.0)] {
            let found = time_at(Cylinder { axis, radius, side }.into(), body);
            // 1/a' = 1/a ∓ 1/(2R), with the same mass.
            let alike = Particle { radius: 1.0 / (1e3 + sign * 0.5 / radius), ..body };
            let expected = time_at(plane, alike);
            assert!(
                (found.duration / expected.duration - 1.0).abs() < 1e-14,
                "{side:?}: {found:?} {expected:?}"
            );
            // Duration falls as stiffness rises.
            let flat = time_at(plane, body).duration;
            assert!((found.duration < 0.9 * flat) == (side == CylinderSide::Inside), "{found:?} {flat}");
        }
    }

    #[test]
    fn without_particles_there_is_no_contact() {
        assert_eq!(shortest_contact(&[], &Interactions::new(1), &[]), None);
    }
}
