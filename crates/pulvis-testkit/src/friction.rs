//! Laws against sliding, rolling and torsion: along no path do they give back work that was not done on them, and what
//! they are given is stored or lost.

use pulvis_contact::catalogue::{LawEntry, Role, Value, Values};
use pulvis_contact::conventions::SlipDashpot;
use pulvis_contact::friction::{self, Along, FrictionLaw, FrictionVisitor, SpringMotion, Tangent};
use pulvis_contact::{ContactScale, Friction};
use pulvis_math::Vector3;

use crate::draw::Draw;
use crate::for_each_case;
use crate::parameters::random_law;

/// What friction sees of a contact: how large and how loaded it is.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// Normal force of the Coulomb limit [N].
    pub reference: f64,
    /// Radius of the contact area [m].
    pub radius: f64,
    /// Force that pulls the bodies apart [N].
    pub pull_off: f64,
    /// Stiffness of the normal force [N/m].
    pub stiffness: f64,
    /// Lever of rolling and torsion [m].
    pub lever: f64,
}

impl Load {
    /// A load without adhesion, at an area of the radius [m].
    pub fn new(reference: f64, radius: f64) -> Self {
        Self { reference, radius, pull_off: 0.0, stiffness: 0.0, lever: 1.0 }
    }

    fn scale(&self) -> ContactScale {
        ContactScale {
            contact_radius: self.radius,
            normal_stiffness: self.stiffness,
            harmonic_radius: self.lever,
        }
    }

    /// A displacement [m] within `elapsed` [s] of a closed contact.
    pub fn moved<T: Tangent<f64>>(&self, displacement: T, elapsed: f64) -> SpringMotion<T, f64> {
        SpringMotion {
            velocity: displacement.scaled(1.0 / elapsed),
            displacement,
            elapsed,
            in_contact: true,
            friction_reference: self.reference,
            contact_radius: self.radius,
            pull_off_force: self.pull_off,
            normal_stiffness: self.stiffness,
            lever: self.lever,
            slip_dashpot: SlipDashpot::Series,
        }
    }
}

/// A friction law on a path, with its books.
#[derive(Clone, Copy, Debug)]
pub struct Walk<F: FrictionLaw, T> {
    law: F,
    vector: T,
    scalars: F::Scalars<f64>,
    /// Force against the motion [N].
    pub force: T,
    /// Energy that the law stores [J].
    pub stored: f64,
    /// Energy that it has lost [J].
    pub lost: f64,
    /// Work that was done on it, by the trapezoidal rule, as the two half kicks of a step do it [J].
    pub work: f64,
    /// Sum of that regardless of its sign [J].
    pub turned_over: f64,
    /// The least by which the work has exceeded what was stored then [J].
    pub least: f64,
}

impl<F: FrictionLaw, T: Tangent<f64>> Walk<F, T> {
    /// At the beginning of a contact.
    pub fn new(law: F) -> Self {
        let (scalars, zero) = (F::Scalars::default(), T::zero());
        Self {
            law,
            vector: zero,
            scalars,
            force: zero,
            stored: 0.0,
            lost: 0.0,
            work: 0.0,
            turned_over: 0.0,
            least: 0.0,
        }
    }

    /// One step by a displacement [m] under a load.
    pub fn go(&mut self, load: &Load, displacement: T) {
        let motion = load.moved(displacement, 1.0);
        let (answer, _) = self.law.respond(&motion, &mut self.vector, &mut self.scalars);
        let done = -0.5 * (self.force + answer.force).dot(displacement);
        self.force = answer.force;
        self.stored = answer.stored_energy;
        self.lost += answer.dissipated_slip;
        self.work += done;
        self.turned_over += done.abs();
        self.least = self.least.min(self.work - self.stored);
    }
}

/// Checks every law of every role along `count` random closed paths each.
pub fn check_all(count: u64) {
    for role in [Role::Sliding, Role::Rolling, Role::Torsion] {
        for entry in friction::entries(role) {
            for_each_case(entry.name, count, |draw| {
                let unlimited = draw.chance(0.5);
                if let Some(law) = drawn(entry, unlimited, draw) {
                    law.accept(OnPath { friction: law, flat: role != Role::Torsion, unlimited, draw });
                }
            });
        }
    }
}

