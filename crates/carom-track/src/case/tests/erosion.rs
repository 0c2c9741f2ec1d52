//! `erosion` of a wall.

use super::*;

#[test]
fn a_wall_names_its_law_and_numbers() {
    let with = |erosion: &str| GOOD.replacen("law = \"plate\"", &format!("law = \"plate\"\nerosion = {erosion}"), 1);
    let case = read(&with("{ law = \"finnie\", density = \"7800 kg/m3\", flow_stress = \"1 GPa\" }")).unwrap();
    let want = carom::erosion::Erosion::new("finnie", None, &[("density", 7800.0), ("flow_stress", 1e9)]).unwrap();
    assert_eq!(case.erosion, [Some(want), None, None]);
    let all = "{ law = \"oka\", material = \"sand-on-steel\", hardness = \"2 GPa\", n1 = 1, n2 = 2, speed_exponent = 2, diameter_exponent = 0.2, reference_ratio = 1e-4, reference_speed = \"100 m/s\", reference_diameter = \"300 um\" }";
    assert!(read(&with(all)).is_ok());
    assert!(read(&with("{ law = \"e-crc\", brinell = 160, sharpness = 1, constant = 2e-7, exponent = 2.4 }")).is_ok());
    assert!(
        read(&with("{ law = \"finnie\", density = 1e3, flow_stress = 1e9, chip_ratio = 3, force_ratio = 3 }")).is_ok()
    );
}

#[test]
fn mistakes_point_at_their_place() {
    let refused_with = |erosion: &str, words: &[&str]| {
        refused("law = \"plate\"", &format!("law = \"plate\"\nerosion = {erosion}"), words);
    };
    refused_with("{ law = \"dnw\" }", &["known are finnie, dnv, e-crc, oka"]);
    refused_with("{ law = \"dnv\", material = \"lead\" }", &["it knows steel"]);
    refused_with("{ law = \"dnv\" }", &["needs constant", "material = \"steel\""]);
    refused_with("{ law = \"e-crc\", brinell = \"160 GPa\" }", &["160 GPa"]);
    refused_with("{ law = \"e-crc\", brinell = 160, sharpness = 2 }", &["sharpness", "between"]);
    refused_with("{ law = \"e-crc\", brinell = 160, hardness = \"1 GPa\" }", &["has no hardness", "brinell"]);
    refused_with("{ law = \"e-crc\", brinel = 160 }", &["brinel"]);
    refused(
        "law = \"escape\"",
        "law = \"escape\"\nerosion = { law = \"dnv\", material = \"steel\" }",
        &["erosion of an opening"],
    );
    refused("[run]", "[output]\nface_sizes = true\n[run]", &["face_sizes without sizes"]);
}
