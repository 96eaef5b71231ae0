//! The messages of a step on virtual ranks, one after the other: what the model on paper is held against.

use pulvis_packing::random_stream;
use rand::RngExt;

use super::model::{BACK, FORWARD, Machine, totals_bytes};
use super::orders::Reading;

/// Ranks, and who reads how many rows of whom.
#[derive(Clone, Debug)]
pub(crate) struct Network<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) ranks: usize,
    pub(crate) particles: f64,
    pub(crate) readings: &'a [Reading],
    pub(crate) rows_per_cell: f64,
    /// Mean of a delay, other than by work, that hits each rank in each step [s].
    pub(crate) jitter: f64,
}

impl Network<'_> {
    /// Mean time of a step of all ranks over so many steps [s]. Ranks work unequally, by up to the machine's imbalance, and are
    /// held up at random.
    pub(crate) fn step(&self, steps: u32) -> f64 {
        let mut random = random_stream(1);
        let share = self.particles / self.ranks as f64 * self.machine.particle;
        // One of them is the slowest; the mean is the share.
        let mut work: Vec<f64> = (0..self.ranks)
            .map(|_| share * (1.0 + self.machine.imbalance * (2.0 * random.random::<f64>() - 1.0)))
            .collect();
        work[0] = share * (1.0 + self.machine.imbalance);
        let mut clocks = vec![0.0_f64; self.ranks];
        for _ in 0..steps {
            self.halo(&mut clocks, FORWARD, |reading| (reading.owner, reading.reader));
            for (clock, work) in clocks.iter_mut().zip(&work) {
                let uniform: f64 = random.random();
                let delay = -self.jitter * (1.0 - uniform).ln();
                *clock += work + delay;
            }
            self.halo(&mut clocks, BACK, |reading| (reading.reader, reading.owner));
            self.totals(&mut clocks);
        }
        clocks.into_iter().fold(0.0, f64::max) / f64::from(steps)
    }

    /// Each rank sends its messages one after the other, and goes on when all of its own have come.
    fn halo(&self, clocks: &mut [f64], row: f64, ends: impl Fn(&Reading) -> (usize, usize)) {
        let (mut busy, mut ready) = (clocks.to_vec(), clocks.to_vec());
        for reading in self.readings {
            let (from, to) = ends(reading);
            busy[from] += reading.cells as f64 * self.rows_per_cell * row * self.machine.byte;
            ready[to] = ready[to].max(busy[from] + self.machine.latency);
        }
        for ((clock, busy), ready) in clocks.iter_mut().zip(busy).zip(ready) {
            *clock = busy.max(ready);
        }
    }

    /// Doubling, with those beyond a power of two before and after.
    fn totals(&self, clocks: &mut [f64]) {
        let round = self.machine.latency + totals_bytes(self.particles) * self.machine.byte;
        let rounds = self.ranks.ilog2();
        let pairs = self.ranks - (1 << rounds);
        for pair in 0..pairs {
            clocks[2 * pair] = clocks[2 * pair].max(clocks[2 * pair + 1] + round);
        }
        let real = |place: usize| if place < pairs { 2 * place } else { place + pairs };
        for bit in 0..rounds {
            let before = clocks.to_vec();
            for place in 0..1_usize << rounds {
                let (own, other) = (real(place), real(place ^ 1 << bit));
                clocks[own] = before[own].max(before[other]) + round;
            }
        }
        for pair in 0..pairs {
            clocks[2 * pair + 1] = clocks[2 * pair + 1].max(clocks[2 * pair] + round);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::tests::MACHINE;
    use super::super::model::{Sharing, halo_rows, step};
    use super::super::orders::{Order, ranks_of_cells, readings};
    use super::*;

    #[test]
    fn two_ranks_take_the_time_of_the_model() {
        let sharing = Sharing { all_rows: false, slabs: true, roughness: 1.0 };
        let (edge, particles) = (16, 1e5);
        let readings = readings(&ranks_of_cells(Order::Lines, edge, 2), edge);
        let rows_per_cell = halo_rows(&sharing, particles, 2.0) / (edge * edge) as f64;
        let network = Network {
            machine: &MACHINE,
            ranks: 2,
            particles,
            readings: &readings,
            rows_per_cell,
            jitter: 0.0,
        };
        let model = step(&MACHINE, &sharing, particles, 2.0);
        let expected = model.sum() - model.lists;
        let found = network.step(50);
        // The slower rank may be the one that waits for rows, and need not wait twice: within the halo.
        assert!((found - expected).abs() <= model.halo + 1e-3 * expected, "{found} for {expected}");
    }
}
