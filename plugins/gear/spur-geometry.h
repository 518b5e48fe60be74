/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transverse geometry of an external involute spur gear pair, in SI. Index 0 is gear 1, the
 * driving one. A position on the path of contact is the radius of curvature of the flank of gear
 * 1, measured along the line of action from its base circle. */
#ifndef GEAR_SPUR_GEOMETRY_H
#define GEAR_SPUR_GEOMETRY_H

#include <flankfilm/plugin.h>

#include <stdbool.h>

/* The pair as given by the user; NaN or empty: not given. A list has one value or two. */
typedef struct gear_spur_spec {
    ff_reals teeth;
    double module;
    double pressure_angle;                /* of the basic rack */
    ff_reals shift;                       /* profile shift coefficients */
    double centre_distance;               /* not given: the distance without backlash */
    ff_reals tip_diameter, root_diameter; /* not given: from the basic rack */
    /* The tool: depth of its tip below the middle of the basic rack and radius of that tip, in
       modules; metal that its protuberance removes from the flank, and stock ground off later, in
       m. */
    ff_reals dedendum, tool_tip_radius, protuberance, machining_allowance;
    /* Tooth thickness: one of the next four, or none for teeth of full thickness. */
    double backlash;          /* of the mounted pair, half of it on the teeth of each gear */
    int32_t backlash_measure; /* 1: measured as an arc of the working pitch circle */
    ff_reals allowance;       /* change of the arc at the reference circle; negative: thinner */
    ff_reals span;            /* over span_teeth teeth */
    ff_reals over_pins;       /* over two pins of pin_diameter */
    ff_reals span_teeth, pin_diameter;
} gear_spur_spec;

typedef struct gear_spur_pair {
    double reference_radius[2], base_radius[2], pitch_radius[2], tip_radius[2], root_radius[2];
    double thickness[2];     /* arc at the reference circle for teeth of full thickness */
    double allowance[2];     /* actual arc minus the arc of full thickness */
    double tip_thickness[2]; /* actual arc at the tip circle */
    double centre_distance, working_angle;
    double backlash; /* along the line of action */
    double base_pitch;
    double line_length;           /* length of the common tangent of the base circles */
    double sap, pitch_point, tip; /* positions on the path of contact */
    double lpstc, hpstc; /* ends of the zone with the fewest pairs in contact, which is one pair
                            if the contact ratio is below 2 */
    double contact_ratio;
    double pitch_error; /* thicknesses + backlash - working pitch, relative to the pitch */
    double form_margin; /* least distance between contact and the lower end of the involute, which a
                           rack with a bottom clearance of 0.25 m cuts; negative: contact reaches
                           the fillet */
    double undercut[2]; /* radius of curvature below which undercut removes the involute; 0: none */
    double form[2];     /* radius of curvature where the involute begins */
    double clearance;   /* least gap between a tip and the mating root */
    /* Moves of dimensions due to the drawing's rounding: the backlash along the line of action, by
       at most rounding_of_backlash, and the root radii inwards; 0: not moved. */
    double moved_backlash, rounding_of_backlash, moved_root[2];
} gear_spur_pair;

/* Computes the pair, or refuses it and names the parameter at fault. */
ff_status gear_spur_pair_make(const ff_host *host, const gear_spur_spec *spec,
                              gear_spur_pair *pair);

/* A run of equally spaced stations. */
typedef struct gear_spur_run {
    double from, to;
    size_t intervals;
    bool joined; /* its first station is also the last one of the previous run */
} gear_spur_run;

/* While a pair is in contact, at most three pairs enter and three leave; the pitch point is one
 * more limit. */
enum { GEAR_SPUR_RUNS = 8 };

/* Splits the path at changes in the number of pairs and at the pitch point into runs with about
 * `wanted` intervals in total; returns the number of runs. */
size_t gear_spur_runs(const gear_spur_pair *pair, size_t wanted,
                      gear_spur_run runs[GEAR_SPUR_RUNS]);

#endif
