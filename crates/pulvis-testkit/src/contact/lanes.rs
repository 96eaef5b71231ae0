//! One text of the whole contact serves a number and eight numbers.

use pulvis_contact::{
    ContactKinematics, ContactLaws, ContactMemory, ContactModel, ContactResponse, Memory, NormalLaw,
    NormalLawVisitor, Pair, resistance,
};
use pulvis_math::{F64Array, Real, Vector3};

use super::Dance;
use crate::bodies::pair_motion;
use crate::draw::Draw;

type Eight = F64Array<8>;

const STEPS: usize = 40;

pub(super) fn lanes_give_the_bits_of_the_plain_number(model: &ContactModel, draw: &mut Draw) {
    let mut dances: Vec<Dance> = (0..8).map(|_| Dance::random(model, draw)).collect();
    // One time step for all.
    let duration = dances[0].duration;
    dances.iter_mut().for_each(|dance| dance.duration = duration);
    model.normal.accept(Suite { laws: model.laws, dances });
}

struct Suite {
    laws: ContactLaws,
    dances: Vec<Dance>,
}

impl NormalLawVisitor for Suite {
    type Output = ();
    fn visit<N: NormalLaw>(self, law: N) {
        let Self { laws, dances } = self;
        let pairs = Pair::<Eight>::from_fn(|lane| dances[lane].pair);
        let dt = dances[0].duration / STEPS as f64;
        let mut memory = ContactMemory::<Eight, N::Memory<Eight>>::default();
        let mut memories = [ContactMemory::<f64, N::Memory<f64>>::default(); 8];
        for step in 0..=STEPS {
            let motions: Vec<ContactKinematics<f64>> = dances
                .iter()
                .enumerate()
                .map(|(lane, dance)| {
                    let [i, j] = dance.step(step, STEPS);
                    let mut motion = pair_motion(dance.radius_i, &i, Some((dance.radius_j, &j)));
                    if lane == 7 {
                        // One wall among the pairs.
                        (motion.inverse_distance, motion.radius_j) = (0.0, 0.0);
                    }
                    motion
                })
                .collect();
            let together = laws.respond::<Eight, N, { resistance::ALL }>(
                &law,
                &pairs,
                &gathered(&motions),
                dt,
                &mut memory,
            );
            for lane in 0..8 {
                let alone = laws.respond::<f64, N, { resistance::ALL }>(
                    &law,
                    &dances[lane].pair,
                    &motions[lane],
                    dt,
                    &mut memories[lane],
                );
                assert_eq!(numbers(&together, lane), numbers(&alone, 0), "{law:?} {laws:?} {alone:?}");
                assert_eq!(state(&memory, lane), state(&memories[lane], 0), "{law:?} {laws:?}");
            }
        }
    }
}

fn gathered(motions: &[ContactKinematics<f64>]) -> ContactKinematics<Eight> {
    let number = |of: fn(&ContactKinematics<f64>) -> f64| Eight::from_fn(|lane| of(&motions[lane]));
    let vector = |of: fn(&ContactKinematics<f64>) -> Vector3| {
        Vector3::new(
            Eight::from_fn(|lane| of(&motions[lane]).x),
            Eight::from_fn(|lane| of(&motions[lane]).y),
            Eight::from_fn(|lane| of(&motions[lane]).z),
        )
    };
    ContactKinematics {
        normal: vector(|motion| motion.normal),
        overlap: number(|motion| motion.overlap),
        inverse_distance: number(|motion| motion.inverse_distance),
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
    let e = &answer.energies;
    let mut all = vec![answer.normal_force];
    for vector in [answer.force, answer.torque_i, answer.torque_j] {
        all.extend([vector.x, vector.y, vector.z]);
    }
    all.extend([e.elastic_normal, e.elastic_sliding, e.elastic_rolling, e.elastic_torsion]);
    all.extend([e.adhesive_potential, e.dissipated_plastic, e.dissipated_adhesive, e.dissipated_sliding]);
    all.extend([e.dissipated_rolling, e.dissipated_torsion, e.viscous_power]);
    all.into_iter().map(|number| number.lane(lane).to_bits()).collect()
}

fn state<R: Real, M: Memory<R>>(memory: &ContactMemory<R, M>, lane: usize) -> Vec<u64> {
    let mut all = vec![memory.touched, memory.torsion];
    for vector in [memory.sliding, memory.rolling] {
        all.extend([vector.x, vector.y, vector.z]);
    }
    memory.normal.store(|_, column| all.push(column));
    all.into_iter().map(|number| number.lane(lane).to_bits()).collect()
}
