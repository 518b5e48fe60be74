/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh stiffness that was measured or computed elsewhere, as a table over one mesh cycle. */
#include "cubic-fit.h"
#include "inputs.h"
#include "outputs.h"
#include "path-inputs.h"
#include "references.h"
#include "table-levels.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One column as a function of phase; `before` and `after` are slopes of cubics. */
typedef struct curve {
    const double *value;
    double *before, *after;
    stiffness_cubic_fit fit;
} curve;

/* The table as functions of phase, for one evaluation. */
typedef struct table_curves {
    const stiffness_table *table;
    double contact_ratio;
    double secant_of; /* if not 0, the stiffness is this force, N, over the deflection; if 0, the
                         curve k is the stiffness */
    curve k, error, loaded, share;
} table_curves;

static const ff_param params[] = {
    FF_PATH("file", stiffness_table, path, FF_REQUIRED, "source",
            "table with the columns phase and stiffness [N/m], or phase, transmission_error [um] "
            "and loaded_transmission_error [um], from which k = F/(e_l - e). With stiffness, "
            "transmission_error is also allowed, and with definition: tangent both errors. The "
            "column load_share is used if the parameter load_share is file. With a column force "
            "[N]: rows for increasing forces from 0, with loaded_transmission_error and, with "
            "definition: tangent, the slope as stiffness"),
    FF_LIST("phase", "1", stiffness_table, phase, FF_REQUIRED | FF_INCREASING, NULL, "source", 0, 1,
            0, 0, 1, 100000,
            "phases of the mesh cycle, 0 = the entering pair at SAP; a repeated phase has the "
            "values before and after a jump; with ends: jump, phases 1 and 0 have the values "
            "before and after a jump"),
    FF_LIST("stiffness", "N/m", stiffness_table, stiffness, FF_MIN_OPEN, NULL, NULL, 0, 1e15, 1e5,
            1e11, 1, 100000, "mesh stiffness along the line of action at these phases"),
    FF_ONE_OF("linear|cubic|fitted", "interpolation", stiffness_table, interpolation, 0, "linear",
              "interpolation between the phases: linear; cubic: the piecewise cubic of Steffen, "
              "which has a continuous slope between jumps and stays between neighbouring values; "
              "fitted: least-squares piecewise cubics, for tables of many noisy samples"),
    FF_ONE_OF("rigid|file", "load_share", stiffness_table, load_share, 0, "rigid",
              "rigid: the pairs in contact carry equal shares; file: the column load_share gives "
              "the share of the pair that entered last, and the previous pair carries the rest"),
    FF_COUNT("points", stiffness_table, points, FF_TUNABLE, "200", NULL, 4, 100000, 0, 0,
             "number of equal steps of the mesh cycle at which the outputs are given, in addition "
             "to the table's own phases"),
    FF_ONE_OF("secant|tangent", "definition", stiffness_table, definition, 0, "secant",
              "definition of the given stiffness: secant F/(e_l - e), or tangent dF/d(e_l). With "
              "tangent the file may also give loaded_transmission_error; without it the tangent is "
              "used as the secant"),
    FF_QUANTITY("tolerance", "1", stiffness_table, tolerance, FF_MIN_OPEN | FF_TUNABLE, "0.01",
                NULL, 0, 1, 0, 0,
                "largest allowed deviation of the fitted cubics from a sample, relative to the "
                "range of the samples"),
    FF_LIST("corners", "1", stiffness_table, corner, FF_INCREASING, NULL, NULL, 0, 1, 0, 0, 1, 200,
            "phases of the table at which the slope of the fitted cubics may jump; repeated phases "
            "are corners in any case"),
    FF_ONE_OF("periodic|jump", "ends", stiffness_table, ends, 0, "periodic",
              "treatment of the stiffness at phases 1 and 0 if the table gives both. periodic: a "
              "difference above 5 % of its range is refused; jump: the stiffness jumps there, for "
              "example because a pair enters"),
};

