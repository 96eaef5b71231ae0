//! Micro-benchmarks: the time of one contact, law by law.

mod builds;
mod cases;
mod contacts;
mod stored;

use std::time::Instant;

use pulvis_contact::ContactModel;
use pulvis_math::{F64Array, Real};

use crate::failure::Failure;
use builds::{Build, Sweep};
use cases::cases;
use contacts::{Contacts, Store};

/// Passes of which the fastest counts: others may use the machine meanwhile.
const PASSES: usize = 9;
/// Sweeps of a pass, so that it takes some milliseconds.
const SWEEPS: usize = 2000;

/// Prints a table of all models whose name holds `only`.
pub(crate) fn run(only: &str) -> Result<(), Failure> {
    on_a_deep_stack(|| print_table(only))?
}

/// What `work` gives. Where code is not optimised, as in tests, every temporary of eight lanes through all laws has its own
/// place on the stack: more than a thread has if nothing is said.
fn on_a_deep_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    const STACK: usize = 256 << 20;
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        thread.map_err(Failure::Thread)?.join().map_err(|panic| std::panic::resume_unwind(panic))
    })
}

fn print_table(only: &str) -> Result<(), Failure> {
    let builds = Build::available();
    println!(
        "ns per contact{}; memory of 64 contacts in cache, no gathers and scatters",
        if ticks().is_some() { " (ticks of the time stamp counter)" } else { "" }
    );
    print!("{:44}{:>8}", "model", "ledger");
    for build in &builds {
        print!("{:>20}", build.to_string());
    }
    println!();
    for case in cases()?.into_iter().filter(|case| case.name.contains(only)) {
        for ledger in [true, false] {
            print!("{:44}{:>8}", case.name, if ledger { "on" } else { "off" });
            for &build in &builds {
                let cost = Measured { model: case.model, build, ledger }.cost();
                let ticks = cost.ticks.map_or(String::new(), |ticks| format!(" ({ticks:6.1})"));
                print!("{:>20}", format!("{:.2}{ticks}", cost.nanoseconds));
            }
            println!();
        }
    }
    Ok(())
}

/// What a contact costs.
#[derive(Clone, Copy, Debug)]
struct Cost {
    /// Time [ns].
    nanoseconds: f64,
    /// Ticks of the time stamp counter, which has a fixed frequency whatever that of the core.
    ticks: Option<f64>,
}

struct Measured {
    model: ContactModel,
    build: Build,
    ledger: bool,
}

impl Measured {
    fn cost(&self) -> Cost {
        match self.build {
            Build::Scalar => self.run_by::<f64>(|sweep| sweep.one_at_a_time()),
            Build::Eight(set) => self.run_by::<F64Array<8>>(|sweep| set.run(sweep)),
        }
    }

    /// The cost of a contact, all contacts being kept in columns of `S` and sweeps done by `run`.
    fn run_by<S: Real>(&self, run: impl Fn(Sweep<'_, S>)) -> Cost {
        let (model, ledger) = (self.model, self.ledger);
        let contacts = Contacts::<S>::new();
        let mut store = Store::new(&contacts, &model);
        let mut pass = || {
            run(Sweep { model, contacts: &contacts, store: &mut store, sweeps: SWEEPS, ledger });
        };
        pass();
        let fastest = (0..PASSES).map(|_| timed(&mut pass)).min_by(|a, b| a.0.total_cmp(&b.0));
        std::hint::black_box((&store.memory, &store.forces_and_torques, &store.energies));
        let (seconds, ticks) = fastest.unwrap_or_default();
        let count = (SWEEPS * contacts.count()) as f64;
        Cost { nanoseconds: 1e9 * seconds / count, ticks: ticks.map(|ticks| ticks / count) }
    }
}

/// Time [s] and ticks that `action` takes.
fn timed(action: impl FnOnce()) -> (f64, Option<f64>) {
    let (begin, first) = (Instant::now(), ticks());
    action();
    let last = ticks();
    let elapsed = first.zip(last).map(|(first, last)| last.wrapping_sub(first) as f64);
    (begin.elapsed().as_secs_f64(), elapsed)
}

/// The time stamp counter, where the processor has one.
fn ticks() -> Option<u64> {
    #[cfg(target_arch = "x86_64")]
    {
        // SAFETY: reads a counter that every x86-64 processor has; it touches no memory.
        Some(unsafe { std::arch::x86_64::_rdtsc() })
    }
    #[cfg(not(target_arch = "x86_64"))]
    None
}
