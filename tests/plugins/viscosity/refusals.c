/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contradictory parameters of viscosity laws must be reported with their name. */
#include "check.h"
#include "stage.h"

#include <stdio.h>
#include <string.h>

/* Opens a law, sets up to five parameters, and expects an error at `item`. */
static void refuse(const char *id, const char *const set[][2], const char *item)
{
    stage *s = stage_open(id);
    for (int i = 0; set[i][0]; i++)
        stage_set_text(s, set[i][0], set[i][1]);
    printf("%s: %s\n", id, item);
    check_true("  is refused", stage_ready(s) == FF_INVALID);
    check_true("  by name", !strcmp(stage_why_item(s), item));
    check_true("  with a reason", strlen(stage_why(s)) > 20);
    stage_close(s);
}

int main(void)
{
    refuse("viscosity/barus", (const char *const[][2]){{"eta0", "5 mPa s"}, {NULL, NULL}}, "alpha");
    refuse("viscosity/roelands", (const char *const[][2]){{"eta0", "5 mPa s"}, {NULL, NULL}},
           "alpha");
    refuse("viscosity/roelands",
           (const char *const[][2]){{"eta0", "1e-5 Pa s"}, {"z", "0.6"}, {NULL, NULL}}, "eta0");
    refuse("viscosity/roelands",
           (const char *const[][2]){{"eta0", "5 mPa s"}, {"alpha", "100 1/GPa"}, {NULL, NULL}},
           "alpha");
    refuse("viscosity/doolittle-tait",
           (const char *const[][2]){{"eta0", "5 mPa s"},
                                    {"B", "3.73"},
                                    {"V_occ", "0.6132"},
                                    {"K0", "1.05 GPa"},
                                    {"K0_prime", "10.076"},
                                    {"pressure_cap", "6.5 GPa"},
                                    {NULL, NULL}},
           "pressure_cap");
    return check_done();
}
