/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Things that no plugin may do. FLANKFILM_MISDEED says who does which in which function: "law eval
   crash". The file that includes this defines `role`, "law". */
#ifndef MISDEED_H
#define MISDEED_H

#include <fcntl.h>
#include <fenv.h>
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static int overflow(volatile int depth)
{
    volatile char room[4096] = {0};
    return depth < 0 ? room[0] : overflow(depth + 1) + room[depth % 4096];
}

/* Ends of the program. */
static void end(const char *what)
{
    static int *volatile nowhere;
    static void (*volatile nothing)(void);
    static volatile int zero;
    static volatile double real;
    if (!strcmp(what, "crash"))
        *nowhere = 1;
    if (!strcmp(what, "null-call"))
        nothing();
    if (!strcmp(what, "abort"))
        abort();
    if (!strcmp(what, "complain")) {
        fputs("terminate called after throwing\n  what(): vector\n", stderr);
        abort();
    }
    if (!strcmp(what, "divide"))
        zero = 7 / zero;
    if (!strcmp(what, "overflow"))
        zero = overflow(1);
    if (!strcmp(what, "trap")) {
        feenableexcept(FE_DIVBYZERO);
        real = 1 / real;
    }
    if (!strcmp(what, "exit"))
        exit(0);
    if (!strcmp(what, "quick-exit"))
        quick_exit(0);
    if (!strcmp(what, "_exit"))
        _exit(0);
    if (!strcmp(what, "_Exit"))
        _Exit(0);
    if (!strcmp(what, "exit-group"))
        zero = (int)syscall(SYS_exit_group, 0);
    if (!strcmp(what, "execl"))
        zero = execl("/bin/true", "true", (char *)NULL);
    if (!strcmp(what, "execvp"))
        zero = execvp("true", (char *[]){"true", NULL});
    if (!strcmp(what, "thread-exit"))
        pthread_exit(NULL);
    if (!strcmp(what, "fork"))
        zero = fork();
}

static void *wait_for_ever(void *nothing)
{
    for (;;)
        pause();
    return nothing;
}

static volatile int result; /* of calls that nobody asks for theirs */

/* Changes of what the whole process has. */
static void change(const char *what)
{
    sigset_t all;
    pthread_t thread;
    struct rlimit limit = {64, 64};
    sigfillset(&all);
    if (!strcmp(what, "rounding"))
        fesetround(FE_UPWARD);
    if (!strcmp(what, "flush"))
        __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
    if (!strcmp(what, "locale"))
        setlocale(LC_ALL, "C.UTF-8");
    if (!strcmp(what, "folder"))
        result = chdir("/");
    if (!strcmp(what, "umask"))
        umask(0177);
    if (!strcmp(what, "handler"))
        signal(SIGTERM, SIG_IGN);
    if (!strcmp(what, "mask"))
        pthread_sigmask(SIG_BLOCK, &all, NULL);
    if (!strcmp(what, "stack"))
        sigaltstack(&(stack_t){.ss_flags = SS_DISABLE}, NULL);
    if (!strcmp(what, "close"))
        close(STDOUT_FILENO);
    if (!strcmp(what, "redirect"))
        result = dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    if (!strcmp(what, "limit"))
        setrlimit(RLIMIT_NOFILE, &limit);
    if (!strcmp(what, "variable"))
        setenv("MISDEED_WAS_HERE", "1", 1);
    if (!strcmp(what, "clear"))
        clearenv();
    if (!strcmp(what, "timer"))
        alarm(1000);
    if (!strcmp(what, "child"))
        result = system("true");
    if (!strcmp(what, "thread"))
        result = pthread_create(&thread, NULL, wait_for_ever, NULL);
    if (!strcmp(what, "print"))
        puts("here I am");
    if (!strcmp(what, "write"))
        result = (int)write(STDOUT_FILENO, "here I am\n", 10);
}

/* Once in a process, which is enough. */
static void misbehave(const char *where)
{
    static int done;
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    char begin[64];
    size_t length = (size_t)snprintf(begin, sizeof begin, "%s %s ", role, where);
    if (!misdeed || strncmp(misdeed, begin, length) != 0)
        return;
    if (done++)
        return;
    end(&misdeed[length]);
    change(&misdeed[length]);
}

__attribute__((constructor)) static void begin_object(void)
{
    misbehave("constructor");
}

__attribute__((destructor)) static void end_object(void)
{
    misbehave("destructor");
}

#endif
