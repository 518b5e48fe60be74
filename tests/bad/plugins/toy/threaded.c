/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Works in a thread of its own, which calls the host. */
#include <flankfilm/author.h>

#include <pthread.h>

static const ff_port outputs[] = {
    {.name = "series", .unit = "1", .doc = "the numbers from 0 on", .dims = "t"},
};

enum { COUNT = 5 };

static ff_status create(const ff_host *host, void **self)
{
    *self = (void *)(uintptr_t)host;
    return FF_OK;
}

/* Returns what is not NULL when it had no memory. */
static void *work(void *self)
{
    const ff_host *host = self;
    double *series = ff_put_series(host, 0, COUNT);
    for (int i = 0; series && i < COUNT; i++)
        series[i] = i;
    host->log(host->ctx, FF_LOG_INFO, "working");
    host->quality(host->ctx, "residual", 0, 1e-8, FF_GOOD, "in a thread");
    return series ? NULL : self;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    pthread_t thread;
    void *lacked;
    (void)wanted, (void)in;
    if (pthread_create(&thread, NULL, work, self) != 0)
        return FF_NOMEM;
    pthread_join(thread, &lacked);
    return lacked ? FF_NOMEM : FF_OK;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "toy/threaded",
    .version = "1.0.0",
    .summary = "Works in a thread of its own",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(outputs),
    .create = create,
    .evaluate = evaluate,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
