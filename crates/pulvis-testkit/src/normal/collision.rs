//! Collisions at the time step that follows from the law.

use pulvis_contact::{ContactLaws, ContactModel, ExpectedLoading, Normal, NormalLaw, NormalLawVisitor, Pair};
use pulvis_math::Vector3;

use crate::bodies::{Couple, Sphere};
use crate::draw::Draw;
use crate::parameters::{loaded_to, pair_of, random_bodies};

/// Time steps in the shortest contact, as the engine takes them by itself.
const STEPS: f64 = 50.0;
/// Steps after which bodies that stick have been looked at long enough.
const MOST_STEPS: f64 = 60.0 * STEPS;

/// What a collision may lose or gain beside what the law dissipates, of its energy: nearly always, and at the most.
struct Allowed {
    nearly_always: f64,
    at_most: f64,
}

impl Allowed {
    /// Along a branch of constant slope the method keeps K + V − Δt² f²/(8 m) exactly. Where the slope changes by Δk within a
    /// step of the way h = v Δt, the trapezoidal rule errs by Δk h²/8 at the most, in the middle of the step: with
    /// Δt = (π/50) √(m/k) by (π/50)²/4 Δk/k = 1e-3 Δk/k of the energy m v²/2. A law has such a kink at touch, where its
    /// attraction begins (there Δk/k may be 2), and at its end, and rarely are all met in the middle of a step. Where the
    /// force jumps, also that of a dashpot at touch, the error is several times as large.
    fn of(law: &Normal, pair: &Pair, expected: &ExpectedLoading) -> Self {
        struct Jumps;
        impl NormalLawVisitor for Jumps {
            type Output = bool;
            fn visit<N: NormalLaw>(self, _law: &N) -> bool {
                N::JUMPS
            }
        }
        if law.accept(Jumps) || law.dashpot(pair, expected) > 0.0 {
            return Self { nearly_always: 5e-3, at_most: 5e-3 };
        }
        // What changes with time bends the path within a step, too.
        if law.depends_on_time() {
            return Self { nearly_always: 2e-3, at_most: 2.5e-3 };
        }
        Self { nearly_always: 1e-3, at_most: 2.5e-3 }
    }
}

/// How many collisions there were, and in how many more was missing than nearly always.
#[derive(Default)]
pub(super) struct Collisions {
    all: u64,
    beyond: u64,
    worst: f64,
}

impl Collisions {
    /// Asserts that at most one of a thousand lies beyond; of fewer than a thousand, one.
    pub(super) fn are_nearly_always_right(&self, law: &str) {
        let Self { all, beyond, worst } = self;

        assert!(beyond * 1000 <= *(all.max(&1000)), "{law}: {beyond} of {all} collisions, at most {worst}");
    }
}

/// A head-on collision of random bodies at a random speed, for which the law's greatest stiffness is asked.
pub(super) fn a_collision_at_the_automatic_step_keeps_its_energy(
    law: &Normal,
    draw: &mut Draw,
    collisions: &mut Collisions,
) {
    let (body_i, body_j) = random_bodies(draw);
    let pair = pair_of(body_i, body_j);
    let overlap = pair.harmonic_radius() * draw.log_between(1e-6, 0.03);
    let stiffness = law.max_stiffness(&pair, &loaded_to(overlap, &pair));
    let speed = overlap * (stiffness * pair.inverse_reduced_mass()).sqrt();
    let expected = ExpectedLoading { speed, force: 0.0, overlap: 0.0 };
    let laws = ContactLaws { expected, ..ContactLaws::default() };
    let model = ContactModel { normal: *law, laws };
    let dt = model.shortest_contact_time(body_i, body_j) / STEPS;
    let range = model.interaction_range(&pair, [body_i.1, body_j.map_or(0.0, |(_, radius)| radius)]);
    let touching = body_i.1 + body_j.map_or(0.0, |(_, radius)| radius);
    let height = touching + range + draw.between(1.0, 2.0) * speed * dt;
    let mut sphere = Sphere::at_rest(body_i.0, body_i.1, Vector3::new(0.0, 0.0, height));
    sphere.velocity.z = -speed;
    let partner = body_j.map(|(mass, radius)| Sphere::at_rest(mass, radius, Vector3::zero()));
    let mut couple = Couple::new(&model, sphere, partner);
    let energy = couple.kinetic_energy();
    // The centre of mass keeps some.
    let relative = 0.5 * speed * speed * pair.reduced_mass();
    let (mut most, mut deepest, mut after) = (relative, 0.0_f64, 0);
    for _ in 0..MOST_STEPS as u64 {
        couple.step(dt);
        // With an attraction more is turned over than the bodies bring.
        most = most.max(relative + couple.kinetic_energy() - energy).max(couple.elastic_normal + couple.lost);
        let apart = couple.overlap <= -range && couple.i.velocity.z > couple.j.map_or(0.0, |j| j.velocity.z);
        deepest = deepest.max(couple.overlap).max(couple.normal_force.abs() / stiffness);
        // The books are right from the step after a jump on.
        after = if apart { after + 1 } else { 0 };
        if after == 3 {
            break;
        }
    }
    // An attraction that no particle can have, pressing it far into the other one.
    if deepest > 0.5 * pair.harmonic_radius() {
        return;
    }
    let missing: f64 = (couple.kinetic_energy() + couple.stored + couple.lost - energy) / most;
    let allowed = Allowed::of(law, &pair, &expected);
    assert!(
        missing.abs() < allowed.at_most,
        "{law:?}: {missing} of the energy is missing at {speed} m/s, {pair:?}"
    );
    collisions.all += 1;
    collisions.beyond += u64::from(missing.abs() > allowed.nearly_always);
    collisions.worst = collisions.worst.max(missing.abs());
}
