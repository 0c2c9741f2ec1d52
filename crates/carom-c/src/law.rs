//! A law: made, asked for its density, freed.

use crate::status::{Status, fail, guard};
use carom::material::Library;
use carom::spec::{parse_named_law, parse_only_law};
use std::borrow::Cow;
use std::ffi::{CStr, c_char};
use std::path::Path;

/// A wall law, compiled. It never changes: any number of threads may use one at once.
pub struct Law(pub(crate) carom::WallLaw);

/// A failure before it is handed out.
type Refusal = (Status, String);

/// Makes a law from a text.
///
/// `toml`: a text with [law.NAME] tables (a law file, or a whole case file), or the keys of one law without a header.
/// `name`: the law wanted; NULL when the text holds one law.
/// `materials`: NULL, or a text with [material.NAME] tables to add to the library's.
/// `out`: receives the law, to be freed with carom_law_free; NULL on failure.
///
/// # Safety
/// Texts are NULL (where allowed) or end with a zero; `out` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_law_from_text(
    toml: *const c_char,
    name: *const c_char,
    materials: *const c_char,
    out: *mut *mut Law,
) -> Status {
    let read = || {
        // SAFETY: the caller promises texts that end with a zero, or NULL.
        let (toml, name, materials) =
            unsafe { (text(toml, "toml"), optional(name, "name"), optional(materials, "materials")) };
        build("law", toml?, name?, materials?.map(|m| ("materials", m)))
    };
    // SAFETY: the caller promises that `out` can be written to, or is NULL.
    guard(|| unsafe { hand_out(read, out) })
}

/// Makes a law from a file, as carom's `--wall-law FILE:NAME`.
///
/// `path`: a law file or a case file. `name`: the law wanted; NULL when the file holds one law.
/// `materials_path`: NULL, or a file with [material.NAME] tables to add to the library's.
/// `out`: receives the law, to be freed with carom_law_free; NULL on failure.
///
/// # Safety
/// Texts are NULL (where allowed) or end with a zero; `out` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_law_from_file(
    path: *const c_char,
    name: *const c_char,
    materials_path: *const c_char,
    out: *mut *mut Law,
) -> Status {
    let read = || {
        // SAFETY: the caller promises texts that end with a zero, or NULL.
        let (path, name, materials) =
            unsafe { (text(path, "path"), optional(name, "name"), optional(materials_path, "materials_path")) };
        let (path, name, materials) = (path?, name?, materials?);
        let toml = file(path)?;
        let extra = materials.map(|m| file(m).map(|t| (m, t))).transpose()?;
        build(path, &toml, name, extra.as_ref().map(|(m, t)| (*m, t.as_str())))
    };
    // SAFETY: the caller promises that `out` can be written to, or is NULL.
    guard(|| unsafe { hand_out(read, out) })
}

/// Frees a law; NULL is let pass.
///
/// # Safety
/// `law` comes from carom_law_from_text or carom_law_from_file, is used by no thread any more and was not freed before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_law_free(law: *mut Law) {
    if !law.is_null() {
        guard(|| {
            // SAFETY: it came out of `Box::into_raw` below, and the caller gives it up.
            drop(unsafe { Box::from_raw(law) });
            Status::Ok
        });
    }
}

/// Density of the law's own sphere, kg/m3, for impacts that give none (1000 in a law without materials); NaN for NULL.
///
/// # Safety
/// `law` is NULL or a law that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_law_density(law: *const Law) -> f64 {
    // SAFETY: NULL or a law, as the caller promises.
    unsafe { law.as_ref() }.map_or(f64::NAN, |law| law.0.density())
}

/// Whether the law scatters, so that its impacts depend on `draws`: 1, or 0 for laws that do not look at them; -1 for NULL.
///
/// # Safety
/// `law` is NULL or a law that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_law_scatters(law: *const Law) -> i32 {
    // SAFETY: NULL or a law, as the caller promises.
    unsafe { law.as_ref() }.map_or(-1, |law| i32::from(law.0.scatter().is_some()))
}

/// # Safety
/// `out` is NULL or can be written to.
unsafe fn hand_out(read: impl FnOnce() -> Result<Law, Refusal>, out: *mut *mut Law) -> Status {
    if out.is_null() {
        return fail(Status::BadArgument, &"out is NULL");
    }
    let (law, status) = match read() {
        Ok(law) => (Box::into_raw(Box::new(law)), Status::Ok),
        Err((status, message)) => (std::ptr::null_mut(), fail(status, &message)),
    };
    // SAFETY: not NULL, and so fit to be written to, as the caller promises.
    unsafe { out.write(law) };
    status
}

/// # Safety
/// `pointer` is NULL or a text that ends with a zero and lives for `'a`.
unsafe fn optional<'a>(pointer: *const c_char, what: &str) -> Result<Option<&'a str>, Refusal> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: not NULL, so a text, as the caller promises.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map(Some).map_err(|e| (Status::BadArgument, format!("{what} is not UTF-8: {e}")))
}

/// # Safety
/// As [`optional`].
unsafe fn text<'a>(pointer: *const c_char, what: &str) -> Result<&'a str, Refusal> {
    // SAFETY: handed on.
    unsafe { optional(pointer, what) }?.ok_or_else(|| (Status::BadArgument, format!("{what} is NULL")))
}

fn file(path: &str) -> Result<String, Refusal> {
    let path_of = Path::new(path);
    // a device or a pipe may never end
    if std::fs::metadata(path_of).is_ok_and(|about| !about.is_file() && !about.is_dir()) {
        return Err((Status::File, format!("{path}: not a regular file, but a device or a pipe")));
    }
    std::fs::read_to_string(path_of).map_err(|e| {
        let said = e.to_string();
        // the number says nothing to the reader
        (Status::File, format!("{path}: {}", said.split(" (os error").next().unwrap_or(&said)))
    })
}

fn build(place: &str, toml: &str, name: Option<&str>, materials: Option<(&str, &str)>) -> Result<Law, Refusal> {
    let mut library = Cow::Borrowed(Library::builtin());
    if let Some((place, text)) = materials {
        library.to_mut().extend_from_toml(text).map_err(|e| (Status::BadLaw, e.shown(place, text)))?;
    }
    name.map_or_else(|| parse_only_law(toml), |name| parse_named_law(toml, name))
        .and_then(|spec| spec.compile(&library))
        .map(Law)
        .map_err(|e| (Status::BadLaw, e.shown(place, toml)))
}
