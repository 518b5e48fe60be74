/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bulk temperature of the teeth by ISO/TR 15144-1. */
#include "bulk.h"

#include <math.h>

/* ISO/TR 15144-1 (84): temperature rise 7400 (P mu_m H_v/(a b))^0.72 X_S/(1.2 X_Ca), with the loss
   P mu_m H_v in kW and a, b in mm. The centre distance a follows from the base radii and the line
   of action. */
double losses_standard_rise(const losses_mesh *m, double loss, int32_t supply, double relief)
{
    static const double supplied[] = {1, 1.2, 0.2};
    const double bases = losses_base_radius(m) * (1 + m->omega[0] / m->omega[1]);
    const double centres = hypot(bases, m->radius[0][0] + m->radius[1][0]);
    const double density = 1e-3 * fmax(loss, 0) / (1e3 * centres * 1e3 * m->face_width);
    return 7400 * pow(density, 0.72) * supplied[supply] / (1.2 * relief);
}
