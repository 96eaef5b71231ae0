//! Surfaces of revolution: a straight line in the half-plane of the distance from the axis and the height along it.

use std::f64::consts::TAU;

use pulvis_math::{Vector3, elementary};

use super::{EdgedShape, FeatureSurface, MOST_HOLLOW, Shape, across};

/// The part of the surface that is nearest to a centre.
const NEAR: u32 = 0;
/// The part across the axis. A sphere that is wider than the surface, such as a grain that plugs an orifice, touches it all
/// around; it is held at two opposite points.
const FAR: u32 = 1;

/// Sides of the polygon that stands for a circle in an outline, and lines along the surface.
const SIDES: u32 = 72;
const LINES: u32 = 8;

/// A straight line that goes once around an axis.
///
/// The nearest point of such a surface lies in the half-plane through the centre, where it is the nearest point of a line:
/// a point between its ends, or an end, which is a rim. All of it is one feature, so that a contact that passes a rim keeps
/// its memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meridian {
    /// Unit vector along the axis.
    pub(super) axis: Vector3,
    /// Where the line begins: distance from the axis and height [m].
    pub(super) start: [f64; 2],
    /// Unit vector along the line, in these coordinates.
    pub(super) direction: [f64; 2],
    /// Length of the line [m], which may be infinite.
    pub(super) length: f64,
    /// Whether spheres touch the part across the axis.
    pub(super) has_far_side: bool,
}

/// A shape that a straight line makes when it goes around an axis.
pub(super) trait Revolved: Shape {
    /// The line.
    fn meridian(&self) -> Meridian;
}

impl<S: Revolved> EdgedShape for S {
    fn surface_of(&self, feature: u32, centre: Vector3, limit: f64) -> Option<FeatureSurface> {
        self.meridian().surface_of(feature, centre, limit)
    }

    fn features_near(&self, centre: Vector3, limit: f64, found: &mut Vec<(u32, f64)>) {
        self.meridian().features_near(centre, limit, found);
    }

    fn distance(&self, centre: Vector3) -> f64 {
        self.meridian().distance(centre)
    }

    fn outline(&self) -> Vec<[Vector3; 2]> {
        self.meridian().outline()
    }
}

/// The nearest point of the line.
struct Foot {
    /// Way along the line [m].
    along: f64,
    /// From there to the centre: away from the axis, and along it [m].
    gap: [f64; 2],
    /// Distance from the axis [m].
    radius: f64,
    distance: f64,
}

impl Meridian {
    /// From one end to another, each given by distance from the axis and height [m].
    pub(super) fn between(axis: Vector3, start: [f64; 2], end: [f64; 2], has_far_side: bool) -> Self {
        let (across, along) = (end[0] - start[0], end[1] - start[1]);
        let length = (across * across + along * along).sqrt();
        Self { axis, start, direction: [across / length, along / length], length, has_far_side }
    }

    /// Distance from the axis, and height [m].
    fn coordinates(&self, centre: Vector3) -> [f64; 2] {
        [centre.tangential_to(self.axis).norm(), centre.dot(self.axis)]
    }

    /// The nearest point on one side of the axis. From the far side, the centre has a negative distance from the axis.
    fn foot(&self, [from_axis, height]: [f64; 2]) -> Foot {
        let [across, along] = self.direction;
        let way = (from_axis - self.start[0]) * across + (height - self.start[1]) * along;
        let way = way.max(0.0).min(self.length);
        let radius = self.start[0] + across * way;
        let gap = [from_axis - radius, height - (self.start[1] + along * way)];
        Foot { along: way, gap, radius, distance: (gap[0] * gap[0] + gap[1] * gap[1]).sqrt() }
    }

