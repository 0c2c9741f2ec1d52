//! An impact allocates nothing, neither one that is met nor one that is refused.

mod common;

use carom_c::{Status, carom_impact, carom_impact_batch, carom_impact_columns, carom_law_free};
use common::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

struct Counting;
static CALLS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is handed to the system's allocator as it came; the count touches no memory of it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        CALLS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// one test alone in this program: others would allocate beside it
#[test]
fn impacts_allocate_nothing() {
    let ins = impacts(200);
    let mut outs = vec![blank(); ins.len()];
    for name in ["glass", "steel", "table", "resolved"] {
        let law = law(WALLS, Some(name)).expect("a law");
        let before = CALLS.load(Ordering::Relaxed);
        let (mut met, mut refused) = (0, 0);
        for (impact, out) in ins.iter().zip(&mut outs) {
            // SAFETY: a law and structs of the size they say.
            match unsafe { carom_impact(law, impact, out) } {
                Status::Ok => met += 1,
                _ => refused += 1,
            }
        }
        // SAFETY: a law and arrays of the length said.
        let status =
            unsafe { carom_impact_batch(law, ins.len(), ins.as_ptr(), outs.as_mut_ptr(), std::ptr::null_mut()) };
        let (column, mut a, mut b, mut c) = ([1e-5; 100], [0.0; 100], [0.0; 100], [0.0; 100]);
        let (p, none) = (column.as_ptr(), std::ptr::null_mut());
        let (x, y, z) = (a.as_mut_ptr(), b.as_mut_ptr(), c.as_mut_ptr());
        // SAFETY: a law and columns of the length said.
        let in_columns =
            unsafe { carom_impact_columns(law, 100, p, p, p, p, x, y, z, none, none, std::ptr::null_mut()) };
        let after = CALLS.load(Ordering::Relaxed);
        assert_eq!(in_columns, Status::Ok);
        assert_eq!(after - before, 0, "{name}");
        assert!(met > 0 && refused > 0 && status == Status::NotApproaching);
        // SAFETY: used no more.
        unsafe { carom_law_free(law) };
    }
    assert!(CALLS.load(Ordering::Relaxed) > 0, "making a law is counted");
}
