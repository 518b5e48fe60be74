/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two instances of it must not run at the same time. */
#include <flankfilm/author.h>

#include <unistd.h>

static const ff_port outputs[] = {
    {.name = "others", .unit = "1", .doc = "instances that ran meanwhile", .dims = ""},
};

static int running; /* what the processor does about it is not enough: += is no one step */

static ff_status create(const ff_host *host, void **self)
{
    *self = (void *)(uintptr_t)host;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    (void)wanted, (void)in;
    int others = running++;
    usleep(2000);
    others += running - 1;
    running--;
    return ff_put_scalar(self, 0, others);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .flags = FF_SERIAL,
    .id = "toy/serial",
    .version = "1.0.0",
    .summary = "Runs alone",
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