static void destroy(void *self)
{
    stiffness_table *t = self;
    if (!t)
        return;
    stiffness_table_phases_free(&t->distinct);
    free(t->corner_at);
    free(t);
}

static ff_status ready(void *self)
{
    const stiffness_table *t = self;
    ff_status status = stiffness_table_samples(self);
    const ff_serving rows[] = {
        {t->share && t->load_share == RIGID, "file.load_share", "", NULL, "load_share is rigid"},
        {t->interpolation != FITTED, "tolerance", "", NULL, "interpolation is not fitted"},
        {t->interpolation != FITTED, "corners", "", NULL, "interpolation is not fitted"},
    };
    ff_serve(t->host, rows, sizeof rows / sizeof rows[0]);
    return status;
}

static bool curve_make(const stiffness_table *t, const double *value, curve *c)
{
    *c = (curve){.value = value};
    if (t->interpolation == LINEAR || !value)
        return true;
    if (t->interpolation == FITTED) {
        bool made = stiffness_cubic_fit_make(&c->fit, &t->distinct, t->count, value, t->corner_at,
                                             t->tolerance);
        c->value = c->fit.value;
        return made;
    }
    c->before = malloc(t->distinct.count * sizeof *c->before);
    c->after = malloc(t->distinct.count * sizeof *c->after);
    if (!c->before || !c->after)
        return false;
    stiffness_steffen_slopes(&t->distinct, value, c->before, c->after);
    return true;
}

static void curve_free(curve *c)
{
    free(c->before);
    free(c->after);
    stiffness_cubic_fit_free(&c->fit);
    *c = (curve){0};
}

static double curve_at(const stiffness_table *t, const curve *c, double phase, int side)
{
    if (t->interpolation == LINEAR)
        return stiffness_linear_at(&t->distinct, c->value, phase, side);
    if (t->interpolation == FITTED)
        return stiffness_cubic_at(&t->distinct, c->value, c->fit.before, c->fit.after, phase, side);
    return stiffness_cubic_at(&t->distinct, c->value, c->before, c->after, phase, side);
}

static double stiffness_at(const void *self, double phase, int side)
{
    const table_curves *s = self;
    if (s->secant_of > 0)
        return s->secant_of / (curve_at(s->table, &s->loaded, phase, side) -
                               curve_at(s->table, &s->error, phase, side));
    return curve_at(s->table, &s->k, phase, side);
}

/* The age of the pair that entered last equals the phase. */
static double share(const void *self, double age, double phase, int side)
{
    const table_curves *s = self;
    if (s->table->load_share == RIGID)
        return 1 / (double)stiffness_pairs(s->contact_ratio, phase, side);
    double last = curve_at(s->table, &s->share, phase, side);
    return age - phase < 0.5 ? last : 1 - last;
}

/* Lists the phases of the table, and the phase at which the oldest pair leaves and the number of
   pairs jumps. */
static size_t list_cycle_breakpoints(const stiffness_table *t, double contact_ratio,
                                     const double *k, stiffness_breakpoint *breaks)
{
    double leaves = stiffness_phase_of(contact_ratio, STIFFNESS_ABOVE);
    bool placed = !(leaves > 0);
    size_t n = 0;
    for (size_t i = 0; i < t->distinct.count; i++) {
        double phase = t->distinct.phase[i];
        bool near = fabs(phase - leaves) <= STIFFNESS_PHASE_TOLERANCE;
        if (!placed && !near && leaves < phase)
            breaks[n++] = (stiffness_breakpoint){leaves, true};
        placed = placed || near || leaves < phase;
        bool jump = stiffness_jumps_at(&t->distinct, k, i) ||
                    (t->error && stiffness_jumps_at(&t->distinct, t->error, i)) ||
                    (t->k && t->loaded && stiffness_jumps_at(&t->distinct, t->loaded, i));
        breaks[n++] = (stiffness_breakpoint){phase, jump || near};
    }
    if (!placed)
        breaks[n++] = (stiffness_breakpoint){leaves, true};
    return n;
}

