//! Every file in `tests/good` is a scenario, and means what it says.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_contact::{Normal, Viscosity};
use pulvis_input::scenario::*;
use pulvis_input::{Replacement, Scenario};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/good")
}

fn good(name: &str) -> Scenario {
    Scenario::load(folder().join(name)).unwrap_or_else(|errors| panic!("{errors}"))
}

fn all() -> Vec<Scenario> {
    let mut names: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    assert!(names.len() >= 5, "the folder of good files was not found");
    names.iter().map(|name| good(name)).collect()
}

#[test]
fn a_resolved_scenario_reads_back_to_the_same_one() {
    for scenario in all() {
        let name = &scenario.source.name;
        let text = scenario.to_resolved_toml("1.2.3");
        assert!(text.starts_with("# Pulvis 1.2.3\n"), "{text}");
        let mut again = Scenario::from_str("run.toml", &text)
            .unwrap_or_else(|errors| panic!("{name} resolved to\n{text}\nwhich is refused:\n{errors}"));
        again.source = scenario.source.clone();
        assert_eq!(again, scenario, "{text}");
        assert_eq!(again.to_resolved_toml("1.2.3"), text, "a resolved scenario is already resolved");
    }
}

#[test]
fn a_scenario_cut_off_anywhere_is_read_or_refused_but_never_breaks_the_reader() {
    for scenario in all() {
        let text = &scenario.source.text;
        // A prime step keeps the test short and still hits every kind of line.
        for end in (0..text.len()).step_by(7).filter(|&end| text.is_char_boundary(end)) {
            if let Err(errors) = Scenario::from_str("cut.toml", &text[..end]) {
                let shown = errors.to_string();
                assert!(!shown.is_empty() && !shown.contains("bug in Pulvis"), "{end}: {shown}");
            }
        }
    }
}

#[test]
fn what_is_left_out_has_its_default() {
    let scenario = good("minimal.toml");
    assert_eq!((scenario.seed, scenario.title.as_deref()), (1, None));
    assert_eq!(scenario.background.gravity.to_array(), [0.0; 3]);
    assert_eq!(scenario.background, Background::default());
    assert_eq!(scenario.time, TimeStep::Auto { steps_per_contact_time: 50.0 });
    assert_eq!((scenario.domain, scenario.enclosure, scenario.walls.len()), (None, None, 0));
    let expected = OutputPlan {
        folder: "minimal-run".into(),
        timeseries: Interval::Steps(100),
        snapshots: Snapshots::StageEnds,
        files: Vec::new(),
        plots: true,
        clusters: ClusterRule::Never,
        checkpoints: Some(CheckpointPlan::default()),
        dimensionless: None,
    };
    assert_eq!(scenario.output, expected);
    assert_eq!(CheckpointPlan::default().wall_clock, 600.0);
    assert_eq!(scenario.particles[0].velocity.mean.to_array(), [1.0, 0.0, 0.0]);
    assert_eq!(scenario.particle_count(), 1);
}

