//! One contact, composed of its laws.

use std::borrow::Borrow;

use pulvis_math::Real;

use crate::bond::Bond;
use crate::catalogue::Parameter;
use crate::conventions::Conventions;
use crate::energy::ContactEnergies;
use crate::events;
use crate::expected::ExpectedLoading;
use crate::friction::{CommonFriction, ContactScale, Friction};
use crate::kinematics::{ContactInputs, ContactKinematics, NormalMotion, ROOM_TEMPERATURE};
use crate::levels;
use crate::memory::{Columns, MemoryLayout, MemorySlots};
use crate::noncontact::{self, NonContact};
use crate::normal::{Normal, NormalResponse, NormalSource};
use crate::pair::{Pair, Quantities, Sizes};
use crate::resistance::Resistance;
use crate::response::ContactResponse;
use crate::viscosity::{self, Viscosity};

/// Everything of a contact but its normal law: chosen at run time, the same for every contact of a
/// pair of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLaws {
    /// Attraction at a distance.
    pub noncontact: NonContact,
    /// Dashpot along the line of centres.
    pub viscosity: Viscosity,
    /// Resistance against sliding.
    pub sliding: Option<Friction>,
    /// Resistance against rolling.
    pub rolling: Option<Friction>,
    /// Resistance against torsion.
    pub torsion: Option<Friction>,
    /// Springs that hold the bodies together until they break.
    pub bond: Option<Bond>,
    /// Choices in which codes differ.
    pub conventions: Conventions,
    /// What the contacts are expected to go through.
    pub expected: ExpectedLoading,
}

impl Default for ContactLaws {
    fn default() -> Self {
        Self {
            noncontact: NonContact::None(noncontact::None),
            viscosity: Viscosity::None(viscosity::None),
            sliding: None,
            rolling: None,
            torsion: None,
            bond: None,
            conventions: Conventions::default(),
            expected: ExpectedLoading::default(),
        }
    }
}

/// All laws between two materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactModel {
    /// Force along the line of centres.
    pub normal: Normal,
    /// The rest of the contact.
    pub laws: ContactLaws,
}

impl ContactModel {
    /// A frictionless contact of one normal law.
    pub fn frictionless(normal: impl Into<Normal>) -> Self {
        Self { normal: normal.into(), laws: ContactLaws::default() }
    }

    /// How far beyond touching the contact acts [m] between the bodies of `pair` with these radii [m], zero for a wall.
    /// Greater bodies never act less far.
    pub fn interaction_range(&self, pair: &Pair, radii: [f64; 2]) -> f64 {
        let bond = self.laws.bond.map_or(0.0, |bond| bond.interaction_range(radii));
        self.normal.interaction_range(pair).max(self.laws.noncontact.interaction_range(pair)).max(bond)
    }

    /// Whether the forces between the bodies of `pair` depend on how fast these move, or on time.
    pub fn depends_on_time(&self, pair: &Pair) -> bool {
        self.normal.depends_on_time()
            || self.normal.dashpot(pair, &self.laws.expected) > 0.0
            || !matches!(self.laws.viscosity, Viscosity::None(_))
            || self.laws.has_resistance_dashpot()
    }

    /// Whether a law of it needs to know the temperature.
    pub fn needs_temperature(&self) -> bool {
        self.normal.needs_temperature()
    }

    /// The quantities of each particle that its laws read: those of the normal law, then those of the attraction.
    pub fn particle_quantities(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        let [normal, attraction] = self.quantities_by_law();
        normal.iter().chain(attraction)
    }

    /// The quantities that the normal law reads, and those that the attraction does.
    pub fn quantities_by_law(&self) -> [&'static [Parameter]; 2] {
        let (normal, attraction) = (self.normal.entry(), self.laws.noncontact.entry());
        let reads = self.laws.noncontact.reads_quantities();
        [normal.particle_quantities, if reads { attraction.particle_quantities } else { &[] }]
    }

    /// The quantities of two bodies that the laws read, in their order, from those `of` a name.
    pub fn quantities(&self, of: impl Fn(&str) -> [f64; 2]) -> Quantities {
        let mut quantities = Quantities::default();
        let slots = [&mut quantities.normal, &mut quantities.attraction];
        for (slots, read) in slots.into_iter().zip(self.quantities_by_law()) {
            for (slot, quantity) in slots.iter_mut().zip(read) {
                *slot = of(quantity.name);
            }
        }
        quantities
    }

    /// The same contact knowing the sizes of each particle quantity by its name: what bounds its stiffness and its range.
    #[must_use]
    pub fn bounded_by(mut self, sizes: impl Fn(&str) -> Sizes) -> Self {
        self.laws.noncontact = self.laws.noncontact.bounded_by(&sizes);
        self
    }

