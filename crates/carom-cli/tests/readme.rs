//! README and the guides tell the truth: their examples run from the root as written, and their pictures are what their commands draw.
//!
//! A program of its own, since it works in the root folder.

use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[test]
fn examples_are_real_and_pictures_are_drawn_by_their_commands() {
    std::env::set_current_dir(ROOT).expect("the root");
    trycmd::TestCases::new()
        .case("README.md")
        .case("docs/cfd-results.md")
        .case("docs/fit.md")
        .case("docs/export.md")
        .case("docs/which-law.md");
    let pages = [("README.md", 1), ("docs/fit.md", 3), ("docs/wall-law.md", 1), ("docs/uncertainty.md", 1)];
    for (page, pictures) in pages {
        let text = std::fs::read_to_string(page).expect("text");
        let commands: Vec<&str> =
            text.lines().filter(|l| l.starts_with("carom ") && l.contains("--plot docs/")).collect();
        assert_eq!(commands.len(), pictures, "{page}");
        commands.iter().for_each(|line| drawn_by(line, page, &text));
    }
}

fn drawn_by(line: &str, page: &str, text: &str) {
    let (arguments, picture) = line.split_once("--plot ").expect("a picture");
    let folder = page.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
    let shown = picture.strip_prefix(&folder).expect("a picture below the page");
    assert!(text.contains(&format!("]({shown})")), "{picture} is not shown");
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = folder.path().join("picture.svg");
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    let out = command
        .args(arguments.split_whitespace().skip(1).map(|a| a.trim_matches('\'')))
        .arg("--plot")
        .arg(&drawn)
        .output();
    assert!(out.expect("it runs").status.success(), "{line}");
    let [drawn, shown] = [drawn.as_path(), picture.as_ref()].map(|p| std::fs::read_to_string(p).expect("text"));
    assert!(drawn == shown, "{picture} is not what its command draws: run the command again");
}
