/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pair.h"

#include <flankfilm/laws.h>

#include <math.h>

static const double degree = M_PI / 180, mm = 1e-3;

const pair pair_a = {{16, 24}, {0.853, -0.5}, {88.77, 112.5}, 20,    536.5, 2170,
                     90,       0.35,          "ISO VG 100",   {0, 0}};
const pair pair_c = {{16, 24}, {0.182, 0.171}, {82.46, 118.36}, 14, 265.1, 2250, 90,
                     0.5,      "ISO VG 220",   {0, 0}};

double oil_viscosity(stage *oil, double T)
{
    const ff_liquid *liquid = stage_service(oil, FF_LIQUID_ID);
    double kelvin = T + 273.15, ln_eta = NAN;
    liquid->eval(liquid->self, FF_LIQUID_LN_ETA0, 1, &kelvin, &ln_eta, NULL);
    return 1e3 * exp(ln_eta);
}

double oil_density(stage *oil, double T)
{
    const ff_liquid *liquid = stage_service(oil, FF_LIQUID_ID);
    double kelvin = T + 273.15, rho = NAN;
    liquid->eval(liquid->self, FF_LIQUID_RHO0, 1, &kelvin, &rho, NULL);
    return rho;
}

pair pair_reversed(const pair *p)
{
    pair r = *p;
    for (int i = 0; i < 2; i++) {
        r.teeth[i] = p->teeth[1 - i];
        r.shift[i] = p->shift[1 - i];
        r.tip_diameter[i] = p->tip_diameter[1 - i];
        r.relief[i] = p->relief[1 - i];
    }
    r.torque = p->torque * p->teeth[1] / p->teeth[0];
    r.rpm = p->rpm * p->teeth[0] / p->teeth[1];
    return r;
}

stage *pair_open(const char *id, const pair *p, stage **oil)
{
    const double r = 4.5 * mm / 2, a = 91.5 * mm;
    const size_t shape[2] = {2, 2};
    double base[2], pitch[2], tip[2], roughness[2], profile[2][2] = {{0}};
    for (int i = 0; i < 2; i++) {
        base[i] = r * p->teeth[i] * cos(20 * degree);
        pitch[i] = a * p->teeth[i] / (p->teeth[0] + p->teeth[1]);
        tip[i] = p->tip_diameter[i] / 2 * mm;
        roughness[i] = p->roughness * (i == 0 ? 0.8 : 1.2) * 1e-6 * sqrt(M_PI / 2);
        profile[i][1] = -1e-6 * p->relief[i];
    }
    stage *s = stage_open(id);
    *oil = stage_open("lubricant/grade");
    stage_set_text(*oil, "grade", p->grade);
    stage_set_text(*oil, "base", "mineral");
    stage_set_text(*oil, "temperature", "90 degC");
    stage_give_series(s, "gear.teeth", 2, p->teeth);
    stage_give_series(s, "gear.base_radius", 2, base);
    stage_give_series(s, "gear.pitch_radius", 2, pitch);
    stage_give_series(s, "gear.tip_radius", 2, tip);
    stage_give_scalar(s, "gear.centre_distance", a);
    stage_give_scalar(s, "gear.working_pressure_angle", acos((base[0] + base[1]) / a));
    stage_give_scalar(s, "gear.pressure_angle", 20 * degree);
    stage_give_scalar(s, "gear.face_width", p->width * mm);
    stage_give_scalar(s, "gear.reduced_modulus", 206e9 / 0.91);
    stage_give_series(s, "gear.roughness", 2, roughness);
    stage_give(s, "gear.profile_deviation", 2, shape, profile[0]);
    stage_give_scalar(s, "operating.line_force", p->torque / base[0]);
    stage_give_scalar(s, "operating.speed", p->rpm * 2 * M_PI / 60);
    stage_give_scalar(s, "operating.oil_temperature", p->oil + 273.15);
    stage_link(s, "oil", *oil);
    return s;
}
