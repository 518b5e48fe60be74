/* SPDX-License-Identifier: MIT */
/* The dimensions of a row: their names, and the wires to which they belong. */
#include "rows.h"

#include <string.h>

/* Whether an input is on the wire with this name of `length` characters. */
static bool has_wire(const ff_model *model, const char *wire, size_t length)
{
    for (size_t i = 0; i < model->input_count; i++) {
        const char *name = ff_model_input(model, i)->name;
        if (name && strcspn(name, ".") == length && !strncmp(name, wire, length))
            return true;
    }
    return false;
}

bool fe_is_name(const char *text, size_t length)
{
    static const char rest[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return length > 0 && length < FE_LONGEST_NAME && !strchr("0123456789", text[0]) &&
           strspn(text, rest) >= length;
}

const char *fe_dims_read(const ff_model *model, const char *text, ff_dims *dims)
{
    for (const char *at = text; *at;) {
        const size_t wire = strcspn(at, " .");
        if (at[wire] == '.') {
            if (model->abi_minor < 3)
                return "names a wire, which needs version 1.3 of the interface";
            if (!has_wire(model, at, wire))
                return "names a wire that the model does not have";
            at += wire + 1;
        }
        size_t length = strcspn(at, " "), word = length;
        if (dims->rank == FF_MAX_RANK)
            return "names more than 4 dimensions";
        if (word > 1 && at[word - 1] == '?') {
            if (dims->rank > 0)
                return "marks a dimension as optional that is not the first";
            dims->first_optional = true;
            word--;
        }
        if (!fe_is_name(at, word) || word >= sizeof dims->name[0] || !strcmp(at + length, " "))
            return "is not a list of names, separated by one blank each";
        memcpy(dims->name[dims->rank++], at, word);
        at += length + (at[length] == ' ');
    }
    return NULL;
}

const char *fe_dim_wire(const ff_model *model, const ff_port *row, uint32_t i, size_t *length)
{
    const char *word = row->dims;
    for (uint32_t k = 0; k < i; k++)
        word += strcspn(word, " ") + 1;
    const size_t ends = strcspn(word, " ."), own = strcspn(row->name, ".");
    *length = 0;
    if (model->abi_minor < 3)
        return "";
    if (word[ends] == '.') {
        *length = ends;
        return word;
    }
    *length = row->name[own] ? own : 0;
    return row->name;
}

const char *fe_dims_clash(const ff_loaded *loaded, size_t output)
{
    const ff_model *model = loaded->model;
    const ff_dims *dims = &loaded->output_dims[output];
    size_t length, other_length;
    for (uint32_t i = 0; i < dims->rank; i++) {
        const char *wire = fe_dim_wire(model, ff_model_output(model, output), i, &length);
        for (size_t k = 0; k < output; k++)
            for (uint32_t d = 0; d < loaded->output_dims[k].rank; d++) {
                const char *other = fe_dim_wire(model, ff_model_output(model, k), d, &other_length);
                if (!strcmp(loaded->output_dims[k].name[d], dims->name[i]) &&
                    (length != other_length || strncmp(wire, other, length) != 0))
                    return dims->name[i];
            }
    }
    return NULL;
}
