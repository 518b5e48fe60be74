/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transverse geometry of the pair: working pressure angle, backlash, diameters, undercut, path of
 * contact. */
#include "spur-geometry.h"

#include "drawing-rounding.h"
#include "tooth-measures.h"

#include "../numerics/involute.h"

#include <flankfilm/author.h>

#include <math.h>

/* Basic rack of ISO 53 (profile A), in modules: addendum and bottom clearance. */
static const double addendum = 1.0, clearance = 0.25;

/* In modules; a smaller undercut is ignored. Gears of 17 teeth at 20 degrees, usually cut without
   profile shift, have 0.006. */
static const double harmless_undercut = 0.01;

/* Points on the path of contact closer than this, in base pitches, are treated as equal. */
static const double same_place = 1e-9;

/* Contact ratios of this value or above are refused. */
enum { MOST_PAIRS = 4 };

/* Involute function of the working pressure angle at which teeth with these shifts mesh without
 * backlash (DIN 3960), inv a_w = inv a + 2 (x1 + x2) tan a/(z1 + z2). If it is not positive,
 * there is no such angle. */
static double tight_involute(const gear_spur_spec *g)
{
    return numerics_involute(g->pressure_angle) +
           2 * (ff_of_both(&g->shift, 0) + ff_of_both(&g->shift, 1)) * tan(g->pressure_angle) /
               (ff_of_both(&g->teeth, 0) + ff_of_both(&g->teeth, 1));
}

static ff_status mount(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    double base_sum = p->base_radius[0] + p->base_radius[1];
    double tight = tight_involute(g);
    if (g->centre_distance > 0) {
        if (!(g->centre_distance > base_sum))
            return ff_failf(host, FF_INVALID, "centre_distance",
                            "centre_distance %g mm must exceed %g mm, the sum of the base radii",
                            1e3 * g->centre_distance, 1e3 * base_sum);
        p->centre_distance = g->centre_distance;
        p->working_angle = acos(base_sum / g->centre_distance);
    } else {
        if (!(tight > 0))
            return ff_failf(host, FF_INVALID, "profile_shift",
                            "the sum of the profile shifts %g and %g is too small for these teeth "
                            "to mesh; it must exceed %.3f, or give centre_distance",
                            ff_of_both(&g->shift, 0), ff_of_both(&g->shift, 1),
                            -numerics_involute(g->pressure_angle) *
                                (ff_of_both(&g->teeth, 0) + ff_of_both(&g->teeth, 1)) /
                                (2 * tan(g->pressure_angle)));
        p->working_angle = ff_of_both(&g->shift, 0) + ff_of_both(&g->shift, 1) == 0
                               ? g->pressure_angle
                               : numerics_involute_inverse(tight);
        p->centre_distance = base_sum / cos(p->working_angle);
    }
    p->line_length = p->centre_distance * sin(p->working_angle);
    for (int i = 0; i < 2; i++)
        p->pitch_radius[i] = p->base_radius[i] / cos(p->working_angle);
    return FF_OK;
}

/* Backlash along the line of action for teeth of full thickness at a given centre distance, j =
 * m cos(a) (z1 + z2) (inv a_w - inv a_tight). */
static double full_backlash(const gear_spur_spec *g, const gear_spur_pair *p)
{
    if (!(g->centre_distance > 0))
        return 0;
    return g->module * cos(g->pressure_angle) *
           (ff_of_both(&g->teeth, 0) + ff_of_both(&g->teeth, 1)) *
           (numerics_involute(p->working_angle) - tight_involute(g));
}

/* Returns the factor that converts a given backlash to one along the line of action. */
static double backlash_unit(const gear_spur_spec *g, const gear_spur_pair *p)
{
    return g->backlash_measure == 1 ? cos(p->working_angle) : 1;
}

