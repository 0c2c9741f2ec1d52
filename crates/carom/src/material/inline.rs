//! `rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma=310MPa`

use super::{Material, Property, PropertyKind};
use crate::error::{SpecError, did_you_mean};
use crate::units::{Density, Number, Pressure, SurfaceEnergy, UnitError};

fn value(kind: PropertyKind, text: &str) -> Result<f64, UnitError> {
    Ok(match kind {
        PropertyKind::Density => text.parse::<Density>()?.0,
        PropertyKind::YoungModulus
        | PropertyKind::YieldStrength
        | PropertyKind::Hardness
        | PropertyKind::TensileStrength => text.parse::<Pressure>()?.0,
        PropertyKind::PoissonRatio => text.parse::<Number>()?.0,
        PropertyKind::SurfaceEnergy => text.parse::<SurfaceEnergy>()?.0,
    })
}

pub(super) fn parse(text: &str) -> Result<Material, SpecError> {
    let mut material = Material { name: "inline".into(), ..Material::default() };
    for part in text.split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let Some((key, written)) = part.split_once('=') else {
            return Err(
                SpecError::new(format!("'{part}' is no key=value")).help("write for example rho=8000,E=190GPa,nu=0.27")
            );
        };
        let key = key.trim();
        let found = PropertyKind::ALL.into_iter().find(|kind| kind.symbol() == key || kind.key() == key);
        let Some(kind) = found else {
            let symbols = PropertyKind::ALL.map(PropertyKind::symbol);
            let near = did_you_mean(key, symbols).map_or(String::new(), |s| format!("{s} "));
            return Err(SpecError::new(format!("unknown property '{key}' in '{text}'"))
                .help(format!("{near}known are {}", symbols.join(", "))));
        };
        if material.property(kind).is_some() {
            return Err(SpecError::new(format!("'{key}' is given twice in '{text}'")).help("keep one of them"));
        }
        let value = value(kind, written.trim()).map_err(|e| SpecError::new(format!("{key} = {e}")))?;
        let property = Property { value, ..Property::default() };
        kind.check(&property)?;
        material.set(kind, property);
    }
    Ok(material)
}
