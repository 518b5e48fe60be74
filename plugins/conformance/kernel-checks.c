/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of the functions of a law. */
#include "guarded.h"
#include "kernel.h"
#include "slope.h"

#include <flankfilm/conformance.h>

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SETS = 4, POINTS = 257, MANY = 4096 };

/* Splitmix64. */
typedef struct random_state {
    uint64_t state;
} random_state;

static double uniform(random_state *random) /* [0, 1) */
{
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double now(void) /* s */
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* What the work of one check needs. */
typedef struct desk {
    const ff_bench *bench;
    random_state random;
} desk;

__attribute__((format(printf, 2, 3))) static bool faulty(const desk *s, const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    s->bench->fault(s->bench->ctx, text);
    return false;
}

static void say(const ff_bench *bench, const char *what, const char *name)
{
    char text[128];
    snprintf(text, sizeof text, "calling %s%s", name, what);
    bench->doing(bench->ctx, text);
}

static const ff_port *output_row(const ff_model *model, size_t index)
{
    return (const void *)((const char *)model->outputs + index * model->output_stride);
}

/* Arguments and results of one call. */
typedef struct batch {
    size_t n;
    guarded in[KERNEL_AXES], out[KERNEL_RESULTS];
} batch;

static batch batch_new(const law_kernel *kernel, size_t n)
{
    batch b = {.n = n};
    for (size_t i = 0; i < kernel->axis_count; i++)
        b.in[i] = guarded_new(n);
    for (size_t i = 0; i < kernel->result_count; i++)
        b.out[i] = guarded_new(n);
    return b;
}

static double draw(const axis_row *axis, random_state *random)
{
    double share = uniform(random);
    return axis->logarithmic ? axis->low * pow(axis->high / axis->low, share)
                             : axis->low + share * (axis->high - axis->low);
}

static batch batch_draw(const law_kernel *kernel, size_t n, random_state *random)
{
    batch b = batch_new(kernel, n);
    for (size_t i = 0; i < kernel->axis_count; i++)
        for (size_t k = 0; k < n; k++)
            b.in[i].data[k] = draw(&kernel->axes[i], random);
    return b;
}

/* What a call leaves out: NULL for the optional argument and for the derivatives. */
enum { WITH_OPTIONAL = 1, WITH_DERIVATIVES = 2, WITH_ALL = 3, CHOICES = 4 };

static ff_status call(const law_kernel *kernel, const void *table, const batch *b, double speed,
                      unsigned with)
{
    const double *in[KERNEL_AXES] = {NULL};
    double *out[KERNEL_RESULTS] = {NULL};
    for (size_t i = 0; i < kernel->axis_count; i++)
        in[i] = kernel->axes[i].optional && !(with & WITH_OPTIONAL) ? NULL : b->in[i].data;
    for (size_t i = 0; i < kernel->result_count; i++)
        out[i] = i && !(with & WITH_DERIVATIVES) ? NULL : b->out[i].data;
    return kernel->call(table, b->n, in, speed, out);
}

/* Calls `test` for each service function of a few instances, and each speed of the kernel. */
static void each(const ff_bench *bench,
                 bool (*test)(desk *, const law_kernel *, const void *, double))
{
    const ff_model *model = bench->model;
    desk s = {.bench = bench, .random = {42}};
    bool good = true;
    for (int set = 0; set < SETS && good; set++) {
        void *instance = bench->open(bench->ctx);
        if (!instance)
            return;
        for (size_t i = 0; i < model->output_count && good; i++) {
            const char *id = output_row(model, i)->service;
            bool ours = id && !strcmp(id, law_kernels[0].service);
            const void *table = ours ? bench->service(bench->ctx, instance, (uint32_t)i) : NULL;
            if (ours && !table)
                good = faulty(&s, "service gave no table for \"%s\"", output_row(model, i)->name);
            for (size_t k = 0; k < law_kernel_count && table; k++)
                for (size_t v = 0; v < law_kernels[k].speed_count && good; v++) {
                    say(bench, "", law_kernels[k].name);
                    good = test(&s, &law_kernels[k], table, law_kernels[k].speeds[v]);
                }
        }
        bench->close(bench->ctx, instance);
    }
}

static bool check_status(desk *s, const law_kernel *kernel, ff_status status)
{
    return status == FF_OK || status == FF_DOMAIN ||
           faulty(s, "%s gave the status %d; only FF_OK and FF_DOMAIN are legal", kernel->name,
                  status);
}

static bool check_guards(desk *s, const law_kernel *kernel, const batch *b)
{
    for (size_t i = 0; i < kernel->axis_count; i++)
        if (!guarded_whole(&b->in[i]))
            return faulty(s, "%s wrote outside the array \"%s\" of %zu points", kernel->name,
                          kernel->axes[i].name, b->n);
    for (size_t i = 0; i < kernel->result_count; i++)
        if (!guarded_whole(&b->out[i]))
            return faulty(s, "%s wrote outside the array \"%s\" of %zu points", kernel->name,
                          kernel->results[i], b->n);
    return true;
}

static bool empty(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    const double *const in[KERNEL_AXES] = {NULL};
    double *const out[KERNEL_RESULTS] = {NULL};
    say(s->bench, " with 0 points", kernel->name);
    return check_status(s, kernel, kernel->call(table, 0, in, speed, out));
}

void law_empty(const ff_bench *bench)
{
    each(bench, empty);
}

/* Vector code may round differently from scalar code. */
static bool agree(double a, double b)
{
    return a == b || fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b)) || (isnan(a) && isnan(b));
}

