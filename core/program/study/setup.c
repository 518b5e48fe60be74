/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes the setup of each stage once in the journal, so that a later run can say what has
   changed. */
#include "case.h"
#include "hash.h"

#include <string.h>

bool study_case_is_good(const study_case *c)
{
    return c->pipeline && ff_report_errors(c->report) == 0;
}

json_t *study_case_setups(const study_case *c)
{
    json_t *setups = json_object();
    char text[20];
    for (size_t i = 0; study_case_is_good(c) && i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        if (!stage->needed)
            continue;
        snprintf(text, sizeof text, "%016llx", (unsigned long long)study_hash_setup(stage));
        json_object_set_new(setups, stage->name, json_string(text));
    }
    return setups;
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

json_t *study_case_parameters(const study_case *c, const json_t *setups, json_t *seen)
{
    json_t *parameters = json_object(), *setup;
    const char *name;
    json_object_foreach((json_t *)(size_t)setups, name, setup)
    {
        const char *hash = json_string_value(setup);
        if (json_object_get(seen, hash))
            continue;
        for (size_t i = 0; i < c->pipeline->count; i++)
            if (!strcmp(c->pipeline->stages[i].name, name))
                json_object_set_new(parameters, hash, describe_setup(&c->pipeline->stages[i]));
        json_object_set_new(seen, hash, json_true());
    }
    return parameters;
}

/* Writes a line for each value that differs. */
static void write_changes(FILE *out, const char *stage, const json_t *before, const json_t *now)
{
    static const char absent[] = "not given";
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)(size_t)now, name, value)
    {
        const char *old = json_string_value(json_object_get(before, name));
        if (!old || strcmp(old, json_string_value(value)) != 0)
            fprintf(out, "%s.%s: %s -> %s\n", stage, name, old ? old : absent,
                    json_string_value(value));
    }
    json_object_foreach((json_t *)(size_t)before, name, value) if (!json_object_get(now, name))
        fprintf(out, "%s.%s: %s -> %s\n", stage, name, json_string_value(value), absent);
}

void study_setup_compare(const study_case *c, const json_t *record, const json_t *parameters,
                         FILE *out)
{
    json_t *setups = study_case_setups(c), *seen = json_object(), *now, *hash;
    const json_t *old = json_object_get(record, "setups");
    const char *stage;
    bool some = false;
    now = study_case_parameters(c, setups, seen);
    json_object_foreach(setups, stage, hash)
    {
        const char *before = json_string_value(json_object_get(old, stage));
        const json_t *values = before ? json_object_get(parameters, before) : NULL;
        long start = ftell(out);
        if (before && !strcmp(before, json_string_value(hash)))
            continue;
        some = true;
        if (!before)
            fprintf(out, "%s: it did not run\n", stage);
        else if (values)
            write_changes(out, stage, values, json_object_get(now, json_string_value(hash)));
        if (ftell(out) == start)
            fprintf(out, "%s: %s\n", stage,
                    values ? "what stands in its files, or digits that are not shown"
                           : "its parameters");
    }
    if (!some)
        fputs(c->states ? "the cases before them in their chain\n"
                        : "which stage feeds which, or the outputs\n",
              out);
    json_decref(setups);
    json_decref(seen);
    json_decref(now);
}

/* {model: {build of its plugin: true}} of all that the records describe. */
static json_t *builds_of(const json_t *records)
{
    json_t *builds = json_object(), *record, *values;
    const char *key, *hash;
    json_object_foreach((json_t *)(size_t)records, key, record)
        json_object_foreach(json_object_get(record, "parameters"), hash, values)
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

void study_setup_warn_rebuilt(const study_run *run, const json_t *records, ff_report *report)
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
        ff_warn(report, stage->use_place,
                "%s: the plugin %s is another build than that of the results in %s: their cases "
                "run anew",
                stage->name, stage->loaded->path, run->directory);
        json_object_set_new(known, build, json_true());
    }
    json_decref(builds);
}
