/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the fit as text. */
#include "fit.h"

#include "../terminal/terminal.h"

#include <math.h>
#include <string.h>

enum { NAME = 28, PARAM = 18, VALUE = 20 };

static void print_data(const fit *f)
{
    printf("%s: %zu rows", f->path, f->table->row_count);
    for (size_t k = 0; k < FIT_COLUMNS; k++) {
        char first[64], last[64];
        double low, high;
        if (!f->table->columns[k])
            continue;
        fit_range(f, k, &low, &high);
        ff_quantity_print(low, &f->units[k], f->rows[k].unit, first, sizeof first);
        ff_quantity_print(high, &f->units[k], f->rows[k].unit, last, sizeof last);
        printf(", %s %s", f->rows[k].name, first);
        if (strcmp(first, last) != 0)
            printf(" to %s", last);
    }
    printf("\n\n");
}

static bool was_asked(const fit *f)
{
    for (size_t i = 0; i < f->law_count; i++)
        if (!*f->laws[i].why && !isnan(f->laws[i].asked))
            return true;
    return false;
}

static void print_table(const fit *f)
{
    double best = fit_best(f)->criterion;
    bool asked = was_asked(f);
    printf("%-*s %5s %9s %22s %9s%s\n", NAME, "law", "found", "rms", "largest", "AICc",
           asked ? "  at that point" : "");
    for (size_t i = 0; i < f->law_count; i++) {
        const fit_law *law = &f->laws[i];
        char largest[64], value[64];
        if (*law->why)
            continue;
        snprintf(largest, sizeof largest, "%+.3g %% in line %u", 100 * law->largest,
                 f->table->lines[law->largest_row]);
        printf("%-*s %5zu %7.3g %% %22s %+9.1f", NAME, law->id, law->free_count, 100 * law->rms,
               largest, law->criterion - best);
        ff_quantity_print(law->asked, &f->units[FIT_VISCOSITY], f->rows[FIT_VISCOSITY].unit, value,
                          sizeof value);
        printf("%s%s\n", asked ? "  " : "", asked ? value : "");
    }
}

static void print_quantity(const fit_param *param, double si, char text[64])
{
    ff_quantity_print(si, param->unit, param->row->unit, text, 64);
}

static void print_param(const fit_param *param)
{
    char text[64], low[64], high[64];
    if (isnan(param->value) || param->found == FIT_PRESET)
        return;
    print_quantity(param, param->value, text);
    printf("  %-*s %-*s", PARAM, param->row->name, VALUE, text);
    if (param->found == FIT_AT_LIMIT) {
        printf(" at its limit");
    } else if (param->found == FIT_HELD) {
        printf(" held");
    } else {
        print_quantity(param, param->low, low);
        print_quantity(param, param->high, high);
        printf(" %s to %s", low, high);
    }
    putchar('\n');
}

/* Prints the remarks on a law, each on a new line. */
static void print_notes(const char *note)
{
    while (*note) {
        char line[600];
        size_t length = strcspn(note, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, note);
        printf("  ");
        terminal_print_wrapped(line, 2, 4);
        note += length + (note[length] == '\n');
    }
}

void fit_print(const fit *f)
{
    print_data(f);
    print_table(f);
    printf("\n95 %% confidence:\n");
    for (size_t i = 0; i < f->law_count; i++) {
        const fit_law *law = &f->laws[i];
        if (*law->why)
            continue;
        printf("\n%s\n", law->id);
        for (size_t k = 0; k < law->param_count; k++)
            print_param(&law->params[k]);
        print_notes(law->note);
    }
}
