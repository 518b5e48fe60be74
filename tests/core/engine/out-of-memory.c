/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each allocation of a run fails in turn, alone or with all that follow: in the engine, in libyaml,
 * in the dynamic linker and in the models. The run answers that it lacked memory, or rightly;
 * nothing is left behind, and the next run is good.
 */
#include <flankfilm/engine.h>

#include <check.h>

#include <dlfcn.h>
#include <errno.h>
#include <fenv.h>
#include <link.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* What the allocator does, and has done. */
static struct {
    size_t calls, fail_at; /* the first that fails; 0: none */
    bool onwards;          /* and all later ones */
    size_t spared;         /* calls, not among them, by libraries of which none may fail */
    long live;             /* blocks */
} memory;

enum { MOST_MORTAL = 8 };

/* Code of libraries that end the process themselves when they get no memory. */
static struct {
    const char *begin, *end;
} mortal[MOST_MORTAL];

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *old);

#define PUBLIC __attribute__((visibility("default")))

static bool refuses(const void *caller)
{
    for (size_t i = 0; mortal[i].begin; i++)
        if ((const char *)caller >= mortal[i].begin && (const char *)caller < mortal[i].end) {
            memory.spared++;
            return false;
        }
    memory.calls++;
    bool refused = memory.fail_at > 0 && (memory.onwards ? memory.calls >= memory.fail_at
                                                         : memory.calls == memory.fail_at);
    if (refused)
        errno = ENOMEM;
    return refused;
}

static void *count(void *made)
{
    memory.live += made != NULL;
    return made;
}

PUBLIC void *malloc(size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_malloc(size));
}

PUBLIC void *calloc(size_t number, size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_calloc(number, size));
}

PUBLIC void *realloc(void *old, size_t size)
{
    if (refuses(__builtin_return_address(0)))
        return NULL;
    void *made = __libc_realloc(old, size);
    memory.live += (made != NULL) - (old != NULL && (made || size == 0));
    return made;
}

PUBLIC void *memalign(size_t alignment, size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_memalign(alignment, size));
}

PUBLIC void *aligned_alloc(size_t alignment, size_t size)
{
    return refuses(__builtin_return_address(0)) ? NULL : count(__libc_memalign(alignment, size));
}

PUBLIC int posix_memalign(void **made, size_t alignment, size_t size)
{
    *made = refuses(__builtin_return_address(0)) ? NULL : count(__libc_memalign(alignment, size));
    return *made ? 0 : ENOMEM;
}

PUBLIC void free(void *old)
{
    memory.live -= old != NULL;
    __libc_free(old);
}

static int note_mortal(struct dl_phdr_info *info, size_t size, void *ctx)
{
    static const char *const names[] = {"/libfftw3.so", "/libgomp.so"};
    size_t *found = ctx;
    (void)size;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
        for (int i = 0; strstr(info->dlpi_name, names[k]) && i < info->dlpi_phnum; i++) {
            const ElfW(Phdr) *p = &info->dlpi_phdr[i];
            if (p->p_type != PT_LOAD || !(p->p_flags & PF_X) || *found + 1 == MOST_MORTAL)
                continue;
            mortal[*found].begin = (const char *)info->dlpi_addr + p->p_vaddr;
            mortal[*found].end = mortal[*found].begin + p->p_memsz;
            ++*found;
        }
    return 0;
}

/* Of the libraries that are loaded. */
static void spare_mortal(void)
{
    size_t found = 0;
    dl_iterate_phdr(note_mortal, &found);
}

/* The blocks in use, without the error that the dynamic linker keeps for each thread. */
static long live(void)
{
    dlerror(), dlerror();
    return memory.live;
}

/* What is run, in the directory of the test, and what came of it. */
typedef struct attempt {
    const char *file;
    enum { RUN, OPEN, INSTANCES } how; /* OPEN: models are to be chosen */
    bool spares;                       /* what FFTW and libgomp allocate */
    ff_status status;
    size_t calls;  /* of the allocator */
    bool lacked;   /* an error says that memory was missing */
    double answer; /* over all numbers and messages */
} attempt;

