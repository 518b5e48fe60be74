/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The cells of a map in rounds, each of which is a study of its own in the same directory: the
 * grid, its refined cases, then halfway between neighbours whose classes differ, again and again.
 */
#include "stability.h"
#include "private.h"

#include "../value/unit.h"

#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A case of a round: a cell as it stands, or refined. */
typedef struct shot {
    size_t cell;
    const char **finer; /* value of each knob; NULL: as it stands */
} shot;

typedef struct rounds {
    const ff_campaign *campaign;
    ff_map *map;
    const ff_study *study; /* the grid */
    const ff_stability *stability;
    ff_tally *tally;
    ff_report *report;
    shot *shots; /* of the round at hand */
    size_t shot_count;
    shot *all; /* of all rounds */
    size_t all_count;
    ff_arena arena; /* of the rounds */
} rounds;

const ff_varied *ff_map_axis(const ff_study *study, size_t axis)
{
    return &study->varied[axis];
}

size_t ff_map_columns(const ff_study *study)
{
    return study->points[0];
}

size_t ff_map_rows(const ff_study *study)
{
    return study->axis_count > 1 ? study->points[1] : 1;
}

size_t ff_map_slices(const ff_study *study)
{
    return study->count / ff_map_columns(study) / ff_map_rows(study);
}

/* The first axis varies slowest. */
size_t ff_map_cell(const ff_study *study, size_t slice, size_t column, size_t row)
{
    return (column * ff_map_rows(study) + row) * ff_map_slices(study) + slice;
}

static ff_cell *add_cell(rounds *r)
{
    ff_map *map = r->map;
    size_t axes = r->study->axis_count;
    map->cells = ff_resize(map->cells, (map->count + 1) * sizeof *map->cells);
    ff_cell *cell = &map->cells[map->count++];
    *cell = (ff_cell){.halved = axes};
    cell->assignments = ff_arena_alloc(&map->arena, axes * sizeof *cell->assignments);
    cell->names = ff_arena_alloc(&map->arena, axes * sizeof *cell->names);
    cell->at = ff_arena_alloc(&map->arena, axes * sizeof *cell->at);
    return cell;
}

static void add_grid(rounds *r)
{
    const ff_study *study = r->study;
    for (size_t i = 0; i < study->count; i++) {
        ff_cell *cell = add_cell(r);
        for (size_t a = 0; a < study->axis_count; a++) {
            const char *end;
            cell->assignments[a] = ff_study_assignment(study, a, i);
            cell->names[a] = ff_study_value(study, a, i);
            if (study->varied[a].names || !ff_number_parse(cell->names[a], &cell->at[a], &end))
                cell->at[a] = (double)ff_study_point(study, a, i);
        }
    }
}

static const char *keep(ff_arena *arena, char *text)
{
    const char *kept = ff_arena_text(arena, text, strlen(text));
    free(text);
    return kept;
}

/* Halfway between two cells that differ along the axis. */
static size_t add_between(rounds *r, size_t axis, size_t low, size_t high)
{
    ff_cell *cell = add_cell(r);
    const ff_cell *a = &r->map->cells[low], *b = &r->map->cells[high];
    const ff_varied *varied = &r->study->varied[axis];
    const char *unit = "";
    double number;
    memcpy(cell->assignments, a->assignments, r->study->axis_count * sizeof *cell->assignments);
    memcpy(cell->names, a->names, r->study->axis_count * sizeof *cell->names);
    memcpy(cell->at, a->at, r->study->axis_count * sizeof *cell->at);
    cell->halved = axis;
    double middle =
        r->stability->log[axis] ? sqrt(a->at[axis] * b->at[axis]) : (a->at[axis] + b->at[axis]) / 2;
    ff_number_parse(a->names[axis], &number, &unit);
    cell->assignments[axis] =
        keep(&r->map->arena, ff_print_text("%s=%.12g%s", varied->path, middle, unit));
    cell->names[axis] = cell->assignments[axis] + strlen(varied->path) + 1;
    ff_number_parse(cell->names[axis], &cell->at[axis], &unit); /* the digits that are written */
    return r->map->count - 1;
}

