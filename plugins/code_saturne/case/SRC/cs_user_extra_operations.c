/* The account of impacts, when all is done. */
#include "cs_defs.h"

#include "cs_prototypes.h"

#include "carom_lagr.h"

void cs_user_extra_operations_finalize(cs_domain_t *domain)
{
    CS_UNUSED(domain);
    carom_lagr_report();
}