static const char *directory;

static void add_array(attempt *a, const char *name, const ff_result *result)
{
    for (size_t n = 0; n < result->count; n++)
        a->answer += (double)(name[0] + name[1]) * result->data[n];
}

/* A file whose models are known. */
static ff_status run_file(attempt *a, ff_engine *engine)
{
    ff_run *run;
    const char *name;
    const ff_result *result;
    const ff_quality *line;
    ff_status status = ff_run_open(engine, a->file, NULL, &run);
    if (status == FF_OK)
        status = ff_run_start(run, NULL);
    for (size_t i = 0; status == FF_OK && ff_run_output(run, i, &name, &result) == FF_OK; i++)
        add_array(a, name, result);
    for (size_t i = 0; status == FF_OK && ff_run_quality(run, i, &line) == FF_OK; i++)
        a->answer += 1e3 * line->limit;
    ff_run_close(run);
    return status;
}

/* Models by hand, some of which use others; the last is none. */
static ff_status use_instances(attempt *a, ff_engine *engine)
{
    enum { ONE, SUM, LAW, USER, TABLE, NONE, COUNT };
    static const char *const ids[] = {"toy/source", "toy/consumer", "toy/law",
                                      "toy/user",   "toy/reader",   "toy/no-model"};
    static const double series[] = {1, 2, 3}, weights[] = {1, 2};
    static const size_t shape[] = {3};
    const ff_array array = {.data = series, .shape = shape, .rank = 1};
    ff_instance *x[COUNT] = {NULL};
    const ff_result *result;
    ff_status s = FF_OK, wrong = FF_OK;
    for (int i = 0; i < NONE && s == FF_OK; i++)
        s = ff_instance_new(engine, ids[i], &x[i]);
    if (s == FF_OK && (s = ff_instance_set(x[ONE], "level", "2 mm")) == FF_OK &&
        (s = ff_instance_set_reals(x[ONE], "weights", weights, 2)) == FF_OK &&
        (s = ff_instance_use(x[SUM], "source", x[ONE])) == FF_OK &&
        (s = ff_instance_give(x[SUM], "more.series", &array)) == FF_OK &&
        (s = ff_instance_run(x[SUM], NULL)) == FF_OK &&
        (s = ff_instance_result(x[SUM], "sum", &result)) == FF_OK)
        add_array(a, "sum", result);
    if (s == FF_OK && (s = ff_instance_set(x[LAW], "gain", "3")) == FF_OK &&
        (s = ff_instance_use(x[USER], "law", x[LAW])) == FF_OK &&
        (s = ff_instance_run(x[USER], "value")) == FF_OK &&
        (s = ff_instance_result(x[USER], "value", &result)) == FF_OK)
        add_array(a, "user", result);
    if (s == FF_OK && (s = ff_instance_set(x[TABLE], "file", "levels.csv")) == FF_OK &&
        (s = ff_instance_run(x[TABLE], NULL)) == FF_OK &&
        (s = ff_instance_result(x[TABLE], "sum", &result)) == FF_OK)
        add_array(a, "table", result);
    if (s == FF_OK && (wrong = ff_instance_set(x[ONE], "level", "2 m/s")) != FF_NOMEM)
        wrong = ff_instance_new(engine, ids[NONE], &x[NONE]);
    for (int i = COUNT; i-- > 0;)
        ff_instance_close(x[i]);
    return s == FF_OK ? wrong : s;
}

typedef struct choice {
    attempt *a;
    ff_engine *engine;
    ff_report *report;
} choice;

/* A file that leaves models open, as the program runs it. */
static void run_open_file(void *ctx)
{
    choice *c = ctx;
    c->report = ff_report_new();
    ff_tree *tree = ff_tree_load(c->a->file, c->report);
    ff_pipeline *p = ff_pipeline_build(tree, c->engine, false, c->report);
    if (p && ff_report_errors(c->report) == 0 && ff_pipeline_run(p, NULL, c->report))
        for (size_t i = 0; i < p->count; i++)
            for (size_t k = 0; p->stages[i].ran && k < p->stages[i].loaded->model->output_count;
                 k++)
                if (p->stages[i].results[k].data)
                    add_array(c->a, p->stages[i].name, &p->stages[i].results[k]);
    c->a->lacked = ff_report_lacked_memory(c->report);
}

