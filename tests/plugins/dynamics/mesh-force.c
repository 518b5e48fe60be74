/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `force: shared`, a mesh force that depends nonlinearly on the deflection: compares motions with a
   separate integration of tooth pairs with relief, each a tooth and a Hertzian contact in series,
   whose equilibrium is solved at every small time step. The models get this equilibrium at some
   forces only. Also checks properties of any mesh force: mean, load fractions, energy, a small
   vibration, a slow motion. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PHASES = 150, MOST_LEVELS = 28, PAIRS = 6, TOP = 9 /* largest level over the mean force */ };

/* Tooth pairs at q mesh cycles after the begin of their contact: compliance, relief at both ends,
   Hertzian approach W slope ln(scale/W). */
typedef struct teeth {
    double begin, end, relief; /* no relief between begin and end, mesh cycles; beyond, it increases
                                  by `relief`, m per cycle */
} teeth;

static const double hertz_slope = 1.5e-10, hertz_scale = 1e7;

static double gap_of(const teeth *t, double age)
{
    double way = fmax(fmax(t->begin - age, age - t->end), 0);
    return t->relief * way * (1 + 0.3 * way);
}

static double compliance_of(double age)
{
    return (1 + 0.15 * cos(2.4 * (age - 0.7))) / 2.6e8;
}

/* Returns the force of a pair with overlap u > 0, by Newton's method, and its slope. */
static double pair_force(double age, double u, double *slope)
{
    double a = compliance_of(age), W = u / (a + 10 * hertz_slope);
    for (int i = 0; i < 30; i++) {
        double by_force = a + hertz_slope * (log(hertz_scale / W) - 1);
        double step = (u - W * (a + hertz_slope * log(hertz_scale / W))) / by_force;
        W = fmax(W + step, 0.1 * W);
        if (fabs(step) < 1e-9 * W) /* the error is then of the order of its square */
            break;
    }
    *slope = 1 / (a + hertz_slope * (log(hertz_scale / W) - 1));
    return W;
}

static double unloaded(const teeth *t, double phase)
{
    double e = INFINITY;
    for (int j = -2; j < PAIRS - 2; j++)
        e = fmin(e, gap_of(t, phase + j));
    return e;
}

/* Returns the mesh force G(phase, s). */
static double mesh_force(const teeth *t, double phase, double s, double *slope)
{
    double force = 0, k;
    *slope = 0;
    for (int j = -2; j < PAIRS - 2; j++) {
        double u = s - gap_of(t, phase + j);
        if (!(u > 1e-15))
            continue;
        force += pair_force(phase + j, u, &k);
        *slope += k;
    }
    return force;
}

static double loaded(const teeth *t, double phase, double force, double *slope)
{
    double s = unloaded(t, phase) + 1.5e-5 * force / 3548;
    for (int i = 0; i < 50; i++) {
        double step = (force - mesh_force(t, phase, s, slope)) / *slope;
        s += step;
        if (fabs(step) < 1e-9 * s)
            break;
    }
    mesh_force(t, phase, s, slope);
    return s;
}

/* The force levels of a mesh, and the gear pair with this mesh. */
typedef struct mesh {
    teeth teeth;
    size_t levels;
    pair p;
    double force[MOST_LEVELS], loaded[PHASES + 1];
    double error[MOST_LEVELS * (PHASES + 1)], stiffness[MOST_LEVELS * (PHASES + 1)];
    double tooth_force[MOST_LEVELS * PAIR_STATIONS];
} mesh;

static double station_age(const mesh *m, size_t i)
{
    return (m->p.roll[i] - m->p.roll[0]) / (2 * M_PI / 50);
}

/* Returns the force of the tooth pair at a station under the mesh force F. */
static double tooth_force_at(const mesh *m, size_t station, double F)
{
    double k, age = station_age(m, station), phase = age - floor(age + 1e-12);
    double u = F > 0 ? loaded(&m->teeth, phase, F, &k) - gap_of(&m->teeth, age) : 0;
    return u > 0 ? pair_force(age, u, &k) : 0;
}

