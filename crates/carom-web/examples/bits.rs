//! Writes impacts of every registered law with their outcomes, computed natively, as bits in hexadecimal: what the WebAssembly must give
//! (`web/test/bits.mjs`).
//!
//! Lines: `law TEXT` (quoted as in JSON), then `impact IN OUT`, `history IN OUT`, `sweep IN OUT`, `figures IN OUT` with numbers separated by
//! commas; OUT is `-` where the law refuses.

#[path = "../../carom/tests/common/mod.rs"]
mod common;

use std::fmt::Write as _;
use std::io::Write as _;

/// Impacts of each law.
const IMPACTS: usize = 60;

fn hex(numbers: &[f64]) -> String {
    let mut text = String::new();
    for (n, number) in numbers.iter().enumerate() {
        let _ = write!(text, "{}{:x}", if n > 0 { "," } else { "" }, number.to_bits());
    }
    text
}

/// As `crates/carom/tests/fixed_bits.rs`: all directions, spins, sizes, moving walls, other densities.
fn impact(i: usize) -> [f64; 18] {
    let at = |k: usize| ((i * 7_919 + k * 104_729) % 65_521) as f64 / 65_521.0;
    let decade = [1e-3, 1e-2, 0.1, 1.0, 10.0, 50.0][i % 6];
    let spin = [0, 1, 2].map(|k| if i.is_multiple_of(3) { 0.0 } else { 1e4 * decade * (at(8 + k) - 0.5) });
    let wall = if i % 4 == 1 { [0.3 * decade * at(11), 0.2 * decade, 0.0] } else { [0.0; 3] };
    let density = if i % 7 == 3 { 2000.0 + 1000.0 * at(12) } else { f64::NAN };
    let diameter = [3e-7, 2e-6, 1e-5, 7e-5, 5e-4][i % 5] * (0.5 + at(7));
    let velocity = [decade * (at(4) - 0.5), decade * (at(5) - 0.5), -decade * (0.2 + at(6))];
    let normal = [at(1) - 0.5, at(2) - 0.5, at(3) + 0.1];
    let mut row = [0.0; 18];
    let draws = [13, 14, 15, 16].map(at);
    let parts = [diameter, density].into_iter().chain(velocity).chain(spin).chain(normal).chain(wall).chain(draws);
    row.iter_mut().zip(parts).for_each(|(to, from)| *to = from);
    row
}

fn answer(done: u32) -> String {
    if done == 0 {
        return "-".to_owned();
    }
    // SAFETY: the library just put that many numbers there, and nothing has been called since.
    hex(unsafe { std::slice::from_raw_parts(carom_web::numbers_at(), carom_web::numbers_length()) })
}

fn give(numbers: &[f64]) {
    let room = carom_web::numbers_in(numbers.len());
    // SAFETY: there is room for that many numbers.
    unsafe { std::slice::from_raw_parts_mut(room, numbers.len()) }.copy_from_slice(numbers);
}

fn law(text: &str) {
    let room = carom_web::text_in(text.len());
    // SAFETY: there is room for that many bytes.
    unsafe { std::slice::from_raw_parts_mut(room, text.len()) }.copy_from_slice(text.as_bytes());
    assert_eq!(carom_web::law(0, 0), 1, "{text}");
}

fn main() -> std::io::Result<()> {
    let steel = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_angle = \"5 deg\"\nfriction = 0.2\n";
    let rough = [
        "normal = \"ea\"\nadhesion_damping = 1.3\nhertz_damping = 0.007\n",
        "normal = \"constant\"\nrestitution = 0.8\n",
        "normal = \"eap\"\nplastic_constant = \"155 MPa\"\ntangential = \"micro-slip\"\n",
    ]
    .map(|rest| format!("{steel}{rest}"));
    let laws = common::all_laws().iter().map(|(text, _)| text.clone()).chain(rough);
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for text in laws {
        law(&text);
        writeln!(out, "law {text:?}")?;
        for i in 0..IMPACTS {
            let input = impact(i);
            give(&input);
            writeln!(out, "impact {} {}", hex(&input), answer(carom_web::impact(0)))?;
        }
        let sweep = [0.0, 40.0, 0.003, 80.0, 0.0, 30e-6, 1.0, 35.0, 1e3];
        let [what, count, from, to, linear, diameter, speed, angle, spin] = sweep;
        let done =
            carom_web::sweep(0, what as u32, count as usize, from, to, linear as u32, diameter, speed, angle, spin);
        writeln!(out, "sweep {} {}", hex(&sweep), answer(done))?;
        for motion in [[90e-6, 2.0, 90.0, 0.0], [5e-6, 7.0, 30.0, 1e4]] {
            let [diameter, speed, angle, spin] = motion;
            writeln!(out, "figures {} {}", hex(&motion), answer(carom_web::figures(0, diameter, speed, angle, spin)))?;
            if text.contains("resolved") {
                writeln!(
                    out,
                    "history {} {}",
                    hex(&motion),
                    answer(carom_web::history(0, diameter, speed, angle, spin))
                )?;
            }
        }
    }
    out.flush()
}
