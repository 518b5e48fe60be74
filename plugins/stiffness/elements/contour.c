/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contour of a tooth space, computed from the rack that cuts the space. */
#include "contour.h"

#include "../../numerics/involute.h"

#include <math.h>
#include <stddef.h>

static double half_angle_at(const stiffness_contour *o, double roll)
{
    return o->half_angle - numerics_involute_at_roll(roll);
}

/* Computes the radius of a point of the fillet, and half the angle of the tooth there. The rounded
   tip of the rack cuts the point when the centre of its rounding is at the distance `travel` from
   the line of centres; the normal at the point passes through the pitch point (Litvin & Fuentes
   2004). At that moment the middle of the tooth space is at the distance travel - land from the
   line of centres, along the reference circle, on the same side. */
static void fillet(const stiffness_contour *o, double travel, double *radius, double *half_angle)
{
    double reach = hypot(travel, o->depth);
    double x = travel + o->round * travel / reach;
    double y = o->reference_radius - o->depth - o->round * o->depth / reach;
    *radius = hypot(x, y);
    *half_angle = o->half_sector - (atan2(x, y) - (travel - o->land) / o->reference_radius);
}

/* Returns the half angle of the tooth at a point of the fillet minus that of the involute at the
   same radius; positive where the fillet is outside the involute. */
static double excess(const stiffness_contour *o, double travel)
{
    double radius, angle;
    fillet(o, travel, &radius, &angle);
    double ratio = radius / o->base_radius;
    return angle - half_angle_at(o, ratio > 1 ? sqrt(ratio * ratio - 1) : 0);
}

/* Ends the fillet where it crosses the involute above the base circle, as in an undercut tooth.
   Returns 0 if it does not cross. */
static int cross_undercut(stiffness_contour *o, double last)
{
    enum { STEPS = 400 };
    double low = 0, high = 0, radius, angle;
    for (int i = 1; i <= STEPS; i++) {
        double travel = last * i / STEPS;
        fillet(o, travel, &radius, &angle);
        if (radius > o->base_radius && excess(o, travel) > 0) {
            high = travel;
            low = last * (i - 1) / STEPS;
            break;
        }
    }
    if (!(high > 0))
        return 0;
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        fillet(o, middle, &radius, &angle);
        *(radius > o->base_radius && excess(o, middle) > 0 ? &high : &low) = middle;
    }
    o->fillet_end = high;
    fillet(o, high, &radius, &angle);
    o->form_roll = sqrt(fmax(0, pow(radius / o->base_radius, 2) - 1));
    return 1;
}

/* Finds the rack with a rounded tip that cuts this root circle and this tooth thickness. Returns
   NULL, or a sentence that says what is wrong. */
static const char *make_rack(stiffness_contour *o, const stiffness_contour_data *d)
{
    double r = d->reference_radius, c = d->base_radius / r, s = sqrt(1 - c * c);
    double depth = r - d->root_radius;
    double space = 2 * M_PI * r / d->teeth - d->thickness; /* width of the rack's tooth */
    double tip = space / 2 - depth * s / c;
    if (!(depth > 0))
        return "the root circle lies above the reference circle";
    if (!(tip > 0))
        return "the flanks of the tooth space meet above the root circle";
    /* largest rounding for which the straight flank still reaches the lowest point of contact */
    double fits = (depth - s * (r * s - d->base_radius * d->contact_roll)) / (1 - s);
    if (!(fits > 0))
        return "contact reaches below the involute, which begins where the straight part of the "
               "rack ends for this root circle";
    o->round = fmin(fmin(d->round, fits), fmin(tip * c / (1 - s), depth / (1 - s)) * (1 - 1e-9));
    o->depth = depth - o->round;
    o->land = tip - o->round * (1 - s) / c;
    o->fillet_end = o->depth * c / s;
    /* the straight flank ends at depth - round (1 - s) below the rolling line */
    o->form_roll = (r * s - (depth - o->round * (1 - s)) / s) / d->base_radius;
    if (o->form_roll <= 0 && !cross_undercut(o, o->fillet_end))
        return "the root is undercut so far that no involute is left";
    return NULL;
}

const char *stiffness_contour_make(stiffness_contour *o, const stiffness_contour_data *d)
{
    double ratio = d->reference_radius / d->base_radius, roll = sqrt(ratio * ratio - 1);
    *o = (stiffness_contour){.base_radius = d->base_radius,
                             .reference_radius = d->reference_radius,
                             .root_radius = d->root_radius,
                             .tip_radius = d->base_radius * sqrt(1 + d->tip_roll * d->tip_roll),
                             .half_sector = M_PI / d->teeth,
                             .half_angle = d->thickness / (2 * d->reference_radius) +
                                           numerics_involute_at_roll(roll),
                             .tip_roll = d->tip_roll};
    const char *why = make_rack(o, d);
    if (why)
        return why;
    if (!(o->form_roll <= d->contact_roll + 1e-9))
        return "contact reaches below the end of the involute";
    if (!(half_angle_at(o, d->tip_roll) > 0))
        return "the tooth is pointed below its tip";
    return NULL;
}

static stiffness_point polar(double radius, double angle)
{
    return (stiffness_point){radius * cos(angle), radius * sin(angle)};
}

stiffness_point stiffness_contour_at(const stiffness_contour *o, double p)
{
    if (p <= 1)
        return polar(o->root_radius, o->half_sector - p * o->land / o->reference_radius);
    if (p <= 2) {
        double radius, angle;
        fillet(o, (p - 1) * o->fillet_end, &radius, &angle);
        return polar(radius, angle);
    }
    double roll = o->form_roll + (p - 2) * (o->tip_roll - o->form_roll);
    return polar(o->base_radius * sqrt(1 + roll * roll), half_angle_at(o, roll));
}

double stiffness_contour_middle(const stiffness_contour *o)
{
    double turn = atan2(o->fillet_end, o->depth);
    return 1 + o->depth * tan(turn / 2) / o->fillet_end;
}

stiffness_flank_force stiffness_contour_force(const stiffness_contour *o, double roll)
{
    /* the normal of the flank touches the base circle; psi is its angle to the normal of the
       tooth's axis */
    double psi = roll - o->half_angle, c = cos(psi), s = sin(psi);
    return (stiffness_flank_force){.radius = o->base_radius * sqrt(1 + roll * roll),
                                   .direction = {-s, -c},
                                   .axis_x = o->base_radius / c,
                                   .depth = o->base_radius * (roll * c - s) / c};
}
