/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The workers of a process. The answer to a case is a line of text: "<index> <key> <verdict>
 * <rest>". The verdict is one of enum study_case_verdict; the rest is the line for the journal
 * or an error message. */
#include "workers.h"

#include "../cases/case.h"
#include "../store/journal.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void study_pool_open(study_pool *pool, const study_run *run, study_records *done)
{
    *pool = (study_pool){.run = run,
                         .done = done,
                         .written_forms = json_object(),
                         .hidden = {-1, -1},
                         .extra_fd = -1};
    pool->workers = memory_alloc(run->jobs * sizeof *pool->workers);
    pool->polled = memory_alloc((run->jobs + 1) * sizeof *pool->polled);
}

void study_pool_close(study_pool *pool)
{
    for (size_t i = 0; pool->workers && i < pool->run->jobs; i++) {
        study_worker *worker = &pool->workers[i];
        if (worker->pid) {
            close(worker->to);
            worker->to = -1;
            kill(worker->pid, SIGCONT); /* otherwise a worker that a plugin has stopped would
                                           never end */
            free(study_worker_reap(worker));
        }
        free(worker->line);
        if (worker->shared)
            munmap(worker->shared, sizeof *worker->shared);
    }
    free(pool->workers);
    free(pool->polled);
    for (size_t i = pool->released; i < pool->held_count; i++)
        free(pool->held[i]);
    free(pool->held);
    free(pool->answer);
    json_decref(pool->written_forms);
}

void study_pool_kill(const study_pool *pool)
{
    for (size_t i = 0; pool->workers && i < pool->run->jobs; i++)
        if (pool->workers[i].pid)
            study_worker_kill(&pool->workers[i]);
}

/* Sends the next case of its chain to the worker. */
static void send_next_case(study_pool *pool, study_worker *worker)
{
    const study_definition *study = pool->run->study;
    size_t length = study_chain_length(study);
    size_t index = study_chain_case(study, worker->chain, length - worker->left--);
    if (worker->pid == 0 && !study_worker_start(worker, pool)) {
        pool->cause = errno;
        worker->busy = true;
        worker->index = index;
        return;
    }
    /* If the worker has just died, reading its answer will show it. */
    study_worker_send_case(worker, pool->run, index);
}

void study_pool_start_chain(study_pool *pool, size_t chain)
{
    size_t i = 0;
    while (i < pool->run->jobs - 1 && pool->workers[i].busy)
        i++;
    pool->workers[i].chain = chain;
    pool->workers[i].left = study_chain_length(pool->run->study);
    send_next_case(pool, &pool->workers[i]);
}

static void set_answer(study_pool *pool, const study_worker *worker, char verdict, const char *rest)
{
    const char *key = worker->shared && worker->shared->key[0] ? worker->shared->key : "-";
    free(pool->answer);
    pool->answer =
        memory_print_text("%zu %.*s %c %s", worker->index, STUDY_KEY_SIZE, key, verdict, rest);
}

/* Forces the logs of all workers to the disk. If that fails, the next answer reports it. */
static bool sync_logs(study_pool *pool)
{
    double start = study_seconds_now();
    for (size_t i = 0; i < pool->run->jobs; i++) {
        study_worker *worker = &pool->workers[i];
        if (!study_worker_is_ahead(worker) || study_worker_sync(worker, pool->run))
            continue;
        char *text = memory_print_text("%s/%s could not be written: %s", pool->run->directory,
                                       worker->shared->name, strerror(errno));
        set_answer(pool, worker, STUDY_VERDICT_FATAL, text);
        free(text);
        return false;
    }
    pool->sync_time = study_seconds_now() - start;
    return true;
}

