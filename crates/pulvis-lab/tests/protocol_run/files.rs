//! Files of particles and contacts in further formats, and the quantities in them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use pulvis_input::scenario::{ContactFields, FileFormat, Interval, OutputFiles, PARTICLE_FIELDS, Region};
use pulvis_math::Vector3;

use super::observed;
use super::protocol_scenarios::{Series, run};

/// A block of each format, some with an interval, a region or fields of their own.
pub(super) fn every_format() -> Vec<OutputFiles> {
    let block = |(number, (name, format)): (usize, (&str, FileFormat))| OutputFiles {
        name: name.replace('-', "_"),
        format,
        every: [None, Some(Interval::Steps(211)), Some(Interval::Time(3e-9))][number % 3],
        fields: (number % 2 == 1).then(|| PARTICLE_FIELDS.map(str::to_owned).into()),
        contacts: if format == FileFormat::Xyz { ContactFields::None } else { ContactFields::Default },
        region: (number == 3)
            .then_some(Region::Sphere { centre: Vector3::new(2e-5, 2e-5, 2e-5), radius: 15e-6 }),
        single_precision: number == 2,
        compressed: false,
    };
    let built = |(name, _): &(&str, FileFormat)| {
        pulvis_io::frames::format(name).is_ok_and(|format| format.missing.is_none())
    };
    FileFormat::ALL.into_iter().filter(built).enumerate().map(block).collect()
}

/// The columns of a table.
fn table(path: &Path) -> BTreeMap<String, Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let mut columns: BTreeMap<String, Vec<String>> =
        names.iter().map(|name| (name.clone(), Vec::new())).collect();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), names.len());
        names.iter().zip(cells).for_each(|(name, cell)| columns.get_mut(name).unwrap().push(cell.to_owned()));
    }
    columns
}

pub(super) fn numbers(table: &BTreeMap<String, Vec<String>>, name: &str) -> Vec<f64> {
    table[name].iter().map(|cell| cell.parse().unwrap()).collect()
}

/// The last table of particles that a run has left.
pub(super) fn last_table(folder: &Path, stem: &str) -> BTreeMap<String, Vec<String>> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let is_one = |name: &String| {
        name.strip_prefix(stem)
            .and_then(|rest| rest.strip_suffix(".csv"))
            .is_some_and(|number| number.len() == 5)
    };
    table(&folder.join(names.filter(is_one).max().unwrap()))
}

#[test]
fn the_sums_over_particles_are_the_stress_of_observers_and_the_energies_of_the_ledger() {
    let folder = tempfile::tempdir().unwrap();
    let mut scenario = observed();
    scenario.output.files = vec![OutputFiles {
        name: "all".to_owned(),
        format: FileFormat::Csv,
        every: None,
        fields: Some(PARTICLE_FIELDS.map(str::to_owned).into()),
        contacts: ContactFields::Named(
            ["id1", "branch", "force", "normal", "normal_force", "tangential_force", "stored_energy"]
                .map(str::to_owned)
                .into(),
        ),
        region: None,
        single_precision: false,
        compressed: false,
    }];
    run(&scenario, folder.path());
    let (series, particles) = (Series::read(folder.path()), last_table(folder.path(), "all"));
    let last = |name: &str| *series.column(name).last().unwrap();
    let near = |found: f64, expected: f64, scale: f64, what: &str| {
        // The observers and the ledger add up in another order.
        assert!((found - expected).abs() <= 1e-12 * scale.abs(), "{what}: {found} is not {expected}");
    };
    let volume: f64 = ["length_x", "length_y", "length_z"].map(last).iter().product();
    let radii = numbers(&particles, "radius");
    let sphere = |radius: &f64| 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
    let largest = ["xx", "yy", "zz"]
        .map(|part| last(&format!("stress_{part}_all")).abs())
        .into_iter()
        .fold(0.0, f64::max);
    assert!(largest > 0.0);
    for part in ["xx", "yy", "zz", "xy", "xz", "yz"] {
        let mean = |name: &str| -> f64 {
            numbers(&particles, name)
                .iter()
                .zip(&radii)
                .map(|(stress, radius)| stress * sphere(radius))
                .sum::<f64>()
                / volume
        };
        let flipped: String = part.chars().rev().collect();
        let of_contacts = 0.5 * (mean(&format!("stress_{part}")) + mean(&format!("stress_{flipped}")));
        // Observers add what moving particles carry.
        let [mass, one, other] = ["mass", &format!("v{}", &part[..1]), &format!("v{}", &part[1..])]
            .map(|name| numbers(&particles, name));
        let of_motion: f64 =
            (0..mass.len()).map(|row| mass[row] * one[row] * other[row]).sum::<f64>() / volume;
        let sum = of_contacts + of_motion;
        near(sum, last(&format!("stress_{part}_all")), 1e3 * largest, part);
    }
    for name in ["kinetic_translation", "kinetic_rotation"] {
        near(numbers(&particles, name).iter().sum(), last(name), last("kinetic"), name);
    }
    let stored =
        ["elastic_normal", "elastic_sliding", "elastic_rolling", "elastic_torsion", "adhesive"].map(last);
    let scale: f64 = stored.iter().map(|energy| energy.abs()).sum();
    near(numbers(&particles, "stored_energy").iter().sum(), stored.iter().sum(), 1e2 * scale, "stored");
    let contacts = last_table(folder.path(), "all_contacts");
    near(numbers(&contacts, "stored_energy").iter().sum(), stored.iter().sum(), 1e2 * scale, "stored");
    // f = f_n n + f_t.
    let vectors = |name: &str| ["x", "y", "z"].map(|axis| numbers(&contacts, &format!("{name}_{axis}")));
    let [force, normal, tangential] = ["force", "normal", "tangential_force"].map(vectors);
    let strength = numbers(&contacts, "normal_force");
    assert!(strength.len() > 10, "{}", strength.len());
    for contact in 0..strength.len() {
        for axis in 0..3 {
            let sum = strength[contact] * normal[axis][contact] + tangential[axis][contact];
            near(sum, force[axis][contact], strength[contact].abs() + sum.abs(), "force");
        }
    }
}

