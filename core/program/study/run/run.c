/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs a study: distributes cases and writes their answers to the journal. */
#include "run.h"

#include "finished-cases.h"
#include "workers.h"

#include "../../crash/lead.h"
#include "../cases/case.h"
#include "../cases/chain.h"
#include "../cases/rows.h"
#include "../cases/table.h"
#include "../cases/walk.h"
#include "../store/journal.h"
#include "../store/reuse.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct execution {
    const study_run *run;
    ff_report *report;
    study_counters *counters;
    study_journal journal;
    bool open;           /* true once the journal is open */
    study_records *done; /* records of earlier runs, and of this run if cases form chains */
    char (*keys)[STUDY_KEY_SIZE];
    size_t room;                   /* number of keys allocated, for rows from standard input */
    study_pool pool;               /* without an executor: the workers of this process */
    study_fork_server fork_server; /* with an executor */
    size_t next;               /* next chain to distribute; a chain is one task of the executor */
    bool searched;             /* whether finished cases have been searched for */
    bool ending;               /* whether no more cases are distributed */
    bool no_memory;            /* whether memory ran out and the executor was told to end */
    double start, progress_at; /* times in s: of the start, and of the last progress report */
} execution;

static size_t end_of_chains(const study_run *run)
{
    return run->end ? run->end : study_chains(run->study);
}

/* If all cases are to run again, removes stored results of stages before the first case. */
static void begin_results(execution *r)
{
    study_setup_warn_rebuilt(r->run, r->done, r->report);
    if (r->run->shards == 1)
        study_remove_parts(r->journal.directory);
    if (r->run->rerun == STUDY_RERUN_ALL)
        study_reuse_clear(r->journal.directory);
}

/* Runs a function that an executor calls. If memory runs out, the function is aborted, and the
   executor is told to end. */
static bool protect(execution *r, void (*function)(void *ctx), void *ctx)
{
    bool done = ff_protected(function, ctx) == FF_OK;
    r->no_memory = r->no_memory || !done;
    r->ending = r->ending || !done;
    return done;
}

static void open_journal(void *ctx)
{
    execution *r = ctx;
    const study_run *run = r->run;
    size_t total = run->study->count, first = run->shard - 1;
    size_t chains = end_of_chains(run) - run->begin;
    study_signals_lead(true);
    r->counters->leads = true;
    r->counters->total = first < chains ? (chains - first - 1) / run->shards + 1 : 0;
    r->counters->total *= study_chain_length(run->study);
    r->open = study_journal_open(&r->journal, run->directory, run->shard, run->shards, r->report);
    if (r->open && ((run->enter && !run->enter(run->ctx, r->report)) ||
                    !study_describe(run, NULL, r->report))) {
        study_journal_close(&r->journal);
        r->open = false;
    }
    if (r->open) {
        r->done = study_records_open(run->directory, true);
        if (run->begin == 0)
            begin_results(r);
        r->keys = run->keys ? run->keys : memory_alloc(total * sizeof *r->keys);
        r->next = run->begin + first;
        r->start = r->progress_at = study_seconds_now();
    } else {
        r->counters->total = 0;
    }
}

static int32_t begin_leading(void *ctx)
{
    execution *r = ctx;
    return protect(r, open_journal, r) && r->open ? 0 : -1;
}

/* Takes the next row from standard input, if one has arrived. */
static void take_row(execution *r)
{
    const study_definition *study = r->run->study;
    if (study_rows_next(study->rows) > 0 && study->count > r->room) {
        size_t room = 2 * study->count;
        r->keys = memory_resize(r->keys, room * sizeof *r->keys);
        memset(r->keys + r->room, 0, (room - r->room) * sizeof *r->keys);
        r->room = room;
    }
    r->counters->total = study->count;
}

/* Returns whether the only case of a chain is already answered. */
static bool is_answered(const execution *r, size_t chain)
{
    return r->searched && r->keys[chain][0];
}

static int32_t next_chain(void *ctx, size_t *task)
{
    execution *r = ctx;
    while (r->open && r->next < end_of_chains(r->run) && is_answered(r, r->next))
        r->next += r->run->shards;
    if (r->open && !r->ending && study_signals_count() == 0 && r->run->study->streams)
        take_row(r);
    if (!r->open || r->ending || study_signals_count() > 0 || r->next >= end_of_chains(r->run))
        return 0;
    *task = r->next;
    r->next += r->run->shards;
    return 1;
}

