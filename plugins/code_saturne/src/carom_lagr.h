/* carom in code_saturne: wall laws for boundary zones, through the user functions of the Lagrangian module. See README.md. */
#ifndef CAROM_LAGR_H
#define CAROM_LAGR_H

#include "cs_defs.h"

#include "cs_lagr_particle.h"

/* In cs_user_lagr_model, after the particle tracking is switched on: reads carom-walls.txt (or what the environment's CAROM_WALLS
 * names), compiles the laws, asks for the variables that keep the spin, makes the fields of deposit and impacts. */
void carom_lagr_setup(void);

/* With `spin`, in cs_user_lagr_in: new particles begin without spin. */
void carom_lagr_new_particles(cs_lagr_particle_set_t *particles, const cs_lnum_t particle_range[2]);

/* At the end of cs_user_lagr_boundary_conditions: hands the zones of the table over to carom. */
void carom_lagr_boundaries(void);

/* In cs_user_extra_operations_finalize: rebounds, captures and captured mass by zone, over all ranks, in the log. */
void carom_lagr_report(void);

#endif
