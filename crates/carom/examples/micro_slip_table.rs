//! Makes the table of the closed micro-slip law from the resolved one; its output is the file.
//!
//! cargo run --release -p carom --example micro_slip_table > crates/carom/src/tangential/micro_slip/table.rs
//!
//! ρ(u, e, κ) at Chebyshev nodes of all three variables, turned into the Chebyshev series that goes through them.

use carom::tangential::micro_slip::{STIFFNESS_RATIOS, full_slip, resolved};
use std::f64::consts::PI;

const NODES: [usize; 3] = [5, 4, 16];
/// Steps of the integration: e_t to about 5e-6.
const STEPS: usize = 400;

/// Chebyshev node `i` of `n` on [−1, 1].
fn node(i: usize, n: usize) -> f64 {
    -(PI * (i as f64 + 0.5) / n as f64).cos()
}

fn chebyshev(degree: usize, x: f64) -> f64 {
    (degree as f64 * x.acos()).cos()
}

/// ρ at a node: κ, e and u from their scaled values.
fn rho(z: f64, y: f64, x: f64) -> f64 {
    let [least, greatest] = STIFFNESS_RATIOS;
    let (kappa, e, u) = (0.5 * (least + greatest) + 0.5 * (greatest - least) * z, 0.5 * (1.0 + y), 0.5 * (1.0 + x));
    let pi = resolved::impulse(u * full_slip(kappa, e), kappa, e, STEPS);
    (pi / (1.0 + e) / u - 1.0) / (1.0 - u)
}

fn main() {
    let [nk, ne, nu] = NODES;
    let mut series = vec![0.0; nk * ne * nu];
    for (k, j, i) in indices() {
        let (z, y, x) = (node(k, nk), node(j, ne), node(i, nu));
        let value = rho(z, y, x);
        for (place, (c, b, a)) in indices().enumerate() {
            let weight: f64 =
                [(c, nk), (b, ne), (a, nu)].iter().map(|(m, n)| if *m == 0 { 1.0 } else { 2.0 } / *n as f64).product();
            series[place] += weight * value * chebyshev(c, z) * chebyshev(b, y) * chebyshev(a, x);
        }
    }
    print(&series);
}

fn indices() -> impl Iterator<Item = (usize, usize, usize)> {
    let [nk, ne, nu] = NODES;
    (0..nk * ne * nu).map(move |n| (n / (ne * nu), n / nu % ne, n % nu))
}

fn print(series: &[f64]) {
    let [nk, ne, nu] = NODES;
    println!("//! Chebyshev series of ρ, made by the example `micro_slip_table`. Do not edit.");
    println!();
    println!("/// Terms in 3κ − 3.\npub(super) const IN_KAPPA: usize = {nk};");
    println!("/// Terms in 2e − 1.\npub(super) const IN_RESTITUTION: usize = {ne};");
    println!("/// Terms in 2u − 1.\npub(super) const IN_SLIP: usize = {nu};");
    println!();
    println!("/// Coefficients by κ, e and u.");
    println!("#[rustfmt::skip]");
    println!("pub(super) const TABLE: [[[f64; IN_SLIP]; IN_RESTITUTION]; IN_KAPPA] = [");
    for block in series.chunks(ne * nu) {
        println!("    [");
        for row in block.chunks(nu) {
            let numbers: Vec<String> = row.iter().map(|c| format!("{c:.6}")).collect();
            println!("        [{}],", numbers.join(", "));
        }
        println!("    ],");
    }
    println!("];");
}