/* Ends the process because a plugin's file was overwritten. The plugin's code must not be
 * touched any more, even for an error message, so the parent process reports it. */
static _Noreturn void end_written_over(execution *r, const char *path)
{
    char sentence[CRASH_SENTENCE];
    snprintf(sentence, sizeof sentence,
             "the plugin %.*s was overwritten while the study ran; earlier results are kept, and "
             "the same command continues with the new plugin",
             (int)strcspn(path, "\n"), path);
    study_pool_kill(&r->pool);
    if (r->run->executor)
        study_fork_server_end(&r->fork_server);
    crash_say(sentence, FF_FAULT_PLUGIN);
}

static void check_plugins(execution *r)
{
    const ff_loaded *over = ff_engine_written_over(r->run->engine);
    if (over)
        end_written_over(r, over->path);
}

/* Loads models that only a worker has used so far, so that their files are watched too. */
static void watch_models(const execution *r, const json_t *record)
{
    ff_report *unheard = ff_report_new();
    const char *stage;
    json_t *values;
    json_object_foreach(json_object_get(record, "parameters"), stage, values)
    {
        const char *id = json_string_value(json_object_get(values, "use"));
        if (id)
            ff_engine_model(r->run->engine, id, FF_NOWHERE, unheard);
    }
    ff_report_free(unheard);
}

/* Counts an answer and adds it to the journal. `text` is what follows the verdict. Returns false if
   no further cases are to run. */
static bool record_answer(execution *r, size_t index, const char *key, char verdict,
                          const char *text)
{
    bool good = verdict == STUDY_VERDICT_GOOD || verdict == STUDY_VERDICT_KNOWN;
    bool known = verdict == STUDY_VERDICT_KNOWN || verdict == STUDY_VERDICT_KNOWN_BAD;
    if (verdict == STUDY_VERDICT_FATAL)
        return ff_error(r->report, FF_FAULT_RUN, FF_NOWHERE,
                        "the same command continues with the rest", "%.*s",
                        (int)strcspn(text, "\n"), text);
    if (verdict == STUDY_VERDICT_WRITTEN_OVER)
        end_written_over(r, text);
    if (!good && !known) /* a good answer was checked by its worker */
        check_plugins(r);
    if (!known && !study_journal_append(&r->journal, text, strlen(text), r->report))
        return false;
    snprintf(r->keys[index], STUDY_KEY_SIZE, "%s", key);
    r->counters->before += known;
    r->counters->done++;
    bool told = r->run->answer != NULL;
    json_t *record = !known ? study_records_take(r->done, text, strlen(text))
                     : told ? study_records_get(r->done, key)
                            : NULL;
    watch_models(r, known ? NULL : record);
    study_judgement judgement;
    if (known)
        judgement = study_records_judge(r->done, key);
    else
        study_judgement_read(&judgement, record);
    bool excused = judgement.verdict == STUDY_CASE_REFUSED;
    r->counters->failed += !good && !excused;
    if (told)
        r->run->answer(r->run->ctx, index, record, known);
    study_savings_add(&r->counters->savings, known ? NULL : record);
    study_tally_add(&r->counters->tally, index + 1, key, &judgement);
    study_judgement_free(&judgement);
    json_decref(record);
    return known || good || excused || !r->run->fail_fast;
}

/* The arguments of wait_for_answer and note_answer. */
typedef struct answer_call {
    execution *r;
    const char *text;
    size_t size, task;
    int32_t milliseconds;
    int state;
} answer_call;

static void read_answer(void *ctx)
{
    const answer_call *call = ctx;
    execution *r = call->r;
    const char *text = call->text;
    char key[STUDY_KEY_SIZE], verdict;
    size_t index;
    int length = 0;
    bool whole = r->keys && call->size > 0 && text[call->size - 1] == '\0' &&
                 sscanf(text, "%zu %19s %c%n", &index, key, &verdict, &length) == 3 &&
                 index < r->run->study->count && text[length] == ' ';
    if (!whole)
        ff_error(r->report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL,
                 "the answer to a case cannot be read");
    if (!whole || !record_answer(r, index, key, verdict, text + length + 1))
        r->ending = true;
}

static void note_answer(void *ctx, const void *answer, size_t size)
{
    answer_call call = {.r = ctx, .text = answer, .size = size};
    protect(call.r, read_answer, &call);
}

