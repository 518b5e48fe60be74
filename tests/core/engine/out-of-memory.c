/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each allocation of a run fails in turn, alone or with all that follow: in the engine, in libyaml,
 * in the dynamic linker and in the models. The run answers that it lacked memory, or rightly;
 * nothing is left behind, and the next run is good.
 */
#include "attempt.h"
#include "failing-allocator.h"

#include <check.h>

#include <dlfcn.h>
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* The blocks in use, without the error that the dynamic linker keeps for each thread. */
static long live(void)
{
    dlerror(), dlerror();
    return memory.live;
}

static attempt try_run(const attempt *plan, size_t fail_at, bool onwards)
{
    memory.fail_at = fail_at;
    memory.onwards = onwards;
    attempt a = attempt_run(plan);
    memory.fail_at = 0;
    return a;
}

/* Whether a run in which allocations failed, and a good one, are as they should be. */
static bool agree(const attempt *failed, const attempt *good)
{
    return good->status != FF_NOMEM &&
           (failed->status == FF_NOMEM ||
            (failed->status == good->status && failed->answer == good->answer));
}

static void tell(const char *what, const char *file, size_t at, bool onwards)
{
    check_true(what, false);
    printf("    %s: allocation %zu fails%s\n", file, at, onwards ? ", and all later ones" : "");
}

/* The allocations that are to fail: one in `stride`, drawn from each so many. */
typedef struct draw {
    size_t stride, begin; /* of the next ones */
    uint64_t seed;
} draw;

static size_t draw_next(draw *d)
{
    d->seed = d->seed * 6364136223846793005 + 1442695040888963407; /* Knuth's MMIX */
    size_t at = d->begin + (size_t)(d->seed >> 33) % d->stride;
    d->begin += d->stride;
    return at;
}

enum { MOST_ENDS = 20 }; /* of a process, before the sweep is given up */

/* What a process that sweeps tells the one that waits for it, since it may end at any time. */
typedef struct sweep {
    draw next;
    size_t at, failed; /* the allocation at hand, and how many failed */
    size_t spared;     /* in a run that is good */
    bool wrong, over;
} sweep;

/* Fails allocations that a run makes when the models are loaded, as far as the process comes. */
static void sweep_on(sweep *s, const attempt *plan, bool onwards)
{
    try_run(plan, 0, false); /* loads what stays */
    memory.spared = 0;
    attempt good = try_run(plan, 0, false);
    s->spared = memory.spared;
    s->wrong = s->wrong || (memory.spares && good.status != FF_OK);
    for (size_t round = 1;; round++) {
        s->at = draw_next(&s->next);
        long before = live();
        attempt failed = try_run(plan, s->at, onwards);
        if (failed.calls < s->at)
            break;
        bool right = agree(&failed, &good), left = live() != before;
        s->failed++;
        s->wrong = s->wrong || !right || left;
        if (!right || left)
            tell(right ? "memory is left behind" : "a wrong answer", plan->file, s->at, onwards);
        if (!right)
            printf("    status %d, answer %.17g; without failure %d, %.17g\n", failed.status,
                   failed.answer, good.status, good.answer);
        if (round % 64 == 0)
            good = try_run(plan, 0, false);
    }
    s->over = true;
}

