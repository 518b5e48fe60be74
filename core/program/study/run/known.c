/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "known.h"

#include "workers.h"

#include "../cases/case.h"
#include "../store/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* What a plugin says or leaves changed here stays here. */
static void set_apart(void)
{
    int null = open("/dev/null", O_RDWR);
    setpgid(0, 0); /* what a plugin starts is ended with it */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        dup2(null, fd);
}

static _Noreturn void search_cases(const study_run *run, const study_records *done, size_t first,
                                   size_t end, FILE *to)
{
    study_kept kept = {.keys = true};
    double limit = ceil(fmin(run->study->time_limit, 1e6));
    set_apart();
    const ff_environment *environment = ff_environment_keep();
    for (size_t i = first; i < end; i += run->shards) {
        study_case c;
        study_known known = {.index = i};
        if (limit > 0)
            alarm((unsigned)limit);
        ff_environment_restore(environment);
        study_case_open(&c, run, i, &kept);
        memcpy(known.key, c.key, sizeof c.key);
        bool sent = !study_state_is_settled(study_records_state(done, c.key), run->rerun) ||
                    fwrite(&known, sizeof known, 1, to) == 1;
        study_case_close(&c);
        if (!sent)
            break;
    }
    fflush(to);
    _exit(0);
}

bool study_search_start(study_search *search, const study_run *run, study_records *done,
                        const int hidden[2], size_t first, size_t end)
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
        study_records_let_go(done);
    }
    if (child && stream)
        search_cases(run, done, first, end, stream);
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
