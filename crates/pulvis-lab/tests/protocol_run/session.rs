//! Scenarios in the hands of a program.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use pulvis_lab::protocol::{Following, MotionValue, RunOptions, Session, follow, load_scenario};
use pulvis_math::Vector3;
use pulvis_parallel::exchange::{Exchange, ThreadRank};

use super::protocol_scenarios::{Series, options, run, run_with};

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

/// Everything that decides the next bit, negative zeros and all.
fn bits(session: &Session) -> String {
    format!("{:?}", session.simulation().export_state())
}

/// In the first stage, with a force on each particle, two walls that the program leads and one that it has taken away.
fn in_hand() -> Session {
    let mut session = Session::new(super::coarse()).unwrap();
    session.advance(300, false).unwrap();
    let lead = |session: &mut Session, wall, motion, parameters: &[(&str, MotionValue)]| {
        let given: Vec<_> = parameters.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        session.set_wall_motion(wall, motion, &given).unwrap();
    };
    lead(&mut session, 0, "velocity", &[("velocity", MotionValue::Vector([4.0, 0.0, 0.0]))]);
    let swing = [
        ("displacement", MotionValue::Vector([0.0, 0.0, 3e-7])),
        ("period", MotionValue::Number(3e-8)),
        ("cycles", MotionValue::Number(5.0)),
    ];
    lead(&mut session, 4, "cosine", &swing);
    session.set_wall_present(2, false).unwrap();
    let count = session.simulation().particles().len();
    let force = |id: usize| Vector3::new(1e-4 * id as f64, 0.0, -2e-4);
    let forces: Vec<_> = (0..count).map(force).collect();
    session.set_vectors("applied_force", &forces).unwrap().unwrap();
    session.advance(77, false).unwrap();
    session
}

#[test]
fn forces_and_walls_in_the_hands_of_a_program_are_in_checkpoints() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("state.pulvis");
    let mut whole = in_hand();
    whole.checkpoint(&file, "test").unwrap();
    let mut resumed = Session::resume(&file).unwrap();
    assert_eq!(bits(&resumed), bits(&whole));
    for session in [&mut whole, &mut resumed] {
        session.advance(150, false).unwrap();
    }
    let motions = |session: &Session| {
        session.simulation().walls().iter().map(|wall| wall.motion.name()).collect::<Vec<_>>()
    };
    assert_eq!(motions(&resumed), ["velocity", "servo", "fixed", "servo", "cosine", "servo"]);
    // Once more, from one that has been resumed, and over the ends of all stages.
    resumed.checkpoint(&file, "test").unwrap();
    let mut again = Session::resume(&file).unwrap();
    while !whole.is_over() {
        for session in [&mut whole, &mut again] {
            session.advance(500, false).unwrap();
        }
        assert!(bits(&whole) == bits(&again), "other bits at step {}", whole.simulation().steps());
    }
    assert!(again.is_over() && again.simulation().has_applied_forces());
    let rows = [&whole, &again].map(|session| session.row().iter().map(|x| x.to_bits()).collect::<Vec<_>>());
    assert_eq!(rows[0], rows[1]);
}

#[test]
fn a_wall_in_the_hands_of_a_program_stays_there_until_a_stage_controls_it() {
    let mut session = Session::new(super::coarse()).unwrap();
    let swing = |displacement: [f64; 3]| {
        [
            ("displacement".to_owned(), MotionValue::Vector(displacement)),
            ("period".to_owned(), MotionValue::Number(3e-8)),
            ("cycles".to_owned(), MotionValue::Number(5.0)),
        ]
    };
    // Before the first step; the first stage controls the second of them, the third stage takes the first away.
    session.set_wall_motion(4, "cosine", &swing([0.0, 0.0, 3e-7])).unwrap();
    session.set_wall_motion(5, "cosine", &swing([0.0, 0.0, 1e-7])).unwrap();
    let motions = |session: &Session| [4, 5].map(|wall| session.simulation().walls()[wall].motion.name());
    session.advance(1, false).unwrap();
    assert_eq!(motions(&session), ["cosine", "servo"]);
    session.advance(u64::MAX, true).unwrap();
    session.advance(5, false).unwrap();
    assert_eq!((session.stage(), motions(&session)), (1, ["cosine", "servo"]));
    session.advance(u64::MAX, true).unwrap();
    session.advance(5, false).unwrap();
    assert_eq!((session.stage(), motions(&session)), (2, ["fixed", "fixed"]));
}

#[test]
fn what_branches_from_such_a_checkpoint_goes_on_with_its_forces_and_walls_but_on_one_rank() {
    let place = tempfile::tempdir().unwrap();
    let origin = in_hand();
    origin.checkpoint(&place.path().join("state.pulvis"), "test").unwrap();
    let file = place.path().join("branch.toml");
    let text = "start_from = \"state.pulvis\"\n[[stages]]\nname = \"on\"\nuntil = { time = \"20 ns\" }\n\
                walls.x-high = { control = \"fixed\" }\n[output]\nplots = false\n";
    std::fs::write(&file, text).unwrap();
    let scenario = load_scenario(&file, &[]).unwrap();
    let mut branch = Session::new(scenario.clone()).unwrap();
    branch.advance(40, false).unwrap();
    let walls = branch.simulation().walls();
    let motions: Vec<&str> = walls.iter().map(|wall| wall.motion.name()).collect();
    // The stage of the checkpoint has not ended: the cosine goes on.
    assert_eq!(motions, ["velocity", "fixed", "fixed", "servo", "cosine", "servo"]);
    assert!(!walls[2].present && branch.simulation().has_applied_forces());
    // The walls of the branch follow from those of its origin.
    let further = place.path().join("branch.pulvis");
    branch.checkpoint(&further, "test").unwrap();
    let mut resumed = Session::resume(&further).unwrap();
    for session in [&mut branch, &mut resumed] {
        session.advance(100, false).unwrap();
    }
    assert_eq!(bits(&resumed), bits(&branch));
    let [first, second] = ThreadRank::team(2).try_into().ok().unwrap();
    let on = |rank: ThreadRank| {
        let rank: Arc<dyn Exchange> = Arc::new(rank);
        (RunOptions { exchange: Some(Arc::clone(&rank)), ..options(&place.path().join("ranks")) }, rank)
    };
    let stop = AtomicBool::new(false);
    let refused = std::thread::scope(|scope| {
        scope.spawn(|| {
            let (options, rank) = on(second);
            follow(Following::Scenario(&scenario), &options, &rank, &stop).is_err()
        });
        run_with(&scenario, &on(first).0, &stop, &mut |_| {}).unwrap_err()
    });
    assert!(refused.to_string().contains("run it on one rank"), "{refused}");
}
