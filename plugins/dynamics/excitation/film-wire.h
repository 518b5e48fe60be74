/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the films of the tooth pairs give back to the motion, frozen over the mesh cycle: friction
 * and rolling resistance as torques on both gears, and the thickness of the loaded film, which lies
 * in series with the teeth.
 */
#ifndef DYNAMICS_FILM_WIRE_H
#define DYNAMICS_FILM_WIRE_H

#include "inputs.h"

/* What of it acts, for a member `wire` of the instance. */
typedef struct dynamics_film_wire {
    int32_t friction, rolling, compliance;
} dynamics_film_wire;

#define DYNAMICS_FILM_WIRE_ROWS(type)                                                              \
    FF_SWITCH("friction", type, wire.friction, "true",                                             \
              "with a film wired back: whether its traction acts as torques on the gears"),        \
        FF_SWITCH("rolling", type, wire.rolling, "true",                                           \
                  "with a film wired back: whether its rolling resistance acts as torques"),       \
        FF_SWITCH("compliance", type, wire.compliance, "true",                                     \
                  "with a film wired back: whether its thickness acts in series with the teeth")

/* Whether a film is wired back and has been computed. */
int dynamics_film_is_wired(const ff_array *in);

/* Mean powers, W. */
typedef struct dynamics_film_powers {
    double torques; /* what the torques put into friction and rolling */
    double loss;    /* what the films of all pairs dissipate, as they say; NaN: there are none */
} dynamics_film_powers;

/* Adds what the film gives to the pieces of an excitation that dynamics_inputs_read has made, and
   says how well. */
ff_status dynamics_film_wire_read(const ff_host *host, const ff_array *in,
                                  const dynamics_film_wire *wire, const dynamics_inputs *inputs,
                                  dynamics_excitation *excitation, dynamics_film_powers *powers);

#endif
