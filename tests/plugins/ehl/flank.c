/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flank.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX generator */
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void flat(flank *f, double period)
{
    memset(f, 0, sizeof *f);
    f->period = period;
    for (size_t i = 0; i < FLANK_POINTS; i++)
        f->position[i] = period * (double)i / FLANK_POINTS;
}

static void set_rq(flank *f, int g, double rq)
{
    double square = 0;
    for (size_t i = 0; i < FLANK_POINTS; i++)
        square += f->height[g][i] * f->height[g][i];
    double factor = square > 0 ? rq / sqrt(square / FLANK_POINTS) : 0;
    for (size_t i = 0; i < FLANK_POINTS; i++)
        f->height[g][i] *= factor;
    f->rq[g] = rq;
}

void flank_random(flank *f, unsigned seed, double rq, double shortest, double longest)
{
    uint64_t state = 1 + (uint64_t)seed * 7919;
    flat(f, 2e-3);
    for (int k = 0; k < 16; k++)
        uniform(&state);
    for (int g = 0; g < 2; g++) {
        for (int k = (int)ceil(f->period / longest); k <= (int)floor(f->period / shortest); k++) {
            double phase = uniform(&state);
            for (size_t i = 0; i < FLANK_POINTS; i++)
                f->height[g][i] += cos(2 * pi * (phase + (double)k * (double)i / FLANK_POINTS)) / k;
        }
        set_rq(f, g, rq);
    }
}

void flank_sine(flank *f, double amplitude, double length)
{
    flat(f, 4 * length);
    for (size_t i = 0; i < FLANK_POINTS; i++)
        f->height[0][i] = amplitude * sin(2 * pi * f->position[i] / length);
    f->rq[0] = amplitude / sqrt(2);
}

void flank_give(const flank *f, stage *film)
{
    stage_set(film, "roughness_cutoff", 0);
    stage_give_series(film, "surface.position", FLANK_POINTS, f->position);
    stage_give_series(film, "surface.height_1", FLANK_POINTS, f->height[0]);
    stage_give_series(film, "surface.height_2", FLANK_POINTS, f->height[1]);
    stage_give_scalar(film, "surface.rq_1", f->rq[0]);
    stage_give_scalar(film, "surface.rq_2", f->rq[1]);
    stage_give_scalar(film, "surface.period", f->period);
    stage_give_scalar(film, "surface.origin", f->origin);
}
