/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tooth measures: spans over teeth, and diameters over pins. */
#include "tooth-measures.h"

#include "../numerics/involute.h"

#include <flankfilm/author.h>

#include <math.h>

/* A tooth, with its thickness as an angle at the base circle. */
typedef struct tooth {
    double teeth, base, pitch; /* number of teeth, base radius, base pitch */
    double half; /* half of the thickness angle at the base circle, s/(2 r) + inv a (DIN 3960) */
} tooth;

static tooth tooth_of(const gear_spur_spec *g, const gear_spur_pair *p, int i, double arc)
{
    return (tooth){.teeth = ff_of_both(&g->teeth, i),
                   .base = p->base_radius[i],
                   .pitch = p->base_pitch,
                   .half =
                       arc / (2 * p->reference_radius[i]) + numerics_involute(g->pressure_angle)};
}

/* Returns the span over k teeth, W = (k - 1) p_b + s_b, with the arc at the base circle s_b = 2 r_b
   (s/(2 r) + inv a) (DIN 3960). */
static double span_over(const tooth *t, double count)
{
    return (count - 1) * t->pitch + 2 * t->base * t->half;
}

/* Returns the radius at which a span touches the flanks. */
static double span_radius(const tooth *t, double span)
{
    return hypot(t->base, span / 2);
}

/* Returns the cosine of the angle between the line from the gear axis to a pin and the measuring
   direction: pi/(2 z) for an odd number of teeth (DIN 3960), else 0. */
static double off_diameter(const tooth *t)
{
    return fmod(t->teeth, 2) == 1 ? cos(M_PI / (2 * t->teeth)) : 1;
}

/* Returns the radius at which a pin with its axis at the radius `axis` touches the flanks; 0: it
   does not touch them. */
static double pin_radius(const tooth *t, double pin, double axis)
{
    double along = sqrt(fmax(0, (axis - t->base) * (axis + t->base))) - pin / 2;
    return axis > t->base && along > 0 ? hypot(t->base, along) : 0;
}

/* Returns the radius of the axis of a pin of diameter D, at the angle a_K with inv a_K = s/(2 r)
 * + inv a + D/(2 r_b) - pi/z (DIN 3960). 0: the axis is below the base circle. */
static double pin_axis(const tooth *t, double pin)
{
    double value = t->half + pin / (2 * t->base) - M_PI / t->teeth;
    return value > 0 ? t->base / cos(numerics_involute_inverse(value)) : 0;
}

double gear_measured_allowance(const gear_spur_spec *g, const gear_spur_pair *p, int i)
{
    const tooth full = tooth_of(g, p, i, p->thickness[i]);
    double half; /* half of the tooth's angle at the base circle */
    if (g->span.count > 0) {
        double others = (ff_of_both(&g->span_teeth, i) - 1) * full.pitch;
        half = (ff_of_both(&g->span, i) - others) / (2 * full.base);
    } else if (g->over_pins.count > 0) {
        double pin = ff_of_both(&g->pin_diameter, i);
        double axis = (ff_of_both(&g->over_pins, i) - pin) / 2 / off_diameter(&full);
        half = numerics_involute(acos(fmin(1, full.base / axis))) - pin / (2 * full.base) +
               M_PI / full.teeth;
    } else {
        return ff_of_both(&g->allowance, i);
    }
    return 2 * p->reference_radius[i] * (half - full.half);
}

ff_status gear_check_measure(const ff_host *host, const gear_spur_spec *g, const gear_spur_pair *p,
                             int i)
{
    const bool spans = g->span.count > 0;
    const tooth t = tooth_of(g, p, i, p->thickness[i]);
    double radius; /* where the tool touches the flank */
    if (spans) {
        radius = span_radius(&t, ff_of_both(&g->span, i));
    } else {
        double pin = ff_of_both(&g->pin_diameter, i);
        radius = pin_radius(&t, pin, (ff_of_both(&g->over_pins, i) - pin) / 2 / off_diameter(&t));
    }
    if (radius > t.base && radius < p->tip_radius[i])
        return FF_OK;
    return ff_failf(host, FF_INVALID, spans ? "span" : "over_pins",
                    "gear %d: %s touches the tooth at diameter %.4f mm, but its flank lies between "
                    "%.4f and %.4f mm; choose %s",
                    i + 1, spans ? "the span" : "the pin", 2e3 * radius, 2e3 * t.base,
                    2e3 * p->tip_radius[i],
                    spans ? "another number of teeth in span_teeth" : "another pin_diameter");
}

/* Returns the radius r + x m, near the middle of the flank. */
static double middle_of(const gear_spur_spec *g, const gear_spur_pair *p, int i)
{
    return fmax(p->reference_radius[i] + ff_of_both(&g->shift, i) * g->module,
                p->base_radius[i] * 1.001);
}

static double usual_count(const tooth *full, double middle)
{
    double span = 2 * sqrt((middle - full->base) * (middle + full->base));
    return fmax(2, round((span - 2 * full->base * full->half) / full->pitch + 1));
}

/* Returns the diameter D = 2 r_b (tan a_K - tan a_v) of the pin that touches a full tooth at the
   pressure angle a_v. With the equation for inv a_K above pin_axis, a_K = tan a_v - (s/(2 r) + inv
   a - pi/z). It is rounded up to a multiple of 0.25 mm, or of 0.05 mm for small modules. */
static double usual_pin(const tooth *full, double middle, double module)
{
    double touches = sqrt((middle - full->base) * (middle + full->base)) / full->base;
    double axis = touches - full->half + M_PI / full->teeth;
    double step = module < 1e-3 ? 0.05e-3 : 0.25e-3;
    if (!(axis > 0 && axis < M_PI_2))
        return 0;
    return step * ceil(2 * full->base * (tan(axis) - touches) / step - 1e-9);
}

void gear_measure_teeth(const gear_spur_spec *g, const gear_spur_pair *p, gear_measures *m)
{
    *m = (gear_measures){.span = {0}};
    for (int i = 0; i < 2; i++) {
        const tooth full = tooth_of(g, p, i, p->thickness[i]);
        const tooth t = tooth_of(g, p, i, p->thickness[i] + p->allowance[i]);
        const double middle = middle_of(g, p, i), tip = p->tip_radius[i];
        double count =
            g->span_teeth.count > 0 ? ff_of_both(&g->span_teeth, i) : usual_count(&full, middle);
        double pin = g->pin_diameter.count > 0 ? ff_of_both(&g->pin_diameter, i)
                                               : usual_pin(&full, middle, g->module);
        double span = span_over(&t, count), axis = pin > 0 ? pin_axis(&t, pin) : 0;
        if (span > 0 && span_radius(&t, span) < tip) {
            m->span_teeth[i] = count;
            m->span[i] = span;
        }
        if (axis > 0 && pin_radius(&t, pin, axis) > 0 && pin_radius(&t, pin, axis) < tip) {
            m->pin_diameter[i] = pin;
            m->over_pins[i] = 2 * axis * off_diameter(&t) + pin;
        }
    }
}
