/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reader of tables. What is accepted is finite, inside its limits, and stands where it is said
   to stand. */
#include "fuzz.h"

#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

static const ff_param rows[] = {
    {.name = "time",
     .unit = "s",
     .doc = "of the instant",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_INCREASING},
    {.name = "angle", .unit = "deg", .doc = "of roll", .type = FF_REALS, .group = "place"},
    {.name = "length",
     .unit = "um",
     .doc = "along",
     .type = FF_REALS,
     .flags = FF_MIN_OPEN,
     .group = "place",
     .min = 0,
     .max = 1e6},
    {.name = "gear",
     .unit = "1",
     .doc = "1 or 2",
     .type = FF_REALS,
     .flags = FF_WHOLE,
     .min = 1,
     .max = 2,
     .max_count = 500},
};
enum { TIME, ANGLE, LENGTH, GEAR, COLUMNS };

static void check_cell(const ff_table *c, size_t row, size_t column)
{
    double value = c->columns[column][row];
    ff_place place = ff_columns_place(c, row, column);
    must(isfinite(value));
    must(place.line == c->lines[row] && place.column >= 1 && place.width >= 1);
    must(column != TIME || row == 0 || value >= c->columns[TIME][row - 1]);
    must(column != LENGTH || (value > 0 && value <= 1));
    must(column != GEAR || (floor(value) == value && value >= 1 && value <= 2));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[40];
    int file = memfd_create("table", 0);
    must(file >= 0 && (!size || write(file, data, size) == (ssize_t)size));
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    ff_report *report = ff_report_new();
    const ff_table *c = ff_columns_read(path, rows, COLUMNS, sizeof *rows, report);
    close(file);
    must((c != NULL) == (ff_report_errors(report) == 0));
    must(!c || (c->row_count > 0 && c->columns[TIME]));
    for (size_t k = 0; c && k < COLUMNS; k++)
        for (size_t i = 0; c->columns[k] && i < c->row_count; i++)
            check_cell(c, i, k);
    for (size_t i = 0; c && i < COLUMNS + 2; i++)
        ff_columns_place(c, c->row_count - i, i);
    ff_columns_free(c);
    fuzz_print(report);
    ff_report_free(report);
    return 0;
}
