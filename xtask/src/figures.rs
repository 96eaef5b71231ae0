//! `cargo xtask figures`: the pictures of README and docs, by the commands that stand beside them.

use std::path::Path;
use std::process::Command;

use crate::Outcome;
use crate::process::{cargo, root, run, scratch};

/// Makes all pictures anew, with the release build: whoever asks for pictures wants to see the
/// program that users have.
pub fn run_all() -> Outcome {
    run(&mut cargo(&["build", "--release", "-p", "pulvis-cli"]))?;
    let figures = root().join("docs/figures");
    std::fs::create_dir_all(&figures).map_err(|error| format!("{}: {error}", figures.display()))?;

    let restitution = figures.join("restitution.png");
    let scenario = root().join("experiments/restitution/experiment.toml");
    run(pulvis().arg("collide").arg(scenario).arg("--plot").arg(&restitution).arg("--force"))?;
    copy(&restitution, &root().join("experiments/restitution/restitution.png"))?;

    let folder = scratch("figures_reproduced")?;
    let names = ["map-beta", "s1-05", "s1-06", "s1-09", "s1-11", "s1-15"];
    run(pulvis().arg("reproduce").args(names).arg("--dpi").arg("100").arg("--output").arg(&folder))?;
    for name in names {
        copy(
            &folder.join(name).with_extension("png"),
            &root().join(format!("docs/book/src/figures/{name}.png")),
        )?;
    }

    for (name, measure) in [("study-restitution", "e2"), ("study-friction", "phi")] {
        let folder = scratch(name)?;
        let study = root().join(format!("experiments/{name}/study.toml"));
        run(pulvis().arg("study").arg(study).arg("--dpi").arg("100").arg("--output").arg(&folder))?;
        copy(
            &folder.join(measure).with_extension("png"),
            &root().join(format!("docs/book/src/figures/{name}.png")),
        )?;
    }

    let folder = scratch("tablet_short")?;
    let scenario = root().join("experiments/tablet/short.toml");
    run(pulvis().arg("run").arg(scenario).arg("--output").arg(&folder).arg("--force"))?;
    copy(&folder.join("force_displacement.png"), &figures.join("tablet_short_force.png"))?;
    let contacts = root().join("docs/book/src/figures/tablet-contacts.png");
    let frame = ["--frame", "1", "--contacts", "--size", "520x400", "--force", "--output"];
    run(pulvis().arg("render").arg(&folder).args(frame).arg(contacts))?;
    println!("look at the pictures before you commit them: git diff --stat docs experiments");
    Ok(())
}

fn pulvis() -> Command {
    cargo(&["run", "--quiet", "--release", "-p", "pulvis-cli", "--"])
}

fn copy(from: &Path, to: &Path) -> Outcome {
    std::fs::copy(from, to).map(|_| ()).map_err(|error| format!("{}: {error}", from.display()))
}
