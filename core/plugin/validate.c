/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a descriptor must be before anything else of the program looks at it. */
#include "../value/memory.h"
#include "clean.h"
#include "param.h"
#include "private.h"

#include <math.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PARAMS = 1000, MOST_INPUTS = 256, MOST_OUTPUTS = 64, LONGEST_NAME = 64 };

typedef struct checking {
    const ff_model *model;
    ff_loaded *loaded;
    char *why;
    size_t why_size;
} checking;

__attribute__((format(printf, 2, 3))) static bool fault(const checking *c, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(c->why, c->why_size, format, args);
    va_end(args);
    return false;
}

static bool is_name(const char *text, size_t length)
{
    static const char rest[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return length > 0 && length < LONGEST_NAME && !strchr("0123456789", text[0]) &&
           strspn(text, rest) >= length;
}

/* Names parted by dots. */
static bool is_dotted_name(const char *text)
{
    for (;;) {
        size_t length = strcspn(text, ".");
        if (!is_name(text, length))
            return false;
        if (!text[length])
            return true;
        text += length + 1;
    }
}

static bool is_line(const char *text)
{
    return text && text[0] && ff_text_is_clean(text);
}

static bool is_kind(const char *text, size_t length)
{
    return length > 0 && length < LONGEST_NAME &&
           strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789-") >= length;
}

bool ff_id_is_legal(const char *id)
{
    size_t kind = strcspn(id, "/");
    return id[kind] && is_kind(id, kind) && is_kind(id + kind + 1, strlen(id + kind + 1));
}

static bool check_version(const checking *c)
{
    const ff_model *m = c->model;
    if (!m)
        return fault(c, "gives no model");
    if (!FF_HAS(m, abi_minor))
        return fault(c, "gives a model that is no larger than %zu bytes", m->size);
    if (m->abi_major != FF_ABI_MAJOR)
        return fault(c, "is made for version %u of the plugin interface, but this program has %d",
                     m->abi_major, FF_ABI_MAJOR);
    if (m->abi_minor > FF_ABI_MINOR)
        return fault(c,
                     "needs version %u.%u of the plugin interface, but this program has %d.%d: a "
                     "newer flankfilm is needed",
                     m->abi_major, m->abi_minor, FF_ABI_MAJOR, FF_ABI_MINOR);
    if (!FF_HAS(m, destroy))
        return fault(c, "gives a model of %zu bytes, less than version 1.0 of the interface has",
                     m->size);
    return true;
}

static bool check_head(const checking *c, const char *id)
{
    const ff_model *m = c->model;
    if (!m->id || strcmp(m->id, id) != 0)
        return fault(c, "calls itself \"%.100s\", but its place says \"%s\"",
                     m->id ? m->id : "nothing", id);
    if (!is_line(m->version))
        return fault(c, "states no version of its own");
    if (!is_line(m->summary))
        return fault(c, "has no summary of one line");
    if (!is_line(m->licence))
        return fault(c, "states no licence");
    if (!m->reference || !m->bibtex)
        return fault(c, "has no reference to the literature (\"\" where there is none)");
    return true;
}

static bool check_table(const checking *c, const char *what, const void *rows, size_t count,
                        size_t stride, size_t least, size_t most)
{
    if (count == 0)
        return true;
    if (!rows)
        return fault(c, "says that it has %zu %s, but gives no table of them", count, what);
    if (count > most)
        return fault(c, "has %zu %s; at most %zu are possible", count, what, most);
    if (stride < least || stride % alignof(ff_param) != 0)
        return fault(c, "gives its table of %s in rows of %zu bytes; version 1.0 has %zu", what,
                     stride, least);
    return true;
}

static bool check_tables(const checking *c)
{
    const ff_model *m = c->model;
    return check_table(c, "parameters", m->params, m->param_count, m->param_stride,
                       sizeof(ff_param), MOST_PARAMS) &&
           check_table(c, "inputs", m->inputs, m->input_count, m->input_stride, sizeof(ff_port),
                       MOST_INPUTS) &&
           check_table(c, "outputs", m->outputs, m->output_count, m->output_stride, sizeof(ff_port),
                       MOST_OUTPUTS);
}

static bool check_functions(const checking *c)
{
    const ff_model *m = c->model;
    bool data = false, service = false, wired = false;
    for (size_t i = 0; i < m->output_count; i++) {
        bool serves = ff_model_output(m, i)->service;
        service = service || serves;
        data = data || !serves;
    }
    for (size_t i = 0; i < m->input_count; i++)
        wired = wired || ff_model_input(m, i)->service;
    const char *missing = !m->create                  ? "create"
                          : data && !m->evaluate      ? "evaluate"
                          : service && !m->service    ? "service"
                          : m->param_count && !m->set ? "set"
                          : wired && !m->wire         ? "wire"
                                                      : NULL;
    if (missing)
        return fault(c, "lacks the function \"%s\", which its tables call for", missing);
    if (m->output_count == 0)
        return fault(c, "offers no output");
    return true;
}

static bool check_words(const checking *c, const ff_param *row)
{
    char word[LONGEST_NAME + 1], other[LONGEST_NAME + 1];
    bool takes = row->type == FF_CHOICE || row->type == FF_REAL || row->type == FF_INT;
    if (row->type == FF_CHOICE && !row->choices)
        return fault(c, "gives the parameter \"%s\" nothing to choose from", row->name);
    if (row->choices && !takes)
        return fault(c, "states choices for the parameter \"%s\", whose type takes none",
                     row->name);
    for (size_t i = 0; ff_word_at(row->choices, i, word, sizeof word); i++) {
        double number;
        const char *end;
        size_t length = strlen(word);
        if (length == 0 || length >= LONGEST_NAME || !ff_text_is_clean(word) ||
            strpbrk(word, " \"'[]{},:#") || ff_number_parse(word, &number, &end))
            return fault(c, "has the choice \"%s\" for the parameter \"%s\", which is no word",
                         word, row->name);
        for (size_t k = 0; k < i && ff_word_at(row->choices, k, other, sizeof other); k++)
            if (!strcmp(word, other))
                return fault(c, "has the choice \"%s\" twice for the parameter \"%s\"", word,
                             row->name);
    }
    return true;
}

/* A range holds when its first number is smaller; both 0 stands for none. */
static bool check_range(const checking *c, const ff_param *row, const char *what, double from,
                        double to)
{
    if (isnan(from) || isnan(to) || from > to || (from == to && from != 0))
        return fault(c, "has impossible %s %g to %g for the parameter \"%s\"", what, from, to,
                     row->name);
    return true;
}

static bool check_limits(const checking *c, const ff_param *row)
{
    if (!check_range(c, row, "limits", row->min, row->max) ||
        !check_range(c, row, "bounds of calibration", row->low, row->high))
        return false;
    bool both = row->min < row->max && row->low < row->high;
    if (both && (row->low > row->max || row->high < row->min))
        return fault(c, "has a calibrated range outside the limits of the parameter \"%s\"",
                     row->name);
    if (row->max_count && row->min_count > row->max_count)
        return fault(c, "asks for %u to %u numbers for the parameter \"%s\"", row->min_count,
                     row->max_count, row->name);
    return true;
}

static bool check_preset(const checking *c, const ff_param *row, const ff_unit *unit)
{
    if (!row->preset)
        return true;
    if ((row->flags & FF_REQUIRED) && !row->group)
        return fault(c, "has a preset for the parameter \"%s\", which must be given", row->name);
    if (row->type == FF_FILE)
        return fault(c, "has a preset for the file \"%s\"", row->name);
    ff_report *report = ff_report_new();
    ff_value value;
    bool good = ff_param_read_preset(row, unit, row->name, &value, report);
    if (good)
        ff_value_clear(&value);
    else
        fault(c, "has an impossible preset \"%.60s\": %s", row->preset,
              ff_report_count(report) ? ff_report_at(report, 0)->text : row->name);
    ff_report_free(report);
    return good;
}

static bool check_unit(const checking *c, const char *what, const char *name, const char *text,
                       ff_unit *unit)
{
    char clause[256];
    if (!text)
        return fault(c, "states no unit for the %s \"%s\"", what, name);
    if (!ff_unit_parse(text, unit, clause, sizeof clause))
        return fault(c, "has a bad unit for the %s \"%s\": the unit \"%.40s\" %s", what, name, text,
                     clause);
    return true;
}

static bool check_param(const checking *c, size_t index)
{
    const ff_param *row = ff_model_param(c->model, index);
    ff_unit *unit = &c->loaded->param_units[index];
    if (!row->name || !is_dotted_name(row->name) || strlen(row->name) >= LONGEST_NAME)
        return fault(c, "gives its parameter %zu the name \"%.60s\", which is none", index + 1,
                     row->name ? row->name : "");
    if (!strcmp(row->name, "use") || !strcmp(row->name, "with"))
        return fault(c, "calls a parameter \"%s\", a word of the file's own", row->name);
    if (row->type < FF_REAL || row->type > FF_FILE)
        return fault(c, "gives the parameter \"%s\" the unknown type %d", row->name, row->type);
    if (row->flags >= 2 * FF_INCREASING)
        return fault(c, "sets unknown flags for the parameter \"%s\"", row->name);
    if (!is_line(row->doc))
        return fault(c, "has no line of explanation for the parameter \"%s\"", row->name);
    return check_unit(c, "parameter", row->name, row->unit, unit) && check_words(c, row) &&
           check_limits(c, row) && check_preset(c, row, unit);
}

/* Equal names, and a name that is also a map of others: "atlas" beside "atlas.from". */
static bool check_param_names(const checking *c)
{
    for (size_t i = 0; i < c->model->param_count; i++) {
        const char *name = ff_model_param(c->model, i)->name;
        size_t length = strlen(name);
        for (size_t k = 0; k < c->model->param_count; k++) {
            const char *other = ff_model_param(c->model, k)->name;
            if (k != i && !strncmp(name, other, length) && (!other[length] || other[length] == '.'))
                return fault(c, "has the parameter \"%s\" twice", name);
        }
    }
    return true;
}

static bool check_kinds(const checking *c, const ff_port *row)
{
    for (const char *at = row->from; at;) {
        size_t length = strcspn(at, "|");
        if (!is_kind(at, length))
            return fault(c, "wires the input \"%s\" from \"%.60s\", which names no kinds",
                         row->name, row->from);
        at = at[length] ? at + length + 1 : NULL;
    }
    return true;
}

static bool check_port(const checking *c, const char *what, const ff_port *row, ff_unit *unit,
                       ff_dims *dims)
{
    char clause[256];
    if (row->flags > FF_OPTIONAL)
        return fault(c, "sets unknown flags for the %s \"%s\"", what, row->name);
    if (!is_line(row->doc))
        return fault(c, "has no line of explanation for the %s \"%s\"", what, row->name);
    if (row->service &&
        (!is_line(row->service) || (row->unit && row->unit[0]) || (row->dims && row->dims[0])))
        return fault(c, "has a bad interface, a unit or dimensions for the service \"%s\"",
                     row->name);
    if (row->service)
        return true;
    if (!check_unit(c, what, row->name, row->unit, unit))
        return false;
    if (!ff_unit_is_si(unit))
        return fault(c, "has the unit \"%s\" for the %s \"%s\", which is not coherent SI",
                     row->unit, what, row->name);
    if (!row->dims)
        return fault(c, "states no dimensions for the %s \"%s\"", what, row->name);
    if (!ff_dims_parse(row->dims, dims, clause, sizeof clause))
        return fault(c, "has bad dimensions for the %s \"%s\": \"%.60s\" %s", what, row->name,
                     row->dims, clause);
    return true;
}

static bool same_text(const char *a, const char *b)
{
    return a == b || (a && b && !strcmp(a, b));
}

/* A wire must not be mistaken for a parameter, nor its rows be wired differently. */
static bool check_wire(const checking *c, size_t index)
{
    const ff_port *row = ff_model_input(c->model, index);
    size_t length = strcspn(row->name, ".");
    for (size_t i = 0; i < index; i++) {
        const ff_port *other = ff_model_input(c->model, i);
        if (!strcmp(row->name, other->name))
            return fault(c, "has the input \"%s\" twice", row->name);
        if (strcspn(other->name, ".") == length && !strncmp(row->name, other->name, length) &&
            !same_text(row->from, other->from))
            return fault(c, "wires the inputs \"%s\" and \"%s\" from different kinds", other->name,
                         row->name);
    }
    for (size_t i = 0; i < c->model->param_count; i++) {
        const char *name = ff_model_param(c->model, i)->name;
        if (strcspn(name, ".") == length && !strncmp(row->name, name, length))
            return fault(c, "calls both a wire and a parameter \"%.*s\"", (int)length, row->name);
    }
    return check_kinds(c, row);
}

static bool check_input(const checking *c, size_t index)
{
    enum { LONGEST_WIRE = 47 };
    const ff_port *row = ff_model_input(c->model, index);
    const char *name = row->name ? row->name : "";
    size_t wire = strcspn(name, ".");
    bool named = is_name(name, wire) && wire <= LONGEST_WIRE &&
                 (row->service ? !name[wire]
                               : name[wire] && is_name(name + wire + 1, strlen(name + wire + 1)));
    if (!named)
        return fault(c,
                     "gives its input %zu the name \"%.60s\"; it must be \"wire.output\", or "
                     "\"wire\" for a service",
                     index + 1, name);
    if ((wire == 3 && !strncmp(name, "use", 3)) || (wire == 4 && !strncmp(name, "with", 4)))
        return fault(c, "calls a wire \"%.*s\", a word of the file's own", (int)wire, name);
    return check_port(c, "input", row, &c->loaded->input_units[index],
                      &c->loaded->input_dims[index]) &&
           check_wire(c, index);
}

static bool check_output(const checking *c, size_t index)
{
    const ff_port *row = ff_model_output(c->model, index);
    if (!row->name || !is_name(row->name, strlen(row->name)))
        return fault(c, "gives its output %zu the name \"%.60s\", which is none", index + 1,
                     row->name ? row->name : "");
    for (size_t i = 0; i < index; i++)
        if (!strcmp(row->name, ff_model_output(c->model, i)->name))
            return fault(c, "has the output \"%s\" twice", row->name);
    return check_port(c, "output", row, &c->loaded->output_units[index],
                      &c->loaded->output_dims[index]);
}

bool ff_model_check(const ff_model *model, const char *id, ff_loaded *loaded, char *why,
                    size_t why_size)
{
    checking c = {.model = model, .loaded = loaded, .why = why, .why_size = why_size};
    if (!check_version(&c) || !check_head(&c, id) || !check_tables(&c) || !check_functions(&c))
        return false;
    loaded->param_units = ff_alloc(model->param_count * sizeof(ff_unit));
    loaded->input_units = ff_alloc(model->input_count * sizeof(ff_unit));
    loaded->output_units = ff_alloc(model->output_count * sizeof(ff_unit));
    loaded->input_dims = ff_alloc(model->input_count * sizeof(ff_dims));
    loaded->output_dims = ff_alloc(model->output_count * sizeof(ff_dims));
    for (size_t i = 0; i < model->param_count; i++)
        if (!check_param(&c, i))
            return false;
    if (!check_param_names(&c))
        return false;
    for (size_t i = 0; i < model->input_count; i++)
        if (!check_input(&c, i))
            return false;
    for (size_t i = 0; i < model->output_count; i++)
        if (!check_output(&c, i))
            return false;
    return true;
}
