/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film connected back to the dynamics: its friction and rolling resistance act on the gears as
   torques, its thickness is in series with the teeth. Compares the motion with a separate
   integration of both gears in small steps, with closed forms, and shooting with time integration
   in a loop with a film that depends on the load. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 4001, TWIN = 10000, MOST = 4096 };

static const double width = 0.02, face = 0.02, sap = 0.25, path = 1.755;

/* Gear 1 with 50 teeth, and gear 2: numbers of teeth, base radii, inertias. */
typedef struct gears {
    double teeth[2], base[2], inertia[2], tangent;
    int shared; /* whether load fractions depend on the mesh force */
} gears;

static gears gears_of(double teeth_2, double inertia_2)
{
    gears g = {{50, teeth_2}, {0.0705, 0.0705 * teeth_2 / 50}, {4e-3, inertia_2}, 0.364, 0};
    return g;
}

/* Returns the radius of curvature of a gear, a number of mesh cycles after SAP; both radii add up
   to the sum of the base radii times the tangent of the pressure angle. */
static double radius_at(const gears *g, int gear, double cycles)
{
    double r1 = g->base[0] * (sap + cycles * 2 * M_PI / 50);
    return gear ? (g->base[0] + g->base[1]) * g->tangent - r1 : r1;
}

/* A prescribed film: traction per width over the mesh cycles since SAP. */
static double traction_at(double cycles)
{
    return 3e3 * sin(3 * (cycles - 0.8)) * (1 + 0.3 * cycles);
}

static double rolling_at(double cycles)
{
    return 900 * (1 + 0.5 * sin(2 * cycles));
}

static double film_at(double cycles)
{
    return 4e-7 * (1 + 0.4 * cos(2.5 * cycles));
}

static void give_gears(stage *s, const gears *g)
{
    double cycles[PAIR_STATIONS], radius[PAIR_STATIONS];
    static const double at[PAIR_STATIONS] = {0,   0.3, 0.5, 0.755, 0.755, 0.9,
                                             1.0, 1.0, 1.3, 1.5,   1.755};
    memcpy(cycles, at, sizeof at);
    for (int gear = 0; gear < 2; gear++) {
        for (int i = 0; i < PAIR_STATIONS; i++)
            radius[i] = radius_at(g, gear, cycles[i]);
        stage_give_series(s, gear ? "gear.radius_2" : "gear.radius_1", PAIR_STATIONS, radius);
    }
    stage_give_series(s, "gear.teeth", 2, g->teeth);
    stage_give_series(s, "gear.inertia", 2, g->inertia);
    stage_give_scalar(s, "gear.face_width", face);
}

typedef struct film {
    double roll[STEPS], engagement[STEPS], traction[STEPS], rolling[STEPS], loss[STEPS],
        thickness[STEPS], pressure[STEPS], load[STEPS];
} film;

static double cycles_of(int i)
{
    return path * i / (STEPS - 1);
}

static void give_film(stage *s, const film *f)
{
    stage_give_series(s, "film.roll_angle", STEPS, f->roll);
    stage_give_series(s, "film.engagement", STEPS, f->engagement);
    stage_give_series(s, "film.traction", STEPS, f->traction);
    stage_give_series(s, "film.rolling_loss", STEPS, f->rolling);
    stage_give_series(s, "film.power_loss", STEPS, f->loss);
    stage_give_series(s, "film.h_central", STEPS, f->thickness);
    stage_give_series(s, "film.p_max", STEPS, f->pressure);
    stage_give_series(s, "film.load_per_width", STEPS, f->load);
}

static film prescribed(void)
{
    static film f;
    for (int i = 0; i < STEPS; i++) {
        double c = cycles_of(i);
        f.roll[i] = sap + c * 2 * M_PI / 50;
        f.traction[i] = traction_at(c);
        f.rolling[i] = rolling_at(c);
        f.thickness[i] = film_at(c);
        f.pressure[i] = 1e9;
    }
    return f;
}

