/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Films whose estimates of errors nobody reads (flankfilm/estimates.h): the same bits, without the
 * lines of the errors that take time to find.
 */
#include "check.h"

#include <flankfilm/engine.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char pipeline[] =
    "format: 2\n"
    "pipeline:\n"
    "  oil: {use: lubricant/grade, grade: ISO VG 100, temperature: 70 degC}\n"
    "  viscosity: {use: viscosity/barus}\n"
    "  density: {use: density/dowson-higginson}\n"
    "  flow: {use: rheology/ree-eyring, tau0: 6 MPa}\n"
    "  gears: {use: gear/involute-spur, teeth: [19, 41], module: 2 mm, face_width: 14 mm}\n"
    "  duty: {use: operating/steady, torque: 12 N m, speed: 1500 rpm}\n"
    "  mesh: {use: stiffness/iso-6336}\n"
    "  motion: {use: dynamics/quasi-static}\n"
    "  tooth: {use: contact/tooth-pair, load: motion}\n"
    "  film: {use: %s, cells: 128%s}\n"
    "outputs: [film.h_min, film.h_central, film.p_max, film.friction_coefficient, "
    "film.power_loss]\n";

static const char *const errors[] = {"h_min_space_error", "h_central_space_error",
                                     "p_max_space_error"};

static ff_run *run_film(ff_engine *engine, const char *model, const char *more, bool unread)
{
    char text[2000];
    ff_run *run;
    snprintf(text, sizeof text, pipeline, model, more);
    check_true("parsed", ff_run_parse(engine, "film.yaml", ".", text, &run) == FF_OK &&
                             ff_run_ready(run) == FF_OK);
    ff_pipeline *stages = ff_run_pipeline(run);
    for (size_t i = 0; stages && i < stages->count; i++)
        stages->stages[i].unread = unread;
    check_true("runs", ff_run_start(run, NULL) == FF_OK);
    return run;
}

static size_t count_errors(const ff_run *run)
{
    const ff_quality *line;
    size_t count = 0;
    for (size_t i = 0; ff_run_quality(run, i, &line) == FF_OK; i++)
        for (size_t k = 0; k < sizeof errors / sizeof errors[0]; k++)
            count += strcmp(line->name, errors[k]) == 0;
    return count;
}

static void compare(ff_engine *engine, const char *model, const char *more)
{
    ff_run *read = run_film(engine, model, more, false), *run = run_film(engine, model, more, true);
    const ff_result *one, *other;
    const char *stage;
    size_t outputs = 0;
    for (size_t i = 0; ff_run_output(read, i, &stage, &one) == FF_OK; i++) {
        char path[200];
        if (!one->requested)
            continue;
        snprintf(path, sizeof path, "%s.%s", stage, one->row->name);
        check_true(path, ff_run_result(run, path, &other) == FF_OK && other->count == one->count &&
                             memcmp(one->data, other->data, one->count * sizeof *one->data) == 0);
        outputs++;
    }
    check_true("all outputs are compared", outputs == 5);
    check_true("errors that are read are told", count_errors(read) == 3);
    check_true("errors that nobody reads are not", count_errors(run) == 0);
    ff_run_close(run);
    ff_run_close(read);
}

int main(void)
{
    const char *directory = getenv("FLANKFILM_TEST_PLUGINS");
    const ff_engine_options options = {sizeof options, &directory, 1};
    ff_engine *engine;
    if (ff_engine_new(&options, &engine) != FF_OK)
        return 1;
    compare(engine, "ehl/finite-volume", "");
    compare(engine, "ehl/control-volume", ", steps: 100");
    ff_engine_close(engine);
    return check_done();
}
