/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of the functions of a law. */
#include "law-checks.h"
#include "jump.h"
#include "slope.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
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

/* State of one check. */
typedef struct checking {
    const ff_fixture *fixture;
    random_state random;
} checking;

static void step(const ff_fixture *fixture, const char *what, const char *name)
{
    char text[128];
    snprintf(text, sizeof text, "calling %s%s", name, what);
    fixture->step(fixture->ctx, text);
}

static const ff_port *output_row(const ff_model *model, size_t index)
{
    return (const void *)((const char *)model->outputs + index * model->output_stride);
}

/* Arguments and results of one call. */
typedef struct batch {
    size_t n;
    double *in[CONFORMANCE_AXES], *out[CONFORMANCE_RESULTS]; /* between guard zones */
} batch;

static batch batch_new(const ff_fixture *fixture, const conformance_function *function, size_t n)
{
    batch b = {.n = n};
    for (size_t i = 0; i < function->axis_count; i++)
        b.in[i] = fixture->numbers(fixture->ctx, n);
    for (size_t i = 0; i < function->result_count; i++)
        b.out[i] = fixture->numbers(fixture->ctx, n);
    return b;
}

static double draw(const conformance_axis *axis, random_state *random)
{
    double share = uniform(random);
    return axis->logarithmic ? axis->low * pow(axis->high / axis->low, share)
                             : axis->low + share * (axis->high - axis->low);
}

static batch batch_draw(const ff_fixture *fixture, const conformance_function *function, size_t n,
                        random_state *random)
{
    batch b = batch_new(fixture, function, n);
    for (size_t i = 0; i < function->axis_count; i++)
        for (size_t k = 0; k < n; k++)
            b.in[i][k] = draw(function->axes[i], random);
    return b;
}

/* The arguments that a call passes; an argument left out is NULL. */
enum { WITH_OPTIONAL = 1, WITH_DERIVATIVES = 2, WITH_ALL = 3, CHOICES = 4 };

static ff_status call(const conformance_function *function, const void *table, const batch *b,
                      double speed, unsigned with)
{
    const double *in[CONFORMANCE_AXES] = {NULL};
    double *out[CONFORMANCE_RESULTS] = {NULL};
    for (size_t i = 0; i < function->axis_count; i++)
        in[i] = function->axes[i]->optional && !(with & WITH_OPTIONAL) ? NULL : b->in[i];
    for (size_t i = 0; i < function->result_count; i++)
        out[i] = i && !(with & WITH_DERIVATIVES) ? NULL : b->out[i];
    return function->call(table, b->n, in, speed, out);
}

/* A test of one function, given the service's table and one speed. */
typedef bool function_test(checking *, const conformance_function *, const void *, double);

/* Tests the functions of one service output. */
static bool test_output(checking *c, void *instance, uint32_t output, function_test *test)
{
    const ff_fixture *fixture = c->fixture;
    const ff_port *row = output_row(fixture->model, output);
    const void *table = NULL;
    bool good = true;
    for (size_t k = 0; k < conformance_function_count && good; k++) {
        const conformance_function *f = &conformance_functions[k];
        if (!row->service || strcmp(row->service, f->service) != 0)
            continue;
        table = table ? table : fixture->service(fixture->ctx, instance, output);
        if (!table)
            return ff_check_failf(fixture, "service gave no table for \"%s\"", row->name);
        if (*(const size_t *)table < f->size)
            return ff_check_failf(fixture,
                                  "the table for \"%s\" says a size of %zu bytes, but the table of "
                                  "the interface has %zu",
                                  row->name, *(const size_t *)table, f->size);
        for (size_t v = 0; v < f->speed_count && good; v++) {
            step(fixture, "", f->name);
            good = test(c, f, table, f->speeds[v]);
        }
    }
    return good;
}

/* Calls `test` for each service function of several instances, and for each speed of the
   function. */
static void for_each_function(const ff_fixture *fixture, function_test *test)
{
    const ff_model *model = fixture->model;
    checking c = {.fixture = fixture, .random = {42}};
    bool good = true;
    for (int set = 0; set < SETS && good; set++) {
        void *instance = fixture->open(fixture->ctx);
        if (!instance)
            return;
        for (size_t i = 0; i < model->output_count && good; i++)
            good = test_output(&c, instance, (uint32_t)i, test);
        fixture->close(fixture->ctx, instance);
    }
}

