/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "variate.h"

#include "../answer/text.h"
#include "tolerances.h"

#include "../../../memory/memory.h"
#include "../../cases/csv.h"
#include "../../cases/yaml.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SAMPLES = 1000000 };

static const char *const kinds[] = {"normal", "lognormal", "uniform", "samples"};
static const char hint[] =
    "write duty.torque: {normal: [250 N m, 10 %]}, or 250 N m +- 5 %; also lognormal: [MEDIAN, "
    "10 %], uniform: [FROM, TO], samples: FILE.csv or a list";

static const char too_many[] = "at most 32 are possible";

static bool refuse(study_context *context, const ff_node *at, const char *name, const char *help,
                   const char *what)
{
    return ff_error(context->report, FF_FAULT_INPUT, at ? at->place : FF_NOWHERE, help,
                    "%s: %.80s: %s", context->name, name, what);
}

/* Reads a spread. In percent it is relative to the number before it; otherwise it has a unit of its
   own. */
static bool read_spread(study_context *context, const ff_node *node, variate *v,
                        const ff_unit *unit)
{
    study_quantity q;
    if (!study_read_quantity(context, node, v->name, hint, &q))
        return false;
    if (!strcmp(q.text, "%")) {
        if (unit->offset != 0)
            return refuse(context, node, v->name, "such as 3 K",
                          "a spread of a temperature is a number of kelvin");
        v->b = q.number / 100 * fabs(v->a);
    } else if (!ff_unit_same_dimension(&q.unit, unit)) {
        return refuse(context, node, v->name, NULL,
                      "the spread has another dimension than the number before it");
    } else {
        v->b = q.number * q.unit.factor / unit->factor;
    }
    return v->b >= 0 || refuse(context, node, v->name, NULL, "a spread must not be negative");
}

static bool read_pair(study_context *context, const ff_node *list, variate *v)
{
    study_quantity first, second;
    if (list->kind != FF_SEQUENCE || list->count != 2)
        return refuse(context, list, v->name, hint, "expected two numbers");
    if (!study_read_quantity(context, list->items[0], v->name, hint, &first))
        return false;
    v->a = first.number;
    v->unit = first.text;
    if (v->kind != VARIATE_UNIFORM) {
        if (!read_spread(context, list->items[1], v, &first.unit))
            return false;
        if (v->kind == VARIATE_LOGNORMAL && !(v->a > 0))
            return refuse(context, list, v->name, NULL, "lognormal needs a positive median");
        if (v->kind == VARIATE_LOGNORMAL) /* from the variance of a lognormal variate over its
                                             squared mean, exp(s^2) - 1 */
            v->b = sqrt(log1p(v->b / v->a * (v->b / v->a)));
        return true;
    }
    if (!study_read_quantity(context, list->items[1], v->name, hint, &second))
        return false;
    v->b = second.number;
    if (!ff_unit_same_dimension(&first.unit, &second.unit))
        return refuse(context, list, v->name, NULL,
                      "the two ends have units of different dimensions");
    if (strcmp(second.text, v->unit) != 0)
        v->b = ff_unit_from_si(&first.unit, ff_unit_to_si(&second.unit, v->b));
    return v->a <= v->b ||
           refuse(context, list, v->name, NULL, "the first end must be the lower one");
}

typedef struct sample {
    double number;
    const char *text;
} sample;

static int by_number(const void *a, const void *b)
{
    double x = ((const sample *)a)->number, y = ((const sample *)b)->number;
    return (x > y) - (x < y);
}

/* Sorts samples if all are numbers of one unit, so that correlations have a meaning. */
static void sort_samples(variate *v)
{
    sample *all = memory_alloc((v->sample_count + 1) * sizeof *all);
    const char *unit = NULL, *end;
    bool numbers = true;
    for (size_t i = 0; i < v->sample_count; i++) {
        all[i].text = v->samples[i];
        numbers = numbers && ff_number_parse(all[i].text, &all[i].number, &end) &&
                  (!unit || !strcmp(unit, end));
        unit = end;
    }
    v->words = !numbers;
    if (numbers)
        qsort(all, v->sample_count, sizeof *all, by_number);
    for (size_t i = 0; i < v->sample_count; i++)
        v->samples[i] = all[i].text;
    free(all);
}

