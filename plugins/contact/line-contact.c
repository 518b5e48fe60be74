/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "line-contact.h"

#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

const ff_port contact_line_inputs[1] = {
    {.name = "viscosity",
     .unit = "",
     .doc = "viscosity law, for the Moes numbers",
     .dims = "",
     .service = FF_VISCOSITY_ID,
     .flags = FF_OPTIONAL},
};

const char contact_line_reference[] =
    "Johnson 1985, Contact Mechanics (Hertz line contact); Moes 2000, Lubrication and Beyond";
const char contact_line_bibtex[] =
    "@book{johnson1985, author = {Johnson, K. L.}, title = {Contact Mechanics}, publisher = "
    "{Cambridge University Press}, year = {1985}}\n"
    "@book{moes2000, author = {Moes, H.}, title = {Lubrication and Beyond}, publisher = "
    "{University of Twente}, year = {2000}}";

void contact_value_set(contact_value *to, const ff_param *row, const ff_value *value)
{
    bool list = row->type == FF_REALS;
    to->value[0] = list ? value->reals[0] : value->real;
    to->value[1] = list ? value->reals[value->count - 1] : value->real;
    to->given = true;
}

ff_status contact_reduced_modulus(const ff_host *host, const contact_value moduli[CONTACT_MODULI],
                                  double *reduced)
{
    static const double steel[2] = {0.3, 0.3};
    const contact_value *ratio = &moduli[CONTACT_POISSON];
    const double *E = moduli[CONTACT_ELASTIC].value, *nu = ratio->given ? ratio->value : steel;
    bool elastic = moduli[CONTACT_ELASTIC].given;
    if (ratio->given && !elastic)
        return ff_failf(host, FF_INVALID, "poisson_ratio",
                        "poisson_ratio has no meaning without elastic_modulus; give both or "
                        "neither");
    *reduced = elastic ? 2 / ((1 - nu[0] * nu[0]) / E[0] + (1 - nu[1] * nu[1]) / E[1])
                       : moduli[CONTACT_REDUCED].value[0];
    return FF_OK;
}
