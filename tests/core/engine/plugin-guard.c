/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faults inside plugins end the program with exit code 3 and one sentence. */
#include "../../../core/program/crash/crash.h"
#include "../../../core/program/crash/lead.h"
#include "pipeline-try.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What the program does around its command. Returns in the process that works. */
static void begin(void)
{
    crash_end end;
    if (crash_lead(&end)) {
        if (end.sentence[0])
            fprintf(stderr, "error: %s\n", end.sentence);
        fflush(stderr);
        _exit(end.code);
    }
    crash_install();
}

static int work(const char *fault)
{
    char text[256];
    begin();
    snprintf(text, sizeof text,
             "pipeline:\n"
             "  film: {use: faulty/%s}\n"
             "outputs: [film.level, film.series]\n",
             fault);
    attempt a = try_run(text);
    char *said = ff_report_text(a.report, false);
    fputs(said, stderr);
    ff_free(said);
    int code = ff_report_fault(a.report);
    try_close(&a);
    fflush(stderr);
    crash_leave(code);
}

static size_t count_lines(const char *text)
{
    size_t lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}

/* A crash: no report is printed any more, so stderr holds the sentence alone. */
static void dies(const char *fault, const char *phrase)
{
    char file[64];
    remains r = try_child(work, fault);
    snprintf(file, sizeof file, "faulty/%s.so", fault);
    if (!check_true(fault, r.exit_code == FF_FAULT_PLUGIN && strstr(r.err, phrase) &&
                               strstr(r.err, file) && count_lines(r.err) == 1))
        printf("    exit %d, signal %d: %s\n", r.exit_code, r.signal, r.err);
    check_true("stdout stays empty", r.out[0] == 0);
}

static void fails(const char *fault, int exit_code, const char *phrase)
{
    remains r = try_child(work, fault);
    if (!check_true(fault, r.exit_code == exit_code && strstr(r.err, phrase)))
        printf("    exit %d, signal %d: %s\n", r.exit_code, r.signal, r.err);
}

static void deaths(void)
{
    dies("crash-load", "crashed during load: segmentation fault");
    dies("crash-entry", "crashed during load: segmentation fault");
    dies("crash-create", "film: the plugin ");
    dies("crash-create", "crashed during create: segmentation fault");
    dies("crash-set", "crashed during set: segmentation fault");
    dies("crash-ready", "crashed during ready: segmentation fault");
    dies("crash-evaluate", "crashed during evaluate: segmentation fault");
    dies("crash-destroy", "crashed during destroy: segmentation fault");
    dies("overflow", "crashed during evaluate: segmentation fault");
    dies("divide", "crashed during evaluate: arithmetic fault");
    dies("abort", "crashed during evaluate: abort");
    dies("exit", "ended the program during evaluate: it called exit()");
    dies("thread", "crashed during evaluate: segmentation fault");
    dies("thread-exit", "ended the program during evaluate: exit code 0");
    dies("exit-entry", "ended the program during load: it called exit()");
}

static void breaches(void)
{
    fails("nan", FF_FAULT_PLUGIN, "gave NaN at index 2 of the output \"series\"");
    fails("infinite", FF_FAULT_PLUGIN,
          "gave an infinite number at index 0 of the output \"level\"");
    fails("missing", FF_FAULT_PLUGIN, "did not give the output \"level\"");
    fails("rank", FF_FAULT_PLUGIN, "gave the output \"level\" with 6 dimensions");
    fails("lengths", FF_FAULT_PLUGIN, "the dimension \"t\" is 3 long in \"series\", but 4");
    fails("twice", FF_FAULT_PLUGIN, "gave the output \"series\" twice");
    fails("row", FF_FAULT_PLUGIN, "output row 99");
    fails("early-output", FF_FAULT_PLUGIN, "outside of evaluate");
    fails("verdict", FF_FAULT_PLUGIN, "unknown verdict 99");
    fails("huge", FF_FAULT_RUN, "not enough memory for the output \"series\"");
    fails("fail-create", FF_FAULT_PLUGIN, "bytes ?? and lines");
    fails("rounding", FF_FAULT_NONE, "changed the rounding mode during evaluate");
    fails("locale", FF_FAULT_NONE, "changed the locale during evaluate");
    remains r = try_child(work, "none");
    check_true("a model without a fault", r.exit_code == FF_FAULT_NONE && !r.err[0]);
}

static int crash_alone(const char *argument)
{
    (void)argument;
    begin();
    raise(SIGABRT);
    return 0;
}

static int fault_alone(const char *argument)
{
    static int *volatile nowhere = NULL;
    (void)argument;
    signal(SIGSEGV, SIG_DFL); /* a sanitizer's handler would stand there */
    begin();
    *nowhere = 1;
    return 0;
}

static int exit_alone(const char *argument)
{
    (void)argument;
    begin();
    exit(5);
}

static void without_plugin(void)
{
    check_true("abort with no plugin at work", try_child(crash_alone, "").signal == SIGABRT);
#ifndef __SANITIZE_ADDRESS__
    check_true("fault with no plugin at work", try_child(fault_alone, "").signal == SIGSEGV);
#else
    (void)fault_alone;
#endif
    remains r = try_child(exit_alone, "");
    check_true("exit with no plugin at work", r.exit_code == 5 && r.out[0] == 0 && r.err[0] == 0);
}

int main(void)
{
    deaths();
    breaches();
    without_plugin();
    return check_done();
}
