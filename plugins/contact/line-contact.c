/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elastic moduli of a line contact without gears. */
#include "line-contact.h"

#include "../numerics/isothermal.h"

#include <flankfilm/laws.h>

const ff_port contact_line_inputs[CONTACT_LINE_INPUTS] = {
    {.name = "viscosity",
     .unit = "",
     .doc = "viscosity law, for the Moes numbers",
     .dims = "",
     .service = FF_VISCOSITY_ID,
     .flags = FF_OPTIONAL},
    NUMERICS_OIL_ROWS,
};

const char contact_line_reference[] =
    "Johnson 1985, Contact Mechanics (Hertz line contact); Moes 2000, Lubrication and Beyond";

ff_status contact_reduced_modulus(const ff_host *host, const contact_moduli *moduli,
                                  double *reduced)
{
    const double steel = 0.3;
    const ff_reals *E = &moduli->elastic, *ratio = &moduli->poisson;
    if (ratio->count > 0 && E->count == 0)
        return ff_failf(host, FF_INVALID, "poisson_ratio",
                        "poisson_ratio has no meaning without elastic_modulus; give both or "
                        "neither");
    *reduced = moduli->reduced;
    if (E->count == 0)
        return FF_OK;
    double compliance = 0; /* sum of (1 - nu^2)/E */
    for (int i = 0; i < 2; i++) {
        double nu = ratio->count > 0 ? ff_of_both(ratio, i) : steel;
        compliance += (1 - nu * nu) / ff_of_both(E, i);
    }
    *reduced = 2 / compliance;
    return FF_OK;
}