    /// As of [`EdgedShape`](super::EdgedShape::surface_of).
    pub(super) fn surface_of(&self, feature: u32, centre: Vector3, limit: f64) -> Option<FeatureSurface> {
        let [from_axis, height] = self.coordinates(centre);
        let far = feature == FAR;
        let signed = if far { -from_axis } else { from_axis };
        let foot = self.foot([signed, height]);
        // At the tip of a cone both sides are one point.
        let is_near = foot.distance < limit;
        if !is_near || far && foot.radius <= 0.0 {
            return None;
        }
        let distance = foot.distance;
        let sideways = centre.tangential_to(self.axis);
        // On the axis, rounding errors have any direction; one across it serves.
        let is_on_axis = from_axis <= 1e-12 * height.abs() || from_axis == 0.0;
        let radial = if is_on_axis { across(self.axis) } else { sideways * (1.0 / from_axis) };
        let outwards = if far { -radial } else { radial };
        let [away, up] = if distance > 0.0 {
            foot.gap.map(|part| part / distance)
        } else {
            [-self.direction[1], self.direction[0]]
        };
        let tangent = self.axis.cross(outwards);
        // Near the axis the direction of the normal changes without bound; so fast no spring can turn.
        let least = 1e-6 * distance;
        let around = if signed.abs() > least { away / signed } else { 0.0 };
        // The middle of a disk is an end of the line, but no rim.
        let is_middle = self.is_flat() && self.start[0] <= 0.0;
        let is_at_end = foot.along <= 0.0 && !is_middle || foot.along >= self.length;
        let over_rim = if is_at_end && distance > 0.0 { 1.0 / distance } else { 0.0 };
        Some(FeatureSurface {
            normal: outwards * away + self.axis * up,
            distance,
            mean_curvature: self.mean_curvature(away, &foot),
            tangent,
            turning: [around, over_rim],
        })
    }

    /// A rim counts as curved as the surface that ends there, so that the stiffness of contacts passes it continuously: a
    /// disk is flat up to its rim.
    fn mean_curvature(&self, away: f64, foot: &Foot) -> f64 {
        if self.is_flat() || away == 0.0 {
            return 0.0;
        }
        let most = MOST_HOLLOW / foot.distance;
        let half = 0.5 * away.abs() / foot.radius;
        half.min(most) * away.signum()
    }

    fn is_flat(&self) -> bool {
        self.direction[1] == 0.0
    }

    /// As of [`EdgedShape`](super::EdgedShape::features_near).
    pub(super) fn features_near(&self, centre: Vector3, limit: f64, found: &mut Vec<(u32, f64)>) {
        let [from_axis, height] = self.coordinates(centre);
        let near = self.foot([from_axis, height]).distance;
        if near < limit {
            found.push((NEAR, near));
        }
        let far = self.foot([-from_axis, height]).distance;
        if self.has_far_side && far < limit {
            found.push((FAR, far));
        }
    }

    /// Distance of a point [m].
    pub(super) fn distance(&self, centre: Vector3) -> f64 {
        self.foot(self.coordinates(centre)).distance
    }

    /// The largest distance from the axis [m].
    pub(super) fn distance_from_axis(&self) -> f64 {
        let end = self.start[0] + if self.length.is_finite() { self.direction[0] * self.length } else { 0.0 };
        self.start[0].max(end)
    }

    /// The least mean curvature [1/m].
    pub(super) fn least_mean_curvature(&self) -> f64 {
        if self.is_flat() {
            return 0.0;
        }
        let end = self.start[0] + self.direction[0] * self.length;
        -0.5 / self.start[0].min(end)
    }

    /// The circles at both ends, and lines between them.
    pub(super) fn outline(&self) -> Vec<[Vector3; 2]> {
        let one = across(self.axis);
        let other = self.axis.cross(one);
        let at = |way: f64, side: u32, sides: u32| {
            let (sine, cosine) = elementary::sin_cos(TAU * f64::from(side) / f64::from(sides));
            let radius = self.start[0] + self.direction[0] * way;
            let height = self.start[1] + self.direction[1] * way;
            (one * cosine + other * sine) * radius + self.axis * height
        };
        let ends = [0.0, self.length].into_iter().filter(|way| way.is_finite());
        let round = ends.filter(|way| self.start[0] + self.direction[0] * way > 0.0);
        let circles = round
            .flat_map(|way| (0..SIDES).map(move |side| [at(way, side, SIDES), at(way, side + 1, SIDES)]));
        let lines = (0..LINES)
            .filter(|_| self.length.is_finite() && !self.is_flat())
            .map(|line| [at(0.0, line, LINES), at(self.length, line, LINES)]);
        circles.chain(lines).collect()
    }
}
