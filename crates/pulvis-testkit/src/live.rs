//! A contact whose normal law is known at run time only.

use pulvis_contact::{
    ContactKinematics, ContactLaws, ContactMemory, ContactModel, ContactResponse, NormalLaw,
    NormalLawVisitor, Pair, resistance,
};
use pulvis_math::Vector3;

/// The springs of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Springs {
    /// Sliding spring [m].
    pub sliding: Vector3,
    /// Rolling spring [m].
    pub rolling: Vector3,
    /// Torsion spring along the line of centres [m].
    pub torsion: f64,
    /// 1 where the pair has touched since it was last out of reach.
    pub touched: f64,
}

/// A contact with its memory.
pub trait AnyContact {
    /// Forces, torques and energies after the step of `time_step` [s] that led to `motion`.
    fn respond(&mut self, motion: &ContactKinematics<f64>, time_step: f64) -> ContactResponse<f64>;
    /// The springs.
    fn springs(&self) -> Springs;
}

/// A virgin contact of `model` between the bodies of `pair`.
pub fn contact(model: &ContactModel, pair: Pair) -> Box<dyn AnyContact> {
    model.normal.accept(Boxed { laws: model.laws, pair })
}

struct Boxed {
    laws: ContactLaws,
    pair: Pair,
}

impl NormalLawVisitor for Boxed {
    type Output = Box<dyn AnyContact>;
    fn visit<N: NormalLaw>(self, law: N) -> Box<dyn AnyContact> {
        Box::new(Live { law, laws: self.laws, pair: self.pair, memory: ContactMemory::default() })
    }
}

struct Live<N: NormalLaw> {
    law: N,
    laws: ContactLaws,
    pair: Pair,
    memory: ContactMemory<f64, N::Memory<f64>>,
}

impl<N: NormalLaw> AnyContact for Live<N> {
    fn respond(&mut self, motion: &ContactKinematics<f64>, time_step: f64) -> ContactResponse<f64> {
        let Self { law, laws, pair, memory } = self;
        match laws.resistance_level() {
            resistance::NONE => {
                laws.respond::<f64, N, { resistance::NONE }>(law, pair, motion, time_step, memory)
            }
            resistance::SLIDING => {
                laws.respond::<f64, N, { resistance::SLIDING }>(law, pair, motion, time_step, memory)
            }
            _ => laws.respond::<f64, N, { resistance::ALL }>(law, pair, motion, time_step, memory),
        }
    }

    fn springs(&self) -> Springs {
        let ContactMemory { touched, sliding, rolling, torsion, .. } = self.memory;
        Springs { sliding, rolling, torsion, touched }
    }
}
