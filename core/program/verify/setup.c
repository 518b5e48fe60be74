/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws random parameters and inputs for tests. */
#include "private.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

verify_setup *verify_setup_new(verify_context *context)
{
    const ff_model *model = context->model;
    verify_setup *setup = memory_alloc(sizeof *setup);
    setup->context = context;
    setup->values = memory_alloc(model->param_count * sizeof *setup->values);
    setup->inputs = memory_alloc(model->input_count * sizeof *setup->inputs);
    setup->shapes = memory_alloc(model->input_count * sizeof *setup->shapes);
    setup->services = memory_alloc(model->input_count * sizeof *setup->services);
    for (size_t i = 0; i < model->input_count; i++)
        setup->services[i] = context->laws[i];
    return setup;
}

static void draw_reals(const verify_setup *setup, size_t param, verify_random *random,
                       verify_range range, ff_value *value)
{
    const ff_param *row = ff_model_param(setup->context->model, param);
    size_t most = row->max_count ? row->max_count : row->min_count + 3;
    value->count = row->min_count + verify_below(random, most - row->min_count + 1);
    double *reals = memory_alloc((value->count + 1) * sizeof *reals);
    for (size_t i = 0; i < value->count; i++) {
        double number = verify_draw_number(row, random, range);
        number = row->flags & FF_WHOLE ? round(number) : number;
        reals[i] = ff_unit_to_si(&setup->context->loaded->param_units[param], number);
    }
    if (row->flags & FF_INCREASING)
        memory_sort(reals, value->count, sizeof *reals);
    value->reals = reals;
}

static void draw_value(verify_setup *setup, size_t param, verify_random *random, verify_range range,
                       ff_value *value)
{
    const ff_param *row = ff_model_param(setup->context->model, param);
    char word[64];
    size_t words = 0;
    *value = (ff_value){.size = sizeof *value, .given = 1};
    while (row->choices && ff_word_at(row->choices, words, word, sizeof word))
        words++;
    bool must = row->type == FF_CHOICE || (row->type == FF_TEXT && range != VERIFY_PHYSICAL);
    if (words && (must || verify_below(random, 4) == 0)) {
        value->integer = (int64_t)verify_below(random, words);
        ff_word_at(row->choices, (size_t)value->integer, word, sizeof word);
        value->text = strdup(word);
    } else if (row->type == FF_REAL) {
        value->real = ff_unit_to_si(&setup->context->loaded->param_units[param],
                                    verify_draw_number(row, random, range));
    } else if (row->type == FF_INT) {
        value->integer = (int64_t)round(verify_draw_number(row, random, range));
    } else if (row->type == FF_BOOL) {
        value->integer = (int64_t)verify_below(random, 2);
    } else if (row->type == FF_REALS) {
        draw_reals(setup, param, random, range, value);
    } else if (row->type == FF_TEXT) {
        value->text = verify_below(random, 2) ? "a text" : "";
    } else if (row->flags & FF_REQUIRED) {
        value->text = verify_make_table(setup->context);
    }
    if (row->type == FF_FILE && !value->text) {
        value->size = 0;
        setup->lacks = row->flags & FF_REQUIRED ? row->name : setup->lacks;
    }
}

/* Chooses the member of a group to set, with equal probability among those that can be drawn. */
static size_t choose_member(const ff_model *model, size_t first, verify_random *random)
{
    const char *group = ff_model_param(model, first)->group;
    size_t chosen = SIZE_MAX, seen = 0;
    for (size_t i = first; i < model->param_count; i++) {
        const ff_param *row = ff_model_param(model, i);
        bool drawn = row->type < FF_TEXT || row->type == FF_REALS;
        if (drawn && row->group && !strcmp(row->group, group) && verify_below(random, ++seen) == 0)
            chosen = i;
    }
    return chosen;
}

static bool is_first_of_group(const ff_model *model, size_t index)
{
    const char *group = ff_model_param(model, index)->group;
    for (size_t i = 0; i < index; i++) {
        const char *other = ff_model_param(model, i)->group;
        if (other && !strcmp(other, group))
            return false;
    }
    return true;
}

/* Returns whether the group needs no value because a member has a preset. */
static bool has_preset(const ff_model *model, size_t member)
{
    const char *group = ff_model_param(model, member)->group;
    bool needed = false;
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *row = ff_model_param(model, i);
        needed = needed || (row->group && !strcmp(row->group, group) && row->flags & FF_REQUIRED);
    }
    return !needed;
}

bool verify_setup_is_replaced(const verify_setup *setup, const ff_param *row)
{
    int input = row->instead ? ff_model_find_input(setup->context->model, row->instead) : -1;
    return input >= 0 && setup->services[input];
}

bool verify_setup_can_be_used(const verify_setup *setup, bool quietly)
{
    const ff_model *model = setup->context->model;
    const ff_port *law = NULL;
    for (size_t i = 0; i < model->input_count && !law; i++) {
        const ff_port *row = ff_model_input(model, i);
        law = row->service && !(row->flags & FF_OPTIONAL) && !setup->services[i] ? row : NULL;
    }
    if (setup->lacks && !quietly)
        verify_skip(setup->context,
                    "it requires \"%s\", and declares no columns from which a file could be made; "
                    "--pipeline FILE gives one",
                    setup->lacks);
    else if (law && !quietly)
        verify_skip(setup->context, "it requires \"%s\", and no model %s/KIND has a plain %s",
                    law->name, FF_CONFORMANCE_KIND, law->service);
    return !setup->lacks && !law;
}

