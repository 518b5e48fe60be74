/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film parameter lambda: film over the combined roughness of both flanks. */
#ifndef EHL_LAMBDA_H
#define EHL_LAMBDA_H

#include <flankfilm/plugin.h>

/* sqrt(Rq1^2 + Rq2^2), m: of the surface where there is one, else of the gears; 0: unknown. The
   arrays are gear.roughness, surface.rq_1 and surface.rq_2. FF_INVALID. */
ff_status ehl_combined_roughness(const ff_host *host, const ff_array *gear, const ff_array *rq_1,
                                 const ff_array *rq_2, double *rq);

/* FF_UNSUPPORTED when this output is wanted without a roughness. */
ff_status ehl_lambda_check(const ff_host *host, uint64_t wanted, uint32_t output, const char *name,
                           double rq);

/* Quality of a smooth film between flanks of known roughness. */
void ehl_lambda_report(const ff_host *host, double lowest);

#endif
