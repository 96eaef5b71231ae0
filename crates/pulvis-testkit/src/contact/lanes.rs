//! One text of the whole contact serves a number and several numbers.

use pulvis_contact::normal::{CommonLawVisitor, Inlined};
use pulvis_contact::{
    ContactInputs, ContactKinematics, ContactModel, ContactResponse, NormalLaw, Pair, ROOM_TEMPERATURE,
    levels,
};
use pulvis_math::{Real, Vector3};

use super::Dance;
use crate::bodies::pair_motion;
use crate::draw::Draw;
use crate::lanes::{LANES, Lanes};

const STEPS: usize = 40;

pub(super) fn lanes_give_the_bits_of_the_plain_number(model: &ContactModel, draw: &mut Draw) {
    let mut dances: Vec<Dance> = (0..LANES).map(|_| Dance::random(model, draw)).collect();
    let wall = draw.chance(0.5);
    // One time step for all.
    let duration = dances[0].duration;
    dances.iter_mut().for_each(|dance| dance.duration = duration);
    let pairs = Pair::<Lanes>::from_fn(|lane| dances[lane].pair);
    let dt = duration / STEPS as f64;
    let columns = model.memory_layout().columns();
    let mut memory = vec![Lanes::zero(); columns];
    let mut inlined_memory = memory.clone();
    let mut memories = vec![vec![0.0; columns]; LANES];
    for step in 0..=STEPS {
        let motions: Vec<_> =
            dances.iter().enumerate().map(|(lane, dance)| motion(dance, step, lane, wall)).collect();
        let kinematics = gathered(&motions);
        if step == 0 {
            for (lane, alone) in memories.iter_mut().enumerate() {
                model.form_bond(motions[lane].overlap, alone);
                for (column, value) in memory.iter_mut().zip(alone) {
                    column.0[lane] = *value;
                }
            }
        }
        let together = model.respond(&pairs, &kinematics, dt, &mut memory);
        let inputs =
            ContactInputs { pair: &pairs, motion: &kinematics, time_step: dt, temperature: ROOM_TEMPERATURE };
        let of_loop = InLoop { model, inputs, columns: &mut inlined_memory };
        let of_loop = if model.is_common() { model.normal.accept_common(of_loop) } else { None };
        for lane in 0..LANES {
            let alone = model.respond(&dances[lane].pair, &motions[lane], dt, &mut memories[lane]);
            assert_eq!(numbers(&together, lane), numbers(&alone, 0), "{model:?} {alone:?}");
            assert_eq!(state(&memory, lane), state(&memories[lane], 0), "{model:?}");
            if let Some(of_loop) = &of_loop {
                let [found, expected] =
                    [numbers(of_loop, lane), numbers(&alone, 0)].map(without_signs_of_zeros);
                assert_eq!(found, expected, "inlined: {model:?} {alone:?}");
                assert_eq!(state(&inlined_memory, lane), state(&memories[lane], 0), "inlined: {model:?}");
            }
        }
    }
}

fn motion(dance: &Dance, step: usize, lane: usize, wall: bool) -> ContactKinematics<f64> {
    let [i, j] = dance.step(step, STEPS);
    let mut motion = pair_motion(dance.radius_i, &i, Some((dance.radius_j, &j)));
    if wall && lane == LANES - 1 {
        // A wall beside pairs.
        (motion.inverse_distance, motion.radius_j) = (0.0, 0.0);
    }
    motion
}

/// The answer as the engine's loops for common contacts compute it.
struct InLoop<'a> {
    model: &'a ContactModel,
    inputs: ContactInputs<'a, Lanes>,
    columns: &'a mut [Lanes],
}

impl CommonLawVisitor for InLoop<'_> {
    type Output = ContactResponse<Lanes>;
    fn visit<N: NormalLaw>(self, law: N) -> ContactResponse<Lanes> {
        let Self { model, inputs, columns } = self;
        let (laws, law, layout) = (model.laws, Inlined(law), model.memory_layout());
        let slots = layout.slots();
        match laws.resistance_level() {
            levels::NONE => laws.respond::<_, _, _, { levels::NONE }>(&law, slots, inputs, columns),
            levels::SLIDING => laws.respond::<_, _, _, { levels::SLIDING }>(&law, slots, inputs, columns),
            _ => laws.respond::<_, _, _, { levels::ALL }>(&law, slots, inputs, columns),
        }
    }
}

fn gathered(motions: &[ContactKinematics<f64>]) -> ContactKinematics<Lanes> {
    let number = |of: fn(&ContactKinematics<f64>) -> f64| Lanes::from_fn(|lane| of(&motions[lane]));
    let vector = |of: fn(&ContactKinematics<f64>) -> Vector3| {
        Vector3::new(
            Lanes::from_fn(|lane| of(&motions[lane]).x),
            Lanes::from_fn(|lane| of(&motions[lane]).y),
            Lanes::from_fn(|lane| of(&motions[lane]).z),
        )
    };
    ContactKinematics {
        normal: vector(|motion| motion.normal),
        overlap: number(|motion| motion.overlap),
        inverse_distance: number(|motion| motion.inverse_distance),
        normal_rate: None,
        radius_i: number(|motion| motion.radius_i),
        radius_j: number(|motion| motion.radius_j),
        velocity: vector(|motion| motion.velocity),
        velocity_mid: vector(|motion| motion.velocity_mid),
        angular_velocity_i: vector(|motion| motion.angular_velocity_i),
        angular_velocity_j: vector(|motion| motion.angular_velocity_j),
        angular_velocity_i_mid: vector(|motion| motion.angular_velocity_i_mid),
        angular_velocity_j_mid: vector(|motion| motion.angular_velocity_j_mid),
    }
}

fn numbers<R: Real>(answer: &ContactResponse<R>, lane: usize) -> Vec<u64> {
    let mut all = vec![answer.normal_force];
    for vector in [answer.force, answer.torque_i, answer.torque_j] {
        all.extend([vector.x, vector.y, vector.z]);
    }
    all.extend(answer.energies.accounts().map(|(_, energy)| energy));
    all.into_iter().map(|number| number.lane(lane).to_bits()).collect()
}

/// A law that is compiled into its loop may give −0 where it gives 0 otherwise: sums begin with 0, and 0 + (−0) is 0.
fn without_signs_of_zeros(bits: Vec<u64>) -> Vec<u64> {
    const MINUS_ZERO: u64 = 1 << 63;
    bits.into_iter().map(|bits| if bits == MINUS_ZERO { 0 } else { bits }).collect()
}

fn state<R: Real>(columns: &[R], lane: usize) -> Vec<u64> {
    columns.iter().map(|column| column.lane(lane).to_bits()).collect()
}
