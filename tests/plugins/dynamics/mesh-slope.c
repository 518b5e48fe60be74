/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The nonlinear mesh spring: contact must end and begin at the transmission error e without load,
   and a slow motion must be the loaded transmission error, whether the stiffness is a secant or a
   slope. */
#include "check.h"
#include "pair.h"

#include "../../../plugins/dynamics/excitation/spring.h"
#include "../../../plugins/dynamics/orbits/orbit.h"
#include "../../../plugins/dynamics/orbits/trajectory.h"
#include "../../../plugins/dynamics/oscillator/oscillator.h"
#include "../../../plugins/dynamics/oscillator/sharing.h"

#include <math.h>
#include <stdio.h>

enum { LINES = 200 };

/* A mesh with constant slope k and constant loaded error e_l: with F = 1, the force line has the
   offset k e_l - 1. */
typedef struct constant_mesh {
    dynamics_excitation mesh;
    dynamics_flow flow;
    double k, chord, offset, load;
} constant_mesh;

static void open_mesh(constant_mesh *c, double k, double loaded, double half_gap)
{
    static const double phase[] = {0, 0.37, 1}, zero[] = {0, 0, 0};
    const double slope[] = {k, k, k}, error[] = {loaded, loaded, loaded};
    dynamics_mesh_curves x = {3, phase, slope, zero};
    dynamics_spring_nodes nodes;
    *c = (constant_mesh){.mesh = {.load = 1, .half_gap = half_gap, .damping = 0}, .k = k};
    c->mesh.length = c->mesh.stiffness = c->mesh.omega = 1;
    c->load = 1;
    c->offset = k * loaded - 1;
    c->chord = k * 0.5 / (0.5 + c->offset);
    check_true("nodes", dynamics_spring_nodes_make(&x, error, 1, 0, &nodes));
    check_true("builds", dynamics_excitation_build_bent(&c->mesh, &x, &nodes) &&
                             dynamics_flow_init(&c->flow, &c->mesh));
    dynamics_spring_nodes_free(&nodes);
}

static void close_mesh(constant_mesh *c)
{
    dynamics_flow_free(&c->flow);
    dynamics_excitation_free(&c->mesh);
}

/* Returns the time from contact at speed v to the knee of the spring; *at_knee: speed there. z'' =
   F - chord z. */
static double time_to_knee(const constant_mesh *c, double v, double *at_knee)
{
    double w = sqrt(c->chord), rest = c->load / c->chord;
    double knee = c->offset / (c->k - c->chord), size = hypot(rest, v / w),
           turn = atan2(v / w, -rest);
    /* z = rest + size cos(turn - w t) */
    double t = (turn - acos((knee - rest) / size)) / w;
    *at_knee = size * w * sin(turn - w * t);
    return t;
}

/* Returns the time from contact at speed v to separation, through both parts of the spring. */
static double time_in_contact(const constant_mesh *c, double v)
{
    double u, down = time_to_knee(c, v, &u), w = sqrt(c->k);
    double rest = (c->load + c->offset) / c->k, knee = c->offset / (c->k - c->chord);
    return 2 * down + 2 * atan2(u / w, -(rest - knee)) / w;
}

/* Without damping, flanks that separate at speed v touch again at this speed after 2 v/F, and
   separate again after time_in_contact. */
static void test_flight(void)
{
    const double speeds[] = {1.2, 2.5, 0.9};
    for (int i = 0; i < 3; i++) {
        constant_mesh c;
        double v = speeds[i];
        open_mesh(&c, 1.3, 1.2, 3);
        double T = 2 * v / c.load + time_in_contact(&c, v);
        dynamics_state y = dynamics_state_at(3, -v);
        check_true("passes", dynamics_flow_motion(&c.flow, T, &y, NULL));
        check_near("parts again at the unloaded e", y.delta, 3, 1e-11);
        check_near("with the speed of the start", y.rate, -v, 1e-11);
        dynamics_oscillator *o = dynamics_oscillator_new(&c.mesh, 1e-12, 1, DYNAMICS_MOTION);
        dynamics_oscillator_start(o, T, 3, -v);
        check_true("passes", dynamics_oscillator_cycle(o, T, NULL));
        check_near("in steps, too", dynamics_oscillator_state(o)[DYNAMICS_DELTA], 3, 1e-9);
        check_near("in steps, too", dynamics_oscillator_state(o)[DYNAMICS_RATE], -v, 1e-9);
        dynamics_oscillator_free(o);
        close_mesh(&c);
    }
}

