/* SPDX-License-Identifier: MIT */
/* Checks a descriptor before anything else uses it. */
#include "../value/memory.h"
#include "clean.h"
#include "param.h"
#include "private.h"
#include "rows.h"

#include <math.h>
#include <stdalign.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Size of a row in version 1.0; rows of later versions are longer. */
static const size_t param_row_1_0 = offsetof(ff_param, place);
static const size_t port_row_1_0 = offsetof(ff_port, min);

enum {
    MOST_PARAMS = 1000,
    MOST_INPUTS = 256,
    MOST_OUTPUTS = 1000,
    MOST_OUTPUTS_1_0 = 64,
    MOST_COLUMNS = 100,
};

typedef struct checking {
    const ff_model *model;
    const char *what, *name; /* the row that is checked: "parameter", "module" */
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

/* A condition that must hold, and the message if it does not. */
typedef struct claim {
    bool holds;
    const char *fault;
} claim;

/* Reports the first condition that does not hold; the message names the current row, or the
   model. */
static bool check_claims(const checking *c, const claim *claims, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!claims[i].holds && c->name)
            return fault(c, "%s for the %s \"%s\"", claims[i].fault, c->what, c->name);
        else if (!claims[i].holds)
            return fault(c, "%s", claims[i].fault);
    return true;
}

/* Counts the names in a text such as "wire.output"; 0 if it is not such a text. */
static int count_names(const char *text)
{
    for (int count = 1; text && strlen(text) < FE_LONGEST_NAME; count++) {
        size_t length = strcspn(text, ".");
        if (!fe_is_name(text, length))
            return 0;
        if (!text[length])
            return count;
        text += length + 1;
    }
    return 0;
}

static bool same_first_name(const char *a, const char *b)
{
    size_t length = strcspn(a, ".");
    return strcspn(b, ".") == length && !strncmp(a, b, length);
}

/* Whether the word is a key of every stage in a file, such as `use`. */
static bool is_reserved(const char *name)
{
    return same_first_name(name, "use") || same_first_name(name, "with");
}

static bool is_line(const char *text)
{
    return text && text[0] && fe_text_is_clean(text);
}

static bool is_kind(const char *text, size_t length)
{
    return length > 0 && length < FE_LONGEST_NAME &&
           strspn(text, "abcdefghijklmnopqrstuvwxyz0123456789-") >= length;
}

bool fe_id_is_legal(const char *id)
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
        return fault(c, "gives a model of only %zu bytes", m->size);
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

static bool check_table(const checking *c, const char *what, const void *rows, size_t count,
                        size_t stride, size_t least, size_t most)
{
    if (count > 0 && !rows)
        return fault(c, "states that it has %zu %s, but gives no table of them", count, what);
    if (count > most)
        return fault(c, "has %zu %s; at most %zu are possible", count, what, most);
    if (count > 0 && (stride < least || stride % alignof(ff_param) != 0))
        return fault(c, "gives its table of %s in rows of %zu bytes; version 1.0 has %zu", what,
                     stride, least);
    return true;
}

static bool check_tables(const checking *c)
{
    const ff_model *m = c->model;
    return check_table(c, "parameters", m->params, m->param_count, m->param_stride, param_row_1_0,
                       MOST_PARAMS) &&
           check_table(c, "inputs", m->inputs, m->input_count, m->input_stride, port_row_1_0,
                       MOST_INPUTS) &&
           check_table(c, "outputs", m->outputs, m->output_count, m->output_stride, port_row_1_0,
                       MOST_OUTPUTS) &&
           (ff_model_columns(m) == 0 || check_table(c, "columns", m->columns, m->column_count,
                                                    m->column_stride, param_row_1_0, MOST_COLUMNS));
}

