/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the finished cases of a large study in a separate process. */
#include "finished-cases.h"

#include "workers.h"

#include "../cases/chain.h"
#include "../cases/walk.h"
#include "../store/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Separates this process, so that output and changes by a plugin have no effect outside. */
static void isolate_process(void)
{
    int null = open("/dev/null", O_RDWR);
    setpgid(0, 0); /* one signal then also ends the processes that a plugin has started */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        dup2(null, fd);
}

static _Noreturn void search_cases(study_walk *walk, FILE *to)
{
    const study_run *run = walk->run;
    double limit = ceil(fmin(run->study->time_limit, 1e6));
    isolate_process();
    const ff_environment *environment = ff_environment_keep();
    for (bool more = true; more;) {
        if (limit > 0)
            alarm((unsigned)limit);
        ff_environment_restore(environment);
        const study_case *c = study_walk_next(walk);
        more = c != NULL;
        if (!c || !study_case_is_settled(c, walk->records, run->rerun))
            continue;
        study_known known = {.index = c->index};
        memcpy(known.key, c->key, sizeof c->key);
        more = fwrite(&known, sizeof known, 1, to) == 1;
    }
    fflush(to);
    _exit(0);
}

bool study_search_start(study_search *search, study_walk *walk, const int hidden[2])
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return false;
    fflush(NULL);
    search->pid = fork();
    bool child = search->pid == 0;
    close(ends[child ? 0 : 1]);
    FILE *stream = search->pid < 0 ? NULL : fdopen(ends[child], child ? "w" : "r");
    if (child) {
        close(hidden[0]);
        close(hidden[1]);
        study_records_close_files(walk->records);
    }
    if (child && stream)
        search_cases(walk, stream);
    if (child)
        _exit(0);
    search->from = stream;
    if (stream)
        return true;
    close(ends[0]);
    study_search_end(search);
    return false;
}

bool study_search_next(study_search *search, study_known *known)
{
    return fread(known, sizeof *known, 1, search->from) == 1;
}

void study_search_end(study_search *search)
{
    if (search->from)
        fclose(search->from);
    if (search->pid <= 0)
        return;
    kill(-search->pid, SIGKILL);
    kill(search->pid, SIGKILL);
    while (waitpid(search->pid, NULL, 0) < 0 && errno == EINTR)
        ;
}
