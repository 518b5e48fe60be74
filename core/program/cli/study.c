/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands run and plan for studies. The driver of a study chooses later cases from the results
 * of earlier cases; a plain sweep has no driver. */
#include "../terminal/terminal.h"
#include "command.h"
#include "spectrum.h"

#include "../memory/memory.h"
#include "../results/derived-files.h"
#include "../results/json.h"
#include "../results/write.h"
#include "../study/cases/case.h"
#include "../study/cases/rows.h"
#include "../study/kinds/answer/number.h"
#include "../terminal/answer.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Returns the number of cores that this process may use. */
static size_t count_cores(void)
{
    cpu_set_t set;
    int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count > 0 ? (size_t)count : 1;
}

/* The progress of a study: on a terminal a line that is redrawn, elsewhere one line a minute. */
typedef struct study_progress {
    const cli_session *session;
    const cli_options *options;
    results_input input;
    const char *directory;
    bool driven; /* the study's driver has run */
    bool entered;
    char *replaced; /* how the inputs of earlier results differ, or NULL */
    char *removed;  /* removed files that were derived from earlier results, or NULL */
    /* the sums over the rows of a load spectrum; empty until all rows are done */
    study_context sums;
    bool terminal;
    double printed_at; /* time of the last progress line, s after the start */
} study_progress;

static void print_progress(void *ctx, const study_counters *counters)
{
    study_progress *t = ctx;
    size_t fresh = counters->done - counters->before, left = counters->total - counters->done;
    double rate = counters->seconds > 0 ? (double)fresh / counters->seconds : 0;
    if (!t->terminal && counters->seconds - t->printed_at < 60)
        return;
    t->printed_at = counters->seconds;
    fprintf(stderr, "%s%zu of %zu cases, %zu failed, %.3g cases/s", t->terminal ? "\r\033[K" : "",
            counters->done, counters->total, counters->failed, rate);
    if (rate > 0 && left > 0)
        fprintf(stderr, ", %.3g s left", (double)left / rate);
    if (!t->terminal)
        fputc('\n', stderr);
}

static void describe(void *ctx, const study_definition *study, const study_tally *tally, FILE *out)
{
    const study_progress *t = ctx;
    const results_study of = {.input = &t->input, .engine = t->session->engine};
    results_write_study_json(&of, study, tally, out);
}

/* Removes the table of an earlier run, which is about other cases. The cases stay in the journal,
 * whatever their inputs. A driver calls this for each batch of its cases. */
static bool enter(void *ctx, ff_report *report)
{
    study_progress *t = ctx;
    if (t->entered)
        return true;
    if (!results_earlier_check_study(t->directory, &t->input, &t->replaced, report))
        return false;
    char *table = memory_print_text("%s/table.csv", t->directory);
    unlink(table);
    free(table);
    t->removed = results_made_remove(t->directory);
    t->entered = true;
    return true;
}

/* Answers a row at once, since the program that sends rows may wait for the answer before it sends
 * the next row. If nobody reads the answers any more, the run ends. */
static void answer_row(void *ctx, size_t index, const json_t *record, bool known)
{
    const study_progress *t = ctx;
    json_t *set = study_case_set(t->session->study, index);
    if (!cli_answer_row(index, set, record, known))
        raise(SIGTERM);
    json_decref(set);
}

/* Reads the heading of standard input, which names the parameters that the rows set. */
static bool begin_rows(study_run *run, const cli_options *options, ff_report *report)
{
    const study_definition *study = run->study;
    if (!study->streams)
        return true;
    if (options->shards || run->executor)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "write the rows to a file",
                        "study: cases: rows from standard input cannot be distributed");
    if (!options->json)
        terminal_answer_begin();
    run->answer = answer_row;
    return study_rows_begin(study->rows, report);
}

/* Prints a line of the study's driver. */
static void print_driver_line(void *ctx, int indent, const char *line)
{
    const study_progress *t = ctx;
    int blanks = (int)strspn(line, " ");
    if (t->options->json)
        return;
    if (t->terminal) {
        fputs("\r\033[K", stderr); /* clears the progress line */
        fflush(stderr);
    }
    if (indent == 0)
        terminal_print_cut(line, 0);
    else if (indent < 0)
        puts(line);
    else
        terminal_print_wrapped(line + blanks, printf("%*s", blanks, ""), indent);
}

