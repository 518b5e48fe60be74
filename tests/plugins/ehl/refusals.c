/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts that no film model can solve: one sentence each, which names the input. */
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const film_model *model;

static void refused(line *c, const char *what, const char *item, const char *outputs)
{
    ff_status status = line_run(c, outputs);
    const char *why = stage_why(c->film);
    char text[96];
    snprintf(text, sizeof text, "%s: %s", model->name, what);
    check_true(text, status < 0 && !strcmp(stage_why_item(c->film), item) && strlen(why) > 20 &&
                         !strchr(why, '\n'));
    line_close(c);
}

static line *fresh(line *c)
{
    model_open(model, c);
    line_last(c, 5, 1e-4);
    return c;
}

static void test_model(void)
{
    static line c;
    fresh(&c)->radius[2] = -0.01;
    refused(&c, "negative radius", "contact.equivalent_radius", "h_min");
    fresh(&c)->radius[2] = NAN;
    refused(&c, "radius that is no number", "contact.equivalent_radius", "h_min");
    fresh(&c);
    memset(c.u1, 0, sizeof c.u1);
    memset(c.u2, 0, sizeof c.u2);
    refused(&c, "no speed at all", "contact.speed_1", "h_min");
    if (!model->solves) {
        fresh(&c);
        c.u1[0] = c.u2[0] = 0;
        refused(&c, "no speed at the start", "contact.speed_1", "h_min");
        fresh(&c)->u1[3] = -10;
        refused(&c, "entrainment that turns round", "contact.speed_1", "h_min");
    }
    fresh(&c)->time[4] = c.time[3];
    refused(&c, "jump at the last time", "contact.time", "h_min");
    fresh(&c)->u2[1] = INFINITY;
    refused(&c, "infinite speed", "contact.speed_2", "h_min");
    fresh(&c)->time[3] = 1e-6;
    refused(&c, "time that goes back", "contact.time", "h_min");
    fresh(&c)->time[3] = NAN;
    refused(&c, "time that is no number", "contact.time", "h_min");
    fresh(&c);
    memset(c.time, 0, sizeof c.time);
    refused(&c, "history without duration", "contact.time", "h_min");
    fresh(&c)->load[1] = -1;
    refused(&c, "negative load", "contact.load_per_width", "h_min");
    fresh(&c);
    memset(c.load, 0, sizeof c.load);
    refused(&c, "no load at all", "contact.load_per_width", "h_min");
    fresh(&c)->gap[1] = -1e-6;
    refused(&c, "negative gap", "contact.gap", "h_min");
    fresh(&c)->modulus = 0;
    refused(&c, "no modulus", "contact.reduced_modulus", "h_min");
    fresh(&c);
    refused(&c, "roll angle of a contact without one", "roll_angle", "roll_angle");
    fresh(&c);
    refused(&c, "place of the lowest film without one", "h_min_lowest_at", "h_min_lowest_at");
    fresh(&c)->count = 0;
    refused(&c, "empty history", "contact.time", "h_min");
    fresh(&c)->load[2] = 1e308;
    refused(&c, "load beyond all numbers", "contact.load_per_width", "h_min");
    fresh(&c)->modulus = NAN;
    refused(&c, "modulus that is no number", "contact.reduced_modulus", "h_min");
}

int main(void)
{
    for (int k = 0; k < FILM_MODELS; k++) {
        model = &film_models[k];
        test_model();
    }
    return check_done();
}
