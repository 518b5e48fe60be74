/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "curve.h"

#include "../../numerics/bracket.h"
#include "bordered.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 20000, FIRST_MARK = 64, MAX_SECANTS = 40 };

/* Tolerances of the residual of a motion and of a point of the curve, in state units. */
static const double tolerance = 1e-10, of_point = 1e-8;
static const double noise = 1e-6;                           /* noise of the test functions */
static const double first_step = 0.1, shortest_step = 1e-7; /* both relative to the longest step */
static const double predicted = 2e-3; /* error of the predictor for which the step length is
                                         chosen */
static const double most_turn = 0.35; /* largest angle between the tangents at both ends of a
                                         step, rad */
static const double cap =
    100; /* bound on the amplitude, relative to half the backlash plus the static deflection */

static dynamics_point point_of(const dynamics_continuation_range *t, const dynamics_orbit *o)
{
    dynamics_point p = {
        .x = {o->x[0], o->x[1]},
        .lambda = o->lambda,
        .fold = dynamics_fold_test(o),
        .doubling = dynamics_doubling_test(o),
        .largest = dynamics_largest_multiplier(o),
    };
    if (o->moments)
        p.rms = o->rms;
    else if (t->moments && !dynamics_orbit_rms(t->flow, o, &p.rms))
        p.rms = 0;
    return p;
}

static int append(dynamics_curve *c, const dynamics_point *p)
{
    if (c->count == c->capacity) {
        size_t capacity = c->capacity ? 2 * c->capacity : 256;
        dynamics_point *points = realloc(c->points, capacity * sizeof *points);
        if (!points)
            return 0;
        c->points = points;
        c->capacity = capacity;
    }
    c->points[c->count++] = *p;
    return 1;
}

/* A step of the continuation, of arclength `ds`, from the point `from` to the point `to`. */
typedef struct stride {
    dynamics_point back, from,
        to;               /* `back` is the point before `from`; if `before` is 0 there is none */
    double ds, before;    /* length of this step, and of the previous one */
    dynamics_orbit orbit; /* orbit at `to` */
    double half[2];       /* state of the orbit at `from` after half its period */
} stride;

/* Solves for the point at arclength s inside a step whose end is already known. */
static int solve_in_stride(const dynamics_continuation_range *t, const stride *w, double s,
                           dynamics_orbit *o)
{
    dynamics_frame f = dynamics_frame_at(t->flow->excitation, &w->from);
    double border[3], z[3];
    dynamics_scaled_tangent(&f, &w->from, border);
    dynamics_point_of_cubic(&f, border, &w->to, s, z);
    return dynamics_bordered_newton(t->flow, &f, border, tolerance, z, o);
}

static double arclength(const dynamics_continuation_range *t, const stride *w)
{
    double u = dynamics_state_unit(t->flow->excitation, w->from.x);
    return (w->to.x[0] - w->from.x[0]) * w->from.tangent[0] / (u * u) +
           (w->to.x[1] - w->from.x[1]) * w->from.tangent[1] / (u * u) +
           (w->to.lambda - w->from.lambda) * w->from.tangent[2];
}

/* Finds the root of a test function over the arclength of the step. Returns 0 if it was not
   found. */
static int find_root_of_test(const dynamics_continuation_range *t, const stride *w,
                             double (*test)(const dynamics_orbit *), double at_start, double at_end,
                             dynamics_orbit *o)
{
    numerics_bracket b = {0, at_start, arclength(t, w), at_end, 0};
    double whole = b.high;
    stride near = *w; /* a copy of the step; its end moves to the root */
    int found = 0;
    for (int i = 0; i < MAX_SECANTS && b.high - b.low > 1e-10 * whole; i++) {
        double s = numerics_bracket_secant(&b);
        if (!solve_in_stride(t, &near, s, o))
            return found;
        found = 1;
        near.to = (dynamics_point){.x = {o->x[0], o->x[1]}, .lambda = o->lambda};
        if (!dynamics_curve_tangent(o, dynamics_state_unit(t->flow->excitation, o->x),
                                    w->from.tangent, near.to.tangent))
            near = *w;
        double f = test(o);
        if (fabs(f) < 1e-11 * (fabs(at_start) + fabs(at_end)))
            break;
        numerics_bracket_narrow(&b, s, f);
    }
    return found;
}

/* Computes the eigenvector of the multiplier -1. */
static void doubling_direction(const dynamics_orbit *o, double v[2])
{
    double a[2] = {o->m[0] + 1, o->m[1]}, b[2] = {o->m[2], o->m[3] + 1};
    const double *row = hypot(a[0], a[1]) > hypot(b[0], b[1]) ? a : b;
    double size = hypot(row[0], row[1]);
    v[0] = size > 0 ? -row[1] / size : 1;
    v[1] = size > 0 ? row[0] / size : 0;
}

