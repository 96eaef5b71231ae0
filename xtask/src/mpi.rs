//! `cargo xtask mpi`: runs on ranks that are processes, started by the launchers of Open MPI and of MPICH.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::Outcome;
use crate::process::{cargo, root, run, scratch, target, works};

/// An MPI library by what compiles with it and what starts its programs.
struct Library {
    name: &'static str,
    compiler: &'static str,
    launcher: &'static str,
    /// More processes than processors are fine here.
    arguments: &'static [&'static str],
}

const LIBRARIES: [Library; 2] = [
    Library {
        name: "Open MPI",
        compiler: "mpicc.openmpi",
        launcher: "mpirun.openmpi",
        arguments: &["--oversubscribe"],
    },
    Library { name: "MPICH", compiler: "mpicc.mpich", launcher: "mpirun.mpich", arguments: &[] },
];

/// What the libraries are called where `apt` is, and what the bindings are made with.
const PACKAGES: [&str; 5] = ["libopenmpi-dev", "openmpi-bin", "libmpich-dev", "mpich", "libclang-dev"];

/// A run may take so long, and the end of one that has lost a process.
const LONGEST: Duration = Duration::from_secs(300);
const LONGEST_END: Duration = Duration::from_secs(60);

/// Builds the program with each library that is there, and runs it on one to four processes; kills one of them so many times.
pub fn run_all(kills: &str) -> Outcome {
    let kills = kills.parse().map_err(|_| format!("`{kills}` is no number of kills"))?;
    let is_there = |library: &&Library| {
        let [compiler, launcher] = [library.compiler, library.launcher];
        works(Command::new(compiler).arg("--version")) && works(Command::new(launcher).arg("--version"))
    };
    if LIBRARIES.iter().filter(is_there).count() < LIBRARIES.len()
        && works(Command::new("apt-get").arg("--version"))
    {
        println!("installing MPI (once)");
        let install = ["install", "--yes", "--quiet", "--no-install-recommends"];
        works(Command::new("apt-get").args(["update", "--quiet"]));
        works(Command::new("apt-get").args(install).args(PACKAGES).env("DEBIAN_FRONTEND", "noninteractive"));
    }
    for library in &LIBRARIES {
        if is_there(&library) {
            library.check(kills).map_err(|error| format!("{}: {error}", library.name))?;
        } else {
            println!(
                "skipped: there is no {} here ({}, {})",
                library.name, library.compiler, library.launcher
            );
        }
    }
    Ok(())
}

type Files = BTreeMap<PathBuf, Vec<u8>>;

impl Library {
    fn check(&self, kills: u32) -> Outcome {
        let program = self.build()?;
        let folder = scratch(&format!("mpi-{}", self.compiler))?;
        let alone = folder.join("alone");
        run(Command::new(&program).arg("run").arg(scenario()).arg("--quiet").arg("--output").arg(&alone))?;
        let expected = files(&alone)?;
        for ranks in 2..=4 {
            let shared = folder.join(format!("ranks-{ranks}"));
            let mut child =
                self.start(&program, ranks, &["run"], &[scenario(), "--output".into(), shared.clone()])?;
            let code = wait(&mut child, LONGEST)?;
            same(code, 0, &format!("{ranks} processes"))?;
            compare(&files(&shared)?, &expected, &format!("{ranks} processes"))?;
        }
        self.stop_and_go_on(&program, &folder.join("stopped"), &expected)?;
        self.kill_and_go_on(&program, &folder.join("killed"), &expected)?;
        self.kill_at_random(&program, &folder.join("random"), &expected, kills)?;
        self.refuse(&program, &folder)?;
        println!(
            "{}: the same files on 1 to 4 processes, after SIGTERM and after {} kills",
            self.name,
            kills + 1
        );
        Ok(())
    }

