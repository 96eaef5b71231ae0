//! Synchronised velocity-Verlet, and the sum of forces on each particle.

use pulvis_math::Vector3;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rayon::slice::{ParallelSlice, ParallelSliceMut};

use crate::background::Background;
use crate::contacts::ContactTable;
use crate::particles::Particles;
use crate::team::Team;

/// Rows that one thread works on at a time. Fixed, so that sums over pieces do not depend on the
/// number of threads.
const ROWS: usize = 256;

/// First half kick and drift over `time_step` [s]. Predicted velocities are those at the end of the
/// step if forces stay as they are: what dashpots see, at the same instant as the positions. Answers
/// with the largest square of the distance of any particle from its place in `listed` [m²], infinite
/// where a position is no number.
pub(crate) fn kick_and_drift(
    particles: &mut Particles,
    listed: &[Vector3],
    time_step: f64,
    team: &Team,
) -> f64 {
    let half = 0.5 * time_step;
    let piece = |columns: DriftColumns<'_>| -> f64 {
        let (position, velocity, spin, velocity_predicted, spin_predicted, fixed) = columns;
        let (force, torque, mass, radius, listed) = fixed;
        let mut farthest = 0.0;
        for row in 0..position.len() {
            let kick = force[row] * (half / mass[row]);
            let turn = torque[row] * (half / (0.4 * mass[row] * radius[row] * radius[row]));
            velocity[row] += kick;
            spin[row] += turn;
            velocity_predicted[row] = velocity[row] + kick;
            spin_predicted[row] = spin[row] + turn;
            position[row] += velocity[row] * time_step;
            let moved = (position[row] - listed[row]).norm_squared();
            // Not `max`: a NaN must not be passed over.
            farthest = if moved <= farthest { farthest } else { moved };
            if farthest.is_nan() {
                farthest = f64::INFINITY;
            }
        }
        farthest
    };
    match team {
        Team::Alone => piece((
            &mut particles.position,
            &mut particles.velocity,
            &mut particles.spin,
            &mut particles.velocity_predicted,
            &mut particles.spin_predicted,
            (&particles.force, &particles.torque, &particles.mass, &particles.radius, listed),
        )),
        Team::Pool(pool) => pool.install(|| {
            let fixed = (
                particles.force.par_chunks(ROWS),
                particles.torque.par_chunks(ROWS),
                particles.mass.par_chunks(ROWS),
                particles.radius.par_chunks(ROWS),
                listed.par_chunks(ROWS),
            );
            let columns = (
                particles.position.par_chunks_mut(ROWS),
                particles.velocity.par_chunks_mut(ROWS),
                particles.spin.par_chunks_mut(ROWS),
                particles.velocity_predicted.par_chunks_mut(ROWS),
                particles.spin_predicted.par_chunks_mut(ROWS),
                fixed.into_par_iter(),
            );
            columns.into_par_iter().map(piece).reduce(|| 0.0, f64::max)
        }),
    }
}

type DriftColumns<'a> = (
    &'a mut [Vector3],
    &'a mut [Vector3],
    &'a mut [Vector3],
    &'a mut [Vector3],
    &'a mut [Vector3],
    (&'a [Vector3], &'a [Vector3], &'a [f64], &'a [f64], &'a [Vector3]),
);

/// Sums the forces of contacts and background on every particle, and does the second half kick over
/// `half` a time step [s]. Answers with the power that the drag takes [W].
pub(crate) fn collect_and_kick(
    particles: &mut Particles,
    contacts: &ContactTable,
    background: &Background,
    half: f64,
    team: &Team,
) -> f64 {
    let piece = |number: usize, columns: KickColumns<'_>| -> f64 {
        let (force, torque, velocity, spin, fixed) = columns;
        let (velocity_predicted, spin_predicted, mass, radius) = fixed;
        let mut power = 0.0;
        for place in 0..force.len() {
            let (push, turn) = contacts.on_particle(number * ROWS + place);
            let drag = background.drag_on(velocity_predicted[place], spin_predicted[place], radius[place]);
            power += drag.power;
            force[place] = push + background.gravity * mass[place] - drag.force;
            torque[place] = turn - drag.torque;
            velocity[place] += force[place] * (half / mass[place]);
            let inertia = 0.4 * mass[place] * radius[place] * radius[place];
            spin[place] += torque[place] * (half / inertia);
        }
        power
    };
    let pieces = particles.len().div_ceil(ROWS);
    if let (Team::Pool(pool), true) = (team, pieces > 1) {
        let powers: Vec<f64> = pool.install(|| {
            let fixed = (
                particles.velocity_predicted.par_chunks(ROWS),
                particles.spin_predicted.par_chunks(ROWS),
                particles.mass.par_chunks(ROWS),
                particles.radius.par_chunks(ROWS),
            );
            let columns = (
                particles.force.par_chunks_mut(ROWS),
                particles.torque.par_chunks_mut(ROWS),
                particles.velocity.par_chunks_mut(ROWS),
                particles.spin.par_chunks_mut(ROWS),
                fixed.into_par_iter(),
            );
            let numbered = ((0..pieces).into_par_iter(), columns.into_par_iter());
            numbered.into_par_iter().map(|(number, columns)| piece(number, columns)).collect()
        });
        return powers.iter().sum();
    }
    let fixed = particles
        .velocity_predicted
        .chunks(ROWS)
        .zip(particles.spin_predicted.chunks(ROWS))
        .zip(particles.mass.chunks(ROWS).zip(particles.radius.chunks(ROWS)));
    let columns = particles
        .force
        .chunks_mut(ROWS)
        .zip(particles.torque.chunks_mut(ROWS))
        .zip(particles.velocity.chunks_mut(ROWS).zip(particles.spin.chunks_mut(ROWS)))
        .zip(fixed);
    let mut power = 0.0;
    for (number, (((force, torque), (velocity, spin)), ((v, w), (mass, radius)))) in columns.enumerate() {
        power += piece(number, (force, torque, velocity, spin, (v, w, mass, radius)));
    }
    power
}

type KickColumns<'a> = (
    &'a mut [Vector3],
    &'a mut [Vector3],
    &'a mut [Vector3],
    &'a mut [Vector3],
    (&'a [Vector3], &'a [Vector3], &'a [f64], &'a [f64]),
);
