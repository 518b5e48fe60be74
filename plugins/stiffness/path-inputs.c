/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the path of contact and the line force. */
#include "path-inputs.h"

#include "cycle.h"
#include "inputs.h"

#include <flankfilm/author.h>

#include <math.h>

/* Larger than any contact ratio of real gears; it limits the loops over pairs. */
static const double highest_contact_ratio = 10;

static ff_status check_stations(const ff_host *host, const stiffness_path *p, double roll_tip)
{
    double slack = STIFFNESS_PHASE_TOLERANCE * p->pitch;
    for (size_t i = 0; i < p->stations; i++) {
        double roll = p->roll[i];
        if (!(roll >= p->roll_sap - slack && roll <= roll_tip + slack) ||
            (i > 0 && roll < p->roll[i - 1]))
            return ff_failf(host, FF_INVALID, "gear.roll_angle",
                            "the roll angles must increase from SAP to the tip, but number %zu is "
                            "%.9g rad on a path from %.9g to %.9g rad",
                            i + 1, roll, p->roll_sap, roll_tip);
    }
    return FF_OK;
}

ff_status stiffness_path_read(const ff_host *host, const ff_array *in, stiffness_path *p)
{
    double tip = 0, teeth = 0;
    ff_status status = stiffness_input_read(host, in, STIFFNESS_IN_SAP, 0, &p->roll_sap);
    if (status == FF_OK)
        status = stiffness_input_read(host, in, STIFFNESS_IN_TIP, 0, &tip);
    if (status == FF_OK)
        status = stiffness_input_read(host, in, STIFFNESS_IN_TEETH, 0, &teeth);
    if (status == FF_OK)
        status = stiffness_input_read(host, in, STIFFNESS_IN_FORCE, 0, &p->line_force);
    if (status != FF_OK)
        return status;
    if (!(teeth >= 1))
        return ff_failf(host, FF_INVALID, "gear.teeth", "a gear of %g teeth does not mesh", teeth);
    /* back flanks meet at the same roll angles of gear 1 as the driving flanks */
    p->line_force = p->load = fabs(p->line_force);
    double reference = 0;
    p->largest = 0;
    if (in[STIFFNESS_IN_REFERENCE_FORCE].data)
        status = stiffness_input_read(host, in, STIFFNESS_IN_REFERENCE_FORCE, 0, &reference);
    if (status == FF_OK && in[STIFFNESS_IN_LARGEST_FORCE].data)
        status = stiffness_input_read(host, in, STIFFNESS_IN_LARGEST_FORCE, 0, &p->largest);
    if (status != FF_OK)
        return status;
    if (!(reference >= 0))
        return ff_failf(host, FF_INVALID, "operating.reference_force",
                        "must not be negative, but is %g N", reference);
    if (reference > 0)
        p->line_force = reference;
    p->pitch = 2 * M_PI / teeth;
    p->contact_ratio = (tip - p->roll_sap) / p->pitch;
    if (!(p->contact_ratio >= 1 - STIFFNESS_PHASE_TOLERANCE &&
          p->contact_ratio <= highest_contact_ratio))
        return ff_failf(host, FF_INVALID, "gear.roll_tip",
                        "the contact ratio is %.6g; it must be at least 1, so that a pair is "
                        "always in mesh, and at most %g",
                        p->contact_ratio, highest_contact_ratio);
    const ff_array *roll = &in[STIFFNESS_IN_ROLL];
    if (!roll->data || roll->rank != 1 || roll->shape[0] == 0)
        return ff_failf(host, FF_INVALID, "gear.roll_angle", "no station on the path of contact");
    p->stations = roll->shape[0];
    p->roll = roll->data;
    return check_stations(host, p, tip);
}
