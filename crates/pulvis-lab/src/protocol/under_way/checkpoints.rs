//! A run under way: what of it makes a checkpoint, and how it goes on from one.

use std::path::PathBuf;
use std::time::Instant;

use pulvis_input::scenario::Scenario;
use pulvis_io::table::TimeSeriesWriter;

use super::{RELATIVE_ERROR, Run, TIME_SERIES};
use crate::protocol::checkpoint::{Checkpoint, Found, Keeper, Purpose, RunRecord};
use crate::protocol::error::RunError;
use crate::protocol::folder::{LIST, OutputFolder};
use crate::protocol::kept_rows::KeptRows;
use crate::protocol::measure::Measure;
use crate::protocol::openings::Openings;
use crate::protocol::pace::Due;
use crate::protocol::programs::models_after;
use crate::protocol::ranks::Leader;
use crate::protocol::run::{PictureOptions, StageResult, drop_later};
use crate::protocol::snapshots::Snapshots;
use crate::protocol::stage::{Look, StageWatch};
use crate::protocol::start::{Resumed, resumed};
use crate::protocol::status::{STATUS, StatusFile};

impl<'a> Run<'a> {
    /// Where a checkpoint has left off.
    pub(in crate::protocol) fn resume(
        scenario: &'a Scenario,
        resolved: String,
        found: Found,
        mut output: OutputFolder,
        version: &str,
    ) -> Result<Self, RunError> {
        let file = found.path.clone();
        let Resumed { simulation, plans, ancestors, record, results } = resumed(scenario, found)?;
        let update = record.update as usize;
        let interactions = models_after(scenario, &scenario.stages[record.stage()], update);
        output.check_list(&record.files)?;
        let mut measure = Measure::new(scenario, &simulation);
        measure.resume(record.reference);
        let series = output.path().join(TIME_SERIES);
        let (writer, written) = TimeSeriesWriter::resume(&series, measure.columns(), record.series())?;
        let mut rows = KeptRows::new(measure.column(RELATIVE_ERROR).unwrap_or(0));
        written.into_iter().for_each(|row| rows.push(row));
        // All that can be refused has been: from here on, files are cut back.
        drop_later(&file)?;
        output.cut_back(&record.files)?;
        let status = StatusFile::begin(output.file(STATUS)?, version);
        let snapshots = Snapshots::resume(scenario, output.path(), &record.snapshots)?;
        let watch = record
            .watch
            .as_ref()
            .map(|watch| StageWatch::resume(scenario, &scenario.stages[record.stage()], watch));
        let keeper = Keeper::new(scenario, output.path(), version);
        Ok(Self {
            scenario,
            resolved,
            ancestors,
            interactions,
            update,
            plans,
            results,
            watch,
            walls_arrive: true,
            measure,
            openings: Openings::new(scenario, Some(&record.openings)),
            writer,
            rows,
            snapshots,
            synced: 0,
            began: Instant::now(),
            steps_before: simulation.steps(),
            rows_due: Due::resume(scenario.output.timeseries, record.rows_due),
            checkpoints_due: keeper
                .plan()
                .and_then(|plan| plan.every)
                .map(|every| Due::resume(every, record.checkpoints_due)),
            keeper,
            pictures: PictureOptions::default(),
            status,
            leader: Leader::default(),
            steps_per_second: 0.0,
            output,
            simulation,
        })
    }

    /// Takes a checkpoint if one is due by the clock, or `asked` for.
    pub(super) fn checkpoint(&mut self, rules: &StageWatch<'_>, asked: bool) -> Result<(), RunError> {
        let Some(purpose) = self.keeper.due()?.or(asked.then_some(Purpose::Write)) else { return Ok(()) };
        self.hold(Some(rules))?;
        if asked || purpose == Purpose::Write {
            let files = self.unsynced();
            self.keeper.write_meanwhile(files)?;
        }
        Ok(())
    }

    /// The checkpoint of a run that the user stops.
    pub(super) fn last_checkpoint(&mut self, rules: &StageWatch<'_>) -> Result<(), RunError> {
        if self.keeper.plan().is_some() {
            self.hold(Some(rules))?;
            self.keeper.write_now(None)?;
        }
        Ok(())
    }

    /// Takes the present state as a checkpoint; without rules, between two stages.
    pub(super) fn hold(&mut self, rules: Option<&StageWatch<'_>>) -> Result<(), RunError> {
        let began = Instant::now();
        self.look(Look::Everything)?;
        let record = self.record(rules)?;
        self.take(record, began);
        Ok(())
    }

    fn record(&mut self, rules: Option<&StageWatch<'_>>) -> Result<RunRecord, RunError> {
        // A new field must be listed here: decide whether it changes anything that comes after the checkpoint.
        let Self {
            scenario: _,
            resolved: _,
            ancestors: _,
            simulation: _,
            interactions: _,
            update,
            plans,
            results,
            watch: _,
            walls_arrive: _,
            measure,
            openings,
            writer,
            rows: _,
            snapshots,
            output,
            synced: _,
            began: _,
            steps_before: _,
            rows_due,
            checkpoints_due,
            keeper: _,
            pictures: _,
            status: _,
            leader: _,
            steps_per_second: _,
        } = self;
        let series = writer.position()?;
        Ok(RunRecord {
            results: results.iter().map(StageResult::record).collect(),
            watch: rules.map(StageWatch::record),
            update: *update as u32,
            complete: false,
            time_steps: plans.iter().map(|plan| plan.time_step).collect(),
            rows_due: rows_due.count(),
            checkpoints_due: checkpoints_due.as_ref().map_or(0, Due::count),
            reference: measure.reference(),
            openings: openings.record(),
            // Those of a run that this one has branched from are among its ancestors.
            led_walls: Vec::new(),
            series: (series.bytes, series.hash),
            snapshots: snapshots.record()?,
            files: output.names().to_vec(),
        })
    }

    /// The files that a checkpoint knows of and that are not on the disk for certain.
    fn unsynced(&mut self) -> Vec<PathBuf> {
        let names = self.output.names();
        let mut grown = vec![LIST.to_owned(), TIME_SERIES.to_owned()];
        grown.extend(self.snapshots.growing());
        let files = names[self.synced.min(names.len())..].iter().chain(&grown);
        let files = files.map(|name| self.output.path().join(name)).collect();
        self.synced = names.len();
        files
    }

    /// The last checkpoint of a run that is complete.
    pub(super) fn end_checkpoint(&mut self) -> Result<(), RunError> {
        if self.keeper.plan().is_none() {
            return Ok(());
        }
        let record = RunRecord { complete: true, ..self.record(None)? };
        self.take(record, Instant::now());
        Ok(self.keeper.complete()?)
    }

    /// Takes the present state as a checkpoint, to which somebody has begun at a time.
    fn take(&mut self, record: RunRecord, began: Instant) {
        let (resolved, ancestors) = (self.resolved.clone(), self.ancestors.clone());
        let checkpoint = Checkpoint::new(resolved, ancestors, record, self.simulation.export_state());
        self.keeper.hold(checkpoint, began.elapsed());
    }
}
