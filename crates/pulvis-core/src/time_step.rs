//! The shortest motion of a system, which sets its time step.
//!
//! Velocity-Verlet whose dashpots see the predicted velocity v + dt a of the end of the step has the recurrence
//!
//! x'' − 2 x' + x = −w² x' − h (3/2 x' − 2 x + x°/2),  w = ω dt,  h = (γ/m) dt,
//!
//! of four positions x°, x, x', x'' in a row. Its characteristic polynomial
//! λ³ − (2 − w² − 3/2 h) λ² + (1 − 2 h) λ + h/2 has all roots within the unit circle where w² + 4 h < 4: a spring is
//! stable up to ω dt = 2, a dashpot alone only up to γ dt/m = 1. Rates of dashpots that are not those of a pair therefore
//! count twice. At the shortest contact over ten, the longest step that the laboratory takes, springs stay at w = 0.31 and
//! have room for the four times stiffer modes of a dense packing.

use std::f64::consts::PI;

use crate::contacts::Interactions;
use crate::particles::{MaterialIndex, Particle};
use crate::walls::Wall;
use pulvis_boundary::Background;
use pulvis_contact::Partner;

/// The shortest motion that a system can make: what the time step has to resolve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortestMotion {
    /// π over its frequency, or over twice the rate of its damping [s].
    pub duration: f64,
    /// What moves.
    pub kind: MotionKind,
}

/// What moves in a system.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionKind {
    /// A contact.
    Contact(ShortestContact),
    /// A servo wall on the contacts of all particles that can touch it at once.
    WallOnContacts {
        /// Index of the wall.
        wall: usize,
        /// The number of particles, at most.
        contacts: f64,
    },
    /// A servo wall that its own damping, or the dashpots of its contacts, slow down.
    WallDamping {
        /// Index of the wall.
        wall: usize,
    },
    /// The lightest particle that the background's drag slows down.
    Drag,
    /// The lightest particle whose rotation the background's drag slows down.
    RotationalDrag,
    /// Two charges that touch and act over all distances.
    Charges,
}

/// The shortest motion of the system: of contacts (see [`shortest_contact`]), of walls that follow a pressure, and of
/// particles in the background's drag. `None` where nothing moves but freely.
///
/// A servo wall of mass M on N contacts of stiffness k oscillates with ω² = N k/M against particles that stand still;
/// together with their own motion ω² is at most N k/M + k/m. Two spheres of radius a and b that touch a plane do so at a
/// distance of 2 √(a b) at least, so that disks of the smallest radius around all touching points are disjoint: at most
/// A/(π a²) particles touch a face of area A, and at most all. Overlaps and edges, which this leaves out, are some percent;
/// the least number of steps in the shortest motion leaves room for a hundredfold. Where the sample `grows`, particles like these
/// come in while it runs: then the face alone bounds their number, if its area is known.
pub fn shortest_motion(
    particles: &[Particle],
    interactions: &Interactions,
    walls: &[Wall],
    background: &Background,
    grows: bool,
) -> Option<ShortestMotion> {
    let mut motions = Vec::new();
    if let Some(contact) = shortest_contact(particles, interactions, walls) {
        motions.push(ShortestMotion { duration: contact.duration, kind: MotionKind::Contact(contact) });
    }
    for (index, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.present) {
        if let Some(inertia) = wall.motion.law().mass_and_damping() {
            motions.extend(wall_motions((particles, grows), interactions, walls, index, inertia));
        }
    }
    if let Some(lightest) = particles.iter().map(|particle| particle.mass).reduce(f64::min) {
        // The torque γ a² ω on the inertia 2/5 m a².
        for (coefficient, kind) in [
            (background.drag, MotionKind::Drag),
            (2.5 * background.rotational_drag, MotionKind::RotationalDrag),
        ] {
            motions.push(ShortestMotion { duration: damping_time(coefficient / lightest), kind });
        }
    }
    motions.retain(|motion| motion.duration < f64::INFINITY);
    motions.into_iter().min_by(|one, other| one.duration.total_cmp(&other.duration))
}

