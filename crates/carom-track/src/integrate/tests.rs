use super::*;

const CONTROL: Control = Control { tolerance: 1e-9, spins: false, place: true };

fn one(x: [f64; 3], v: [f64; 3]) -> Motion<1> {
    Motion { x: x.map(|c| [c]), v: v.map(|c| [c]), spin: [[0.0]; 3] }
}

fn advance(start: &Motion<1>, h: f64, rates: &impl Fn(&Motion<1>, &mut Rates<1>)) -> Step<1> {
    let mut first = Rates::ZERO;
    rates(start, &mut first);
    let mut out = Step::ZERO;
    step(&[0.0], start, &first, &[h], CONTROL, rates, &mut out);
    out
}

/// How far, and how fast, at θ.
fn along(step: &Step<1>, h: f64, t: f64) -> [[f64; 3]; 2] {
    let (x, v) = step.along(&[h], &[t]);
    [x, v].map(|a| a.map(|c| c[0]))
}

#[test]
fn constant_acceleration_is_exact_at_the_end_and_within_the_step() {
    let g = |_: &Motion<1>, r: &mut Rates<1>| r.a = [[0.5], [-9.81], [0.0]];
    let start = one([0.0, 1.0, 0.0], [2.0, 3.0, -1.0]);
    let s = advance(&start, 0.7, &g);
    assert!(s.error_squared[0] < 1e-6, "{}", s.error_squared[0]);
    for t in [0.25, 0.5, 0.9, 1.0] {
        let h = 0.7 * t;
        let [x, v] = along(&s, 0.7, t);
        assert!((x[1] - (3.0 * h - 0.5 * 9.81 * h * h)).abs() < 2e-15);
        assert!((x[0] - (2.0 * h + 0.25 * h * h)).abs() < 2e-15);
        assert!((v[1] - (3.0 - 9.81 * h)).abs() < 1e-14, "{}", v[1] - (3.0 - 9.81 * h));
    }
}

/// v′ = −v + cos x: something nonlinear that needs every stage.
fn swirl(m: &Motion<1>, r: &mut Rates<1>) {
    r.a[0][0] = m.x[1][0].cos() - m.v[0][0];
    r.a[1][0] = (m.x[0][0] * 2.0).sin() - m.v[1][0] * m.v[0][0];
}

fn travel(steps: u32) -> [f64; 4] {
    let mut m = one([0.1, 0.4, 0.0], [1.0, -0.5, 0.0]);
    for _ in 0..steps {
        m = advance(&m, 2.0 / f64::from(steps), &swirl).end;
    }
    [m.x[0][0], m.x[1][0], m.v[0][0], m.v[1][0]]
}

#[test]
fn ends_converge_with_order_five() {
    let exact = travel(4096);
    let off = |n| travel(n).iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (coarse, fine) = (off(16), off(32));
    let order = (coarse / fine).log2();
    assert!((4.7..5.7).contains(&order), "order {order}: {coarse:e} {fine:e}");
}

#[test]
fn paths_within_a_step_converge_with_order_five_or_better() {
    let off = |n: u32| {
        let h = 0.4 / f64::from(n);
        let start = one([0.1, 0.4, 0.0], [1.0, -0.5, 0.0]);
        let [x, v] = along(&advance(&start, h, &swirl), h, 0.37);
        let mut fine = start;
        for _ in 0..64 {
            fine = advance(&fine, 0.37 * h / 64.0, &swirl).end;
        }
        ((x[0] + start.x[0][0] - fine.x[0][0]).abs(), (v[0] - fine.v[0][0]).abs())
    };
    let (coarse, fine) = (off(1), off(2));
    // one step's errors: h⁶ of the path, h⁵ of its slope
    assert!((coarse.0 / fine.0).log2() > 5.5 && (coarse.1 / fine.1).log2() > 4.5, "{coarse:?} {fine:?}");
}

#[test]
fn the_path_has_the_motion_of_both_ends() {
    let start = one([0.1, 0.4, 0.0], [1.0, -0.5, 0.0]);
    let s = advance(&start, 0.1, &swirl);
    let ([first, begin], [last, end]) = (along(&s, 0.1, 0.0), along(&s, 0.1, 1.0));
    for c in 0..3 {
        assert_eq!((first[c], start.x[c][0] + last[c]), (0.0, s.end.x[c][0]));
        assert!((begin[c] - start.v[c][0]).abs() < 1e-14 && (end[c] - s.end.v[c][0]).abs() < 1e-14);
    }
}

#[test]
fn eight_lanes_give_the_bits_of_one() {
    let many = |m: &Motion<8>, r: &mut Rates<8>| {
        for l in 0..8 {
            r.a[0][l] = m.x[1][l].mul_add(0.3, -m.v[0][l]);
            r.a[1][l] = m.x[0][l].mul_add(-1.7, 0.2);
            r.a[2][l] = -m.v[2][l] * m.v[2][l];
        }
    };
    let single = |m: &Motion<1>, r: &mut Rates<1>| {
        r.a[0][0] = m.x[1][0].mul_add(0.3, -m.v[0][0]);
        r.a[1][0] = m.x[0][0].mul_add(-1.7, 0.2);
        r.a[2][0] = -m.v[2][0] * m.v[2][0];
    };
    let mut m = Motion::<8>::ZERO;
    let mut h = [0.0; 8];
    for l in 0..8 {
        let s = l as f64;
        m.x = [0, 1, 2].map(|c| {
            let mut row = m.x[c];
            row[l] = 0.1 * s + c as f64;
            row
        });
        m.v = [0, 1, 2].map(|c| {
            let mut row = m.v[c];
            row[l] = 1.0 - 0.3 * s + c as f64;
            row
        });
        h[l] = 0.01 * (s + 1.0);
    }
    let mut first = Rates::ZERO;
    many(&m, &mut first);
    let mut out = Step::ZERO;
    step(&[0.0; 8], &m, &first, &h, CONTROL, &many, &mut out);
    for l in 0..8 {
        let lone = one([0, 1, 2].map(|c| m.x[c][l]), [0, 1, 2].map(|c| m.v[c][l]));
        let s = advance(&lone, h[l], &single);
        assert_eq!(s.error_squared[0].to_bits(), out.error_squared[l].to_bits());
        for c in 0..3 {
            assert_eq!(s.end.x[c][0].to_bits(), out.end.x[c][l].to_bits());
            assert_eq!(s.path[1][c][0].to_bits(), out.path[1][c][l].to_bits());
        }
    }
}
