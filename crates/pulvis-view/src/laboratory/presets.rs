//! Figures of the papers, as the files that `pulvis reproduce` computes them from.

use serde_json::{Value, json};

/// A figure with the file that it is computed from.
struct Preset {
    title: &'static str,
    text: &'static str,
}

macro_rules! presets {
    ($(($title:literal, $file:literal)),* $(,)?) => {
        &[$(Preset {
            title: $title,
            text: include_str!(concat!("../../../../experiments/", $file)),
        }),*]
    };
}

const PRESETS: &[Preset] = presets![
    ("S1 Fig. 2: branches of the hysteretic contact", "figures/s1-02/branches.toml"),
    ("S1 Fig. 3: reversible attraction", "figures/s1-03/reversible.toml"),
    ("S1 Fig. 3: attraction that jumps in", "figures/s1-03/jump-in.toml"),
    ("S1 Fig. 4: attraction with plastic contact", "figures/s1-04/plastic.toml"),
    ("S1 Fig. 5: restitution with attraction", "figures/s1-05/attraction.toml"),
    ("S1 Fig. 6: restitution over velocity", "figures/s1-06/restitution.toml"),
    ("S1 Fig. 7: loops at four velocities", "figures/s1-07/loops.toml"),
    ("S1 Fig. 11: weak plasticity with dashpot", "figures/s1-11/weak.toml"),
    ("S1 Fig. 15: energies of a collision", "figures/s1-15/energies.toml"),
    ("S0 Fig. 5: elastic and plastic spheres that attract", "figures/s0-05/attraction.toml"),
    ("Chung and Ooi, test 4: aluminium alloy, angle of incidence", "chung-ooi/test-4-aluminium-alloy.toml"),
    ("Chung and Ooi, test 2: aluminium alloy on a plane", "chung-ooi/test-2-aluminium-alloy.toml"),
];

/// All of them.
pub(super) fn list() -> Value {
    PRESETS.iter().map(|preset| json!({ "title": preset.title, "text": preset.text })).collect()
}
