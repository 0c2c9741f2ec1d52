/* carom: what happens when a small particle hits a wall.
 *
 * A law is made once from its text form and then answers impacts; see docs/c.md for how to compile and link.
 *
 *   carom_law *law = NULL;
 *   if (carom_law_from_file("walls.toml", "glass", NULL, &law) != CAROM_STATUS_OK) {
 *       fprintf(stderr, "%s\n", carom_last_error());
 *       exit(1);
 *   }
 *   carom_impact_in in = {0};
 *   carom_impact_out out = {0};
 *   in.size = sizeof in;
 *   out.size = sizeof out;
 *   in.diameter = 90e-6;
 *   in.velocity[0] = 2.0;
 *   in.velocity[1] = -0.5;
 *   in.normal[1] = 1.0;
 *   if (carom_impact(law, &in, &out) == CAROM_STATUS_OK && out.fate == CAROM_FATE_REBOUND) { ... out.velocity ... }
 *   carom_law_free(law);
 *
 * SI units; angles in radians, from the surface. A law never changes and may be used from many threads at once; an impact allocates
 * nothing. Calls answer with a carom_status; carom_last_error has the message.
 *
 * This file is made from the library's source; do not edit it. */

#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

// How a call ended.
enum carom_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // Done.
    CAROM_STATUS_OK = 0,
    // No impact: the sphere does not move towards the wall.
    CAROM_STATUS_NOT_APPROACHING = 1,
    // No impact: a diameter, density, velocity, spin or normal that is none (NaN, out of range).
    CAROM_STATUS_BAD_IMPACT = 2,
    // A pointer is null, a text is not UTF-8, a struct's size is not one this library knows.
    CAROM_STATUS_BAD_ARGUMENT = 3,
    // The law or the materials cannot be read; the message points at the line.
    CAROM_STATUS_BAD_LAW = 4,
    // A file cannot be read.
    CAROM_STATUS_FILE = 5,
    // A defect of the library, caught.
    CAROM_STATUS_PANIC = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum carom_status carom_status;
#else
typedef int32_t carom_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// Does the sphere stick or bounce?
enum carom_fate
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No impact: the sphere is as it was.
    CAROM_FATE_UNMET = -1,
    // It leaves the wall.
    CAROM_FATE_REBOUND = 0,
    // It stays: it takes the wall's velocity and stops spinning.
    CAROM_FATE_CAPTURE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum carom_fate carom_fate;
#else
typedef int32_t carom_fate;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How the contact ended.
enum carom_contact
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    // No tangential contact force: no slip, a law that gives the tangential restitution outright, or a capture.
    CAROM_CONTACT_NONE = 0,
    // Sliding to the end of contact.
    CAROM_CONTACT_SLIDING = 1,
    // Rolling (no slip) at the end of contact.
    CAROM_CONTACT_ROLLING = 2,
    // Partial slip of an elastic contact.
    CAROM_CONTACT_MICRO_SLIP = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum carom_contact carom_contact;
#else
typedef int32_t carom_contact;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A wall law, compiled. It never changes: any number of threads may use one at once.
typedef struct carom_law carom_law;

// A sphere meets a wall. Velocities in one frame, which may be any.
//
// Zero it, then set `size` to sizeof(carom_impact_in) and what is known: fields left at zero are a sphere without spin, of the law's
// own density, on a wall at rest. A caller may end the struct after `normal`, or after any later field, with `size` saying so.
typedef struct carom_impact_in {
    // sizeof(carom_impact_in), set by the caller.
    size_t size;
    // Sphere diameter, m.
    double diameter;
    // Sphere density, kg/m3; 0 or NaN for the law's own sphere.
    double density;
    // Velocity of the sphere's centre, m/s.
    double velocity[3];
    // Angular velocity, rad/s.
    double spin[3];
    // Normal of the wall, from the wall to the sphere; any length but zero.
    double normal[3];
    // Velocity of the wall at the contact point, m/s.
    double wall_velocity[3];
    // Uniform draws in [0, 1) for laws that scatter, new ones for each impact: the caller owns the randomness. Zeros are draws like
    // any other.
    double draws[4];
} carom_impact_in;

// Where the kinetic energy relative to the wall, translation plus spin, went: fractions, their sum is 1.
typedef struct carom_energy {
    // Work of adhesion.
    double adhesion;
    // Adhesion damping.
    double adhesion_damping;
    // Hertzian damping.
    double hertz_damping;
    // Plastic deformation.
    double plastic;
    // Normal loss of a table law, which names no mechanism.
    double other;
    // Tangential loss.
    double friction;
    // What was left when a captured sphere stopped.
    double captured;
    // What the rebound keeps.
    double kept;
} carom_energy;

// How the sphere leaves. Set `size` to sizeof(carom_impact_out) before the call; the rest is written by it.
//
// A caller may end the struct after `tangential_restitution`, or after any later field, with `size` saying so.
typedef struct carom_impact_out {
    // sizeof(carom_impact_out), set by the caller.
    size_t size;
    // Sticks or bounces: a carom_fate.
    int32_t fate;
    // How the contact ended: a carom_contact.
    int32_t contact;
    // Velocity of the sphere's centre after the impact, m/s, in the frame of the one before.
    double velocity[3];
    // Angular velocity after the impact, rad/s.
    double spin[3];
    // Restitution e, 0 for a capture; may exceed 1 on a wall that scatters.
    double restitution;
    // Impulse ratio, tangential over normal; NaN for a capture.
    double impulse_ratio;
    // Tangential restitution; NaN for a capture or at normal incidence.
    double tangential_restitution;
    // What to mind: bits, see carom_validity_name. 0 is nothing.
    uint64_t validity;
    // Where the energy went.
    struct carom_energy energy;
} carom_impact_out;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The message of the last call on this thread that failed: what, where and what would be right, in one or a few lines of UTF-8.
// Empty if none has. It is the library's, and stays until the next call on this thread that fails.
const char *carom_last_error(void);

