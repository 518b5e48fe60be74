/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files that a fit leaves: a card for pipelines, and the residuals as a table. */
#include "fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A file name may hold anything, a remark ends with its line. */
static void print_name(FILE *out, const char *name)
{
    for (; *name; name++)
        fputc((unsigned char)*name < ' ' || *name == 127 ? '?' : *name, out);
}

static const fit_regression *best_of(const ff_fit *fit, const fit_regression *laws)
{
    const fit_regression *best = NULL;
    for (size_t i = 0; i < fit->law_count; i++)
        if (!*laws[i].why && (!best || laws[i].criterion < best->criterion))
            best = &laws[i];
    return best;
}

static void print_range(FILE *out, const fit_data *d)
{
    double lowest = d->p[0];
    for (size_t i = 1; i < d->n; i++)
        lowest = fmin(lowest, d->p[i]);
    fprintf(out, "%zu rows, %.4g to %.4g GPa", d->n, 1e-9 * lowest, 1e-9 * d->highest);
    if (d->isothermal && d->T)
        fprintf(out, " at %.4g degC", d->temperature - 273.15);
}

static void print_head(FILE *out, const ff_fit *fit, const fit_data *d, const fit_regression *laws,
                       const fit_regression *best)
{
    fputs("# Fitted to ", out);
    print_name(out, fit->source);
    fputs(" by flankfilm fit:\n# ", out);
    print_range(out, d);
    fprintf(out, ".\n#\n# %-28s %5s %8s %11s %7s\n", "law", "found", "rms %", "largest %", "AICc");
    for (size_t i = 0; i < fit->law_count; i++)
        if (!*laws[i].why)
            fprintf(out, "# %-28s %5zu %8.3g %+11.3g %+7.1f\n", fit->laws[i]->id,
                    laws[i].free_count, 100 * laws[i].rms, 100 * laws[i].largest,
                    laws[i].criterion - best->criterion);
    fprintf(out,
            "#\n# The data end at %.4g GPa. From there on, pressure_cap, ln(eta) goes on as a\n"
            "# straight line, and a run that gets there warns that it left the range of the law.\n"
            "# Intervals are of 95 %% confidence.\n",
            1e-9 * d->highest);
}

/* "5.006 mPa s" */
static void print_quantity(FILE *out, const ff_fit_param *param, double si)
{
    double number = (si - param->offset) / param->factor;
    const char *unit = param->row->unit;
    if (!strcmp(unit, "Pa s") && number < 1) {
        number *= 1e3;
        unit = "mPa s";
    }
    bool bare = !*unit || !strcmp(unit, "1");
    fprintf(out, "%.6g%s%s", number, bare ? "" : " ", bare ? "" : unit);
}

static void print_law(FILE *out, const ff_fit_law *law, const fit_regression *r)
{
    fprintf(out, "      %s:\n", law->id);
    for (size_t i = 0; i < law->param_count; i++) {
        const ff_fit_value *value = &r->values[i];
        if (isnan(value->value) || value->how == FF_FIT_UNSAID)
            continue;
        fprintf(out, "        %s: ", law->params[i]->row->name);
        print_quantity(out, law->params[i], value->value);
        if (value->how == FF_FIT_FREE) {
            fputs("   # ", out);
            print_quantity(out, law->params[i], value->low);
            fputs(" to ", out);
            print_quantity(out, law->params[i], value->high);
        } else if (value->how == FF_FIT_AT_LIMIT) {
            fputs("   # its limit: the data want it beyond", out);
        } else {
            fputs("   # held", out);
        }
        fputc('\n', out);
    }
    for (const char *at = r->note; *at;) {
        size_t length = strcspn(at, "\n");
        fprintf(out, "        # %.*s\n", (int)length, at);
        at += length + (at[length] == '\n');
    }
}

char *fit_card(const ff_fit *fit, const fit_data *data, const fit_regression *laws)
{
    char *text = NULL;
    size_t size = 0;
    const fit_regression *best = best_of(fit, laws);
    FILE *out = best ? open_memstream(&text, &size) : NULL;
    if (!out)
        return NULL;
    print_head(out, fit, data, laws, best);
    fprintf(out, "pipeline:\n  oil:\n    use: %s\n    with:\n", fit->laws[best->law]->id);
    for (size_t i = 0; i < fit->law_count; i++)
        if (!*laws[i].why)
            print_law(out, fit->laws[i], &laws[i]);
    fclose(out);
    return text;
}

char *fit_residual_table(const ff_fit *fit, const fit_data *d, const fit_regression *laws)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs("pressure [GPa],viscosity [mPa s]", out);
    for (size_t k = 0; k < fit->law_count; k++)
        if (!*laws[k].why)
            fprintf(out, ",%s [%%]", fit->laws[k]->id);
    for (size_t i = 0; i < d->n; i++) {
        fprintf(out, "\n%.10g,%.10g", 1e-9 * d->p[i], 1e3 * exp(d->ln_eta[i]));
        for (size_t k = 0; k < fit->law_count; k++)
            if (!*laws[k].why)
                fprintf(out, ",%.4g", 100 * expm1(laws[k].residual[i]));
    }
    fputc('\n', out);
    fclose(out);
    return text;
}