/* Refuses teeth that jam by more than the drawing's rounding. */
static ff_status refuse_jam(const ff_host *host, const gear_spur_spec *g, const gear_spur_pair *p,
                            double full, double backlash)
{
    if (!isnan(g->backlash))
        return ff_failf(host, FF_INVALID, "backlash",
                        "backlash %g mm is less than %.4f mm, the backlash of full teeth with "
                        "these profile shifts at centre_distance %g mm; give the backlash of the "
                        "mounted pair, or leave it out",
                        1e3 * g->backlash, 1e3 * full / backlash_unit(g, p),
                        1e3 * p->centre_distance);
    if (g->allowance.count > 0 || g->span.count > 0 || g->over_pins.count > 0)
        return ff_failf(host, FF_INVALID,
                        g->span.count > 0        ? "span"
                        : g->over_pins.count > 0 ? "over_pins"
                                                 : "thickness_allowance",
                        "teeth with thickness allowances %.4g and %.4g mm jam by %.4g mm at "
                        "centre_distance %g mm; they "
                        "must sum to %.4g mm or less",
                        1e3 * p->allowance[0], 1e3 * p->allowance[1], -1e3 * backlash,
                        1e3 * p->centre_distance, 1e3 * full / cos(g->pressure_angle));
    return ff_failf(host, FF_INVALID, "centre_distance",
                    "at centre_distance %g mm teeth with these profile shifts jam; it must be at "
                    "least %.4f mm, or give thickness_allowance, span, over_pins or backlash",
                    1e3 * p->centre_distance,
                    1e3 * (p->base_radius[0] + p->base_radius[1]) /
                        cos(numerics_involute_inverse(tight_involute(g))));
}

/* Sets allowances and backlash. Allowances A1 and A2 of the arcs add -(A1 + A2) cos(a) to the
 * backlash of teeth of full thickness. Teeth that overlap by less than the drawing's rounding
 * get the allowances at which they just fit. */
static ff_status set_backlash(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    const bool stated = !isnan(g->backlash);
    const double full = full_backlash(g, p), cosine = cos(g->pressure_angle);
    for (int i = 0; i < 2; i++)
        p->thickness[i] =
            g->module * (M_PI_2 + 2 * ff_of_both(&g->shift, i) * tan(g->pressure_angle));
    if (stated)
        p->backlash = g->backlash * backlash_unit(g, p);
    for (int i = 0; i < 2 && stated; i++)
        p->allowance[i] = -(p->backlash - full) / (2 * cosine);
    for (int i = 0; i < 2 && !stated; i++)
        if (g->allowance.count > 0 || g->span.count > 0 || g->over_pins.count > 0)
            p->allowance[i] = gear_measured_allowance(g, p, i);
    /* excess of the backlash over its minimum; the minimum is the backlash of full teeth if the
       backlash is given, otherwise 0 */
    const double spare =
        stated ? p->backlash - full : full - (p->allowance[0] + p->allowance[1]) * cosine;
    p->rounding_of_backlash = gear_rounding_of_backlash(g, p);
    if (spare < -p->rounding_of_backlash)
        return refuse_jam(host, g, p, full, spare);
    p->moved_backlash = fmax(-spare, 0);
    for (int i = 0; i < 2; i++)
        p->allowance[i] -= p->moved_backlash / (2 * cosine);
    p->backlash = stated ? p->backlash + p->moved_backlash : fmax(spare, 0);
    return FF_OK;
}

/* Checks the gap between tips and roots. If a tip overlaps the mating root by less than the
 * drawing's rounding, the root is moved inwards. */
static ff_status set_clearance(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    p->clearance = HUGE_VAL;
    for (int tip = 0; tip < 2; tip++) {
        const int root = 1 - tip;
        double gap = p->centre_distance - p->tip_radius[tip] - p->root_radius[root];
        if (gap < -gear_rounding_of_clearance(g))
            return ff_failf(host, FF_INVALID,
                            ff_of_both(&g->root_diameter, root) > 0 ? "root_diameter"
                                                                    : "tip_diameter",
                            "the tip of gear %d (diameter %g mm) touches the root of gear %d (%g "
                            "mm) at centre distance %g mm; the sum of tip and root radius must be "
                            "less than this distance",
                            tip + 1, 2e3 * p->tip_radius[tip], root + 1, 2e3 * p->root_radius[root],
                            1e3 * p->centre_distance);
        p->moved_root[root] = fmax(-gap, 0);
        p->root_radius[root] -= p->moved_root[root];
        p->clearance = fmin(p->clearance, fmax(gap, 0));
    }
    return FF_OK;
}

