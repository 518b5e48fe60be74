/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-run.h"

#include "../../numerics/bracket.h"
#include "../../numerics/integrator.h"
#include "../excitation/spring.h"
#include "coupled-variation.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Longest step, in radians of the highest frequency. longest_coarse applies if the allowed error
   per step is `coarse` or more. */
static const double longest_step = 0.5, longest_coarse = 1.5, coarse = 1e-7;

/* An event is located when the absolute value of its gate is below this bound: a few round-off
   errors of the numbers whose difference is the gate. The first attempts aim at a tenth of the
   bound. Coarse integrations use closed_coarse. */
static const double closed = 1e-13, closed_coarse = 1e-10;

/* The integration fails after this many steps since the start. */
static const size_t step_limit = 10000000;

/* Smallest error per step, relative to the motion, that may be requested. */
static const double round_off = 1e-14;

/* An event is idle if it comes less than `slip` (rad) after the previous one. After MAX_IDLE idle
   events in a row the regime is kept for that time. */
enum { MAX_IDLE = 6 };
static const double slip = 1e-6;

struct dynamics_coupled_run {
    dynamics_field field;
    numerics_integrator gsl;
    gsl_odeiv2_system system;
    double y[DYNAMICS_COUPLED_SIZE];
    dynamics_variation *variation;
    int varies; /* 1: the derivatives with respect to the start are integrated too */
    size_t count;
    dynamics_stretch *stretches;
    double t;          /* time since the start of the stretch (coupled-field.h) */
    double longest, h; /* longest step; length of the next step */
    double closed;     /* `closed` or closed_coarse */
    double parted, back;
    size_t steps;
};

/* Returns an upper bound on the highest natural frequency: mesh and bearing springs on the lighter
   gear. */
static double highest_frequency(const dynamics_coupled *pair)
{
    double k = 2 * pair->excitation->k_max, highest = k;
    for (int i = 0; i < 2; i++)
        highest = fmax(highest, (k + pair->bearing[i]) / pair->mass[i]);
    return sqrt(highest + k);
}

static int by_start(const void *a, const void *z)
{
    double x = *(const double *)a, y = *(const double *)z;
    return (x > y) - (x < y);
}

/* Splits the pieces of the mesh cycle at the phase where a tooth pair of the mounted gears leaves
   the mesh. */
static int make_stretches(dynamics_coupled_run *run)
{
    const dynamics_coupled *pair = run->field.pair;
    const dynamics_excitation *excitation = pair->excitation;
    double end = pair->cycle[pair->nodes - 1], leaves = end - floor(end);
    double *node = malloc((excitation->count + 2) * sizeof *node);
    run->stretches = calloc(excitation->count + 1, sizeof *run->stretches);
    if (!node || !run->stretches) {
        free(node);
        return 0;
    }
    size_t count = 0;
    for (size_t i = 0; i < excitation->count; i++)
        node[count++] = excitation->pieces[i].start;
    if (leaves > 1e-9 && leaves < 1 - 1e-9)
        node[count++] = leaves;
    qsort(node, count, sizeof *node, by_start);
    node[count] = 1;
    for (size_t i = 0; i < count; i++) {
        double length = node[i + 1] - node[i];
        if (length < 1e-9 && i + 1 < count && node[i + 1] == leaves)
            node[i + 1] = node[i], length = 0; /* the phase is a node of the mesh already */
        if (length <= 0)
            continue;
        const dynamics_piece *piece =
            dynamics_excitation_piece(excitation, node[i] + 0.5 * length, 0);
        run->stretches[run->count++] = (dynamics_stretch){
            .piece = piece,
            .start = node[i],
            .length = length,
            .mounted = dynamics_coupled_mounted_pairs(pair, node[i] + 0.5 * length),
            .jump = piece->jump && node[i] == piece->start,
        };
    }
    free(node);
    return 1;
}

