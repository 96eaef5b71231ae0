//! Observation of regions: sums over particles and contacts, with all threads, the same for any number of them.

use pulvis_boundary::Region;
use pulvis_math::Vector3;

use super::Simulation;
use crate::contacts::{ContactPartner, ContactView};
use crate::observation::{LEAST_CONTACTS, Observation, ObservationPlan, add_product};

/// What the contacts of a chunk come to.
#[derive(Debug, Default)]
struct Part {
    /// Region by region.
    sums: Vec<Observation>,
    /// Rows of touching pairs, if rattlers are looked for.
    pairs: Vec<[u32; 2]>,
    /// Rows that touch walls, once for each contact, if rattlers are looked for.
    at_walls: Vec<u32>,
}

impl Simulation {
    /// Observes the present state, region by region as in `plan`. Regions beyond
    /// [`MOST_REGIONS`](ObservationPlan::MOST_REGIONS) hold nothing.
    pub fn observe(&self, plan: &ObservationPlan) -> Vec<Observation> {
        let inside = self.inside(&plan.regions);
        let mut observed: Vec<Observation> =
            (0..plan.regions.len()).map(|number| self.observe_particles(&inside, number)).collect();
        if plan.contacts {
            let parts = self.gather_contacts_of_rows(|part: &mut Part, contact, rows| {
                self.observe_contact(plan, &inside, part, contact, rows);
            });
            for part in &parts {
                observed.iter_mut().zip(&part.sums).for_each(|(sum, part)| add(sum, part));
            }
            if plan.rattlers {
                self.observe_rattlers(plan, &inside, &parts, &mut observed);
            }
        }
        observed
    }

    /// The normal forces of all touching contacts of a region, repulsion positive [N], each with the share of the
    /// contact that lies in the region.
    pub fn normal_forces(&self, region: Option<&Region>) -> Vec<(f64, f64)> {
        let parts = self.gather_contacts(|forces: &mut Vec<(f64, f64)>, contact| {
            if contact.overlap > 0.0 {
                let share = self.share(region, contact);
                if share > 0.0 {
                    forces.push((contact.normal_force, share));
                }
            }
        });
        parts.into_iter().flatten().collect()
    }

    /// The regions that hold each row, a bit for each.
    fn inside(&self, regions: &[Option<Region>]) -> Vec<u64> {
        let (particles, domain) = (&self.particles, &self.domain);
        let mut inside = Vec::new();
        self.pool.fill(&mut inside, particles.len(), |row| {
            let holds = |region: &Option<Region>| match region {
                None => true,
                Some(region) => region.contains(particles.position[row].vector, domain),
            };
            let numbered = regions.iter().take(ObservationPlan::MOST_REGIONS).enumerate();
            numbered.fold(0, |bits, (number, region)| bits | u64::from(holds(region)) << number)
        });
        inside
    }

    fn observe_particles(&self, inside: &[u64], number: usize) -> Observation {
        let particles = &self.particles;
        let sums: [f64; 12] = self.pool.sum_over(particles.len(), |rows| {
            let mut sums = [0.0; 12];
            for row in rows.filter(|&row| is_in(inside[row], number)) {
                let mass = particles.mass[row];
                // Relative to the flow of a cell that deforms.
                let v = particles.velocity[row].vector;
                let momentum = v * mass;
                let parts = [
                    1.0,
                    volume(particles.radius[row]),
                    mass,
                    momentum.x,
                    momentum.y,
                    momentum.z,
                    mass * v.x * v.x,
                    mass * v.y * v.y,
                    mass * v.z * v.z,
                    mass * v.x * v.y,
                    mass * v.x * v.z,
                    mass * v.y * v.z,
                ];
                sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
            }
            sums
        });
        let [count, solid, mass, px, py, pz, xx, yy, zz, xy, xz, yz] = sums;
        Observation {
            particles: count,
            solid_volume: solid,
            mass,
            momentum: Vector3::new(px, py, pz),
            kinetic: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            rattlers: f64::NAN,
            corrected_ends: f64::NAN,
            wall_forces: vec![Vector3::zero(); self.walls.len()],
            ..Observation::default()
        }
    }

    /// Adds a contact to all regions that it belongs to.
    fn observe_contact(
        &self,
        plan: &ObservationPlan,
        inside: &[u64],
        part: &mut Part,
        contact: &ContactView<'_>,
        [first, second]: [usize; 2],
    ) {
        if part.sums.is_empty() {
            let none =
                Observation { wall_forces: vec![Vector3::zero(); self.walls.len()], ..Default::default() };
            part.sums = vec![none; plan.regions.len()];
        }
        let branch = contact.centre_first - contact.centre_second;
        let normal = (branch * (1.0 / branch.norm())).to_array();
        let touching = contact.overlap > 0.0;
        let radius = &self.particles.radius;
        let (mut ends, mut count) = ([(inside[first], volume(radius[first])); 2], 1);
        if matches!(contact.second, ContactPartner::Particle(_)) {
            ends[1] = (inside[second], volume(radius[second]));
            count = 2;
        }
        for (number, (region, sums)) in plan.regions.iter().zip(&mut part.sums).enumerate() {
            if touching {
                for (_, volume) in ends.iter().take(count).filter(|(inside, _)| is_in(*inside, number)) {
                    sums.contact_ends += 1.0;
                    add_product(&mut sums.volume_fabric_sum, normal, normal, *volume);
                }
            }
            if let ContactPartner::Wall(wall) = contact.second
                && region.is_none_or(|region| region.contains(contact.centre_second, &self.domain))
            {
                sums.wall_forces[wall] -= contact.force;
            }
            let share = self.share(region.as_ref(), contact);
            if share > 0.0 {
                add_share(sums, contact, branch, normal, share);
            }
        }
        if plan.rattlers && touching {
            match contact.second {
                ContactPartner::Particle(_) => part.pairs.push([first as u32, second as u32]),
                ContactPartner::Wall(_) => part.at_walls.push(first as u32),
            }
        }
    }

