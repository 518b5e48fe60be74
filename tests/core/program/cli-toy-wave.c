/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model without physics for tests of the command line: a wave, and ways of going wrong. */
#include <flankfilm/author.h>

#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { AMPLITUDE, COUNT, WORK, END, FACTORS, SHAPE };
enum { TOTAL, TIME, HEIGHT, X, FIELD, LEVEL, LENGTHS };
enum {
    GOOD,
    DOUBTFUL,
    BAD,
    FAIL,
    INVALID,
    NOISY,
    DEAF,
    QUIT,
    CRASH,
    SEGV,
    EAT,
    SPAWN,
    STARVE,
    SCRIBBLE
};

typedef struct wave {
    const ff_host *host;
    double amplitude, work;
    size_t count;
    int64_t end;
    int *nowhere; /* NULL */
} wave;

static const ff_param params[] = {
    {.name = "amplitude",
     .unit = "mm",
     .doc = "half the height of the wave",
     .type = FF_REAL,
     .flags = FF_REQUIRED | FF_MIN_OPEN,
     .min = 0,
     .max = 10,
     .low = 0.001,
     .high = 5},
    {.name = "count",
     .unit = "",
     .doc = "number of points",
     .type = FF_INT,
     .preset = "8",
     .min = 1,
     .max = 20000},
    {.name = "work", .unit = "s", .doc = "how long to seem busy", .type = FF_REAL, .preset = "0 s"},
    {.name = "end",
     .unit = "",
     .doc = "how the evaluation ends",
     .type = FF_CHOICE,
     .preset = "good",
     .choices =
         "good|doubtful|bad|fail|invalid|noisy|deaf|quit|crash|segv|eat|spawn|starve|scribble"},
    {.name = "factors",
     .unit = "1",
     .doc = "a list that nothing depends on",
     .type = FF_REALS,
     .preset = "[1, 2]",
     .min_count = 1,
     .max_count = 3},
    {.name = "shape", .unit = "", .doc = "a text that nothing depends on", .type = FF_TEXT},
};

static const ff_port outputs[] = {
    {.name = "total", .unit = "m", .doc = "sum of the heights", .dims = ""},
    {.name = "time", .unit = "s", .doc = "time", .dims = "t"},
    {.name = "height", .unit = "m", .doc = "height of the wave", .dims = "t"},
    {.name = "x", .unit = "m", .doc = "position", .dims = "x"},
    {.name = "field", .unit = "m", .doc = "height over time and position", .dims = "t x"},
    {.name = "level", .unit = "1", .doc = "rank of a point", .dims = "point"},
    {.name = "cost",
     .unit = "1",
     .doc = "number of points, with which the work would grow in a model that computes something",
     .dims = ""},
};

static ff_status create(const ff_host *host, void **self)
{
    wave *w = calloc(1, sizeof *w);
    if (!w)
        return FF_NOMEM;
    w->host = host;
    *self = w;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    wave *w = self;
    if (param == AMPLITUDE)
        w->amplitude = value->real;
    else if (param == COUNT)
        w->count = (size_t)value->integer;
    else if (param == WORK)
        w->work = value->real;
    else if (param == END)
        w->end = value->integer;
    return FF_OK;
}

/* Seems busy and tells how far it is; a deaf wave goes on when it is asked to stop. */
static ff_status work(const wave *w)
{
    struct timespec nap = {0, 5000000}; /* 5 ms */
    int naps = (int)(w->work / 5e-3);
    for (int i = 0; i < naps; i++) {
        nanosleep(&nap, NULL);
        if (w->host->progress(w->host->ctx, (double)i / naps) && w->end != DEAF)
            return FF_STOPPED;
    }
    return FF_OK;
}

static ff_status give_series(const wave *w)
{
    double *time = ff_put_series(w->host, TIME, w->count);
    double *height = ff_put_series(w->host, HEIGHT, w->count);
    double *x = ff_put_series(w->host, X, w->count + 1);
    if (!time || !height || !x)
        return FF_NOMEM;
    double sum = 0;
    for (size_t i = 0; i < w->count; i++) {
        time[i] = 0.001 * (double)i;
        height[i] = w->amplitude * sin(0.5 * (double)i);
        sum += height[i];
    }
    for (size_t i = 0; i <= w->count; i++)
        x[i] = 1e-5 * (double)i;
    return ff_put_scalar(w->host, TOTAL, sum);
}

