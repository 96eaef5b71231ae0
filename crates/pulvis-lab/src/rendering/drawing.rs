//! The scene of one frame.

use pulvis_input::scenario::Scenario;
use pulvis_io::picture::{Edge, OutlineCylinder, Paint, Scene, Tube};
use pulvis_io::vtk::Frame;
use pulvis_io::{Colour, ColourMap};

use super::error::RenderError;
use super::extent::Extent;
use super::plan::{Paints, Plan};
use super::quantity::{Contacts, Quantity};
use super::view::Direction;

/// Radius of the thickest tubes over the median radius of the particles.
const THICKEST: f64 = 0.4;

/// Size of particles that show their contacts.
const SHRUNK: f64 = 0.3;

/// Tubes whose force has no place in the colour bar.
const PUSH: Colour = Colour::new(0xA8, 0x30, 0x28);
const PULL: Colour = Colour::new(0x2B, 0x6C, 0xB0);

/// The walls of a frame.
#[derive(Debug, Default)]
pub(super) struct Walls {
    pub(super) edges: Vec<Edge>,
    pub(super) cylinders: Vec<OutlineCylinder>,
}

impl Walls {
    pub(super) fn of(frame: &Frame) -> Self {
        let radii = frame.walls.scalar("radius").unwrap_or_default();
        let mut walls = Self::default();
        for (ends, radius) in frame.walls.lines().into_iter().zip(radii) {
            if radius > 0.0 {
                walls.cylinders.push(OutlineCylinder { ends, radius });
            } else {
                walls.edges.push(ends);
            }
        }
        walls
    }
}

/// Radii of the particles \[m\].
pub(super) fn radii(frame: &Frame) -> Result<Vec<f64>, RenderError> {
    frame.particles.scalar("radius").ok_or(RenderError::Column("radius"))
}

/// What a picture shows of a frame.
#[derive(Debug)]
pub(super) struct Drawing {
    walls: Walls,
    centres: Vec<[f64; 3]>,
    radii: Vec<f64>,
    values: Vec<f64>,
    tubes: Vec<Tube>,
    range: Option<[f64; 2]>,
    colours: ColourMap,
    bar_label: String,
    classes: Vec<String>,
    title: String,
    caption: String,
}

impl Drawing {
    /// # Errors
    /// The frame has not the columns that are asked for.
    pub(super) fn of(
        frame: &Frame,
        time: f64,
        plan: &Plan,
        paints: &Paints,
        extent: &Extent,
        scenario: Option<&Scenario>,
    ) -> Result<Self, RenderError> {
        let all_radii = radii(frame)?;
        let limits = extent.limits.unwrap_or_default();
        let kept: Vec<bool> = frame
            .particles
            .points
            .iter()
            .map(|&centre| plan.clips.iter().all(|clip| clip.keeps(centre, limits)))
            .collect();
        let size = if plan.contacts { SHRUNK } else { 1.0 };
        let mut drawing = Self {
            walls: Walls::of(frame),
            centres: filtered(&frame.particles.points, &kept),
            radii: filtered(&all_radii, &kept).iter().map(|radius| size * radius).collect(),
            values: Vec::new(),
            tubes: Vec::new(),
            range: extent.range(),
            colours: ColourMap::Viridis,
            bar_label: String::new(),
            classes: Vec::new(),
            title: title(scenario, time),
            caption: String::new(),
        };
        match paints {
            Paints::Particles(quantity) => {
                let values = quantity.values(frame, Direction::of(plan.view.0))?;
                drawing.colour(quantity, filtered(&values, &kept), extent, scenario);
            }
            Paints::Forces => {
                drawing.bar_label = "normal force [N]".to_owned();
                drawing.show_signs();
            }
        }
        if plan.contacts {
            let thickest = THICKEST * median(&all_radii);
            drawing.tubes = tubes(frame, &kept, *paints == Paints::Forces, thickest, extent.force)?;
            let force = pulvis_io::plot::amount("force [N]", extent.force);
            let colours = if *paints == Paints::Forces { "" } else { "tubes: red pushes, blue pulls; " };
            drawing.caption = format!("{colours}the thickest tubes are normal forces of {force} and more");
        }
        Ok(drawing)
    }