static void add_sample(study_context *context, variate *v, const char *text, const char *unit)
{
    v->samples =
        memory_arena_grow(&context->arena, v->samples, v->sample_count, sizeof *v->samples);
    v->samples[v->sample_count++] =
        study_context_format(context, "%s%s%s", text, *unit ? " " : "", unit);
}

/* Takes the column of that name from the rows. Returns NULL, or the reason if it cannot. */
static const char *take_column(study_context *context, study_csv *table, variate *v)
{
    size_t column = 0;
    const char *unit = NULL;
    if (!study_csv_next(table))
        return "it has no rows";
    for (; column < table->count && !table->fault; column++)
        if ((unit = study_csv_unit(&table->fields[column])) &&
            !strcmp(table->fields[column].text, v->name))
            break;
    if (table->fault || column == table->count)
        return table->fault ? table->fault : "no column is named after the input";
    unit = study_context_format(context, "%s", unit);
    while (study_csv_next(table)) {
        if (table->fault || table->count <= column || !*table->fields[column].text)
            return table->fault ? table->fault : "a row has no value";
        if (v->sample_count == MOST_SAMPLES)
            return "more than 1000000 rows";
        add_sample(context, v, table->fields[column].text, unit);
    }
    return v->sample_count ? NULL : "it has no rows";
}

static bool read_table(study_context *context, const ff_node *node, variate *v)
{
    char *path = ff_path_beside(node->place.source->directory, node->text);
    study_csv table;
    const char *fault = study_csv_open(&table, path);
    if (!fault)
        fault = take_column(context, &table, v);
    if (fault)
        ff_error(context->report, FF_FAULT_INPUT, node->place,
                 "its first row names columns, such as duty.torque [N m]", "%s: %.80s: %.200s: %s",
                 context->name, v->name, path, fault);
    study_csv_close(&table);
    ff_free(path);
    return !fault;
}

static bool read_samples(study_context *context, const ff_node *node, variate *v)
{
    if (study_word(node)) {
        if (!read_table(context, node, v))
            return false;
    } else if (node->kind == FF_SEQUENCE && node->count > 0) {
        for (size_t i = 0; i < node->count; i++)
            if (!study_word(node->items[i]))
                return refuse(context, node->items[i], v->name, NULL,
                              "a sample must be a single value");
            else
                add_sample(context, v, node->items[i]->text, "");
    } else {
        return refuse(context, node, v->name, hint, "samples must be a list or a table");
    }
    sort_samples(v);
    return true;
}

/* Reads the paths that receive the value: the name itself, or the paths in `sets`. */
static bool read_paths(study_context *context, const ff_node *sets, const ff_node *at, variate *v)
{
    size_t count = sets ? sets->count : 1;
    v->paths = memory_arena_alloc(&context->arena, (count + 1) * sizeof *v->paths);
    if (sets && (sets->kind != FF_SEQUENCE || count == 0))
        return refuse(context, sets, v->name, "write sets: [oil.nu_40, oil.nu_100]",
                      "\"sets\" must be a list of the paths that share the value");
    if (!sets)
        v->paths[0] = v->name;
    for (size_t i = 0; i < count; i++) {
        if (sets && !(v->paths[i] = study_word(sets->items[i])))
            return refuse(context, sets, v->name, NULL, "\"sets\" must be a list of paths");
        if (!strchr(v->paths[i], '.'))
            return refuse(context, sets ? sets->items[i] : at, v->paths[i],
                          "name a path, or add sets: [STAGE.PARAMETER, ...]",
                          "it is not a path of the pipeline");
    }
    v->path_count = count;
    return true;
}

/* Reads a uniform distribution between two ends. */
static void spread_evenly(study_context *context, const ff_tolerance *t, const char *text,
                          variate *v)
{
    v->kind = VARIATE_UNIFORM;
    v->a = t->low;
    v->b = t->high;
    v->unit = study_context_format(context, "%s", t->unit);
    v->text = study_context_format(context, "%.200s", text);
}

/* Reads a value with a drawing tolerance. */
static bool read_toleranced(study_context *context, const ff_node *node, variate *v)
{
    ff_tolerance t;
    char why[200];
    int found = ff_tolerance_parse(node->text, &t, why, sizeof why);
    if (found < 0)
        return refuse(context, node, v->name, NULL, why);
    if (found == 0)
        return refuse(context, node, v->name, hint, "expected a distribution");
    spread_evenly(context, &t, node->text, v);
    return read_paths(context, NULL, node, v);
}

