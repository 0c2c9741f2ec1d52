use super::*;

const CONTROL: Control = Control { tolerance: 1e-9, spins: false, place: true };

fn one(x: [f64; 3], v: [f64; 3]) -> Motion<1> {
    Motion { x: x.map(|c| [c]), v: v.map(|c| [c]), spin: [[0.0]; 3] }
}

fn column(v: &Lanes3<1>) -> [f64; 3] {
    v.map(|c| c[0])
}

fn advance(start: &Motion<1>, h: f64, control: Control, rates: &impl Fn(&Motion<1>, &mut Rates<1>)) -> Step<1> {
    let mut first = Rates::ZERO;
    rates(start, &mut first);
    let mut out = Step::ZERO;
    step(&[0.0], start, &first, &[h], control, rates, &mut out);
    out
}

/// Stokes drag at the rate `beta` in a fluid with the velocity u(x), and a weight.
fn stokes(beta: f64, weight: [f64; 3], u: impl Fn([f64; 3]) -> [f64; 3]) -> impl Fn(&Motion<1>, &mut Rates<1>) {
    move |m, r| {
        let u = u(column(&m.x));
        for c in 0..3 {
            r.a[c][0] = beta.mul_add(u[c] - m.v[c][0], weight[c]);
        }
        r.drag = [beta];
    }
}

/// Rates of drag over those of the flow.
const RATES: [f64; 9] = [1e-3, 0.03, 1.0, 10.0, 100.0, 1e4, 1e6, 1e9, 1e12];

/// The rate of e^{rt} in x″ = β(γ x − x′) that does not die with the drag: (√(1 + 4γ/β) − 1) β/2, γ complex.
fn slow_root(beta: f64, gamma: [f64; 2]) -> [f64; 2] {
    let [a, b] = [1.0 + 4.0 * gamma[0] / beta, 4.0 * gamma[1] / beta];
    let root = (0.5 * (a.hypot(b) + a)).sqrt();
    let divisor = [1.0 + root, b / (2.0 * root)];
    let size = divisor[0] * divisor[0] + divisor[1] * divisor[1];
    let times = |p: [f64; 2], q: [f64; 2]| [p[0] * q[0] - p[1] * q[1], p[0] * q[1] + p[1] * q[0]];
    times(gamma, [2.0 * divisor[0] / size, -2.0 * divisor[1] / size])
}

/// Largest errors of the end's position and velocity, and of positions and velocities within steps, over the way of a sphere through a
/// flow against a plate (x out along it, y down to it) and, across, around an axis with the fluid, in `steps` steps.
fn errors(beta: f64, steps: u32) -> [f64; 4] {
    let rates = stokes(beta, [0.0; 3], |[x, y, _]| [x, -y, 0.0]);
    let around = stokes(beta, [0.0; 3], |[x, y, _]| [-y, x, 0.0]);
    let (out, down, turn) = (slow_root(beta, [1.0, 0.0]), slow_root(beta, [-1.0, 0.0]), slow_root(beta, [0.0, 1.0]));
    let spiral = |t: f64| {
        let (s, c) = (turn[1] * t).sin_cos();
        let size = (turn[0] * t).exp();
        let [x, y] = [size * c, size * s];
        [[x, y, 0.0], [turn[0] * x - turn[1] * y, turn[0] * y + turn[1] * x, 0.0]]
    };
    let jet = |t: f64| {
        let [x, y] = [(out[0] * t).exp(), (down[0] * t).exp()];
        [[x, y, 0.0], [out[0] * x, down[0] * y, 0.0]]
    };
    let mut worst = [0.0f64; 4];
    // a sphere slower than a quarter of the flow's time passes through its axis
    if beta > 4.0 {
        worst = gone(1.0, steps, &rates, jet);
    }
    let second = gone(1.0 / turn[0].hypot(turn[1]), steps, &around, spiral);
    [0, 1, 2, 3].map(|i| worst[i].max(second[i]))
}

