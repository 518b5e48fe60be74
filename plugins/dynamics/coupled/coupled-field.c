/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-field.h"

#include "../excitation/spring.h"

#include <gsl/gsl_errno.h>

#include <math.h>
#include <string.h>

static const int side_of[DYNAMICS_FLANKS + 1] = {1, -1, 0};

double dynamics_field_phase(const dynamics_field *field, double t)
{
    return field->now->start + t / field->T;
}

int dynamics_field_damps(const dynamics_field *field, int flank)
{
    const dynamics_regime *r = &field->regime;
    if (flank < DYNAMICS_FLANKS)
        return r->touches[flank] && r->pressed[flank];
    return field->pair->excitation->damping == DYNAMICS_DAMPING_ALWAYS &&
           !r->touches[DYNAMICS_DRIVING] && !r->touches[DYNAMICS_BACK];
}

/* The mesh spring of a flank at the current position of the centres. A displacement of the centres
   changes the stiffness, which is kept at 0 or above. The force of the mounted pair is scaled in
   proportion to the stiffness. */
typedef struct mesh_spring {
    double slope, offset; /* slope and offset of the force as a line over the overlap */
    double by_stiffness;  /* derivative of the force with respect to the stiffness */
} mesh_spring;

/* Mesh stiffness at a phase: `mounted` for the mounted pair, `now` for the current position of the
   centres. */
typedef struct mesh_stiffness {
    double since, mounted, now;
} mesh_stiffness;

static mesh_stiffness stiffness_at(const dynamics_field *field, double phase,
                                   const dynamics_place *place)
{
    const dynamics_piece *piece = field->now->piece;
    double since = phase - piece->start, k = dynamics_piece_value(piece->k, piece->degree, since);
    double change = dynamics_coupled_stiffness_change(field->pair, place, phase,
                                                      field->regime.pairs, field->now->mounted);
    return (mesh_stiffness){since, k, fmax(k + change, 0)};
}

static mesh_spring spring_at(const dynamics_field *field, const mesh_stiffness *k, int flank,
                             double overlap)
{
    const dynamics_piece *piece = field->now->piece;
    if (!dynamics_spring_bends(piece) || !(k->mounted > 0))
        return (mesh_spring){k->now, 0, overlap};
    int band = field->regime.band[flank];
    double slope =
        dynamics_piece_value(dynamics_spring_slope(piece, band), piece->degree, k->since);
    double offset =
        band ? dynamics_piece_value(dynamics_spring_offset(piece, band), piece->degree, k->since)
             : 0;
    return (mesh_spring){k->now / k->mounted * slope, k->now / k->mounted * offset,
                         (slope * overlap - offset) / k->mounted};
}

static void add_force(dynamics_push *p, const dynamics_overlap *overlap, double normal)
{
    for (int i = 0; i < DYNAMICS_COORDINATES; i++)
        p->on[i] -= normal * overlap->gradient[i];
}

dynamics_push dynamics_field_push(const dynamics_field *field, double t, const double *y,
                                  const dynamics_place *place)
{
    const dynamics_coupled *pair = field->pair;
    const dynamics_piece *piece = field->now->piece;
    double phase = dynamics_field_phase(field, t), since = phase - piece->start;
    double c = 2 * pair->excitation->zeta;
    double e = dynamics_piece_value(piece->e, piece->degree, since);
    double e_rate = dynamics_piece_slope(piece->e, piece->degree, since) / field->T;
    const int *touches = field->regime.touches;
    mesh_stiffness k = {0};
    dynamics_push p = {0};
    if (touches[DYNAMICS_DRIVING] || touches[DYNAMICS_BACK])
        k = stiffness_at(field, phase, place);
    for (int i = 0; i < DYNAMICS_FLANKS; i++) {
        p.overlap[i] =
            dynamics_coupled_overlap(pair, place, side_of[i], y, y + DYNAMICS_RATES, e, e_rate);
        if (!touches[i])
            continue;
        mesh_spring spring = spring_at(field, &k, i, p.overlap[i].value);
        p.normal[i] = spring.slope * p.overlap[i].value + c * p.overlap[i].rate - spring.offset;
        if (dynamics_field_damps(field, i))
            add_force(&p, &p.overlap[i], p.normal[i]);
    }
    if (dynamics_field_damps(field, DYNAMICS_FLANKS)) {
        dynamics_overlap free =
            dynamics_coupled_overlap(pair, place, 0, y, y + DYNAMICS_RATES, e, e_rate);
        add_force(&p, &free, c * free.rate);
    }
    p.force = -p.on[DYNAMICS_Q];
    return p;
}