/* The status of the run; the answer has the length of the message, too. */
static ff_status run(attempt *a)
{
    const ff_engine_options options = {sizeof options, &directory, 1};
    choice c = {.a = a};
    ff_status status = ff_engine_new(&options, &c.engine);
    if (status != FF_OK)
        return status;
    if (a->how == INSTANCES)
        status = use_instances(a, c.engine);
    else if (a->how == OPEN)
        status = ff_protected(run_open_file, &c);
    else
        status = run_file(a, c.engine);
    a->answer += 1e6 * (double)strlen(ff_engine_message(c.engine));
    ff_engine_close(c.engine);
    return status == FF_OK && a->lacked ? FF_NOMEM : status;
}

static attempt try_run(const attempt *plan, size_t fail_at, bool onwards)
{
    attempt a = *plan;
    memory.calls = 0;
    memory.fail_at = fail_at;
    memory.onwards = onwards;
    a.status = run(&a);
    memory.fail_at = 0;
    a.calls = memory.calls;
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
    attempt good = try_run(plan, 0, false); /* loads what stays */
    if (plan->spares) {
        spare_mortal();
        memory.spared = 0;
        good = try_run(plan, 0, false);
        s->spared = memory.spared;
    }
    s->wrong = s->wrong || (plan->spares && good.status != FF_OK);
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
    if (plan->spares)
        printf("    none of the %zu that FFTW and libgomp make\n", s->spared);
    check_true("no wrong answer, and nothing left behind", !s->wrong);
    check_true("some failed", s->failed > 20);
    munmap(s, sizeof *s);
}

/* Fails each while models are loaded, which a process does once. */
static void fail_cold(const attempt *plan, bool onwards)
{
    enum { GOOD, WRONG, BEYOND };
    int answer = GOOD;
    size_t at = 1;
    for (; answer != BEYOND; at++) {
        int status = 0;
        fflush(stdout);
        if (fork() == 0) {
            attempt failed = try_run(plan, at, onwards), next = try_run(plan, 0, false);
            _exit(!agree(&failed, &next) ? WRONG : failed.calls < at ? BEYOND : GOOD);
        }
        wait(&status);
        answer = WIFEXITED(status) ? WEXITSTATUS(status) : WRONG;
        if (answer == WRONG)
            tell("wrong while models are loaded", plan->file, at, onwards);
    }
    check_true("some failed", at > 100);
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
static void leave_models(void)
{
    const ff_engine_options options = {sizeof options, &directory, 1};
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

/* DIRECTORY-OF-PLUGINS DIRECTORY-OF-FILES FILE STRIDE [open|instances|models [SEED]]; stride 0:
   cold; models: the shipped ones, which use libraries that end the process. */
int main(int argc, char **argv)
{
    if (argc < 5 || chdir(argv[2]) != 0)
        return 2;
    const char *how = argc > 5 ? argv[5] : "";
    const attempt plan = {.file = argv[3],
                          .how = !strcmp(how, "open")        ? OPEN
                                 : !strcmp(how, "instances") ? INSTANCES
                                                             : RUN,
                          .spares = !strcmp(how, "models")};
    const draw start = {.stride = (size_t)atoi(argv[4]),
                        .begin = 1,
                        .seed = argc > 6 ? strtoull(argv[6], NULL, 10) : 1};
    directory = argv[1];
    setenv("OPENBLAS_NUM_THREADS", "1", 1); /* the count of allocations is then always the same */
    setenv("OMP_THREAD_LIMIT", "1", 1);
    for (int onwards = 0; onwards <= 1; onwards++)
        if (start.stride == 0)
            fail_cold(&plan, onwards);
        else
            fail_warm(&plan, start, onwards);
    if (plan.how == INSTANCES)
        leave_models();
    return check_done();
}
