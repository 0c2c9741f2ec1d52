/* New particles begin without spin. */
#include "cs_defs.h"

#include "cs_lagr.h"
#include "cs_lagr_prototypes.h"

#include "carom_lagr.h"

void cs_user_lagr_in(cs_lagr_particle_set_t *particles, const cs_lagr_injection_set_t *zis, const cs_lnum_t particle_range[2],
                     const cs_lnum_t particle_face_id[], const cs_real_t visc_length[])
{
    CS_UNUSED(zis);
    CS_UNUSED(particle_face_id);
    CS_UNUSED(visc_length);
    carom_lagr_new_particles(particles, particle_range);
}