/// The time that a step has to resolve where a velocity falls with a `rate` [1/s].
fn damping_time(rate: f64) -> f64 {
    PI / (2.0 * rate)
}

/// The motions of a servo wall: on its contacts, and in its damping.
fn wall_motions(
    (particles, grows): (&[Particle], bool),
    interactions: &Interactions,
    walls: &[Wall],
    index: usize,
    (mass, damping): (f64, f64),
) -> [ShortestMotion; 2] {
    let touching = TouchingAtOnce::of(particles, interactions, walls, index, grows);
    let on_contacts = PI * (mass / touching.stiffness).sqrt();
    let damping = damping_time((damping + touching.dashpot) / mass);
    let contacts = touching.contacts;
    [
        ShortestMotion { duration: on_contacts, kind: MotionKind::WallOnContacts { wall: index, contacts } },
        ShortestMotion { duration: damping, kind: MotionKind::WallDamping { wall: index } },
    ]
}

/// Bounds on all contacts that a wall can have at the same time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TouchingAtOnce {
    /// Their number.
    pub contacts: f64,
    /// The sum of their steepest slopes [N/m].
    pub stiffness: f64,
    /// The sum of their dashpots [kg/s].
    pub dashpot: f64,
}

impl TouchingAtOnce {
    /// For the wall at `index`; see [`shortest_motion`] for the bound.
    pub fn of(
        particles: &[Particle],
        interactions: &Interactions,
        walls: &[Wall],
        index: usize,
        grows: bool,
    ) -> Self {
        let wall = &walls[index];
        let (mut all, mut largest) = (Self::default(), Self::default());
        for (material, bodies) in extremes_by_material(particles) {
            let Some(model) = interactions.get(material, wall.material) else { continue };
            let count = particles.iter().filter(|particle| particle.material == material).count() as f64;
            let slopes = bodies.map(|body| model.steepest_normal(body, None));
            let stiffness = slopes[0].0.max(slopes[1].0);
            let dashpot = slopes[0].1.max(slopes[1].1);
            all.contacts += count;
            all.stiffness += count * stiffness;
            all.dashpot += count * dashpot;
            largest.stiffness = largest.stiffness.max(stiffness);
            largest.dashpot = largest.dashpot.max(dashpot);
        }
        let smallest = particles.iter().map(|particle| particle.radius).fold(f64::INFINITY, f64::min);
        let room = wall.area.of(walls).map_or(f64::INFINITY, |area| area / (PI * smallest * smallest));
        if grows && room.is_finite() {
            let contacts = room.ceil();
            let (stiffness, dashpot) = (contacts * largest.stiffness, contacts * largest.dashpot);
            return Self { contacts, stiffness, dashpot };
        }
        let contacts = all.contacts.min(room.ceil());
        Self {
            contacts,
            // Zero contacts of infinite room are none.
            stiffness: all.stiffness.min(contacts * largest.stiffness),
            dashpot: all.dashpot.min(contacts * largest.dashpot),
        }
    }
}

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
            for &body in bodies {
                let surface = Partner::Wall { mean_curvature: wall.shape.least_mean_curvature_for(body.1) };
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

    use pulvis_contact::viscosity::{Constant, Viscosity};
    use pulvis_contact::{ContactModel, Hertz, Linear};
    use pulvis_math::Vector3;

    use super::*;
    use crate::walls::{Cylinder, CylinderSide, FaceArea, Plane, PressureRamp, Servo, WallMotion, WallShape};
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
    fn a_servo_wall_counts_with_the_contacts_that_fit_on_its_face() {
        let mut model = ContactModel::frictionless(Linear::new(900.0, 0.0));
        model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 1e-9 });
        let mut interactions = Interactions::new(1);
        interactions.set(0, 0, model);
        let particles = vec![sphere(0, 1e-3); 100];
        let motion = |mass: f64, damping: f64, area: f64, grows: bool| {
            let pressure = PressureRamp { from: 1.0, to: 1.0, duration: 0.0 };
            let mut lid = Wall::fixed("lid", 0, Vector3::zero(), Vector3::new(0.0, 0.0, -1.0));
            lid.motion = WallMotion::Servo(Servo { pressure, mass, damping });
            lid.area = FaceArea::Given(area);
            shortest_motion(&particles, &interactions, &[lid], &Background::default(), grows).unwrap()
        };
        let motion_of = |mass, damping, area| motion(mass, damping, area, false);
        // Disks of π mm² on a face of 10 π mm² and on a face with room for more than all.
        for (area, contacts) in [(10.0 * PI * 1e-6, 10.0), (1.0, 100.0)] {
            let light = motion_of(1e-7, 0.0, area * (1.0 - 1e-12));
            assert_eq!(light.kind, MotionKind::WallOnContacts { wall: 0, contacts });
            let expected = PI * (1e-7 / (contacts * 900.0)).sqrt();
            assert!((light.duration / expected - 1.0).abs() < 1e-12, "{light:?}");
        }
        // Where more come in, only the face counts.
        let crowded = motion(1e-7, 0.0, 1000.0 * PI * 1e-6 * (1.0 - 1e-12), true);
        assert_eq!(crowded.kind, MotionKind::WallOnContacts { wall: 0, contacts: 1000.0 });
        let expected = PI * (1e-7 / (1000.0 * 900.0_f64)).sqrt();
        assert!((crowded.duration / expected - 1.0).abs() < 1e-12, "{crowded:?}");
        // With its damping and ten dashpots.
        let damped = motion_of(1e-3, 1e3, 10.0 * PI * 1e-6 * (1.0 - 1e-12));
        assert_eq!(damped.kind, MotionKind::WallDamping { wall: 0 });
        assert!((damped.duration * 2.0 * (1e3 + 1e-8) / 1e-3 / PI - 1.0).abs() < 1e-12);
        // A heavy wall leaves the contacts alone.
        assert!(matches!(motion_of(1.0, 0.0, 1.0).kind, MotionKind::Contact(_)));
    }

    #[test]
    fn drag_counts_for_the_lightest_particle() {
        let mut interactions = Interactions::new(1);
        interactions.set(0, 0, ContactModel::frictionless(Linear::new(100.0, 0.0)));
        let particles = [sphere(0, 2e-3), sphere(0, 1e-3)];
        let light = particles[1].mass;
        let motion = |background: Background| {
            shortest_motion(&particles, &interactions, &[], &background, false).unwrap()
        };
        let drag = motion(Background { drag: 1.0, ..Background::default() });
        assert_eq!((drag.kind, drag.duration), (MotionKind::Drag, PI / (2.0 * (1.0 / light))));
        let turning = motion(Background { rotational_drag: 1.0, ..Background::default() });
        assert_eq!(
            (turning.kind, turning.duration),
            (MotionKind::RotationalDrag, PI / (2.0 * (2.5 / light)))
        );
        assert!(matches!(motion(Background::default()).kind, MotionKind::Contact(_)));
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
            let expected = time_at(plane.clone(), alike);
            assert!(
                (found.duration / expected.duration - 1.0).abs() < 1e-14,
                "{side:?}: {found:?} {expected:?}"
            );
            // Duration falls as stiffness rises.
            let flat = time_at(plane.clone(), body).duration;
            assert!((found.duration < 0.9 * flat) == (side == CylinderSide::Inside), "{found:?} {flat}");
        }
    }

    #[test]
    fn without_particles_there_is_no_contact() {
        assert_eq!(shortest_contact(&[], &Interactions::new(1), &[]), None);
        assert_eq!(shortest_motion(&[], &Interactions::new(1), &[], &Background::default(), false), None);
    }
}