/// A law with random parameters, without dashpots, and with the passive variant where it has several; `unlimited`: with
/// a coefficient of friction that no force comes up to. A finite one hides rules that create energy.
fn drawn(entry: &LawEntry, unlimited: bool, draw: &mut Draw) -> Option<Friction> {
    let coefficient = if unlimited { 1e9 } else { draw.log_between(0.05, 1.0) };
    random_law(entry, draw, |name, values| {
        let mut values: Values = values.clone();
        for parameter in entry.parameters {
            if parameter.name.starts_with("mu") {
                values.set(parameter.name, Value::Number(coefficient));
            } else if parameter.name.starts_with("gamma") {
                values.set(parameter.name, Value::Number(0.0));
            } else if parameter.name == "variant" {
                values.set("variant", Value::Choice("passive".to_owned()));
            }
        }
        friction::build(entry.role, name, &values)
    })
}

struct OnPath<'a> {
    friction: Friction,
    flat: bool,
    unlimited: bool,
    draw: &'a mut Draw,
}

impl FrictionVisitor for OnPath<'_> {
    type Output = ();

    fn visit<F: FrictionLaw>(self, law: &F) {
        let Self { friction, flat, unlimited, draw } = self;
        if flat {
            let direction =
                |draw: &mut Draw| Vector3::new(draw.between(-1.0, 1.0), draw.between(-1.0, 1.0), 0.0);
            no_work_comes_back(Walk::<F, Vector3>::new(*law), &friction, unlimited, draw, direction);
        } else {
            let direction = |draw: &mut Draw| Along(draw.between(-1.0, 1.0));
            no_work_comes_back(Walk::<F, Along<f64>>::new(*law), &friction, unlimited, draw, direction);
        }
    }
}

/// A closed path whose legs change either the load or the displacement: the trapezoidal rule then leaves no error.
fn no_work_comes_back<F: FrictionLaw, T: Tangent<f64>>(
    mut walk: Walk<F, T>,
    friction: &Friction,
    unlimited: bool,
    draw: &mut Draw,
    direction: impl Fn(&mut Draw) -> T,
) {
    let (force, radius) = (draw.log_between(1e-6, 1.0), draw.log_between(1e-6, 1e-3));
    let adhesive = draw.chance(0.5);
    // Slip may jump down to its limit: in steps that a spring follows.
    let steps = if unlimited { 1 } else { 50 };
    let mut gone = T::zero();
    let mut load = Load::new(0.0, 0.0);
    let legs = 6 + (draw.unit() * 14.0) as usize;
    for leg in 0..=legs {
        if leg < legs || load.radius == 0.0 {
            load = random_load(force, radius, adhesive, draw);
            walk.go(&load, T::zero());
        }
        let stiffness = friction.max_stiffness(&load.scale());
        let length = if stiffness > 0.0 { force / stiffness } else { radius };
        // A coefficient of 1e9 makes some springs as stiff.
        let displacement = if leg < legs {
            direction(draw).scaled(2.0 * length.max(1e-12 * radius))
        } else {
            T::zero() - gone
        };
        let count = if leg < legs { steps } else { 20 * steps };
        for _ in 0..count {
            walk.go(&load, displacement.scaled(1.0 / f64::from(count)));
        }
        gone = gone + displacement;
    }
    let books = walk.work - walk.stored - walk.lost;
    let round_off = 1e-11 * walk.turned_over;
    assert!(books.abs() <= round_off, "{books} J of {} J are missing: {friction:?}", walk.turned_over);
    assert!(
        walk.least >= -round_off,
        "{} J of {} J from nothing: {friction:?}",
        walk.least,
        walk.turned_over
    );
    assert!(walk.work >= -round_off, "a cycle gives {} J back: {friction:?}", -walk.work);
}

fn random_load(force: f64, radius: f64, adhesive: bool, draw: &mut Draw) -> Load {
    let reference = force * draw.log_between(0.1, 10.0);
    // P ≥ −F_c, and the limit refers to P + 2 F_c.
    let pull_off = if adhesive { reference * draw.between(0.0, 1.0) } else { 0.0 };
    let radius = radius * draw.log_between(0.1, 4.0);
    Load { reference, radius, pull_off, stiffness: force / radius * draw.log_between(0.3, 3.0), lever: 1e-3 }
}
