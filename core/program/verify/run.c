/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of tests, and the child processes that they run in. */
#include "private.h"

#include "../../engine/pipeline/tool.h"
#include "../../engine/plugin/kind.h"
#include "../../engine/value/memory.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* What a test tries: to load the model, to take the user's file, what any model or its kind owes.
 */
typedef enum matter { LOADING, GIVEN, ANY, KIND } matter;

typedef struct test {
    const char *name, *claim;
    matter matter;
    size_t rank;           /* ANY: among the tests of the verifier */
    int32_t about;         /* ANY: which models */
    const ff_check *check; /* KIND */
} test;

typedef struct session {
    const verify_request *request;
    char *root, *id;
    fe_library *library; /* the subject's own folder comes before the search path */
    const ff_verifier *verifier;
    void (*tell)(void *ctx, size_t number, const study_case_verdict *verdict);
    void *ctx;
    size_t number;
    fe_report *report;
    bool good; /* the file that was given can be used */
} session;

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool concerns(const ff_model *model, int32_t about)
{
    bool data = false;
    for (size_t i = 0; i < model->output_count; i++)
        data = data || !ff_model_output(model, i)->service;
    return (about != FF_ABOUT_PARAMS || model->param_count > 0) &&
           (about != FF_ABOUT_DATA || data) &&
           (about != FF_ABOUT_ASSESS || (FF_HAS(model, assess) && model->assess)) &&
           (about != FF_ABOUT_JUDGE || (FF_HAS(model, judge) && model->judge));
}

/* A warning at loading is a fault, too: the loader has undone it. */
static bool load(verify_examined *subject, fe_library *library, const char *id)
{
    fe_report *report = fe_report_new();
    subject->loaded = fe_library_load(library, id, FE_NOWHERE, report);
    if (fe_report_count(report))
        verify_slate_say(subject->slate, VERIFY_FAULTY, fe_report_at(report, 0)->text);
    fe_report_free(report);
    return subject->loaded && subject->slate->finding == VERIFY_PASSED;
}

/* Inputs cost a run of the pipeline; parameters do not. */
static bool take_pipeline(verify_examined *subject, const verify_request *request,
                          fe_library *library, bool inputs)
{
    fe_report *report = fe_report_new();
    snprintf(subject->slate->doing, sizeof subject->slate->doing, "running %s", request->pipeline);
    bool good = verify_exam_give(subject, request, library, inputs, report);
    char *why = fe_print_text("%s: %s", request->pipeline,
                              fe_report_count(report) ? fe_report_at(report, 0)->text
                                                      : "it cannot be used");
    if (!good)
        verify_slate_say(subject->slate, VERIFY_FAULTY, why);
    free(why);
    fe_report_free(report);
    return good;
}

static void examine(verify_examined *subject, const session *s, fe_library *library, const test *t)
{
    const verify_request *request = s->request;
    bool inputs = t->matter == KIND || t->about >= FF_ABOUT_DATA;
    verify_exam_begin(subject, library);
    if (!concerns(subject->loaded->model, t->about))
        subject->slate->finding = VERIFY_UNTRIED;
    else if (request->pipeline && !take_pipeline(subject, request, library, inputs))
        ; /* said */
    else if (t->matter == ANY)
        s->verifier->run(s->verifier->self, &subject->exam, t->rank);
    else if (t->matter == KIND)
        s->verifier->check(s->verifier->self, &subject->exam, t->check);
}

