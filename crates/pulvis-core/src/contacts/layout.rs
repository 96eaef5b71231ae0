//! Where the parts of a contact's memory stand among its columns.

use pulvis_contact::{ContactMemory, ContactModel, Memory, NormalLaw, NormalLawVisitor, resistance};
use pulvis_math::{F64Array, Simd8, Vector3};

/// Eight contacts at a time.
pub(crate) type F64x8 = F64Array<8>;

/// The columns of a group's contact memory: the normal law's, then those that the laws needs. A
/// sliding spring, which most contacts have, stands where the type of the normal law says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layout {
    touched: Option<usize>,
    sliding: Option<usize>,
    rolling: Option<usize>,
    torsion: Option<usize>,
    normal_columns: usize,
    columns: usize,
}

struct NormalColumns;

impl NormalLawVisitor for NormalColumns {
    type Output = usize;
    fn visit<N: NormalLaw>(self, _law: N) -> usize {
        <N::Memory<f64> as Memory<f64>>::COLUMNS
    }
}

impl Layout {
    /// The columns that contacts of `model` need.
    pub(crate) fn of(model: &ContactModel) -> Self {
        let normal_columns = model.normal.accept(NormalColumns);
        let mut columns = normal_columns;
        let mut index = |needed: bool, width: usize| {
            needed.then(|| {
                columns += width;
                columns - width
            })
        };
        let laws = &model.laws;
        let sliding = index(laws.sliding.is_some(), 3);
        let rolling = index(laws.rolling.is_some(), 3);
        let torsion = index(laws.torsion.is_some(), 1);
        let touched = index(laws.noncontact.remembers_touch(), 1);
        Self { touched, sliding, rolling, torsion, normal_columns, columns }
    }

    /// Number of columns.
    #[inline(always)]
    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    /// The memory of one lane of a block.
    pub(crate) fn load_one<M: Memory<f64>>(&self, columns: &[F64x8], lane: usize) -> ContactMemory<f64, M> {
        let number = |index: Option<usize>| index.map_or(0.0, |index| columns[index].0[lane]);
        let vector = |index: Option<usize>| {
            let along = |axis: usize| number(index.map(|index| index + axis));
            Vector3::new(along(0), along(1), along(2))
        };
        ContactMemory {
            normal: M::load(|column| columns[column].0[lane]),
            touched: number(self.touched),
            sliding: vector(self.sliding),
            rolling: vector(self.rolling),
            torsion: number(self.torsion),
        }
    }

    /// Where contacts of a level of resistance (see [`resistance`]) keep their sliding spring.
    #[inline(always)]
    fn sliding<const RESISTANCE: u8>(&self, normal_columns: usize) -> Option<usize> {
        match RESISTANCE {
            resistance::NONE => None,
            resistance::SLIDING => Some(normal_columns),
            _ => self.sliding,
        }
    }

    /// The memory of a block of contacts of a level of resistance, read from its columns.
    #[inline(always)]
    pub(crate) fn load<R: Simd8, M: Memory<R>, const RESISTANCE: u8>(
        &self,
        columns: &[F64x8],
    ) -> ContactMemory<R, M> {
        debug_assert!(columns.len() == self.columns && self.normal_columns == M::COLUMNS);
        let mut memory = ContactMemory {
            normal: M::load(|column| R::load(&columns[column])),
            touched: load_number(self.touched, columns),
            sliding: load_vector(self.sliding::<RESISTANCE>(M::COLUMNS), columns),
            rolling: Vector3::zero(),
            torsion: R::zero(),
        };
        if RESISTANCE == resistance::ALL {
            memory.rolling = load_vector(self.rolling, columns);
            memory.torsion = load_number(self.torsion, columns);
        }
        memory
    }

    /// The memory of a block, written into its columns.
    #[inline(always)]
    pub(crate) fn store<R: Simd8, M: Memory<R>, const RESISTANCE: u8>(
        &self,
        memory: &ContactMemory<R, M>,
        columns: &mut [F64x8],
    ) {
        memory.normal.store(|column, value| value.store(&mut columns[column]));
        store_number(self.touched, memory.touched, columns);
        store_vector(self.sliding::<RESISTANCE>(M::COLUMNS), memory.sliding, columns);
        if RESISTANCE == resistance::ALL {
            store_vector(self.rolling, memory.rolling, columns);
            store_number(self.torsion, memory.torsion, columns);
        }
    }

