//! Coarse-grained fields.
//!
//! With the kernel W, masses m, positions r, velocities v, forces f on the first of two bodies i and j and the way b = r_i − r_j
//! between them (at a wall from the contact point c to the centre):
//!
//! - density ρ = Σ m W(x − r), momentum p = Σ m v W(x − r), velocity V = p/ρ;
//! - kinetic stress Σ m (v − V) ⊗ (v − V) W(x − r), with V where the kernel is taken;
//! - contact stress Σ f ⊗ b ∫ W(x − r_j − s b) ds over s from 0 to 1: the force is spread along the way; compression positive;
//! - force of the walls on the particles Σ f W(x − c), so that in a sample at rest div σ = ρ g + wall force;
//! - solid fraction Σ v_p W(x − r) with the particle volumes v_p, fabric Σ v_p W(x − r) Σ n ⊗ n over the contacts of the particle.
//!
//! Sums over all cells times their volume are what the sample has, to rounding errors, because the shares of each point add
//! up to one.
//!
//! # Source
//! I. Goldhirsch, Granular Matter 12, 239 (2010); walls: T. Weinhart, A. R. Thornton, S. Luding, O. Bokhove, Granular Matter
//! 14, 289 (2012). Fabric: M. Madadi, O. Tsoungui, M. Lätzel, S. Luding, Int. J. Solids Struct. 41, 2563 (2004).

use pulvis_math::Vector3;

use super::grid::{Grid, Share};
use super::kernel::Kernel;
use super::sample::Sample;

/// The fields of one instant, cell by cell, x fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// Where the cells are.
    pub grid: Grid,
    /// Σ v_p W \[1\].
    pub solid_fraction: Vec<f64>,
    /// \[kg/m³\]
    pub density: Vec<f64>,
    /// \[kg/(m² s)\]
    pub momentum: Vec<[f64; 3]>,
    /// Row by row \[Pa\].
    pub kinetic_stress: Vec<[f64; 9]>,
    /// f_k b_l, row by row \[Pa\].
    pub contact_stress: Vec<[f64; 9]>,
    /// Force of the walls on the particles \[N/m³\].
    pub wall_force: Vec<[f64; 3]>,
    /// Row by row \[1\].
    pub fabric: Vec<[f64; 9]>,
}

/// Points along a contact for every width of the kernel.
const POINTS_PER_WIDTH: f64 = 4.0;

impl Fields {
    /// Spreads a sample over a grid.
    pub fn new(sample: &Sample, grid: Grid, kernel: Kernel, width: f64) -> Self {
        let cells = grid.len();
        let mut fields = Self {
            solid_fraction: vec![0.0; cells],
            density: vec![0.0; cells],
            momentum: vec![[0.0; 3]; cells],
            kinetic_stress: vec![[0.0; 9]; cells],
            contact_stress: vec![[0.0; 9]; cells],
            wall_force: vec![[0.0; 3]; cells],
            fabric: vec![[0.0; 9]; cells],
            grid,
        };
        let spread = Spread { kernel, width, per_volume: 1.0 / fields.grid.volume() };
        let mut shares = Vec::new();
        fields.add_particles(sample, spread, &mut shares);
        fields.add_kinetic_stress(sample, spread, &mut shares);
        fields.add_contacts(sample, spread, &mut shares);
        fields
    }

    /// Momentum over density \[m/s\]; NaN where there is nothing.
    pub fn velocity(&self, cell: usize) -> [f64; 3] {
        self.momentum[cell].map(|momentum| momentum / self.density[cell])
    }

    fn add_particles(&mut self, sample: &Sample, spread: Spread, shares: &mut Vec<Share>) {
        for grain in &sample.particles {
            self.grid.shares(grain.position, spread.kernel, spread.width, shares);
            let [xx, yy, zz, xy, xz, yz] = grain.fabric;
            let fabric = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
            let volume = grain.volume();
            for &(cell, share) in &*shares {
                let weight = share * spread.per_volume;
                self.solid_fraction[cell] += volume * weight;
                self.density[cell] += grain.mass * weight;
                let momentum = grain.velocity * (grain.mass * weight);
                add(&mut self.momentum[cell], &momentum.to_array(), 1.0);
                add(&mut self.fabric[cell], &fabric, volume * weight);
            }
        }
    }

