/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws to be fitted, and the user's settings of their parameters. */
#include "fit.h"

#include "../memory/memory.h"

#include <flankfilm/viscosity.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const laws[] = {"viscosity/barus", "viscosity/two-slope", "viscosity/roelands",
                                   "viscosity/doolittle-tait", "viscosity/modulus"};
enum { LAWS = sizeof laws / sizeof laws[0] };

static bool needs_others(const ff_model *model)
{
    for (size_t i = 0; i < model->input_count; i++)
        if (!(ff_model_input(model, i)->flags & FF_OPTIONAL))
            return true;
    return false;
}

static bool add_law(fit *f, ff_engine *engine, const char *id)
{
    const ff_loaded *loaded = ff_engine_model(engine, id, FF_NOWHERE, f->report);
    bool serves = loaded && ff_model_find_service(loaded->model, FF_VISCOSITY_ID) >= 0;
    ff_instance *instance;
    if (!loaded)
        return false;
    if (!serves || needs_others(loaded->model))
        return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s cannot be fitted: it %s%s",
                        id, serves ? "needs other stages" : "offers no service ",
                        serves ? "" : FF_VISCOSITY_ID);
    if (ff_instance_new(engine, id, &instance) != FF_OK)
        return ff_error(f->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "%s", ff_engine_message(engine));
    size_t count = loaded->model->param_count;
    f->laws = memory_resize(f->laws, (f->law_count + 1) * sizeof *f->laws);
    fit_law *law = &f->laws[f->law_count++];
    *law = (fit_law){.instance = instance,
                     .loaded = loaded,
                     .id = memory_copy_text(id, strlen(id)),
                     .params = memory_alloc((count + 1) * sizeof *law->params),
                     .param_count = count,
                     .asked = NAN};
    for (size_t i = 0; i < count; i++)
        law->params[i] = (fit_param){.row = ff_model_param(loaded->model, i),
                                     .unit = &loaded->param_units[i],
                                     .value = NAN,
                                     .tried = NAN,
                                     .low = NAN,
                                     .high = NAN};
    return true;
}

bool fit_add_laws(fit *f, ff_engine *engine, const char *const *names, size_t count)
{
    bool good = true;
    f->named = count > 0;
    for (size_t i = 0; i < count; i++) {
        char *id = memory_print_text("%s%s", strchr(names[i], '/') ? "" : "viscosity/", names[i]);
        for (size_t k = 0; k < f->law_count; k++)
            if (!strcmp(f->laws[k].id, id))
                good = ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "--law names %s twice",
                                id);
        good = good && add_law(f, engine, id);
        free(id);
    }
    for (size_t i = 0; i < LAWS && count == 0; i++)
        good = add_law(f, engine, laws[i]) && good;
    return good;
}

/* Fixes a parameter at the value that the user gave. */
static bool fix(fit *f, fit_law *law, fit_param *param, const ff_node *node)
{
    const ff_param *row = param->row;
    ff_value value;
    param->asked = param->found = FIT_HELD;
    if (!ff_param_read(row, param->unit, row->name, node, &value, f->report))
        return false;
    bool number = row->type == FF_REAL && !value.text;
    if (number)
        param->value = value.real;
    ff_status status =
        number ? ff_instance_set_reals(law->instance, row->name, &value.real, 1)
        : row->type == FF_REALS
            ? ff_instance_set_reals(law->instance, row->name, value.reals, value.count)
            : ff_instance_set(law->instance, row->name, node->text);
    ff_value_clear(&value);
    if (status != FF_OK)
        ff_report_append(f->report, ff_instance_report(law->instance));
    return status == FF_OK;
}

/* Applies a setting to all laws that have the parameter, or only to `only`. */
static bool set_param(fit *f, const char *name, const ff_node *node, const fit_law *only)
{
    bool used = false, good = true;
    for (size_t i = 0; i < f->law_count; i++) {
        fit_law *law = &f->laws[i];
        int index = ff_model_find_param(law->loaded->model, name);
        if (index < 0 || (only && law != only))
            continue;
        fit_param *param = &law->params[index];
        used = true;
        if (node->kind == FF_SCALAR && !strcmp(node->text, "free")) {
            param->asked = FIT_FREE;
        } else {
            good = fix(f, law, param, node) && good;
        }
    }
    return used ? good
                : ff_error(f->report, FF_FAULT_INPUT, node->place, NULL,
                           "none of the fitted laws has a parameter \"%s\"", name);
}

static const fit_law *find_law(const fit *f, const char *id)
{
    for (size_t i = 0; i < f->law_count; i++)
        if (!strcmp(f->laws[i].id, id))
            return &f->laws[i];
    return NULL;
}

