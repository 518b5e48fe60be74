/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bordered.h"

#include <math.h>

/* Largest number of Newton corrections; if more are needed, Newton's method has failed. */
enum { CORRECTIONS = 7 };

double dynamics_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

dynamics_frame dynamics_frame_at(const dynamics_excitation *excitation, const dynamics_point *p)
{
    return (dynamics_frame){.origin = {p->x[0], p->x[1], p->lambda},
                            .unit = dynamics_state_unit(excitation, p->x)};
}

void dynamics_scaled_tangent(const dynamics_frame *f, const dynamics_point *p, double tangent[3])
{
    tangent[0] = p->tangent[0] / f->unit;
    tangent[1] = p->tangent[1] / f->unit;
    tangent[2] = p->tangent[2];
}

void dynamics_point_of_cubic(const dynamics_frame *f, const double border[3],
                             const dynamics_point *other, double s, double z[3])
{
    static const double straight = 0.5; /* least cosine of the angle between the tangents */
    double place[3] = {(other->x[0] - f->origin[0]) / f->unit,
                       (other->x[1] - f->origin[1]) / f->unit, other->lambda - f->origin[2]};
    double tangent[3], length = dynamics_dot(place, border), x = s / length;
    dynamics_scaled_tangent(f, other, tangent);
    double cosine = dynamics_dot(tangent, border);
    int turned = !(cosine > straight * sqrt(dynamics_dot(tangent, tangent)));
    for (int k = 0; k < 3; k++) {
        double off = place[k] - length * border[k];
        double slope = turned ? 2 * off : length * (tangent[k] / cosine - border[k]);
        z[k] = s * border[k] + x * x * (3 * off - slope + x * (slope - 2 * off));
    }
}

static void return_rows(const dynamics_orbit *o, double unit, double rows[2][3])
{
    for (int i = 0; i < 2; i++) {
        rows[i][0] = o->m[2 * i] - (i == 0);
        rows[i][1] = o->m[2 * i + 1] - (i == 1);
        rows[i][2] = o->slope[i] / unit;
    }
}

static void set_orbit(const dynamics_frame *f, const double z[3], dynamics_orbit *o)
{
    o->x[0] = f->origin[0] + f->unit * z[0];
    o->x[1] = f->origin[1] + f->unit * z[1];
    o->lambda = f->origin[2] + z[2];
}

/* Returns the index of the longer row if both rows are parallel to within the accuracy of a point,
   else -1. Parallel rows occur if a whole line of motions exists at one speed: undamped flanks in
   contact, with a constant stiffness, may vibrate at any phase. */
static int only_row(double rows[2][3])
{
    static const double parallel = 1e-6;
    double c[3], first = dynamics_dot(rows[0], rows[0]), second = dynamics_dot(rows[1], rows[1]);
    cross(rows[0], rows[1], c);
    return sqrt(dynamics_dot(c, c)) > parallel * (first + second) ? -1 : first < second;
}

/* Computes the part of the direction `along` that is perpendicular to `row`. */
static void part_across(const double row[3], const double along[3], double part[3])
{
    double share = dynamics_dot(along, row) / dynamics_dot(row, row);
    for (int i = 0; i < 3; i++)
        part[i] = along[i] - share * row[i];
}

/* Solves rows . u = r with `border` as the third row, by Cramer's rule. If both rows are parallel,
   u is the shortest solution of one row. Returns 0 if the system is singular. */
static int solve_bordered(double rows[2][3], const double border[3], const double r[3], double u[3])
{
    double a[3], b[3], c[3];
    int only = only_row(rows);
    if (only >= 0) {
        part_across(border, rows[only], a);
        for (int i = 0; i < 3; i++)
            u[i] = r[only] * a[i] / dynamics_dot(a, a);
        return isfinite(u[0]) && isfinite(u[1]) && isfinite(u[2]);
    }
    cross(rows[1], border, a);
    cross(border, rows[0], b);
    cross(rows[0], rows[1], c);
    double det = dynamics_dot(rows[0], a);
    for (int i = 0; i < 3; i++)
        u[i] = (r[0] * a[i] + r[1] * b[i] + r[2] * c[i]) / det;
    return det != 0 && isfinite(u[0]) && isfinite(u[1]) && isfinite(u[2]);
}

int dynamics_bordered_newton(const dynamics_flow *flow, const dynamics_frame *f,
                             const double border[3], double tolerance, double z[3],
                             dynamics_orbit *o)
{
    static const double far = 2; /* a solution farther away than this, in the unit of the frame, is
                                    another motion */
    static const double promising =
        1e-4; /* below this residual one more correction is usually enough */
    double last = INFINITY;
    for (int i = 0; i < CORRECTIONS; i++) {
        set_orbit(f, z, o);
        o->moments = f->moments && last < promising;
        if (!dynamics_orbit_map(flow, o))
            return 0;
        double residual = hypot(o->end[0] - o->x[0], o->end[1] - o->x[1]) / f->unit;
        if (residual <= tolerance)
            return 1;
        if (!(residual < 2 * last))
            return 0;
        last = residual;
        double rows[2][3], u[3];
        double r[3] = {(o->x[0] - o->end[0]) / f->unit, (o->x[1] - o->end[1]) / f->unit, 0};
        return_rows(o, f->unit, rows);
        if (!solve_bordered(rows, border, r, u))
            return 0;
        for (int k = 0; k < 3; k++)
            z[k] += u[k];
        if (dynamics_dot(z, z) > far * far)
            return 0;
    }
    return 0;
}

int dynamics_curve_tangent(const dynamics_orbit *o, double unit, const double along[3],
                           double tangent[3])
{
    double rows[2][3], t[3];
    return_rows(o, unit, rows);
    double scaled[3] = {along[0] / unit, along[1] / unit, along[2]};
    int only = only_row(rows);
    if (only >= 0)
        part_across(rows[only], scaled, t);
    else
        cross(rows[0], rows[1], t);
    double size = sqrt(dynamics_dot(t, t)) * (dynamics_dot(t, scaled) < 0 ? -1 : 1);
    if (size == 0 || !isfinite(size))
        return 0;
    tangent[0] = t[0] / size * unit;
    tangent[1] = t[1] / size * unit;
    tangent[2] = t[2] / size;
    return 1;
}
