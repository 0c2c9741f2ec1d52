/* Particles that the air carries and that do not act on it. */
#include "cs_defs.h"

#include "cs_lagr.h"
#include "cs_lagr_prototypes.h"

#include "carom_lagr.h"

void cs_user_lagr_model(void)
{
    cs_glob_lagr_time_scheme->iilagr = CS_LAGR_ONEWAY_COUPLING;
    cs_glob_lagr_time_scheme->t_order = 1;
    cs_glob_lagr_time_scheme->idistu = 0;
    carom_lagr_setup();
}
