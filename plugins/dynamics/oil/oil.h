/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oil between separated flanks: its parameters, and its data from gear and lubricant. */
#ifndef DYNAMICS_OIL_H
#define DYNAMICS_OIL_H

#include "../excitation/inputs.h"
#include "film.h"

enum { DYNAMICS_SQUEEZE_NONE, DYNAMICS_SQUEEZE_SERIES };

typedef struct dynamics_oil {
    int32_t squeeze, rolling;
    double hand_over, supply; /* m; supply NaN: oil always fills the gap */
} dynamics_oil;

/* The parameter rows for a member `oil` of the instance. */
#define DYNAMICS_OIL_ROWS(type)                                                                    \
    FF_ONE_OF("none|series", "squeeze", type, oil.squeeze, 0, "none",                              \
              "model of the oil that is squeezed out when separated flanks meet again. none: no "  \
              "oil; series: a film on either flank, in series with the teeth"),                    \
        FF_SWITCH(                                                                                 \
            "squeeze_rolling", type, oil.rolling, "false",                                         \
            "for squeeze: series, whether the wedge of the rolling flanks carries load too"),      \
        FF_QUANTITY("handover_film", "um", type, oil.hand_over, FF_MIN_OPEN, "0.2 um", NULL, 0,    \
                    1000, 0.02, 5,                                                                 \
                    "for squeeze: series, film thickness of the loaded flanks, at which the "      \
                    "teeth take over the load"),                                                   \
        FF_QUANTITY("supply_film", "um", type, oil.supply, FF_MIN_OPEN, NULL, NULL, 0, 1e6, 0, 0,  \
                    "for squeeze: series, film thickness above which the oil does not fill the "   \
                    "gap; default: it always fills the gap")

/* Checks the parameters in `ready`: refuses contradictory parameters and reports parameters without
   effect. */
ff_status dynamics_oil_check(const ff_host *host, const dynamics_oil *oil, int32_t damping);

/* Makes the film for an excitation whose units are known. The excitation then owns the film. *film
   is NULL without squeeze. */
ff_status dynamics_oil_read(const ff_host *host, const ff_array *in, const dynamics_oil *oil,
                            const dynamics_inputs *inputs, dynamics_excitation *excitation,
                            dynamics_film **film);

#endif
