//! Particles of other programs' files, and files that are broken.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use pulvis_math::Vector3;

fn reading(format: PointsFormat) -> FileReading {
    FileReading { format, frame: None, length_unit: 1.0, time_unit: 1.0, materials: None }
}

fn parse(format: PointsFormat, text: &str) -> Vec<Grain> {
    parse_points("a", text, &reading(format)).unwrap()
}

fn refusal(format: PointsFormat, text: &str) -> String {
    parse_points("a", text, &reading(format)).unwrap_err().to_string()
}

fn grain(position: [f64; 3], radius: Option<f64>) -> Grain {
    Grain { position: position.into(), radius, velocity: None, angular_velocity: None, material: None }
}

#[test]
fn commas_and_blanks_give_the_same_grains() {
    let comma = parse(PointsFormat::Table, "x,y,z,radius\n1,2,3,0.5\n# a comment\n\n4, 5, 6, 0.25\n");
    let blank = parse(PointsFormat::Table, "# x y z radius\n1 2 3 0.5\n4  5\t6 2.5e-1 # last\n");
    let bare = parse(PointsFormat::Table, "1 2 3 0.5\n4 5 6 0.25");
    assert_eq!(comma, blank);
    assert_eq!(comma, bare);
    assert_eq!(comma, [grain([1.0, 2.0, 3.0], Some(0.5)), grain([4.0, 5.0, 6.0], Some(0.25))]);
}

#[test]
fn columns_of_a_table_stand_in_any_order_and_further_ones_are_skipped() {
    let text = "id,vz,omegax,omegay,omegaz,material,z,y,x,vy,vx,diameter,colour\n7,6,10,20,30,steel,3,2,1,5,4,0.5,red\n";
    let materials = Some([("glass".to_owned(), 0), ("steel".to_owned(), 1)].into());
    let reading =
        FileReading { length_unit: 1e-3, time_unit: 1e-6, materials, ..reading(PointsFormat::Table) };
    let expected = Grain {
        position: Vector3::new(1e-3, 2e-3, 3e-3),
        radius: Some(0.25e-3),
        velocity: Some(Vector3::new(4.0, 5.0, 6.0) * (1e-3 / 1e-6)),
        angular_velocity: Some(Vector3::new(10.0, 20.0, 30.0) * (1.0 / 1e-6)),
        material: Some(1),
    };
    assert_eq!(parse_points("a", text, &reading).unwrap(), [expected]);
    let error = parse_points("a", &text.replace("steel", "wood"), &reading).unwrap_err().to_string();
    assert_eq!(error, "a:2: material is \"wood\"; expected one of glass, steel, as the key `materials` says");
    let error = parse_points("a", "x,y,z\n1,2,3", &reading).unwrap_err().to_string();
    let expected = "a:1: found the columns x,y,z; expected `material`, `species` or `type` among them, for the key `materials`";
    assert_eq!(error, expected);
}

#[test]
fn a_wrong_line_of_a_table_is_named() {
    let table = |text: &str| refusal(PointsFormat::Table, text);
    let header = "x,y,z,radius\n1,2,3,0.5\n";
    assert_eq!(parse(PointsFormat::Table, ""), []);
    assert_eq!(table("x,y,radius\n"), "a:1: found the columns x,y,radius; expected x, y and z among them");
    assert_eq!(table("x,y,z,x\n"), "a:1: found the columns x,y,z,x; expected `x` once");
    assert_eq!(table("x,y,z,vx\n"), "a:1: found the columns x,y,z,vx; expected all of vx, vy, vz, or none");
    assert_eq!(
        table("1,2\n"),
        "a:1: found 2 columns without names; expected 3 (x, y, z), 4 (and a radius) or 7 (and a velocity), or a line with their names"
    );
    assert_eq!(table(&format!("{header}1,2,3")), "a:3: found 3 values; expected 4, one for each column");
    assert_eq!(table(&format!("{header}1,2,NaN,0.5")), "a:3: z is \"NaN\"; expected a finite number");
    assert_eq!(table(&format!("{header}1,2,3,-0.5")), "a:3: radius is \"-0.5\"; expected a radius above 0 m");
    assert_eq!(table(&format!("{header}1,two,3,0.5")), "a:3: y is \"two\"; expected a number");
}

const DUMP: &str = "ITEM: UNITS\nsi\nITEM: TIME\n0\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z radius\n1 2 0.5 0.25 0.125 0.0625\nITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n0 1 0\n0 1 0\nITEM: ATOMS type xu yu zu c_own[1]\n2 1 2 3 9\n1 4 5 6 9\n";

#[test]
fn of_a_dump_the_last_instant_is_taken_or_the_one_that_is_asked_for() {
    let last = parse(PointsFormat::LammpsDump, DUMP);
    assert_eq!(last, [grain([1.0, 2.0, 3.0], None), grain([4.0, 5.0, 6.0], None)]);
    let at = |frame| FileReading { frame: Some(frame), ..reading(PointsFormat::LammpsDump) };
    let first = parse_points("a", DUMP, &at(0)).unwrap();
    assert_eq!(first, [grain([0.5, 0.25, 0.125], Some(0.0625))]);
    let error = parse_points("a", DUMP, &at(2)).unwrap_err().to_string();
    assert_eq!(error, "a holds 2 frames; expected more, for frame 2 counted from 0");
    let materials = Some([("1".to_owned(), 0), ("2".to_owned(), 3)].into());
    let named =
        parse_points("a", DUMP, &FileReading { materials, ..reading(PointsFormat::LammpsDump) }).unwrap();
    assert_eq!(named.iter().map(|grain| grain.material).collect::<Vec<_>>(), [Some(3), Some(0)]);
}

