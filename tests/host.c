/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "host.h"

#include <flankfilm/engine.h>

#include <ctype.h>
#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ROWS = 64, MAX_QUALITY = 64, MAX_RANK = 4 };

typedef struct setting {
    ff_value value;
    char *text;
    double *reals;
    int given;
} setting;

typedef struct feed {
    int connected;
    stage *from;
    int output; /* of `from`; -1: the array below is the caller's */
    ff_array array;
    size_t shape[MAX_RANK];
    double scalar; /* what `array` points at when stage_give_scalar fed it */
} feed;

typedef struct output {
    double *data;
    size_t shape[MAX_RANK];
    uint32_t rank;
} output;

struct stage {
    const ff_model *model;
    void *self;
    ff_host host;
    setting settings[MAX_ROWS];
    feed feeds[MAX_ROWS];
    output outputs[MAX_ROWS];
    char quality_name[MAX_QUALITY][48];
    double quality[MAX_QUALITY], quality_limit[MAX_QUALITY];
    size_t quality_count;
    int worst, is_ready, has_run;
    uint64_t wanted; /* by the last evaluate */
    int stop_at, progress_calls;
    char why[1024], why_item[128];
    ff_tables tables;
};

static void die(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
    exit(2);
}

static const ff_param *param_row(const stage *s, size_t i)
{
    return (const ff_param *)(const void *)((const char *)s->model->params +
                                            i * s->model->param_stride);
}

static const ff_port *input_row(const stage *s, size_t i)
{
    return (const ff_port *)(const void *)((const char *)s->model->inputs +
                                           i * s->model->input_stride);
}

static const ff_port *output_row(const stage *s, size_t i)
{
    return (const ff_port *)(const void *)((const char *)s->model->outputs +
                                           i * s->model->output_stride);
}

static size_t find_output(const stage *s, const char *name)
{
    for (size_t i = 0; i < s->model->output_count; i++)
        if (!strcmp(output_row(s, i)->name, name))
            return i;
    die("%s has no output %s", s->model->id, name);
    return 0;
}

static size_t find_param(const stage *s, const char *name)
{
    for (size_t i = 0; i < s->model->param_count; i++)
        if (!strcmp(param_row(s, i)->name, name))
            return i;
    die("%s has no parameter %s", s->model->id, name);
    return 0;
}

static ff_status host_fail(void *ctx, ff_status status, const char *item, const char *text)
{
    stage *s = ctx;
    snprintf(s->why, sizeof s->why, "%s", text ? text : "");
    snprintf(s->why_item, sizeof s->why_item, "%s", item ? item : "");
    return status;
}

static void host_log(void *ctx, int32_t level, const char *text)
{
    const stage *s = ctx;
    fprintf(stderr, "%s: %s%s\n", s->model->id, level == FF_LOG_WARNING ? "warning: " : "", text);
}

static double *host_output(void *ctx, uint32_t index, uint32_t rank, const size_t *shape)
{
    stage *s = ctx;
    if (index >= s->model->output_count || rank > MAX_RANK)
        die("%s: output row %u, rank %u", s->model->id, index, rank);
    output *out = &s->outputs[index];
    size_t count = 1;
    for (uint32_t i = 0; i < rank; i++)
        count *= out->shape[i] = shape[i];
    free(out->data);
    out->rank = rank;
    out->data = calloc(count ? count : 1, sizeof *out->data);
    return out->data;
}

static void host_quality(void *ctx, const char *name, double value, double limit, int32_t verdict,
                         const char *text)
{
    stage *s = ctx;
    (void)text;
    if (s->quality_count == MAX_QUALITY)
        die("%s: more than %d quality lines", s->model->id, MAX_QUALITY);
    snprintf(s->quality_name[s->quality_count], sizeof s->quality_name[0], "%s", name);
    s->quality_limit[s->quality_count] = limit;
    s->quality[s->quality_count++] = value;
    if (verdict > s->worst)
        s->worst = verdict;
}

static int32_t host_progress(void *ctx, double fraction)
{
    stage *s = ctx;
    if (!(fraction >= 0 && fraction <= 1))
        die("%s: progress %g", s->model->id, fraction);
    return ++s->progress_calls == s->stop_at;
}

static ff_status tell_table(stage *s, ff_status status)
{
    char why[1024];
    if (status == FF_BUG)
        die("%s: a table that cannot be, or that it has not read", s->model->id);
    if (status == FF_OK)
        return status;
    ff_tables_print(&s->tables, why, sizeof why);
    return host_fail(s, status, s->tables.item, why);
}