#[test]
fn a_tablet_has_its_walls_contacts_and_stages() {
    let tablet = good("tablet.toml");
    assert_eq!((tablet.seed, tablet.particles[0].count), (42, 200));
    let names: Vec<&str> = tablet.walls.iter().map(|wall| wall.name.as_str()).collect();
    assert_eq!(names, BoxFace::NAMES);
    assert_eq!(tablet.walls[1].material, tablet.material("sticky_plate").unwrap());
    assert_eq!(tablet.walls[2].material, tablet.material("plate").unwrap());
    let pairs: Vec<[usize; 2]> = tablet.contacts.iter().map(|contact| contact.materials).collect();
    assert_eq!(pairs, [[0, 0], [0, 1], [0, 2]]);
    let [relax, sinter, release, pull, cycles] = &tablet.stages[..] else { panic!("five stages") };
    assert_eq!((relax.until.kinetic_to_elastic, relax.until.minimum_time), (Some(1e-5), 1e-6));
    let stress = StressRule { axis: Axis::X, value: 4e7, crosses: Crossing::Upwards };
    assert_eq!(sinter.until.stress, Some(stress));
    let (x_high, control) = sinter.controls[0];
    assert_eq!(tablet.walls[x_high].name, "x-high");
    let servo =
        Servo { pressure: PressureRamp { from: 0.0, to: 4e7, duration: 1e-6 }, mass: 1e-9, damping: 1e-3 };
    assert_eq!(control, WallControl::Motion(WallMotion::Servo(servo)));
    assert_eq!(sinter.time, TimeStep::Auto { steps_per_contact_time: 20.0 });
    assert_eq!((sinter.background.drag, release.background.drag), (1e-5, 0.0));
    assert_eq!(release.background.rotational_drag, 1e-6);
    assert_eq!(pull.controls.iter().filter(|(_, c)| *c == WallControl::Removed).count(), 4);
    assert_eq!(pull.background.drag, 0.0, "a switch holds on through later stages");
    let two_and_a_half_periods = 2.5e-5;
    assert!((cycles.until.time.unwrap() - two_and_a_half_periods).abs() < 1e-18);
    assert_eq!(cycles.time, TimeStep::Fixed(5e-11));
}

#[test]
fn a_lattice_fills_its_block_with_cells() {
    let gas = good("periodic_gas.toml");
    let Arrangement::Lattice(lattice) = &gas.particles[0].arrangement else { panic!("a lattice") };
    let sites: Vec<_> = lattice.sites().collect();
    assert_eq!((sites.len(), gas.particles[0].count), (2000, 2000));
    assert_eq!(sites[0].to_array(), [0.5e-3, 0.5e-3, 0.5e-3]);
    assert_eq!(sites[1].to_array(), [1.5e-3, 0.5e-3, 0.5e-3]);
    assert_eq!(sites[20].to_array(), [0.5e-3, 1.5e-3, 0.5e-3]);
    // Up to the rounding of coordinates.
    let last = sites[1999] - [19.5e-3, 19.5e-3, 4.5e-3].into();
    assert!(last.norm() < 1e-16);
    assert_eq!(gas.domain.unwrap().periodic, [true; 3]);
    assert_eq!(gas.particles[1].radius.as_ref().unwrap().limits(), (1e-4, 2e-4));
}

#[test]
fn a_box_has_no_walls_where_space_repeats_or_a_face_is_open() {
    let hopper = good("hopper.toml");
    let names: Vec<&str> = hopper.walls.iter().map(|wall| wall.name.as_str()).collect();
    assert_eq!(names, ["x-low", "x-high", "z-low", "ramp", "lid"]);
    let ramp = &hopper.walls[hopper.wall("ramp").unwrap()];
    // Up to rounding of the division by the length.
    let WallShape::Plane(Plane { normal }) = ramp.shape else { panic!("a plane") };
    assert!((normal.norm() - 1.0).abs() < 1e-15);
    assert_eq!(hopper.walls[4].area, Some(5e-4));
    assert_eq!((hopper.stages[0].background.gravity.z, hopper.stages[1].background.gravity.z), (-9.81, 0.0));
}

#[test]
fn cylinders_have_an_axis_a_radius_and_a_side_and_can_rotate() {
    let scenario = good("drum.toml");
    let cylinder = |number: usize| match scenario.walls[number].shape {
        WallShape::Cylinder(cylinder) => cylinder,
        _ => panic!("a cylinder"),
    };
    let axis = pulvis_math::Vector3::new(0.0, 1.0, 0.0);
    assert_eq!(cylinder(0), Cylinder { axis, radius: 0.02, side: CylinderSide::Inside });
    assert_eq!(cylinder(1), Cylinder { axis: -axis, radius: 0.003, side: CylinderSide::Outside });
    let distance = |number: usize, z: f64| scenario.walls[number].distance([0.0, 0.3, z].into());
    assert!((distance(0, 0.015) - 0.005).abs() < 1e-17 && (distance(0, -0.025) + 0.005).abs() < 1e-17);
    assert!((distance(1, 0.013) - 0.002).abs() < 1e-17 && (distance(1, 0.007) + 0.002).abs() < 1e-17);
    let controls = &scenario.stages[0].controls;
    let rotation =
        |angular_velocity| WallControl::Motion(WallMotion::Rotation(Rotation { angular_velocity }));
    assert_eq!(controls[..], [(0, rotation(10.0)), (1, rotation(-20.0))]);
}

