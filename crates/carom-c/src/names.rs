//! Words for the numbers in results, and the version.

use carom::validity::CODES;
use std::ffi::{CStr, CString, c_char};
use std::sync::LazyLock;

/// The core's words, ended with a zero once.
static VALIDITY: LazyLock<Vec<[CString; 2]>> = LazyLock::new(|| {
    let ended = |text: &str| CString::new(text).unwrap_or_default();
    CODES.iter().map(|(code, _, meaning)| [ended(code), ended(meaning)]).collect()
});

/// The word for a carom_fate, such as "rebound"; NULL for a number that is none.
#[unsafe(no_mangle)]
pub extern "C" fn carom_fate_name(fate: i32) -> *const c_char {
    let name = match fate {
        -1 => c"unmet",
        0 => c"rebound",
        1 => c"capture",
        _ => return std::ptr::null(),
    };
    name.as_ptr()
}

/// The word for a carom_contact, such as "rolling"; NULL for a number that is none.
#[unsafe(no_mangle)]
pub extern "C" fn carom_contact_name(contact: i32) -> *const c_char {
    let name = match contact {
        0 => c"none",
        1 => c"sliding",
        2 => c"rolling",
        3 => c"micro-slip",
        _ => return std::ptr::null(),
    };
    name.as_ptr()
}

fn validity(bit: u64, column: usize) -> *const c_char {
    let code = CODES.iter().position(|(_, v, _)| u64::from(v.bits()) == bit);
    code.and_then(|i| VALIDITY.get(i)).map_or(std::ptr::null(), |words| words[column].as_ptr())
}

/// The code of one bit of `validity`, such as "large-contact"; NULL for a bit that means nothing (yet): try 1, 2, 4, ...
#[unsafe(no_mangle)]
pub extern "C" fn carom_validity_name(bit: u64) -> *const c_char {
    validity(bit, 0)
}

/// What that code means, in a sentence; NULL for a bit that means nothing (yet).
#[unsafe(no_mangle)]
pub extern "C" fn carom_validity_meaning(bit: u64) -> *const c_char {
    validity(bit, 1)
}

const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => c"",
};

/// The library's version, such as "0.2.0".
#[unsafe(no_mangle)]
pub extern "C" fn carom_version() -> *const c_char {
    VERSION.as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::{Contact, Fate};

    fn word(pointer: *const c_char) -> Option<String> {
        // SAFETY: NULL or one of the texts above.
        (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned())
    }

    #[test]
    fn words_are_the_cores() {
        for (number, fate) in [(Fate::Rebound, carom::Fate::Rebound), (Fate::Capture, carom::Fate::Capture)] {
            assert_eq!(word(carom_fate_name(number as i32)).as_deref(), Some(fate.name()));
        }
        use carom::Contact as C;
        for (number, contact) in [
            (Contact::None, C::None),
            (Contact::Sliding, C::Sliding),
            (Contact::Rolling, C::Rolling),
            (Contact::MicroSlip, C::MicroSlip),
        ] {
            assert_eq!(word(carom_contact_name(number as i32)).as_deref(), Some(contact.name()));
        }
        for (code, bit, meaning) in CODES {
            assert_eq!(word(carom_validity_name(bit.bits().into())).as_deref(), Some(code));
            assert_eq!(word(carom_validity_meaning(bit.bits().into())).as_deref(), Some(meaning));
        }
        assert_eq!(word(carom_version()).as_deref(), Some(env!("CARGO_PKG_VERSION")));
    }

    #[test]
    fn numbers_that_are_none_have_no_name() {
        assert!(carom_fate_name(2).is_null() && carom_contact_name(-1).is_null());
        assert!(carom_validity_name(0).is_null() && carom_validity_name(3).is_null());
    }
}
