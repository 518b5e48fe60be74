/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The directory of a single run: result.json has it all. */
#include "results.h"

#include <errno.h>
#include <math.h>
#include <string.h>

static void add_outputs(results_reader *results, json_t *outputs, json_t *all, uint32_t flags)
{
    const char *name;
    json_t *entry;
    json_object_foreach(outputs, name, entry)
    {
        results_variable(results, name, entry, json_object_get(entry, "doc"), flags);
        json_object_set(all, name, entry);
    }
}

static int verdict_of(const json_t *text)
{
    const char *word = json_string_value(text);
    return !word || !strcmp(word, "good") ? FF_GOOD
           : !strcmp(word, "doubtful")    ? FF_DOUBTFUL
                                          : FF_BAD;
}

/* Quality and time of the stages that ran. */
static void add_stages(results_reader *results, ff_view_case *c, const json_t *stages)
{
    results_rows rows = {.rows = NULL};
    json_t *stage, *line;
    const char *name;
    size_t i;
    c->seconds = 0;
    json_array_foreach(stages, i, stage)
    {
        const char *of = json_string_value(json_object_get(stage, "stage"));
        if (!of || !json_is_true(json_object_get(stage, "ran")))
            continue;
        c->seconds += json_number_value(json_object_get(stage, "seconds"));
        json_object_foreach(json_object_get(stage, "quality"), name, line) results_quality(
            results, &rows, of, name, json_object_get(line, "value"),
            json_object_get(line, "limit"), verdict_of(json_object_get(line, "verdict")),
            json_object_get(line, "text"));
    }
    c->quality_count = rows.count;
    c->quality = results_keep(results, &rows);
}

bool results_read_run(results_reader *results)
{
    errno = 0;
    if (!results_document_open(&results->run, results->directory, "result.json"))
        return results_refuse(results, "run the case again", "%s/result.json cannot be read%s%s",
                              results->path, errno ? ": " : "", errno ? strerror(errno) : "");
    const json_t *root = results->run.root;
    results_head(results, root);
    ff_view_case *c = results_add(results, &results->cases, sizeof *c);
    *c = (ff_view_case){
        .size = sizeof *c,
        .status = results_text(results, json_object_get(root, "status")),
        .reason = results_text(
            results,
            json_object_get(json_array_get(json_object_get(root, "errors"), 0), "message")),
        .command = "",
    };
    results->own = results_alloc(sizeof *results->own);
    results->own[0].outputs = json_object();
    add_outputs(results, json_object_get(root, "outputs"), results->own[0].outputs, FF_VIEW_ASKED);
    add_outputs(results, json_object_get(root, "computed"), results->own[0].outputs, 0);
    add_stages(results, c, json_object_get(root, "stages"));
    return true;
}
