//! Random cases that can be repeated.

use crate::draw::Draw;

/// Runs `check` for `count` random cases, the same ones on every machine. A failing case prints
/// `label` and its seed.
pub fn for_each_case(label: &str, count: u64, mut check: impl FnMut(&mut Draw)) {
    let (factor, start) = (setting("PULVIS_TESTKIT_CASES", 1), setting("PULVIS_TESTKIT_SEED", 0));
    for seed in start..start + count * factor {
        let _report = Report { label, seed };
        check(&mut Draw::new(seed));
    }
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

struct Report<'a> {
    label: &'a str,
    seed: u64,
}

impl Drop for Report<'_> {
    #[allow(clippy::print_stderr)] // the test runner shows it with the failure
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("{}: failed in the case of PULVIS_TESTKIT_SEED={}", self.label, self.seed);
        }
    }
}
