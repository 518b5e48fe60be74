/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "origin.h"

#include <stdlib.h>
#include <string.h>

static const char *fact(const ff_view *view, const char *name)
{
    for (size_t i = 0; i < view->fact_count; i++)
        if (!strcmp(view->facts[i]->name, name))
            return view->facts[i]->text;
    return "";
}

/* Defines an attribute of the file from what `print` writes. */
static void define_text(writer_nc_file *f, const char *name, void (*print)(const ff_view *, FILE *))
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out)
        print(f->view, out);
    if (!out || fclose(out) != 0)
        f->status = FF_NOMEM;
    else
        writer_nc_text(f, NC_GLOBAL, name, text);
    free(text);
}

static void print_parameters(const ff_view *view, FILE *out)
{
    for (size_t i = 0; i < view->stage_count; i++) {
        const ff_view_stage *stage = view->stages[i];
        fprintf(out, "%s: %s %s, file %s\n", stage->name, stage->model, stage->version,
                stage->build);
        for (size_t k = 0; k < stage->param_count; k++)
            fprintf(out, "%s.%s: %s (%s)\n", stage->name, stage->params[k]->name,
                    stage->params[k]->text, stage->params[k]->origin);
    }
}

static void print_references(const ff_view *view, FILE *out)
{
    for (size_t i = 0; i < view->citation_count; i++)
        fprintf(out, "%s: %s\n", view->citations[i]->model, view->citations[i]->reference);
}

static void print_bibtex(const ff_view *view, FILE *out)
{
    for (size_t i = 0; i < view->citation_count; i++)
        fprintf(out, "%s\n", view->citations[i]->bibtex);
}

void writer_nc_define_globals(writer_nc_file *f)
{
    writer_nc_text(f, NC_GLOBAL, "Conventions", "CF-1.10");
    writer_nc_text(f, NC_GLOBAL, "title", f->view->title);
    writer_nc_format(f, NC_GLOBAL, "source", "flankfilm %s", fact(f->view, "flankfilm"));
    writer_nc_format(f, NC_GLOBAL, "history", "%s: computed by flankfilm from %s",
                     fact(f->view, "date"), fact(f->view, "file"));
    define_text(f, "references", print_references);
    define_text(f, "parameters", print_parameters);
    define_text(f, "bibtex", print_bibtex);
    for (size_t i = 0; i < f->view->fact_count; i++)
        if (strcmp(f->view->facts[i]->name, "flankfilm") != 0) {
            char name[100];
            snprintf(name, sizeof name, "flankfilm %s", f->view->facts[i]->name);
            for (char *at = name; *at; at++)
                *at = *at == ' ' ? '_' : *at;
            writer_nc_text(f, NC_GLOBAL, name, f->view->facts[i]->text);
        }
}
