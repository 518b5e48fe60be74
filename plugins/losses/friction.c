/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the friction of the film with formulas that were fitted to measured gears. */
#include "friction.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <stdio.h>

/* Range of the measurements to which the formulas were fitted. */
static const double slowest = 2, fastest = 20;             /* pitch line, m/s */
static const double smoothest = 0.1e-6, roughest = 0.8e-6; /* Ra, m */

/* Outside this range of the ratio film to formula, one of the two is doubtful. */
static const double least_agreement = 0.67, most_agreement = 1.5;

static const double high_friction = 0.12; /* above all measurements of lubricated gears */
static const double most_friction = 0.2;  /* lower end for dry steel */
static const double loaded = 0.01;        /* share of the largest load below which friction is not
                                             judged */

double losses_friction_mean(const losses_mesh *m)
{
    double loss = 0, unit = 0, radius[2], speed[2], before = 0;
    for (size_t i = 0; i < m->n; i++) {
        losses_motion_at(m, m->roll[i], radius, speed);
        const double sliding = fabs(speed[0] - speed[1]);
        bool apart = i > 0 && m->engagement && m->engagement[i] != m->engagement[i - 1];
        bool known = i > 0 && m->load[i] > 0 && m->load[i - 1] > 0 && !apart;
        double width = known ? m->roll[i] - m->roll[i - 1] : 0;
        if (width > 0) {
            loss += width * (fabs(m->traction[i]) * sliding + fabs(m->traction[i - 1]) * before);
            unit += width * (m->load[i] * sliding + m->load[i - 1] * before);
        }
        before = sliding;
    }
    return unit > 0 ? loss / unit : 0;
}

/* Ohlendorf 1958, for spur gears: H_v = pi (u + 1)/(z_1 u) (1 - eps + eps_1^2 + eps_2^2). Each of
   two pairs in contact carries half of the load. eps_1 and eps_2 are the parts of the contact ratio
   before and after the pitch point. */
static double loss_factor(const losses_mesh *m, double pitch_roll)
{
    const double ratio = m->omega[0] / m->omega[1]; /* z_2/z_1 */
    const double approach = (pitch_roll - m->station[0]) / m->pitch;
    const double recess = (m->station[m->stations - 1] - pitch_roll) / m->pitch;
    /* pi/z_1 is half of the pitch */
    return m->pitch / 2 * (1 + 1 / ratio) *
           (1 - approach - recess + approach * approach + recess * recess);
}

static double factor_of_base(double base, bool *guessed)
{
    static const double factor[] = {
        [FF_BASE_MINERAL] = 1, [FF_BASE_PAO] = 0.8, [FF_BASE_ESTER] = 0.8, [FF_BASE_PAG] = 0.7};
    *guessed = !(base >= 0 && base < sizeof factor / sizeof factor[0]);
    return *guessed ? 1 : factor[(int)base];
}

/* Friction coefficient by two standards, with the load F_bt/b: torque over base radius and face
   width, N/mm; sum of surface speeds v_SC (m/s) and equivalent radius rho_C (mm) at the pitch
   point; viscosity eta at the oil temperature, mPa s; roughness Ra, mean of both flanks, um. ISO/TR
   14179-2 (Schlenk): mu = 0.048 (F_bt/b/(v_SC rho_C))^0.2 eta^-0.05 Ra^0.25 X_L ISO/TR 15144-1: mu
   = 0.045 (F_bt/b/(v_SC rho_C))^0.2 eta^-0.05 X_R X_L, X_R = 2.2 (Ra/rho_C)^0.25 */