static bool check_status(checking *c, const conformance_function *function, ff_status status)
{
    return status == FF_OK || status == FF_DOMAIN ||
           ff_check_failf(c->fixture, "%s gave the status %d; only FF_OK and FF_DOMAIN are legal",
                          function->name, status);
}

static bool check_guards(checking *c, const conformance_function *function, const batch *b)
{
    for (size_t i = 0; i < function->axis_count; i++)
        if (!c->fixture->is_intact(c->fixture->ctx, b->in[i], b->n))
            return ff_check_failf(c->fixture, "%s wrote outside the array \"%s\" of %zu points",
                                  function->name, function->axes[i]->name, b->n);
    for (size_t i = 0; i < function->result_count; i++)
        if (!c->fixture->is_intact(c->fixture->ctx, b->out[i], b->n))
            return ff_check_failf(c->fixture, "%s wrote outside the array \"%s\" of %zu points",
                                  function->name, function->results[i], b->n);
    return true;
}

static bool empty(checking *c, const conformance_function *function, const void *table,
                  double speed)
{
    const double *const in[CONFORMANCE_AXES] = {NULL};
    double *const out[CONFORMANCE_RESULTS] = {NULL};
    step(c->fixture, " with 0 points", function->name);
    return check_status(c, function, function->call(table, 0, in, speed, out));
}

void conformance_check_empty(const ff_fixture *fixture)
{
    for_each_function(fixture, empty);
}

/* Whether two results agree; vector code may round differently from scalar code. */
static bool agree(double a, double b)
{
    return a == b || fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b)) || (isnan(a) && isnan(b));
}

static bool batches(checking *c, const conformance_function *function, const void *table,
                    double speed)
{
    batch all = batch_draw(c->fixture, function, POINTS, &c->random),
          one = batch_new(c->fixture, function, 1);
    bool good = true;
    for (unsigned with = 0; with < CHOICES && good; with++) {
        good =
            check_status(c, function, call(function, table, &all, speed, with | WITH_DERIVATIVES));
        for (size_t k = 0; k < all.n && good; k++) {
            for (size_t i = 0; i < function->axis_count; i++)
                one.in[i][0] = all.in[i][k];
            call(function, table, &one, speed, with);
            for (size_t i = 0; i < (with & WITH_DERIVATIVES ? function->result_count : 1); i++)
                if (good && !agree(one.out[i][0], all.out[i][k]))
                    good = ff_check_failf(
                        c->fixture, "%s: %s is %.17g in a batch of %zu points, but %.17g alone",
                        function->name, function->results[i], all.out[i][k], all.n, one.out[i][0]);
        }
    }
    return good;
}

void conformance_check_batch(const ff_fixture *fixture)
{
    for_each_function(fixture, batches);
}

static bool guards(checking *c, const conformance_function *function, const void *table,
                   double speed)
{
    bool good = true;
    for (size_t n = 1; n < 20 && good; n++) {
        random_state again = c->random;
        batch b = batch_draw(c->fixture, function, n, &c->random),
              copy = batch_draw(c->fixture, function, n, &again);
        for (unsigned with = 0; with < CHOICES && good; with++) {
            good = check_status(c, function, call(function, table, &b, speed, with)) &&
                   check_guards(c, function, &b);
            for (size_t i = 0; i < function->axis_count && good; i++)
                if (memcmp(b.in[i], copy.in[i], n * sizeof(double)) != 0)
                    good = ff_check_failf(c->fixture, "%s changed its argument \"%s\"",
                                          function->name, function->axes[i]->name);
        }
    }
    return good;
}

void conformance_check_guards(const ff_fixture *fixture)
{
    for_each_function(fixture, guards);
}

/* Prints a point: "p = 1e9, T = 300". */
static const char *point_text(const conformance_function *function, const double *point,
                              char text[160])
{
    size_t used = 0;
    for (size_t i = 0; i < function->axis_count && used < 120; i++)
        used += (size_t)snprintf(text + used, 160 - used, "%s%s = %g", i ? ", " : "",
                                 function->axes[i]->name, point[i]);
    return text;
}