fn gone(
    time: f64,
    steps: u32,
    rates: &impl Fn(&Motion<1>, &mut Rates<1>),
    exact: impl Fn(f64) -> [[f64; 3]; 2],
) -> [f64; 4] {
    let h = time / f64::from(steps);
    let off = |a: [f64; 3], b: [f64; 3]| (0..3).fold(0.0f64, |m, c| m.max((a[c] - b[c]).abs()));
    let [x, v] = exact(0.0);
    let (mut m, mut worst) = (one(x, v), [0.0f64; 4]);
    for n in 0..steps {
        let s = advance(&m, h, CONTROL, rates);
        let t = h * f64::from(n);
        for theta in [0.03, 0.3, 0.62, 0.9] {
            let [x, v] = exact(t + theta * h);
            let (offset, slope) = s.along(&[h], &[theta]);
            let place = [0, 1, 2].map(|c| m.x[c][0] + offset[c][0]);
            worst[2] = worst[2].max(off(place, x));
            worst[3] = worst[3].max(off(column(&slope), v));
        }
        m = s.end;
        let [x, v] = exact(t + h);
        worst[0] = worst[0].max(off(column(&m.x), x));
        worst[1] = worst[1].max(off(column(&m.v), v));
    }
    worst
}

#[test]
fn no_order_is_lost_whatever_the_drag() {
    for beta in RATES {
        let (coarse, fine) = (errors(beta, 8), errors(beta, 16));
        for (i, (name, least)) in [("end", 4.8), ("speed", 3.9), ("path", 4.8), ("slope", 3.9)].into_iter().enumerate()
        {
            let order = (coarse[i] / fine[i]).log2();
            assert!(
                (order > least || fine[i] < 1e-13) && fine[i] < 2e-6,
                "{name} at {beta:e}: order {order}, {:e} {:e}",
                coarse[i],
                fine[i]
            );
        }
    }
}

#[test]
fn even_flow_and_stokes_drag_have_no_error_at_any_step() {
    let (weight, wind) = ([0.3, -9.81, 0.0], [0.4, -0.1, 2.0]);
    for z in [1e-12f64, 1e-6, 0.01, 0.9, 2.6, 2.7, 30.0, 1e4, 1e9] {
        let h = 0.02;
        let beta = z / h;
        let start = one([0.1, 0.0, -0.3], [-1.0, 0.7, 0.2]);
        let s = advance(&start, h, CONTROL, &stokes(beta, weight, |_| wind));
        for c in 0..3 {
            let last = wind[c] + weight[c] / beta;
            // (1 − e^{−z})/z and (e^{−z} − 1 + z)/z²
            let one = -(-z).exp_m1() / z;
            let two = if z < 0.1 { 0.5 - z / 6.0 + z * z / 24.0 - z * z * z / 120.0 } else { (1.0 - one) / z };
            let kick = beta * (wind[c] - start.v[c][0]) + weight[c];
            let v = start.v[c][0] + h * one * kick;
            let x = h * (start.v[c][0] + h * two * kick);
            let speed = start.v[c][0].abs().max(if z > 1.0 { last.abs() } else { 0.3 });
            assert!((s.end.v[c][0] - v).abs() < 1e-14 * speed, "{z:e} {c}: {} {v}", s.end.v[c][0]);
            assert!(
                (s.path[4][c][0] - x).abs() < 1e-9 * z.min(1.0) * h * speed + 1e-14 * h * speed,
                "{z:e} {c}: {} {x}",
                s.path[4][c][0]
            );
        }
        // only that the quintic does not follow such a path counts, until it no longer shows
        let small = advance(&start, h, Control { tolerance: 1e-6, ..CONTROL }, &stokes(beta, weight, |_| wind))
            .error_squared[0];
        assert_eq!(small < 1.0, !(0.5..1e8).contains(&z), "{z:e}: {small:e}");
    }
}

/// Steps of their own length to a time, and how many.
fn flown(mut m: Motion<1>, until: f64, tolerance: f64, rates: &impl Fn(&Motion<1>, &mut Rates<1>)) -> (Motion<1>, u32) {
    let control = Control { tolerance, spins: true, place: true };
    let (mut t, mut h, mut steps) = (0.0, 1e-7, 0);
    while t < until {
        let last = until - t <= h;
        let now = if last { until - t } else { h };
        let s = advance(&m, now, control, rates);
        let factor = crate::integrate::growth(s.error_squared[0], true);
        if s.error_squared[0] <= 1.0 {
            m = s.end;
            t = if last { until } else { t + now };
        }
        h = now * factor;
        steps += 1;
    }
    (m, steps)
}

