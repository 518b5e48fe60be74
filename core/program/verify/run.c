/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of tests, and the child processes in which they run. */
#include "private.h"

#include "../crash/lead.h"
#include "../memory/memory.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Subject of a test: loading the model, the user's file, rules for all models, rules of the model's
   kind. */
typedef enum matter { LOADING, USER_FILE, ANY_MODEL, ITS_KIND } matter;

/* Models to which a test applies. Tests from WITH_DATA on need inputs. */
typedef enum concern { ALL, WITH_PARAMS, WITH_PLACES, WITH_DATA } concern;

typedef struct test {
    const char *name, *claim;
    matter matter;
    concern concern;
    bool (*run)(verify_context *context); /* set for ANY_MODEL */
    const ff_check *check;                /* set for ITS_KIND */
} test;

static const test descriptor = {
    "descriptor", "loads and follows the rules for tables", LOADING, ALL, NULL, NULL};
static const test pipeline = {"pipeline", "the file gives it parameters", USER_FILE, ALL, NULL,
                              NULL};
static const test any_model[] = {
    {"references", "licence, reference and BibTeX can be read", ANY_MODEL, ALL,
     verify_test_references, NULL},
    {"presets", "presets lie in the calibrated range", ANY_MODEL, WITH_PARAMS, verify_test_presets,
     NULL},
    {"places", "has a member for each parameter with a place", ANY_MODEL, WITH_PLACES,
     verify_test_places, NULL},
    {"life", "can be created and destroyed in every legal order", ANY_MODEL, ALL, verify_test_life,
     NULL},
    {"leaks", "a thousand instances leave no memory behind", ANY_MODEL, ALL, verify_test_leaks,
     NULL},
    {"allocations", "survives a failing allocation", ANY_MODEL, ALL, verify_test_allocations, NULL},
    {"limits", "accepts parameters within and at their limits, or says why not", ANY_MODEL,
     WITH_PARAMS, verify_test_limits, NULL},
    {"environment", "leaves locale, arithmetic, signals and folder alone", ANY_MODEL, ALL,
     verify_test_environment, NULL},
    {"inputs", "gives finite outputs or a reason for any input", ANY_MODEL, WITH_DATA,
     verify_test_inputs, NULL},
    {"wanted", "gives each output that is wanted", ANY_MODEL, WITH_DATA, verify_test_wanted, NULL},
    {"repeat", "gives the same outputs again, and in two threads", ANY_MODEL, WITH_DATA,
     verify_test_repeat, NULL},
};

typedef struct session {
    const verify_request *request;
    char *root, *id;
    ff_engine *engine;
    void (*tell)(void *ctx, size_t number, const verify_result *result);
    void *ctx;
    size_t number;
    ff_report *report;
    bool good;     /* whether the user's file can be used */
    char *missing; /* a copy of `only` in which names of existing tests are blanked; NULL: tests
                      are run */
} session;

static bool concerns(const test *t, const ff_model *model)
{
    switch (t->concern) {
    case WITH_PARAMS:
        return model->param_count > 0;
    case WITH_PLACES:
        return model->self_size > 0;
    case WITH_DATA:
        return verify_data_outputs(model) != 0;
    case ALL:
        break;
    }
    return true;
}

/* Loads the model. A warning also fails the test, since it reports a change of the process that the
   loader has reverted. */
static bool load(verify_context *context, ff_engine *engine, const char *id)
{
    ff_report *report = ff_report_new();
    context->loaded = ff_engine_model(engine, id, FF_NOWHERE, report);
    if (ff_report_count(report))
        verify_outcome_set(context->outcome, VERIFY_FAILED, ff_report_at(report, 0)->text);
    ff_report_free(report);
    return context->loaded && context->outcome->finding == VERIFY_PASSED;
}

/* Prepares the user's pipeline for a test. With `inputs` the pipeline is run; for parameters alone
   it need not run. */
