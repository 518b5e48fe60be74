/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Descriptors: a model whose tables are made of the input's bytes passes or fails the loader's
 * check, and what passes can be described and given values. Structs and strings lie in memory of
 * their exact size, so that a sanitizer sees a read past what they state.
 */
#include "fuzz.h"

#include "../../core/engine/plugin/param.h"
#include "../../core/engine/plugin/private.h"
#include "../../core/engine/value/tree.h"

#include <math.h>

enum { MOST_PIECES = 4096 };

typedef struct maker {
    const uint8_t *at, *end;
    void *pieces[MOST_PIECES];
    size_t count;
} maker;

static unsigned byte(maker *m)
{
    return m->at < m->end ? *m->at++ : 0;
}

static void *piece(maker *m, size_t size)
{
    void *memory = calloc(1, size ? size : 1);
    must(memory != NULL && m->count < MOST_PIECES);
    return m->pieces[m->count++] = memory;
}

static const char *const words[] = {
    "",         "m",     "mm",   "1/GPa",  "1",         "rpm",      "degC",   "kind/model",
    "a",        "b",     "a.b",  "a.c",    "use",       "x|y",      "on|off", "[1, 2]",
    "3 mm",     "-1",    "true", "12.5",   "auto",      "auto|few", "t",      "t x",
    "group? t", "1.0.0", "MIT",  "a line", "lab.law/1",
};
enum { WORDS = sizeof words / sizeof words[0] };

static const char *text(maker *m)
{
    unsigned choice = byte(m);
    if (choice == 255)
        return NULL;
    if (choice < 224)
        return words[choice % WORDS];
    size_t length = choice - 224;
    if (length > (size_t)(m->end - m->at))
        length = (size_t)(m->end - m->at);
    char *copy = piece(m, length + 1);
    if (length)
        memcpy(copy, m->at, length);
    m->at += length;
    return copy;
}

static double number(maker *m)
{
    static const double odd[] = {0, 0, 1, -1, 1e300, 2, 10, 0.5};
    unsigned choice = byte(m);
    if (choice < 250)
        return odd[choice % 8];
    return choice == 250 ? (double)NAN : choice == 251 ? (double)INFINITY : -(double)INFINITY;
}

/* Mostly as asked. */
static size_t near(maker *m, size_t value)
{
    unsigned choice = byte(m);
    return choice < 240 ? value : choice < 248 ? value + choice - 239 : value - (choice - 247);
}

static ff_param param(maker *m)
{
    return (ff_param){.name = text(m),
                      .unit = text(m),
                      .doc = text(m),
                      .type = (int32_t)(byte(m) % 9),
                      .flags = byte(m) % 72,
                      .preset = text(m),
                      .choices = text(m),
                      .group = text(m),
                      .min = number(m),
                      .max = number(m),
                      .low = number(m),
                      .high = number(m),
                      .min_count = byte(m) % 8,
                      .max_count = byte(m) % 8};
}

static ff_port port(maker *m)
{
    return (ff_port){.name = text(m),
                     .unit = text(m),
                     .doc = text(m),
                     .dims = text(m),
                     .service = byte(m) < 200 ? NULL : text(m),
                     .flags = byte(m) % 4,
                     .from = byte(m) < 200 ? NULL : text(m)};
}

/* `count` rows of `stride` bytes each. */
static const void *table(maker *m, size_t *count, size_t *stride, size_t size,
                         void (*fill)(maker *m, void *row))
{
    *count = byte(m) % 6;
    *stride = near(m, size);
    if (byte(m) > 250)
        return NULL;
    char *rows = piece(m, *count * *stride), *row = malloc(size);
    must(row != NULL);
    for (size_t i = 0; i < *count; i++) {
        fill(m, row);
        memcpy(rows + i * *stride, row, *stride < size ? *stride : size);
    }
    free(row);
    return rows;
}

static void fill_param(maker *m, void *row)
{
    ff_param made = param(m);
    memcpy(row, &made, sizeof made);
}

static void fill_port(maker *m, void *row)
{
    ff_port made = port(m);
    memcpy(row, &made, sizeof made);
}

static ff_status create(const ff_host *host, void **self)
{
    (void)host, (void)self;
    return FF_OK;
}

