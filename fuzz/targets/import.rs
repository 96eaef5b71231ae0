//! Particles in the formats of other programs: the first letter says in which.
#![no_main]

use libfuzzer_sys::fuzz_target;
use pulvis_input::scenario::Scenario;

const ENDINGS: [&str; 5] = ["csv", "dump", "data", "xyz", "vtp"];

fuzz_target!(|data: &[u8]| {
    let Some((first, content)) = data.split_first() else { return };
    let file = pulvis_fuzz::file(ENDINGS[usize::from(first % 5)], content);
    let scenario = include_str!("import.toml").replace("GRAINS", &file.to_string_lossy());
    pulvis_fuzz::judge(Scenario::from_str("case.toml", &scenario));
});
