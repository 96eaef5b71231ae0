//! Rows of the time series that a run keeps in memory, for its pictures.

use pulvis_math::max_or_nan;

/// Rows up to which all are kept: more than a picture has columns of pixels, and some ten megabytes.
const MOST: usize = 32_768;

/// The rows so far; of very many every second, every fourth and so on, so that a run of any length takes no more memory. Which
/// ones follows from their number alone, so that a resumed run keeps the same.
#[derive(Clone, Debug)]
pub(super) struct KeptRows {
    rows: Vec<Vec<f64>>,
    /// Every so many rows are kept.
    stride: u64,
    count: u64,
    /// The column of the relative error of the ledger.
    error_column: usize,
    /// The largest relative error of all rows.
    largest_error: f64,
}

impl KeptRows {
    /// None yet; `error_column` is that of the relative error of the ledger.
    pub(super) fn new(error_column: usize) -> Self {
        Self { rows: Vec::new(), stride: 1, count: 0, error_column, largest_error: 0.0 }
    }

    /// Takes a row in.
    pub(super) fn push(&mut self, row: Vec<f64>) {
        self.largest_error = max_or_nan(self.largest_error, row[self.error_column].abs());
        if self.count.is_multiple_of(self.stride) {
            self.rows.push(row);
        }
        self.count += 1;
        if self.rows.len() > MOST {
            let mut place = 0;
            self.rows.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            self.stride *= 2;
        }
    }

    /// Those that are kept.
    pub(super) fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// The largest relative error of the ledger among all rows, those that are not kept included [1].
    pub(super) fn largest_error(&self) -> f64 {
        self.largest_error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_rows_are_all_kept_and_of_many_evenly_some_with_the_largest_error_of_all() {
        let mut kept = KeptRows::new(1);
        let many = 5 * MOST + 3;
        for number in 0..many {
            let error = if number == 12_345 { -7e-3 } else { 1e-6 };
            kept.push(vec![number as f64, error]);
            if number < MOST {
                assert_eq!(kept.rows().len(), number + 1);
            }
        }
        assert_eq!(kept.largest_error(), 7e-3);
        assert!((MOST / 2..=MOST).contains(&kept.rows().len()), "{}", kept.rows().len());
        let steps: Vec<f64> = kept.rows().windows(2).map(|two| two[1][0] - two[0][0]).collect();
        assert!(kept.rows()[0][0] == 0.0 && steps.iter().all(|step| *step == 8.0));
        kept.push(vec![0.0, f64::NAN]);
        assert!(kept.largest_error().is_nan());
    }
}