    /// The columns of this layout filled from a contact remembered in another one: what both laws
    /// keep survives a switch of laws, what only the old one kept is forgotten.
    pub(crate) fn translate(&self, from: &Layout, record: &[f64], same_normal_law: bool) -> Vec<f64> {
        let mut translated = vec![0.0; self.columns];
        let mut copy = |to: Option<usize>, from: Option<usize>, width: usize| {
            if let (Some(to), Some(from)) = (to, from) {
                translated[to..to + width].copy_from_slice(&record[from..from + width]);
            }
        };
        if same_normal_law {
            copy(Some(0), Some(0), self.normal_columns);
        }
        copy(self.touched, from.touched, 1);
        copy(self.sliding, from.sliding, 3);
        copy(self.rolling, from.rolling, 3);
        copy(self.torsion, from.torsion, 1);
        translated
    }
}

#[inline(always)]
fn load_number<R: Simd8>(index: Option<usize>, columns: &[F64x8]) -> R {
    match index {
        Some(index) => R::load(&columns[index]),
        None => R::zero(),
    }
}

#[inline(always)]
fn load_vector<R: Simd8>(index: Option<usize>, columns: &[F64x8]) -> Vector3<R> {
    match index {
        Some(index) => {
            let [x, y, z] = [&columns[index], &columns[index + 1], &columns[index + 2]];
            Vector3::new(R::load(x), R::load(y), R::load(z))
        }
        None => Vector3::zero(),
    }
}

#[inline(always)]
fn store_number<R: Simd8>(index: Option<usize>, value: R, columns: &mut [F64x8]) {
    if let Some(index) = index {
        value.store(&mut columns[index]);
    }
}

#[inline(always)]
fn store_vector<R: Simd8>(index: Option<usize>, value: Vector3<R>, columns: &mut [F64x8]) {
    if let Some(index) = index {
        value.x.store(&mut columns[index]);
        value.y.store(&mut columns[index + 1]);
        value.z.store(&mut columns[index + 2]);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_contact::normal::LudingMemory;
    use pulvis_contact::{ContactModel, Linear, Luding, SpringSlider};

    use super::*;

    fn luding() -> Luding {
        Luding {
            k1: 1.0,
            kp: 2.0,
            kc: 1.0,
            phi_f: 0.1,
            interpolation: pulvis_contact::normal::Interpolation::Linear,
        }
    }

    #[test]
    fn a_switch_of_laws_keeps_what_both_remember() {
        let slider =
            SpringSlider { stiffness: 1.0, dashpot: 0.0, dynamic_coefficient: 1.0, static_coefficient: 1.0 };
        let mut full = ContactModel::frictionless(luding());
        full.laws.sliding = Some(slider);
        full.laws.torsion = Some(slider);
        let mut sliding_only = ContactModel::frictionless(luding());
        sliding_only.laws.sliding = Some(slider);
        let (full, sliding_only) = (Layout::of(&full), Layout::of(&sliding_only));
        assert_eq!(full.columns(), 5);
        let record = [9.0, 1.0, 2.0, 3.0, 7.0];
        assert_eq!(sliding_only.translate(&full, &record, true), [9.0, 1.0, 2.0, 3.0]);
        assert_eq!(full.translate(&sliding_only, &record[..4], true), [9.0, 1.0, 2.0, 3.0, 0.0]);
        let elastic = Layout::of(&ContactModel::frictionless(Linear::new(1.0, 0.0)));
        assert_eq!(elastic.translate(&full, &record, false), [0.0; 0]);
    }

    #[test]
    fn what_is_stored_is_what_is_loaded() {
        let mut model = ContactModel::frictionless(luding());
        model.laws.sliding = Some(SpringSlider {
            stiffness: 1.0,
            dashpot: 0.0,
            dynamic_coefficient: 1.0,
            static_coefficient: 1.0,
        });
        let layout = Layout::of(&model);
        let columns: Vec<F64x8> = (0..4).map(|column| F64x8::from([f64::from(column); 8])).collect();
        let memory = layout.load::<F64x8, LudingMemory<F64x8>, { resistance::SLIDING }>(&columns);
        let mut copy = vec![F64x8::default(); 4];
        layout.store::<_, _, { resistance::SLIDING }>(&memory, &mut copy);
        assert_eq!(copy, columns);
    }
}