static ff_status table_read(void *ctx, const char *item, const char *path, const ff_param *rows,
                            size_t count, size_t stride, const ff_table **table)
{
    stage *s = ctx;
    return tell_table(s, ff_tables_read(&s->tables, item, path, rows, count, stride, table));
}

static ff_status table_fail(void *ctx, const ff_table *table, size_t row, size_t column,
                            const char *text)
{
    stage *s = ctx;
    return tell_table(s, ff_tables_fail(&s->tables, table, row, column, text));
}

static const void *host_extension(void *ctx, const char *id)
{
    static const ff_table_reader tables = {sizeof tables, table_read, table_fail};
    (void)ctx;
    return !strcmp(id, FF_TABLE_ID) ? &tables : NULL;
}

static int32_t host_wanted(void *ctx, uint32_t index)
{
    const stage *s = ctx;
    return s->wanted >> index & 1;
}

static int32_t host_given(void *ctx, uint32_t index)
{
    const stage *s = ctx;
    return s->settings[index].given;
}

static const ff_model *find_model(void *object, const char *id)
{
    const ff_model *(*one)(void);
    const ff_model *const *(*list)(void);
    *(void **)(void *)&one = dlsym(object, "flankfilm_model_v1");
    *(void **)(void *)&list = dlsym(object, "flankfilm_models_v1");
    if (one)
        return strcmp(one()->id, id) ? NULL : one();
    for (const ff_model *const *m = list ? list() : NULL; m && *m; m++)
        if (!strcmp((*m)->id, id))
            return *m;
    return NULL;
}

stage *stage_open(const char *id)
{
    const char *directory = getenv("FLANKFILM_TEST_PLUGINS");
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.so", directory ? directory : "plugins", id);
    void *object = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!object)
        die("%s", dlerror());
    stage *s = calloc(1, sizeof *s);
    if (!s)
        die("out of memory");
    s->model = find_model(object, id);
    if (!s->model)
        die("%s has no model %s", path, id);
    if (s->model->param_count > MAX_ROWS || s->model->input_count > MAX_ROWS ||
        s->model->output_count > MAX_ROWS)
        die("%s: a table of more than %d rows", id, MAX_ROWS);
    s->host = (ff_host){
        .size = sizeof s->host,
        .abi_minor = FF_ABI_MINOR,
        .ctx = s,
        .fail = host_fail,
        .log = host_log,
        .output = host_output,
        .quality = host_quality,
        .progress = host_progress,
        .extension = host_extension,
        .wanted = host_wanted,
        .given = host_given,
    };
    if (s->model->create(&s->host, &s->self) != FF_OK)
        die("%s: create: %s", id, s->why);
    return s;
}

void stage_close(stage *s)
{
    if (!s)
        return;
    if (s->model->destroy)
        s->model->destroy(s->self);
    ff_tables_free(&s->tables);
    for (size_t i = 0; i < MAX_ROWS; i++) {
        free(s->settings[i].text);
        free(s->settings[i].reals);
        free(s->outputs[i].data);
    }
    free(s);
}

static void keep(stage *s, size_t row, setting value)
{
    if (s->is_ready)
        die("%s: set %s after ready", s->model->id, param_row(s, row)->name);
    setting *slot = &s->settings[row];
    free(slot->text);
    free(slot->reals);
    *slot = value;
    slot->value.size = sizeof slot->value;
    slot->value.text = slot->text;
    slot->value.reals = slot->reals;
}

void stage_set(stage *s, const char *param, double si)
{
    size_t row = find_param(s, param);
    setting v = {.given = 1, .value = {.real = si, .given = 1}};
    int32_t type = param_row(s, row)->type;
    if (type == FF_REALS) {
        stage_set_reals(s, param, 1, &si);
        return;
    }
    if (type != FF_REAL)
        v.value.integer = (int64_t)si;
    keep(s, row, v);
}

void stage_set_reals(stage *s, const char *param, size_t count, const double *si)
{
    setting v = {.given = 1, .value = {.count = count, .given = 1}};
    v.reals = malloc((count ? count : 1) * sizeof *si);
    if (!v.reals)
        die("out of memory");
    memcpy(v.reals, si, count * sizeof *si);
    keep(s, find_param(s, param), v);
}