#[test]
fn a_broken_dump_is_refused_where_it_breaks() {
    let dump = |text: &str| refusal(PointsFormat::LammpsDump, text);
    let huge = DUMP.replace("ATOMS\n2\n", "ATOMS\n18446744073709551615\n");
    assert_eq!(
        dump(&huge),
        "a:26: found the end of the file; expected 18446744073709551615 particles, as ITEM: NUMBER OF ATOMS says"
    );
    assert_eq!(dump("x y z\n"), "a:1: found \"x y z\"; expected a line that begins with ITEM:");
    assert_eq!(
        dump("ITEM: NUMBER OF ATOMS\nmany\n"),
        "a:2: found \"many\"; expected the number of particles"
    );
    assert_eq!(
        dump("ITEM: NUMBER OF ATOMS"),
        "a:2: found the end of the file; expected the number of particles"
    );
    assert_eq!(
        dump("ITEM: ATOMS x y z\n"),
        "a:1: found \"ITEM: ATOMS x y z\"; expected ITEM: NUMBER OF ATOMS before the particles"
    );
    assert_eq!(
        dump("ITEM: ENTRIES a\n"),
        "a:1: found \"ITEM: ENTRIES a\"; expected an item of a dump of particles"
    );
    assert_eq!(
        dump(&DUMP.replace("xu yu zu", "xs ys zs")),
        "a:23: found the columns type,xs,ys,zs,c_own[1]; expected x, y, z, not scaled with the box"
    );
    assert_eq!(parse(PointsFormat::LammpsDump, "ITEM: TIMESTEP"), []);
}

#[test]
fn extended_and_plain_xyz_are_read() {
    let extended = "1\nProperties=species:S:1:pos:R:3:velo:R:3:radius:R:1:stress:R:9 Time=1\nA 1 2 3 4 5 6 0.5 1 2 3 4 5 6 7 8 9\n";
    let expected = Grain { velocity: Some(Vector3::new(4.0, 5.0, 6.0)), ..grain([1.0, 2.0, 3.0], Some(0.5)) };
    assert_eq!(parse(PointsFormat::Xyz, extended), [expected]);
    assert_eq!(
        parse(PointsFormat::Xyz, &format!("{extended}1\nplain\nA 7 8 9\n\n")),
        [grain([7.0, 8.0, 9.0], None)]
    );
    let xyz = |text: &str| refusal(PointsFormat::Xyz, text);
    assert_eq!(xyz("one\n"), "a:1: found \"one\"; expected the number of particles");
    assert_eq!(xyz("3\n\nA 1 2 3\n"), "a:4: found the end of the file; expected 3 particles, as line 1 says");
    assert_eq!(
        xyz("1\nProperties=pos:R:x\n1 2 3\n"),
        "a:2: found \"pos:R:x\"; expected Properties=name:kind:columns:..."
    );
    assert_eq!(xyz("1\n\nA 1 2\n"), "a:3: found 3 values; expected 4, one for each column");
}

const DATA: &str = "LAMMPS data\n\n2 atoms\n1 atom types\n0 1 xlo xhi\n\nAtoms # sphere\n\n4 1 0.5 2500 1 2 3 0 0 0\n2 1 1.5 2500 4 5 6 0 0 0\n\nVelocities\n\n2 1 2 3 4 5 6\n4 7 8 9 0 0 1\n";

#[test]
fn a_data_file_of_spheres_gives_diameters_and_motion_by_id() {
    let moving = |grain: Grain, v: [f64; 3], omega: [f64; 3]| Grain {
        velocity: Some(v.into()),
        angular_velocity: Some(omega.into()),
        ..grain
    };
    let expected = [
        moving(grain([1.0, 2.0, 3.0], Some(0.25)), [7.0, 8.0, 9.0], [0.0, 0.0, 1.0]),
        moving(grain([4.0, 5.0, 6.0], Some(0.75)), [1.0, 2.0, 3.0], [4.0, 5.0, 6.0]),
    ];
    assert_eq!(parse(PointsFormat::LammpsData, DATA), expected);
    let data = |text: &str| refusal(PointsFormat::LammpsData, text);
    assert_eq!(
        data(&DATA.replace("# sphere", "# full")),
        "a:7: found \"full\"; expected the atom style sphere"
    );
    assert_eq!(
        data(&DATA.replace("2 atoms", "3 atoms")),
        "a:11: found \"\"; expected 3 lines of the section Atoms, and there are 2"
    );
    assert_eq!(
        data(&DATA.replace("\n4 7", "\n5 7")),
        "a:15: found \"5\"; expected the id of a particle of the section Atoms"
    );
    assert_eq!(
        data(&DATA.replace("\n4 1 0.5", "\n2 1 0.5")),
        "a:10: found \"2\"; expected an id that no other particle has"
    );
    assert_eq!(data("x\n2 atoms\n"), "a:3: found the end of the file; expected the section Atoms");
    assert_eq!(data("x\n"), "a:2: found the end of the file; expected a line `N atoms`");
}
