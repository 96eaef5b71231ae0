//! Damaged inputs of every format: no panic, no hang, bounded memory, and a message that says where.
//!
//! `PULVIS_FUZZ_CASES=100000` tries as many, `PULVIS_FUZZ_SEED` others, and `PULVIS_FUZZ_FIRST` begins with a case that has
//! failed before.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stderr)]

mod formats;
mod mutate;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};

use formats::{Corpus, Ending, Format};
use mutate::Dice;

/// Wall-clock time that nothing may take, however busy the machine is.
const LONGEST: Duration = Duration::from_secs(60);

/// Memory that all cases may take together [byte].
const MOST_MEMORY: u64 = 1 << 30;

/// Failures after which no more are looked for, and letters of an input that are shown.
const MOST_FAILURES: usize = 10;
const LONGEST_SHOWN: usize = 4000;

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{name}: {text}")))
}

/// The last panic, with its place.
static LAST: Mutex<String> = Mutex::new(String::new());

/// What a worker tells.
enum Word {
    Begun(u64, Format),
    Failed(String),
    Ended { accepted: u64, refused: u64 },
}

#[test]
fn damaged_inputs_are_refused_with_a_message_and_never_panic_hang_or_fill_the_memory() {
    let [cases, seed, first] = [("CASES", 2000), ("SEED", 1), ("FIRST", 0)]
        .map(|(name, default)| number(&format!("PULVIS_FUZZ_{name}"), default));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_owned();
    let (sender, receiver) = mpsc::channel();
    // The stack of a main thread, as the program has it.
    let worker = std::thread::Builder::new().stack_size(8 << 20);
    let began = Instant::now();
    worker.spawn(move || work(&Corpus::new(&path), first..first + cases, seed, &sender)).unwrap();
    let mut now = None;
    loop {
        match receiver.recv_timeout(LONGEST) {
            Ok(Word::Begun(case, format)) => now = Some((case, format)),
            Ok(Word::Failed(text)) => fail(&text),
            Ok(Word::Ended { accepted, refused }) => {
                let taken = began.elapsed().as_secs_f64();
                eprintln!(
                    "{cases} cases of seed {seed}: {accepted} accepted, {refused} refused, in {taken:.1} s"
                );
                // Changes that break everything, or nothing, test little; a few cases alone may be of one kind.
                assert!(
                    cases < 1000 || 40 * accepted > cases && 4 * refused > cases,
                    "{accepted} accepted, {refused} refused"
                );
                break;
            }
            Err(_) => fail(&format!(
                "case {now:?} of seed {seed} takes longer than {LONGEST:?}, or ended the thread"
            )),
        }
    }
    if let Some(peak) = peak_memory() {
        eprintln!("at most {:.0} MB of memory", peak as f64 / 1e6);
        assert!(peak < MOST_MEMORY, "{peak} bytes");
    }
}

/// Panics aloud: the worker has hushed its own panics.
fn fail(text: &str) -> ! {
    let _ = std::panic::take_hook();
    panic!("{text}");
}

fn work(corpus: &Corpus, cases: std::ops::Range<u64>, seed: u64, told: &mpsc::Sender<Word>) {
    let (mut accepted, mut refused, mut failures) = (0, 0, Vec::new());
    // Panics are told with the input that caused them.
    std::panic::set_hook(Box::new(|panic| {
        *LAST.lock().unwrap_or_else(PoisonError::into_inner) = panic.to_string();
    }));
    for case in cases {
        let format = Format::of_case(case);
        let _ = told.send(Word::Begun(case, format));
        let mut given = String::new();
        let mut dice = Dice::of_case(seed, case);
        let ending = catch_unwind(AssertUnwindSafe(|| corpus.try_case(format, &mut dice, &mut given)));
        match ending {
            Ok(Ending::Accepted) => accepted += 1,
            Ok(Ending::Refused) => refused += 1,
            Err(_) => {
                let text = LAST.lock().unwrap_or_else(PoisonError::into_inner).clone();
                let again = format!("PULVIS_FUZZ_SEED={seed} PULVIS_FUZZ_FIRST={case} PULVIS_FUZZ_CASES=1");
                let given: String = given.chars().take(LONGEST_SHOWN).collect();
                failures.push(format!("{format:?}, {again}: {text}\n--- given:\n{given}"));
                if failures.len() == MOST_FAILURES {
                    break;
                }
            }
        }
    }
    let _ = told.send(match failures.is_empty() {
        true => Word::Ended { accepted, refused },
        false => Word::Failed(failures.join("\n\n")),
    });
}

/// The largest memory of this process so far [byte]; `None` where the system does not say.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}
