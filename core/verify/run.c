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
typedef enum concern { ANY, GIVEN, PARAMS, KERNEL, DATA } concern;

static const struct test {
    const char *name, *claim;
    concern concern;
    bool (*run)(ff_subject *subject); /* NULL: loading is all */
} tests[] = {
    {"descriptor", "loads and keeps the rules for tables", ANY, NULL},
    {"pipeline", "the file gives it parameters", GIVEN, NULL},
    {"references", "licence, reference and BibTeX can be read", ANY, ff_test_references},
    {"presets", "presets lie in the calibrated range", PARAMS, ff_test_presets},
    {"life", "lives and dies in every legal order", ANY, ff_test_life},
    {"leaks", "a thousand lives leave no memory behind", ANY, ff_test_leaks},
    {"allocations", "survives a failing allocation", ANY, ff_test_allocations},
    {"limits", "takes parameters in and at their limits, or says why not", PARAMS, ff_test_limits},
    {"environment", "leaves locale, arithmetic, signals and folder alone", ANY,
     ff_test_environment},
    {"empty", "a batch of no points is legal", KERNEL, ff_test_empty},
    {"guards", "writes its results and nothing else", KERNEL, ff_test_guards},
    {"batch", "a batch gives what single calls give", KERNEL, ff_test_batch},
    {"finite", "is finite for extreme arguments", KERNEL, ff_test_finite},
    {"derivatives", "derivatives agree with differences", KERNEL, ff_test_derivatives},
    {"physics", "has the sign and slope that physics asks for", KERNEL, ff_test_physics},
    {"purity", "gives the same answers again, and in two threads", KERNEL, ff_test_purity},
    {"inputs", "gives finite outputs or a reason for any input", DATA, ff_test_inputs},
    {"wanted", "gives each output that is wanted", DATA, ff_test_wanted},
    {"repeat", "gives the same outputs again, and in two threads", DATA, ff_test_repeat},
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
    bool kernel = false;
    for (size_t i = 0; i < model->output_count; i++)
        for (size_t k = 0; k < ff_kernel_count && ff_model_output(model, i)->service; k++)
            kernel = kernel || !strcmp(ff_kernels[k].service, ff_model_output(model, i)->service);
    return what == ANY || what == GIVEN || (what == PARAMS && model->param_count > 0) ||
           (what == KERNEL && kernel) || (what == DATA && ff_all_outputs(model));
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
    subject->given = ff_feed_from_pipeline(request, library, subject->loaded, inputs, report);
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
    if (load(&subject, library, id) && (test->run || test->concern == GIVEN)) {
        if (!concerns(subject.loaded->model, test->concern))
            slate->finding = FF_UNTRIED;
        else if ((!request->pipeline ||
                  take_pipeline(&subject, request, library, test->concern == DATA)) &&
                 test->run)
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

/* Parts ".../viscosity/barus.so" into root and id, each to be freed. */
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

bool ff_verify_plugin(const ff_verify *request,
                      void (*tell)(void *ctx, size_t number, const ff_verdict *verdict), void *ctx,
                      ff_report *report)
{
    char *root, *id;
    size_t number = 0;
    bool good = true;
    if (access(request->path, R_OK) != 0)
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be read: %s",
                        request->path, strerror(errno));
    if (!part(request->path, &root, &id))
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE,
                        "its place must be KIND/NAME.so, as its id says", "%s is no plugin",
                        request->path);
    for (size_t i = 0; i < TESTS; i++) {
        ff_verdict verdict;
        bool given = tests[i].concern == GIVEN;
        if (given && !request->pipeline)
            continue;
        run_test(request, root, id, &tests[i], &verdict);
        if (given && verdict.finding != FF_PASSED)
            good = ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s", verdict.why);
        else if (!given && (verdict.finding != FF_UNTRIED || verdict.why[0]))
            tell(ctx, ++number, &verdict);
        if (!tests[i].run && verdict.finding != FF_PASSED)
            break;
    }
    free(root);
    free(id);
    return good;
}
