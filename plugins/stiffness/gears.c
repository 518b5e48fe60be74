/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the gears for models that compute the compliance of teeth. */
#include "gears.h"

#include "contact-point.h"
#include "inputs.h"

#include <flankfilm/author.h>

#include <math.h>

/* Tip radius of the basic rack of ISO 53 (profile A), in modules. */
static const double standard_tip_radius = 0.38;

/* Ratio of root radius to rim radius for a gear without a bore. */
static const double default_body_ratio = 2;

static ff_status read_positive(const ff_host *host, const ff_array *in, int row, size_t gear,
                               double *value)
{
    const char *name = stiffness_inputs[row].name;
    ff_status status = stiffness_input_read(host, in, row, gear, value);
    if (status == FF_OK && !(*value > 0))
        status = ff_failf(host, FF_INVALID, name, "gear %zu: the value must be positive, but is %g",
                          gear + 1, *value);
    return status;
}

static ff_status check_gear(const ff_host *host, const stiffness_gear *g, const ff_reals *rim,
                            int gear)
{
    if (!(g->poisson_ratio > -1 && g->poisson_ratio <= 0.5))
        return ff_failf(host, FF_INVALID, "gear.poisson_ratio",
                        "gear %d: Poisson's ratio must lie between -1 and 0.5, but is %g", gear + 1,
                        g->poisson_ratio);
    if (!(g->reference_radius >= g->base_radius))
        return ff_failf(host, FF_INVALID, "gear.reference_radius",
                        "gear %d: the reference circle lies inside the base circle", gear + 1);
    if (!(g->rim_radius < g->root_radius))
        return ff_failf(host, FF_INVALID, rim->count ? "rim_radius" : "gear.bore_radius",
                        "gear %d: the rim radius %.6g mm must be less than the root radius "
                        "%.6g mm",
                        gear + 1, 1e3 * g->rim_radius, 1e3 * g->root_radius);
    return FF_OK;
}

static ff_status read_gear(const ff_host *host, const ff_array *in, const ff_reals *rim, int gear,
                           stiffness_gear *g)
{
    const struct {
        int row;
        double *to;
    } positive[] = {
        {STIFFNESS_IN_BASE, &g->base_radius},        {STIFFNESS_IN_REFERENCE, &g->reference_radius},
        {STIFFNESS_IN_ROOT, &g->root_radius},        {STIFFNESS_IN_THICKNESS, &g->thickness},
        {STIFFNESS_IN_MODULUS, &g->elastic_modulus}, {STIFFNESS_IN_TEETH, &g->teeth},
    };
    size_t i = (size_t)gear;
    double bore = 0, backlash = 0, allowance = 0;
    ff_status status = FF_OK;
    for (size_t k = 0; k < sizeof positive / sizeof positive[0] && status == FF_OK; k++)
        status = read_positive(host, in, positive[k].row, i, positive[k].to);
    if (status == FF_OK)
        status = stiffness_input_read(host, in, STIFFNESS_IN_POISSON, i, &g->poisson_ratio);
    if (status == FF_OK)
        status = stiffness_input_read(host, in, STIFFNESS_IN_BORE, i, &bore);
    if (status == FF_OK && in[STIFFNESS_IN_BACKLASH].data)
        status = stiffness_input_read(host, in, STIFFNESS_IN_BACKLASH, 0, &backlash);
    if (status == FF_OK && in[STIFFNESS_IN_ALLOWANCE].data)
        status = stiffness_input_read(host, in, STIFFNESS_IN_ALLOWANCE, i, &allowance);
    g->tool_tip = standard_tip_radius;
    if (status == FF_OK && in[STIFFNESS_IN_TOOL_TIP].data)
        status = stiffness_input_read(host, in, STIFFNESS_IN_TOOL_TIP, i, &g->tool_tip);
    if (status != FF_OK)
        return status;
    if (!(g->tool_tip >= 0))
        return ff_failf(
            host, FF_INVALID, "gear.tool_tip_radius",
            "gear %d: the tip radius of the tool must not be negative; it is %g modules", gear + 1,
            g->tool_tip);
    if (!(backlash >= 0))
        return ff_failf(host, FF_INVALID, "gear.backlash",
                        "the backlash must not be negative; it is %g m", backlash);
    g->rim_radius = rim->count ? ff_of_both(rim, gear)
                    : bore > 0 ? bore
                               : g->root_radius / default_body_ratio;
    g->full_thickness = g->thickness;
    /* without thickness_allowance, the backlash, an arc of the base circle, thins both gears
       equally */
    g->thickness += in[STIFFNESS_IN_ALLOWANCE].data
                        ? allowance
                        : -backlash / 2 * g->reference_radius / g->base_radius;
    if (!(g->thickness > 0))
        return ff_failf(
            host, FF_INVALID,
            in[STIFFNESS_IN_ALLOWANCE].data ? "gear.thickness_allowance" : "gear.backlash",
            "gear %d: with this value no tooth is left at the reference circle", gear + 1);
    return check_gear(host, g, rim, gear);
}

ff_status stiffness_gears_read(const ff_host *host, const ff_array *in, const stiffness_path *e,
                               const ff_reals *rim, stiffness_gears *g)
{
    *g = (stiffness_gears){
        .roll_sap = e->roll_sap, .pitch = e->pitch, .contact_ratio = e->contact_ratio};
    double angle = 0;
    ff_status status = stiffness_input_read(host, in, STIFFNESS_IN_ANGLE, 0, &angle);
    if (status == FF_OK && !(angle > 0 && angle < M_PI / 2))
        status = ff_failf(host, FF_INVALID, "gear.working_pressure_angle",
                          "the working pressure angle must lie between 0 and 90 deg, but is %g rad",
                          angle);
    if (status == FF_OK)
        status = read_positive(host, in, STIFFNESS_IN_WIDTH, 0, &g->width);
    for (int i = 0; i < 2 && status == FF_OK; i++) {
        status = read_gear(host, in, rim, i, &g->gear[i]);
        g->tangent_length += g->gear[i].base_radius * tan(angle);
    }
    if (status != FF_OK)
        return status;
    for (int i = 0; i < 2; i++) {
        double sap = stiffness_gears_roll(g, i, 0),
               tip = stiffness_gears_roll(g, i, g->contact_ratio);
        g->gear[i].roll_low = fmin(sap, tip);
        g->gear[i].roll_tip = fmax(sap, tip);
        if (!(g->gear[i].roll_low > 0))
            return ff_failf(host, FF_INVALID, "gear.roll_tip",
                            "gear %d: the path of contact ends below the base circle", i + 1);
    }
    return FF_OK;
}
