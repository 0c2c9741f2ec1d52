/* The peer of the batch: oblique impacts of the EA law as a plain loop over the closed form, written for a compiler that vectorises it
   with the C library's vector pow. Flat wall, rolling friction; rows as carom's batch has them. One power an impact, as carom needs. */
#include <math.h>
#include <stddef.h>

void ea_rows(size_t n, const double *restrict vn, const double *restrict vt, const double *restrict spin,
             const double *restrict diameter, double *restrict vn_out, double *restrict vt_out, double *restrict spin_out,
             double scale, double adhesion_damping, double hertz_damping, double friction) {
    for (size_t i = 0; i < n; i++) {
        double v = vn[i], r = 0.5 * diameter[i], u = r * 1e5;
        double psi = scale * pow(v * v * v * v * v * v * (u * u * u * u * u), -2.0 / 15.0);
        double e2 = 1.0 - psi * (1.0 + adhesion_damping * v) - 0.907218423253029 * hertz_damping * v;
        double e = e2 > 0.0 ? sqrt(e2) : 0.0;
        double impulse = (1.0 + e) * v;
        double slip = vt[i] - r * spin[i];
        double stick = 2.0 / 7.0 * fabs(slip), slide = friction * impulse;
        double p = copysign(slide < stick ? slide : stick, slip);
        int rebounds = e2 > 0.0;
        vn_out[i] = e * v;
        vt_out[i] = rebounds ? vt[i] - p : 0.0;
        spin_out[i] = rebounds ? spin[i] + 2.5 * p / r : 0.0;
    }
}
