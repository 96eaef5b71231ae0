//! Frequencies, stiffnesses, and the place of a contact that a bond takes.

use super::bodies::{
    MASS, RADIUS, STIFFNESS, X, Y, Z, alone, at_rest, beside, bond_of, couple, published, values,
};
use pulvis_contact::bond::BROKEN;
use pulvis_contact::theory::bond::Beam;
use pulvis_contact::{ContactKinematics, ContactModel, Linear, Normal, Pair, bond};
use pulvis_math::Vector3;
use pulvis_testkit::oscillation::oscillates_at;

#[test]
fn bonded_spheres_oscillate_at_the_frequencies_of_all_modes() {
    let strong = [("tensile_strength", 1e9), ("normal_stiffness", STIFFNESS)];
    // Along the line of centres √(k_n/m_r).
    let model = alone(bond_of("elastic-brittle", &strong));
    oscillates_at(3.16227766e4, || couple(&model, Z * 1e-7, Vector3::zero()), |now| -now.overlap);
    // 1/I_i + 1/I_j = 5/(m a²) for two spheres; springs against turning √(k 5/(m a²)).
    let turning = STIFFNESS * RADIUS * RADIUS;
    let expected = (turning * 5.0 / (MASS * RADIUS * RADIUS)).sqrt();
    let model =
        alone(bond_of("elastic-brittle", &[strong.as_slice(), &[("bending_stiffness", turning)]].concat()));
    oscillates_at(expected, || couple(&model, Vector3::zero(), Y * 1e-6), |now| now.springs().bond_bending.y);
    let model =
        alone(bond_of("elastic-brittle", &[strong.as_slice(), &[("torsion_stiffness", turning)]].concat()));
    oscillates_at(expected, || couple(&model, Vector3::zero(), Z * 1e-6), |now| now.springs().bond_twist);
    // Shear moves and turns both: 1/m_r + a²/I_i + a²/I_j = 7/m.
    let model =
        alone(bond_of("elastic-brittle", &[strong.as_slice(), &[("shear_stiffness", STIFFNESS)]].concat()));
    let expected = (STIFFNESS * 7.0 / MASS).sqrt();
    let start = || couple(&model, X * 1e-7, Vector3::zero());
    oscillates_at(expected, start, |now| now.springs().bond_shear.x);
}

#[test]
fn a_beam_bond_has_the_stiffness_matrix_of_a_beam() {
    for shear_deforms in [true, false] {
        for (radius_i, radius_j) in [(RADIUS, RADIUS), (RADIUS, 0.6 * RADIUS)] {
            let length = radius_i + radius_j;
            let beam = Beam { length, radius: 4e-4, young_modulus: 1e9, poisson_ratio: 0.25, shear_deforms };
            let theory = if shear_deforms { "timoshenko" } else { "euler-bernoulli" };
            let numbers = [
                ("young_modulus", beam.young_modulus),
                ("poisson_ratio", beam.poisson_ratio),
                ("bond_radius", beam.radius),
                ("tensile_strength", 1e9),
            ];
            let values = values(&numbers).with_choice("beam_theory", theory);
            let model = alone(bond::build("elastic-brittle", &values).unwrap().unwrap().unwrap());
            let matrix = beam.bending_matrix();
            for end in 0..4 {
                let forces = end_forces(&model, [radius_i, radius_j], end, 1e-9 * RADIUS);
                let scale = [1.0, length, 1.0, length]
                    .map(|unit| matrix[0][0] * unit * if end.is_multiple_of(2) { 1.0 } else { length });
                for (row, force) in forces.into_iter().enumerate() {
                    let error = (force - matrix[row][end]).abs() / scale[row];
                    // Displacements of 1e-9 of the length: the turn of the normal is of that order.
                    assert!(error < 1e-8, "{row} {end}: {force}, {}", matrix[row][end]);
                }
            }
        }
    }
}

