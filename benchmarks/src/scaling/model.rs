//! The time of a step on many ranks, on paper.

/// What a machine and a system are like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Machine {
    /// Time of a step for each particle of a rank, lists among it [s].
    pub(crate) particle: f64,
    /// From the beginning of a message to its arrival, however short [s].
    pub(crate) latency: f64,
    /// For each byte of a message [s].
    pub(crate) byte: f64,
    /// Steps between two lists [1].
    pub(crate) list_steps: f64,
    /// Work at a list for each row of another rank that is sorted in, where every rank sorts all [s].
    pub(crate) foreign_row: f64,
    /// How much more than the mean the slowest rank works [1].
    pub(crate) imbalance: f64,
}

/// How ranks share the particles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharing {
    /// Whether every rank gets to know and sorts all rows at a new list, as now; otherwise only its own and those around them.
    pub(crate) all_rows: bool,
    /// Whether the body of a rank is a slab, as it is where blocks of cells follow each other line by line; otherwise it is as
    /// compact as a cube, of whose faces `roughness` times as many are read.
    pub(crate) slabs: bool,
    /// Rows that are read, over those of half the faces of a cube [1].
    pub(crate) roughness: f64,
}

/// Rows that are read behind each face that is one mean distance of particles wide and high: measured in the bed of 32 000 with
/// two ranks, 1368 rows behind 28 mm x 28 mm at 1.15 particles per mm³.
pub(crate) const ROWS_PER_FACE: f64 = 1.59;
/// Bytes of a row: forward, and of the sums that go back.
pub(crate) const FORWARD: f64 = 96.0;
pub(crate) const BACK: f64 = 48.0;
/// Bytes of a row at a new list: five vectors.
pub(crate) const ROW: f64 = 120.0;
/// Bytes of what a node of chunks comes to, and particles of a chunk.
const NODE: f64 = 220.0;
const CHUNK: f64 = 1024.0;

/// The parts of a step [s].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Parts {
    pub(crate) work: f64,
    pub(crate) waiting: f64,
    pub(crate) halo: f64,
    pub(crate) totals: f64,
    pub(crate) lists: f64,
}

impl Parts {
    pub(crate) fn sum(&self) -> f64 {
        self.work + self.waiting + self.halo + self.totals + self.lists
    }

    /// The part that costs most beside the work, in words.
    pub(crate) fn worst(&self) -> &'static str {
        let parts = [
            (self.waiting, "imbalance"),
            (self.halo, "halo"),
            (self.totals, "totals"),
            (self.lists, "lists"),
        ];
        parts.into_iter().max_by(|(one, _), (other, _)| one.total_cmp(other)).map_or("", |(_, name)| name)
    }
}

/// Rows that a rank reads of others in every step.
pub(crate) fn halo_rows(sharing: &Sharing, particles: f64, ranks: f64) -> f64 {
    if ranks < 2.0 {
        return 0.0;
    }
    let own = particles / ranks;
    let cube = 3.0 * sharing.roughness * own.powf(2.0 / 3.0);
    let slab = particles.powf(2.0 / 3.0);
    // More rows than there are cannot be read; a few ranks are slabs in any order.
    let faces = if sharing.slabs { slab } else { cube.min(slab) };
    (ROWS_PER_FACE * faces).min(particles - own)
}

/// Bytes that a rank sends in a round of totals.
pub(crate) fn totals_bytes(particles: f64) -> f64 {
    NODE * (2.0 * (particles / CHUNK).log2()).max(1.0)
}

/// The time of a step.
pub(crate) fn step(machine: &Machine, sharing: &Sharing, particles: f64, ranks: f64) -> Parts {
    let own = particles / ranks;
    let work = own * machine.particle;
    if ranks < 2.0 {
        return Parts { work, ..Parts::default() };
    }
    let rows = halo_rows(sharing, particles, ranks);
    // Borders lie between chunks: half a chunk more or less cannot be balanced.
    let grain = if sharing.all_rows { (0.5 * CHUNK / own).min(1.0) } else { 0.0 };
    // Rows go forward, sums back. Where all is balanced to one chunk, the last rank to be ready is waited for once.
    let halo = 2.0 * machine.latency + rows * (FORWARD + BACK) * machine.byte;
    let round = machine.latency + totals_bytes(particles) * machine.byte;
    let foreign = if sharing.all_rows { particles - own } else { rows };
    Parts {
        work,
        waiting: work * machine.imbalance.max(grain),
        halo,
        totals: ranks.log2().ceil() * round,
        lists: foreign * (machine.foreign_row + ROW * machine.byte) / machine.list_steps,
    }
}

/// The time of one rank over that of all ranks together.
pub(crate) fn efficiency(machine: &Machine, sharing: &Sharing, particles: f64, ranks: f64) -> f64 {
    particles * machine.particle / (ranks * step(machine, sharing, particles, ranks).sum())
}

/// The most ranks, in powers of two, that share so many particles with at least this efficiency.
pub(crate) fn reach(machine: &Machine, sharing: &Sharing, particles: f64, least: f64) -> f64 {
    let ranks = (0..=20).map(|power| f64::from(1 << power));
    ranks.take_while(|&ranks| efficiency(machine, sharing, particles, ranks) >= least).last().unwrap_or(1.0)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in super::super) const MACHINE: Machine = Machine {
        particle: 70e-9,
        latency: 2e-6,
        byte: 1e-10,
        list_steps: 40.0,
        foreign_row: 40e-9,
        imbalance: 0.02,
    };

    #[test]
    fn one_rank_works_alone_and_many_are_slower_than_their_share() {
        let sharing = Sharing { all_rows: true, slabs: true, roughness: 1.0 };
        assert_eq!(step(&MACHINE, &sharing, 1e6, 1.0).sum(), 0.07);
        let mut before = 1.0;
        for power in 1..12 {
            let found = efficiency(&MACHINE, &sharing, 1e6, f64::from(1 << power));
            assert!(found < before, "{found} after {before}");
            before = found;
        }
    }

    #[test]
    fn slabs_read_the_same_rows_for_any_number_of_ranks_and_cubes_fewer() {
        let slabs = Sharing { all_rows: false, slabs: true, roughness: 1.0 };
        let cubes = Sharing { slabs: false, ..slabs };
        assert_eq!(halo_rows(&slabs, 1e6, 4.0), halo_rows(&slabs, 1e6, 30.0));
        // At 3³ ranks, three faces of a ninth of the cross-section each.
        assert!((halo_rows(&cubes, 1e6, 27.0) / halo_rows(&slabs, 1e6, 27.0) - 1.0 / 3.0).abs() < 1e-12);
    }
}