/* At rest under F, the deflection must be e_l. The force must not decrease with increasing
   deflection. */
static void test_law(void)
{
    constant_mesh c;
    open_mesh(&c, 1.4, 1.1, 3);
    const dynamics_piece *p = c.mesh.pieces;
    check_near("at rest", dynamics_rest_bend(&c.mesh), 1.1, 1e-15);
    check_near("F there", dynamics_spring_force(p, 0, 1.1), 1, 1e-15);
    check_near("half of it at the knee", dynamics_spring_force(p, 0, c.offset / (c.k - c.chord)),
               0.5, 1e-14);
    check_near("none at e", dynamics_spring_force(p, 0, 0), 0, 1e-15);
    check_near("as much on the other flank", dynamics_spring_force(p, 0, -1.1), -1, 1e-15);
    double before = 0;
    for (int i = 1; i <= 200; i++) {
        double force = dynamics_spring_force(p, 0, 0.01 * i);
        check_true("rises", force > before);
        before = force;
    }
    close_mesh(&c);
}

/* Compares the monodromy matrix, over both parts of the spring and a separation, with
   differences. */
static void test_variation(void)
{
    constant_mesh c;
    const double T = 9.3, h = 1e-6, at[2] = {3.4, 2.2};
    open_mesh(&c, 1.3, 1.2, 3);
    c.mesh.zeta = 0.03;
    dynamics_state y = dynamics_state_at(at[0], at[1]);
    check_true("passes", dynamics_flow_variation(&c.flow, T, &y, NULL));
    for (int j = 0; j < 2; j++) {
        dynamics_state up = dynamics_state_at(at[0] + (j ? 0 : h), at[1] + (j ? h : 0));
        dynamics_state down = dynamics_state_at(at[0] - (j ? 0 : h), at[1] - (j ? h : 0));
        check_true("passes", dynamics_flow_motion(&c.flow, T, &up, NULL) &&
                                 dynamics_flow_motion(&c.flow, T, &down, NULL));
        check_near("delta", y.m[j], (up.delta - down.delta) / (2 * h), 1e-6);
        check_near("rate", y.m[2 + j], (up.rate - down.rate) / (2 * h), 1e-6);
    }
    dynamics_state longer = dynamics_state_at(at[0], at[1]), shorter = longer;
    check_true("passes", dynamics_flow_motion(&c.flow, T + h, &longer, NULL) &&
                             dynamics_flow_motion(&c.flow, T - h, &shorter, NULL));
    check_near("by T", y.change[0], (longer.delta - shorter.delta) / (2 * h), 1e-6);
    close_mesh(&c);
}

/* Returns the energy of the spring at a deflection, by the midpoint rule. */
static double energy_of_force(const dynamics_piece *p, double since, double bend)
{
    enum { PARTS = 20000 };
    double sum = 0, part = bend / PARTS;
    for (int i = 0; i < PARTS; i++)
        sum += part * dynamics_spring_force(p, since, (i + 0.5) * part);
    return sum;
}

/* Returns the energy that flanks without pulling force lose, from a fine record: the integral of c
   rate^2 during contact, and the spring energy at each end of contact minus that at each begin.
   *high: number of ends of contact beyond the knee. */