/* Rank of `word` in "a|b|c", or -1. */
static int choice_rank(const char *choices, const char *word)
{
    size_t length = strlen(word);
    int rank = 0;
    for (const char *at = choices; at && *at; rank++) {
        size_t n = strcspn(at, "|");
        if (n == length && !strncmp(at, word, n))
            return rank;
        at += n + (at[n] == '|');
    }
    return -1;
}

static double quantity(const stage *s, const ff_param *row, const char *text)
{
    ff_unit unit;
    char why[256];
    double si = 0;
    if (!ff_unit_parse(row->unit, &unit, why, sizeof why) ||
        !ff_quantity_parse(text, &unit, row->unit, &si, why, sizeof why))
        die("%s.%s = %s: %s", s->model->id, row->name, text, why);
    return si;
}

static void read_list(const stage *s, const ff_param *row, const char *text, setting *v)
{
    char item[128];
    v->reals = malloc((strlen(text) + 1) * sizeof *v->reals);
    if (!v->reals)
        die("out of memory");
    for (const char *at = text; *at;) {
        at += strspn(at, "[], \n");
        size_t n = strcspn(at, "],");
        if (n == 0)
            break;
        snprintf(item, sizeof item, "%.*s", (int)n, at);
        v->reals[v->value.count++] = quantity(s, row, item);
        at += n;
    }
}

static setting read_text(const stage *s, size_t index, const char *text, int given)
{
    const ff_param *row = param_row(s, index);
    setting v = {.given = given, .value = {.given = given}};
    int rank = choice_rank(row->choices, text);
    if (rank >= 0 || row->type == FF_TEXT || row->type == FF_FILE) {
        v.text = strdup(text);
        v.value.integer = rank;
    } else if (row->type == FF_REAL)
        v.value.real = quantity(s, row, text);
    else if (row->type == FF_INT)
        v.value.integer = strtoll(text, NULL, 10);
    else if (row->type == FF_BOOL)
        v.value.integer = !strcmp(text, "true");
    else if (row->type == FF_REALS)
        read_list(s, row, text, &v);
    else
        die("%s.%s: no choice %s", s->model->id, row->name, text);
    return v;
}

void stage_set_text(stage *s, const char *param, const char *text)
{
    size_t row = find_param(s, param);
    keep(s, row, read_text(s, row, text, 1));
}

static feed *input_feed(stage *s, const char *row)
{
    for (size_t i = 0; i < s->model->input_count; i++)
        if (!strcmp(input_row(s, i)->name, row))
            return &s->feeds[i];
    die("%s has no input %s", s->model->id, row);
    return NULL;
}

void stage_link(stage *s, const char *wire, stage *from)
{
    size_t length = strlen(wire);
    int linked = 0;
    for (size_t i = 0; i < s->model->input_count; i++) {
        const ff_port *row = input_row(s, i);
        if (strncmp(row->name, wire, length) != 0)
            continue;
        if (row->service && row->name[length] == 0) {
            s->feeds[i] = (feed){.connected = 1, .from = from, .output = -1};
            linked = 1;
        } else if (!row->service && row->name[length] == '.') {
            const char *name = row->name + length + 1;
            int found = -1;
            for (size_t k = 0; k < from->model->output_count; k++)
                if (!strcmp(output_row(from, k)->name, name))
                    found = (int)k;
            if (found < 0 && !(row->flags & FF_OPTIONAL))
                die("%s needs %s, which %s does not offer", s->model->id, name, from->model->id);
            if (found >= 0)
                s->feeds[i] = (feed){.connected = 1, .from = from, .output = found};
            linked = 1;
        }
    }
    if (!linked)
        die("%s has no wire %s", s->model->id, wire);
}

int stage_carry(stage *to, const stage *from)
{
    ff_state_bytes state = {.size = sizeof state};
    if (!FF_HAS(from->model, carry) || !from->model->carry)
        die("%s hands on no state", from->model->id);
    if (from->model->carry(from->self, NULL, &state) != FF_OK || state.count == 0)
        return 0;
    void *copy = malloc(state.count);
    if (!copy)
        die("out of memory");
    memcpy(copy, state.bytes, state.count);
    state.bytes = copy;
    ff_status status = to->model->carry(to->self, &state, NULL);
    free(copy);
    return status == FF_OK;
}

void stage_give(stage *s, const char *row, uint32_t rank, const size_t *shape, const double *data)
{
    feed *f = input_feed(s, row);
    *f = (feed){.connected = 1, .output = -1, .array = {.data = data, .rank = rank}};
    for (uint32_t i = 0; i < rank; i++)
        f->shape[i] = shape[i];
}