static ff_status set_depths(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    /* Tip shortening k m = a - a_0 - (x1 + x2) m, which keeps the clearance of the basic rack
     * when the shifts do not cancel (DIN 3960); tips are never lengthened. */
    double shortening =
        fmin(0, p->centre_distance - p->reference_radius[0] - p->reference_radius[1] -
                    (ff_of_both(&g->shift, 0) + ff_of_both(&g->shift, 1)) * g->module);
    for (int i = 0; i < 2; i++) {
        double middle = p->reference_radius[i] + ff_of_both(&g->shift, i) * g->module;
        p->root_radius[i] = ff_of_both(&g->root_diameter, i) > 0
                                ? ff_of_both(&g->root_diameter, i) / 2
                                : middle - ff_of_both(&g->dedendum, i) * g->module;
        p->tip_radius[i] = ff_of_both(&g->tip_diameter, i) > 0
                               ? ff_of_both(&g->tip_diameter, i) / 2
                               : middle + addendum * g->module + shortening;
        if (!(p->root_radius[i] > 0))
            return ff_failf(host, FF_INVALID, "root_diameter",
                            "gear %d has root diameter %g mm; it must be above 0", i + 1,
                            2e3 * p->root_radius[i]);
        double least = fmax(p->root_radius[i], p->base_radius[i]);
        if (!(p->tip_radius[i] > least))
            return ff_failf(host, FF_INVALID, "tip_diameter",
                            "gear %d has tip diameter %g mm; it must exceed %g mm, its %s "
                            "diameter",
                            i + 1, 2e3 * p->tip_radius[i], 2e3 * least,
                            p->root_radius[i] > p->base_radius[i] ? "root" : "base");
    }
    return set_clearance(host, g, p);
}

/* The tip of the tool that cuts gear i: radius of its rounding, depth of the rounding's centre
 * below the middle of the rack minus the profile shift, and distance of the centre from the
 * straight flank, inwards along the rack. Without a radius, the tip is the corner given by the
 * bottom clearance of the basic rack. */
typedef struct tool_tip {
    double round, centre, behind;
} tool_tip;

/* Returns the metal, normal to the flank, that the protuberance removes beyond the stock that is
   ground off later. */
static double residual_undercut(const gear_spur_spec *g, int i)
{
    double taken = g->protuberance.count > 0 ? ff_of_both(&g->protuberance, i) : 0;
    double ground = g->machining_allowance.count > 0 ? ff_of_both(&g->machining_allowance, i) : 0;
    return fmax(taken - ground, 0);
}

/* Returns the depth of the straight flank of the rack below the middle of the rack, in modules. */
static double straight_depth(const gear_spur_spec *g, int i)
{
    double round = g->tool_tip_radius.count > 0
                       ? ff_of_both(&g->tool_tip_radius, i) * (1 - sin(g->pressure_angle))
                       : clearance;
    return ff_of_both(&g->dedendum, i) - round;
}

static tool_tip tip_of(const gear_spur_spec *g, int i)
{
    const double a = g->pressure_angle;
    double round = g->tool_tip_radius.count > 0 ? ff_of_both(&g->tool_tip_radius, i) : 0;
    double depth = straight_depth(g, i) - round * sin(a) - ff_of_both(&g->shift, i);
    double behind = (round * g->module - residual_undercut(g, i)) / cos(a);
    return (tool_tip){round * g->module, depth * g->module, behind};
}