static bool check_model(const checking *c, const char *id)
{
    const ff_model *m = c->model;
    bool data = false, service = false, wired = false, placed = true;
    for (size_t i = 0; i < m->output_count; i++) {
        bool serves = ff_model_output(m, i)->service;
        service = service || serves;
        data = data || !serves;
    }
    for (size_t i = 0; i < m->input_count; i++)
        wired = wired || ff_model_input(m, i)->service;
    for (size_t i = 0; i < m->param_count; i++)
        placed = placed && ff_model_param(m, i)->place;
    const claim claims[] = {
        {is_line(m->version), "states no version of its own"},
        {is_line(m->summary), "has no summary of one line"},
        {is_line(m->licence), "states no licence"},
        {m->reference && m->bibtex,
         "has no reference to the literature (write \"\" if there is none)"},
        {m->output_count > 0, "offers no output"},
        {m->create != NULL, "lacks the function \"create\""},
        {m->evaluate || !data, "lacks the function \"evaluate\", which its outputs require"},
        {m->service || !service, "lacks the function \"service\", which its outputs require"},
        {m->set || placed, "lacks the function \"set\", which its parameters require"},
        {m->wire || !wired, "lacks the function \"wire\", which its inputs require"},
        {m->cost >= 0 && isfinite(m->cost), "states an impossible cost"},
    };
    if (m->output_count > MOST_OUTPUTS_1_0 && m->abi_minor < 2)
        return fault(c, "has %zu outputs; for more than %d it must ask for version 1.2",
                     m->output_count, MOST_OUTPUTS_1_0);
    if (!m->id || strcmp(m->id, id) != 0)
        return fault(c, "calls itself \"%.100s\", but its place says \"%s\"",
                     m->id ? m->id : "nothing", id);
    return check_claims(c, claims, sizeof claims / sizeof *claims);
}

static bool check_words(const checking *c, const ff_param *row)
{
    char word[FE_LONGEST_NAME + 1];
    for (size_t i = 0; ff_word_at(row->choices, i, word, sizeof word); i++) {
        double number;
        const char *end;
        size_t length = strlen(word);
        bool plain = length > 0 && length < FE_LONGEST_NAME && fe_text_is_clean(word);
        /* "16MnCr5" is a word; a word may begin with a number only if the row takes no number */
        bool numeric = ff_number_parse(word, &number, &end) && (row->type != FF_CHOICE || !*end);
        if (!plain || (row->type != FF_TEXT && (strpbrk(word, " \"'[]{},:#") || numeric)))
            return fault(c, "has the choice \"%s\" for the parameter \"%s\", which is not a word",
                         word, c->name);
        if (fe_word_find(row->choices, word) != (int)i)
            return fault(c, "has the choice \"%s\" twice for the parameter \"%s\"", word, c->name);
    }
    return true;
}

/* Whether the first number of a range is the smaller one; two zeros mean no range. */
static bool is_range(double from, double to)
{
    return from < to || (from == 0 && to == 0);
}

static bool check_param_row(const checking *c, const ff_param *row)
{
    bool chosen = row->type >= FF_REAL && row->type <= FF_TEXT && row->type != FF_BOOL;
    bool apart = row->min < row->max && row->low < row->high &&
                 (row->low > row->max || row->high < row->min);
    bool idle = row->type == FF_FILE || ((row->flags & FF_REQUIRED) && !row->group);
    const claim claims[] = {
        {row->flags < 2 * FF_INCREASING, "has unknown flags"},
        {is_line(row->doc), "has no line of explanation"},
        {row->choices || row->type != FF_CHOICE, "has nothing to choose from"},
        {!row->choices || chosen, "has choices that its type does not take"},
        {is_range(row->low, row->high) && !apart, "has an impossible calibrated range"},
        {row->min_count <= row->max_count || row->max_count == 0, "has impossible counts"},
        {!row->preset || !idle, "has a preset that can never be used"},
    };
    if (row->type < FF_REAL || row->type > FF_FILE)
        return fault(c, "has the unknown type %d for the parameter \"%s\"", row->type, c->name);
    if (!is_range(row->min, row->max))
        return fault(c, "has impossible limits %g to %g for the parameter \"%s\"", row->min,
                     row->max, c->name);
    return check_claims(c, claims, sizeof claims / sizeof *claims) && check_words(c, row);
}

