/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "meddling.h"

#include <dlfcn.h>
#include <signal.h>
#include <spawn.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

typedef enum call {
    ALARM,
    CLEARENV,
    CLOSE,
    DUP2,
    NICE,
    POPEN,
    POSIX_SPAWN,
    POSIX_SPAWNP,
    PRLIMIT,
    PTHREAD_SIGMASK,
    PUTENV,
    SETENV,
    SETITIMER,
    SETPGID,
    SETPRIORITY,
    SETRLIMIT,
    SETSID,
    SIGACTION,
    SIGALTSTACK,
    SIGNAL,
    SIGPROCMASK,
    SYSTEM,
    TIMER_CREATE,
    UMASK,
    UNSETENV,
    VFORK,
    KILL,
    KILLPG,
    PTHREAD_EXIT,
    PTHREAD_KILL,
    RAISE,
    CALLS,
} call;

static const char *const names[CALLS] = {
    "alarm",       "clearenv",    "close",        "dup2",         "nice",
    "popen",       "posix_spawn", "posix_spawnp", "prlimit",      "pthread_sigmask",
    "putenv",      "setenv",      "setitimer",    "setpgid",      "setpriority",
    "setrlimit",   "setsid",      "sigaction",    "sigaltstack",  "signal",
    "sigprocmask", "system",      "timer_create", "umask",        "unsetenv",
    "vfork",       "kill",        "killpg",       "pthread_exit", "pthread_kill",
    "raise"};

static void *libc[CALLS];
static void (*judge)(const char *function, const void *caller, bool ends);

static void *find(call which)
{
    if (!libc[which])
        libc[which] = dlsym(RTLD_NEXT, names[which]);
    return libc[which];
}

void crash_meddling_watch(void (*ask)(const char *function, const void *caller, bool ends))
{
    for (int i = 0; i < CALLS; i++)
        find((call)i); /* handlers of signals must not look for them */
    judge = ask;
}

/* The address of libc's definition, for a caller who may have it. */
static void *given_to(const void *caller, call which)
{
    if (judge)
        judge(names[which], caller, which >= KILL);
    return find(which);
}

#pragma GCC visibility push(default)

unsigned alarm(unsigned seconds)
{
    unsigned (*next)(unsigned);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), ALARM);
    return next(seconds);
}

int clearenv(void)
{
    int (*next)(void);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), CLEARENV);
    return next();
}

int close(int file)
{
    int (*next)(int);
    *(void **)(void *)&next =
        file > STDERR_FILENO ? find(CLOSE) : given_to(__builtin_return_address(0), CLOSE);
    return next(file);
}

int dup2(int file, int as)
{
    int (*next)(int, int);
    *(void **)(void *)&next =
        as > STDERR_FILENO ? find(DUP2) : given_to(__builtin_return_address(0), DUP2);
    return next(file, as);
}

int nice(int more)
{
    int (*next)(int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), NICE);
    return next(more);
}

FILE *popen(const char *command, const char *mode)
{
    FILE *(*next)(const char *, const char *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), POPEN);
    return next(command, mode);
}

int posix_spawn(pid_t *child, const char *path, const posix_spawn_file_actions_t *files,
                const posix_spawnattr_t *attributes, char *const argv[], char *const env[])
{
    int (*next)(pid_t *, const char *, const posix_spawn_file_actions_t *,
                const posix_spawnattr_t *, char *const[], char *const[]);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), POSIX_SPAWN);
    return next(child, path, files, attributes, argv, env);
}

int posix_spawnp(pid_t *child, const char *file, const posix_spawn_file_actions_t *files,
                 const posix_spawnattr_t *attributes, char *const argv[], char *const env[])
{
    int (*next)(pid_t *, const char *, const posix_spawn_file_actions_t *,
                const posix_spawnattr_t *, char *const[], char *const[]);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), POSIX_SPAWNP);
    return next(child, file, files, attributes, argv, env);
}

int pthread_sigmask(int how, const sigset_t *set, sigset_t *old)
{
    int (*next)(int, const sigset_t *, sigset_t *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), PTHREAD_SIGMASK);
    return next(how, set, old);
}

int putenv(char *variable)
{
    int (*next)(char *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), PUTENV);
    return next(variable);
}

int setenv(const char *name, const char *value, int replace)
{
    int (*next)(const char *, const char *, int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETENV);
    return next(name, value, replace);
}

int unsetenv(const char *name)
{
    int (*next)(const char *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), UNSETENV);
    return next(name);
}

