//! What is wrong at a place in a file.

/// A fault, and at which byte.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) at: usize,
    pub(super) what: String,
}

pub(super) fn fault(at: usize, what: impl Into<String>) -> Fault {
    Fault { at, what: what.into() }
}