static bool check_finite(checking *c, const conformance_function *function, const batch *b,
                         double speed)
{
    for (size_t i = 0; i < function->result_count; i++)
        for (size_t k = 0; k < b->n; k++)
            if (!isfinite(b->out[i][k])) {
                double point[CONFORMANCE_AXES];
                char where[160];
                for (size_t j = 0; j < function->axis_count; j++)
                    point[j] = b->in[j][k];
                return ff_check_failf(c->fixture, "%s: %s is %g at %s, scalar argument %g",
                                      function->name, function->results[i], b->out[i][k],
                                      point_text(function, point, where), speed);
            }
    return true;
}

/* Tests every combination of extreme arguments, and points in between. */
static bool extremes(checking *c, const conformance_function *function, const void *table,
                     double speed)
{
    size_t corners = 1;
    for (size_t i = 0; i < function->axis_count; i++)
        corners *= function->axes[i]->extreme_count;
    batch b = batch_draw(c->fixture, function, corners + MANY, &c->random);
    for (size_t k = 0; k < corners; k++) {
        size_t rest = k;
        for (size_t i = 0; i < function->axis_count; i++) {
            b.in[i][k] = function->axes[i]->extremes[rest % function->axes[i]->extreme_count];
            rest /= function->axes[i]->extreme_count;
        }
    }
    bool good = true;
    for (unsigned with = 0; with <= WITH_OPTIONAL && good; with++)
        good = check_status(c, function,
                            call(function, table, &b, speed * 1e3, with | WITH_DERIVATIVES)) &&
               check_finite(c, function, &b, speed * 1e3);
    return good;
}

void conformance_check_finite(const ff_fixture *fixture)
{
    for_each_function(fixture, extremes);
}

static bool derivatives(checking *c, const conformance_function *function, const void *table,
                        double speed)
{
    char where[160];
    for (int k = 0; k < POINTS; k++)
        for (size_t i = 1; i < function->result_count; i++) {
            conformance_line l = {
                .function = function, .table = table, .speed = speed, .axis = function->by[i]};
            const conformance_axis *axis = function->axes[l.axis];
            double out[CONFORMANCE_RESULTS], found;
            for (size_t j = 0; j < function->axis_count; j++)
                l.point[j] = draw(function->axes[j], &c->random);
            double scale = axis->scale > 0 ? axis->scale : 10;
            double x = l.point[l.axis], h = 0.02 * (axis->logarithmic ? x : scale);
            conformance_value_at(&l, x, out);
            /* two attempts, so that a kink within the first step is no fault */
            if (conformance_compare_slope(&l, out[i], h, &found) == 1 &&
                conformance_compare_slope(&l, out[i], h / 8, &found) == 1)
                return ff_check_failf(
                    c->fixture, "%s: %s is %.9g at %s, but differences of %s give %.9g",
                    function->name, function->results[i], out[i],
                    point_text(function, l.point, where), function->results[0], found);
        }
    return true;
}

void conformance_check_derivatives(const ff_fixture *fixture)
{
    for_each_function(fixture, derivatives);
}

static bool continuity(checking *c, const conformance_function *function, const void *table,
                       double speed)
{
    enum { LINES = 3 };
    for (size_t i = 0; i < LINES * function->axis_count; i++) {
        conformance_line l = {
            .function = function, .table = table, .speed = speed, .axis = i / LINES};
        conformance_jump jump;
        for (size_t j = 0; j < function->axis_count; j++)
            l.point[j] = draw(function->axes[j], &c->random);
        if (conformance_find_jump(&l, &jump))
            return ff_check_failf(c->fixture, "%s: %s jumps from %.9g to %.9g at %s = %.9g",
                                  function->name, function->results[0], jump.before, jump.after,
                                  function->axes[l.axis]->name, jump.at);
    }
    return true;
}

void conformance_check_continuity(const ff_fixture *fixture)
{
    for_each_function(fixture, continuity);
}

static bool check_rise(checking *c, const conformance_function *function, const batch *b)
{
    for (size_t k = 1; k < b->n && function->rising; k++) {
        double before = b->out[0][k - 1], after = b->out[0][k];
        if (after < before - 1e-12 * fabs(before))
            return ff_check_failf(c->fixture,
                                  "%s: %s falls from %.9g to %.9g while %s rises from %g to %g",
                                  function->name, function->results[0], before, after,
                                  function->axes[0]->name, b->in[0][k - 1], b->in[0][k]);
    }
    return true;
}

