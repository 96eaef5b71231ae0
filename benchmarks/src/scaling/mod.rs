//! How far ranks reach: surfaces of orders, a model of the time of a step, and the messages of many virtual ranks.
#![allow(clippy::disallowed_methods)] // no bit of a simulation is made here

mod model;
mod network;
mod orders;

use clap::Args;

use self::model::{Machine, ROWS_PER_FACE, Sharing, efficiency, halo_rows, reach, step};
use self::network::Network;
use self::orders::{Order, Reading, ranks_of_cells, readings};

/// What a machine is like; where from, the book says on its page "On a cluster".
#[derive(Args, Clone, Debug)]
pub(crate) struct Options {
    /// Time of a step for each particle of a rank, lists among it [ns].
    #[arg(long, default_value_t = 70.0)]
    particle: f64,
    /// From the beginning of a message to its arrival [µs].
    #[arg(long, default_value_t = 2.0)]
    latency: f64,
    /// Bytes that a rank sends in a second [GB/s].
    #[arg(long, default_value_t = 10.0)]
    bandwidth: f64,
    /// Steps between two lists [1].
    #[arg(long, default_value_t = 200.0)]
    list_steps: f64,
    /// Work at a list for each row of another rank that is sorted in [ns].
    #[arg(long, default_value_t = 100.0)]
    foreign_row: f64,
    /// How much more than the mean the slowest rank works [1].
    #[arg(long, default_value_t = 0.02)]
    imbalance: f64,
    /// Mean of a delay, other than by work, that hits each virtual rank in each step [µs].
    #[arg(long, default_value_t = 0.0)]
    jitter: f64,
}

/// Cells along each edge of the cube that orders share out, and ranks that do.
const EDGE: usize = 128;
const SHARES: [usize; 4] = [8, 60, 512, 1000];

/// Efficiency below which more ranks are no good.
const LEAST: f64 = 0.8;

pub(crate) fn run(options: &Options) {
    let machine = Machine {
        particle: 1e-9 * options.particle,
        latency: 1e-6 * options.latency,
        byte: 1e-9 / options.bandwidth,
        list_steps: options.list_steps,
        foreign_row: 1e-9 * options.foreign_row,
        imbalance: options.imbalance,
    };
    println!(
        "Cells read of higher ranks, over half the surface of a cube as large; neighbours read of (mean, most)"
    );
    println!("{:>10} {}", "ranks", SHARES.map(|ranks| format!("{ranks:>22}")).concat());
    let mut roughness = 1.0;
    for order in [Order::Lines, Order::Morton, Order::Hilbert, Order::Bisection] {
        let surfaces = SHARES.map(|ranks| Surface::of(order, ranks));
        if order == Order::Hilbert {
            roughness = surfaces[2].mean;
        }
        println!("{:>10} {}", format!("{order:?}").to_lowercase(), surfaces.map(|one| one.text()).concat());
    }
    let as_built = Sharing { all_rows: true, slabs: true, roughness: 1.0 };
    let own_rows = Sharing { all_rows: false, slabs: false, roughness };
    for (name, sharing) in [
        ("as built: slabs, all rows at a list", as_built),
        ("own rows only, along the curve of Hilbert", own_rows),
    ] {
        print_model(name, &machine, &sharing);
    }
    print_network(&machine, &own_rows, 1e-6 * options.jitter);
}

/// What an order makes each rank read.
#[derive(Clone, Copy, Debug)]
struct Surface {
    mean: f64,
    neighbours: f64,
    most: usize,
}

impl Surface {
    fn of(order: Order, ranks: usize) -> Self {
        let readings = readings(&ranks_of_cells(order, EDGE, ranks), EDGE);
        let cells: usize = readings.iter().map(|one| one.cells).sum();
        let cube = 3.0 * ((EDGE * EDGE * EDGE) as f64 / ranks as f64).powf(2.0 / 3.0);
        let mut of_rank = vec![0_usize; ranks];
        readings.iter().for_each(|one| of_rank[one.reader] += 1);
        Self {
            mean: cells as f64 / ranks as f64 / cube,
            neighbours: readings.len() as f64 / ranks as f64,
            most: of_rank.into_iter().max().unwrap_or(0),
        }
    }

    fn text(&self) -> String {
        format!("{:>10.2} ({:>4.1}, {:>2})", self.mean, self.neighbours, self.most)
    }
}

fn print_model(name: &str, machine: &Machine, sharing: &Sharing) {
    const RANKS: [f64; 6] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5];
    println!("\nTime of a step [s], efficiency, and what costs most beside the work; {name}");
    println!(
        "{:>10} {}{:>26}",
        "particles",
        RANKS.map(|ranks| format!("{ranks:>27}")).concat(),
        "80 % up to ranks"
    );
    for particles in [1e6, 1e7, 1e8, 1e9, 1e10] {
        let column = |ranks: f64| {
            let parts = step(machine, sharing, particles, ranks);
            let efficiency = 100.0 * efficiency(machine, sharing, particles, ranks);
            let worst = if ranks > 1.0 { parts.worst() } else { "" };
            format!("{:>10.2e} {efficiency:>4.0} % {worst:>9}", parts.sum())
        };
        let columns = RANKS.map(|ranks| format!("{:>27}", column(ranks))).concat();
        println!("{particles:>10.0e} {columns}{:>26}", reach(machine, sharing, particles, LEAST));
    }
}

fn print_network(machine: &Machine, sharing: &Sharing, jitter: f64) {
    println!(
        "\nTime of a step without lists [ms]: messages of virtual ranks along the curve of Hilbert, and the model"
    );
    for ranks in [512, 1024, 1500, 4096] {
        let readings: Vec<Reading> = readings(&ranks_of_cells(Order::Hilbert, EDGE, ranks), EDGE);
        for particles in [1e7, 1e8, 1e9] {
            // A cell of this cube stands for so many particles; those behind one of its faces are read.
            let per_face = (particles / (EDGE * EDGE * EDGE) as f64).powf(2.0 / 3.0);
            let rows_per_cell = ROWS_PER_FACE * per_face;
            let network = Network { machine, ranks, particles, readings: &readings, rows_per_cell, jitter };
            let parts = step(machine, sharing, particles, ranks as f64);
            let (found, expected) = (network.step(20), parts.sum() - parts.lists);
            let rows = halo_rows(sharing, particles, ranks as f64);
            println!(
                "{ranks:>6} ranks, {particles:.0e} particles, {rows:>7.0} rows read: {:>9.4} and {:>9.4}, {:+.1} %",
                1e3 * found,
                1e3 * expected,
                100.0 * (found / expected - 1.0),
            );
        }
    }
}
