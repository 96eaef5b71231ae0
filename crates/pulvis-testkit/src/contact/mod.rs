//! What every composition of laws promises, whichever laws and conventions it is made of.

use pulvis_contact::catalogue::{Law, Role};
use pulvis_contact::{
    Bond, ContactLaws, ContactModel, Conventions, ExpectedLoading, NonContact, Normal, Viscosity, bond,
    friction,
};

use crate::draw::Draw;
use crate::for_each_case;
use crate::parameters::{random_friction, random_law};

mod balance;
mod dance;
mod lanes;
mod rotation;
mod symmetry;

pub use balance::{closing_errors, deficits};
pub use dance::Dance;
pub use rotation::{RigidRotation, rigid_rotation};

/// Checks `count` random compositions of the catalogue's laws and conventions.
pub fn check_all(count: u64) {
    for_each_case("frame, exchange, mirror, speed, momentum", count, |draw| {
        let model = random_bonded_model(draw);
        let dance = Dance::random(&model, draw);
        symmetry::a_turned_frame_turns_the_answer(&model, &dance, draw);
        symmetry::exchanged_bodies_feel_the_same(&model, &dance);
        symmetry::a_mirror_shows_the_same_contact(&model, &dance, draw);
        symmetry::a_common_speed_changes_nothing(&model, &dance, draw);
        symmetry::momentum_is_only_exchanged(&model, &dance);
        symmetry::losses_are_losses(&model, &dance);
    });
    for_each_case("lanes of whole contacts", count, |draw| {
        let model = random_bonded_model(draw);
        lanes::lanes_give_the_bits_of_the_plain_number(&model, draw);
    });
}

/// A contact as of [`random_model`], in two of five cases with a bond.
fn random_bonded_model(draw: &mut Draw) -> ContactModel {
    let mut model = random_model(draw);
    if draw.chance(0.4) {
        model.laws.bond = random_bond(draw);
    }
    model
}

/// A bond drawn from the catalogue's list with random parameters.
pub fn random_bond(draw: &mut Draw) -> Option<Bond> {
    let entries = bond::entries();
    let entry = *draw.one_of(&entries[1..]);
    random_law(entry, draw, bond::build)
}

/// A contact without a bond, of laws drawn from the catalogue's lists with random parameters and conventions.
pub fn random_model(draw: &mut Draw) -> ContactModel {
    let noncontact = draw.one_of(NonContact::ENTRIES);
    let noncontact = random_law(noncontact, draw, NonContact::build);
    let viscosity = draw.one_of(Viscosity::ENTRIES);
    let viscosity = random_law(viscosity, draw, Viscosity::build);
    let conventions = random_law(&Conventions::ENTRY, draw, |_, values| {
        Some(Conventions::ENTRY.complete(values).and_then(|values| Conventions::from_values(&values)))
    });
    let mut resistance = |role: Role| {
        let entries = friction::entries(role);
        // Twice out of three a spring: most of what can go wrong needs one.
        let entry = if draw.chance(0.33) { entries[0] } else { draw.one_of(&entries) };
        random_friction(entry, draw)
    };
    let (sliding, rolling, torsion) =
        (resistance(Role::Sliding), resistance(Role::Rolling), resistance(Role::Torsion));
    let expected = random_law(&ExpectedLoading::ENTRY, draw, |_, values| {
        let entry = ExpectedLoading::ENTRY;
        Some(entry.complete(values).and_then(|values| ExpectedLoading::from_values(&values)))
    });
    let laws =
        ContactLaws { noncontact, viscosity, sliding, rolling, torsion, bond: None, conventions, expected };
    let normal = draw.one_of(Normal::ENTRIES);
    ContactModel { normal: random_law(normal, draw, Normal::build), laws }
}