/* Returns whether a motion of even period has become a motion of half the period. The curve turns
   back there and follows the same motions, shifted by half the period. That point is not a fold. */
static int is_halved(const dynamics_excitation *excitation, const dynamics_orbit *o)
{
    return o->period % 2 == 0 && hypot(o->half[0] - o->x[0], o->half[1] - o->x[1]) <
                                     1e-3 * dynamics_state_unit(excitation, o->x);
}

/* Appends the folds and period doublings of the step in their order along the curve. A test
   function below `noise` is ignored. Without contact loss the pair is linear, and a doubling is
   then a whole line of motions at one speed. */
static int add_events(const dynamics_continuation_range *t, const stride *w, dynamics_curve *c)
{
    dynamics_point found[2];
    double s[2];
    int count = 0;
    for (int kind = DYNAMICS_POINT_FOLD; kind <= DYNAMICS_POINT_DOUBLING; kind++) {
        int fold = kind == DYNAMICS_POINT_FOLD;
        double a = fold ? w->from.fold : w->from.doubling, z = fold ? w->to.fold : w->to.doubling;
        /* at a fold lambda turns back along the curve; if it does not, two curves cross there */
        int turns = w->from.tangent[2] * w->to.tangent[2] < 0;
        dynamics_orbit o = w->orbit;
        if (a * z >= 0 || fmin(fabs(a), fabs(z)) < noise || (fold && !turns) ||
            !find_root_of_test(t, w, fold ? dynamics_fold_test : dynamics_doubling_test, a, z,
                               &o) ||
            (fold && is_halved(t->flow->excitation, &o)))
            continue;
        dynamics_point p = point_of(t, &o);
        p.kind = kind;
        doubling_direction(&o, p.direction);
        if (!dynamics_curve_tangent(&o, dynamics_state_unit(t->flow->excitation, p.x),
                                    w->from.tangent, p.tangent))
            memcpy(p.tangent, w->from.tangent, sizeof p.tangent);
        stride part = *w;
        part.to = p;
        s[count] = arclength(t, &part);
        found[count++] = p;
    }
    int swap = count == 2 && s[1] < s[0];
    for (int i = 0; i < count; i++)
        if (!append(c, &found[swap ? 1 - i : i]))
            return 0;
    return 1;
}

/* Returns whether a step may miss two folds. That may happen if the slopes of lambda at both ends
   have the same sign, but the cubic through both ends nearly turns between them. */
static int hides_folds(double slope, double end_slope, double mean)
{
    double middle = 1.5 * mean - 0.25 * (slope + end_slope);
    double least = fmin(fabs(slope), fabs(end_slope));
    return slope * end_slope > 0 && (slope < 0 ? -middle : middle) < 0.5 * least;
}

/* Returns whether a step may miss two period doublings, judged by the parabola through the last
   three values of the test function. */
static int hides_doublings(const stride *w)
{
    double back = w->before, a = w->back.doubling, b = w->from.doubling;
    double c = dynamics_doubling_test(&w->orbit);
    if (back == 0 || a * b <= 0 || b * c <= 0)
        return 0;
    double bend = ((c - b) / w->ds - (b - a) / back) / (w->ds + back);
    double slope = (b - a) / back + bend * back, lowest = -slope / (2 * bend);
    double value = b + 0.5 * slope * lowest;
    return lowest > 0 && lowest < w->ds && value / b < 0.3 * fmin(1, c / b);
}

/* Tries a step of length w->ds: predictor, corrector, and the angle between the tangents. `error`
   is the error of the predictor and `turn` the angle. Returns 0 if the step is too long. */