/* Lists the phases at which an integration over the mesh cycle must be split: jumps of k and e and,
   with linear interpolation, changes of their slope. */
static size_t list_output_breakpoints(const stiffness_table *t, const double *k, double *phase)
{
    bool (*is_break)(const stiffness_table_phases *, const double *, size_t) =
        t->interpolation == LINEAR ? stiffness_slope_changes_at : stiffness_jumps_at;
    size_t n = 0;
    for (size_t i = 0; i < t->distinct.count; i++)
        if (is_break(&t->distinct, k, i) || (t->error && is_break(&t->distinct, t->error, i)) ||
            (t->k && t->loaded && is_break(&t->distinct, t->loaded, i)) ||
            (t->interpolation == FITTED && t->corner_at[i]))
            phase[n++] = t->distinct.phase[i];
    return n;
}

/* Computes k at the samples, from the transmission errors if the table gives these. */
static ff_status sample_stiffness(const stiffness_table *t, const stiffness_path *e, double *k)
{
    for (size_t i = 0; i < t->count; i++)
        k[i] = t->k ? t->k[i] : e->line_force / (t->loaded[i] - t->error[i]);
    for (size_t i = 0; i < t->count; i++)
        if (!(k[i] > 0 && isfinite(k[i])))
            return ff_failf(t->host, FF_INVALID, "operating.line_force",
                            "a stiffness from transmission errors needs a load: F = %g N gives %g "
                            "N/m at phase %g",
                            e->line_force, k[i], t->at[i]);
    return FF_OK;
}

/* Work space of one evaluation. */
typedef struct table_work {
    double *sample, *stiffness, *error, *loaded, *breakpoint;
    stiffness_breakpoint *breaks;
    stiffness_cycle cycle;
    table_curves curves;
    stiffness_table_levels levels;
} table_work;

static bool work_make(const stiffness_table *t, table_work *w)
{
    size_t n = t->distinct.count + 1;
    w->sample = malloc(t->count * sizeof *w->sample);
    w->breaks = malloc(n * sizeof *w->breaks);
    w->breakpoint = malloc(n * sizeof *w->breakpoint);
    return w->sample && w->breaks && w->breakpoint;
}

static void work_free(table_work *w)
{
    free(w->sample);
    free(w->stiffness);
    free(w->error);
    free(w->loaded);
    free(w->breakpoint);
    free(w->breaks);
    stiffness_cycle_free(&w->cycle);
    curve_free(&w->curves.k);
    curve_free(&w->curves.error);
    curve_free(&w->curves.loaded);
    curve_free(&w->curves.share);
    stiffness_table_levels_free(&w->levels);
}

/* Computes k and e at the points of the mesh cycle. */
static ff_status sample_cycle(const stiffness_table *t, table_work *w)
{
    table_curves *s = &w->curves;
    /* without k, or with levels, the stiffness follows from the error under load */
    const double *loaded = t->k || t->forces ? t->loaded : NULL;
    size_t breaks = list_cycle_breakpoints(t, s->contact_ratio, w->sample, w->breaks);
    if (!curve_make(t, w->sample, &s->k) || !curve_make(t, t->error, &s->error) ||
        !curve_make(t, loaded, &s->loaded) || !curve_make(t, t->share, &s->share) ||
        !stiffness_cycle_make(&w->cycle, (size_t)t->points, breaks, w->breaks))
        return FF_NOMEM;
    w->stiffness = malloc(w->cycle.count * sizeof *w->stiffness);
    w->error = malloc(w->cycle.count * sizeof *w->error);
    w->loaded = loaded ? malloc(w->cycle.count * sizeof *w->loaded) : NULL;
    if (!w->stiffness || !w->error || (loaded && !w->loaded))
        return FF_NOMEM;
    for (size_t i = 0; i < w->cycle.count; i++) {
        int side = stiffness_cycle_side(&w->cycle, i);
        w->stiffness[i] = stiffness_at(s, w->cycle.phase[i], side);
        w->error[i] = t->error ? curve_at(t, &s->error, w->cycle.phase[i], side) : 0;
        if (loaded)
            w->loaded[i] = curve_at(t, &s->loaded, w->cycle.phase[i], side);
        if (!(w->stiffness[i] > 0))
            return ff_failf(t->host, FF_INVALID, "tolerance",
                            "the fitted cubics fall to %g N/m at phase %g; reduce tolerance, or "
                            "give corners",
                            w->stiffness[i], w->cycle.phase[i]);
    }
    return FF_OK;
}

