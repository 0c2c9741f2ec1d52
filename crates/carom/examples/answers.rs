//! Answers of a law as bits, for other languages to be held against: `answers LAW.toml < ROWS > ANSWERS`.
//!
//! A row is diameter, normal and tangential speed and spin; an answer is normal and tangential speed, spin, restitution, impulse ratio
//! and the eight shares of the energy, each as the 16 hexadecimal digits of its bits; `-` stands for what is no impact.

use carom::material::Library;
use carom::{Fate, Impact, spec::parse_only_law};
use std::io::{BufRead as _, Write as _};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("answers LAW.toml < ROWS")?;
    let law = parse_only_law(&std::fs::read_to_string(path)?)?.compile(Library::builtin())?;
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for line in std::io::stdin().lock().lines() {
        let row = line?.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let [diameter, normal, tangential, spin] = row[..] else { return Err("a row has four numbers".into()) };
        let impact =
            Impact { spin: [0.0, 0.0, -spin], ..Impact::new(diameter, [tangential, -normal, 0.0], [0.0, 1.0, 0.0]) };
        let Ok(met) = law.impact(&impact) else {
            writeln!(out, "-")?;
            continue;
        };
        let motion = match met.fate {
            Fate::Capture => [0.0, 0.0, 0.0, 0.0, f64::NAN],
            Fate::Rebound => [met.velocity[1], met.velocity[0], -met.spin[2], met.restitution, met.impulse_ratio],
        };
        let energy = met.energy.named().map(|(_, share)| share);
        let bits: Vec<String> = motion.iter().chain(&energy).map(|v| format!("{:016x}", v.to_bits())).collect();
        writeln!(out, "{}", bits.join(" "))?;
    }
    Ok(())
}