#[test]
fn stages_switch_laws_and_parameters() {
    let scenario = good("switching.toml");
    let grains = |stage: usize| scenario.stages[stage].contacts[0].model;
    let Normal::Linear(_) = scenario.contacts[0].model.normal else { panic!("linear at first") };
    let Normal::Luding(first) = grains(0).normal else { panic!("then Luding") };
    assert_eq!((first.k1, first.kp, first.kc), (200.0, 400.0, 0.0));
    let Normal::Luding(second) = grains(1).normal else { panic!("still Luding") };
    assert_eq!((second.k1, second.kp), (200.0, 450.0));
    assert!(matches!(grains(1).laws.viscosity, Viscosity::Constant(_)));
    let sliding = grains(1).laws.sliding.unwrap();
    assert!(matches!(sliding, pulvis_contact::Friction::SpringSlider(law) if law.dynamic_coefficient == 0.5));
    assert!(matches!(grains(2).laws.viscosity, Viscosity::None(_)));
    assert_eq!(grains(3).normal, scenario.contacts[0].model.normal);
    let plate = |stage: usize| match scenario.stages[stage].contacts[1].model.normal {
        Normal::Luding(law) => law.kc,
        other => panic!("{other:?} is not Luding"),
    };
    assert_eq!((plate(0), plate(1), plate(3)), (100.0, 0.0, 0.0));
    assert_eq!((scenario.stages[0].background.drag, scenario.stages[3].background.drag), (0.0, 1e-6));
    assert_eq!(scenario.stages[2].time, TimeStep::Fixed(5e-7));
    assert_eq!(scenario.stages[3].time, TimeStep::default());
}

#[test]
fn positions_come_from_files_beside_the_scenario() {
    let scenario = good("switching.toml");
    let Arrangement::File { grains, path, .. } = &scenario.particles[0].arrangement else { panic!("a file") };
    assert!(path.is_absolute());
    assert_eq!((grains.len(), grains[1].radius, grains[1].velocity.unwrap().z), (2, Some(1.5e-4), -1.0));
    assert_eq!((&scenario.particles[0].radius, scenario.particles[0].count), (&None, 2));
    assert!(scenario.particles[1].radius.is_some());
}

