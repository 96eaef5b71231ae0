//! What bonds promise on any path: the work that was done on them is stored, or was lost by breaking.

use pulvis_contact::bond::{BROKEN, Bond, BondStiffness, Dashpots};
use pulvis_contact::{ContactKinematics, ContactModel, ContactResponse, Linear, Pair};
use pulvis_math::Vector3;

use crate::contact::random_bond;
use crate::draw::Draw;
use crate::for_each_case;

/// Checks `count` random closed paths of overlap, shear, bending and twist, in steps of any length.
pub fn check_all(count: u64) {
    for_each_case("closed paths of bonds", count, |draw| {
        let Some(mut bond) = random_bond(draw) else { panic!("a bond of the catalogue") };
        // Rates jump at turning points, and the power of dashpots with them.
        bond.springs.dashpots = Dashpots::default();
        no_closed_path_gains_energy(&bond, draw);
    });
}

/// Overlap [m], shear [m], bending and twist [rad].
type Pose = [f64; 4];

/// A bond between two equal spheres on a path.
struct Led {
    model: ContactModel,
    columns: Vec<f64>,
    radius: f64,
    pose: Pose,
    last: ContactResponse<f64>,
    work: f64,
    turned_over: f64,
    lost: f64,
}

impl Led {
    fn new(bond: &Bond, radius: f64) -> Self {
        let mut model = ContactModel::frictionless(Linear::new(f64::MIN_POSITIVE, 0.0));
        model.laws.bond = Some(*bond);
        let mut columns = vec![0.0; model.memory_layout().columns()];
        let mut led = Self {
            model,
            radius,
            pose: [0.0; 4],
            last: ContactResponse::default(),
            work: 0.0,
            turned_over: 0.0,
            lost: 0.0,
            columns: Vec::new(),
        };
        model.form_bond(0.0, &mut columns);
        led.columns = columns;
        // A bond by touch forms in a first look at bodies that overlap.
        led.go([f64::MIN_POSITIVE, 0.0, 0.0, 0.0]);
        led
    }

    /// Goes straight to a pose in one step of 1 s.
    fn go(&mut self, pose: Pose) {
        let change: Pose = std::array::from_fn(|motion| pose[motion] - self.pose[motion]);
        self.pose = pose;
        let spin = Vector3::new(change[3], 0.0, change[2]) * 0.5;
        let motion = ContactKinematics {
            normal: Vector3::new(1.0, 0.0, 0.0),
            overlap: pose[0],
            inverse_distance: 0.0,
            normal_rate: None,
            radius_i: self.radius,
            radius_j: self.radius,
            velocity: Vector3::zero(),
            velocity_mid: Vector3::new(-change[0], change[1], 0.0),
            angular_velocity_i: Vector3::zero(),
            angular_velocity_j: Vector3::zero(),
            angular_velocity_i_mid: spin,
            angular_velocity_j_mid: -spin,
        };
        let pair = Pair::spheres(1.0, 1.0, self.radius, self.radius);
        let answer = self.model.respond(&pair, &motion, 1.0, &mut self.columns);
        let work = |answer: &ContactResponse<f64>| {
            -(answer.force.dot(motion.velocity_mid)
                + answer.torque_i.dot(motion.angular_velocity_i_mid)
                + answer.torque_j.dot(motion.angular_velocity_j_mid))
        };
        // In the step of breaking both half kicks of the force at its end belong to the time before it.
        let breaks = answer.energies.dissipated_fracture > 0.0;
        let done = 0.5 * work(&self.last) + if breaks { work(&answer) } else { 0.5 * work(&answer) };
        self.work += done;
        self.turned_over += done.abs();
        self.lost += answer.energies.dissipated_fracture;
        self.last = if breaks { ContactResponse::default() } else { answer };
    }

    fn is_broken(&self) -> bool {
        let column = self.model.memory_layout().column("bond_state").expect("the column of the state");
        self.columns[column] == BROKEN
    }
}

/// Half of the squares of a pose times the stiffnesses [J].
fn energy(bond: &Bond, radius: f64, pose: &Pose) -> f64 {
    let BondStiffness { normal, shear, bending, torsion, .. } = bond.stiffness_at_touch([radius; 2]);
    let parts = [normal, shear, bending, torsion].into_iter().zip(pose);
    parts.map(|(stiffness, stretch)| 0.5 * stiffness * stretch * stretch).sum()
}

fn no_closed_path_gains_energy(bond: &Bond, draw: &mut Draw) {
    let radius = 1e-3 * draw.log_between(0.3, 3.0);
    let mut led = Led::new(bond, radius);
    // Of the extension at which the bond breaks.
    let extension = bond.interaction_range([radius; 2]) - bond.formation.distance;
    let scale = (extension * draw.log_between(0.03, 3.0)).min(0.1 * radius);
    let mut corners: Vec<Pose> = (0..3 + (draw.unit() * 5.0) as usize)
        .map(|_| {
            let mut size = |scale: f64| scale * draw.between(-1.0, 1.0);
            [size(scale), size(scale), size(scale / radius), size(scale / radius)]
        })
        .collect();
    let start = led.pose;
    corners.push(start);
    // What the bond would store without breaking: the instant of breaking is known to 1e-12 of a step.
    let unbroken = corners.iter().map(|corner| energy(bond, radius, corner)).fold(0.0, f64::max);
    for corner in corners {
        let from = led.pose;
        let steps = 1 + (draw.unit() * 4.0) as u32;
        for step in 1..=steps {
            let part = f64::from(step) / f64::from(steps);
            led.go(std::array::from_fn(|motion| from[motion] + (corner[motion] - from[motion]) * part));
        }
    }
    let stored = led.last.energies.elastic_bond;
    // Springs are linear, so that the mean of two forces does the work of a step of any length; round-off of differences.
    let error = (led.work - stored - led.lost).abs();
    let scale = led.turned_over + led.lost + 1e-2 * unbroken;
    assert!(error <= 1e-9 * scale, "{error} J of {scale} J, broken: {}, {bond:?}", led.is_broken());
    assert!(led.lost >= 0.0 && stored <= 1e-9 * scale.max(f64::MIN_POSITIVE), "{stored} J, {bond:?}");
    assert!(led.work >= -1e-9 * scale, "{} J, {bond:?}", led.work);
}