static study_run run_of(const cli_session *session, const cli_options *options, char *directory)
{
    const char *executor = cli_option(options, "executor");
    study_run run = {.study = session->study,
                     .described = session->study,
                     .file = options->operand,
                     .sets = options->sets,
                     .set_count = options->set_count,
                     .engine = session->engine,
                     .directory = directory,
                     .pipeline = session->pipeline,
                     .jobs = options->jobs ? options->jobs
                             : executor    ? 1
                                           : count_cores(),
                     .shard = options->shard ? options->shard : 1,
                     .shards = options->shards ? options->shards : 1,
                     .rerun = options->rerun_all      ? STUDY_RERUN_ALL
                              : options->rerun_failed ? STUDY_RERUN_FAILED
                                                      : STUDY_RERUN_NONE,
                     .fail_fast = cli_option(options, "fail-fast") != NULL,
                     .against = results_against};
    if (!options->shards && !session->study->streams)
        cli_shard_find(&run, executor != NULL, session->report);
    if (!options->shards && run.shards > 1 && !options->json && !executor)
        fprintf(stderr, "shard %zu/%zu, from Slurm\n", run.shard, run.shards);
    return run;
}

void cli_print_savings(const study_reuse_counts *savings)
{
    if (savings->computed + savings->reused == 0)
        return;
    printf("stages: %zu computed in %.3g s", savings->computed, savings->spent);
    if (savings->reused)
        printf(", %zu reused from other cases, which saved %.3g s", savings->reused,
               savings->saved);
    putchar('\n');
}

json_t *cli_json_savings(const study_reuse_counts *savings)
{
    return json_pack("{s:I, s:f, s:I, s:f}", "computed", (json_int_t)savings->computed, "seconds",
                     savings->spent, "reused", (json_int_t)savings->reused, "saved",
                     savings->saved);
}

/* Prints the known cases of a study whose driver has not run. */
static void print_known_cases(const study_definition *study)
{
    printf("these are %s that are known beforehand; a run in one process does the rest and reuses "
           "them\n",
           study_cases(study));
}

/* Prints the last line. The number of cases is left out if the driver has not fixed it. */
static void print_last_line(const study_definition *study, const study_counters *counters)
{
    char *verdicts = study_tally_text(&counters->tally);
    printf("%zu ", counters->done);
    if (!study->driver || !*study_further(study))
        printf("of %zu ", counters->total);
    fputs("cases done", stdout);
    if (counters->before)
        printf(", %zu of them earlier", counters->before);
    if (*verdicts)
        printf(": %s", verdicts);
    if (counters->failed + counters->tally.counts[STUDY_CASE_REFUSED])
        fputs("; the column \"reason\" of the table says why", stdout);
    putchar('\n');
    free(verdicts);
}

/* What the driver of the study found, or the sums over its rows. */
static const study_context *found(const study_progress *t)
{
    const study_context *driven = study_found(t->session->study);
    return driven ? driven : &t->sums;
}

/* Returns "map.csv, map.json, ", to be freed. */
static char *list_files(const study_context *of)
{
    char *text = memory_print_text("%s", "");
    for (size_t i = 0; i < of->file_count; i++)
        memory_add_text(&text, "%s, ", of->files[i].name);
    return text;
}

/* Prints which derived files are gone, except those that have been written again. */
static void print_removed(char *removed, const char *files)
{
    char *rest = NULL, *gone = memory_print_text("%s", "");
    const char *name = removed ? strtok_r(removed, ", ", &rest) : NULL;
    for (; name; name = strtok_r(NULL, ", ", &rest)) {
        char *listed = memory_print_text("%s, ", name);
        if (!strstr(files, listed))
            memory_add_text(&gone, "%s%s", *gone ? ", " : "", name);
        free(listed);
    }
    if (*gone)
        printf("removed, since it was made from earlier results: %s\n", gone);
    free(gone);
}

static void print_end(const study_progress *t, const study_counters *counters, bool good,
                      ff_report *report)
{
    const study_definition *study = t->session->study;
    const char *directory = t->directory;
    char *files = list_files(found(t));
    terminal_print_messages(report, stderr, terminal_colour(stderr));
    cli_print_savings(&counters->savings);
    if (t->replaced)
        printf("the table of an earlier run is replaced (%s); its cases stay in the journal\n",
               t->replaced);
    print_removed(t->removed, files);
    if (good && *files)
        printf("results in %s: %stable.csv\n", directory, files);
    else if (good)
        printf("results in %s/table.csv\n", directory);
    if (good)
        printf("as a page with figures: flankfilm report %s\n", directory);
    free(files);
    if (good && study->driver && !t->driven)
        print_known_cases(study);
    print_last_line(study, counters);
}

