/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law's calls in a real run, each between guards. */
#include "guarded.h"
#include "slope.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

__attribute__((format(printf, 2, 3))) static void blame(const law_watch *watch, const char *format,
                                                        ...)
{
    char text[240];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    watch->blame(watch->ctx, text);
}

/* The arguments and results of the caller, and those that the law sees. */
typedef struct passage {
    const law_kernel *kernel;
    size_t n;
    const double *const *in;
    double *const *out;
    guarded theirs[KERNEL_AXES], results[KERNEL_RESULTS];
} passage;

static bool is_finite(const double *data, size_t n, size_t *at)
{
    for (*at = 0; data && *at < n; ++*at)
        if (!isfinite(data[*at]))
            return false;
    return true;
}

static void check_writes(const law_watch *watch, const passage *p)
{
    const law_kernel *kernel = p->kernel;
    for (size_t i = 0; i < kernel->axis_count; i++)
        if (p->in[i] && p->n &&
            (!guarded_whole(&p->theirs[i]) ||
             memcmp(p->theirs[i].data, p->in[i], p->n * sizeof(double)) != 0))
            blame(watch, "changed the argument \"%s\" of %s", kernel->axes[i].name, kernel->name);
    for (size_t i = 0; i < kernel->result_count; i++)
        if (p->out[i] && !guarded_whole(&p->results[i]))
            blame(watch, "wrote outside the array \"%s\" of %zu points in %s", kernel->results[i],
                  p->n, kernel->name);
}

static void check_numbers(const law_watch *watch, const passage *p, double speed)
{
    const law_kernel *kernel = p->kernel;
    size_t at;
    for (size_t i = 0; i < kernel->axis_count; i++)
        if (!is_finite(p->in[i], p->n, &at))
            return; /* asked for a point that is none */
    for (size_t i = 0; i < kernel->result_count && isfinite(speed); i++)
        if (p->out[i] && !is_finite(p->results[i].data, p->n, &at))
            blame(watch, "gave %s = %g in %s at %s = %g", kernel->results[i],
                  p->results[i].data[at], kernel->name, kernel->axes[0].name,
                  p->in[0] ? p->in[0][at] : 0.0);
}

/* 1: some slope at point k could be compared. */
static int check_slopes_at(const law_watch *watch, const passage *p, double speed, size_t k)
{
    const law_kernel *kernel = p->kernel;
    int compared = 0;
    line l = {.kernel = kernel, .table = watch->law, .speed = speed};
    for (size_t i = 0; i < kernel->axis_count; i++) {
        l.absent[i] = !p->in[i];
        l.point[i] = p->in[i] ? p->in[i][k] : 0;
    }
    for (size_t i = 1; i < kernel->result_count; i++) {
        const axis_row *axis = &kernel->axes[kernel->by[i]];
        l.axis = kernel->by[i];
        double x = l.point[l.axis], h = 0.02 * (axis->logarithmic ? x : 10), found;
        if (!p->out[i] || l.absent[l.axis] || !(x >= axis->low && x <= axis->high))
            continue; /* where laws are continued they may have kinks */
        compared = 1;
        if (slope_compare(&l, p->results[i].data[k], h, &found) == 1 &&
            slope_compare(&l, p->results[i].data[k], h / 8, &found) == 1)
            blame(watch, "gave %s = %.9g in %s at %s = %g, but differences of %s give %.9g",
                  kernel->results[i], p->results[i].data[k], kernel->name, kernel->axes[0].name,
                  l.point[0], kernel->results[0], found);
    }
    return compared;
}

/* One point of the call, another in each: the batch's size and its first argument choose where the
   search for one begins; most of a film's points may be dry. */
static void check_slopes(const law_watch *watch, const passage *p, double speed)
{
    enum { TRIES = 16 };
    uint64_t bits = p->n;
    if (p->n == 0 || !p->in[0])
        return;
    memcpy(&bits, &p->in[0][p->n / 2], sizeof bits);
    size_t first = (size_t)((bits >> 12) ^ bits) % p->n, stride = p->n / TRIES + 1;
    for (size_t i = 0; i < TRIES; i++)
        if (check_slopes_at(watch, p, speed, (first + i * stride) % p->n))
            return;
}

ff_status law_watched(const law_watch *watch, size_t index, size_t n, const double *const *in,
                      double speed, double *const *out)
{
    const law_kernel *kernel = &law_kernels[index];
    passage p = {.kernel = kernel, .n = n, .in = in, .out = out};
    const double *arguments[KERNEL_AXES] = {NULL};
    double *results[KERNEL_RESULTS] = {NULL};
    for (size_t i = 0; i < kernel->axis_count; i++)
        if (in[i]) {
            p.theirs[i] = guarded_new(n);
            if (n)
                memcpy(p.theirs[i].data, in[i], n * sizeof(double));
            arguments[i] = p.theirs[i].data;
        }
    for (size_t i = 0; i < kernel->result_count; i++)
        if (out[i]) {
            p.results[i] = guarded_new(n);
            results[i] = p.results[i].data;
        }
    ff_status status = kernel->call(watch->law, n, arguments, speed, results);
    if (status != FF_OK && status != FF_DOMAIN)
        blame(watch, "gave the status %d in %s", (int)status, kernel->name);
    check_writes(watch, &p);
    check_numbers(watch, &p, speed);
    check_slopes(watch, &p, speed);
    for (size_t i = 0; i < kernel->result_count; i++) {
        if (out[i] && n)
            memcpy(out[i], p.results[i].data, n * sizeof(double));
        guarded_free(&p.results[i]);
    }
    for (size_t i = 0; i < kernel->axis_count; i++)
        guarded_free(&p.theirs[i]);
    return status;
}
