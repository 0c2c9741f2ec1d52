use super::*;

#[test]
fn suggestions_are_near_or_absent() {
    let names = ["copper", "nickel", "gold"];
    assert_eq!(did_you_mean("coper", names), Some("did you mean copper?".into()));
    assert_eq!(did_you_mean("Coppre", names), Some("did you mean copper?".into()));
    assert_eq!(did_you_mean("unobtainium", names), None);
    // one slip in a short word, two from six letters on
    assert_eq!(did_you_mean("wood", names), None);
    assert_eq!(did_you_mean("nikcle", names), Some("did you mean nickel?".into()));
}

#[test]
fn place_is_line_and_column() {
    let e = LawError::new("bad").at(Some(6..9)).help("be good");
    assert_eq!(e.located("law.toml", "a = 1\nb = x\n"), "law.toml:2:1: bad; be good");
}

#[test]
fn the_line_is_shown_with_its_place() {
    let text = "a = 1\n\tµ = xyz\n";
    let e = LawError::new("bad").at(Some(12..15));
    assert_eq!(e.shown("law.toml", text), "law.toml:2:6: bad\n  2 | \tµ = xyz\n    | \t    ^^^");
    assert_eq!(LawError::new("bad").shown("law.toml", text), "law.toml: bad");
    // a whole table is marked on its first line only, and a place at the end of the text has no line
    assert!(LawError::new("bad").at(Some(0..15)).shown("t", text).ends_with("  1 | a = 1\n    | ^^^^^"));
    assert!(LawError::new("bad").at(Some(16..16)).shown("t", text).ends_with("  3 | \n    | ^"));
}

#[cfg(feature = "toml")]
#[test]
fn messages_are_for_those_who_wrote_the_text() {
    for (serde, plain) in [
        ("missing field `law`", "the key 'law' is missing here"),
        (
            "invalid type: floating point `9.81`, expected an array of length 3",
            "9.81 stands here; a list of 3 values, [x, y, ...], is wanted",
        ),
        (
            "invalid length 2, expected an array of length 3",
            "2 values stand here; a list of 3 values, [x, y, ...], is wanted",
        ),
        (
            "invalid type: string \"-0.5\", expected f64",
            "the text \"-0.5\" stands here; a number (without quotes) is wanted",
        ),
        ("invalid value: integer `-1`, expected u64", "-1 stands here; a whole number, zero or more, is wanted"),
        ("invalid type: integer `3`, expected a sequence", "3 stands here; a list in [ ] is wanted"),
        ("invalid type: map, expected a string", "a table stands here; a text in quotes is wanted"),
    ] {
        assert_eq!(plain::said(serde).map(|e| e.message()), Some(plain.to_owned()));
    }
    assert!(plain::said("invalid string, expected `\"`").is_none());
}

#[cfg(feature = "toml")]
#[test]
fn unknown_keys_have_neighbours() {
    let text = "normal = \"ea\"\nfrictoin = 0.2\n";
    let error = crate::spec::parse_law(text).expect_err("a misspelt key");
    assert_eq!((error.kind(), error.key()), (ErrorKind::UnknownKey, Some("frictoin")));
    assert_eq!(error.message(), "unknown key 'frictoin'");
    assert!(error.remedy().is_some_and(|h| h.starts_with("did you mean friction? known are sphere,")));
}

#[test]
fn a_front_has_words_of_its_own() {
    struct Flags;
    impl Wording for Flags {
        fn key(&self, key: &str) -> String {
            format!("--{key}")
        }
        fn value(&self, value: &str) -> String {
            value.to_owned()
        }
        fn setting(&self, key: &str, value: &str) -> String {
            format!("--{key} {value}")
        }
        fn loss(&self, name: &str) -> String {
            format!("--law {name}")
        }
        fn materials(&self) -> Option<String> {
            Some("see the list".into())
        }
    }
    let error = LawError::from(Problem::MissingKey { key: Key::Friction, reader: None });
    assert_eq!(
        error.said_in(&Flags),
        "the law needs a friction coefficient for impacts that slip along the wall; give --friction 0.2"
    );
    assert_eq!(
        error.to_string(),
        "the law needs a friction coefficient for impacts that slip along the wall; give friction = 0.2"
    );
    let error = LawError::from(Problem::UnknownMaterial { name: "x".into(), near: None });
    assert!(error.said_in(&Flags).contains("see the list") && !error.to_string().contains("see the list"));
}

#[test]
fn what_is_written_without_end_is_not_repeated() {
    let long = "x".repeat(1_000_000);
    let error = LawError::new(alloc::format!("unknown law '{long}'"));
    assert_eq!(error.to_string(), alloc::format!("unknown law '{}…'", "x".repeat(59)));
    let many = LawError::new("a b ".repeat(100_000));
    assert!(many.to_string().len() < 2100);
    // a path keeps its length
    let path = alloc::format!("{}/wall.stl: no such file", "a".repeat(70));
    assert_eq!(LawError::new(path.clone()).to_string(), path);
    assert!("1 xxxxx".parse::<crate::units::Length>().is_err());
    assert!(alloc::format!("1 {long}").parse::<crate::units::Length>().is_err());
    assert_eq!(super::did_you_mean(&long, ["glass"]), None);
}