/* Returns the load fraction of the tooth pair whose contact began `cycles` ago, as in pair.c. */
static double share_at(double cycles)
{
    const double at[] = {0, 0.3, 0.5, 0.755}, late[] = {1, 1.3, 1.5, 1.755};
    const double *x = cycles < 0.755 ? at : late;
    if (cycles >= 0.755 && cycles < 1)
        return 1;
    for (int i = 0; i < 3; i++)
        if (cycles <= x[i + 1]) {
            double t = (cycles - x[i]) / (x[i + 1] - x[i]);
            double a = x == at ? 0.4 + 0.2 * x[i] : 0.6 - 0.2 * (x[i] - 1);
            double z = x == at ? 0.4 + 0.2 * x[i + 1] : 0.6 - 0.2 * (x[i + 1] - 1);
            return a + t * (z - a);
        }
    return 0.6 - 0.2 * 0.755;
}

/* Forces over the mean load: the mesh force that the film carries, and the force of a pair under
   it. Up to half the mean load, both pairs carry equal loads, at the mean load those of pair.c. */
static double borne_at(double cycles)
{
    return 1 + 0.4 * sin(2 * M_PI * cycles);
}

static double tooth_force_at(double cycles, double force)
{
    int alone = cycles >= 0.755 && cycles < 1;
    return alone ? force : 0.5 * force + (share_at(cycles) - 0.5) * fmax(2 * force - 1, 0);
}

static double weight_at(const gears *g, double cycles)
{
    return g->shared ? tooth_force_at(cycles, borne_at(cycles)) : share_at(cycles);
}

static void load(const pair *p, film *f)
{
    for (int i = 0; i < STEPS; i++) {
        double c = cycles_of(i);
        f->load[i] = p->line_force * tooth_force_at(c, borne_at(c)) / face;
    }
}

/* Gives the force levels of a mesh whose stiffness does not depend on the force, but whose load
   fractions do. */
static void give_levels(stage *s, const pair *p)
{
    enum { LEVELS = 4, PHASES = 6 };
    static const double part[LEVELS] = {0, 0.5, 1, 2},
                        at[PAIR_STATIONS] = {0,        0.3, 0.5, 0.755 - 1e-9, 0.755, 0.9,
                                             1 - 1e-9, 1,   1.3, 1.5,          1.755};
    double force[LEVELS], error[LEVELS * PHASES], stiffness[LEVELS * PHASES];
    double teeth[LEVELS * PAIR_STATIONS];
    for (int k = 0; k < LEVELS; k++) {
        force[k] = part[k] * p->line_force;
        for (int i = 0; i < PHASES; i++) {
            stiffness[k * PHASES + i] = p->stiffness[i];
            error[k * PHASES + i] = force[k] / p->stiffness[i];
        }
        for (int i = 0; i < PAIR_STATIONS; i++)
            teeth[k * PAIR_STATIONS + i] = p->line_force * tooth_force_at(at[i], part[k]);
    }
    check_true("phases", p->phases == PHASES);
    stage_set_text(s, "force", "shared");
    stage_give_series(s, "stiffness.loaded_transmission_error", PHASES, error + 2 * PHASES);
    stage_give_series(s, "stiffness.force_level", LEVELS, force);
    stage_give(s, "stiffness.level_error", 2, (size_t[]){LEVELS, PHASES}, error);
    stage_give(s, "stiffness.level_stiffness", 2, (size_t[]){LEVELS, PHASES}, stiffness);
    stage_give(s, "stiffness.level_tooth_force", 2, (size_t[]){LEVELS, PAIR_STATIONS}, teeth);
}

/* Computes the resisting torques and the film thickness in series, from all tooth pairs at a
   phase. */
