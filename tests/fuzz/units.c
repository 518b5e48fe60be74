/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Units and quantities: "unit\nquantity". What is accepted is finite, and reads back as it was
   printed. */
#include "fuzz.h"

#include <math.h>

static void read_quantity(const char *text, const ff_unit *row, const char *row_text)
{
    char why[200], printed[400];
    double si, again;
    if (!ff_quantity_parse(text, row, row_text, &si, why, sizeof why)) {
        must(why[0] && memchr(why, 0, sizeof why) != NULL);
        return;
    }
    must(isfinite(si));
    ff_quantity_print(si, row, row_text, printed, sizeof printed);
    if (strlen(row_text) > 100 ||
        !ff_quantity_parse(printed, row, row_text, &again, why, sizeof why))
        return; /* too long to print, or rounded past the largest number */
    double shifted = fabs(row->offset) + fmax(fabs(si), fabs(again)); /* six digits are printed */
    must(fabs(again - si) <= 1e-5 * shifted + 1e-300);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = fuzz_text(data, size), why[200];
    const char *end;
    int64_t whole;
    double number;
    ff_unit unit, metre;
    char *line = strchr(text, '\n');
    if (line)
        *line++ = 0;
    const char *quantity = line ? line : text;
    if (ff_unit_parse(text, &unit, why, sizeof why)) {
        must(isfinite(unit.factor) && isfinite(unit.offset) && unit.factor > 0);
        must(ff_unit_same_dimension(&unit, &unit) && ff_unit_examples(&unit) != NULL);
        read_quantity(quantity, &unit, text);
    } else {
        must(why[0] && memchr(why, 0, sizeof why) != NULL);
    }
    must(ff_unit_parse("m", &metre, why, sizeof why));
    read_quantity(quantity, &metre, "m");
    ff_integer_parse(quantity, &whole, why, sizeof why);
    if (ff_number_parse(quantity, &number, &end))
        must(isfinite(number) && end > quantity && end <= quantity + strlen(quantity));
    free(text);
    return 0;
}
