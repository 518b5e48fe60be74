/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pipe to the fork server carries numbers of chains; the pipe from it carries a header and
 * an answer for each case. */
#include "workers.h"

#include "../../memory/file.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct answer_head {
    size_t task, size;
    int state;
} answer_head;

static bool has_input(int fd, int milliseconds)
{
    struct pollfd polled = {.fd = fd, .events = POLLIN};
    return poll(&polled, 1, milliseconds) > 0;
}

/* Opens the pool at the first chain, after the leading process has made the directory. */
static void open_pool(study_pool *pool, const study_run *run, int from, int to)
{
    study_pool_open(pool, run, study_records_open(run->directory, true));
    pool->extra_fd = pool->hidden[0] = from;
    pool->hidden[1] = to;
}

static _Noreturn void serve(const study_run *run, int from, int to)
{
    study_pool pool = {.workers = NULL};
    size_t task;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN); /* the leading process decides when to end */
    signal(SIGUSR1, SIG_IGN);
    for (;;) {
        if (!pool.workers || has_input(from, 0)) {
            if (!file_read(from, &task, sizeof task, -1))
                break;
            if (!pool.workers)
                open_pool(&pool, run, from, to);
            study_pool_start_chain(&pool, task);
        }
        int state = study_pool_wait(&pool, 1000, &task);
        if (state == FF_TASK_NONE)
            continue;
        answer_head head = {.task = task, .size = strlen(pool.answer) + 1, .state = state};
        if (!file_write(to, &head, sizeof head, -1) || !file_write(to, pool.answer, head.size, -1))
            break;
    }
    study_pool_kill(&pool);
    _exit(0);
}

bool study_fork_server_start(study_fork_server *server, const study_run *run)
{
    int to[2], from[2];
    *server = (study_fork_server){.to = -1, .from = -1};
    if (!study_open_pipes(to, from))
        return false;
    fflush(NULL);
    server->pid = fork();
    if (server->pid == 0) {
        close(to[1]);
        close(from[0]);
        serve(run, to[0], from[1]);
    }
    close(to[0]);
    close(from[1]);
    server->to = to[1];
    server->from = from[0];
    return server->pid > 0;
}

void study_fork_server_start_chain(study_fork_server *server, size_t chain)
{
    /* If the fork server has ended, study_fork_server_wait will notice. */
    file_write(server->to, &chain, sizeof chain, -1);
}

int study_fork_server_wait(study_fork_server *server, int milliseconds, size_t *task)
{
    answer_head head;
    if (!has_input(server->from, milliseconds))
        return FF_TASK_NONE;
    if (!file_read(server->from, &head, sizeof head, -1))
        return FF_TASK_GONE;
    server->answer = memory_resize(server->answer, head.size);
    if (!file_read(server->from, server->answer, head.size, -1))
        return FF_TASK_GONE;
    *task = head.task;
    return head.state;
}

void study_fork_server_end(study_fork_server *server)
{
    if (server->to >= 0)
        close(server->to);
    if (server->from >= 0)
        close(server->from);
    while (server->pid > 0 && waitpid(server->pid, NULL, 0) < 0 && errno == EINTR)
        ;
    free(server->answer);
}