#[test]
fn a_drag_that_rises_with_the_speed_is_followed_as_a_stiff_solver_follows_it() {
    // thrown at Re = 0.5 into a vortex, sinking at Re = 0.05; 10⁴ relaxation times. SciPy's DOP853 and Radau agree to 13 digits
    const WANT: [f64; 4] = [0.589_997_863_092_76, 0.750_872_257_114_72, -0.750_824_978_489_09, 0.482_245_577_910_25];
    let (beta, reynolds, weight) = (1e4, 0.5, [0.0, -1100.0, 0.0]);
    let rates = |m: &Motion<1>, r: &mut Rates<1>| {
        let slip = [-m.x[1][0] - m.v[0][0], m.x[0][0] - m.v[1][0], 0.0];
        let re = reynolds * slip[0].hypot(slip[1]);
        let rate = beta * (1.0 + 0.15 * re.powf(0.687));
        for c in 0..3 {
            r.a[c][0] = rate * slip[c] + weight[c];
        }
        r.drag = [rate];
    };
    for (tolerance, most) in [(1e-6, 190), (1e-8, 450), (1e-10, 4000)] {
        let (m, steps) = flown(one([1.0, 0.0, 0.0], [1.0, 0.5, 0.0]), 1.0, tolerance, &rates);
        let got = [m.x[0][0], m.x[1][0], m.v[0][0], m.v[1][0]];
        let off = got.iter().zip(WANT).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
        assert!(off < 10.0 * tolerance && steps < most, "{tolerance:e}: {off:e} in {steps} steps, {got:?}");
    }
}

#[test]
fn a_spin_relaxes_at_its_own_rate() {
    // ω′ = γ (W − ω): ω = W + (ω₀ − W) e^{−γ t}
    for gamma in [1.0, 1e3, 1e9] {
        let rates = |m: &Motion<1>, r: &mut Rates<1>| {
            r.alpha = [[0.0], [0.0], [gamma * (7.0 - m.spin[2][0])]];
            r.torque = [gamma];
        };
        let start = Motion { spin: [[0.0], [0.0], [-100.0]], ..one([0.0; 3], [1.0, 0.0, 0.0]) };
        let (m, steps) = flown(start, 0.01, 1e-6, &rates);
        let want = 7.0 - 107.0 * (-gamma * 0.01f64).exp();
        assert!(
            (m.spin[2][0] - want).abs() < 1e-12 * 107.0 && steps < 60,
            "{gamma:e}: {} {want}, {steps}",
            m.spin[2][0]
        );
    }
}

#[test]
fn eight_lanes_give_the_bits_of_one() {
    fn forces<const W: usize>(m: &Motion<W>, r: &mut Rates<W>) {
        for l in 0..W {
            // a rate of its own for each start
            let beta = 10f64.powf(10.0 * m.x[2][l]);
            for c in 0..3 {
                r.a[c][l] = beta * (m.x[(c + 1) % 3][l].mul_add(-1.5, 0.3) - m.v[c][l]);
                r.alpha[c][l] = 0.3 * beta * (m.x[c][l] - m.spin[c][l]);
            }
            (r.drag[l], r.torque[l]) = (beta, 0.3 * beta);
        }
    }
    let control = Control { tolerance: 1e-6, spins: true, place: true };
    let (mut m, mut h) = (Motion::<8>::ZERO, [0.0; 8]);
    for l in 0..8 {
        let s = l as f64;
        for c in 0..3 {
            m.x[c][l] = 0.1 * s + 0.03 * c as f64;
            m.v[c][l] = 0.5 - 0.2 * s + 0.1 * c as f64;
            m.spin[c][l] = s - c as f64;
        }
        h[l] = 0.01 * (s + 1.0);
    }
    let mut first = Rates::ZERO;
    forces(&m, &mut first);
    let mut all = Step::ZERO;
    step(&[0.0; 8], &m, &first, &h, control, &|m: &Motion<8>, r: &mut Rates<8>| forces(m, r), &mut all);
    for l in 0..8 {
        let pick = |v: &Lanes3<8>| v.map(|c| [c[l]]);
        let lone = Motion { x: pick(&m.x), v: pick(&m.v), spin: pick(&m.spin) };
        let s = advance(&lone, h[l], control, &|m: &Motion<1>, r: &mut Rates<1>| forces(m, r));
        assert_eq!(s.error_squared[0].to_bits(), all.error_squared[l].to_bits(), "{l}");
        for c in 0..3 {
            assert_eq!(s.end.x[c][0].to_bits(), all.end.x[c][l].to_bits());
            assert_eq!(s.end.v[c][0].to_bits(), all.end.v[c][l].to_bits());
            assert_eq!(s.end.spin[c][0].to_bits(), all.end.spin[c][l].to_bits());
            assert_eq!(s.path[1][c][0].to_bits(), all.path[1][c][l].to_bits());
            assert_eq!(s.twist[1][c][0].to_bits(), all.twist[1][c][l].to_bits());
        }
    }
}