static void answer_end(const study_progress *t, const study_counters *counters, int code,
                       ff_report *report)
{
    const char *directory = t->directory;
    bool good = code == EXIT_SUCCESS || code == CLI_EXIT_CASES;
    json_t *answer = results_json_answer(good ? "ok" : "error", code, report);
    json_object_update_new(
        answer,
        json_pack("{s:I, s:I, s:I, s:I, s:o, s:o}", "cases", (json_int_t)counters->total, "done",
                  (json_int_t)counters->done, "before", (json_int_t)counters->before, "failed",
                  (json_int_t)counters->failed, "stages", cli_json_savings(&counters->savings),
                  "directory", results_json_text(directory)));
    study_tally_describe(&counters->tally, answer);
    json_object_update(answer, found(t)->facts);
    results_json_print(answer);
}

/* Decides whether the driver runs the study. A distributed run computes only the cases that are
 * known beforehand, without the driver. A study that measures costs cannot be distributed. False
 * after an error. */
static bool settle_driver(const study_run *run, bool *driven, ff_report *report)
{
    bool spread = run->executor || run->shards > 1;
    *driven = run->study->driver && !spread;
    return !spread || !run->study->measure ||
           ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "run it in one process on an idle machine",
                    "this study measures costs, one case at a time, and cannot be distributed");
}

/* Records these files as derived from the results, so that they are removed if the cases change. */
static void note_files(const study_context *of, const char *directory)
{
    for (size_t i = 0; i < of->file_count; i++) {
        char *path = memory_print_text("%s/%s", directory, of->files[i].name);
        results_made_note(directory, path, path);
        free(path);
    }
}

/* Opens what the run needs in addition to the file; false after an error. */
static bool begin_run(study_run *run, cli_session *session, const cli_options *options,
                      study_progress *t)
{
    run->progress = options->json ? NULL : print_progress;
    run->enter = enter;
    run->describe = describe;
    run->print_line = print_driver_line;
    run->ctx = t;
    if (cli_option(options, "executor"))
        run->executor = cli_executor_open(session->engine, options, session->report);
    return ff_report_errors(session->report) == 0 && begin_rows(run, options, session->report);
}

static void print_or_answer(const study_progress *t, const study_counters *counters, bool good,
                            int code, ff_report *report)
{
    if (counters->leads && t->options->json)
        answer_end(t, counters, code, report);
    else if (counters->leads)
        print_end(t, counters, good, report);
    else
        terminal_print_messages(report, stderr, terminal_colour(stderr));
}

/* Whether --strict makes the study a failure. */
static bool is_strict_about(const study_counters *counters, const cli_options *options,
                            const ff_report *report, bool print)
{
    const study_tally *tally = &counters->tally;
    return cli_is_strict_about(options, tally->counts[FF_DOUBTFUL] > 0,
                               tally->limits[LIMITS_WITHIN] + tally->limits[LIMITS_MISSED] > 0,
                               report, print);
}

/* Runs the study and prints its progress and results; returns the exit code. */
static int run_and_print(const study_run *run, study_progress *t, ff_report *report)
{
    const cli_options *options = t->options;
    study_counters counters = {.total = 0};
    study_signals before;
    study_signals_catch(&before);
    bool settled = settle_driver(run, &t->driven, report), driven = t->driven;
    bool good = settled && (driven ? study_drive(run, &counters, report)
                                   : study_execute(run, &counters, report));
    study_signals_restore(&before);
    if (good && counters.leads && run->keys)
        good = cli_spectrum_sum(run, &t->sums);
    int verdict = driven ? found(t)->verdict : -1;
    bool bad = verdict < 0 ? counters.failed > 0 : verdict == FF_BAD;
    const bool strict = is_strict_about(&counters, options, report, false);
    bad = bad || strict;
    int code = !good ? ff_report_fault(report) : bad ? CLI_EXIT_CASES : EXIT_SUCCESS;
    if (t->terminal && run->progress)
        fputs("\r\033[K", stderr);
    if (!good && (driven || !settled || counters.leads) && counters.total == 0)
        code = cli_refuse(report, options, "nothing was run");
    else
        print_or_answer(t, &counters, good, code, report);
    if (good && strict && !options->json && counters.leads)
        is_strict_about(&counters, options, report, true);
    if (good)
        note_files(found(t), t->directory);
    study_tally_free(&counters.tally);
    return code;
}