/* Sweeps, in a process that is made anew where an allocation that fails has ended it. */
static void fail_warm(const attempt *plan, draw start, bool onwards)
{
    sweep *s = mmap(NULL, sizeof *s, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (s == MAP_FAILED)
        abort();
    *s = (sweep){.next = start};
    for (int ends = 0; !s->over && ends < MOST_ENDS; ends++) {
        fflush(stdout);
        if (fork() == 0) {
            sweep_on(s, plan, onwards);
            fflush(stdout);
            _exit(0);
        }
        wait(NULL);
        if (!s->over)
            tell("the process has ended", plan->file, s->at, onwards);
    }
    printf("%s: %zu failed%s, of one in %zu\n", plan->file, s->failed,
           onwards ? " with all later ones" : "", start.stride);
    if (memory.spares)
        printf("    none of the %zu that FFTW, libgomp, OpenBLAS and the linker make\n", s->spared);
    check_true("no wrong answer, and nothing left behind", !s->wrong);
    check_true("some failed", s->failed > 0);
    munmap(s, sizeof *s);
}

/* What a process that loads models tells the one that waits for it. */
typedef struct loading {
    attempt good, failed, next;
    int end; /* how the process ended */
} loading;

/* In a process without models: the attempt fails, the next one is good. */
static void load_once(loading *l, const attempt *plan, size_t at, bool onwards)
{
    fflush(stdout);
    if (fork() == 0) {
        l->failed = try_run(plan, at, onwards);
        l->next = try_run(plan, 0, false);
        _exit(0);
    }
    wait(&l->end);
}

static bool is_right(const loading *l)
{
    return l->end == 0 && agree(&l->failed, &l->good) && l->next.status == l->good.status &&
           l->next.answer == l->good.answer;
}

/* Fails allocations while models are loaded, which a process does once. */
static void fail_cold(const attempt *plan, draw start, bool onwards)
{
    loading *l = mmap(NULL, sizeof *l, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (l == MAP_FAILED)
        abort();
    load_once(l, plan, 0, onwards);
    l->good = l->failed;
    check_true("a good answer", is_right(l) && l->good.status == FF_OK);
    size_t failed = 0;
    for (size_t at; (at = draw_next(&start)) <= l->good.opening; failed++) {
        load_once(l, plan, at, onwards);
        if (is_right(l))
            continue;
        tell("wrong while models are loaded", plan->file, at, onwards);
        printf("    the process ended with %d, the attempt with %d, %.17g, the next one with %d, "
               "%.17g; a good one with %.17g\n",
               l->end, l->failed.status, l->failed.answer, l->next.status, l->next.answer,
               l->good.answer);
    }
    printf("%s: %zu failed%s in the loading of models, of one in %zu\n", plan->file, failed,
           onwards ? " with all later ones" : "", start.stride);
    check_true("some failed", failed > 0);
    munmap(l, sizeof *l);
}

/* Gives the next attempt so much address space; 0: as much as there is. */
static void limit_space(size_t bytes)
{
    size_t pages = 0;
    struct rlimit limit;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%zu", &pages) != 1 || getrlimit(RLIMIT_AS, &limit) != 0)
        exit(2);
    fclose(file);
    limit.rlim_cur = bytes ? pages * (size_t)sysconf(_SC_PAGESIZE) + bytes : limit.rlim_max;
    setrlimit(RLIMIT_AS, &limit);
}

/* The models and their libraries find ever more address space, until there is enough. */
static void fail_space(const attempt *plan, size_t step)
{
    attempt short_plan = *plan;
    short_plan.only_loads = true;
    loading *l = mmap(NULL, sizeof *l, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (l == MAP_FAILED)
        abort();
    load_once(l, plan, 0, false);
    l->good = l->failed;
    l->failed.status = FF_NOMEM;
    size_t tries = 0, wrong = 0;
    for (size_t room = step; l->failed.status != FF_OK && tries < 1000; room += step, tries++) {
        fflush(stdout);
        if (fork() == 0) {
            limit_space(room);
            l->failed = try_run(&short_plan, 0, false);
            limit_space(0);
            l->next = try_run(plan, 0, false);
            _exit(0);
        }
        wait(&l->end);
        wrong += l->end != 0 || (l->failed.status != FF_OK && l->failed.status != FF_NOMEM) ||
                 l->next.status != l->good.status || l->next.answer != l->good.answer;
    }
    printf("%s: %zu times without space\n", plan->file, tries - 1);
    check_true("lack of memory is said, and passes", tries > 1 && wrong == 0);
    munmap(l, sizeof *l);
}

static ff_status lack(void *ctx)
{
    (void)ctx;
    fesetround(FE_UPWARD);
    memory.fail_at = memory.calls + 1;
    ff_report_new();
    return FF_OK;
}

static void log_nothing(void *ctx, const ff_stage *stage, int32_t level, const char *text)
{
    (void)stage, (void)level, (void)text;
    lack(ctx);
}

static int32_t go_on(void *ctx, const ff_stage *stage, double fraction)
{
    (void)stage, (void)fraction;
    return lack(ctx);
}

/* A crash after that must not be blamed on the plugin. */
static void check_left(const char *what, ff_status status)
{
    memory.fail_at = 0;
    check_true(what, status == FF_NOMEM && fegetround() == FE_TONEAREST);
    check_true("and no plugin runs", !ff_guard_current().path);
    fesetround(FE_TONEAREST);
}

/* The program lacks memory while a model runs, which must be left in order. */
static void leave_models(const char *plugins)
{
    const ff_engine_options options = {sizeof options, &plugins, 1};
    const ff_observer logs = {.size = sizeof logs, .log = log_nothing};
    const ff_observer goes_on = {.size = sizeof goes_on, .progress = go_on};
    ff_engine *engine;
    ff_instance *x[3];
    check_true("an engine", ff_engine_new(&options, &engine) == FF_OK);
    for (int i = 0; i < 3; i++)
        if (ff_instance_new(engine, "toy/source", &x[i]) != FF_OK ||
            ff_instance_set(x[i], "level", "2 mm") != FF_OK)
            check_true("a model", false);
    ff_instance_observe(x[0], &logs);
    check_left("in a log", ff_instance_run(x[0], NULL));
    ff_instance_observe(x[1], &goes_on);
    ff_instance_set(x[1], "answer", "progress");
    check_left("in a progress", ff_instance_run(x[1], NULL));
    check_true("ready", ff_instance_ready(x[2]) == FF_OK);
    check_left("in a call", ff_instance_call(x[2], "its test", lack, NULL));
    for (int i = 0; i < 3; i++)
        ff_instance_close(x[i]);
    ff_engine_close(engine);
}

/* DIRECTORY-OF-PLUGINS DIRECTORY-OF-FILES FILE STRIDE [SEED] WORD...: instances or stages say
   how the file is run; cold: allocations fail while models are loaded; space: they find so many KiB
   of address space, twice as many, and so on; shipped: the models use
   libraries that end the process. */
int main(int argc, char **argv)
{
    if (argc < 5 || chdir(argv[2]) != 0)
        return 2;
    attempt plan = {.plugins = argv[1], .file = argv[3], .how = RUN};
    draw start = {.stride = (size_t)atoi(argv[4]), .begin = 1, .seed = 1};
    bool cold = false, space = false;
    for (int i = 5; i < argc; i++) {
        plan.how = !strcmp(argv[i], "stages")      ? STAGES
                   : !strcmp(argv[i], "instances") ? INSTANCES
                                                   : plan.how;
        cold = cold || !strcmp(argv[i], "cold");
        space = space || !strcmp(argv[i], "space");
        memory.spares = memory.spares || !strcmp(argv[i], "shipped");
        if (atoi(argv[i]) > 0)
            start.seed = strtoull(argv[i], NULL, 10);
    }
    setenv("OPENBLAS_NUM_THREADS", "1", 1); /* the count of allocations is then always the same */
    setenv("OMP_THREAD_LIMIT", "1", 1);
    if (!attempt_prepare(&plan))
        return 2;
    if (space)
        fail_space(&plan, start.stride * 1024);
    for (int onwards = 0; onwards <= 1 && !space; onwards++)
        (cold ? fail_cold : fail_warm)(&plan, start, onwards);
    if (plan.how == INSTANCES)
        leave_models(plan.plugins);
    return check_done();
}