dynamics_coupled_run *dynamics_coupled_run_new(const dynamics_coupled *pair, double tolerance)
{
    dynamics_coupled_run *run = calloc(1, sizeof *run);
    if (!run)
        return NULL;
    run->field.pair = pair;
    run->longest = (tolerance < coarse ? longest_step : longest_coarse) / highest_frequency(pair);
    run->closed = tolerance < coarse ? 0.1 * closed : closed_coarse;
    run->system =
        (gsl_odeiv2_system){dynamics_field_slope, NULL, DYNAMICS_COUPLED_SIZE, &run->field};
    if (numerics_integrator_make(&run->gsl, DYNAMICS_COUPLED_SIZE, tolerance, round_off) &&
        make_stretches(run) &&
        (run->variation = dynamics_variation_new(&run->field, 0.1 * tolerance)))
        return run;
    dynamics_coupled_run_free(run);
    return NULL;
}

void dynamics_coupled_run_free(dynamics_coupled_run *run)
{
    if (!run)
        return;
    numerics_integrator_free(&run->gsl);
    dynamics_variation_free(run->variation);
    free(run->stretches);
    free(run);
}

/* Sets the flags of the flanks that touch: flanks touch if they overlap. */
static void set_contact(dynamics_coupled_run *run, const dynamics_place *place)
{
    dynamics_push p = dynamics_field_push(&run->field, run->t, run->y, place);
    double overlap[DYNAMICS_FLANKS];
    for (int i = 0; i < DYNAMICS_FLANKS; i++) {
        overlap[i] = p.overlap[i].value;
        run->field.regime.touches[i] = run->field.regime.pressed[i] = overlap[i] > 0;
    }
    dynamics_field_find_bands(&run->field, run->t, overlap);
}

/* Recomputes the bands of the springs at the start of a piece of the mesh cycle. */
static void set_bands(dynamics_coupled_run *run)
{
    dynamics_place place;
    double overlap[DYNAMICS_FLANKS];
    if (!dynamics_spring_bends(run->field.now->piece))
        return;
    dynamics_coupled_locate(run->field.pair, run->y, &place);
    dynamics_push p = dynamics_field_push(&run->field, run->t, run->y, &place);
    for (int i = 0; i < DYNAMICS_FLANKS; i++)
        overlap[i] = run->field.regime.touches[i] ? p.overlap[i].value : 0;
    dynamics_field_find_bands(&run->field, run->t, overlap);
}

void dynamics_coupled_start(dynamics_coupled_run *run, double T, const double *state)
{
    dynamics_place place;
    memcpy(run->y, state, DYNAMICS_TAKEN * sizeof *state);
    run->y[DYNAMICS_TAKEN] = 0;
    run->field.T = T;
    run->t = 0;
    run->field.now = run->stretches;
    run->steps = 0;
    run->parted = run->back = 0;
    dynamics_coupled_locate(run->field.pair, run->y, &place);
    run->field.regime.pairs = dynamics_coupled_pairs(&place, 0);
    run->field.regime.pairs.youngest--; /* pair numbers as before the start of the mesh cycle, where
                                           they increase by 1 */
    run->field.regime.pairs.oldest--;
    set_contact(run, &place);
    run->varies = 0;
}

void dynamics_coupled_start_varied(dynamics_coupled_run *run, double T, const double *state)
{
    dynamics_coupled_start(run, T, state);
    dynamics_variation_start(run->variation);
    run->varies = 1;
}

const double *dynamics_coupled_monodromy(const dynamics_coupled_run *run)
{
    return dynamics_variation_matrix(run->variation);
}

const double *dynamics_coupled_state(const dynamics_coupled_run *run)
{
    return run->y;
}

void dynamics_coupled_clocks(const dynamics_coupled_run *run, double *parted, double *back)
{
    *parted = run->parted;
    *back = run->back;
}

double dynamics_coupled_energy(const dynamics_coupled_run *run, double *kinetic)
{
    const double *v = run->y + DYNAMICS_RATES, *m = run->field.pair->mass;
    *kinetic = 0.5 * (v[DYNAMICS_Q] * v[DYNAMICS_Q] +
                      m[0] * (v[DYNAMICS_X1] * v[DYNAMICS_X1] + v[DYNAMICS_Y1] * v[DYNAMICS_Y1]) +
                      m[1] * (v[DYNAMICS_X2] * v[DYNAMICS_X2] + v[DYNAMICS_Y2] * v[DYNAMICS_Y2]));
    return *kinetic - run->field.pair->excitation->load * run->y[DYNAMICS_Q] +
           run->y[DYNAMICS_TAKEN];
}

