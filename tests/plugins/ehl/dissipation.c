/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the dissipation in the film with published solutions, other integrals and other
   domains. */
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>

static const char losses[] = "sliding_loss rolling_loss squeeze_loss asperity_loss power_loss";

static double loss(line *c, const char *output)
{
    return line_value(c, output, 0);
}

/* In a steady film, the pressure flow dissipates the work of the entrainment: the squeeze loss,
   which is their difference, is only the error of the discretisation. Returns squeeze loss over
   rolling loss. */
static double difference(const char *model, size_t cells)
{
    line c;
    line_open(&c, model);
    line_eyring(&c, 5e6);
    c.u1[0] *= 1.1;
    c.u2[0] *= 0.9;
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "tolerance", 1e-8);
    check_true("runs", line_run(&c, losses) == FF_OK);
    double share = fabs(loss(&c, "squeeze_loss")) / loss(&c, "rolling_loss");
    double sum = loss(&c, "sliding_loss") + loss(&c, "rolling_loss") + loss(&c, "squeeze_loss");
    check_near("the whole", loss(&c, "power_loss"), sum, 1e-12);
    line_close(&c);
    return share;
}

static void test_order(const char *model)
{
    double coarse = difference(model, 256), fine = difference(model, 512),
           finest = difference(model, 1024);
    printf("%s: dissipation off the work by %.2g, %.2g, %.2g at 256, 512, 1024 cells\n", model,
           coarse, fine, finest);
    check_below("dissipation against work, 512 cells", fine, 1e-3);
    check_below("second order", fine / coarse, 1 / 3.5);
    check_below("second order", finest / fine, 1 / 3.5);
}

/* Rolling force of Biboulet & Houpert (2010, Proc. IMechE J 224) for Barus' and Dowson &
   Higginson's laws: their fit to solutions with M 0.2 to 200 and L 4 to 16, within a "few per
   cent". The models without a pressure solution use this fit. */
static void test_published(double M, double L)
{
    const double U = 1e-11;
    double rolling[2];
    for (int k = 0; k < 2; k++) {
        line c;
        line_open(&c, k ? "ehl/film-formula" : "ehl/finite-volume");
        double scale = c.modulus * c.radius[0];
        line_oil(&c, "viscosity/barus", U * scale / c.u1[0], L / (c.modulus * pow(2 * U, 0.25)));
        c.load[0] = M * sqrt(2 * U) * scale;
        if (k == 0)
            stage_set(c.film, "cells", 1024);
        check_true("runs", line_run(&c, losses) == FF_OK);
        rolling[k] = loss(&c, "rolling_loss");
        line_close(&c);
    }
    printf("M %g, L %g: rolling over the published fit %.3f\n", M, L, rolling[0] / rolling[1]);
    check_near("published rolling force", rolling[0], rolling[1], 0.15);
}

/* The loss must not depend on the inlet, here of 5 and 16 Hertz half-widths a. */
static void test_inlet(const char *model)
{
    double rolling[2];
    for (int k = 0; k < 2; k++) {
        line c;
        line_open(&c, model);
        stage_set(c.film, "inlet", k ? 16 : 5);
        stage_set(c.film, "outlet", 1.5);
        stage_set(c.film, "cells", k ? 1024 : 384);
        check_true("runs", line_run(&c, losses) == FF_OK);
        rolling[k] = loss(&c, "rolling_loss");
        line_close(&c);
    }
    check_near("rolling: inlet of 5 a and 16 a", rolling[0], rolling[1], 0.01);
}

/* Returns the load at a step of a history with equally spaced rows. */
static double load_at(const line *c, size_t step, size_t steps)
{
    double at = (double)step / (double)steps * (double)(c->count - 1);
    size_t i = (size_t)fmin(at, (double)(c->count - 2));
    return c->load[i] + (at - (double)i) * (c->load[i + 1] - c->load[i]);
}

/* Over a period of the load, the film stores no energy, and the squeeze loss is the work of the
   load on the approach of the bodies, from `separation`. Returns the difference of both integrals,
   over the integral of the loss's absolute value. */
static double off_the_way(const line *c, size_t steps)
{
    double work = 0, taken = 0, moved = 0;
    for (size_t k = steps / 2; k < steps; k++) {
        double dt = line_value(c, "time", k + 1) - line_value(c, "time", k);
        double force = load_at(c, k, steps) + load_at(c, k + 1, steps);
        double loss = line_value(c, "squeeze_loss", k) + line_value(c, "squeeze_loss", k + 1);
        work -= 0.5 * force * (line_value(c, "separation", k + 1) - line_value(c, "separation", k));
        taken += 0.5 * loss * dt;
        moved += 0.5 * fabs(loss) * dt;
    }
    return fabs(work - taken) / moved;
}