static bool take_user_run(verify_context *context, const verify_request *request, ff_engine *engine,
                          bool inputs)
{
    verify_step(context, "running %s", request->pipeline);
    bool good = verify_take_user_run(context, request, engine, inputs);
    const ff_report *report = ff_run_report(context->user);
    char *why = memory_print_text("%s: %s", request->pipeline,
                                  ff_report_count(report) ? ff_report_at(report, 0)->text
                                                          : "it cannot be used");
    if (!good)
        verify_outcome_set(context->outcome, VERIFY_FAILED, why);
    free(why);
    return good;
}

static void run_watched(verify_context *context, const test *t, bool watching)
{
    context->watching = false; /* other models may have run before */
    verify_step(context, "beginning");
    if (watching)
        verify_watch(context);
    if (t->matter == ANY_MODEL)
        t->run(context);
    else if (t->matter == ITS_KIND)
        verify_run_check(context, t->check);
    verify_check_process(context);
}

static void try_model(verify_context *context, const session *s, ff_engine *engine, const test *t)
{
    const verify_request *request = s->request;
    bool inputs = t->matter == ITS_KIND || t->concern >= WITH_DATA;
    verify_context_begin(context, engine);
    if (!concerns(t, context->model))
        context->outcome->finding = VERIFY_SKIPPED;
    else if (request->pipeline && !take_user_run(context, request, engine, inputs))
        return;
    else
        run_watched(context, t, inputs || t->run == verify_test_environment);
}

/* Runs the destructors of the plugin. The program skips them, but other users of the library may
   not. */
static void run_destructors(verify_context *context)
{
#ifndef __SANITIZE_ADDRESS__ /* a sanitizer would count the memory that the test did not free */
    context->watching = false;
    verify_step(context, "running its destructors");
    exit(0);
#else
    (void)context;
#endif
}

static verify_outcome *watched; /* context of the test in this process; global, since a signal
                                   handler takes no argument */

/* Ends the child. Otherwise a model that forks at each call would fill the machine with copies of
   the test. */
static void on_fork(void)
{
    snprintf(watched->why, sizeof watched->why, "started another process while %s", watched->step);
    watched->finding = VERIFY_FAILED;
    watched->finished = true;
    _exit(0);
}

static _Noreturn void child(const session *s, const test *t, verify_outcome *outcome)
{
    verify_context context = {.outcome = outcome, .root = s->root};
    ff_engine *engine = verify_open_engine(s->root);
    watched = outcome;
    crash_mark(&outcome->running);
    pthread_atfork(on_fork, NULL, NULL);
    verify_step(&context, "loading");
    verify_watch(&context);
    bool loaded = load(&context, engine, s->id);
    verify_check_process(&context);
    if (loaded && t->matter != LOADING)
        try_model(&context, s, engine, t);
    fflush(stdout);
    outcome->finished = true;
    if (t->matter == LOADING)
        run_destructors(&context);
    _exit(0);
}

/* Writes the first line that the child printed, or "" if it printed nothing. */
static void first_words(FILE *capture, char *out, size_t size)
{
    rewind(capture);
    out[0] = 0;
    if (fgets(out, (int)size, capture))
        out[strcspn(out, "\n")] = 0;
}

static void conclude(verify_outcome *outcome, int status, bool late, FILE *capture,
                     const verify_request *request, verify_result *result)
{
    static const char told[] = "error: "; /* prefix written by the crash handler */
    char words[380], end[CRASH_SENTENCE];
    first_words(capture, words, sizeof words);
    result->finding = outcome->finding;
    snprintf(result->why, sizeof result->why, "%s", outcome->why);
    if (outcome->finished && !words[0] && !late && !WIFSIGNALED(status))
        return;
    result->finding = VERIFY_FAILED;
    if (late)
        snprintf(result->why, sizeof result->why, "hung while %s: not done after %g s",
                 outcome->step, request->limit);
    else if (!outcome->finished && !words[0] &&
             crash_describe(&outcome->running, status, end, sizeof end))
        snprintf(result->why, sizeof result->why, "%.360s, while %s", end, outcome->step);
    else if (WIFSIGNALED(status))
        snprintf(result->why, sizeof result->why, "crashed while %s: %s", outcome->step,
                 strsignal(WTERMSIG(status)));
    else if (!outcome->finished && !strncmp(words, told, strlen(told)))
        snprintf(result->why, sizeof result->why, "%s, while %s", words + strlen(told),
                 outcome->step);
    else if (!outcome->finished)
        snprintf(result->why, sizeof result->why, "ended the program while %s: %s", outcome->step,
                 words[0] ? words : "it called exit(), or the like");
    else if (!outcome->why[0])
        snprintf(result->why, sizeof result->why, "printed \"%.100s\"", words);
}

