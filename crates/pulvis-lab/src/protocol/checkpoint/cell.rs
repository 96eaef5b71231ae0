//! A deforming cell in a checkpoint.

use pulvis_boundary::motion::PressureRamp;
use pulvis_core::{CellControl, CellMotion, CellState, Domain};
use pulvis_math::Vector3;
use serde::{Deserialize, Serialize};

#[derive(Debug, Serialize, Deserialize)]
pub(super) struct CellEntry {
    /// What leads the components xx, yy, zz, xy, xz and yz.
    components: [ControlEntry; 6],
    isotropic: Option<RampEntry>,
    inertial_number: f64,
    listed_lower: [f64; 3],
    listed_upper: [f64; 3],
    listed_tilts: [f64; 3],
    numbers: Vec<(String, f64)>,
}

/// Pressure at the start and at the end [Pa], and duration [s].
type RampEntry = (f64, f64, f64);

/// Neither for a component that does not deform.
#[derive(Debug, Serialize, Deserialize)]
struct ControlEntry {
    rate: Option<f64>,
    stress: Option<RampEntry>,
}

fn ramp_entry(ramp: PressureRamp) -> RampEntry {
    let PressureRamp { from, to, duration } = ramp;
    (from, to, duration)
}

fn ramp_of((from, to, duration): RampEntry) -> PressureRamp {
    PressureRamp { from, to, duration }
}

impl From<CellControl> for ControlEntry {
    fn from(control: CellControl) -> Self {
        match control {
            CellControl::Fixed => Self { rate: None, stress: None },
            CellControl::Rate(rate) => Self { rate: Some(rate), stress: None },
            CellControl::Stress(ramp) => Self { rate: None, stress: Some(ramp_entry(ramp)) },
        }
    }
}

impl TryFrom<ControlEntry> for CellControl {
    type Error = &'static str;

    fn try_from(entry: ControlEntry) -> Result<Self, &'static str> {
        match (entry.rate, entry.stress) {
            (None, None) => Ok(Self::Fixed),
            (Some(rate), None) => Ok(Self::Rate(rate)),
            (None, Some(ramp)) => Ok(Self::Stress(ramp_of(ramp))),
            (Some(_), Some(_)) => Err("a component of its cell follows a rate and a stress"),
        }
    }
}

impl From<CellState> for CellEntry {
    fn from(state: CellState) -> Self {
        let CellState { motion, listed, numbers } = state;
        let CellMotion { components, isotropic, inertial_number } = motion;
        Self {
            components: components.map(ControlEntry::from),
            isotropic: isotropic.map(ramp_entry),
            inertial_number,
            listed_lower: listed.extent.lower.to_array(),
            listed_upper: listed.extent.upper.to_array(),
            listed_tilts: listed.tilts,
            numbers,
        }
    }
}

impl CellEntry {
    /// The state, in a domain with these periodic directions.
    pub(super) fn into_state(self, periodic: [bool; 3]) -> Result<CellState, &'static str> {
        let Self {
            components,
            isotropic,
            inertial_number,
            listed_lower,
            listed_upper,
            listed_tilts,
            numbers,
        } = self;
        let mut controls = [CellControl::Fixed; 6];
        for (control, entry) in controls.iter_mut().zip(components) {
            *control = entry.try_into()?;
        }
        let isotropic = isotropic.map(ramp_of);
        let motion = CellMotion { components: controls, isotropic, inertial_number };
        let listed = domain_of(listed_lower, listed_upper, periodic, listed_tilts);
        Ok(CellState { motion, listed, numbers })
    }
}

/// A domain from plain numbers.
pub(super) fn domain_of(lower: [f64; 3], upper: [f64; 3], periodic: [bool; 3], tilts: [f64; 3]) -> Domain {
    Domain { tilts, ..Domain::periodic(Vector3::from(lower), Vector3::from(upper), periodic) }
}
