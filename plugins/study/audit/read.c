/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the user asks for, and whether the first case has it. */
#include "audit.h"

const ff_param *study_param_row(const ff_model *model, size_t param)
{
    return (const void *)((const char *)model->params + param * model->param_stride);
}

const ff_port *study_output_row(const ff_model *model, size_t output)
{
    return (const void *)((const char *)model->outputs + output * model->output_stride);
}

const ff_study_stage *study_find_stage(const ff_study_look *look, const char *path)
{
    size_t length = strcspn(path, ".");
    for (size_t i = 0; i < look->stage_count; i++) {
        const char *name = look->stages[i]->name;
        if (strlen(name) == length && !strncmp(name, path, length))
            return look->stages[i];
    }
    return NULL;
}

size_t study_find_output(const ff_study_stage *stage, const char *name)
{
    for (size_t i = 0; i < stage->model->output_count; i++)
        if (!strcmp(study_output_row(stage->model, i)->name, name))
            return i;
    return SIZE_MAX;
}

/* One dimension, which may have another before it that is absent. */
const char *study_dimension_of(const ff_port *row)
{
    const char *dims = row->dims ? row->dims : "", *optional = strstr(dims, "? ");
    dims = optional ? optional + 2 : dims;
    return *dims && !strchr(dims, ' ') ? dims : NULL;
}

bool study_is_field(const ff_port *row)
{
    return row->service || (row->dims && *row->dims && !study_dimension_of(row));
}

static bool refuse(const study_audit *a, const ff_written *where, const char *hint,
                   const char *what)
{
    a->desk->refuse(a->desk->ctx, FF_INVALID, where, hint, what);
    return false;
}

static bool read_outputs(study_audit *a)
{
    const ff_written *list = a->settings[STUDY_OUTPUTS];
    if (!list)
        return true;
    if (list->text || list->keys || list->count == 0)
        return refuse(a, list, NULL, "\"outputs\" wants a list such as [film.h_min_lowest]");
    a->outputs = a->desk->memory(a->desk->ctx, list->count * sizeof *a->outputs);
    for (a->output_count = 0; a->output_count < list->count; a->output_count++) {
        const ff_written *item = list->items[a->output_count];
        const char *dot = item->text ? strchr(item->text, '.') : NULL;
        if (!dot || !dot[1] || dot[1] == '*')
            return refuse(a, item, NULL, "\"outputs\" wants names such as STAGE.OUTPUT");
        a->outputs[a->output_count] = item->text;
    }
    return true;
}

static bool read_inputs(study_audit *a)
{
    const ff_written *map = a->inputs = a->settings[STUDY_INPUTS];
    bool good = true;
    if (map && (!map->keys || map->count == 0))
        return refuse(a, map, "write inputs: {duty.torque: 2 %}",
                      "\"inputs\" wants a map from parameters to their standard uncertainty");
    for (size_t i = 0; map && i < map->count; i++) {
        const ff_written *item = map->items[i];
        const char *path = map->keys[i], *end;
        double number = 0;
        if (!strchr(path, '.'))
            good = refuse(a, item, NULL,
                          study_keep(a->desk,
                                     "inputs: \"%.80s\" is no parameter; write STAGE.PARAMETER",
                                     path));
        else if (!item->text || !study_number(item->text, &number, &end) || !(number > 0))
            good = refuse(
                a, item, "write 2 %, or 5 N m",
                study_keep(a->desk, "inputs: %.80s wants its standard uncertainty, above 0", path));
    }
    return good;
}

ff_status study_audit_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan)
{
    study_audit *a = self;
    a->desk = desk;
    a->plan = plan;
    plan->flags = FF_STUDY_SWEEPS;
    bool outputs = read_outputs(a), inputs = read_inputs(a);
    return outputs && inputs ? FF_OK : FF_INVALID;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Letters that must be added, dropped or changed to make one word the other. */
static size_t distance(const char *a, const char *b)
{
    size_t row[64], length = strlen(b);
    if (length >= sizeof row / sizeof row[0])
        return SIZE_MAX;
    for (size_t k = 0; k <= length; k++)
        row[k] = k;
    for (size_t i = 0; a[i]; i++) {
        size_t corner = row[0];
        row[0] = i + 1;
        for (size_t k = 1; k <= length; k++) {
            size_t changed = corner + (a[i] != b[k - 1]);
            corner = row[k];
            row[k] = least(least(row[k], row[k - 1]) + 1, changed);
        }
    }
    return row[length];
}

/* Keeps the better of two guesses at a word. */
static void guess(const char *word, const char *name, const char **near, size_t *best)
{
    size_t off = distance(word, name);
    if (off < *best && off <= 1 + strlen(word) / 4) {
        *best = off;
        *near = name;
    }
}

static const char *question(const study_audit *a, const char *near)
{
    return near ? study_keep(a->desk, "; did you mean \"%s\"?", near) : "";
}

static const char *name_in(const char *path)
{
    return strchr(path, '.') + 1;
}

static size_t find_param(const ff_study_stage *stage, const char *name)
{
    for (size_t i = 0; i < stage->model->param_count; i++)
        if (!strcmp(study_param_row(stage->model, i)->name, name))
            return i;
    return SIZE_MAX;
}

static bool refuse_input(const study_audit *a, const ff_written *where, const char *path,
                         const char *hint, const char *what)
{
    return refuse(a, where, hint, study_keep(a->desk, "inputs: %s: %s", path, what));
}

/* Why the stage has no such number: it is not known, is not given, or is something else. */
static bool explain_input(const study_audit *a, const ff_study_stage *stage, const char *path,
                          size_t param, const ff_written *where)
{
    const char *near = NULL;
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < stage->model->param_count; i++)
        guess(name_in(path), study_param_row(stage->model, i)->name, &near, &best);
    if (param == SIZE_MAX)
        return refuse_input(a, where, path, NULL,
                            study_keep(a->desk, "%s (%s) has no such parameter%s", stage->name,
                                       stage->model->id, question(a, near)));
    const ff_param *row = study_param_row(stage->model, param);
    if (row->type != FF_REAL)
        return refuse_input(a, where, path, NULL,
                            "only a parameter that is one real number can vary");
    return refuse_input(
        a, where, path,
        row->group ? "of parameters that stand for each other, name the one that is given" : NULL,
        "it is not given as a number, so that there is nothing to vary");
}

