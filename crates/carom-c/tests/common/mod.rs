//! Laws and impacts for the tests, through the C interface.

use carom_c::{ImpactIn, ImpactOut, Law, Status, carom_last_error, carom_law_from_text};
use std::ffi::{CStr, CString};
use std::mem::size_of;
use std::ptr::{null, null_mut};

/// Laws of every kind.
pub const WALLS: &str = r#"
[law.glass]
sphere = "copper"
surface = "glass"
normal = "ea"
friction = 0.2
roughness_factor = 0.15
adhesion_damping = "1.3 s/m"
hertz_damping = "0.007 s/m"

[law.steel]
sphere = "rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma=310MPa"
surface = "silicon"
normal = ["plastic-thornton-ning", "adhesion-work"]
tangential = "micro-slip"
friction = 0.15
roughness_factor = 0.15

[law.table]
normal = "by-angle"
restitution = "grant-tabakoff"
tangential_restitution = "grant-tabakoff"

[law.resolved]
sphere = "stainless-steel"
surface = "silicon"
normal = "resolved"
friction = 0.2
adhesion_damping = 1.3
hertz_damping = 0.007
roughness_factor = 0.15
"#;

/// The message of the last call that failed.
pub fn message() -> String {
    // SAFETY: a text that ends with a zero.
    unsafe { CStr::from_ptr(carom_last_error()) }.to_string_lossy().into_owned()
}

/// A text for C.
pub fn c(text: &str) -> CString {
    CString::new(text).expect("no zero inside")
}

/// A law from a text; the message if it is refused.
pub fn law(text: &str, name: Option<&str>) -> Result<*mut Law, (Status, String)> {
    let (text, name) = (c(text), name.map(c));
    let mut out = null_mut();
    // SAFETY: texts that end with a zero, and a place for the answer.
    let status = unsafe {
        carom_law_from_text(text.as_ptr(), name.as_ref().map_or(null(), |n| n.as_ptr()), null(), &raw mut out)
    };
    if status == Status::Ok {
        Ok(out)
    } else {
        assert!(out.is_null());
        Err((status, message()))
    }
}

/// An impact at y = 0 with what the first fields need.
pub fn impact() -> ImpactIn {
    ImpactIn {
        size: size_of::<ImpactIn>(),
        diameter: 90e-6,
        density: 0.0,
        velocity: [2.0, -0.5, 0.0],
        spin: [0.0; 3],
        normal: [0.0, 1.0, 0.0],
        wall_velocity: [0.0; 3],
        draws: [0.5; 4],
    }
}

/// Impacts of all kinds, the same ones every time, in any direction; some do not approach.
pub fn impacts(n: usize) -> Vec<ImpactIn> {
    // SplitMix64 of the numbers of impact and value
    let at = |i: usize, k: usize| {
        let mut z = ((i * 64 + k) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let three = |i: usize, k: usize, scale: f64| [scale * at(i, k), scale * at(i, k + 1), scale * at(i, k + 2)];
    (0..n)
        .map(|i| ImpactIn {
            diameter: 1e-6 * 200f64.powf(at(i, 1) + 0.5),
            density: if i % 3 == 0 { 0.0 } else { 5000.0 + 8000.0 * at(i, 2) },
            velocity: three(i, 3, 20.0),
            spin: three(i, 6, 4e4),
            normal: three(i, 9, 2.0),
            wall_velocity: if i % 2 == 0 { [0.0; 3] } else { three(i, 12, 4.0) },
            ..impact()
        })
        .collect()
}

/// An answer to be written.
pub fn blank() -> ImpactOut {
    // SAFETY: plain numbers, for which zeros are a value.
    let mut out: ImpactOut = unsafe { std::mem::zeroed() };
    out.size = size_of::<ImpactOut>();
    out
}