static ff_status give_field(const wave *w)
{
    const size_t shape[2] = {w->count, w->count + 1};
    double *field = w->host->output(w->host->ctx, FIELD, 2, shape);
    if (!field)
        return FF_NOMEM;
    for (size_t i = 0; i < shape[0] * shape[1]; i++)
        field[i] = w->amplitude * (1 + (double)i) / 3;
    return FF_OK;
}

/* Takes 1 GiB unless it is kept from it. */
static ff_status eat(const wave *w)
{
    enum { BITES = 16, BITE = 1 << 26 };
    void *eaten[BITES];
    int count = 0;
    while (count < BITES && (eaten[count] = calloc(1, BITE)))
        memset(eaten[count++], 1, BITE);
    bool whole = count == BITES;
    while (count > 0)
        free(eaten[--count]);
    return whole ? FF_OK : w->host->fail(w->host->ctx, FF_NOMEM, NULL, "nothing left to eat");
}

/* Asks for memory for ever, as some libraries do. */
static ff_status starve(void)
{
    void *at;
    do
        at = mmap(NULL, (size_t)1 << 47, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    while (at == MAP_FAILED);
    return FF_OK;
}

__attribute__((no_sanitize("undefined"))) static void write_nowhere(const wave *w)
{
    *w->nowhere = 1;
}

static ff_status judge(const wave *w)
{
    const ff_host *host = w->host;
    int32_t verdict = w->end == BAD ? FF_BAD : w->end == DOUBTFUL ? FF_DOUBTFUL : FF_GOOD;
    host->quality(host->ctx, "residual", verdict == FF_GOOD ? 1e-9 : 1e-3, 1e-6, verdict,
                  "what is left over");
    if (w->end == NOISY) {
        host->log(host->ctx, FF_LOG_INFO, "a remark in passing");
        host->log(host->ctx, FF_LOG_WARNING, "a word of caution");
    }
    if (w->end == QUIT)
        exit(0);
    if (w->end == CRASH)
        abort();
    if (w->end == SEGV)
        write_nowhere(w);
    if (w->end == EAT)
        return eat(w);
    if (w->end == FAIL)
        return host->fail(host->ctx, FF_NOCONV, NULL, "the wave broke at step 3");
    if (w->end == INVALID)
        return host->fail(host->ctx, FF_INVALID, "amplitude", "the wave is too high for its bed");
    return FF_OK;
}

/* By libc's own function: the program refuses that of its name. */
static int spawn(void)
{
    int (*run)(const char *);
    *(void **)(void *)&run = dlsym(dlopen("libc.so.6", RTLD_NOW | RTLD_NOLOAD), "system");
    return run("sleep 60 </dev/null >/dev/null 2>&1 & echo $! >child");
}

/* Writes into whatever is open, as a program does that has closed a file twice. */
static void scribble(void)
{
    for (int fd = 3; fd < 20; fd++)
        if (write(fd, "scribble", 8) < 0)
            continue;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const wave *w = self;
    (void)in;
    if (w->end == SPAWN && spawn() != 0)
        return FF_NOCONV;
    if (w->end == SCRIBBLE)
        scribble();
    ff_status status = w->end == STARVE ? starve() : work(w);
    if (status == FF_OK)
        status = give_series(w);
    if (status == FF_OK && wanted & FF_BIT(FIELD))
        status = give_field(w);
    if (status == FF_OK && wanted & FF_BIT(LEVEL)) {
        double *level = ff_put_series(w->host, LEVEL, 2);
        if (!level)
            return FF_NOMEM;
        level[1] = 1;
    }
    if (status == FF_OK)
        status = ff_put_scalar(w->host, LENGTHS, (double)w->count);
    return status == FF_OK ? judge(w) : status;
}

static const ff_param columns[] = {
    {.name = "depth",
     .unit = "mm",
     .doc = "of the water below",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = 0,
     .max = 40},
};

static void destroy(void *self)
{
    free(self);
}

const ff_model *flankfilm_model_v1(void)
{
    static const ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "toy/wave",
        .version = "1.2.3",
        .summary = "a wave without physics",
        .reference = "Nobody 1900, Journal of Toys 1",
        .bibtex = "@article{nobody1900, title={Waves}}",
        .licence = "GPL-3.0-or-later",
        .params = params,
        .param_count = sizeof params / sizeof params[0],
        .param_stride = sizeof params[0],
        .outputs = outputs,
        .output_count = sizeof outputs / sizeof outputs[0],
        .output_stride = sizeof outputs[0],
        .create = create,
        .set = set,
        .evaluate = evaluate,
        .destroy = destroy,
        .columns = FF_TABLE(columns),
    };
    return &model;
}