static bool check_preset(const checking *c, const ff_param *row, const ff_unit *unit)
{
    if (!row->preset)
        return true;
    ff_report *report = ff_report_new();
    ff_value value;
    bool good = ff_param_read_preset(row, unit, row->name, &value, report);
    ff_value_clear(&value);
    if (!good)
        fault(c, "has an impossible preset \"%.60s\": %s", row->preset,
              ff_report_at(report, 0)->text);
    ff_report_free(report);
    return good;
}

/* Checks that the member lies inside the instance, is aligned, and does not overlap the members of
   earlier rows. */
static bool check_place(const checking *c, size_t index)
{
    const ff_model *m = c->model;
    const ff_param *row = ff_model_param(m, index);
    if (!row->place)
        return true;
    fe_member member = fe_param_member(row->type);
    size_t first = row->place - 1;
    if (m->self_size == 0 || m->abi_minor < 2)
        return fault(c, "has a place for the parameter \"%s\", but %s", c->name,
                     m->self_size ? "does not ask for version 1.2 of the interface"
                                  : "does not state the size of its instance, self_size");
    if (first > m->self_size || member.size > m->self_size - first)
        return fault(c, "places the parameter \"%s\" behind the %zu bytes of its instance", c->name,
                     m->self_size);
    if (first % member.alignment != 0)
        return fault(c, "places the parameter \"%s\" at byte %zu, where its type cannot stand",
                     c->name, first);
    for (size_t i = 0; i < index; i++) {
        const ff_param *other = ff_model_param(m, i);
        size_t size = fe_param_member(other->type).size;
        if (other->place && row->place < other->place + size &&
            other->place < row->place + member.size)
            return fault(c, "places the parameters \"%s\" and \"%s\" over each other", other->name,
                         c->name);
    }
    return true;
}

static bool check_unit(const checking *c, const char *text, ff_unit *unit)
{
    char clause[256];
    if (!text)
        return fault(c, "has no unit for the %s \"%s\"", c->what, c->name);
    return ff_unit_parse(text, unit, clause, sizeof clause) ||
           fault(c, "has a bad unit for the %s \"%s\": the unit \"%.40s\" %s", c->what, c->name,
                 text, clause);
}

static bool check_param(checking *c, size_t index, ff_unit *unit)
{
    const ff_param *row = ff_model_param(c->model, index);
    c->what = "parameter";
    c->name = row->name ? row->name : "";
    if (count_names(c->name) == 0)
        return fault(c, "gives its parameter %zu the invalid name \"%.60s\"", index + 1, c->name);
    if (is_reserved(c->name))
        return fault(c, "calls a parameter \"%s\", which is a reserved word of files", c->name);
    /* names must differ, and none may be a map of another, as "atlas" is for "atlas.from" */
    for (size_t i = 0; i < index; i++) {
        const char *other = ff_model_param(c->model, i)->name;
        size_t n = strlen(c->name), m = strlen(other), least = n < m ? n : m;
        if (!strncmp(c->name, other, least) && strchr(".", n < m ? other[n] : c->name[m]))
            return fault(c, "has the parameter \"%.*s\" twice", (int)least, other);
    }
    return check_param_row(c, row) && check_place(c, index) && check_unit(c, row->unit, unit) &&
           check_preset(c, row, unit);
}

static bool check_port(const checking *c, const ff_port *row, ff_dims *dims)
{
    ff_unit unit;
    bool plain = (!row->unit || !row->unit[0]) && (!row->dims || !row->dims[0]);
    const claim claims[] = {
        {row->flags < 2 * FF_DIFFERENCE, "has unknown flags"},
        {is_line(row->doc), "has no line of explanation"},
        {!row->service || is_line(row->service), "has a bad interface"},
        {!row->service || plain, "has a unit or dimensions in addition to the interface"},
        {row->service || row->dims, "has no dimensions"},
    };
    if (!check_claims(c, claims, sizeof claims / sizeof *claims))
        return false;
    if (row->service)
        return true;
    if (!check_unit(c, row->unit, &unit))
        return false;
    if (!ff_unit_is_si(&unit))
        return fault(c, "has the unit \"%s\" for the %s \"%s\", which is not coherent SI",
                     row->unit, c->what, c->name);
    const char *wrong = fe_dims_read(c->model, row->dims, dims);
    return !wrong || fault(c, "has bad dimensions for the %s \"%s\": \"%.60s\" %s", c->what,
                           c->name, row->dims, wrong);
}

