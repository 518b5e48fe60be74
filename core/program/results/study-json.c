/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes study.json, which describes a study: its axes, and the stages of its first case. */
#include "json.h"
#include "label.h"
#include "write.h"

#include <stdlib.h>
#include <string.h>

/* Finds the parameter that a path names in the first case; false if the path names something else.
 */
static bool find_param(const ff_pipeline *pipeline, const char *path, const ff_param **row,
                       const ff_unit **unit)
{
    static const char top[] = "pipeline.";
    const char *name;
    if (!strncmp(path, top, sizeof top - 1))
        path += sizeof top - 1;
    const ff_stage *stage = ff_stage_of(pipeline, path, &name);
    int param = stage && stage->loaded ? ff_model_find_param(stage->loaded->model, name) : -1;
    if (param < 0)
        return false;
    *row = ff_model_param(stage->loaded->model, (size_t)param);
    *unit = &stage->loaded->param_units[param];
    return (*row)->type == FF_REAL || (*row)->type == FF_INT;
}

/* Finds a coherent SI unit with this dimension among the example units; NULL if there is none. */
static json_t *si_unit(const ff_unit *unit)
{
    const char *at = ff_unit_examples(unit);
    while (*at) {
        size_t length = strcspn(at, ",");
        ff_unit offered;
        char why[200], *text = memory_print_text("%.*s", (int)length, at);
        bool found = ff_unit_parse(text, &offered, why, sizeof why) && ff_unit_is_si(&offered);
        json_t *name = found ? results_json_text(text) : NULL;
        free(text);
        if (name)
            return name;
        at += length;
        at += strspn(at, ", ");
    }
    return NULL;
}

/* Returns the values in SI, or NULL if one of them is a word. */
static json_t *numbers_in_si(const study_varied *varied, size_t points, const ff_param *row,
                             const ff_unit *unit)
{
    json_t *values = json_array();
    for (size_t i = 0; i < points; i++) {
        double si;
        char why[300];
        if (!ff_quantity_parse(study_varied_value(varied, i), unit, row->unit, &si, why,
                               sizeof why)) {
            json_decref(values);
            return NULL;
        }
        json_array_append_new(values, study_json_real(si));
    }
    return values;
}

static json_t *describe_axes(const results_study *of, const study_definition *study)
{
    json_t *list = json_array();
    for (size_t k = 0; k < study->varied_count; k++) {
        const study_varied *varied = &study->varied[k];
        const ff_param *row = NULL;
        const ff_unit *unit = NULL;
        json_t *words = json_array();
        for (size_t i = 0; i < study->points[varied->axis]; i++)
            json_array_append_new(words, results_json_text(study_varied_value(varied, i)));
        json_t *axis = json_pack("{s:o, s:I, s:o}", "path", results_json_text(varied->path),
                                 "dimension", (json_int_t)varied->axis, "words", words);
        bool is_number = find_param(of->input->pipeline, varied->path, &row, &unit);
        json_t *name = is_number ? si_unit(unit) : NULL;
        json_t *values =
            name ? numbers_in_si(varied, study->points[varied->axis], row, unit) : NULL;
        if (values) {
            json_object_set_new(axis, "values", values);
            json_object_set(axis, "unit", name);
        }
        json_decref(name);
        json_array_append_new(list, axis);
    }
    return list;
}

static json_t *describe_stages(const ff_pipeline *pipeline, json_t *docs)
{
    json_t *list = json_array();
    char name[160];
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (!stage->needed || !stage->loaded)
            continue;
        json_t *entry = results_json_origin(pipeline, stage);
        json_object_set_new(entry, "stage", results_json_text(stage->name));
        json_object_set_new(entry, "model", results_json_text(stage->use));
        json_array_append_new(list, entry);
        for (size_t k = 0; k < stage->loaded->model->output_count; k++) {
            const ff_port *row = ff_model_output(stage->loaded->model, k);
            snprintf(name, sizeof name, "%s.%s", stage->name, row->name);
            json_object_set_new(docs, name, results_json_text(results_called(row)));
        }
    }
    return list;
}

/* Returns the plugin files and the literature of models that only later cases use. */
static json_t *list_other_models(const results_study *of, const study_definition *study)
{
    json_t *models = json_object();
    study_use at = {0};
    const char *id;
    while ((id = study_next_use(study, &at))) {
        if (json_object_get(models, id))
            continue;
        ff_report *silent = ff_report_new();
        const ff_loaded *loaded = ff_engine_model(of->engine, id, FF_NOWHERE, silent);
        if (loaded)
            json_object_set_new(models, id, results_json_model(loaded));
        ff_report_free(silent);
    }
    return models;
}

void results_write_study_json(const results_study *of, const study_definition *study,
                              const study_tally *tally, FILE *out)
{
    json_t *lengths = json_array(), *sets = json_array(), *docs = json_object();
    for (size_t i = 0; i < study->axis_count; i++)
        json_array_append_new(lengths, json_integer((json_int_t)study->points[i]));
    for (size_t i = 0; i < of->input->set_count; i++)
        json_array_append_new(sets, results_json_text(of->input->sets[i]));
    json_t *all = json_pack(
        "{s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "format", STUDY_FORMAT, "title",
        results_json_text(of->input->pipeline->title), "facts", results_json_facts(of->input->file),
        "sets", sets, "lengths", lengths, "axes", describe_axes(of, study), "stages",
        describe_stages(of->input->pipeline, docs), "models", list_other_models(of, study));
    json_object_set_new(all, "docs", docs);
    json_object_set_new(all, "key", results_json_key(of->input->key));
    if (tally)
        study_tally_describe(tally, all);
    json_dumpf(all, out, JSON_COMPACT | JSON_REAL_PRECISION(17));
    fputc('\n', out);
    json_decref(all);
}
