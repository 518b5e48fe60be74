/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gear/involute-spur: path of contact, radii of curvature and inertia of a spur gear pair. */
#include "drawing-rounding.h"
#include "references.h"
#include "spur-rows.h"
#include "spur.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ff_param params[] = {
    FF_LIST("teeth", "1", spur, spec.teeth, FF_REQUIRED | FF_WHOLE, NULL, NULL, 3, 1e6, 0, 0, 1, 2,
            "numbers of teeth of gear 1 and gear 2; one value: both equal. Gear 1 drives if its "
            "torque is positive"),
    FF_QUANTITY("module", "mm", spur, spec.module, FF_REQUIRED, NULL, NULL, 1e-3, 1e3, 0, 0,
                "module: reference diameter over number of teeth"),
    FF_QUANTITY("pressure_angle", "deg", spur, spec.pressure_angle, 0, "20 deg", NULL, 5, 45, 0, 0,
                "pressure angle of the basic rack; spur teeth have no helix angle"),
    FF_QUANTITY("face_width", "mm", spur, face_width, FF_REQUIRED, NULL, NULL, 1e-3, 1e5, 0, 0,
                "width of the teeth in contact"),
    FF_LIST("profile_shift", "1", spur, spec.shift, 0, "0", NULL, -10, 10, 0, 0, 1, 2,
            "profile shift coefficients x1 and x2, positive outward; refused if the meshing part "
            "of a flank is undercut"),
    FF_QUANTITY("centre_distance", "mm", spur, spec.centre_distance, 0, NULL, NULL, 1e-3, 1e9, 0, 0,
                "working centre distance; left out: that of a mesh without backlash for these "
                "profile shifts"),
    FF_LIST("tip_diameter", "mm", spur, spec.tip_diameter, 0, NULL, NULL, 1e-3, 1e9, 0, 0, 1, 2,
            "tip (outside) diameters; left out: d + 2 m (1 + x), shortened by DIN 3960 if the "
            "profile shifts do not cancel"),
    FF_LIST("root_diameter", "mm", spur, spec.root_diameter, 0, NULL, NULL, 1e-3, 1e9, 0, 0, 1, 2,
            "root diameters; left out: d + 2 m (x - dedendum)"),
    FF_LIST("dedendum", "1", spur, spec.dedendum, 0, "1.25", NULL, 0.5, 3, 1, 1.6, 1, 2,
            "dedendum of the basic rack over the module: the depth that the tool cuts"),
    FF_LIST("tool_tip_radius", "1", spur, spec.tool_tip_radius, 0, NULL, NULL, 0, 1, 0, 0, 1, 2,
            "tip radius of the tool over the module, for the root form and the stiffness of the "
            "tooth; left out: a root form with the bottom clearance of 0.25, and 0.38 for the "
            "stiffness"),
    FF_LIST("protuberance", "um", spur, spec.protuberance, 0, NULL, NULL, 0, 1e3, 0, 0, 1, 2,
            "protuberance of the tool's tip beyond the tool's flank, normal to the flank; it "
            "determines where the involute begins"),
    FF_LIST("machining_allowance", "um", spur, spec.machining_allowance, 0, NULL, NULL, 0, 1e3, 0,
            0, 1, 2,
            "stock ground off the flank after cutting, normal to the flank; a protuberance "
            "undercuts the flank only by its excess over this stock"),
    FF_QUANTITY("backlash", "mm", spur, spec.backlash, 0, NULL, "thickness", 0, 1e3, 0, 0,
                "total backlash of the mounted pair, twice the half-gap b; both gears are thinned "
                "equally for it. Left out: it follows from the tooth thickness, or from full teeth "
                "if that is not given either"),
    FF_ONE_OF("line-of-action|circular", "backlash_measure", spur, spec.backlash_measure, 0,
              "line-of-action",
              "where `backlash` is measured: along the line of action, or as an arc of the working "
              "pitch circle"),
    FF_LIST("thickness_allowance", "um", spur, spec.allowance, 0, NULL, "thickness", -1e4, 1e4,
            -1e3, 0, 1, 2,
            "tooth thickness allowances E_sn of a drawing, as arcs at the reference circle, one "
            "value or two; negative: the tooth is thinner than the profile shift makes it"),
    FF_LIST("span", "mm", spur, spec.span, 0, NULL, "thickness", 1e-3, 1e5, 0, 0, 1, 2,
            "span measures W_k over span_teeth teeth, one value or two"),
    FF_LIST("span_teeth", "1", spur, spec.span_teeth, 0, NULL, NULL, 2, 1000, 0, 0, 1, 2,
            "numbers of teeth k over which `span` was measured"),
    FF_LIST("over_pins", "mm", spur, spec.over_pins, 0, NULL, "thickness", 1e-3, 1e5, 0, 0, 1, 2,
            "measures M_d over two pins (or balls) of pin_diameter, one value or two"),
    FF_LIST("pin_diameter", "mm", spur, spec.pin_diameter, 0, NULL, NULL, 1e-3, 1e4, 0, 0, 1, 2,
            "diameters D_M of the pins over which `over_pins` was measured"),
    FF_LIST("bore_diameter", "mm", spur, bore, 0, "0 mm", NULL, 0, 1e9, 0, 0, 1, 2,
            "bore diameters, 0: none"),
    FF_LIST("inertia", "kg m2", spur, given_inertia, 0, NULL, NULL, 1e-20, 1e20, 0, 0, 1, 2,
            "polar moments of inertia; left out: discs of working pitch diameter and face "
            "width minus the bore"),
    FF_ONE_OF(GEAR_MATERIALS, "material", spur, material.name[0], 0, "steel",
              "material of the gears: gives modulus, Poisson's ratio, density, heat data, hardness "
              "and yield strength, as far as they are known"),
    FF_ONE_OF(GEAR_MATERIALS, "material_2", spur, material.name[1], 0, NULL,
              "material of gear 2; left out: that of gear 1"),
    FF_LIST("elastic_modulus", "GPa", spur, material.modulus, 0, NULL, NULL, 1e-3, 1e4, 0, 0, 1, 2,
            "Young's moduli E1 and E2; left out: those of the material"),
    FF_LIST("poisson_ratio", "1", spur, material.poisson, 0, NULL, NULL, 0, 0.5, 0, 0, 1, 2,
            "Poisson's ratios of the gears; left out: those of the material"),
    FF_LIST("density", "kg/m3", spur, material.density, 0, NULL, NULL, 1, 1e5, 0, 0, 1, 2,
            "densities of the gears, for mass, inertia and heat; left out: those of the material"),
    FF_LIST("thermal_conductivity", "W/(m K)", spur, material.conductivity, 0, NULL, NULL, 1e-3,
            1e4, 0, 0, 1, 2,
            "thermal conductivities of the gears; left out: those of the material, unless a given "
            "elastic_modulus or density differs from that of the material"),
    FF_LIST("specific_heat", "J/(kg K)", spur, material.specific_heat, 0, NULL, NULL, 1, 1e5, 0, 0,
            1, 2,
            "specific heats of the gears; left out: the same rule as for "
            "thermal_conductivity"),
    FF_LIST("hardness", "GPa", spur, material.hardness, FF_MIN_OPEN, NULL, NULL, 0, 1e3, 0, 0, 1, 2,
            "indentation hardness of the flanks as a pressure: 7 GPa is 700 HV; left out: the same "
            "rule as for thermal_conductivity"),
    FF_LIST("yield_strength", "MPa", spur, material.yield, FF_MIN_OPEN, NULL, NULL, 0, 1e4, 0, 0, 1,
            2,
            "yield strengths of the flanks in tension; left out: the same rule as for "
            "thermal_conductivity"),
    FF_COUNT("stations", spur, stations, FF_TUNABLE, "800", NULL, 8, 100000, 0, 0,
             "approximate number of intervals of the path of contact"),
    FF_LIST("tip_relief", "um", spur, flank_spec.tip.amount, 0, "0 um", NULL, 0, 1e4, 0, 0, 1, 2,
            "metal removed at the tip of the flank, normal to it, one value or two"),
    FF_LIST("tip_relief_start", "deg", spur, flank_spec.tip.start, 0, NULL, "tip_relief_start", 0,
            1e4, 0, 0, 1, 2,
            "roll angle, on the gear itself, at which the tip relief starts; left out: each gear's "
            "HPSTC"),
    FF_LIST("tip_relief_diameter", "mm", spur, flank_spec.tip.diameter, 0, NULL, "tip_relief_start",
            1e-3, 1e9, 0, 0, 1, 2,
            "diameter at which the tip relief starts, instead of tip_relief_start"),
    FF_LIST("tip_relief_length", "mm", spur, flank_spec.tip.length, 0, NULL, "tip_relief_start", 0,
            1e5, 0, 0, 1, 2,
            "length of the tip relief from the tip, along the line of action as in profile "
            "diagrams, instead of tip_relief_start"),
    FF_ONE_OF("linear|parabolic", "tip_relief_shape", spur, flank_spec.tip.shape, 0, "linear",
              "shape of the tip relief between its start and the tip"),
    FF_LIST("back_relief", "um", spur, back_relief.amount, 0, NULL, NULL, 0, 1e4, 0, 0, 1, 2,
            "tip relief of the back flanks, which carry the load if the torque is negative; left "
            "out: back_relief and its other parameters are those of the driving flank"),
    FF_LIST("back_relief_start", "deg", spur, back_relief.start, 0, NULL, "back_relief_start", 0,
            1e4, 0, 0, 1, 2,
            "roll angle, on the gear itself, at which the relief of its back flank starts"),
    FF_LIST("back_relief_diameter", "mm", spur, back_relief.diameter, 0, NULL, "back_relief_start",
            1e-3, 1e9, 0, 0, 1, 2,
            "diameter at which the relief of the back flank starts, instead of back_relief_start"),
    FF_LIST("back_relief_length", "mm", spur, back_relief.length, 0, NULL, "back_relief_start", 0,
            1e5, 0, 0, 1, 2,
            "length of the back relief from the tip along the line of action, instead of "
            "back_relief_start"),
    FF_ONE_OF("linear|parabolic", "back_relief_shape", spur, back_relief.shape, 0, NULL,
              "shape of the back relief between its start and the tip"),
    FF_LIST("root_relief", "um", spur, flank_spec.root.amount, 0, "0 um", NULL, 0, 1e4, 0, 0, 1, 2,
            "metal removed at the lowest point of contact, one value or two"),
    FF_LIST("root_relief_start", "deg", spur, flank_spec.root.start, 0, NULL, "root_relief_start",
            0, 1e4, 0, 0, 1, 2,
            "roll angle, on the gear itself, at which the root relief starts; left out: each "
            "gear's LPSTC"),
    FF_LIST("root_relief_diameter", "mm", spur, flank_spec.root.diameter, 0, NULL,
            "root_relief_start", 1e-3, 1e9, 0, 0, 1, 2,
            "diameter at which the root relief starts, instead of root_relief_start"),
    FF_LIST("root_relief_length", "mm", spur, flank_spec.root.length, 0, NULL, "root_relief_start",
            0, 1e5, 0, 0, 1, 2,
            "length of the root relief from the lowest contact, along the line of action as in "
            "profile diagrams, instead of root_relief_start"),
    FF_ONE_OF("linear|parabolic", "root_relief_shape", spur, flank_spec.root.shape, 0, "linear",
              "shape of the root relief between its start and the lowest point of contact"),
    FF_LIST("crowning", "um", spur, flank_spec.crown, 0, "0 um", NULL, 0, 1e4, 0, 0, 1, 2,
            "profile crown (barrelling): a parabola that removes this much metal at both ends of "
            "the flank and none in the middle"),
    FF_LIST(
        "profile_slope", "um", spur, flank_spec.slope, 0, "0 um", NULL, -1e4, 1e4, 0, 0, 1, 2,
        "profile slope deviation f_H_alpha of ISO 1328-1, caused by a pressure-angle error: rise "
        "of the flank from its lowest contact to the tip, positive if the tip has more metal"),
    FF_LIST("pitch_error", "um", spur, flank_spec.index[0], 0, NULL, NULL, -1e4, 1e4, 0, 0, 1,
            100000,
            "index deviations of the teeth of gear 1 along the line of action, one per tooth, "
            "positive: more metal on the working flank; 0 for teeth not listed"),
    FF_LIST("pitch_error_2", "um", spur, flank_spec.index[1], 0, NULL, NULL, -1e4, 1e4, 0, 0, 1,
            100000, "index deviations of the teeth of gear 2, as pitch_error"),
    FF_LIST("quality", "1", spur, quality, FF_WHOLE, NULL, NULL, 0, 12, 0, 0, 1, 2,
            "accuracy class of ISO 1328-1:1995, one value or two; gives the tolerance outputs"),
    FF_PATH("profile_file", spur, flank_spec.file, 0, NULL,
            "file with measured profiles to be added; header: gear, roll_angle [deg], deviation "
            "[um]. The roll angle is on the gear itself; a positive deviation is more metal"),
    FF_LIST("roughness_rq", "um", spur, roughness_rq, FF_MIN_OPEN, NULL, "roughness", 0, 100, 0.01,
            10, 1, 2,
            "root mean square roughness Rq of the flanks, one value or two, for the lambda ratio "
            "of smooth films; a film between rough flanks needs a stage of kind surface"),
    FF_LIST("roughness_ra", "um", spur, roughness_ra, FF_MIN_OPEN, NULL, "roughness", 0, 100, 0.01,
            10, 1, 2,
            "mean roughness Ra, as on drawings, instead of `roughness`: Rq = sqrt(pi/2) Ra for "
            "Gaussian heights"),
};

