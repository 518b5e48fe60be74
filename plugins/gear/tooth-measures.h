/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one measures on a tooth to know how thick it is: spans over teeth, and over two pins. */
#ifndef GEAR_TOOTH_MEASURES_H
#define GEAR_TOOTH_MEASURES_H

#include "spur-geometry.h"

typedef struct gear_measures {
    double span_teeth[2], span[2];        /* 0: no span touches both flanks */
    double pin_diameter[2], over_pins[2]; /* 0: the pin touches beside the flanks */
} gear_measures;

/* By how much the arc of gear i at the reference circle is more than that of a full tooth, from the
   allowance, span or measure over pins that is given. */
double gear_measured_allowance(const gear_spur_spec *g, const gear_spur_pair *p, int i);

/* Refuses a span or pins that touch the teeth beside their flanks. */
ff_status gear_check_measure(const ff_host *host, const gear_spur_spec *g, const gear_spur_pair *p,
                             int i);

/* The measures of the teeth as they are, over the teeth and pins that are given, or else those that
   touch a full tooth nearest to the middle of its flank. */
void gear_measure_teeth(const gear_spur_spec *g, const gear_spur_pair *p, gear_measures *m);

#endif
