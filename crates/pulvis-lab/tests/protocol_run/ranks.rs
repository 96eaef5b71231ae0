//! Runs on several ranks, which are threads here: the files of one rank, byte by byte.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use pulvis_input::scenario::CheckpointPlan;
use pulvis_lab::protocol::{Following, RunError, RunOptions, RunSummary, follow, resume};
use pulvis_parallel::exchange::{Exchange, ThreadRank};

use super::observed;
use super::protocol_scenarios::{on_ranks, options, run, run_with};
use super::resume::files;

fn assert_same_files(found: &Path, expected: &Path, case: &str) {
    let (found, expected) = (files(found), files(expected));
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>(), "{case}");
    let different: Vec<&String> = found.keys().filter(|name| found[*name] != expected[*name]).collect();
    assert!(different.is_empty(), "{case}: {different:?}");
}

#[test]
fn a_run_on_several_ranks_leaves_the_files_of_one_also_if_it_is_stopped_and_goes_on_with_others() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, shared, stopped] = ["whole", "shared", "stopped"].map(|name| folder.path().join(name));
    let mut scenario = observed();
    scenario.output.checkpoints = Some(CheckpointPlan { stage_ends: true, ..CheckpointPlan::default() });
    scenario.output.files = super::files::every_format();
    run(&scenario, &whole);
    on_ranks(&scenario, &shared, 2);
    assert_same_files(&shared, &whole, "two ranks");
    // The third rank is asked to stop at each of its first looks; the run goes on with two ranks, and then with one.
    let part = |ranks: usize, is_new: bool, stops: bool| -> RunSummary {
        let lead = |options: &RunOptions| {
            if is_new {
                run_with(&scenario, options, &AtomicBool::new(false), &mut |_| {})
            } else {
                resume(&stopped, options, &AtomicBool::new(false), &mut |_| {})
            }
        };
        let following = if is_new { Following::Scenario(&scenario) } else { Following::Resumed(&stopped) };
        lead_and_follow(ranks, &stopped, stops, lead, following).unwrap()
    };
    let first = part(3, true, true);
    assert!(first.interrupted() && first.can_be_resumed);
    let second = part(2, false, true);
    assert!(second.interrupted() && second.steps > first.steps);
    let last = part(2, false, false);
    assert!(!last.interrupted() && last.steps_before == second.steps);
    assert_same_files(&stopped, &whole, "stopped twice");
}

/// What the first of some ranks comes to; with `stops`, the last one is asked to stop. Nobody is left behind.
fn lead_and_follow(
    ranks: usize,
    folder: &Path,
    stops: bool,
    lead: impl Fn(&RunOptions) -> Result<RunSummary, RunError> + Sync,
    following: Following<'_>,
) -> Result<RunSummary, RunError> {
    let mut team = ThreadRank::team(ranks).into_iter();
    let first: Arc<dyn Exchange> = Arc::new(team.next().unwrap());
    std::thread::scope(|scope| {
        for (number, rank) in team.enumerate() {
            scope.spawn(move || {
                let rank: Arc<dyn Exchange> = Arc::new(rank);
                let stop = AtomicBool::new(stops && number + 2 == ranks);
                let options = RunOptions { exchange: Some(Arc::clone(&rank)), ..options(folder) };
                let _ = follow(following, &options, &rank, &stop).unwrap();
                assert_eq!(stop.load(Ordering::Relaxed), stops && number + 2 == ranks);
            });
        }
        lead(&RunOptions { exchange: Some(first), ..options(folder) })
    })
}

#[test]
fn a_leader_that_cannot_write_sends_the_others_home_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "no folder").unwrap();
    let scenario = observed();
    let lead = |options: &RunOptions| run_with(&scenario, options, &AtomicBool::new(false), &mut |_| {});
    let refused = lead_and_follow(3, &file, false, lead, Following::Scenario(&scenario)).unwrap_err();
    assert!(refused.is_bad_input() && refused.to_string().contains("file"), "{refused}");
}

#[test]
fn what_fails_on_all_ranks_is_told_by_the_first_and_what_fails_on_one_by_that_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut scenario = observed();
    // No contact is that flat.
    scenario.limits.overlap = 1e-6;
    let lead = |options: &RunOptions| run_with(&scenario, options, &AtomicBool::new(false), &mut |_| {});
    let place = folder.path().join("deep");
    let failed = lead_and_follow(2, &place, false, lead, Following::Scenario(&scenario)).unwrap_err();
    assert!(failed.to_string().contains("overlap"), "{failed}");
    // A follower that finds no run to go on with.
    let mut team = ThreadRank::team(2).into_iter();
    let [first, second]: [Arc<dyn Exchange>; 2] = [(); 2].map(|()| Arc::new(team.next().unwrap()) as _);
    let place = folder.path().join("nowhere");
    std::thread::scope(|scope| {
        let follower = scope.spawn(|| {
            let options = RunOptions { exchange: Some(Arc::clone(&second)), ..options(&place) };
            follow(Following::Resumed(&place), &options, &second, &AtomicBool::new(false))
                .unwrap_err()
                .to_string()
        });
        let options = RunOptions { exchange: Some(first), ..options(&folder.path().join("fine")) };
        let failed = run_with(&observed(), &options, &AtomicBool::new(false), &mut |_| {}).unwrap_err();
        assert!(failed.to_string().contains("rank 1 could not do its part"), "{failed}");
        assert!(follower.join().unwrap().contains("nowhere"));
    });
}