void stage_give_series(stage *s, const char *row, size_t count, const double *data)
{
    stage_give(s, row, 1, &count, data);
}

void stage_give_scalar(stage *s, const char *row, double value)
{
    feed *f = input_feed(s, row);
    *f = (feed){.connected = 1, .output = -1, .scalar = value};
    f->array.data = &f->scalar;
}

static bool has_place(const stage *s, const ff_param *row)
{
    return s->model->param_stride >= sizeof *row && row->place;
}

/* The wire that replaces the parameter is connected. */
static bool is_replaced(const stage *s, const ff_param *row)
{
    if (s->model->param_stride < sizeof *row || !row->instead)
        return false;
    for (size_t i = 0; i < s->model->input_count; i++)
        if (!strcmp(input_row(s, i)->name, row->instead))
            return s->feeds[i].connected;
    return false;
}

static int group_is_given(const stage *s, const char *group)
{
    for (size_t i = 0; group && i < s->model->param_count; i++) {
        const char *other = param_row(s, i)->group;
        if (other && !strcmp(other, group) && s->settings[i].given)
            return 1;
    }
    return 0;
}

static ff_status apply_settings(stage *s)
{
    bool present[MAX_ROWS];
    for (size_t i = 0; i < s->model->param_count; i++) {
        const ff_param *row = param_row(s, i);
        bool preset = row->preset && !group_is_given(s, row->group) && !is_replaced(s, row);
        present[i] = s->settings[i].given || preset;
        if (!s->settings[i].given && preset)
            keep(s, i, read_text(s, i, row->preset, 0));
        if (has_place(s, row))
            ff_param_place(row, s->self, present[i] ? &s->settings[i].value : NULL);
    }
    for (size_t i = 0; i < s->model->param_count; i++) {
        setting *v = &s->settings[i];
        if (!present[i] || has_place(s, param_row(s, i)))
            continue;
        ff_status status = s->model->set(s->self, (uint32_t)i, &v->value);
        if (status < 0)
            return status;
    }
    return FF_OK;
}

ff_status stage_ready(stage *s)
{
    if (s->is_ready)
        return FF_OK;
    ff_status status = apply_settings(s);
    for (size_t i = 0; i < s->model->input_count && status >= 0; i++) {
        const feed *f = &s->feeds[i];
        const ff_port *row = input_row(s, i);
        if (!f->connected && !(row->flags & FF_OPTIONAL))
            die("%s: input %s is not connected", s->model->id, row->name);
        if (f->connected && s->model->wire)
            status = s->model->wire(s->self, (uint32_t)i,
                                    row->service ? stage_service(f->from, row->service) : NULL);
    }
    if (status >= 0 && s->model->ready)
        status = s->model->ready(s->self);
    s->is_ready = status >= 0;
    return status;
}

static ff_status run_bits(stage *s, uint64_t wanted)
{
    ff_array in[MAX_ROWS] = {{0}};
    ff_status status = stage_ready(s);
    for (size_t i = 0; i < s->model->input_count && status >= 0; i++) {
        feed *f = &s->feeds[i];
        if (!f->connected || input_row(s, i)->service)
            continue;
        in[i] = f->array;
        in[i].shape = f->shape;
        if (f->output >= 0) {
            if (!f->from->has_run && (status = stage_run(f->from)) != FF_OK)
                return host_fail(s, status, input_row(s, i)->name, f->from->why);
            const output *out = &f->from->outputs[f->output];
            in[i] = (ff_array){.data = out->data, .shape = out->shape, .rank = out->rank};
        }
    }
    if (status < 0)
        return status;
    s->quality_count = 0;
    s->worst = FF_GOOD;
    s->progress_calls = 0;
    for (size_t i = 0; i < MAX_ROWS; i++) {
        free(s->outputs[i].data);
        s->outputs[i] = (output){0};
    }
    s->wanted = wanted;
    status = s->model->evaluate(s->self, wanted, in);
    s->has_run = status >= 0;
    for (size_t i = 0; i < s->model->output_count && status >= 0; i++) {
        size_t count = 1;
        for (uint32_t k = 0; k < s->outputs[i].rank; k++)
            count *= s->outputs[i].shape[k];
        for (size_t k = 0; s->outputs[i].data && k < count; k++)
            if (!isfinite(s->outputs[i].data[k]))
                die("%s: %s[%zu] is not finite", s->model->id, output_row(s, i)->name, k);
    }
    return status;
}

