//! How a periodic cell deforms.

use super::PressureRamp;
use crate::UpperTriangular;

/// What leads one component of a cell's deformation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CellControl {
    /// It does not deform.
    #[default]
    Fixed,
    /// It deforms at this rate [1/s]: L'/L of a length, positive for extension; ∂v_x/∂y of a shear.
    Rate(f64),
    /// It follows a stress, compression positive.
    Stress(PressureRamp),
}

/// How a periodic cell deforms: each component of its velocity gradient at a rate, or so that a stress is followed.
///
/// A component that follows a stress deforms as a dashpot between the stress and its target would:
/// e = (σ − σ_target)/η. It has no inertia, so that it cannot ring. Its viscosity η = d √(ρ σ)/I belongs to an inertial
/// number I: a cell that resists nothing is compressed at the rate e = σ/η at which e d √(ρ/σ) = I. Its speed is limited to
/// [`FASTEST`](Self::FASTEST) times that rate. A packing with the bulk modulus K comes to its target within some η/K.
///
/// # Source
/// The inertial number: GDR MiDi, Eur. Phys. J. E 14, 341 (2004). A rate in proportion to the error of the
/// stress is the usual control of periodic cells in granular simulations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellMotion {
    /// The components xx, yy, zz, xy, xz and yz.
    pub components: [CellControl; 6],
    /// The mean of the three normal stresses, which all three lengths follow alike.
    pub isotropic: Option<PressureRamp>,
    /// Inertial number I of the components that follow a stress [1].
    pub inertial_number: f64,
}

impl Default for CellMotion {
    fn default() -> Self {
        Self { components: [CellControl::Fixed; 6], isotropic: None, inertial_number: Self::QUASI_STATIC }
    }
}

/// What a cell that follows a stress is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CellContent {
    /// Mean diameter of the particles d [m].
    pub diameter: f64,
    /// Density of the particles ρ [kg/m³].
    pub density: f64,
}

impl CellMotion {
    /// The inertial number below which frictional flows are quasi-static.
    pub const QUASI_STATIC: f64 = 1e-3;
    /// The largest rate under a stress, over that of a cell that resists nothing.
    pub const FASTEST: f64 = 10.0;

    /// Whether anything deforms.
    pub fn moves(&self) -> bool {
        let still = |control: &CellControl| matches!(control, CellControl::Fixed | CellControl::Rate(0.0));
        self.isotropic.is_some() || !self.components.iter().all(still)
    }

    /// The stresses that are followed.
    pub fn targets(&self) -> impl Iterator<Item = PressureRamp> + '_ {
        let of = |control: &CellControl| match control {
            CellControl::Stress(ramp) => Some(*ramp),
            CellControl::Fixed | CellControl::Rate(_) => None,
        };
        self.components.iter().filter_map(of).chain(self.isotropic)
    }

    /// Whether a component deforms or may deform.
    pub fn deforms(&self, component: usize) -> bool {
        let normal = component < 3;
        (normal && self.isotropic.is_some())
            || !matches!(self.components[component], CellControl::Fixed | CellControl::Rate(0.0))
    }

    /// The prescribed rates alone [1/s].
    pub fn prescribed(&self) -> UpperTriangular {
        UpperTriangular::from_array(self.components.map(|control| match control {
            CellControl::Rate(rate) => rate,
            CellControl::Fixed | CellControl::Stress(_) => 0.0,
        }))
    }

    /// The viscosity η of components that follow a stress [Pa s]; zero where none does.
    pub fn viscosity(&self, content: CellContent) -> f64 {
        let CellContent { diameter, density } = content;
        diameter * (density * self.largest_target()).sqrt() / self.inertial_number
    }

    /// The largest stress that is followed at the end of all ramps [Pa].
    pub fn largest_target(&self) -> f64 {
        let largest = self.targets().map(|ramp| ramp.to.abs().max(ramp.from.abs()));
        largest.fold(0.0, pulvis_math::max_or_nan)
    }

    /// The rates [1/s] under the stresses σ_xx … σ_yz [Pa] at a time since the motion began [s].
    pub fn rates(&self, stress: [f64; 6], time: f64, content: CellContent) -> UpperTriangular {
        let viscosity = self.viscosity(content);
        let fastest = Self::FASTEST * self.largest_target() / viscosity;
        let under =
            |stress: f64, ramp: PressureRamp| ((stress - ramp.at(time)) / viscosity).clamp(-fastest, fastest);
        let mut rates: [f64; 6] = std::array::from_fn(|component| match self.components[component] {
            CellControl::Fixed => 0.0,
            CellControl::Rate(rate) => rate,
            CellControl::Stress(ramp) => under(stress[component], ramp),
        });
        if let Some(ramp) = self.isotropic {
            let mean = (stress[0] + stress[1] + stress[2]) / 3.0;
            rates[..3].fill(under(mean, ramp));
        }
        UpperTriangular::from_array(rates)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTENT: CellContent = CellContent { diameter: 1e-3, density: 2500.0 };

    fn constant(pressure: f64) -> PressureRamp {
        PressureRamp { from: pressure, to: pressure, duration: 0.0 }
    }

    #[test]
    fn a_cell_that_resists_nothing_is_compressed_at_its_inertial_number() {
        let mut motion = CellMotion { isotropic: Some(constant(100.0)), ..CellMotion::default() };
        motion.components[3] = CellControl::Rate(0.25);
        let rates = motion.rates([0.0; 6], 0.0, CONTENT);
        let inertial = -rates.xx * CONTENT.diameter * (CONTENT.density / 100.0).sqrt();
        assert!((inertial - 1e-3).abs() < 1e-15, "{inertial}");
        assert_eq!((rates.yy, rates.zz, rates.xy), (rates.xx, rates.xx, 0.25));
        assert!(motion.moves() && motion.deforms(1) && motion.deforms(3) && !motion.deforms(4));
    }

    #[test]
    fn a_cell_at_its_stress_stands_still_and_far_beyond_it_is_not_faster_than_ten_times() {
        let mut motion = CellMotion::default();
        motion.components[1] = CellControl::Stress(constant(100.0));
        let rate = |stress: f64| motion.rates([0.0, stress, 0.0, 0.0, 0.0, 0.0], 0.0, CONTENT).yy;
        assert_eq!(rate(100.0), 0.0);
        assert!((rate(1e9) + 10.0 * rate(0.0)).abs() < 1e-12 * rate(1e9));
        assert!(!CellMotion::default().moves());
    }
}
