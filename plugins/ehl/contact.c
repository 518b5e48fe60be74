/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contact.h"

#include <math.h>
#include <string.h>

/* What the mass that cell i loses changes by with h, as far as the oil is carried along. */
static double carried(const ehl_reynolds *r, const ehl_step *step, const ehl_film *film, size_t i)
{
    double near, far, u = step->follows ? 0 : step->entrainment;
    ehl_upwind(r, film, i, &near, &far);
    return r->liquid.rho[i] * (u * near + r->dx * step->rate);
}

int ehl_contact_choose(const ehl_reynolds *r, const ehl_step *step, ehl_film *film)
{
    int changed = 0;
    for (size_t i = 1; i + 1 < r->nodes; i++) {
        double open = r->h[i] - r->contact;
        int asperity =
            film->full[i] ? carried(r, step, film, i) * open < -r->residual[i] : open < 0;
        changed |= asperity != film->asperity[i];
        film->asperity[i] = (unsigned char)asperity;
        film->full[i] |= (unsigned char)asperity;
    }
    return changed;
}

void ehl_contact_rows(ehl_reynolds *r, const ehl_step *step, const ehl_film *film)
{
    for (size_t i = 1; i < r->last; i++) {
        if (!film->asperity[i])
            continue;
        double c = carried(r, step, film, i);
        for (int s = 0; s < EHL_STENCIL; s++)
            r->by_p[s][i] = r->by_h[s][i] = 0;
        r->by_h[2][i] = -c;
        r->residual[i] = -c * (r->h[i] - r->contact);
    }
}

void ehl_contact_mass(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, double *mass)
{
    if (!(step->rate > 0) || !step->follows || !memchr(film->asperity, 1, r->nodes))
        return;
    ehl_reynolds_evaluate(r, step, film);
    for (size_t i = 1; i + 1 < r->nodes; i++)
        if (film->asperity[i])
            mass[i] = fmin(r->mass[i], fmax(0, r->mass[i] + r->residual[i] / (r->dx * step->rate)));
}
