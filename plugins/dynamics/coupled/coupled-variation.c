/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-variation.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ORDER: largest order of the Taylor series of a step. WIDE: length of a row, padded to whole SIMD
   vectors. */
enum { N = DYNAMICS_TAKEN, ORDER = 20, NODES = 3, WIDE = 12 };

struct dynamics_variation {
    dynamics_field *field;
    double negligible;   /* the series of a step ends at a term whose derivatives are all below
                            this */
    double matrix[N][N]; /* derivatives of the state with respect to the start, one row per
                            component */
};

dynamics_variation *dynamics_variation_new(dynamics_field *field, double negligible)
{
    dynamics_variation *v = calloc(1, sizeof *v);
    if (!v)
        return NULL;
    v->field = field;
    v->negligible = negligible;
    return v;
}

void dynamics_variation_free(dynamics_variation *v)
{
    free(v);
}

void dynamics_variation_start(dynamics_variation *v)
{
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++)
            v->matrix[i][k] = i == k;
}

const double *dynamics_variation_matrix(const dynamics_variation *v)
{
    return v->matrix[0];
}

/* The mesh force depends on six numbers of a state: q, the position of gear 2 relative to gear 1
   along the line of centres and across it, and their rates. The forces on gear 1 and gear 2 are
   opposite. */
enum { SEEN = 3 };
static const int seen[SEEN] = {DYNAMICS_Q, DYNAMICS_X2, DYNAMICS_Y2},
                 against[SEEN] = {-1, DYNAMICS_X1, DYNAMICS_Y1};

/* Derivatives of the mesh force on q and on gear 2 with respect to these six numbers: polynomials
   in the fraction of the step. */
typedef struct mesh_powers {
    double at[NODES][SEEN][2 * SEEN];
    int count; /* number of coefficients; 1: nearly constant */
} mesh_powers;

/* Extracts the derivatives of the mesh force from those of the accelerations. */
static void find_mesh(const dynamics_field *field, double t, const double *state,
                      double mesh[SEEN][2 * SEEN])
{
    const dynamics_coupled *pair = field->pair;
    double jacobian[DYNAMICS_COORDINATES][N];
    dynamics_field_jacobian(field, t, state, jacobian);
    for (int i = 0; i < SEEN; i++) {
        double mass = i ? pair->mass[1] : 1;
        for (int j = 0; j < SEEN; j++) {
            mesh[i][j] = mass * jacobian[seen[i]][seen[j]] + (i && i == j ? pair->bearing[1] : 0);
            mesh[i][SEEN + j] = mass * jacobian[seen[i]][DYNAMICS_RATES + seen[j]] +
                                (i && i == j ? pair->damper[1] : 0);
        }
    }
}

/* Fits polynomials of degree 2 at the three Gauss nodes, so that the error of their moments is of
   order h^6. */
static void find_powers(const dynamics_field *field, double t, double h, const double *from,
                        const double *to, double negligible, mesh_powers *power)
{
    static const double gauss = 0.38729833462074169; /* sqrt(15)/10 */
    double at[NODES][SEEN][2 * SEEN], varies = 0;
    dynamics_course course;
    dynamics_course_find(field, t, h, from, to, &course);
    for (int n = 0; n < NODES; n++) {
        double x = 0.5 + (n - 1) * gauss, state[DYNAMICS_COUPLED_SIZE];
        dynamics_course_state(&course, x, state);
        find_mesh(field, t + x * h, state, at[n]);
    }
    for (int i = 0; i < SEEN; i++)
        for (int j = 0; j < 2 * SEEN; j++) {
            double slope = (at[2][i][j] - at[0][i][j]) / (2 * gauss);
            double bend = (at[0][i][j] - 2 * at[1][i][j] + at[2][i][j]) / (2 * gauss * gauss);
            power->at[0][i][j] = at[1][i][j] - 0.5 * slope + 0.25 * bend;
            power->at[1][i][j] = slope - bend;
            power->at[2][i][j] = bend;
            varies = fmax(varies, fmax(fabs(slope), fabs(bend)));
        }
    power->count = h * varies > negligible ? NODES : 1;
}

/* The terms of the series for all columns, and the six numbers of each term on which the mesh force
   depends. */
typedef struct series {
    double term[ORDER + 1][N][WIDE], seen[ORDER + 1][2 * SEEN][WIDE];
} series;

FF_SIMD static void see(int n, series *s)
{
    for (int i = 0; i < 2 * SEEN; i++) {
        int rate = i < SEEN ? 0 : DYNAMICS_RATES, other = against[i % SEEN];
        const double *row = s->term[n][rate + seen[i % SEEN]];
        const double *less = s->term[n][rate + (other < 0 ? 0 : other)];
        double sign = other < 0 ? 0 : 1;
        FF_SIMD_LOOP
        for (int k = 0; k < WIDE; k++)
            s->seen[n][i][k] = row[k] - sign * less[k];
    }
}

/* Computes term n + 1 of the series from the previous terms, for each column (x, v): x' = v, and v'
   is the force of mesh and bearings. Returns the largest absolute value of the term. */
