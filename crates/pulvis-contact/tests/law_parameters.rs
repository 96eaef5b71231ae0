//! Parameters that are valid one by one and do not fit together; and the time that they leave a step.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_contact::catalogue::{InvalidParameter, Role, Values};
use pulvis_contact::{ContactLaws, ContactModel, Friction, Linear, Normal, SpringSlider, friction};

fn luding(k1: f64, kp: f64) -> Result<Normal, InvalidParameter> {
    let values = Values::new().with("k1", k1).with("kp", kp).with("kc", 0.0).with("phi_f", 0.05);
    Normal::build("luding", &values).unwrap()
}

#[test]
fn a_contact_that_unloads_more_softly_than_it_loads_is_refused() {
    assert!(luding(100.0, 100.0).is_ok());
    let error = luding(100.0, 99.0).unwrap_err();
    assert_eq!(error.name(), "kp");
    assert!(error.to_string().contains("kp >= k1 = 100 N/m"), "{error}");
}

#[test]
fn static_friction_below_dynamic_friction_is_refused_in_every_role() {
    for (role, stiffness, dynamic, fixed) in [
        (Role::Sliding, "kt", "mu", "mu_static"),
        (Role::Rolling, "kr", "mu_r", "mu_r_static"),
        (Role::Torsion, "ko", "mu_o", "mu_o_static"),
    ] {
        let values = Values::new().with(stiffness, 1.0).with(dynamic, 0.5);
        let built = |values: &Values| friction::build(role, "spring-slider", values).unwrap();
        // Not given, it equals the dynamic one.
        let Some(Friction::SpringSlider(slider)) = built(&values).unwrap() else { panic!("a spring-slider") };
        assert_eq!(slider.static_coefficient, 0.5);
        assert!(built(&values.clone().with(fixed, 0.5)).is_ok());
        assert_eq!(built(&values.with(fixed, 0.4)).unwrap_err().name(), fixed);
    }
}

#[test]
fn a_linear_spring_or_dashpot_given_twice_or_not_at_all_is_refused() {
    let refused = |values: Values| Normal::build("linear", &values).unwrap().unwrap_err().name().to_owned();
    assert_eq!(refused(Values::new()), "k");
    assert_eq!(refused(Values::new().with("k", 1.0).with("contact_time", 1.0)), "contact_time");
    assert_eq!(refused(Values::new().with("contact_time", 1.0)), "restitution");
    let two = Values::new().with("k", 1.0).with("gamma_0", 0.0).with("restitution", 0.5);
    assert_eq!(refused(two), "restitution");
    let two = Values::new().with("k", 1.0).with("restitution", 0.5).with("damping_rate", 1.0);
    assert_eq!(refused(two), "damping_rate");
}

fn spring(stiffness: f64) -> Option<Friction> {
    let slider = SpringSlider { stiffness, dashpot: 0.0, dynamic_coefficient: 1.0, static_coefficient: 1.0 };
    Some(slider.into())
}

#[test]
fn sliding_and_rolling_springs_of_a_sphere_at_a_wall_stiffen_each_other() {
    // Along the wall the sphere has the coordinates (x, a φ) with masses m and 2/5 m, and stiffnesses
    // k_t (x + a φ)² and k_r (2 a φ)²: the larger root of λ² − λ (7/2 k_t + 10 k_r)/m + 10 k_t k_r/m² = 0.
    let (mass, radius, sliding, rolling) = (2e-6, 1e-3, 300.0, 70.0);
    let laws = ContactLaws { sliding: spring(sliding), rolling: spring(rolling), ..ContactLaws::default() };
    let model = ContactModel { normal: Linear::new(1.0, 0.0).into(), laws };
    let half_trace = 0.5 * (3.5 * sliding + 10.0 * rolling) / mass;
    let determinant = 10.0 * sliding * rolling / (mass * mass);
    let highest = half_trace + (half_trace * half_trace - determinant).sqrt();
    let time = model.shortest_contact_time((mass, radius), None);
    assert!((time * highest.sqrt() / std::f64::consts::PI - 1.0).abs() < 1e-12, "{time} s");
}

#[test]
fn equal_spheres_slide_and_roll_independently() {
    let body = (2e-6, 1e-3);
    let time = |sliding, rolling| {
        let laws = ContactLaws { sliding, rolling, ..ContactLaws::default() };
        let model = ContactModel { normal: Linear::new(1.0, 0.0).into(), laws };
        model.shortest_contact_time(body, Some(body))
    };
    let together = time(spring(300.0), spring(70.0));
    assert_eq!(together, time(spring(300.0), None).min(time(None, spring(70.0))));
}

#[test]
fn no_memory_column_has_the_name_of_what_files_say_of_every_contact() {
    let taken = ["id1", "id2", "force", "normal_force", "overlap"];
    for entry in Normal::ENTRIES {
        for column in entry.memory {
            let name = column.split(' ').next().unwrap();
            assert!(!taken.contains(&name), "{}: {column}", entry.name);
        }
    }
}
