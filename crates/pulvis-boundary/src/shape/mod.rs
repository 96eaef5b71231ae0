//! Shapes of walls: where a sphere meets the surface. One file a shape; the list is at the end of this file.
//!
//! A shape is given in the frame of its wall: it knows its size and directions, the wall knows the reference
//! point and the motion. The contact loop asks a shape for eight centres at a time, through code without branches.

mod cylinder;
mod plane;

pub use cylinder::{Cylinder, CylinderSide};
pub use plane::Plane;

use pulvis_math::{Real, Vector3};

/// How a surface lies to a point near it, the centre of a sphere.
#[derive(Clone, Copy, Debug)]
pub struct Surface<R> {
    /// Unit normal of the surface, towards the particles.
    pub normal: Vector3<R>,
    /// Distance of the centre from the surface, negative behind it [m].
    pub distance: R,
    /// Mean of the two principal curvatures, positive where the surface bulges towards the particles [1/m].
    pub mean_curvature: R,
    /// How much the normal turns per length that the centre moves in the direction in which the surface is
    /// curved; negative where it turns against that direction [1/m].
    pub turning: R,
}

/// What a wall needs to know of its shape. `point` is the wall's reference point [m].
pub trait Shape: Copy {
    /// How the surface lies to `centre` [m].
    fn surface<R: Real>(&self, point: Vector3, centre: Vector3<R>) -> Surface<R>;

    /// The least mean curvature of the surface [1/m], see [`Surface::mean_curvature`]: contacts there have the largest
    /// effective radius.
    fn least_mean_curvature(&self) -> f64;

    /// How fast the normal turns when the centre moves with `velocity` against the wall's reference point
    /// [1/s]; `None` where it never turns. A rotation of the wall does not turn it, because walls rotate about
    /// axes of symmetry only.
    fn normal_rate<R: Real>(&self, surface: &Surface<R>, velocity: Vector3<R>) -> Option<Vector3<R>>;

    /// By how much the distance of any point can change at the most when the wall moves by `displacement` [m].
    fn approach(&self, displacement: Vector3) -> f64;

    /// The axis of symmetry about which the wall can rotate, through the reference point.
    fn axis(&self) -> Option<Vector3>;

    /// The largest distance of the surface from that axis [m]; zero where there is none.
    fn distance_from_axis(&self) -> f64 {
        0.0
    }

    /// Whether the wall is the same after a shift along `direction`, a unit vector: space can be periodic there.
    fn is_invariant_along(&self, direction: Vector3) -> bool;

    /// Whether the shape can be, and spheres of up to `largest_radius` [m] can meet it.
    ///
    /// # Errors
    /// What is wrong, in words.
    fn check(&self, largest_radius: f64) -> Result<(), String>;
}

macro_rules! wall_shapes {
    ($($shape:ident = $name:literal),* $(,)?) => {
        /// The shape of a wall.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum WallShape {
            $(#[doc = concat!("A [`", stringify!($shape), "`].")] $shape($shape),)*
        }

        $(impl From<$shape> for WallShape {
            fn from(shape: $shape) -> Self {
                Self::$shape(shape)
            }
        })*

        impl WallShape {
            /// The names of all shapes in a scenario.
            pub const NAMES: &[&str] = &[$($name),*];

            /// The name in a scenario.
            pub const fn name(&self) -> &'static str {
                match self { $(Self::$shape(_) => $name,)* }
            }
        }

        impl Shape for WallShape {
            #[inline(always)]
            fn surface<R: Real>(&self, point: Vector3, centre: Vector3<R>) -> Surface<R> {
                match self { $(Self::$shape(shape) => shape.surface(point, centre),)* }
            }
            fn least_mean_curvature(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.least_mean_curvature(),)* }
            }
            #[inline(always)]
            fn normal_rate<R: Real>(&self, surface: &Surface<R>, velocity: Vector3<R>) -> Option<Vector3<R>> {
                match self { $(Self::$shape(shape) => shape.normal_rate(surface, velocity),)* }
            }
            fn approach(&self, displacement: Vector3) -> f64 {
                match self { $(Self::$shape(shape) => shape.approach(displacement),)* }
            }
            fn axis(&self) -> Option<Vector3> {
                match self { $(Self::$shape(shape) => shape.axis(),)* }
            }
            fn distance_from_axis(&self) -> f64 {
                match self { $(Self::$shape(shape) => shape.distance_from_axis(),)* }
            }
            fn is_invariant_along(&self, direction: Vector3) -> bool {
                match self { $(Self::$shape(shape) => shape.is_invariant_along(direction),)* }
            }
            fn check(&self, largest_radius: f64) -> Result<(), String> {
                match self { $(Self::$shape(shape) => shape.check(largest_radius),)* }
            }
        }
    };
}

// The list of shapes: a new one is its file and its name here.
wall_shapes![Plane = "plane", Cylinder = "cylinder"];

/// Directions come from rotated frames and decimal numbers: their length is one up to rounding errors.
const UNIT: f64 = 1e-9;

/// Whether the vector is of length one.
fn is_unit(vector: Vector3) -> bool {
    (vector.norm() - 1.0).abs() <= UNIT
}

#[cfg(test)]
mod tests;