static void attempt(dynamics_coupled_run *run, double h, double *y, double *error)
{
    memcpy(y, run->y, sizeof run->y);
    if (gsl_odeiv2_step_apply(run->gsl.step, run->t, h, y, error, NULL, NULL, &run->system))
        y[0] = NAN;
    error[DYNAMICS_TAKEN] = 0;
    run->steps++;
}

/* A step of duration h from the state of the integrator, and an event within the step. */
typedef struct event {
    double at; /* time since the start of the step */
    int gate;
    double state[DYNAMICS_COUPLED_SIZE]; /* state at `at`, if `at` is above 0 */
} event;

static double gate_on_course(const dynamics_coupled_run *run, const dynamics_course *course, int i,
                             double share)
{
    double y[DYNAMICS_COUPLED_SIZE], gate[DYNAMICS_GATES];
    dynamics_course_state(course, share, y);
    dynamics_field_gates(&run->field, run->t + share * course->h, y, gate);
    return gate[i];
}

/* Returns the value of the event's gate after a trial step to that time. */
static double gate_after(dynamics_coupled_run *run, double h, event *e)
{
    double error[DYNAMICS_COUPLED_SIZE], gate[DYNAMICS_GATES];
    attempt(run, h, e->state, error);
    dynamics_field_gates(&run->field, run->t + h, e->state, gate);
    e->at = h;
    return gate[e->gate];
}

/* Most attempts to locate the event. Bisection takes over after MAX_SECANTS attempts. */
enum { MAX_PROBES = 80, MAX_SECANTS = 40, MAX_CORRECTIONS = 4 };

/* Returns the next fraction of the step to try. */
static double next_probe(const numerics_bracket *b, int n)
{
    double middle = numerics_bracket_secant(b);
    return middle > b->low && middle < b->high && n <= MAX_SECANTS
               ? middle
               : b->low + 0.5 * (b->high - b->low);
}

/* Finds the time at which the event's gate closes, given a bracket in fractions of the step. The
   polynomials of the step give a first estimate, which trial steps correct with the slope of the
   gate. If these do not converge, trial steps narrow the bracket. */
static void find_closing(dynamics_coupled_run *run, const dynamics_course *course,
                         numerics_bracket b, event *e)
{
    static const double near = 1e-9, apart = 1e-4; /* in fractions of the step */
    numerics_bracket wide = b;
    double share = b.high, f = b.f_high;
    for (int n = 0; n < MAX_PROBES && b.high - b.low > near && fabs(f) > closed; n++) {
        share = next_probe(&b, n);
        f = gate_on_course(run, course, e->gate, share);
        numerics_bracket_narrow(&b, share, f);
    }
    double slope = (gate_on_course(run, course, e->gate, share + apart) -
                    gate_on_course(run, course, e->gate, share - apart)) /
                   (2 * apart);
    for (int n = 0; n < MAX_CORRECTIONS && share > wide.low && share <= wide.high; n++) {
        f = gate_after(run, share * course->h, e);
        if (fabs(f) < run->closed || (n + 1 == MAX_CORRECTIONS && fabs(f) < closed))
            return;
        share -= f / slope;
    }
    for (int n = 0; n < MAX_PROBES && wide.high - wide.low > 4 * DBL_EPSILON; n++) {
        share = next_probe(&wide, n);
        f = gate_after(run, share * course->h, e);
        if (fabs(f) < closed)
            return;
        numerics_bracket_narrow(&wide, share, f);
    }
    gate_after(run, wide.high * course->h, e);
}

/* Finds the first gate that closes in the step of h to y. A gate that is open at both ends but may
   fall below 0 between them is also checked in the middle. */