/* Makes inputs of the values with a tolerance in the pipeline. */
static bool find_toleranced(variates *v, study_context *context)
{
    size_t count;
    v->place = ff_node_get(ff_node_get(context->root, "study"), context->name);
    const study_toleranced *list = study_find_toleranced(context->root, &context->arena, &count);
    if (count == 0)
        return refuse(context, v->place, "inputs",
                      "write inputs: {duty.torque: {normal: [250 N m, 10 %]}}, or in the pipeline "
                      "for example centre_distance: 120 mm +- 20 um",
                      "no value of the pipeline has a tolerance, and no input is named here");
    for (size_t i = 0; i < count && i <= VARIATE_MOST; i++) {
        if (i == VARIATE_MOST)
            return refuse(context, v->place, "inputs", NULL, too_many);
        variate *one = &v->all[v->count++];
        one->name = list[i].path;
        spread_evenly(context, &list[i].tolerance, list[i].text, one);
        read_paths(context, NULL, NULL, one);
    }
    return true;
}

static bool read_variate(study_context *context, const ff_node *map, variate *v)
{
    const ff_node *node = NULL, *own;
    if (study_word(map))
        return read_toleranced(context, map, v);
    if (!study_is_map(map))
        return refuse(context, map, v->name, hint, "expected a distribution");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        own = ff_node_get(map, kinds[i]);
        if (own && node)
            return refuse(context, map, v->name, hint, "it has two distributions");
        if (own) {
            node = own;
            v->kind = (variate_kind)i;
        }
    }
    for (size_t i = 0; i < map->count; i++)
        if (map->items[i] != node && strcmp(map->keys[i], "sets") != 0)
            return ff_error(context->report, FF_FAULT_INPUT, map->key_places[i], hint,
                            "%s: %.80s: unknown key \"%.80s\"", context->name, v->name,
                            map->keys[i]);
    if (!node)
        return refuse(context, map, v->name, hint, "expected a distribution");
    char *text = study_yaml_assignment(kinds[v->kind], node);
    v->text = study_context_format(context, "%.200s", text);
    free(text);
    return read_paths(context, ff_node_get(map, "sets"), map, v) &&
           (v->kind == VARIATE_SAMPLES ? read_samples(context, node, v)
                                       : read_pair(context, node, v));
}

static size_t find(const variates *v, const char *name)
{
    size_t k = 0;
    while (k < v->count && strcmp(v->all[k].name, name) != 0)
        k++;
    return k;
}

/* Replaces the correlations by their Cholesky factor; false when they are not positive definite. */
static bool factorise(double *m, size_t n)
{
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) {
            double sum = m[i * VARIATE_MOST + j];
            for (size_t k = 0; k < (i < j ? 0 : j); k++)
                sum -= m[i * VARIATE_MOST + k] * m[j * VARIATE_MOST + k];
            if (i == j && !(sum > 1e-12))
                return false;
            m[i * VARIATE_MOST + j] = i < j    ? 0
                                      : i == j ? sqrt(sum)
                                               : sum / m[j * VARIATE_MOST + j];
        }
    return true;
}

/* Numbers the groups of inputs; inputs in different groups are not correlated. */
static void number_groups(variates *v)
{
    for (size_t i = 0; i < v->count; i++)
        v->all[i].group = i;
    for (size_t i = 0; i < v->count; i++)
        for (size_t j = 0; j < i; j++) {
            size_t from = v->all[i].group, to = v->all[j].group;
            for (size_t k = 0; v->root[i * VARIATE_MOST + j] != 0 && k < v->count; k++)
                v->all[k].group = v->all[k].group == from ? to : v->all[k].group;
        }
    for (size_t g = 0; g < v->count; g++) { /* numbers without gaps */
        bool used = false;
        for (size_t k = 0; k < v->count; k++)
            if (v->all[k].group == g) {
                v->all[k].group = v->groups;
                used = true;
            }
        v->groups += used;
    }
}

