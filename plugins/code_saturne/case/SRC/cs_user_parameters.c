/* Laminar air through the channel, 2 m/s at the inlet. */
#include "cs_defs.h"

#include "cs_domain.h"
#include "cs_parameters.h"
#include "cs_physical_constants.h"
#include "cs_prototypes.h"
#include "cs_time_step.h"
#include "cs_turbulence_model.h"

void cs_user_model(void)
{
    cs_get_glob_turb_model()->iturb = 0;
}

void cs_user_parameters(cs_domain_t *domain)
{
    cs_fluid_properties_t *air = cs_get_glob_fluid_properties();

    air->ro0 = 1.19;
    air->viscl0 = 1.83e-5;
    cs_get_glob_physical_constants()->gravity[1] = -9.81;
    cs_get_glob_time_step_options()->idtvar = 0;
    domain->time_step->dt_ref = 1e-3;
    domain->time_step->nt_max = 250;
}