/* Checks that a feedback wire is optional and carries data. */
static bool check_feedback(const checking *c, const ff_port *row)
{
    const claim claims[] = {
        {row->flags & FF_OPTIONAL, "has feedback that is not optional"},
        {!row->service, "has feedback of a service"},
        {c->model->abi_minor >= 2, "does not ask for version 1.2, which feedback needs,"},
    };
    return !(row->flags & FF_FEEDBACK) || check_claims(c, claims, sizeof claims / sizeof *claims);
}

/* Checks an input row: its wire must not have the name of a parameter, and all rows of the wire
   must have the same `from`. */
static bool check_input(checking *c, size_t index, ff_dims *dims)
{
    enum { LONGEST_WIRE = 47 };
    const ff_port *row = ff_model_input(c->model, index);
    c->what = "input";
    c->name = row->name ? row->name : "";
    int wire = (int)strcspn(c->name, "."), names = count_names(c->name);
    if ((names != 2 && !(row->service && names == 1)) || wire > LONGEST_WIRE)
        return fault(c,
                     "gives its input %zu the name \"%.60s\"; it must be \"wire.output\", or "
                     "\"wire\" for a service",
                     index + 1, c->name);
    if (is_reserved(c->name))
        return fault(c, "calls a wire \"%.*s\", which is a reserved word of files", wire, c->name);
    for (size_t i = 0; i < index; i++) {
        const ff_port *other = ff_model_input(c->model, i);
        bool same_from =
            other->from && row->from ? !strcmp(other->from, row->from) : other->from == row->from;
        if (!strcmp(c->name, other->name))
            return fault(c, "has the input \"%s\" twice", c->name);
        if (same_first_name(c->name, other->name) && (row->flags ^ other->flags) & FF_FEEDBACK)
            return fault(c, "has feedback for only one of the inputs \"%s\" and \"%s\"",
                         other->name, c->name);
        if (same_first_name(c->name, other->name) && !same_from)
            return fault(c, "wires the inputs \"%s\" and \"%s\" from different kinds", other->name,
                         c->name);
    }
    for (size_t i = 0; i < c->model->param_count; i++)
        if (same_first_name(c->name, ff_model_param(c->model, i)->name))
            return fault(c, "calls both a wire and a parameter \"%.*s\"", wire, c->name);
    return check_feedback(c, row) && check_port(c, row, dims);
}

/* Checks that the input which replaces a parameter is optional: a service or, since 1.3, a data
   input or a wire. */
static bool check_instead(const checking *c, size_t index)
{
    const ff_param *row = ff_model_param(c->model, index);
    bool any = false, optional = true, data = false;
    for (size_t i = 0; i < c->model->input_count; i++) {
        const ff_port *port = ff_model_input(c->model, i);
        if (!row->instead || !fe_is_on_wire(port->name, row->instead))
            continue;
        any = true;
        optional = optional && port->flags & FF_OPTIONAL;
        data = data || !port->service;
    }
    const bool old = data && c->model->abi_minor < 3;
    return !row->instead || (any && optional && !old) ||
           fault(c, "lets \"%.60s\" replace the parameter \"%s\", but it %s", row->instead,
                 row->name,
                 old ? "is a data input, which needs version 1.3 of the interface"
                     : "is not an optional input");
}

