//! A contact with its memory.

use pulvis_contact::catalogue::Role;
use pulvis_contact::{ContactKinematics, ContactModel, ContactResponse, Friction, MemoryLayout, Pair};
use pulvis_math::Vector3;

/// What the laws against sliding, rolling and torsion remember as vectors of the tangent plane and as a number along
/// the line of centres: the stretch of a spring [m], or its force [N].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Springs {
    /// Of sliding.
    pub sliding: Vector3,
    /// Of rolling.
    pub rolling: Vector3,
    /// Of torsion, along the line of centres.
    pub torsion: f64,
    /// Of the bond against shear [m].
    pub bond_shear: Vector3,
    /// Of the bond against bending [rad].
    pub bond_bending: Vector3,
    /// Of the bond against torsion, along the line of centres [rad].
    pub bond_twist: f64,
}

/// A contact of any laws between two bodies, with its memory.
#[derive(Clone, Debug)]
pub struct LiveContact {
    model: ContactModel,
    pair: Pair,
    layout: MemoryLayout,
    columns: Vec<f64>,
    started: bool,
}

impl LiveContact {
    /// A virgin contact of `model` between the bodies of `pair`. A bond that forms at the start of a stage does so where the
    /// contact is asked first.
    pub fn new(model: &ContactModel, pair: Pair) -> Self {
        let layout = model.memory_layout();
        Self { model: *model, pair, layout, columns: vec![0.0; layout.columns()], started: false }
    }

    /// Forces, torques and energies after the step of `time_step` [s] that led to `motion`.
    pub fn respond(&mut self, motion: &ContactKinematics<f64>, time_step: f64) -> ContactResponse<f64> {
        if !self.started {
            self.model.form_bond(motion.overlap, &mut self.columns);
            self.started = true;
        }
        self.model.respond(&self.pair, motion, time_step, &mut self.columns)
    }

    /// The memory.
    pub fn columns(&self) -> &[f64] {
        &self.columns
    }

    /// The column with this name (without its unit).
    pub fn column(&self, name: &str) -> Option<f64> {
        self.layout.column(name).map(|column| self.columns[column])
    }

    /// The first column of a friction law.
    fn start(&self, law: &Option<Friction>, role: Role) -> Option<usize> {
        let name = law.as_ref()?.entry(role)?.memory.first()?;
        self.layout.names().position(|known| known == *name)
    }

    fn vector(&self, start: Option<usize>) -> Vector3 {
        let at = |offset: usize| start.map_or(0.0, |start| self.columns[start + offset]);
        Vector3::new(at(0), at(1), at(2))
    }

    fn starts(&self) -> [Option<usize>; 3] {
        let laws = &self.model.laws;
        [
            self.start(&laws.sliding, Role::Sliding),
            self.start(&laws.rolling, Role::Rolling),
            self.start(&laws.torsion, Role::Torsion),
        ]
    }

    /// The first column of the bond: shear (3), bending (3), twist.
    fn bond_start(&self) -> Option<usize> {
        self.layout.column("bond_shear_x")
    }

    /// The springs.
    pub fn springs(&self) -> Springs {
        let [sliding, rolling, torsion] = self.starts();
        Springs {
            sliding: self.vector(sliding),
            rolling: self.vector(rolling),
            torsion: torsion.map_or(0.0, |start| self.columns[start]),
            bond_shear: self.vector(self.bond_start()),
            bond_bending: self.vector(self.bond_start().map(|start| start + 3)),
            bond_twist: self.bond_start().map_or(0.0, |start| self.columns[start + 6]),
        }
    }

    /// The columns that belong to no spring: they look the same from everywhere.
    pub fn scalars(&self) -> Vec<f64> {
        let [sliding, rolling, torsion] = self.starts();
        let in_springs = |column: usize| {
            [sliding, rolling].into_iter().flatten().any(|start| (start..start + 3).contains(&column))
                || torsion == Some(column)
                || self.bond_start().is_some_and(|start| (start..start + 7).contains(&column))
        };
        let all = self.columns.iter().enumerate();
        all.filter(|(column, _)| !in_springs(*column)).map(|(_, value)| *value).collect()
    }
}
