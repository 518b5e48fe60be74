/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of the services that a model offers. */
#include "subject.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

enum { SETS = 4, POINTS = 257, MANY = 4096 };

/* Arguments and results of one call. */
typedef struct batch {
    size_t n;
    ff_guarded in[FF_AXES], out[FF_RESULTS];
} batch;

static batch batch_new(const ff_kernel *kernel, size_t n)
{
    batch b = {.n = n};
    for (size_t i = 0; i < kernel->axis_count; i++)
        b.in[i] = ff_guarded_new(n);
    for (size_t i = 0; i < kernel->result_count; i++)
        b.out[i] = ff_guarded_new(n);
    return b;
}

static double draw(const ff_axis *axis, ff_random *random)
{
    double share = ff_uniform(random);
    return axis->logarithmic ? axis->low * pow(axis->high / axis->low, share)
                             : axis->low + share * (axis->high - axis->low);
}

static batch batch_draw(const ff_kernel *kernel, size_t n, ff_random *random)
{
    batch b = batch_new(kernel, n);
    for (size_t i = 0; i < kernel->axis_count; i++)
        for (size_t k = 0; k < n; k++)
            b.in[i].data[k] = draw(&kernel->axes[i], random);
    return b;
}

/* What a call leaves out: NULL for the optional argument and for the derivatives. */
enum { WITH_OPTIONAL = 1, WITH_DERIVATIVES = 2, WITH_ALL = 3, CHOICES = 4 };

static ff_status call(const ff_kernel *kernel, const void *table, const batch *b, double speed,
                      unsigned with)
{
    const double *in[FF_AXES] = {NULL};
    double *out[FF_RESULTS] = {NULL};
    for (size_t i = 0; i < kernel->axis_count; i++)
        in[i] = kernel->axes[i].optional && !(with & WITH_OPTIONAL) ? NULL : b->in[i].data;
    for (size_t i = 0; i < kernel->result_count; i++)
        out[i] = i && !(with & WITH_DERIVATIVES) ? NULL : b->out[i].data;
    return kernel->call(table, b->n, in, speed, out);
}

/* Calls `test` for each service function of a few instances, and each speed of the kernel. */
static bool each(ff_subject *s, bool (*test)(ff_subject *, const ff_kernel *, const void *, double))
{
    const ff_model *model = s->loaded->model;
    bool good = true;
    for (int set = 0; set < (s->given ? 1 : SETS) && good; set++) {
        ff_trial trial;
        ff_feed *feed = ff_find_feed(s, &trial);
        if (!feed)
            return false;
        for (size_t i = 0; i < model->output_count && good; i++) {
            const char *id = ff_model_output(model, i)->service;
            const void *table = id ? model->service(trial.self, (uint32_t)i) : NULL;
            if (id && !table)
                good = ff_faulty(s, "service gave no table for \"%s\"",
                                 ff_model_output(model, i)->name);
            for (size_t k = 0; k < ff_kernel_count && table; k++)
                for (size_t v = 0; v < ff_kernels[k].speed_count && good; v++) {
                    if (strcmp(ff_kernels[k].service, id) != 0)
                        break;
                    ff_doing(s, "calling %s", ff_kernels[k].name);
                    good = test(s, &ff_kernels[k], table, ff_kernels[k].speeds[v]);
                }
        }
        ff_trial_close(&trial);
    }
    return good;
}

static bool check_status(ff_subject *s, const ff_kernel *kernel, ff_status status)
{
    return status == FF_OK || status == FF_DOMAIN ||
           ff_faulty(s, "%s gave the status %d; only FF_OK and FF_DOMAIN are legal", kernel->name,
                     status);
}

static bool check_guards(ff_subject *s, const ff_kernel *kernel, const batch *b)
{
    for (size_t i = 0; i < kernel->axis_count; i++)
        if (!ff_guarded_whole(&b->in[i]))
            return ff_faulty(s, "%s wrote outside the array \"%s\" of %zu points", kernel->name,
                             kernel->axes[i].name, b->n);
    for (size_t i = 0; i < kernel->result_count; i++)
        if (!ff_guarded_whole(&b->out[i]))
            return ff_faulty(s, "%s wrote outside the array \"%s\" of %zu points", kernel->name,
                             kernel->results[i], b->n);
    return true;
}