static void make_mesh(mesh *m, const teeth *t, double frequency, size_t levels)
{
    double softest;
    m->teeth = *t;
    m->levels = levels;
    m->p = pair_cosine(frequency, 0, 0, PHASES);
    for (size_t k = 0; k < levels; k++) {
        double part = (double)k / (double)(levels - 1);
        m->force[k] = TOP * part * part * m->p.line_force;
        for (size_t i = 0; i <= PHASES; i++) {
            size_t at = k * (PHASES + 1) + i;
            m->error[at] = k ? loaded(t, m->p.phase[i], m->force[k], &m->stiffness[at])
                             : unloaded(t, m->p.phase[i]);
            if (!k) /* nearly 0 */
                loaded(t, m->p.phase[i], 1e-9 * m->p.line_force, &m->stiffness[at]);
        }
        for (size_t i = 0; i < PAIR_STATIONS; i++)
            m->tooth_force[k * PAIR_STATIONS + i] = tooth_force_at(m, i, m->force[k]);
    }
    for (size_t i = 0; i <= PHASES; i++) {
        m->p.error[i] = m->error[i];
        m->loaded[i] = loaded(t, m->p.phase[i], m->p.line_force, &m->p.stiffness[i]);
    }
    for (size_t i = 0; i < PAIR_STATIONS; i++)
        m->p.tooth_force[i] = tooth_force_at(m, i, m->p.line_force);
    softest = pair_mean(&m->p);
    m->p.mass *= softest / m->p.stiffness_mean;
    m->p.stiffness_mean = softest;
}

static stage *open_shared(const char *model, const mesh *m)
{
    const size_t phases[] = {m->levels, PHASES + 1}, stations[] = {m->levels, PAIR_STATIONS};
    stage *s = pair_open(model, &m->p);
    stage_set_text(s, "force", "shared");
    stage_give_series(s, "stiffness.loaded_transmission_error", PHASES + 1, m->loaded);
    stage_give_series(s, "stiffness.force_level", m->levels, m->force);
    stage_give(s, "stiffness.level_error", 2, phases, m->error);
    stage_give(s, "stiffness.level_stiffness", 2, phases, m->stiffness);
    stage_give(s, "stiffness.level_tooth_force", 2, stations, m->tooth_force);
    return s;
}

/* Runs without maps and counts of motions. */
static int run_motion(stage *s)
{
    return stage_run_wanted(s,
                            "phase dte dte_velocity dte_rms dte_mean dte_peak_to_peak mesh_force "
                            "tooth_force contact_loss back_contact period") == FF_OK;
}

/* The separate integration: Runge and Kutta's method of order 4 with STEPS steps per cycle. */
enum { STEPS = 4096 };

static double twin_force(const mesh *m, double zeta, double phase, double s, double rate)
{
    double b = m->p.backlash / 2, k, h = 1e-5, x = phase - floor(phase);
    double c = 2 * zeta * sqrt(m->p.stiffness_mean * m->p.mass);
    double e_rate = (unloaded(&m->teeth, x + h) - unloaded(&m->teeth, x - h)) / (2 * h);
    double force = c * (rate - e_rate * m->p.mesh_frequency);
    double back = 2 * unloaded(&m->teeth, x) - s - b; /* the back flank is the mirrored one */
    force += mesh_force(&m->teeth, x, s - b, &k);
    return force - mesh_force(&m->teeth, x, back, &k);
}

/* Whether e has a kink within a step, where the force of the damper jumps. */
static int bends_at(const mesh *m, double phase)
{
    double h = 1.5 / STEPS, x = phase - floor(phase), e = unloaded(&m->teeth, x);
    double before = e - unloaded(&m->teeth, x - h), behind = unloaded(&m->teeth, x + h) - e;
    return fabs(behind - before) > 0.05 * (fabs(behind) + fabs(before));
}

/* Integrates over a cycle from a state. Finds the largest differences from the motion of a model,
   over its amplitude, and from its mesh force, over the mean. */
