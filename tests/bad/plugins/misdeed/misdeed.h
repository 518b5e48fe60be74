/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Things that no plugin may do. FLANKFILM_MISDEED says who does which in which function: "law eval
   crash". The file that includes this defines `role`, "law". */
#ifndef MISDEED_H
#define MISDEED_H

#undef NDEBUG /* its assertion fails in a release, too */
#include <assert.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <fenv.h>
#include <locale.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

/* What the compiler must not see through, and results that nobody asks for. */
static int *volatile nowhere;
static void *volatile somewhere;
static volatile int zero;
static volatile double real;

static void write_null(void)
{
    *nowhere = 1;
}

static void read_null(void)
{
    zero = *nowhere;
}

static void call_null(void)
{
    static void (*volatile nothing)(void);
    nothing();
}

static void write_wild(void)
{
    *(volatile int *)(uintptr_t)(0x123456789000u + (unsigned)zero) = 1;
}

static void write_constant(void)
{
    somewhere = (void *)(uintptr_t) "constant";
    *(volatile char *)somewhere = 1;
}

static void touch_beyond_file(void)
{
    int file = memfd_create("empty", MFD_CLOEXEC);
    volatile char *mapped = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    mapped[0] = 1;
}

static void run_illegal(void)
{
    __builtin_trap();
}

static void divide(void)
{
    zero = 7 / zero;
}

static void trap(void)
{
    feenableexcept(FE_DIVBYZERO);
    real = 1 / real;
}

/* What C++ does with an exception that nobody catches. */
static void complain(void)
{
    fputs("terminate called after throwing\n  what(): vector\n", stderr);
    abort();
}

static void fail_assertion(void)
{
    assert(zero);
}

static void free_twice(void)
{
    somewhere = malloc(40000);
    void *same = somewhere;
    free(somewhere);
    free(same);
}

static void free_inside(void)
{
    somewhere = malloc(100);
    somewhere = (char *)somewhere + 8;
    free(somewhere);
}

static int overflow(volatile int depth)
{
    volatile char room[4096] = {0};
    return depth < 0 ? room[0] : overflow(depth + 1) + room[depth % 4096];
}

static void overflow_stack(void)
{
    zero = overflow(1);
}

static void call_exit(void)
{
    exit(0);
}

static void call_quick_exit(void)
{
    quick_exit(0);
}

static void call_underscore_exit(void)
{
    _exit(0);
}

static void call_exit_of_c99(void)
{
    _Exit(0);
}

static void call_exit_group(void)
{
    zero = (int)syscall(SYS_exit_group, 0);
}

static void call_execl(void)
{
    zero = execl("/bin/true", "true", (char *)NULL);
}

static void call_execvp(void)
{
    zero = execvp("true", (char *[]){"true", NULL});
}

static void call_execve(void)
{
    zero = execve("/bin/true", (char *[]){"true", NULL}, (char *[]){NULL});
}

/* Of the thread alone, which is all of the program when no library has made one. */
static void call_exit_by_number(void)
{
    zero = (int)syscall(SYS_exit, 0);
}

static void call_exec_by_number(void)
{
    zero = (int)syscall(SYS_execve, "/bin/true", (char *[]){"true", NULL}, (char *[]){NULL});
}

static void call_execat_by_number(void)
{
    zero = (int)syscall(SYS_execveat, AT_FDCWD, "/bin/true", (char *[]){"true", NULL},
                        (char *[]){NULL}, 0);
}

/* A thousand numbers over the frames of those who called. */
__attribute__((noinline)) static void smash_stack(void)
{
    volatile double room[1];
    for (int i = 0; i < 1000; i++)
        *(volatile double *)((uintptr_t)room + 8 * (uintptr_t)(i + zero)) = 1e300;
}

static jmp_buf gone;

__attribute__((noinline)) static void mark_frame(void)
{
    volatile double room[64] = {0};
    zero = setjmp(gone) + (int)room[zero];
}

__attribute__((noinline)) static void mark_deeper(void)
{
    volatile double room[64] = {0};
    mark_frame();
    zero = (int)room[zero];
}

