//! Chance is drawn by particle and step: who tracks a sphere, with whom and after which interruption, leaves no trace.

use super::shards::whole_threads_and_shards;
use super::*;

/// Nanospheres of two sizes in a laminar channel, above a floor they bounce on and below a ceiling that keeps them; eddies beside the
/// molecules where `eddies` says so.
fn case(eddies: bool, [fine, coarse]: [u64; 2]) -> Case {
    let (profile, walk) =
        if eddies { ("turbulent", "random_walk = { model = \"langevin\" }\n") } else { ("laminar", "") };
    let text = format!(
        r#"
seed = 11
[flow]
kind = "channel"
profile = "{profile}"
height = "1 mm"
mean_speed = "40 m/s"
[forces]
brownian = true
gravity = ["0 m/s2", "-9.81 m/s2", "0 m/s2"]
{walk}[[wall]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 1, 0] }}
law = "reflect"
restitution = 1
tangential_restitution = 1
[[wall]]
name = "ceiling"
plane = {{ point = [0, 0.001, 0], normal = [0, -1, 0] }}
law = "trap"
[[injection]]
name = "fine"
density = "1000 kg/m3"
diameter = "60 nm"
count = {fine}
position = {{ box = [["0 m", "0.05 um", "0 m"], ["0 m", "0.3 um", "1 mm"]] }}
velocity = "fluid"
[[injection]]
name = "coarse"
density = "2000 kg/m3"
diameter = "400 nm"
count = {coarse}
position = {{ box = [["0 m", "999.4 um", "0 m"], ["0 m", "999.7 um", "1 mm"]] }}
velocity = "fluid"
[run]
until = "0.01 ms"
[output]
trajectories = 5
"#
    );
    Case::from_toml(&text, Path::new("case.toml"), Library::builtin()).unwrap()
}

#[test]
fn threads_shards_stops_and_power_cuts_leave_no_trace_in_brownian_runs() {
    for (eddies, spheres) in [(false, [24, 12]), (true, [6, 3])] {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let case = case(eddies, spheres);
        let whole = whole_threads_and_shards(&case, folder.path(), 3);
        let impacts: u64 = whole.walls.iter().map(|w| w.impacts).sum();
        let ends: u64 = whole.fates.iter().map(|f| f.count).sum();
        assert!(impacts > 5 && ends == spheres[0] + spheres[1], "{impacts} impacts, {ends} ends");
        let (cut, again) = (at("cut"), |threads| RunOptions { resume: true, ..options(&at("cut"), threads) });
        let often = RunOptions { checkpoint_every: Duration::ZERO, ..options(&cut, 2) };
        run_on(&case, &often, &Silent, &power::Unplugged::after(20, &cut), HELD).unwrap_err();
        let stops = StopsAt(ends - 5, AtomicU64::new(0));
        if let Err(error) = run(&case, &again(1), &stops) {
            assert!(matches!(error, RunError::Stopped), "{error}");
        }
        run(&case, &again(2), &Silent).unwrap();
        assert_eq!(files(&at("whole")), files(&cut));
    }
}