int cli_run_study(cli_session *session, const cli_options *options)
{
    char *directory = cli_study_directory(options);
    char input[20];
    study_run run = run_of(session, options, directory);
    study_progress t = {
        .session = session,
        .sums = {.report = session->report},
        .options = options,
        .input = {.file = options->operand,
                  .sets = options->sets,
                  .set_count = options->set_count,
                  .pipeline = session->pipeline,
                  .accuracy =
                      "", /* the accuracy is part of the key of each case, not of the study */
                  .key = results_input_key(session->pipeline, ""),
                  .replace = cli_option(options, "replace") != NULL},
        .directory = directory,
        .terminal = isatty(STDERR_FILENO) != 0};
    snprintf(input, sizeof input, "%016llx", (unsigned long long)t.input.key);
    run.input = input;
    if (session->study->spectrum)
        run.keys = memory_alloc((session->study->count + 1) * sizeof *run.keys);
    int code = begin_run(&run, session, options, &t)
                   ? run_and_print(&run, &t, session->report)
                   : cli_refuse(session->report, options, "nothing was run");
    ff_instance_close(run.executor);
    study_context_free(&t.sums);
    free(run.keys);
    free(t.replaced);
    free(t.removed);
    free(directory);
    return code;
}

static void print_varied(const study_definition *study)
{
    for (size_t k = 0; k < study->varied_count; k++) {
        const study_varied *varied = &study->varied[k];
        size_t points = study->points[varied->axis];
        bool chain = varied->axis == study->followed;
        char *text =
            memory_print_text("%s%s%s%s", study_varied_value(varied, 0), points > 1 ? " ... " : "",
                              points > 1 ? study_varied_value(varied, points - 1) : "",
                              chain ? ", each starts from its neighbour" : "");
        printf("  %-32s %6zu values: ", varied->path, points);
        terminal_print_cut(text, 49);
        free(text);
    }
}

void cli_print_cases(const study_definition *study)
{
    const char *kind = study_kind_name(study), *further = study_further(study);
    if (study->streams) {
        puts("one case for each row of standard input");
        return;
    }
    printf("%s%s%zu %s%s%s\n", kind, *kind ? ": " : "", study->count, study_cases(study),
           *further ? ", " : "", further);
    print_varied(study);
}

static void print_plan(const study_run *run, const study_plan *plan)
{
    cli_print_cases(run->study);
    if (run->study->streams)
        return;
    if (run->shards > 1)
        printf("shard %zu/%zu: ", run->shard, run->shards);
    printf("%zu done, %zu failed, %zu to run", plan->done, plan->failed, plan->left);
    if (plan->left && plan->seconds >= 0)
        printf(", about %.3g s with %zu workers", plan->seconds, run->jobs);
    putchar('\n');
    if (plan->again)
        printf("an earlier run did %zu of these with other inputs; changes of the first:\n",
               plan->again);
    for (const char *line = plan->changed; *line; line += strcspn(line, "\n") + 1)
        printf("  %.*s\n", (int)strcspn(line, "\n"), line);
}

/* Returns the lines as a list. */
static json_t *changes(const char *lines)
{
    json_t *list = json_array();
    for (; *lines; lines += strcspn(lines, "\n") + 1) {
        char *line = memory_print_text("%.*s", (int)strcspn(lines, "\n"), lines);
        json_array_append_new(list, results_json_text(line));
        free(line);
    }
    return list;
}

int cli_plan_study(const cli_options *options)
{
    cli_session session;
    study_plan plan = {.left = 0};
    char *directory = cli_study_directory(options);
    bool good = cli_session_open(&session, options, false);
    int code = EXIT_SUCCESS;
    if (good && !session.study)
        good = ff_error(session.report, FF_FAULT_INPUT, FF_NOWHERE,
                        "flankfilm explain shows what a single case would run", "%s has no study",
                        options->operand);
    study_run run = good ? run_of(&session, options, directory) : (study_run){0};
    good = good && ff_report_errors(session.report) == 0 &&
           study_check_format(directory, session.report);
    if (good)
        study_plan_run(&run, &plan);
    if (!good) {
        code = cli_refuse(session.report, options, "nothing was run");
    } else if (options->json) {
        json_t *answer = results_json_answer("ok", code, session.report);
        json_object_update_new(
            answer, json_pack("{s:I, s:I, s:I, s:I, s:I, s:o, s:o}", "cases",
                              (json_int_t)session.study->count, "done", (json_int_t)plan.done,
                              "failed", (json_int_t)plan.failed, "left", (json_int_t)plan.left,
                              "again", (json_int_t)plan.again, "changed", changes(plan.changed),
                              "seconds", plan.seconds < 0 ? json_null() : json_real(plan.seconds)));
        results_json_print(answer);
    } else {
        print_plan(&run, &plan);
    }
    free(directory);
    cli_session_close(&session);
    return code;
}
