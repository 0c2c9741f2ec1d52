//! The README tells the truth: its examples run from the root as written; pictures of the docs are what their commands draw.
//!
//! A program of its own, since it works in the root folder.

use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[test]
fn examples_are_real_and_pictures_are_drawn_by_their_commands() {
    std::env::set_current_dir(ROOT).expect("the root");
    trycmd::TestCases::new().case("README.md");

    for page in ["README.md", "docs/wall-law.md", "docs/uncertainty.md"] {
        picture_is_drawn_by_its_command(page);
    }
}

/// The page's line `carom sweep ... --plot PICTURE` draws the picture it shows.
fn picture_is_drawn_by_its_command(page: &str) {
    let text = std::fs::read_to_string(page).expect("text");
    let line =
        text.lines().find(|l| l.starts_with("carom sweep ") && l.contains("--plot")).expect("the picture's command");
    let (arguments, picture) = line.split_once("--plot ").expect("a picture");
    assert!(
        text.contains(&format!("]({})", picture.trim_start_matches(page.split_once('/').map_or("", |_| "docs/")))),
        "{picture}"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = folder.path().join("picture.svg");
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    let arguments = arguments.split_whitespace().skip(1).map(|a| a.trim_matches('\''));
    let status = command.args(arguments).arg("--plot").arg(&drawn).status();
    assert!(status.expect("it runs").success());
    let [drawn, shown] = [drawn.as_path(), picture.as_ref()].map(|p| std::fs::read_to_string(p).expect("text"));
    assert!(drawn == shown, "{picture} is not what its command draws: run the command again");
}
