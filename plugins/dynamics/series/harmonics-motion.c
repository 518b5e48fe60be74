/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "harmonics-motion.h"

#include "../excitation/spring.h"
#include "harmonics.h"

#include <math.h>
#include <string.h>

/* Order of the Taylor series of a disturbance. With steps of at most 0.25 rad, the first neglected
   term, 0.25^15/15!, is below round-off. */
enum { TAYLOR = 14 };
static const double longest_step = 0.25;

/* Accuracy, in mesh cycles, to which a change of contact is located. */
static const double instant = 1e-14;

/* State of the integration through the mesh cycle. The motion is the Fourier series with the
   coefficients x. */
typedef struct walk {
    dynamics_motion *motion;
    const dynamics_piece *piece;
    const double *x;
    size_t harmonics;
} walk;

static double delta_at(const walk *w, double phase)
{
    double s, slope;
    dynamics_fourier_at(w->x, w->harmonics, 2 * M_PI * phase, &s, &slope);
    return s - dynamics_piece_value(w->piece->e, w->piece->degree, phase - w->piece->start);
}

/* A state of contact: the flank that touches (1: driving, -1: back, 0: none), and the band of the
   spring, the index of the line that gives its force (spring.h). */
typedef struct contact {
    int side, band;
} contact;

static contact contact_at(const walk *w, double phase)
{
    const dynamics_excitation *excitation = w->motion->excitation;
    double b = excitation->half_gap, delta = delta_at(w, phase);
    contact c = {.side = b == 0 ? 1 : (delta > b) - (delta < -b)};
    if (c.side)
        c.band = dynamics_spring_band(w->piece, phase - w->piece->start, delta - c.side * b);
    return c;
}

static int same_contact(contact a, contact z)
{
    return a.side == z.side && a.band == z.band;
}

/* Solves u'' + 2 zeta u' + (k_0 + k_1 t + ...) u = 0 over a step of h by its Taylor series. */
static void disturb(double zeta, const double *k, double h, double *u, double *u_rate)
{
    double c[TAYLOR + 1] = {*u, *u_rate}, power = h;
    *u += *u_rate * h;
    for (int j = 0; j + 2 <= TAYLOR; j++) {
        double force = 2 * zeta * (j + 1) * c[j + 1];
        for (int i = 0; i <= j && i <= DYNAMICS_DEGREE; i++)
            force += k[i] * c[j - i];
        c[j + 2] = -force / ((j + 1) * (j + 2));
        *u_rate += (j + 2) * c[j + 2] * power;
        power *= h;
        *u += c[j + 2] * power;
    }
}

/* Advances the disturbances and the times of contact (dynamics_clocks) over a stretch of the cycle
   with one state of contact. */
static void pass_stretch(const walk *w, double from, double to, contact c)
{
    dynamics_motion *motion = w->motion;
    double *m = motion->monodromy, T = motion->T, h = (to - from) * T;
    double k[DYNAMICS_DEGREE + 1] = {0};
    if (c.side)
        dynamics_piece_shift(dynamics_spring_slope(w->piece, c.band), w->piece->degree,
                             from - w->piece->start, 1 / T, k);
    disturb(motion->excitation->zeta, k, h, &m[0], &m[2]);
    disturb(motion->excitation->zeta, k, h, &m[1], &m[3]);
    motion->clocks.parted += c.side ? 0 : h;
    motion->clocks.back += c.side < 0 ? h : 0;
    motion->clocks.damped += h;
}

/* Advances over a stretch, divided into parts with one state of contact each. Changes of contact
   are located by bisection. */
static void pass_contact_changes(const walk *w, double from, double to, contact first, contact last)
{
    if (same_contact(first, last) || to - from < instant) {
        pass_stretch(w, from, to, first);
        return;
    }
    double middle = 0.5 * (from + to);
    contact between = contact_at(w, middle);
    pass_contact_changes(w, from, middle, first, between);
    pass_contact_changes(w, middle, to, between, last);
}

