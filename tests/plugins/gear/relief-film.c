/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The start of a relief given as a diameter must give the same film as given by its roll angle. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { GEAR, DUTY, MESH, TOOTH, VISCOSITY, DENSITY, FLOW, FILM, STAGES };

static const char *const models[STAGES] = {
    "gear/involute-spur",  "operating/steady", "stiffness/load-distribution",
    "contact/tooth-pair",  "viscosity/barus",  "density/dowson-higginson",
    "rheology/ree-eyring", "ehl/finite-volume"};

/* Settings common to both pipelines; the gears differ in teeth, material and relief. */
static const struct {
    int stage;
    const char *param, *text;
} settings[] = {{GEAR, "teeth", "[23, 41]"},
                {GEAR, "module", "3 mm"},
                {GEAR, "face_width", "20 mm"},
                {GEAR, "profile_shift", "[0.2, 0.05]"},
                {GEAR, "elastic_modulus", "[206 GPa, 170 GPa]"},
                {GEAR, "tip_relief", "[24 um, 15 um]"},
                {GEAR, "root_relief", "[6 um, 9 um]"},
                {DUTY, "torque", "180 N m"},
                {DUTY, "speed", "1500 rpm"},
                {VISCOSITY, "eta0", "12 mPa s"},
                {VISCOSITY, "alpha", "15 1/GPa"},
                {DENSITY, "rho0", "860 kg/m3"},
                {FLOW, "tau0", "5 MPa"},
                {FILM, "cells", "64"},
                {FILM, "steps", "60"}};

static const struct {
    int to, from;
    const char *wire;
} wires[] = {{DUTY, GEAR, "gear"},
             {MESH, GEAR, "gear"},
             {MESH, DUTY, "operating"},
             {TOOTH, GEAR, "gear"},
             {TOOTH, DUTY, "operating"},
             {TOOTH, MESH, "load"},
             {TOOTH, VISCOSITY, "viscosity"},
             {FILM, TOOTH, "contact"},
             {FILM, GEAR, "gear"},
             {FILM, VISCOSITY, "viscosity"},
             {FILM, DENSITY, "density"},
             {FILM, FLOW, "rheology"}};

static const double tip[2] = {73.3e-3, 126.4e-3}, root[2] = {67.9e-3, 120.8e-3};

/* Sets the start of a relief as a diameter, or, if `angles`, as the roll angle sqrt(r^2 -
   r_b^2)/r_b. */
static void set_start(stage *gear, const char *end, const double diameter[2], bool angles)
{
    static const double teeth[2] = {23, 41};
    double value[2];
    char name[40];
    for (int g = 0; g < 2; g++) {
        const double base = 3e-3 * teeth[g] / 2 * cos(20 * (M_PI / 180)), r = diameter[g] / 2;
        value[g] = angles ? sqrt((r - base) * (r + base)) / base : diameter[g];
    }
    snprintf(name, sizeof name, "%s_%s", end, angles ? "start" : "diameter");
    stage_set_reals(gear, name, 2, value);
}

static void run(stage *chain[STAGES], bool relieved, bool angles)
{
    for (int i = 0; i < STAGES; i++)
        chain[i] = stage_open(models[i]);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        if (relieved || !strstr(settings[i].param, "relief"))
            stage_set_text(chain[settings[i].stage], settings[i].param, settings[i].text);
    if (relieved) {
        set_start(chain[GEAR], "tip_relief", tip, angles);
        set_start(chain[GEAR], "root_relief", root, angles);
    }
    for (size_t i = 0; i < sizeof wires / sizeof wires[0]; i++)
        stage_link(chain[wires[i].to], wires[i].wire, chain[wires[i].from]);
    if (!check_true("the film runs", stage_run(chain[FILM]) == FF_OK))
        printf("%s: %s\n", stage_why_item(chain[FILM]), stage_why(chain[FILM]));
}

static void finish(stage *chain[STAGES])
{
    for (int i = STAGES; i-- > 0;)
        stage_close(chain[i]);
}

static void check_series(const char *output, const stage *a, const stage *b, bool same)
{
    size_t n, m;
    const double *x = stage_get(a, output, &n), *y = stage_get(b, output, &m);
    check_true(output, n == m && n > 10 && (memcmp(x, y, n * sizeof *x) == 0) == same);
}

int main(void)
{
    static const char *const outputs[] = {"h_min", "p_max", "traction", "power_loss"};
    stage *drawn[STAGES], *rolled[STAGES], *plain[STAGES];
    run(drawn, true, false);
    run(rolled, true, true);
    run(plain, false, false);
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++) {
        check_series(outputs[i], drawn[FILM], rolled[FILM], true);
        check_series(outputs[i], drawn[FILM], plain[FILM], false);
    }
    finish(drawn);
    finish(rolled);
    finish(plain);
    return check_done();
}
