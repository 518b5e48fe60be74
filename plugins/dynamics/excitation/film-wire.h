/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Feedback of the films of the previous round to the motion. Friction and rolling resistance act as
 * torques on both gears. The thickness of the loaded film acts in series with the teeth.
 */
#ifndef DYNAMICS_FILM_WIRE_H
#define DYNAMICS_FILM_WIRE_H

#include "inputs.h"

/* Switches for the effects of the film. The instance has a member `wire` of this type. */
typedef struct dynamics_film_wire {
    int32_t friction, rolling, compliance;
} dynamics_film_wire;

#define DYNAMICS_FILM_WIRE_ROWS(type)                                                              \
    FF_SWITCH("friction", type, wire.friction, "true",                                             \
              "whether the friction of a film that is wired back acts as torques on the gears"),   \
        FF_SWITCH("rolling", type, wire.rolling, "true",                                           \
                  "whether the rolling resistance of a film that is wired back acts as torques "   \
                  "on the gears"),                                                                 \
        FF_SWITCH("compliance", type, wire.compliance, "true",                                     \
                  "whether the thickness of a film that is wired back acts in series with the "    \
                  "teeth")

/* Returns whether a film is wired back and available; it is available from the second round on. */
int dynamics_film_is_wired(const ff_array *in);

/* Mean powers, W. */
typedef struct dynamics_film_powers {
    double torques; /* power that the torques spend on friction and rolling */
    double loss;    /* power dissipated by the films of all pairs, as the film model
                       gives it; NaN: no film */
} dynamics_film_powers;

/* Adds drag and thickness of the film to the pieces of an excitation that
   dynamics_inputs_read has made, and reports the error of this representation. */
ff_status dynamics_film_wire_read(const ff_host *host, const ff_array *in,
                                  const dynamics_film_wire *wire, const dynamics_inputs *inputs,
                                  dynamics_excitation *excitation, dynamics_film_powers *powers);

#endif
