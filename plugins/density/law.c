/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include "../numerics/liquid.h"

const ff_port density_inputs[1] = {{.name = "oil",
                                    .unit = "",
                                    .doc = "the oil over temperature, in place of rho0",
                                    .dims = "",
                                    .service = FF_LIQUID_ID,
                                    .flags = FF_OPTIONAL,
                                    .from = "lubricant"}};

ff_status density_wire(void *self, uint32_t input, const void *service)
{
    density_law *law = self;
    (void)input;
    law->liquid = service;
    law->rho0 = 1;
    return FF_OK;
}

ff_status density_end(const density_law *law, ff_status status, size_t n, const double *T,
                      double *rho, double *drho_dp, double *drho_dT)
{
    double rho0[NUMERICS_POINTS], slope[NUMERICS_POINTS];
    for (size_t i = 0; i < n && drho_dT; i++)
        drho_dT[i] = 0;
    for (size_t from = 0; from < n && law->liquid; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status worse = numerics_liquid_values(law->liquid, FF_LIQUID_RHO0, count,
                                                 T ? T + from : NULL, rho0, slope);
        for (size_t i = 0; i < count; i++) {
            if (drho_dT)
                drho_dT[from + i] = slope[i] * rho[from + i];
            if (drho_dp)
                drho_dp[from + i] *= rho0[i];
            rho[from + i] *= rho0[i];
        }
        status = worse != FF_OK ? worse : status;
    }
    return status;
}