static void sum_pairs(const gears *g, double mesh_frequency, double phase, double against[2],
                      double *thickness)
{
    double borne = 0, speed[2] = {2 * M_PI * mesh_frequency / g->teeth[0],
                                  2 * M_PI * mesh_frequency / g->teeth[1]};
    against[0] = against[1] = *thickness = 0;
    for (double c = phase; c < path; c++) {
        double r1 = radius_at(g, 0, c), r2 = radius_at(g, 1, c), F = width * traction_at(c);
        double f = width * rolling_at(c) / (r1 * speed[0] + r2 * speed[1]);
        against[0] += (F + f) * r1;
        against[1] += (f - F) * r2;
        borne += weight_at(g, c);
        *thickness += weight_at(g, c) * film_at(c);
    }
    *thickness /= borne;
}

/* Integrates angle and speed of each gear from the start of the model's motion, by Runge and
   Kutta's method. Returns the largest difference from the model's s, over the largest effect of the
   film on s, the difference from the motion without feedback. */
typedef struct twin {
    const pair *p;
    const gears *g;
    double damper, mean_film, torque[2];
} twin;

/* Whether the contact of a tooth pair ends or begins between two phases. */
static int leaves(double from, double to)
{
    return (from < path - 1 && to >= path - 1) || to >= 1;
}

static double stiffness_at(const pair *p, double phase)
{
    size_t i = 0;
    while (i + 2 < p->phases && p->phase[i + 1] <= phase)
        i++;
    double t = (phase - p->phase[i]) / (p->phase[i + 1] - p->phase[i]);
    return p->stiffness[i] + t * (p->stiffness[i + 1] - p->stiffness[i]);
}

static void turn(const twin *w, double time, const double y[4], double rate[4])
{
    const gears *g = w->g;
    double phase = time * w->p->mesh_frequency, b = w->p->backlash / 2, step = 1e-6;
    double against[2], other[2], h, next;
    phase -= floor(phase);
    sum_pairs(g, w->p->mesh_frequency, phase, against, &h);
    sum_pairs(g, w->p->mesh_frequency, phase + step, other, &next);
    double h_rate = leaves(phase, phase + step) ? 0 : (next - h) / step * w->p->mesh_frequency;
    double s = g->base[0] * y[0] - g->base[1] * y[1], v = g->base[0] * y[2] - g->base[1] * y[3];
    double delta = s + h - w->mean_film;
    double bend = delta > b ? delta - b : delta < -b ? delta + b : 0;
    double W = stiffness_at(w->p, phase) * bend + w->damper * (v + h_rate);
    rate[0] = y[2];
    rate[1] = y[3];
    rate[2] = (w->torque[0] - g->base[0] * W - against[0]) / g->inertia[0];
    rate[3] = (-w->torque[1] + g->base[1] * W - against[1]) / g->inertia[1];
}

/* When a pair's contact ends, the film thickness jumps, and the damper gives an impulse. */
static void pass_leaving(const twin *w, double y[4])
{
    double against[2], before, behind;
    sum_pairs(w->g, w->p->mesh_frequency, path - 1 - 1e-9, against, &before);
    sum_pairs(w->g, w->p->mesh_frequency, path - 1 + 1e-9, against, &behind);
    for (int i = 0; i < 2; i++)
        y[2 + i] -= (i ? -1 : 1) * w->g->base[i] * w->damper * (behind - before) / w->g->inertia[i];
}

static void step_twin(const twin *w, double time, double h, double y[4])
{
    static const double at[] = {0, 0.5, 0.5, 1}, weight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
    double k[4][4], from[4], sum[4] = {0};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++)
            from[j] = y[j] + (i ? at[i] * h * k[i - 1][j] : 0);
        turn(w, time + at[i] * h, from, k[i]);
        for (int j = 0; j < 4; j++)
            sum[j] += weight[i] * h * k[i][j];
    }
    for (int j = 0; j < 4; j++)
        y[j] += sum[j];
}

static const char outputs[] =
    "phase dte dte_velocity dte_rms mesh_force dte_harmonics period contact_loss"
    " damper_loss excitation_power torque_power friction_work "
    "film_power";

