//! Inlets: spheres that come into a region over time, at a rate.

use std::f64::consts::{PI, TAU};

use pulvis_boundary::{Cuboid, Domain, Region};
use pulvis_math::{Vector3, elementary};
use rand::RngExt;
use thiserror::Error;

use super::{InvalidDistribution, OccupiedSpace, RadiusDistribution, Random, gaussian_vector, random_stream};

/// How much comes in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// A number of spheres.
    Number(f64),
    /// A mass [kg].
    Mass(f64),
}

impl Amount {
    /// The bare number, in spheres or kilograms; per second if it is a rate.
    pub fn value(self) -> f64 {
        match self {
            Self::Number(value) | Self::Mass(value) => value,
        }
    }

    /// What a sphere of this mass [kg] adds, counted as this amount is.
    fn of_sphere(self, mass: f64) -> f64 {
        match self {
            Self::Number(_) => 1.0,
            Self::Mass(_) => mass,
        }
    }
}

/// What an inlet brings in.
#[derive(Clone, Debug, PartialEq)]
pub struct InletPlan {
    /// Where: spheres lie whole in it when they come in. It is bounded: boxes end in all directions, layers are not taken.
    pub region: Region,
    /// How much in a second.
    pub rate: Amount,
    /// How much in all; without end where it is `None`. The sphere that would exceed a mass does not come in.
    pub total: Option<Amount>,
    /// How large.
    pub radius: RadiusDistribution,
    /// Density of the spheres [kg/m³].
    pub density: f64,
    /// Mean velocity [m/s].
    pub velocity: Vector3,
    /// Standard deviation of each component of the velocity, Gaussian [m/s].
    pub standard_deviation: f64,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Which of the independent streams of random numbers of this seed. Initial packings take number 0.
    pub stream: u64,
}

/// A sphere that comes in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewSphere {
    /// Radius [m].
    pub radius: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Position of the centre [m].
    pub position: Vector3,
    /// Velocity [m/s].
    pub velocity: Vector3,
}

/// Everything that an inlet keeps over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InletState {
    /// Where its stream of random numbers is.
    pub word_position: u128,
    /// The radius of the sphere that comes next, once it is drawn [m].
    pub next_radius: Option<f64>,
    /// Spheres that have come in.
    pub number: u64,
    /// Their mass [kg].
    pub mass: f64,
}

/// Why a plan is none.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum InvalidInlet {
    /// The distribution of radii.
    #[error(transparent)]
    Radius(#[from] InvalidDistribution),
    /// The region has no end in some direction.
    #[error("the region of an inlet has no end in some direction")]
    Unbounded,
    /// The region is smaller than the largest sphere.
    #[error("a sphere of radius {radius} m does not lie whole in the region of the inlet")]
    TooLarge {
        /// The largest radius [m].
        radius: f64,
    },
}

/// What there is room for.
pub trait Room {
    /// Whether a sphere, by its centre and radius [m], overlaps nothing.
    fn is_free(&self, centre: Vector3, radius: f64) -> bool;

    /// A sphere is there from now on.
    fn take(&mut self, centre: Vector3, radius: f64);
}

impl Room for OccupiedSpace {
    fn is_free(&self, centre: Vector3, radius: f64) -> bool {
        OccupiedSpace::is_free(self, centre, radius)
    }

    fn take(&mut self, centre: Vector3, radius: f64) {
        self.add(centre, radius);
    }
}

/// Sites that are tried for a sphere before it waits. In a region that is a third full every fourth site or so is free; with
/// so many trials a sphere finds the last thirtieth of the sites that are free in all but 3 % of the cases.
const TRIALS: usize = 100;

/// An inlet over time. It owes what its rate says, and never brings in more; spheres that find no room wait and are tried
/// again, the same ones, so that sizes keep their distribution however full the region is.
///
/// All random numbers are drawn in one order from one stream: the same calls give the same spheres on every machine.
#[derive(Clone, Debug)]
pub struct Inlet {
    plan: InletPlan,
    random: Random,
    next_radius: Option<f64>,
    number: u64,
    mass: f64,
}

impl Inlet {
    /// An inlet that has brought in nothing yet.
    ///
    /// # Errors
    /// Radii cannot be drawn, the region has no end, or the largest sphere does not fit into it.
    pub fn new(plan: InletPlan, domain: &Domain) -> Result<Self, InvalidInlet> {
        plan.radius.check()?;
        let [lower, upper] = plan.region.bounds();
        if !(lower.is_finite() && upper.is_finite()) {
            return Err(InvalidInlet::Unbounded);
        }
        let (_, radius) = plan.radius.limits();
        if plan.region.inset(radius, domain).is_none() {
            return Err(InvalidInlet::TooLarge { radius });
        }
        let mut random = random_stream(plan.seed);
        random.set_stream(plan.stream);
        Ok(Self { plan, random, next_radius: None, number: 0, mass: 0.0 })
    }

    /// Goes on where a state was taken.
    pub fn set_state(&mut self, state: &InletState) {
        let &InletState { word_position, next_radius, number, mass } = state;
        self.random.set_word_pos(word_position);
        (self.next_radius, self.number, self.mass) = (next_radius, number, mass);
    }

    /// Everything that later calls depend on, beside the plan.
    pub fn state(&self) -> InletState {
        let Self { plan: _, random, next_radius, number, mass } = self;
        InletState {
            word_position: random.get_word_pos(),
            next_radius: *next_radius,
            number: *number,
            mass: *mass,
        }
    }

