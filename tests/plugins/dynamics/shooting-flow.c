/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact motion through a mesh cycle: closed forms and invariants. */
#include "check.h"

#include "../../../plugins/dynamics/orbits/orbit.h"

#include <math.h>
#include <stdio.h>

enum { MOST = 2048 };

typedef struct fixture {
    dynamics_excitation mesh;
    dynamics_flow flow;
} fixture;

static void open_mesh(fixture *f, size_t count, const double *phase, const double *k,
                      const double *e)
{
    dynamics_mesh_curves x = {count, phase, k, e};
    f->mesh.length = f->mesh.stiffness = f->mesh.omega = 1;
    check_true("builds",
               dynamics_excitation_build(&f->mesh, &x) && dynamics_flow_init(&f->flow, &f->mesh));
}

static void close_mesh(fixture *f)
{
    dynamics_flow_free(&f->flow);
    dynamics_excitation_free(&f->mesh);
}

/* Makes the trapezoid of pair.c with half backlash 1; symmetric in time. */
static void trapezoid(fixture *f, double zeta, double load, int damping)
{
    const double two = 0.755, ramp = 0.04, edge = two / 2, high = 1 / (two + (1 - two) * 0.65);
    const double phase[] = {
        0, edge - ramp / 2, edge + ramp / 2, 1 - edge - ramp / 2, 1 - edge + ramp / 2, 1};
    const double k[] = {high, high, 0.65 * high, 0.65 * high, high, high};
    *f = (fixture){.mesh = {.zeta = zeta, .load = load, .half_gap = 1, .damping = damping}};
    open_mesh(f, 6, phase, k, NULL);
}

/* Makes k = mean + first cos(2 pi phase) from `n` straight lines, enough for the smooth pieces to
   follow the cosine. */
static void cosine(fixture *f, double mean, double first, double zeta, size_t n)
{
    static double phase[MOST + 1], k[MOST + 1];
    for (size_t i = 0; i <= n; i++) {
        phase[i] = (double)i / (double)n;
        k[i] = mean + first * cos(2 * M_PI * phase[i]);
    }
    *f = (fixture){.mesh = {.zeta = zeta}};
    open_mesh(f, n + 1, phase, k, NULL);
}

static dynamics_state pass(const fixture *f, double T, double x, double v, int cycles)
{
    dynamics_state y = dynamics_state_at(x, v);
    for (int i = 0; i < cycles; i++)
        check_true("passes", dynamics_flow_variation(&f->flow, T, &y, NULL));
    return y;
}

/* McLachlan's x'' + (a - 2 q cos 2t) x = 0: at a characteristic value the trace over pi is 2 or
   -2. */
static double trace_less(double q, double a, double trace)
{
    fixture f;
    cosine(&f, a, -2 * q, 0, 1024);
    dynamics_state y = dynamics_state_at(0, 0);
    check_true("passes", dynamics_flow_variation(&f.flow, M_PI, &y, NULL));
    close_mesh(&f);
    return y.m[0] + y.m[3] - trace;
}

/* Returns a characteristic value by false position (Illinois). */
static double characteristic(double q, double low, double high, double trace)
{
    double f_low = trace_less(q, low, trace), f_high = trace_less(q, high, trace), a = low;
    for (int i = 0; i < 30 && high - low > 1e-9; i++) {
        a = high - f_high * (high - low) / (f_high - f_low);
        double f = trace_less(q, a, trace);
        if (f == 0)
            break;
        if ((f < 0) == (f_low < 0))
            low = a, f_low = f, f_high *= 0.5;
        else
            high = a, f_high = f, f_low *= 0.5;
    }
    return a;
}

static void test_mathieu(void)
{
    /* stiffness must not be negative: a > 2 q */
    const struct {
        double q, a, trace, away;
    } values[] = {{0.1, 0.898766, -2, 0.05}, {0.1, 1.098734, -2, 0.05}, {0.5, 1.466767, -2, 0.05},
                  {1, 3.917025, 2, 0.1},     {1, 4.371301, 2, 0.1},     {0.5, 4.100901, 2, 0.04}};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        double a = characteristic(values[i].q, values[i].a - values[i].away,
                                  values[i].a + values[i].away, values[i].trace);
        check_below("Mathieu's characteristic value", fabs(a - values[i].a), 1e-6);
    }
}