__attribute__((noinline)) static void cover_frame(void)
{
    volatile double room[256];
    for (int i = 0; i < 256; i++)
        room[i] = 1e300;
    zero = room[zero] < 0;
}

/* To a frame that is gone, where another one has been since. */
static void jump_back(void)
{
    mark_deeper();
    cover_frame();
    longjmp(gone, 1);
}

/* As often as it takes until its own code is gone. */
static void unload_itself(void)
{
    Dl_info here;
    dladdr((void *)(uintptr_t)unload_itself, &here);
    void *object = dlopen(here.dli_fname, RTLD_NOW | RTLD_NOLOAD);
    for (int i = 0; object && i < 100; i++)
        dlclose(object);
}

static void exit_thread(void)
{
    pthread_exit(NULL);
}

static void in_thread(void *(*work)(void *nothing))
{
    pthread_t thread;
    if (pthread_create(&thread, NULL, work, NULL) == 0)
        pthread_join(thread, NULL);
}

static void *write_null_there(void *nothing)
{
    *nowhere = 1;
    return nothing;
}

static void *abort_there(void *nothing)
{
    abort();
    return nothing;
}

static void crash_in_thread(void)
{
    in_thread(write_null_there);
}

static void abort_in_thread(void)
{
    in_thread(abort_there);
}

static void call_fork(void)
{
    zero = fork();
}

static void call_vfork(void)
{
    if (vfork() == 0)
        _exit(0);
}

static void call_system(void)
{
    zero = system("true");
}

static void call_popen(void)
{
    somewhere = popen("true", "r");
}

static void call_spawn(void)
{
    pid_t child;
    zero = posix_spawn(&child, "/bin/true", NULL, NULL, (char *[]){"true", NULL}, (char *[]){NULL});
}

static void raise_term(void)
{
    raise(SIGTERM);
}

static void kill_itself(void)
{
    kill(getpid(), SIGKILL);
}

static void stop_itself(void)
{
    kill(getpid(), SIGSTOP);
}

static void kill_group(void)
{
    killpg(0, SIGUSR1);
}

static void kill_thread(void)
{
    pthread_kill(pthread_self(), SIGUSR2);
}

static void round_up(void)
{
    fesetround(FE_UPWARD);
}

static void flush_to_zero(void)
{
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
}

static void set_locale(void)
{
    setlocale(LC_ALL, "C.UTF-8");
}

static void change_folder(void)
{
    zero = chdir("/");
}

static void set_umask(void)
{
    umask(0177);
}

static void ignore_term(void)
{
    signal(SIGTERM, SIG_IGN);
}

static void set_action(void)
{
    sigaction(SIGINT, &(struct sigaction){.sa_handler = SIG_IGN}, NULL);
}

static void block_signals(void)
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, NULL);
}

static void block_process(void)
{
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, NULL);
}

static void take_stack(void)
{
    sigaltstack(&(stack_t){.ss_flags = SS_DISABLE}, NULL);
}

static void limit_files(void)
{
    setrlimit(RLIMIT_NOFILE, &(struct rlimit){64, 64});
}

static void limit_stack(void)
{
    prlimit(0, RLIMIT_STACK, &(struct rlimit){1 << 20, 1 << 20}, NULL);
}

static void be_nice(void)
{
    zero = nice(1);
}

static void lower_priority(void)
{
    setpriority(PRIO_PROCESS, 0, 1);
}

static void set_variable(void)
{
    setenv("MISDEED_WAS_HERE", "1", 1);
}

static void put_variable(void)
{
    static char variable[] = "MISDEED_WAS_HERE=1";
    putenv(variable);
}

static void unset_variable(void)
{
    unsetenv("PATH");
}

static void clear_variables(void)
{
    clearenv();
}

static void close_output(void)
{
    close(STDOUT_FILENO);
}

static void close_input(void)
{
    close(STDIN_FILENO);
}

static void redirect(void)
{
    zero = dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
}

static void set_alarm(void)
{
    alarm(1000);
}

static void set_timer(void)
{
    setitimer(ITIMER_PROF, &(struct itimerval){.it_value = {.tv_sec = 1000}}, NULL);
}

