//! Tables of a case file that read a flow and name its walls.

use carom_cfd::{Patch, PatchKind};
use std::fmt::Write as _;

/// The table of a mesh.
pub fn flow(kind: &str, path: &str, time: Option<&str>) -> String {
    if kind != "OpenFOAM" {
        return format!("[flow]\nkind = \"{}\"\nfile = {}\n", kind.to_lowercase(), quoted(path));
    }
    let time = time.map_or(String::new(), |t| format!("time = {}  # or \"latest\"\n", quoted(t)));
    format!("[flow]\nkind = \"openfoam\"\ncase = {}\n{time}", quoted(path))
}

/// A table for each wall, and one for all openings.
pub fn walls(patches: &[Patch]) -> String {
    let mut text = String::new();
    let filled = |kind: PatchKind| patches.iter().filter(move |p| p.kind == kind && !p.faces.is_empty());
    for wall in filled(PatchKind::Wall) {
        let patch = quoted(&escaped(&wall.name));
        let _ = write!(text, "\n[[wall]]\npatch = {patch}\nlaw = \"trap\"  # or the NAME of a table [law.NAME]\n");
    }
    let open: Vec<_> = filled(PatchKind::Plain).map(|p| escaped(&p.name)).collect();
    if !open.is_empty() {
        let _ = write!(text, "\n[[wall]]\npatch = {}\nlaw = \"escape\"\n", quoted(&open.join("|")));
    }
    text.trim_start().to_owned()
}

/// A name as a regular expression that fits it alone.
fn escaped(name: &str) -> String {
    let special = |c: char| r"\.+*?()|[]{}^$".contains(c);
    name.chars().flat_map(|c| special(c).then_some('\\').into_iter().chain([c])).collect()
}

/// A text of TOML.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn patch(name: &str, kind: PatchKind) -> Patch {
        Patch { name: name.into(), groups: vec![], kind, faces: 0..3 }
    }

    #[test]
    fn names_fit_themselves_alone_and_are_texts_of_toml() {
        let text = walls(&[
            patch("in.1", PatchKind::Plain),
            patch("pipe(2)", PatchKind::Wall),
            patch("out", PatchKind::Plain),
            patch("front", PatchKind::Empty),
        ]);
        let read: toml::Table = text.parse().unwrap();
        let walls = read["wall"].as_array().unwrap();
        assert_eq!(walls.len(), 2);
        assert_eq!(walls[0]["patch"].as_str().unwrap(), r"pipe\(2\)");
        assert_eq!((walls[1]["patch"].as_str().unwrap(), walls[1]["law"].as_str().unwrap()), (r"in\.1|out", "escape"));
        let flow: toml::Table = flow("OpenFOAM", "a\"b", Some("0.5")).parse().unwrap();
        assert_eq!((flow["flow"]["case"].as_str(), flow["flow"]["time"].as_str()), (Some("a\"b"), Some("0.5")));
    }
}
