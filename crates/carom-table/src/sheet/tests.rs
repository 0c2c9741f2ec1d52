//! Each of these texts holds the numbers 0.5, 0.952 and 2, 0.981 under speed and restitution, or is refused with a word.

use super::*;

const KNOWN: [&str; 2] = ["speed", "restitution"];

fn knows(name: &str) -> bool {
    KNOWN.contains(&name)
}

fn read(bytes: &[u8]) -> Result<Vec<[Option<f64>; 2]>, SheetError> {
    let sheet = Sheet::read(bytes, &knows)?;
    let of = |name: &str| sheet.headings().iter().position(|h| h.name == name).unwrap_or(99);
    let places = KNOWN.map(of);
    let mut rows = sheet.rows();
    let mut all = Vec::new();
    while rows.next_row()?.is_some() {
        all.push([rows.number(places[0])?, rows.number(places[1])?]);
    }
    Ok(all)
}

const WANTED: [[Option<f64>; 2]; 2] = [[Some(0.5), Some(0.952)], [Some(2.0), Some(0.981)]];

#[test]
fn the_same_points_in_every_dress() {
    for text in [
        "speed,restitution\n0.5,0.952\n2,0.981\n",
        "speed,restitution\r\n0.5,0.952\r\n2,0.981",
        "speed,restitution\r0.5,0.952\r2,0.981\r",
        "speed;restitution\n0,5;0,952\n2;0,981\n",
        "speed\trestitution\n0.5\t0.952\n2\t0.981\n",
        "speed\trestitution\n0,5\t0,952\n2\t0,981\n",
        "   speed   restitution\n   0.5   0.952\n   2.0   0.981\n",
        "speed,restitution,\n0.5,0.952,\n2,0.981,\n",
        "speed;restitution;;\n0,5;0,952;;\n2;0,981;;\n;;;\n",
        "speed [m/s],restitution [-]\n0.5,0.952\n2,0.981\n",
        "\"Speed (m/s)\",\"Restitution\"\n\"0.5\",\"0.952\"\n\"2\",\"0.981\"\n",
        "\"speed\",\"restitution\"\n\"0,5\",\"0,952\"\n\"2\",\"0,981\"\n",
        "sep=;\nspeed;restitution\n0,5;0,952\n2;0,981\n",
        "\"sep=,\"\nspeed,restitution\n0.5,0.952\n2,0.981\n",
        "# taken by hand\n# on Monday\n\nspeed,restitution\n0.5,0.952\n# a pause\n2,0.981\n",
        "% Date: today\n% speed     restitution\n0.5    0.952\n2    0.981\n",
        "# speed restitution\n0.5 0.952\n2 0.981\n",
        "My measurement\nsensor 3, gain 10\nspeed,restitution\n0.5,0.952\n2,0.981\n",
        "Nodes,1000\nspeed,restitution\n0.5,0.952\n2,0.981\n",
        "speed,restitution\nm/s,-\n0.5,0.952\n2,0.981\n",
        "speed;restitution\n[m/s];[-]\n0,5;0,952\n2;0,981\n",
        "run,speed,note,restitution\n1,0.5,\"a, \"\"good\"\" one\",0.952\n2,2,\"two\nlines\",0.981\n",
        "[Name]\nPlane 1\n\n[Data]\nspeed [ m s^-1 ], restitution\n0.5, 0.952\n2, 0.981\n\n[Faces]\n0, 1, 2\n",
        "speed, restitution\n0.5D+00, 9.52D-01\n2.0d0, 0.981\n",
    ] {
        assert_eq!(read(text.as_bytes()), Ok(WANTED.to_vec()), "{text}");
    }
    let utf16: Vec<u8> =
        "\u{feff}speed\trestitution\n0,5\t0,952\n2\t0,981\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(read(&utf16), Ok(WANTED.to_vec()));
    assert_eq!(read(b"\xef\xbb\xbfspeed,restitution\n0.5,0.952\n2,0.981\n"), Ok(WANTED.to_vec()));
    assert_eq!(read(b"speed;restitution;Gr\xf6\xdfe\n0,5;0,952;1\n2;0,981;1\n"), Ok(WANTED.to_vec()));
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    for (text, wanted) in [
        ("speed,restitution\n0.5,0.952\n#N/A,0.9\n", "line 3: column \"speed\": \"#N/A\" is not a finite number"),
        ("speed,restitution\n0.5,#DIV/0!\n", "line 2: column \"restitution\": \"#DIV/0!\""),
        ("speed\n#NV\n", "line 2: column \"speed\": \"#NV\""),
        (
            "speed;restitution\n0.5;0,952\n",
            "line 2: column \"restitution\": \"0,952\" has a decimal comma, but line 2 has a decimal point",
        ),
        ("speed,restitution\n0,5,0,952\n", "line 2: 4 values under 2 columns: are these decimal commas"),
        ("speed,restitution\n\"1,234\",0.9\n", "may part thousands or decimals"),
        ("speed,restitution\n0.5\n", "line 2: 1 values under 2 columns"),
        ("speed,restitution\n1,nan\n", "\"nan\" is not a finite number"),
        ("speed,restitution\n\"1,0.9\n", "line 2: a quote that does not end"),
        ("1,2\n3,4\n", "line 1: a line that names the columns is wanted"),
        ("", "nothing in it"),
        ("PK\u{3}\u{4}", "Excel workbook"),
        ("<?xml version=\"1.0\"?>", "Resample To Image"),
        ("a\0b", "bytes of zero"),
        (
            "[Name]\nA\n[Data]\nspeed,restitution\n1,0.9\n[Name]\nB\n[Data]\nspeed,restitution\n",
            "line 6: a second table",
        ),
    ] {
        let error = read(text.as_bytes()).expect_err(text).to_string();
        assert!(error.contains(wanted), "{text}: {error}");
    }
    let long = format!("speed,restitution\n1,{}\n", "x".repeat(1_000_000));
    let error = read(long.as_bytes()).expect_err("no number").to_string();
    assert!(error.chars().count() < 150, "{error}");
}