static const char motion[] = "phase dte dte_rms mesh_force dte_harmonics period contact_loss";

static bool run(stage *s)
{
    return stage_run_wanted(s, outputs) == FF_OK;
}

static stage *open_motion(const char *id, const pair *p, const gears *g, const char *branch)
{
    stage *s = pair_open(id, p);
    give_gears(s, g);
    stage_set_text(s, "branch", branch);
    stage_set_text(s, "steps_per_cycle", "500");
    return s;
}

static void check_twin(double frequency, const char *branch, double teeth_2, double inertia_2,
                       int shared)
{
    gears g = gears_of(teeth_2, inertia_2);
    g.shared = shared;
    pair p = pair_trapezoid(frequency);
    film f = prescribed();
    char name[100];
    double give[2], mean[2] = {0, 0}, mean_film = 0, against[2], thickness;
    for (int i = 0; i < 2; i++)
        give[i] = g.base[i] * g.base[i] / g.inertia[i];
    p.mass = 1 / (give[0] + give[1]);
    for (int i = 0; i < TWIN; i++) {
        sum_pairs(&g, frequency, (i + 0.5) / TWIN, against, &thickness);
        mean[0] += against[0] / TWIN;
        mean[1] += against[1] / TWIN;
        mean_film += thickness / TWIN;
    }
    /* the torque of gear 1 is given; that of gear 2 follows from the losses */
    double W = p.line_force - mean[0] / g.base[0];
    twin w = {.p = &p,
              .g = &g,
              .damper = 2 * 0.01 * sqrt(p.stiffness_mean * p.mass),
              .mean_film = mean_film,
              .torque = {p.line_force * g.base[0], W * g.base[1] - mean[1]}};
    stage *one = open_motion("dynamics/shooting", &p, &g, branch);
    stage *both = open_motion("dynamics/shooting", &p, &g, branch);
    stage_set(one, "equivalent_mass", p.mass);
    stage_set(both, "equivalent_mass", p.mass);
    if (shared) {
        load(&p, &f);
        give_levels(one, &p);
        give_levels(both, &p);
    }
    give_film(both, &f);
    check_true("runs", run(one) && run(both));
    const double *s = stage_get(both, "dte", NULL), *v = stage_get(both, "dte_velocity", NULL);
    const double *before = stage_get(one, "dte", NULL), *phase = stage_get(both, "phase", NULL);
    double y[4] = {s[0] / g.base[0], 0, v[0] / g.base[0], 0}, off = 0, effect = 0, dte_at = 0;
    size_t count, other;
    stage_get(both, "phase", &count);
    const double *old = stage_get(one, "phase", &other);
    for (int i = 0, at = 1; i < TWIN; i++) {
        if (leaves((i - 0.5) / TWIN, (i + 0.5) / TWIN))
            pass_leaving(&w, y);
        step_twin(&w, i / frequency / TWIN, 1 / frequency / TWIN, y);
        double done = (double)(i + 1) / TWIN;
        while (at < (int)count && phase[at] < done - 1e-9)
            at++;
        if (at < (int)count && fabs(phase[at] - done) < 1e-9) {
            dte_at = g.base[0] * y[0] - g.base[1] * y[1];
            off = fmax(off, fabs(dte_at - s[at]));
            for (size_t k = 0; k < other; k++)
                if (fabs(old[k] - done) < 1e-9)
                    effect = fmax(effect, fabs(before[k] - s[at]));
        }
    }
    snprintf(name, sizeof name, "%g Hz %s, %g teeth%s: s, over what the film does to it", frequency,
             branch, teeth_2, shared ? ", shared" : "");
    check_below(name, off / effect, 1e-3);
    check_below("energy balance", stage_quality(both, "energy_balance"), 1e-12);
    double speed[2] = {2 * M_PI * frequency / 50, 2 * M_PI * frequency / teeth_2};
    check_near("power of the torques", stage_scalar(both, "torque_power"),
               mean[0] * speed[0] + mean[1] * speed[1], 1e-5);
    stage_close(one);
    stage_close(both);
}

