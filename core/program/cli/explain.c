/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands check and explain, which run nothing. */
#include "../terminal/terminal.h"
#include "command.h"
#include "drawing.h"
#include "resolved.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../results/json.h"
#include "../run/run.h"
#include "../study/cases/case.h"

#include <stdlib.h>
#include <string.h>

enum { NAME = 24, VALUE = 28 };

static json_t *outputs(const ff_stage *stage)
{
    json_t *list = json_array();
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (result->wanted)
            json_array_append_new(list,
                                  json_pack("{s:s, s:s, s:b}", "output", result->row->name, "unit",
                                            result->row->unit, "requested", result->requested));
    }
    return list;
}

/* Returns {use, candidates} for a stage that leaves its model open. */
static json_t *describe_choice(const ff_stage *stage, ff_engine *engine)
{
    memory_arena arena = {.blocks = NULL};
    json_t *list = json_array();
    for (const char **ids = accuracy_candidates(stage, engine, &arena); *ids; ids++)
        json_array_append_new(list, json_string(*ids));
    memory_arena_free(&arena);
    return json_pack("{s:s, s:o}", "use", accuracy_open_use(stage), "candidates", list);
}

static json_t *describe_stage(const ff_pipeline *pipeline, const ff_stage *stage, ff_engine *engine)
{
    json_t *entry =
        json_pack("{s:s, s:s, s:b, s:b, s:s}", "stage", stage->name, "model", stage->use, "runs",
                  stage->needed, "loaded", stage->loaded != NULL, "why", stage->why);
    if (stage->loaded && accuracy_open_use(stage))
        json_object_set_new(entry, "choice", describe_choice(stage, engine));
    if (stage->needed) {
        json_object_set_new(entry, "wires", results_json_wires(pipeline, stage));
        json_object_set_new(entry, "parameters", results_json_params(stage));
        json_object_set_new(entry, "outputs", outputs(stage));
    }
    return entry;
}

/* Adds {from, to, wire, feedback} for each wire between stages of the loop: the feedback wires,
 * or the others. */
static void add_wires(const ff_pipeline *pipeline, const ff_loop *loop, bool feedback, json_t *list)
{
    for (size_t i = 0; i < loop->count; i++) {
        const ff_stage *to = &pipeline->stages[pipeline->order[loop->first + i]];
        for (size_t k = 0; k < to->wire_count; k++) {
            const ff_wire *wire = &to->wires[k];
            if (wire->stage >= 0 && pipeline->stages[wire->stage].loop == loop &&
                wire->closes == feedback)
                json_array_append_new(list,
                                      json_pack("{s:s, s:s, s:s, s:b}", "from",
                                                pipeline->stages[wire->stage].name, "to", to->name,
                                                "wire", wire->name, "feedback", feedback));
        }
    }
}

static json_t *describe_loops(const ff_pipeline *pipeline)
{
    const ff_feedback *feedback = &pipeline->feedback;
    json_t *list = json_array();
    for (size_t i = 0; i < pipeline->loop_count; i++) {
        const ff_loop *loop = &pipeline->loops[i];
        json_t *stages = json_array(), *wires = json_array();
        add_wires(pipeline, loop, false, wires);
        add_wires(pipeline, loop, true, wires);
        for (size_t k = 0; k < loop->count; k++)
            json_array_append_new(
                stages, json_string(pipeline->stages[pipeline->order[loop->first + k]].name));
        if (pipeline->stages[pipeline->order[loop->first]].needed)
            json_array_append_new(
                list, json_pack("{s:O, s:O, s:I, s:f, s:f}", "stages", stages, "wires", wires,
                                "rounds", (json_int_t)feedback->rounds, "tolerance",
                                feedback->tolerance, "relaxation", feedback->relaxation));
        json_decref(stages);
        json_decref(wires);
    }
    return list;
}

static const char *text_of(const json_t *object, const char *key)
{
    return json_string_value(json_object_get(object, key));
}

/* Prints the outputs that will be computed, with a star at those that the file requests. */
static void print_outputs(const json_t *list)
{
    char *names = memory_print_text("%s", "");
    const json_t *entry;
    size_t i;
    json_array_foreach(list, i, entry)
    {
        bool requested = json_is_true(json_object_get(entry, "requested"));
        memory_add_text(&names, "%s%s%s", i ? ", " : "", text_of(entry, "output"),
                        requested ? "*" : "");
    }
    if (*names)
        terminal_print_wrapped(names, printf("  computes: "), 4);
    free(names);
}

/* Prints the models that a run would try in place of the reference. */
static void print_choice(const json_t *choice)
{
    char *names = memory_print_text("%s", "");
    const json_t *entry;
    size_t i;
    json_array_foreach(json_object_get(choice, "candidates"), i, entry)
    {
        memory_add_text(&names, "%s%s", i ? ", " : "", json_string_value(entry));
    }
    char *text = memory_print_text("the reference of %s; a run also tries %s",
                                   text_of(choice, "use"), *names ? names : "no other");
    terminal_print_wrapped(text, printf("  "), 4);
    free(text);
    free(names);
}

