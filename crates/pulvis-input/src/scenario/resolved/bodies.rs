//! Particles and walls of the resolved scenario.

use super::writer::{Writer, key, list, number, quantity, text, vector};
use crate::scenario::{
    Arrangement, BoxFace, Cuboid, FileReading, GasVelocities, Grain, Growth, ParticleGroup,
    RadiusDistribution, Scenario, VelocityPlan, Wall, WallShape,
};
use pulvis_boundary::{Disk, PlaneWithHole};
use pulvis_math::Dimension;
use std::path::Path;

impl Scenario {
    pub(super) fn write_particles(&self, writer: &mut Writer) {
        for group in &self.particles {
            writer.item("particles");
            // Where the arrangement tells the materials, the group has none.
            if !group.arrangement.gives_materials() {
                writer.key("material", self.material_text(group.material));
            }
            if !matches!(group.arrangement, Arrangement::File { .. } | Arrangement::List(_)) {
                writer.key("count", group.count.to_string());
            }
            if let Some(radius) = &group.radius {
                writer.table("particles.radius");
                write_radius(writer, radius);
            }
            writer.table("particles.arrangement");
            self.write_arrangement(writer, &group.arrangement);
            writer.table("particles.velocity");
            write_velocity(writer, &group.velocity, group);
            if !group.columns.is_empty() {
                writer.table("particles.columns");
            }
            for column in &group.columns {
                writer.key(&column.name, quantity(column.value, column.dimension));
            }
        }
    }

    fn write_arrangement(&self, writer: &mut Writer, arrangement: &Arrangement) {
        match arrangement {
            Arrangement::Lattice(lattice) => {
                writer.key("kind", text("lattice"));
                writer.key("lower", vector(lattice.lower, Dimension::LENGTH));
                writer.key("counts", list(lattice.counts.map(|count| count.to_string())));
                writer.key("spacing", quantity(lattice.spacing, Dimension::LENGTH));
                writer.key("jitter", number(lattice.jitter));
                writer.key("structure", text(lattice.structure.name()));
            }
            Arrangement::Random(block) => {
                writer.key("kind", text("random"));
                write_extent(writer, block);
            }
            Arrangement::Dense(block) => {
                writer.key("kind", text("dense"));
                write_extent(writer, block);
            }
            Arrangement::Aggregate { centre, growth } => {
                writer.key("kind", text("aggregate"));
                writer.key("centre", vector(*centre, Dimension::LENGTH));
                let name = Growth::ALL.iter().find(|(_, other)| other == growth).map_or("", |(name, _)| name);
                writer.key("growth", text(name));
            }
            Arrangement::File { path, reading, grains: _, columns: _ } => {
                self.write_file(writer, path, reading)
            }
            Arrangement::List(grains) => self.write_grains(writer, grains),
        }
    }

    fn write_grains(&self, writer: &mut Writer, grains: &[Grain]) {
        writer.key("kind", text("list"));
        writer.key("positions", list(grains.iter().map(|grain| vector(grain.position, Dimension::LENGTH))));
        let radii =
            grains.iter().filter_map(|grain| grain.radius).map(|radius| quantity(radius, Dimension::LENGTH));
        let velocities =
            grains.iter().filter_map(|grain| grain.velocity).map(|speed| vector(speed, Dimension::VELOCITY));
        let spins = grains
            .iter()
            .filter_map(|grain| grain.angular_velocity)
            .map(|spin| vector(spin, Dimension::RATE));
        let materials =
            grains.iter().filter_map(|grain| grain.material).map(|index| self.material_text(index));
        let lists: [(&str, Vec<String>); 4] = [
            ("radii", radii.collect()),
            ("velocities", velocities.collect()),
            ("angular_velocities", spins.collect()),
            ("materials", materials.collect()),
        ];
        for (key, values) in lists.into_iter().filter(|(_, values)| !values.is_empty()) {
            writer.key(key, list(values));
        }
    }

    fn write_file(&self, writer: &mut Writer, path: &Path, reading: &FileReading) {
        let FileReading { format, frame, length_unit, time_unit, materials } = reading;
        writer.key("kind", text("file"));
        writer.key("path", text(&path.to_string_lossy()));
        writer.key("format", text(format.name()));
        if let Some(frame) = frame {
            writer.key("frame", frame.to_string());
        }
        writer.key("length_unit", quantity(*length_unit, Dimension::LENGTH));
        writer.key("time_unit", quantity(*time_unit, Dimension::TIME));
        if let Some(words) = materials {
            let words =
                words.iter().map(|(word, &index)| format!("{} = {}", key(word), self.material_text(index)));
            writer.key("materials", format!("{{ {} }}", words.collect::<Vec<_>>().join(", ")));
        }
    }

