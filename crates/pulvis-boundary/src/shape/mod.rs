//! Shapes of walls: where a sphere meets the surface. One file a shape; the list is at the end of this file.
//!
//! A shape is given in the frame of its wall: it knows its size and directions, the wall knows the reference
//! point and the motion. A shape without edges, [`EdgelessShape`], is asked for eight centres at a time, through code
//! without branches. Its particles are on one side. A shape with edges, [`EdgedShape`], is a thin shell with particles on
//! both sides. It has *features*, parts with which a sphere has one contact each, and is asked for one centre and one
//! feature at a time.

mod cone;
mod cylinder;
mod disk;
mod meridian;
mod mesh;
mod plane;
mod plane_with_hole;
mod tube;

pub use cone::Cone;
pub use cylinder::{Cylinder, CylinderSide};
pub use disk::Disk;
pub use mesh::{InvalidMesh, Mesh, TriangleMesh};
pub use plane::Plane;
pub use plane_with_hole::PlaneWithHole;
pub use tube::Tube;

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

/// What a wall needs to know of its shape.
pub trait Shape {
    /// The least mean curvature of the surface [1/m], see [`Surface::mean_curvature`]: contacts there have the largest
    /// effective radius. Negative infinity where it is hollow to a point.
    fn least_mean_curvature(&self) -> f64;

    /// By how much the distance of any point can change at the most when the wall moves by `displacement` [m].
    fn approach(&self, displacement: Vector3) -> f64 {
        displacement.norm()
    }

    /// The axis about which the wall can rotate, through the reference point.
    fn axis(&self) -> Option<Vector3>;

    /// The largest distance of the surface from that axis [m]; zero where there is none.
    fn distance_from_axis(&self) -> f64 {
        0.0
    }

    /// Whether the wall looks different after it has turned about its axis.
    fn is_turned_by_rotation(&self) -> bool {
        false
    }

    /// The direction in which a pressure moves the wall, a unit vector towards the particles; `None` where none can.
    fn direction_of_push(&self) -> Option<Vector3> {
        None
    }

    /// Whether the wall is the same after a shift along `direction`, a unit vector: space can be periodic there.
    fn is_invariant_along(&self, _direction: Vector3) -> bool {
        false
    }

    /// Whether the shape can be, and spheres of up to `largest_radius` [m] can meet it.
    ///
    /// # Errors
    /// What is wrong, in words.
    fn check(&self, largest_radius: f64) -> Result<(), String>;
}

/// A shape without edges, whose particles are on one side.
pub trait EdgelessShape: Shape + Copy {
    /// How the surface lies to `centre` [m]; `point` is the wall's reference point [m].
    fn surface<R: Real>(&self, point: Vector3, centre: Vector3<R>) -> Surface<R>;

    /// How fast the normal turns when the centre moves with `velocity` against the wall's reference point
    /// [1/s]; `None` where it never turns. A rotation of the wall does not turn it, because these shapes are symmetric
    /// about their axes.
    fn normal_rate<R: Real>(&self, surface: &Surface<R>, velocity: Vector3<R>) -> Option<Vector3<R>>;
}

/// How a feature of a shape with edges lies to the centre of a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureSurface {
    /// Unit normal, from the nearest point of the feature to the centre.
    pub normal: Vector3,
    /// Distance of the centre from that point [m].
    pub distance: f64,
    /// Mean of the principal curvatures, positive where the surface bulges towards the centre [1/m].
    pub mean_curvature: f64,
    /// A unit vector across the normal.
    pub tangent: Vector3,
    /// How much the normal turns per length that the centre moves along `tangent`, and along normal × `tangent` [1/m].
    pub turning: [f64; 2],
}

impl FeatureSurface {
    /// How fast the normal turns when the centre moves with `velocity` [m/s] against the wall [1/s].
    pub fn normal_rate(&self, velocity: Vector3) -> Vector3 {
        let other = self.normal.cross(self.tangent);
        self.tangent * (self.turning[0] * self.tangent.dot(velocity))
            + other * (self.turning[1] * other.dot(velocity))
    }
}

/// A shape with edges: a thin shell with particles on both sides. Centres are counted from the wall's reference point, and
/// for shapes that rotation turns in the frame that has turned with them.
///
/// A sphere touches the points where its distance from the surface has a minimum, each with one feature. So its potential
/// is continuous where contacts pass from one feature to the next, and at an edge a contact ends as softly as it began.
pub trait EdgedShape: Shape {
    /// How a feature lies to `centre` [m]; `None` where its distance has no minimum there, or none below `limit` [m].
    fn surface_of(&self, feature: u32, centre: Vector3, limit: f64) -> Option<FeatureSurface>;

    /// Puts the features that a centre can meet while it moves by less than `limit` less the distance that stands beside
    /// them [m] into `found`, in the order of their numbers.
    fn features_near(&self, centre: Vector3, limit: f64, found: &mut Vec<(u32, f64)>);

    /// Distance of a point from the surface [m].
    fn distance(&self, centre: Vector3) -> f64;

    /// Lines that show the shape [m].
    fn outline(&self) -> Vec<[Vector3; 2]>;
}

