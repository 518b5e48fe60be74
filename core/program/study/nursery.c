/* SPDX-License-Identifier: GPL-3.0-or-later */
/* On the pipe to it: numbers of cases. On the pipe from it: a note, then its answer. */
#include "private.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct note {
    size_t task, size;
    int state;
} note;

static bool get(int fd, void *data, size_t size)
{
    for (char *at = data; size > 0;) {
        ssize_t got = read(fd, at, size);
        if (got == 0 || (got < 0 && errno != EINTR))
            return false;
        at += got > 0 ? got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

static bool has_input(int fd, int milliseconds)
{
    struct pollfd polled = {.fd = fd, .events = POLLIN};
    return poll(&polled, 1, milliseconds) > 0;
}

/* The directory is there when the first case is: the leading process has made it. */
static void open_pool(study_pool *pool, const study_campaign *campaign, int from)
{
    study_pool_open(pool, campaign, study_journal_read(campaign->directory));
    pool->also = from;
}

static _Noreturn void nurse(const study_campaign *campaign, int from, int to)
{
    study_pool pool = {.workers = NULL};
    size_t task;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN); /* the run decides */
    signal(SIGUSR1, SIG_IGN);
    for (;;) {
        if (!pool.workers || has_input(from, 0)) {
            if (!get(from, &task, sizeof task))
                break;
            if (!pool.workers)
                open_pool(&pool, campaign, from);
            study_pool_give(&pool, task);
        }
        int state = study_pool_take(&pool, 1000, &task);
        if (state == FF_TASK_NONE)
            continue;
        note head = {.task = task, .size = strlen(pool.answer) + 1, .state = state};
        if (!study_put_all(to, &head, sizeof head) || !study_put_all(to, pool.answer, head.size))
            break;
    }
    _exit(0);
}

bool study_nursery_start(study_nursery *nursery, const study_campaign *campaign)
{
    int to[2], from[2];
    *nursery = (study_nursery){.to = -1, .from = -1};
    if (!study_open_pipes(to, from))
        return false;
    fflush(NULL);
    nursery->pid = fork();
    if (nursery->pid == 0) {
        close(to[1]);
        close(from[0]);
        nurse(campaign, to[0], from[1]);
    }
    close(to[0]);
    close(from[1]);
    nursery->to = to[1];
    nursery->from = from[0];
    return nursery->pid > 0;
}

void study_nursery_give(study_nursery *nursery, size_t chain)
{
    study_put_all(nursery->to, &chain,
                  sizeof chain); /* one that is gone is seen when it is listened to */
}

int study_nursery_take(study_nursery *nursery, int milliseconds, size_t *task)
{
    note head;
    if (!has_input(nursery->from, milliseconds))
        return FF_TASK_NONE;
    if (!get(nursery->from, &head, sizeof head))
        return FF_TASK_GONE;
    nursery->answer = fe_resize(nursery->answer, head.size);
    if (!get(nursery->from, nursery->answer, head.size))
        return FF_TASK_GONE;
    *task = head.task;
    return head.state;
}

void study_nursery_end(study_nursery *nursery)
{
    if (nursery->to >= 0)
        close(nursery->to);
    if (nursery->from >= 0)
        close(nursery->from);
    while (nursery->pid > 0 && waitpid(nursery->pid, NULL, 0) < 0 && errno == EINTR)
        ;
    free(nursery->answer);
}
