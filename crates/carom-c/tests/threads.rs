//! One law, many threads at once: the same answers, and each thread its own message.

mod common;

use carom_c::{Law, Status, carom_impact, carom_law_free, carom_law_from_text};
use common::*;
use std::ptr::{null, null_mut};

struct Shared(*const Law);
// SAFETY: a law never changes, as the interface promises; this is what the test is about.
unsafe impl Sync for Shared {}

impl Shared {
    fn run(&self, ins: &[carom_c::ImpactIn]) -> Vec<u64> {
        let mut bits = Vec::new();
        for impact in ins {
            let mut out = blank();
            // SAFETY: a law and structs of the size they say.
            unsafe { carom_impact(self.0, impact, &raw mut out) };
            bits.extend(out.velocity.iter().chain(&out.spin).map(|x| x.to_bits()));
        }
        bits
    }
}

#[test]
fn threads_share_a_law_and_not_their_messages() {
    let law = law(WALLS, Some("steel")).expect("a law");
    let (shared, ins) = (Shared(law), impacts(2000));
    let alone = shared.run(&ins);
    std::thread::scope(|scope| {
        for i in 0..8 {
            let (shared, ins, alone) = (&shared, &ins, &alone);
            scope.spawn(move || {
                assert_eq!(message(), "");
                let (text, name) = (c(WALLS), c(&format!("none-{i}")));
                // SAFETY: texts that end with a zero, and a place for the answer.
                let status = unsafe { carom_law_from_text(text.as_ptr(), name.as_ptr(), null(), &mut null_mut()) };
                assert_eq!(status, Status::BadLaw);
                let said = message();
                assert!(said.contains(&format!("no law 'none-{i}'")), "{said}");
                // those that do not approach say so, each on its thread
                assert!(shared.run(ins) == *alone);
                assert!(message().contains("does not approach"));
            });
        }
    });
    // SAFETY: used by no thread any more.
    unsafe { carom_law_free(law) };
}
