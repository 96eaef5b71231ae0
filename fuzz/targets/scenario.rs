//! Files of scenarios.
#![no_main]

use libfuzzer_sys::fuzz_target;
use pulvis_input::scenario::Scenario;

fuzz_target!(|data: &[u8]| {
    if let Ok(text) = std::str::from_utf8(data) {
        pulvis_fuzz::judge(Scenario::from_str("case.toml", text));
    }
});