/* Waits for the child until the limit, and ends the processes that it started. Returns true if the
   child exceeded the limit. */
static bool await(pid_t pid, double limit, int *status)
{
    double end = study_seconds_now() + limit;
    const struct timespec pause = {.tv_nsec = 1000000};
    siginfo_t info = {.si_pid = 0};
    while (waitid(P_PID, (id_t)pid, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0 &&
           study_seconds_now() < end)
        nanosleep(&pause, NULL);
    kill(-pid, SIGKILL);
    waitpid(pid, status, 0);
    return info.si_pid == 0;
}

static void run_test(const session *s, const test *t, verify_result *result)
{
    const struct rlimit no_core = {0, 0};
    double begin = study_seconds_now();
    int status = 0;
    verify_outcome *outcome =
        mmap(NULL, sizeof *outcome, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    FILE *capture = tmpfile();
    *result = (verify_result){.test = t->name, .claim = t->claim, .finding = VERIFY_FAILED};
    if (outcome == MAP_FAILED || !capture) {
        snprintf(result->why, sizeof result->why, "no memory or temporary file for the test");
        return;
    }
    fflush(NULL);
    pid_t pid = fork();
    if (pid == 0) {
        setpgid(0, 0);
        setrlimit(RLIMIT_CORE, &no_core);
        dup2(fileno(capture), STDOUT_FILENO);
        dup2(fileno(capture), STDERR_FILENO);
        child(s, t, outcome);
    }
    setpgid(pid, pid);
    bool late = pid > 0 && await(pid, s->request->limit, &status);
    conclude(outcome, status, late, capture, s->request, result);
    result->seconds = study_seconds_now() - begin;
    fclose(capture);
    munmap(outcome, sizeof *outcome);
}

/* Splits ".../kind/name.so" into root and id. Both are to be freed. */
static bool part(const char *path, char **root, char **id)
{
    const char *name = strrchr(path, '/');
    size_t length = strlen(path);
    name = name ? name + 1 : path;
    char *above = memory_print_text("%.*s.", (int)(name - path), path);
    char *folder = realpath(above, NULL);
    free(above);
    bool good = folder && strrchr(folder, '/') && length > 3 && !strcmp(path + length - 3, ".so");
    if (good) {
        char *slash = strrchr(folder, '/');
        *id = memory_print_text("%s/%.*s", slash + 1, (int)strlen(name) - 3, name);
        *root = memory_print_text("%.*s", slash > folder ? (int)(slash - folder) : 1, folder);
    }
    free(folder);
    return good;
}

/* Returns the position of the name in a comma-separated list, or NULL. */
static const char *find_among(const char *name, const char *names)
{
    size_t length = strlen(name);
    for (const char *at = names; *at; at += strcspn(at, ","), at += *at == ',') {
        at += strspn(at, " ");
        if (strcspn(at, " ,") == length && !strncmp(at, name, length))
            return at;
    }
    return NULL;
}

/* Blanks the name of a test wherever it is requested. */
static void cross_out(session *s, const char *name)
{
    for (const char *at; (at = find_among(name, s->missing));)
        memset(s->missing + (at - s->missing), ' ', strlen(name));
}

/* Returns false, with an error, if a requested name does not belong to a test, or if no name is
 * requested. */
static bool check_requested(session *s)
{
    const char *only = s->request->only;
    if (!only[strspn(only, " ,")])
        return ff_error(s->report, FF_FAULT_INPUT, FF_NOWHERE, "--list names them",
                        "--only names no test");
    for (const char *at = s->missing; *(at += strspn(at, " ,")); at += strcspn(at, ","))
        ff_error(s->report, FF_FAULT_INPUT, FF_NOWHERE, "--list names them",
                 "%s has no test \"%.*s\"", s->id, (int)strcspn(at, ","), at);
    return ff_report_errors(s->report) == 0;
}

/* Runs a test. Returns false if no further test can be run. */
static bool try(session *s, const test *t)
{
    verify_result result = {.test = t->name, .claim = t->claim, .finding = VERIFY_LISTED};
    bool file = t->matter == USER_FILE;
    bool asked = !s->request->only || find_among(t->name, s->request->only);
    if (file && !s->request->pipeline)
        return true;
    if (s->missing) { /* the requested names are looked up first */
        cross_out(s, t->name);
        return true;
    }
    if (s->request->list) {
        s->tell(s->ctx, ++s->number, &result);
        return true;
    }
    if (!asked && !file) /* each test loads the model again in its own process */
        return true;
    run_test(s, t, &result);
    if (file && result.finding != VERIFY_PASSED)
        s->good = ff_error(s->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s", result.why);
    else if (!file && (result.finding != VERIFY_SKIPPED || result.why[0]))
        s->tell(s->ctx, ++s->number, &result);
    return t->matter >= ANY_MODEL || result.finding == VERIFY_PASSED;
}

static void try_kind(session *s)
{
    ff_report *report = ff_report_new();
    char *kind = memory_copy_text(s->id, strcspn(s->id, "/"));
    verify_kind_checks checks;
    bool known = verify_kind_checks_open(&checks, s->engine, kind, report);
    for (size_t i = 0; known && i < checks.offer->check_count; i++) {
        size_t offset = i * checks.offer->check_stride;
        const ff_check *check = (const void *)((const char *)checks.offer->checks + offset);
        try(s, &(test){check->name, check->claim, ITS_KIND, ALL, NULL, check});
    }
    if (!known && !s->request->only && !s->request->list) {
        bool broken = ff_report_count(report) > 0;
        verify_result none = {.test = "kind",
                              .claim = "meets the requirements of its kind",
                              .finding = broken ? VERIFY_FAILED : VERIFY_SKIPPED};
        if (broken)
            snprintf(none.why, sizeof none.why, "%s", ff_report_at(report, 0)->text);
        else
            snprintf(none.why, sizeof none.why,
                     "there is no model %s/%s that states them; only the general tests were run",
                     FF_CONFORMANCE_KIND, kind);
        s->tell(s->ctx, ++s->number, &none);
    }
    verify_kind_checks_close(&checks);
    free(kind);
    ff_report_free(report);
}

static void try_all(session *s)
{
    if (!try(s, &descriptor) || !try(s, &pipeline))
        return;
    for (size_t i = 0; i < sizeof any_model / sizeof *any_model; i++)
        try(s, &any_model[i]);
    try_kind(s);
}

bool verify_plugin(const verify_request *request,
                   void (*tell)(void *ctx, size_t number, const verify_result *result), void *ctx,
                   ff_report *report)
{
    session s = {.request = request, .tell = tell, .ctx = ctx, .report = report, .good = true};
    if (access(request->path, R_OK) != 0)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s cannot be read: %s",
                        request->path, strerror(errno));
    if (!part(request->path, &s.root, &s.id))
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                        "its place must be KIND/NAME.so, as its id says", "%s is not a plugin",
                        request->path);
    setenv("OPENBLAS_NUM_THREADS", "1", 1); /* so that any remaining thread is the model's own */
    setenv("OMP_NUM_THREADS", "1", 1);
    s.engine = verify_open_engine(s.root);
    if (request->only && !request->list) {
        s.missing = memory_copy_text(request->only, strlen(request->only));
        try_all(&s);
        s.good = check_requested(&s);
        free(s.missing);
        s.missing = NULL;
    }
    if (s.good)
        try_all(&s);
    if (s.good && request->only && !s.number)
        s.good = ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                          "no test that --only names applies to %s", s.id);
    ff_engine_close(s.engine);
    free(s.root);
    free(s.id);
    return s.good;
}