/* Checks the members of an output row that were added in 1.3. */
static bool check_meaning(const checking *c, const ff_port *row)
{
    ff_unit unit, shown;
    char clause[256];
    const bool kelvin = row->unit && !strcmp(row->unit, "K");
    const claim claims[] = {
        {row->min < row->max || (row->min == 0 && row->max == 0), "has impossible bounds"},
        {!(row->flags & FF_DIFFERENCE) || kelvin, "has a difference that is not in K"},
        {!row->label || is_line(row->label), "has a label that is not one line"},
        {!row->quantity || is_line(row->quantity), "has a quantity that is not one line"},
        {row->apart >= 0, "has a negative allowed difference"},
        {row->headline >= FF_NO_HEADLINE && row->headline <= FF_MEAN, "has an unknown headline"},
        {!row->origin || ff_model_find_input(c->model, row->origin) >= 0,
         "is counted from an input that the model does not have"},
    };
    if (row->service)
        return true;
    if (row->shown && (!ff_unit_parse(row->shown, &shown, clause, sizeof clause) ||
                       !ff_unit_parse(row->unit, &unit, clause, sizeof clause) ||
                       !ff_unit_same_dimension(&shown, &unit)))
        return fault(c, "shows the output \"%s\" in \"%.40s\", a unit of another dimension",
                     c->name, row->shown);
    return check_claims(c, claims, sizeof claims / sizeof *claims);
}

static bool check_output(checking *c, ff_loaded *loaded, size_t index)
{
    ff_dims *dims = &loaded->output_dims[index];
    const ff_port *row = ff_model_output(c->model, index);
    c->what = "output";
    c->name = row->name ? row->name : "";
    if (row->flags & FF_FEEDBACK || (row->flags & FF_DIFFERENCE && c->model->abi_minor < 3))
        return fault(c, "has unknown flags for the output \"%.60s\"", c->name);
    if (count_names(c->name) != 1)
        return fault(c, "gives its output %zu the invalid name \"%.60s\"", index + 1, c->name);
    for (size_t i = 0; i < index; i++)
        if (!strcmp(c->name, ff_model_output(c->model, i)->name))
            return fault(c, "has the output \"%s\" twice", c->name);
    if (!check_port(c, row, dims) || !check_meaning(c, row))
        return false;
    const char *shared = fe_dims_clash(loaded, index);
    return !shared || fault(c, "gives outputs along \"%s\" of different stages, such as \"%s\"",
                            shared, row->name);
}

static bool check_column(checking *c, size_t index)
{
    const ff_param *row = ff_model_column(c->model, index);
    ff_unit unit;
    c->what = "column";
    c->name = row->name ? row->name : "";
    if (count_names(c->name) != 1)
        return fault(c, "gives its column %zu the invalid name \"%.60s\"", index + 1, c->name);
    return check_claims(c, &(claim){is_line(row->doc), "has no line of explanation"}, 1) &&
           check_unit(c, row->unit, &unit);
}

bool fe_model_check(ff_loaded *loaded, const char *id, char *why, size_t why_size)
{
    checking c = {.model = loaded->model, .why = why, .why_size = why_size};
    if (!check_version(&c) || !check_tables(&c))
        return false;
    const ff_model *model = c.model = loaded->model = fe_model_complete(loaded->model);
    if (!check_model(&c, id))
        return false;
    loaded->param_units = fe_alloc(model->param_count * sizeof(ff_unit));
    loaded->input_dims = fe_alloc(model->input_count * sizeof(ff_dims));
    loaded->output_dims = fe_alloc(model->output_count * sizeof(ff_dims));
    bool good = true;
    for (size_t i = 0; i < model->param_count && good; i++)
        good = check_param(&c, i, &loaded->param_units[i]);
    for (size_t i = 0; i < model->input_count && good; i++)
        good = check_input(&c, i, &loaded->input_dims[i]);
    for (size_t i = 0; i < model->param_count && good; i++)
        good = check_instead(&c, i);
    for (size_t i = 0; i < model->output_count && good; i++)
        good = check_output(&c, loaded, i);
    for (size_t i = 0; i < ff_model_columns(model) && good; i++)
        good = check_column(&c, i);
    return good;
}
