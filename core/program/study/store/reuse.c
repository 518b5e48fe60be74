/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores results of stages on the disk for reuse. While a process computes a stage, it locks the
   file of the stage, and others wait for it. A checksum distinguishes a complete file from an
   incomplete one. */
#include "reuse.h"

#include "hash.h"

#include "../../memory/file.h"
#include "../../memory/memory.h"
#include "../../run/run.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const double worth_keeping = 2e-3; /* Least time of an evaluation, s, for which its result
                                             is stored; writing a file takes a tenth of that. */
enum {
    FORM = 2,          /* version of the file format; a file of another version counts as damaged */
    LARGEST = 1 << 26, /* bytes of a file */
    /* number of bytes stored without being reused, after which results of the stage are no
       longer stored */
    MOST_IDLE = 1 << 26
};

static void write_text(FILE *out, const char *text)
{
    size_t length = text ? strlen(text) : 0;
    fwrite(&length, sizeof length, 1, out);
    if (length)
        fwrite(text, 1, length, out);
}

/* The unread part of a file. Its contents are not trusted. */
typedef struct kept_bytes {
    const char *at;
    size_t left;
    bool good; /* false once data were missing */
} kept_bytes;

static const char *take_bytes(kept_bytes *in, size_t size)
{
    const char *at = in->at;
    in->good = in->good && size <= in->left;
    if (!in->good)
        return NULL;
    in->at += size;
    in->left -= size;
    return at;
}

static void read_bytes(kept_bytes *in, void *data, size_t size)
{
    const char *from = take_bytes(in, size);
    if (from)
        memcpy(data, from, size);
    else
        memset(data, 0, size);
}

/* Reads a text. Returns NULL if it is empty. */
static char *read_text(kept_bytes *in)
{
    size_t length;
    read_bytes(in, &length, sizeof length);
    const char *from = take_bytes(in, length);
    return from && length ? memory_copy_text(from, length) : NULL;
}

static void write_results(const ff_stage *stage, FILE *out)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        int32_t rank = result->data ? (int32_t)result->rank : -1;
        fwrite(&rank, sizeof rank, 1, out);
        fwrite(result->shape, sizeof *result->shape, rank > 0 ? (size_t)rank : 0, out);
        if (result->data)
            fwrite(result->data, sizeof *result->data, result->count, out);
    }
    fwrite(&stage->seconds, sizeof stage->seconds, 1, out);
    fwrite(&stage->work, sizeof stage->work, 1, out);
    fwrite(&stage->quality_count, sizeof stage->quality_count, 1, out);
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        fwrite(&line->value, sizeof line->value, 1, out);
        fwrite(&line->limit, sizeof line->limit, 1, out);
        const int32_t verdict = ff_quality_given(line);
        fwrite(&verdict, sizeof verdict, 1, out);
        write_text(out, line->name);
        write_text(out, line->text);
    }
}

/* Reads the numbers of an output. `fill`: copies them to the stage. */
static void read_output(ff_stage *stage, size_t output, uint32_t rank, bool fill, kept_bytes *in)
{
    size_t shape[FF_MAX_RANK], count = 1;
    in->good = in->good && rank <= stage->loaded->output_dims[output].rank && rank <= FF_MAX_RANK;
    for (uint32_t k = 0; in->good && k < rank; k++) {
        read_bytes(in, &shape[k], sizeof shape[k]);
        in->good = in->good && (count == 0 || shape[k] <= in->left / count);
        count *= shape[k];
    }
    in->good = in->good && count <= in->left / sizeof(double);
    const char *from = take_bytes(in, in->good ? count * sizeof(double) : 0);
    if (from && fill)
        memcpy(ff_result_fill(stage, output, rank, shape), from, count * sizeof(double));
}

/* Reads what write_results has written. `fill`: copies it to the stage. Returns false if a
   requested result is missing, or if the file has another format. */
static bool read_results(ff_stage *stage, bool fill, kept_bytes *in)
{
    bool all = true;
    double seconds, work;
    size_t lines;
    for (size_t i = 0; i < stage->loaded->model->output_count && in->good; i++) {
        int32_t rank;
        read_bytes(in, &rank, sizeof rank);
        /* rank below 0: the model did not give the output */
        all = all && (rank >= 0 || !stage->results[i].wanted);
        if (rank >= 0)
            read_output(stage, i, (uint32_t)rank, fill, in);
    }
    read_bytes(in, &seconds, sizeof seconds);
    read_bytes(in, &work, sizeof work);
    read_bytes(in, &lines, sizeof lines);
    if (fill) {
        stage->seconds = seconds;
        stage->work = work;
    }
    for (size_t i = 0; i < lines && in->good; i++) {
        ff_quality line;
        read_bytes(in, &line.value, sizeof line.value);
        read_bytes(in, &line.limit, sizeof line.limit);
        read_bytes(in, &line.verdict, sizeof line.verdict);
        char *name = read_text(in), *text = read_text(in);
        in->good = in->good && name && line.verdict >= 0 && line.verdict <= FF_RANGE;
        if (fill && in->good)
            ff_add_quality(stage, name, line.value, line.limit, line.verdict, text);
        free(name);
        free(text);
    }
    return all && in->good;
}

