//! Scenarios in the hands of a program.

use pulvis_lab::protocol::Session;

use super::protocol_scenarios::{Series, run};

/// Takes all steps in calls of 1, 2, 3, ... up to `longest` steps, over and over.
fn divided(longest: u64) -> Session {
    let mut session = Session::new(super::coarse()).unwrap();
    let mut calls = (1..=longest).cycle();
    while !session.is_over() {
        let steps = calls.next().unwrap();
        let advance = session.advance(steps, false).unwrap();
        assert!(advance.steps == steps || session.is_over());
    }
    session
}

#[test]
fn a_session_has_the_bits_of_a_run_however_its_steps_are_divided() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&super::coarse(), folder.path());
    let series = Series::read(folder.path());
    for longest in [37, u64::from(u32::MAX)] {
        // The long one is one call for each stage.
        let session = if longest == 37 {
            divided(longest)
        } else {
            let mut session = Session::new(super::coarse()).unwrap();
            while !session.is_over() {
                let advance = session.advance(longest, true).unwrap();
                assert_eq!(advance.ended.len(), 1);
            }
            session
        };
        assert_eq!(session.results(), summary.stages);
        for (name, value) in session.columns().iter().zip(session.row()) {
            let last = *series.column(name).last().unwrap();
            assert!(
                value.to_bits() == last.to_bits() || (value.is_nan() && last.is_nan()),
                "{name}: {value} {last}"
            );
        }
    }
}

#[test]
fn a_session_that_has_failed_can_be_looked_at_and_goes_on_no_more() {
    let mut scenario = super::coarse();
    scenario.limits.speed = 1e-3;
    let mut session = Session::new(scenario).unwrap();
    let stopped = session.advance(1_000_000, false).unwrap_err().to_string();
    assert!(stopped.starts_with("stage `press`") && stopped.contains("likely cause"), "{stopped}");
    let again = session.advance(1, false).unwrap_err().to_string();
    assert!(again.contains("not go on"), "{again}");
    assert!(session.simulation().particles().positions().iter().all(|centre| centre.x.is_finite()));
}