static _Noreturn void child(const session *s, const test *t, verify_slate *slate)
{
    verify_examined subject = {.slate = slate};
    const char *const roots[] = {s->root};
    fe_library *library = fe_library_new(roots, 1);
    snprintf(slate->doing, sizeof slate->doing, "loading");
    if (load(&subject, library, s->id) && t->matter != LOADING)
        examine(&subject, s, library, t);
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

static void judge(verify_slate *slate, int status, bool late, FILE *capture,
                  const verify_request *request, study_case_verdict *verdict)
{
    char words[200];
    first_words(capture, words, sizeof words);
    verdict->finding = slate->finding;
    snprintf(verdict->why, sizeof verdict->why, "%s", slate->why);
    if (slate->told && !words[0])
        return;
    verdict->finding = VERIFY_FAULTY;
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
    double end = seconds_now() + limit;
    const struct timespec pause = {.tv_nsec = 1000000};
    while (waitpid(pid, status, WNOHANG) == 0) {
        if (seconds_now() > end) {
            kill(-pid, SIGKILL);
            waitpid(pid, status, 0);
            return true;
        }
        nanosleep(&pause, NULL);
    }
    return false;
}

static void run_test(const session *s, const test *t, study_case_verdict *verdict)
{
    const struct rlimit no_core = {0, 0};
    double begin = seconds_now();
    int status = 0;
    verify_slate *slate =
        mmap(NULL, sizeof *slate, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    FILE *capture = tmpfile();
    *verdict = (study_case_verdict){.test = t->name, .claim = t->claim, .finding = VERIFY_FAULTY};
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
        child(s, t, slate);
    }
    setpgid(pid, pid);
    bool late = pid > 0 && await(pid, s->request->limit, &status);
    judge(slate, status, late, capture, s->request, verdict);
    verdict->seconds = seconds_now() - begin;
    fclose(capture);
    munmap(slate, sizeof *slate);
}

/* Parts ".../kind/name.so" into root and id, each to be freed. */
static bool part(const char *path, char **root, char **id)
{
    const char *name = strrchr(path, '/');
    size_t length = strlen(path);
    name = name ? name + 1 : path;
    char *above = fe_print_text("%.*s.", (int)(name - path), path);
    char *folder = realpath(above, NULL);
    free(above);
    bool good = folder && strrchr(folder, '/') && length > 3 && !strcmp(path + length - 3, ".so");
    if (good) {
        char *slash = strrchr(folder, '/');
        *id = fe_print_text("%s/%.*s", slash + 1, (int)strlen(name) - 3, name);
        *root = fe_print_text("%.*s", slash > folder ? (int)(slash - folder) : 1, folder);
    }
    free(folder);
    return good;
}

/* False when nothing else can be tried. */
static bool try(session *s, const test *t)
{
    study_case_verdict verdict;
    bool given = t->matter == GIVEN;
    if (given && !s->request->pipeline)
        return true;
    run_test(s, t, &verdict);
    if (given && verdict.finding != VERIFY_PASSED)
        s->good = fe_error(s->report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "%s", verdict.why);
    else if (!given && (verdict.finding != VERIFY_UNTRIED || verdict.why[0]))
        s->tell(s->ctx, ++s->number, &verdict);
    return t->matter >= ANY || verdict.finding == VERIFY_PASSED;
}

static void try_any(session *s)
{
    const ff_verifier *v = s->verifier;
    for (size_t i = 0; i < v->test_count; i++) {
        const ff_verifier_test *row = (const void *)((const char *)v->tests + i * v->test_stride);
        try(s, &(test){row->name, row->claim, ANY, i, row->about, NULL});
    }
}

/* What the kind asks for. */
static void try_kind(session *s)
{
    fe_report *report = fe_report_new();
    char *name = fe_copy_text(s->id, strcspn(s->id, "/"));
    fe_kindred kind;
    bool known = fe_kind_open(&kind, s->library, name, report);
    for (size_t i = 0; known && i < kind.asks->check_count; i++) {
        size_t offset = i * kind.asks->check_stride;
        const ff_check *check = (const void *)((const char *)kind.asks->checks + offset);
        try(s, &(test){check->name, check->claim, KIND, 0, FF_ABOUT_ALL, check});
    }
    if (!known) {
        study_case_verdict none = {.test = "kind",
                                   .claim = "keeps what its kind asks for",
                                   .finding =
                                       fe_report_count(report) ? VERIFY_FAULTY : VERIFY_UNTRIED};
        snprintf(none.why, sizeof none.why, "%s",
                 fe_report_count(report) ? fe_report_at(report, 0)->text : "");
        if (!fe_report_count(report))
            snprintf(none.why, sizeof none.why,
                     "there is no model %s/%s that says what; the general tests were made",
                     FF_CONFORMANCE_KIND, name);
        s->tell(s->ctx, ++s->number, &none);
    }
    fe_kind_close(&kind);
    free(name);
    fe_report_free(report);
}

bool verify_plugin(const verify_request *request,
                   void (*tell)(void *ctx, size_t number, const study_case_verdict *verdict),
                   void *ctx, fe_report *report)
{
    static const test descriptor = {.name = "descriptor",
                                    .claim = "loads and keeps the rules for tables",
                                    .matter = LOADING},
                      pipeline = {.name = "pipeline",
                                  .claim = "the file gives it parameters",
                                  .matter = GIVEN};
    const fe_tool_choice choice = {
        .option = "verify", .interface = FF_VERIFIER_ID, .name = VERIFY_VERIFIER};
    session s = {.request = request, .tell = tell, .ctx = ctx, .report = report, .good = true};
    fe_tool tool = {.table = NULL};
    if (access(request->path, R_OK) != 0)
        return fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "%s cannot be read: %s",
                        request->path, strerror(errno));
    if (!part(request->path, &s.root, &s.id))
        return fe_error(report, FE_EXIT_INPUT, FE_NOWHERE,
                        "its place must be KIND/NAME.so, as its id says", "%s is no plugin",
                        request->path);
    const char *const roots[] = {s.root};
    s.library = fe_library_new(roots, 1);
    s.good = fe_tool_open(&tool, s.library, &choice, report);
    s.verifier = tool.table;
    if (s.good && try(&s, &descriptor) && try(&s, &pipeline)) {
        try_any(&s);
        try_kind(&s);
    }
    fe_tool_close(&tool);
    fe_library_free(s.library);
    free(s.root);
    free(s.id);
    return s.good;
}
