/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-variation.h"

#include "../../numerics/integrator.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The motion and, behind it, the columns. */
enum { COLUMNS = DYNAMICS_COUPLED_SIZE, SIZE = COLUMNS + DYNAMICS_TAKEN * DYNAMICS_TAKEN };

struct dynamics_variation {
    dynamics_field *field;
    numerics_integrator gsl;
    gsl_odeiv2_system system;
    double state[SIZE];
};

/* Per column (x, v): x' = v, and v' is the Jacobian times the column. */
static int slope(double t, const double state[], double rate[], void *self)
{
    double jacobian[DYNAMICS_COORDINATES][DYNAMICS_TAKEN];
    int status = dynamics_field_slope(t, state, rate, self);
    dynamics_field_jacobian(self, t, state, jacobian);
    for (int k = 0; k < DYNAMICS_TAKEN; k++) {
        const double *column = state + COLUMNS + k * DYNAMICS_TAKEN;
        double *change = rate + COLUMNS + k * DYNAMICS_TAKEN;
        memcpy(change, column + DYNAMICS_RATES, DYNAMICS_COORDINATES * sizeof *change);
        for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
            double sum = 0;
            for (int j = 0; j < DYNAMICS_TAKEN; j++)
                sum += jacobian[i][j] * column[j];
            change[DYNAMICS_RATES + i] = sum;
        }
    }
    return status;
}

dynamics_variation *dynamics_variation_new(dynamics_field *field)
{
    dynamics_variation *v = calloc(1, sizeof *v);
    if (!v)
        return NULL;
    v->field = field;
    v->system = (gsl_odeiv2_system){slope, NULL, SIZE, field};
    if (numerics_integrator_make(&v->gsl, SIZE, 1, 0))
        return v;
    free(v);
    return NULL;
}

void dynamics_variation_free(dynamics_variation *v)
{
    if (!v)
        return;
    numerics_integrator_free(&v->gsl);
    free(v);
}

void dynamics_variation_start(dynamics_variation *v)
{
    for (int k = 0; k < DYNAMICS_TAKEN; k++)
        for (int i = 0; i < DYNAMICS_TAKEN; i++)
            v->state[COLUMNS + k * DYNAMICS_TAKEN + i] = i == k;
}

const double *dynamics_variation_columns(const dynamics_variation *v)
{
    return v->state + COLUMNS;
}

void dynamics_variation_step(dynamics_variation *v, double t, double h, const double *y)
{
    double error[SIZE];
    memcpy(v->state, y, COLUMNS * sizeof *y);
    if (gsl_odeiv2_step_apply(v->gsl.step, t, h, v->state, error, NULL, NULL, &v->system))
        v->state[COLUMNS] = NAN;
}

/* A start that reaches the gate by dt later moves on by dt at the slope before the gate in place of
   that behind it, and dt is -(slope of the gate . column)/(rate of the gate along the motion)
   (the saltation matrix: Leine & Nijmeijer 2004, Dynamics and Bifurcations of Non-Smooth Mechanical
   Systems, ch. 7). Where a clipped damper lets go, or takes hold again, the force of the flanks is
   0 on both sides. */
void dynamics_variation_pass_gate(dynamics_variation *v, int gate, double t, const double *y)
{
    double before[COLUMNS], behind[COLUMNS], by_state[DYNAMICS_TAKEN];
    if (gate >= DYNAMICS_PRESS && gate < DYNAMICS_COMES) {
        dynamics_field_pass_gate(v->field, gate);
        return;
    }
    double rate = dynamics_field_gate_slope(v->field, gate, t, y, by_state);
    dynamics_field_slope(t, y, before, v->field);
    dynamics_field_pass_gate(v->field, gate);
    dynamics_field_slope(t, y, behind, v->field);
    for (int i = 0; i < DYNAMICS_TAKEN; i++)
        rate += by_state[i] * before[i];
    if (rate == 0)
        return;
    for (int k = 0; k < DYNAMICS_TAKEN; k++) {
        double *column = v->state + COLUMNS + k * DYNAMICS_TAKEN, sooner = 0;
        for (int i = 0; i < DYNAMICS_TAKEN; i++)
            sooner += by_state[i] * column[i] / rate;
        for (int i = 0; i < DYNAMICS_TAKEN; i++)
            column[i] += (behind[i] - before[i]) * sooner;
    }
}

/* The impulse 2 zeta leap g_q g acts along the gradient g of the overlap, which turns with the
   coordinates; g_q does not change. */
void dynamics_variation_leap(dynamics_variation *v, int flank, double leap,
                             const dynamics_place *place)
{
    const dynamics_coupled *pair = v->field->pair;
    int side = flank == DYNAMICS_DRIVING ? 1 : flank == DYNAMICS_BACK ? -1 : 0;
    dynamics_bend bend = dynamics_coupled_bend(place, side);
    double impulse = 2 * pair->excitation->zeta * leap * (side < 0 ? -1 : 1);
    for (int k = 0; k < DYNAMICS_TAKEN; k++) {
        double *column = v->state + COLUMNS + k * DYNAMICS_TAKEN, turned[DYNAMICS_COORDINATES];
        dynamics_bend_apply(&bend, column, turned);
        for (int i = DYNAMICS_X1; i < DYNAMICS_COORDINATES; i++)
            column[DYNAMICS_RATES + i] += impulse * turned[i] / pair->mass[i >= DYNAMICS_X2];
    }
}