/* Sets mass and inertia for discs with the working pitch diameter and a bore. An inertia given by
   the user replaces that of the disc. */
static ff_status set_discs(spur *s)
{
    for (int i = 0; i < 2; i++) {
        double radius = s->pair.pitch_radius[i], bore = ff_of_both(&s->bore, i) / 2;
        if (!(bore < s->pair.root_radius[i]))
            return ff_failf(s->host, FF_INVALID, "bore_diameter",
                            "gear %d has bore diameter %g mm; it must be less than its root "
                            "diameter %g mm",
                            i + 1, 2e3 * bore, 2e3 * s->pair.root_radius[i]);
        s->bore_radius[i] = bore;
        s->mass[i] =
            s->made_of[i].density * M_PI * s->face_width * (radius - bore) * (radius + bore);
        s->inertia[i] = s->given_inertia.count > 0
                            ? ff_of_both(&s->given_inertia, i)
                            : s->mass[i] * (radius * radius + bore * bore) / 2;
    }
    return FF_OK;
}

/* Declares parameters that affect only some outputs. The engine warns if one of them is given but
   only other outputs are requested. */
static void tell_servings(const spur *s)
{
    static const char back[] = "back_profile_roll|back_profile_deviation",
                      form[] = "profile_roll|profile_deviation|back_profile_roll|"
                               "back_profile_deviation",
                      tolerances[] = "single_pitch_tolerance|total_pitch_tolerance|"
                                     "profile_form_tolerance|profile_slope_tolerance|"
                                     "profile_tolerance";
    const int tip = ff_of_both(&s->flank_spec.tip.amount, 0) > 0 ||
                    ff_of_both(&s->flank_spec.tip.amount, 1) > 0;
    const int root = ff_of_both(&s->flank_spec.root.amount, 0) > 0 ||
                     ff_of_both(&s->flank_spec.root.amount, 1) > 0;
    const ff_serving rows[] = {
        {1, "stations", "roll_angle|radius_1|radius_2", NULL, NULL},
        {isnan(s->spec.backlash), "backlash_measure", "", NULL, "backlash is not given"},
        {s->spec.span.count == 0, "span_teeth", "span|span_teeth", NULL, "span is not given"},
        {s->spec.over_pins.count == 0, "pin_diameter", "over_pins|pin_diameter", NULL,
         "over_pins is not given"},
        {1, "inertia", "inertia|equivalent_mass", NULL, NULL},
        {1, "tip_relief", form, NULL, NULL},
        {1, "tip_relief_start", form, NULL, NULL},
        {1, "tip_relief_diameter", form, NULL, NULL},
        {1, "tip_relief_length", form, NULL, NULL},
        {1, "tip_relief_shape", form, NULL, NULL},
        {!tip, "tip_relief_start", "", NULL, "tip_relief is 0"},
        {!tip, "tip_relief_diameter", "", NULL, "tip_relief is 0"},
        {!tip, "tip_relief_length", "", NULL, "tip_relief is 0"},
        {!tip, "tip_relief_shape", "", NULL, "tip_relief is 0"},
        {1, "back_relief", back, NULL, NULL},
        {1, "back_relief_start", back, NULL, NULL},
        {1, "back_relief_diameter", back, NULL, NULL},
        {1, "back_relief_length", back, NULL, NULL},
        {1, "back_relief_shape", back, NULL, NULL},
        {1, "root_relief", form, NULL, NULL},
        {1, "root_relief_start", form, NULL, NULL},
        {1, "root_relief_diameter", form, NULL, NULL},
        {1, "root_relief_length", form, NULL, NULL},
        {1, "root_relief_shape", form, NULL, NULL},
        {!root, "root_relief_start", "", NULL, "root_relief is 0"},
        {!root, "root_relief_diameter", "", NULL, "root_relief is 0"},
        {!root, "root_relief_length", "", NULL, "root_relief is 0"},
        {!root, "root_relief_shape", "", NULL, "root_relief is 0"},
        {1, "crowning", form, NULL, NULL},
        {1, "profile_slope", form, NULL, NULL},
        {1, "profile_file", form, NULL, NULL},
        {1, "pitch_error", "pitch_deviation_1", NULL, NULL},
        {1, "pitch_error_2", "pitch_deviation_2", NULL, NULL},
        {1, "thermal_conductivity", "thermal_conductivity", NULL, NULL},
        {1, "specific_heat", "specific_heat", NULL, NULL},
        {1, "hardness", "hardness", NULL, NULL},
        {1, "yield_strength", "yield_strength", NULL, NULL},
        {1, "quality", tolerances, NULL, NULL},
        {1, "roughness_rq", "roughness", NULL, NULL},
        {1, "roughness_ra", "roughness", NULL, NULL},
    };
    ff_serve(s->host, rows, sizeof rows / sizeof rows[0]);
}

