//! A folder for each test, and what is expected of the files that a run leaves in it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// 27 grains in a box that fly for less than a second of wall-clock time.
pub const TINY: &str = r#"[materials.grain]
density = "2000 kg/m^3"

[contacts.grain-grain]
normal = { law = "luding", k1 = "100 N/m", kp = "500 N/m", kc = "100 N/m", phi_f = 0.05 }

[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "1 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [3, 3, 3], spacing = "2.2 mm" }
velocity = { standard_deviation = "1 m/s" }

[box]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["6.6 mm", "6.6 mm", "6.6 mm"]
material = "grain"

[[stages]]
name = "mix"
until = { time = "1 ms" }

[output]
timeseries = { steps = 10 }
"#;

/// The line of [`TINY`] that places its grains.
pub const LATTICE: &str = r#"arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [3, 3, 3], spacing = "2.2 mm" }"#;

/// A folder of one test with the scenario `s.toml` in it; commands run there.
pub struct Place(pub PathBuf);

impl Place {
    /// [`TINY`] with some texts replaced; each of them must be there.
    pub fn new(name: &str, changes: &[(&str, &str)]) -> Self {
        Self::with(name, TINY, changes)
    }

    /// The same with another scenario.
    pub fn with(name: &str, scenario: &str, changes: &[(&str, &str)]) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("run_command").join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let text = changes.iter().fold(scenario.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        });
        fs::write(folder.join("s.toml"), text).unwrap();
        Self(folder)
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pulvis"));
        command.args(arguments).current_dir(&self.0);
        command
    }

    pub fn pulvis(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    pub fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
    }
}

pub fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn error(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// All lines whole, all files of the index there, the record a scenario: what a finished run leaves.
pub fn assert_files_are_complete(place: &Place, folder: &str) {
    let series = place.read(&format!("{folder}/timeseries.csv"));
    assert!(series.ends_with('\n'));
    let columns = series.lines().next().unwrap().split(',').count();
    assert!(series.lines().count() > 1 && columns > 20);
    assert!(series.lines().all(|line| line.split(',').count() == columns));
    let index = place.read(&format!("{folder}/series.pvd"));
    assert!(index.starts_with("<?xml") && index.trim_end().ends_with("</VTKFile>"), "{index}");
    let frames: Vec<&str> =
        index.split("file=\"").skip(1).filter_map(|rest| Some(rest.split_once('"')?.0)).collect();
    assert!(frames.len() >= 2, "{index}");
    for frame in frames {
        let blocks = place.read(&format!("{folder}/{frame}"));
        for block in blocks.split("file=\"").skip(1) {
            let file = place.0.join(folder).join(block.split_once('"').unwrap().0);
            // The data are binary; the end of the file is text.
            let bytes = fs::read(&file).unwrap();
            assert!(bytes.trim_ascii_end().ends_with(b"</VTKFile>"), "{}", file.display());
        }
    }
    for picture in ["energies.png", "stress.png", "particles.png"] {
        let bytes = fs::read(place.0.join(folder).join(picture)).unwrap();
        assert!(bytes.starts_with(b"\x89PNG") && bytes.ends_with(b"IEND\xaeB`\x82"), "{picture}");
    }
    let again = place.pulvis(&["check", &format!("{folder}/run.toml")]);
    assert_eq!(again.status.code(), Some(0), "{}", error(&again));
}

/// A run whose words are kept until it is [`finish`]ed.
pub fn spawn(mut command: Command) -> Child {
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// A run that ends with the test, however that ends.
#[cfg(unix)]
pub struct Ended(pub Child);

#[cfg(unix)]
impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Waits until the run has written some of its time series.
pub fn wait_for_rows(series: &Path) {
    wait_for_bytes(series, 2000);
}

pub fn wait_for_bytes(file: &Path, bytes: u64) {
    let began = Instant::now();
    while fs::metadata(file).map_or(0, |data| data.len()) < bytes {
        assert!(began.elapsed() < Duration::from_secs(60), "no row after a minute");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Waits for the end of a run that has been told to stop; ends it by force after a minute.
pub fn finish(mut run: Child) -> Output {
    let began = Instant::now();
    while run.try_wait().unwrap().is_none() {
        if began.elapsed() > Duration::from_secs(60) {
            run.kill().unwrap();
            panic!("the run goes on after Ctrl-C");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    run.wait_with_output().unwrap()
}
