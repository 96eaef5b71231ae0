//! The same seed gives the same packing, on every machine and in every version.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_boundary::{Cuboid, Domain};
use pulvis_math::Vector3;
use pulvis_packing::{
    Lattice, RadiusDistribution, Structure, gaussian_vector, random_positions, random_stream,
};
use rand::RngExt;

/// A hash of the bits of numbers in their order.
fn hash(numbers: impl IntoIterator<Item = f64>) -> u64 {
    let mix =
        |hash: u64, number: f64| (hash.rotate_left(5) ^ number.to_bits()).wrapping_mul(0x517c_c1b7_2722_0a95);
    numbers.into_iter().fold(0, mix)
}

fn components(vectors: &[Vector3]) -> impl Iterator<Item = f64> + '_ {
    vectors.iter().flat_map(|vector| vector.to_array())
}

/// The hashes were taken from the code that drew packings before this crate was made. All
/// draws are from one stream, so that each also depends on how many numbers those before it have used.
#[test]
fn packings_of_a_seed_have_the_bits_that_they_always_had() {
    let mut random = random_stream(42);
    let uniform = RadiusDistribution::Uniform { minimum: 0.8e-3, maximum: 1.2e-3 };
    let (standard_deviation, minimum, maximum) = (2e-4, 0.9e-3, 1.3e-3);
    let normal = RadiusDistribution::Normal { mean: 1e-3, standard_deviation, minimum, maximum };
    let (minimum, maximum) = (0.7e-3, 2e-3);
    let log_normal = RadiusDistribution::LogNormal { median: 1e-3, sigma: 0.3, minimum, maximum };
    let list = RadiusDistribution::List { values: vec![1e-3, 2e-3, 3e-3], weights: vec![1.0, 3.0, 0.5] };
    let radii = [uniform, normal, log_normal, list].map(|distribution| {
        let drawn = distribution.draw(1000, &mut random).unwrap();
        hash(drawn)
    });
    let expected =
        [0x0833_d709_d627_fef4, 0x56a6_6d3e_f359_9b96, 0x27fa_8d89_7573_20a8, 0x9b97_3494_98a3_415c];
    assert_eq!(radii, expected);

    let lower = Vector3::new(1e-3, -2e-3, 0.3e-3);
    let lattice =
        Lattice { lower, counts: [3, 4, 5], spacing: 1.1e-3, jitter: 0.2, structure: Structure::SimpleCubic };
    let sites = lattice.positions(&mut random);
    assert_eq!(sites[0].x.to_bits(), 0x3f57_602d_2134_91e0);
    assert_eq!(hash(components(&sites)), 0x90f3_f435_ef8a_2965);

    let radii = RadiusDistribution::Uniform { minimum: 0.03, maximum: 0.08 }.draw(150, &mut random).unwrap();
    let cube = Cuboid { lower: Vector3::zero(), upper: Vector3::new(1.0, 1.0, 1.0) };
    let domain = Domain::periodic(cube.lower, cube.upper, [true, false, true]);
    let present = [(Vector3::new(0.5, 0.5, 0.5), 0.2)];
    let positions = random_positions(&radii, &cube, &domain, &present, &mut random).unwrap();
    assert_eq!(positions[0].x.to_bits(), 0x3fd7_832d_9ad8_bf9e);
    assert_eq!(hash(components(&positions)), 0xa2ae_9778_c477_3b8d);

    let gaussian = gaussian_vector(&mut random).to_array().map(f64::to_bits);
    assert_eq!(gaussian, [0x3ff3_fe0c_1126_aa60, 0xbfd7_ad5b_32e7_0122, 0xbfe5_1546_d1cd_f703]);
    assert_eq!(random.random::<f64>().to_bits(), 0x3fdf_b4d0_a6cb_b104);
}