static void follow_twin(const mesh *m, double zeta, const stage *shown, double off[2])
{
    size_t count, next = 0;
    const double *phase = stage_get(shown, "phase", &count), *dte = stage_get(shown, "dte", NULL);
    const double *rate = stage_get(shown, "dte_velocity", NULL);
    const double *force = stage_get(shown, "mesh_force", NULL);
    double x[2] = {dte[0], rate[0]}, T = 1 / m->p.mesh_frequency, h = T / STEPS;
    double size = stage_scalar(shown, "dte_peak_to_peak");
    off[0] = off[1] = 0;
    for (size_t i = 0; i <= STEPS; i++) {
        double at = (double)i / STEPS, k[4][2], y[2];
        for (; next < count && phase[next] < at + 0.5 / STEPS; next++) {
            if (fabs(phase[next] - at) > 1e-6)
                continue;
            off[0] = fmax(off[0], fabs(dte[next] - x[0]) / size);
            if (bends_at(m, at))
                continue;
            off[1] = fmax(off[1], fabs(force[next] - twin_force(m, zeta, at, x[0], x[1])) /
                                      m->p.line_force);
        }
        for (int j = 0; j < 4; j++) {
            double part = j == 0 ? 0 : j == 3 ? h : h / 2;
            for (int n = 0; n < 2; n++)
                y[n] = x[n] + (j ? part * k[j - 1][n] : 0);
            k[j][0] = y[1];
            k[j][1] =
                (m->p.line_force - twin_force(m, zeta, at + part / T, y[0], y[1])) / m->p.mass;
        }
        for (int n = 0; n < 2; n++)
            x[n] += h / 6 * (k[0][n] + 2 * k[1][n] + 2 * k[2][n] + k[3][n]);
    }
}

static const teeth relieved = {0.44, 1.36, 60e-6}, wide = {0.12, 2.04, 30e-6}, none = {-9, 9, 0};

/* Motions with and without loss of contact, by three models, with two and with three tooth pairs in
   contact. */
static void test_twin(void)
{
    static const struct {
        const char *model, *branch;
        const teeth *teeth;
        double frequency, limit;
        int parts;
    } cases[] = {
        {"dynamics/shooting", "lower", &relieved, 2000, 1e-3, 0},
        {"dynamics/shooting", "upper", &relieved, 2900, 1e-3, 1},
        {"dynamics/time-integration", "upper", &relieved, 2900, 1e-3, 1},
        {"dynamics/harmonic-balance", "lower", &relieved, 2000, 1e-3, 0},
        {"dynamics/shooting", "lower", &wide, 1500, 1e-3, 0},
    };
    static mesh m;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double off[2];
        if (i == 0 || cases[i].teeth != cases[i - 1].teeth)
            make_mesh(&m, cases[i].teeth, cases[i].frequency, MOST_LEVELS);
        m.p.mesh_frequency = cases[i].frequency;
        stage *s = open_shared(cases[i].model, &m);
        stage_set(s, "damping_ratio", 0.03);
        stage_set_text(s, "branch", cases[i].branch);
        check_true(cases[i].model, run_motion(s));
        check_true("parts as said", (stage_scalar(s, "contact_loss") > 0.01) == cases[i].parts);
        follow_twin(&m, 0.03, s, off);
        printf("%s %s %g Hz: %.1e of the motion, %.1e of the force\n", cases[i].model,
               cases[i].branch, cases[i].frequency, off[0], off[1]);
        check_below("the motion of the twin", off[0], cases[i].limit);
        check_below("its mesh force", off[1], 3 * cases[i].limit);
        stage_close(s);
    }
}

/* The mean mesh force over the motion, by the trapezium rule, must be the line force. At two
   stations with the same phase, the forces of both pairs must add up to the mesh force, and none
   may be below 0. */
static void check_shares(const mesh *m, const stage *s, size_t steps, double *highest)
{
    size_t count;
    const double *phase = stage_get(s, "phase", &count), *W = stage_get(s, "tooth_force", NULL);
    const double *force = stage_get(s, "mesh_force", NULL);
    double mean = 0, cycles = phase[count - 1] - phase[0];
    for (size_t i = 1; i < count; i++)
        mean += (phase[i] - phase[i - 1]) * (force[i] + force[i - 1]) / 2 / cycles;
    check_near("mean force", mean, m->p.line_force, 1e-6);
    /* stations 1 and 8 are 0.3 and 1.3 cycles after the begin of contact, stations 2 and 9 0.5 and
       1.5 cycles */
    for (size_t i = 1; i <= 2 && stage_scalar(s, "period") == 1; i++) {
        double at = (i == 1 ? 0.3 : 0.5) * (double)steps;
        size_t k = (size_t)at;
        while (phase[k] < floor(at) / (double)steps - 1e-9)
            k++;
        double there = force[k] + (at - floor(at)) * (force[k + 1] - force[k]);
        check_near("both pairs", W[i] + W[i + 7], there, 1e-5);
        double direct = there > 0 ? tooth_force_at(m, i, there) : W[i];
        check_below("the share at that force", fabs(W[i] - direct) / m->p.line_force, 0.02);
        check_true("no pair pulls", there < 0 || (W[i] >= 0 && W[i + 7] >= 0));
        *highest = fmax(*highest, there / m->p.line_force);
    }
}