/* Returns how far inside the involute the tip of the tool cuts gear i if the centre of the tip's
   rounding lies `beside` the line of centres. The result is an angle, positive inside the tooth;
   *radius is the distance of the cut from the axis. The normal at the cut passes through the pitch
   point (Litvin & Fuentes 2004). */
static double tip_inside(const gear_spur_spec *g, const gear_spur_pair *p, int i, double beside,
                         double *radius)
{
    const double r = p->reference_radius[i];
    const tool_tip tip = tip_of(g, i);
    const double reach = hypot(beside, tip.centre);
    const double far = reach > 0 ? 1 + tip.round / reach : 1;
    const double x = beside * far, y = r - tip.centre * far;
    const double rolled = beside + tip.centre * tan(g->pressure_angle) + tip.behind;
    *radius = fmax(hypot(x, y), p->base_radius[i]);
    const double flank =
        numerics_involute(acos(p->base_radius[i] / *radius)) - numerics_involute(g->pressure_angle);
    return atan2(x, y) - rolled / r - flank;
}

/* Returns the least profile shift without undercut (DIN 3960: h - z sin^2(a)/2, where h is the
 * depth of the straight flank). */
static double least_shift(const gear_spur_spec *g, int i)
{
    const double s = sin(g->pressure_angle);
    return straight_depth(g, i) - ff_of_both(&g->teeth, i) * s * s / 2;
}

/* Returns the radius of curvature up to which undercut or a protuberance removes the involute of
   gear i; 0: none. It is the outermost point at which the path of the tool's tip crosses the
   involute. */
static double undercut_of(const gear_spur_spec *g, const gear_spur_pair *p, int i)
{
    enum { STEPS = 400 };
    if (ff_of_both(&g->shift, i) >= least_shift(g, i) - harmless_undercut &&
        !(residual_undercut(g, i) > 0))
        return 0;
    double radius, most = p->tip_radius[i], outer = most, inner = 0;
    bool inside = false;
    for (int k = 0; k < STEPS && !inside; k++) {
        inner = most * (1 - (double)k / STEPS);
        inside = tip_inside(g, p, i, inner, &radius) > 0;
        if (!inside)
            outer = inner;
    }
    for (int k = 0; k < 60 && inside; k++) {
        double middle = (inner + outer) / 2;
        *(tip_inside(g, p, i, middle, &radius) > 0 ? &inner : &outer) = middle;
    }
    if (!inside)
        return 0;
    tip_inside(g, p, i, inner, &radius);
    return sqrt((radius - p->base_radius[i]) * (radius + p->base_radius[i]));
}

/* Refuses teeth whose undercut removes a part of the meshing flank. */
static ff_status check_undercut(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    for (int i = 0; i < 2; i++) {
        const double tip = p->tip_radius[1 - i], base = p->base_radius[1 - i];
        const double lowest = p->line_length - sqrt((tip - base) * (tip + base));
        p->undercut[i] = undercut_of(g, p, i);
        if (p->undercut[i] > 0 && lowest < p->undercut[i] && residual_undercut(g, i) > 0)
            return ff_failf(host, FF_INVALID, "protuberance",
                            "gear %d: the protuberance removes the flank up to a diameter of %.6g "
                            "mm, but the flank meshes from %.6g mm on; reduce the protuberance, or "
                            "increase machining_allowance or dedendum",
                            i + 1, 2e3 * hypot(p->base_radius[i], p->undercut[i]),
                            2e3 * hypot(p->base_radius[i], lowest));
        if (p->undercut[i] > 0 && lowest < p->undercut[i])
            return ff_failf(host, FF_INVALID, "profile_shift",
                            "gear %d with %g teeth and profile shift %g is undercut where its "
                            "flank meshes; it needs a profile_shift of at least %.3f, or more "
                            "teeth",
                            i + 1, ff_of_both(&g->teeth, i), ff_of_both(&g->shift, i),
                            least_shift(g, i));
    }
    return FF_OK;
}

/* Arc of the tooth at `radius` from the arc s at the reference radius r (DIN 3960): s_y = 2 r_y
 * (s/(2 r) + inv a - inv a_y). */
