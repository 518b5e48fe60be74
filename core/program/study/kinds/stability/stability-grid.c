/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layout of a map's grid, and the results of its cells. */
#include "stability.h"

size_t study_map_columns(const study_map *map)
{
    return map->grid->points[0];
}

size_t study_map_rows(const study_map *map)
{
    return map->axis_count > 1 ? map->grid->points[1] : 1;
}

size_t study_map_slices(const study_map *map)
{
    return map->grid->count / study_map_columns(map) / study_map_rows(map);
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
        stride *= map->grid->points[a];
    return stride;
}

const char *study_map_value(const study_map *map, size_t axis, size_t point)
{
    return study_varied_value(&map->grid->varied[axis], point);
}

const study_outcome *study_map_outcome(const study_map *map, int64_t number)
{
    return number == STUDY_NOT_SUBMITTED ? NULL : study_outcome_of(map->context, (size_t)number);
}
