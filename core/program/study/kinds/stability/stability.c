/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs the cells of a map in rounds: the grid, its twins, then repeatedly cells halfway between
 * neighbours whose classes differ. The first twin is coarser and costs a fraction of the answer. If
 * the error falls with order 1 or more, the error of the answer is at most the difference between
 * the two. A finer twin, which costs several times the answer, decides the remaining cells. */
#include "stability.h"

#include <math.h>
#include <string.h>

static const ff_param keys[STUDY_MAP_KEYS] = {
    [MAP_AXES] = {.name = "axes",
                  .flags = FF_REQUIRED,
                  .doc = "map from paths to ranges or lists, as under sweep: the grid"},
    [MAP_OUTPUTS] = {.name = "outputs",
                     .flags = FF_REQUIRED,
                     .doc = "list of the scalars that must be right: [film.h_min_lowest]"},
    [MAP_ESTIMATES] = {.name = "estimates",
                       .doc = "map from outputs to the quality lines that state their errors"},
    [MAP_REFINE] = {.name = "refine",
                    .doc = "list of parameters that are halved in the case that confirms a cell, "
                           "and doubled if it does not; or a map to factors"},
    [MAP_BISECT] = {.name = "bisect",
                    .doc = "halvings between neighbours that differ, 0 to 40, or a map from axes"},
    [MAP_PHYSICAL] = {.name = "physical",
                      .doc = "list of quality lines, and of conditions in SI, that mean that the "
                             "machine itself is unstable, or a map to the lines that warn "
                             "because of it"},
    [MAP_NOTES] = {.name = "notes",
                   .doc =
                       "map from such lines and conditions to words printed after their value; "
                       "they do not change the verdict: {\"motion.period > 1\": mesh cycles long}"},
    [MAP_RANGE] = {.name = "range",
                   .doc = "list of quality lines that state where a model applies"},
    [MAP_TOLERANCE] = {.name = "tolerance",
                       .type = FF_REAL,
                       .unit = "1",
                       .flags = FF_MIN_OPEN,
                       .max = HUGE_VAL,
                       .preset = "1 %",
                       .doc = "relative difference allowed for an output without an estimate"},
};

static size_t point_of(const study_map *map, size_t axis, size_t cell)
{
    return cell / study_map_stride(map, axis) % map->grid->points[axis];
}

static study_cell *add_cell(study_map *map, const study_setting *settings)
{
    study_context *context = map->context;
    map->cells = memory_arena_grow(&context->arena, map->cells, map->count, sizeof *map->cells);
    study_cell *cell = &map->cells[map->count++];
    *cell = (study_cell){.settings = settings,
                         .halved = map->axis_count,
                         .number = STUDY_NOT_SUBMITTED,
                         .twin = STUDY_NOT_SUBMITTED};
    cell->at = memory_arena_alloc(&context->arena, map->axis_count * sizeof *cell->at);
    return cell;
}

/* Adds the cells of the grid, whose cases study_map_read has already submitted. */
static void add_grid(study_map *map)
{
    for (size_t i = 0; i < map->grid->count; i++) {
        study_setting *settings =
            memory_arena_alloc(&map->context->arena, map->axis_count * sizeof *settings);
        for (size_t a = 0; a < map->axis_count; a++)
            settings[a] =
                (study_setting){study_assignment(map->grid, a, i), study_value(map->grid, a, i)};
        study_cell *cell = add_cell(map, settings);
        const char *end;
        cell->number = (int64_t)i;
        for (size_t a = 0; a < map->axis_count; a++)
            if (!ff_number_parse(settings[a].name, &cell->at[a], &end))
                cell->at[a] = (double)point_of(map, a, i);
    }
}

