//! Level 1 of the house: ONE contact.
//!
//! A contact is composed of a normal law, an attraction at a distance, a dashpot, and resistance
//! against sliding, rolling and torsion. Each law is one file that holds its formula, written once
//! over the scalar trait [`pulvis_math::Real`], and its description for the [`catalogue`]. Memory
//! is plain columns of numbers. Closed forms that laws are verified against stand in [`theory`].
//!
//! ```
//! use pulvis_contact::catalogue::Values;
//! use pulvis_contact::{Normal, NormalLaw, NormalMotion, Pair};
//!
//! let values = Values::new().with("k1", 100.0).with("kp", 500.0).with("kc", 100.0).with("phi_f", 0.05);
//! let law = Normal::build("luding", &values).expect("the law exists").expect("valid parameters");
//! let Normal::Luding(luding) = law else { unreachable!() };
//! let pair = Pair::spheres(1e-6, 1e-6, 1e-3, 1e-3);
//! let mut memory = Default::default();
//! // Virgin loading follows k1.
//! let motion = NormalMotion::at_rest(&pair, 1e-6);
//! assert!((luding.respond(&motion, &mut memory).force - 1e-4).abs() < 1e-18);
//! ```

pub mod bond;
pub mod catalogue;
pub mod conventions;
mod energy;
pub mod events;
mod expected;
pub mod friction;
pub mod functions;
mod kinematics;
pub mod levels;
pub mod memory;
mod model;
pub mod noncontact;
pub mod normal;
pub mod pair;
mod resistance;
mod response;
pub mod theory;
mod time_scales;
pub mod viscosity;

pub use bond::Bond;
pub use conventions::Conventions;
pub use energy::{AttractionAccount, ContactEnergies};
pub use expected::ExpectedLoading;
pub use friction::{ContactScale, Friction, Mindlin, SpringSlider};
pub use kinematics::{ContactInputs, ContactKinematics, NormalMotion, ROOM_TEMPERATURE};
pub use memory::{Columns, Memory, MemoryLayout, MemorySlots};
pub use model::{ContactLaws, ContactModel};
pub use noncontact::NonContact;
pub use normal::{
    Dahneke, Dmt, Hertz, Jkr, LeeRadok, Linear, Luding, Normal, NormalLaw, NormalLawVisitor, NormalResponse,
    ThorntonNing, ViscoelasticJkr, WaltonJohnson,
};
pub use pair::{MOST_QUANTITIES, Pair, Quantities, Sizes};
pub use response::ContactResponse;
pub use time_scales::Partner;
pub use viscosity::Viscosity;