int dynamics_field_slope(double t, const double y[], double dydt[], void *self)
{
    const dynamics_field *field = self;
    const dynamics_coupled *pair = field->pair;
    dynamics_place place;
    dynamics_coupled_locate(pair, y, &place);
    dynamics_push p = dynamics_field_push(field, t, y, &place);
    const double *v = y + DYNAMICS_RATES;
    double *a = dydt + DYNAMICS_RATES;
    memcpy(dydt, v, DYNAMICS_COORDINATES * sizeof *v);
    a[DYNAMICS_Q] = pair->excitation->load + p.on[DYNAMICS_Q];
    dydt[DYNAMICS_TAKEN] = -p.on[DYNAMICS_Q] * v[DYNAMICS_Q];
    for (int i = DYNAMICS_X1; i <= DYNAMICS_Y2; i++) {
        int gear = i >= DYNAMICS_X2;
        double force = p.on[i] - pair->bearing[gear] * y[i] - pair->damper[gear] * v[i];
        a[i] = force / pair->mass[gear];
        dydt[DYNAMICS_TAKEN] -= force * v[i];
    }
    return isfinite(a[DYNAMICS_Q]) ? GSL_SUCCESS : GSL_EBADFUNC;
}

void dynamics_course_find(const dynamics_field *field, double t, double h, const double *from,
                          const double *to, dynamics_course *course)
{
    double slope_from[DYNAMICS_COUPLED_SIZE], slope_to[DYNAMICS_COUPLED_SIZE];
    dynamics_field_slope(t, from, slope_from, (void *)field);
    dynamics_field_slope(t + h, to, slope_to, (void *)field);
    course->h = h;
    for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
        int rate = DYNAMICS_RATES + i;
        double v = h * from[rate], a = h * h * slope_from[rate];
        double d = to[i] - from[i] - v - 0.5 * a, dv = h * to[rate] - v - a;
        double da = h * h * slope_to[rate] - a;
        course->power[0][i] = from[i];
        course->power[1][i] = v;
        course->power[2][i] = 0.5 * a;
        course->power[3][i] = 10 * d - 4 * dv + 0.5 * da;
        course->power[4][i] = 7 * dv - 15 * d - da;
        course->power[5][i] = 6 * d - 3 * dv + 0.5 * da;
    }
}

void dynamics_course_state(const dynamics_course *course, double share, double *state)
{
    for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
        double x = course->power[5][i], v = 5 * x;
        for (int n = 4; n >= 0; n--)
            x = course->power[n][i] + share * x;
        for (int n = 4; n >= 1; n--)
            v = n * course->power[n][i] + share * v;
        state[i] = x;
        state[DYNAMICS_RATES + i] = v / course->h;
    }
    state[DYNAMICS_TAKEN] = 0;
}

/* The normal force of a flank, or of the damper in the gap, with its derivatives. */
typedef struct normal_force {
    dynamics_overlap overlap;
    dynamics_bend bend; /* second derivatives of the overlap */
    double value, by_state[DYNAMICS_TAKEN];
} normal_force;