static int find_event(dynamics_coupled_run *run, double h, const double *y, event *first)
{
    double a[DYNAMICS_GATES], z[DYNAMICS_GATES], m[DYNAMICS_GATES], middle[DYNAMICS_COUPLED_SIZE];
    int found = 0, dips = 0, closes = 0;
    dynamics_course course;
    dynamics_field_gates(&run->field, run->t, run->y, a);
    dynamics_field_gates(&run->field, run->t + h, y, z);
    for (int i = 0; i < DYNAMICS_COMES; i++) /* the motion may leave and return near the edge of the
                                                gap during the step */
        dips |= z[i] >= 0 &&
                fmin(a[i], z[i]) < 0.5 * h * h * (1 + fabs(run->field.pair->excitation->load));
    for (int i = 0; i < DYNAMICS_GATES; i++)
        closes |= z[i] < 0;
    if (dips || closes)
        dynamics_course_find(&run->field, run->t, h, run->y, y, &course);
    if (dips) {
        dynamics_course_state(&course, 0.5, middle);
        dynamics_field_gates(&run->field, run->t + 0.5 * h, middle, m);
    }
    for (int i = 0; i < DYNAMICS_GATES; i++) {
        numerics_bracket b = {0, a[i], 1, z[i], 0};
        if (dips && i < DYNAMICS_COMES && z[i] >= 0 && m[i] < 0 && a[i] > 0)
            b = (numerics_bracket){0, a[i], 0.5, m[i], 0};
        if (b.f_high >= 0)
            continue;
        event e = {.at = 0, .gate = i};
        if (a[i] > 0)
            find_closing(run, &course, b, &e);
        if (!found || e.at < first->at)
            *first = e;
        found = 1;
    }
    return found;
}

static void accept_step(dynamics_coupled_run *run, double h, const double *y)
{
    const dynamics_regime *r = &run->field.regime;
    int driving = r->touches[DYNAMICS_DRIVING] && r->pressed[DYNAMICS_DRIVING];
    int back = r->touches[DYNAMICS_BACK] && r->pressed[DYNAMICS_BACK];
    if (run->varies)
        dynamics_variation_step(run->variation, run->t, h, run->y, y);
    memcpy(run->y, y, sizeof run->y);
    run->t += h;
    run->parted += driving || back ? 0 : h;
    run->back += back ? h : 0;
}

static void pass_gate(dynamics_coupled_run *run, int gate)
{
    if (run->varies)
        dynamics_variation_pass_gate(run->variation, gate, run->t, run->y);
    else
        dynamics_field_pass_gate(&run->field, gate);
}

/* Integrates to the instant `end` of the stretch. Returns 0 if there are too many steps. */
static int advance_to(dynamics_coupled_run *run, double end)
{
    static const double no_slope[DYNAMICS_COUPLED_SIZE] = {0};
    double y[DYNAMICS_COUPLED_SIZE], error[DYNAMICS_COUPLED_SIZE];
    int idle = 0;
    event e;
    while (run->t < end) {
        double h = fmin(run->h, run->longest), left = end - run->t, next;
        if (run->steps > step_limit)
            return 0;
        h = idle > MAX_IDLE ? fmin(h, slip) : h;
        int last = h >= left * (1 - 1e-9);
        h = last ? left : fmin(h, 0.5 * left + 0.5 * h);
        attempt(run, h, y, error);
        if (!isfinite(y[0]))
            return 0;
        next = h;
        int adjusted =
            gsl_odeiv2_control_hadjust(run->gsl.control, run->gsl.step, y, error, no_slope, &next);
        if (adjusted == GSL_ODEIV_HADJ_DEC && h > 1e-9) {
            run->h = next;
            continue;
        }
        if (idle <= MAX_IDLE && find_event(run, h, y, &e)) {
            if (e.at > 0)
                accept_step(run, e.at, e.state);
            idle = e.at > slip ? 0 : idle + 1;
            pass_gate(run, e.gate);
            continue;
        }
        accept_step(run, h, y);
        idle = 0;
        run->h = adjusted == GSL_ODEIV_HADJ_INC ? fmax(run->h, next) : run->h;
        if (last)
            run->t = end;
    }
    return 1;
}

/* Enters a stretch. A jump of e gives an impulse of 2 zeta times the jump through each active
   damper. */
