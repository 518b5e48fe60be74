/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pair.h"

#include <stddef.h>

const char pair_dry[] = "time roll_angle radius_1 radius_2 equivalent_radius speed_1 speed_2 "
                        "entrainment_speed sliding_speed slide_roll_ratio load_per_width "
                        "hertz_half_width hertz_pressure gap reduced_modulus";

static pair open_stages(void)
{
    pair p = {stage_open("gear/involute-spur"), stage_open("operating/steady"),
              stage_open("contact/tooth-pair")};
    stage_set_text(p.gear, "module", "3 mm");
    stage_set_text(p.gear, "face_width", "20 mm");
    stage_set_text(p.duty, "torque", "250 N m");
    stage_set_text(p.duty, "mesh_frequency", "1250 Hz");
    stage_link(p.duty, "gear", p.gear);
    stage_link(p.tooth, "gear", p.gear);
    stage_link(p.tooth, "operating", p.duty);
    return p;
}

static pair open_with(const char *teeth, const char *shift, const char *moduli)
{
    pair p = open_stages();
    stage_set_text(p.gear, "teeth", teeth);
    stage_set_text(p.gear, "profile_shift", shift);
    stage_set_text(p.gear, "elastic_modulus", moduli);
    stage_run(p.gear);
    return p;
}

pair pair_open(void)
{
    return open_with("[25, 40]", "[0.3, 0.1]", "[206 GPa, 170 GPa]");
}

pair pair_open_exchanged(void)
{
    return open_with("[40, 25]", "[0.1, 0.3]", "[170 GPa, 206 GPa]");
}

pair pair_open_printed(void)
{
    return open_with("50", "0", "206 GPa");
}

pair pair_open_long(const char *tip_diameter)
{
    pair p = open_stages();
    stage_set_text(p.gear, "teeth", "50");
    stage_set_text(p.gear, "tip_diameter", tip_diameter);
    stage_set_text(p.gear, "root_diameter", "140 mm");
    stage_run(p.gear);
    return p;
}

void pair_close(pair *p)
{
    stage_close(p->tooth);
    stage_close(p->duty);
    stage_close(p->gear);
}

const double *pair_stations(const pair *p, size_t *n)
{
    return stage_get(p->gear, "roll_angle", n);
}

void pair_share(const pair *p, double force, double *tooth_force)
{
    size_t n;
    const double *roll = pair_stations(p, &n);
    int side = 0; /* 1 between the two jumps */
    for (size_t i = 0; i < n; i++) {
        side ^= i > 0 && roll[i] == roll[i - 1];
        tooth_force[i] = side ? force : force / 2;
    }
}