    /// The program with this library; the rest of it is that of the tests.
    fn build(&self) -> Outcome<PathBuf> {
        let arguments =
            ["build", "--workspace", "--bin", "pulvis", "--tests", "--features", "pulvis-cli/mpi"];
        // The bindings are those of the compiler that was named last, which cargo does not look at.
        run(&mut cargo(&["clean", "--quiet", "--package", "mpi-sys", "--package", "mpi"]))?;
        run(cargo(&arguments).env("MPICC", self.compiler))?;
        let own = std::env::current_exe().map_err(|error| error.to_string())?;
        let copy = target().join("xtask").join(format!("pulvis-{}", self.compiler));
        let failed = |error: std::io::Error| format!("{}: {error}", copy.display());
        std::fs::create_dir_all(target().join("xtask")).map_err(failed)?;
        std::fs::copy(own.with_file_name("pulvis"), &copy).map_err(failed)?;
        Ok(copy)
    }

    fn start(&self, program: &Path, ranks: usize, words: &[&str], paths: &[PathBuf]) -> Outcome<Child> {
        let mut command = Command::new(self.launcher);
        command.args(["-n", &ranks.to_string()]).args(self.arguments).arg(program);
        command.args(words).args(paths).arg("--quiet").stdin(Stdio::null()).stdout(Stdio::null());
        // In containers everybody is root.
        command.env("OMPI_ALLOW_RUN_AS_ROOT", "1").env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
        println!("$ {command:?}");
        command.spawn().map_err(|error| format!("{}: {error}", self.launcher))
    }

    /// One process is told to end, as by a queue whose time is over; the run goes on with others.
    fn stop_and_go_on(&self, program: &Path, place: &Path, expected: &Files) -> Outcome {
        let mut child = self.start(program, 3, &["run"], &[scenario(), "--output".into(), place.into()])?;
        signal_first_rank(place, "TERM", &mut child)?;
        let code = wait(&mut child, LONGEST_END)?;
        if code == 0 {
            return Err("a run that was told to end came to its end".to_owned());
        }
        let mut child = self.start(program, 2, &["run", "--resume"], &[place.into()])?;
        same(wait(&mut child, LONGEST)?, 0, "the run that went on")?;
        compare(&files(place)?, expected, "stopped by SIGTERM on 3 processes, gone on with 2")
    }

    /// One process is killed: all end within a minute, and the run goes on from its last checkpoint.
    fn kill_and_go_on(&self, program: &Path, place: &Path, expected: &Files) -> Outcome {
        let mut child = self.start(program, 2, &["run"], &[scenario(), "--output".into(), place.into()])?;
        signal_first_rank(place, "KILL", &mut child)?;
        let code = wait(&mut child, LONGEST_END)?;
        if code == 0 {
            return Err("a run that has lost a process says that all is well".to_owned());
        }
        let mut child = self.start(program, 4, &["run", "--resume"], &[place.into()])?;
        same(wait(&mut child, LONGEST)?, 0, "the run that went on")?;
        compare(&files(place)?, expected, "killed on 2 processes, gone on with 4")
    }

    /// Any process is killed at any moment of runs on two to four: with what others go on with, all end as if nothing had been.
    fn kill_at_random(&self, program: &Path, place: &Path, expected: &Files, kills: u32) -> Outcome {
        if !Path::new("/proc/self/exe").exists() {
            println!("skipped: kills at random, this system does not tell its processes in /proc");
            return Ok(());
        }
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        let (mut run_number, mut killed) = (0, 0);
        while killed < kills {
            let folder = place.join(run_number.to_string());
            let is_begun = folder.join("run.toml").exists();
            let ranks = 2 + random.below(3) as usize;
            let mut child = if is_begun {
                self.start(program, ranks, &["run", "--resume"], std::slice::from_ref(&folder))?
            } else {
                std::fs::create_dir_all(place).map_err(|error| error.to_string())?;
                let paths = [scenario(), "--force".into(), "--output".into(), folder.clone()];
                self.start(program, ranks, &["run"], &paths)?
            };
            std::thread::sleep(Duration::from_millis(random.below(3000)));
            let processes = processes_of(program);
            if !processes.is_empty() {
                let process = &processes[random.below(processes.len() as u64) as usize];
                if works(Command::new("kill").args(["-KILL", process])) {
                    killed += 1;
                }
            }
            let code = wait(&mut child, LONGEST_END)?;
            // It may have been at its end already.
            let found = if folder.exists() { files(&folder)? } else { Files::new() };
            if found == *expected {
                run_number += 1;
            } else if code == 0 {
                compare(&found, expected, &format!("after {killed} kills"))?;
            }
        }
        let folder = place.join(run_number.to_string());
        if folder.join("run.toml").exists() {
            let mut child = self.start(program, 3, &["run", "--resume"], std::slice::from_ref(&folder))?;
            same(wait(&mut child, LONGEST)?, 0, "the last run that went on")?;
            compare(&files(&folder)?, expected, &format!("after {killed} kills"))?;
        }
        Ok(())
    }