FF_SIMD static double next_term(int n, double h, const dynamics_coupled *pair,
                                const mesh_powers *power, series *s)
{
    double step = h / (n + 1), push[SEEN][WIDE], size[WIDE] = {0}, largest = 0;
    for (int i = 0; i < SEEN; i++) {
        double sum[WIDE] = {0};
        for (int m = 0; m < power->count && m <= n; m++)
            for (int j = 0; j < 2 * SEEN; j++) {
                double by = power->at[m][i][j];
                const double *row = s->seen[n - m][j];
                for (int k = 0; k < WIDE; k++)
                    sum[k] += by * row[k];
            }
        memcpy(push[i], sum, sizeof sum);
    }
    for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
        int gear = i >= DYNAMICS_X2, on = i ? 1 + (i - DYNAMICS_X1) % 2 : 0;
        double turns = i == DYNAMICS_Q || gear ? 1 : -1, by = i ? step / pair->mass[gear] : step;
        double k_b = i ? pair->bearing[gear] : 0, c_b = i ? pair->damper[gear] : 0;
        const double *at = s->term[n][i], *rate = s->term[n][DYNAMICS_RATES + i];
        double *x = s->term[n + 1][i], *v = s->term[n + 1][DYNAMICS_RATES + i];
        FF_SIMD_LOOP
        for (int k = 0; k < WIDE; k++) {
            x[k] = step * rate[k];
            v[k] = by * (turns * push[on][k] - k_b * at[k] - c_b * rate[k]);
            double more = fabs(x[k]) > fabs(v[k]) ? fabs(x[k]) : fabs(v[k]);
            size[k] = more > size[k] ? more : size[k];
        }
    }
    for (int k = 0; k < WIDE; k++)
        largest = fmax(largest, size[k]);
    return largest;
}

void dynamics_variation_step(dynamics_variation *v, double t, double h, const double *from,
                             const double *to)
{
    mesh_powers power;
    series s;
    int last = 0;
    find_powers(v->field, t, h, from, to, v->negligible, &power);
    memset(s.term[0], 0, sizeof s.term[0]);
    for (int i = 0; i < N; i++)
        memcpy(s.term[0][i], v->matrix[i], sizeof v->matrix[i]);
    for (double size = 1; last < ORDER && size > v->negligible; last++) {
        see(last, &s);
        size = next_term(last, h, v->field->pair, &power, &s);
    }
    for (int n = last; n > 0; n--)
        for (int i = 0; i < N; i++)
            for (int k = 0; k < N; k++)
                v->matrix[i][k] += s.term[n][i][k];
}

/* Multiplies the derivatives by the saltation matrix at a gate (Leine & Nijmeijer 2004, Dynamics
   and Bifurcations of Non-Smooth Mechanical Systems, ch. 7). A start state that reaches the gate
   later by dt moves for dt with the rates before the gate instead of those after it, with dt =
   -(slope of the gate . column)/(rate of the gate along the motion). Where a clipped damper begins
   or ends to act, the flank force is 0 on both sides and nothing changes. */
void dynamics_variation_pass_gate(dynamics_variation *v, int gate, double t, const double *y)
{
    double before[DYNAMICS_COUPLED_SIZE], behind[DYNAMICS_COUPLED_SIZE], by_state[N];
    if (gate >= DYNAMICS_PRESS && gate < DYNAMICS_COMES) {
        dynamics_field_pass_gate(v->field, gate);
        return;
    }
    double rate = dynamics_field_gate_slope(v->field, gate, t, y, by_state);
    dynamics_field_slope(t, y, before, v->field);
    dynamics_field_pass_gate(v->field, gate);
    dynamics_field_slope(t, y, behind, v->field);
    for (int i = 0; i < N; i++)
        rate += by_state[i] * before[i];
    if (rate == 0)
        return;
    double sooner[N] = {0};
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++)
            sooner[k] += by_state[i] * v->matrix[i][k] / rate;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < N; k++)
            v->matrix[i][k] += (behind[i] - before[i]) * sooner[k];
}

/* Adds the impulse of a jump of e. The impulse 2 zeta leap g_q g acts along the gradient g of the
   overlap, whose direction depends on the coordinates; g_q is constant. */
void dynamics_variation_leap(dynamics_variation *v, int flank, double leap,
                             const dynamics_place *place)
{
    const dynamics_coupled *pair = v->field->pair;
    int side = flank == DYNAMICS_DRIVING ? 1 : flank == DYNAMICS_BACK ? -1 : 0;
    dynamics_bend bend = dynamics_coupled_bend(place, side);
    double impulse = 2 * pair->excitation->zeta * leap * (side < 0 ? -1 : 1);
    for (int k = 0; k < N; k++) {
        double column[DYNAMICS_COORDINATES], turned[DYNAMICS_COORDINATES];
        for (int i = 0; i < DYNAMICS_COORDINATES; i++)
            column[i] = v->matrix[i][k];
        dynamics_bend_apply(&bend, column, turned);
        for (int i = DYNAMICS_X1; i < DYNAMICS_COORDINATES; i++)
            v->matrix[DYNAMICS_RATES + i][k] += impulse * turned[i] / pair->mass[i >= DYNAMICS_X2];
    }
}