static normal_force normal_at(const dynamics_field *field, double t, const double *y,
                              const dynamics_place *place, int flank)
{
    const dynamics_coupled *pair = field->pair;
    const dynamics_piece *piece = field->now->piece;
    const double *v = y + DYNAMICS_RATES;
    double phase = dynamics_field_phase(field, t), since = phase - piece->start;
    double e = dynamics_piece_value(piece->e, piece->degree, since);
    double e_rate = dynamics_piece_slope(piece->e, piece->degree, since) / field->T;
    double c = 2 * pair->excitation->zeta, by_shift = 0;
    int side = side_of[flank];
    normal_force n = {.overlap = dynamics_coupled_overlap(pair, place, side, y, v, e, e_rate),
                      .bend = dynamics_coupled_bend(place, side)};
    mesh_spring spring = {0};
    if (side) {
        mesh_stiffness k = stiffness_at(field, phase, place);
        spring = spring_at(field, &k, flank, n.overlap.value);
    }
    if (spring.slope > 0)
        by_shift = dynamics_coupled_stiffness_slope(pair, place, phase, field->regime.pairs);
    n.value = spring.slope * n.overlap.value + c * n.overlap.rate - spring.offset;
    double turning[DYNAMICS_COORDINATES], shift[DYNAMICS_COORDINATES];
    dynamics_bend_apply(&n.bend, v, turning);
    dynamics_coupled_shift_slope(pair, place, shift, NULL);
    for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
        n.by_state[i] = spring.slope * n.overlap.gradient[i] +
                        by_shift * spring.by_stiffness * shift[i] + c * turning[i];
        n.by_state[DYNAMICS_RATES + i] = c * n.overlap.gradient[i];
    }
    return n;
}

static void add_normal(const normal_force *n, double jacobian[][DYNAMICS_TAKEN])
{
    double unit[DYNAMICS_COORDINATES], bent[DYNAMICS_COORDINATES];
    for (int k = 0; k < DYNAMICS_COORDINATES; k++) {
        for (int i = 0; i < DYNAMICS_COORDINATES; i++)
            unit[i] = i == k;
        dynamics_bend_apply(&n->bend, unit, bent);
        for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
            jacobian[i][k] -= n->by_state[k] * n->overlap.gradient[i] + n->value * bent[i];
            jacobian[i][DYNAMICS_RATES + k] -=
                n->by_state[DYNAMICS_RATES + k] * n->overlap.gradient[i];
        }
    }
}

void dynamics_field_jacobian(const dynamics_field *field, double t, const double *y,
                             double jacobian[DYNAMICS_COORDINATES][DYNAMICS_TAKEN])
{
    const dynamics_coupled *pair = field->pair;
    dynamics_place place;
    dynamics_coupled_locate(pair, y, &place);
    memset(jacobian, 0, DYNAMICS_COORDINATES * sizeof jacobian[0]);
    for (int flank = 0; flank <= DYNAMICS_FLANKS; flank++) {
        if (!dynamics_field_damps(field, flank))
            continue;
        normal_force n = normal_at(field, t, y, &place, flank);
        add_normal(&n, jacobian);
    }
    for (int i = DYNAMICS_X1; i <= DYNAMICS_Y2; i++) {
        int gear = i >= DYNAMICS_X2;
        jacobian[i][i] -= pair->bearing[gear];
        jacobian[i][DYNAMICS_RATES + i] -= pair->damper[gear];
        for (int k = 0; k < DYNAMICS_TAKEN; k++)
            jacobian[i][k] /= pair->mass[gear];
    }
}

void dynamics_field_find_bands(dynamics_field *field, double t, const double *overlap)
{
    const dynamics_piece *piece = field->now->piece;
    double since = dynamics_field_phase(field, t) - piece->start;
    for (int i = 0; i < DYNAMICS_FLANKS; i++)
        field->regime.band[i] = overlap[i] > 0 ? dynamics_spring_band(piece, since, overlap[i]) : 0;
}

