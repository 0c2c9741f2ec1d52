use super::*;
use crate::force::Slip;

const STATE: &str = "density = \"1.19 kg/m3\"\nviscosity = \"1.83e-5 Pa s\"";

fn with(lines: &str) -> Result<Case, CaseError> {
    read(&GOOD.replacen(STATE, lines, 1))
}

#[test]
fn a_gas_slips_and_a_liquid_does_not() {
    let case = with(STATE).unwrap();
    assert_eq!(case.dynamics.forces.slip, Slip::Davies);
    // 24 °C, 1.19 kg/m³: λ = μ/(0.499 ρ c̄), c̄ = 466.08 m/s
    let path = 1.83e-5 / (0.499 * 1.19 * 466.08);
    assert!((case.dynamics.fluid.mean_free_path / path - 1.0).abs() < 1e-4, "{:?}", case.dynamics.fluid);
    let water = with("density = 998\nviscosity = 1e-3\nliquid = true").unwrap();
    assert_eq!((water.dynamics.forces.slip, water.dynamics.fluid.mean_free_path), (Slip::None, 0.0));
    let chamber = with("pressure = \"1e-4 Torr\"\ntemperature = \"20 degC\"").unwrap();
    assert!((chamber.dynamics.fluid.mean_free_path - 0.4955).abs() < 1e-4, "{:?}", chamber.dynamics.fluid);
    let moist = with("temperature = \"24 degC\"\nhumidity = \"25 %\"").unwrap();
    assert!((moist.dynamics.fluid.density / 1.18504 - 1.0).abs() < 1e-3, "{:?}", moist.dynamics.fluid);
}

#[test]
fn fluids_that_cannot_be_are_refused() {
    let liquid = "density = 998\nviscosity = 1e-3\nliquid = true";
    refused(STATE, "density = 998\nviscosity = 1e-3", &["density 998 kg/m3 is no gas's", "add liquid = true"]);
    refused(STATE, "pressure = \"1 atm\"\ndensity = 0.6\ntemperature = 293", &["contradict each other", "leave one"]);
    refused(STATE, "gas = \"helum\"", &["unknown gas 'helum'", "did you mean helium?"]);
    refused(STATE, "gas = \"argon\"\nhumidity = 0.3", &["humidity in argon"]);
    refused(STATE, "humidity = 45", &["humidity is 45", "from 0 to 1"]);
    refused(STATE, "gas = \"helium\"\ntemperature = \"-150 degC\"", &["helium at 123.15", "from 200 K to 600 K"]);
    let half = with("density = 998\nliquid = true").unwrap_err().to_string();
    assert!(half.contains("a liquid needs density and viscosity"), "{half}");
    refused(STATE, &format!("{liquid}\npressure = \"1 atm\""), &["pressure of a liquid"]);
    refused(STATE, "mean_free_path = \"-1 nm\"", &["mean free path", "positive"]);
    let text = GOOD.replacen(STATE, liquid, 1);
    let error = read(&text.replacen("[forces]", "[forces]\nslip = \"davies\"", 1)).unwrap_err().to_string();
    assert!(error.contains("slip in a liquid"), "{error}");
    assert!(read(&text.replacen("[forces]", "[forces]\nslip = \"none\"", 1)).is_ok());
}

#[test]
fn doubtful_drag_is_told() {
    let told = |from: &str, to: &str, word: &str| {
        let case = read(&GOOD.replacen(from, to, 1)).unwrap();
        case.notes.iter().any(|note| note.contains(word))
    };
    assert!(!told("seed", "seed", "slip") && !told("seed", "seed", "speed"));
    assert!(!told("[forces]", "[forces]\nslip = \"none\"", "slip"), "90 um slips by 0.2 %");
    let small = "diameter = \"500 nm\"";
    let off = GOOD.replacen("[forces]", "[forces]\nslip = \"none\"", 1).replacen("diameter = \"90 um\"", small, 1);
    let notes = read(&off).unwrap().notes;
    assert!(notes.iter().any(|n| n.contains("slip is none") && n.contains("1.33")), "{notes:?}");
    let fast = "velocity = [\"150 m/s\", \"0 m/s\", \"0 m/s\"]";
    assert!(told("velocity = [\"2 m/s\", \"0 m/s\", \"0 m/s\"]", fast, "most probable speed"));
    assert!(told(STATE, "mean_free_path = \"1 um\"", "mean_free_path is 1.000e-6"));
    assert!(!told(STATE, "mean_free_path = \"68 nm\"", "mean_free_path"));
    assert!(told(STATE, "pressure = \"20 bar\"", "taken as ideal"));
}
