//! Particles, inlets, outlets, walls and regions in the scenario of a run.

use super::shapes::*;
use crate::scenario::PointsFormat;
use pulvis_boundary::WallShape;
use pulvis_packing::Structure;
use serde_json::Value;

pub(super) const AXES: [&str; 3] = ["x", "y", "z"];
const FACES: [&str; 6] = ["x-low", "x-high", "y-low", "y-high", "z-low", "z-high"];

fn radius(page: Page<'_>) -> Value {
    let by = || ("by", choice(["number", "mass"]));
    let limits = || [("minimum", quantity()), ("maximum", quantity())];
    let with_limits =
        |keys: Vec<(&'static str, Value)>| keys.into_iter().chain(limits()).chain([by()]).collect();
    page.at("`[particles.radius]`").variants(
        "distribution",
        None,
        [
            ("fixed", vec![("value", quantity())], &["value"][..]),
            ("uniform", with_limits(Vec::new()), &["minimum", "maximum"]),
            (
                "normal",
                with_limits(vec![("mean", quantity()), ("standard_deviation", quantity())]),
                &["mean", "standard_deviation", "minimum", "maximum"],
            ),
            (
                "log-normal",
                with_limits(vec![("median", quantity()), ("sigma", number())]),
                &["median", "sigma", "minimum", "maximum"],
            ),
            (
                "rosin-rammler",
                with_limits(vec![("scale", quantity()), ("exponent", number())]),
                &["scale", "exponent", "minimum", "maximum"],
            ),
            (
                "table",
                vec![("radii", list(quantity())), ("cumulative", list(number())), by()],
                &["radii", "cumulative"],
            ),
            ("list", vec![("values", list(quantity())), ("weights", list(number())), by()], &["values"]),
        ],
    )
}

fn arrangement(page: Page<'_>) -> Value {
    let page = page.at("`[particles.arrangement]`");
    let lattice = vec![
        ("lower", vector()),
        ("counts", exactly(3, whole(1))),
        ("spacing", quantity()),
        ("jitter", number()),
        ("structure", choice(Structure::ALL.map(|(name, _)| name))),
    ];
    let file = vec![
        ("path", text()),
        ("format", choice(PointsFormat::ALL.map(|(name, _)| name))),
        ("frame", whole(0)),
        ("length_unit", quantity()),
        ("time_unit", quantity()),
        ("materials", either([boolean(), named(text())])),
    ];
    let listed = vec![
        ("positions", list(vector())),
        ("radii", list(quantity())),
        ("velocities", list(vector())),
        ("angular_velocities", list(vector())),
        ("materials", list(text())),
    ];
    page.variants(
        "kind",
        None,
        [
            ("lattice", lattice, &["lower", "counts", "spacing"][..]),
            ("random", vec![("lower", vector()), ("upper", vector())], &["lower", "upper"]),
            ("dense", vec![("lower", vector()), ("upper", vector())], &["lower", "upper"]),
            (
                "aggregate",
                vec![("centre", vector()), ("growth", choice(["particle-cluster", "cluster-cluster"]))],
                &["centre", "growth"],
            ),
            ("file", file, &["path"]),
            ("list", listed, &["positions"]),
        ],
    )
}

pub(super) fn particles(page: Page<'_>) -> Value {
    let velocity = page.at("`[particles.velocity]`").table(
        [
            ("mean", vector()),
            ("standard_deviation", quantity()),
            ("zero_momentum", boolean()),
            ("exact_temperature", boolean()),
            ("spin", vector()),
        ],
        &[],
    );
    page.at("`[[particles]]`").table(
        [
            ("material", text()),
            ("count", whole(1)),
            ("radius", radius(page)),
            ("arrangement", arrangement(page)),
            ("velocity", velocity),
            ("columns", named(any_quantity())),
        ],
        &["arrangement"],
    )
}

/// A part of space.
pub(super) fn region(page: Page<'_>) -> Value {
    page.at("Regions").variants(
        "kind",
        None,
        [
            ("box", vec![("lower", vector()), ("upper", vector())], &["lower", "upper"][..]),
            ("sphere", vec![("centre", vector()), ("radius", quantity())], &["centre", "radius"]),
            (
                "cylinder",
                vec![("start", vector()), ("end", vector()), ("radius", quantity())],
                &["start", "end", "radius"],
            ),
            (
                "layer",
                vec![("axis", choice(AXES)), ("lower", quantity()), ("upper", quantity())],
                &["axis", "lower", "upper"],
            ),
        ],
    )
}

pub(super) fn inlets(page: Page<'_>) -> Value {
    let velocity = table_of(
        [
            ("mean", Some("Mean velocity [m/s].".to_owned()), vector()),
            ("standard_deviation", Some("Of each component, Gaussian [m/s].".to_owned()), quantity()),
            ("spin", Some("Angular velocity of every particle [rad/s].".to_owned()), vector()),
        ],
        &[],
    );
    page.at("`[[inlets]]`").table(
        [
            ("name", text()),
            ("material", text()),
            ("number_rate", quantity()),
            ("mass_rate", quantity()),
            ("total_number", whole(1)),
            ("total_mass", quantity()),
            ("region", region(page)),
            ("radius", radius(page)),
            ("velocity", velocity),
            ("columns", named(any_quantity())),
            ("seed", whole(0)),
            ("stages", list(text())),
            ("start", quantity()),
            ("stop", quantity()),
            ("interval", quantity()),
            ("max_delay", quantity()),
            ("size_classes", list(quantity())),
        ],
        &["name", "material", "region", "radius"],
    )
}

pub(super) fn outlets(page: Page<'_>) -> Value {
    let beyond = table_of(
        [
            ("point", Some("A point of the plane [m].".to_owned()), vector()),
            ("normal", Some("Points away from the particles that stay.".to_owned()), direction()),
        ],
        &["point", "normal"],
    );
    page.at("`[[outlets]]`").table(
        [
            ("name", text()),
            ("region", region(page)),
            ("beyond", beyond),
            ("steps", whole(1)),
            ("stages", list(text())),
            ("start", quantity()),
            ("stop", quantity()),
            ("size_classes", list(quantity())),
        ],
        &["name"],
    )
}

pub(super) fn enclosure(page: Page<'_>) -> Value {
    page.at("`[box]`").table(
        [
            ("lower", vector()),
            ("upper", vector()),
            ("material", text()),
            ("open", list(choice(FACES))),
            ("materials", table_of(FACES.map(|face| (face, None, text())), &[])),
        ],
        &["lower", "upper", "material"],
    )
}

pub(super) fn walls(page: Page<'_>) -> Value {
    let page = page.at("`[walls.NAME]`");
    let material = || ("material", text());
    let round = || {
        vec![
            material(),
            ("point", vector()),
            ("normal", direction()),
            ("radius", quantity()),
            ("area", quantity()),
        ]
    };
    let rotate = table_of(
        [
            ("axis", Some("Vector along the axis.".to_owned()), direction()),
            ("angle", Some("For example \"90 deg\".".to_owned()), any_quantity()),
        ],
        &["axis", "angle"],
    );
    let variant = |name: &'static str| -> Variant {
        match name {
            "plane" => (
                name,
                vec![material(), ("point", vector()), ("normal", direction()), ("area", quantity())],
                &["material", "point", "normal"],
            ),
            "cylinder" => (
                name,
                vec![
                    material(),
                    ("point", vector()),
                    ("axis", direction()),
                    ("radius", quantity()),
                    ("side", choice(["inside", "outside"])),
                ],
                &["material", "point", "axis", "radius", "side"],
            ),
            "cone" => (
                name,
                vec![
                    material(),
                    ("point", vector()),
                    ("axis", direction()),
                    ("radii", exactly(2, quantity())),
                    ("height", quantity()),
                ],
                &["material", "point", "axis", "radii", "height"],
            ),
            "tube" => (
                name,
                vec![
                    material(),
                    ("point", vector()),
                    ("axis", direction()),
                    ("radius", quantity()),
                    ("length", quantity()),
                ],
                &["material", "point", "axis", "radius", "length"],
            ),
            "mesh" => (
                name,
                vec![
                    material(),
                    ("file", text()),
                    ("file_hash", text()),
                    ("scale", quantity()),
                    ("translate", vector()),
                    ("rotate", rotate.clone()),
                    ("point", vector()),
                    ("axis", direction()),
                    ("area", quantity()),
                ],
                &["material", "file", "scale"],
            ),
            _ => (name, round(), &["material", "point", "normal", "radius"]),
        }
    };
    page.variants("kind", Some("plane"), WallShape::NAMES.iter().copied().map(variant))
}