static bool batches(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    batch all = batch_draw(kernel, POINTS, &s->random), one = batch_new(kernel, 1);
    bool good = true;
    for (unsigned with = 0; with < CHOICES && good; with++) {
        good = check_status(s, kernel, call(kernel, table, &all, speed, with | WITH_DERIVATIVES));
        for (size_t k = 0; k < all.n && good; k++) {
            for (size_t i = 0; i < kernel->axis_count; i++)
                one.in[i].data[0] = all.in[i].data[k];
            call(kernel, table, &one, speed, with);
            for (size_t i = 0; i < (with & WITH_DERIVATIVES ? kernel->result_count : 1); i++)
                if (good && !agree(one.out[i].data[0], all.out[i].data[k]))
                    good = faulty(s, "%s: %s is %.17g in a batch of %zu points, but %.17g alone",
                                  kernel->name, kernel->results[i], all.out[i].data[k], all.n,
                                  one.out[i].data[0]);
        }
    }
    return good;
}

void law_batch(const ff_bench *bench)
{
    each(bench, batches);
}

static bool guards(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    bool good = true;
    for (size_t n = 1; n < 20 && good; n++) {
        random_state again = s->random;
        batch b = batch_draw(kernel, n, &s->random), copy = batch_draw(kernel, n, &again);
        for (unsigned with = 0; with < CHOICES && good; with++) {
            good = check_status(s, kernel, call(kernel, table, &b, speed, with)) &&
                   check_guards(s, kernel, &b);
            for (size_t i = 0; i < kernel->axis_count && good; i++)
                if (memcmp(b.in[i].data, copy.in[i].data, n * sizeof(double)) != 0)
                    good = faulty(s, "%s changed its argument \"%s\"", kernel->name,
                                  kernel->axes[i].name);
        }
    }
    return good;
}

void law_guards(const ff_bench *bench)
{
    each(bench, guards);
}

static bool check_finite(desk *s, const law_kernel *kernel, const batch *b, double speed)
{
    for (size_t i = 0; i < kernel->result_count; i++)
        for (size_t k = 0; k < b->n; k++)
            if (!isfinite(b->out[i].data[k]))
                return faulty(s, "%s: %s is %g at %s = %g, %s = %g, scalar %g", kernel->name,
                              kernel->results[i], b->out[i].data[k], kernel->axes[0].name,
                              b->in[0].data[k], kernel->axes[1].name, b->in[1].data[k], speed);
    return true;
}

/* Every combination of extremes, and points between. */
static bool extremes(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    size_t corners = 1;
    for (size_t i = 0; i < kernel->axis_count; i++)
        corners *= kernel->axes[i].extreme_count;
    batch b = batch_draw(kernel, corners + MANY, &s->random);
    for (size_t k = 0; k < corners; k++) {
        size_t rest = k;
        for (size_t i = 0; i < kernel->axis_count; i++) {
            b.in[i].data[k] = kernel->axes[i].extremes[rest % kernel->axes[i].extreme_count];
            rest /= kernel->axes[i].extreme_count;
        }
    }
    bool good = true;
    for (unsigned with = 0; with <= WITH_OPTIONAL && good; with++)
        good = check_status(s, kernel,
                            call(kernel, table, &b, speed * 1e3, with | WITH_DERIVATIVES)) &&
               check_finite(s, kernel, &b, speed * 1e3);
    return good;
}

void law_finite(const ff_bench *bench)
{
    each(bench, extremes);
}

static bool derivatives(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    for (int k = 0; k < POINTS; k++)
        for (size_t i = 1; i < kernel->result_count; i++) {
            line l = {.kernel = kernel, .table = table, .speed = speed, .axis = kernel->by[i]};
            const axis_row *axis = &kernel->axes[l.axis];
            double out[KERNEL_RESULTS], found;
            for (size_t j = 0; j < kernel->axis_count; j++)
                l.point[j] = draw(&kernel->axes[j], &s->random);
            double x = l.point[l.axis], h = 0.02 * (axis->logarithmic ? x : 10);
            slope_value(&l, x, out);
            /* twice, so that a kink in the reach of the first is no fault */
            if (slope_compare(&l, out[i], h, &found) == 1 &&
                slope_compare(&l, out[i], h / 8, &found) == 1)
                return faulty(s,
                              "%s: %s is %.9g at %s = %g, %s = %g, but differences of %s give "
                              "%.9g",
                              kernel->name, kernel->results[i], out[i], kernel->axes[0].name,
                              l.point[0], kernel->axes[1].name, l.point[1], kernel->results[0],
                              found);
        }
    return true;
}