/* Sets the gates at the two knees at the ends of the current band of a flank's spring. */
static void knee_gates(const dynamics_field *field, double t, int flank, double overlap,
                       double gate[DYNAMICS_GATES])
{
    const dynamics_piece *piece = field->now->piece;
    int band = field->regime.band[flank], bends = piece->lines && field->regime.touches[flank];
    double since = dynamics_field_phase(field, t) - piece->start;
    gate[DYNAMICS_FALLS + flank] =
        bends && band > 0 ? dynamics_spring_excess(piece, band, since, overlap) : 1;
    gate[DYNAMICS_RISES + flank] = bends && band + 1 < piece->lines
                                       ? -dynamics_spring_excess(piece, band + 1, since, overlap)
                                       : 1;
}

void dynamics_field_gates(const dynamics_field *field, double t, const double *y,
                          double gate[DYNAMICS_GATES])
{
    const dynamics_regime *r = &field->regime;
    dynamics_place place;
    dynamics_coupled_locate(field->pair, y, &place);
    dynamics_push p = dynamics_field_push(field, t, y, &place);
    double age = dynamics_field_phase(field, t) + place.shift;
    for (int i = 0; i < DYNAMICS_FLANKS; i++) {
        int touches = r->touches[i];
        int clipped = field->pair->excitation->damping == DYNAMICS_DAMPING_CLIPPED && touches;
        gate[DYNAMICS_TOUCH + i] = touches ? p.overlap[i].value : -p.overlap[i].value;
        gate[DYNAMICS_PRESS + i] = !clipped ? 1 : r->pressed[i] ? p.normal[i] : -p.normal[i];
        if (clipped && r->pressed[i])
            gate[DYNAMICS_TOUCH + i] = 1; /* the damper has stopped pulling before the flanks
                                             separate */
        knee_gates(field, t, i, p.overlap[i].value, gate);
    }
    gate[DYNAMICS_COMES] = place.entry - (age + r->pairs.youngest - 1);
    gate[DYNAMICS_GOES] = place.exit - (age + r->pairs.oldest);
}

double dynamics_field_gate_slope(const dynamics_field *field, int gate, double t, const double *y,
                                 double slope[DYNAMICS_TAKEN])
{
    dynamics_place place;
    double entry[DYNAMICS_COORDINATES];
    dynamics_coupled_locate(field->pair, y, &place);
    memset(slope, 0, DYNAMICS_TAKEN * sizeof *slope);
    if (gate < DYNAMICS_PRESS) {
        dynamics_overlap overlap = dynamics_field_push(field, t, y, &place).overlap[gate];
        double by_time = overlap.rate;
        memcpy(slope, overlap.gradient, sizeof overlap.gradient);
        for (int i = 0; i < DYNAMICS_COORDINATES; i++)
            by_time -= overlap.gradient[i] * y[DYNAMICS_RATES + i];
        return by_time;
    }
    dynamics_coupled_shift_slope(field->pair, &place, slope, entry);
    for (int i = 0; i < DYNAMICS_COORDINATES; i++)
        slope[i] = (gate == DYNAMICS_COMES ? entry[i] : 0) - slope[i];
    return -1 / field->T;
}

void dynamics_field_pass_gate(dynamics_field *field, int gate)
{
    dynamics_regime *r = &field->regime;
    if (gate == DYNAMICS_COMES) {
        r->pairs.youngest--;
    } else if (gate == DYNAMICS_GOES) {
        r->pairs.oldest--;
    } else if (gate >= DYNAMICS_RISES) {
        r->band[gate - DYNAMICS_RISES]++;
    } else if (gate >= DYNAMICS_FALLS) {
        r->band[gate - DYNAMICS_FALLS]--;
    } else if (gate >= DYNAMICS_PRESS) {
        r->pressed[gate - DYNAMICS_PRESS] = !r->pressed[gate - DYNAMICS_PRESS];
    } else {
        r->touches[gate] = !r->touches[gate];
        r->pressed[gate] = r->touches[gate];
        r->band[gate] = 0;
    }
}
