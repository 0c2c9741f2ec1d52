//! The core speaks of keys, `friction = 0.2`; on a command line the user wrote flags, `--friction 0.2`.

use carom::SpecError;

/// Keys that are written as flags wherever they appear.
const KEYS: [&str; 16] = [
    "walton_beta",
    "roughness_factor",
    "roughness_model",
    "roughness_angle",
    "asperity_radius",
    "adhesion_damping",
    "hertz_damping",
    "surface_curvature",
    "tangential_restitution",
    "yield_velocity",
    "meyer_index",
    "limiting_pressure",
    "interfacial_parameter",
    "equilibrium_spacing",
    "work_of_adhesion",
    "plastic_constant",
];

/// Keys that are common words too: flags only where a value follows.
const WORDS: [(&str, &str); 7] = [
    ("normal", "law"),
    ("adhesion", "adhesion"),
    ("tangential", "tangential"),
    ("friction", "friction"),
    ("roughness", "roughness"),
    ("restitution", "restitution"),
    ("stiffness", "stiffness"),
];

/// The message with flags for keys.
pub fn as_flags(error: &SpecError) -> String {
    for body in ["sphere", "surface"] {
        if error.message.starts_with(&format!("the {body} (not given)")) {
            return format!("the law needs a {body}; give --{body}, a material's name or its properties");
        }
    }
    let mut text = error.to_string().replace("give sphere and surface", "give --sphere and --surface");
    for key in KEYS {
        let flag = format!("--{}", key.replace('_', "-"));
        text = text.replace(&format!("{key} = "), &format!("{flag} ")).replace(key, &flag);
    }
    for (key, flag) in WORDS {
        text = replace_word(&text, &format!("{key} = "), &format!("--{flag} "));
    }
    text = text.replace("leave the key out", "leave it out");
    text.replace("[\"", "").replace("\"]", "").replace('"', "")
}

/// Replaces `from` where no letter, `-` or `_` stands before it.
fn replace_word(text: &str, from: &str, to: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(from) {
        let (before, after) = rest.split_at(at);
        out.push_str(before);
        let inside = out.chars().last().is_some_and(|c| c.is_alphanumeric() || c == '-' || c == '_');
        out.push_str(if inside { from } else { to });
        rest = &after[from.len()..];
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(message: &str, help: &str) -> String {
        as_flags(&SpecError::new(message).help(help))
    }

    #[test]
    fn keys_become_flags() {
        assert_eq!(
            said("the law needs a friction coefficient for oblique impacts", "give friction = 0.2, say"),
            "the law needs a friction coefficient for oblique impacts; give --friction 0.2, say"
        );
        assert_eq!(
            said(
                "tangential_restitution has no effect with tangential = \"rolling\"",
                "write tangential = \"constant\""
            ),
            "--tangential-restitution has no effect with --tangential rolling; write --tangential constant"
        );
        assert_eq!(
            said("both roughness_factor and roughness", "keep one"),
            "both --roughness-factor and roughness; keep one"
        );
        assert_eq!(
            said("the law needs Tabor's fitted yield velocity", "give yield_velocity = \"0.09 m/s\""),
            "the law needs Tabor's fitted yield velocity; give --yield-velocity 0.09 m/s"
        );
    }

    #[test]
    fn a_missing_body_is_asked_for() {
        assert!(said("the surface (not given) has no Young's modulus", "give its E").contains("give --surface"));
    }
}
