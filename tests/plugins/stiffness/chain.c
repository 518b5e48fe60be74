/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "chain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

chain chain_open(const char *model, const char *torque)
{
    chain c = {stage_open("gear/involute-spur"), stage_open("operating/steady"), stage_open(model)};
    stage_set_text(c.gear, "teeth", "[50, 50]");
    stage_set_text(c.gear, "module", "3 mm");
    stage_set_text(c.gear, "face_width", "20 mm");
    stage_set_text(c.gear, "backlash", "0.14 mm");
    stage_set_text(c.duty, "torque", torque);
    stage_set_text(c.duty, "speed", "1500 rpm");
    stage_link(c.duty, "gear", c.gear);
    stage_link(c.mesh, "gear", c.gear);
    stage_link(c.mesh, "operating", c.duty);
    return c;
}

void chain_close(chain *c)
{
    stage_close(c->mesh);
    stage_close(c->duty);
    stage_close(c->gear);
}

void chain_run(chain *c)
{
    if (stage_run(c->gear) != FF_OK || stage_run(c->mesh) != FF_OK) {
        printf("FAIL %s: %s\n", stage_why_item(c->mesh), stage_why(c->mesh));
        exit(1);
    }
}

double chain_mean(chain *c)
{
    chain_run(c);
    return stage_scalar(c->mesh, "stiffness_mean");
}

size_t chain_station(const chain *c, const char *point)
{
    size_t n, i = 0;
    const double *roll = stage_get(c->gear, "roll_angle", &n);
    while (i + 1 < n && roll[i] < stage_scalar(c->gear, point) - 1e-9)
        i++;
    return i;
}

chain chain_with(const char *model, const char *torque, const char *param, const char *value)
{
    chain c = chain_open(model, torque);
    if (param)
        stage_set_text(strncmp(param, "mesh.", 5) ? c.gear : c.mesh, param + 5, value);
    chain_run(&c);
    return c;
}