static void start_chain(void *ctx, size_t task)
{
    execution *r = ctx;
    if (r->run->executor)
        study_fork_server_start_chain(&r->fork_server, task);
    else
        study_pool_start_chain(&r->pool, task);
}

static void show_progress(execution *r)
{
    r->counters->seconds = study_seconds_now() - r->start;
    if (!r->keys || !r->run->progress || r->start + r->counters->seconds - r->progress_at < 0.5)
        return;
    r->progress_at = r->start + r->counters->seconds;
    r->run->progress(r->run->ctx, r->counters);
}

/* Ends this process after a second signal, with all workers and the processes that they have
   started. */
static _Noreturn void end_at_once(execution *r)
{
    study_pool_kill(&r->pool);
    if (r->run->executor)
        study_fork_server_end(&r->fork_server);
    study_signals_raise();
    _exit(FF_FAULT_RUN);
}

static void take_answer(void *ctx)
{
    answer_call *call = ctx;
    execution *r = call->r;
    bool forked = r->run->executor != NULL;
    r->pool.ending = r->ending || study_signals_count() > 0;
    call->state = forked ? study_fork_server_wait(&r->fork_server, call->milliseconds, &call->task)
                         : study_pool_wait(&r->pool, call->milliseconds, &call->task);
    if (study_signals_count() > 1)
        end_at_once(r);
    if (call->state == FF_TASK_NONE)
        check_plugins(r); /* The code of an overwritten plugin may never return. */
    if (call->state > 0)
        call->text = forked ? r->fork_server.answer : r->pool.answer;
    show_progress(r);
}

static int32_t wait_for_answer(void *ctx, int32_t milliseconds, size_t *task, const void **answer,
                               size_t *size)
{
    answer_call call = {.r = ctx, .milliseconds = milliseconds, .state = FF_TASK_GONE};
    protect(call.r, take_answer, &call);
    *task = call.task;
    if (call.text) {
        *answer = call.text;
        *size = strlen(call.text) + 1;
    }
    return call.state;
}

static bool expects_row(const execution *r)
{
    const study_definition *study = r->run->study;
    return study->streams && !r->ending && study_signals_count() == 0 &&
           !study_rows_ended(study->rows);
}

/* Waits for a row. Returns false if there will be none. */
static bool await_row(const execution *r)
{
    if (!expects_row(r))
        return false;
    study_rows_wait();
    return true;
}

/* Answers all finished cases here, without passing each of them to a worker. */
static void answer_known(execution *r)
{
    /* below this number of cases, a separate process costs more than it saves */
    enum { FEW = 1000 };
    const study_run *run = r->run;
    study_search search = {.pid = 0};
    study_known known;
    if (study_records_count(r->done) < FEW || r->counters->total < FEW || run->study->streams ||
        run->study->measure || study_is_chained(run->study))
        return;
    study_walk walk = study_walk_begin(run, r->done);
    walk.chain = r->next;
    walk.end = end_of_chains(run);
    r->searched = study_search_start(&search, &walk, (int[]){r->journal.fd, r->journal.directory});
    while (r->searched && !r->ending && study_signals_count() == 0 &&
           study_search_next(&search, &known)) {
        bool good = study_records_state(r->done, known.key) == STUDY_OK;
        r->ending = !record_answer(r, known.index, known.key,
                                   good ? STUDY_VERDICT_KNOWN : STUDY_VERDICT_KNOWN_BAD, "");
        show_progress(r);
    }
    if (r->searched)
        study_search_end(&search);
    study_walk_end(&walk);
}

/* Runs all cases by workers of this process. */
static bool run_here(execution *r)
{
    size_t task, size, busy = 0;
    if (begin_leading(r) < 0)
        return false;
    answer_known(r);
    study_pool_open(&r->pool, r->run, r->done);
    r->pool.hidden[0] = r->journal.fd;
    r->pool.hidden[1] = r->journal.directory;
    r->pool.groups = true;
    for (;;) {
        const void *answer = NULL;
        for (; busy < r->run->jobs && next_chain(r, &task); busy++)
            start_chain(r, task);
        if (busy == 0 && r->pool.held_count == 0 && !await_row(r))
            break;
        r->pool.extra_fd = busy < r->run->jobs && expects_row(r) ? STUDY_ROWS_FD : -1;
        if (busy == 0 && r->pool.held_count == 0)
            continue;
        int state = wait_for_answer(r, 1000, &task, &answer, &size);
        if (answer)
            note_answer(r, answer, size);
        if (r->no_memory)
            memory_require(NULL);
        busy -= state == FF_TASK_OVER;
    }
    study_pool_close(&r->pool);
    return true;
}

