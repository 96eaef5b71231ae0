//! A circular cylinder without end, met from inside or outside.

use pulvis_math::{Real, Vector3};

use super::{EdgelessShape, Shape, Surface, UNIT, check_axis, check_length};

/// On which side of a cylinder's surface particles are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CylinderSide {
    /// Inside: a drum or a tube.
    Inside,
    /// Outside: a roller or a post.
    Outside,
}

impl CylinderSide {
    /// The name in a scenario.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::Outside => "outside",
        }
    }

    /// 1 where the normal points away from the axis, −1 where it points to it.
    #[inline(always)]
    fn sign(self) -> f64 {
        match self {
            Self::Inside => -1.0,
            Self::Outside => 1.0,
        }
    }
}

/// A circular cylinder without end, whose axis goes through the wall's reference point.
///
/// A sphere of radius a touches a surface with the principal curvatures ±1/R around the axis and 0 along it. The
/// contact area is an ellipse; laws of spheres take the mean of the two relative curvatures, that is
/// 1/a ± 1/(2R), for one over the effective radius. To first order in a/R this is Hertz's solution, whose effective
/// radius is one over the geometric mean of the relative curvatures.
///
/// # Source
/// K. L. Johnson, Contact Mechanics (1985), section 4.2. LAMMPS (`fix wall/gran`, `zcylinder`) takes the same mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Unit vector along the axis; a positive rotation is by the right-hand rule about it.
    pub axis: Vector3,
    /// Radius of the surface [m].
    pub radius: f64,
    /// The side on which particles are.
    pub side: CylinderSide,
}

impl EdgelessShape for Cylinder {
    #[inline(always)]
    fn surface<R: Real>(&self, point: Vector3, centre: Vector3<R>) -> Surface<R> {
        let sign = R::splat(self.side.sign());
        let axis = Vector3::<R>::splat(self.axis);
        let across = (centre - Vector3::splat(point)).tangential_to(axis);
        // On the axis there is no normal. Spheres there are out of touch: zero serves as well.
        let from_axis = across.norm().max(R::splat(f64::MIN_POSITIVE));
        let turning = sign / from_axis;
        Surface {
            normal: across * turning,
            distance: sign * (from_axis - R::splat(self.radius)),
            mean_curvature: sign * R::splat(0.5 / self.radius),
            turning,
        }
    }

    #[inline(always)]
    fn normal_rate<R: Real>(&self, surface: &Surface<R>, velocity: Vector3<R>) -> Option<Vector3<R>> {
        // Only what goes around the axis turns the normal.
        let around = Vector3::<R>::splat(self.axis).cross(surface.normal);
        Some(around * (around.dot(velocity) * surface.turning))
    }
}

impl Shape for Cylinder {
    fn least_mean_curvature(&self) -> f64 {
        self.side.sign() * (0.5 / self.radius)
    }

    fn approach(&self, displacement: Vector3) -> f64 {
        displacement.tangential_to(self.axis).norm()
    }

    fn axis(&self) -> Option<Vector3> {
        Some(self.axis)
    }

    fn distance_from_axis(&self) -> f64 {
        self.radius
    }

    fn is_invariant_along(&self, direction: Vector3) -> bool {
        direction.tangential_to(self.axis).norm() <= UNIT
    }

    fn check(&self, largest_radius: f64) -> Result<(), String> {
        let Self { axis, radius, side } = *self;
        check_axis(axis)?;
        check_length("radius", radius)?;
        if side == CylinderSide::Inside && radius <= largest_radius {
            return Err(format!("a particle of {largest_radius} m radius has no room inside {radius} m"));
        }
        Ok(())
    }
}