/* Checks that a tooth measure comes with the number of teeth, or the pin diameter, over which it
   was taken. */
static ff_status check_tools(const spur *s)
{
    const gear_spur_spec *g = &s->spec;
    if (g->span.count > 0 && g->span_teeth.count == 0)
        return ff_failf(s->host, FF_INVALID, "span",
                        "span needs span_teeth, the number of teeth over which it was measured");
    for (size_t i = 0; i < g->span_teeth.count; i++)
        if (g->span_teeth.data[i] != floor(g->span_teeth.data[i]))
            return ff_failf(s->host, FF_INVALID, "span_teeth",
                            "span_teeth must be a whole number, but is %g", g->span_teeth.data[i]);
    if (g->over_pins.count > 0 && g->pin_diameter.count == 0)
        return ff_failf(s->host, FF_INVALID, "over_pins",
                        "over_pins needs pin_diameter, the diameter of the pins");
    return FF_OK;
}

static ff_status ready(void *self)
{
    spur *s = self;
    tell_servings(s);
    for (int i = 0; i < 2; i++)
        s->made_of[i] = gear_material_make(&s->material, i);
    ff_status status = check_tools(s);
    if (status == FF_OK)
        status = gear_spur_pair_make(s->host, &s->spec, &s->pair);
    if (status == FF_OK)
        status = set_discs(s);
    for (int i = 0; i < 2 && status == FF_OK && s->quality.count > 0; i++)
        status = gear_tolerances_of(s->host, i + 1, ff_of_both(&s->quality, i), s->spec.module,
                                    2 * s->pair.reference_radius[i], &s->tolerances[i]);
    gear_flanks_free(&s->flanks);
    gear_flanks_free(&s->back);
    if (status == FF_OK)
        status = gear_flanks_make(s->host, &s->flank_spec, &s->spec, &s->pair, &s->flanks);
    if (status == FF_OK && gear_flanks_have_back(&s->back_relief)) {
        const gear_flank_spec back = gear_flanks_back(&s->flank_spec, &s->back_relief);
        status = gear_flanks_make(s->host, &back, &s->spec, &s->pair, &s->back);
    }
    return status;
}

