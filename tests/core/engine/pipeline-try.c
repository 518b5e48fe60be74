/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pipeline-try.h"

#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

const char *try_plugins(void)
{
    const char *directory = getenv("FLANKFILM_TEST_BAD");
    return directory ? directory : "tests/bad/plugins";
}

ff_engine *try_engine(const char *const *directories, size_t count)
{
    const ff_engine_options options = {sizeof options, directories, count};
    ff_engine *engine;
    if (ff_engine_new(&options, &engine) != FF_OK)
        exit(2);
    return engine;
}

static attempt begin(const char *text, const char *assignment, bool everything)
{
    const char *const directories[] = {try_plugins()};
    char whole[8192];
    snprintf(whole, sizeof whole, "format: 2\n%s", text);
    attempt a = {.report = ff_report_new(), .engine = try_engine(directories, 1)};
    a.tree = fe_tree_parse("case.yaml", ".", whole, a.report);
    if (assignment)
        fe_tree_set(a.tree, assignment, NULL, NULL, a.report);
    a.pipeline = fe_pipeline_build(a.tree, a.engine, everything, a.report);
    return a;
}

attempt try_build(const char *text, bool everything)
{
    return begin(text, NULL, everything);
}

attempt try_build_set(const char *text, const char *assignment, bool everything)
{
    return begin(text, assignment, everything);
}

attempt try_run(const char *text)
{
    attempt a = begin(text, NULL, false);
    if (a.pipeline && ff_report_errors(a.report) == 0)
        fe_pipeline_run(a.pipeline, NULL, a.report);
    return a;
}

void try_close(attempt *a)
{
    fe_pipeline_free(a->pipeline);
    fe_tree_free(a->tree);
    ff_engine_close(a->engine);
    ff_report_free(a->report);
}

const ff_stage *try_stage(const attempt *a, const char *name)
{
    for (size_t i = 0; a->pipeline && i < a->pipeline->count; i++)
        if (!strcmp(a->pipeline->stages[i].name, name))
            return &a->pipeline->stages[i];
    return NULL;
}

const ff_bound *try_param(const attempt *a, const char *of, const char *param)
{
    const ff_stage *s = try_stage(a, of);
    int row = s && s->params ? ff_model_find_param(s->loaded->model, param) : -1;
    return row < 0 ? NULL : &s->params[row];
}

const ff_result *try_result(const attempt *a, const char *of, const char *output)
{
    const ff_stage *s = try_stage(a, of);
    int row = s && s->loaded ? ff_model_find_output(s->loaded->model, output) : -1;
    return row < 0 ? NULL : &s->results[row];
}

double try_scalar(const attempt *a, const char *of, const char *output)
{
    const ff_result *result = try_result(a, of, output);
    return result && result->data ? result->data[0] : NAN;
}

bool try_says(const attempt *a, ff_severity severity, unsigned line, unsigned column,
              const char *phrase)
{
    for (size_t i = 0; i < ff_report_count(a->report); i++) {
        const ff_message *m = ff_report_at(a->report, i);
        bool here = line == 0 || (m->place.line == line && m->place.column == column);
        if (m->severity == severity && here &&
            (strstr(m->text, phrase) || (m->hint && strstr(m->hint, phrase))))
            return true;
    }
    return false;
}

void try_print(const attempt *a)
{
    for (size_t i = 0; i < ff_report_count(a->report); i++) {
        const ff_message *m = ff_report_at(a->report, i);
        printf("    %u:%u: %s%s%s\n", m->place.line, m->place.column, m->text,
               m->hint ? "\n        hint: " : "", m->hint ? m->hint : "");
    }
}

void check_good(const char *what, const attempt *a)
{
    if (!check_true(what, a->pipeline && ff_report_errors(a->report) == 0))
        try_print(a);
}

void check_error(const char *what, const attempt *a, unsigned line, unsigned column,
                 const char *phrase)
{
    if (!check_true(what, try_says(a, FF_ERROR, line, column, phrase))) {
        printf("    wanted at %u:%u: %s\n", line, column, phrase);
        try_print(a);
    }
}

static void collect(int out, int err, remains *r)
{
    struct pollfd files[2] = {{.fd = out, .events = POLLIN}, {.fd = err, .events = POLLIN}};
    char *texts[2] = {r->out, r->err};
    size_t used[2] = {0, 0};
    int open = 2;
    while (open > 0 && poll(files, 2, 20000) > 0)
        for (int i = 0; i < 2; i++) {
            if (files[i].fd < 0 || !files[i].revents)
                continue;
            ssize_t got = read(files[i].fd, texts[i] + used[i], sizeof r->out - 1 - used[i]);
            if (got > 0) {
                used[i] += (size_t)got;
            } else {
                close(files[i].fd);
                files[i].fd = -1;
                open--;
            }
        }
}

remains try_child(int (*work)(const char *argument), const char *argument)
{
    remains r = {.exit_code = -1};
    int out[2], err[2], status;
    fflush(stdout);
    if (pipe(out) != 0 || pipe(err) != 0)
        exit(2);
    pid_t child = fork();
    if (child == 0) {
        dup2(out[1], STDOUT_FILENO);
        dup2(err[1], STDERR_FILENO);
        close(out[0]);
        close(err[0]);
        alarm(20);
        exit(work(argument));
    }
    close(out[1]);
    close(err[1]);
    collect(out[0], err[0], &r);
    waitpid(child, &status, 0);
    if (WIFEXITED(status))
        r.exit_code = WEXITSTATUS(status);
    else
        r.signal = WTERMSIG(status);
    return r;
}
