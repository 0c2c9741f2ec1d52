/* Copper spheres come in with the air; the walls are carom's. */
#include "cs_defs.h"

#include "cs_boundary_zone.h"
#include "cs_lagr.h"
#include "cs_lagr_prototypes.h"

#include "carom_lagr.h"

void cs_user_lagr_boundary_conditions(const int bc_type[])
{
    cs_lagr_zone_data_t *conditions = cs_lagr_get_boundary_conditions();
    const int inlet = cs_boundary_zone_by_name("inlet")->id;
    cs_lagr_injection_set_t *copper = cs_lagr_get_injection_set(conditions, inlet, 0);

    CS_UNUSED(bc_type);
    for (int i = 0; i < cs_boundary_zone_n_zones(); i++) {
        conditions->zone_type[i] = CS_LAGR_SYM;
    }
    conditions->zone_type[inlet] = CS_LAGR_INLET;
    conditions->zone_type[cs_boundary_zone_by_name("outlet")->id] = CS_LAGR_OUTLET;
    carom_lagr_boundaries();

    copper->n_inject = 10;
    copper->injection_frequency = 1;
    copper->velocity_profile = 1;
    copper->velocity[0] = 2.0;
    copper->velocity[1] = copper->velocity[2] = 0.0;
    copper->stat_weight = 1.0;
    copper->diameter = 50e-6;
    copper->diameter_variance = 10e-6;
    copper->density = 8960.0;
}
