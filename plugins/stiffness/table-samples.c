/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and checks the samples of stiffness/table. */
#include "table-samples.h"

#include "cycle.h"
#include "table-levels.h"

#include <math.h>
#include <stdlib.h>

const ff_param stiffness_table_columns[STIFFNESS_TABLE_COLUMNS] = {
    FF_ROW("phase", "1", "phase in mesh cycles, from 0 to 1", FF_REALS, FF_REQUIRED, NULL, NULL,
           NULL, 0, 0, 0, 0, 0, 100000, 0),
    FF_COLUMN("stiffness", "N/m", 0, NULL, 0, 0, "mesh stiffness"),
    FF_COLUMN("transmission_error", "um", 0, NULL, 0, 0, "transmission error without load"),
    FF_COLUMN("loaded_transmission_error", "um", 0, NULL, 0, 0,
              "loaded transmission error, under the load of the operating point"),
    FF_COLUMN("load_share", "1", 0, NULL, 0, 0, "load share of the pair that entered last"),
    FF_COLUMN("force", "N", 0, NULL, 0, 0,
              "mesh force for loaded_transmission_error of the row, increasing from 0"),
    FF_COLUMN("torque", "N m", 0, NULL, 0, 0, "not used; give the column force instead"),
};

static ff_status use_lists(stiffness_table *t)
{
    if (t->phase.count == 0)
        return ff_failf(t->host, FF_INVALID, "file",
                        "a table is needed: file, or the lists phase and stiffness");
    if (t->stiffness.count == 0)
        return ff_failf(t->host, FF_INVALID, "stiffness", "phase is given, stiffness is missing");
    if (t->phase.count != t->stiffness.count)
        return ff_failf(t->host, FF_INVALID, "stiffness",
                        "%zu values for %zu phases; both lists must have the same length",
                        t->stiffness.count, t->phase.count);
    if (t->load_share == FROM_FILE)
        return ff_failf(t->host, FF_INVALID, "load_share",
                        "load_share: file needs a file with a column load_share");
    t->count = t->phase.count;
    t->at = t->phase.data;
    t->k = t->stiffness.data;
    return FF_OK;
}

static ff_status use_columns(stiffness_table *t)
{
    const double *const *column = t->file->columns;
    t->count = t->file->row_count;
    t->at = column[COLUMN_PHASE];
    t->k = column[COLUMN_STIFFNESS];
    t->error = column[COLUMN_ERROR];
    t->loaded = column[COLUMN_LOADED];
    t->share = column[COLUMN_SHARE];
    if (column[COLUMN_TORQUE])
        return ff_table_failf(t->host, t->file, FF_TABLE_ALL, COLUMN_TORQUE,
                              "give the mesh force, force [N], instead: the torque divided by the "
                              "base radius of its gear");
    if (t->load_share == FROM_FILE && !t->share)
        return ff_failf(t->host, FF_INVALID, "load_share", "the file has no column load_share");
    if (column[COLUMN_FORCE])
        return stiffness_table_levels_check(t);
    if (!t->k && !(t->error && t->loaded))
        return ff_table_failf(t->host, t->file, FF_TABLE_ALL, FF_TABLE_ALL,
                              "the header must name stiffness, or transmission_error and "
                              "loaded_transmission_error");
    if (t->k && t->loaded && t->definition == SECANT)
        return ff_table_failf(t->host, t->file, FF_TABLE_ALL, COLUMN_LOADED,
                              "the secant stiffness follows from this column: give only one of the "
                              "two columns, or set definition: tangent if the stiffness is the "
                              "slope dF/d(e_l)");
    if (!t->k && t->definition == TANGENT)
        return ff_failf(t->host, FF_UNSUPPORTED, "definition",
                        "from transmission errors at one load only the secant stiffness follows");
    return FF_OK;
}

/* Reports an error in sample i, with its position in the file or in the list. */
static ff_status fail_at(const stiffness_table *t, const char *list, size_t column, size_t i,
                         const char *why, double value)
{
    if (t->file)
        return ff_table_failf(t->host, t->file, i, column, "%s; found %.9g", why, value);
    return ff_failf(t->host, FF_INVALID, list, "value %zu: %s; found %.9g", i + 1, why, value);
}

/* Returns the sample at phase 1 if it differs from that at phase 0 by more than 5 % of the range,
   the assumed noise of a table; otherwise NULL. */
static const double *differs_from_start(const stiffness_table *t, const double *value)
{
    const stiffness_table_phases *k = &t->distinct;
    const double noise = 0.05;
    double low = INFINITY, high = -INFINITY;
    if (!value || k->count == 0 || k->phase[0] > 0 || t->at[k->before[0]] < 1)
        return NULL;
    for (size_t i = 0; i < t->count; i++) {
        low = fmin(low, value[i]);
        high = fmax(high, value[i]);
    }
    const double *end = &value[k->before[0]];
    return fabs(*end - value[k->after[0]]) > noise * (high - low) ? end : NULL;
}

