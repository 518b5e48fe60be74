/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A complete pipeline of unequal gears with the friction of a film. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>

enum { STATIONS = 4000 };

typedef struct drive {
    stage *gear, *duty, *tooth, *oil, *rho, *flow, *film, *losses;
    double force[STATIONS];
} drive;

/* Divides the line force among the tooth pairs in contact. */
static void share(drive *d)
{
    size_t n;
    stage_run(d->gear);
    const double *roll = stage_get(d->gear, "roll_angle", &n);
    const double base_radius = stage_get(d->gear, "base_radius", NULL)[0];
    int inside = 0;
    for (size_t i = 0; i < n && i < STATIONS; i++) {
        inside ^= i > 0 && !(roll[i] > roll[i - 1]);
        d->force[i] = 250 / base_radius * (inside ? 1 : 0.5);
    }
    stage_give_series(d->tooth, "load.tooth_force", n, d->force);
}

static void drive_open(drive *d, const char *film)
{
    *d = (drive){stage_open("gear/involute-spur"),
                 stage_open("operating/steady"),
                 stage_open("contact/tooth-pair"),
                 stage_open("viscosity/roelands"),
                 stage_open("density/dowson-higginson"),
                 stage_open("rheology/ree-eyring"),
                 stage_open(film),
                 stage_open("losses/tooth-mesh"),
                 {0}};
    stage_set_text(d->gear, "teeth", "[31, 50]");
    stage_set_text(d->gear, "module", "3 mm");
    stage_set_text(d->gear, "face_width", "20 mm");
    stage_set_text(d->gear, "material_2", "EN-GJS-500-7");
    stage_set_text(d->gear, "roughness_rq", "[0.03 um, 0.07 um]");
    stage_set_text(d->duty, "torque", "250 N m");
    stage_set_text(d->duty, "oil_temperature", "40 degC");
    stage_set_text(d->duty, "mesh_frequency", "1250 Hz");
    stage_set_text(d->oil, "eta0", "5.006 mPa s");
    stage_set_text(d->oil, "alpha", "11.03 1/GPa");
    stage_set_text(d->rho, "rho0", "917.8 kg/m3");
    stage_set_text(d->flow, "tau0", "5 MPa");
    stage_link(d->duty, "gear", d->gear);
    stage_link(d->tooth, "gear", d->gear);
    stage_link(d->tooth, "operating", d->duty);
    stage_link(d->tooth, "viscosity", d->oil);
    stage_link(d->film, "contact", d->tooth);
    stage_link(d->film, "gear", d->gear);
    stage_link(d->film, "viscosity", d->oil);
    stage_link(d->film, "density", d->rho);
    stage_link(d->film, "rheology", d->flow);
    stage_link(d->losses, "ehl", d->film);
    stage_link(d->losses, "gear", d->gear);
    stage_link(d->losses, "operating", d->duty);
    share(d);
}

static void drive_close(drive *d)
{
    stage *all[] = {d->losses, d->film, d->flow, d->rho, d->oil, d->tooth, d->duty, d->gear};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        stage_close(all[i]);
}

/* Returns the integral of friction force times sliding speed over an engagement, over the mesh
   period. */
static double power_by_hand(const drive *d)
{
    size_t n;
    const double *traction = stage_get(d->film, "traction", &n);
    const double *time = stage_get(d->film, "time", NULL);
    const double *roll = stage_get(d->film, "roll_angle", NULL);
    const double radius = stage_get(d->gear, "base_radius", NULL)[0];
    const double omega = stage_scalar(d->duty, "speed"), pitch_point = tan(M_PI / 9);
    double work = 0, before = 0;
    for (size_t i = 0; i < n; i++) {
        double sliding = omega * radius * (1 + 31. / 50) * (roll[i] - pitch_point);
        double power = traction[i] * sliding;
        if (i > 0)
            work += (time[i] - time[i - 1]) * (power + before) / 2;
        before = power;
    }
    return work * 20e-3 * 1250;
}

static void test_drive(const char *film)
{
    drive d;
    drive_open(&d, film);
    if (!check_true(film, stage_run(d.film) == FF_OK && stage_run(d.losses) == FF_OK)) {
        printf("%s\n", stage_why(d.losses));
        return;
    }
    double loss = stage_scalar(d.losses, "power_loss_mean");
    double efficiency = stage_scalar(d.losses, "efficiency");
    printf("loss %g W, efficiency %g, flash %g K\n", loss, efficiency,
           stage_scalar(d.losses, "flash_temperature_max"));
    check_near("by hand", stage_scalar(d.losses, "sliding_loss_mean"), power_by_hand(&d), 1e-6);
    check_near("parts", loss,
               stage_scalar(d.losses, "sliding_loss_mean") +
                   stage_scalar(d.losses, "rolling_loss_mean") +
                   stage_scalar(d.losses, "squeeze_loss_mean") +
                   stage_scalar(d.losses, "asperity_loss_mean"),
               1e-12);
    double rolling =
        stage_scalar(d.losses, "rolling_loss_mean") / stage_scalar(d.losses, "sliding_loss_mean");
    printf("rolling over sliding %g\n", rolling);
    check_below("parts make the whole", stage_quality(d.losses, "loss_parts"), 1e-9);
    check_true("about 99 %", efficiency > 0.985 && efficiency < 0.9999);
    check_near("input", stage_scalar(d.losses, "power_input"), 250 * 2 * M_PI * 1250 / 31, 1e-9);
    check_below("force times sliding", stage_quality(d.losses, "friction_power_error"), 1e-6);
    check_below("whole engagement", stage_quality(d.losses, "engagement"), 1e-6);
    drive_close(&d);
}

int main(void)
{
    test_drive("ehl/film-formula");
    test_drive("ehl/finite-volume");
    return check_done();
}
