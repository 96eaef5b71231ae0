//! Forces between all charges, summed pair by pair.
//!
//! Every particle sums over all charges itself, in the order of the rows: eight partial sums, one for each lane, are added
//! from the first lane to the last. This order depends on the scenario only, so that forces have the same bits for any number of
//! threads and of ranks and any instruction set. That computes each pair twice, and shares nothing but the positions.

use std::f64::consts::PI;
use std::ops::Range;

use pulvis_boundary::Electrostatics;
use pulvis_contact::noncontact::COULOMB_CONSTANT;
use pulvis_math::{F64Array, Kernel, Packed4, Simd8, Vector3};

use crate::particles::Particle;
use crate::time_step::{MotionKind, ShortestMotion};

/// The quantity of particles that is their charge [C].
pub(crate) const CHARGE: &str = "charge";

const LANES: usize = 8;

/// 1/(4 π ε_0 ε_r) [N m²/C²].
fn strength_in(electrostatics: &Electrostatics) -> f64 {
    COULOMB_CONSTANT / electrostatics.relative_permittivity
}

/// Eight charges and where they are. What is beyond the last one has no charge.
#[derive(Clone, Copy, Debug, Default)]
struct ChargeBlock {
    x: F64Array<LANES>,
    y: F64Array<LANES>,
    z: F64Array<LANES>,
    charge: F64Array<LANES>,
}

/// All particles that have a charge, in the order of their rows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Charges {
    rows: Vec<u32>,
    blocks: Vec<ChargeBlock>,
    /// 1/(4 π ε_0 ε_r) [N m²/C²].
    strength: f64,
}

impl Charges {
    /// Takes the charges [C] and centres of all rows.
    pub(crate) fn take_in(&mut self, electrostatics: &Electrostatics, charges: &[f64], centres: &[Packed4]) {
        self.strength = strength_in(electrostatics);
        self.rows.clear();
        self.blocks.clear();
        for (row, (&charge, centre)) in charges.iter().zip(centres).enumerate() {
            if charge == 0.0 {
                continue;
            }
            let lane = self.rows.len() % LANES;
            if lane == 0 {
                self.blocks.push(ChargeBlock::default());
            }
            if let Some(block) = self.blocks.last_mut() {
                let Vector3 { x, y, z } = centre.vector;
                (block.x.0[lane], block.y.0[lane], block.z.0[lane]) = (x, y, z);
                block.charge.0[lane] = charge;
            }
            self.rows.push(row as u32);
        }
    }

    /// The charges among some rows, by their places.
    fn places(&self, rows: &Range<usize>) -> Range<usize> {
        let place = |row: usize| self.rows.partition_point(|&known| (known as usize) < row);
        place(rows.start)..place(rows.end)
    }
}

/// The forces of all charges on those of some rows.
pub(crate) struct ForcesOfCharges<'a> {
    pub(crate) charges: &'a Charges,
    pub(crate) rows: Range<usize>,
    /// For these rows: force [N], and the potential energy with all other charges [J].
    pub(crate) forces: &'a mut [Packed4],
}

impl Kernel for ForcesOfCharges<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Simd8>(self) {
        let Self { charges: Charges { rows: charged, blocks, strength }, ref rows, .. } = self;
        self.forces.fill(Packed4::default());
        for place in self.charges.places(rows) {
            let (own, lane) = (&blocks[place / LANES], place % LANES);
            // No closure: it would be compiled without the instructions of `R`.
            let (x, y, z) = (R::splat(own.x.0[lane]), R::splat(own.y.0[lane]), R::splat(own.z.0[lane]));
            let [mut field_x, mut field_y, mut field_z, mut potential] = [R::zero(); 4];
            for block in blocks {
                let (dx, dy, dz) = (x - R::load(&block.x), y - R::load(&block.y), z - R::load(&block.z));
                let square = dx * dx + dy * dy + dz * dz;
                // A charge does not act on itself.
                let inverse = (R::one() / square.sqrt()).keep_where(square.gt(R::zero()));
                let one_potential = R::load(&block.charge) * inverse;
                let one_field = one_potential * (inverse * inverse);
                field_x += dx * one_field;
                field_y += dy * one_field;
                field_z += dz * one_field;
                potential += one_potential;
            }
            let strength = strength * own.charge.0[lane];
            let field = Vector3::new(field_x.sum_lanes(), field_y.sum_lanes(), field_z.sum_lanes());
            self.forces[charged[place] as usize - rows.start] =
                Packed4::new(field * strength, potential.sum_lanes() * strength);
        }
    }
}

/// The shortest motion of two charges [C] of these particles: where they touch, at the distance d, the force falls with the slope
/// 2 |q_i q_j|/(4 π ε_0 ε_r d³). An orbit there takes √2 times as long. `None` where no two have a charge.
pub fn shortest_motion_of_charges(
    particles: &[Particle],
    charges: &[f64],
    electrostatics: &Electrostatics,
) -> Option<ShortestMotion> {
    let charged: Vec<(f64, f64, f64)> = particles
        .iter()
        .zip(charges)
        .filter(|(_, charge)| **charge != 0.0)
        .map(|(particle, charge)| (charge.abs(), particle.mass, particle.radius))
        .take(Electrostatics::MOST_CHARGES)
        .collect();
    let mut steepest = 0.0_f64;
    for (index, &(charge, mass, radius)) in charged.iter().enumerate() {
        for &(other_charge, other_mass, other_radius) in &charged[..index] {
            let touching = radius + other_radius;
            let slope = 2.0 * charge * other_charge / (touching * touching * touching);
            steepest = steepest.max(slope * (1.0 / mass + 1.0 / other_mass));
        }
    }
    let frequency = (strength_in(electrostatics) * steepest).sqrt();
    (frequency > 0.0).then(|| ShortestMotion { duration: PI / frequency, kind: MotionKind::Charges })
}
