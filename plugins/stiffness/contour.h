/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Contour of half a tooth space as a rack with rounded tips cuts it (Litvin & Fuentes 2004): bottom
 * land, trochoid fillet, involute, in one parameter p. The axis x runs from the gear's centre
 * through the middle of the tooth; the flank meant lies at y > 0.
 */
#ifndef FF_STIFFNESS_CONTOUR_H
#define FF_STIFFNESS_CONTOUR_H

typedef struct ff_point {
    double x, y;
} ff_point;

typedef struct ff_contour {
    double base_radius, reference_radius, root_radius, tip_radius; /* m */
    double half_sector;                                            /* pi over the number of teeth */
    double half_angle; /* of the tooth at the base circle, by its involutes */
    double depth;      /* of the round's centre below the rolling line of the rack */
    double round;      /* radius of the rack's tip */
    double land;       /* half the flat of the rack's tip */
    double fillet_end; /* travel of the rack at the end of the fillet */
    double form_roll;  /* roll angle where the involute begins */
    double tip_roll;
} ff_contour;

/* What the contour is made from; thickness: arc at the reference circle. */
typedef struct ff_contour_data {
    double teeth, base_radius, reference_radius, root_radius, tip_roll, thickness;
    double contact_roll; /* lowest roll angle that must lie on the involute */
    double round;        /* wished radius of the rack's tip; made smaller where it does not fit */
} ff_contour_data;

/* Returns NULL, or a sentence that says why there is no such tooth. */
const char *ff_contour_make(ff_contour *o, const ff_contour_data *data);

/* p from 0 (middle of the space) over 1 (fillet) and 2 (involute) to 3 (tip). */
ff_point ff_contour_at(const ff_contour *o, double p);
/* p on the fillet where its normal has turned half way. */
double ff_contour_middle(const ff_contour *o);

/* Unit normal force on the flank at that roll angle: where, its direction into the tooth, where its
   line cuts the tooth's axis, and how deep that is. */
typedef struct ff_flank_force {
    double radius;
    ff_point direction;
    double axis_x, depth;
} ff_flank_force;
ff_flank_force ff_contour_force(const ff_contour *o, double roll);

#endif
