/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of tests, and the child processes that they run in. */
#include "subject.h"

#include "../value/memory.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Which models a test is about. */
typedef enum concern { ANY, GIVEN, PARAMS, DATA, KIND } concern;

struct test {
    const char *name, *claim;
    concern concern;
    bool (*run)(ff_subject *subject); /* NULL: loading is all */
    const ff_check *check;            /* KIND: what the kind asks */
};

static const struct test tests[] = {
    {"descriptor", "loads and keeps the rules for tables", ANY, NULL, NULL},
    {"pipeline", "the file gives it parameters", GIVEN, NULL, NULL},
    {"references", "licence, reference and BibTeX can be read", ANY, ff_test_references, NULL},
    {"presets", "presets lie in the calibrated range", PARAMS, ff_test_presets, NULL},
    {"life", "lives and dies in every legal order", ANY, ff_test_life, NULL},
    {"leaks", "a thousand lives leave no memory behind", ANY, ff_test_leaks, NULL},
    {"allocations", "survives a failing allocation", ANY, ff_test_allocations, NULL},
    {"limits", "takes parameters in and at their limits, or says why not", PARAMS, ff_test_limits,
     NULL},
    {"environment", "leaves locale, arithmetic, signals and folder alone", ANY, ff_test_environment,
     NULL},
    {"inputs", "gives finite outputs or a reason for any input", DATA, ff_test_inputs, NULL},
    {"wanted", "gives each output that is wanted", DATA, ff_test_wanted, NULL},
    {"repeat", "gives the same outputs again, and in two threads", DATA, ff_test_repeat, NULL},
};
enum { TESTS = sizeof tests / sizeof tests[0] };

double ff_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void ff_doing(ff_subject *subject, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(subject->slate->doing, sizeof subject->slate->doing, format, args);
    va_end(args);
}

static bool say(ff_slate *slate, ff_finding finding, const char *format, va_list args)
{
    if (slate->finding == FF_PASSED) {
        slate->finding = finding;
        vsnprintf(slate->why, sizeof slate->why, format, args);
    }
    return false;
}

bool ff_faulty(ff_subject *subject, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(subject->slate, FF_FAULTY, format, args);
    va_end(args);
    return false;
}

bool ff_untried(ff_subject *subject, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(subject->slate, FF_UNTRIED, format, args);
    va_end(args);
    return false;
}

static bool concerns(const ff_model *model, concern what)
{
    return (what != PARAMS || model->param_count > 0) && (what != DATA || ff_all_outputs(model));
}

/* A warning at loading is a fault, too: the loader has undone it. */
static bool load(ff_subject *subject, ff_library *library, const char *id)
{
    ff_report *report = ff_report_new();
    subject->loaded = ff_library_load(library, id, FF_NOWHERE, report);
    if (ff_report_count(report))
        ff_faulty(subject, "%s", ff_report_at(report, 0)->text);
    ff_report_free(report);
    return subject->loaded && subject->slate->finding == FF_PASSED;
}

/* Inputs cost a run of the pipeline; parameters do not. */
static bool take_pipeline(ff_subject *subject, const ff_verify *request, ff_library *library,
                          bool inputs)
{
    ff_report *report = ff_report_new();
    ff_doing(subject, "running %s", request->pipeline);
    subject->given = ff_feed_from_pipeline(request, library, subject, inputs, report);
    if (!subject->given)
        ff_faulty(subject, "%s: %s", request->pipeline,
                  ff_report_count(report) ? ff_report_at(report, 0)->text : "it cannot be used");
    ff_report_free(report);
    return subject->given;
}

static _Noreturn void child(const ff_verify *request, const char *root, const char *id,
                            const struct test *test, ff_slate *slate)
{
    ff_subject subject = {.slate = slate, .random = {42}};
    const char *const roots[] = {root};
    ff_library *library = ff_library_new(roots, 1);
    ff_doing(&subject, "loading");
    if (load(&subject, library, id) && (test->run || test->concern == GIVEN || test->check)) {
        bool inputs = test->concern == DATA || test->concern == KIND;
        subject.laws = ff_plain_laws(library, subject.loaded);
        if (!concerns(subject.loaded->model, test->concern))
            slate->finding = FF_UNTRIED;
        else if (request->pipeline && !take_pipeline(&subject, request, library, inputs))
            ; /* said */
        else if (test->check)
            ff_bench_check(&subject, test->check);
        else if (test->run)
            test->run(&subject);
    }
    fflush(stdout);
    slate->told = true;
    _exit(0);
}

/* What the child printed, its first line; "" for nothing. */
static void first_words(FILE *capture, char *out, size_t size)
{
    rewind(capture);
    out[0] = 0;
    if (fgets(out, (int)size, capture))
        out[strcspn(out, "\n")] = 0;
}

static void judge(ff_slate *slate, int status, bool late, FILE *capture, const ff_verify *request,
                  ff_verdict *verdict)
{
    char words[200];
    first_words(capture, words, sizeof words);
    verdict->finding = slate->finding;
    snprintf(verdict->why, sizeof verdict->why, "%s", slate->why);
    if (slate->told && !words[0])
        return;
    verdict->finding = FF_FAULTY;
    if (late)
        snprintf(verdict->why, sizeof verdict->why, "hung while %s: not done after %g s",
                 slate->doing, request->limit);
    else if (WIFSIGNALED(status))
        snprintf(verdict->why, sizeof verdict->why, "crashed while %s: %s", slate->doing,
                 strsignal(WTERMSIG(status)));
    else if (!slate->told)
        snprintf(verdict->why, sizeof verdict->why, "ended the program while %s: %s", slate->doing,
                 words[0] ? words : "it called exit()");
    else if (!slate->why[0])
        snprintf(verdict->why, sizeof verdict->why, "printed \"%.100s\"", words);
}