    /// Where and under which names the contact keeps what it remembers.
    pub fn memory_layout(&self) -> MemoryLayout {
        let of_friction = |friction: &Option<Friction>, role| {
            let entry = friction.as_ref().and_then(|law| law.entry(role));
            entry.map_or(("", &[][..]), |entry| (entry.name, entry.memory))
        };
        use crate::catalogue::Role;
        let (normal, attraction) = (self.normal.entry(), self.laws.noncontact.entry());
        let bond = self.laws.bond.as_ref().map(Bond::entry);
        MemoryLayout::new([
            (normal.name, normal.memory),
            of_friction(&self.laws.sliding, Role::Sliding),
            of_friction(&self.laws.rolling, Role::Rolling),
            of_friction(&self.laws.torsion, Role::Torsion),
            (attraction.name, attraction.memory),
            bond.map_or(("", &[][..]), |entry| (entry.name, entry.memory)),
        ])
    }

    /// The whole contact, for one pair or eight: updates the memory in `columns`, laid out as
    /// [`memory_layout`](Self::memory_layout) says, and answers with forces, torques and energies. `time_step` [s] is
    /// the step that led to `motion`. The temperature is that of a room.
    pub fn respond<R: Real>(
        &self,
        pair: &Pair<R>,
        motion: &ContactKinematics<R>,
        time_step: f64,
        columns: &mut [R],
    ) -> ContactResponse<R> {
        self.respond_at(pair, motion, [time_step, ROOM_TEMPERATURE], columns)
    }

    /// The same after a step [s] with a temperature in its middle [K].
    pub fn respond_at<R: Real>(
        &self,
        pair: &Pair<R>,
        motion: &ContactKinematics<R>,
        [time_step, temperature]: [f64; 2],
        columns: &mut [R],
    ) -> ContactResponse<R> {
        let slots = *self.memory_layout().slots();
        let inputs = ContactInputs { pair, motion, time_step, temperature };
        let (mut seen, mut bonded) = (*motion, None);
        if let Some(bond) = &self.laws.bond {
            let answer = bond.respond(inputs, slots.bond, columns);
            seen = answer.beside(motion);
            bonded = Some(answer);
        }
        // One call for both cases: all laws are inlined into it.
        let inputs = ContactInputs { motion: &seen, ..inputs };
        let mut response =
            self.laws.respond::<R, _, _, { levels::ALL }>(&self.normal, &slots, inputs, columns);
        if let Some(bonded) = bonded {
            bonded.add_to(&mut response);
        }
        response
    }

    /// How large and how stiff the contact of two bodies becomes under the loading that is expected.
    pub fn scale(&self, pair: &Pair) -> ContactScale {
        let expected = &self.laws.expected;
        ContactScale {
            contact_radius: self.normal.expected_contact_radius(pair, expected),
            normal_stiffness: self.normal.max_stiffness(pair, expected),
            harmonic_radius: pair.harmonic_radius(),
        }
    }

    /// Whether the engine's loops for common contacts can compute this one: they are compiled for the normal law
    /// itself, and hold nothing beside it but dashpots, its [common](crate::NormalLaw::COMMON_SLIDING) law against
    /// sliding, and spring-sliders against rolling and torsion.
    pub fn is_common(&self) -> bool {
        let laws = &self.laws;
        let is = |friction: &Option<Friction>, common| friction.as_ref().is_none_or(|law| law.is(common));
        self.normal.is_common()
            && laws.bond.is_none()
            && matches!(laws.noncontact, NonContact::None(_))
            && is(&laws.sliding, self.normal.common_sliding())
            && is(&laws.rolling, CommonFriction::SpringSlider)
            && is(&laws.torsion, CommonFriction::SpringSlider)
    }
}

impl ContactLaws {
    fn frictions(&self) -> impl Iterator<Item = &Friction> {
        [&self.sliding, &self.rolling, &self.torsion].into_iter().flatten()
    }

    /// Whether the contact resists that the bodies slide, roll or twist, or that they turn with a bond.
    pub fn has_friction(&self) -> bool {
        self.bond.is_some() || self.frictions().next().is_some()
    }

    /// Whether any of the laws against sliding, rolling and torsion, or the bond, has a dashpot.
    pub fn has_resistance_dashpot(&self) -> bool {
        self.bond.is_some_and(|bond| bond.springs.has_dashpot())
            || self.frictions().any(|friction| friction.dashpot() != 0.0)
    }

    /// Whether a law against sliding, rolling or torsion takes its stiffness from the radius of the contact area.
    pub fn needs_contact_radius(&self) -> bool {
        self.frictions().any(Friction::needs_contact_radius)
    }