static void report_fit(const stiffness_table *t, const table_curves *s)
{
    if (t->interpolation != FITTED)
        return;
    double error = fmax(s->k.fit.error, fmax(s->error.fit.error, s->share.fit.error));
    int held = error <= t->tolerance;
    t->host->quality(t->host->ctx, "fit_error", error, t->tolerance, held ? FF_GOOD : FF_DOUBTFUL,
                     held ? "largest distance of the fitted cubics from the samples, over the "
                            "range of the samples"
                          : "largest distance of the fitted cubics from the samples, over the "
                            "range of the samples: corners or jumps are missing, or the tolerance "
                            "is below the noise");
}

static ff_status check_sharing(const stiffness_table *t, const stiffness_path *e)
{
    if (t->load_share == RIGID || e->contact_ratio <= 2 + STIFFNESS_PHASE_TOLERANCE)
        return FF_OK;
    return ff_failf(t->host, FF_UNSUPPORTED, "load_share",
                    "the share of the entering pair determines all shares only for contact ratios "
                    "up to 2; the contact ratio is %.6g",
                    e->contact_ratio);
}

/* Fills in one row of the levels, each of which has `stations` tooth forces. */
static ff_status fill_level(const table_curves *at, const stiffness_path *path,
                            const stiffness_cycle *cycle, double force, const double *slopes,
                            double *rows[3])
{
    const stiffness_table *t = at->table;
    curve slope = {0};
    if (!curve_make(t, slopes, &slope)) {
        curve_free(&slope);
        return FF_NOMEM;
    }
    for (size_t i = 0; i < cycle->count; i++) {
        int side = stiffness_cycle_side(cycle, i);
        *rows[0]++ = curve_at(t, &at->error, cycle->phase[i], side);
        *rows[1]++ = curve_at(t, &slope, cycle->phase[i], side);
    }
    for (size_t i = 0; i < path->stations; i++) {
        int side;
        double age = stiffness_station_age(path, i, &side);
        *rows[2]++ = force > 0 ? force * share(at, age, stiffness_phase_of(age, side), side) : 0;
    }
    curve_free(&slope);
    return FF_OK;
}

/* Writes the levels; a table at one force has one level, 0. */
static ff_status publish_levels(const stiffness_table *t, const table_work *w, uint64_t wanted,
                                const stiffness_path *path)
{
    const ff_host *host = t->host;
    const stiffness_table_levels *l = &w->levels;
    const size_t count = l->count ? l->count : 1, n = w->cycle.count;
    if (!(wanted >> STIFFNESS_OUT_FORCE_LEVEL))
        return FF_OK;
    double *force = ff_put_series(host, STIFFNESS_OUT_FORCE_LEVEL, count);
    double *error = host->output(host->ctx, STIFFNESS_OUT_LEVEL_ERROR, 2, (size_t[]){count, n});
    double *slope = host->output(host->ctx, STIFFNESS_OUT_LEVEL_STIFFNESS, 2, (size_t[]){count, n});
    double *teeth = host->output(host->ctx, STIFFNESS_OUT_LEVEL_TOOTH_FORCE, 2,
                                 (size_t[]){count, path->stations});
    ff_status status = FF_OK;
    if (!force || !error || !slope || !teeth)
        return FF_NOMEM;
    if (!l->count) {
        force[0] = 0;
        memcpy(error, w->error, n * sizeof *error);
        memcpy(slope, w->stiffness, n * sizeof *slope);
        memset(teeth, 0, path->stations * sizeof *teeth);
        return FF_OK;
    }
    double *rows[3] = {error, slope, teeth};
    for (size_t k = 0; k < count && status == FF_OK; k++) {
        table_curves at = {.table = t, .contact_ratio = path->contact_ratio};
        bool made = curve_make(t, l->error + k * t->count, &at.error) &&
                    curve_make(t, l->share ? l->share + k * t->count : NULL, &at.share);
        force[k] = l->force[k];
        status = made ? fill_level(&at, path, &w->cycle, force[k], l->slope + k * t->count, rows)
                      : FF_NOMEM;
        curve_free(&at.error);
        curve_free(&at.share);
    }
    return status;
}