static void take_monodromy(walk *w, size_t parts)
{
    dynamics_motion *motion = w->motion;
    const dynamics_excitation *excitation = motion->excitation;
    motion->clocks = (dynamics_clocks){0};
    motion->monodromy[0] = motion->monodromy[3] = 1;
    motion->monodromy[1] = motion->monodromy[2] = 0;
    for (size_t i = 0; i < excitation->count; i++) {
        w->piece = &excitation->pieces[i];
        size_t count = (size_t)ceil(w->piece->length * (double)parts);
        double h = w->piece->length / (double)count;
        contact now = contact_at(w, w->piece->start);
        for (size_t k = 0; k < count; k++) {
            double from = w->piece->start + h * (double)k;
            contact next = contact_at(w, from + h);
            pass_contact_changes(w, from, from + h, now, next);
            now = next;
        }
    }
    dynamics_motion_check_determinant(motion);
}

static void add_sample(const walk *w, double phase)
{
    const dynamics_motion *motion = w->motion;
    const dynamics_piece *piece = w->piece;
    dynamics_record *record = &w->motion->record;
    double s, slope, since = phase - piece->start, turn = 2 * M_PI / motion->T;
    dynamics_fourier_at(w->x, w->harmonics, 2 * M_PI * phase, &s, &slope);
    record->samples[record->count++] = (dynamics_sample){
        .phase = (double)record->cycles + phase,
        .s = s,
        .s_rate = slope * turn,
        .force = dynamics_mesh_force(
            motion->excitation, piece, since,
            s - dynamics_piece_value(piece->e, piece->degree, since),
            slope * turn - dynamics_piece_slope(piece->e, piece->degree, since) / motion->T),
    };
}

/* Records one mesh cycle at equal steps. At a jump of the excitation there are two samples. */
static void record_cycle(walk *w)
{
    const dynamics_excitation *excitation = w->motion->excitation;
    dynamics_record *record = &w->motion->record;
    double n = (double)record->per_cycle;
    size_t next = 1;
    for (size_t i = 0; i < excitation->count; i++) {
        w->piece = &excitation->pieces[i];
        int final = i + 1 == excitation->count;
        double end = final ? 1 : w->piece->start + w->piece->length, node = end * n;
        if (w->piece->jump || (i == 0 && record->cycles == 0))
            add_sample(w, w->piece->start);
        for (; (double)next < node - 1e-9; next++)
            add_sample(w, (double)next / n);
        int on_grid = fabs((double)next - node) <= 1e-9;
        if (excitation->pieces[(i + 1) % excitation->count].jump || final || on_grid)
            add_sample(w, end);
        next += on_grid ? 1 : 0;
    }
    record->cycles++;
}

/* Returns the number of equal parts of the cycle at whose ends the contact is checked. */
static size_t parts_for(const dynamics_motion *motion, size_t harmonics)
{
    double stiffest = sqrt(fmax(motion->excitation->k_max, 1));
    size_t parts = 16 * harmonics, needed = (size_t)(stiffest * motion->T / longest_step) + 1;
    parts = parts < 1024 ? 1024 : parts;
    return parts < needed ? needed : parts;
}

ff_status dynamics_harmonics_motion(dynamics_motion *motion, const dynamics_inputs *inputs,
                                    const double *x, size_t harmonics, size_t per_cycle)
{
    size_t cycles = motion->cycles + dynamics_mesh_cycles_of_engagement(inputs);
    if (!dynamics_record_init(&motion->record, motion->excitation, per_cycle, cycles))
        return FF_NOMEM;
    walk w = {.motion = motion, .x = x, .harmonics = harmonics};
    take_monodromy(&w, parts_for(motion, harmonics));
    for (size_t i = 0; i < cycles; i++)
        record_cycle(&w);
    motion->energy_error = 0;
    return FF_OK;
}
