/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Torque and speed of Li & Kahraman 2011, given as speed and as mesh frequency. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <string.h>

static const double base_radius[2] = {70.476947e-3, 140.0e-3}, teeth[2] = {50, 100};

static stage *open_duty(const char *param, const char *text)
{
    stage *duty = stage_open("operating/steady");
    stage_set_text(duty, "torque", "250 N m");
    stage_set_text(duty, "oil_temperature", "40 degC");
    if (param)
        stage_set_text(duty, param, text);
    return duty;
}

static void give_gear(stage *duty)
{
    stage_give_series(duty, "gear.teeth", 2, teeth);
    stage_give_series(duty, "gear.base_radius", 2, base_radius);
}

static void check_point(const char *frequency, double hertz, double rpm)
{
    stage *by_frequency = open_duty("mesh_frequency", frequency), *by_speed = open_duty(NULL, NULL);
    stage_set(by_speed, "speed", rpm * M_PI / 30);
    stage *duties[2] = {by_frequency, by_speed};
    for (int i = 0; i < 2; i++) {
        give_gear(duties[i]);
        if (!check_true("runs", stage_run(duties[i]) == FF_OK))
            continue;
        check_near("speed, rpm", stage_scalar(duties[i], "speed") * 30 / M_PI, rpm, 1e-14);
        check_near("mesh frequency", stage_scalar(duties[i], "mesh_frequency"), hertz, 1e-14);
        check_near("line force, N", stage_scalar(duties[i], "line_force"), 3547.26, 0.005 / 3547);
        check_near("torque", stage_scalar(duties[i], "torque"), 250, 0);
        check_near("oil at 40 degC", stage_scalar(duties[i], "oil_temperature"), 313.15, 1e-15);
    }
    stage_close(by_frequency);
    stage_close(by_speed);
}

/* Without a gear, outputs that need no gear must be given, and requests for others fail with their
   name. */
static void check_without_gear(void)
{
    stage *duty = open_duty("speed", "1500 rpm");
    check_true("speed needs no gear", stage_run_wanted(duty, "torque speed") == FF_OK);
    check_near("speed, rad/s", stage_scalar(duty, "speed"), 50 * M_PI, 1e-15);
    check_true("mesh frequency needs a gear",
               stage_run_wanted(duty, "mesh_frequency") == FF_INVALID &&
                   !strcmp(stage_why_item(duty), "gear.teeth") &&
                   strstr(stage_why(duty), "mesh_frequency needs a gear"));
    check_true("line force needs a gear", stage_run_wanted(duty, "line_force") == FF_INVALID &&
                                              !strcmp(stage_why_item(duty), "gear.base_radius") &&
                                              strstr(stage_why(duty), "line_force needs a gear"));
    stage_close(duty);
    duty = open_duty("mesh_frequency", "1250 Hz");
    check_true("mesh frequency as given needs no gear",
               stage_run_wanted(duty, "mesh_frequency torque") == FF_OK);
    check_true("speed from mesh frequency needs a gear",
               stage_run_wanted(duty, "speed") == FF_INVALID);
    stage_close(duty);
}

/* The oil temperature has no default: a model that needs it must report where it is missing. */
static void check_without_temperature(void)
{
    stage *duty = stage_open("operating/steady");
    stage_set_text(duty, "torque", "250 N m");
    stage_set_text(duty, "speed", "1500 rpm");
    check_true("nobody reads it", stage_run_wanted(duty, "torque speed") == FF_OK);
    check_true("it is asked for", stage_run_wanted(duty, "oil_temperature") == FF_UNSUPPORTED &&
                                      !strcmp(stage_why_item(duty), "oil_temperature") &&
                                      strstr(stage_why(duty), "oil_temperature is missing"));
    stage_close(duty);
}

static void check_refusals(void)
{
    stage *duty = open_duty(NULL, NULL);
    check_true("neither speed nor mesh frequency",
               stage_ready(duty) == FF_INVALID && !strcmp(stage_why_item(duty), "speed"));
    stage_close(duty);
    duty = open_duty("speed", "1500 rpm");
    const double nothing[2] = {0, NAN};
    stage_give_series(duty, "gear.teeth", 2, nothing);
    stage_give_series(duty, "gear.base_radius", 1, nothing + 1);
    check_true("a gear with 0 teeth", stage_run_wanted(duty, "mesh_frequency") == FF_INVALID);
    check_true("a gear without radius", stage_run_wanted(duty, "line_force") == FF_INVALID);
    stage_close(duty);
}

/* A torque below 0 must load the back flanks. */
static void check_back(void)
{
    stage *duty = open_duty("speed", "1500 rpm");
    stage_set_text(duty, "torque", "-250 N m");
    give_gear(duty);
    check_true("below 0", stage_run(duty) == FF_OK);
    check_near("line force, N", stage_scalar(duty, "line_force"), -3547.26, 0.005 / 3547);
    check_near("mesh frequency", stage_scalar(duty, "mesh_frequency"), 1250, 1e-14);
    check_near("torque", stage_scalar(duty, "torque"), -250, 0);
    check_near("no other reference", stage_scalar(duty, "reference_force"), 0, 0);
    stage_close(duty);
    duty = open_duty("reference_torque", "30 N m");
    stage_set_text(duty, "speed", "1500 rpm");
    stage_set_text(duty, "torque", "0 N m");
    give_gear(duty);
    check_true("none", stage_run(duty) == FF_OK);
    check_near("no line force", stage_scalar(duty, "line_force"), 0, 0);
    check_near("that of the reference", stage_scalar(duty, "reference_force"), 30 / base_radius[0],
               1e-14);
    stage_close(duty);
}

int main(void)
{
    check_back();
    check_point("1250 Hz", 1250, 1500);
    check_point("2085 Hz", 2085, 2502);
    check_point("2375 Hz", 2375, 2850);
    check_without_gear();
    check_without_temperature();
    check_refusals();
    return check_done();
}