/* For a table at several forces, replaces the loaded samples by those under the line force. */
static ff_status take_levels(stiffness_table *t, double line_force, table_work *w)
{
    ff_status status = stiffness_table_levels_make(t, line_force, &w->levels);
    if (status != FF_OK)
        return status;
    size_t from = w->levels.mean * t->count;
    t->loaded = w->levels.error + from;
    t->share = w->levels.share ? w->levels.share + from : NULL;
    t->k = t->definition == TANGENT ? w->levels.slope + from : NULL;
    w->curves.secant_of = t->definition == TANGENT ? 0 : line_force;
    return FF_OK;
}

/* limits for the sum of the shares: rounding, or the accuracy of the numbers in a file */
static const double rounding = 1e-12, balance_of_file = 0.02;

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    stiffness_table at_load = *(const stiffness_table *)self, *t = &at_load;
    stiffness_path path;
    table_work w = {0};
    ff_status status = stiffness_path_read(t->host, in, &path);
    if (status == FF_OK)
        status = check_sharing(t, &path);
    if (status != FF_OK)
        return status;
    w.curves = (table_curves){.table = t, .contact_ratio = path.contact_ratio};
    if (t->forces)
        status = take_levels(t, path.line_force, &w);
    if (status == FF_OK)
        status = work_make(t, &w) ? sample_stiffness(t, &path, w.sample) : FF_NOMEM;
    if (status == FF_OK)
        status = sample_cycle(t, &w);
    if (status != FF_OK)
        goto out;
    stiffness_result result = {
        .cycle = w.cycle,
        .stiffness = w.stiffness,
        .error = w.error,
        .loaded = w.loaded,
        .breakpoints = list_output_breakpoints(t, w.sample, w.breakpoint),
        .breakpoint = w.breakpoint,
        .stiffness_at = stiffness_at,
        .share = share,
        .self = &w.curves,
        .balance = t->load_share == RIGID ? rounding : balance_of_file,
    };
    report_fit(t, &w.curves);
    status = stiffness_result_publish(t->host, wanted, &result, &path);
    if (status == FF_OK)
        status = publish_levels(t, &w, wanted, &path);
out:
    work_free(&w);
    return status;
}

FF_MODEL(stiffness_table_model, stiffness_table, .id = "stiffness/table", .version = "1.0.0",
         .summary = "mesh stiffness from a table over one mesh cycle",
         .reference = "Steffen 1990, Astron. Astrophys. 239, 443-450 (the cubic interpolation)",
         .bibtex = BIB_steffen1990, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = stiffness_inputs, .input_count = STIFFNESS_PATH_INPUTS,
         .input_stride = sizeof stiffness_inputs[0], .outputs = stiffness_outputs,
         .output_count = STIFFNESS_LEVEL_OUTPUTS, .output_stride = sizeof stiffness_outputs[0],
         .ready = ready, .evaluate = evaluate, .destroy = destroy,
         .columns = FF_TABLE(stiffness_table_columns));
FF_EXPORT_MODELS(&stiffness_table_model);
