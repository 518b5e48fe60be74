/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For `check`: finds errors of an oil that a run would report, namely a temperature that is given
 * in two places, and laws that contradict the oil. Evaluates only the stages of the oil and the
 * stages that feed them. */
#include "oil.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../run/run.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"temperature", "eta0", "rho0"};
enum { TEMPERATURE, ETA0, RHO0, NAMES };

static bool is_oil(const ff_stage *stage)
{
    const ff_model *model = stage->loaded ? stage->loaded->model : NULL;
    if (!model || !stage->needed || ff_model_find_service(model, FF_LIQUID_ID) < 0)
        return false;
    for (size_t i = 0; i < NAMES; i++)
        if (ff_model_find_output(model, names[i]) < 0)
            return false;
    return true;
}

/* Returns "outputs=[oil.temperature, ...]" for all oils; NULL: there is none. */
static char *request(const ff_pipeline *pipeline)
{
    char *text = memory_print_text("outputs=[");
    size_t count = 0;
    for (size_t k = 0; k < pipeline->count; k++)
        for (size_t i = 0; is_oil(&pipeline->stages[k]) && i < NAMES; i++)
            memory_add_text(&text, "%s%s.%s", count++ ? ", " : "", pipeline->stages[k].name,
                            names[i]);
    memory_add_text(&text, "]");
    if (count)
        return text;
    free(text);
    return NULL;
}

/* Makes an instance of the law with the parameters of its stage and without wires. */
static ff_instance *make_law(ff_engine *engine, const ff_stage *stage)
{
    ff_instance *law;
    if (ff_instance_new(engine, stage->use, &law) != FF_OK)
        return NULL;
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        const ff_bound *bound = &stage->params[i];
        const ff_value *value = &bound->value;
        double number = bound->row->type == FF_REAL ? value->real : (double)value->integer;
        if (!bound->present)
            continue;
        if (bound->row->type == FF_TEXT || bound->row->type == FF_FILE)
            ff_instance_set(law, bound->row->name, value->text);
        else if (bound->row->type == FF_REALS)
            ff_instance_set_reals(law, bound->row->name, value->reals, value->count);
        else
            ff_instance_set_reals(law, bound->row->name, &number, 1);
    }
    return law;
}

typedef struct law_call {
    int what;
    double T;
    const void *table; /* the table of functions of the law */
    double value;
} law_call;

static ff_status evaluate_law(void *ctx)
{
    law_call *call = ctx;
    const double p = 0;
    if (call->what == ETA0) {
        const ff_viscosity *viscosity = call->table;
        return viscosity->eval(viscosity->self, 1, &p, &call->T, &call->value, NULL, NULL);
    }
    const ff_density *density = call->table;
    return density->eval(density->self, 1, &p, &call->T, &call->value, NULL, NULL);
}

/* Returns eta0 or rho0 of the law at T; NaN if the law does not give it. */
static double value_of_law(ff_instance *law, int what, double T)
{
    law_call call = {.what = what, .T = T, .value = NAN};
    const char *id = what == ETA0 ? FF_VISCOSITY_ID : FF_DENSITY_ID;
    if (ff_instance_service(law, id, &call.table) != FF_OK)
        return NAN;
    ff_status status = ff_instance_call(law, "eval", evaluate_law, &call);
    if (status != FF_OK && status != FF_DOMAIN)
        return NAN;
    return what == ETA0 ? exp(call.value) : call.value;
}

/* Returns the place of that parameter in the file, or of the stage if it is not given. */
static ff_place place_of(const ff_stage *stage, const char *param)
{
    int at = ff_model_find_param(stage->loaded->model, param);
    return at >= 0 && stage->params[at].place.source ? stage->params[at].place : stage->place;
}

static double scalar(ff_run *oils, const ff_stage *oil, int what)
{
    char *path = memory_print_text("%s.%s", oil->name, names[what]);
    const ff_result *result;
    bool known = ff_run_result(oils, path, &result) == FF_OK;
    free(path);
    return known ? *result->data : NAN;
}