typedef struct executor_call {
    const void *table;
    ff_tasks *tasks;
} executor_call;

static ff_status call_executor(void *ctx)
{
    const executor_call *call = ctx;
    const ff_executor *executor = call->table;
    return FF_HAS(executor, run) && executor->run ? executor->run(executor->self, call->tasks)
                                                  : FF_BUG;
}

/* Runs the cases with an executor. An error that was reported meanwhile is more specific than the
   executor's status. */
static bool run_elsewhere(execution *r, ff_tasks *tasks)
{
    ff_instance *executor = r->run->executor;
    executor_call call = {.tasks = tasks};
    size_t errors = ff_report_errors(r->report);
    ff_status status = ff_instance_service(executor, FF_EXECUTOR_ID, &call.table);
    if (status == FF_OK || status == FF_DOMAIN)
        status = ff_instance_call(executor, "run", call_executor, &call);
    if (r->no_memory)
        memory_require(NULL);
    bool good = status == FF_OK || status == FF_DOMAIN;
    if (ff_report_errors(r->report) > errors)
        return false;
    ff_report_append(r->report, ff_instance_report(executor));
    return good;
}

static bool run_cases(execution *r)
{
    ff_tasks tasks = {.size = sizeof tasks,
                      .ctx = r,
                      .slots = r->run->jobs,
                      .lead = begin_leading,
                      .next = next_chain,
                      .note = note_answer,
                      .give = start_chain,
                      .take = wait_for_answer};
    if (!r->run->executor)
        return run_here(r);
    bool good =
        study_fork_server_start(&r->fork_server, r->run)
            ? run_elsewhere(r, &tasks)
            : ff_error(r->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "no process could be started");
    study_fork_server_end(&r->fork_server);
    return good;
}

/* Builds the cases that did not run here to find their keys. The journals contain the cases of
   other shards under these keys. */
static void find_keys(execution *r)
{
    study_walk walk = study_walk_begin(r->run, r->done);
    const study_case *c;
    walk.chain = 0;
    walk.step = 1;
    walk.keys = r->keys;
    walk.kept.keys = false;
    while ((c = study_walk_next(&walk)))
        memcpy(r->keys[c->index], c->key, sizeof c->key);
    study_walk_end(&walk);
}

/* Ends the run in the leading process after all cases are answered. */
static void finish_run(execution *r)
{
    const study_run *run = r->run;
    check_plugins(r);
    if (run->progress)
        run->progress(run->ctx, r->counters);
    if (study_signals_count() > 0)
        ff_error(r->report, FF_FAULT_RUN, FF_NOWHERE, "the same command continues with the rest",
                 "the study was stopped");
    else if (r->counters->done < r->counters->total && !r->ending &&
             ff_report_errors(r->report) == 0)
        ff_error(r->report, FF_FAULT_PLUGIN, FF_NOWHERE, "the same command continues with the rest",
                 "the executor did not run %zu cases", r->counters->total - r->counters->done);
    if (run->study->streams && study_rows_are_cut(run->study->rows))
        ff_error(r->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                 "study: cases: row %zu of standard input is longer than 1 MiB",
                 run->study->count + 1);
    bool good = ff_report_errors(r->report) == 0 && study_journal_settle(&r->journal, r->report);
    study_records *rows = study_records_open(run->directory, true);
    good = study_recount(run, rows, r->keys, r->counters, r->report) && good;
    if (good && !run->end) {
        find_keys(r);
        study_table_write(run, r->keys, run->shards == 1 ? rows : NULL, r->report);
    }
    if (run->rows)
        *run->rows = rows;
    else
        study_records_close(rows);
    study_journal_close(&r->journal);
}

bool study_execute(const study_run *given, study_counters *counters, ff_report *report)
{
    study_run own = *given;
    const study_run *run = &own;
    execution r = {.run = run, .report = report, .counters = counters};
    *counters = (study_counters){.total = 0};
    ff_run *base = study_case_base(own.engine, own.file);
    own.base = base;
    run_cases(&r);
    study_signals_lead(false);
    if (r.open)
        finish_run(&r);
    study_records_close(r.done);
    if (!run->keys)
        free(r.keys);
    ff_run_close(base);
    return ff_report_errors(report) == 0;
}