// Makes a law from a text.
//
// `toml`: a text with [law.NAME] tables (a law file, or a whole case file), or the keys of one law without a header.
// `name`: the law wanted; NULL when the text holds one law.
// `materials`: NULL, or a text with [material.NAME] tables to add to the library's.
// `out`: receives the law, to be freed with carom_law_free; NULL on failure.
//
// # Safety
// Texts are NULL (where allowed) or end with a zero; `out` can be written to.
carom_status carom_law_from_text(const char *toml,
                                 const char *name,
                                 const char *materials,
                                 struct carom_law **out);

// Makes a law from a file, as carom's `--wall-law FILE:NAME`.
//
// `path`: a law file or a case file. `name`: the law wanted; NULL when the file holds one law.
// `materials_path`: NULL, or a file with [material.NAME] tables to add to the library's.
// `out`: receives the law, to be freed with carom_law_free; NULL on failure.
//
// # Safety
// Texts are NULL (where allowed) or end with a zero; `out` can be written to.
carom_status carom_law_from_file(const char *path,
                                 const char *name,
                                 const char *materials_path,
                                 struct carom_law **out);

// Frees a law; NULL is let pass.
//
// # Safety
// `law` comes from carom_law_from_text or carom_law_from_file, is used by no thread any more and was not freed before.
void carom_law_free(struct carom_law *law);

// Density of the law's own sphere, kg/m3, for impacts that give none (1000 in a law without materials); NaN for NULL.
//
// # Safety
// `law` is NULL or a law that was not freed.
double carom_law_density(const struct carom_law *law);

// Whether the law scatters, so that its impacts depend on `draws`: 1, or 0 for laws that do not look at them; -1 for NULL.
//
// # Safety
// `law` is NULL or a law that was not freed.
int32_t carom_law_scatters(const struct carom_law *law);

// One impact.
//
// Answers CAROM_STATUS_NOT_APPROACHING or CAROM_STATUS_BAD_IMPACT where there is none; `out` then says CAROM_FATE_UNMET and holds velocity and spin as they
// came. On CAROM_STATUS_BAD_ARGUMENT `out` is not touched.
//
// # Safety
// Pointers are NULL (an error) or to a law that was not freed and to structs of the size they say.
carom_status carom_impact(const struct carom_law *law,
                          const struct carom_impact_in *impact,
                          struct carom_impact_out *out);

// Many impacts, one after the other, each exactly as carom_impact gives it.
//
// `impacts` and `out` are arrays of `n` structs, all of one size each: the size the first one says. `failed`, if not NULL, receives the index
// of the first that is no impact, or `n`; all others are done nonetheless, and the status is that of the first. On
// CAROM_STATUS_BAD_ARGUMENT nothing is done.
//
// # Safety
// Pointers are NULL (an error, but for `failed` and arrays of none) or to a law that was not freed and to `n` structs each.
carom_status carom_impact_batch(const struct carom_law *law,
                                size_t n,
                                const struct carom_impact_in *impacts,
                                struct carom_impact_out *out,
                                size_t *failed);

// The speed at and below which a sphere sticks, m/s, when it comes in at `angle` (radians from the surface; pi/2 is head-on): what
// adhesion holds is decided by the normal component, so it is the capture velocity over sin(angle).
//
// `density`: kg/m3; 0 or NaN for the law's own sphere. `out`: 0 if nothing captures, infinity if the sphere never rebounds.
//
// # Safety
// `law` is NULL or a law that was not freed; `out` is NULL or can be written to.
carom_status carom_capture_velocity(const struct carom_law *law,
                                    double diameter,
                                    double density,
                                    double angle,
                                    double *out);

// Many impacts at once, several times as fast as one by one: in columns of `n` numbers, each in its own plane of incidence, spheres of the
// law's own density, the wall at rest. The same bits as carom_impact, on any machine.
// A wall that scatters takes every draw at 1/2 here.
//
// In: `normal` approach speed (m/s, positive), `tangential` speed (m/s), `spin` (rad/s, positive when it rolls forward along
// positive tangential speed), `diameter` (m). Out: normal speed away from the wall, tangential speed and spin after the impact,
// zeros for a capture; `restitution` and `impulse_ratio` may be NULL.
//
// A row that is no impact has NaN in all columns out; `failed`, if not NULL, receives the index of the first, or `n`, and the status is
// that row's. Columns out must not overlap each other or columns in.
//
// # Safety
// Pointers are NULL (an error where not allowed) or to a law that was not freed and to `n` numbers each.
carom_status carom_impact_columns(const struct carom_law *law,
                                  size_t n,
                                  const double *normal,
                                  const double *tangential,
                                  const double *spin,
                                  const double *diameter,
                                  double *normal_out,
                                  double *tangential_out,
                                  double *spin_out,
                                  double *restitution,
                                  double *impulse_ratio,
                                  size_t *failed);

// The word for a carom_fate, such as "rebound"; NULL for a number that is none.
const char *carom_fate_name(int32_t fate);

// The word for a carom_contact, such as "rolling"; NULL for a number that is none.
const char *carom_contact_name(int32_t contact);

// The code of one bit of `validity`, such as "large-contact"; NULL for a bit that means nothing (yet): try 1, 2, 4, ...
const char *carom_validity_name(uint64_t bit);

// What that code means, in a sentence; NULL for a bit that means nothing (yet).
const char *carom_validity_meaning(uint64_t bit);

// The library's version, such as "0.2.0".
const char *carom_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* CAROM_H */
