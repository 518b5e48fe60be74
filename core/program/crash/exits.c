/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "exits.h"

#include <dlfcn.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { MOST_ARGUMENTS = 4096 };

static void (*judge)(const char *function, const void *caller);
static long (*next_syscall)(long, ...); /* libc's; threads call it often */

static void find_syscall(void)
{
    if (!next_syscall)
        *(void **)(void *)&next_syscall = dlsym(RTLD_NEXT, "syscall");
}

void crash_exits_watch(void (*ask)(const char *function, const void *caller))
{
    find_syscall();
    judge = ask;
}

static void ask(const char *function, const void *caller)
{
    if (judge)
        judge(function, caller);
}

void crash_leave(int status)
{
    for (;;)
        next_syscall(SYS_exit_group, status);
}

/* libc's own definition. */
static void *next(const char *name)
{
    return dlsym(RTLD_NEXT, name);
}

static int run_path(const char *path, char *const argv[], char *const env[])
{
    int (*run)(const char *, char *const[], char *const[]);
    *(void **)(void *)&run = next("execve");
    return run(path, argv, env);
}

static int run_file(const char *file, char *const argv[], char *const env[])
{
    int (*run)(const char *, char *const[], char *const[]);
    *(void **)(void *)&run = next("execvpe");
    return run(file, argv, env);
}

/* The arguments of execl and its like as a list; what stands behind their NULL is left in `args`.
 */
static void list(const char *first, va_list *args, char *argv[MOST_ARGUMENTS])
{
    argv[0] = (char *)(uintptr_t)first;
    for (size_t n = 0; argv[n] && n + 1 < MOST_ARGUMENTS; n++)
        argv[n + 1] = n + 2 < MOST_ARGUMENTS ? va_arg(*args, char *) : NULL;
}

#pragma GCC visibility push(default)

void _exit(int status)
{
    ask("_exit()", __builtin_return_address(0));
    find_syscall();
    crash_leave(status);
}

void _Exit(int status)
{
    ask("_Exit()", __builtin_return_address(0));
    find_syscall();
    crash_leave(status);
}

/* As many arguments as a system call can have; those that were not given are not looked at. */
long syscall(long number, ...)
{
    long a[6];
    va_list args;
    va_start(args, number);
    for (int i = 0; i < 6; i++)
        a[i] = va_arg(args, long);
    va_end(args);
    if (number == SYS_exit_group || number == SYS_exit || number == SYS_execve ||
        number == SYS_execveat)
        ask("syscall()", __builtin_return_address(0));
    find_syscall();
    return next_syscall(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

int execve(const char *path, char *const argv[], char *const env[])
{
    ask("execve()", __builtin_return_address(0));
    return run_path(path, argv, env);
}

int execv(const char *path, char *const argv[])
{
    ask("execv()", __builtin_return_address(0));
    return run_path(path, argv, environ);
}

int execvpe(const char *file, char *const argv[], char *const env[])
{
    ask("execvpe()", __builtin_return_address(0));
    return run_file(file, argv, env);
}

int execvp(const char *file, char *const argv[])
{
    ask("execvp()", __builtin_return_address(0));
    return run_file(file, argv, environ);
}

int fexecve(int fd, char *const argv[], char *const env[])
{
    int (*run)(int, char *const[], char *const[]);
    ask("fexecve()", __builtin_return_address(0));
    *(void **)(void *)&run = next("fexecve");
    return run(fd, argv, env);
}

int execl(const char *path, const char *arg, ...)
{
    char *argv[MOST_ARGUMENTS];
    va_list args;
    ask("execl()", __builtin_return_address(0));
    va_start(args, arg);
    list(arg, &args, argv);
    va_end(args);
    return run_path(path, argv, environ);
}

int execlp(const char *file, const char *arg, ...)
{
    char *argv[MOST_ARGUMENTS];
    va_list args;
    ask("execlp()", __builtin_return_address(0));
    va_start(args, arg);
    list(arg, &args, argv);
    va_end(args);
    return run_file(file, argv, environ);
}

int execle(const char *path, const char *arg, ...)
{
    char *argv[MOST_ARGUMENTS];
    va_list args;
    ask("execle()", __builtin_return_address(0));
    va_start(args, arg);
    list(arg, &args, argv);
    char *const *env = va_arg(args, char *const *);
    va_end(args);
    return run_path(path, argv, env);
}

#pragma GCC visibility pop
