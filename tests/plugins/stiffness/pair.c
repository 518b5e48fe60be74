/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pair.h"

#include <math.h>
#include <stdlib.h>

static double involute(double angle)
{
    return tan(angle) - angle;
}

static double inverse_involute(double value)
{
    double low = 0, high = 1.2;
    for (int i = 0; i < 100; i++) {
        double middle = (low + high) / 2;
        *(involute(middle) < value ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void place_stations(spur_pair *p)
{
    double low = p->roll_tip - (p->contact_ratio < 2 ? 1 : 2) * p->pitch;
    double high = p->roll_sap + (p->contact_ratio < 2 ? 1 : 2) * p->pitch;
    size_t n = 0;
    for (int i = 0; i <= 40; i++)
        p->roll[n++] = p->roll_sap + (p->roll_tip - p->roll_sap) * i / 40;
    for (int twice = 0; twice < 2; twice++) {
        p->roll[n++] = low;
        p->roll[n++] = high;
    }
    qsort(p->roll, n, sizeof p->roll[0], by_value);
    for (size_t i = n; i-- > 0;) {
        if (!(p->roll[i] < low || p->roll[i] > low))
            p->lpstc = i;
        if (!(p->roll[i] < high || p->roll[i] > high))
            p->hpstc = i;
    }
}

static void place_contact(spur_pair *p)
{
    double length = (p->base[0] + p->base[1]) * tan(p->working_angle);
    double tip2 = sqrt(pow(p->tip[1] / p->base[1], 2) - 1);
    p->roll_sap = (length - p->base[1] * tip2) / p->base[0];
    p->roll_tip = sqrt(pow(p->tip[0] / p->base[0], 2) - 1);
    p->pitch = 2 * M_PI / p->teeth[0];
    p->contact_ratio = (p->roll_tip - p->roll_sap) / p->pitch;
    place_stations(p);
}

spur_pair spur_pair_make(double z1, double z2, double module, double addendum, double x1, double x2)
{
    const double angle = M_PI / 9, shift[2] = {x1, x2};
    spur_pair p = {.teeth = {z1, z2},
                   .module = module,
                   .width = 0.020,
                   .modulus = {206e9, 206e9},
                   .poisson = {0.3, 0.3},
                   .line_force = 3547.26};
    for (int g = 0; g < 2; g++) {
        p.reference[g] = module * p.teeth[g] / 2;
        p.base[g] = p.reference[g] * cos(angle);
        p.tip[g] = p.reference[g] + module * (addendum + shift[g]);
        p.root[g] = p.reference[g] - module * (addendum + 0.25 - shift[g]);
        p.bore[g] = p.root[g] / 2;
        p.thickness[g] = module * (M_PI / 2 + 2 * shift[g] * tan(angle));
    }
    p.working_angle = inverse_involute(involute(angle) + 2 * tan(angle) * (x1 + x2) / (z1 + z2));
    place_contact(&p);
    return p;
}

static void swap(double pair[2])
{
    double kept = pair[0];
    pair[0] = pair[1];
    pair[1] = kept;
}

spur_pair spur_pair_swap(const spur_pair *pair)
{
    spur_pair p = *pair;
    swap(p.teeth);
    swap(p.base);
    swap(p.reference);
    swap(p.tip);
    swap(p.root);
    swap(p.bore);
    swap(p.thickness);
    swap(p.modulus);
    swap(p.poisson);
    place_contact(&p);
    return p;
}

void feed_path(stage *s, const spur_pair *pair)
{
    stage_give_series(s, "gear.roll_angle", PAIR_STATIONS, pair->roll);
    stage_give(s, "gear.roll_sap", 0, NULL, &pair->roll_sap);
    stage_give(s, "gear.roll_tip", 0, NULL, &pair->roll_tip);
    stage_give_series(s, "gear.teeth", 2, pair->teeth);
    stage_give(s, "operating.line_force", 0, NULL, &pair->line_force);
}

void feed_teeth(stage *s, const spur_pair *pair)
{
    stage_give_series(s, "gear.base_radius", 2, pair->base);
    stage_give_series(s, "gear.reference_radius", 2, pair->reference);
    stage_give_series(s, "gear.root_radius", 2, pair->root);
    stage_give_series(s, "gear.bore_radius", 2, pair->bore);
    stage_give_series(s, "gear.tooth_thickness", 2, pair->thickness);
    stage_give(s, "gear.working_pressure_angle", 0, NULL, &pair->working_angle);
    stage_give(s, "gear.face_width", 0, NULL, &pair->width);
    stage_give_series(s, "gear.elastic_modulus", 2, pair->modulus);
    stage_give_series(s, "gear.poisson_ratio", 2, pair->poisson);
}