static int try_stride(const dynamics_continuation_range *t, stride *w, double *error, double *turn)
{
    dynamics_frame f = dynamics_frame_at(t->flow->excitation, &w->from);
    double border[3], z[3], guess[3], ds = w->ds;
    dynamics_scaled_tangent(&f, &w->from, border);
    for (int k = 0; k < 3; k++)
        z[k] = ds * border[k];
    if (w->before > 0)
        dynamics_point_of_cubic(&f, border, &w->back, ds, z);
    memcpy(guess, z, sizeof guess);
    f.moments = t->moments;
    if (!dynamics_bordered_newton(t->flow, &f, border, of_point, z, &w->orbit))
        return 0;
    double miss[3] = {z[0] - guess[0], z[1] - guess[1], z[2] - guess[2]}, tangent[3];
    *error = sqrt(dynamics_dot(miss, miss));
    w->to = (dynamics_point){.x = {w->orbit.x[0], w->orbit.x[1]}, .lambda = w->orbit.lambda};
    if (!dynamics_curve_tangent(&w->orbit, dynamics_state_unit(t->flow->excitation, w->to.x),
                                w->from.tangent, w->to.tangent))
        return 0;
    dynamics_scaled_tangent(&f, &w->to, tangent);
    double size = sqrt(dynamics_dot(tangent, tangent));
    double cosine = dynamics_dot(tangent, border) / (size * sqrt(dynamics_dot(border, border)));
    int kink = ds < 1e-3 * t->step; /* at a grazing contact the curve has a kink */
    *turn = acos(fmin(fmax(cosine, -1), 1));
    if (*error > 0.5 * ds || (*turn > most_turn && !kink))
        return 0;
    return ds <= 1e-2 * t->step ||
           !(hides_folds(border[2], tangent[2] / size, z[2] / ds) || hides_doublings(w));
}

/* Ends the step at the bound of the range that it crosses. Returns 0 if no motion was found
   there. */
static int cut_at_bound(const dynamics_continuation_range *t, double bound, stride *w)
{
    if (!dynamics_curve_solve(t->flow, &w->from, &w->to, bound, &w->orbit))
        return 0;
    double tangent[3];
    memcpy(tangent, w->to.tangent, sizeof tangent);
    w->to = point_of(t, &w->orbit);
    memcpy(w->to.tangent, tangent, sizeof tangent);
    return 1;
}

/* A motion to which the curve may return: its states at phase 0. */
typedef struct mark {
    double lambda;
    double x[DYNAMICS_PERIOD_MAX][2];
} mark;

static int set_mark(const dynamics_flow *flow, const dynamics_orbit *o, mark *m)
{
    dynamics_state y = dynamics_orbit_start(o);
    m->lambda = o->lambda;
    for (int i = 0; i < o->period; i++) {
        m->x[i][0] = y.delta;
        m->x[i][1] = y.rate;
        if (!dynamics_flow_motion(flow, dynamics_cycle_duration(o->lambda), &y, NULL))
            return 0;
    }
    return 1;
}

/* Returns whether the step passes through the marked motion. */
static int passes_mark(const dynamics_continuation_range *t, const stride *w, const mark *m)
{
    double u = dynamics_state_unit(t->flow->excitation, w->from.x), whole = arclength(t, w);
    const double *tangent = w->from.tangent;
    for (int i = 0; i < w->orbit.period; i++) {
        double d[3] = {(m->x[i][0] - w->from.x[0]) / u, (m->x[i][1] - w->from.x[1]) / u,
                       m->lambda - w->from.lambda};
        double along = (d[0] * tangent[0] + d[1] * tangent[1]) / u + d[2] * tangent[2];
        double off = sqrt(fmax(dynamics_dot(d, d) - along * along, 0));
        if (along > 0 && along <= whole && off < 0.2 * whole)
            return 1;
    }
    return 0;
}

/* Finds the period doubling near `o`, a motion of the shorter period, by the secant method in
   lambda. */
static int find_doubling(const dynamics_continuation_range *t, dynamics_orbit *o)
{
    static const double first = 1e-4, far = 0.05;
    double start = o->lambda, last = 0, f_last = 0;
    for (int i = 0; i < 12; i++) {
        if (!dynamics_orbit_solve(t->flow, tolerance, o) || fabs(o->lambda - start) > far)
            return 0;
        double f = dynamics_doubling_test(o), step = first;
        if (i > 0)
            step = f != f_last ? -f * (o->lambda - last) / (f - f_last) : 0;
        if (fabs(step) < 1e-12)
            return 1;
        last = o->lambda;
        f_last = f;
        o->lambda += step;
    }
    return 0;
}

/* Returns whether a motion of even period becomes one of half the period within the step, or
   converges to a motion of half the period. The step then ends at that motion. */