/* Limits of the damped principal instability, from another program, to the digits below. */
static void test_damped_tongue(void)
{
    const double edges[][3] = {{0.05, 1.98482, 2.01482},
                               {0.1, 1.95377, 2.04541},
                               {0.2, 1.90077, 2.09657},
                               {0.3, 1.84879, 2.14556}};
    for (int i = 0; i < 4; i++) {
        fixture f;
        cosine(&f, 1, edges[i][0], 0.01, 512);
        for (int side = 1; side <= 2; side++) {
            double out = side == 1 ? -1e-5 : 1e-5;
            for (int k = 0; k < 2; k++) {
                dynamics_orbit o = {.period = 1, .lambda = log(edges[i][side] + (k ? out : -out))};
                check_true("maps", dynamics_orbit_map(&f.flow, &o));
                check_true(k ? "stable outside" : "unstable inside",
                           (dynamics_largest_multiplier(&o) < 1) == k);
            }
        }
        close_mesh(&f);
    }
}

/* Advances x'' + 2 z x' + k x = load by a time t, in closed form. */
static void spring(double z, double k, double load, double t, double y[2])
{
    double w = sqrt(k - z * z), x = y[0] - load / k, c = cos(w * t), s = sin(w * t);
    double a = x, b = (y[1] + z * x) / w, decay = exp(-z * t);
    y[0] = load / k + decay * (a * c + b * s);
    y[1] = decay * (w * (b * c - a * s) - z * (a * c + b * s));
}

/* Without separation, the return map is affine: with two levels of k, it must agree with the closed
   form, and Newton's method must find the fixed point in one step. */
static void test_affine(void)
{
    const double phase[] = {0, 0.6, 0.6, 1}, k[] = {1.1, 1.1, 0.85, 0.85};
    for (int i = 0; i < 5; i++) {
        const double ratio[] = {0.3, 0.55, 1.31, 2.7, 9};
        double lambda = log(ratio[i]), T = dynamics_cycle_duration(lambda), zeta = 0.05;
        fixture f = {.mesh = {.zeta = zeta, .load = 1, .half_gap = 1}};
        open_mesh(&f, 4, phase, k, NULL);
        double column[3][2] = {{0, 0}, {1, 0}, {0, 1}};
        for (int c = 0; c < 3; c++) {
            spring(zeta, 1.1, 1, 0.6 * T, column[c]);
            spring(zeta, 0.85, 1, 0.4 * T, column[c]);
        }
        double a = 1 - (column[1][0] - column[0][0]), b = -(column[2][0] - column[0][0]);
        double c = -(column[1][1] - column[0][1]), d = 1 - (column[2][1] - column[0][1]);
        double det = a * d - b * c;
        double x = (d * column[0][0] - b * column[0][1]) / det;
        double v = (a * column[0][1] - c * column[0][0]) / det;
        dynamics_orbit o = {.period = 1, .lambda = lambda, .x = {2.5, 0.1}};
        check_true("solves", dynamics_orbit_solve(&f.flow, 1e-13, &o));
        check_below("fixed point", hypot(o.x[0] - 1 - x, o.x[1] - v), 1e-12);
        check_below("monodromy",
                    fabs(o.m[0] - 1 + a) + fabs(o.m[1] + b) + fabs(o.m[2] + c) +
                        fabs(o.m[3] - 1 + d),
                    1e-12);
        close_mesh(&f);
    }
}

/* Returns the period of a free vibration x'' + g(x) = load with its highest point a above the
   static deflection: in the phase plane, an arc of a circle on the driving flank, a parabola in the
   gap, and, for large a, an arc on the back flank. */
static double backbone(double a, double load, double b)
{
    if (a <= load)
        return 2 * M_PI;
    double front = 2 * (M_PI - acos(load / a)), v = sqrt(a * a - load * load);
    if (v * v <= 4 * load * b)
        return front + 2 * v / load;
    double w = sqrt(v * v - 4 * load * b);
    return front + 2 * (v - w) / load + 2 * atan(w / load);
}