/* Without a film, every bit of the motion must be that of a pair without radii of curvature and
   oil. */
static void check_one_way(const char *id)
{
    gears g = gears_of(50, 4e-3);
    pair p = pair_trapezoid(2375);
    stage *bare = pair_open(id, &p), *known = open_motion(id, &p, &g, "upper");
    stage_set_text(bare, "branch", "upper");
    stage_set_text(bare, "steps_per_cycle", "500");
    stage_give_scalar(known, "oil.eta0", 5.006e-3);
    check_true("runs",
               stage_run_wanted(bare, motion) == FF_OK && stage_run_wanted(known, motion) == FF_OK);
    size_t count, other;
    const double *dte = stage_get(bare, "dte", &count), *same = stage_get(known, "dte", &other);
    check_true(id, count == other && !memcmp(dte, same, count * sizeof *dte));
    stage_close(bare);
    stage_close(known);
}

/* With all feedback switched off, the motion must be that without a film; with each feedback alone,
   work and losses must be in balance. */
static void check_switches(void)
{
    static const char *const names[] = {"friction", "rolling", "compliance"};
    gears g = gears_of(50, 4e-3);
    pair p = pair_trapezoid(1250);
    film f = prescribed();
    stage *one = open_motion("dynamics/shooting", &p, &g, "lower");
    check_true("runs", run(one));
    for (int on = -1; on < 3; on++) {
        stage *s = open_motion("dynamics/shooting", &p, &g, "lower");
        give_film(s, &f);
        for (int i = 0; i < 3; i++)
            stage_set_text(s, names[i], i == on ? "true" : "false");
        check_true("runs", run(s));
        double rms = stage_scalar(s, "dte_rms"), off = stage_scalar(one, "dte_rms");
        if (on < 0)
            check_near("all off", rms, off, 1e-12);
        else
            check_true(names[on], fabs(rms / off - 1) > 1e-5);
        double in = stage_scalar(s, "excitation_power") + stage_scalar(s, "film_power");
        double out = stage_scalar(s, "damper_loss") + stage_scalar(s, "friction_work");
        check_near("work is loss", in, out, 1e-9);
        check_true("power of the torques",
                   on == 0 || on == 1 || stage_scalar(s, "torque_power") == 0);
        check_true("power of the film", on == 2 || stage_scalar(s, "film_power") == 0);
        stage_close(s);
    }
    stage_close(one);
}

/* A film for loops: h is proportional to W^-0.13, as in Dowson and Higginson's (2.3), friction is a
   twentieth of the load. Only one tooth pair at a time is in contact. */
typedef struct loop {
    double thickness, friction; /* at the static load */
} loop;

static double force_at(const stage *s, double phase)
{
    size_t n;
    const double *x = stage_get(s, "phase", &n), *W = stage_get(s, "mesh_force", NULL);
    size_t i = 0;
    while (i + 2 < n && x[i + 1] <= phase)
        i++;
    double t = x[i + 1] > x[i] ? (phase - x[i]) / (x[i + 1] - x[i]) : 0;
    return W[i] + t * (W[i + 1] - W[i]);
}

static double feed(stage *s, const pair *p, const loop *l, film *f)
{
    double moved = 0, most = 0;
    for (int i = 0; i < STEPS; i++) {
        double c = (double)i / (STEPS - 1), W = force_at(s, c) / p->line_force;
        double h = l->thickness * pow((0.1 + fmax(W, 0)) / 1.1, -0.13);
        double traction = l->friction * p->line_force * fmax(W, 0) / width * tanh(8 * (c - 0.45));
        moved = fmax(moved, fabs(h - f->thickness[i]) / l->thickness);
        most = fmax(most, fabs(traction - f->traction[i]) * width / p->line_force);
        f->roll[i] = sap + c * 2 * M_PI / 50;
        f->thickness[i] = h;
        f->traction[i] = traction;
        f->pressure[i] = 1e9 * sqrt(fmax(W, 0));
    }
    give_film(s, f);
    return fmax(moved, most);
}