void law_derivatives(const ff_bench *bench)
{
    each(bench, derivatives);
}

static bool check_rise(desk *s, const law_kernel *kernel, const batch *b)
{
    for (size_t k = 1; k < b->n && kernel->rising; k++) {
        double before = b->out[0].data[k - 1], after = b->out[0].data[k];
        if (after < before - 1e-12 * fabs(before))
            return faulty(s, "%s: %s falls from %.9g to %.9g while %s rises from %g to %g",
                          kernel->name, kernel->results[0], before, after, kernel->axes[0].name,
                          b->in[0].data[k - 1], b->in[0].data[k]);
    }
    return true;
}

static bool physics(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    batch b = batch_draw(kernel, POINTS, &s->random);
    const axis_row *first = &kernel->axes[0];
    for (size_t k = 0; k < b.n; k++) {
        double share = (double)k / (double)(b.n - 1);
        b.in[0].data[k] = first->low + share * (first->high - first->low);
        for (size_t i = 1; i < kernel->axis_count && kernel->rising; i++)
            b.in[i].data[k] = b.in[i].data[0];
    }
    bool good = check_status(s, kernel, call(kernel, table, &b, speed, WITH_ALL)) &&
                check_rise(s, kernel, &b);
    for (size_t k = 0; k < b.n && good; k++) {
        double value = b.out[0].data[k], sign = (speed > 0) - (speed < 0);
        if (kernel->positive && !(value > 0))
            good = faulty(s, "%s: %s is %g; it must be positive", kernel->name, kernel->results[0],
                          value);
        else if (kernel->follows_speed && (value > 0) - (value < 0) != sign)
            good = faulty(s, "%s: %s is %g at a sliding speed of %g; it has its sign", kernel->name,
                          kernel->results[0], value, speed);
    }
    return good;
}

void law_physics(const ff_bench *bench)
{
    each(bench, physics);
}

/* One thread's share of the work. */
typedef struct shift {
    const law_kernel *kernel;
    const void *table;
    double speed;
    batch work;
    const batch *expected;
    pthread_barrier_t *start;
    bool differs;
} shift;

static bool same(const law_kernel *kernel, const batch *a, const batch *b)
{
    for (size_t i = 0; i < kernel->result_count; i++)
        if (memcmp(a->out[i].data, b->out[i].data, a->n * sizeof(double)) != 0)
            return false;
    return true;
}

/* Long enough to be interrupted in the middle of calls where there is one processor only. */
static void *work(void *argument)
{
    shift *mine = argument;
    pthread_barrier_wait(mine->start);
    for (double end = now() + 0.02; now() < end && !mine->differs;) {
        call(mine->kernel, mine->table, &mine->work, mine->speed, WITH_ALL);
        mine->differs = !same(mine->kernel, &mine->work, mine->expected);
    }
    return NULL;
}

static bool purity(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    random_state seeds[] = {s->random, {7}}, again[] = {s->random, {7}};
    batch expected[2];
    shift shifts[2];
    pthread_t thread;
    pthread_barrier_t start;
    pthread_barrier_init(&start, NULL, 2);
    for (int i = 0; i < 2; i++) {
        expected[i] = batch_draw(kernel, MANY, &seeds[i]);
        call(kernel, table, &expected[i], speed, WITH_ALL);
        shifts[i] = (shift){.kernel = kernel,
                            .table = table,
                            .speed = speed,
                            .work = batch_draw(kernel, MANY, &again[i]),
                            .expected = &expected[i],
                            .start = &start};
    }
    call(kernel, table, &shifts[0].work, speed, WITH_ALL);
    bool good = same(kernel, &shifts[0].work, &expected[0]) ||
                faulty(s, "%s gives other answers to the same question", kernel->name);
    if (good && pthread_create(&thread, NULL, work, &shifts[1]) == 0) {
        work(&shifts[0]);
        pthread_join(thread, NULL);
        good = (!shifts[0].differs && !shifts[1].differs) ||
               faulty(s, "%s gives other answers while another thread calls it", kernel->name);
    }
    pthread_barrier_destroy(&start);
    return good;
}

/* Another instance, made later with other parameters, must not be felt. */
static bool apart(desk *s, const law_kernel *kernel, const void *table, double speed)
{
    random_state seed = s->random, again = s->random;
    batch before = batch_draw(kernel, POINTS, &seed), after = batch_draw(kernel, POINTS, &again);
    call(kernel, table, &before, speed, WITH_ALL);
    void *other = s->bench->open(s->bench->ctx);
    call(kernel, table, &after, speed, WITH_ALL);
    bool good = same(kernel, &before, &after) ||
                faulty(s, "%s gives other answers once another instance is there", kernel->name);
    s->bench->close(s->bench->ctx, other);
    return good;
}

void law_purity(const ff_bench *bench)
{
    each(bench, purity);
    each(bench, apart);
}