    /// Whether a law against sliding, rolling or torsion takes its stiffness from that of the normal force.
    pub fn needs_normal_stiffness(&self) -> bool {
        self.frictions().any(Friction::needs_normal_stiffness)
    }

    /// Whether normal law, attraction and bond may lose energy: one that remembers nothing cannot.
    #[inline(always)]
    pub fn remembers_normal_motion(&self, slots: &MemorySlots) -> bool {
        slots.normal_columns() > 0 || slots.attraction < slots.bond || self.bond.is_some()
    }

    /// The lowest [level](levels) that leaves none of the contact's laws out.
    pub fn resistance_level(&self) -> u8 {
        if self.rolling.is_some() || self.torsion.is_some() || self.bond.is_some() {
            levels::ALL
        } else if self.sliding.is_some() {
            levels::SLIDING
        } else {
            levels::NONE
        }
    }

    /// The whole contact with the answer of the normal law from `normal`: updates the memory in `columns` and answers
    /// with forces, torques and energies. Of the sliding, rolling and torsion laws those are left out that the level
    /// `RESISTANCE` (see [`levels`]) does not hold; their code is not there. Where `normal` is that of a
    /// [common](ContactModel::is_common) contact, the code of attractions and of uncommon friction laws is not there
    /// either. Bonds are not among the laws: their answer comes beforehand, and says which overlap these laws see.
    #[inline(always)]
    pub fn respond<R, N, C, const RESISTANCE: u8>(
        &self,
        normal: &N,
        slots: &MemorySlots,
        inputs: ContactInputs<'_, R>,
        columns: &mut C,
    ) -> ContactResponse<R>
    where
        R: Real,
        N: NormalSource<R>,
        C: Columns<R> + ?Sized,
    {
        let ContactInputs { pair, motion, time_step, temperature } = inputs;
        let along = NormalMotion::new(pair, motion, time_step, temperature);
        let answer = normal.respond(&along, columns);
        let elastic: &NormalResponse<R> = answer.borrow();
        let mut coefficient = elastic.dashpot;
        if !matches!(self.viscosity, Viscosity::None(_)) {
            coefficient += self.viscosity.coefficient(pair, along.depth, elastic);
        }
        let dashpot = coefficient * along.closing_rate;
        let viscous = dashpot.keep_where(elastic.in_contact);
        let [applied_viscous, closing] = if N::DASHPOT || !matches!(self.viscosity, Viscosity::None(_)) {
            events::of_dashpot(&along, elastic, dashpot)
        } else {
            [viscous, along.closing_rate]
        };
        let mut normal_force = elastic.applied_force + applied_viscous;
        let mut energies = ContactEnergies {
            elastic_normal: elastic.stored_energy,
            adhesive_potential: elastic.adhesive_potential,
            dissipated_plastic: elastic.dissipated_plastic,
            dissipated_adhesive: elastic.dissipated_adhesive,
            dissipated_thermal: elastic.dissipated_thermal,
            viscous_power: applied_viscous * closing,
            ..ContactEnergies::default()
        };
        let mut attraction_force = R::zero();
        let mut event_force = elastic.applied_force - elastic.force + (applied_viscous - viscous);
        if N::COMMON.is_none() && !matches!(self.noncontact, NonContact::None(_)) {
            let attraction = self.noncontact.respond(&along, columns, slots.attraction);
            normal_force += attraction.applied_force;
            event_force += attraction.applied_force - attraction.force;
            attraction_force = attraction.force;
            energies.attract(self.noncontact.account(), attraction.potential, attraction.dissipated);
        }
        let force = motion.normal * normal_force;
        let stiffness = elastic.stiffness;
        let mut response = ContactResponse {
            normal_force,
            event_force,
            force,
            stiffness,
            energies,
            ..ContactResponse::default()
        };
        if RESISTANCE >= levels::SLIDING {
            let reference = self.conventions.friction_reference(
                elastic.friction_reference,
                elastic.force,
                viscous,
                attraction_force,
            );
            let step = Resistance::new::<N>(&self.conventions, inputs, elastic, reference);
            if let Some(friction) = &self.sliding {
                let start = slots.sliding::<RESISTANCE>(N::COLUMNS);
                step.slide::<N, C>(friction, start, columns, &mut response);
            }
            if RESISTANCE >= levels::ALL && (self.rolling.is_some() || self.torsion.is_some()) {
                let levers = step.levers();
                if let Some(friction) = &self.rolling {
                    step.roll::<N, C>(friction, levers, slots.rolling, columns, &mut response);
                }
                if let Some(friction) = &self.torsion {
                    step.twist::<N, C>(friction, levers, slots.torsion, columns, &mut response);
                }
            }
        }
        response
    }
}
