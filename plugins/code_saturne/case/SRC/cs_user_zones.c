/* The channel's boundary zones, by the groups of mesh.sh. */
#include "cs_defs.h"

#include "cs_boundary_zone.h"
#include "cs_prototypes.h"

void cs_user_zones(void)
{
    cs_boundary_zone_define("inlet", "1", 0);
    cs_boundary_zone_define("outlet", "2", 0);
    cs_boundary_zone_define("floor", "3", CS_BOUNDARY_ZONE_WALL);
    cs_boundary_zone_define("ceiling", "4", CS_BOUNDARY_ZONE_WALL);
    cs_boundary_zone_define("sides", "5", 0);
}
