/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run of a study: hands cases to workers, writes down what they answer. */
#include "private.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct run {
    const ff_campaign *campaign;
    ff_report *report;
    ff_tally *tally;
    ff_journal journal;
    int directory;
    json_t *done; /* records of earlier runs */
    char (*keys)[FF_KEY_SIZE];
    ff_worker *workers;
    size_t next; /* chain to hand out */
    bool ending; /* no more cases are handed out */
} run;

static volatile sig_atomic_t interrupts;

static void on_interrupt(int number)
{
    static const char text[] = "\nfinishing the cases at hand; once more to end at once\n";
    (void)number;
    interrupts = 1;
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0)
        return; /* nobody is there to read it */
}

static void count(run *r, size_t index, const char *key, bool good, bool fresh)
{
    memcpy(r->keys[index], key, FF_KEY_SIZE);
    r->tally->done++;
    r->tally->failed += !good;
    r->ending = r->ending || (fresh && !good && r->campaign->fail_fast);
}

static bool note(run *r, size_t index, const char *key, const json_t *record)
{
    char *line = ff_journal_line(record);
    bool written = ff_journal_append(&r->journal, line, strlen(line), r->report);
    free(line);
    if (written)
        count(r, index, key, false, true);
    return written;
}

/* The worker is gone, or was ended since it took too long. */
static bool lament(run *r, ff_worker *worker, const char *status, char *reason)
{
    bool noted = true;
    if (worker->busy) {
        char key[FF_KEY_SIZE];
        memcpy(key, worker->key, sizeof key);
        key[FF_KEY_SIZE - 1] = '\0';
        if (!key[0]) /* it died while the case was built */
            snprintf(key, sizeof key, "case-%zu", worker->index + 1);
        json_t *record = ff_case_record(r->campaign, worker->index, key, status, reason);
        noted = note(r, worker->index, key, record);
        json_decref(record);
    }
    free(reason);
    worker->busy = false;
    return noted;
}

static bool hear(run *r, ff_worker *worker)
{
    int state = ff_worker_read(worker);
    if (state < 0)
        return lament(r, worker, "crashed", ff_worker_bury(worker));
    if (state == 0)
        return true;
    worker->busy = false;
    if (worker->line[0] == '!') {
        worker->line[worker->length - 1] = '\0';
        return ff_error(r->report, FF_EXIT_FAILED, FF_NOWHERE,
                        "nothing that was finished is lost; the same command goes on", "%s",
                        worker->line + 1);
    }
    if (worker->line[0] == '=') {
        r->tally->before++;
        count(r, worker->index, worker->key, ff_record_is_ok(json_object_get(r->done, worker->key)),
              false);
        return true;
    }
    if (!ff_journal_append(&r->journal, worker->line, worker->length, r->report))
        return false;
    json_t *record = json_loadb(worker->line, worker->length, 0, NULL);
    ff_savings_add(&r->tally->savings, record);
    count(r, worker->index, worker->key, ff_record_is_ok(record), true);
    if (ff_study_chain_length(r->campaign->study) > 1) /* another worker may have to go on */
        json_object_set(r->done, worker->key, record);
    json_decref(record);
    return true;
}

/* Ends a worker whose case takes too long. */
static bool check_time(run *r, ff_worker *worker)
{
    double limit = r->campaign->study->time_limit;
    if (!worker->busy || !(limit > 0) || ff_seconds_now() - worker->since < limit)
        return true;
    kill(worker->pid, SIGKILL);
    free(ff_worker_bury(worker));
    return lament(r, worker, "time limit",
                  ff_print_text("the case took longer than its limit of %.6g s", limit));
}

/* The next case of the worker's chain, or the first one of the next chain. */
static size_t next_case(run *r, ff_worker *worker)
{
    const ff_study *study = r->campaign->study;
    size_t length = ff_study_chain_length(study);
    if (worker->left == 0) {
        worker->chain = r->next;
        worker->left = length;
        r->next += r->campaign->shards;
    }
    return ff_study_chained(study, worker->chain, length - worker->left--);
}

/* Keeps every worker busy that can be; the number of them that are. */
static size_t hand_out(run *r)
{
    const ff_campaign *campaign = r->campaign;
    size_t busy = 0;
    for (size_t i = 0; i < campaign->jobs; i++) {
        ff_worker *worker = &r->workers[i];
        bool more = worker->left > 0 || r->next < ff_study_chains(campaign->study);
        more = more && !r->ending && !interrupts;
        if (!worker->busy && more) {
            if (worker->pid == 0 && !ff_worker_start(worker, campaign, r->directory, r->done,
                                                     r->workers, campaign->jobs)) {
                r->ending = true;
                ff_error(r->report, FF_EXIT_FAILED, FF_NOWHERE, NULL,
                         "a worker process could not be started: %s", strerror(errno));
                continue;
            }
            ff_worker_give(worker,
                           next_case(r, worker)); /* one that just died is seen to be gone */
        }
        busy += worker->busy;
    }
    return busy;
}