losses_formula losses_formula_of(const losses_mesh *m, int32_t formula, double oil_factor)
{
    const size_t last = m->stations - 1;
    const double line = m->radius[0][0] + m->radius[1][0];
    /* share of radius 1 in the line of action */
    const double share = m->omega[1] / (m->omega[0] + m->omega[1]);
    const double base_radius =
        (m->radius[0][last] - m->radius[0][0]) / (m->station[last] - m->station[0]);
    const double pitch_roll = m->station[0] + (share * line - m->radius[0][0]) / base_radius;
    const double speed = 2 * m->omega[0] * share * line;           /* v_SC */
    const double radius = share * (1 - share) * line;              /* rho_C */
    const double load = m->torque / (base_radius * m->face_width); /* F_bt/b, N/m */
    losses_formula f = {.film = losses_friction_mean(m),
                        .loss_factor = loss_factor(m, pitch_roll),
                        .pitch_speed = m->omega[0] * hypot(base_radius, share * line),
                        .roughness = m->roughness,
                        .oil_factor = oil_factor};
    if (isnan(oil_factor))
        f.oil_factor = factor_of_base(m->oil_base, &f.oil_is_guessed);
    const double rough = 1e6 * m->roughness;
    const double by_roughness = formula == LOSSES_ISO_15144
                                    ? 0.045 * 2.2 * pow(rough / (1e3 * radius), 0.25)
                                    : 0.048 * pow(rough, 0.25);
    f.coefficient = rough > 0 ? pow(1e-3 * load / (speed * 1e3 * radius), 0.2) *
                                    pow(1e3 * m->viscosity, -0.05) * by_roughness * f.oil_factor
                              : NAN;
    return f;
}

/* Returns the largest friction coefficient under more than 1 % of the largest load. */
static double highest_friction(const losses_mesh *m, size_t *at)
{
    double most = 0, highest = 0;
    for (size_t i = 0; i < m->n; i++)
        most = fmax(most, m->load[i]);
    for (size_t i = 0; i < m->n; i++)
        if (m->load[i] > loaded * most && fabs(m->friction[i]) > highest) {
            highest = fabs(m->friction[i]);
            *at = i;
        }
    return highest;
}

static void report_bound(const ff_host *host, const losses_mesh *m)
{
    char text[200];
    size_t at = 0;
    const double highest = highest_friction(m, &at);
    snprintf(
        text, sizeof text,
        "highest friction coefficient where the load exceeds 1 %% of its maximum, at roll angle "
        "%.3g rad; lubricated gears have less than 0.12, and above 0.2 the rheology law does not "
        "hold",
        m->shown[at]);
    host->quality(host->ctx, "friction_bound", highest, high_friction,
                  highest > most_friction   ? FF_BAD
                  : highest > high_friction ? FF_RANGE
                                            : FF_GOOD,
                  text);
}

void losses_report_factor(const ff_host *host, const losses_mesh *m)
{
    const bool within = m->contact_ratio >= 1 && m->contact_ratio <= 2;
    host->quality(
        host->ctx, "loss_factor_range", m->contact_ratio, m->contact_ratio < 1 ? 1 : 2,
        within ? FF_GOOD : FF_RANGE,
        "contact ratio; loss_factor holds for one or two pairs in mesh, contact ratios of 1 to 2");
}

void losses_report_friction(const ff_host *host, const losses_mesh *m, const losses_formula *f,
                            bool wanted)
{
    char text[320];
    report_bound(host, m);
    if (!(f->coefficient > 0))
        return;
    const bool within = f->pitch_speed >= slowest && f->pitch_speed <= fastest &&
                        f->roughness >= smoothest && f->roughness <= roughest;
    snprintf(text, sizeof text,
             "pitch line speed in m/s, with Ra %.3g um; the formula is fitted to losses measured "
             "at 2 to 20 m/s with Ra 0.1 to 0.8 um%s",
             1e6 * f->roughness,
             f->pitch_speed < slowest ? ", and at lower speeds exceeds measured boundary friction"
                                      : "");
    host->quality(host->ctx, "friction_formula_range", f->pitch_speed,
                  f->pitch_speed < slowest ? slowest : fastest,
                  within || !wanted ? FF_GOOD : FF_RANGE, text);
    const double ratio = f->film / f->coefficient;
    const bool agrees = ratio >= least_agreement && ratio <= most_agreement;
    snprintf(text, sizeof text,
             "friction coefficient of the film, %.3g, over that of the formula, %.3g%s%s", f->film,
             f->coefficient,
             f->oil_is_guessed ? " for a mineral oil, since the base oil is unknown" : "",
             !within  ? "; the gear is outside the range of the formula, so the ratio proves "
                        "nothing"
             : agrees ? "; the formula is fitted to measured losses of gears"
                      : "; the formula is fitted to measured losses of gears: check the laws of "
                        "the oil at high pressure, and the roughness");
    host->quality(host->ctx, "friction_agreement", ratio,
                  ratio < 1 ? least_agreement : most_agreement,
                  agrees || !within ? FF_GOOD : FF_RANGE, text);
}
