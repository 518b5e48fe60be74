/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "half-space.h"

#include "../contact/simd-reductions.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Step of the trapezoidal rule. Its relative error is 2 |Gamma(1/2 + 2 pi i/STEP)|/sqrt(pi):
   3e-4. */
static const double STEP = 1.05;
/* Factors by which the range of the modes exceeds the shortest and the longest time. The sums
   beyond both ends are exact to the second moment. */
static const double FASTER = 12, SLOWER = 0.15;

void ehl_half_space_create(ehl_half_space *f, double B, double shortest, double longest)
{
    double low = log(SLOWER / longest), high = log(FASTER / shortest), step = STEP;
    size_t inner = (size_t)fmax(2, ceil((high - low) / step)) + 1;
    if (inner > EHL_MODES - 1) {
        inner = EHL_MODES - 1;
        step = (high - low) / (double)(inner - 1);
    }
    size_t whole = (inner + EHL_LANES) / EHL_LANES * EHL_LANES;
    *f = (ehl_half_space){.count = whole, .scale = 1 / (sqrt(pi) * B)};
    for (size_t k = inner + 1; k < whole; k++)
        f->lambda[k] = exp(high);
    for (size_t k = 0; k < inner; k++) {
        double y = low + step * (double)k;
        f->lambda[k + 1] = exp(y);
        f->weight[k + 1] = step * exp(y / 2) / sqrt(pi);
    }
    /* geometric sums: of e^(y/2) and e^(3y/2) over all slower modes, and of e^(-y/2) over all
       faster modes */
    double ratio = exp(-step / 2), cubed = ratio * ratio * ratio;
    double slow = f->weight[1] * ratio / (1 - ratio);
    double decay = f->weight[1] * f->lambda[1] * cubed / (1 - cubed);
    f->lambda[0] = decay / slow;
    f->weight[0] = slow;
    f->instant = f->weight[inner] / f->lambda[inner] * ratio / (1 - ratio);
}

void ehl_half_space_pass(const ehl_half_space *f, double u, double dx, double rate, ehl_passage *p)
{
    double own = f->instant;
    for (size_t k = 0; k < f->count; k++) {
        double decay = f->lambda[k], way = u > 0 ? decay * dx / u : HUGE_VAL;
        double kept = exp(-way), gone = -expm1(-way);
        /* int_0^1 exp(-way (1 - s)) s ds = (1 - gone/way)/way */
        double here = way > 1e-4 ? 1 - gone / way : way / 2 - way * way / 6;
        double before = (gone - here) / decay, per = 1 / (1 + rate * here / decay);
        p->keep[k] = (kept - rate * before) * per;
        p->here[k] = here / decay * per;
        p->before[k] = before * per;
        own += f->weight[k] * p->here[k];
    }
    p->own = f->scale * own;
}

FF_SIMD
double ehl_half_space_reach(const ehl_half_space *f, const ehl_passage *p,
                            const double *modes_before, double flux_before,
                            const double *past_before, const double *past, double *modes)
{
    static const double none[EHL_MODES] = {0};
    ehl_lanes sum = {0}, keep, before, here, mode, was, now, weight;
    past_before = past_before ? past_before : none;
    past = past ? past : none;
    for (size_t k = 0; k < f->count; k += EHL_LANES) {
        memcpy(&keep, p->keep + k, sizeof keep);
        memcpy(&before, p->before + k, sizeof before);
        memcpy(&here, p->here + k, sizeof here);
        memcpy(&weight, f->weight + k, sizeof weight);
        memcpy(&mode, modes_before + k, sizeof mode);
        memcpy(&was, past_before + k, sizeof was);
        memcpy(&now, past + k, sizeof now);
        mode = keep * mode + before * (flux_before - was) - here * now;
        memcpy(modes + k, &mode, sizeof mode);
        sum += weight * mode;
    }
    return f->scale * ehl_lanes_sum(&sum);
}

FF_SIMD
void ehl_half_space_add(const ehl_half_space *f, const ehl_passage *p, double flux, double *modes)
{
    ehl_lanes here, mode;
    for (size_t k = 0; k < f->count; k += EHL_LANES) {
        memcpy(&here, p->here + k, sizeof here);
        memcpy(&mode, modes + k, sizeof mode);
        mode += here * flux;
        memcpy(modes + k, &mode, sizeof mode);
    }
}