/* Runs the loop. Returns the number of rounds, or 0 if it takes more than `rounds`. */
static int settle(stage *s, const pair *p, const loop *l, double tolerance, int rounds)
{
    static film f;
    int done = 0;
    memset(&f, 0, sizeof f);
    for (int i = 1; i <= rounds + 1; i++) {
        check_true("runs", stage_run_wanted(s, motion) == FF_OK);
        if (done || i > rounds)
            return done ? i - 1 : 0;
        done = feed(s, p, l, &f) < tolerance;
    }
    return 0;
}

/* Returns the amplitude ratio of a mass that e drives through film and spring in series, with
   damping: m s'' = -k soft (1 + 2 i zeta r) (s - e). soft: stiffness of spring and film in series
   over that of the spring. */
static double gain_of(double soft, double r)
{
    double damped = 2 * 0.01 * r * soft;
    return hypot(soft, damped) / hypot(soft - r * r, damped);
}

/* Returns the `soft` that gives an amplitude ratio, between 1 - room and 1, where the ratio is
   monotonic. */
static double softness_of(double gain, double r, double room)
{
    double low = 1 - room, high = 1;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *((gain_of(middle, r) > gain) == (r < 1) ? &low : &high) = middle;
    }
    return low;
}

/* A film whose thickness decreases by 0.13 h/W per unit of force is a spring of stiffness W/(0.13
   h) in series: the natural frequency decreases. Small vibration due to e(t) with one harmonic,
   below and above the natural frequency. Linear interpolation of e has the relative error (2
   pi/400)^2/12, 1e-3 of the effect of the film. */
static void check_compliance(void)
{
    gears g = gears_of(50, 4e-3);
    const double ratios[] = {0.8, 1.25};
    for (int i = 0; i < 2; i++) {
        double r = ratios[i], a = 2e-8;
        pair p = pair_cosine(r * pair_natural_frequency, 0, a, 400);
        loop l = {2e-6, 0};
        double soft = 1 / (1 + p.stiffness_mean * 0.13 / 1.1 * l.thickness / p.line_force);
        for (int k = 0; k < PAIR_STATIONS; k++)
            p.load_share[k] = 1, p.tooth_force[k] = p.line_force;
        stage *s = open_motion("dynamics/shooting", &p, &g, "lower");
        check_true("the loop settles", settle(s, &p, &l, 1e-9, 60) > 0);
        double found = softness_of(stage_get(s, "dte_harmonics", NULL)[0] / a, r, 3 * (1 - soft));
        check_near("shift of the natural frequency by the film", sqrt(found) - 1, sqrt(soft) - 1,
                   3e-3);
        stage_close(s);
    }
}

/* Compares two methods in loops with the film, with and without loss of contact. Without oil
   between separated flanks, they share no code for the solution. With oil, both use the steps of
   flow.h, which landing.c compares with references, but find the periodic motion differently: by
   Newton's method, and by integration until it settles. */
