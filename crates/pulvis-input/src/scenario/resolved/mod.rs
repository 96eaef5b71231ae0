//! The resolved scenario, `run.toml`: everything that a run used, with no default left unsaid.

pub(super) mod bodies;
mod stages;
pub(super) mod writer;

use super::groups::write_groups;
use super::inlets::write_inlets;
use super::observers::write_observers;
use super::outlets::write_outlets;
use super::output::{CheckpointPlan, ClusterRule, Interval, OutputPlan, Snapshots};
use super::output_files::write_output_files;
use super::start::StartFrom;
use super::time::TimeStep;
use super::{Axis, Contact, Electrostatics, Material, NamedLaw, Scenario, Stage};
use pulvis_contact::catalogue::mixing::MATERIAL_PROPERTIES;
use pulvis_contact::catalogue::{Kind, Role, Value};
use pulvis_math::{Dimension, Vector3};
use writer::{Writer, key, list, number, quantity, text, vector};

impl Scenario {
    /// The scenario as TOML in SI that reads back to an equal one, with a header that says where it
    /// comes from. `version` is that of the program.
    pub fn to_resolved_toml(&self, version: &str) -> String {
        let mut writer = Writer::default();
        writer.comment(&format!("Pulvis {version}"));
        writer.comment(&format!("resolved from {} with seed {}", self.source.name, self.seed));
        if !self.source.replaced.is_empty() {
            writer.comment(&format!(
                "with values set from outside the file: {}",
                self.source.replaced.join(", ")
            ));
        }
        writer.comment("in SI, defaults written out; `pulvis run` of this file repeats the run");
        if let Some(title) = &self.title {
            writer.key("title", text(title));
        }
        if let Some(start) = &self.start_from {
            writer.key("start_from", start_from(start));
        }
        writer.key("seed", self.seed.to_string());
        if !self.allow.is_empty() {
            writer.key("allow", list(self.allow.iter().map(|refusal| text(refusal.name()))));
        }
        writer.key("gravity", gravity(self.background.gravity));
        if let Some(domain) = &self.domain {
            writer.table("domain");
            writer.key("lower", vector(domain.extent.lower, Dimension::LENGTH));
            writer.key("upper", vector(domain.extent.upper, Dimension::LENGTH));
            let periodic = Axis::ALL.into_iter().filter(|axis| domain.periodic[axis.index()]);
            writer.key("periodic", list(periodic.map(|axis| text(axis.name()))));
        }
        self.write_materials(&mut writer);
        for contact in &self.contacts {
            for law in &contact.laws {
                writer.table(&key_of_law(contact, law, &self.materials));
                write_law(&mut writer, law);
            }
        }
        writer.table("background");
        writer.key("drag", quantity(self.background.drag, Dimension::DASHPOT));
        writer.key("rotational_drag", quantity(self.background.rotational_drag, Dimension::DASHPOT));
        if let Some(program) = &self.temperature {
            writer.table("temperature");
            let point = |(time, temperature): &(f64, f64)| {
                list([quantity(*time, Dimension::TIME), quantity(*temperature, Dimension::TEMPERATURE)])
            };
            writer.key("program", list(program.points().iter().map(point)));
        }
        if let Some(Electrostatics { relative_permittivity }) = self.electrostatics {
            writer.table("electrostatics");
            writer.key("relative_permittivity", quantity(relative_permittivity, Dimension::NONE));
        }
        self.write_particles(&mut writer);
        write_inlets(&mut writer, &self.inlets, |material| self.material_text(material));
        write_outlets(&mut writer, &self.outlets);
        self.write_walls(&mut writer);
        write_groups(&mut writer, &self.groups, |material| self.material_text(material));
        writer.table("time");
        write_time(&mut writer, self.time);
        writer.table("limits");
        writer.key("energy_error", quantity(self.limits.energy_error, Dimension::NONE));
        writer.key("overlap", quantity(self.limits.overlap, Dimension::NONE));
        writer.key("speed", quantity(self.limits.speed, Dimension::VELOCITY));
        write_output(&mut writer, &self.output, &self.stages);
        write_observers(&mut writer, &self.observers);
        self.write_stages(&mut writer);
        writer.finish()
    }

    fn write_materials(&self, writer: &mut Writer) {
        for material in &self.materials {
            writer.table(&format!("materials.{}", key(&material.name)));
            if let Some(density) = material.density {
                writer.key("density", quantity(density, Dimension::DENSITY));
            }
            for property in MATERIAL_PROPERTIES {
                if let Some(value) = material.properties.number(property.name) {
                    writer.key(property.name, quantity(value, property.dimension));
                }
            }
        }
    }