static void compare_law(cli_session *session, const ff_stage *law, ff_run *oils,
                        const ff_stage *oil, int what)
{
    static const char *const units[] = {"", "Pa s", "kg/m3"};
    ff_instance *alone = make_law(session->engine, law);
    double T = scalar(oils, oil, TEMPERATURE), by_oil = scalar(oils, oil, what);
    double by_law = alone ? value_of_law(alone, what, T) : NAN;
    ff_instance_close(alone);
    if (!isfinite(by_law) || !isfinite(by_oil) || fabs(by_law - by_oil) <= 0.01 * fabs(by_oil))
        return;
    char there[200];
    ff_message_print(&(ff_message){.place = oil->place, .text = ""}, there, sizeof there);
    ff_error(
        session->report, FF_FAULT_INPUT, place_of(law, names[what]),
        "connect the oil to the law, or disconnect it from the stage that uses both (oil: none)",
        "%s: the law and the oil contradict each other: at %g degC %s is %.4g %s in the law and "
        "%.4g %s in the oil, the stage \"%s\" (%.*s)",
        law->name, T - 273.15, names[what], by_law, units[what], by_oil, units[what], oil->name,
        (int)(strlen(there) > 2 ? strlen(there) - 2 : 0), there);
}

static const ff_stage *stage_on(const ff_pipeline *pipeline, const ff_stage *stage,
                                const char *wire)
{
    for (size_t i = 0; i < stage->wire_count; i++)
        if (!strcmp(stage->wires[i].name, wire) && stage->wires[i].stage >= 0)
            return &pipeline->stages[stage->wires[i].stage];
    return NULL;
}

/* Compares the laws of a stage with the oil that it uses. A law that is wired to the oil cannot
 * contradict it. */
static void compare_laws(cli_session *session, ff_run *oils, const ff_stage *user)
{
    static const char *const wires[] = {NULL, "viscosity", "density"};
    const ff_stage *oil = stage_on(session->pipeline, user, "oil");
    for (int what = ETA0; oil && what < NAMES; what++) {
        const ff_stage *law = stage_on(session->pipeline, user, wires[what]);
        if (law && law->loaded && law->params && !stage_on(session->pipeline, law, "oil"))
            compare_law(session, law, oils, oil, what);
    }
}

/* Returns the value that the file gives for the parameter; NULL: none. */
static const ff_bound *given(const ff_stage *stage, const char *param)
{
    int at = stage && stage->loaded && stage->params
                 ? ff_model_find_param(stage->loaded->model, param)
                 : -1;
    return at >= 0 && stage->params[at].present && stage->params[at].row->type == FF_REAL
               ? &stage->params[at]
               : NULL;
}

void cli_check_temperatures(cli_session *session)
{
    for (size_t i = 0; i < session->pipeline->count; i++) {
        const ff_stage *oil = &session->pipeline->stages[i];
        if (!is_oil(oil))
            continue;
        const ff_stage *duty = stage_on(session->pipeline, oil, "operating");
        const ff_bound *own = given(oil, "temperature"), *there = given(duty, "oil_temperature");
        char place[512];
        if (!own || !there || fabs(own->value.real - there->value.real) <= 1e-6)
            continue;
        ff_bound_origin(there, place, sizeof place);
        ff_error(session->report, FF_FAULT_INPUT, own->place, "remove this one",
                 "%s.temperature: the temperature of the oil is given in two places: here %g degC, "
                 "and as %s.oil_temperature %g degC (%s)",
                 oil->name, own->value.real - 273.15, duty->name, there->value.real - 273.15,
                 place);
    }
}

void cli_check_oil(cli_session *session, ff_run *oils)
{
    char *outputs = request(session->pipeline);
    if (!outputs)
        return;
    run_set(oils, outputs, NULL, NULL);
    if (accuracy_build_alone(oils, session->engine, false) && !run_has_errors(oils))
        run_start(oils, NULL);
    for (size_t i = 0; !run_has_errors(oils) && i < session->pipeline->count; i++)
        if (session->pipeline->stages[i].needed && session->pipeline->stages[i].loaded)
            compare_laws(session, oils, &session->pipeline->stages[i]);
    free(outputs);
}
