//! Symmetries of space and of the pair.

use pulvis_contact::conventions::LeverArm;
use pulvis_contact::{ContactEnergies, ContactModel, ContactResponse};
use pulvis_math::{Vector3, elementary};

use super::Dance;
use crate::bodies::{Kinematics, pair_motion};
use crate::draw::Draw;
use crate::live::{LiveContact, Springs};

const STEPS: usize = 60;

/// Positions of the order of a radius and overlaps of 1e-4 of it carry a relative round-off of 1e-12,
/// velocities from differences of positions one of 1e-10; dashpots add both up over sixty steps.
const ROUND_OFF: f64 = 1e-7;

/// How much more in the step in which a bond breaks.
const BREAKING: f64 = 1e4;

/// One answer of a contact and what it remembers then.
struct Moment {
    answer: ContactResponse<f64>,
    springs: Springs,
    scalars: Vec<f64>,
}

type Performance = Vec<Moment>;
type Size<'a> = &'a dyn Fn(&Moment) -> f64;

/// How a contact looks from elsewhere.
struct View {
    /// What becomes of positions, velocities and forces.
    polar: Box<dyn Fn(Vector3) -> Vector3>,
    /// What becomes of angular velocities and torques.
    axial: Box<dyn Fn(Vector3) -> Vector3>,
    /// What becomes of the torsion spring, n·(turn): a scalar that a mirror turns round.
    torsion: f64,
    /// Whether i and j are exchanged. Then n, forces and the sliding spring change sign; the rolling
    /// spring, n × (ω_i − ω_j), and the torsion springs, n·(ω_i − ω_j), keep it. Those of a bond against shear and bending
    /// are a displacement and a rotation of i against j.
    exchanged: bool,
}

impl View {
    fn kinematics(&self, dance: &Dance, step: usize) -> [Kinematics; 2] {
        let seen = dance.step(step, STEPS).map(|body| Kinematics {
            position: (self.polar)(body.position),
            velocity: (self.polar)(body.velocity),
            velocity_mid: (self.polar)(body.velocity_mid),
            angular_velocity: (self.axial)(body.angular_velocity),
            angular_velocity_mid: (self.axial)(body.angular_velocity_mid),
        });
        if self.exchanged { [seen[1], seen[0]] } else { seen }
    }

    fn response(&self, answer: &ContactResponse<f64>) -> [Vector3; 3] {
        let [first, second] = [answer.torque_i, answer.torque_j].map(&self.axial);
        let force = (self.polar)(answer.force);
        if self.exchanged { [-force, second, first] } else { [force, first, second] }
    }

    fn springs(&self, springs: &Springs) -> Springs {
        let turned = |vector: Vector3| if self.exchanged { -vector } else { vector };
        Springs {
            sliding: turned((self.polar)(springs.sliding)),
            rolling: (self.polar)(springs.rolling),
            torsion: self.torsion * springs.torsion,
            bond_shear: turned((self.polar)(springs.bond_shear)),
            bond_bending: turned((self.axial)(springs.bond_bending)),
            bond_twist: self.torsion * springs.bond_twist,
        }
    }
}

fn perform(model: &ContactModel, dance: &Dance, view: &View) -> Performance {
    let mut contact = LiveContact::new(model, dance.pair);
    let dt = dance.duration / STEPS as f64;
    let radii = [dance.radius_i, dance.radius_j];
    let [radius_i, radius_j] = if view.exchanged { [radii[1], radii[0]] } else { radii };
    (0..=STEPS)
        .map(|step| {
            let [i, j] = view.kinematics(dance, step);
            let answer = contact.respond(&pair_motion(radius_i, &i, Some((radius_j, &j))), dt);
            Moment { answer, springs: contact.springs(), scalars: contact.scalars() }
        })
        .collect()
}

fn as_it_is() -> View {
    View { polar: Box::new(|v| v), axial: Box::new(|v| v), torsion: 1.0, exchanged: false }
}

