//! Averages of what observers have seen, stage by stage, with errors from blocks.

use pulvis_input::scenario::Scenario;
use pulvis_io::IoError;
use pulvis_io::table::{Cell, Table};

use super::observers::{ObservedColumn, columns};

/// The file of all averages.
pub(super) const AVERAGES: &str = "averages.json";

/// An average over the rows of a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Average {
    /// The observer.
    pub observer: String,
    /// The stage.
    pub stage: String,
    /// What was averaged.
    pub quantity: String,
    /// Its unit.
    pub unit: &'static str,
    /// Mean over all blocks.
    pub mean: f64,
    /// Standard error of the mean, from the scatter of the blocks; `None` of a single row.
    pub standard_error: Option<f64>,
    /// Number of blocks.
    pub blocks: usize,
    /// Number of rows in all blocks.
    pub rows: usize,
    /// Times of the first and the last row [s].
    pub times: [f64; 2],
}

/// The averages of all observers over all stages, out of the rows of a time series with these `names`. Rows at the start of
/// a stage, and within the time that an observer discards, are left out; so are the first rows of what remains, until the
/// rest makes blocks of one length. The standard error is √(Σ (b − mean)²/(B (B − 1))) over the means b of B blocks, which is
/// right where blocks are longer than what is seen remembers (Flyvbjerg, Petersen, J. Chem. Phys. 91, 461 (1989)).
pub(super) fn averages(scenario: &Scenario, names: &[String], rows: &[Vec<f64>]) -> Vec<Average> {
    let place = |name: &str| names.iter().position(|column| column == name);
    let [Some(step), Some(time), Some(stage)] = ["step", "time", "stage"].map(place) else {
        return Vec::new();
    };
    let mut averages = Vec::new();
    for observer in &scenario.observers {
        let columns = columns(scenario, observer);
        for (number, plan) in (1..).zip(&scenario.stages) {
            let of_stage = || rows.iter().filter(|row| row[stage] == f64::from(number));
            let Some(start) = of_stage().next().map(|row| row[time]) else { continue };
            let mut seen: Vec<&Vec<f64>> =
                of_stage().filter(|row| row[time] > start && row[time] >= start + observer.discard).collect();
            // A row at the end of a stage may be one at the interval, too.
            seen.dedup_by(|later, earlier| later[step] == earlier[step]);
            let blocks = observer.blocks.min(seen.len());
            if blocks == 0 {
                continue;
            }
            let length = seen.len() / blocks;
            let seen = seen.split_off(seen.len() - length * blocks);
            let times = [seen[0][time], seen[seen.len() - 1][time]];
            for ObservedColumn { quantity, unit, column } in &columns {
                let Some(column) = place(column) else { continue };
                let (mean, standard_error) = over_blocks(&seen, column, length);
                averages.push(Average {
                    observer: observer.name.clone(),
                    stage: plan.name.clone(),
                    quantity: quantity.clone(),
                    unit,
                    mean,
                    standard_error,
                    blocks,
                    rows: seen.len(),
                    times,
                });
            }
        }
    }
    averages
}

/// The mean of a column over blocks of a length, and its standard error.
fn over_blocks(rows: &[&Vec<f64>], column: usize, length: usize) -> (f64, Option<f64>) {
    let means: Vec<f64> = rows
        .chunks(length)
        .map(|block| block.iter().map(|row| row[column]).sum::<f64>() / length as f64)
        .collect();
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let squares: f64 = means.iter().map(|block| (block - mean) * (block - mean)).sum();
    (mean, (means.len() > 1).then(|| (squares / (count * (count - 1.0))).sqrt()))
}

/// All averages as a table.
pub(super) fn table(averages: &[Average]) -> Result<Table, IoError> {
    let mut table = Table::new([
        "observer",
        "stage",
        "quantity",
        "unit",
        "mean",
        "standard error",
        "blocks",
        "rows",
        "from [s]",
        "to [s]",
    ]);
    for average in averages {
        let Average { observer, stage, quantity, unit, mean, standard_error, blocks, rows, times } = average;
        table.push([
            Cell::from(observer.clone()),
            Cell::from(stage.clone()),
            Cell::from(quantity.clone()),
            Cell::from(*unit),
            Cell::from(*mean),
            Cell::from(*standard_error),
            Cell::from(*blocks as f64),
            Cell::from(*rows as f64),
            Cell::from(times[0]),
            Cell::from(times[1]),
        ])?;
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_blocks_is_that_of_the_text_book_and_grows_with_what_rows_remember() {
        // Means of blocks of two: 1, 3, 2, 6: mean 3, standard deviation √(14/3), error half of it.
        let rows: Vec<Vec<f64>> = [0.0, 2.0, 3.0, 3.0, 1.0, 3.0, 5.0, 7.0].map(|value| vec![value]).into();
        let rows: Vec<&Vec<f64>> = rows.iter().collect();
        let (mean, error) = over_blocks(&rows, 0, 2);
        assert_eq!(mean, 3.0);
        assert!(error.is_some_and(|error| (error - (14.0_f64 / 12.0).sqrt()).abs() < 1e-15), "{error:?}");
        assert_eq!(over_blocks(&rows[..1], 0, 1), (0.0, None));
    }
}