static void make_timer(void)
{
    timer_t timer;
    timer_create(CLOCK_MONOTONIC, NULL, &timer);
}

static void leave_session(void)
{
    setsid();
}

static void leave_group(void)
{
    setpgid(0, 0);
}

static void print(void)
{
    puts("here I am");
}

static void write_output(void)
{
    zero = (int)write(STDOUT_FILENO, "here I am\n", 10);
}

static void *wait_for_ever(void *nothing)
{
    for (;;)
        pause();
    return nothing;
}

static void leave_thread(void)
{
    pthread_t thread;
    zero = pthread_create(&thread, NULL, wait_for_ever, NULL);
}

static void loop(void)
{
    while (!zero)
        ;
}

static void hoard(void)
{
    for (size_t size = (size_t)1 << 24; (somewhere = malloc(size)) != NULL;)
        memset(somewhere, 1, size);
    abort();
}

static void overflow_without_stack(void)
{
    take_stack();
    overflow_stack();
}

static const struct {
    const char *name;
    void (*commit)(void);
} misdeeds[] = {
    {"crash", write_null},
    {"read-null", read_null},
    {"null-call", call_null},
    {"wild", write_wild},
    {"constant", write_constant},
    {"bus", touch_beyond_file},
    {"illegal", run_illegal},
    {"divide", divide},
    {"trap", trap},
    {"abort", abort},
    {"complain", complain},
    {"assert", fail_assertion},
    {"free-twice", free_twice},
    {"free-inside", free_inside},
    {"overflow", overflow_stack},
    {"exit", call_exit},
    {"quick-exit", call_quick_exit},
    {"_exit", call_underscore_exit},
    {"_Exit", call_exit_of_c99},
    {"exit-group", call_exit_group},
    {"execl", call_execl},
    {"execvp", call_execvp},
    {"execve", call_execve},
    {"exit-thread", call_exit_by_number},
    {"raw-exec", call_exec_by_number},
    {"raw-execat", call_execat_by_number},
    {"smash", smash_stack},
    {"stale-jump", jump_back},
    {"unload", unload_itself},
    {"thread-exit", exit_thread},
    {"thread-crash", crash_in_thread},
    {"thread-abort", abort_in_thread},
    {"fork", call_fork},
    {"vfork", call_vfork},
    {"child", call_system},
    {"popen", call_popen},
    {"spawn", call_spawn},
    {"raise", raise_term},
    {"kill", kill_itself},
    {"stop", stop_itself},
    {"killpg", kill_group},
    {"thread-kill", kill_thread},
    {"rounding", round_up},
    {"flush", flush_to_zero},
    {"locale", set_locale},
    {"folder", change_folder},
    {"umask", set_umask},
    {"handler", ignore_term},
    {"action", set_action},
    {"mask", block_signals},
    {"process-mask", block_process},
    {"stack", take_stack},
    {"limit", limit_files},
    {"stack-limit", limit_stack},
    {"nice", be_nice},
    {"priority", lower_priority},
    {"variable", set_variable},
    {"put-variable", put_variable},
    {"unset-variable", unset_variable},
    {"clear", clear_variables},
    {"close", close_output},
    {"close-input", close_input},
    {"redirect", redirect},
    {"timer", set_alarm},
    {"interval", set_timer},
    {"new-timer", make_timer},
    {"session", leave_session},
    {"group", leave_group},
    {"print", print},
    {"write", write_output},
    {"thread", leave_thread},
    {"loop", loop},
    {"hoard", hoard},
    {"bare-overflow", overflow_without_stack},
};

/* Once in a process, which is enough. */
static void misbehave(const char *where)
{
    static int done;
    const char *misdeed = getenv("FLANKFILM_MISDEED");
    char begin[64];
    size_t length = (size_t)snprintf(begin, sizeof begin, "%s %s ", role, where);
    if (!misdeed || strncmp(misdeed, begin, length) != 0 || done++)
        return;
    for (size_t i = 0; i < sizeof misdeeds / sizeof misdeeds[0]; i++)
        if (!strcmp(&misdeed[length], misdeeds[i].name)) {
            misdeeds[i].commit();
            return;
        }
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