int setitimer(__itimer_which_t which, const struct itimerval *timer, struct itimerval *old)
{
    int (*next)(__itimer_which_t, const struct itimerval *, struct itimerval *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETITIMER);
    return next(which, timer, old);
}

int timer_create(clockid_t clock, struct sigevent *event, timer_t *timer)
{
    int (*next)(clockid_t, struct sigevent *, timer_t *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), TIMER_CREATE);
    return next(clock, event, timer);
}

int setpgid(pid_t process, pid_t group)
{
    int (*next)(pid_t, pid_t);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETPGID);
    return next(process, group);
}

pid_t setsid(void)
{
    pid_t (*next)(void);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETSID);
    return next();
}

int setpriority(__priority_which_t which, id_t who, int priority)
{
    int (*next)(__priority_which_t, id_t, int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETPRIORITY);
    return next(which, who, priority);
}

int sigaction(int number, const struct sigaction *action, struct sigaction *old)
{
    int (*next)(int, const struct sigaction *, struct sigaction *);
    *(void **)(void *)&next =
        action ? given_to(__builtin_return_address(0), SIGACTION) : find(SIGACTION);
    return next(number, action, old);
}

int sigaltstack(const stack_t *stack, stack_t *old)
{
    int (*next)(const stack_t *, stack_t *);
    *(void **)(void *)&next =
        stack ? given_to(__builtin_return_address(0), SIGALTSTACK) : find(SIGALTSTACK);
    return next(stack, old);
}

__sighandler_t signal(int number, __sighandler_t handler)
{
    __sighandler_t (*next)(int, __sighandler_t);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SIGNAL);
    return next(number, handler);
}

int sigprocmask(int how, const sigset_t *set, sigset_t *old)
{
    int (*next)(int, const sigset_t *, sigset_t *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SIGPROCMASK);
    return next(how, set, old);
}

int system(const char *command)
{
    int (*next)(const char *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SYSTEM);
    return next(command);
}

mode_t umask(mode_t mask)
{
    mode_t (*next)(mode_t);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), UMASK);
    return next(mask);
}

/* It returns twice, so that it cannot be handed on from here; fork serves whoever calls it. */
pid_t vfork(void)
{
    given_to(__builtin_return_address(0), VFORK);
    return fork();
}

int kill(pid_t process, int number)
{
    int (*next)(pid_t, int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), KILL);
    return next(process, number);
}

int killpg(pid_t group, int number)
{
    int (*next)(pid_t, int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), KILLPG);
    return next(group, number);
}

int raise(int number)
{
    int (*next)(int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), RAISE);
    return next(number);
}

int pthread_kill(pthread_t thread, int number)
{
    int (*next)(pthread_t, int);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), PTHREAD_KILL);
    return next(thread, number);
}

_Noreturn void pthread_exit(void *answer)
{
    void (*next)(void *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), PTHREAD_EXIT);
    next(answer);
    abort(); /* it has not returned */
}

/* Headers give one of libc's two names to the other, so that both are spelt out here. */
int own_setrlimit(int which, const struct rlimit *limit) __asm__("setrlimit");
int own_setrlimit64(int which, const struct rlimit *limit) __asm__("setrlimit64");
int own_prlimit(pid_t process, int which, const struct rlimit *limit,
                struct rlimit *old) __asm__("prlimit");
int own_prlimit64(pid_t process, int which, const struct rlimit *limit,
                  struct rlimit *old) __asm__("prlimit64");

int own_setrlimit(int which, const struct rlimit *limit)
{
    int (*next)(int, const struct rlimit *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETRLIMIT);
    return next(which, limit);
}

int own_setrlimit64(int which, const struct rlimit *limit)
{
    int (*next)(int, const struct rlimit *);
    *(void **)(void *)&next = given_to(__builtin_return_address(0), SETRLIMIT);
    return next(which, limit);
}

int own_prlimit(pid_t process, int which, const struct rlimit *limit, struct rlimit *old)
{
    int (*next)(pid_t, int, const struct rlimit *, struct rlimit *);
    *(void **)(void *)&next =
        limit ? given_to(__builtin_return_address(0), PRLIMIT) : find(PRLIMIT);
    return next(process, which, limit, old);
}

int own_prlimit64(pid_t process, int which, const struct rlimit *limit, struct rlimit *old)
{
    int (*next)(pid_t, int, const struct rlimit *, struct rlimit *);
    *(void **)(void *)&next =
        limit ? given_to(__builtin_return_address(0), PRLIMIT) : find(PRLIMIT);
    return next(process, which, limit, old);
}

#pragma GCC visibility pop