static bool physics(checking *c, const conformance_function *function, const void *table,
                    double speed)
{
    batch b = batch_draw(c->fixture, function, POINTS, &c->random);
    const conformance_axis *first = function->axes[0];
    for (size_t k = 0; k < b.n; k++) {
        double share = (double)k / (double)(b.n - 1);
        b.in[0][k] = first->low + share * (first->high - first->low);
        for (size_t i = 1; i < function->axis_count && function->rising; i++)
            b.in[i][k] = b.in[i][0];
    }
    bool good = check_status(c, function, call(function, table, &b, speed, WITH_ALL)) &&
                check_rise(c, function, &b);
    for (size_t k = 0; k < b.n && good; k++) {
        double value = b.out[0][k], sign = (speed > 0) - (speed < 0);
        if (function->positive && !(value > 0))
            good = ff_check_failf(c->fixture, "%s: %s is %g; it must be positive", function->name,
                                  function->results[0], value);
        else if (function->follows_speed && (value > 0) - (value < 0) != sign)
            good = ff_check_failf(c->fixture,
                                  "%s: %s is %g at a sliding speed of %g; both must have "
                                  "the same sign",
                                  function->name, function->results[0], value, speed);
    }
    return good;
}

void conformance_check_physics(const ff_fixture *fixture)
{
    for_each_function(fixture, physics);
}

/* Arguments of one thread. */
typedef struct shift {
    const conformance_function *function;
    const void *table;
    double speed;
    batch work;
    const batch *expected;
    pthread_barrier_t *start;
    bool differs;
} shift;

static bool same(const conformance_function *function, const batch *a, const batch *b)
{
    for (size_t i = 0; i < function->result_count; i++)
        if (memcmp(a->out[i], b->out[i], a->n * sizeof(double)) != 0)
            return false;
    return true;
}

/* Repeats the calls long enough to be interrupted during a call even on a single processor. */
static void *work(void *argument)
{
    shift *mine = argument;
    pthread_barrier_wait(mine->start);
    for (double end = now() + 0.02; now() < end && !mine->differs;) {
        call(mine->function, mine->table, &mine->work, mine->speed, WITH_ALL);
        mine->differs = !same(mine->function, &mine->work, mine->expected);
    }
    return NULL;
}

static bool purity(checking *c, const conformance_function *function, const void *table,
                   double speed)
{
    random_state seeds[] = {c->random, {7}}, again[] = {c->random, {7}};
    batch expected[2];
    shift shifts[2];
    pthread_t thread;
    pthread_barrier_t start;
    pthread_barrier_init(&start, NULL, 2);
    for (int i = 0; i < 2; i++) {
        expected[i] = batch_draw(c->fixture, function, MANY, &seeds[i]);
        call(function, table, &expected[i], speed, WITH_ALL);
        shifts[i] = (shift){.function = function,
                            .table = table,
                            .speed = speed,
                            .work = batch_draw(c->fixture, function, MANY, &again[i]),
                            .expected = &expected[i],
                            .start = &start};
    }
    call(function, table, &shifts[0].work, speed, WITH_ALL);
    bool good = same(function, &shifts[0].work, &expected[0]) ||
                ff_check_failf(c->fixture, "%s gives different results for the same arguments",
                               function->name);
    if (good && pthread_create(&thread, NULL, work, &shifts[1]) == 0) {
        work(&shifts[0]);
        pthread_join(thread, NULL);
        good =
            (!shifts[0].differs && !shifts[1].differs) ||
            ff_check_failf(c->fixture, "%s gives different results while another thread calls it",
                           function->name);
    }
    pthread_barrier_destroy(&start);
    return good;
}

/* Checks that another instance, created later with other parameters, has no effect. */
static bool apart(checking *c, const conformance_function *function, const void *table,
                  double speed)
{
    random_state seed = c->random, again = c->random;
    batch before = batch_draw(c->fixture, function, POINTS, &seed),
          after = batch_draw(c->fixture, function, POINTS, &again);
    call(function, table, &before, speed, WITH_ALL);
    void *other = c->fixture->open(c->fixture->ctx);
    call(function, table, &after, speed, WITH_ALL);
    bool good =
        same(function, &before, &after) ||
        ff_check_failf(c->fixture, "%s gives different results after another instance was created",
                       function->name);
    c->fixture->close(c->fixture->ctx, other);
    return good;
}

void conformance_check_purity(const ff_fixture *fixture)
{
    for_each_function(fixture, purity);
    for_each_function(fixture, apart);
}
