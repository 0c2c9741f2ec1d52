//! What the command tells shells and their manual of itself.

use std::process::{Command, Output};

fn carom(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_carom")).args(arguments).output().expect("the command runs")
}

fn text(arguments: &[&str]) -> String {
    let output = carom(arguments);
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn every_shell_knows_the_flags() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let completions = text(&["completions", shell]);
        for word in ["sweep", "roughness-factor", "completions"] {
            assert!(completions.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(carom(&["completions", "tcsh"]).status.code(), Some(2));
}

#[test]
fn the_manual_has_a_page_for_the_whole_and_for_each_subcommand() {
    assert!(text(&["man"]).contains(".TH carom 1"));
    for subcommand in ["impact", "sweep", "capture", "materials", "info", "run", "merge", "fit", "validate", "export"] {
        let page = text(&["man", subcommand]);
        assert!(page.contains(&format!(".TH carom-{subcommand} 1")), "{subcommand}");
    }
    assert!(text(&["man", "sweep"]).contains("micro\\-slip"));
    assert_eq!(carom(&["man", "nosuch"]).status.code(), Some(2));
}

#[test]
fn what_is_piped_has_no_colours() {
    for arguments in [&["--help"][..], &["impact", "--help"], &["impact", "--speed", "x"]] {
        let output = carom(arguments);
        assert!(!output.stdout.contains(&0x1b) && !output.stderr.contains(&0x1b), "{arguments:?}");
    }
}