static bool read_correlations(variates *v, study_context *context, const ff_node *list)
{
    for (size_t i = 0; i < v->count; i++)
        v->root[i * VARIATE_MOST + i] = 1;
    for (size_t i = 0; list && i < (list->kind == FF_SEQUENCE ? list->count : 1); i++) {
        const ff_node *one = list->kind == FF_SEQUENCE ? list->items[i] : list;
        bool three = one->kind == FF_SEQUENCE && one->count == 3;
        const char *name[2] = {three ? study_word(one->items[0]) : NULL,
                               three ? study_word(one->items[1]) : NULL};
        const char *text = three ? study_word(one->items[2]) : NULL, *end;
        double r;
        if (!name[0] || !name[1] || !text || !ff_number_parse(text, &r, &end) || *end ||
            !(fabs(r) < 1))
            return refuse(context, one, "correlations", "write [[duty.torque, duty.speed, 0.5]]",
                          "expected two inputs and a number between -1 and 1");
        size_t a = find(v, name[0]), b = find(v, name[1]);
        if (a == v->count || b == v->count || a == b)
            return refuse(context, one, "correlations", NULL,
                          study_context_format(context,
                                               a == b && a < v->count
                                                   ? "\"%.80s\" is named twice"
                                                   : "there is no input \"%.80s\"",
                                               a == v->count ? name[0] : name[1]));
        v->root[a * VARIATE_MOST + b] = v->root[b * VARIATE_MOST + a] = r;
    }
    number_groups(v);
    return factorise(v->root, v->count) ||
           refuse(
               context, list, "correlations",
               "for example, two inputs fully opposed to a third cannot be opposed to each other",
               "no inputs can have these correlations: their matrix is not positive definite");
}

static size_t count_setters(const variates *v, const char *path)
{
    size_t count = 0;
    for (size_t k = 0; k < v->count; k++)
        for (size_t i = 0; i < v->all[k].path_count; i++)
            count += !strcmp(v->all[k].paths[i], path);
    return count;
}

bool variates_read(variates *v, study_context *context, const ff_node *inputs,
                   const ff_node *correlations)
{
    if (!inputs)
        return find_toleranced(v, context) && read_correlations(v, context, correlations);
    if (!study_is_map(inputs) || inputs->count == 0)
        return refuse(context, inputs, "inputs", hint,
                      "expected a map from paths to distributions");
    if (inputs->count > VARIATE_MOST)
        return refuse(context, inputs, "inputs", NULL, too_many);
    v->place = inputs;
    for (size_t i = 0; i < inputs->count; i++) {
        v->all[i].name = inputs->keys[i];
        v->count++;
        if (!read_variate(context, inputs->items[i], &v->all[i]))
            return false;
        for (size_t a = 0; a < v->all[i].path_count; a++)
            if (count_setters(v, v->all[i].paths[a]) > 1)
                return refuse(context, inputs->items[i], v->all[i].paths[a], NULL,
                              "it is set twice");
    }
    return read_correlations(v, context, correlations);
}

double *variates_draw(const variates *v, uint64_t seed, size_t count)
{
    double *numbers = memory_alloc((count * v->count + 1) * sizeof *numbers);
    gsl_rng *rng = memory_require(gsl_rng_alloc(gsl_rng_mt19937));
    /* The generator takes a seed of 32 bits. Neighbouring seeds give sufficiently different first
       numbers, since a seed is spread over the whole state. */
    gsl_rng_set(rng, (unsigned long)((8 * seed + 2) & 0xffffffff));
    for (size_t i = 0; i < count * v->count; i++) {
        double u = gsl_rng_uniform_pos(rng);
        numbers[i] = gsl_cdf_ugaussian_Pinv(u);
    }
    gsl_rng_free(rng);
    return numbers;
}

const char *variates_value(const variates *v, study_context *context, size_t k,
                           const double *numbers)
{
    const variate *one = &v->all[k];
    double z = 0, value = 0;
    for (size_t j = 0; numbers && j <= k; j++)
        z += v->root[k * VARIATE_MOST + j] * numbers[j];
    double share = gsl_cdf_ugaussian_P(z);
    if (one->kind == VARIATE_SAMPLES) {
        size_t at = (size_t)(share * (double)one->sample_count);
        return one->samples[at < one->sample_count ? at : one->sample_count - 1];
    }
    value = one->kind == VARIATE_NORMAL      ? one->a + one->b * z
            : one->kind == VARIATE_LOGNORMAL ? one->a * exp(one->b * z)
                                             : one->a + (one->b - one->a) * share;
    return study_context_format(context, "%.12g%s%s", value, *one->unit ? " " : "", one->unit);
}
