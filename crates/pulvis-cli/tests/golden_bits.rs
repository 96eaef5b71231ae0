//! The bits of a few short runs, as they stand in the repository: the same with every instruction set, any number of
//! threads, and another choice of the C library; on every machine that runs this test.
//!
//! A change that alters numbers on purpose renews them: `cargo xtask golden-bits`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout, clippy::print_stderr)]

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use pulvis_math::InstructionSet;

/// Set, the test writes the bits into the repository; the task of the header does that.
const RENEW: &str = "PULVIS_RENEW_GOLDEN_BITS";

/// Makes glibc take the code for processors without fused multiplication and wide registers; what glibc does not
/// know, on other processors or in other versions, it ignores.
const PLAIN_C_LIBRARY: &str = "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX2_Usable,-FMA_Usable,-FMA4_Usable";

const RUNS: [&str; 2] = ["plates", "packing"];
const COLLISIONS: [&str; 2] = ["pair-exact", "pair-engine"];

/// A column of numbers of one output file, of which the repository keeps the last value, to be read, and a hash.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    /// Output and column, without spaces.
    name: String,
    last: String,
    hash: u64,
}

impl Column {
    fn new<'a>(name: String, values: impl IntoIterator<Item = &'a str>) -> Self {
        let (mut hash, mut last) = (FNV_OFFSET, "-");
        for value in values {
            hash = fnv(fnv(hash, value.as_bytes()), b"\n");
            last = value;
        }
        Self { name: name.replace(' ', "_"), last: if last.is_empty() { "-" } else { last }.to_owned(), hash }
    }
}

const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;

/// Goes on with the 64-bit FNV-1a hash.
fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// How the program is run: none of it may change a bit.
#[derive(Clone, Debug, Default)]
struct Variant {
    instructions: Option<String>,
    threads: Option<&'static str>,
    plain_c_library: bool,
}

impl Variant {
    fn run(&self, arguments: &[&str]) -> String {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pulvis"));
        command.args(arguments);
        if arguments[0] == "run" {
            let instructions = self.instructions.iter().flat_map(|set| ["--instructions", set]);
            command.args(instructions).args(self.threads.iter().flat_map(|count| ["--threads", count]));
        }
        if self.plain_c_library {
            command.env("GLIBC_TUNABLES", PLAIN_C_LIBRARY);
        }
        let output = command.output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }

    /// All columns of a scenario's output.
    fn columns(&self, scenario: &str, folder: &Path) -> Vec<Column> {
        let file = stored(&format!("{scenario}.toml"));
        let file = file.to_str().unwrap();
        if COLLISIONS.contains(&scenario) {
            return table("collisions", &self.run(&["collide", file, "--format", "csv"]));
        }
        let output = folder.join(scenario);
        self.run(&["run", file, "--quiet", "--output", output.to_str().unwrap()]);
        let mut columns = table("timeseries", &fs::read_to_string(output.join("timeseries.csv")).unwrap());
        for kind in ["particles", "contacts"] {
            columns.extend(arrays(kind, &fs::read_to_string(last_frame(&output, kind)).unwrap()));
        }
        columns
    }
}

/// A file beside the scenarios.
fn stored(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden_bits").join(name)
}

/// The columns of a CSV table; its numbers have all digits.
fn table(output: &str, text: &str) -> Vec<Column> {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let rows: Vec<_> = lines.collect();
    assert!(rows.len() > 5, "only {} rows of {output}", rows.len());
    let column = |(index, name)| Column::new(format!("{output}.{name}"), rows.iter().map(|row| row[index]));
    names.iter().enumerate().map(column).collect()
}

/// The arrays of a VTK file: eight bytes a number in base64.
fn arrays(output: &str, text: &str) -> Vec<Column> {
    let array = |part: &str| {
        let (head, rest) = part.split_once('>').unwrap();
        let name = head.split_once("Name=\"").unwrap().1.split_once('"').unwrap().0;
        let (body, _) = rest.split_once("</DataArray>").unwrap();
        Column { last: "-".to_owned(), ..Column::new(format!("{output}.{name}"), [body.trim()]) }
    };
    let columns: Vec<_> = text.split("<DataArray ").skip(1).map(array).collect();
    assert!(columns.len() > 3, "only {} arrays of {output}", columns.len());
    columns
}

/// The file of the last frame.
fn last_frame(folder: &Path, kind: &str) -> PathBuf {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|file| file.file_name().unwrap().to_str().unwrap().starts_with(kind)).max().unwrap()
}

