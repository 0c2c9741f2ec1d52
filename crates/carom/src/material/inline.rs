//! `rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma=310MPa`

use super::{Material, Property, PropertyKind};
use crate::error::{LawError, Problem};
use alloc::borrow::ToOwned;

pub(super) fn parse(text: &str) -> Result<Material, LawError> {
    let mut material = Material { name: "inline".into(), ..Material::default() };
    for part in text.split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let Some((key, written)) = part.split_once('=') else {
            return Err(
                LawError::new(format!("'{part}' is not key=value")).help("write for example rho=8000,E=190GPa,nu=0.27")
            );
        };
        let key = key.trim();
        let kind = PropertyKind::by_name(key).ok_or_else(|| Problem::UnknownKey {
            what: "property",
            key: key.to_owned(),
            known: PropertyKind::SYMBOLS.to_vec(),
        })?;
        if material.property(kind).is_some() {
            return Err(Problem::GivenTwice { what: "property", key: key.to_owned() }.into());
        }
        let value = kind
            .parse(written.trim())
            .map_err(|error| LawError::from(Problem::WrongUnit { key: kind.key().to_owned(), error }).within(key))?;
        let property = Property { value, ..Property::default() };
        kind.check(&property)?;
        material.set(kind, property);
    }
    Ok(material)
}