/* Waits for the child, but not for ever; true when it was late. */
static bool await(pid_t pid, double limit, int *status)
{
    double end = ff_now() + limit;
    const struct timespec pause = {.tv_nsec = 1000000};
    while (waitpid(pid, status, WNOHANG) == 0) {
        if (ff_now() > end) {
            kill(-pid, SIGKILL);
            waitpid(pid, status, 0);
            return true;
        }
        nanosleep(&pause, NULL);
    }
    return false;
}

static void run_test(const ff_verify *request, const char *root, const char *id,
                     const struct test *test, ff_verdict *verdict)
{
    const struct rlimit no_core = {0, 0};
    double begin = ff_now();
    int status = 0;
    ff_slate *slate =
        mmap(NULL, sizeof *slate, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    FILE *capture = tmpfile();
    *verdict = (ff_verdict){.test = test->name, .claim = test->claim, .finding = FF_FAULTY};
    if (slate == MAP_FAILED || !capture) {
        snprintf(verdict->why, sizeof verdict->why, "no memory or temporary file for the test");
        return;
    }
    fflush(NULL);
    pid_t pid = fork();
    if (pid == 0) {
        setpgid(0, 0);
        setrlimit(RLIMIT_CORE, &no_core);
        dup2(fileno(capture), STDOUT_FILENO);
        dup2(fileno(capture), STDERR_FILENO);
        child(request, root, id, test, slate);
    }
    setpgid(pid, pid);
    bool late = pid > 0 && await(pid, request->limit, &status);
    judge(slate, status, late, capture, request, verdict);
    verdict->seconds = ff_now() - begin;
    fclose(capture);
    munmap(slate, sizeof *slate);
}

/* Parts ".../kind/name.so" into root and id, each to be freed. */
static bool part(const char *path, char **root, char **id)
{
    const char *name = strrchr(path, '/');
    size_t length = strlen(path);
    name = name ? name + 1 : path;
    char *above = ff_print_text("%.*s.", (int)(name - path), path);
    char *folder = realpath(above, NULL);
    free(above);
    bool good = folder && strrchr(folder, '/') && length > 3 && !strcmp(path + length - 3, ".so");
    if (good) {
        char *slash = strrchr(folder, '/');
        *id = ff_print_text("%s/%.*s", slash + 1, (int)strlen(name) - 3, name);
        *root = ff_print_text("%.*s", slash > folder ? (int)(slash - folder) : 1, folder);
    }
    free(folder);
    return good;
}

typedef struct session {
    const ff_verify *request;
    char *root, *id;
    void (*tell)(void *ctx, size_t number, const ff_verdict *verdict);
    void *ctx;
    size_t number;
    ff_report *report;
    bool good; /* the file that was given can be used */
} session;

/* False when nothing else can be tried. */
static bool try(session *s, const struct test *test)
{
    ff_verdict verdict;
    bool given = test->concern == GIVEN;
    if (given && !s->request->pipeline)
        return true;
    run_test(s->request, s->root, s->id, test, &verdict);
    if (given && verdict.finding != FF_PASSED)
        s->good = ff_error(s->report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s", verdict.why);
    else if (!given && (verdict.finding != FF_UNTRIED || verdict.why[0]))
        s->tell(s->ctx, ++s->number, &verdict);
    return test->run || test->check || verdict.finding == FF_PASSED;
}

/* What the kind asks for. The subject's own folder comes before the search path. */
static void try_kind(session *s)
{
    const char *const roots[] = {s->root};
    ff_library *library = ff_library_new(roots, 1);
    ff_report *report = ff_report_new();
    char *name = ff_copy_text(s->id, strcspn(s->id, "/"));
    ff_kindred kind;
    bool known = ff_kind_open(&kind, library, name, report);
    for (size_t i = 0; known && i < kind.asks->check_count; i++) {
        size_t offset = i * kind.asks->check_stride;
        const ff_check *check = (const void *)((const char *)kind.asks->checks + offset);
        try(s, &(struct test){check->name, check->claim, KIND, NULL, check});
    }
    if (!known) {
        ff_verdict none = {.test = "kind",
                           .claim = "keeps what its kind asks for",
                           .finding = ff_report_count(report) ? FF_FAULTY : FF_UNTRIED};
        snprintf(none.why, sizeof none.why, "%s",
                 ff_report_count(report) ? ff_report_at(report, 0)->text : "");
        if (!ff_report_count(report))
            snprintf(none.why, sizeof none.why,
                     "there is no model %s/%s that says what; the general tests were made",
                     FF_CONFORMANCE_KIND, name);
        s->tell(s->ctx, ++s->number, &none);
    }
    ff_kind_close(&kind);
    free(name);
    ff_report_free(report);
    ff_library_free(library);
}

bool ff_verify_plugin(const ff_verify *request,
                      void (*tell)(void *ctx, size_t number, const ff_verdict *verdict), void *ctx,
                      ff_report *report)
{
    session s = {.request = request, .tell = tell, .ctx = ctx, .report = report, .good = true};
    bool all = true;
    if (access(request->path, R_OK) != 0)
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be read: %s",
                        request->path, strerror(errno));
    if (!part(request->path, &s.root, &s.id))
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE,
                        "its place must be KIND/NAME.so, as its id says", "%s is no plugin",
                        request->path);
    for (size_t i = 0; i < TESTS && all; i++)
        all = try(&s, &tests[i]);
    if (all)
        try_kind(&s);
    free(s.root);
    free(s.id);
    return s.good;
}