static bool empty(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
{
    const double *const in[FF_AXES] = {NULL};
    double *const out[FF_RESULTS] = {NULL};
    ff_doing(s, "calling %s with 0 points", kernel->name);
    return check_status(s, kernel, kernel->call(table, 0, in, speed, out));
}

bool ff_test_empty(ff_subject *s)
{
    return each(s, empty);
}

/* Vector code may round differently from scalar code. */
static bool agree(double a, double b)
{
    return a == b || fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b)) || (isnan(a) && isnan(b));
}

static bool batches(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
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
                    good = ff_faulty(s, "%s: %s is %.17g in a batch of %zu points, but %.17g alone",
                                     kernel->name, kernel->results[i], all.out[i].data[k], all.n,
                                     one.out[i].data[0]);
        }
    }
    return good;
}

bool ff_test_batch(ff_subject *s)
{
    return each(s, batches);
}

static bool guards(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
{
    bool good = true;
    for (size_t n = 1; n < 20 && good; n++) {
        ff_random again = s->random;
        batch b = batch_draw(kernel, n, &s->random), copy = batch_draw(kernel, n, &again);
        for (unsigned with = 0; with < CHOICES && good; with++) {
            good = check_status(s, kernel, call(kernel, table, &b, speed, with)) &&
                   check_guards(s, kernel, &b);
            for (size_t i = 0; i < kernel->axis_count && good; i++)
                if (memcmp(b.in[i].data, copy.in[i].data, n * sizeof(double)) != 0)
                    good = ff_faulty(s, "%s changed its argument \"%s\"", kernel->name,
                                     kernel->axes[i].name);
        }
    }
    return good;
}

bool ff_test_guards(ff_subject *s)
{
    return each(s, guards);
}

static bool check_finite(ff_subject *s, const ff_kernel *kernel, const batch *b, double speed)
{
    for (size_t i = 0; i < kernel->result_count; i++)
        for (size_t k = 0; k < b->n; k++)
            if (!isfinite(b->out[i].data[k]))
                return ff_faulty(s, "%s: %s is %g at %s = %g, %s = %g, scalar %g", kernel->name,
                                 kernel->results[i], b->out[i].data[k], kernel->axes[0].name,
                                 b->in[0].data[k], kernel->axes[1].name, b->in[1].data[k], speed);
    return true;
}

/* Every combination of extremes, and points between. */
static bool extremes(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
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

bool ff_test_finite(ff_subject *s)
{
    return each(s, extremes);
}

/* The value of a kernel along one axis through a point. */
typedef struct line {
    const ff_kernel *kernel;
    const void *table;
    double speed, point[FF_AXES];
    size_t axis;
} line;

static double value_at(const line *l, double x, double out[FF_RESULTS])
{
    double point[FF_AXES];
    const double *in[FF_AXES];
    double *results[FF_RESULTS];
    memcpy(point, l->point, sizeof point);
    point[l->axis] = x;
    for (size_t i = 0; i < FF_AXES; i++)
        in[i] = &point[i];
    for (size_t i = 0; i < FF_RESULTS; i++)
        results[i] = &out[i];
    l->kernel->call(l->table, 1, in, l->speed, results);
    return out[0];
}

/* Ridders 1982, Adv. Eng. Software 4, 75-76: central differences extrapolated to h = 0; *error
   bounds what truncation and rounding leave. */
static double difference(const line *l, double x, double h, double *error)
{
    enum { ROWS = 8 };
    double table[ROWS][ROWS], best = 0, out[FF_RESULTS];
    *error = INFINITY;
    for (int row = 0; row < ROWS; row++, h /= 1.6) {
        double above = value_at(l, x + h, out), below = value_at(l, x - h, out), factor = 1;
        double rounding = 64 * DBL_EPSILON * fmax(fabs(above), fabs(below)) / h;
        table[row][0] = (above - below) / (2 * h);
        for (int i = 1; i <= row; i++) {
            factor *= 1.6 * 1.6;
            table[row][i] = (table[row][i - 1] * factor - table[row - 1][i - 1]) / (factor - 1);
            double gap = fmax(fabs(table[row][i] - table[row][i - 1]),
                              fabs(table[row][i] - table[row - 1][i - 1]));
            if (gap + rounding < *error) {
                *error = gap + rounding;
                best = table[row][i];
            }
        }
    }
    return best;
}

/* 0: agrees; 1: does not; 2: the differences are too rough to tell, as beside a kink. */
static int compare(const line *l, double claimed, double h, double *found)
{
    double error;
    *found = difference(l, l->point[l->axis], h, &error);
    double size = fmax(fabs(claimed), fabs(*found));
    if (!(4 * error < 3e-4 * size))
        return fabs(claimed - *found) <= 4 * error ? 0 : 2;
    return fabs(claimed - *found) <= 1e-4 * size + 4 * error ? 0 : 1;
}

static bool derivatives(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
{
    for (int k = 0; k < POINTS; k++)
        for (size_t i = 1; i < kernel->result_count; i++) {
            line l = {.kernel = kernel, .table = table, .speed = speed, .axis = kernel->by[i]};
            const ff_axis *axis = &kernel->axes[l.axis];
            double out[FF_RESULTS], found;
            for (size_t j = 0; j < kernel->axis_count; j++)
                l.point[j] = draw(&kernel->axes[j], &s->random);
            double x = l.point[l.axis], h = 0.02 * (axis->logarithmic ? x : 10);
            value_at(&l, x, out);
            /* twice, so that a kink in the reach of the first is no fault */
            if (compare(&l, out[i], h, &found) == 1 && compare(&l, out[i], h / 8, &found) == 1)
                return ff_faulty(s,
                                 "%s: %s is %.9g at %s = %g, %s = %g, but differences of %s give "
                                 "%.9g",
                                 kernel->name, kernel->results[i], out[i], kernel->axes[0].name,
                                 l.point[0], kernel->axes[1].name, l.point[1], kernel->results[0],
                                 found);
        }
    return true;
}

bool ff_test_derivatives(ff_subject *s)
{
    return each(s, derivatives);
}

static bool check_rise(ff_subject *s, const ff_kernel *kernel, const batch *b)
{
    for (size_t k = 1; k < b->n && kernel->rising; k++) {
        double before = b->out[0].data[k - 1], after = b->out[0].data[k];
        if (after < before - 1e-12 * fabs(before))
            return ff_faulty(s, "%s: %s falls from %.9g to %.9g while %s rises from %g to %g",
                             kernel->name, kernel->results[0], before, after, kernel->axes[0].name,
                             b->in[0].data[k - 1], b->in[0].data[k]);
    }
    return true;
}

static bool physics(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
{
    batch b = batch_draw(kernel, POINTS, &s->random);
    const ff_axis *first = &kernel->axes[0];
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
            good = ff_faulty(s, "%s: %s is %g; it must be positive", kernel->name,
                             kernel->results[0], value);
        else if (kernel->follows_speed && (value > 0) - (value < 0) != sign)
            good = ff_faulty(s, "%s: %s is %g at a sliding speed of %g; it has its sign",
                             kernel->name, kernel->results[0], value, speed);
    }
    return good;
}

bool ff_test_physics(ff_subject *s)
{
    return each(s, physics);
}

/* One thread's share of the work. */
typedef struct shift {
    const ff_kernel *kernel;
    const void *table;
    double speed;
    batch work;
    const batch *expected;
    pthread_barrier_t *start;
    bool differs;
} shift;

static bool same(const ff_kernel *kernel, const batch *a, const batch *b)
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
    for (double end = ff_now() + 0.02; ff_now() < end && !mine->differs;) {
        call(mine->kernel, mine->table, &mine->work, mine->speed, WITH_ALL);
        mine->differs = !same(mine->kernel, &mine->work, mine->expected);
    }
    return NULL;
}

static bool purity(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
{
    ff_random seeds[] = {s->random, {7}}, again[] = {s->random, {7}};
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
                ff_faulty(s, "%s gives other answers to the same question", kernel->name);
    if (good && pthread_create(&thread, NULL, work, &shifts[1]) == 0) {
        work(&shifts[0]);
        pthread_join(thread, NULL);
        good = (!shifts[0].differs && !shifts[1].differs) ||
               ff_faulty(s, "%s gives other answers while another thread calls it", kernel->name);
    }
    pthread_barrier_destroy(&start);
    return good;
}

/* Another instance, made later with other parameters, must not be felt. */
static bool apart(ff_subject *s, const ff_kernel *kernel, const void *table, double speed)
{
    ff_trial other;
    ff_random seed = s->random, again = s->random;
    batch before = batch_draw(kernel, POINTS, &seed), after = batch_draw(kernel, POINTS, &again);
    call(kernel, table, &before, speed, WITH_ALL);
    ff_feed *feed = ff_find_feed(s, &other);
    call(kernel, table, &after, speed, WITH_ALL);
    bool good = !feed || same(kernel, &before, &after) ||
                ff_faulty(s, "%s gives other answers once another instance is there", kernel->name);
    if (feed)
        ff_trial_close(&other);
    return good;
}

bool ff_test_purity(ff_subject *s)
{
    return each(s, purity) && each(s, apart);
}
