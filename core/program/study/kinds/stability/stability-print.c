/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints a map in letters: slices one below the other, and a legend. */
#include "stability.h"

#include <math.h>
#include <string.h>

enum { MARGIN = 12, MOST_CAUSES = 8 };

const char *study_map_short(const study_map *map, const char *text)
{
    double number;
    const char *end;
    return ff_number_parse(text, &number, &end)
               ? study_context_format(map->context, "%.4g%s", number, end)
               : text;
}

static void print_slice(const study_map *map, size_t slice)
{
    size_t columns = study_map_columns(map), rows = study_map_rows(map);
    study_line line = {0};
    for (size_t row = rows; row-- > 0;) {
        study_line_add(&line, "  %*s |", MARGIN,
                       map->axis_count > 1 ? study_map_short(map, study_map_value(map, 1, row))
                                           : "");
        for (size_t column = 0; column < columns; column++) {
            const study_cell *cell = &map->cells[study_map_cell(map, slice, column, row)];
            study_line_add(&line, "%s%c%s", column ? "" : " ", study_class_letters[cell->class],
                           cell->note             ? "'"
                           : column + 1 < columns ? " "
                                                  : "");
        }
        study_line_print(map->context, &line, -1);
    }
    study_line_add(&line, "  %*s   %s ... %s", MARGIN, "",
                   study_map_short(map, study_map_value(map, 0, 0)),
                   study_map_short(map, study_map_value(map, 0, columns - 1)));
    study_line_print(map->context, &line, 0);
}

static void print_slices(const study_map *map)
{
    study_line line = {0};
    study_line_add(&line, "across: %s", map->grid->varied[0].path);
    if (map->axis_count > 1)
        study_line_add(&line, "; up: %s", map->grid->varied[1].path);
    study_line_print(map->context, &line, 0);
    for (size_t slice = 0; slice < study_map_slices(map); slice++) {
        study_line_print(map->context, &line, 0);
        for (size_t a = 2; a < map->axis_count; a++) {
            const study_cell *cell = &map->cells[study_map_cell(map, slice, 0, 0)];
            study_line_add(&line, "  %s: %s", map->grid->varied[a].path,
                           study_map_short(map, cell->settings[a].name));
            study_line_print(map->context, &line, 0);
        }
        print_slice(map, slice);
    }
    study_line_print(map->context, &line, 0);
}

static const char *cause_of(const study_cell *cell)
{
    return cell->line ? cell->line : cell->why ? cell->why : "";
}

/* Prints the first few of the deciding lines, outputs or reasons, with their numbers of cells. */
static void print_causes(const study_map *map, enum study_class class)
{
    size_t shown = 0, left = 0;
    study_line line = {0};
    for (size_t i = 0; i < map->count && class != STUDY_CONVERGED; i++) {
        const study_cell *cell = &map->cells[i];
        size_t count = 0, before = 0;
        char value[32];
        for (size_t k = 0; cell->class == class && k < map->count; k++) {
            bool same = map->cells[k].class == class &&
                        strcmp(cause_of(cell), cause_of(&map->cells[k])) == 0;
            count += same;
            before += same && k < i;
        }
        if (count == 0 || before > 0)
            continue;
        left += shown == MOST_CAUSES;
        if (shown == MOST_CAUSES)
            continue;
        shown++;
        snprintf(value, sizeof value, isfinite(cell->value) ? "%.3g" : "not known", cell->value);
        study_line_add(&line, "      ");
        if (!cell->line)
            study_line_add(&line, "%s", cause_of(cell));
        else if (class == STUDY_SILENT)
            study_line_add(&line, "%zu: %s: %s", count, cell->line, cell->why);
        else
            study_line_add(&line, "%zu: %s, for example %s, limit %.3g", count, cell->line, value,
                           cell->limit);
        study_line_print(map->context, &line, 0);
    }
    if (left) {
        study_line_add(&line, "      ... %zu more, see map.csv", left);
        study_line_print(map->context, &line, 0);
    }
}

/* Prints each note with the range of its values. */
static void print_notes(const study_map *map)
{
    study_line line = {0};
    if (map->noted[0] + map->noted[1] == 0)
        return;
    study_line_add(&line, "  ' %zu with a note", map->noted[0]);
    if (map->noted[1])
        study_line_add(&line, " and %zu between", map->noted[1]);
    study_line_add(&line, ": %s", study_note_text);
    study_line_print(map->context, &line, -1);
    for (size_t n = 0; n < map->note_count; n++) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        size_t count = 0;
        for (size_t i = 0; i < map->count; i++)
            if (map->cells[i].note && !isnan(map->cells[i].noted[n])) {
                least = fmin(least, map->cells[i].noted[n]);
                most = fmax(most, map->cells[i].noted[n]);
                count++;
            }
        if (count == 0)
            continue;
        study_line_add(&line, "      %zu: %.3g", count, least);
        if (most > least)
            study_line_add(&line, " to %.3g", most);
        study_line_add(&line, " %s", map->notes[n].words);
        study_line_print(map->context, &line, 0);
    }
}

static void print_legend(const study_map *map)
{
    study_line line = {0};
    for (size_t k = 0; k < STUDY_CLASSES; k++) {
        if (map->counts[k] + map->more[k] == 0)
            continue;
        study_line_add(&line, "  %c %zu %s", study_class_letters[k], map->counts[k],
                       study_class_names[k]);
        if (map->more[k])
            study_line_add(&line, " and %zu between", map->more[k]);
        study_line_add(&line, ": %s", study_class_texts[k]);
        study_line_print(map->context, &line, -1);
        print_causes(map, (enum study_class)k);
    }
    print_notes(map);
    if (map->counts[STUDY_SILENT] + map->more[STUDY_SILENT] == 0)
        study_context_print_line(map->context, 0, "  no silent failure");
}

void study_map_print(const study_map *map)
{
    print_slices(map);
    print_legend(map);
}
