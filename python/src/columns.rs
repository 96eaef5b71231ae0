//! Tables as dictionaries of columns.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pulvis_io::table::{Cell, Table};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Columns that hold words, also where every cell is empty.
const WORDS: [&str; 4] = ["regime", "stop_branch", "branch", "contact"];

/// The columns of a table by their names: numbers as arrays, NaN where there is nothing; words as a list of the words that
/// occur and an array of indices into it.
pub fn of_table<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    for (number, name) in table.columns().iter().enumerate() {
        let cells = || table.rows().iter().filter_map(|row| row.get(number));
        if WORDS.contains(&name.as_str()) {
            columns.set_item(name, words(py, cells())?)?;
        } else {
            columns.set_item(name, PyArray1::from_iter(py, cells().map(number_in)))?;
        }
    }
    Ok(columns)
}

fn number_in(cell: &Cell) -> f64 {
    match cell {
        Cell::Number(number) => *number,
        Cell::Text(_) | Cell::Empty => f64::NAN,
    }
}

/// Words that occur, in the order of their first use, and the index of each cell's word.
fn words<'py, 't>(
    py: Python<'py>,
    cells: impl Iterator<Item = &'t Cell>,
) -> PyResult<(Bound<'py, PyList>, Bound<'py, PyArray1<u32>>)> {
    let mut known: Vec<&str> = Vec::new();
    let mut indices: Vec<u32> = Vec::new();
    for cell in cells {
        let word = match cell {
            Cell::Text(text) => text.as_str(),
            Cell::Number(_) | Cell::Empty => "",
        };
        let index = known.iter().position(|known| *known == word).unwrap_or_else(|| {
            known.push(word);
            known.len() - 1
        });
        indices.push(index as u32);
    }
    Ok((PyList::new(py, known)?, PyArray1::from_vec(py, indices)))
}

/// Vectors as an array of three columns.
pub fn vectors<'py>(
    py: Python<'py>,
    vectors: impl Iterator<Item = [f64; 3]>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = vectors.flatten().collect();
    let rows = flat.len() / 3;
    PyArray1::from_vec(py, flat).reshape([rows, 3])
}
