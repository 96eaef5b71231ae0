//! `cargo xtask browser`: the page of `pulvis view` in a real browser without a window.

use std::path::PathBuf;
use std::process::Command;

use crate::Outcome;
use crate::process::{pulvis, root, run, scratch, target, works};

/// Names of the browser, in the order of preference.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// Builds the program and tests its page, where Node.js and Chromium are.
pub fn run_all() -> Outcome {
    let skipped = |why: &str| {
        println!("skipped: the page of `pulvis view` is not tested in a browser, {why}");
        Ok(())
    };
    let node = ["-e", "process.exit(Number(process.versions.node.split('.')[0]) < 20 ? 1 : 0)"];
    if !works(Command::new("node").args(node)) {
        return skipped("there is no Node.js 20 or newer here");
    }
    let Some(browser) = browser() else {
        return skipped("there is no Chromium here (the variable CHROMIUM may name one)");
    };
    let Some(tools) = tools() else { return skipped("npm cannot install what the tests need") };
    let program = pulvis()?;
    let scratch = scratch("browser")?;
    run(Command::new("node").arg(tools.join("test.mjs")).arg(program).arg(browser).arg(&scratch))?;
    println!("pictures of the page are in {}", scratch.display());
    Ok(())
}

fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let found = || {
        let files = std::env::split_paths(&paths).flat_map(|folder| BROWSERS.map(|name| folder.join(name)));
        files.into_iter().find(|file| file.is_file())
    };
    named.or_else(found)
}

/// A folder with the tests and what they need, so that nothing is installed among the sources.
fn tools() -> Option<PathBuf> {
    let folder = target().join("xtask-browser");
    std::fs::create_dir_all(&folder).ok()?;
    let sources = root().join("crates/pulvis-view/browser");
    for file in ["package.json", "test.mjs", "growing.toml", "large.toml"] {
        std::fs::copy(sources.join(file), folder.join(file)).ok()?;
    }
    let imports = "await import('playwright-core'); await import('axe-core')";
    let has_tools =
        || works(Command::new("node").args(["--input-type=module", "-e", imports]).current_dir(&folder));
    let install = ["install", "--silent", "--no-audit", "--no-fund", "--ignore-scripts"];
    let ready = has_tools() || (works(Command::new("npm").args(install).current_dir(&folder)) && has_tools());
    ready.then_some(folder)
}
