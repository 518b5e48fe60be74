/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The cells of a map in rounds: the grid, its refined cases, then halfway between neighbours whose
 * classes differ, again and again.
 */
#include "stability.h"

#include <math.h>

static const ff_param params[STUDY_SETTINGS] = {
    [STUDY_AXES] = {.name = "axes",
                    .unit = "",
                    .type = FF_TREE,
                    .flags = FF_REQUIRED,
                    .doc = "map from paths to ranges or lists, as under sweep: the grid"},
    [STUDY_OUTPUTS] = {.name = "outputs",
                       .unit = "",
                       .type = FF_TREE,
                       .flags = FF_REQUIRED,
                       .doc = "list of the scalars that must be right: [film.h_min_lowest]"},
    [STUDY_ESTIMATES] = {.name = "estimates",
                         .unit = "",
                         .type = FF_TREE,
                         .doc = "map from outputs to the lines of quality that say their errors"},
    [STUDY_REFINE] = {.name = "refine",
                      .unit = "",
                      .type = FF_TREE,
                      .doc =
                          "list of parameters to double in the case that confirms a cell, or a map "
                          "to factors"},
    [STUDY_BISECT] = {.name = "bisect",
                      .unit = "",
                      .type = FF_TREE,
                      .doc =
                          "halvings between neighbours that differ, 0 to 40, or a map from axes"},
    [STUDY_PHYSICAL_ROWS] =
        {.name = "physical",
         .unit = "",
         .type = FF_TREE,
         .doc = "list of lines of quality, and of conditions in SI, which say that "
                "the machine itself is unstable, or a map to the lines that warn "
                "because of it"},
    [STUDY_NOTES] = {.name = "notes",
                     .unit = "",
                     .type = FF_TREE,
                     .doc = "map from such lines and conditions to words behind their value, which "
                            "leave the verdict alone: {\"motion.period > 1\": mesh cycles long}"},
    [STUDY_RANGE] = {.name = "range",
                     .unit = "",
                     .type = FF_TREE,
                     .doc = "list of lines of quality that say where a model applies"},
    [STUDY_TOLERANCE] = {.name = "tolerance",
                         .unit = "",
                         .type = FF_TREE,
                         .preset = "1 %",
                         .doc = "for an output without an estimate"},
};

static const ff_port outputs[] = {
    {.name = "study", .unit = "", .dims = "", .service = FF_STUDY_ID, .doc = "a map of trust"},
};

size_t study_map_columns(const study_map *map)
{
    return map->grid->lengths[0];
}

size_t study_map_rows(const study_map *map)
{
    return map->axis_count > 1 ? map->grid->lengths[1] : 1;
}

size_t study_map_slices(const study_map *map)
{
    return map->grid->case_count / study_map_columns(map) / study_map_rows(map);
}

/* The first axis varies slowest. */
size_t study_map_cell(const study_map *map, size_t slice, size_t column, size_t row)
{
    return (column * study_map_rows(map) + row) * study_map_slices(map) + slice;
}

size_t study_map_stride(const study_map *map, size_t axis)
{
    size_t stride = 1;
    for (size_t a = map->axis_count; --a > axis;)
        stride *= map->grid->lengths[a];
    return stride;
}

static size_t point_of(const study_map *map, size_t axis, size_t cell)
{
    return cell / study_map_stride(map, axis) % map->grid->lengths[axis];
}

const char *study_map_value(const study_map *map, size_t axis, size_t point)
{
    return map->grid->points[point * study_map_stride(map, axis) * map->axis_count + axis].name;
}

const ff_study_answer *study_map_answer(const study_map *map, int64_t asked)
{
    return asked == STUDY_NOT_ASKED ? NULL : map->desk->answer(map->desk->ctx, (size_t)asked);
}

static study_cell *add_cell(study_map *map, const ff_study_point *points)
{
    const ff_study_desk *desk = map->desk;
    if ((map->count & (map->count - 1)) == 0) {
        size_t room = map->count ? 2 * map->count : 1;
        study_cell *more = desk->memory(desk->ctx, room * sizeof *more);
        if (map->count)
            memcpy(more, map->cells, map->count * sizeof *more);
        map->cells = more;
    }
    study_cell *cell = &map->cells[map->count++];
    *cell = (study_cell){.points = points,
                         .halved = map->axis_count,
                         .asked = STUDY_NOT_ASKED,
                         .finer = STUDY_NOT_ASKED};
    cell->at = desk->memory(desk->ctx, map->axis_count * sizeof *cell->at);
    return cell;
}

