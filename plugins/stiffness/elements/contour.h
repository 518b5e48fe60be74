/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contour of half a tooth space as cut by a rack with rounded tips (Litvin & Fuentes 2004): bottom
   land, trochoid fillet, involute, with one parameter p. The axis x runs from the gear's centre
   through the middle of the tooth; the contour is the flank at y > 0. */
#ifndef STIFFNESS_CONTOUR_H
#define STIFFNESS_CONTOUR_H

typedef struct stiffness_point {
    double x, y;
} stiffness_point;

typedef struct stiffness_contour {
    double base_radius, reference_radius, root_radius, tip_radius; /* m */
    double half_sector;                                            /* pi over the number of teeth */
    double half_angle; /* half angle of the tooth at the base circle, between its involutes */
    double depth; /* depth of the centre of the tip's rounding below the rolling line of the rack */
    double round; /* radius of the rack's rounded tip */
    double land;  /* half of the flat part of the rack's tip */
    double fillet_end; /* travel of the rack at which the fillet ends */
    double form_roll;  /* roll angle where the involute begins */
    double tip_roll;
} stiffness_contour;

/* Data of the contour; thickness: arc at the reference circle. */
typedef struct stiffness_contour_data {
    double teeth, base_radius, reference_radius, root_radius, tip_roll, thickness;
    double contact_roll; /* lowest roll angle that must lie on the involute */
    double round;        /* desired radius of the rack's tip; reduced if it does not fit */
} stiffness_contour_data;

/* Returns NULL, or a sentence that explains why there is no such tooth. */
const char *stiffness_contour_make(stiffness_contour *o, const stiffness_contour_data *data);

/* Returns the point at p, which runs from 0 (middle of the space) over 1 (fillet) and 2 (involute)
   to 3 (tip). */
stiffness_point stiffness_contour_at(const stiffness_contour *o, double p);
/* Returns the parameter p at which the normal of the fillet has turned by half of its total
   angle. */
double stiffness_contour_middle(const stiffness_contour *o);

/* A unit normal force on the flank at a roll angle: its point of application, its direction into
   the tooth, the point where its line crosses the tooth's axis, and the depth of that point. */
typedef struct stiffness_flank_force {
    double radius;
    stiffness_point direction;
    double axis_x, depth;
} stiffness_flank_force;
stiffness_flank_force stiffness_contour_force(const stiffness_contour *o, double roll);

#endif