static double thickness_at(const gear_spur_spec *g, const gear_spur_pair *p, int i, double arc,
                           double radius)
{
    double angle = acos(fmin(1, p->base_radius[i] / radius));
    return 2 * radius *
           (arc / (2 * p->reference_radius[i]) + numerics_involute(g->pressure_angle) -
            numerics_involute(angle));
}

static ff_status set_thickness(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    double pitch = 2 * p->pitch_radius[0] * M_PI / ff_of_both(&g->teeth, 0);
    double filled = p->backlash / cos(p->working_angle);
    for (int i = 0; i < 2; i++) {
        double arc = p->thickness[i] + p->allowance[i];
        filled += thickness_at(g, p, i, arc, p->pitch_radius[i]);
        p->tip_thickness[i] = thickness_at(g, p, i, arc, p->tip_radius[i]);
        if (!(p->tip_thickness[i] > 0))
            return ff_failf(host, FF_INVALID,
                            ff_of_both(&g->tip_diameter, i) > 0 ? "tip_diameter" : "profile_shift",
                            "the tooth of gear %d is pointed below its tip diameter %g mm; "
                            "its %s must be less%s",
                            i + 1, 2e3 * p->tip_radius[i],
                            ff_of_both(&g->tip_diameter, i) > 0 ? "tip_diameter" : "profile_shift",
                            p->allowance[i] < 0 ? ", or the backlash" : "");
    }
    p->pitch_error = fabs(filled / pitch - 1);
    return FF_OK;
}

/* Finds the zone with the fewest pairs, n. It begins where the n-th pair ahead leaves, tip - n p_b,
   and ends where the n-th pair behind enters, SAP + n p_b. For n > 1 there are zones in between
   with n + 1 pairs. */
static void set_fewest_pairs(gear_spur_pair *p)
{
    double pairs = fmax(1, floor(p->contact_ratio + same_place));
    double apart = same_place * p->base_pitch;
    p->lpstc = p->tip - pairs * p->base_pitch;
    p->hpstc = p->sap + pairs * p->base_pitch;
    if (p->lpstc < p->sap + apart)
        p->lpstc = p->sap;
    if (p->hpstc > p->tip - apart)
        p->hpstc = p->tip;
}

static ff_status set_path(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    double reach[2]; /* radius of curvature of each flank at its tip */
    for (int i = 0; i < 2; i++) {
        double tip = p->tip_radius[i], base = p->base_radius[i];
        reach[i] = sqrt((tip - base) * (tip + base));
    }
    for (int i = 0; i < 2; i++)
        if (!(reach[i] < p->line_length * (1 - 1e-9)))
            return ff_failf(host, FF_INVALID,
                            ff_of_both(&g->tip_diameter, i) > 0 ? "tip_diameter" : "profile_shift",
                            "the tip of gear %d (diameter %g mm) reaches below the base circle of "
                            "gear %d, where there is no involute; the tip diameter must be less "
                            "than %.4f mm",
                            i + 1, 2e3 * p->tip_radius[i], 2 - i,
                            2e3 * hypot(p->base_radius[i], p->line_length));
    p->sap = p->line_length - reach[1];
    p->tip = reach[0];
    p->pitch_point = p->base_radius[0] * tan(p->working_angle);
    p->contact_ratio = (p->tip - p->sap) / p->base_pitch;
    if (!(p->contact_ratio >= 1 - same_place && p->contact_ratio < MOST_PAIRS))
        return ff_failf(host, FF_INVALID,
                        ff_of_both(&g->tip_diameter, 0) > 0 ? "tip_diameter" : "teeth",
                        "the profile contact ratio of the pair is %.4f; it must be at least 1 and "
                        "less than %d",
                        p->contact_ratio, MOST_PAIRS);
    set_fewest_pairs(p);
    return FF_OK;
}

/* A rack whose straight flank ends h modules below its middle cuts an involute down to the
 * radius of curvature r sin a - (h - x) m / sin a; below it the tip of the tool cuts the fillet. */