static void test_backbone(void)
{
    const double phase[] = {0, 1}, k[] = {1, 1}, amplitudes[] = {0.05, 0.3, 0.7, 0.8, 1.5, 40};
    for (int i = 0; i < 6; i++) {
        fixture f = {.mesh = {.load = 0.14, .half_gap = 1}};
        open_mesh(&f, 2, phase, k, NULL);
        double x = 1 + 0.14 + amplitudes[i], T = backbone(amplitudes[i], 0.14, 1);
        for (int cycles = 1; cycles <= 3; cycles++) {
            /* one free vibration takes 1, 2 or 3 mesh cycles */
            dynamics_state y = pass(&f, T / cycles, x, 0, cycles);
            check_below("free vibration returns", hypot(y.delta - x, y.rate) / x, 1e-12);
            check_near("det", y.det, 1, 1e-13);
        }
        close_mesh(&f);
    }
}

/* Without damping, and with an excitation symmetric in time, a motion must return to its start
   after its rate is reversed. */
static void test_time_reversal(void)
{
    fixture f;
    trapezoid(&f, 0, 0.14, DYNAMICS_DAMPING_ALWAYS);
    for (int i = 0; i < 6; i++) {
        double x = 0.5 + 0.2 * i, v = 0.3 - 0.1 * i, T = 3 + 1.7 * i;
        dynamics_state forth = pass(&f, T, x, v, 3),
                       back = pass(&f, T, forth.delta, -forth.rate, 3);
        double size = 1 + hypot(forth.m[0] + forth.m[3], forth.m[1] + forth.m[2]);
        check_below("returns", hypot(back.delta - x, back.rate + v) / size, 1e-12);
        check_near("det", forth.det, 1, 1e-12);
    }
    close_mesh(&f);
}

/* Compares derivatives with differences of the motion, for every kind of damping, with a
   transmission error that has kinks and jumps. */
static void test_derivatives(void)
{
    const double phase[] = {0, 0.3, 0.3, 0.7, 1}, k[] = {1.2, 1.1, 0.8, 0.9, 1.2};
    const double e[] = {0, 0.2, 0.35, -0.1, 0.1};
    for (int damping = DYNAMICS_DAMPING_ALWAYS; damping <= DYNAMICS_DAMPING_CLIPPED; damping++) {
        fixture f = {.mesh = {.zeta = 0.07, .load = 0.14, .half_gap = 0.4, .damping = damping}};
        open_mesh(&f, 5, phase, k, e);
        for (int i = 0; i < 8; i++) {
            double x = 0.9 - 0.23 * i, v = 0.4 * sin(3 * i), T = 2.5 + i, h = 1e-6;
            dynamics_state y = pass(&f, T, x, v, 2);
            double d[3][2];
            for (int c = 0; c < 3; c++) {
                dynamics_state p =
                    pass(&f, T + h * (c == 2), x + h * (c == 0), v + h * (c == 1), 2);
                dynamics_state m =
                    pass(&f, T - h * (c == 2), x - h * (c == 0), v - h * (c == 1), 2);
                d[c][0] = (p.delta - m.delta) / (2 * h);
                d[c][1] = (p.rate - m.rate) / (2 * h);
            }
            double size = 1 + hypot(y.m[0], y.m[1]) + hypot(y.m[2], y.m[3]);
            check_below("after x", hypot(y.m[0] - d[0][0], y.m[2] - d[0][1]) / size, 1e-6);
            check_below("after v", hypot(y.m[1] - d[1][0], y.m[3] - d[1][1]) / size, 1e-6);
            size += hypot(y.change[0], y.change[1]);
            check_below("after T", hypot(y.change[0] - d[2][0], y.change[1] - d[2][1]) / size,
                        1e-6);
        }
        close_mesh(&f);
    }
}

/* A contact of depth d^2 at x = 0.4 must be found down to rounding errors, and no contact where
   there is none. */
static void test_grazing(void)
{
    for (int i = 1; i <= 6; i++) {
        double d = pow(10, -i), p[3] = {0.16 - d * d, -0.8, 1}, q[3] = {0.16 + d * d, -0.8, 1};
        check_below("seen", fabs(dynamics_taylor_first_exit(p, 2, 1e-15) - (0.4 - d)),
                    1e-15 / d + 1e-15);
        check_near("not invented", dynamics_taylor_first_exit(q, 2, 1e-15), -1, 0);
    }
    const double leaves[] = {0, -1, 2}, stays[] = {0, 1, -0.5}, again[] = {0, 1, -4, 2};
    check_near("leaves at once", dynamics_taylor_first_exit(leaves, 2, 1e-15), 0, 0);
    check_near("stays inside", dynamics_taylor_first_exit(stays, 2, 1e-15), -1, 0);
    check_near("comes back", dynamics_taylor_first_exit(again, 3, 1e-15), 1 - sqrt(0.5), 1e-14);
}