static void enter_stretch(dynamics_coupled_run *run, const dynamics_stretch *next)
{
    const dynamics_coupled *pair = run->field.pair;
    const dynamics_piece *before = run->field.now->piece;
    double since = run->field.now->start + run->field.now->length - before->start;
    double old = dynamics_piece_value(before->e, before->degree, since);
    dynamics_place place;
    run->field.now = next;
    run->t = 0;
    if (!next->jump) {
        set_bands(run);
        return;
    }
    double leap = next->piece->e[0] - old, before_leap, after_leap;
    dynamics_coupled_energy(run, &before_leap);
    dynamics_coupled_locate(pair, run->y, &place);
    dynamics_push p = dynamics_field_push(&run->field, 0, run->y, &place);
    dynamics_overlap open =
        dynamics_coupled_overlap(pair, &place, 0, run->y, run->y + DYNAMICS_RATES, 0, 0);
    for (int i = 0; i <= DYNAMICS_FLANKS; i++) {
        const dynamics_overlap *o = i < DYNAMICS_FLANKS ? &p.overlap[i] : &open;
        if (!dynamics_field_damps(&run->field, i))
            continue;
        double impulse = 2 * pair->excitation->zeta * leap * o->gradient[DYNAMICS_Q];
        for (int k = 0; k < DYNAMICS_COORDINATES; k++)
            run->y[DYNAMICS_RATES + k] +=
                impulse * o->gradient[k] / (k == DYNAMICS_Q ? 1 : pair->mass[k >= DYNAMICS_X2]);
        if (run->varies)
            dynamics_variation_leap(run->variation, i, leap, &place);
    }
    dynamics_coupled_energy(run, &after_leap);
    run->y[DYNAMICS_TAKEN] -= after_leap - before_leap;
    set_contact(run, &place);
}

static void add_sample(const dynamics_coupled_run *run, double phase,
                       dynamics_coupled_record *record)
{
    if (record->count == record->capacity)
        return;
    const dynamics_coupled *pair = run->field.pair;
    dynamics_place place;
    dynamics_coupled_locate(pair, run->y, &place);
    dynamics_push p = dynamics_field_push(&run->field, run->t, run->y, &place);
    dynamics_overlap s =
        dynamics_coupled_overlap(pair, &place, 0, run->y, run->y + DYNAMICS_RATES, 0, 0);
    dynamics_coupled_sample sample = {.excitation = {.phase = (double)record->cycles + phase,
                                                     .s = s.value,
                                                     .s_rate = s.rate,
                                                     .force = p.force},
                                      .overlap = p.overlap[DYNAMICS_DRIVING].value,
                                      .overlap_rate = p.overlap[DYNAMICS_DRIVING].rate,
                                      .centre = place.centre,
                                      .contact_ratio = place.exit - place.entry};
    memcpy(sample.position, run->y, sizeof sample.position);
    record->samples[record->count++] = sample;
}

/* Integrates over a stretch; if there is a record, from sample to sample. */
static int pass_stretch(dynamics_coupled_run *run, size_t *next, dynamics_coupled_record *record)
{
    const dynamics_stretch *now = run->field.now;
    double n = record ? (double)record->per_cycle : 0, end = now->start + now->length;
    for (; record && (double)*next / n < end - 1e-12; ++*next) {
        double phase = (double)*next / n;
        if (phase <= now->start + 1e-12)
            continue;
        if (!advance_to(run, (phase - now->start) * run->field.T))
            return 0;
        add_sample(run, phase, record);
    }
    return advance_to(run, now->length * run->field.T);
}

int dynamics_coupled_cycle(dynamics_coupled_run *run, double T, dynamics_coupled_record *record)
{
    size_t next = 0;
    const dynamics_stretch *last = &run->stretches[run->count - 1];
    run->field.now = last;
    run->field.T = T;
    run->h = run->longest;
    run->field.regime.pairs.youngest++;
    run->field.regime.pairs.oldest++;
    for (size_t i = 0; i < run->count; i++) {
        const dynamics_stretch *s = &run->stretches[i];
        enter_stretch(run, s);
        if (record && (s->jump || (i == 0 && record->cycles == 0)))
            add_sample(run, s->start, record);
        if (!pass_stretch(run, &next, record))
            return 0;
        double end = s->start + s->length, node = end * (record ? (double)record->per_cycle : 0);
        int jump = run->stretches[(i + 1) % run->count].jump;
        if (record && (jump || s == last || fabs(node - round(node)) < 1e-9))
            add_sample(run, end, record);
    }
    if (record)
        record->cycles++;
    return 1;
}

int dynamics_coupled_record_init(dynamics_coupled_record *record, const dynamics_coupled *pair,
                                 size_t per_cycle, size_t cycles)
{
    size_t capacity = (per_cycle + 4 + 2 * pair->excitation->count) * cycles;
    *record = (dynamics_coupled_record){.per_cycle = per_cycle, .capacity = capacity};
    record->samples = calloc(capacity, sizeof *record->samples);
    return record->samples != NULL;
}