    fn add_kinetic_stress(&mut self, sample: &Sample, spread: Spread, shares: &mut Vec<Share>) {
        for grain in &sample.particles {
            self.grid.shares(grain.position, spread.kernel, spread.width, shares);
            for &(cell, share) in &*shares {
                let velocity = grain.velocity - Vector3::from(self.velocity(cell));
                let outer = outer(velocity, velocity);
                add(&mut self.kinetic_stress[cell], &outer, grain.mass * share * spread.per_volume);
            }
        }
    }

    fn add_contacts(&mut self, sample: &Sample, spread: Spread, shares: &mut Vec<Share>) {
        for link in &sample.contacts {
            let branch = link.ends[0] - link.ends[1];
            let virial = outer(link.force, branch);
            let points = (POINTS_PER_WIDTH * branch.norm() / spread.width).ceil().max(1.0);
            for point in 0..points as usize {
                let along = (point as f64 + 0.5) / points;
                self.grid.shares(link.ends[1] + branch * along, spread.kernel, spread.width, shares);
                for &(cell, share) in &*shares {
                    add(&mut self.contact_stress[cell], &virial, share / points * spread.per_volume);
                }
            }
            if link.at_wall {
                self.grid.shares(link.ends[1], spread.kernel, spread.width, shares);
                for &(cell, share) in &*shares {
                    add(&mut self.wall_force[cell], &link.force.to_array(), share * spread.per_volume);
                }
            }
        }
    }

    /// Means over the cells of each slab across an axis: the field of one row of cells.
    pub fn profile(&self, axis: usize) -> Self {
        let mut grid = self.grid.clone();
        for other in (0..3).filter(|&other| other != axis) {
            grid.cell[other] *= grid.counts[other] as f64;
            grid.counts[other] = 1;
        }
        let slabs = grid.counts[axis];
        let share = slabs as f64 / self.grid.len() as f64;
        let [nx, ny, _] = self.grid.counts;
        let slab = |cell: usize| [cell % nx, cell / nx % ny, cell / (nx * ny)][axis];
        let scalars = |values: &[f64]| {
            let mut means = vec![0.0; slabs];
            values.iter().enumerate().for_each(|(cell, value)| means[slab(cell)] += value * share);
            means
        };
        Self {
            solid_fraction: scalars(&self.solid_fraction),
            density: scalars(&self.density),
            momentum: means(&self.momentum, slabs, &slab, share),
            kinetic_stress: means(&self.kinetic_stress, slabs, &slab, share),
            contact_stress: means(&self.contact_stress, slabs, &slab, share),
            wall_force: means(&self.wall_force, slabs, &slab, share),
            fabric: means(&self.fabric, slabs, &slab, share),
            grid,
        }
    }
}

/// How a point is spread.
#[derive(Clone, Copy)]
struct Spread {
    kernel: Kernel,
    width: f64,
    /// One over the volume of a cell \[1/m³\].
    per_volume: f64,
}

fn means<const N: usize>(
    values: &[[f64; N]],
    slabs: usize,
    slab: &impl Fn(usize) -> usize,
    share: f64,
) -> Vec<[f64; N]> {
    let mut means = vec![[0.0; N]; slabs];
    values.iter().enumerate().for_each(|(cell, value)| add(&mut means[slab(cell)], value, share));
    means
}

fn add<const N: usize>(sum: &mut [f64; N], value: &[f64; N], factor: f64) {
    sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += factor * value);
}

fn outer(one: Vector3, other: Vector3) -> [f64; 9] {
    std::array::from_fn(|part| one[part / 3] * other[part % 3])
}