static void add_shot(rounds *r, size_t cell, const char **finer)
{
    r->shots = ff_resize(r->shots, (r->shot_count + 1) * sizeof *r->shots);
    r->shots[r->shot_count++] = (shot){.cell = cell, .finer = finer};
}

static void add_varied(ff_study *round, const shot *shots, size_t path, const char *name, bool knob,
                       const ff_map *map, ff_arena *arena)
{
    ff_varied *varied = &round->varied[round->varied_count++];
    const char **names = ff_arena_alloc(arena, round->count * sizeof *names);
    *varied = (ff_varied){.path = name, .names = names};
    varied->assignments = ff_arena_alloc(arena, round->count * sizeof *varied->assignments);
    for (size_t i = 0; i < round->count; i++) {
        const ff_cell *cell = &map->cells[shots[i].cell];
        const char *finer = knob && shots[i].finer ? shots[i].finer[path] : NULL;
        varied->assignments[i] = finer  ? keep(arena, ff_print_text("%s=%s", name, finer))
                                 : knob ? ""
                                        : cell->assignments[path];
        names[i] = finer ? finer : knob ? "" : cell->names[path];
    }
}

/* A knob that is an axis, too, takes its place in refined cases. */
static void overlay(ff_study *round, const rounds *r, const shot *shots, size_t axis,
                    ff_arena *arena)
{
    ff_varied *varied = &round->varied[axis];
    const char **names = (const char **)(size_t)varied->names;
    for (size_t k = 0; k < r->stability->knob_count; k++)
        for (size_t i = 0; i < round->count; i++) {
            const char *finer = shots[i].finer ? shots[i].finer[k] : NULL;
            if (!finer || strcmp(r->stability->knobs[k].path, varied->path) != 0)
                continue;
            varied->assignments[i] = keep(arena, ff_print_text("%s=%s", varied->path, finer));
            names[i] = finer;
        }
}

/* Cases one by one: a study of one axis. */
static void lay_out(ff_study *round, const rounds *r, const shot *shots, size_t count,
                    ff_arena *arena)
{
    const ff_study *study = r->study;
    const ff_stability *s = r->stability;
    *round = *study;
    round->varied =
        ff_arena_alloc(arena, (study->varied_count + s->knob_count) * sizeof *round->varied);
    round->points = ff_arena_alloc(arena, sizeof *round->points);
    round->points[0] = round->count = count;
    round->axis_count = round->followed = round->way = 1;
    round->varied_count = 0;
    for (size_t a = 0; a < study->axis_count; a++) {
        add_varied(round, shots, a, study->varied[a].path, false, r->map, arena);
        overlay(round, r, shots, a, arena);
    }
    for (size_t k = 0; k < s->knob_count; k++) {
        size_t a = 0;
        while (a < study->axis_count && strcmp(study->varied[a].path, s->knobs[k].path) != 0)
            a++;
        if (a == study->axis_count)
            add_varied(round, shots, k, s->knobs[k].path, true, r->map, arena);
    }
}

/* Numbers that are added up over the rounds. */
static void add_tally(ff_tally *sum, const ff_tally *part)
{
    sum->leads = part->leads;
    sum->total += part->total;
    sum->before += part->before;
    sum->done += part->done;
    sum->failed += part->failed;
    sum->seconds += part->seconds;
    sum->savings.computed += part->savings.computed;
    sum->savings.reused += part->savings.reused;
    sum->savings.spent += part->savings.spent;
    sum->savings.saved += part->savings.saved;
}