    pub(super) fn write_walls(&self, writer: &mut Writer) {
        if let Some(extent) = &self.enclosure {
            self.write_box(writer, extent);
        }
        for wall in self.walls.iter().filter(|wall| wall.face.is_none()) {
            writer.table(&format!("walls.{}", key(&wall.name)));
            writer.key("material", self.material_text(wall.material));
            writer.key("kind", text(wall.shape.name()));
            writer.key("point", vector(wall.point, Dimension::LENGTH));
            match &wall.shape {
                WallShape::Plane(plane) => writer.key("normal", vector(plane.normal, Dimension::NONE)),
                WallShape::Cylinder(cylinder) => {
                    writer.key("axis", vector(cylinder.axis, Dimension::NONE));
                    writer.key("radius", quantity(cylinder.radius, Dimension::LENGTH));
                    writer.key("side", text(cylinder.side.name()));
                }
                WallShape::Cone(cone) => {
                    writer.key("axis", vector(cone.axis, Dimension::NONE));
                    let radii = cone.radii.map(|radius| quantity(radius, Dimension::LENGTH));
                    writer.key("radii", list(radii));
                    writer.key("height", quantity(cone.height, Dimension::LENGTH));
                }
                WallShape::Tube(tube) => {
                    writer.key("axis", vector(tube.axis, Dimension::NONE));
                    writer.key("radius", quantity(tube.radius, Dimension::LENGTH));
                    writer.key("length", quantity(tube.length, Dimension::LENGTH));
                }
                WallShape::Disk(Disk { normal, radius })
                | WallShape::PlaneWithHole(PlaneWithHole { normal, radius }) => {
                    writer.key("normal", vector(*normal, Dimension::NONE));
                    writer.key("radius", quantity(*radius, Dimension::LENGTH));
                }
                WallShape::Mesh(mesh) => writer.key("axis", vector(mesh.axis, Dimension::NONE)),
            }
            if let Some(source) = &wall.mesh {
                source.write(writer);
            }
            if let Some(area) = wall.area {
                writer.key("area", quantity(area, Dimension::LENGTH * Dimension::LENGTH));
            }
        }
    }

    fn write_box(&self, writer: &mut Writer, extent: &Cuboid) {
        let faces: Vec<&Wall> = self.walls.iter().filter(|wall| wall.face.is_some()).collect();
        let periodic = self.domain.map_or([false; 3], |domain| domain.periodic);
        let is_open = |face: &BoxFace| {
            !periodic[face.axis.index()] && faces.iter().all(|wall| wall.face.as_ref() != Some(face))
        };
        // A box whose faces are all open has a material all the same; which one means nothing.
        let common = faces.first().map_or(0, |wall| wall.material);
        writer.table("box");
        writer.key("material", self.material_text(common));
        write_extent(writer, extent);
        writer.key(
            "open",
            list(BoxFace::ALL.iter().filter(|face| is_open(face)).map(|face| text(face.name()))),
        );
        let special: Vec<_> = faces.iter().filter(|wall| wall.material != common).collect();
        if !special.is_empty() {
            writer.table("box.materials");
        }
        for wall in special {
            writer.key(&wall.name, self.material_text(wall.material));
        }
    }
}

pub(in crate::scenario) fn write_extent(writer: &mut Writer, extent: &Cuboid) {
    writer.key("lower", vector(extent.lower, Dimension::LENGTH));
    writer.key("upper", vector(extent.upper, Dimension::LENGTH));
}

pub(in crate::scenario) fn write_radius(writer: &mut Writer, radius: &RadiusDistribution) {
    let (radius, by) = match radius {
        RadiusDistribution::ByMass(of) => (&**of, "mass"),
        other => (other, "number"),
    };
    if !matches!(radius, RadiusDistribution::Fixed { .. }) {
        writer.key("by", text(by));
    }
    let length = |value: f64| quantity(value, Dimension::LENGTH);
    let mut keys = |name: &str, pairs: &[(&str, String)]| {
        writer.key("distribution", text(name));
        for (key, value) in pairs {
            writer.key(key, value);
        }
    };
    match radius {
        RadiusDistribution::Fixed { value } => keys("fixed", &[("value", length(*value))]),
        RadiusDistribution::Uniform { minimum, maximum } => {
            keys("uniform", &[("minimum", length(*minimum)), ("maximum", length(*maximum))]);
        }
        RadiusDistribution::Normal { mean, standard_deviation, minimum, maximum } => keys(
            "normal",
            &[
                ("mean", length(*mean)),
                ("standard_deviation", length(*standard_deviation)),
                ("minimum", length(*minimum)),
                ("maximum", length(*maximum)),
            ],
        ),
        RadiusDistribution::LogNormal { median, sigma, minimum, maximum } => keys(
            "log-normal",
            &[
                ("median", length(*median)),
                ("sigma", number(*sigma)),
                ("minimum", length(*minimum)),
                ("maximum", length(*maximum)),
            ],
        ),
        RadiusDistribution::RosinRammler { scale, exponent, minimum, maximum } => keys(
            "rosin-rammler",
            &[
                ("scale", length(*scale)),
                ("exponent", number(*exponent)),
                ("minimum", length(*minimum)),
                ("maximum", length(*maximum)),
            ],
        ),
        RadiusDistribution::Table { radii, cumulative } => keys(
            "table",
            &[
                ("radii", list(radii.iter().map(|radius| length(*radius)))),
                ("cumulative", list(cumulative.iter().map(|share| number(*share)))),
            ],
        ),
        // What is by mass twice is so once.
        RadiusDistribution::ByMass(of) => write_radius(writer, of),
        RadiusDistribution::List { values, weights } => keys(
            "list",
            &[
                ("values", list(values.iter().map(|value| length(*value)))),
                ("weights", list(weights.iter().map(|weight| number(*weight)))),
            ],
        ),
    }
}

fn write_velocity(writer: &mut Writer, velocity: &VelocityPlan, group: &ParticleGroup) {
    if !group.arrangement.gives(|grain| grain.velocity) {
        writer.key("mean", vector(velocity.mean, Dimension::VELOCITY));
        let GasVelocities { standard_deviation, zero_momentum, exact_temperature } = velocity.random;
        writer.key("standard_deviation", quantity(standard_deviation, Dimension::VELOCITY));
        writer.key("zero_momentum", zero_momentum.to_string());
        writer.key("exact_temperature", exact_temperature.to_string());
    }
    if !group.arrangement.gives(|grain| grain.angular_velocity) {
        writer.key("spin", vector(velocity.angular_velocity, Dimension::RATE));
    }
}
