//! How calls end, and the message of the last one that failed.

use std::cell::UnsafeCell;
use std::ffi::c_char;
use std::fmt::{self, Write as _};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a call ended.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// No impact: the sphere does not move towards the wall.
    NotApproaching = 1,
    /// No impact: a diameter, density, velocity, spin or normal that is none (NaN, out of range).
    BadImpact = 2,
    /// A pointer is null, a text is not UTF-8, a struct's size is not one this library knows.
    BadArgument = 3,
    /// The law or the materials cannot be read; the message points at the line.
    BadLaw = 4,
    /// A file cannot be read.
    File = 5,
    /// A defect of the library, caught.
    Panic = 6,
}

/// Room for a message, its end included; a longer one is cut.
const ROOM: usize = 4096;

/// A message in place: saying that a sphere does not approach allocates nothing either.
struct Message {
    length: usize,
    bytes: [u8; ROOM],
}

impl fmt::Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut end = text.len().min(ROOM - 1 - self.length);
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        for (to, from) in self.bytes[self.length..].iter_mut().zip(text[..end].bytes()) {
            // a zero would end the message early
            *to = if from == 0 { b'?' } else { from };
        }
        self.length += end;
        self.bytes[self.length] = 0;
        Ok(())
    }
}

thread_local! {
    static MESSAGE: UnsafeCell<Message> = const { UnsafeCell::new(Message { length: 0, bytes: [0; ROOM] }) };
}

/// Keeps the message for [`carom_last_error`] and hands the status on.
pub(crate) fn fail(status: Status, message: &dyn fmt::Display) -> Status {
    MESSAGE.with(|cell| {
        // SAFETY: this thread alone reaches the cell; no reference to it outlives this function, and a `Display` called below comes
        // from this library, none of which calls back here.
        let kept = unsafe { &mut *cell.get() };
        kept.length = 0;
        kept.bytes[0] = 0;
        // writing to it cannot fail
        let _ = write!(kept, "{message}");
    });
    status
}

/// The message of the last call on this thread that failed: what, where and what would be right, in one or a few lines of UTF-8.
/// Empty if none has. It is the library's, and stays until the next call on this thread that fails.
#[unsafe(no_mangle)]
pub extern "C" fn carom_last_error() -> *const c_char {
    MESSAGE.with(|cell| {
        // SAFETY: the place of a field within the cell; nothing is read.
        unsafe { (&raw const (*cell.get()).bytes).cast() }
    })
}

/// Runs `body`; a panic ends here, as a status.
pub(crate) fn guard(body: impl FnOnce() -> Status) -> Status {
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(status) => status,
        Err(payload) => {
            let said = payload
                .downcast_ref::<&str>()
                .copied()
                .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
                .unwrap_or("no message");
            let status = fail(Status::Panic, &format_args!("a defect of carom, please report it: {said}"));
            // dropping it might panic again
            std::mem::forget(payload);
            status
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn last() -> String {
        // SAFETY: the pointer is to a text that ends with a zero and lives as long as the thread.
        unsafe { CStr::from_ptr(carom_last_error()) }.to_string_lossy().into_owned()
    }

    #[test]
    fn a_panic_becomes_a_status() {
        assert_eq!(guard(|| panic!("out of {}", "luck")), Status::Panic);
        assert_eq!(last(), "a defect of carom, please report it: out of luck");
        assert_eq!(guard(|| Status::Ok), Status::Ok);
    }

    #[test]
    fn long_messages_are_cut_at_a_letter() {
        fail(Status::File, &format_args!("a{}", "µ".repeat(ROOM)));
        let kept = last();
        assert_eq!(kept.len(), ROOM - 1);
        assert!(kept.ends_with('µ'));
        fail(Status::File, &"nul\0inside");
        assert_eq!(last(), "nul?inside");
    }

    #[test]
    fn each_thread_has_its_own() {
        fail(Status::File, &"mine");
        std::thread::spawn(|| assert_eq!(last(), "")).join().expect("it ends");
        assert_eq!(last(), "mine");
    }
}
