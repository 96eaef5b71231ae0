//! The formats that are read: where sound texts come from, and what must be said of damaged ones.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use pulvis_input::collision::CollisionScenario;
use pulvis_input::figure::FigureScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_input::scenario::{Arrangement, Scenario};
use pulvis_input::study::Study;
use pulvis_input::{Document, InputErrors};
use pulvis_io::checkpoint;
use pulvis_lab::protocol::{self, PictureOptions, RunOptions, explain, prepare};

use super::mutate::{Dice, mutated, mutated_bytes};

/// What is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Scenario,
    Collision,
    Probe,
    Figure,
    Study,
    Table,
    Import,
    Mesh,
    Checkpoint,
}

impl Format {
    /// Of a hundred cases: the largest formats have the most.
    pub fn of_case(case: u64) -> Self {
        match case % 20 {
            0..7 => Self::Scenario,
            7 => Self::Import,
            8..11 => Self::Collision,
            11..13 => Self::Probe,
            13 => Self::Figure,
            14 => Self::Study,
            15 => Self::Table,
            16 => Self::Mesh,
            _ => Self::Checkpoint,
        }
    }
}

/// Sound inputs, and a folder for what must be a file.
pub struct Corpus {
    scenarios: Vec<String>,
    collisions: Vec<String>,
    probes: Vec<String>,
    figures: Vec<String>,
    studies: Vec<String>,
    tables: Vec<String>,
    /// With the endings of their files.
    imports: Vec<(&'static str, Vec<u8>)>,
    meshes: Vec<(&'static str, Vec<u8>)>,
    /// Header and contents of a checkpoint.
    checkpoint: (String, Vec<u8>),
    folder: PathBuf,
}

/// How a case ended, where it ended well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Accepted,
    Refused,
}

/// Particles up to which a scenario that was accepted is also set up.
const FEW: usize = 3000;

impl Corpus {
    pub fn new(folder: &Path) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let input = root.join("crates/pulvis-input/tests");
        let mut scenarios = texts(&input.join("good"), |name| name.ends_with(".toml"));
        for name in ["tablet/short.toml", "drum/short.toml"] {
            scenarios.push(fs::read_to_string(root.join("experiments").join(name)).unwrap());
        }
        let is_of = |kind: &'static str| move |name: &str| name.starts_with(kind) && name.ends_with(".toml");
        let plain = |name: &str| {
            name.ends_with(".toml") && !name.starts_with("collision_") && !name.starts_with("probe_")
        };
        scenarios = often(scenarios, 12);
        // What was wrong once stands close to what is wrong otherwise.
        scenarios.extend(texts(&input.join("bad"), plain));
        let mut collisions = texts(&root.join("experiments/chung-ooi"), is_of("test-"));
        collisions.extend(texts(&root.join("experiments/restitution"), is_of("experiment")));
        collisions = often(collisions, 6);
        collisions.extend(texts(&input.join("bad"), is_of("collision_")));
        let mut probes = often(probes_of_figures(&root.join("experiments/figures")), 4);
        probes.extend(texts(&input.join("bad"), is_of("probe_")));
        let figures = fs::read_dir(root.join("experiments/figures")).unwrap();
        let mut figures: Vec<PathBuf> = figures
            .map(|entry| entry.unwrap().path().join("figure.toml"))
            .filter(|path| path.is_file())
            .collect();
        figures.sort();
        let figures = figures.iter().map(|path| fs::read_to_string(path).unwrap()).collect();
        let tables = texts(&input.join("good"), |name| name.ends_with(".csv") || name.ends_with(".txt"));
        fs::create_dir_all(folder.join("figure")).unwrap();
        let collision = root.join("experiments/figures/s1-06/restitution.toml");
        fs::copy(collision, folder.join("figure/restitution.toml")).unwrap();
        fs::create_dir_all(folder.join("scenarios")).unwrap();
        fs::copy(input.join("bad_studies/scenarios/press.toml"), folder.join("scenarios/press.toml"))
            .unwrap();
        let own = fs::read_to_string(root.join("experiments/study-restitution/study.toml")).unwrap();
        let mut studies = often(vec![own.replace("drop.toml", "scenarios/press.toml")], 12);
        studies.extend(texts(&input.join("bad_studies"), |name| name.ends_with(".toml")));
        let checkpoint = checkpoint_of_a_run(&folder.join("run"));
        let folder = folder.to_owned();
        let imports = seeds(&root.join("fuzz/seeds/import"), |name| match name {
            "dump" => "dump",
            "data" => "data",
            "xyz" => "xyz",
            "vtp" | "vtp_appended" => "vtp",
            _ => "csv",
        });
        let meshes =
            seeds(&root.join("fuzz/seeds/mesh"), |name| if name == "object" { "obj" } else { "stl" });
        Self { scenarios, collisions, probes, figures, studies, tables, imports, meshes, checkpoint, folder }
    }

