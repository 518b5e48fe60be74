/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The result files of a fit: a card for pipelines, and the residuals as a table. */
#include "fit.h"

#include <math.h>
#include <string.h>

/* A file name may contain any character; a line break would end the comment. */
static void print_name(FILE *out, const char *name)
{
    for (; *name; name++)
        fputc((unsigned char)*name < ' ' || *name == 127 ? '?' : *name, out);
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

static void print_head(FILE *out, const fit *f, const fit_law *best)
{
    fputs("# Fitted to ", out);
    print_name(out, f->path);
    fputs(" by flankfilm fit:\n# ", out);
    print_range(out, &f->data);
    fprintf(out, ".\n#\n# %-28s %5s %8s %11s %7s\n", "law", "found", "rms %", "largest %", "AICc");
    for (size_t i = 0; i < f->law_count; i++)
        if (!*f->laws[i].why)
            fprintf(out, "# %-28s %5zu %8.3g %+11.3g %+7.1f\n", f->laws[i].id,
                    f->laws[i].free_count, 100 * f->laws[i].rms, 100 * f->laws[i].largest,
                    f->laws[i].criterion - best->criterion);
    fprintf(
        out,
        "#\n# The data end at %.4g GPa. Beyond this pressure_cap, ln(eta) continues as a straight\n"
        "# line, and a run that reaches it warns that it leaves the range of the law.\n"
        "# Intervals have 95 %% confidence. The laws contain eta0, for a pipeline without an oil\n"
        "# stage.\n",
        1e-9 * f->data.highest);
}

/* "5.006 mPa s" */
static void print_quantity(FILE *out, const fit_param *param, double si)
{
    double number = ff_unit_from_si(param->unit, si);
    const char *unit = param->row->unit;
    if (!strcmp(unit, "Pa s") && number < 1) {
        number *= 1e3;
        unit = "mPa s";
    }
    bool bare = !*unit || !strcmp(unit, "1");
    fprintf(out, "%.6g%s%s", number, bare ? "" : " ", bare ? "" : unit);
}

static void print_law(FILE *out, const fit_law *law)
{
    fprintf(out, "      %s:\n", law->id);
    for (size_t i = 0; i < law->param_count; i++) {
        const fit_param *param = &law->params[i];
        if (isnan(param->value) || param->found == FIT_PRESET)
            continue;
        fprintf(out, "        %s: ", param->row->name);
        print_quantity(out, param, param->value);
        if (param->found == FIT_FREE) {
            fputs("   # ", out);
            print_quantity(out, param, param->low);
            fputs(" to ", out);
            print_quantity(out, param, param->high);
        } else if (param->found == FIT_AT_LIMIT) {
            fputs("   # its limit: the data fit better beyond it", out);
        } else {
            fputs("   # held", out);
        }
        fputc('\n', out);
    }
    for (const char *at = law->note; *at;) {
        size_t length = strcspn(at, "\n");
        fprintf(out, "        # %.*s\n", (int)length, at);
        at += length + (at[length] == '\n');
    }
}

void fit_write_card(const fit *f, FILE *out)
{
    const fit_law *best = fit_best(f);
    print_head(out, f, best);
    fprintf(out, "pipeline:\n  viscosity:\n    use: %s\n    with:\n", best->id);
    for (size_t i = 0; i < f->law_count; i++)
        if (!*f->laws[i].why)
            print_law(out, &f->laws[i]);
}

void fit_write_residuals(const fit *f, FILE *out)
{
    const fit_data *d = &f->data;
    fputs("pressure [GPa],viscosity [mPa s]", out);
    for (size_t k = 0; k < f->law_count; k++)
        if (!*f->laws[k].why)
            fprintf(out, ",%s [%%]", f->laws[k].id);
    for (size_t i = 0; i < d->n; i++) {
        fprintf(out, "\n%.10g,%.10g", 1e-9 * d->p[i], 1e3 * exp(d->ln_eta[i]));
        for (size_t k = 0; k < f->law_count; k++)
            if (!*f->laws[k].why)
                fprintf(out, ",%.4g", 100 * expm1(f->laws[k].residual[i]));
    }
    fputc('\n', out);
}
