/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program of the build that writes the table of the heated channel (channel.h) as a header. The
   ehl models interpolate in this table. */
#include "channel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(void)
{
    const double coldest = 1e-6; /* used instead of F = 0, at which R = b/(12 sqrt(F)) is not
                                    defined; R - 1 is 4e-7 at this F */
    ehl_channel first = {.b = 0};
    puts("/* ln R over ln(1 + F), rows, and ln(1 + S), written by channel-table.c. */");
    printf("static const double ln_R[%d][%d] = {\n", EHL_HEAT_TABLE, EHL_HEAT_TABLE);
    for (int i = 0; i < EHL_HEAT_TABLE; i++) {
        double F = i > 0 ? expm1(i * EHL_HEAT_STEP) : coldest, R = ehl_channel_solve(&first, F, 0);
        ehl_channel c = first;
        printf("{%.12g", log(R));
        for (int j = 1; j < EHL_HEAT_TABLE && isfinite(R); j++) {
            R = ehl_channel_solve(&c, F, expm1(j * EHL_HEAT_STEP));
            printf(", %.12g", log(R));
        }
        puts("},");
        if (!isfinite(R)) {
            fputs("the heated channel was not solved\n", stderr);
            return EXIT_FAILURE;
        }
    }
    puts("};");
    return EXIT_SUCCESS;
}
