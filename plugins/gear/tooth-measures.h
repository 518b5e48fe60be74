/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures of the tooth thickness: spans over teeth, and diameters over two pins. */
#ifndef GEAR_TOOTH_MEASURES_H
#define GEAR_TOOTH_MEASURES_H

#include "spur-geometry.h"

typedef struct gear_measures {
    double span_teeth[2], span[2];        /* 0: no span touches both flanks */
    double pin_diameter[2], over_pins[2]; /* 0: the pin does not touch the flanks */
} gear_measures;

/* Returns the arc of gear i at the reference circle minus that of a full tooth, from the given
 * allowance, span or measure over pins. */
double gear_measured_allowance(const gear_spur_spec *g, const gear_spur_pair *p, int i);

/* Refuses a span or pins that do not touch the flanks of the teeth. */
ff_status gear_check_measure(const ff_host *host, const gear_spur_spec *g, const gear_spur_pair *p,
                             int i);

/* Computes the measures of the actual teeth over the given number of teeth and pins. If these are
   not given, it uses those that touch a full tooth nearest to the middle of its flank. */
void gear_measure_teeth(const gear_spur_spec *g, const gear_spur_pair *p, gear_measures *m);

#endif