/// Asserts that the contact seen by `view` is the view of the contact.
fn looks_the_same(model: &ContactModel, dance: &Dance, view: &View) {
    let (direct, seen) = (perform(model, dance, &as_it_is()), perform(model, dance, view));
    let largest = |size: Size| ROUND_OFF * direct.iter().map(size).fold(1e-290, f64::max);
    let force = largest(&|Moment { answer, .. }| answer.force.norm());
    let torque = largest(&|Moment { answer, .. }| answer.torque_i.norm().max(answer.torque_j.norm()));
    let spring =
        largest(&|Moment { springs: s, .. }| s.sliding.norm().max(s.rolling.norm()).max(s.torsion.abs()));
    let bond_shear = largest(&|Moment { springs: s, .. }| s.bond_shear.norm());
    let bond_turn = largest(&|Moment { springs: s, .. }| s.bond_bending.norm().max(s.bond_twist.abs()));
    let energy = largest(&|Moment { answer, .. }| {
        let energies = ContactEnergies { viscous_power: 0.0, ..answer.energies };
        energies.accounts().iter().map(|(_, energy)| energy.abs()).sum()
    });
    let power = largest(&|Moment { answer, .. }| answer.energies.viscous_power.abs());
    let columns = 0..direct[0].scalars.len();
    let size = |column: usize| direct.iter().map(|moment| moment.scalars[column].abs()).fold(0.0, f64::max);
    let largest_scalars: Vec<f64> = columns.map(size).collect();
    for (step, (direct, seen)) in direct.iter().zip(&seen).enumerate() {
        let (Moment { answer, springs, scalars }, other, others) = (direct, seen.answer, seen.springs);
        // When within its step a bond broke is known to the round-off of positions over the way of that step.
        let wider = if answer.energies.dissipated_fracture > 0.0 { BREAKING } else { 1.0 };
        let close = |one: f64, what: &str, tolerance: f64| {
            let tolerance = wider * tolerance;
            assert!(one <= tolerance, "{what} differs by {one}, allowed {tolerance}, step {step}, {model:?}");
        };
        let [expected, first, second] = view.response(answer);
        close((expected - other.force).norm(), "force", force);
        close((first - other.torque_i).norm(), "torque on i", torque);
        close((second - other.torque_j).norm(), "torque on j", torque);
        let expected = view.springs(springs);
        close((expected.sliding - others.sliding).norm(), "sliding spring", spring);
        close((expected.rolling - others.rolling).norm(), "rolling spring", spring);
        close((expected.torsion - others.torsion).abs(), "torsion spring", spring);
        close((expected.bond_shear - others.bond_shear).norm(), "shear of the bond", bond_shear);
        close((expected.bond_bending - others.bond_bending).norm(), "bending of the bond", bond_turn);
        close((expected.bond_twist - others.bond_twist).abs(), "twist of the bond", bond_turn);
        for (index, (one, two)) in scalars.iter().zip(&seen.scalars).enumerate() {
            close((one - two).abs(), "memory", ROUND_OFF * largest_scalars[index]);
        }
        let pairs = answer.energies.accounts().into_iter().zip(other.energies.accounts());
        for ((account, one), (_, two)) in pairs {
            let tolerance = if account == "viscous_power" { power } else { energy };
            close((one - two).abs(), account, tolerance);
        }
    }
}

pub(super) fn a_turned_frame_turns_the_answer(model: &ContactModel, dance: &Dance, draw: &mut Draw) {
    let axis = draw.direction();
    let (sine, cosine) = elementary::sin_cos(draw.between(0.0, std::f64::consts::TAU));
    // Rodrigues' rotation.
    let turn = move |v: Vector3| v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
    looks_the_same(model, dance, &View { polar: Box::new(turn), axial: Box::new(turn), ..as_it_is() });
}

pub(super) fn exchanged_bodies_feel_the_same(model: &ContactModel, dance: &Dance) {
    looks_the_same(model, dance, &View { exchanged: true, ..as_it_is() });
}