    /// One case. What it was given, and how it ended.
    pub fn try_case(&self, format: Format, dice: &mut Dice, given: &mut String) -> Ending {
        let mut text = |corpus: &[String]| {
            let text = mutated(dice.pick(corpus).as_str(), corpus, dice);
            given.clone_from(&text);
            text
        };
        match format {
            Format::Scenario => of_scenario(Scenario::from_str("case.toml", &text(&self.scenarios))),
            Format::Collision => {
                let document = Document::from_str("case.toml", &text(&self.collisions));
                judged(document.and_then(|document| CollisionScenario::from_document(&document)).map(drop))
            }
            Format::Probe => {
                let document = Document::from_str("case.toml", &text(&self.probes));
                judged(document.and_then(|document| ProbeScenario::from_document(&document)).map(drop))
            }
            Format::Figure => {
                let folder = self.folder.join("figure");
                fs::write(folder.join("figure.toml"), text(&self.figures)).unwrap();
                judged(FigureScenario::load(&folder).map(drop))
            }
            Format::Study => {
                let document = Document::from_str("case.toml", &text(&self.studies));
                let file = self.folder.join("case.toml");
                let load = |document| Study::from_document(&document, &file, &|path| Document::load(path));
                judged(document.and_then(load).map(drop))
            }
            Format::Table => {
                fs::write(self.folder.join("table.csv"), text(&self.tables)).unwrap();
                let file = self.folder.join("table.toml");
                fs::write(&file, WITH_TABLE).unwrap();
                of_scenario(Scenario::load(&file))
            }
            Format::Import => {
                let text = |bytes: &Vec<u8>| String::from_utf8(bytes.clone()).ok();
                let texts: Vec<String> = self.imports.iter().filter_map(|(_, seed)| text(seed)).collect();
                let (ending, sound) = dice.pick(&self.imports);
                let bytes = match text(sound) {
                    Some(text) => mutated(&text, &texts, dice).into_bytes(),
                    None => mutated_bytes(sound, dice),
                };
                *given = String::from_utf8_lossy(&bytes).into_owned();
                let path = format!("grains.{ending}");
                fs::write(self.folder.join(&path), bytes).unwrap();
                let file = self.folder.join("import.toml");
                fs::write(&file, WITH_TABLE.replace("table.csv", &path)).unwrap();
                of_scenario(Scenario::load(&file))
            }
            Format::Mesh => {
                let (ending, sound) = dice.pick(&self.meshes);
                let bytes = match std::str::from_utf8(sound) {
                    Ok(text) => mutated(text, &[text.to_owned()], dice).into_bytes(),
                    Err(_) => mutated_bytes(sound, dice),
                };
                *given = String::from_utf8_lossy(&bytes).into_owned();
                let path = format!("blade.{ending}");
                fs::write(self.folder.join(&path), bytes).unwrap();
                let file = self.folder.join("mesh.toml");
                fs::write(&file, WITH_MESH.replace("blade.stl", &path)).unwrap();
                of_scenario(Scenario::load(&file))
            }
            Format::Checkpoint => self.try_checkpoint(dice),
        }
    }

    /// A checkpoint whose contents are damaged under a checksum that is right, or the scenario of which is another one.
    fn try_checkpoint(&self, dice: &mut Dice) -> Ending {
        let (header, contents) = &self.checkpoint;
        let contents = mutated_bytes(contents, dice);
        let run = self.folder.join("run");
        let file = run.join("checkpoint.pulvis");
        checkpoint::write(&file, None, header, |out| out.write_all(&contents)).unwrap();
        match explain(&run) {
            Ok(explanation) => {
                assert!(explanation.parts.len() >= 2, "{explanation}");
                Ending::Accepted
            }
            Err(error) => {
                let text = error.to_string();
                assert!(text.contains("checkpoint"), "the file is not named: {text}");
                Ending::Refused
            }
        }
    }
}

const WITH_TABLE: &str = r#"[materials.grain]
density = "2000 kg/m^3"
[contacts.grain-grain.normal]
law = "linear"
k = "100 N/m"
[[particles]]
material = "grain"
arrangement = { kind = "file", path = "table.csv" }
[[stages]]
name = "all"
until = { time = "1 ms" }
"#;

