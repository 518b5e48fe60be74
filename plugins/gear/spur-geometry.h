/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Transverse geometry of an external involute spur gear pair, SI. Index 0 is gear 1, the driving
 * one. Positions on the path of contact are radii of curvature of the flank of gear 1, measured
 * along the line of action from its base circle.
 */
#ifndef GEAR_SPUR_GEOMETRY_H
#define GEAR_SPUR_GEOMETRY_H

#include <flankfilm/plugin.h>

#include <stdbool.h>

/* The pair as the user states it; NaN or empty: not given. Lists hold one value or two. */
typedef struct gear_spur_spec {
    ff_reals teeth;
    double module;
    double pressure_angle;                /* of the reference rack */
    ff_reals shift;                       /* profile shift coefficients */
    double centre_distance;               /* not given: zero backlash with these shifts */
    ff_reals tip_diameter, root_diameter; /* not given: standard */
    /* The tool: depth of its tip below the middle of the basic rack and radius of that tip, in
       modules; what its protuberance takes off the flank, and what is ground off after it. */
    ff_reals dedendum, tool_tip_radius, protuberance, machining_allowance;
    /* How thick the teeth are: one of four, or none for teeth of full thickness. */
    double backlash;          /* of the mounted pair, which thins both gears' teeth alike */
    int32_t backlash_measure; /* 1: as an arc of the working pitch circle */
    ff_reals allowance;       /* arc at the reference circle, less than 0: thinner */
    ff_reals span;            /* over span_teeth teeth */
    ff_reals over_pins;       /* over two pins of pin_diameter */
    ff_reals span_teeth, pin_diameter;
} gear_spur_spec;

typedef struct gear_spur_pair {
    double reference_radius[2], base_radius[2], pitch_radius[2], tip_radius[2], root_radius[2];
    double thickness[2];     /* arc at the reference circle of teeth of full thickness */
    double allowance[2];     /* what the actual arc is more */
    double tip_thickness[2]; /* arc at the tip circle, allowance deducted */
    double centre_distance, working_angle;
    double backlash; /* along the line of action */
    double base_pitch;
    double line_length;           /* between the base circles, along the line of action */
    double sap, pitch_point, tip; /* on the path of contact */
    double lpstc, hpstc; /* lowest and highest point of contact with the fewest pairs: one, where
                            the contact ratio is below 2 */
    double contact_ratio;
    double pitch_error; /* thicknesses + backlash against the working pitch, relative */
    double form_margin; /* least distance from the end of the involute, cut by a rack with a bottom
                           clearance of 0.25 m, to contact; below 0: the fillet is met */
    double undercut[2]; /* radius of curvature up to which undercut takes the involute; 0: none */
    double form[2];     /* radius of curvature where the involute begins */
    double clearance;   /* least gap between a tip and the mating root */
    /* What the rounding of the stated dimensions has moved: the backlash along the line of action,
       of at most rounding_of_backlash, and the root radii inwards; 0: nothing. */
    double moved_backlash, rounding_of_backlash, moved_root[2];
} gear_spur_pair;

/* Computes the pair, or refuses it at the parameter that is at fault. */
ff_status gear_spur_pair_make(const ff_host *host, const gear_spur_spec *spec,
                              gear_spur_pair *pair);

/* One uniform run of stations. */
typedef struct gear_spur_run {
    double from, to;
    size_t intervals;
    bool joined; /* its first station is the last of the run before */
} gear_spur_run;

/* Three pairs at most come and three leave while one is in contact; the pitch point besides. */
enum { GEAR_SPUR_RUNS = 8 };

/* Splits the path where the number of pairs changes and at the pitch point into runs of about
   `wanted` intervals in all; gives the number of runs. */
size_t gear_spur_runs(const gear_spur_pair *pair, size_t wanted,
                      gear_spur_run runs[GEAR_SPUR_RUNS]);

#endif
