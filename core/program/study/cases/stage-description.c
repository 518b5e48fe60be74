/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes each stage with its model once in the journal. A later run can then report what has
   changed. */
#include "case.h"

#include "../store/hash.h"

#include <string.h>

bool study_case_is_good(const study_case *c)
{
    return c->pipeline && ff_report_errors(c->report) == 0;
}

static const char build_name[] = "build of the plugin";
enum { BUILD_SIZE = 17 };

static void print_build(const ff_stage *stage, char *text)
{
    snprintf(text, BUILD_SIZE, "%016llx", (unsigned long long)stage->loaded->build);
}

static json_t *describe_setup(const ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    json_t *values = json_object();
    char text[512];
    size_t used = 0;
    json_object_set_new(values, "use", json_string(model->id));
    json_object_set_new(values, "version of the model", json_string(model->version));
    print_build(stage, text);
    json_object_set_new(values, build_name, json_string(text));
    for (size_t i = 0; i < model->param_count; i++) {
        if (!stage->params[i].present)
            continue;
        ff_bound_print(stage, i, text, sizeof text);
        json_object_set_new(values, stage->params[i].row->name, json_string(text));
    }
    text[0] = '\0';
    for (size_t i = 0; i < model->output_count && used < sizeof text; i++)
        if (stage->results[i].wanted)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", used ? " " : "",
                                     stage->results[i].row->name);
    json_object_set_new(values, "outputs", json_string(text));
    return values;
}

/* Adds each stage with its model to `seen`. Returns false if all are already there. */
static bool is_new(const study_case *c, json_t *seen)
{
    bool any = false;
    for (size_t i = 0; study_case_is_good(c) && i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        char name[400], build[BUILD_SIZE];
        if (!stage->needed)
            continue;
        print_build(stage, build);
        snprintf(name, sizeof name, "%.160s %.160s %s", stage->name, stage->loaded->model->id,
                 build);
        any = any || !json_object_get(seen, name);
        json_object_set_new(seen, name, json_true());
    }
    return any;
}

json_t *study_case_parameters(const study_case *c, json_t *seen)
{
    json_t *parameters = json_object();
    bool any = is_new(c, seen);
    for (size_t i = 0; any && i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        if (stage->needed)
            json_object_set_new(parameters, stage->name, describe_setup(stage));
    }
    return parameters;
}

/* Returns whether the study varies the parameter of the stage. */
static bool is_varied(const study_definition *study, const char *stage, const char *name)
{
    char path[400], whole[420];
    bool found = false;
    snprintf(path, sizeof path, "%.160s.%.200s", stage, name);
    snprintf(whole, sizeof whole, "pipeline.%s", path);
    for (size_t k = 0; k < study->varied_count && !found; k++)
        found = !strcmp(study->varied[k].path, path) || !strcmp(study->varied[k].path, whole);
    return found;
}

/* Writes a line for each value that differs, except those that the study varies. */
static void write_changes(FILE *out, const study_definition *study, const char *stage,
                          const json_t *before, const json_t *now)
{
    static const char absent[] = "not given";
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)(size_t)now, name, value)
    {
        const char *old = json_string_value(json_object_get(before, name));
        if ((!old || strcmp(old, json_string_value(value)) != 0) && !is_varied(study, stage, name))
            fprintf(out, "%s.%s: %s -> %s\n", stage, name, old ? old : absent,
                    json_string_value(value));
    }
    json_object_foreach((json_t *)(size_t)before, name, value)
    {
        if (!json_object_get(now, name) && !is_varied(study, stage, name))
            fprintf(out, "%s.%s: %s -> %s\n", stage, name, json_string_value(value), absent);
    }
}

/* Returns the description of the stage with its model, or with its last model if this one was not
   described. */
static const json_t *find_described(const json_t *described, const ff_stage *stage)
{
    const char *name;
    json_t *values;
    const json_t *found = NULL;
    size_t length = strlen(stage->name);
    json_object_foreach((json_t *)(size_t)described, name, values)
    {
        if (strncmp(name, stage->name, length) != 0 || name[length] != ' ')
            continue;
        found = values;
        if (!strcmp(name + length + 1, stage->loaded->model->id))
            break;
    }
    return found;
}

void study_setup_compare(const study_case *c, const study_definition *study,
                         const json_t *described, FILE *out)
{
    long start = ftell(out);
    for (size_t i = 0; i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        const json_t *before = stage->needed ? find_described(described, stage) : NULL;
        if (before) {
            json_t *now = describe_setup(stage);
            write_changes(out, study, stage->name, before, now);
            json_decref(now);
        } else if (stage->needed) {
            fprintf(out, "%s: it did not run\n", stage->name);
        }
    }
    if (ftell(out) == start)
        fputs(c->states ? "the cases before them in their chain\n"
                        : "contents of files, digits that are not shown, or which stage feeds "
                          "which\n",
              out);
}

/* Returns {model: {build of its plugin: true}} for everything described in the records. */
static json_t *builds_of(const study_records *records)
{
    json_t *builds = json_object(), *stages, *values;
    const char *input, *stage;
    json_object_foreach((json_t *)(size_t)study_records_described(records), input, stages)
        json_object_foreach(stages, stage, values)
    {
        const char *model = json_string_value(json_object_get(values, "use"));
        const char *build = json_string_value(json_object_get(values, build_name));
        if (!model || !build)
            continue;
        if (!json_object_get(builds, model))
            json_object_set_new(builds, model, json_object());
        json_object_set_new(json_object_get(builds, model), build, json_true());
    }
    return builds;
}

void study_setup_warn_rebuilt(const study_run *run, const study_records *records, ff_report *report)
{
    json_t *builds = builds_of(records);
    for (size_t i = 0; run->pipeline && i < run->pipeline->count; i++) {
        const ff_stage *stage = &run->pipeline->stages[i];
        if (!stage->needed || !stage->loaded)
            continue;
        char build[BUILD_SIZE];
        json_t *known = json_object_get(builds, stage->loaded->model->id);
        print_build(stage, build);
        if (!known || json_object_get(known, build))
            continue;
        ff_warn(
            report, stage->use_place,
            "%s: the plugin %s is a different build from that of the results in %s: their cases "
            "run anew",
            stage->name, stage->loaded->path, run->directory);
        json_object_set_new(known, build, json_true());
    }
    json_decref(builds);
}