static void judge_round(const rounds *r)
{
    int directory = open(r->campaign->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    json_t *records = directory < 0 ? json_object() : ff_journal_read(directory);
    for (size_t i = 0; i < r->shot_count; i++) {
        ff_cell *cell = &r->map->cells[r->shots[i].cell];
        ff_judge(cell, r->stability, json_object_get(records, cell->key),
                 *cell->refined ? json_object_get(records, cell->refined) : NULL, &r->map->arena);
    }
    json_decref(records);
    if (directory >= 0)
        close(directory);
}

/* Runs the shots of the round and judges their cells. */
static bool run_round(rounds *r)
{
    ff_campaign campaign = *r->campaign;
    ff_study round;
    ff_tally tally;
    ff_arena arena = {NULL};
    bool good = true;
    if (r->shot_count > 0) {
        lay_out(&round, r, r->shots, r->shot_count, &arena);
        campaign.study = &round;
        campaign.keys = ff_alloc(round.count * sizeof *campaign.keys);
        good = ff_study_run(&campaign, &tally, r->report);
        add_tally(r->tally, &tally);
        for (size_t i = 0; good && i < round.count; i++) {
            ff_cell *cell = &r->map->cells[r->shots[i].cell];
            memcpy(r->shots[i].finer ? cell->refined : cell->key, campaign.keys[i], FF_KEY_SIZE);
        }
        if (good)
            judge_round(r);
        free(campaign.keys);
        ff_arena_free(&arena);
    }
    r->all = ff_resize(r->all, (r->all_count + r->shot_count + 1) * sizeof *r->all);
    if (r->shot_count)
        memcpy(r->all + r->all_count, r->shots, r->shot_count * sizeof *r->shots);
    r->all_count += r->shot_count;
    r->shot_count = 0;
    return good;
}

/* The table of all cases, in place of those of the rounds; nothing is left to run. */
static bool write_table(const rounds *r)
{
    ff_campaign campaign = *r->campaign;
    ff_study whole;
    ff_tally tally;
    ff_arena arena = {NULL};
    lay_out(&whole, r, r->all, r->all_count, &arena);
    campaign.study = &whole;
    campaign.rerun = FF_RERUN_NONE;
    campaign.progress = NULL;
    bool good = ff_study_run(&campaign, &tally, r->report);
    ff_arena_free(&arena);
    return good;
}

/* The value of the knob in the case, turned; NULL: its stage does not run, or has no such number.
 */
static const char *turn(rounds *r, const ff_pipeline *pipeline, const ff_knob *knob)
{
    const ff_stage *stage = ff_stage_of(pipeline, knob->path);
    size_t i = ff_knob_param(stage, knob->path);
    if (i == SIZE_MAX)
        return NULL;
    const ff_bound *b = &stage->params[i];
    if (b->row->type == FF_INT)
        return keep(&r->arena,
                    ff_print_text("%.0f", fmax(1, round((double)b->value.integer * knob->factor))));
    double number = ff_unit_from_si(&stage->loaded->param_units[i], b->value.real * knob->factor);
    return keep(&r->arena,
                ff_print_text("%.12g %s", number, strcmp(b->row->unit, "1") ? b->row->unit : ""));
}

/* Values of the knobs for the refined case; NULL: there is nothing to refine. */
static const char **refine(rounds *r, size_t index)
{
    const ff_stability *s = r->stability;
    const char **finer = ff_arena_alloc(&r->arena, (s->knob_count + 1) * sizeof *finer);
    shot one = {.cell = index};
    ff_campaign campaign = *r->campaign;
    ff_study single;
    ff_arena arena = {NULL};
    size_t turned = 0;
    ff_case c;
    lay_out(&single, r, &one, 1, &arena);
    campaign.study = &single;
    ff_case_open(&c, &campaign, 0);
    for (size_t k = 0; ff_case_is_good(&c) && k < s->knob_count; k++) {
        finer[k] = turn(r, c.pipeline, &s->knobs[k]);
        turned += finer[k] != NULL;
    }
    ff_case_close(&c);
    ff_arena_free(&arena);
    return turned ? finer : NULL;
}

/* The cells from `first` on: as they stand, then refined where there is something to compare. */
static bool run_cells(rounds *r, size_t first)
{
    for (size_t i = first; i < r->map->count; i++)
        add_shot(r, i, NULL);
    if (!run_round(r))
        return false;
    for (size_t i = first; i < r->map->count; i++) {
        const char **finer = r->map->cells[i].class <= FF_DEGRADED ? refine(r, i) : NULL;
        if (finer)
            add_shot(r, i, finer);
    }
    return run_round(r);
}

static size_t stride_of(const ff_study *study, size_t axis)
{
    size_t stride = 1;
    for (size_t a = study->axis_count; --a > axis;)
        stride *= study->points[a];
    return stride;
}

static void find_boundaries(rounds *r)
{
    const ff_study *study = r->study;
    ff_map *map = r->map;
    for (size_t a = 0; a < study->axis_count; a++) {
        size_t stride = stride_of(study, a);
        for (size_t i = 0; r->stability->halvings[a] && i < study->count; i++) {
            bool last = ff_study_point(study, a, i) + 1 == study->points[a];
            if (last || map->cells[i].class == map->cells[i + stride].class)
                continue;
            map->boundaries =
                ff_resize(map->boundaries, (map->boundary_count + 1) * sizeof *map->boundaries);
            map->boundaries[map->boundary_count++] =
                (ff_boundary){.axis = a,
                              .low = i,
                              .high = i + stride,
                              .slice = i % ff_map_slices(study),
                              .column = ff_study_point(study, 0, i),
                              .row = study->axis_count > 1 ? ff_study_point(study, 1, i) : 0};
        }
    }
}

/* Between the middle and that end which differs from it; where both do, the better one. */
static void narrow(const ff_map *map, ff_boundary *b, size_t middle)
{
    enum ff_class low = map->cells[b->low].class, high = map->cells[b->high].class;
    enum ff_class at = map->cells[middle].class;
    if (at == low || (at != high && high < low))
        b->low = middle;
    else
        b->high = middle;
}

static bool halve(rounds *r)
{
    ff_map *map = r->map;
    size_t most = 0;
    for (size_t i = 0; i < map->boundary_count; i++)
        if (r->stability->halvings[map->boundaries[i].axis] > most)
            most = r->stability->halvings[map->boundaries[i].axis];
    for (size_t n = 0; n < most; n++) {
        size_t first = map->count, next = first;
        for (size_t i = 0; i < map->boundary_count; i++) {
            const ff_boundary *b = &map->boundaries[i];
            if (n < r->stability->halvings[b->axis])
                add_between(r, b->axis, b->low, b->high);
        }
        if (!run_cells(r, first))
            return false;
        for (size_t i = 0; i < map->boundary_count; i++)
            if (n < r->stability->halvings[map->boundaries[i].axis])
                narrow(map, &map->boundaries[i], next++);
    }
    return true;
}

bool ff_stability_run(const ff_campaign *campaign, ff_map *map, ff_tally *tally, ff_report *report)
{
    rounds r = {.campaign = campaign,
                .map = map,
                .study = campaign->study,
                .stability = campaign->study->stability,
                .tally = tally,
                .report = report};
    *map = (ff_map){.study = campaign->study};
    *tally = (ff_tally){.leads = true};
    add_grid(&r);
    bool good = run_cells(&r, 0);
    if (good)
        find_boundaries(&r);
    good = good && halve(&r) && write_table(&r);
    for (size_t i = 0; i < map->count; i++)
        (i < map->study->count ? map->counts : map->more)[map->cells[i].class]++;
    free(r.shots);
    free(r.all);
    ff_arena_free(&r.arena);
    return good && ff_map_write(map, campaign->directory, report);
}

void ff_map_free(ff_map *map)
{
    free(map->cells);
    free(map->boundaries);
    ff_arena_free(&map->arena);
}
