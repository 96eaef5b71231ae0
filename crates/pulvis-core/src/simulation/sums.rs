//! Sums over all chunks: of what contacts came to in a pass, and of the energies of rows. They have the same bits for any
//! number of threads and of ranks; see [`ChunkTree`].

use std::ops::Range;

use pulvis_contact::ContactEnergies;
use pulvis_math::max_or_nan;
use pulvis_parallel::exchange::ExchangeError;

use super::Simulation;
use crate::chunk_tree::ChunkTree;
use crate::contacts::ContactTotals;
use crate::ranks::message::Numbers;
use crate::walls::WallForce;

type Agreed<T = ()> = Result<T, ExchangeError>;

/// What all contacts, and the kicks after them, came to in the last pass.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PassTotals {
    pub(super) energies: ContactEnergies,
    /// Power of the drag [W].
    pub(super) background_power: f64,
    /// The largest k/m_r of a contact whose law does not bound its stiffness [1/s²].
    pub(super) rate_squared: f64,
    /// For observation; of the last pass that ended an advance.
    pub(super) observed: ContactTotals,
}

/// Energies of all rows, and what comes with them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RowSums {
    /// Kinetic energies [J]; those of prescribed particles are outside, like those of walls.
    pub(super) translation: f64,
    pub(super) rotation: f64,
    /// Σ F²/m + Σ T²/I of the same particles [J/s²].
    pub(super) discretisation: f64,
    /// Potential energy of gravity [J].
    pub(super) potential: f64,
    /// Potential energy of charges that act over all distances [J].
    pub(super) electrostatic: f64,
    /// The largest speed of a particle [m/s].
    pub(super) fastest: f64,
}

impl RowSums {
    const SUMS: usize = 5;
    const NUMBERS: usize = 6;

    fn of(numbers: &[f64]) -> Agreed<Self> {
        let mut numbers = Numbers::of(numbers);
        Ok(Self {
            translation: numbers.next()?,
            rotation: numbers.next()?,
            discretisation: numbers.next()?,
            potential: numbers.next()?,
            electrostatic: numbers.next()?,
            fastest: numbers.next()?.sqrt(),
        })
    }
}

/// Numbers of the contacts of an observed chunk that are added.
const OBSERVED: usize = 11;

impl Simulation {
    /// Adds up what all chunks came to in the last pass; with `observes`, what is there for observation, too.
    pub(super) fn sum_up(&mut self, observes: bool) -> Agreed {
        let walls = self.on_particles.len();
        let accounts = ContactEnergies::<f64>::default().accounts().len();
        let observed = usize::from(observes);
        let mut tree = std::mem::take(&mut self.tree);
        tree.begin(accounts + 1 + 4 * walls + OBSERVED * observed, 2 + observed);
        for number in self.contacts.own() {
            let (totals, outcome) = (&self.contacts.chunks()[number].totals, &self.outcomes[number]);
            tree.push(number, |numbers| {
                numbers.extend(totals.energies.accounts().map(|(_, energy)| energy));
                numbers.push(outcome.kicked.power);
                let near = totals.wall_forces.iter().copied();
                let far = std::iter::repeat(WallForce::default());
                for WallForce { force, torque } in near.chain(far).take(walls) {
                    numbers.extend([force.x, force.y, force.z, torque]);
                }
                let ContactTotals { pairs, at_walls, overlap_max, virial } = totals.observed;
                if observes {
                    numbers.extend([pairs, at_walls]);
                    numbers.extend_from_slice(virial.as_flattened());
                }
                // The least of something is the largest of its opposite.
                numbers.extend([totals.rate_squared, -outcome.moved.left]);
                if observes {
                    numbers.push(overlap_max);
                }
            });
        }
        let summed = self.take_in_totals(&mut tree, observes);
        self.tree = tree;
        summed
    }

