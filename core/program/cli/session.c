/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens the file that a command is given. */
#include "session.h"

#include "../terminal/terminal.h"
#include "oil.h"

#include "../accuracy/models.h"
#include "../limits/limits.h"
#include "../memory/memory.h"
#include "../results/json.h"
#include "../run/run.h"
#include "../study/cases/case.h"
#include "../study/store/hash.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ERRORS = 20 };

/* Returns the case that a command shows as an example of a study: the first that can be built.
 * Cases before it may be idle rows of a spectrum, or impossible values in a study that searches for
 * the limits of the possible. `count` if there is none. */
static size_t first_case(const cli_session *session, const cli_options *options)
{
    const study_definition *study = session->study;
    size_t most = study->driver ? CLI_MOST_SPREAD : CLI_MOST_ROWS;
    for (size_t index = 0; index < study->count && index < most; index++) {
        ff_run *run = cli_session_try(session, options, index, false);
        bool passed =
            study->driver ? run_has_errors(run) : study_case_is_refused(study, ff_run_report(run));
        ff_run_close(run);
        if (!passed)
            return index;
    }
    return study->driver ? study->count : 0;
}

/* Applies the example case of the study to the file. If no case can be built, the file stays as it
 * is. */
static void apply_case(const cli_session *session, const cli_options *options, ff_run *run)
{
    if (session->first < session->study->count)
        study_overlay(session->study, session->first, options->sets, options->set_count, run);
    else
        run_put(run, "outputs", session->study->request);
}

static bool open_study(cli_session *session, const cli_options *options)
{
    const ff_node *node = ff_node_get(ff_run_root(session->run), "study");
    if (!node || (node->kind == FF_SCALAR && !*node->text))
        return true;
    size_t errors = ff_report_errors(session->report);
    session->study = study_open(ff_run_root(session->run), session->report);
    if (ff_report_errors(session->report) > errors)
        return false;
    setenv("OPENBLAS_NUM_THREADS", "1", 0); /* the workers use the cores */
    if (session->study->streams)            /* no case is known yet */
        return true;
    if (session->study->spectrum || session->study->driver)
        session->first = first_case(session, options);
    apply_case(session, options, session->run);
    return true;
}

/* Adds the messages of a run that have that severity. */
static void copy_messages(cli_session *session, ff_run *run, ff_severity severity)
{
    const ff_report *messages = ff_run_report(run);
    for (size_t i = 0; i < ff_report_count(messages); i++) {
        const ff_message *m = ff_report_at(messages, i);
        ff_source source = m->place.source ? *m->place.source : (ff_source){0};
        ff_place place = m->place;
        source.temporary = true; /* the text is freed with the run */
        if (place.source && run != session->run)
            place.source = &source;
        if (m->severity != severity)
            continue;
        if (m->severity == FF_ERROR)
            ff_error(session->report, m->fault, place, m->hint, "%s", m->text);
        else
            ff_warn(session->report, place, "%s", m->text);
    }
}

static int32_t leave(void *ctx, const ff_stage *stage, double fraction)
{
    (void)ctx, (void)stage, (void)fraction;
    return 2;
}

/* Finds errors in the inputs of the stages. Stages that report no progress are quick and run to
 * their end; the others are stopped at their first report of progress. */
static void run_quick(ff_run *run)
{
    const ff_observer watch = {.size = sizeof watch, .progress = leave};
    run_start(run, &watch);
}

ff_run *cli_session_try(const cli_session *session, const cli_options *options, size_t index,
                        bool runs)
{
    ff_run *run = run_read(session->engine, options->operand);
    study_overlay(session->study, index, options->sets, options->set_count, run);
    if (accuracy_build(run, session->engine, true) && runs && !run_has_errors(run))
        run_quick(run);
    return run;
}

/* Adds the messages of a case that have that severity to the report. */
static void try_case(cli_session *session, const cli_options *options, size_t index,
                     ff_severity severity)
{
    ff_run *run = cli_session_try(session, options, index, severity == FF_ERROR);
    if (!study_case_is_refused(
            session->study,
            ff_run_report(
                run))) /* otherwise the answer states the share of the time that is affected */
        copy_messages(session, run, severity);
    ff_run_close(run);
}

/* Reports, for each model that the study swaps in, the settings of the file that the model cannot
 * take. */
static void try_swaps(cli_session *session, const cli_options *options)
{
    const study_definition *study = session->study;
    for (size_t k = 0; k < study->varied_count; k++) {
        const study_varied *varied = &study->varied[k];
        const char *dot = strrchr(varied->path, '.');
        size_t stride = study_stride(study, varied->axis);
        for (size_t i = 1; dot && !strcmp(dot, ".use") && i < study->points[varied->axis]; i++) {
            if (varied->places && i == CLI_MOST_ROWS)
                i = study->points[varied->axis] - 1;
            try_case(session, options, i * stride, FF_WARNING);
        }
    }
}