static void wait_for_answers(run *r)
{
    const ff_campaign *campaign = r->campaign;
    struct pollfd *polled = ff_alloc(campaign->jobs * sizeof *polled);
    bool good = true;
    for (size_t i = 0; i < campaign->jobs; i++)
        polled[i] =
            (struct pollfd){.fd = r->workers[i].pid ? r->workers[i].from : -1, .events = POLLIN};
    double limit = campaign->study->time_limit;
    if (poll(polled, campaign->jobs, limit > 0 && limit < 1 ? 1 + (int)(limit * 200) : 200) < 0)
        memset(polled, 0, campaign->jobs * sizeof *polled);
    for (size_t i = 0; i < campaign->jobs; i++) {
        if (polled[i].revents)
            good = hear(r, &r->workers[i]) && good;
        if (r->workers[i].pid)
            good = check_time(r, &r->workers[i]) && good;
    }
    r->ending = r->ending || !good;
    free(polled);
}

static void run_cases(run *r)
{
    const ff_campaign *campaign = r->campaign;
    double start = ff_seconds_now(), told = start;
    r->workers = ff_alloc(campaign->jobs * sizeof *r->workers);
    r->next = campaign->shard - 1;
    while (hand_out(r) > 0) {
        wait_for_answers(r);
        r->tally->seconds = ff_seconds_now() - start;
        if (campaign->progress && start + r->tally->seconds - told >= 0.5) {
            told = start + r->tally->seconds;
            campaign->progress(campaign->ctx, r->tally);
        }
    }
    for (size_t i = 0; i < campaign->jobs; i++) {
        if (r->workers[i].pid) {
            close(r->workers[i].to);
            r->workers[i].to = -1;
            free(ff_worker_bury(&r->workers[i]));
        }
        free(r->workers[i].line);
    }
    free(r->workers);
}

/* The journal knows cases of other shards by their keys, which only their building tells. */
static void find_keys(run *r)
{
    const ff_campaign *campaign = r->campaign;
    ff_chain chain = {0};
    size_t length = ff_study_chain_length(campaign->study);
    for (size_t i = 0; i < campaign->study->count; i++) {
        size_t index = ff_study_chained(campaign->study, i / length, i % length);
        ff_case c;
        if (i % length == 0)
            ff_chain_begin(&chain, i / length);
        if (!r->keys[index][0]) {
            ff_case_open(&c, campaign, index);
            ff_chain_enter(&chain, campaign->study, &c);
            memcpy(r->keys[index], c.key, sizeof c.key);
            ff_case_close(&c);
        }
        memcpy(chain.key, r->keys[index], sizeof chain.key);
    }
    ff_chain_free(&chain);
}

static void begin(struct sigaction before[2])
{
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    interrupts = 0;
    sigaction(SIGINT, &action, &before[0]);
    sigaction(SIGTERM, &action, &before[1]);
}

bool ff_study_run(const ff_campaign *campaign, ff_tally *tally, ff_report *report)
{
    run r = {.campaign = campaign, .report = report, .tally = tally};
    size_t total = campaign->study->count, first = campaign->shard - 1;
    size_t chains = ff_study_chains(campaign->study);
    struct sigaction before[2];
    *tally = (ff_tally){.total = first < chains ? (chains - first - 1) / campaign->shards + 1 : 0};
    tally->total *= ff_study_chain_length(campaign->study);
    r.directory = ff_journal_open(&r.journal, campaign, report);
    if (r.directory < 0)
        return false;
    r.done = ff_journal_read(r.directory);
    r.keys = ff_alloc(total * sizeof *r.keys);
    begin(before);
    run_cases(&r);
    sigaction(SIGINT, &before[0], NULL);
    sigaction(SIGTERM, &before[1], NULL);
    if (campaign->progress)
        campaign->progress(campaign->ctx, tally);
    if (interrupts)
        ff_error(report, FF_EXIT_FAILED, FF_NOWHERE, "the same command goes on with the rest",
                 "the study was stopped");
    if (ff_report_errors(report) == 0) {
        find_keys(&r);
        ff_table_write(campaign, r.directory, r.keys, report);
    }
    ff_journal_close(&r.journal);
    close(r.directory);
    json_decref(r.done);
    free(r.keys);
    return ff_report_errors(report) == 0;
}
