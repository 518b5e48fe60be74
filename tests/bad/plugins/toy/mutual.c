/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Must run alone, and so must its service, which the other side uses: see engine-threads. */
#include <flankfilm/author.h>

#include <unistd.h>

#define TURN_ID "toy.turn/1"

typedef struct turn {
    size_t size;
    int (*take)(void);
} turn;

typedef struct side {
    const ff_host *host;
    const turn *other; /* NULL: none */
} side;

static const ff_port inputs[] = {
    {.name = "other",
     .unit = "",
     .doc = "the other side",
     .service = TURN_ID,
     .flags = FF_OPTIONAL,
     .from = "toy"},
};

static const ff_port outputs[] = {
    {.name = "turn", .unit = "", .doc = "its turns", .service = TURN_ID},
    {.name = "others", .unit = "1", .doc = "turns that others took meanwhile", .dims = ""},
};

static int turns; /* of the object: += is no one step */

static int take(void)
{
    int before = turns++;
    usleep(100);
    return turns - before - 1;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)input;
    ((side *)self)->other = service;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    static const turn table = {sizeof table, take};
    (void)self, (void)output;
    return &table;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const side *s = self;
    (void)wanted, (void)in;
    int others = take();
    if (s->host->progress(s->host->ctx, 0.5))
        return FF_STOPPED;
    for (int i = 0; s->other && i < 5; i++)
        others += s->other->take();
    return ff_put_scalar(s->host, 1, others);
}

FF_MODEL(model, side, .flags = FF_SERIAL, .id = "toy/" SIDE, .version = "1.0.0",
         .summary = "One of two sides that call each other", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .inputs = FF_TABLE(inputs), .outputs = FF_TABLE(outputs),
         .wire = wire, .service = service, .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
