//! Meshes: the first letter says in which format.
#![no_main]

use libfuzzer_sys::fuzz_target;
use pulvis_input::scenario::Scenario;

fuzz_target!(|data: &[u8]| {
    let Some((first, content)) = data.split_first() else { return };
    let file = pulvis_fuzz::file(if first % 2 == 0 { "stl" } else { "obj" }, content);
    let scenario = include_str!("mesh.toml").replace("MESH", &file.to_string_lossy());
    pulvis_fuzz::judge(Scenario::from_str("case.toml", &scenario));
});