    fn material_text(&self, index: usize) -> String {
        text(self.materials.get(index).map_or("", |material| material.name.as_str()))
    }
}

fn start_from(start: &StartFrom) -> String {
    let path = text(&start.path.to_string_lossy());
    match &start.stage {
        Some(stage) => format!("{{ run = {path}, stage = {} }}", text(stage)),
        None => path,
    }
}

fn gravity(value: Vector3) -> String {
    vector(value, Dimension::ACCELERATION)
}

/// `contacts.grain-plate.normal`.
fn key_of_law(contact: &Contact, law: &NamedLaw, materials: &[Material]) -> String {
    let [one, other] = contact.materials.map(|index| materials.get(index).map_or("", |m| m.name.as_str()));
    format!("contacts.{}.{}", key(&format!("{one}-{other}")), law.role.key())
}

/// The keys of a law and their values as TOML. Conventions and expectations are no laws and have no name.
fn law_keys(law: &NamedLaw) -> Vec<(String, String)> {
    let entries = crate::contact::entries(law.role);
    let entry = entries.into_iter().find(|entry| entry.name == law.name);
    let named = !matches!(law.role, Role::Conventions | Role::Expected);
    let mut keys: Vec<_> = named.then(|| ("law".to_owned(), text(law.name))).into_iter().collect();
    for (name, value) in law.values.iter() {
        let dimension = match entry.and_then(|entry| entry.parameter(name)).map(|parameter| parameter.kind) {
            Some(Kind::Number { dimension, .. } | Kind::Numbers { dimension, .. }) => dimension,
            _ => Dimension::NONE,
        };
        let value = match value {
            Value::Number(value) => quantity(*value, dimension),
            Value::Choice(name) => text(name),
            Value::Numbers(values) => list(values.iter().map(|value| quantity(*value, dimension))),
        };
        keys.push((key(name), value));
    }
    keys
}

fn write_law(writer: &mut Writer, law: &NamedLaw) {
    for (name, value) in law_keys(law) {
        writer.key(&name, value);
    }
}

fn write_time(writer: &mut Writer, time: TimeStep) {
    match time {
        TimeStep::Auto { steps_per_contact_time } => {
            writer.key("step", text("auto"));
            writer.key("steps_per_contact_time", number(steps_per_contact_time));
        }
        TimeStep::Fixed(step) => writer.key("step", quantity(step, Dimension::TIME)),
    }
}

fn checkpoints(plan: Option<CheckpointPlan>) -> String {
    let Some(CheckpointPlan { wall_clock, every, stage_ends }) = plan else { return "false".to_owned() };
    let mut keys = vec![format!("wall_clock = {}", quantity(wall_clock, Dimension::TIME))];
    keys.extend(every.map(|interval| match interval {
        Interval::Steps(steps) => format!("steps = {steps}"),
        Interval::Time(time) => format!("interval = {}", quantity(time, Dimension::TIME)),
    }));
    keys.push(format!("stage_ends = {stage_ends}"));
    format!("{{ {} }}", keys.join(", "))
}

fn write_output(writer: &mut Writer, output: &OutputPlan, stages: &[Stage]) {
    let interval = |interval: Interval| match interval {
        Interval::Steps(steps) => format!("{{ steps = {steps} }}"),
        Interval::Time(time) => format!("{{ interval = {} }}", quantity(time, Dimension::TIME)),
    };
    writer.table("output");
    writer.key("folder", text(&output.folder.to_string_lossy()));
    writer.key("timeseries", interval(output.timeseries));
    writer.key(
        "vtk",
        match output.snapshots {
            Snapshots::Never => "false".to_owned(),
            Snapshots::StageEnds => "true".to_owned(),
            Snapshots::Every(every) => interval(every),
        },
    );
    writer.key("plots", output.plots.to_string());
    match output.clusters {
        ClusterRule::Never => {}
        ClusterRule::Acting => writer.key("clusters", "true"),
        ClusterRule::Bound => writer.key("clusters", text("bound")),
    }
    writer.key("checkpoints", checkpoints(output.checkpoints));
    if let Some(scales) = output.dimensionless {
        writer.table("output.dimensionless");
        writer.key("length", quantity(scales.length, Dimension::LENGTH));
        writer.key("stiffness", quantity(scales.stiffness, Dimension::STIFFNESS));
        if let Some(stage) = scales.reference_stage.and_then(|stage| stages.get(stage)) {
            writer.key("reference_stage", text(&stage.name));
        }
    }
    write_output_files(writer, &output.files);
}
