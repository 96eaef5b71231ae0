//! Files of collisions.
#![no_main]

use libfuzzer_sys::fuzz_target;
use pulvis_input::Document;
use pulvis_input::collision::CollisionScenario;

fuzz_target!(|data: &[u8]| {
    if let Ok(text) = std::str::from_utf8(data) {
        pulvis_fuzz::judge(
            Document::from_str("case.toml", text)
                .and_then(|document| CollisionScenario::from_document(&document)),
        );
    }
});
