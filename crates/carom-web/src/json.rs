//! JSON as the page reads it: texts, numbers, lists, objects.

use std::fmt::Write as _;

/// A text in quotation marks.
pub fn text(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c < ' ' => {
                let _ = write!(out, "\\u{:04x}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A number; null where it is none.
pub fn number(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "null".to_owned(), |v| format!("{v:e}"))
}

/// A list of what is JSON already.
pub fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(","))
}

/// An object of what is JSON already; what is empty is left out.
pub fn object<'a>(entries: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let entries = entries.into_iter().filter(|(_, value)| !matches!(value.as_str(), "\"\"" | "null" | "[]"));
    format!("{{{}}}", entries.map(|(key, value)| format!("{}:{value}", text(key))).collect::<Vec<_>>().join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_json_gives_a_meaning_is_written_another_way() {
        assert_eq!(text("a \"b\"\\\n"), "\"a \\\"b\\\"\\\\\\u000a\"");
        assert_eq!(
            object([("a", number(Some(0.1))), ("b", text("")), ("c", list([number(None)]))]),
            "{\"a\":1e-1,\"c\":[null]}"
        );
    }
}