/* Bit of the output that the model refused for its inputs, as it may; 0: it failed otherwise. */
static uint64_t refused(const stage *s, ff_status status)
{
    for (size_t i = 0; i < s->model->output_count && status == FF_UNSUPPORTED; i++)
        if (!strcmp(output_row(s, i)->name, s->why_item))
            return UINT64_C(1) << i;
    return 0;
}

ff_status stage_run(stage *s)
{
    uint64_t wanted = 0, without;
    ff_status status;
    for (size_t i = 0; i < s->model->output_count; i++)
        if (!output_row(s, i)->service)
            wanted |= UINT64_C(1) << i;
    do {
        status = run_bits(s, wanted);
        without = wanted & refused(s, status);
        wanted &= ~without;
    } while (without);
    return status;
}

ff_status stage_run_wanted(stage *s, const char *outputs)
{
    uint64_t wanted = 0;
    char name[64];
    for (const char *at = outputs; *at;) {
        size_t n = strcspn(at, " ");
        snprintf(name, sizeof name, "%.*s", (int)n, at);
        wanted |= UINT64_C(1) << find_output(s, name);
        at += n + strspn(at + n, " ");
    }
    return run_bits(s, wanted);
}

int stage_has(const stage *s, const char *name)
{
    return s->outputs[find_output(s, name)].data != NULL;
}

size_t stage_count(const stage *s, const char *name)
{
    const output *out = &s->outputs[find_output(s, name)];
    if (!out->data)
        die("%s: output %s was not given", s->model->id, name);
    size_t n = 1;
    for (uint32_t i = 0; i < out->rank; i++)
        n *= out->shape[i];
    return n;
}

const double *stage_get(const stage *s, const char *name, size_t *count)
{
    size_t n = stage_count(s, name);
    if (n == 0)
        die("%s: output %s is empty", s->model->id, name);
    if (count)
        *count = n;
    return s->outputs[find_output(s, name)].data;
}

const size_t *stage_shape(const stage *s, const char *name, uint32_t *rank)
{
    const output *out = &s->outputs[find_output(s, name)];
    if (rank)
        *rank = out->rank;
    return out->shape;
}

double stage_scalar(const stage *s, const char *name)
{
    return stage_get(s, name, NULL)[0];
}

const void *stage_service(stage *s, const char *id)
{
    if (stage_ready(s) < 0)
        die("%s: %s", s->model->id, s->why);
    for (size_t i = 0; i < s->model->output_count; i++) {
        const ff_port *row = output_row(s, i);
        if (row->service && !strcmp(row->service, id))
            return s->model->service(s->self, (uint32_t)i);
    }
    die("%s offers no %s", s->model->id, id);
    return NULL;
}

const char *stage_why(const stage *s)
{
    return s->why;
}

const char *stage_why_item(const stage *s)
{
    return s->why_item;
}

static size_t quality_line(const stage *s, const char *name)
{
    for (size_t i = 0; i < s->quality_count; i++)
        if (!strcmp(s->quality_name[i], name))
            return i;
    die("%s: no quality line %s", s->model->id, name);
    return 0;
}

double stage_quality(const stage *s, const char *name)
{
    return s->quality[quality_line(s, name)];
}

double stage_quality_limit(const stage *s, const char *name)
{
    return s->quality_limit[quality_line(s, name)];
}

int stage_verdict(const stage *s)
{
    return s->worst;
}

void stage_stop_at(stage *s, int call)
{
    s->stop_at = call;
}

static int checks, failures;

static int count_check(int holds)
{
    checks++;
    failures += !holds;
    return holds;
}

int check_near(const char *what, double value, double expected, double relative)
{
    double scale = fabs(expected) > 0 ? fabs(expected) : 1;
    double error = fabs(value - expected) / scale;
    int holds = error <= relative;
    printf("%s %s: %.10g, expected %.10g, off by %.2e of %.1e\n", holds ? "ok  " : "FAIL", what,
           value, expected, error, relative);
    return count_check(holds);
}

int check_below(const char *what, double value, double limit)
{
    int holds = value <= limit;
    printf("%s %s: %.4g <= %.4g\n", holds ? "ok  " : "FAIL", what, value, limit);
    return count_check(holds);
}

int check_true(const char *what, int condition)
{
    printf("%s %s\n", condition ? "ok  " : "FAIL", what);
    return count_check(condition != 0);
}

int check_done(void)
{
    printf("%d checks, %d failed\n", checks, failures);
    return checks == 0 || failures > 0;
}
