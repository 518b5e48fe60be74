/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A map in letters: slices one below the other, what they mean, and the boundaries. */
#include "stability.h"

#include <math.h>

enum { MARGIN = 12, MOST_BOUNDARIES = 40, MOST_CAUSES = 8 };

/* "1.77827941004 m/s": with four digits. */
static const char *short_value(const ff_map *map, const char *text)
{
    double number;
    const char *end;
    return ff_number(text, &number, &end) ? ff_keep(map->desk, "%.4g%s", number, end) : text;
}

static void print_slice(const ff_map *map, size_t slice)
{
    size_t columns = ff_map_columns(map), rows = ff_map_rows(map);
    ff_line line = {0};
    for (size_t row = rows; row-- > 0;) {
        ff_put(&line, "  %*s |", MARGIN,
               map->axis_count > 1 ? short_value(map, ff_map_value(map, 1, row)) : "");
        for (size_t column = 0; column < columns; column++) {
            const ff_cell *cell = &map->cells[ff_map_cell(map, slice, column, row)];
            ff_put(&line, "%s%c%s", column ? "" : " ", ff_class_letters[cell->class],
                   cell->note             ? "'"
                   : column + 1 < columns ? " "
                                          : "");
        }
        ff_tell(map->desk, &line, -1);
    }
    ff_put(&line, "  %*s   %s ... %s", MARGIN, "", short_value(map, ff_map_value(map, 0, 0)),
           short_value(map, ff_map_value(map, 0, columns - 1)));
    ff_tell(map->desk, &line, 0);
}

static void print_slices(const ff_map *map)
{
    ff_line line = {0};
    ff_put(&line, "across: %s", map->grid->paths[0]);
    if (map->axis_count > 1)
        ff_put(&line, "; up: %s", map->grid->paths[1]);
    ff_tell(map->desk, &line, 0);
    for (size_t slice = 0; slice < ff_map_slices(map); slice++) {
        ff_tell(map->desk, &line, 0);
        for (size_t a = 2; a < map->axis_count; a++) {
            const ff_cell *cell = &map->cells[ff_map_cell(map, slice, 0, 0)];
            ff_put(&line, "  %s: %s", map->grid->paths[a], short_value(map, cell->points[a].name));
            ff_tell(map->desk, &line, 0);
        }
        print_slice(map, slice);
    }
    ff_tell(map->desk, &line, 0);
}

static const char *cause_of(const ff_cell *cell)
{
    return cell->line ? cell->line : cell->why ? cell->why : "";
}

/* Lines and outputs that decide, with the number of cells; of reasons in words the first few. */
static void print_causes(const ff_map *map, enum ff_class class)
{
    size_t shown = 0, left = 0;
    ff_line line = {0};
    for (size_t i = 0; i < map->count && class != FF_CONVERGED; i++) {
        const ff_cell *cell = &map->cells[i];
        size_t count = 0, before = 0;
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
        ff_put(&line, "      ");
        if (!cell->line)
            ff_put(&line, "%s", cause_of(cell));
        else if (class == FF_SILENT)
            ff_put(&line, "%zu: %s: %s", count, cell->line, cell->why);
        else
            ff_put(&line, "%zu: %s, as %.3g with limit %.3g", count, cell->line, cell->value,
                   cell->limit);
        ff_tell(map->desk, &line, 0);
    }
    if (left) {
        ff_put(&line, "      ... %zu more, see map.csv", left);
        ff_tell(map->desk, &line, 0);
    }
}

/* Each note with its values. */
static void print_notes(const ff_map *map)
{
    ff_line line = {0};
    if (map->noted[0] + map->noted[1] == 0)
        return;
    ff_put(&line, "  ' %zu with a note", map->noted[0]);
    if (map->noted[1])
        ff_put(&line, " and %zu between", map->noted[1]);
    ff_put(&line, ": %s", ff_note_text);
    ff_tell(map->desk, &line, -1);
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
        ff_put(&line, "      %zu: %.3g", count, least);
        if (most > least)
            ff_put(&line, " to %.3g", most);
        ff_put(&line, " %s", map->notes[n].words);
        ff_tell(map->desk, &line, 0);
    }
}

static void print_legend(const ff_map *map)
{
    ff_line line = {0};
    for (size_t k = 0; k < FF_CLASSES; k++) {
        if (map->counts[k] + map->more[k] == 0)
            continue;
        ff_put(&line, "  %c %zu %s", ff_class_letters[k], map->counts[k], ff_class_names[k]);
        if (map->more[k])
            ff_put(&line, " and %zu between", map->more[k]);
        ff_put(&line, ": %s", ff_class_texts[k]);
        ff_tell(map->desk, &line, -1);
        print_causes(map, (enum ff_class)k);
    }
    print_notes(map);
    if (map->counts[FF_SILENT] + map->more[FF_SILENT] == 0)
        map->desk->say(map->desk->ctx, 0, "  no silent failure");
}

static void print_boundary(const ff_map *map, const ff_boundary *b)
{
    const ff_cell *low = &map->cells[b->low], *high = &map->cells[b->high];
    const ff_cell *worse = low->class > high->class ? low : high;
    ff_line line = {0};
    ff_put(&line, "  %s %s | %s %s", short_value(map, low->points[b->axis].name),
           ff_class_names[low->class], short_value(map, high->points[b->axis].name),
           ff_class_names[high->class]);
    ff_put(&line, "%*s", line.used < 46 ? (int)(46 - line.used) : 0, "");
    for (size_t a = 0; a < map->axis_count; a++)
        if (a != b->axis)
            ff_put(&line, " %s", short_value(map, low->points[a].name));
    if (worse->line)
        ff_put(&line, "  (%s)", worse->line);
    ff_tell(map->desk, &line, -1);
}

void ff_map_print(const ff_map *map)
{
    ff_line line = {0};
    print_slices(map);
    print_legend(map);
    for (size_t a = 0; a < map->axis_count; a++) {
        size_t count = 0;
        for (size_t i = 0; i < map->boundary_count; i++) {
            if (map->boundaries[i].axis != a)
                continue;
            if (count == 0) {
                map->desk->say(map->desk->ctx, 0, "");
                ff_put(&line, "boundaries along %s:", map->grid->paths[a]);
                ff_tell(map->desk, &line, 0);
            }
            if (count++ < MOST_BOUNDARIES)
                print_boundary(map, &map->boundaries[i]);
        }
        if (count > MOST_BOUNDARIES) {
            ff_put(&line, "  ... and %zu more, see map.json", count - MOST_BOUNDARIES);
            ff_tell(map->desk, &line, 0);
        }
    }
    map->desk->say(map->desk->ctx, 0, "");
}