/* Holds the worker's answer back until its arrays are on the disk. */
static void settle_arrays(study_pool *pool, const study_worker *worker)
{
    if (!study_worker_is_ahead(worker))
        return;
    if (!pool->groups) {
        sync_logs(pool);
        return;
    }
    if (pool->held_count == 0)
        pool->held_since = study_seconds_now();
    pool->held = memory_resize(pool->held, (pool->held_count + 1) * sizeof *pool->held);
    pool->held[pool->held_count++] = pool->answer;
    pool->answer = NULL;
}

/* Returns for how many s answers may still be held back: long enough that syncs take at most a
   tenth of the time, but only a short time, and not at all if there is nothing else to do. */
static double time_to_hold(const study_pool *pool)
{
    const double longest = 0.2;
    bool idle = true;
    for (size_t i = 0; i < pool->run->jobs; i++)
        idle = idle && !pool->workers[i].busy;
    double end = pool->held_since + fmin(9 * pool->sync_time, longest);
    return idle || pool->ending ? 0 : end - study_seconds_now();
}

/* Releases the next answer that was held back. After a write error, all these answers carry the
   error. */
static bool release_answer(study_pool *pool)
{
    if (pool->held_count == 0 || (pool->released == 0 && time_to_hold(pool) > 0))
        return false;
    if (pool->released > 0 || sync_logs(pool)) {
        free(pool->answer);
        pool->answer = pool->held[pool->released++];
    } else {
        while (pool->released < pool->held_count)
            free(pool->held[pool->released++]);
    }
    if (pool->released == pool->held_count)
        pool->released = pool->held_count = 0;
    return true;
}

static int finish_case(study_pool *pool, study_worker *worker, char verdict, const char *rest,
                       size_t *task)
{
    set_answer(pool, worker, verdict, rest);
    settle_arrays(pool, worker);
    worker->busy = false;
    *task = worker->chain;
    if (pool->ending || verdict == STUDY_VERDICT_FATAL || verdict == STUDY_VERDICT_WRITTEN_OVER ||
        (verdict == STUDY_VERDICT_FAILED && pool->run->fail_fast))
        worker->left = 0;
    if (worker->left == 0)
        return FF_TASK_OVER;
    send_next_case(pool, worker);
    return pool->answer ? FF_TASK_ANSWER : FF_TASK_NONE;
}

/* Stores the record of a line, since another worker may have to continue the chain. */
static void keep_record(study_pool *pool, const char *key, const char *line)
{
    if (study_chain_length(pool->run->study) == 1)
        return;
    json_t *record = study_records_take(pool->done, line, strlen(line));
    study_records_keep(pool->done, key, record);
    json_decref(record);
}

/* Records that the worker of a case has died, or was ended because it took too long. */
static int record_crash(study_pool *pool, study_worker *worker, const char *status, char *reason,
                        size_t *task)
{
    char key[STUDY_KEY_SIZE];
    if (!worker->busy) {
        free(reason);
        return FF_TASK_NONE;
    }
    if (!worker->shared->key[0]) /* it died while building the case */
        snprintf(worker->shared->key, STUDY_KEY_SIZE, "case-%zu", worker->index + 1);
    memcpy(key, worker->shared->key, sizeof key);
    key[STUDY_KEY_SIZE - 1] = '\0';
    json_t *record = study_case_record(pool->run, worker->index, key, status, reason);
    study_judge_record(record);
    char *line = study_journal_line(record, pool->written_forms);
    keep_record(pool, key, line);
    int state = finish_case(pool, worker, STUDY_VERDICT_FAILED, line, task);
    json_decref(record);
    free(line);
    free(reason);
    return state;
}

/* Refuses an answer that is malformed, since a plugin has written into the pipe of its worker. */
static int refuse_answer(study_pool *pool, study_worker *worker, size_t *task)
{
    study_worker_kill(worker);
    free(study_worker_reap(worker));
    return record_crash(
        pool, worker, "crashed",
        memory_print_text("its answer was spoiled: a plugin has written into a file that is not "
                          "its own"),
        task);
}