static void print_stage(const json_t *stage)
{
    const char *name;
    json_t *entry;
    const char *why = text_of(stage, "why");
    printf("\n%s: %s, because %s%s\n", text_of(stage, "stage"), text_of(stage, "model"),
           strncmp(why, "feeds ", strlen("feeds ")) ? "" : "it ", why);
    if (json_object_get(stage, "choice"))
        print_choice(json_object_get(stage, "choice"));
    json_object_foreach(json_object_get(stage, "wires"), name, entry)
    {
        bool automatic = json_is_true(json_object_get(entry, "automatic"));
        bool feedback = json_is_true(json_object_get(entry, "feedback"));
        printf("  %s %-*s %-*s %s\n", name, NAME - 1 - (int)strlen(name), feedback ? "<~" : "<-",
               VALUE, text_of(entry, "stage"),
               feedback    ? "feedback"
               : automatic ? "automatic"
                           : "written");
    }
    json_object_foreach(json_object_get(stage, "parameters"), name, entry)
    {
        printf("  %-*s %-*s %s\n", NAME, name, VALUE, text_of(entry, "text"),
               text_of(entry, "origin"));
    }
    print_outputs(json_object_get(stage, "outputs"));
}

/* Draws a loop: a line for each wire, and a wavy arrow for each feedback wire. */
static void print_loop(const json_t *loop)
{
    const json_t *entry;
    size_t i;
    printf("\nloop:");
    json_array_foreach(json_object_get(loop, "stages"), i, entry)
    {
        printf("%s %s", i ? "," : "", json_string_value(entry));
    }
    printf("; in at most %" JSON_INTEGER_FORMAT
           " rounds, until the feedback changes by no more than %g\n",
           json_integer_value(json_object_get(loop, "rounds")),
           json_number_value(json_object_get(loop, "tolerance")));
    json_array_foreach(json_object_get(loop, "wires"), i, entry)
    {
        bool feedback = json_is_true(json_object_get(entry, "feedback"));
        printf("  %s %s %s.%s%s\n", text_of(entry, "from"), feedback ? "~>" : "->",
               text_of(entry, "to"), text_of(entry, "wire"),
               feedback ? "  absent in the first round" : "");
    }
}

static void print_plan(const ff_pipeline *pipeline, const char *file, const json_t *stages)
{
    size_t needed = 0, i;
    char title[400];
    const json_t *stage;
    ff_clean_text(title, sizeof title, pipeline->title ? pipeline->title : file);
    for (i = 0; i < pipeline->count; i++)
        needed += pipeline->stages[i].needed;
    printf("%s: %zu of %zu stages run (* requested)\n", title, needed, pipeline->count);
    json_array_foreach(stages, i, stage)
    {
        if (json_is_true(json_object_get(stage, "runs")))
            print_stage(stage);
    }
    json_t *loops = describe_loops(pipeline);
    json_array_foreach(loops, i, stage)
    {
        print_loop(stage);
    }
    json_decref(loops);
    if (needed < pipeline->count)
        printf("\nnot run:\n");
    json_array_foreach(stages, i, stage)
    {
        if (!json_is_true(json_object_get(stage, "runs")))
            printf("  %s: %s, %s%s\n", text_of(stage, "stage"), text_of(stage, "model"),
                   text_of(stage, "why"),
                   json_is_true(json_object_get(stage, "loaded")) ? "" : "; not loaded");
    }
}

/* Returns the assignments of a case, without its name and without those that the first case has,
 * too. */
static json_t *settings_of(const study_definition *study, size_t index)
{
    json_t *list = json_array();
    for (size_t k = 0; k < study->varied_count; k++) {
        const char *text = study_assignment(study, k, index);
        if (*text && strcmp(text, study_assignment(study, k, 0)) != 0)
            json_array_append_new(list, json_string(text));
    }
    return list;
}

/* Returns [{model, settings, fault}] for the models that a study compares with the file's; `fault`
 * is the reason why the model cannot be compared, or null. */
static json_t *describe_compared(const cli_session *session, const cli_options *options)
{
    json_t *list = json_array();
    const char *name;
    size_t index;
    for (size_t i = 0; (name = study_compared(session->study, i, &index)); i++) {
        ff_run *tried = cli_session_try(session, options, index, false);
        char *fault = run_has_errors(tried) ? study_first_error(ff_run_report(tried)) : NULL;
        json_array_append_new(list, json_pack("{s:s, s:o, s:o}", "model", name, "settings",
                                              settings_of(session->study, index), "fault",
                                              results_json_text(fault)));
        free(fault);
        ff_run_close(tried);
    }
    return list;
}

static void print_compared(const json_t *list)
{
    const json_t *entry, *setting;
    size_t i, k;
    if (json_array_size(list))
        printf("\nmodels that the study compares:\n");
    json_array_foreach(list, i, entry)
    {
        const char *fault = text_of(entry, "fault");
        printf("  %-*s", NAME, text_of(entry, "model"));
        json_array_foreach(json_object_get(entry, "settings"), k, setting)
        {
            printf(" %s", json_string_value(setting));
        }
        printf("%s%s\n", fault ? "; cannot be compared: " : "", fault ? fault : "");
    }
}