#[test]
fn a_region_holds_the_particles_whose_centres_lie_in_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut scenario = observed();
    let block = |name: &str, region| OutputFiles {
        name: name.to_owned(),
        format: FileFormat::Csv,
        every: None,
        fields: Some(vec!["radius".to_owned()]),
        contacts: ContactFields::None,
        region,
        single_precision: false,
        compressed: false,
    };
    let (centre, radius) = (Vector3::new(2e-5, 2e-5, 2e-5), 12e-6);
    scenario.output.files =
        vec![block("whole", None), block("part", Some(Region::Sphere { centre, radius }))];
    run(&scenario, folder.path());
    let [whole, part] = ["whole", "part"].map(|stem| last_table(folder.path(), stem));
    let at = |row: usize| {
        let axis = |name| numbers(&whole, name)[row];
        (Vector3::new(axis("x"), axis("y"), axis("z")) - centre).norm()
    };
    let inside: Vec<&String> =
        (0..whole["id"].len()).filter(|&row| at(row) <= radius).map(|row| &whole["id"][row]).collect();
    assert!(!inside.is_empty() && inside.len() < whole["id"].len());
    assert_eq!(inside, part["id"].iter().collect::<Vec<_>>());
    assert!(whole["material"].iter().all(|name| name == "grain"));
    assert!(!folder.path().join("part_contacts_0000.csv").exists());
}

#[test]
fn every_format_of_scenarios_has_a_writer() {
    for (name, _) in FileFormat::ALL {
        assert_eq!(pulvis_io::frames::format(name).unwrap().name, name);
    }
    assert_eq!(pulvis_io::frames::FORMATS.len(), FileFormat::ALL.len());
}

#[test]
fn the_last_state_in_any_format_that_is_read_is_a_start_with_the_same_particles() {
    let folder = tempfile::tempdir().unwrap();
    let mut scenario = observed();
    let block = |name: &str, format| OutputFiles {
        name: name.to_owned(),
        format,
        every: None,
        fields: None,
        contacts: ContactFields::None,
        region: None,
        single_precision: false,
        compressed: false,
    };
    scenario.output.files = vec![
        block("a", FileFormat::Csv),
        block("b", FileFormat::Xyz),
        block("c", FileFormat::LammpsDump),
        block("d", FileFormat::Vtk),
        OutputFiles { compressed: true, ..block("e", FileFormat::Vtk) },
    ];
    run(&scenario, folder.path());
    let last = last_table(folder.path(), "a");
    let names =
        fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let csv = names.filter(|name| name.starts_with("a_") && name.ends_with(".csv")).max().unwrap();
    let by_number = "{ 0 = \"grain\" }";
    for (file, materials) in [
        (csv.as_str(), "true"),
        ("b.xyz", "true"),
        ("c.dump", "{ 1 = \"grain\" }"),
        ("d_series.pvd", by_number),
        ("e_series.pvd", by_number),
        // The folder of the run.
        ("", "true"),
        ("", by_number),
    ] {
        let text = format!(
            "[materials.grain]\ndensity = \"2000 kg/m^3\"\n[contacts.grain-grain.normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n\
             [[particles]]\n[particles.arrangement]\nkind = \"file\"\npath = {:?}\nmaterials = {materials}\n\
             [[stages]]\nname = \"on\"\nuntil = {{ time = \"1 ns\" }}\n",
            folder.path().join(file)
        );
        let start = super::protocol_scenarios::scenario(&text);
        // The record of a run reads the same particles.
        let again = super::protocol_scenarios::scenario(&start.to_resolved_toml("test"));
        assert_eq!(start.particles, again.particles, "{file}");
        let particles = pulvis_lab::protocol::prepare(&start).unwrap().particles;
        assert_eq!(particles.len(), last["id"].len(), "{file}");
        type Value = fn(&pulvis_core::Particle) -> Vector3;
        let columns: [([&str; 3], Value); 3] = [
            (["x", "y", "z"], |particle| particle.position),
            (["vx", "vy", "vz"], |particle| particle.velocity),
            (["omegax", "omegay", "omegaz"], |particle| particle.angular_velocity),
        ];
        for (names, value) in columns {
            for (axis, name) in names.into_iter().enumerate() {
                let found: Vec<f64> = particles.iter().map(|particle| value(particle)[axis]).collect();
                assert_eq!(found, numbers(&last, name), "{file}: {name}");
            }
        }
        assert!(particles.iter().any(|particle| particle.angular_velocity.norm() > 0.0));
        assert_eq!(
            particles.iter().map(|particle| particle.radius).collect::<Vec<_>>(),
            numbers(&last, "radius")
        );
    }
}