static ff_status set(void *self, uint32_t index, const ff_value *value)
{
    (void)self, (void)index, (void)value;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)self, (void)input, (void)service;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    (void)self, (void)wanted, (void)in;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return self;
}

enum { NEWER = 0xF2 };

static unsigned last(maker *m)
{
    return m->at < m->end ? *--m->end : 0;
}

/* The members since 1.2 are made of the last bytes, behind a mark: older inputs stay as they are.
 */
static void add_newer(maker *m, ff_model *model)
{
    if (m->at == m->end || m->end[-1] != NEWER)
        return;
    m->end--;
    model->abi_minor = 2;
    model->self_size = last(m);
    model->cost = last(m) < 200 ? 1 : (double)NAN;
    for (size_t i = 0; model->params && i < model->param_count; i++) {
        ff_param *row = (void *)((char *)(uintptr_t)model->params + i * model->param_stride);
        unsigned place = last(m), word = last(m);
        if (model->param_stride < sizeof *row || model->param_stride % sizeof(void *) != 0)
            return;
        row->place = place;
        row->instead = word < 128 ? NULL : words[word % WORDS];
    }
}

static const ff_model *make(maker *m)
{
    ff_model model = {.abi_major = byte(m) < 250 ? FF_ABI_MAJOR : byte(m),
                      .abi_minor = byte(m) < 240 ? 0 : byte(m),
                      .id = byte(m) < 240 ? "kind/model" : text(m),
                      .version = text(m),
                      .summary = text(m),
                      .reference = text(m),
                      .bibtex = text(m),
                      .licence = text(m),
                      .flags = byte(m) < 250 ? 0 : byte(m),
                      .create = byte(m) < 250 ? create : NULL,
                      .set = byte(m) < 250 ? set : NULL,
                      .wire = byte(m) < 250 ? wire : NULL,
                      .evaluate = byte(m) < 250 ? evaluate : NULL,
                      .service = byte(m) < 250 ? service : NULL};
    model.params = table(m, &model.param_count, &model.param_stride, sizeof(ff_param), fill_param);
    model.inputs = table(m, &model.input_count, &model.input_stride, sizeof(ff_port), fill_port);
    model.outputs = table(m, &model.output_count, &model.output_stride, sizeof(ff_port), fill_port);
    add_newer(m, &model);
    model.size = byte(m) < 230 ? sizeof model : 8 * (byte(m) % 40);
    void *exact = piece(m, model.size < sizeof model.size ? sizeof model.size : model.size);
    memcpy(exact, &model, model.size < sizeof model ? model.size : sizeof model);
    memcpy(exact, &model.size, sizeof model.size);
    return exact;
}

/* The rest of the input, as a list of what a user writes for the parameters in turn. */
static void give_values(const ff_loaded *loaded, maker *m)
{
    char *rest = fuzz_text(m->at, (size_t)(m->end - m->at));
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_parse("values", "/nonexistent", rest, report);
    const ff_node *root = fe_tree_root(tree);
    size_t params = loaded->model->param_count;
    for (size_t i = 0; params && root && i < root->count; i++) {
        const ff_param *row = ff_model_param(loaded->model, i % params);
        const ff_unit *unit = &loaded->param_units[i % params];
        ff_value value;
        if (ff_param_read(row, unit, row->name, root->items[i], &value, report)) {
            must(isfinite(value.real));
            if (row->place) {
                void *self = calloc(1, loaded->model->self_size);
                must(self != NULL);
                fe_param_place(row, self, &value);
                fe_param_place(row, self, NULL);
                free(self);
            }
            ff_value_clear(&value);
        }
    }
    fuzz_print(report);
    ff_report_free(report);
    fe_tree_free(tree);
    free(rest);
}

static void check(void *ctx)
{
    maker *m = ctx;
    char why[1024] = "";
    ff_loaded loaded = {.model = make(m), .path = "fuzz.so"};
    if (fe_model_check(&loaded, "kind/model", why, sizeof why))
        give_values(&loaded, m);
    else
        must(why[0] && memchr(why, 0, sizeof why) != NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static maker m;
    fe_heap heap = {0};
    m = (maker){.at = data, .end = data + size};
    must(fe_protected(&heap, check, &m) == FF_OK);
    fe_heap_close(&heap);
    for (size_t i = 0; i < m.count; i++)
        free(m.pieces[i]);
    return 0;
}
