//! The page: sources as they are, nothing is built.

use crate::message::Answer;

/// A file of the page.
pub(crate) struct File {
    pub(crate) name: &'static str,
    pub(crate) text: &'static str,
}

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(File { name: $name, text: include_str!(concat!("../page/", $name)) }),*]
    };
}

/// The page itself.
pub(crate) const INDEX: &str = include_str!("../page/index.html");

/// Its looks.
pub(crate) const STYLE: &str = include_str!("../page/style.css");

/// Its modules; each uses only those before it.
pub(crate) const MODULES: &[File] = files![
    "format.js",
    "colour.js",
    "chart.js",
    "heat.js",
    "oblique.js",
    "source.js",
    "camera.js",
    "spheres.js",
    "scenario.js",
    "controls.js",
    "panel.js",
    "headon.js",
    "map.js",
    "laboratory.js",
    "picture.js",
    "webm.js",
    "video.js",
    "look.js",
    "run.js",
    "main.js",
];

/// A file of the page by its path.
pub(crate) fn answer(path: &str) -> Option<Answer> {
    match path {
        "/" => Some(Answer::of("text/html; charset=utf-8", INDEX)),
        "/style.css" => Some(Answer::of("text/css; charset=utf-8", STYLE)),
        _ => {
            let module = MODULES.iter().find(|file| path.strip_prefix('/') == Some(file.name))?;
            Some(Answer::of("text/javascript; charset=utf-8", module.text))
        }
    }
}
