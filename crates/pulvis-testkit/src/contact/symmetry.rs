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

/// How a contact looks from elsewhere.
struct View {
    /// By how much positions are moved at first [m].
    shift: Vector3,
    /// A speed that all bodies have beside their own [m/s].
    drift: Vector3,
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
        let moved = self.shift + self.drift * (dance.duration / STEPS as f64 * step as f64);
        let seen = dance.step(step, STEPS).map(|body| Kinematics {
            position: (self.polar)(body.position + moved),
            velocity: (self.polar)(body.velocity + self.drift),
            velocity_mid: (self.polar)(body.velocity_mid + self.drift),
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
    View {
        shift: Vector3::zero(),
        drift: Vector3::zero(),
        polar: Box::new(|v| v),
        axial: Box::new(|v| v),
        torsion: 1.0,
        exchanged: false,
    }
}

/// Asserts that the contact seen by `view` is the view of the contact.
///
/// Whether a bond breaks in a step or a contact peels off in it is now and then decided by the round-off of positions and
/// velocities; springs and memory then go other ways for good. Such a dance says nothing about symmetry. It is known by
/// this: it goes other ways already where it is danced elsewhere at another speed.
fn looks_the_same(model: &ContactModel, dance: &Dance, view: &View) {
    let (direct, seen) = (perform(model, dance, &as_it_is()), perform(model, dance, view));
    let Some(difference) = first_difference(&direct, &seen, view) else { return };
    let is_a_matter_of_round_off = (0..PLACES).any(|number| {
        let elsewhere = elsewhere(dance, number);
        let other = perform(model, dance, &elsewhere);
        first_difference(&direct, &other, &elsewhere).is_some()
    });
    assert!(is_a_matter_of_round_off, "{difference}, {model:?}");
}

/// Places that are tried, and radii by which they lie off and by which the dance moves on there.
const PLACES: u64 = 64;
const FARTHEST: f64 = 30.0;

/// A dance in one of several places, at another speed.
fn elsewhere(dance: &Dance, number: u64) -> View {
    let mut draw = Draw::new(number);
    let mut far = || draw.direction() * (draw.between(0.5, 1.0) * FARTHEST * dance.radius_i);
    let (shift, way) = (far(), far());
    View { shift, drift: way * (1.0 / dance.duration), ..as_it_is() }
}

/// What first differs between a contact and the view of it by more than round-off.
fn first_difference(direct: &Performance, seen: &Performance, view: &View) -> Option<String> {
    let all: Vec<_> = direct.iter().zip(seen).map(|(one, other)| compared(one, other, view)).collect();
    let largest = |place: usize| all.iter().map(|moment| moment[place].size).fold(1e-290, f64::max);
    let scales: Vec<f64> = (0..all[0].len()).map(largest).collect();
    for (step, (moment, direct)) in all.iter().zip(direct).enumerate() {
        // When within its step a bond broke is known to the round-off of positions over the way of that step.
        let breaking = if direct.answer.energies.dissipated_fracture > 0.0 { BREAKING } else { 1.0 };
        for (Compared { what, difference, .. }, scale) in moment.iter().zip(&scales) {
            let allowed = breaking * ROUND_OFF * scale;
            if difference.is_nan() || *difference > allowed {
                return Some(format!("{what} differs by {difference}, allowed {allowed}, step {step}"));
            }
        }
    }
    None
}

/// One quantity of a contact and of the view of it: how far they lie apart, and how large it is.
struct Compared {
    what: &'static str,
    difference: f64,
    size: f64,
}

fn compared(direct: &Moment, seen: &Moment, view: &View) -> Vec<Compared> {
    let (answer, other) = (&direct.answer, &seen.answer);
    let [force, first, second] = view.response(answer);
    let (springs, others) = (view.springs(&direct.springs), &seen.springs);
    let torque = first.norm().max(second.norm());
    let spring = springs.sliding.norm().max(springs.rolling.norm()).max(springs.torsion.abs());
    let turn = springs.bond_bending.norm().max(springs.bond_twist.abs());
    let energies = ContactEnergies { viscous_power: 0.0, ..answer.energies }.accounts();
    let energy = energies.iter().map(|(_, energy)| energy.abs()).sum();
    let one = |what, difference, size| Compared { what, difference, size };
    let mut all = vec![
        one("force", (force - other.force).norm(), force.norm()),
        one("torque on i", (first - other.torque_i).norm(), torque),
        one("torque on j", (second - other.torque_j).norm(), torque),
        one("sliding spring", (springs.sliding - others.sliding).norm(), spring),
        one("rolling spring", (springs.rolling - others.rolling).norm(), spring),
        one("torsion spring", (springs.torsion - others.torsion).abs(), spring),
        one("shear of bond", (springs.bond_shear - others.bond_shear).norm(), springs.bond_shear.norm()),
        one("bending of bond", (springs.bond_bending - others.bond_bending).norm(), turn),
        one("twist of bond", (springs.bond_twist - others.bond_twist).abs(), turn),
    ];
    let memory = direct.scalars.iter().zip(&seen.scalars);
    // Remembered energies are squares of forces: their relative round-off is twice that of the forces.
    all.extend(memory.map(|(column, other)| one("memory", (column - other).abs(), 2.0 * column.abs())));
    let accounts = answer.energies.accounts().into_iter().zip(other.energies.accounts());
    all.extend(accounts.map(|((account, value), (_, other))| {
        one(account, (value - other).abs(), if account == "viscous_power" { value.abs() } else { energy })
    }));
    all
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
    let view =
        View { polar: Box::new(mirror), axial: Box::new(move |v| -mirror(v)), torsion: -1.0, ..as_it_is() };
    looks_the_same(model, dance, &view);
}

pub(super) fn a_common_speed_changes_nothing(model: &ContactModel, dance: &Dance, draw: &mut Draw) {
    let drift = draw.vector() * (dance.radius_i / dance.duration);
    looks_the_same(model, dance, &View { drift, ..as_it_is() });
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