static int meets_half_period(const dynamics_continuation_range *t, stride *w)
{
    const dynamics_orbit *o = &w->orbit;
    if (o->period % 2 != 0)
        return 0;
    double before[2] = {w->half[0] - w->from.x[0], w->half[1] - w->from.x[1]};
    double after[2] = {o->half[0] - o->x[0], o->half[1] - o->x[1]};
    double b = hypot(before[0], before[1]), a = hypot(after[0], after[1]);
    if (before[0] * after[0] + before[1] * after[1] >= 0 && a > 1e-3 * b)
        return 0;
    double x = b / (a + b);
    dynamics_orbit shorter = {.period = o->period / 2};
    shorter.lambda = w->from.lambda + x * (o->lambda - w->from.lambda);
    for (int i = 0; i < 2; i++)
        shorter.x[i] = w->from.x[i] + 0.5 * before[i];
    if (find_doubling(t, &shorter)) {
        w->to = point_of(t, &shorter);
        w->to.largest = w->from.largest;
    } else {
        w->to = w->from;
    }
    return 1;
}

static int beyond_cap(const dynamics_excitation *excitation, const dynamics_point *p)
{
    double limit = cap * (excitation->half_gap + 1);
    return !(fabs(p->x[0]) < limit && fabs(p->x[1]) < limit);
}

/* Returns the length of the next step. The error of the predictor grows with the fourth power of
   the step length. The angle between the tangents is proportional to the step length where the
   curvature is constant. */
static double next_step(const dynamics_continuation_range *t, double ds, double error, double turn)
{
    double growth = fmin(error > 0 ? sqrt(sqrt(predicted / error)) : 2, 0.8 * most_turn / turn);
    return fmin(ds * fmin(fmax(growth, 0.5), 1.6), t->step);
}

/* Returns whether the curve ends with this step, and sets the reason. The step may be shortened. */
static int ends_here(const dynamics_continuation_range *t, stride *w, const mark *start,
                     const mark *recent, const dynamics_curve *c, dynamics_curve_end *why)
{
    double slack = 1e-12, bound = w->to.lambda > t->high ? t->high : t->low;
    if (w->to.lambda > t->high + slack || w->to.lambda < t->low - slack) {
        *why = cut_at_bound(t, bound, w) ? DYNAMICS_END_RANGE : DYNAMICS_END_STUCK;
        return 1;
    }
    if (beyond_cap(t->flow->excitation, &w->to))
        *why = DYNAMICS_END_CAP;
    else if (meets_half_period(t, w))
        *why = DYNAMICS_END_HALVED;
    else if (c->count > 3 && passes_mark(t, w, start))
        *why = DYNAMICS_END_CLOSED;
    else if (c->count > FIRST_MARK + 3 && passes_mark(t, w, recent))
        *why = DYNAMICS_END_LOOP;
    else if (c->count >= MOST_POINTS)
        *why = DYNAMICS_END_CROWDED;
    else
        return 0;
    return 1;
}

/* Follows the curve in one direction from the start point and appends the points. */
static ff_status follow_one_way(const dynamics_continuation_range *t, const dynamics_orbit *orbit,
                                const dynamics_point *start, dynamics_curve *c,
                                dynamics_curve_end *why)
{
    double error = 0, turn = 0;
    mark first, recent;
    stride w = {.from = *start, .ds = first_step * t->step, .orbit = *orbit};
    memcpy(w.half, orbit->half, sizeof w.half);
    *why = DYNAMICS_END_STUCK;
    if (!set_mark(t->flow, orbit, &first))
        return FF_OK;
    recent = first;
    for (size_t i = 0;; i++) {
        if (i % 64 == 0 && t->host->progress(t->host->ctx, t->done))
            return FF_STOPPED;
        w.orbit.period = orbit->period;
        if (!try_stride(t, &w, &error, &turn)) {
            w.ds *= 0.5;
            if (w.ds < shortest_step * t->step)
                return FF_OK;
            continue;
        }
        double tangent[3];
        memcpy(tangent, w.to.tangent, sizeof tangent);
        w.to = point_of(t, &w.orbit);
        memcpy(w.to.tangent, tangent, sizeof tangent);
        int last = ends_here(t, &w, &first, &recent, c, why);
        int joins = last && (*why == DYNAMICS_END_HALVED || *why == DYNAMICS_END_CLOSED);
        if (joins && *why == DYNAMICS_END_CLOSED)
            w.to = *start;
        if (!joins && !add_events(t, &w, c))
            return FF_NOMEM;
        if (!append(c, &w.to))
            return FF_NOMEM;
        if (last)
            return FF_OK;
        /* Brent's method to detect a loop: the marked motion is replaced at each power of two */
        int power_of_two = (c->count & (c->count - 1)) == 0;
        if (c->count >= FIRST_MARK && power_of_two && !set_mark(t->flow, &w.orbit, &recent))
            return FF_OK;
        /* along a line of motions at one speed the cubic predictor would drift */
        w.before = fabs(w.to.fold) < noise ? 0 : w.ds;
        w.back = w.from;
        w.from = w.to;
        memcpy(w.half, w.orbit.half, sizeof w.half);
        w.ds = next_step(t, w.ds, error, turn);
    }
}