static void add_grid(study_map *map)
{
    for (size_t i = 0; i < map->grid->case_count; i++) {
        study_cell *cell = add_cell(map, map->grid->points + i * map->axis_count);
        const char *end;
        cell->asked = (int64_t)i; /* by the plan */
        for (size_t a = 0; a < map->axis_count; a++)
            if (!study_number(cell->points[a].name, &cell->at[a], &end))
                cell->at[a] = (double)point_of(map, a, i);
    }
}

/* Halfway between two cells that differ along the axis. */
static void add_between(study_map *map, size_t axis, size_t low, size_t high)
{
    const ff_study_desk *desk = map->desk;
    ff_study_point *points = desk->memory(desk->ctx, map->axis_count * sizeof *points);
    study_cell *cell = add_cell(map, points);
    const study_cell *a = &map->cells[low], *b = &map->cells[high];
    const char *path = map->grid->paths[axis], *unit;
    double number;
    memcpy(points, a->points, map->axis_count * sizeof *points);
    memcpy(cell->at, a->at, map->axis_count * sizeof *cell->at);
    cell->halved = axis;
    double middle =
        map->log[axis] ? sqrt(a->at[axis] * b->at[axis]) : (a->at[axis] + b->at[axis]) / 2;
    study_number(a->points[axis].name, &number, &unit);
    points[axis].assignment = study_keep(desk, "%s=%.12g%s", path, middle, unit);
    points[axis].name = points[axis].assignment + strlen(path) + 1;
    study_number(points[axis].name, &cell->at[axis], &unit); /* the digits that are written */
}

/* finer: values of the knobs, NULL where one stays; a knob that is an axis, too, takes its place.
 */
static int64_t ask(const study_map *map, const study_cell *cell, const char *const *finer)
{
    const ff_study_desk *desk = map->desk;
    size_t paths = map->plan->path_count;
    ff_study_point *points = desk->memory(desk->ctx, paths * sizeof *points);
    for (size_t i = 0; i < paths; i++) {
        points[i] = i < map->axis_count ? cell->points[i] : (ff_study_point){"", ""};
        for (size_t k = 0; k < map->knob_count && finer; k++)
            if (finer[k] && !strcmp(map->knobs[k], map->plan->paths[i]))
                points[i] =
                    (ff_study_point){study_keep(desk, "%s=%s", map->knobs[k], finer[k]), finer[k]};
    }
    const ff_study_case one = {.size = sizeof one, .points = points, .label = "", .repeat = 0};
    return (int64_t)desk->ask(desk->ctx, &one);
}

/* The number of the refined case; STUDY_NOT_ASKED: there is nothing to refine. */
static int64_t ask_finer(const study_map *map, const study_cell *cell)
{
    const ff_study_desk *desk = map->desk;
    const char **finer = desk->memory(desk->ctx, (map->knob_count + 1) * sizeof *finer);
    size_t turned = 0;
    for (size_t k = 0; k < map->knob_count; k++) {
        finer[k] = desk->turn(desk->ctx, (size_t)cell->asked, map->knobs[k], map->factors[k]);
        turned += finer[k] != NULL;
    }
    return turned ? ask(map, cell, finer) : STUDY_NOT_ASKED;
}

/* Runs the cases from number `begin` on and judges the cells from `first` on. */
static ff_status run_round(study_map *map, int64_t begin, int64_t end, size_t first)
{
    const ff_study_desk *desk = map->desk;
    ff_status status = begin < end ? desk->run(desk->ctx, (size_t)begin, (size_t)end) : FF_OK;
    for (size_t i = first; i < map->count && status == FF_OK; i++) {
        study_cell *cell = &map->cells[i];
        study_judge(map, cell, study_map_answer(map, cell->asked),
                    study_map_answer(map, cell->finer));
    }
    return status;
}