/* Reports which dimensions were moved because of the drawing's rounding. */
static void report_rounding(const spur *s)
{
    const gear_spur_pair *p = &s->pair;
    char text[400];
    gear_rounding_say(p, fmax(s->flanks.moved_start, s->back.moved_start), text, sizeof text);
    if (!*text)
        return;
    s->host->log(s->host->ctx, FF_LOG_INFO, text);
    s->host->quality(s->host->ctx, "rounding", 1e6 * p->moved_backlash,
                     1e6 * p->rounding_of_backlash, FF_GOOD, text);
}

static void report_quality(const spur *s)
{
    const gear_spur_pair *p = &s->pair;
    const ff_host *host = s->host;
    const double m = s->spec.module;
    double tip = fmin(p->tip_thickness[0], p->tip_thickness[1]) / m;
    report_rounding(s);
    host->quality(host->ctx, "pitch_error", p->pitch_error, 1e-9,
                  p->pitch_error <= 1e-9 ? FF_GOOD : FF_BAD,
                  "relative difference between the working pitch and the sum of tooth thicknesses "
                  "and backlash");
    host->quality(host->ctx, "tip_thickness", tip, 0.2, tip >= 0.2 ? FF_GOOD : FF_RANGE,
                  "smallest tooth thickness at a tip, in modules; below 0.2 a tip is weak");
    host->quality(host->ctx, "tip_clearance", p->clearance / m, 0.1,
                  p->clearance >= 0.1 * m ? FF_GOOD : FF_RANGE,
                  "smallest gap between tip and mating root, in modules");
    host->quality(host->ctx, "involute_margin", p->form_margin / m, 0,
                  p->form_margin >= -1e-9 * m ? FF_GOOD : FF_RANGE,
                  "distance from the lower end of the involute to the nearest contact, in modules; "
                  "if negative, a tip may touch a fillet");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const spur *s = self;
    (void)in;
    report_quality(s);
    return gear_spur_write(s, wanted);
}

static void destroy(void *self)
{
    spur *s = self;
    if (!s)
        return;
    gear_flanks_free(&s->flanks);
    gear_flanks_free(&s->back);
    free(s);
}

FF_MODEL(gear_involute_spur, spur, .id = "gear/involute-spur", .version = "1.0.0",
         .summary = "external involute spur gear pair: path of contact, radii, inertia, deviations "
                    "of the flanks",
         .reference = "DIN 3960:1987, definitions and parameters of cylindrical gears; ISO 53:1998 "
                      "(basic rack); Litvin and Fuentes 2004, Gear Geometry and Applied Theory",
         .bibtex = BIB_litvin2004, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .outputs = FF_TABLE(gear_spur_outputs), .ready = ready, .evaluate = evaluate,
         .destroy = destroy, .columns = FF_TABLE(gear_curve_columns));
FF_EXPORT_MODELS(&gear_involute_spur);