/* Connects a service that replaces parameters in every second draw, so that both cases are
   tested. */
static void draw_replacements(verify_setup *setup, verify_random *random)
{
    const ff_model *model = setup->context->model;
    for (size_t k = 0; k < model->input_count; k++) {
        bool replaces = false;
        for (size_t i = 0; i < model->param_count; i++) {
            const char *wire = ff_model_param(model, i)->instead;
            replaces = replaces || (wire && ff_model_find_input(model, wire) == (int)k);
        }
        if (replaces)
            setup->services[k] = verify_below(random, 2) ? setup->context->laws[k] : NULL;
    }
}

void verify_setup_draw_params(verify_setup *setup, verify_random *random, verify_range range)
{
    const ff_model *model = setup->context->model;
    draw_replacements(setup, random);
    bool *give = memory_alloc(model->param_count * sizeof *give);
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *row = ff_model_param(model, i);
        bool kept =
            range == VERIFY_REQUIRED || (row->flags & FF_TUNABLE && range == VERIFY_CALIBRATED);
        size_t chosen = SIZE_MAX;
        if (!row->group)
            give[i] = row->flags & FF_REQUIRED || (!kept && verify_below(random, 4) == 0);
        else if (is_first_of_group(model, i) && !(range == VERIFY_REQUIRED && has_preset(model, i)))
            chosen = choose_member(model, i, random);
        if (chosen != SIZE_MAX)
            give[chosen] = true;
    }
    for (size_t i = 0; i < model->param_count; i++) {
        setup->values[i].size = 0;
        if (give[i] && !verify_setup_is_replaced(setup, ff_model_param(model, i)))
            draw_value(setup, i, random, range, &setup->values[i]);
    }
    free(give);
}

void verify_setup_give(verify_setup *setup, size_t input, const double *data, uint32_t rank,
                       const size_t *shape)
{
    size_t count = 1;
    for (uint32_t i = 0; i < rank; i++)
        count *= setup->shapes[input][i] = shape[i];
    double *copy = memory_alloc((count + 1) * sizeof *copy);
    memcpy(copy, data, count * sizeof *copy);
    setup->inputs[input] = (ff_array){.data = copy, .shape = setup->shapes[input], .rank = rank};
}

static size_t stir(size_t sum, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        sum = sum * 31 + (unsigned char)text[i];
    return sum;
}

/* Returns the length of a dimension. Equal names on one wire have equal lengths; before ABI 1.3
   equal names on all wires. */
static size_t length_of(const ff_model *model, const ff_port *row, uint32_t at, size_t seed)
{
    static const size_t lengths[] = {1, 2, 3, 7, 0};
    const char *word = row->dims;
    for (uint32_t i = 0; i < at; i++)
        word += strcspn(word, " ") + 1;
    const size_t wire = strcspn(word, " ."), own = strcspn(row->name, ".");
    const char *name = word[wire] == '.' ? word + wire + 1 : word;
    size_t sum = stir(seed, name, strcspn(name, " ?"));
    if (model->abi_minor >= 3)
        sum = word[wire] == '.' ? stir(sum, word, wire) : stir(sum, row->name, own);
    return lengths[sum % (sizeof lengths / sizeof *lengths)];
}

static double draw_any(verify_random *random, size_t style)
{
    static const double odd[] = {0, 1, -1, 1e-12, 1e12, -1e12, 1e300, -1e300};
    double tame = pow(10, 6 * verify_uniform(random) - 3);
    if (style == 0)
        return tame;
    return style == 1 ? odd[verify_below(random, sizeof odd / sizeof *odd)]
                      : 1 + verify_uniform(random);
}

void verify_setup_draw_inputs(verify_setup *setup, verify_random *random)
{
    const ff_model *model = setup->context->model;
    size_t seed = verify_below(random, 1000), style = verify_below(random, 3);
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_dims *dims = &setup->context->loaded->input_dims[i];
        const ff_port *row = ff_model_input(model, i);
        size_t shape[FF_MAX_RANK], count = 1;
        bool absent = row->flags & FF_OPTIONAL && verify_below(random, 2) == 0;
        bool shorter = dims->first_optional && verify_below(random, 2) == 0;
        if (row->service || absent)
            continue;
        for (uint32_t k = shorter; k < dims->rank; k++)
            count *= shape[k - shorter] = length_of(model, row, k, seed);
        double *data = memory_alloc((count + 1) * sizeof *data);
        for (size_t k = 0; k < count; k++)
            data[k] = draw_any(random, style);
        if (verify_below(random, 2))
            memory_sort(data, count, sizeof *data);
        verify_setup_give(setup, i, data, dims->rank - shorter, shape);
        free(data);
    }
}

bool verify_setup_is_complete(const verify_setup *setup)
{
    for (size_t i = 0; i < setup->context->model->input_count; i++) {
        const ff_port *row = ff_model_input(setup->context->model, i);
        const void *there = row->service ? setup->services[i] : setup->inputs[i].data;
        if (!there && !(row->flags & FF_OPTIONAL))
            return false;
    }
    return true;
}
