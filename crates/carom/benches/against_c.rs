//! Batches against a plain C loop over the same formula, in one run: `cargo bench -p carom --bench against_c`.
//!
//! The loop (`plain_loop.c`) is compiled here with `cc -Ofast` for the whole processor and for AVX2, which lets GCC use glibc's vector
//! `pow`. Both sides take the same columns in turn; times are medians over many short calls, best read from a pinned, idle core. Linux
//! with a C compiler only.

use carom::batch::{Incidence, InstructionSet, Rebound};
use carom::material::Library;
use carom::normal::{NormalLaw, Term};
use carom::{Impact, WallLaw};
use std::ffi::{CString, c_char, c_int, c_void};
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

const ROWS: usize = 4096;
const ROUNDS: usize = 400;

type Loop = unsafe extern "C" fn(
    usize,
    *const f64,
    *const f64,
    *const f64,
    *const f64,
    *mut f64,
    *mut f64,
    *mut f64,
    f64,
    f64,
    f64,
    f64,
);

unsafe extern "C" {
    fn dlopen(name: *const c_char, flags: c_int) -> *mut c_void;
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

/// The C loop, compiled with `flags`; `None` without a compiler that can.
fn compile(name: &str, flags: &[&str]) -> Option<Loop> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/plain_loop.c");
    let library = std::env::temp_dir().join(format!("carom-plain-loop-{name}-{}.so", std::process::id()));
    let done = Command::new("cc")
        .args(["-Ofast", "-shared", "-fPIC", "-o"])
        .arg(&library)
        .args(flags)
        .arg(&source)
        .arg("-lm")
        .status();
    if !done.is_ok_and(|status| status.success()) {
        return None;
    }
    let path = CString::new(library.to_str()?).ok()?;
    // SAFETY: the library was just made of the source beside this file; its only symbol is the loop, and it is never closed.
    let symbol = unsafe { dlsym(dlopen(path.as_ptr(), 2), c"ea_rows".as_ptr()) };
    let _ = std::fs::remove_file(&library);
    // SAFETY: the symbol is a function of this type, as the source has it.
    (!symbol.is_null()).then(|| unsafe { std::mem::transmute::<*mut c_void, Loop>(symbol) })
}

fn law(normal: &str) -> WallLaw {
    let text = format!(
        "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nfriction = 0.2\nroughness_factor = 0.15\n{normal}"
    );
    let spec = carom::spec::parse_law(&text).unwrap_or_else(|e| panic!("{}", e.located("bench", &text)));
    spec.compile(Library::builtin()).unwrap_or_else(|e| panic!("{e}"))
}

/// Spread over the ranges of the paper: 0.1 to 30 m/s, 20 to 120 µm, all angles, spins either way.
fn rows() -> [Vec<f64>; 4] {
    let at = |i: usize, k: usize| ((i * 2_654_435_761 + k * 40_503) % 65_536) as f64 / 65_536.0;
    [
        (0..ROWS).map(|i| 0.1 * 300f64.powf(at(i, 1))).collect(),
        (0..ROWS).map(|i| 10.0 * at(i, 2)).collect(),
        (0..ROWS).map(|i| 2e4 * (at(i, 3) - 0.5)).collect(),
        (0..ROWS).map(|i| 20e-6 + 100e-6 * at(i, 4)).collect(),
    ]
}

/// Something timed: its name and one call over all rows.
type Timed<'a> = (String, Box<dyn FnMut() + 'a>);

/// Median ns a row of each, called in turn.
fn medians(timed: &mut [Timed]) -> Vec<f64> {
    let mut times = vec![Vec::with_capacity(ROUNDS); timed.len()];
    for _ in 0..ROUNDS {
        for ((_, call), times) in timed.iter_mut().zip(&mut times) {
            let start = Instant::now();
            call();
            times.push(start.elapsed().as_secs_f64() * 1e9 / ROWS as f64);
        }
    }
    times
        .iter_mut()
        .map(|t| {
            t.sort_by(f64::total_cmp);
            t[t.len() / 2]
        })
        .collect()
}

/// Ψ_A's constant for the C loop: at 1 m/s and a radius of 10 µm the power is 1.
fn scale(law: &WallLaw) -> f64 {
    let NormalLaw::Ledger(ledger) = law.normal() else { panic!("a ledger") };
    let Some(Term::AdhesionWork(work)) = ledger.terms().find(|t| matches!(t, Term::AdhesionWork(_))) else {
        panic!("adhesion work")
    };
    work.fraction(1.0, &carom::normal::Size::flat(1e-5))
}

fn main() {
    const DAMPED: &str = "normal = \"ea\"\nadhesion_damping = 1.3\nhertz_damping = 0.007\n";
    let (ea, eap) = (law(DAMPED), law("normal = \"eap\"\n"));
    let [normal, tangential, spin, diameter] = &rows();
    let incidence = Incidence { normal, tangential, spin, diameter };
    let impacts: Vec<Impact> = (0..ROWS)
        .map(|i| {
            let velocity = [0.6 * tangential[i], -normal[i], 0.8 * tangential[i]];
            let mut impact = Impact::new(diameter[i], velocity, [0.0, 1.0, 0.0]);
            impact.spin = [0.5 * spin[i], 0.3 * spin[i], -spin[i]];
            impact
        })
        .collect();
    let mut timed: Vec<Timed> = Vec::new();
    for (name, flags) in [("native", &["-march=native"][..]), ("avx2", &["-march=haswell"])] {
        let Some(c_loop) = compile(name, flags) else { continue };
        let a = scale(&ea);
        let (mut n, mut t, mut w) = (vec![0.0; ROWS], vec![0.0; ROWS], vec![0.0; ROWS]);
        let call = move || {
            let (vn, vt, s, d) = (normal.as_ptr(), tangential.as_ptr(), spin.as_ptr(), diameter.as_ptr());
            // SAFETY: seven columns of ROWS numbers that do not overlap.
            unsafe {
                c_loop(ROWS, vn, vt, s, d, n.as_mut_ptr(), t.as_mut_ptr(), w.as_mut_ptr(), a, 1.3, 0.007, 0.2);
            }
            black_box(&mut n);
        };
        timed.push((format!("C, EA, {name}"), Box::new(call)));
    }
    for (name, law) in [("EA", &ea), ("EAP", &eap)] {
        for set in InstructionSet::available() {
            let (mut n, mut t, mut w) = (vec![0.0; ROWS], vec![0.0; ROWS], vec![0.0; ROWS]);
            let call = move || {
                let done = law.impact_batch_on(set, &incidence, &mut Rebound::new(&mut n, &mut t, &mut w));
                black_box(&done);
            };
            timed.push((format!("carom, {name}, {set:?}"), Box::new(call)));
        }
        let impacts = &impacts;
        let call = move || {
            for impact in impacts {
                let out = law.impact(black_box(impact));
                black_box(&out);
            }
        };
        timed.push((format!("carom, {name}, one by one"), Box::new(call)));
    }
    let medians = medians(&mut timed);
    for ((name, _), ns) in timed.iter().zip(&medians) {
        println!("{name:30} {ns:8.2} ns");
    }
    for (c, set) in [("native", "Avx512"), ("avx2", "Avx2")] {
        let find = |wanted: &str| timed.iter().position(|(name, _)| name == wanted).map(|i| medians[i]);
        if let (Some(peer), Some(own)) = (find(&format!("C, EA, {c}")), find(&format!("carom, EA, {set}"))) {
            println!("C ({c}) over carom ({set}): {:.2}", peer / own);
        }
    }
}
