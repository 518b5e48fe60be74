/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inputs.h"

#include "../numerics/pinion.h"

#include <flankfilm/author.h>

#include <math.h>

const ff_port stiffness_inputs[STIFFNESS_INPUTS] = {
    {.name = "gear.roll_angle",
     .unit = "rad",
     .doc = "roll angle of gear 1 at the stations",
     .dims = "station"},
    {.name = "gear.roll_sap", .unit = "rad", .doc = "roll angle at SAP", .dims = ""},
    {.name = "gear.roll_tip", .unit = "rad", .doc = "roll angle at the tip", .dims = ""},
    {.name = "gear.teeth", .unit = "1", .doc = "numbers of teeth", .dims = "gear"},
    {.name = "operating.line_force",
     .unit = "N",
     .doc = "normal force along the line of action; negative on the back flanks",
     .dims = ""},
    {.name = "operating.reference_force",
     .unit = "N",
     .doc =
         "force for which stiffness and load sharing are evaluated; not wired or 0: the line force",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "operating.largest_force",
     .unit = "N",
     .doc = "largest line force during the torque fluctuation; the force levels cover it",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "gear.profile_roll",
     .unit = "rad",
     .doc = "roll angles on each gear's own flank at which profile_deviation is given",
     .dims = "gear profile",
     .flags = FF_OPTIONAL},
    {.name = "gear.profile_deviation",
     .unit = "m",
     .doc = "deviation of the flank along its normal, positive: more metal",
     .dims = "gear profile",
     .flags = FF_OPTIONAL},
    {.name = "gear.back_profile_roll",
     .unit = "rad",
     .doc = "roll angles on the back flanks at which back_profile_deviation is given; not wired: "
            "the back flanks equal the driving flanks",
     .dims = "gear back_profile",
     .flags = FF_OPTIONAL},
    {.name = "gear.back_profile_deviation",
     .unit = "m",
     .doc = "deviation of the back flank, which carries the load if the line force is negative",
     .dims = "gear back_profile",
     .flags = FF_OPTIONAL},
    {.name = "gear.pitch_deviation_1",
     .unit = "m",
     .doc = "index deviations of the teeth of gear 1, positive: more metal",
     .dims = "tooth_1",
     .flags = FF_OPTIONAL},
    {.name = "gear.pitch_deviation_2",
     .unit = "m",
     .doc = "index deviations of the teeth of gear 2, positive: more metal",
     .dims = "tooth_2",
     .flags = FF_OPTIONAL},
    {.name = "gear.base_radius", .unit = "m", .doc = "base circle radii", .dims = "gear"},
    {.name = "gear.reference_radius", .unit = "m", .doc = "reference circle radii", .dims = "gear"},
    {.name = "gear.root_radius", .unit = "m", .doc = "root circle radii", .dims = "gear"},
    {.name = "gear.bore_radius", .unit = "m", .doc = "bore radii; 0: none", .dims = "gear"},
    {.name = "gear.tooth_thickness",
     .unit = "m",
     .doc = "tooth thickness as an arc at the reference circle, without thickness_allowance",
     .dims = "gear"},
    {.name = "gear.working_pressure_angle",
     .unit = "rad",
     .doc = "working pressure angle, the angle of the line of action",
     .dims = ""},
    {.name = "gear.face_width", .unit = "m", .doc = "width of the teeth in contact", .dims = ""},
    {.name = "gear.elastic_modulus", .unit = "Pa", .doc = "Young's moduli", .dims = "gear"},
    {.name = "gear.poisson_ratio", .unit = "1", .doc = "Poisson's ratios", .dims = "gear"},
    {.name = "gear.backlash",
     .unit = "m",
     .doc = "backlash along the line of action; without thickness_allowance, half of it thins the "
            "teeth of each gear",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "gear.thickness_allowance",
     .unit = "m",
     .doc = "actual tooth thickness minus tooth_thickness; negative: thinner",
     .dims = "gear",
     .flags = FF_OPTIONAL},
    {.name = "gear.tool_tip_radius",
     .unit = "1",
     .doc = "tip radius of the rack that cuts the teeth, over the module; not given: 0.38",
     .dims = "gear",
     .flags = FF_OPTIONAL},
    NUMERICS_PINION_ROW(NULL),
};

ff_status stiffness_input_read(const ff_host *host, const ff_array *in, int row, size_t i,
                               double *value)
{
    const ff_array *array = &in[row];
    const char *name = stiffness_inputs[row].name;
    size_t count = 1;
    for (uint32_t k = 0; k < array->rank; k++)
        count *= array->shape[k];
    if (!array->data || i >= count)
        return ff_failf(host, FF_INVALID, name, "element %zu is missing", i + 1);
    *value = array->data[i];
    if (!isfinite(*value))
        return ff_failf(host, FF_INVALID, name, "the value must be finite, but is %g", *value);
    return FF_OK;
}