/* Used if there are too many cases to check all: tries each value of each axis (the ends of a
 * range) once, with the other axes at their first value. */
static void try_values(cli_session *session, const cli_options *options)
{
    const study_definition *study = session->study;
    for (size_t k = 0; k < study->varied_count; k++) {
        const study_varied *varied = &study->varied[k];
        size_t last = study->points[varied->axis] - 1;
        size_t stride = study_stride(study, varied->axis);
        bool listed = varied->values || varied->names;
        bool whole = !varied->places || k == 0; /* the values of a row belong together */
        for (size_t i = listed || varied->places ? 1 : last; whole && i > 0 && i <= last; i++) {
            if (varied->places && i == CLI_MOST_ROWS)
                i = last;
            if (ff_report_errors(session->report) < MOST_ERRORS)
                try_case(session, options, i * stride, FF_ERROR);
        }
    }
}

/* Tries cases of a study that chooses its cases itself. Some of these may be impossible; a warning
 * says how many. */
static void try_spread(cli_session *session, const cli_options *options)
{
    const study_definition *study = session->study;
    size_t bad = 0, first = 0;
    char *why = NULL;
    session->tried = study->count < CLI_MOST_SPREAD ? study->count : CLI_MOST_SPREAD;
    for (size_t i = 0; i < session->tried; i++) {
        size_t index = session->tried > 1 ? i * (study->count - 1) / (session->tried - 1) : 0;
        ff_run *run = cli_session_try(session, options, index, true);
        if (run_has_errors(run) && bad++ == 0) {
            first = index;
            why = study_first_error(ff_run_report(run));
        }
        ff_run_close(run);
    }
    if (bad)
        ff_warn(session->report, FF_NOWHERE,
                "study: %zu of %zu %s that were checked cannot run, the first of them number "
                "%zu: %s",
                bad, session->tried, study_cases(study), first + 1, why);
    free(why);
}

/* Tries the cases of the study. An impossible case is an error only for `check`. */
static void try_cases(cli_session *session, const cli_options *options)
{
    const study_definition *study = session->study;
    const study_run run = {.study = study,
                           .file = options->operand,
                           .sets = options->sets,
                           .set_count = options->set_count,
                           .engine = session->engine};
    if (study->driver) {
        if (study_open_cases(&run, session->report))
            try_spread(session, options);
    } else if (study->count > CLI_MOST_CASES || study->streams) {
        try_values(session, options);
    } else {
        session->tried = study->count;
        for (size_t i = session->first + 1;
             i < study->count && ff_report_errors(session->report) < MOST_ERRORS; i++)
            try_case(session, options, i, FF_ERROR);
    }
}

static void check_oil(cli_session *session, const cli_options *options)
{
    ff_run *run = run_read(session->engine, options->operand);
    if (session->study && !session->study->streams)
        apply_case(session, options, run);
    else
        run_set_all(run, options->sets, options->set_count);
    if (!session->study || !session->study->streams)
        cli_check_oil(session, run);
    copy_messages(session, run, FF_ERROR);
    ff_run_close(run);
}

static void warn_of_follow(const cli_session *session)
{
    const ff_pipeline *pipeline = session->pipeline;
    bool carried = !session->study || study_chain_length(session->study) == 1;
    for (size_t i = 0; pipeline && i < pipeline->count; i++)
        carried = carried || ff_stage_has_state(&pipeline->stages[i]) ||
                  accuracy_open_use(&pipeline->stages[i]); /* the model is not known yet */
    if (!carried)
        ff_warn(session->report, FF_NOWHERE,
                "study: none of the stages that run passes a state to the next case, so \"follow\" "
                "changes nothing");
}

/* Warns of displaced files for the models of the stages and for those that a study swaps in. */
static void warn_of_displaced(cli_session *session)
{
    study_use at = {0};
    const char *id;
    ff_report *captured = ff_report_new(); /* a case that names no model gives its own error */
    while (session->study && (id = study_next_use(session->study, &at)))
        ff_engine_model(session->engine, id, FF_NOWHERE, captured);
    ff_report_free(captured);
    ff_engine_warn_displaced(session->engine, session->report);
}

