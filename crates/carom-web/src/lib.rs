//! carom for the explorer's page: plain exports over two buffers, one of text and one of numbers. `tools/web.sh` compiles it to
//! WebAssembly; natively it is an ordinary library, which its tests and the comparison of bits use.
//!
//! A caller asks for room ([`text_in`], [`numbers_in`]), writes there, calls, and reads the answer from the same buffers
//! ([`text_at`], [`text_length`], [`numbers_at`], [`numbers_length`]). Every call that can fail returns 1 if it did what was asked and 0
//! if the text now says what is wrong. Laws live in numbered slots.

mod answers;
mod json;
mod lists;
mod words;

pub use answers::{COLUMNS, Slot, Swept};

use carom::plane::Motion;
use carom::study::{ratios, steps};
use std::cell::RefCell;

/// Laws at once.
const SLOTS: usize = 16;
/// Rows of an answer: a page asks for hundreds.
const MOST: usize = 1_000_000;

#[derive(Default)]
struct Page {
    text: Vec<u8>,
    numbers: Vec<f64>,
    slots: [Option<Slot>; SLOTS],
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

impl Page {
    fn say(&mut self, text: String) -> u32 {
        self.text = text.into_bytes();
        1
    }

    fn answer(&mut self, found: Result<Vec<f64>, String>) -> u32 {
        match found {
            Ok(numbers) => {
                self.numbers = numbers;
                1
            }
            Err(message) => self.refuse(message),
        }
    }

    fn refuse(&mut self, message: String) -> u32 {
        self.say(message);
        0
    }

    fn slot(&self, slot: u32) -> Result<&Slot, String> {
        self.slots.get(slot as usize).and_then(Option::as_ref).ok_or_else(|| "no law has been given yet".to_owned())
    }
}

fn with<R>(work: impl FnOnce(&mut Page) -> R) -> R {
    PAGE.with_borrow_mut(work)
}

/// Room for a text of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn text_in(length: usize) -> *mut u8 {
    with(|page| {
        page.text = vec![0; length];
        page.text.as_mut_ptr()
    })
}

/// Where the text is.
#[unsafe(no_mangle)]
pub extern "C" fn text_at() -> *const u8 {
    with(|page| page.text.as_ptr())
}

/// Its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn text_length() -> usize {
    with(|page| page.text.len())
}

/// Room for so many numbers.
#[unsafe(no_mangle)]
pub extern "C" fn numbers_in(count: usize) -> *mut f64 {
    with(|page| {
        page.numbers = vec![0.0; count.min(MOST)];
        page.numbers.as_mut_ptr()
    })
}

/// Where the numbers are.
#[unsafe(no_mangle)]
pub extern "C" fn numbers_at() -> *const f64 {
    with(|page| page.numbers.as_ptr())
}

/// How many.
#[unsafe(no_mangle)]
pub extern "C" fn numbers_length() -> usize {
    with(|page| page.numbers.len())
}

/// Reads the text as a law's and compiles it into a slot. With `oblique` it must have what impacts along the wall need.
#[unsafe(no_mangle)]
pub extern "C" fn law(slot: u32, oblique: u32) -> u32 {
    with(|page| {
        let text = String::from_utf8_lossy(&page.text).into_owned();
        let read = Slot::read(&text, oblique != 0);
        let Some(place) = page.slots.get_mut(slot as usize) else {
            return page.refuse(format!("there are {SLOTS} slots"));
        };
        match read {
            Ok(law) => {
                *place = Some(law);
                1
            }
            Err(message) => {
                *place = None;
                page.refuse(message)
            }
        }
    })
}

/// The keys that the text's law reads, as a list in JSON: it need not be complete.
#[unsafe(no_mangle)]
pub extern "C" fn keys_read() -> u32 {
    with(|page| {
        let text = String::from_utf8_lossy(&page.text).into_owned();
        match words::reads(&text) {
            Ok(list) => page.say(list),
            Err(message) => page.refuse(message),
        }
    })
}

/// The text as a quantity: 0 a diameter, 1 a speed, 2 an angle in degrees, 3 a spin; from 4 on a key of a law, in its order, where the text
/// is that key's line of a law file. One number, SI units but for the angle.
#[unsafe(no_mangle)]
pub extern "C" fn quantity(kind: u32) -> u32 {
    with(|page| {
        let text = String::from_utf8_lossy(&page.text).into_owned();
        let found = words::quantity(kind, &text).map(|value| vec![value]);
        page.answer(found)
    })
}

/// Normal and tangential speed of a speed (m/s) at an angle (degrees from the surface).
#[unsafe(no_mangle)]
pub extern "C" fn components(speed: f64, angle: f64) -> u32 {
    let (normal, tangential) = carom::impact::components(speed, angle);
    with(|page| page.answer(Ok(vec![normal, tangential])))
}