static double account(const dynamics_motion *motion, int *high)
{
    const dynamics_excitation *mesh = motion->excitation;
    const dynamics_record *record = &motion->record;
    double loss = 0;
    for (size_t i = 1; i < record->count; i++) {
        const dynamics_sample *x = &record->samples[i - 1], *y = x + 1;
        double middle = 0.5 * (x->phase + y->phase), phase = middle - floor(middle);
        if (middle > (double)motion->cycles)
            break;
        const dynamics_piece *p = dynamics_excitation_piece(mesh, phase, 0);
        double since = phase - p->start, e = dynamics_piece_value(p->e, p->degree, since);
        double e_rate = dynamics_piece_slope(p->e, p->degree, since) / motion->T;
        double bend = 0.5 * (x->s + y->s) - e - mesh->half_gap;
        double rate = 0.5 * (x->s_rate + y->s_rate) - e_rate;
        int pressed = x->force > 0, stays = y->force > 0;
        if (pressed != stays && bend > 0) {
            loss += (pressed ? 1 : -1) * energy_of_force(p, since, bend);
            *high += pressed && dynamics_spring_band(p, since, bend);
        }
        loss += 0.5 * (pressed + stays) * (y->phase - x->phase) * motion->T * 2 * mesh->zeta *
                rate * rate;
    }
    return loss;
}

/* With strong damping and fast changes of e, contact ends while the spring is beyond its knee. */
static void test_energy(void)
{
    static const double phase[] = {0, 0.2, 0.45, 0.7, 1}, slope[] = {1, 1.2, 0.8, 1.1, 1};
    static const double e[] = {0, 1.3, -0.9, 0.4, 0}, bent[] = {1.3, 1.1, 1.6, 1.2, 1.3};
    double loaded[5];
    for (int i = 0; i < 5; i++)
        loaded[i] = e[i] + bent[i] / slope[i];
    dynamics_mesh_curves x = {5, phase, slope, e};
    dynamics_spring_nodes nodes;
    dynamics_excitation mesh = {.load = 1, .half_gap = 5, .zeta = 0.4};
    dynamics_flow flow;
    mesh.length = mesh.stiffness = mesh.omega = 1;
    mesh.damping = DYNAMICS_DAMPING_CLIPPED;
    check_true("builds", dynamics_spring_nodes_make(&x, loaded, 1, 0, &nodes) &&
                             dynamics_excitation_build_bent(&mesh, &x, &nodes) &&
                             dynamics_flow_init(&flow, &mesh));
    const double roll[] = {0}, start[2] = {6.2, 3};
    dynamics_inputs inputs = {.roll_angle = roll, .stations = 1, .pitch = 1};
    dynamics_motion motion = {.excitation = &mesh, .cycles = 4, .T = 5};
    int high = 0;
    check_true("passes",
               dynamics_trajectory_record(&flow, &inputs, 40000, start, &motion) == FF_OK);
    double expected = account(&motion, &high);
    check_true("lets go beyond the knee", high >= 4);
    check_near("what is lost", motion.loss, expected, 3e-4);
    check_true("the balance", motion.energy_error < 1e-11);
    double loss = motion.loss;
    dynamics_record_free(&motion.record);
    dynamics_oscillator *o =
        dynamics_oscillator_new(&mesh, 1e-12, 1, DYNAMICS_MOTION_AND_VARIATION);
    dynamics_oscillator_start(o, motion.T, start[0], start[1]);
    for (size_t i = 0; i < motion.cycles; i++)
        check_true("passes", dynamics_oscillator_cycle(o, motion.T, NULL));
    check_near("in steps, too", dynamics_oscillator_state(o)[DYNAMICS_LOSS], loss, 1e-8);
    dynamics_oscillator_free(o);
    dynamics_flow_free(&flow);
    dynamics_spring_nodes_free(&nodes);
    dynamics_excitation_free(&mesh);
}

/* Slope and loaded error with one harmonic each: at 1 % of the natural frequency, the motion must
   be the loaded error at every point. */
