//! Other programs: cargo, the `pulvis` command, Python.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::Outcome;

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_path_buf)
}

/// Where cargo builds: this program stands in a profile's folder below it.
pub fn target() -> PathBuf {
    let own = std::env::current_exe().ok();
    own.and_then(|path| path.ancestors().nth(2).map(Path::to_path_buf))
        .unwrap_or_else(|| root().join("target"))
}

/// An empty folder of its own for a task.
pub fn scratch(name: &str) -> Outcome<PathBuf> {
    let folder = target().join("xtask").join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}

/// Cargo, in the root of the workspace, without a terminal to ask.
pub fn cargo(arguments: &[&str]) -> Command {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(arguments).current_dir(root()).stdin(Stdio::null());
    command
}

/// The `pulvis` command, built first if it is not up to date, together with the tests: their dependencies switch on
/// features of shared crates, and without them the engine would be compiled once more.
pub fn pulvis() -> Outcome<PathBuf> {
    run(&mut cargo(&["build", "--workspace", "--bin", "pulvis", "--tests"]))?;
    let name = format!("pulvis{}", std::env::consts::EXE_SUFFIX);
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let path = own.with_file_name(name);
    if path.exists() { Ok(path) } else { Err(format!("cargo did not build {}", path.display())) }
}

/// Runs a program; what it prints is shown.
pub fn run(command: &mut Command) -> Outcome {
    println!("$ {}", shown(command));
    let status = command.status().map_err(|error| format!("{}: {error}", shown(command)))?;
    if status.success() { Ok(()) } else { Err(format!("`{}` failed: {status}", shown(command))) }
}

/// Runs a program and keeps what it prints.
pub fn capture(command: &mut Command) -> Outcome<Output> {
    command.output().map_err(|error| format!("{}: {error}", shown(command)))
}

/// Runs a program that must succeed and answers with its standard output.
pub fn text(command: &mut Command) -> Outcome<String> {
    let output = capture(command)?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{}` failed: {}\n{errors}", shown(command), output.status));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether the program can be started and says yes.
pub fn works(command: &mut Command) -> bool {
    let quiet = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// The command as one would type it, from the root of the workspace.
fn shown(command: &Command) -> String {
    let root = format!("{}/", root().display());
    let program = Path::new(command.get_program());
    let name = program.file_name().unwrap_or(program.as_os_str()).to_string_lossy().into_owned();
    let words = command.get_args().map(|word| word.to_string_lossy().replace(&root, ""));
    std::iter::once(name).chain(words).collect::<Vec<_>>().join(" ")
}