/* The cells from `first` on: as they stand, then refined where there is something to compare. */
static ff_status run_cells(study_map *map, size_t first)
{
    int64_t begin = 0, end = (int64_t)map->grid->case_count;
    for (size_t i = first; i < map->count; i++)
        if (map->cells[i].asked == STUDY_NOT_ASKED) {
            map->cells[i].asked = ask(map, &map->cells[i], NULL);
            begin = i == first ? map->cells[i].asked : begin;
            end = map->cells[i].asked + 1;
        }
    if (first == map->count)
        return FF_OK;
    ff_status status = run_round(map, begin, end, first);
    begin = end;
    for (size_t i = first; i < map->count && status == FF_OK; i++) {
        study_cell *cell = &map->cells[i];
        cell->finer = cell->class <= STUDY_DEGRADED ? ask_finer(map, cell) : STUDY_NOT_ASKED;
        end = cell->finer == STUDY_NOT_ASKED ? end : cell->finer + 1;
    }
    return status == FF_OK ? run_round(map, begin, end, first) : status;
}

static void find_boundaries(study_map *map)
{
    const ff_study_desk *desk = map->desk;
    size_t cells = map->grid->case_count;
    map->boundaries = desk->memory(desk->ctx, cells * map->axis_count * sizeof *map->boundaries);
    for (size_t a = 0; a < map->axis_count; a++) {
        size_t stride = study_map_stride(map, a);
        for (size_t i = 0; map->halvings[a] && i < cells; i++) {
            bool last = point_of(map, a, i) + 1 == map->grid->lengths[a];
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

/* Between the middle and that end which differs from it; where both do, the better one. */
static void narrow(const study_map *map, study_boundary *b, size_t middle)
{
    enum study_class low = map->cells[b->low].class, high = map->cells[b->high].class;
    enum study_class at = map->cells[middle].class;
    if (at == low || (at != high && high < low))
        b->low = middle;
    else
        b->high = middle;
}

static ff_status halve(study_map *map)
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
        ff_status status = run_cells(map, first);
        if (status != FF_OK)
            return status;
        for (size_t i = 0; i < map->boundary_count; i++)
            if (n < map->halvings[map->boundaries[i].axis])
                narrow(map, &map->boundaries[i], next++);
    }
    return FF_OK;
}

static void hand_over(const study_map *map, const char *name,
                      void (*put)(const study_map *, FILE *))
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out)
        put(map, out);
    if (out && fclose(out) == 0)
        map->desk->file(map->desk->ctx, name, text);
    free(text);
}

static ff_status run(void *self, const ff_study_desk *desk)
{
    study_map *map = self;
    map->desk = desk;
    add_grid(map);
    ff_status status = run_cells(map, 0);
    if (status == FF_OK) {
        find_boundaries(map);
        status = halve(map);
    }
    if (status != FF_OK)
        return status;
    for (size_t i = 0; i < map->count; i++) {
        bool grid = i < map->grid->case_count;
        (grid ? map->counts : map->more)[map->cells[i].class]++;
        map->noted[!grid] += map->cells[i].note != NULL;
    }
    hand_over(map, "map.csv", study_map_csv);
    hand_over(map, "map.json", study_map_json);
    hand_over(map, "map.svg", study_map_svg);
    char *facts = study_map_facts(map);
    if (facts)
        desk->facts(desk->ctx, facts);
    free(facts);
    study_map_print(map);
    /* cells that fail are what a map looks for; those that fail in silence are not */
    desk->conclude(desk->ctx,
                   map->counts[STUDY_SILENT] + map->more[STUDY_SILENT] ? FF_BAD : FF_GOOD);
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    study_map *map = calloc(1, sizeof *map);
    if (!map)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    map->host = host;
    map->service = (ff_study_model){.size = sizeof map->service,
                                    .self = map,
                                    .verb = "maps",
                                    .plan = study_map_plan,
                                    .run = run};
    *self = map;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    study_map *map = self;
    if (param < STUDY_SETTINGS)
        map->settings[param] = value->tree;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((study_map *)self)->service;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "study/stability",
    .version = "1.0.0",
    .summary = "Map of where a pipeline converges, degrades or fails, and why",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