static void test_slow_motion(void)
{
    static const char *const models[] = {"dynamics/shooting", "dynamics/time-integration",
                                         "dynamics/harmonic-balance"};
    static double loaded[PAIR_MAX_PHASES];
    for (int tangent = 0; tangent < 2; tangent++) {
        pair p = pair_cosine(0.01 * pair_natural_frequency, 0.1, 2e-6, LINES);
        double mean = p.line_force / p.stiffness_mean, range = 0, low = INFINITY, high = 0;
        for (size_t i = 0; i < p.phases; i++) {
            double c = cos(2 * M_PI * p.phase[i]), chord = 0.85 + 0.08 * c;
            loaded[i] = p.error[i] + (tangent ? mean / chord : p.line_force / p.stiffness[i]);
            low = fmin(low, loaded[i]), high = fmax(high, loaded[i]);
        }
        range = high - low;
        for (size_t m = 0; m < sizeof models / sizeof *models; m++) {
            stage *s = pair_open(models[m], &p);
            size_t count;
            double worst = 0;
            stage_give_series(s, "stiffness.loaded_transmission_error", p.phases, loaded);
            check_true(models[m], stage_run(s) == FF_OK);
            const double *phase = stage_get(s, "phase", &count), *dte = stage_get(s, "dte", NULL);
            for (size_t i = 0; i < count; i++) {
                double at = phase[i] * LINES, x = at - floor(at);
                size_t node = (size_t)floor(at) % LINES;
                double expected = loaded[node] + x * (loaded[node + 1] - loaded[node]);
                worst = fmax(worst, fabs(dte[i] - p.backlash / 2 - expected));
            }
            check_true(tangent ? "slow motion, slope" : "slow motion, chord", worst < 1e-3 * range);
            stage_close(s);
        }
    }
}

/* A loaded error that agrees with the secant stiffness must not change any bit. A loaded error for
   which the stiffness would decrease with force, or which is below e, must be reported. */
static void test_sources(void)
{
    static double loaded[PAIR_MAX_PHASES];
    double rms[2];
    for (int given = 0; given < 2; given++) {
        pair p = pair_trapezoid(2375);
        for (size_t i = 0; i < p.phases; i++)
            loaded[i] = p.line_force / p.stiffness[i];
        stage *s = pair_open("dynamics/shooting", &p);
        if (given)
            stage_give_series(s, "stiffness.loaded_transmission_error", p.phases, loaded);
        check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
        rms[given] = stage_scalar(s, "dte_rms");
        stage_close(s);
    }
    check_true("the chord to the last bit", rms[0] == rms[1]);
    for (int below = 0; below < 2; below++) {
        pair p = pair_trapezoid(2375);
        for (size_t i = 0; i < p.phases; i++)
            loaded[i] = (below ? -1 : 0.8) * p.line_force / p.stiffness[i];
        stage *s = pair_open("dynamics/shooting", &p);
        stage_give_series(s, "stiffness.loaded_transmission_error", p.phases, loaded);
        check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
        check_true("is told", stage_verdict(s) == FF_DOUBTFUL);
        stage_close(s);
    }
}

/* Compares the reported ends of separations with the points where dte returns to the edge of the
   gap, and with the velocity there. Two models must agree; a motion in permanent contact must have
   none. */
static void test_landings(void)
{
    static const char *const models[] = {"dynamics/shooting", "dynamics/time-integration"};
    pair p = pair_trapezoid(2375);
    double first[2] = {0};
    for (int m = 0; m < 2; m++) {
        size_t count, landings, last = 0;
        stage *s = pair_open(models[m], &p);
        stage_set_text(s, "branch", "upper");
        check_true(models[m], stage_run(s) == FF_OK);
        const double *phase = stage_get(s, "phase", &count), *dte = stage_get(s, "dte", NULL);
        const double *rate = stage_get(s, "dte_velocity", NULL);
        const double *time = stage_get(s, "landing_time", &landings);
        const double *speed = stage_get(s, "landing_speed", NULL);
        for (size_t i = 1; i < count; i++)
            last = dte[i - 1] < p.backlash / 2 && dte[i] >= p.backlash / 2 ? i : last;
        check_true("one landing", landings == 1 && last > 0);
        double step = (phase[last] - phase[last - 1]) / p.mesh_frequency;
        double back = (dte[last] - p.backlash / 2) / rate[last]; /* the motion is nearly straight
                                                                    from there */
        check_near("time", time[0], phase[last] / p.mesh_frequency - back, 1e-4);
        double x = 1 - back / step;
        check_near("speed", speed[0], rate[last - 1] * (1 - x) + rate[last] * x, 1e-3);
        if (m)
            check_near("as the other model has it", speed[0], first[1], 1e-6);
        first[0] = time[0], first[1] = speed[0];
        stage_close(s);
        s = pair_open(models[m], &p);
        check_true("runs", stage_run(s) == FF_OK);
        check_true("none in full contact", stage_count(s, "landing_time") == 0);
        stage_close(s);
    }
}

