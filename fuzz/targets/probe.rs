//! Files of probes.
#![no_main]

use libfuzzer_sys::fuzz_target;
use pulvis_input::Document;
use pulvis_input::probe::ProbeScenario;

fuzz_target!(|data: &[u8]| {
    if let Ok(text) = std::str::from_utf8(data) {
        pulvis_fuzz::judge(
            Document::from_str("case.toml", text)
                .and_then(|document| ProbeScenario::from_document(&document)),
        );
    }
});
