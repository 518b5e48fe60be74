/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A map in letters: slices one below the other, what they mean, and the boundaries. */
#include "command.h"
#include "text.h"

#include "../study/map.h"
#include "../value/unit.h"

#include <stdlib.h>
#include <string.h>

enum { MARGIN = 12, MOST_BOUNDARIES = 40, MOST_CAUSES = 8 };

/* "1.77827941004 m/s": with four digits, to be freed. */
static char *short_value(const char *text)
{
    double number;
    const char *end;
    return ff_number_parse(text, &number, &end) ? ff_print_text("%.4g%s", number, end)
                                                : ff_print_text("%s", text);
}

static void print_slice(const ff_map *map, size_t slice)
{
    const ff_study *study = map->study;
    const ff_varied *across = ff_map_axis(study, 0);
    size_t columns = ff_map_columns(study), rows = ff_map_rows(study);
    for (size_t row = rows; row-- > 0;) {
        char *label = study->axis_count > 1
                          ? short_value(ff_varied_value(ff_map_axis(study, 1), row))
                          : ff_print_text("%s", "");
        printf("  %*s |", MARGIN, label);
        for (size_t column = 0; column < columns; column++)
            printf(" %c",
                   ff_class_letters[map->cells[ff_map_cell(study, slice, column, row)].class]);
        putchar('\n');
        free(label);
    }
    char *first = short_value(ff_varied_value(across, 0));
    char *last = short_value(ff_varied_value(across, columns - 1));
    printf("  %*s   %s ... %s\n", MARGIN, "", first, last);
    free(first);
    free(last);
}

static void print_slices(const ff_map *map)
{
    const ff_study *study = map->study;
    printf("across: %s", ff_map_axis(study, 0)->path);
    if (study->axis_count > 1)
        printf("; up: %s", ff_map_axis(study, 1)->path);
    putchar('\n');
    for (size_t slice = 0; slice < ff_map_slices(study); slice++) {
        putchar('\n');
        for (size_t a = 2; a < study->axis_count; a++) {
            const ff_cell *cell = &map->cells[ff_map_cell(study, slice, 0, 0)];
            char *value = short_value(cell->names[a]);
            printf("  %s: %s\n", ff_map_axis(study, a)->path, value);
            free(value);
        }
        print_slice(map, slice);
    }
    putchar('\n');
}

static const char *cause_of(const ff_cell *cell)
{
    return cell->line ? cell->line : cell->why ? cell->why : "";
}

/* Lines and outputs that decide, with the number of cells; of reasons in words the first few. */
static void print_causes(const ff_map *map, enum ff_class class)
{
    size_t shown = 0, left = 0;
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
        char *text = !cell->line ? ff_print_text("%s", cause_of(cell))
                     : class == FF_SILENT
                         ? ff_print_text("%zu: %s: %s", count, cell->line, cell->why)
                         : ff_print_text("%zu: %s, as %.3g with limit %.3g", count, cell->line,
                                         cell->value, cell->limit);
        fputs("      ", stdout);
        ff_print_cut(text, 6);
        free(text);
    }
    if (left)
        printf("      ... %zu more, see map.csv\n", left);
}

static void print_legend(const ff_map *map)
{
    for (size_t k = 0; k < FF_CLASSES; k++) {
        if (map->counts[k] + map->more[k] == 0)
            continue;
        printf("  %c %zu %s", ff_class_letters[k], map->counts[k], ff_class_names[k]);
        if (map->more[k])
            printf(" and %zu between", map->more[k]);
        printf(": %s\n", ff_class_texts[k]);
        print_causes(map, (enum ff_class)k);
    }
    if (map->counts[FF_SILENT] + map->more[FF_SILENT] == 0)
        puts("  no silent failure");
}

static void print_boundary(const ff_map *map, const ff_boundary *b)
{
    const ff_study *study = map->study;
    const ff_cell *low = &map->cells[b->low], *high = &map->cells[b->high];
    const ff_cell *worse = low->class > high->class ? low : high;
    char *from = short_value(low->names[b->axis]), *to = short_value(high->names[b->axis]);
    char *text = ff_print_text("%s %s | %s %s", from, ff_class_names[low->class], to,
                               ff_class_names[high->class]);
    printf("  %-44s", text);
    for (size_t a = 0; a < study->axis_count; a++) {
        if (a == b->axis)
            continue;
        char *value = short_value(low->names[a]);
        printf(" %s", value);
        free(value);
    }
    if (worse->line)
        printf("  (%s)", worse->line);
    putchar('\n');
    free(from);
    free(to);
    free(text);
}

void ff_print_map(const ff_map *map)
{
    print_slices(map);
    print_legend(map);
    for (size_t a = 0; a < map->study->axis_count; a++) {
        size_t count = 0;
        for (size_t i = 0; i < map->boundary_count; i++) {
            if (map->boundaries[i].axis != a)
                continue;
            if (count == 0)
                printf("\nboundaries along %s:\n", ff_map_axis(map->study, a)->path);
            if (count++ < MOST_BOUNDARIES)
                print_boundary(map, &map->boundaries[i]);
        }
        if (count > MOST_BOUNDARIES)
            printf("  ... and %zu more, see map.json\n", count - MOST_BOUNDARIES);
    }
    putchar('\n');
}
