//! The page with the frames of a run in one file that works from disk.

use crate::ViewError;
use crate::page::{INDEX, MODULES, STYLE};
use crate::run::{Run, column_names, scalars};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use pulvis_io::checkpoint::write_text;
use pulvis_io::vtk::{Frame, Numbers, PolyData};
use serde_json::{Value, json};
use std::path::Path;

/// Numbers of all frames together: about 40 MB of text, which browsers open at once.
const MOST_NUMBERS: usize = 8_000_000;

/// More frames make no smoother film.
const MOST_FRAMES: usize = 200;

/// Two ends, normal force, overlap, and both bodies.
const NUMBERS_OF_A_CONTACT: usize = 10;

/// What was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExportSummary {
    /// Frames in the file.
    pub frames: usize,
    /// Frames of the run.
    pub frames_of_run: usize,
    /// Particles of each frame are thinned out: one of so many is there.
    pub one_of: usize,
    /// \[byte\]
    pub bytes: usize,
}

/// Writes the page with the frames of the run in `folder` to `file`. Of a large run some frames are left out first, then
/// contacts, then particles.
///
/// # Errors
/// There is no run with frames, or the file cannot be written.
pub fn export(folder: &Path, file: &Path) -> Result<ExportSummary, ViewError> {
    let run = Run::open(folder)?;
    let count = run.entries()?.len();
    let last = count.checked_sub(1).ok_or_else(|| ViewError::NoFrames(folder.to_owned()))?;
    let no_frames = || ViewError::NoFrames(folder.to_owned());
    // The last frame is as large as any, unless particles leave.
    let (_, sample) = run.frame(last)?.ok_or_else(no_frames)?;
    let particles = sample.particles.points.len() * (3 + sample.particles.columns.len());
    let contacts = sample.contacts.points.len() / 2 * NUMBERS_OF_A_CONTACT;
    let one_of = particles.div_ceil(MOST_NUMBERS).max(1);
    let fitting = (MOST_NUMBERS / (particles + contacts).max(1)).clamp(1, MOST_FRAMES);
    let chosen = evenly(count, fitting);
    let with_contacts = particles + contacts <= MOST_NUMBERS;
    let mut frames = Vec::new();
    // Walls that do not move are there once.
    let mut surfaces: Vec<String> = Vec::new();
    for number in &chosen {
        if let Some((time, frame)) = run.frame(*number)? {
            let triangles = packed(frame.surfaces.points.as_flattened());
            if surfaces.last() != Some(&triangles) {
                surfaces.push(triangles);
            }
            let mut one = embedded(time, &frame, one_of, with_contacts);
            one["surface"] = json!(surfaces.len() - 1);
            frames.push(one);
        }
    }
    let mut summary = run.summary()?;
    summary["times"] = frames.iter().map(|frame| frame["time"].clone()).collect();
    summary["one_of"] = json!(one_of);
    summary["frames_of_run"] = json!(count);
    let series = run.series().map(|series| series.all());
    let data = json!({ "run": summary, "series": series, "frames": frames, "surfaces": surfaces });
    let text = page(&data);
    write_text(file, &text).map_err(ViewError::Write)?;
    Ok(ExportSummary { frames: chosen.len(), frames_of_run: count, one_of, bytes: text.len() })
}

/// At most so many of the numbers below `count`, the first and the last among them.
fn evenly(count: usize, most: usize) -> Vec<usize> {
    if most == 1 {
        return vec![count - 1];
    }
    let taken = count.min(most);
    (0..taken).map(|place| if taken == 1 { count - 1 } else { place * (count - 1) / (taken - 1) }).collect()
}

/// A frame with all columns as numbers, vectors as magnitudes.
fn embedded(time: f64, frame: &Frame, one_of: usize, with_contacts: bool) -> Value {
    let PolyData { points, columns } = &frame.particles;
    let kept = |values: Vec<f64>| values.into_iter().step_by(one_of).collect::<Vec<f64>>();
    let positions: Vec<f64> = points.iter().step_by(one_of).flatten().copied().collect();
    let numbers = columns.iter().map(|(_, numbers)| packed(&kept(scalars(numbers)))).collect::<Value>();
    let walls = frame.walls.lines();
    let contacts = if with_contacts { frame.contacts.points.as_slice() } else { &[] };
    let of_contacts = |name: &str| frame.contacts.column(name).filter(|_| with_contacts);
    let numbers_of = |name: &str| of_contacts(name).map(scalars).unwrap_or_default();
    let bodies = |name: &str| match of_contacts(name) {
        Some(Numbers::Integer(ids)) => ids.as_slice(),
        _ => &[],
    };
    json!({
        "time": time,
        "particles": positions.len() / 3,
        "names": column_names(columns),
        "positions": packed(&positions),
        "columns": numbers,
        "walls": packed(walls.as_flattened().as_flattened()),
        "wall_radii": packed(&frame.walls.scalar("radius").unwrap_or_else(|| vec![0.0; walls.len()])),
        "contacts": packed(contacts.as_flattened()),
        "forces": packed(&numbers_of("normal_force")),
        "overlaps": packed(&numbers_of("overlap")),
        "bodies": [bodies("id1"), bodies("id2")],
    })
}

/// 32-bit floats, little endian, as text.
fn packed(numbers: &[f64]) -> String {
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| (*number as f32).to_le_bytes()).collect();
    STANDARD.encode(bytes)
}

/// The page with its looks, modules and data inside. Modules that lie in a file cannot name each other by paths: a map gives
/// each a name and its text.
fn page(data: &Value) -> String {
    let named = |text: &str| text.replace("from \"./", "from \"pulvis/");
    let address = |text: &str| format!("data:text/javascript;base64,{}", STANDARD.encode(named(text)));
    let imports: serde_json::Map<String, Value> =
        MODULES.iter().map(|file| (format!("pulvis/{}", file.name), json!(address(file.text)))).collect();
    // A closing tag within the data would end it.
    let data = data.to_string().replace("</", "<\\/");
    let map = json!({ "imports": imports });
    INDEX
        .replace("<link rel=\"stylesheet\" href=\"style.css\">", &format!("<style>{STYLE}</style>"))
        .replace(
            "<script type=\"module\" src=\"main.js\"></script>",
            &format!(
                "<script type=\"application/json\" id=\"embedded\">{data}</script>\n<script type=\"importmap\">{map}</script>\n<script type=\"module\">import \"pulvis/main.js\";</script>"
            ),
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_left_out_evenly_and_the_ends_are_kept() {
        assert_eq!(evenly(1, 5), [0]);
        assert_eq!(evenly(7, 1), [6]);
        assert_eq!(evenly(5, 10), [0, 1, 2, 3, 4]);
        assert_eq!(evenly(101, 5), [0, 25, 50, 75, 100]);
    }

    #[test]
    fn the_exported_page_names_nothing_outside_itself() {
        let text = page(&json!({ "title": "</script><b>" }));
        assert!(text.contains("<style>") && text.contains("importmap") && text.contains("pulvis/main.js"));
        assert!(!text.contains("href=\"style.css\"") && !text.contains("src=\"main.js\""));
        assert!(!text.contains("</script><b>"), "a title cannot end the data");
        // The name of the namespace of SVG is no address.
        let names = |text: &str| text.replace("http://www.w3.org/2000/svg", "").contains("http");
        assert!(MODULES.iter().all(|file| !file.text.contains("from \"/") && !names(file.text)));
    }
}
