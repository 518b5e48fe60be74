/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interpolates a table given at several mesh forces. */
#include "table-levels.h"

#include "../numerics/steffen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Forces with a smaller relative difference, and phases with a smaller difference in mesh cycles,
   are treated as equal. */
static const double same_force = 1e-9, same_phase = 1e-9;

static ff_status fail_at(const stiffness_table *t, size_t row, size_t column, const char *why,
                         double value)
{
    return ff_table_failf(t->host, t->file, row, column, "%s; found %.9g", why, value);
}

static ff_status check_header(const stiffness_table *t)
{
    const double *const *column = t->file->columns;
    if (!column[COLUMN_LOADED])
        return ff_table_failf(t->host, t->file, FF_TABLE_ALL, COLUMN_FORCE,
                              "a table with a column force also needs the column "
                              "loaded_transmission_error, under the force of each row");
    if (column[COLUMN_ERROR])
        return ff_table_failf(t->host, t->file, FF_TABLE_ALL, COLUMN_ERROR,
                              "in a table with a column force, the rows of force 0 give the "
                              "transmission error without load, as loaded_transmission_error");
    if (column[COLUMN_STIFFNESS] && t->definition == SECANT)
        return ff_table_failf(t->host, t->file, FF_TABLE_ALL, COLUMN_STIFFNESS,
                              "in a table with a column force, stiffness is the slope dF/d(e_l) "
                              "under the force of its row: set definition: tangent; leave out a "
                              "secant stiffness, which follows from the errors");
    return FF_OK;
}

/* Checks that a row has the force and the phase expected at its position. */
static ff_status check_row(const stiffness_table *t, size_t i, size_t phases)
{
    const double *force = t->file->columns[COLUMN_FORCE], *at = t->file->columns[COLUMN_PHASE];
    const double *error = t->file->columns[COLUMN_LOADED], *k = t->file->columns[COLUMN_STIFFNESS];
    const double *part = t->file->columns[COLUMN_SHARE];
    size_t first = i / phases * phases;
    if (fabs(force[i] - force[first]) > same_force * force[first])
        return fail_at(t, i, COLUMN_FORCE, "every force must have as many rows as the first force",
                       force[i]);
    if (i == first && i > 0 && !(force[i] > force[i - 1]))
        return fail_at(t, i, COLUMN_FORCE, "the forces must increase", force[i]);
    if (fabs(at[i] - at[i % phases]) > same_phase)
        return fail_at(t, i, COLUMN_PHASE, "every force must have the phases of the first force",
                       at[i]);
    if (i >= phases && !(error[i] > error[i - phases]))
        return fail_at(t, i, COLUMN_LOADED,
                       "the transmission error, in m, must exceed that under the previous force",
                       error[i]);
    if (k && !(k[i] > 0))
        return fail_at(t, i, COLUMN_STIFFNESS, "a stiffness must be positive", k[i]);
    if (part && !(part[i] >= 0 && part[i] <= 1))
        return fail_at(t, i, COLUMN_SHARE, "a load share must lie between 0 and 1", part[i]);
    return FF_OK;
}

/* Refuses a table whose stiffness equals the chord force/(error - error without load) in all rows,
   although the errors have another slope. Such a column is not the slope dF/d(e_l) that is
   required. */
static ff_status check_slopes(const stiffness_table *t, size_t rows, size_t phases)
{
    static const double rounded = 1e-3, other = 1e-2;
    const double *force = t->file->columns[COLUMN_FORCE], *k = t->file->columns[COLUMN_STIFFNESS];
    const double *error = t->file->columns[COLUMN_LOADED];
    double off = 0, bend = 0;
    for (size_t i = phases; k && i < rows; i++) {
        double chord = force[i] / (error[i] - error[i % phases]);
        double part = (force[i] - force[i - phases]) / (error[i] - error[i - phases]);
        off = fmax(off, fabs(k[i] / chord - 1));
        bend = fmax(bend, fabs(k[i] / part - 1));
    }
    if (!k || off > rounded || bend < other)
        return FF_OK;
    return fail_at(t, phases, COLUMN_STIFFNESS,
                   "in every row this is the secant, the force over the error minus that without "
                   "load; in a table with a column force it must be the slope dF/d(e_l): leave it "
                   "out",
                   k[phases]);
}

ff_status stiffness_table_levels_check(stiffness_table *t)
{
    const double *const *column = t->file->columns;
    const double *force = column[COLUMN_FORCE];
    size_t rows = t->file->row_count, phases = 0;
    ff_status status = check_header(t);
    if (status != FF_OK)
        return status;
    if (force[0] != 0)
        return fail_at(t, 0, COLUMN_FORCE,
                       "the first rows must have the force 0: the transmission error without load",
                       force[0]);
    while (phases < rows && force[phases] == 0)
        phases++;
    if (phases == rows)
        return ff_table_failf(t->host, t->file, rows - 1, COLUMN_FORCE,
                              "at least one force above 0 is needed after the force 0");
    for (size_t i = 0; i < rows && status == FF_OK; i++)
        status = check_row(t, i, phases);
    if (status != FF_OK)
        return status;
    if (rows % phases)
        return ff_table_failf(t->host, t->file, rows - 1, COLUMN_FORCE,
                              "every force must have as many rows as the first force, %zu; this "
                              "force has %zu",
                              phases, rows % phases);
    if ((status = check_slopes(t, rows, phases)) != FF_OK)
        return status;
    if (rows / phases > STIFFNESS_TABLE_FORCES)
        return ff_table_failf(t->host, t->file, STIFFNESS_TABLE_FORCES * phases, COLUMN_FORCE,
                              "more than %d forces", STIFFNESS_TABLE_FORCES);
    t->forces = rows / phases;
    t->count = phases;
    t->k = NULL;
    t->error = column[COLUMN_LOADED];
    t->loaded = column[COLUMN_LOADED] + rows - phases;
    return FF_OK;
}

