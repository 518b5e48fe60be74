/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL's explicit Runge-Kutta integrator of order 8, for dynamics models. */
#ifndef NUMERICS_INTEGRATOR_H
#define NUMERICS_INTEGRATOR_H

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

/* GSL exports this symbol but declares it in no header. */
extern const gsl_odeiv2_control_type *gsl_odeiv2_control_standard;

typedef struct numerics_integrator {
    gsl_odeiv2_step *step;
    gsl_odeiv2_control *control;
} numerics_integrator;

static inline void numerics_integrator_free(numerics_integrator *i)
{
    if (i->step)
        gsl_odeiv2_step_free(i->step);
    if (i->control)
        gsl_odeiv2_control_free(i->control);
    *i = (numerics_integrator){0};
}

/* Creates an integrator for this many components; the error of a step is limited to the sum of the
   relative and the absolute tolerance. Returns 0 if memory is short. Memory is checked first, since
   GSL's default handler would end the process, and gsl_odeiv2_control_standard_new would
   dereference NULL. */
static inline int numerics_integrator_make(numerics_integrator *i, size_t components,
                                           double absolute, double relative)
{
    gsl_set_error_handler_off();
    *i = (numerics_integrator){gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, components),
                               gsl_odeiv2_control_alloc(gsl_odeiv2_control_standard)};
    if (i->step && i->control &&
        gsl_odeiv2_control_init(i->control, absolute, relative, 1, 0) == GSL_SUCCESS)
        return 1;
    numerics_integrator_free(i);
    return 0;
}

#endif