static bool read_kept(int fd, const ff_pipeline *pipeline, const ff_stage *stage)
{
    struct stat info;
    uint64_t sum;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size <= (off_t)sizeof sum ||
        info.st_size > LARGEST)
        return false;
    size_t size = (size_t)info.st_size;
    char *text = memory_alloc(size);
    bool whole = file_read(fd, text, size, 0);
    memcpy(&sum, text, sizeof sum);
    whole =
        whole && sum == study_hash(STUDY_HASH_START ^ FORM, text + sizeof sum, size - sizeof sum);
    /* the first pass only checks the file, so that a stage is never filled from a damaged one */
    for (int fill = 0; fill < 2 && whole; fill++) {
        kept_bytes in = {text + sizeof sum, size - sizeof sum, true};
        for (size_t i = 0; whole && run_together(pipeline, stage, i); i++)
            whole = read_results(run_together(pipeline, stage, i), fill, &in);
    }
    free(text);
    return whole;
}

void study_reuse_clear(int study)
{
    int fd = openat(study, "stages", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = fd < 0 ? NULL : fdopendir(fd);
    const struct dirent *item;
    while (list && (item = readdir(list)))
        unlinkat(dirfd(list), item->d_name, 0);
    if (list)
        closedir(list);
    else if (fd >= 0)
        close(fd);
}

bool study_reuse_recall(void *ctx, const ff_pipeline *pipeline, ff_stage *stage)
{
    study_reuse *reuse = ctx;
    size_t index = (size_t)(stage - pipeline->stages);
    study_reuse_stats *own = &reuse->stats[index];
    bool fresh = false;
    for (size_t i = 0; reuse->fresh && run_together(pipeline, stage, i); i++)
        fresh = fresh || reuse->fresh[run_together(pipeline, stage, i) - pipeline->stages];
    if (reuse->directory < 0 || fresh || own->idle > MOST_IDLE ||
        (own->seconds > 0 && own->seconds < worth_keeping))
        return false;
    snprintf(reuse->name, sizeof reuse->name, "%016llx",
             (unsigned long long)study_hash_evaluation(pipeline, stage, reuse->fingerprints));
    int fd = openat(reuse->directory, reuse->name,
                    O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (fd < 0)
        return false;
    while (flock(fd, LOCK_EX) != 0 && errno == EINTR)
        ;
    if (read_kept(fd, pipeline, stage)) {
        own->idle = 0;
        close(fd);
        return true;
    }
    reuse->held = fd;
    return false;
}

/* Returns the number of bytes written. */
static size_t write_kept(int fd, const ff_pipeline *pipeline, const ff_stage *stage)
{
    char *text = NULL;
    size_t length = 0;
    uint64_t sum = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        return 0;
    fwrite(&sum, sizeof sum, 1, out);
    for (size_t i = 0; run_together(pipeline, stage, i); i++)
        write_results(run_together(pipeline, stage, i), out);
    bool whole = fclose(out) == 0 && length <= LARGEST;
    if (whole) {
        sum = study_hash(STUDY_HASH_START ^ FORM, text + sizeof sum, length - sizeof sum);
        memcpy(text, &sum, sizeof sum);
        whole = ftruncate(fd, 0) == 0 && pwrite(fd, text, length, 0) == (ssize_t)length;
    }
    if (!whole && ftruncate(fd, 0) != 0)
        length = 0; /* the checksum will not match, so the file is invalid */
    free(text);
    return length;
}

void study_reuse_keep(void *ctx, const ff_pipeline *pipeline, const ff_stage *stage)
{
    study_reuse *reuse = ctx;
    size_t index = (size_t)(stage - pipeline->stages);
    bool good = true;
    double seconds = 0;
    for (size_t i = 0; run_together(pipeline, stage, i); i++) {
        const ff_stage *one = run_together(pipeline, stage, i);
        good = good && one->ran && one->status == FF_OK;
        seconds += one->seconds;
    }
    reuse->stats[index].seconds = seconds;
    if (reuse->held < 0)
        return;
    good = good && json_array_size(reuse->warnings) == 0;
    size_t kept = good && seconds >= worth_keeping ? write_kept(reuse->held, pipeline, stage) : 0;
    reuse->stats[index].idle += kept;
    if (kept == 0)
        unlinkat(reuse->directory, reuse->name, 0);
    close(reuse->held);
    reuse->held = -1;
}
