use super::*;

#[test]
fn common_texts_are_exact() {
    assert_eq!("90 um".parse(), Ok(Length(9e-5)));
    assert_eq!("90µm".parse(), Ok(Length(9e-5)));
    assert_eq!("0.07 mm".parse(), Ok(Length(7e-5)));
    assert_eq!("1 nm".parse(), Ok(Length(1e-9)));
    assert_eq!("5 angstrom".parse(), Ok(Length(5e-10)));
    assert_eq!("190 GPa".parse(), Ok(Pressure(190e9)));
    assert_eq!("145 MPa".parse(), Ok(Pressure(145e6)));
    assert_eq!("1.2 J/m2".parse(), Ok(SurfaceEnergy(1.2)));
    assert_eq!("30 mN/m".parse(), Ok(SurfaceEnergy(0.03)));
    assert_eq!("1.83e-5 Pa s".parse(), Ok(Viscosity(1.83e-5)));
    assert_eq!("1 cP".parse(), Ok(Viscosity(1e-3)));
    assert_eq!("-9.81 m/s2".parse(), Ok(Acceleration(-9.81)));
    assert_eq!("-9.81 m s^-2".parse(), Ok(Acceleration(-9.81)));
    assert_eq!("8.94 g/cm3".parse(), Ok(Density(8940.0)));
    assert_eq!("8940 kg m⁻³".parse(), Ok(Density(8940.0)));
    assert_eq!("24 degC".parse(), Ok(Temperature(297.15)));
    assert_eq!("1.3 s/m".parse(), Ok(InverseSpeed(1.3)));
    assert_eq!("7200 1/h".parse(), Ok(Frequency(2.0)));
    assert_eq!("0.8".parse(), Ok(Number(0.8)));
    assert_eq!("2".parse(), Ok(Speed(2.0)));
    // what people write
    assert_eq!("10 ksi".parse::<Pressure>().map(|p| p.0.round()), Ok(68_947_573.0));
    assert_eq!("18 Mpsi".parse::<Pressure>().map(|p| (p.0 / 1e6).round()), Ok(124_106.0));
    assert_eq!("1 mil".parse(), Ok(Length(2.54e-5)));
    assert_eq!("2 inch".parse(), Ok(Length(0.0508)));
    assert_eq!("5 micron".parse(), Ok(Length(5e-6)));
    assert_eq!("7.87 g/cc".parse(), Ok(Density(7870.0)));
    assert_eq!("36 km/h".parse(), Ok(Speed(10.0)));
    assert_eq!("100 mph".parse(), Ok(Speed(44.704)));
    assert_eq!("30 dyn/cm".parse::<SurfaceEnergy>().map(|w| (w.0 * 1e12).round()), Ok(3e10));
    assert_eq!("1 kgf/mm2".parse::<Pressure>().map(|p| p.0.round()), Ok(9_806_650.0));
    assert_eq!("60 rpm".parse(), Ok(AngularVelocity(core::f64::consts::TAU)));
    assert_eq!("1 rev/s".parse(), Ok(AngularVelocity(core::f64::consts::TAU)));
    assert_eq!("180°".parse(), Ok(Angle(core::f64::consts::PI)));
    assert_eq!(("180 deg".parse::<Angle>().map(|a| a.0)), Ok(core::f64::consts::PI));
}

fn complaint<T: core::str::FromStr<Err = UnitError> + core::fmt::Debug>(text: &str) -> (usize, String) {
    let e = text.parse::<T>().expect_err("should be refused");
    (e.at, e.to_string())
}

#[test]
fn errors_point_at_the_character_and_say_what_fits() {
    let (at, text) = complaint::<Length>("90 umm");
    assert_eq!(at, 3, "{text}");
    assert!(text.contains("unknown unit 'umm'") && text.contains("90 um"), "{text}");
    let (at, text) = complaint::<SurfaceEnergy>("1.2 J/m3");
    assert_eq!(at, 4, "{text}");
    assert!(text.contains("J/m2"), "{text}");
    assert!(complaint::<Length>("um").1.contains("no number"));
    assert!(complaint::<Length>("").1.contains("nothing"));
    assert!(complaint::<Length>("inf").1.contains("not a finite"));
    assert!(complaint::<Length>("NaN m").1.contains("not a finite"));
    assert!(complaint::<Length>("1e400 m").1.contains("not a finite"));
    assert!(complaint::<Length>("1e-320 nm").1.contains("too small"));
    assert!(complaint::<Length>("5 m/").1.contains("after '/'"));
    assert!(complaint::<Temperature>("-300 degC").1.contains("absolute zero"));
    assert!(complaint::<Number>("0.8 m").1.contains("no unit"));
    assert!(complaint::<Length>("5 m9999999999").1.contains("power"));
}
