//! What serde says of a text that has the wrong form, in words for those who wrote the text.

use super::LawError;
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;

/// The message in plain words; none for what is plain already.
pub(super) fn said(message: &str) -> Option<LawError> {
    if let Some(field) = between(message, "missing field `", "`") {
        return Some(LawError::new(format!("the key '{field}' is missing here")));
    }
    if message.starts_with("data did not match any variant") {
        return Some(LawError::new("this has none of the forms that it may have"));
    }
    if let Some(rest) = message.strip_prefix("unknown variant `") {
        let (wrong, known) = rest.split_once("`, expected ")?;
        return Some(LawError::new(format!("'{wrong}' is not known here; known are {}", known.replace('`', ""))));
    }
    let (found, wanted) = message.rsplit_once(", expected ")?;
    let wanted = wanted_form(wanted);
    let (found, rest) = found.split_once(' ').map(|(_, rest)| rest).and_then(|rest| rest.split_once([':', ' ']))?;
    let found = match found {
        "length" => format!("{} values stand", rest.trim()),
        "type" | "value" => format!("{} stands", found_form(rest.trim())),
        _ => return None,
    };
    Some(LawError::new(format!("{found} here; {wanted} is wanted")))
}

fn between<'a>(text: &'a str, before: &str, after: &str) -> Option<&'a str> {
    text.strip_prefix(before)?.split_once(after).map(|(inside, _)| inside)
}

/// `floating point `9.81`` is 9.81.
fn found_form(found: &str) -> String {
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "a table".to_owned(),
        _ => match (found.split_once('`'), found.strip_prefix("string ")) {
            (_, Some(text)) => format!("the text {text}"),
            (Some((_, value)), _) => value.trim_end_matches('`').trim_end_matches(".0").to_owned(),
            _ => found.to_owned(),
        },
    }
}

/// `an array of length 3` is a list of 3 values.
fn wanted_form(wanted: &str) -> String {
    if let Some(length) = wanted.strip_prefix("an array of length ") {
        return format!("a list of {length} values, [x, y, ...],");
    }
    match wanted {
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, zero or more,",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "f32" | "f64" => "a number (without quotes)",
        "a string" | "a borrowed string" => "a text in quotes",
        "a sequence" => "a list in [ ]",
        "a map" => "a table",
        "a boolean" => "true or false",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
    .to_owned()
}