/* If e decreases in a jump during a separation, the flanks touch at once, with their speed at that
   time. */
static void test_landing_at_jump(void)
{
    pair p = pair_trapezoid(2375);
    size_t count, landings, jump = 0;
    p.phases = 4;
    for (size_t i = 0; i < p.phases; i++) {
        p.phase[i] = (double)(i == 1 || i == 2) * 0.5 + (double)(i == 3);
        p.stiffness[i] = p.stiffness_mean;
        p.error[i] = i < 2 ? 0.3 * p.backlash : 0;
    }
    stage *s = pair_open("dynamics/shooting", &p);
    stage_set_text(s, "branch", "upper");
    check_true("runs", stage_run(s) == FF_OK);
    const double *phase = stage_get(s, "phase", &count), *dte = stage_get(s, "dte", NULL);
    const double *rate = stage_get(s, "dte_velocity", NULL);
    const double *time = stage_get(s, "landing_time", &landings);
    while (jump < count && phase[jump] < 0.5)
        jump++;
    check_true("one landing", landings == 1 && jump < count);
    check_true("apart before the jump, in contact behind it",
               dte[jump] < 0.8 * p.backlash && dte[jump] > 0.5 * p.backlash);
    check_near("time", time[0] * p.mesh_frequency, 0.5, 1e-12);
    check_near("speed", stage_get(s, "landing_speed", NULL)[0], rate[jump], 1e-5);
    stage_close(s);
}

enum { LEVELS = 5 };

/* Gives data of the mesh at five forces: a slope that doubles above `knee` times the mean force,
   and a tooth force that is linear in the mesh force, so that the load fraction of a pair has the
   error d (1/F_1 - 1/F) between two forces. */
static const double knee = 1.05;

static void give_levels(stage *s, const pair *p, double d, size_t rows)
{
    static double slope[LEVELS * PAIR_MAX_PHASES], teeth[LEVELS * PAIR_STATIONS];
    static double error[LEVELS * PAIR_MAX_PHASES];
    double force[LEVELS];
    for (size_t k = 0; k < LEVELS; k++) {
        force[k] = 0.5 * (double)k * p->line_force;
        for (size_t i = 0; i < p->phases; i++) {
            double above = fmax(force[k] - knee * p->line_force, 0);
            slope[k * p->phases + i] = p->stiffness[i] * (above > 0 ? 2 : 1);
            error[k * p->phases + i] = p->error[i] + (force[k] - above / 2) / p->stiffness[i];
        }
        for (size_t i = 0; i < PAIR_STATIONS; i++)
            teeth[k * PAIR_STATIONS + i] = k ? 0.4 * force[k] + d * (i == 7) * p->line_force : 0;
    }
    const size_t phases[] = {rows, p->phases}, stations[] = {rows, PAIR_STATIONS};
    stage_give_series(s, "stiffness.force_level", LEVELS, force);
    stage_give(s, "stiffness.level_error", 2, phases, error);
    stage_give(s, "stiffness.level_stiffness", 2, phases, slope);
    stage_give(s, "stiffness.level_tooth_force", 2, stations, teeth);
}

/* Compares the quality lines sharing_change and slope_change with values from the motion's
   forces. */