/* The work of the spring force must be the loss in the damper, in contact, while separated, and on
   the back flank. */
static void test_balances(void)
{
    enum { STEPS_SHOWN = 32768 };
    static mesh m;
    double highest = 0;
    make_mesh(&m, &relieved, 2900, 10);
    for (int i = 0; i < 3; i++) {
        int narrow = i == 2;
        m.p.backlash *= narrow ? 0.05 : 1;
        m.p.mesh_frequency = i ? 2900 : 1700;
        stage *s = open_shared("dynamics/shooting", &m);
        stage_set(s, "damping_ratio", 0.02);
        stage_set_text(s, "branch", i ? "upper" : "lower");
        stage_set_text(s, "steps_per_cycle", "32768");
        check_true("runs", run_motion(s));
        check_true("flight", (stage_scalar(s, "contact_loss") > 0.05) == (i > 0));
        check_true("both flanks", (stage_scalar(s, "back_contact") > 0.01) == narrow);
        check_below("energy", stage_quality(s, "energy_balance"), 1e-8);
        check_shares(&m, s, STEPS_SHOWN, &highest);
        stage_close(s);
    }
    check_true("pairs that bear more than the mean", highest > 1);
}

/* If all levels lie on the line k g, the spring is linear: folds and motion must be those of the
   stiffness k. */
static void test_linear(void)
{
    static double error[4 * 6], stiffness[4 * 6], loaded_error[6];
    double force[4], rms[2], fold[2];
    for (int shared = 0; shared < 2; shared++) {
        pair p = pair_trapezoid(2375);
        for (size_t k = 0; k < 4; k++)
            force[k] = (double)k * p.line_force;
        for (size_t i = 0; i < 4 * 6; i++) {
            stiffness[i] = p.stiffness[i % 6];
            error[i] = force[i / 6] / stiffness[i];
        }
        memcpy(loaded_error, error + 6, sizeof loaded_error);
        stage *s = pair_open("dynamics/shooting", &p);
        stage_set(s, "damping_ratio", 0.05);
        stage_set_text(s, "atlas.from", "2200 Hz");
        stage_set_text(s, "atlas.to", "3500 Hz");
        stage_set_text(s, "search_speeds", "0");
        stage_set_text(s, "branch", "upper");
        stage_give_series(s, "stiffness.loaded_transmission_error", 6, loaded_error);
        if (shared) {
            stage_set_text(s, "force", "shared");
            stage_give_series(s, "stiffness.force_level", 4, force);
            stage_give(s, "stiffness.level_error", 2, (size_t[]){4, 6}, error);
            stage_give(s, "stiffness.level_stiffness", 2, (size_t[]){4, 6}, stiffness);
        }
        check_true("runs", stage_run_wanted(s, "dte_rms fold_frequency") == FF_OK);
        rms[shared] = stage_scalar(s, "dte_rms");
        fold[shared] = stage_get(s, "fold_frequency", NULL)[0];
        stage_close(s);
    }
    check_near("levels of k alone, rms", rms[1], rms[0], 1e-9);
    check_true("its fold, to 1e-6 Hz", fabs(fold[1] - fold[0]) < 1e-6);
}

/* Levels with decreasing slope cannot be a spring of stiffening lines: the line through levels 1
   and 1.3 reaches 5.33 F at 2.3, where 3 F are given. The quality record must report this. */
static void test_bent_back(void)
{
    static const double deflection[4] = {0, 1, 1.3, 2.3};
    static double error[4 * 6], loaded_error[6];
    double force[4];
    pair p = pair_trapezoid(1200);
    for (size_t i = 0; i < 4 * 6; i++) {
        force[i / 6] = (double)(i / 6) * p.line_force;
        p.stiffness[i % 6] = p.stiffness[0];
        error[i] = deflection[i / 6] * p.line_force / p.stiffness[0];
    }
    memcpy(loaded_error, error + 6, sizeof loaded_error);
    stage *s = pair_open("dynamics/shooting", &p);
    stage_give_series(s, "stiffness.loaded_transmission_error", 6, loaded_error);
    stage_set_text(s, "force", "shared");
    stage_give_series(s, "stiffness.force_level", 4, force);
    stage_give(s, "stiffness.level_error", 2, (size_t[]){4, 6}, error);
    check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
    check_near("what the lines miss", stage_quality(s, "mesh_force_convex"), 7.0 / 3, 0.01);
    stage_close(s);
}