    fn take_in_totals(&mut self, tree: &mut ChunkTree, observes: bool) -> Agreed {
        let mut ranks = self.ranks.as_mut().filter(|ranks| ranks.shares);
        if let Some(ranks) = &mut ranks {
            ranks.reduce_tree(tree)?;
        }
        let Some(root) = tree.root() else {
            self.pass = PassTotals::default();
            self.on_particles.fill(WallForce::default());
            return Ok(());
        };
        let mut numbers = Numbers::of(root);
        self.pass.energies = ContactEnergies::from_accounts(|_| numbers.next())?;
        self.pass.background_power = numbers.next()?;
        for wall in &mut self.on_particles {
            *wall = WallForce { force: numbers.next_vector()?, torque: numbers.next()? };
        }
        let observed = &mut self.pass.observed;
        if observes {
            (observed.pairs, observed.at_walls) = (numbers.next()?, numbers.next()?);
            observed.virial.as_flattened_mut().copy_from_slice(numbers.take(9)?);
        }
        self.pass.rate_squared = numbers.next()?;
        let left = -numbers.next()?;
        if observes {
            observed.overlap_max = numbers.next()?;
        }
        if let Some(ranks) = ranks {
            ranks.left = Some(left);
        }
        Ok(())
    }

    /// Sums over all rows, where this rank holds them.
    pub(super) fn sum_rows(&self) -> RowSums {
        let mut tree = ChunkTree::default();
        self.add_rows(&mut tree, 0..self.contacts.chunks().len());
        // A tree of this rank has the width that is read.
        tree.root().and_then(|root| RowSums::of(root).ok()).unwrap_or_default()
    }

    /// The same where ranks share the rows; the [ledger](Self::ledger) knows them afterwards.
    pub(super) fn sum_rows_of_all(&mut self) -> Agreed<RowSums> {
        let mut tree = ChunkTree::default();
        self.add_rows(&mut tree, self.contacts.own());
        if let Some(ranks) = self.ranks.as_mut().filter(|ranks| ranks.shares) {
            ranks.reduce_tree(&mut tree)?;
        }
        let sums = tree.root().map_or(Ok(RowSums::default()), RowSums::of)?;
        self.row_sums = Some((self.step, sums));
        Ok(sums)
    }

    fn add_rows(&self, tree: &mut ChunkTree, own: Range<usize>) {
        let chunks = &self.contacts.chunks()[own.clone()];
        let mut parts = vec![[0.0; RowSums::NUMBERS]; own.len()];
        self.pool.for_each(&mut parts, |number, part| *part = self.sums_of(chunks[number].rows.clone()));
        tree.begin(RowSums::SUMS, RowSums::NUMBERS - RowSums::SUMS);
        for (number, part) in own.zip(parts) {
            tree.push(number, |numbers| numbers.extend(part));
        }
    }

    fn sums_of(&self, rows: Range<usize>) -> [f64; RowSums::NUMBERS] {
        let (particles, gravity) = (&self.particles, self.background.gravity);
        let [mut translation, mut rotation, mut discretisation, mut potential, mut electrostatic] =
            [0.0; RowSums::SUMS];
        let mut fastest = 0.0;
        for row in rows {
            let (mass, inertia) = (particles.mass[row], particles.inertia(row));
            let load = &particles.forces_and_torques[row];
            let speed_squared = particles.velocity[row].vector.norm_squared();
            potential -= mass * gravity.dot(particles.position[row].vector);
            // Half of the energy of each pair belongs to each of the two.
            electrostatic += particles.electrostatic.get(row).map_or(0.0, |charge| 0.5 * charge.scalar);
            fastest = max_or_nan(fastest, speed_squared);
            // Like that of walls, what moves these is outside: see `work_walls`.
            if particles.is_prescribed(row) {
                continue;
            }
            translation += 0.5 * mass * speed_squared;
            rotation += 0.5 * inertia * particles.angular_velocity[row].vector.norm_squared();
            discretisation += load.force.vector.norm_squared() / mass;
            discretisation += load.torque.vector.norm_squared() / inertia;
        }
        [translation, rotation, discretisation, potential, electrostatic, fastest]
    }
}