/// Forces and moments that hold a beam between j at the origin and i, for a unit displacement of u_j, θ_j, u_i or θ_i
/// across it; made by one small step of size `small`.
fn end_forces(model: &ContactModel, radii: [f64; 2], end: usize, small: f64) -> [f64; 4] {
    let [radius_i, radius_j] = radii;
    let length = radius_i + radius_j;
    let mut columns = vec![0.0; model.memory_layout().columns()];
    assert!(model.form_bond(0.0, &mut columns));
    let size = if end.is_multiple_of(2) { small } else { small / length };
    let given = |which: usize| if which == end { size } else { 0.0 };
    let motion = ContactKinematics {
        inverse_distance: 1.0 / length,
        radius_i,
        radius_j,
        velocity_mid: Y * (given(2) - given(0)),
        angular_velocity_i_mid: Z * given(3),
        angular_velocity_j_mid: Z * given(1),
        ..at_rest(0.0)
    };
    let pair = Pair::spheres(MASS, MASS, radius_i, radius_j);
    let answer = model.respond(&pair, &motion, 1.0, &mut columns);
    // What the bond does to the bodies is the opposite of what holds them.
    [answer.force.y, -answer.torque_j.z, -answer.force.y, -answer.torque_i.z].map(|force| force / size)
}

#[test]
fn a_contact_whose_place_the_bond_took_begins_without_force() {
    let values = values(&[
        ("normal_stiffness", 1e3),
        ("shear_stiffness", 1e3),
        ("shear_strength", 1e-4),
        ("tensile_strength", 1e9),
    ])
    .with_choice("contact_spring", "off");
    let bond = bond::build("elastic-brittle", &values).unwrap().unwrap().unwrap();
    let model = beside(bond, Linear::new(2e3, 0.0));
    let (overlap, pair) = (1e-5, Pair::spheres(MASS, MASS, RADIUS, RADIUS));
    let mut columns = vec![0.0; model.memory_layout().columns()];
    assert!(model.form_bond(overlap, &mut columns));
    let mut motion = at_rest(overlap);
    let mut ask =
        |motion: &ContactKinematics<f64>, step: f64| model.respond(&pair, motion, step, &mut columns);
    // The bond alone carries it.
    let pressed = ask(&at_rest(overlap + 1e-6), 0.0);
    assert!((pressed.normal_force - 1e-3).abs() < 1e-15 && pressed.energies.elastic_normal == 0.0);
    motion.velocity_mid = Y * 1e-3;
    let breaking = ask(&motion, 1e-3);
    assert!(breaking.energies.dissipated_fracture > 0.0 && breaking.energies.elastic_normal == 0.0);
    // At the overlap of breaking the contact has no force; beyond it has its stiffness, and none once the bodies part less.
    for (deeper, force) in [(0.0, 0.0), (1e-6, 2e-3), (-1e-6, 0.0)] {
        // To 1e-11 of the overlap, at which the contact may begin later.
        assert!((ask(&at_rest(overlap + deeper), 0.0).normal_force - force).abs() < 2e-13, "{deeper}");
    }
    // After they have come apart, the contact is an ordinary one.
    ask(&at_rest(-1e-9), 0.0);
    assert!((ask(&at_rest(1e-6), 0.0).normal_force - 2e-3).abs() < 1e-15);
}

#[test]
fn kemptons_agglomerates_are_his_contact_and_a_normal_bond() {
    let kempton =
        Normal::build("kempton", &values(&[("k1", 100.0), ("k2", 400.0), ("cohesion_density", 1e4)]));
    let Some(Ok(Normal::Kempton(law))) = kempton else { panic!("the law") };
    let model = beside(published(), law);
    let contact = ContactModel::frictionless(law);
    let pair = Pair::spheres(MASS, MASS, RADIUS, RADIUS);
    let (mut columns, mut without) =
        (vec![0.0; model.memory_layout().columns()], vec![0.0; contact.memory_layout().columns()]);
    let at_formation = 2e-6;
    contact.respond(&pair, &at_rest(at_formation), 0.0, &mut without);
    model.respond(&pair, &at_rest(at_formation), 0.0, &mut columns);
    assert!(model.form_bond(at_formation, &mut columns));
    // Bond and contact add up, in compression and in tension, and beyond touching the bond is alone.
    for overlap in [2e-6, 5e-6, 1.5e-6, -0.5e-6, 0.5e-6, 1.2e-6] {
        let both = model.respond(&pair, &at_rest(overlap), 0.0, &mut columns).normal_force;
        let alone = contact.respond(&pair, &at_rest(overlap), 0.0, &mut without).normal_force;
        let broken = columns[model.memory_layout().column("bond_state").unwrap()] == BROKEN;
        let expected = if broken { 0.0 } else { 1e3 * (overlap - at_formation) };
        // An extension of 2.5e-6 m is more than F_t/k_n.
        assert_eq!(broken, overlap < 1.5e-6, "{overlap}");
        assert!((both - alone - expected).abs() < 1e-15, "{overlap}: {both} {alone}");
    }
}