/* Adds a cell halfway between two cells that differ along the axis. */
static void add_between(study_map *map, size_t axis, size_t low, size_t high)
{
    study_context *context = map->context;
    study_setting *settings =
        memory_arena_alloc(&context->arena, map->axis_count * sizeof *settings);
    study_cell *cell = add_cell(map, settings);
    const study_cell *a = &map->cells[low], *b = &map->cells[high];
    const char *path = map->grid->varied[axis].path, *unit;
    double number;
    memcpy(settings, a->settings, map->axis_count * sizeof *settings);
    memcpy(cell->at, a->at, map->axis_count * sizeof *cell->at);
    cell->halved = axis;
    double middle =
        map->log[axis] ? sqrt(a->at[axis] * b->at[axis]) : (a->at[axis] + b->at[axis]) / 2;
    ff_number_parse(a->settings[axis].name, &number, &unit);
    settings[axis].assignment = study_context_format(context, "%s=%.12g%s", path, middle, unit);
    settings[axis].name = settings[axis].assignment + strlen(path) + 1;
    ff_number_parse(settings[axis].name, &cell->at[axis],
                    &unit); /* the number as rounded by printing */
}

/* Submits the case of a cell. `scaled` has assignments of the knobs, or NULL for a knob that keeps
   its value; a knob that is also an axis replaces the value of the axis. */
static int64_t submit_cell(const study_map *map, const study_cell *cell, const char *const *scaled)
{
    study_context *context = map->context;
    size_t paths = context->path_count;
    study_setting *settings = memory_arena_alloc(&context->arena, paths * sizeof *settings);
    for (size_t i = 0; i < paths; i++) {
        settings[i] = i < map->axis_count ? cell->settings[i] : (study_setting){"", ""};
        for (size_t k = 0; k < map->knob_count && scaled; k++)
            if (scaled[k] && !strcmp(map->knobs[k], context->paths[i]))
                settings[i] = (study_setting){scaled[k], strchr(scaled[k], '=') + 1};
    }
    return (int64_t)study_submit(context, settings, 0, "", NULL);
}

/* Submits a twin and returns its number; STUDY_NOT_SUBMITTED if not all numbers can be scaled, or
   if none changes. */
static int64_t submit_twin(const study_map *map, study_cell *cell, bool finer)
{
    study_context *context = map->context;
    const char **scaled =
        memory_arena_alloc(&context->arena, (map->knob_count + 1) * sizeof *scaled);
    double *factors = memory_arena_alloc(&context->arena, (map->knob_count + 1) * sizeof *factors);
    for (size_t k = 0; k < map->knob_count; k++)
        factors[k] = finer ? map->factors[k] : 1 / map->factors[k];
    const enum study_scaling scaling = study_scale_parameters(
        context, (size_t)cell->number, map->knobs, factors, map->knob_count, scaled);
    cell->bounded = scaling == STUDY_BEYOND_LIMITS;
    return scaling == STUDY_SCALED ? submit_cell(map, cell, scaled) : STUDY_NOT_SUBMITTED;
}

/* Runs the cases with the numbers from `begin` to `end` - 1 and judges the cells from `first` on.
 */
static bool run_round(study_map *map, int64_t begin, int64_t end, size_t first)
{
    if (begin < end && !study_run_submitted(map->context, (size_t)begin, (size_t)end))
        return false;
    for (size_t i = first; i < map->count; i++) {
        study_cell *cell = &map->cells[i];
        study_judge(map, cell, study_map_outcome(map, cell->number),
                    study_map_outcome(map, cell->twin));
    }
    return true;
}

/* Runs twins of the cells from `first` on: the coarser twin of each cell that has an answer, or the
 * finer twin of each cell whose coarser one did not confirm it or is impossible. */
static bool run_twins(study_map *map, int64_t begin, size_t first, bool finer)
{
    int64_t end = begin;
    for (size_t i = first; i < map->count; i++) {
        study_cell *cell = &map->cells[i];
        const bool had = cell->twin != STUDY_NOT_SUBMITTED;
        if (had ? cell->confirmed : cell->class > STUDY_DEGRADED)
            continue;
        const int64_t twin = submit_twin(map, cell, finer);
        if (twin == STUDY_NOT_SUBMITTED)
            continue;
        cell->twin = twin;
        cell->finer = finer;
        end = twin + 1;
    }
    return run_round(map, begin, end, first) && (finer || run_twins(map, end, first, true));
}