    fn colour(
        &mut self,
        quantity: &Quantity,
        mut values: Vec<f64>,
        extent: &Extent,
        scenario: Option<&Scenario>,
    ) {
        match quantity {
            Quantity::Material => {
                let known: Vec<usize> = extent.materials.iter().copied().collect();
                let name = |kind: &usize| {
                    let material = scenario.and_then(|scenario| scenario.materials.get(*kind));
                    material.map_or_else(|| format!("material {kind}"), |material| material.name.clone())
                };
                self.classes = known.iter().map(name).collect();
                for value in &mut values {
                    let kind = known.binary_search(&(value.max(0.0) as usize));
                    *value = kind.map_or(f64::NAN, |number| number as f64);
                }
            }
            Quantity::Depth => {
                values.iter_mut().for_each(|value| *value -= extent.values[0]);
                self.range = self.range.map(|[low, high]| [0.0, high - low]);
            }
            _ if quantity.is_signed() => self.show_signs(),
            _ => {}
        }
        self.values = values;
        self.bar_label = quantity.label(scenario);
    }

    /// Both signs are shown against zero, in colours that differ.
    fn show_signs(&mut self) {
        if let Some([low, high]) = self.range.filter(|[low, high]| *low < 0.0 && *high > 0.0) {
            let most = high.max(-low);
            (self.range, self.colours) = (Some([-most, most]), ColourMap::BlueRed);
        }
    }

    /// The scene; of a sequence, all of `limits`.
    pub(super) fn with_scene<T>(
        &self,
        plan: &Plan,
        limits: Option<[[f64; 3]; 2]>,
        draw: impl FnOnce(&Scene<'_>) -> T,
    ) -> T {
        let classes: Vec<&str> = self.classes.iter().map(String::as_str).collect();
        draw(&Scene {
            tubes: &self.tubes,
            range: self.range,
            colours: self.colours,
            classes: &classes,
            view: plan.view.0,
            projection: plan.projection,
            limits,
            width: plan.size[0],
            height: plan.size[1],
            title: &self.title,
            bar_label: &self.bar_label,
            caption: &self.caption,
            edges: &self.walls.edges,
            cylinders: &self.walls.cylinders,
            scale_bar: true,
            paper: plan.paper,
            ..Scene::new(&self.centres, &self.radii, &self.values)
        })
    }
}

/// What the run is called, and the time.
fn title(scenario: Option<&Scenario>, time: f64) -> String {
    let instant = format!("t = {}", pulvis_io::plot::amount("time [s]", time));
    let title = scenario.and_then(|scenario| scenario.title.as_ref());
    title.map_or_else(|| instant.clone(), |title| format!("{title}, {instant}"))
}

fn filtered<T: Copy>(values: &[T], kept: &[bool]) -> Vec<T> {
    values.iter().zip(kept).filter(|(_, kept)| **kept).map(|(&value, _)| value).collect()
}

/// The contacts between particles that are shown, and with walls, as thick as their force is large.
fn tubes(
    frame: &Frame,
    kept: &[bool],
    in_bar: bool,
    thickest: f64,
    strong: f64,
) -> Result<Vec<Tube>, RenderError> {
    let is_shown = |row: Option<usize>| row.is_none_or(|row| kept.get(row).is_some_and(|kept| *kept));
    let contacts = Contacts::of(frame)?;
    let shown = contacts.iter().filter(|contact| is_shown(contact.first) && is_shown(contact.second));
    let tube = |contact: super::quantity::Contact| {
        let force = contact.normal_force;
        let share = (force.abs() / strong).min(1.0);
        let paint =
            if in_bar { Paint::Value(force) } else { Paint::Plain(if force < 0.0 { PULL } else { PUSH }) };
        // Without any force there is nothing to show.
        (share > 0.0).then_some(Tube { ends: contact.ends, radius: thickest * share, paint })
    };
    Ok(shown.filter_map(tube).collect())
}

fn median(values: &[f64]) -> f64 {
    let mut values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