/* Checks that at most one member of a group is given or free. */
static bool check_groups(const fit *f, const fit_law *law)
{
    for (size_t i = 0; i < law->param_count; i++) {
        const fit_param *one = &law->params[i];
        for (size_t k = i + 1; k < law->param_count && one->row->group; k++) {
            const fit_param *other = &law->params[k];
            if (one->asked != FIT_PRESET && other->asked != FIT_PRESET && other->row->group &&
                !strcmp(one->row->group, other->row->group))
                return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                                "%s: only one of \"%s\" and \"%s\" may be given", law->id,
                                one->row->name, other->row->name);
        }
    }
    return true;
}

/* Applies the settings under `pipeline`: parameters, or laws with their parameters. */
static bool set_all(fit *f, const ff_node *map)
{
    bool good = true;
    for (size_t i = 0; i < map->count && good; i++) {
        const ff_node *node = map->items[i];
        const fit_law *only = find_law(f, map->keys[i]);
        if (only && node->kind != FF_MAP)
            return ff_error(f->report, FF_FAULT_INPUT, node->place, NULL,
                            "%s is a law: name a parameter of it, %s.NAME=VALUE", only->id,
                            only->id);
        for (size_t k = 0; only && k < node->count; k++)
            good = set_param(f, node->keys[k], node->items[k], only) && good;
        if (!only)
            good = set_param(f, map->keys[i], node, NULL);
    }
    return good;
}

bool fit_set(fit *f, ff_engine *engine, const char *const *sets, size_t count)
{
    bool good = ff_run_parse(engine, "--set", ".", "{}", &f->settings) == FF_OK;
    for (size_t i = 0; i < count && good; i++)
        good = ff_run_set(memory_require(f->settings), sets[i]) == FF_OK;
    ff_report_append(f->report, memory_require(ff_run_report(f->settings)));
    const ff_node *root = good ? ff_run_root(f->settings) : NULL;
    for (size_t i = 0; root && i < root->count && good; i++)
        good = strcmp(root->keys[i], "pipeline") != 0
                   ? set_param(f, root->keys[i], root->items[i], NULL)
                   : set_all(f, root->items[i]);
    for (size_t i = 0; i < f->law_count && good; i++)
        good = check_groups(f, &f->laws[i]);
    return good;
}

/* Passes the changed values to the law. Returns false if it refuses one. */
static bool set_values(fit_law *law, const double *values)
{
    bool good = true;
    for (size_t i = 0; i < law->param_count && good; i++) {
        fit_param *param = &law->params[i];
        bool given = !isnan(values[i]), was = !isnan(param->tried);
        if (given && !(values[i] == param->tried))
            good = ff_instance_set_reals(law->instance, param->row->name, &values[i], 1) == FF_OK;
        else if (!given && was)
            good = ff_instance_set(law->instance, param->row->name, NULL) == FF_OK;
        param->tried = good ? values[i] : NAN;
    }
    return good;
}

typedef struct evaluation {
    const void *table;
    size_t n;
    const double *p, *T;
    double *ln_eta;
} evaluation;

static ff_status evaluate(void *ctx)
{
    const evaluation *e = ctx;
    const ff_viscosity *law = e->table;
    ff_status status = law->eval(law->self, e->n, e->p, e->T, e->ln_eta, NULL, NULL);
    return status == FF_DOMAIN ? FF_OK : status;
}

bool fit_law_eval(fit *f, fit_law *law, const double *values, size_t n, const double *p,
                  const double *T, double *ln_eta)
{
    evaluation e = {.n = n, .p = p, .T = T, .ln_eta = ln_eta};
    ff_status status = set_values(law, values)
                           ? ff_instance_service(law->instance, FF_VISCOSITY_ID, &e.table)
                           : FF_INVALID;
    bool open = status == FF_OK || status == FF_DOMAIN;
    bool good = open && ff_instance_call(law->instance, "its fit", evaluate, &e) == FF_OK;
    const ff_report *messages = ff_instance_report(law->instance);
    if (!open) {
        free(law->refusal);
        law->refusal = memory_print_text("%s", ff_instance_reason(law->instance));
    }
    if (good || ff_report_fault(messages) == FF_FAULT_PLUGIN)
        ff_report_append(f->report, messages);
    return good;
}

void fit_free(fit *f)
{
    for (size_t i = 0; i < f->law_count; i++) {
        fit_law *law = &f->laws[i];
        ff_instance_close(law->instance);
        free(law->id);
        free(law->params);
        free(law->refusal);
        free(law->correlation);
        free(law->residual);
    }
    free(f->laws);
    free(f->data.p);
    free(f->data.T);
    free(f->data.ln_eta);
    free(f->data.root);
    free(f->data.row);
    ff_columns_free(f->table);
    ff_run_close(f->settings);
}
