/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws that are fitted, and what the user says of their parameters. */
#include "fit.h"

#include "../memory/memory.h"

#include <flankfilm/viscosity.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const laws[] = {"viscosity/barus", "viscosity/two-slope", "viscosity/roelands",
                                   "viscosity/doolittle-tait"};
enum { LAWS = sizeof laws / sizeof laws[0] };

static bool add_law(fit *f, ff_library *library, const char *id)
{
    ff_trial *trial = ff_trial_new(library, id, FF_VISCOSITY_ID, f->report);
    if (!trial)
        return false;
    const ff_loaded *loaded = ff_trial_model(trial);
    size_t count = loaded->model->param_count;
    f->laws = memory_resize(f->laws, (f->law_count + 1) * sizeof *f->laws);
    fit_law *law = &f->laws[f->law_count++];
    *law = (fit_law){.trial = trial,
                     .id = memory_copy_text(id, strlen(id)),
                     .params = memory_alloc((count + 1) * sizeof *law->params),
                     .param_count = count,
                     .asked = NAN};
    for (size_t i = 0; i < count; i++)
        law->params[i] = (fit_param){.row = ff_model_param(loaded->model, i),
                                     .unit = &loaded->param_units[i],
                                     .value = NAN,
                                     .low = NAN,
                                     .high = NAN};
    return true;
}

bool fit_add_laws(fit *f, ff_library *library, const char *const *names, size_t count)
{
    bool good = true;
    f->named = count > 0;
    for (size_t i = 0; i < count; i++) {
        char *id = memory_print_text("%s%s", strchr(names[i], '/') ? "" : "viscosity/", names[i]);
        for (size_t k = 0; k < f->law_count; k++)
            if (!strcmp(f->laws[k].id, id))
                good = ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "--law names %s twice",
                                id);
        good = good && add_law(f, library, id);
        free(id);
    }
    for (size_t i = 0; i < LAWS && count == 0; i++)
        good = add_law(f, library, laws[i]) && good;
    return good;
}

/* Applies a setting to all laws that have the parameter, or to `only`. */
static bool set_param(fit *f, const char *name, const ff_node *node, const fit_law *only)
{
    bool used = false, good = true;
    for (size_t i = 0; i < f->law_count; i++) {
        fit_law *law = &f->laws[i];
        int index = ff_model_find_param(ff_trial_model(law->trial)->model, name);
        if (index < 0 || (only && law != only))
            continue;
        fit_param *param = &law->params[index];
        used = true;
        if (node->kind == FF_SCALAR && !strcmp(node->text, "free")) {
            param->asked = FIT_FREE;
        } else {
            param->asked = param->found = FIT_HELD;
            good = ff_trial_hold(law->trial, (size_t)index, node, f->report) && good;
            param->value = ff_trial_held(law->trial, (size_t)index);
        }
    }
    return used ? good
                : ff_error(f->report, FF_FAULT_INPUT, node->place, NULL,
                           "no law that is fitted has a parameter \"%s\"", name);
}

static const fit_law *find_law(const fit *f, const char *id)
{
    for (size_t i = 0; i < f->law_count; i++)
        if (!strcmp(f->laws[i].id, id))
            return &f->laws[i];
    return NULL;
}

bool fit_set(fit *f, const char *const *sets, size_t count)
{
    bool good = true;
    f->settings = ff_tree_parse("--set", ".", "{}", f->report);
    for (size_t i = 0; i < count && good; i++)
        good = ff_tree_set(f->settings, sets[i], NULL, ff_file_keys(), f->report);
    const ff_node *root = ff_tree_root(f->settings);
    for (size_t i = 0; root && i < root->count && good; i++) {
        const ff_node *node = root->items[i];
        const fit_law *only = find_law(f, root->keys[i]);
        if (only && node->kind != FF_MAP)
            return ff_error(f->report, FF_FAULT_INPUT, node->place, NULL,
                            "%s is a law: name a parameter of it, %s.NAME=VALUE", only->id,
                            only->id);
        for (size_t k = 0; only && k < node->count; k++)
            good = set_param(f, node->keys[k], node->items[k], only) && good;
        if (!only)
            good = set_param(f, root->keys[i], node, NULL);
    }
    return good;
}

/* The service with these values; NULL when the law refuses them. */
static const ff_viscosity *open_law(fit *f, fit_law *law, const double *values)
{
    ff_report *said = ff_report_new();
    const void *service = ff_trial_open(law->trial, values, said);
    if (!service) {
        const char *why = ff_trial_why(law->trial);
        const char *text = ff_report_count(said) ? ff_report_at(said, 0)->text : "";
        free(law->refusal);
        law->refusal = memory_print_text("%s", *why ? why : text);
        if (ff_report_fault(said) == FF_FAULT_PLUGIN)
            ff_error(f->report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL, "%s", text);
    }
    ff_report_free(said);
    return service;
}

bool fit_law_eval(fit *f, fit_law *law, const double *values, size_t n, const double *p,
                  const double *T, double *ln_eta)
{
    const ff_viscosity *service = open_law(f, law, values);
    const char *path = ff_trial_model(law->trial)->path;
    ff_environment environment;
    if (!service)
        return false;
    ff_environment_keep(&environment);
    ff_guard_mark mark =
        ff_guard_enter((ff_guard_mark){.path = path, .stage = law->id, .action = "its fit"});
    ff_status status = service->eval(service->self, n, p, T, ln_eta, NULL, NULL);
    ff_guard_leave(mark);
    const char *changed = ff_environment_restore(&environment);
    if (changed)
        ff_warn(f->report, FF_NOWHERE, "%s: the plugin %s %s during its fit; this was set back",
                law->id, path, changed);
    return status >= 0;
}

double fit_to_si(const fit_param *param, double number)
{
    return param->unit->factor * number + param->unit->offset;
}

double fit_from_si(const fit_param *param, double si)
{
    return (si - param->unit->offset) / param->unit->factor;
}

void fit_free(fit *f)
{
    for (size_t i = 0; i < f->law_count; i++) {
        fit_law *law = &f->laws[i];
        ff_trial_free(law->trial);
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
    ff_columns_free(&f->columns);
    ff_tree_free(f->settings);
}