static void reverse_curve(dynamics_curve *c)
{
    for (size_t i = 0; i < c->count / 2; i++) {
        dynamics_point p = c->points[i];
        c->points[i] = c->points[c->count - 1 - i];
        c->points[c->count - 1 - i] = p;
    }
    for (size_t i = 0; i < c->count; i++)
        for (int k = 0; k < 3; k++)
            c->points[i].tangent[k] *= -1;
}

ff_status dynamics_curve_trace(const dynamics_continuation_range *t, const dynamics_orbit *orbit,
                               dynamics_curve *curve)
{
    dynamics_orbit o = *orbit;
    *curve = (dynamics_curve){
        .period = o.period, .first = DYNAMICS_END_STUCK, .last = DYNAMICS_END_STUCK};
    if (!dynamics_orbit_map(t->flow, &o))
        return FF_OK;
    dynamics_point start = point_of(t, &o);
    const double down[3] = {0, 0, -1};
    double unit = dynamics_state_unit(t->flow->excitation, start.x);
    if (!dynamics_curve_tangent(&o, unit, down, start.tangent))
        memcpy(start.tangent, down, sizeof down);
    if (!append(curve, &start))
        return FF_NOMEM;
    ff_status status = FF_OK;
    int at_low = start.lambda <= t->low, at_high = start.lambda >= t->high;
    curve->first = DYNAMICS_END_RANGE;
    if (!at_low && !at_high)
        status = follow_one_way(t, &o, &start, curve, &curve->first);
    if (status != FF_OK)
        return status;
    reverse_curve(curve);
    if (curve->first == DYNAMICS_END_CLOSED) {
        curve->last = DYNAMICS_END_CLOSED;
        return FF_OK;
    }
    if (!at_high)
        for (int k = 0; k < 3; k++)
            start.tangent[k] *= -1;
    return follow_one_way(t, &o, &start, curve, &curve->last);
}

int dynamics_curve_double(const dynamics_continuation_range *t, const dynamics_point *p, int period,
                          dynamics_orbit *orbit)
{
    static const double off = 1e-2;
    dynamics_frame f = dynamics_frame_at(t->flow->excitation, p);
    double border[3] = {p->direction[0], p->direction[1], 0};
    double z[3] = {off * border[0], off * border[1], 0};
    *orbit = (dynamics_orbit){.period = 2 * period};
    return dynamics_bordered_newton(t->flow, &f, border, tolerance, z, orbit) &&
           orbit->lambda > t->low && orbit->lambda < t->high;
}

/* Evaluates the Hermite cubic at the fraction x of the distance from a to z. `from` and `to` are
   the slopes at both ends. */
static double cubic_at(double a, double z, double from, double to, double x)
{
    return a + x * (from + x * (3 * (z - a) - 2 * from - to + x * (2 * (a - z) + from + to)));
}

/* Interpolates with a cubic, which follows the curve around a fold at either end. Linear
   interpolation would lead to the motion on the other side of the fold. */
void dynamics_curve_between(const dynamics_flow *flow, const dynamics_point *a,
                            const dynamics_point *z, double lambda, double state[2])
{
    enum { HALVINGS = 50 };
    double u = dynamics_state_unit(flow->excitation, a->x), low = 0, high = 1;
    double way[3] = {(z->x[0] - a->x[0]) / u, (z->x[1] - a->x[1]) / u, z->lambda - a->lambda};
    double length = sqrt(dynamics_dot(way, way));
    for (int i = 0; i < HALVINGS && z->lambda != a->lambda; i++) {
        double x = 0.5 * (low + high);
        double at =
            cubic_at(a->lambda, z->lambda, length * a->tangent[2], length * z->tangent[2], x);
        *((at < lambda) == (a->lambda < z->lambda) ? &low : &high) = x;
    }
    for (int i = 0; i < 2; i++)
        state[i] = cubic_at(a->x[i], z->x[i], length * a->tangent[i], length * z->tangent[i], low);
}

int dynamics_curve_solve(const dynamics_flow *flow, const dynamics_point *a,
                         const dynamics_point *z, double lambda, dynamics_orbit *orbit)
{
    orbit->lambda = lambda;
    dynamics_curve_between(flow, a, z, lambda, orbit->x);
    return dynamics_orbit_solve(flow, tolerance, orbit);
}

void dynamics_curve_free(dynamics_curve *curve)
{
    free(curve->points);
    curve->points = NULL;
}