const WITH_MESH: &str = r#"[materials.grain]
density = "2000 kg/m^3"
[contacts.grain-grain.normal]
law = "linear"
k = "100 N/m"
[[particles]]
material = "grain"
radius = { distribution = "fixed", value = "1 mm" }
arrangement = { kind = "list", positions = [["0 mm", "0 mm", "50 mm"]] }
[walls.blade]
kind = "mesh"
material = "grain"
file = "blade.stl"
scale = "1 mm"
[[stages]]
name = "all"
until = { time = "1 ms" }
"#;

/// Sound inputs of the coverage-guided fuzzing: a letter that says which format they are in, and the file.
fn seeds(folder: &Path, ending: impl Fn(&str) -> &'static str) -> Vec<(&'static str, Vec<u8>)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let seed = |path: PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (ending(&name), fs::read(&path).unwrap().split_off(1))
    };
    paths.into_iter().map(seed).collect()
}

/// The texts of the files of a folder, in the order of their names.
fn texts(folder: &Path, wanted: impl Fn(&str) -> bool) -> Vec<String> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| wanted(&path.file_name().unwrap().to_string_lossy()));
    paths.sort();
    let texts: Vec<String> =
        paths.iter().map(|path| String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned()).collect();
    assert!(!texts.is_empty(), "{} has none", folder.display());
    texts
}

/// Each of them several times.
fn often(texts: Vec<String>, times: usize) -> Vec<String> {
    std::iter::repeat_n(texts, times).flatten().collect()
}

/// The probes among the scenarios of all figures.
fn probes_of_figures(folder: &Path) -> Vec<String> {
    let is_probe = |text: &String| {
        Document::from_str("probe", text)
            .is_ok_and(|document| ProbeScenario::from_document(&document).is_ok())
    };
    let mut folders: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.retain(|folder| folder.is_dir());
    folders.sort();
    let all = folders.iter().flat_map(|folder| texts(folder, |name| name.ends_with(".toml")));
    let probes: Vec<String> = all.filter(is_probe).collect();
    assert!(!probes.is_empty());
    probes
}

/// A scenario that is accepted is also set up, if it is small.
fn of_scenario(read: Result<Scenario, InputErrors>) -> Ending {
    let scenario = match read {
        Ok(scenario) => scenario,
        Err(errors) => return judged(Err(errors)),
    };
    let again = Scenario::from_str("again.toml", &scenario.to_resolved_toml("0"));
    let is_of_files =
        scenario.particles.iter().any(|group| matches!(group.arrangement, Arrangement::File { .. }));
    assert!(again.is_ok() || is_of_files || scenario.start_from.is_some(), "{}", again.unwrap_err());
    let sites = scenario.particles.iter().map(|group| match &group.arrangement {
        Arrangement::Lattice(lattice) => lattice.site_count(),
        _ => group.count,
    });
    if sites.sum::<usize>() > FEW {
        return Ending::Accepted;
    }
    match prepare(&scenario) {
        Ok(_) => Ending::Accepted,
        Err(error) => {
            let text = error.to_string();
            assert!(text.starts_with("error: ") && text.contains(".toml:"), "{text}");
            assert!(!text.contains("please report"), "{text}");
            Ending::Refused
        }
    }
}

/// Every mistake says where and what, in a bounded number of letters.
fn judged(read: Result<(), InputErrors>) -> Ending {
    let Err(errors) = read else { return Ending::Accepted };
    let text = errors.to_string();
    assert!(!errors.errors().is_empty() && !text.contains("bug in Pulvis"), "{text}");
    for error in errors.errors() {
        let headline = error.headline();
        // A file that is missing or empty has no lines.
        let has_place = error.place.is_some()
            || ["the file ", "cannot be read: ", "is a folder; "]
                .iter()
                .any(|start| headline.starts_with(start))
            || headline.starts_with("there is ");
        assert!(!error.file.is_empty() && has_place && headline.len() < 2000, "{headline}");
    }
    assert!(text.len() < 40_000, "{} letters", text.len());
    Ending::Refused
}

/// Runs a small tablet, and reads its last checkpoint.
fn checkpoint_of_a_run(folder: &Path) -> (String, Vec<u8>) {
    let text = include_str!("../protocol_scenarios/tablet.toml");
    let scenario = Scenario::from_str("tablet.toml", text).unwrap();
    let options = RunOptions {
        folder: Some(folder.to_path_buf()),
        force: false,
        threads: Some(1),
        instructions: None,
        version: "fuzz".to_owned(),
        pictures: PictureOptions::default(),
        exchange: None,
        warn: |_| {},
    };
    protocol::run(&scenario, &options, &AtomicBool::new(false), &mut |_| {}).unwrap();
    checkpoint::read(&folder.join("checkpoint.pulvis")).unwrap()
}