#[test]
fn a_single_particle_needs_no_contact_with_its_like_and_may_have_one() {
    let bad = folder().with_file_name("bad").join("two_particles_meet.toml");
    let text = std::fs::read_to_string(bad).unwrap();
    let alone = text.replace(r#", ["1 mm", "2 mm", "1 mm"]"#, "");
    assert_ne!(text, alone);
    assert_eq!(Scenario::from_str("alone.toml", &alone).unwrap().contacts.len(), 1);
    let given = format!("{alone}\n[contacts.grain-grain.normal]\nlaw = \"linear\"\nk = \"1 N/m\"\n");
    assert_eq!(Scenario::from_str("given.toml", &given).unwrap().contacts.len(), 2);
    // A wall of its own material is something to meet.
    let at_wall = alone.replace(r#"material = "plate""#, r#"material = "grain""#);
    let error = Scenario::from_str("wall.toml", &at_wall).unwrap_err().to_string();
    assert!(error.contains("missing `contacts.grain-grain`"), "{error}");
}

#[test]
fn values_are_set_from_outside_once_each_and_late_mistakes_blame_the_outside() {
    let path = folder().join("minimal.toml");
    let set = |pairs: &[(&str, &str)]| {
        let pair = |(key, text): &(&str, &str)| ((*key).to_owned(), Replacement::parse(text));
        Scenario::load_with(&path, &pairs.iter().map(pair).collect::<Vec<_>>())
    };
    let scenario = set(&[("stages[0].until.time", "3 s")]).unwrap();
    assert_eq!(scenario.stages[0].until.time, Some(3.0));
    assert!(
        scenario
            .to_resolved_toml("1")
            .contains("# with values set from outside the file: stages[0].until.time\n")
    );
    let problem = || pulvis_input::Problem::rule("too long", "less");
    assert!(scenario.mistake(&["stages[0].until.time"], problem(), "").replaced);
    assert!(!scenario.mistake(&["stages[0].name"], problem(), "").replaced);
    let twice = set(&[("stages[0].until.time", "3 s"), ("stages[0].\"until\".time", "4 s")]).unwrap_err();
    assert!(
        twice.errors()[0].headline().ends_with(
            "stages[0].until.time: the key is set twice from outside the file; expected each key once"
        ),
        "{twice}"
    );
}

#[test]
fn moduli_of_a_contact_follow_from_its_materials_unless_it_names_them() {
    let scenario = good("elastic.toml");
    let modulus = |contact: usize| match scenario.stages[0].contacts[contact].model.normal {
        Normal::Hertz(law) => law.effective_modulus,
        other => panic!("{other:?} is not Hertz"),
    };
    // Equal materials: half of E/(1 − ν²).
    assert!((modulus(0) / (0.5 * 70e9 / 0.96) - 1.0).abs() < 1e-15);
    assert_eq!(modulus(1), 60e9);
    let shear = |contact: usize| match scenario.stages[0].contacts[contact].model.laws.sliding {
        Some(pulvis_contact::Friction::Mindlin(law)) => law.effective_shear_modulus,
        other => panic!("{other:?} is not Mindlin"),
    };
    let (glass, steel): (f64, f64) = (70e9 / 2.4 / 1.8, 210e9 / 2.6 / 1.7);
    assert!((shear(0) / (0.5 * glass) - 1.0).abs() < 1e-15);
    assert!((shear(1) / (1.0 / (1.0 / glass + 1.0 / steel)) - 1.0).abs() < 1e-15);
    assert_eq!(scenario.stages[0].contacts[0].model.laws.expected.speed, 1.0);
}

#[test]
fn columns_of_particles_come_in_one_order_with_their_dimensions() {
    let scenario = good("removal.toml");
    let columns = |group: usize| -> Vec<(&str, f64, String)> {
        let columns = &scenario.particles[group].columns;
        columns.iter().map(|column| (&column.name[..], column.value, column.dimension.unit())).collect()
    };
    let units = ["C", "kg^-1 m^-2 s^3 A^2", "1"].map(str::to_owned);
    let [charge, conductance, batch] = units;
    let first = [
        ("charge", 1e-12, charge.clone()),
        ("conductance", 2e-3, conductance.clone()),
        ("batch", 1.0, batch.clone()),
    ];
    assert_eq!(columns(0), first);
    assert_eq!(
        columns(1),
        [("charge", -3e-12, charge), ("conductance", 0.0, conductance), ("batch", 2.0, batch)]
    );
}

#[test]
fn charges_act_over_all_distances_where_the_table_is_there() {
    let medium = good("electrostatics.toml").electrostatics.unwrap();
    assert_eq!(medium.relative_permittivity, 2.2);
    assert_eq!(good("removal.toml").electrostatics, None);
    let text = good("electrostatics.toml").source.text.replace("relative_permittivity = 2.2", "");
    let vacuum = Scenario::from_str("vacuum.toml", &text).unwrap().electrostatics.unwrap();
    assert_eq!(vacuum.relative_permittivity, 1.0);
}

#[test]
fn stages_take_particles_away_in_any_region() {
    let stages = good("removal.toml").stages;
    assert_eq!(stages[0].remove, None);
    assert_eq!(stages[1].remove, Some(Region::Sphere { centre: [0.0; 3].into(), radius: 1.5e-3 }));
    let (lower, upper) = ([0.0, 0.0, 1e-3].into(), [1e-2; 3].into());
    assert_eq!(stages[2].remove, Some(Region::Box(Cuboid { lower, upper })));
    let ends = [[0.0; 3].into(), [3e-3, 0.0, 0.0].into()];
    assert_eq!(stages[3].remove, Some(Region::Cylinder { ends, radius: 0.7e-3 }));
    assert_eq!(stages[4].remove, Some(Region::Layer { axis: 1, lower: 1e-3, upper: 2e-3 }));
}

#[test]
fn a_gas_can_be_without_momentum_and_have_its_temperature_exactly() {
    let groups = good("periodic_gas.toml").particles;
    let gas = GasVelocities { standard_deviation: 1.0, zero_momentum: true, exact_temperature: true };
    assert_eq!((groups[0].velocity.random, groups[1].velocity.random), (gas, GasVelocities::default()));
}

#[test]
fn observers_see_the_sample_or_a_region_and_measure_all_but_walls_unless_told() {
    let observers = good("periodic_gas.toml").observers;
    let all = ObservedQuantity::ALL.map(|(_, quantity)| quantity);
    let [whole, slab, ball] = &observers[..] else { panic!("{observers:?}") };
    let expected = Observer {
        name: "gas".to_owned(),
        region: None,
        quantities: all[..5].to_vec(),
        discard: 0.0,
        blocks: 10,
        least_contacts: 4,
        histogram: false,
    };
    assert_eq!(*whole, expected);
    assert_eq!(slab.region, Some(Region::Layer { axis: 2, lower: 0.0, upper: 5e-3 }));
    assert_eq!(slab.quantities, [ObservedQuantity::Stress, ObservedQuantity::Particles]);
    assert_eq!((slab.discard, slab.blocks, slab.histogram), (0.1, 5, true));
    assert_eq!(ball.region, Some(Region::Sphere { centre: [1e-2; 3].into(), radius: 4e-3 }));
}

#[test]
fn a_cell_deforms_as_its_stages_say_and_goes_on_where_they_say_nothing() {
    let scenario = good("cell.toml");
    let motion = |stage: usize| scenario.stages[stage].cell.unwrap();
    assert_eq!(motion(0).prescribed().to_array(), [-20.0, -20.0, -20.0, 0.0, 0.0, 0.0]);
    let ramp = PressureRamp { from: 20.0, to: 200.0, duration: 5e-3 };
    assert_eq!((motion(1).isotropic, motion(1).inertial_number), (Some(ramp), 2e-3));
    assert_eq!(motion(2).components[3], CellControl::Rate(10.0));
    let constant = PressureRamp { from: 200.0, to: 200.0, duration: 0.0 };
    assert_eq!(motion(2).components[1], CellControl::Stress(constant));
    assert_eq!(motion(2).inertial_number, CellMotion::QUASI_STATIC);
    assert_eq!(scenario.stages[2].until.shear_strain, Some(ShearRule { component: 3, value: 1.5 }));
    assert_eq!(scenario.stages[3].cell, None);
    assert_eq!(scenario.stages[4].cell, Some(CellMotion::default()));
}

#[test]
fn walls_with_edges_and_meshes_read_back_with_what_they_were_made_of() {
    let scenario = good("hopper_of_parts.toml");
    let [silo, funnel, floor, piston, paddle] = &scenario.walls[..] else { panic!("five walls") };
    let up = pulvis_math::Vector3::new(0.0, 0.0, 1.0);
    assert_eq!(silo.shape, Tube { axis: up, radius: 0.01, length: 0.03 }.into());
    assert_eq!(funnel.shape, Cone { axis: up, radii: [0.0, 0.01], height: 0.01 }.into());
    assert_eq!(floor.shape, PlaneWithHole { normal: up, radius: 2e-3 }.into());
    assert_eq!(
        (&piston.shape, piston.area),
        (&Disk { normal: -up, radius: 0.01 }.into(), Some(std::f64::consts::PI * 0.01 * 0.01))
    );
    let WallShape::Mesh(mesh) = &paddle.shape else { panic!("a mesh") };
    // Two triangles, one flat part, four edges, four corners.
    assert_eq!((mesh.surface.counts(), mesh.axis), ([2, 1, 4, 4], up));
    // Turned by 90° about z and lifted: the blade from x = −4 to 4 mm reaches from y = −4 to 4 mm.
    let (low, high) = mesh.surface.bounds();
    for (found, expected) in low.into_iter().chain(high).zip([0.0, -4e-3, 13e-3, 0.0, 4e-3, 17e-3]) {
        assert!((found - expected).abs() < 1e-17, "{low:?} {high:?}");
    }
    assert!((paddle.distance([3e-3, 1e-3, 15e-3].into()) - 3e-3).abs() < 1e-17);
    let source = paddle.mesh.as_ref().unwrap();
    assert_eq!((source.scale, source.hash.len()), (1e-3, 16));
    // The copy of the scenario in the folder of a run is refused where the file has changed.
    let resolved = scenario.to_resolved_toml("test");
    assert!(resolved.contains(&format!("file_hash = \"{}\"", source.hash)), "{resolved}");
    let other = resolved.replace(&source.hash, "0123456789abcdef");
    let refused = Scenario::from_str("run.toml", &other).unwrap_err().to_string();
    assert!(refused.contains("paddle.obj has changed: its hash is"), "{refused}");
}

#[test]
fn inlets_and_outlets_have_what_their_keys_say_and_regions_end_with_the_box() {
    let scenario = good("inlets.toml");
    assert!(scenario.particles.is_empty());
    assert_eq!(scenario.openings().collect::<Vec<_>>(), ["rain", "jet", "hole", "above"]);
    let [rain, jet] = &scenario.inlets[..] else { panic!("two inlets") };
    let Region::Box(extent) = rain.region else { panic!("a layer ends with the box") };
    assert_eq!(extent.lower.to_array(), [0.0, 0.0, 12e-3]);
    assert_eq!(extent.upper.to_array(), [10e-3, 10e-3, 16e-3]);
    assert_eq!((rain.rate, rain.total), (Amount::Number(1000.0), Some(Amount::Number(40.0))));
    assert_eq!((rain.schedule.start, rain.schedule.stop), (0.0, f64::INFINITY));
    assert!(rain.schedule.takes_in("fill") && !rain.schedule.takes_in("drain"));
    assert_eq!((jet.rate, jet.total), (Amount::Mass(1e-3), Some(Amount::Mass(1e-4))));
    assert_eq!((jet.seed, jet.interval, jet.max_delay), (Some(12), Some(2e-3), None));
    assert_eq!(jet.velocity.to_array(), [0.0, 1.0, 0.0]);
    let [hole, above] = &scenario.outlets[..] else { panic!("two outlets") };
    assert_eq!((hole.steps, above.steps), (20, 50));
    let OutletZone::Beyond { normal, .. } = above.zone else { panic!("a plane") };
    assert_eq!(normal.to_array(), [0.0, 0.0, 1.0]);
    assert_eq!(
        scenario.stages[0].until.passed,
        Some(PassedRule { opening: 0, amount: Amount::Number(40.0) })
    );
    assert_eq!(scenario.stages[1].until.passed.map(|rule| rule.opening), Some(2));
    // In the hands of another run, what is open stays open and what is shut stays shut.
    let later = scenario.as_in_stage(1, None);
    assert!(!later.inlets[0].schedule.takes_in("anything") && later.inlets[1].schedule.takes_in("anything"));
}

#[test]
fn groups_have_criteria_and_motions() {
    let scenario = good("groups.toml");
    let [floor, ball, corner] = &scenario.groups[..] else { panic!("{:?}", scenario.groups) };
    assert!(floor.region.is_some() && ball.takes_in(99, 1) && !ball.takes_in(99, 0));
    assert!(corner.takes_in(15, 0) && !corner.takes_in(16, 0) && corner.takes_in(60, 0));
    let [rest, lead, turn] = &scenario.stages[..] else { panic!() };
    assert_eq!(rest.groups, [(0, GroupControl { motion: GroupMotion::Fixed, regather: false })]);
    assert!(lead.until.time == Some(2e-3) && turn.groups[0].1.regather);
    assert!(matches!(turn.groups[1].1.motion, GroupMotion::Rotation(rotation) if rotation.axis.y == -2.0));
}
