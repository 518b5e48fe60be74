/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opening the file that a command is given. */
#include "session.h"

#include "../terminal/terminal.h"
#include "oil.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../results/json.h"
#include "../study/hash.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ERRORS = 20 };

/* Applies the first case of a study to the tree: it shows what holds for all cases. */
static bool open_study(cli_session *session, const cli_options *options)
{
    const ff_node *node = ff_node_get(ff_tree_root(session->tree), "study");
    if (!node || (node->kind == FF_SCALAR && !*node->text))
        return true;
    size_t errors = ff_report_errors(session->report);
    session->study = study_open(ff_tree_root(session->tree), session->report);
    if (ff_report_errors(session->report) > errors)
        return false;
    setenv("OPENBLAS_NUM_THREADS", "1", 0); /* the workers use the cores */
    if (session->study->streams)            /* no case is known yet */
        return true;
    if (!session->study->overlay_first) /* the first case may be the one that fails */
        ff_tree_put(session->tree, "outputs", session->study->request);
    else
        study_overlay(session->study, 0, options->sets, options->set_count, session->tree,
                      session->report);
    return true;
}

/* Adds the messages of that severity of another report, whose sources may be freed before. */
static void copy_messages(cli_session *session, const ff_report *captured, ff_severity severity)
{
    for (size_t i = 0; i < ff_report_count(captured); i++) {
        const ff_message *m = ff_report_at(captured, i);
        ff_source source = m->place.source ? *m->place.source : (ff_source){0};
        ff_place place = m->place;
        source.temporary = true; /* it is freed with the tree */
        place.source = place.source ? &source : NULL;
        if (m->severity != severity)
            continue;
        if (m->severity == FF_ERROR)
            ff_error(session->report, m->fault, place, m->hint, "%s", m->text);
        else
            ff_warn(session->report, place, "%s", m->text);
    }
}

ff_tree *cli_session_try(const cli_session *session, const cli_options *options, size_t index,
                         ff_report *report)
{
    ff_tree *tree = ff_tree_load(options->operand, report);
    study_overlay(session->study, index, options->sets, options->set_count, tree, report);
    ff_pipeline_free(accuracy_build(tree, session->engine, true, report));
    return tree;
}

/* Adds the messages of that severity of a case to the report. */
static void try_case(cli_session *session, const cli_options *options, size_t index,
                     ff_severity severity)
{
    ff_report *captured = ff_report_new();
    ff_tree *tree = cli_session_try(session, options, index, captured);
    copy_messages(session, captured, severity);
    ff_tree_free(tree);
    ff_report_free(captured);
}

/* Tries each value of each axis once, or the end of a range, with the other axes at their first. A
   case that cannot be is an error of a check alone; a model that cannot take all that the file says
   is named by a run, too. */
static void try_values(cli_session *session, const cli_options *options, bool everything)
{
    const study_definition *study = session->study;
    for (size_t k = 0; k < study->varied_count; k++) {
        const study_varied *varied = &study->varied[k];
        size_t last = study->points[varied->axis] - 1, stride = 1;
        for (size_t a = varied->axis + 1; a < study->axis_count; a++)
            stride *= study->points[a];
        const char *dot = strrchr(varied->path, '.');
        bool swaps = dot && !strcmp(dot, ".use"), listed = varied->values || varied->names;
        bool whole = everything && (!varied->places || k == 0); /* a row is tried once */
        for (size_t i = listed || varied->places ? 1 : last; i > 0 && i <= last; i++) {
            if (varied->places && i == CLI_MOST_ROWS)
                i = last;
            if (whole && ff_report_errors(session->report) < MOST_ERRORS)
                try_case(session, options, i * stride, FF_ERROR);
            if (swaps)
                try_case(session, options, i * stride, FF_WARNING);
        }
    }
}

/* Of a study its first case. */
static void check_oil(cli_session *session, const cli_options *options)
{
    ff_report *captured = ff_report_new();
    ff_tree *tree = ff_tree_load(options->operand, captured);
    if (session->study && session->study->overlay_first)
        study_overlay(session->study, 0, options->sets, options->set_count, tree, captured);
    for (size_t i = 0; !session->study && i < options->set_count; i++)
        ff_tree_set(tree, options->sets[i], NULL, NULL, captured);
    if (!session->study || session->study->overlay_first) {
        ff_report *found = ff_report_new();
        cli_check_oil(session, tree, found);
        copy_messages(session, found, FF_ERROR);
        ff_report_free(found);
    }
    ff_tree_free(tree);
    ff_report_free(captured);
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
                "study: no stage that runs hands a state to the next case, so that \"follow\" "
                "changes nothing");
}

/* Of the models of the stages, and of those that a study puts in their place. */
static void warn_of_displaced(cli_session *session)
{
    study_use at = {0};
    const char *id;
    ff_report *captured = ff_report_new(); /* a case that names no model fails by itself */
    while (session->study && (id = study_next_use(session->study, &at)))
        ff_engine_model(session->engine, id, FF_NOWHERE, captured);
    ff_report_free(captured);
    ff_engine_warn_displaced(session->engine, session->report);
}

static bool open_file(cli_session *session, const cli_options *options, bool everything)
{
    session->engine = cli_engine_new(options);
    session->tree = ff_tree_load(options->operand, session->report);
    if (!ff_tree_root(session->tree))
        return false;
    for (size_t i = 0; i < options->set_count; i++)
        ff_tree_set(session->tree, options->sets[i], NULL, NULL, session->report);
    if (!open_study(session, options))
        return false;
    session->pipeline = accuracy_build(session->tree, session->engine, everything, session->report);
    warn_of_follow(session);
    if (session->pipeline && ff_report_errors(session->report) == 0)
        cli_check_temperatures(session);
    if (session->study && session->pipeline)
        study_check(session->study, session->pipeline, session->report);
    if (session->study && !session->study->driver && ff_report_errors(session->report) == 0)
        try_values(session, options, everything);
    if (everything && session->pipeline && ff_report_errors(session->report) == 0)
        check_oil(session, options);
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
    ff_pipeline_free(session->pipeline);
    ff_engine_close(session->engine);
    ff_tree_free(session->tree);
    ff_report_free(session->report);
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

/* Adds ",duty.speed=3000rpm" to a name, in characters that no shell minds. */
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

bool cli_is_strict_about(const cli_options *options, bool doubtful, const ff_report *report)
{
    for (size_t i = 0; i < ff_report_count(report); i++)
        doubtful = doubtful || ff_report_at(report, i)->severity == FF_WARNING;
    return doubtful && cli_option(options, "strict");
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