/* The return map must be continuous between start points whose motions just touch, and just miss,
   the edge of the gap. */
static void test_graze_of_motion(void)
{
    fixture f;
    trapezoid(&f, 0.01, 0.14, DYNAMICS_DAMPING_ALWAYS);
    double last[2] = {0};
    for (int i = -50; i <= 50; i++) {
        double a = 0.14 / 1.0937 * (1 + 1e-9 * i); /* amplitude */
        dynamics_state y = pass(&f, 4, 1 + 0.14 / 1.0937 + a, 0, 1);
        if (i > -50)
            check_below("no leap", hypot(y.delta - last[0], y.rate - last[1]), 1e-8);
        last[0] = y.delta, last[1] = y.rate;
    }
    close_mesh(&f);
}

/* Follows the motion of large amplitude to lower speeds, to its fold, which is found to `step` of
   lambda. */
static dynamics_orbit fold_of(const fixture *f, double step)
{
    dynamics_orbit o = {.period = 1, .lambda = log(0.8)}, next;
    dynamics_state y = pass(f, dynamics_cycle_duration(o.lambda), 4, 0, 400);
    o.x[0] = y.delta, o.x[1] = y.rate;
    check_true("starts", dynamics_orbit_solve(&f->flow, dynamics_orbit_accuracy, &o));
    check_true("on a motion that parts", hypot(o.x[0] - 1, o.x[1]) > 0.5);
    for (double down = 0.01; down > step; down /= 2)
        for (;;) {
            next = o;
            next.lambda -= down;
            if (!dynamics_orbit_solve(&f->flow, dynamics_orbit_accuracy, &next) ||
                !dynamics_orbit_is_stable(&next))
                break;
            o = next;
        }
    return o;
}

/* A motion that repeats itself after a shorter period to 1e-6 must get this period. If Newton's
   method does not converge with this period, as just beyond a fold, the start must not change. */
static void test_reduce(void)
{
    fixture f;
    trapezoid(&f, 0.01, 0.14, DYNAMICS_DAMPING_ALWAYS);
    dynamics_orbit o = fold_of(&f, 1e-10), twice = o, beyond = o, lost;
    twice.period = beyond.period = 2;
    twice.x[0] += 1e-9;
    dynamics_orbit_reduce(&f.flow, &twice);
    check_near("a shorter period", twice.period, 1, 0);
    check_below("sharpened", dynamics_orbit_residual(&f.mesh, &twice), 1e-11);
    beyond.lambda -= 1e-8;
    lost = beyond;
    lost.period = 1;
    check_true("no motion there", !dynamics_orbit_solve(&f.flow, dynamics_orbit_accuracy, &lost));
    check_true("Newton's method moves the start", fabs(lost.x[0] - beyond.x[0]) > 0);
    dynamics_orbit_reduce(&f.flow, &beyond);
    check_near("a shorter period beyond", beyond.period, 1, 0);
    check_near("its own start", hypot(beyond.x[0] - o.x[0], beyond.x[1] - o.x[1]), 0, 0);
    close_mesh(&f);
}

/* Without load and damping, a motion between the flanks crosses the gap 2 b twice, and reverses at
   each flank in half a period of the spring: period 4 b/v + 2 pi. */
static void test_between_flanks(void)
{
    const double speeds[] = {0.1, 1, 7};
    for (int i = 0; i < 3; i++) {
        fixture f;
        cosine(&f, 1, 0, 0, 64);
        f.mesh.half_gap = 1;
        dynamics_state y = pass(&f, 4 / speeds[i] + 2 * M_PI, 0, speeds[i], 1);
        check_below("comes back", hypot(y.delta, (y.rate - speeds[i]) / speeds[i]), 1e-13);
        y = pass(&f, 2 / speeds[i] + M_PI, 0, speeds[i], 1);
        check_below("half way", hypot(y.delta, (y.rate + speeds[i]) / speeds[i]), 1e-13);
        close_mesh(&f);
    }
}

int main(void)
{
    test_between_flanks();
    test_reduce();
    test_mathieu();
    test_damped_tongue();
    test_affine();
    test_backbone();
    test_time_reversal();
    test_derivatives();
    test_grazing();
    test_graze_of_motion();
    return check_done();
}
