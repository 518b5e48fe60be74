/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Slurm: the parts as an array of jobs. A job whose node is lost is queued again by Slurm; one that
 * nears its time limit is warned, finishes the cases at hand and queues itself again.
 */
#include <flankfilm/author.h>
#include <flankfilm/scheduler.h>

#include <stdlib.h>
#include <string.h>

enum { TIME, PARTITION, ACCOUNT, MEMORY, WARNING, TEXTS = WARNING };
enum { LONGEST = 200 };

typedef struct slurm {
    const ff_host *host;
    ff_scheduler service;
    char *texts[TEXTS]; /* NULL: left to Slurm */
    double warning;     /* s */
} slurm;

static const ff_param params[] = {
    {.name = "time",
     .unit = "",
     .doc = "time limit of a part as Slurm writes it, such as 02:00:00; else the partition's",
     .type = FF_TEXT},
    {.name = "partition", .unit = "", .doc = "partition; else Slurm's default", .type = FF_TEXT},
    {.name = "account", .unit = "", .doc = "account to charge; else the user's", .type = FF_TEXT},
    {.name = "memory",
     .unit = "",
     .doc = "memory for each worker as Slurm writes it, such as 2G; else the partition's",
     .type = FF_TEXT},
    {.name = "warning",
     .unit = "s",
     .doc = "a part that has this much time left hands out no more cases; more than a case takes",
     .type = FF_REAL,
     .preset = "120 s",
     .min = 1,
     .max = 65535},
};
static const char *const options[TEXTS] = {"time", "partition", "account", "mem-per-cpu"};

static const ff_port outputs[] = {
    {.name = "scheduler", .unit = "", .doc = "an array of jobs", .service = FF_SCHEDULER_ID},
};

typedef struct script {
    void (*put)(void *ctx, const char *text);
    void *ctx;
} script;

FF_PRINTF(2, 3) static void print(const script *s, const char *format, ...)
{
    char text[8192];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    s->put(s->ctx, text);
}

static void put_head(const slurm *self, const ff_submission *job, const script *s)
{
    print(s, "#!/bin/bash\n#SBATCH --job-name=%s\n#SBATCH --array=1-%zu\n", job->name, job->parts);
    print(s, "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=%zu\n", job->workers);
    for (size_t i = 0; i < TEXTS; i++)
        if (self->texts[i])
            print(s, "#SBATCH --%s=%s\n", options[i], self->texts[i]);
    print(s, "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --signal=B:USR1@%d\n",
          (int)self->warning);
    print(s, "#SBATCH --output=\"%s/part-%%a.out\"\n\n", job->logs);
}

static ff_status write_script(void *self, const ff_submission *job,
                              void (*put)(void *ctx, const char *text), void *ctx)
{
    const script s = {put, ctx};
    put_head(self, job, &s);
    print(&s, "# A task of the array is a part of the study. A part may run again: what is done\n"
              "# stays done. --array=3,7 on the command line of sbatch sends these two alone.\n");
    print(&s, "parts=%zu\ncd ", job->parts);
    put(ctx, job->directory);
    print(&s, " || exit\n");
    put(ctx, job->command);
    print(&s, " \"$SLURM_ARRAY_TASK_ID/$parts\" &\nwork=$!\n\n"
              "# The time limit is near: let the part finish what it has begun.\n"
              "late=\n"
              "trap 'late=yes; kill -TERM \"$work\"' USR1\n"
              "wait \"$work\"\n"
              "code=$?\n"
              "while kill -0 \"$work\" 2>/dev/null; do\n"
              "    wait \"$work\"\n"
              "    code=$?\n"
              "done\n"
              "if [ -n \"$late\" ] && [ \"$code\" -ne 0 ] && [ \"$code\" -ne 4 ]; then\n"
              "    exec scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"\n"
              "fi\n"
              "exit \"$code\"\n");
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    static const char *const send[] = {"sbatch", "--parsable", NULL};
    slurm *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    s->service =
        (ff_scheduler){.size = sizeof s->service, .self = s, .send = send, .write = write_script};
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    static const char legal[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                ":.,_-";
    slurm *s = self;
    if (param == WARNING) {
        s->warning = value->real;
        return FF_OK;
    }
    if (!*value->text || strlen(value->text) > LONGEST ||
        strspn(value->text, legal) < strlen(value->text))
        return ff_failf(s->host, FF_INVALID, params[param].name,
                        "expected one word, such as Slurm takes for --%s", options[param]);
    free(s->texts[param]);
    s->texts[param] = strdup(value->text);
    return s->texts[param] ? FF_OK : FF_NOMEM;
}

static const void *service(void *self, uint32_t output)
{
    slurm *s = self;
    (void)output;
    return &s->service;
}

static void destroy(void *self)
{
    slurm *s = self;
    for (size_t i = 0; s && i < TEXTS; i++)
        free(s->texts[i]);
    free(s);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "scheduler/slurm",
    .version = "1.0.0",
    .summary = "an array of Slurm jobs: flankfilm submit FILE --to slurm",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
