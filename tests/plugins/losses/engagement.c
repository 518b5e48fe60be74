/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engagement.h"

#include <math.h>

static const double pitch = 2 * M_PI / TEETH;
static const double pitch_point = 0.364; /* roll angle, tan 20 deg */
static const double ratio = (double)TEETH_2 / TEETH;

void engagement_fill(engagement *e, double contact_ratio)
{
    *e = (engagement){.contact_ratio = contact_ratio,
                      .base_radius = 70e-3,
                      .omega = 150,
                      .load = 200e3,
                      .friction = 0.05,
                      .face_width = 20e-3,
                      .modulus = 226.4e9,
                      .torque = 250};
    for (int i = 0; i < INSTANTS; i++) {
        double at = (i / (INSTANTS - 1.0) - 0.5) * contact_ratio * pitch; /* from the pitch point */
        double sliding = (1 + 1 / ratio) * e->omega * e->base_radius * at;
        e->roll[i] = pitch_point + at;
        e->radius_1[i] = e->base_radius * (pitch_point + at);
        e->radius_2[i] = e->base_radius * (ratio * pitch_point - at);
        e->coefficient[i] = sliding < 0 ? -e->friction : e->friction;
        e->traction[i] = e->coefficient[i] * e->load;
        e->power[i] = e->traction[i] * sliding;
    }
}

stage *engagement_open(const engagement *e)
{
    static const double teeth[] = {TEETH, TEETH_2};
    stage *s = stage_open("losses/tooth-mesh");
    stage_give_series(s, "ehl.roll_angle", INSTANTS, e->roll);
    stage_give_series(s, "ehl.power_loss", INSTANTS, e->power);
    stage_give_series(s, "ehl.sliding_loss", INSTANTS, e->power);
    stage_give_series(s, "ehl.rolling_loss", INSTANTS, e->none);
    stage_give_series(s, "ehl.squeeze_loss", INSTANTS, e->none);
    stage_give_series(s, "ehl.asperity_loss", INSTANTS, e->none);
    stage_give_series(s, "ehl.traction", INSTANTS, e->traction);
    stage_give_series(s, "ehl.friction_coefficient", INSTANTS, e->coefficient);
    stage_give_series(s, "gear.roll_angle", INSTANTS, e->roll);
    stage_give_series(s, "gear.radius_1", INSTANTS, e->radius_1);
    stage_give_series(s, "gear.radius_2", INSTANTS, e->radius_2);
    stage_give_series(s, "gear.teeth", 2, teeth);
    stage_give_scalar(s, "gear.face_width", e->face_width);
    stage_give_scalar(s, "gear.reduced_modulus", e->modulus);
    stage_give_scalar(s, "gear.contact_ratio", e->contact_ratio);
    stage_give_scalar(s, "operating.torque", e->torque);
    stage_give_scalar(s, "operating.speed", e->omega);
    stage_give_scalar(s, "operating.oil_temperature", 353.15);
    return s;
}

double engagement_sliding(const engagement *e)
{
    return (1 + 1 / ratio) / 2 * e->omega * e->base_radius * e->contact_ratio * pitch;
}

double engagement_loss(const engagement *e, double pitches)
{
    double sliding = engagement_sliding(e) * fabs(2 * pitches / e->contact_ratio - 1);
    return e->friction * e->load * sliding * e->face_width;
}
