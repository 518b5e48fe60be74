/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the process that a model must not change, besides arithmetic and locale. */
#include "private.h"

#include "../study/store/hash.h"

#include <dirent.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static size_t count_threads(void)
{
    size_t count = 0;
    DIR *folder = opendir("/proc/self/task");
    for (const struct dirent *entry; folder && (entry = readdir(folder));)
        count += entry->d_name[0] != '.';
    if (folder)
        closedir(folder);
    return count;
}

/* Returns whether the process has timers made by timer_create. */
static bool has_timers(void)
{
    FILE *list = fopen("/proc/self/timers", "re");
    bool any = list && fgetc(list) != EOF;
    if (list)
        fclose(list);
    return any;
}

/* Hashes the texts "NAME=value" of the environment. */
static uint64_t hash_variables(void)
{
    uint64_t hash = STUDY_HASH_START;
    for (char *const *variable = environ; variable && *variable; variable++)
        hash = study_hash_text(hash, *variable);
    return hash;
}

/* Returns the memory of the largest child process that has ended, or -1 if a child still runs. A
   change shows that another child process was started. */
static long children(void)
{
    struct rusage usage;
    siginfo_t info;
    if (waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0)
        return -1;
    return getrusage(RUSAGE_CHILDREN, &usage) == 0 ? usage.ru_maxrss : 0;
}

void verify_process_look(verify_process *process)
{
    memset(process, 0, sizeof *process);
    for (int i = 1; i < VERIFY_SIGNALS; i++)
        sigaction(i, NULL, &process->signals[i]);
    sigprocmask(SIG_SETMASK, NULL, &process->blocked);
    sigaltstack(NULL, &process->stack);
    process->mask = umask(0);
    umask(process->mask);
    if (!getcwd(process->folder, sizeof process->folder))
        process->folder[0] = 0;
    for (int i = 0; i < 3; i++)
        fstat(i, &process->streams[i]); /* remains zero for a closed stream */
    for (int i = 0; i < VERIFY_LIMITS; i++)
        getrlimit((__rlimit_resource_t)i, &process->limits[i]);
    for (int i = 0; i < 3; i++)
        getitimer((__itimer_which_t)i, &process->timers[i]);
    process->variables = hash_variables();
    process->children = children();
    process->threads = count_threads();
    process->priority = getpriority(PRIO_PROCESS, 0);
    process->has_timers = has_timers();
}

/* Returns whether there are more threads than before. A joined thread may still be listed for a
   short time. */
static bool has_more_threads(const verify_process *was, const verify_process *is)
{
    const struct timespec moment = {.tv_nsec = 1000000};
    size_t now = is->threads;
    for (int i = 0; i < 100 && now > was->threads; i++) {
        nanosleep(&moment, NULL);
        now = count_threads();
    }
    return now > was->threads;
}

static const char *changed_signals(const verify_process *was, const verify_process *is)
{
    for (int i = 1; i < VERIFY_SIGNALS; i++) {
        if (was->signals[i].sa_handler != is->signals[i].sa_handler)
            return "changed a signal handler";
        if (sigismember(&was->blocked, i) != sigismember(&is->blocked, i))
            return "changed which signals are blocked";
    }
    if (was->stack.ss_sp != is->stack.ss_sp || was->stack.ss_flags != is->stack.ss_flags)
        return "changed the stack of the signal handlers";
    for (int i = 0; i < 3; i++)
        if ((is->timers[i].it_value.tv_sec || is->timers[i].it_value.tv_usec) &&
            !was->timers[i].it_value.tv_sec && !was->timers[i].it_value.tv_usec)
            return "set a timer that sends a signal";
    return NULL;
}

static const char *changed_streams(const verify_process *was, const verify_process *is)
{
    static const char *const changes[] = {"closed or replaced the standard input",
                                          "closed or replaced the standard output",
                                          "closed or replaced the standard error output"};
    for (int i = 0; i < 3; i++)
        if (was->streams[i].st_dev != is->streams[i].st_dev ||
            was->streams[i].st_ino != is->streams[i].st_ino)
            return changes[i];
    return NULL;
}

const char *verify_process_changed(const verify_process *was)
{
    verify_process is;
    verify_process_look(&is);
    const char *change = changed_signals(was, &is);
    change = change ? change : changed_streams(was, &is);
    if (change)
        return change;
    if (strcmp(was->folder, is.folder) != 0)
        return "changed the working directory";
    if (was->mask != is.mask)
        return "changed the permission mask of new files";
    for (int i = 0; i < VERIFY_LIMITS; i++)
        if (was->limits[i].rlim_cur != is.limits[i].rlim_cur ||
            was->limits[i].rlim_max != is.limits[i].rlim_max)
            return "changed a resource limit";
    if (was->priority != is.priority)
        return "changed the priority of the process";
    if (is.has_timers && !was->has_timers)
        return "set a timer that sends a signal";
    if (was->variables != is.variables)
        return "changed the environment variables";
    if (was->children != is.children)
        return "started another process";
    return has_more_threads(was, &is) ? "left a thread behind" : NULL;
}
