//! The README and the guide to exports tell the truth: their examples run from the root as written, and its picture is what its command draws.
//!
//! A program of its own, since it works in the root folder.

use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

#[test]
fn examples_are_real_and_the_picture_is_drawn_by_its_command() {
    std::env::set_current_dir(ROOT).expect("the root");
    trycmd::TestCases::new().case("README.md").case("docs/export.md");

    let readme = std::fs::read_to_string("README.md").expect("text");
    let line =
        readme.lines().find(|l| l.starts_with("carom sweep ") && l.contains("--plot")).expect("the picture's command");
    let (arguments, picture) = line.split_once("--plot ").expect("a picture");
    assert!(readme.contains(&format!("]({picture})")), "{picture} is not shown");
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = folder.path().join("picture.svg");
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    let status = command.args(arguments.split_whitespace().skip(1)).arg("--plot").arg(&drawn).status();
    assert!(status.expect("it runs").success());
    let [drawn, shown] = [drawn.as_path(), picture.as_ref()].map(|p| std::fs::read_to_string(p).expect("text"));
    assert!(drawn == shown, "{picture} is not what its command draws: run the command again");
}