static int explain(cli_session *session, const cli_options *options)
{
    const ff_pipeline *pipeline = session->pipeline;
    json_t *stages = json_array();
    int code = ff_report_fault(session->report);
    for (size_t i = 0; i < pipeline->count; i++)
        json_array_append_new(
            stages,
            describe_stage(pipeline, &pipeline->stages[pipeline->order[i]], session->engine));
    json_t *answer = results_json_answer(code ? "failed" : "ok", code, session->report);
    json_object_set_new(answer, "title", results_json_text(pipeline->title));
    json_object_set_new(answer, "file", results_json_text(options->operand));
    json_object_set_new(answer, "stages", stages);
    if (pipeline->loop_count)
        json_object_set_new(answer, "loops", describe_loops(pipeline));
    study_reuse_counts savings = {0};
    json_t *compared = session->study ? describe_compared(session, options) : NULL;
    if (session->study) {
        json_object_set_new(answer, "compared", compared);
        json_object_set_new(answer, "study",
                            json_pack("{s:s, s:I, s:s}", "kind", study_kind_name(session->study),
                                      "cases", (json_int_t)session->study->count, "further",
                                      study_further(session->study)));
        char *directory = cli_study_directory(options);
        savings = study_savings(directory);
        free(directory);
        json_object_set_new(answer, "reuse", cli_json_savings(&savings));
    }
    if (options->json) {
        results_json_print(answer);
        return code;
    }
    terminal_print_messages(session->report, stderr, terminal_colour(stderr));
    print_plan(pipeline, options->operand, stages);
    if (session->study)
        fputs("\nstudy (one of its cases is shown above): ", stdout);
    if (session->study)
        cli_print_cases(session->study);
    print_compared(compared);
    if (savings.computed + savings.reused)
        printf("\nthe cases of the study so far: ");
    cli_print_savings(&savings);
    json_decref(answer);
    return code;
}

/* Returns the exit code of a check. With --strict a warning counts as a wrong input. */
static int confirm(cli_session *session, const cli_options *options)
{
    size_t stages = session->pipeline->count, cases = session->study ? session->study->count : 1;
    bool strict = cli_is_strict_about(options, false, false, session->report, false);
    int code = strict ? FF_FAULT_INPUT : EXIT_SUCCESS;
    if (options->json) {
        json_t *answer = results_json_answer(strict ? "error" : "ok", code, session->report);
        json_object_set_new(answer, "stages", json_integer((json_int_t)stages));
        json_object_set_new(answer, "cases", json_integer((json_int_t)cases));
        json_object_set_new(answer, "study", json_boolean(session->study));
        if (session->tried)
            json_object_set_new(answer, "tried", json_integer((json_int_t)session->tried));
        results_json_print(answer);
        return code;
    }
    terminal_print_messages(session->report, stderr, terminal_colour(stderr)); /* the warnings */
    if (strict) {
        fprintf(stderr, "--strict: a warning counts as an error\n");
        return code;
    }
    printf("%s: ok (%zu stage%s", options->operand, stages, stages == 1 ? "" : "s");
    if (!session->study || session->study->streams)
        printf(")\n");
    else if (session->study->driver)
        printf("; %zu of %zu cases%s%s)\n", session->tried, cases,
               *study_further(session->study) ? ", " : "", study_further(session->study));
    else if (session->tried == cases)
        printf("; all %zu cases)\n", cases);
    else
        printf(cases > CLI_MOST_ROWS && session->study->rows
                   ? "; %zu cases, of which the first 1000 and the last were checked)\n"
                   : "; %zu cases, of which each value was checked once)\n",
               cases);
    return code;
}

static int with_session(const cli_options *options, bool everything,
                        int (*show)(cli_session *, const cli_options *))
{
    cli_session session;
    int code = EXIT_SUCCESS;
    if (cli_session_open(&session, options, everything)) {
        code = show(&session, options);
    } else {
        code = cli_refuse(session.report, options, "nothing was run");
    }
    cli_session_close(&session);
    return code;
}

int cli_check(const cli_options *options)
{
    return with_session(options, true, confirm);
}

static int resolve(cli_session *session, const cli_options *options)
{
    terminal_print_messages(session->report, stderr, terminal_colour(stderr)); /* the warnings */
    cli_print_resolved(session, options);
    return ff_report_fault(session->report);
}

static int draw(cli_session *session, const cli_options *options)
{
    if (!options->json)
        /* the warnings */
        terminal_print_messages(session->report, stderr, terminal_colour(stderr));
    return cli_print_drawing(session, options);
}

int cli_explain(const cli_options *options)
{
    bool yaml = cli_option(options, "yaml"), drawing = cli_option(options, "drawing");
    if (yaml && options->json) {
        cli_wrong_usage(options, "choose --yaml or --json: explain prints one of them");
        return FF_FAULT_INPUT;
    }
    if (yaml && drawing) {
        cli_wrong_usage(options, "choose --yaml or --drawing: explain prints one of them");
        return FF_FAULT_INPUT;
    }
    return with_session(options, false, yaml ? resolve : drawing ? draw : explain);
}