static bool refuse_stage(const study_audit *a, const ff_study_look *look, const ff_written *where,
                         const char *path)
{
    const char *near = NULL, *word = study_keep(a->desk, "%.*s", (int)strcspn(path, "."), path);
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < look->stage_count; i++)
        guess(word, look->stages[i]->name, &near, &best);
    return refuse(
        a, where, NULL,
        study_keep(a->desk, "inputs: there is no stage \"%s\"%s", word, question(a, near)));
}

/* A stage that the first case does not need may run in another one; the model that a stage chooses
   may have what the stage does not say. */
static bool check_input(const study_audit *a, const ff_study_look *look, size_t i)
{
    const ff_written *where = a->inputs->items[i];
    const char *path = a->inputs->keys[i], *why;
    const ff_study_stage *stage = study_find_stage(look, path);
    if (!stage)
        return refuse_stage(a, look, where, path);
    if (!stage->runs)
        return a->cases > 1 || refuse_input(a, where, path, NULL, "no output needs that stage");
    if (!stage->numbers)
        return true; /* its errors are told already */
    size_t param = find_param(stage, name_in(path));
    bool known = param != SIZE_MAX && study_param_row(stage->model, param)->type == FF_REAL;
    if (known && !stage->numbers[param] && stage->chooses)
        return true;
    if (!known || !stage->numbers[param])
        return explain_input(a, stage, path, param, where);
    return a->desk->shift(a->desk->ctx, 0, path, where->text, 1, &why) ||
           refuse_input(a, where, path, NULL, why);
}

static bool refuse_output(const study_audit *a, size_t i, const char *what)
{
    return refuse(a, a->settings[STUDY_OUTPUTS]->items[i], NULL,
                  study_keep(a->desk, "outputs: %s%s", a->outputs[i], what));
}

static bool check_output(const study_audit *a, const ff_study_look *look, size_t i)
{
    const char *path = a->outputs[i], *near = NULL;
    const ff_study_stage *stage = study_find_stage(look, path);
    size_t best = SIZE_MAX;
    if (!stage || !stage->runs)
        return refuse_output(
            a, i, stage ? ": no output of the file needs that stage" : ": there is no such stage");
    if (!stage->wanted)
        return true;
    size_t output = study_find_output(stage, name_in(path));
    const ff_port *row = output == SIZE_MAX ? NULL : study_output_row(stage->model, output);
    if (row && study_is_field(row))
        return refuse_output(a, i,
                             row->service ? " is a service; name scalars and series"
                                          : " is a field; name scalars and series");
    for (size_t k = 0; !row && k < stage->model->output_count; k++)
        guess(name_in(path), study_output_row(stage->model, k)->name, &near, &best);
    return row || refuse_output(
                      a, i, study_keep(a->desk, ": there is no such output%s", question(a, near)));
}

ff_status study_audit_check(void *self, const ff_study_desk *desk, size_t cases)
{
    study_audit *a = self;
    a->desk = desk;
    a->cases = cases;
    a->plan->further =
        study_keep(desk, "%zu of them audited: computed once more, finer", study_audit_count(a));
    const ff_study_look *look = desk->look(desk->ctx, 0);
    bool chooses = false, good = true;
    for (size_t i = 0; i < look->stage_count; i++)
        chooses = chooses || (look->stages[i]->runs && look->stages[i]->chooses);
    if (!chooses)
        good = refuse(a, NULL, "write use: KIND/auto, or give a stage an accuracy",
                      "no stage of this file chooses its model, so that nothing was promised");
    for (size_t i = 0; a->inputs && i < a->inputs->count; i++)
        good = check_input(a, look, i) && good;
    for (size_t i = 0; i < a->output_count; i++)
        good = check_output(a, look, i) && good;
    return good ? FF_OK : FF_INVALID;
}