static double form_margin(const gear_spur_spec *g, gear_spur_pair *p)
{
    double s = sin(g->pressure_angle), lowest[2] = {p->sap, p->line_length - p->tip};
    double margin = HUGE_VAL;
    for (int i = 0; i < 2; i++) {
        double rest = ff_of_both(&g->dedendum, i) - straight_depth(g, i);
        double depth = p->reference_radius[i] - p->root_radius[i] - rest * g->module;
        p->form[i] = fmax(p->reference_radius[i] * s - depth / s, p->undercut[i]);
        margin = fmin(margin, lowest[i] - p->form[i]);
    }
    return margin;
}

ff_status gear_spur_pair_make(const ff_host *host, const gear_spur_spec *g, gear_spur_pair *p)
{
    *p = (gear_spur_pair){0};
    for (int i = 0; i < 2; i++) {
        p->reference_radius[i] = g->module * ff_of_both(&g->teeth, i) / 2;
        p->base_radius[i] = p->reference_radius[i] * cos(g->pressure_angle);
    }
    p->base_pitch = M_PI * g->module * cos(g->pressure_angle);
    ff_status status = mount(host, g, p);
    if (status == FF_OK)
        status = set_backlash(host, g, p);
    if (status == FF_OK)
        status = set_depths(host, g, p);
    if (status == FF_OK)
        status = check_undercut(host, g, p);
    for (int i = 0; i < 2 && status == FF_OK && (g->span.count > 0 || g->over_pins.count > 0); i++)
        status = gear_check_measure(host, g, p, i);
    if (status == FF_OK)
        status = set_thickness(host, g, p);
    if (status == FF_OK)
        status = set_path(host, g, p);
    if (status == FF_OK)
        p->form_margin = form_margin(g, p);
    return status;
}

/* Lists the ends of the zones with a constant number of pairs, from SAP to tip. Pairs enter at
 * whole base pitches after SAP and leave at whole base pitches before the tip. */
static size_t list_ends(const gear_spur_pair *p, double ends[2 * MOST_PAIRS])
{
    double apart = same_place * p->base_pitch;
    size_t count = 0;
    ends[count++] = p->sap;
    int came = 1, left = MOST_PAIRS - 1;
    while (came < MOST_PAIRS || left > 0) {
        double comes = came < MOST_PAIRS ? p->sap + came * p->base_pitch : HUGE_VAL;
        double leaves = left > 0 ? p->tip - left * p->base_pitch : HUGE_VAL;
        double next = fmin(comes, leaves);
        if (leaves < comes)
            left--;
        else
            came++;
        if (next > ends[count - 1] + apart && next < p->tip - apart)
            ends[count++] = next;
    }
    ends[count++] = p->tip;
    return count;
}

/* Returns the number of intervals for a zone with this share of the path; a negligible zone
 * keeps only its ends. */
static size_t intervals(double share, size_t wanted)
{
    const double negligible = 1e-6;
    return (size_t)fmax(share > negligible ? 2 : 1, round(share * (double)wanted));
}

size_t gear_spur_runs(const gear_spur_pair *p, size_t wanted, gear_spur_run runs[GEAR_SPUR_RUNS])
{
    double ends[2 * MOST_PAIRS], path = p->tip - p->sap, apart = same_place * p->base_pitch;
    size_t end_count = list_ends(p, ends), count = 0;
    for (size_t i = 0; i + 1 < end_count; i++) {
        bool split = p->pitch_point > ends[i] + apart && p->pitch_point < ends[i + 1] - apart;
        runs[count++] =
            (gear_spur_run){.from = ends[i], .to = split ? p->pitch_point : ends[i + 1]};
        if (split)
            runs[count++] =
                (gear_spur_run){.from = p->pitch_point, .to = ends[i + 1], .joined = true};
    }
    for (size_t i = 0; i < count; i++)
        runs[i].intervals = intervals((runs[i].to - runs[i].from) / path, wanted);
    return count;
}
