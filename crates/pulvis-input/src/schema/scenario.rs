//! The scenario of a run.

use super::bodies::{AXES, enclosure, inlets, outlets, particles, region, walls};
use super::laws::contact;
use super::shapes::*;
use crate::scenario::{CONTACT_FIELDS, FileFormat, ObservedQuantity, PARTICLE_FIELDS, Refusal};
use pulvis_contact::catalogue::mixing::MATERIAL_PROPERTIES;
use pulvis_math::Dimension;
use serde_json::{Value, json};

const TENSOR: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// The whole file.
pub(super) fn file(page: Page<'_>) -> Value {
    let top = page.at("Top level");
    let start = either([
        text(),
        table_of(
            [
                ("run", Some("Folder of the run, or a checkpoint.".to_owned()), text()),
                ("stage", Some("The stage at whose end the run starts.".to_owned()), text()),
            ],
            &["run"],
        ),
    ]);
    let mut root = top.table([("title", text()), ("seed", whole(0)), ("gravity", vector())], &[]);
    let tables: Vec<(&str, &str, Value)> = vec![
        (
            "start_from",
            "The run, or the checkpoint, from whose state this one starts; what the file does not say is as there.",
            start,
        ),
        ("allow", "What an expert lets pass that is refused otherwise.", list(choice(Refusal::NAMES))),
        ("domain", "Periodic directions.", domain(page)),
        ("materials", "Materials by their names.", materials(page)),
        ("contacts", "The laws between two materials: `[contacts.A-B]`.", named(contact(false, true))),
        ("background", "A medium at rest.", background(page)),
        (
            "temperature",
            "The temperature of everything, which sintering laws read: one for all time, or a `program`.",
            temperature(),
        ),
        ("electrostatics", "Charges act on each other over all distances.", electrostatics(page)),
        ("particles", "Groups of particles.", tables(particles(page))),
        ("inlets", "Particles that come in during the run.", tables(inlets(page))),
        ("outlets", "Where particles leave during the run.", tables(outlets(page))),
        ("box", "Six plane walls.", enclosure(page)),
        ("walls", "Further walls by their names.", named(walls(page))),
        ("groups", "Groups of particles by their names.", named(groups(page))),
        ("time", "The time step.", time(page)),
        ("stages", "What happens, in order.", tables(stages(page))),
        ("limits", "What stops a run.", limits(page)),
        (
            "observers",
            "Stress, fabric, coordination and forces of the sample or a part of it.",
            tables(observers(page)),
        ),
        ("output", "What is written.", output(page)),
    ];
    for (key, words, mut shape) in tables {
        shape["description"] = json!(words);
        root["properties"][key] = shape;
    }
    root
}

/// A temperature, or a program over time.
pub(super) fn temperature() -> Value {
    let program = list(exactly(2, quantity()));
    let words = "Points of time and temperature, straight in between.".to_owned();
    either([quantity(), table_of([("program", Some(words), program)], &["program"])])
}

fn domain(page: Page<'_>) -> Value {
    let keys = [("lower", vector()), ("upper", vector()), ("periodic", list(choice(AXES)))];
    page.at("`[domain]`").table(keys, &["lower", "upper", "periodic"])
}

fn materials(page: Page<'_>) -> Value {
    let properties = MATERIAL_PROPERTIES.iter().map(|property| {
        (property.name, if property.dimension == Dimension::NONE { number() } else { quantity() })
    });
    let density = ("density", quantity());
    named(page.at("`[materials.NAME]`").table(std::iter::once(density).chain(properties), &[]))
}

fn background(page: Page<'_>) -> Value {
    page.at("`[background]`").table([("drag", quantity()), ("rotational_drag", quantity())], &[])
}

fn electrostatics(page: Page<'_>) -> Value {
    page.at("`[electrostatics]`").table([("relative_permittivity", number())], &[])
}

fn time(page: Page<'_>) -> Value {
    page.at("`[time]`").table([("step", quantity_or("auto")), ("steps_per_contact_time", number())], &[])
}

/// A quantity, or a word.
fn quantity_or(word: &str) -> Value {
    either([json!({ "const": word }), quantity()])
}

fn stages(page: Page<'_>) -> Value {
    page.at("`[[stages]]`").table(
        [
            ("name", text()),
            ("until", until(page)),
            ("remove", region(page)),
            ("form_bonds", boolean()),
            ("walls", named(control(page))),
            ("groups", named(group_control(page))),
            ("cell", cell(page)),
            ("set", named(anything())),
            ("programs", named(list(exactly(2, any_quantity())))),
            ("program_updates", whole(1)),
            ("time", time(page)),
        ],
        &["name"],
    )
}

fn until(page: Page<'_>) -> Value {
    let words = |key: &str| match key {
        "axis" => "Axis of the box, or of the period.",
        "component" => "Component of the shear strain.",
        "value" => "The value that is to be reached.",
        "crosses" => "In which direction.",
        "name" => "Name of an inlet or outlet.",
        "number" => "So many particles since the start of the run.",
        "column" => "A column of the time series.",
        "block" => "Duration of a block [s].",
        "blocks" => "Number of blocks in a row.",
        "tolerance" => "A drift of this share of the mean is none.",
        _ => "So much mass since the start of the run [kg].",
    };
    let rule = |keys: Vec<(&'static str, Value)>, required: &[&str]| {
        table_of(keys.into_iter().map(|(key, shape)| (key, Some(words(key).to_owned()), shape)), required)
    };
    let strain = rule(vec![("axis", choice(AXES)), ("value", number())], &["axis", "value"]);
    let component = choice(["xy", "xz", "yz"]);
    let shear = rule(vec![("component", component), ("value", number())], &["component", "value"]);
    let crosses = choice(["upwards", "downwards"]);
    let stress = rule(
        vec![("axis", choice(AXES)), ("value", quantity()), ("crosses", crosses)],
        &["axis", "value", "crosses"],
    );
    let passed = rule(vec![("name", text()), ("number", whole(1)), ("mass", quantity())], &["name"]);
    let steady = rule(
        vec![("column", text()), ("block", quantity()), ("blocks", whole(3)), ("tolerance", number())],
        &["column", "block"],
    );
    page.at("`[stages.until]`").table(
        [
            ("time", quantity()),
            ("kinetic_to_elastic", number()),
            ("minimum_time", quantity()),
            ("pressure_tolerance", number()),
            ("strain", strain),
            ("shear_strain", shear),
            ("stress", stress),
            ("passed", passed),
            ("steady", steady),
        ],
        &[],
    )
}