    /// A wrong file is refused once, with exit code 2.
    fn refuse(&self, program: &Path, folder: &Path) -> Outcome {
        let wrong = folder.join("wrong.toml");
        std::fs::write(&wrong, "title = 1\n").map_err(|error| error.to_string())?;
        let mut child = self.start(program, 3, &["run"], &[wrong])?;
        same(wait(&mut child, LONGEST_END)?, 2, "a wrong file")
    }
}

/// Numbers at random, the same each time (Marsaglia 2003, Journal of Statistical Software 8, 14).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

/// The processes that run this program, where the system tells.
fn processes_of(program: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir("/proc") else { return Vec::new() };
    let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    let runs = |name: &String| {
        let target = std::fs::read_link(Path::new("/proc").join(name).join("exe"));
        name.bytes().all(|byte| byte.is_ascii_digit()) && target.is_ok_and(|target| target == program)
    };
    names.filter(runs).collect()
}

fn scenario() -> PathBuf {
    root().join("crates/pulvis-mpi/tests/press.toml")
}

/// Sends a signal to the first rank when its run is under way.
fn signal_first_rank(place: &Path, signal: &str, child: &mut Child) -> Outcome {
    let began = Instant::now();
    // A checkpoint is there as soon as some hundred steps are done.
    while !place.join("checkpoint.pulvis").exists() {
        if child.try_wait().ok().flatten().is_some() || began.elapsed() > LONGEST {
            return Err("the run has ended before it could be disturbed".to_owned());
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    let process = std::fs::read_to_string(place.join(".pulvis-lock")).map_err(|error| error.to_string())?;
    if works(Command::new("kill").arg(format!("-{signal}")).arg(process.trim())) {
        Ok(())
    } else {
        Err(format!("cannot send {signal} to process {process}"))
    }
}

/// The exit code of the launcher.
fn wait(child: &mut Child, longest: Duration) -> Outcome<i32> {
    let began = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            return Ok(status.code().unwrap_or(-1));
        }
        if began.elapsed() > longest {
            let _ = child.kill();
            return Err(format!("it has not ended after {} s", longest.as_secs()));
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn same(code: i32, expected: i32, case: &str) -> Outcome {
    if code == expected { Ok(()) } else { Err(format!("{case}: exit code {code}, expected {expected}")) }
}

/// The files of a run, but for those that are another one each time.
fn files(folder: &Path) -> Outcome<Files> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut files = Files::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let name = PathBuf::from(path.file_name().unwrap_or_default());
        if path.is_file() && !["status.json", ".pulvis-lock"].iter().any(|other| name == Path::new(other)) {
            files.insert(name, std::fs::read(&path).map_err(failed)?);
        }
    }
    Ok(files)
}

fn compare(found: &Files, expected: &Files, case: &str) -> Outcome {
    let names = found.keys().chain(expected.keys());
    let different: Vec<&PathBuf> = names.filter(|name| found.get(*name) != expected.get(*name)).collect();
    if different.is_empty() && !expected.is_empty() {
        return Ok(());
    }
    Err(format!("{case}: other files than one process leaves: {different:?}"))
}