/* The errors under the forces at one phase, and their slopes over the force. */
typedef struct curve {
    size_t count;
    double force[STIFFNESS_TABLE_FORCES], error[STIFFNESS_TABLE_FORCES];
    double slope[STIFFNESS_TABLE_FORCES];
} curve;

static double rise(const curve *c, size_t i)
{
    return (c->error[i + 1] - c->error[i]) / (c->force[i + 1] - c->force[i]);
}

/* Evaluates the cubic and its slope at a force between the forces low and low + 1. */
static void read_curve(const curve *c, size_t low, double force, double *error, double *slope)
{
    double h = c->force[low + 1] - c->force[low], x = (force - c->force[low]) / h;
    double chord = rise(c, low);
    double a = c->slope[low], z = c->slope[low + 1], bend = 3 * chord - 2 * a - z;
    double turn = a + z - 2 * chord;
    *error = c->error[low] + h * x * (a + x * (bend + x * turn));
    *slope = fmax(a + x * (2 * bend + 3 * x * turn), 1e-3 * chord);
}

static curve curve_at(const stiffness_table *t, size_t phase)
{
    const double *k = t->file->columns[COLUMN_STIFFNESS];
    curve c = {.count = t->forces};
    for (size_t i = 0; i < c.count; i++) {
        size_t at = i * t->count + phase;
        c.force[i] = t->file->columns[COLUMN_FORCE][i * t->count];
        c.error[i] = t->file->columns[COLUMN_LOADED][at];
    }
    numerics_steffen_slopes(c.count, c.force, c.error, c.slope);
    /* a slope of 0, which Steffen's cubic may have at its ends, would mean a rigid mesh */
    size_t last = c.count - 1;
    c.slope[0] = fmax(c.slope[0], 0.1 * rise(&c, 0));
    c.slope[last] = fmax(c.slope[last], 0.1 * rise(&c, last - 1));
    for (size_t i = 0; i < c.count && k; i++) {
        double steepest = 3 * fmin(rise(&c, i ? i - 1 : 0), rise(&c, i + 1 < c.count ? i : i - 1));
        c.slope[i] = fmin(1 / k[i * t->count + phase], steepest); /* keeps the cubic monotone */
    }
    return c;
}

/* Fills in one phase of all rows. If the line force is not a force of the table, `low` is the table
   force below it. */
static void fill_phase(const stiffness_table *t, stiffness_table_levels *l, size_t phase,
                       int between)
{
    curve c = curve_at(t, phase);
    for (size_t row = 0; row < l->count; row++) {
        size_t from = row - (between && row > l->mean), at = row * t->count + phase;
        const double *part = l->share ? t->file->columns[COLUMN_SHARE] : NULL;
        if (between && row == l->mean) {
            size_t low = row - 1;
            double x = (l->force[row] - c.force[low]) / (c.force[row] - c.force[low]), slope;
            read_curve(&c, low, l->force[row], &l->error[at], &slope);
            l->slope[at] = 1 / slope;
            if (part)
                l->share[at] = part[low * t->count + phase] +
                               x * (part[row * t->count + phase] - part[low * t->count + phase]);
            continue;
        }
        l->error[at] = c.error[from];
        l->slope[at] = 1 / c.slope[from];
        if (part)
            l->share[at] = part[from * t->count + phase];
    }
}

ff_status stiffness_table_levels_make(const stiffness_table *t, double line_force,
                                      stiffness_table_levels *l)
{
    const double *force = t->file->columns[COLUMN_FORCE];
    size_t above = 0;
    *l = (stiffness_table_levels){.count = 0};
    while (above < t->forces && force[above * t->count] < line_force * (1 - same_force))
        above++;
    if (above == t->forces)
        return ff_table_failf(t->host, t->file, (t->forces - 1) * t->count, COLUMN_FORCE,
                              "the largest force of the table is %.9g N, below the line force of "
                              "%.9g N",
                              force[(t->forces - 1) * t->count], line_force);
    int between = force[above * t->count] > line_force * (1 + same_force);
    l->mean = above;
    l->count = t->forces + (between ? 1 : 0);
    for (size_t row = 0; row < l->count; row++)
        l->force[row] = between && row == above
                            ? line_force
                            : force[(row - (between && row > above)) * t->count];
    l->error = malloc(l->count * t->count * sizeof *l->error);
    l->slope = malloc(l->count * t->count * sizeof *l->slope);
    if (t->load_share == FROM_FILE)
        l->share = malloc(l->count * t->count * sizeof *l->share);
    if (!l->error || !l->slope || (t->load_share == FROM_FILE && !l->share))
        return FF_NOMEM;
    for (size_t i = 0; i < t->count; i++)
        fill_phase(t, l, i, between);
    return FF_OK;
}

void stiffness_table_levels_free(stiffness_table_levels *l)
{
    free(l->error);
    free(l->slope);
    free(l->share);
    *l = (stiffness_table_levels){.count = 0};
}