    /// The share of a contact that lies in a region.
    fn share(&self, region: Option<&Region>, contact: &ContactView<'_>) -> f64 {
        let whole =
            |region: &Region| region.share_of_line(contact.centre_first, contact.centre_second, &self.domain);
        region.map_or(1.0, whole)
    }

    /// Counts rattlers, and the contacts of all others among themselves and with walls.
    fn observe_rattlers(
        &self,
        plan: &ObservationPlan,
        inside: &[u64],
        parts: &[Part],
        observed: &mut [Observation],
    ) {
        let mut known: Option<(u32, Vec<u32>)> = None;
        for (number, sums) in observed.iter_mut().enumerate() {
            let least = plan.least_contacts.get(number).copied().unwrap_or(LEAST_CONTACTS);
            // Most often all regions have the same.
            let (_, carrying) = match known.take().filter(|(of, _)| *of == least) {
                Some(same) => known.insert(same),
                None => known.insert((least, contacts_without_rattlers(self.particles.len(), parts, least))),
            };
            let counts: [f64; 2] = self.pool.sum_over(carrying.len(), |rows| {
                let mut counts = [0.0; 2];
                for row in rows.filter(|&row| is_in(inside[row], number)) {
                    counts[0] += f64::from(u8::from(carrying[row] < least));
                    counts[1] += f64::from(carrying[row]);
                }
                counts
            });
            [sums.rattlers, sums.corrected_ends] = counts;
        }
    }
}

/// Whether a region is among those of a row.
fn is_in(inside: u64, number: usize) -> bool {
    number < ObservationPlan::MOST_REGIONS && inside >> number & 1 == 1
}

fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius
}

/// Adds a contact with its share.
fn add_share(
    sums: &mut Observation,
    contact: &ContactView<'_>,
    branch: Vector3,
    normal: [f64; 3],
    share: f64,
) {
    add_product(&mut sums.virial, contact.force.to_array(), branch.to_array(), share);
    if contact.overlap > 0.0 {
        sums.contacts += share;
        add_product(&mut sums.fabric_sum, normal, normal, share);
        sums.normal_force_sum += share * contact.normal_force;
        sums.overlap_force_sum += share * contact.normal_force * contact.overlap;
        sums.normal_force_max = sums.normal_force_max.max(contact.normal_force);
        if contact.normal_force < 0.0 {
            sums.tensile += share;
        }
    }
}

/// Adds the sums over the contacts of a chunk.
fn add(sum: &mut Observation, part: &Observation) {
    // What particles come to is not in parts.
    let Observation {
        particles: _,
        solid_volume: _,
        mass: _,
        momentum: _,
        kinetic: _,
        contacts,
        contact_ends,
        rattlers: _,
        corrected_ends: _,
        virial,
        fabric_sum,
        volume_fabric_sum,
        normal_force_sum,
        overlap_force_sum,
        normal_force_max,
        tensile,
        wall_forces,
    } = part;
    sum.contacts += contacts;
    sum.contact_ends += contact_ends;
    sum.normal_force_sum += normal_force_sum;
    sum.overlap_force_sum += overlap_force_sum;
    sum.normal_force_max = sum.normal_force_max.max(*normal_force_max);
    sum.tensile += tensile;
    let tensors = [
        (&mut sum.virial, virial),
        (&mut sum.fabric_sum, fabric_sum),
        (&mut sum.volume_fabric_sum, volume_fabric_sum),
    ];
    for (sum, part) in tensors {
        sum.iter_mut().flatten().zip(part.iter().flatten()).for_each(|(sum, part)| *sum += part);
    }
    sum.wall_forces.iter_mut().zip(wall_forces).for_each(|(sum, part)| *sum += *part);
}

/// The number of contacts of each row with rows that are no rattlers, and with walls; zero of rattlers. Which rows stay does
/// not depend on the order in which others are taken away.
fn contacts_without_rattlers(rows: usize, parts: &[Part], least: u32) -> Vec<u32> {
    let pairs = || parts.iter().flat_map(|part| &part.pairs);
    let mut counts = vec![0_u32; rows];
    for row in parts.iter().flat_map(|part| &part.at_walls).chain(pairs().flatten()) {
        counts[*row as usize] += 1;
    }
    // Partners, row by row.
    let mut starts = vec![0_u32; rows + 1];
    pairs().flatten().for_each(|&row| starts[row as usize + 1] += 1);
    for row in 0..rows {
        starts[row + 1] += starts[row];
    }
    let mut next = starts.clone();
    let mut partners = vec![0_u32; starts[rows] as usize];
    for &[one, other] in pairs() {
        for (row, partner) in [(one, other), (other, one)] {
            partners[next[row as usize] as usize] = partner;
            next[row as usize] += 1;
        }
    }
    let mut taken: Vec<bool> = counts.iter().map(|&count| count < least).collect();
    let mut waiting: Vec<u32> = (0..rows as u32).filter(|&row| taken[row as usize]).collect();
    while let Some(row) = waiting.pop() {
        let row = row as usize;
        counts[row] = 0;
        for &partner in &partners[starts[row] as usize..starts[row + 1] as usize] {
            let partner = partner as usize;
            if taken[partner] {
                continue;
            }
            counts[partner] -= 1;
            if counts[partner] < least {
                taken[partner] = true;
                waiting.push(partner as u32);
            }
        }
    }
    counts
}