pub(super) fn a_mirror_shows_the_same_contact(model: &ContactModel, dance: &Dance, draw: &mut Draw) {
    let across = draw.direction();
    let mirror = move |v: Vector3| v - across * (2.0 * across.dot(v));
    let view = View {
        polar: Box::new(mirror),
        axial: Box::new(move |v| -mirror(v)),
        torsion: -1.0,
        exchanged: false,
    };
    looks_the_same(model, dance, &view);
}

pub(super) fn a_common_speed_changes_nothing(model: &ContactModel, dance: &Dance, draw: &mut Draw) {
    let dt = dance.duration / STEPS as f64;
    let boost = draw.vector() * (dance.radius_i / dance.duration);
    let run = |boost: Vector3| -> Performance {
        let mut contact = LiveContact::new(model, dance.pair);
        (0..=STEPS)
            .map(|step| {
                let [i, j] = dance.step(step, STEPS).map(|body| Kinematics {
                    position: body.position + boost * (dt * step as f64),
                    velocity: body.velocity + boost,
                    velocity_mid: body.velocity_mid + boost,
                    ..body
                });
                let motion = pair_motion(dance.radius_i, &i, Some((dance.radius_j, &j)));
                let answer = contact.respond(&motion, dt);
                Moment { answer, springs: contact.springs(), scalars: contact.scalars() }
            })
            .collect()
    };
    let (resting, moving) = (run(Vector3::zero()), run(boost));
    let scale = resting.iter().map(|moment| moment.answer.force.norm()).fold(1e-290, f64::max);
    for (one, other) in resting.iter().zip(&moving) {
        let difference = (one.answer.force - other.answer.force).norm();
        assert!(difference <= ROUND_OFF * scale, "{difference} N of {scale} N, {model:?}");
    }
}

pub(super) fn momentum_is_only_exchanged(model: &ContactModel, dance: &Dance) {
    if model.laws.conventions.lever_arm != LeverArm::Corrected {
        // Uncorrected arms add up to more than the distance: no such promise.
        return;
    }
    let performance = perform(model, dance, &as_it_is());
    for (step, Moment { answer, .. }) in performance.iter().enumerate() {
        let [i, j] = dance.step(step, STEPS);
        let between = i.position - j.position;
        // The force on j is −force, so that the total torque about any point is this.
        let total = answer.torque_i + answer.torque_j + between.cross(answer.force);
        let scale = answer.torque_i.norm() + answer.torque_j.norm() + between.norm() * answer.force.norm();
        assert!(total.norm() <= 1e-14 * scale, "{} of {scale} N m, {model:?}", total.norm());
    }
}

pub(super) fn losses_are_losses(model: &ContactModel, dance: &Dance) {
    let performance = perform(model, dance, &as_it_is());
    let turned_over = |moment: &Moment| {
        let e = &moment.answer.energies;
        e.elastic_normal + e.dissipated_plastic.abs() + e.dissipated_adhesive.abs()
    };
    let scale = performance.iter().map(turned_over).fold(1e-290, f64::max);
    for Moment { answer, .. } in &performance {
        let e = &answer.energies;
        // In the step in which a bond breaks or bodies part, the power stands for less than half of a step.
        let ends = e.dissipated_fracture > 0.0 || answer.event_force != 0.0;
        assert!(e.viscous_power >= 0.0 || ends, "{e:?}, {model:?}");
        assert!(e.dissipated_fracture >= 0.0 && e.elastic_bond >= 0.0, "{e:?}, {model:?}");
        if model.normal.is_passive() {
            assert!(e.dissipated_plastic >= -1e-12 * scale, "{e:?}, {model:?}");
            assert!(e.dissipated_adhesive >= -1e-12 * scale, "{e:?}, {model:?}");
        }
        let stored = [e.elastic_normal, e.elastic_sliding, e.elastic_rolling, e.elastic_torsion];
        assert!(stored.iter().all(|&energy| energy >= 0.0), "{e:?}, {model:?}");
    }
}