fn control(page: Page<'_>) -> Value {
    let servo = ["pressure", "from", "ramp", "mass", "damping"].map(|key| (key, quantity())).into();
    let cosine = vec![("displacement", vector()), ("period", quantity()), ("cycles", number())];
    page.at("`[stages.walls.NAME]`").variants(
        "control",
        None,
        [
            ("fixed", Vec::new(), &[][..]),
            ("velocity", vec![("velocity", vector())], &["velocity"]),
            ("cosine", cosine, &["displacement", "period"]),
            ("servo", servo, &["pressure", "mass", "damping"]),
            ("rotation", vec![("angular_velocity", quantity())], &["angular_velocity"]),
            ("removed", Vec::new(), &[]),
        ],
    )
}

fn groups(page: Page<'_>) -> Value {
    let keys = [("material", text()), ("region", region(page)), ("ids", list(exactly(2, whole(0))))];
    page.at("`[groups.NAME]`").table(keys, &[])
}

fn group_control(page: Page<'_>) -> Value {
    let cosine = vec![("displacement", vector()), ("period", quantity()), ("cycles", number())];
    let rotation = vec![("point", vector()), ("axis", direction()), ("angular_velocity", quantity())];
    let variants = [
        ("free", Vec::new(), &[][..]),
        ("fixed", Vec::new(), &[]),
        ("velocity", vec![("velocity", vector())], &["velocity"]),
        ("cosine", cosine, &["displacement", "period"]),
        ("rotation", rotation, &["point", "axis", "angular_velocity"]),
    ];
    let variants = variants.map(|(name, mut keys, required)| {
        keys.push(("regather", boolean()));
        (name, keys, required)
    });
    page.at("`[stages.groups.NAME]`").variants("control", None, variants)
}

fn cell(page: Page<'_>) -> Value {
    let stresses = || {
        let mut all = components(&TENSOR, quantity);
        all["properties"]["isotropic"] = quantity();
        all
    };
    page.at("`[stages.cell]`").table(
        [
            ("rate", components(&TENSOR, quantity)),
            ("stress", stresses()),
            ("from", stresses()),
            ("ramp", quantity()),
            ("inertial_number", number()),
            ("fixed", boolean()),
        ],
        &[],
    )
}

fn limits(page: Page<'_>) -> Value {
    let keys = [("energy_error", number()), ("overlap", number()), ("speed", quantity())];
    page.at("`[limits]`").table(keys, &[])
}

fn observers(page: Page<'_>) -> Value {
    page.at("`[[observers]]`").table(
        [
            ("name", text()),
            ("region", region(page)),
            ("quantities", list(choice(ObservedQuantity::ALL.map(|(name, _)| name)))),
            ("discard", quantity()),
            ("blocks", whole(2)),
            ("least_contacts", whole(1)),
            ("histogram", boolean()),
        ],
        &["name"],
    )
}

/// Every so many steps, or after such a time.
fn interval() -> Value {
    table_of(
        [
            ("steps", Some("Every so many steps.".to_owned()), whole(1)),
            ("interval", Some("Every such time [s].".to_owned()), quantity()),
        ],
        &[],
    )
}

fn output(page: Page<'_>) -> Value {
    let checkpoints = {
        let mut table = interval();
        for (key, words, mut shape) in [
            ("wall_clock", "Every such time of the clock [s].", quantity()),
            ("stage_ends", "Whether the state at the end of each stage is kept.", boolean()),
        ] {
            shape["description"] = json!(words);
            table["properties"][key] = shape;
        }
        table
    };
    let dimensionless = table_of(
        [
            ("length", Some("Length scale [m].".to_owned()), quantity()),
            ("stiffness", Some("Stiffness scale [N/m].".to_owned()), quantity()),
            ("reference_stage", Some("The stage at whose end L0 is taken.".to_owned()), text()),
        ],
        &["length", "stiffness"],
    );
    page.at("`[output]`").table(
        [
            ("folder", text()),
            ("timeseries", interval()),
            ("vtk", either([boolean(), interval()])),
            ("plots", boolean()),
            ("clusters", either([boolean(), choice(["bound"])])),
            ("checkpoints", either([boolean(), checkpoints])),
            ("dimensionless", dimensionless),
            ("files", tables(files(page))),
        ],
        &[],
    )
}

fn files(page: Page<'_>) -> Value {
    // Names of particle columns are fields, too: an editor proposes those that there always are.
    let fields = list(either([choice(PARTICLE_FIELDS), text()]));
    page.at("`[[output.files]]`").table(
        [
            ("format", choice(FileFormat::ALL.map(|(name, _)| name))),
            ("name", text()),
            ("interval", quantity()),
            ("steps", whole(1)),
            ("fields", fields),
            ("contacts", either([boolean(), list(choice(CONTACT_FIELDS))])),
            ("region", region(page)),
            ("precision", choice(["double", "single"])),
            ("compressed", boolean()),
        ],
        &["format"],
    )
}
