//! Files in the folder of a run, and none elsewhere.

use super::leads_down;
use crate::message::{Answer, decode};
use std::path::{Path, PathBuf};

/// The file of this name, if it lies in the folder: names that lead up or start at the root are refused before the system is
/// asked, links that lead out of the folder after it has said where they lead.
pub(super) fn inside(folder: &Path, name: &str) -> Option<PathBuf> {
    if !leads_down(name) {
        return None;
    }
    let real = folder.join(name).canonicalize().ok()?;
    (real.starts_with(folder) && real.is_file()).then_some(real)
}

/// A file by its name, as sent.
pub(super) fn answer(folder: &Path, name: &str) -> Answer {
    let missing = || Answer::refused(404, "the run has no such file");
    let Some(file) = decode(name).and_then(|name| inside(folder, &name)) else { return missing() };
    let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let kind = match ending.as_str() {
        "png" => "image/png",
        "json" => "application/json",
        // Pictures in SVG may hold scripts: as text they are harmless.
        "csv" | "toml" | "txt" | "svg" | "files" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    };
    std::fs::read(&file).map_or_else(|_| missing(), |bytes| Answer::of(kind, bytes))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn no_name_leads_out_of_the_folder_of_a_run() {
        let all = tempfile::tempdir().unwrap();
        let folder = all.path().canonicalize().unwrap().join("run");
        std::fs::create_dir_all(folder.join("deeper")).unwrap();
        std::fs::write(all.path().join("secret.txt"), "secret").unwrap();
        std::fs::write(folder.join("run.toml"), "mine").unwrap();
        std::fs::write(folder.join("deeper/a b.csv"), "1").unwrap();
        assert_eq!(answer(&folder, "run.toml").body, b"mine");
        assert_eq!(answer(&folder, "deeper/a%20b.csv").body, b"1");
        let absolute = all.path().join("secret.txt").display().to_string();
        let names = [
            "../secret.txt",
            "%2e%2e/secret.txt",
            "..%2fsecret.txt",
            "%2e%2e%2fsecret.txt",
            "deeper/../../secret.txt",
            "deeper/%2e%2e/%2e%2e/secret.txt",
            "./../secret.txt",
            "..\\secret.txt",
            absolute.as_str(),
            "",
            ".",
            "..",
            "deeper",
            "%",
            "%zz",
            "%00",
            "run.toml%00",
        ];
        for name in names {
            assert_eq!(answer(&folder, name).status, 404, "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_that_lead_out_of_the_folder_are_not_followed() {
        let all = tempfile::tempdir().unwrap();
        let folder = all.path().canonicalize().unwrap().join("run");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(all.path().join("secret.txt"), "secret").unwrap();
        std::fs::write(folder.join("inside.txt"), "mine").unwrap();
        std::os::unix::fs::symlink(all.path().join("secret.txt"), folder.join("out.txt")).unwrap();
        std::os::unix::fs::symlink(folder.join("inside.txt"), folder.join("in.txt")).unwrap();
        assert_eq!(answer(&folder, "out.txt").status, 404);
        assert_eq!(answer(&folder, "in.txt").body, b"mine");
    }
}
