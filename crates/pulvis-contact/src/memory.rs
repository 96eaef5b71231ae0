//! What contacts remember, as plain named columns of numbers.

use pulvis_math::{Real, Vector3};

use crate::levels;

/// What a law of a contact remembers between time steps, as plain columns of numbers. All columns of a contact
/// that begins are zero.
///
/// A law puts its columns back to zero when it forgets. The engine keeps them from list to list as long as any is
/// not zero, and asks the law once more in the step in which the bodies leave its range.
pub trait Memory<R: Real>: Copy + Default + std::fmt::Debug {
    /// Number of columns.
    const COLUMNS: usize;
    /// The memory read from its columns.
    fn load(column: impl FnMut(usize) -> R) -> Self;
    /// The memory written into its columns.
    fn store(&self, column: impl FnMut(usize, R));
}

/// The memory of a law that has none.
impl<R: Real> Memory<R> for () {
    const COLUMNS: usize = 0;
    #[inline(always)]
    fn load(_column: impl FnMut(usize) -> R) -> Self {}
    #[inline(always)]
    fn store(&self, _column: impl FnMut(usize, R)) {}
}

/// The memory of a law that keeps one number.
impl<R: Real> Memory<R> for [R; 1] {
    const COLUMNS: usize = 1;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        [column(0)]
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self[0]);
    }
}

/// The memory of one contact, or of eight side by side, by the numbers of its columns.
pub trait Columns<R: Real> {
    /// The value of a column.
    fn get(&self, column: usize) -> R;
    /// Sets the value of a column.
    fn set(&mut self, column: usize, value: R);
}

impl<R: Real> Columns<R> for [R] {
    #[inline(always)]
    fn get(&self, column: usize) -> R {
        self[column]
    }
    #[inline(always)]
    fn set(&mut self, column: usize, value: R) {
        self[column] = value;
    }
}

/// A law's memory, from the column `start` on.
#[inline(always)]
pub(crate) fn load<R: Real, M: Memory<R>>(columns: &(impl Columns<R> + ?Sized), start: usize) -> M {
    M::load(|column| columns.get(start + column))
}

/// Writes a law's memory, from the column `start` on.
#[inline(always)]
pub(crate) fn store<R: Real, M: Memory<R>>(
    memory: &M,
    columns: &mut (impl Columns<R> + ?Sized),
    start: usize,
) {
    memory.store(|column, value| columns.set(start + column, value));
}

/// Three columns, from `start` on.
#[inline(always)]
pub(crate) fn load_vector<R: Real>(columns: &(impl Columns<R> + ?Sized), start: usize) -> Vector3<R> {
    Vector3::new(columns.get(start), columns.get(start + 1), columns.get(start + 2))
}

/// Writes three columns, from `start` on.
#[inline(always)]
pub(crate) fn store_vector<R: Real>(
    vector: Vector3<R>,
    columns: &mut (impl Columns<R> + ?Sized),
    start: usize,
) {
    columns.set(start, vector.x);
    columns.set(start + 1, vector.y);
    columns.set(start + 2, vector.z);
}

/// Where the laws of a contact keep their columns: those of the normal law first, then those of sliding, rolling,
/// torsion, attraction and bond, as far as there are such laws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemorySlots {
    pub(crate) normal_columns: usize,
    pub(crate) sliding: usize,
    pub(crate) rolling: usize,
    pub(crate) torsion: usize,
    pub(crate) attraction: usize,
    pub(crate) bond: usize,
    columns: usize,
}

impl MemorySlots {
    /// Number of columns.
    #[inline(always)]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of columns of the normal law, which come first.
    #[inline(always)]
    pub fn normal_columns(&self) -> usize {
        self.normal_columns
    }

    /// First column of the attraction.
    #[inline(always)]
    pub fn attraction(&self) -> usize {
        self.attraction
    }

    /// First column of the bond.
    #[inline(always)]
    pub fn bond(&self) -> usize {
        self.bond
    }

    /// First column of sliding. At the level of sliding alone it stands where the number of columns of the normal
    /// law says, which is known at compile time where the law is.
    #[inline(always)]
    pub(crate) fn sliding<const RESISTANCE: u8>(&self, normal_columns: Option<usize>) -> usize {
        match normal_columns {
            Some(columns) if RESISTANCE == levels::SLIDING => columns,
            _ => self.sliding,
        }
    }
}

/// The columns of a part of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Part {
    /// Name of the law that they belong to.
    law: &'static str,
    /// Their names with units.
    columns: &'static [&'static str],
}

/// Parts of a contact that may remember something.
const PARTS: usize = 6;

/// The columns of a contact model: where they stand, what they are called, and whose they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryLayout {
    slots: MemorySlots,
    /// Normal law, sliding, rolling, torsion, attraction, bond.
    parts: [Part; PARTS],
}

impl MemoryLayout {
    /// Columns of the laws in the order of [`MemorySlots`], each a law's name and its columns' names with units.
    pub(crate) fn new(parts: [(&'static str, &'static [&'static str]); PARTS]) -> Self {
        let mut starts = [0; PARTS];
        let mut columns = 0;
        for (start, (_, part)) in starts.iter_mut().zip(&parts) {
            *start = columns;
            columns += part.len();
        }
        let [_, sliding, rolling, torsion, attraction, bond] = starts;
        let normal_columns = parts[0].1.len();
        Self {
            slots: MemorySlots { normal_columns, sliding, rolling, torsion, attraction, bond, columns },
            parts: parts.map(|(law, columns)| Part { law, columns }),
        }
    }

    /// Where the columns stand.
    #[inline(always)]
    pub fn slots(&self) -> &MemorySlots {
        &self.slots
    }

    /// Number of columns.
    #[inline(always)]
    pub fn columns(&self) -> usize {
        self.slots.columns
    }

    /// The names of all columns with their units, `overlap_max [m]`, in order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.parts.into_iter().flat_map(|part| part.columns).copied()
    }

    /// The names of the laws that the columns belong to, column by column.
    pub fn laws(&self) -> impl Iterator<Item = &'static str> + use<> {
        self.parts.into_iter().flat_map(|part| part.columns.iter().map(move |_| part.law))
    }

    /// The number of the column with this name (without its unit).
    pub fn column(&self, name: &str) -> Option<usize> {
        self.names().position(|known| known.split(' ').next() == Some(name))
    }

    /// The columns of this layout filled from a contact remembered in another one: what the same law kept survives
    /// a switch of laws, the rest is forgotten.
    pub fn translate(&self, from: &Self, record: &[f64]) -> Vec<f64> {
        let mut translated = vec![0.0; self.columns()];
        let (mut to, mut source) = (0, 0);
        for (part, before) in self.parts.iter().zip(&from.parts) {
            let (width, width_before) = (part.columns.len(), before.columns.len());
            if part == before {
                translated[to..to + width].copy_from_slice(&record[source..source + width_before]);
            }
            to += width;
            source += width_before;
        }
        translated
    }
}