/// One impact in three dimensions, of 18 numbers: diameter, density (NaN: the law's own), velocity, spin, normal, velocity of the wall (3
/// each), draws (4). Out: fate (1 rebound, 0 capture), velocity, spin, restitution, impulse ratio, tangential restitution, contact, the
/// eight shares of energy, bits of validity.
#[unsafe(no_mangle)]
pub extern "C" fn impact(slot: u32) -> u32 {
    with(|page| {
        let found = page.slot(slot).and_then(|law| law.impact(&page.numbers));
        page.answer(found)
    })
}

/// What runs, and the values along it: in equal ratios, or equal steps if `linear`.
fn running(what: u32, from: f64, to: f64, count: usize, linear: u32) -> Result<(Swept, Vec<f64>), &'static str> {
    let swept = Swept::of(what).ok_or("what runs is a speed, a diameter, an angle or a number of the law")?;
    let along = if linear != 0 { steps } else { ratios };
    Ok((swept, along(from, to, count)))
}

/// Impacts along the speed (0), the diameter (1), the angle (2) or a key of the law (3 and its place in the list), in equal ratios, or
/// equal steps if `linear`: a row of [`COLUMNS`] numbers each.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // an interface of plain numbers
pub extern "C" fn sweep(
    slot: u32,
    what: u32,
    count: usize,
    from: f64,
    to: f64,
    linear: u32,
    diameter: f64,
    speed: f64,
    angle: f64,
    spin: f64,
) -> u32 {
    with(|page| {
        let motion = Motion { diameter, speed, angle, spin };
        let run = |law: &Slot| {
            let (swept, values) = running(what, from, to, count.clamp(2, MOST), linear)?;
            law.sweep(swept, &values, &motion)
        };
        let found = page.slot(slot).and_then(run);
        page.answer(found)
    })
}

/// Whether the wall scatters: 1, or 0 for a smooth one and an empty slot.
#[unsafe(no_mangle)]
pub extern "C" fn scatters(slot: u32) -> u32 {
    with(|page| u32::from(page.slot(slot).is_ok_and(|law| law.wall.scatter().is_some())))
}

/// The spread that a wall makes that scatters, along the speed (0), the diameter (1) or the angle (2), of so many samples each: rows of
/// 11 numbers, see [`Slot::spread`].
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // an interface of plain numbers
pub extern "C" fn spread(
    slot: u32,
    what: u32,
    count: usize,
    from: f64,
    to: f64,
    linear: u32,
    diameter: f64,
    speed: f64,
    angle: f64,
    spin: f64,
    samples: u32,
) -> u32 {
    with(|page| {
        let motion = Motion { diameter, speed, angle, spin };
        let run = |law: &Slot| {
            let (swept, values) = running(what, from, to, count.clamp(2, 1000), linear)?;
            law.spread(swept, &values, &motion, samples.clamp(2, 10_000))
        };
        let found = page.slot(slot).and_then(run);
        page.answer(found)
    })
}

/// Impacts at each of so many speeds for each of so many diameters: region (0 capture, 1 rebound, 2 rebound with yield) and validity.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // an interface of plain numbers
pub extern "C" fn map(
    slot: u32,
    columns: usize,
    rows: usize,
    slowest: f64,
    fastest: f64,
    smallest: f64,
    largest: f64,
    angle: f64,
    spin: f64,
) -> u32 {
    with(|page| {
        let run = |law: &Slot| {
            let speeds = ratios(slowest, fastest, columns.clamp(2, 1000));
            let diameters = ratios(smallest, largest, rows.clamp(2, 1000));
            law.map(&speeds, &diameters, angle, spin)
        };
        let found = page.slot(slot).and_then(run);
        page.answer(found)
    })
}

/// The contact in time, where the law is `resolved`: rows of time, overlap, speed, Hertz force, net force, slip.
#[unsafe(no_mangle)]
pub extern "C" fn history(slot: u32, diameter: f64, speed: f64, angle: f64, spin: f64) -> u32 {
    with(|page| {
        let found = page.slot(slot).and_then(|law| law.history(&Motion { diameter, speed, angle, spin }));
        page.answer(found)
    })
}

/// Figures of a law at a motion, NaN where there is none: capture velocity, exhausted velocity, yield velocity of its own, that of its
/// materials, critical angle (degrees), C_R, Tabor's parameter, adhesion parameter, stiffness, work of adhesion, plastic constant,
/// density of the sphere. The text is a list of warnings in JSON.
#[unsafe(no_mangle)]
pub extern "C" fn figures(slot: u32, diameter: f64, speed: f64, angle: f64, spin: f64) -> u32 {
    with(|page| {
        let motion = Motion { diameter, speed, angle, spin };
        let found = page.slot(slot).and_then(|law| Ok((law.figures(&motion)?, law.warnings(&motion)?)));
        match found {
            Ok((numbers, warnings)) => {
                page.numbers = numbers;
                page.say(warnings)
            }
            Err(message) => page.refuse(message),
        }
    })
}

/// Everything the page shows that does not depend on an input, in JSON: materials with sources, keys, laws, losses, codes of validity.
#[unsafe(no_mangle)]
pub extern "C" fn lists() -> u32 {
    with(|page| page.say(lists::all()))
}