/* Runs the cells from `first` on and their twins. */
static bool run_cells(study_map *map, size_t first)
{
    int64_t begin = 0, end = (int64_t)map->grid->count;
    for (size_t i = first; i < map->count; i++)
        if (map->cells[i].number == STUDY_NOT_SUBMITTED) {
            map->cells[i].number = submit_cell(map, &map->cells[i], NULL);
            begin = i == first ? map->cells[i].number : begin;
            end = map->cells[i].number + 1;
        }
    if (first == map->count)
        return true;
    return run_round(map, begin, end, first) && run_twins(map, end, first, false);
}

static void find_boundaries(study_map *map)
{
    study_context *context = map->context;
    size_t cells = map->grid->count;
    map->boundaries =
        memory_arena_alloc(&context->arena, cells * map->axis_count * sizeof *map->boundaries);
    for (size_t a = 0; a < map->axis_count; a++) {
        size_t stride = study_map_stride(map, a);
        for (size_t i = 0; map->halvings[a] && i < cells; i++) {
            bool last = point_of(map, a, i) + 1 == map->grid->points[a];
            if (last || map->cells[i].class == map->cells[i + stride].class)
                continue;
            map->boundaries[map->boundary_count++] =
                (study_boundary){.axis = a,
                                 .low = i,
                                 .high = i + stride,
                                 .slice = i % study_map_slices(map),
                                 .column = point_of(map, 0, i),
                                 .row = map->axis_count > 1 ? point_of(map, 1, i) : 0};
        }
    }
}

/* Narrows a boundary to the middle and the end that differs from it; if both ends differ, to the
 * better one. */
static void narrow_boundary(const study_map *map, study_boundary *b, size_t middle)
{
    enum study_class low = map->cells[b->low].class, high = map->cells[b->high].class;
    enum study_class at = map->cells[middle].class;
    if (at == low || (at != high && high < low))
        b->low = middle;
    else
        b->high = middle;
}

static bool halve_boundaries(study_map *map)
{
    size_t most = 0;
    for (size_t i = 0; i < map->boundary_count; i++)
        if (map->halvings[map->boundaries[i].axis] > most)
            most = map->halvings[map->boundaries[i].axis];
    for (size_t n = 0; n < most; n++) {
        size_t first = map->count, next = first;
        for (size_t i = 0; i < map->boundary_count; i++) {
            const study_boundary *b = &map->boundaries[i];
            if (n < map->halvings[b->axis])
                add_between(map, b->axis, b->low, b->high);
        }
        if (!run_cells(map, first))
            return false;
        for (size_t i = 0; i < map->boundary_count; i++)
            if (n < map->halvings[map->boundaries[i].axis])
                narrow_boundary(map, &map->boundaries[i], next++);
    }
    return true;
}

static bool run_map(void *study)
{
    study_map *map = study;
    add_grid(map);
    if (!run_cells(map, 0))
        return false;
    find_boundaries(map);
    if (!halve_boundaries(map))
        return false;
    for (size_t i = 0; i < map->count; i++) {
        bool grid = i < map->grid->count;
        (grid ? map->counts : map->more)[map->cells[i].class]++;
        map->noted[!grid] += map->cells[i].note != NULL;
    }
    return true;
}

const study_kind study_stability_kind = {
    .name = "stability",
    .verb = "maps",
    .summary = "Map of where a pipeline converges, degrades or fails, and why",
    .file = "map",
    .keys = keys,
    .key_count = STUDY_MAP_KEYS,
    .read = study_map_read,
    .cases = run_map,
    .reduce = study_map_reduce,
};