static void test_sharing(void)
{
    static const char *const models[] = {"dynamics/shooting", "dynamics/time-integration",
                                         "dynamics/harmonic-balance"};
    static const double changes[] = {0.001, 0.9};
    for (int i = 0; i < 6; i++) {
        pair p = pair_cosine(2375, 0.05, 1e-6, 50);
        stage *s = pair_open(models[i % 3], &p);
        double low = INFINITY, high = 0, d = changes[i / 3];
        size_t count;
        give_levels(s, &p, d, LEVELS);
        check_true(models[i % 3], stage_run(s) == FF_OK);
        const double *force = stage_get(s, "mesh_force", &count);
        for (size_t k = 0; k < count; k++) {
            low = fmin(low, force[k] / p.line_force);
            high = fmax(high, force[k] / p.line_force);
        }
        check_true("the flanks do not part", low > 0.5 && high < 2);
        check_near("change of the share", stage_quality(s, "sharing_change"),
                   d * fmax(1 / low - 1, 1 - 1 / high), 1e-9);
        double above = fmax(high - knee, 0) / 2, steeper = above / (high - low - above);
        check_near("change of the slope", stage_quality(s, "slope_change"), steeper, 1e-9);
        check_true("is told", steeper > 0.02 && stage_verdict(s) == FF_DOUBTFUL);
        check_true("the larger is told", (stage_quality(s, "sharing_change") > 0.02) == (i >= 3));
        stage_close(s);
    }
    pair p = pair_trapezoid(2375);
    stage *s = pair_open("dynamics/shooting", &p);
    check_true("runs", stage_run(s) == FF_OK);
    check_true("no line without levels",
               !stage_has_quality(s, "sharing_change") && !stage_has_quality(s, "slope_change"));
    give_levels(s, &p, 0.1, LEVELS - 1);
    check_true("a row is missing", stage_run(s) == FF_INVALID);
    stage_close(s);
}

/* A run with a constant stiffness must have no quality line if the levels cannot make a spring: too
   many levels, or errors that do not increase. */
static void test_useless_levels(void)
{
    enum { MANY = 40 };
    static double error[MANY * PAIR_MAX_PHASES], force[MANY];
    for (int falls = 0; falls < 2; falls++) {
        pair p = pair_cosine(2375, 0.05, 1e-6, 50);
        stage *s = pair_open("dynamics/shooting", &p);
        const size_t rows = falls ? LEVELS : MANY, shape[] = {rows, p.phases};
        for (size_t k = 0; k < rows; k++) {
            force[k] = 0.1 * (double)k * p.line_force;
            for (size_t i = 0; i < p.phases; i++)
                error[k * p.phases + i] = p.error[i] + (falls ? -1 : 1) * force[k] / p.stiffness[i];
        }
        stage_give_series(s, "stiffness.force_level", rows, force);
        stage_give(s, "stiffness.level_error", 2, shape, error);
        check_true("runs", stage_run(s) == FF_OK);
        check_true("no line", !stage_has_quality(s, "slope_change"));
        stage_close(s);
    }
}

/* A motion near the mean force, which is a level, must have a stated error, too: that of the
   tangent at the mean force to the mesh G = g^1.5 with ten levels. */
static void test_near_a_level(void)
{
    enum { COUNT = 10 };
    double force[COUNT], error[2 * COUNT], stiffness[2 * COUNT];
    for (int k = 0; k < COUNT; k++) {
        force[k] = k * k / 9.0;
        error[2 * k] = error[2 * k + 1] = pow(force[k], 2 / 3.0);
        stiffness[2 * k] = stiffness[2 * k + 1] = fmax(1.5 * cbrt(force[k]), 1e-3);
    }
    dynamics_inputs inputs = {
        .reference = 1,
        .levels = {
            .count = COUNT, .phases = 2, .force = force, .error = error, .stiffness = stiffness}};
    for (double high = 1.05; high < 1.3; high += 0.1) {
        double off = high - (1 + 1.5 * (pow(high, 2 / 3.0) - 1));
        double stated = dynamics_level_error(&inputs, 2 - high, high);
        check_below("is known to have one", off, stated);
        check_below("that of the lines beside it", stated, 0.08);
    }
}

int main(void)
{
    test_near_a_level();
    test_law();
    test_flight();
    test_variation();
    test_energy();
    test_slow_motion();
    test_sources();
    test_landings();
    test_landing_at_jump();
    test_sharing();
    test_useless_levels();
    return check_done();
}