#[test]
fn units_stand_behind_names() {
    for (written, name, unit) in [
        ("X [ m ]", "x", Some("m")),
        ("Velocity u [ m s^-1 ]", "velocity_u", Some("m s^-1")),
        ("Velocity[i] (m/s)", "velocity_i", Some("m/s")),
        ("Velocity[j]", "velocity_j", None),
        ("u (m/s)", "u", Some("m/s")),
        ("Points:0", "points_0", None),
        ("x-coordinate", "x_coordinate", None),
        ("v / (m/s)", "v", Some("m/s")),
        ("v / m/s", "v", Some("m/s")),
        ("d / µm", "d", Some("µm")),
        ("Speed in mm/s", "speed", Some("mm/s")),
        ("Velocity in Stn Frame u", "velocity_in_stn_frame_u", None),
        ("restitution [-]", "restitution", None),
        ("(m)", "m", None),
        ("", "", None),
    ] {
        let heading = Heading::of(written);
        assert_eq!((heading.name.as_str(), heading.unit.as_deref()), (name, unit), "{written}");
    }
}

#[test]
fn comments_are_kept() {
    let text = "% Length unit: mm\n% speed restitution\n1 2\n# the end\n";
    let sheet = Sheet::read(text.as_bytes(), &knows).expect("a sheet");
    assert_eq!(sheet.remark("length unit"), Some("mm"));
    assert_eq!(sheet.comments().collect::<Vec<_>>(), ["Length unit: mm", "the end"]);
}

/// Texts made by chance are read or refused; the seed is printed.
#[test]
fn texts_by_chance_never_panic() {
    let seed = std::env::var("CAROM_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1u64);
    println!("seed {seed} (CAROM_SEED)");
    let pieces = [
        "speed",
        "restitution",
        ",",
        ";",
        "\t",
        " ",
        "\n",
        "\r\n",
        "\"",
        "0.5",
        "0,5",
        "1e9",
        "#",
        "#N/A",
        "%",
        "[Data]",
        "[Name]",
        "(",
        ")",
        "[m/s]",
        "é",
        "\u{feff}",
        "sep=;",
        "-",
        "nan",
        "\u{0}",
        "//",
        "1,234",
    ];
    let mut state = seed;
    let mut next = move |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for _ in 0..4_000 {
        let text: String = (0..next(40)).map(|_| pieces[next(pieces.len())]).collect();
        let _ = read(text.as_bytes());
        if let Ok(sheet) = Sheet::read(text.as_bytes(), &knows) {
            let _ = sheet.comments().count();
        }
        let mut bytes = text.into_bytes();
        if !bytes.is_empty() {
            let at = next(bytes.len());
            bytes[at] = next(256) as u8;
        }
        let _ = read(&bytes);
    }
}
