//! How a front names what an error is about.
use alloc::borrow::ToOwned;
use alloc::string::String;

/// The words of a front: how its users write keys and settings.
pub trait Wording {
    /// A key of a law, `roughness_factor`.
    fn key(&self, key: &str) -> String;

    /// A value on its own, `0.2` or `"ea"`. It comes without quotation marks.
    fn value(&self, value: &str) -> String;

    /// A key with its value, `friction = 0.2`, from both as they come.
    fn setting(&self, key: &str, value: &str) -> String;

    /// The normal law as a list with this loss, `normal = ["adhesion-work"]`.
    fn loss(&self, name: &str) -> String;

    /// Where the names of materials are found, if the front has a list.
    fn materials(&self) -> Option<String> {
        None
    }
}

/// The words of a law's text: keys and values as in TOML.
#[derive(Clone, Copy, Debug)]
pub struct Keys;

impl Wording for Keys {
    fn key(&self, key: &str) -> String {
        key.to_owned()
    }

    fn value(&self, value: &str) -> String {
        let bare = value.parse::<f64>().is_ok() || value.starts_with(['{', '[']);
        if bare { value.to_owned() } else { format!("\"{value}\"") }
    }

    fn setting(&self, key: &str, value: &str) -> String {
        format!("{key} = {}", self.value(value))
    }

    fn loss(&self, name: &str) -> String {
        format!("normal = [\"{name}\"]")
    }
}
