//! Timed steps, and the report.

use std::sync::Arc;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use pulvis_core::{Phases, Setup, Simulation};
use pulvis_parallel::exchange::Exchange;

use crate::command::Run;
use crate::failure::Failure;
use crate::observed::{Observed, write_table};
use crate::ranks::{self, Counted};

/// What the clock said.
struct Times {
    wall: Duration,
    cpu: Duration,
    phases: Phases,
    rebuilds: u64,
}

/// Sets the system up, does the steps and prints the report. As with the peers' loop time, setting up
/// and the first forces are not counted.
pub(crate) fn run(name: &str, setup: Setup, run: &Run) -> Result<(), Failure> {
    let mut exchanges = ranks::exchanges(run.ranks)?.into_iter();
    let Some(first) = exchanges.next() else { return run_one(name, setup, run, None) };
    std::thread::scope(|scope| {
        let others: Vec<_> = exchanges
            .map(|exchange| scope.spawn(|| run_one(name, setup.clone(), run, Some(exchange))))
            .collect();
        let result = run_one(name, setup.clone(), run, Some(first));
        // A thread that has panicked has said so.
        let others = others.into_iter().filter_map(|thread| thread.join().ok());
        others.fold(result, Result::and)
    })
}

/// The same on one rank, of which the first prints the report.
fn run_one(name: &str, setup: Setup, run: &Run, exchange: Option<Arc<Counted>>) -> Result<(), Failure> {
    let mut simulation = Simulation::new(setup)?;
    if let Some(skin) = run.skin {
        simulation.set_skin(skin)?;
    }
    simulation.set_threads(run.threads)?;
    if let Some(instructions) = run.instructions()? {
        simulation.set_instructions(instructions);
    }
    if !run.has_ledger() {
        simulation.disable_ledger();
    }
    simulation.set_law_pointers(run.pointers);
    if let Some(exchange) = &exchange {
        simulation.set_exchange(Arc::clone(exchange) as Arc<dyn Exchange>);
    }
    simulation.advance_apart(run.warm_up)?;
    if let Some(exchange) = &exchange {
        exchange.reset();
    }
    let times = timed_steps(&mut simulation, run.steps)?;
    if let Some(exchange) = &exchange {
        println!("{}", exchange.report(run.steps, simulation.halo_rows(), times.wall.as_secs_f64()));
    }
    simulation.tell_everything()?;
    if exchange.is_some_and(|exchange| exchange.rank() > 0) {
        return Ok(());
    }
    print(name, &mut simulation, run.steps, &times);
    match &run.write {
        Some(path) => write_table(&simulation, path),
        None => Ok(()),
    }
}

fn timed_steps(simulation: &mut Simulation, steps: u64) -> Result<Times, Failure> {
    let rebuilds = simulation.rebuilds();
    simulation.watch_phases();
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    simulation.advance_apart(steps)?;
    Ok(Times {
        wall: wall.elapsed(),
        cpu: cpu.elapsed(),
        phases: simulation.phases().unwrap_or_default(),
        rebuilds: simulation.rebuilds() - rebuilds,
    })
}

fn print(name: &str, simulation: &mut Simulation, steps: u64, times: &Times) {
    let observed = Observed::of(simulation);
    let count = simulation.particles().len();
    let wall = times.wall.as_secs_f64();
    let contacts = observed.pairs + observed.at_walls;
    println!("workload {name}");
    println!(
        "contacts {contacts} (at walls {}) candidates {} rebuilds {} bytes per particle {:.0}",
        observed.at_walls,
        simulation.candidates(),
        times.rebuilds,
        simulation.memory_size() as f64 / count.max(1) as f64,
    );
    let Phases { pairs, walls, integration, neighbours } = times.phases;
    // Threads work on everything but neighbours at the same time as the one that takes this time.
    let whole = wall * simulation.threads() as f64;
    let neighbours = neighbours * simulation.threads() as f64;
    let share = |seconds: f64| 100.0 * seconds / whole;
    println!(
        "pair {:.1} % walls {:.1} % integration {:.1} % neighbours {:.1} % other {:.1} % of {} x {wall:.4} s",
        share(pairs),
        share(walls),
        share(integration),
        share(neighbours),
        share(whole - pairs - walls - integration - neighbours),
        simulation.threads(),
    );
    println!(
        "kinetic energy {:.9e} J, of rotation {:.9e} J, coordination {:.6}, mean overlap {:.9e} m",
        observed.kinetic, observed.rotational, observed.coordination, observed.mean_overlap
    );
    println!(
        "{:.4} M particle-steps/s, {:.1} steps/s, {:.2} ns per contact-step",
        1e-6 * (count as f64) * steps as f64 / wall,
        steps as f64 / wall,
        1e9 * wall / steps as f64 / contacts.max(1) as f64
    );
    println!("N {count} steps {steps} wall {wall:.6} cpu {:.6}", times.cpu.as_secs_f64());
}