static bool open_file(cli_session *session, const cli_options *options, bool everything)
{
    session->engine = cli_engine_new(options);
    session->run = run_read(session->engine, options->operand);
    run_set_all(session->run, options->sets, options->set_count);
    ff_report_append(session->report, ff_run_report(session->run));
    if (!ff_run_root(session->run) || !open_study(session, options))
        return false;
    session->pipeline = accuracy_build(session->run, session->engine, everything);
    if (session->pipeline)
        limits_check(session->run);
    ff_report_append(session->report, ff_run_report(session->run));
    warn_of_follow(session);
    if (session->pipeline && ff_report_errors(session->report) == 0)
        cli_check_temperatures(session);
    if (session->study && session->pipeline)
        study_check(session->study, session->pipeline, session->report);
    if (session->study && !session->study->driver && ff_report_errors(session->report) == 0)
        try_swaps(session, options);
    if (everything && session->pipeline && ff_report_errors(session->report) == 0)
        check_oil(session, options);
    if (everything && session->pipeline && ff_report_errors(session->report) == 0 &&
        !(session->study && session->study->streams)) {
        run_quick(session->run);
        copy_messages(session, session->run, FF_ERROR);
    }
    if (everything && session->study && ff_report_errors(session->report) == 0)
        try_cases(session, options);
    return session->pipeline && ff_report_errors(session->report) == 0;
}

bool cli_session_open(cli_session *session, const cli_options *options, bool everything)
{
    *session = (cli_session){.report = ff_report_new()};
    bool good = open_file(session, options, everything);
    warn_of_displaced(session);
    return good;
}

void cli_session_close(cli_session *session)
{
    study_free(session->study);
    ff_report_free(session->report);
    ff_run_close(session->run);
    ff_engine_close(session->engine);
}

ff_engine *cli_engine_new(const cli_options *options)
{
    ff_engine_options given = {.size = sizeof given,
                               .plugin_paths = options->plugin_paths,
                               .plugin_path_count = options->plugin_path_count};
    ff_engine *engine;
    ff_engine_new(&given, &engine);
    return memory_require(engine);
}

static char *default_directory(const char *file)
{
    const char *slash = strrchr(file, '/');
    const char *name = slash ? slash + 1 : file;
    const char *dot = strrchr(name, '.');
    bool yaml = dot && dot > name && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml"));
    return memory_print_text("results/%.*s", (int)(yaml ? (size_t)(dot - name) : strlen(name)),
                             name);
}

char *cli_study_directory(const cli_options *options)
{
    return options->directory ? memory_print_text("%s", options->directory)
                              : default_directory(options->operand);
}

/* Appends ",duty.speed=3000rpm" to a name, in characters that shells do not interpret. */
static void add_setting(FILE *name, const char *set)
{
    static const char prefix[] = "pipeline.";
    if (!strncmp(set, prefix, sizeof prefix - 1))
        set += sizeof prefix - 1;
    putc(',', name);
    for (; *set; set++)
        if (isalnum((unsigned char)*set) || strchr("._+=-", *set))
            putc(*set, name);
        else if (*set != ' ')
            putc('-', name);
}

char *cli_run_directory(const cli_options *options)
{
    enum { LONGEST = 160 };
    char *base = cli_study_directory(options), *name = NULL;
    size_t length = 0, start = strlen(base);
    if (options->directory)
        return base;
    FILE *stream = memory_require(open_memstream(&name, &length));
    uint64_t hash = STUDY_HASH_START;
    fputs(base, stream);
    for (size_t i = 0; i < options->set_count; i++) {
        add_setting(stream, options->sets[i]);
        hash = study_hash_text(hash, options->sets[i]);
    }
    fclose(stream);
    free(base);
    if (length <= start + LONGEST)
        return name;
    char *cut = memory_print_text("%.*s,%08x", (int)start + LONGEST, name, (unsigned)hash);
    free(name);
    return cut;
}

bool cli_is_strict_about(const cli_options *options, bool doubtful, bool unsure,
                         const ff_report *report, bool print)
{
    bool warned = false;
    for (size_t i = 0; i < ff_report_count(report); i++) {
        const ff_message *m = ff_report_at(report, i);
        warned = warned || (m->severity == FF_WARNING && !study_warning_of_range(m->text));
    }
    if (!cli_option(options, "strict") || !(doubtful || unsure || warned))
        return false;
    if (print)
        fprintf(stderr, "--strict: %s%s%s%s%s counts as a failure\n",
                doubtful ? "a doubtful answer" : "", doubtful && (unsure || warned) ? ", " : "",
                unsure ? "a limit that is not surely met" : "", unsure && warned ? ", " : "",
                warned ? "a warning" : "");
    return true;
}

int cli_refuse(const ff_report *report, const cli_options *options, const char *ending)
{
    int code = ff_report_fault(report);
    size_t errors = ff_report_errors(report);
    if (options->json) {
        results_json_print(results_json_answer("error", code, report));
        return code;
    }
    terminal_print_messages(report, stderr, terminal_colour(stderr));
    fprintf(stderr, "%zu error%s; %s\n", errors, errors == 1 ? "" : "s", ending);
    return code;
}
