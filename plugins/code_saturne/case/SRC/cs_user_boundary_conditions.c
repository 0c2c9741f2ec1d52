/* Uniform inflow of 2 m/s, walls below and above, symmetry at the sides. */
#include "cs_defs.h"

#include "cs_boundary_zone.h"
#include "cs_field.h"
#include "cs_mesh.h"
#include "cs_parameters.h"
#include "cs_prototypes.h"

static void set_type(const char *name, int type, int bc_type[])
{
    const cs_zone_t *zone = cs_boundary_zone_by_name(name);

    for (cs_lnum_t i = 0; i < zone->n_elts; i++) {
        bc_type[zone->elt_ids[i]] = type;
    }
}

void cs_user_boundary_conditions(int nvar, int bc_type[], int icodcl[], cs_real_t rcodcl[])
{
    const cs_zone_t *inlet = cs_boundary_zone_by_name("inlet");
    const int variable = cs_field_get_key_int(cs_field_by_name("velocity"), cs_field_key_id("variable_id")) - 1;

    CS_UNUSED(nvar);
    CS_UNUSED(icodcl);
    set_type("inlet", CS_INLET, bc_type);
    set_type("outlet", CS_OUTLET, bc_type);
    set_type("floor", CS_SMOOTHWALL, bc_type);
    set_type("ceiling", CS_SMOOTHWALL, bc_type);
    set_type("sides", CS_SYMMETRY, bc_type);
    for (cs_lnum_t i = 0; i < inlet->n_elts; i++) {
        for (int k = 0; k < 3; k++) {
            rcodcl[(variable + k) * cs_glob_mesh->n_b_faces + inlet->elt_ids[i]] = k == 0 ? 2.0 : 0.0;
        }
    }
}
