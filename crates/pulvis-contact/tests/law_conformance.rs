//! Every law of the catalogue passes the suites of the test kit. The suites read the catalogue's
//! lists, so a newly listed law is tested without another line here.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_contact::catalogue::{InvalidParameter, Law, LawEntry, Role, Values};
use pulvis_contact::{Conventions, ExpectedLoading, NonContact, Normal, Viscosity, bond, friction};
use pulvis_testkit as testkit;

fn references(entries: &'static [LawEntry]) -> Vec<&'static LawEntry> {
    entries.iter().collect()
}

#[test]
fn every_description_is_complete_and_its_law_refuses_wrong_values() {
    testkit::catalogue::check_list(&references(Normal::ENTRIES), Normal::build);
    testkit::catalogue::check_list(&references(NonContact::ENTRIES), NonContact::build);
    testkit::catalogue::check_list(&references(Viscosity::ENTRIES), Viscosity::build);
    for role in [Role::Sliding, Role::Rolling, Role::Torsion] {
        testkit::catalogue::check_list(&friction::entries(role), |name, values| {
            friction::build(role, name, values)
        });
    }
    testkit::catalogue::check_list(&bond::entries(), bond::build);
    fn built<L: Law>(name: &str, values: &Values) -> Option<Result<L, InvalidParameter>> {
        let entry = L::ENTRY;
        (name == entry.name).then(|| entry.complete(values).and_then(|all| L::from_values(&all)))
    }
    testkit::catalogue::check_list(&[&Conventions::ENTRY], built::<Conventions>);
    testkit::catalogue::check_list(&[&ExpectedLoading::ENTRY], built::<ExpectedLoading>);
}

#[test]
fn normal_laws_keep_their_promises() {
    testkit::normal::check_all(300);
}

#[test]
fn noncontact_laws_keep_their_promises() {
    testkit::noncontact::check_all(200);
}

#[test]
fn viscous_laws_keep_their_promises() {
    testkit::viscosity::check_all(300);
}

#[test]
fn friction_laws_give_no_work_back() {
    testkit::friction::check_all(10_000);
}

#[test]
fn bonds_give_no_work_back_but_what_they_store() {
    testkit::bond::check_all(10_000);
}

#[test]
fn whole_contacts_keep_their_promises() {
    testkit::contact::check_all(400);
}