macro_rules! wall_shapes {
    (edgeless: $($edgeless:ident = $edgeless_name:literal),*; edged: $($edged:ident = $edged_name:literal),* $(,)?) => {
        /// The shape of a wall.
        #[derive(Clone, Debug, PartialEq)]
        pub enum WallShape {
            $(#[doc = concat!("A [`", stringify!($edgeless), "`].")] $edgeless($edgeless),)*
            $(#[doc = concat!("A [`", stringify!($edged), "`].")] $edged($edged),)*
        }

        /// A shape without edges.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Edgeless {
            $(#[doc = concat!("A [`", stringify!($edgeless), "`].")] $edgeless($edgeless),)*
        }

        $(impl From<$edgeless> for WallShape {
            fn from(shape: $edgeless) -> Self {
                Self::$edgeless(shape)
            }
        })*
        $(impl From<$edged> for WallShape {
            fn from(shape: $edged) -> Self {
                Self::$edged(shape)
            }
        })*

        impl Edgeless {
            /// As of [`EdgelessShape::surface`].
            #[inline(always)]
            pub fn surface<R: Real>(&self, point: Vector3, centre: Vector3<R>) -> Surface<R> {
                match self { $(Self::$edgeless(shape) => shape.surface(point, centre),)* }
            }

            /// As of [`EdgelessShape::normal_rate`].
            #[inline(always)]
            pub fn normal_rate<R: Real>(&self, surface: &Surface<R>, velocity: Vector3<R>) -> Option<Vector3<R>> {
                match self { $(Self::$edgeless(shape) => shape.normal_rate(surface, velocity),)* }
            }
        }

        impl WallShape {
            /// The names of all shapes in a scenario.
            pub const NAMES: &[&str] = &[$($edgeless_name,)* $($edged_name,)*];

            /// The name in a scenario.
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$edgeless(_) => $edgeless_name,)*
                    $(Self::$edged(_) => $edged_name,)*
                }
            }

            /// The shape, if it has no edges.
            pub fn edgeless(&self) -> Option<Edgeless> {
                match self {
                    $(Self::$edgeless(shape) => Some(Edgeless::$edgeless(*shape)),)*
                    _ => None,
                }
            }

            /// The shape, if it has edges.
            pub fn edged(&self) -> Option<&dyn EdgedShape> {
                match self {
                    $(Self::$edged(shape) => Some(shape),)*
                    _ => None,
                }
            }

            fn any(&self) -> &dyn Shape {
                match self {
                    $(Self::$edgeless(shape) => shape,)*
                    $(Self::$edged(shape) => shape,)*
                }
            }
        }
    };
}

// The list of shapes: a new one is its file and its name here.
wall_shapes![
    edgeless: Plane = "plane", Cylinder = "cylinder";
    edged: Cone = "cone", Tube = "tube", Disk = "disk", PlaneWithHole = "plane-with-hole", Mesh = "mesh"
];

impl WallShape {
    /// Distance of a point, counted from the wall's reference point, from the surface [m]: negative behind a shape
    /// without edges.
    pub fn distance(&self, from: Vector3) -> f64 {
        match self.edged() {
            Some(shape) => shape.distance(from),
            None => {
                self.edgeless().map_or(f64::INFINITY, |shape| shape.surface(Vector3::zero(), from).distance)
            }
        }
    }

    /// The least mean curvature that a contact with a sphere of this radius [m] counts [1/m].
    pub fn least_mean_curvature_for(&self, radius: f64) -> f64 {
        self.least_mean_curvature().max(-MOST_HOLLOW / radius)
    }
}

impl Shape for WallShape {
    fn least_mean_curvature(&self) -> f64 {
        self.any().least_mean_curvature()
    }
    fn approach(&self, displacement: Vector3) -> f64 {
        self.any().approach(displacement)
    }
    fn axis(&self) -> Option<Vector3> {
        self.any().axis()
    }
    fn distance_from_axis(&self) -> f64 {
        self.any().distance_from_axis()
    }
    fn is_turned_by_rotation(&self) -> bool {
        self.any().is_turned_by_rotation()
    }
    fn direction_of_push(&self) -> Option<Vector3> {
        self.any().direction_of_push()
    }
    fn is_invariant_along(&self, direction: Vector3) -> bool {
        self.any().is_invariant_along(direction)
    }
    fn check(&self, largest_radius: f64) -> Result<(), String> {
        self.any().check(largest_radius)
    }
}

/// The mean curvature, over one over the distance of the centre, up to which a surface counts as hollow or bulging:
/// that of a tube as wide as the sphere. A narrower one is touched all around, not in a point.
pub const MOST_HOLLOW: f64 = 0.5;

/// Directions come from rotated frames and decimal numbers: their length is one up to rounding errors.
const UNIT: f64 = 1e-9;

/// Whether the vector is of length one.
fn is_unit(vector: Vector3) -> bool {
    (vector.norm() - 1.0).abs() <= UNIT
}

/// What is wrong with an axis, if anything.
fn check_axis(Vector3 { x, y, z }: Vector3) -> Result<(), String> {
    if is_unit(Vector3 { x, y, z }) {
        return Ok(());
    }
    Err(format!("its axis ({x}, {y}, {z}) is not of length 1"))
}

/// What is wrong with a length, if anything.
fn check_length(what: &str, length: f64) -> Result<(), String> {
    if length > 0.0 && length.is_finite() {
        return Ok(());
    }
    Err(format!("its {what} is {length} m, not a length greater than zero"))
}

/// A unit vector across a unit vector.
fn across(axis: Vector3) -> Vector3 {
    // The coordinate axis that is farthest from it leaves the longest part.
    let [x, y, z] = axis.to_array().map(f64::abs);
    let other = match (x <= y && x <= z, y <= z) {
        (true, _) => Vector3::new(1.0, 0.0, 0.0),
        (false, true) => Vector3::new(0.0, 1.0, 0.0),
        _ => Vector3::new(0.0, 0.0, 1.0),
    };
    let side = other.tangential_to(axis);
    side * (1.0 / side.norm())
}

#[cfg(test)]
mod tests;