/* A slope below the secant from the level before is impossible for a mesh that stiffens: the secant
   replaces it, and the quality line must report this. */
static void test_soft_slope(void)
{
    static double error[3 * 6], slope[3 * 6], loaded_error[6];
    double force[3];
    pair p = pair_trapezoid(1200);
    for (size_t i = 0; i < 3 * 6; i++) {
        force[i / 6] = (double)(i / 6) * p.line_force;
        error[i] = force[i / 6] / p.stiffness[i % 6];
        slope[i] = p.stiffness[i % 6];
    }
    memcpy(loaded_error, error + 6, sizeof loaded_error);
    for (int soft = 0; soft < 2; soft++) {
        stage *s = pair_open("dynamics/shooting", &p);
        slope[2 * 6 + 3] *= soft ? 0.8 : 1;
        stage_give_series(s, "stiffness.loaded_transmission_error", 6, loaded_error);
        stage_set_text(s, "force", "shared");
        stage_give_series(s, "stiffness.force_level", 3, force);
        stage_give(s, "stiffness.level_error", 2, (size_t[]){3, 6}, error);
        stage_give(s, "stiffness.level_stiffness", 2, (size_t[]){3, 6}, slope);
        check_true("runs", stage_run_wanted(s, "dte_rms") == FF_OK);
        check_below("no force is raised", stage_quality(s, "mesh_force_convex"), 1e-3);
        check_true("a raised slope is told", stage_has_quality(s, "soft_levels") == soft);
        stage_close(s);
    }
}

/* Without relief, with a mesh that does not depend on phase: e varies by a thousandth of the
   deflection, and the response must be that of the slope k at the mean force, m z'' + c z' + k z =
   -m e''. */
static void test_small_vibration(void)
{
    static mesh m;
    const double zeta = 0.02, frequency = 1900, amplitude = 1e-8;
    make_mesh(&m, &none, frequency, 10);
    double mean = m.p.stiffness_mean, k;
    for (size_t i = 0; i < m.levels * (PHASES + 1); i++) {
        double there = m.force[i / (PHASES + 1)];
        m.error[i] = there > 0 ? loaded(&none, 0.25, there, &m.stiffness[i]) : 0;
        loaded(&none, 0.25, fmax(there, 1e-9 * m.p.line_force), &m.stiffness[i]);
        m.error[i] += amplitude * cos(2 * M_PI * m.p.phase[i % (PHASES + 1)]);
    }
    double rest = loaded(&none, 0.25, m.p.line_force, &k);
    for (size_t i = 0; i <= PHASES; i++) {
        m.p.error[i] = m.error[i];
        m.loaded[i] = rest + m.p.error[i];
        m.p.stiffness[i] = k;
    }
    m.p.mass *= k / mean;
    m.p.stiffness_mean = k;
    double w = 2 * M_PI * frequency, w_n = sqrt(k / m.p.mass), r = w / w_n;
    double answer = amplitude * hypot(1, 2 * zeta * r) / hypot(1 - r * r, 2 * zeta * r);
    static const char *const models[] = {"dynamics/shooting", "dynamics/time-integration",
                                         "dynamics/harmonic-balance"};
    for (int i = 0; i < 3; i++) {
        stage *s = open_shared(models[i], &m);
        stage_set(s, "damping_ratio", zeta);
        check_true(models[i], stage_run_wanted(s, "dte_rms") == FF_OK);
        check_near("answer of the slope", stage_scalar(s, "dte_rms"), answer / sqrt(2), 1e-3);
        stage_close(s);
    }
}

/* The difference between all levels and every second level must be within the error stated with
   every second level. */