static const char loaded_jumps[] =
    "the loaded transmission error is not periodic: at phase 1 it must have the value of phase 0; "
    "if it jumps there, set ends: jump";

/* Checks that the table is periodic. The transmission error without load must always be; the
   stiffness may jump at the end of a mesh cycle if the table gives both values. */
static ff_status check_periodic(const stiffness_table *t)
{
    const double *stiffness = t->k ? t->k : t->loaded;
    const double *end = differs_from_start(t, t->error);
    if (end)
        return fail_at(t, "file", COLUMN_ERROR, t->distinct.before[0],
                       "the transmission error without load is not periodic: at phase 1 it must "
                       "have the value of phase 0",
                       *end);
    end = t->ends == PERIODIC ? differs_from_start(t, stiffness) : NULL;
    if (!end && t->k && t->loaded && t->ends == PERIODIC) {
        end = differs_from_start(t, t->loaded);
        if (end)
            return fail_at(t, "file", COLUMN_LOADED, t->distinct.before[0], loaded_jumps, *end);
    }
    for (size_t i = 1; !end && t->ends == PERIODIC && i + 1 < t->forces; i++) {
        const size_t row = i * t->count;
        const double *between = differs_from_start(t, t->file->columns[COLUMN_LOADED] + row);
        if (between)
            return fail_at(t, "file", COLUMN_LOADED, row + t->distinct.before[0], loaded_jumps,
                           *between);
    }
    if (!end)
        return FF_OK;
    return fail_at(t, "stiffness", t->k ? COLUMN_STIFFNESS : COLUMN_LOADED, t->distinct.before[0],
                   t->k ? "the stiffness is not periodic: at phase 1 it must have the value of "
                          "phase 0; if it jumps there, set ends: jump"
                        : loaded_jumps,
                   *end);
}

static ff_status check_values(const stiffness_table *t)
{
    for (size_t i = 0; i < t->count; i++) {
        if (t->k && !(t->k[i] > 0 && isfinite(t->k[i])))
            return fail_at(t, "stiffness", COLUMN_STIFFNESS, i, "a stiffness must be positive",
                           t->k[i]);
        if (t->loaded && !(t->loaded[i] > (t->error ? t->error[i] : 0)))
            return fail_at(t, "file", COLUMN_LOADED, i,
                           "the loaded transmission error, in m, must exceed the transmission "
                           "error without load",
                           t->loaded[i]);
        if (t->load_share == FROM_FILE && !(t->share[i] >= 0 && t->share[i] <= 1))
            return fail_at(t, "file", COLUMN_SHARE, i, "a load share lies between 0 and 1",
                           t->share[i]);
    }
    return check_periodic(t);
}

static ff_status mark_corners(stiffness_table *t)
{
    bool *flags = calloc(t->distinct.count, sizeof *flags);
    if (!flags)
        return FF_NOMEM;
    free(t->corner_at);
    t->corner_at = flags;
    for (size_t c = 0; c < t->corner.count; c++) {
        double phase = t->corner.data[c] < 1 ? t->corner.data[c] : 0;
        size_t i = 0;
        while (i < t->distinct.count &&
               fabs(t->distinct.phase[i] - phase) > STIFFNESS_PHASE_TOLERANCE)
            i++;
        if (i == t->distinct.count)
            return ff_failf(t->host, FF_INVALID, "corners",
                            "a corner must be one of the table's phases; %.9g is not", phase);
        flags[i] = true;
    }
    return FF_OK;
}

ff_status stiffness_table_samples(stiffness_table *t)
{
    ff_status status;
    if (t->path) {
        if (t->stiffness.count > 0)
            return ff_failf(t->host, FF_INVALID, "stiffness",
                            "stiffness cannot be given together with file; it belongs to the list "
                            "phase");
        status =
            ff_table_read(t->host, "file", t->path, stiffness_table_columns,
                          STIFFNESS_TABLE_COLUMNS, sizeof stiffness_table_columns[0], &t->file);
        if (status == FF_OK)
            status = use_columns(t);
    } else
        status = use_lists(t);
    if (status != FF_OK)
        return status;
    size_t bad = 0;
    stiffness_table_phases_free(&t->distinct);
    const char *why = stiffness_table_phases_make(&t->distinct, t->count, t->at, &bad);
    if (why && !*why)
        return ff_failf(t->host, FF_NOMEM, NULL, "out of memory");
    if (why)
        return fail_at(t, "phase", COLUMN_PHASE, bad, why, t->at[bad]);
    status = mark_corners(t);
    return status == FF_OK ? check_values(t) : status;
}