/// An empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("golden-bits-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn write_golden(scenario: &str, columns: &[Column]) {
    let mut text =
        "# output, column, last value, hash of all values; made by `cargo xtask golden-bits`\n".to_owned();
    for Column { name, last, hash } in columns {
        writeln!(text, "{name} {last} {hash:016x}").unwrap();
    }
    fs::write(stored(&format!("{scenario}.bits")), text).unwrap();
}

fn read_golden(scenario: &str) -> Vec<Column> {
    let file = stored(&format!("{scenario}.bits"));
    let text = fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let column = |line: &str| {
        let (start, hash) = line.rsplit_once(' ').unwrap();
        let (name, last) = start.rsplit_once(' ').unwrap();
        Column { name: name.to_owned(), last: last.to_owned(), hash: u64::from_str_radix(hash, 16).unwrap() }
    };
    lines.map(column).collect()
}

/// What differs from the repository, line by line. A new column is no difference.
fn differences(scenario: &str, found: &[Column]) -> String {
    let mut text = String::new();
    let golden = read_golden(scenario);
    for expected in &golden {
        match found.iter().find(|column| column.name == expected.name) {
            None => writeln!(text, "{scenario}: {}: is missing", expected.name).unwrap(),
            Some(column) if column.hash != expected.hash => {
                let Column { name, last, .. } = column;
                writeln!(text, "{scenario}: {name}: last value {last}, in the repository {}", expected.last)
                    .unwrap();
            }
            Some(_) => {}
        }
    }
    assert!(golden.len() > 5, "{scenario}: only {} columns in the repository", golden.len());
    text
}

fn assert_golden(variant: &Variant, name: &str) {
    let folder = folder(name);
    let scenarios = RUNS.into_iter().chain(COLLISIONS);
    let differing: String =
        scenarios.map(|scenario| differences(scenario, &variant.columns(scenario, &folder))).collect();
    assert!(
        differing.is_empty(),
        "{variant:?} has other bits than the repository:\n{differing}\
         If numbers are meant to change, `cargo xtask golden-bits` renews them."
    );
}

fn plainest() -> Variant {
    let instructions = InstructionSet::available().first().map(ToString::to_string);
    Variant { instructions, threads: Some("1"), plain_c_library: false }
}

#[test]
fn the_bits_are_those_of_the_repository_with_every_instruction_set_and_number_of_threads() {
    if std::env::var_os(RENEW).is_some() {
        let folder = folder("renewed");
        for scenario in RUNS.into_iter().chain(COLLISIONS) {
            write_golden(scenario, &plainest().columns(scenario, &folder));
        }
    }
    assert_golden(&plainest(), "plainest");
    for (set, threads) in InstructionSet::available().into_iter().zip(["3", "2", "5"]) {
        let variant =
            Variant { instructions: Some(set.to_string()), threads: Some(threads), ..Variant::default() };
        assert_golden(&variant, &variant.instructions.clone().unwrap());
    }
}

/// What the standard functions give for many arguments, as the C library of this process computes them.
fn hash_of_standard_functions() -> u64 {
    let mut hash = FNV_OFFSET;
    for step in 1..20_000 {
        let x = std::hint::black_box(0.000_731 * f64::from(step));
        #[allow(clippy::disallowed_methods)] // the control: these are the functions that differ
        for value in [x.sin(), x.cos(), x.exp(), x.ln(), x.powf(0.7)] {
            hash = fnv(hash, &value.to_bits().to_le_bytes());
        }
    }
    hash
}

/// Not a test: what the test below runs under the other choice of the C library.
#[test]
#[ignore = "a part of another test"]
fn print_the_hash_of_standard_functions() {
    println!("hash {:016x}", hash_of_standard_functions());
}

/// Whether the setting changes what the standard functions give on this machine.
fn the_c_library_chooses() -> bool {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", "print_the_hash_of_standard_functions", "--ignored", "--nocapture"]);
    let output = command.env("GLIBC_TUNABLES", PLAIN_C_LIBRARY).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("hash "), "the control did not run: {text}");
    !text.contains(&format!("hash {:016x}", hash_of_standard_functions()))
}

#[test]
fn the_bits_are_those_of_the_repository_under_another_choice_of_the_c_library() {
    if std::env::var_os(RENEW).is_some() {
        return; // The other test writes the files meanwhile.
    }
    if !the_c_library_chooses() {
        eprintln!("skipped: this C library gives the same bits with and without {PLAIN_C_LIBRARY}");
        return;
    }
    assert_golden(&Variant { plain_c_library: true, ..Variant::default() }, "plain-c-library");
}