static int read_answer(study_pool *pool, study_worker *worker, size_t *task)
{
    int state = study_worker_read(worker);
    if (state < 0)
        return record_crash(pool, worker, "crashed", study_worker_reap(worker), task);
    if (state == 0)
        return FF_TASK_NONE;
    const char *line = worker->line;
    if (line[0] == STUDY_VERDICT_FATAL || line[0] == STUDY_VERDICT_WRITTEN_OVER)
        return finish_case(pool, worker, line[0], line + 1, task);
    enum study_state before = study_records_state(pool->done, worker->shared->key);
    if (!strcmp(line, "=\n") && before != STUDY_UNKNOWN)
        return finish_case(pool, worker,
                           before == STUDY_OK ? STUDY_VERDICT_KNOWN : STUDY_VERDICT_KNOWN_BAD, "",
                           task);
    if (!study_line_is_whole(line, worker->length))
        return refuse_answer(pool, worker, task);
    bool good = study_line_state(line) == STUDY_OK;
    keep_record(pool, worker->shared->key, line);
    return finish_case(pool, worker, good ? STUDY_VERDICT_GOOD : STUDY_VERDICT_FAILED, line, task);
}

/* Ends a worker whose case takes too long. */
static int check_time(study_pool *pool, study_worker *worker, size_t *task)
{
    double limit = pool->run->study->time_limit;
    if (!worker->busy || !(limit > 0) || study_seconds_now() - worker->case_start < limit)
        return FF_TASK_NONE;
    study_worker_kill(worker);
    free(study_worker_reap(worker));
    return record_crash(pool, worker, "time limit",
                        memory_print_text("the case took longer than its limit of %.6g s", limit),
                        task);
}

/* Checks one worker. `quiet`: no worker has written anything. */
static int poll_worker(study_pool *pool, size_t i, bool quiet, size_t *task)
{
    study_worker *worker = &pool->workers[i];
    int state = FF_TASK_NONE;
    if (worker->busy && !worker->pid) {
        char *text =
            memory_print_text("a worker process could not be started: %s", strerror(pool->cause));
        state = finish_case(pool, worker, STUDY_VERDICT_FATAL, text, task);
        free(text);
    }
    if (state == FF_TASK_NONE && worker->pid && pool->polled[i].revents)
        state = read_answer(pool, worker, task);
    if (state == FF_TASK_NONE && worker->busy && worker->pid && quiet &&
        study_worker_is_gone(worker))
        state = record_crash(pool, worker, "crashed", study_worker_reap(worker), task);
    if (state == FF_TASK_NONE && worker->pid)
        state = check_time(pool, worker, task);
    return state;
}

int study_pool_wait(study_pool *pool, int milliseconds, size_t *task)
{
    size_t jobs = pool->run->jobs;
    double limit = pool->run->study->time_limit;
    if (release_answer(pool))
        return FF_TASK_ANSWER;
    for (size_t i = 0; i < jobs; i++) {
        const study_worker *worker = &pool->workers[i];
        pool->polled[i] = (struct pollfd){.fd = worker->pid ? worker->from : -1, .events = POLLIN};
        if (worker->busy && !worker->pid)
            milliseconds = 0;
    }
    pool->polled[jobs] = (struct pollfd){.fd = pool->extra_fd, .events = POLLIN};
    if (milliseconds > 200)
        milliseconds = limit > 0 && limit < 1 ? 1 + (int)(limit * 200) : 200;
    if (pool->held_count)
        milliseconds = (int)fmin(milliseconds, 1 + 1000 * fmax(0, time_to_hold(pool)));
    int ready = poll(pool->polled, jobs + 1, milliseconds);
    if (ready < 0)
        memset(pool->polled, 0, jobs * sizeof *pool->polled);
    for (size_t n = 0; n < jobs; n++) {
        int state = poll_worker(pool, pool->turn++ % jobs, ready == 0, task);
        if (state != FF_TASK_NONE)
            return state;
    }
    return FF_TASK_NONE;
}