/* An incompressible film under an oscillating load: the squeeze loss must be -int p dh/dt dx, here
   from the fields at three instants. Returns the largest difference over the largest squeeze loss.
   The squeeze loss has both signs, but the total dissipation is positive. */
static double off_the_work(const char *model, size_t cells, size_t steps, double *way)
{
    static line c;
    const size_t rows = 201;
    line_open(&c, model);
    line_incompressible(&c);
    line_last(&c, rows, 400e-6);
    for (size_t i = 0; i < rows; i++)
        c.load[i] *= 1 - 0.5 * cos(4 * acos(-1) * (double)i / (double)(rows - 1));
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "steps", (double)steps);
    stage_set(c.film, "tolerance", 1e-7);
    check_true("runs",
               line_run(&c, "squeeze_loss power_loss time separation x film pressure") == FF_OK);
    const double *h = stage_get(c.film, "film", NULL), *p = stage_get(c.film, "pressure", NULL),
                 *x = stage_get(c.film, "x", NULL);
    double worst = 0, most = 0, least = 0, power = HUGE_VAL, dx = x[1] - x[0];
    for (size_t k = 1; k < steps; k++) {
        double dt = line_value(&c, "time", k + 1) - line_value(&c, "time", k - 1), work = 0;
        for (size_t i = k * (cells + 1); i < (k + 1) * (cells + 1); i++)
            work -= p[i] * (h[i + cells + 1] - h[i - cells - 1]) / dt * dx;
        double squeeze = line_value(&c, "squeeze_loss", k);
        worst = fmax(worst, fabs(squeeze - work));
        most = fmax(most, squeeze);
        least = fmin(least, squeeze);
        power = fmin(power, line_value(&c, "power_loss", k));
    }
    printf("%s: squeeze loss %.3g to %.3g W/m, off the work of the film by %.2g of it\n", model,
           least, most, worst / most);
    check_true("it takes and gives", most > 0 && least < -0.3 * most);
    check_true("what is dissipated is positive", power > 0);
    *way = off_the_way(&c, steps);
    line_close(&c);
    return worst / most;
}

static void test_squeeze(const char *model)
{
    double way[2];
    double coarse = off_the_work(model, 256, 800, &way[0]),
           fine = off_the_work(model, 512, 1600, &way[1]);
    check_below("squeeze loss against the work of the film", fine, 0.01);
    check_below("second order", fine / coarse, 1 / 2.8);
    check_below("squeeze loss against the work of the load", way[1], 0.01);
    check_below("second order", way[1] / way[0], 1 / 2.8);
}

static void test_asperities(void)
{
    static flank f;
    static line c;
    flank_random(&f, 1, 0.5e-6, 60e-6, 400e-6);
    line_open(&c, "ehl/finite-volume");
    line_eyring(&c, 5e6);
    c.u1[0] *= 0.01 * 0.9;
    c.u2[0] *= 0.01 * 1.1;
    line_last(&c, 2, 50e-6 / 0.0403);
    stage_set(c.film, "cells", 256);
    stage_set(c.film, "steps", 40);
    stage_set(c.film, "boundary_friction", 0.2);
    flank_give(&f, c.film);
    check_true("runs", line_run(&c, "asperity_loss asperity_load_share power_loss sliding_loss "
                                    "rolling_loss squeeze_loss traction") == FF_OK);
    double share = line_value(&c, "asperity_load_share", 40), slide = c.u2[0] - c.u1[0];
    check_true("asperities carry", share > 0.01);
    check_near("their friction", line_value(&c, "asperity_loss", 40),
               0.2 * share * c.load[0] * slide, 1e-9);
    check_near("all friction", -line_value(&c, "traction", 40) * slide,
               line_value(&c, "asperity_loss", 40) + line_value(&c, "sliding_loss", 40), 1e-12);
    line_close(&c);
}

int main(void)
{
    static const char *const models[] = {"ehl/finite-volume", "ehl/control-volume"};
    for (int k = 0; k < 2; k++) {
        test_order(models[k]);
        test_inlet(models[k]);
        test_squeeze(models[k]);
    }
    test_published(0.2, 8);
    test_published(1, 8);
    test_published(2, 8);
    test_published(5, 8);
    test_published(20, 8);
    test_published(100, 8);
    test_asperities();
    return check_done();
}