static void test_half(void)
{
    static mesh m;
    static double W[2][PAIR_STATIONS];
    double rms[2], stated = 0;
    for (int half = 1; half >= 0; half--) {
        make_mesh(&m, &relieved, 2600, half ? 10 : 19);
        stage *s = open_shared("dynamics/shooting", &m);
        stage_set(s, "damping_ratio", 0.05);
        check_true("runs", run_motion(s));
        rms[half] = stage_scalar(s, "dte_rms");
        memcpy(W[half], stage_get(s, "tooth_force", NULL), sizeof W[half]);
        stated = half ? stage_quality(s, "force_levels") : stated;
        printf("%zu levels: %.2g\n", m.levels, stage_quality(s, "force_levels"));
        check_true("twice the levels are enough", half || stage_quality(s, "force_levels") < 0.02);
        stage_close(s);
    }
    check_below("rms", fabs(rms[1] / rms[0] - 1), stated);
    for (size_t i = 0; i < PAIR_STATIONS; i++)
        check_below("tooth force", fabs(W[1][i] - W[0][i]) / m.p.line_force, stated);
}

/* A motion beyond the levels must be doubtful, with a stated error that covers the effect of the
   missing levels. */
static void test_beyond(void)
{
    static mesh m;
    double rms[2], stated = 0;
    make_mesh(&m, &relieved, 2900, 10);
    for (int all = 1; all >= 0; all--) {
        m.levels = all ? 10 : 5; /* up to 1.8 times the mean force */
        stage *s = open_shared("dynamics/shooting", &m);
        stage_set(s, "damping_ratio", 0.03);
        stage_set_text(s, "branch", "upper");
        check_true("runs", run_motion(s));
        rms[all] = stage_scalar(s, "dte_rms");
        stated = stage_quality(s, "force_levels");
        printf("levels up to %g F: %.2g\n", m.force[m.levels - 1] / m.p.line_force, stated);
        check_true("doubtful if it leaves them", all || stage_verdict(s) == FF_DOUBTFUL);
        stage_close(s);
    }
    check_below("rms", fabs(rms[1] / rms[0] - 1), stated);
    check_true("more than between the levels", stated > 0.1);
}

/* Below a hundredth of the natural frequency, the motion must be the transmission error under
   load. */
static void test_slow(void)
{
    static mesh m;
    make_mesh(&m, &relieved, 20, 10);
    stage *s = open_shared("dynamics/shooting", &m);
    const size_t count = 4096;
    double mean = 0, square = 0, k;
    stage_set(s, "damping_ratio", 0.05);
    check_true("runs", run_motion(s));
    for (size_t i = 0; i < count; i++) {
        double there = loaded(&m.teeth, (double)i / (double)count, m.p.line_force, &k);
        mean += there / (double)count;
        square += there * there / (double)count;
    }
    check_near("rms", stage_scalar(s, "dte_rms"), sqrt(square - mean * mean), 1e-3);
    check_near("mean", stage_scalar(s, "dte_mean") - m.p.backlash / 2, mean, 1e-4);
    stage_close(s);
}

/* A wrong or missing level must be reported with its row. */
static void test_refusals(void)
{
    static mesh m;
    make_mesh(&m, &relieved, 2000, 4);
    stage *s = pair_open("dynamics/shooting", &m.p);
    stage_set_text(s, "force", "shared");
    check_true("no levels", stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), "force"));
    stage_close(s);
    for (int i = 0; i < 4; i++) {
        make_mesh(&m, &relieved, 2000, 4);
        size_t at = (size_t)(i == 0 ? 0 : 3) * (PHASES + 1) + 7;
        double *of = i == 2 ? m.stiffness : m.error;
        of[at] = i == 0 ? 1e-6 : i == 1 ? m.error[at - PHASES - 1] : i == 2 ? 0 : of[at];
        m.loaded[7] += i == 3 ? 1e-7 : 0;
        m.force[1] = i == 3 ? m.p.line_force : m.force[1];
        s = open_shared("dynamics/shooting", &m);
        check_true(i == 2 ? "no slope" : "not the error",
                   stage_run(s) == FF_INVALID &&
                       !strcmp(stage_why_item(s),
                               i == 2 ? "stiffness.level_stiffness" : "stiffness.level_error"));
        stage_close(s);
    }
}

int main(void)
{
    test_twin();
    test_balances();
    test_linear();
    test_bent_back();
    test_soft_slope();
    test_small_vibration();
    test_half();
    test_beyond();
    test_slow();
    test_refusals();
    return check_done();
}