static void check_methods(int points, int oil)
{
    gears g = gears_of(50, 4e-3);
    int lost = 0, done = 0;
    for (int i = 0; done < points && i < 4 * points; i++) {
        double frequency = 900 + 2600. * i / points, rms[2], period[2], apart[2];
        const char *branch = i % 2 ? "upper" : "lower";
        pair p = pair_trapezoid(frequency);
        loop l = {4e-7, 0.01};
        int rounds[2];
        char name[100];
        for (int k = 0; k < 2; k++) {
            stage *s =
                open_motion(k ? "dynamics/time-integration" : "dynamics/shooting", &p, &g, branch);
            if (k)
                stage_set_text(s, "settle_tolerance", "1e-9");
            if (oil) {
                stage_set_text(s, "squeeze", "series");
                stage_give_scalar(s, "oil.eta0", 5.006e-3);
            }
            rounds[k] = settle(s, &p, &l, 1e-7, 30);
            rms[k] = stage_scalar(s, "dte_rms");
            period[k] = stage_scalar(s, "period");
            apart[k] = stage_scalar(s, "contact_loss");
            stage_close(s);
        }
        if (period[0] != 1 || period[1] != 1) /* the film in this test has a period of one mesh
                                                 cycle */
            continue;
        snprintf(name, sizeof name, "%g Hz %s%s, %d and %d rounds, %.2g apart: rms by both methods",
                 frequency, branch, oil ? " in oil" : "", rounds[0], rounds[1], apart[0]);
        check_true("the loop settles", rounds[0] > 0 && rounds[1] > 0);
        check_near(name, rms[1], rms[0], 1e-6);
        lost += apart[0] > 0;
        done++;
    }
    check_true("so many points were compared", done == points);
    check_true("some lose contact and some do not", 3 * lost >= points && lost < points);
}

/* With oil, an engagement that ends with separated flanks, and one whose load increases: each must
   have the same effect in any order as alone. */
static void check_order(void)
{
    gears g = gears_of(50, 4e-3);
    pair p = pair_trapezoid(1250);
    double rms[2];
    for (int k = 0; k < 2; k++) {
        film f = prescribed();
        for (int i = 0; i < STEPS; i++) {
            int each = STEPS / 2, second = i >= each, flies = second == k;
            double share = fmin((double)(i - second * each) / (each - 1), 1);
            f.engagement[i] = second;
            f.roll[i] = sap + path * share * 2 * M_PI / 50;
            f.pressure[i] = 1e9 * (flies ? share < 0.8 : share);
            f.thickness[i] = flies && share > 0.8 ? 0 : 4e-7 * (1 + share);
        }
        stage *s = open_motion("dynamics/shooting", &p, &g, "lower");
        stage_set_text(s, "squeeze", "series");
        stage_give_scalar(s, "oil.eta0", 5.006e-3);
        give_film(s, &f);
        check_true("runs", stage_run_wanted(s, motion) == FF_OK);
        rms[k] = stage_scalar(s, "dte_rms");
        stage_close(s);
    }
    check_near("rms with the engagements in the other order", rms[1], rms[0], 1e-9);
}

static void check_bad(void)
{
    gears g = gears_of(50, 4e-3);
    pair p = pair_trapezoid(1250);
    film f = prescribed();
    stage *s = open_motion("dynamics/shooting", &p, &g, "lower");
    f.traction[7] = NAN;
    give_film(s, &f);
    check_true("a number that is none is refused", stage_run_wanted(s, outputs) == FF_INVALID);
    check_true("by its name", !strcmp(stage_why_item(s), "film.traction"));
    stage_close(s);
    s = pair_open("dynamics/shooting", &p);
    f = prescribed();
    give_film(s, &f);
    check_true("a gear without radii is refused", stage_run_wanted(s, outputs) == FF_INVALID);
    stage_close(s);
}

/* Argument: number of points at which both methods are compared. */
int main(int argc, char **argv)
{
    check_twin(1250, "lower", 50, 4e-3, 0);
    check_twin(1250, "lower", 75, 2e-2, 0);
    check_twin(2375, "upper", 50, 4e-3, 0);
    check_twin(1250, "lower", 75, 2e-2, 1);
    check_one_way("dynamics/shooting");
    check_one_way("dynamics/time-integration");
    check_switches();
    check_compliance();
    check_methods(argc > 1 ? atoi(argv[1]) : 2, 0);
    check_methods(argc > 1 ? atoi(argv[1]) : 2, 1);
    check_order();
    check_bad();
    return check_done();
}