    /// What it brings in.
    pub fn plan(&self) -> &InletPlan {
        &self.plan
    }

    /// What has come in, counted as the rate is.
    pub fn supplied(&self) -> f64 {
        match self.plan.rate {
            Amount::Number(_) => self.number as f64,
            Amount::Mass(_) => self.mass,
        }
    }

    /// Whether all has come in that should.
    pub fn is_exhausted(&self) -> bool {
        match (self.plan.total, self.next_radius) {
            (None, _) => false,
            (Some(Amount::Number(total)), _) => self.number as f64 >= total,
            (Some(Amount::Mass(total)), Some(radius)) => self.mass + self.mass_of(radius) > total * ROUNDING,
            (Some(Amount::Mass(total)), None) => self.mass >= total,
        }
    }

    fn mass_of(&self, radius: f64) -> f64 {
        4.0 / 3.0 * PI * elementary::powi(radius, 3) * self.plan.density
    }

    /// The spheres that come in when the inlet has been open for `open` seconds in all, where there is `room` for them.
    pub fn supply(&mut self, open: f64, domain: &Domain, room: &mut impl Room) -> Vec<NewSphere> {
        let mut spheres = Vec::new();
        while let Some(radius) = self.next_radius().filter(|radius| self.owes(*radius, open)) {
            let mass = self.mass_of(radius);
            let Some(inset) = self.plan.region.inset(radius, domain) else { break };
            let site = (0..TRIALS).find_map(|_| {
                let site = random_point(&inset, &mut self.random);
                room.is_free(site, radius).then_some(site)
            });
            let Some(position) = site else { break };
            room.take(position, radius);
            let mut velocity = self.plan.velocity;
            if self.plan.standard_deviation > 0.0 {
                velocity += gaussian_vector(&mut self.random) * self.plan.standard_deviation;
            }
            spheres.push(NewSphere { radius, mass, position, velocity });
            self.next_radius = None;
            self.number += 1;
            self.mass += mass;
        }
        spheres
    }

    /// Whether a sphere is due when the inlet has been open for `open` seconds.
    pub fn is_due(&mut self, open: f64) -> bool {
        let next = self.next_radius();
        next.is_some_and(|radius| self.owes(radius, open))
    }

    /// Whether a sphere of this radius [m] is due.
    fn owes(&self, radius: f64, open: f64) -> bool {
        let of_sphere = self.plan.rate.of_sphere(self.mass_of(radius));
        self.supplied() + of_sphere <= self.plan.rate.value() * open * ROUNDING
    }

    /// The radius of the sphere that comes next [m]; `None` after the last one.
    fn next_radius(&mut self) -> Option<f64> {
        if self.next_radius.is_none() && !self.is_exhausted() {
            // The distribution has been checked.
            let drawn = self.plan.radius.draw(1, &mut self.random).ok()?;
            self.next_radius = drawn.first().copied();
        }
        if self.is_exhausted() { None } else { self.next_radius }
    }

    /// For how long the sphere that comes next has been waiting for room [s], when the inlet has been open for `open`
    /// seconds; zero where it is not due yet.
    pub fn delay(&self, open: f64) -> f64 {
        let rate = self.plan.rate;
        match self.next_radius {
            Some(radius) if !self.is_exhausted() => {
                let at = (self.supplied() + rate.of_sphere(self.mass_of(radius))) / rate.value();
                (open - at).max(0.0)
            }
            _ => 0.0,
        }
    }
}

/// Sums of masses and products of times are not exact: what is due to so many digits is due.
const ROUNDING: f64 = 1.0 + 1e-12;

/// A random point of a bounded region, each part of it equally likely [m]; of a layer, of the part between -1 m and 1 m along
/// the other directions.
pub fn random_point(region: &Region, random: &mut Random) -> Vector3 {
    let mut uniform = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
    match *region {
        Region::Box(Cuboid { lower, upper }) => {
            Vector3::new(uniform(lower.x, upper.x), uniform(lower.y, upper.y), uniform(lower.z, upper.z))
        }
        Region::Layer { axis, lower, upper } => {
            let mut point = Vector3::new(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0));
            *point.component_mut(axis) = uniform(lower, upper);
            point
        }
        Region::Sphere { centre, radius } => loop {
            let point = Vector3::new(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0));
            if point.norm_squared() <= 1.0 {
                return centre + point * radius;
            }
        },
        Region::Cylinder { ends: [start, end], radius } => {
            let (along, angle) = (uniform(0.0, 1.0), uniform(0.0, TAU));
            let out = radius * uniform(0.0, 1.0).sqrt();
            let axis = end - start;
            // The coordinate axis that is farthest from it.
            let least = if axis.x.abs() <= axis.y.abs() && axis.x.abs() <= axis.z.abs() {
                Vector3::new(1.0, 0.0, 0.0)
            } else if axis.y.abs() <= axis.z.abs() {
                Vector3::new(0.0, 1.0, 0.0)
            } else {
                Vector3::new(0.0, 0.0, 1.0)
            };
            let middle = start + axis * along;
            // An axis without length has no direction: then the disc is that of z.
            let axis = axis.unit().unwrap_or(Vector3::new(0.0, 0.0, 1.0));
            let one = axis.cross(least).unit().unwrap_or(Vector3::new(1.0, 0.0, 0.0));
            let other = axis.cross(one);
            let (sin, cos) = elementary::sin_cos(angle);
            middle + one * (out * cos) + other * (out * sin)
        }
    }
}

#[cfg(test)]
mod tests;
