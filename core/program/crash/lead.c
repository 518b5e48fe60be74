/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lead.h"

#include "suspect.h"

#include <assert.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Memory shared by the two processes. */
typedef struct last_words {
    ff_guard_mirror running;
    pid_t child;
    bool over; /* whether the child has ended by itself */
    crash_end end;
} last_words;

static last_words *words; /* NULL if this process has no leading process */
static ff_guard_mirror own, *running = &own;

/* Used in the leading process: process id of the child, and the last signal that was forwarded. */
static volatile sig_atomic_t child, forwarded;

void crash_mark(ff_guard_mirror *mirror)
{
    assert(mirror);
    running = mirror;
    ff_guard_mirror_set(mirror);
}

const char *crash_running(void)
{
    return running->who;
}

static bool is_led(void)
{
    return words && words->child == getpid();
}

void crash_leave(int code)
{
    if (is_led()) {
        words->end.code = code;
        words->over = true;
    }
    _exit(code);
}

static void put(const char *text)
{
    if (write(STDERR_FILENO, text, strlen(text)) < 0)
        return; /* stderr is closed, so nothing can be done */
}

void crash_say(const char *sentence, int code)
{
    if (is_led()) {
        words->end.code = code;
        strncpy(words->end.sentence, sentence, sizeof words->end.sentence - 1);
    } else {
        put("error: ");
        put(sentence);
        put("\n");
    }
    _exit(code);
}

const char *crash_fault_name(int number)
{
    return number == SIGSEGV   ? "segmentation fault"
           : number == SIGBUS  ? "bus error"
           : number == SIGILL  ? "illegal processor instruction"
           : number == SIGABRT ? "abort"
           : number == SIGFPE  ? "arithmetic fault such as an integer division by zero"
                               : NULL;
}

bool crash_describe(const ff_guard_mirror *mark, int status, char *text, size_t size)
{
    int number = WIFSIGNALED(status) ? WTERMSIG(status) : WIFSTOPPED(status) ? WSTOPSIG(status) : 0;
    const char *who = mark->who, *action = mark->action;
    if (!*who)
        return false;
    if (number && crash_fault_name(number))
        snprintf(text, size, "%s crashed during %s: %s", who, action, crash_fault_name(number));
    else if (number)
        snprintf(text, size, "%s ended the program during %s: signal %d (%s)%s", who, action,
                 number, strsignal(number),
                 number == SIGKILL ? ", sent by its own code or by a system that is short of memory"
                                   : "");
    else
        snprintf(text, size, "%s ended the program during %s: exit code %d", who, action,
                 WEXITSTATUS(status));
    return true;
}

static long long now_ns(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * 1000000000LL + time.tv_nsec;
}

/* Returns whether a signal is a copy of one already counted. A signal sent to the group arrives
   twice, with any delay on a busy machine, and three times if its sender also addresses the leading
   process, as timeout(1) does. Several threads may receive the copies at once. */
bool crash_is_echo(const siginfo_t *info)
{
    enum { SIGNALS = 65 };
    static const long long pair = 1000000000LL, burst = 50000000LL; /* ns */
    static atomic_llong counted[SIGNALS], seen[SIGNALS];
    static atomic_int came_alone[SIGNALS]; /* signals that arrived here, minus those forwarded by
                                              the leading process */
    const int n = info->si_signo;
    if (info->si_code > 0 || n < 0 || n >= SIGNALS)
        return false;
    const long long now = now_ns();
    if (now - atomic_exchange(&seen[n], now) > pair)
        atomic_store(&came_alone[n], 0);
    bool handed = is_led() && info->si_pid == getppid();
    bool paired =
        handed ? atomic_fetch_sub(&came_alone[n], 1) > 0 : atomic_fetch_add(&came_alone[n], 1) < 0;
    long long last = atomic_load(&counted[n]);
    if (!paired && now - last < burst) {
        atomic_fetch_add(&came_alone[n], handed ? 1 : -1);
        return true;
    }
    return paired || !atomic_compare_exchange_strong(&counted[n], &last, now);
}

/* Forwards a signal to the child. A terminal signals the whole group by itself, and a signal that
   the child sends to its group does not come from the user. */
static void forward(int number, siginfo_t *info, void *context)
{
    int before = errno;
    (void)context;
    if (info->si_pid != (pid_t)child) {
        if (number != SIGCONT && number != SIGTSTP)
            forwarded = number;
        if (info->si_code <= 0 || getpgid((pid_t)child) != getpgrp())
            kill((pid_t)child, number);
        if (number == SIGTSTP)
            raise(SIGSTOP);
    }
    errno = before;
}

static void catch_signals(void)
{
    static const int handed[] = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,
                                 SIGUSR1, SIGUSR2, SIGCONT, SIGTSTP};
    struct sigaction action = {.sa_sigaction = forward, .sa_flags = SA_SIGINFO | SA_RESTART};
    struct sigaction before;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof handed / sizeof *handed; i++)
        if (sigaction(handed[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(handed[i], &action, NULL);
}

/* Returns true if a thread of the stopped child is in a call that sends SIGSTOP, or if the system
   does not provide this information. */
static bool has_stopped_itself(void)
{
    char path[300];
    bool itself = false, known = false;
    snprintf(path, sizeof path, "/proc/%d/task", (int)child);
    DIR *threads = opendir(path);
    const struct dirent *thread;
    while (threads && (thread = readdir(threads))) {
        long call = -1;
        unsigned long sent[3] = {0};
        snprintf(path, sizeof path, "/proc/%d/task/%s/syscall", (int)child, thread->d_name);
        FILE *stream = *thread->d_name == '.' ? NULL : fopen(path, "re");
        if (!stream)
            continue;
        if (fscanf(stream, "%ld %lx %lx %lx", &call, &sent[0], &sent[1], &sent[2]) > 0)
            known = true;
        fclose(stream);
        itself = itself || ((call == SYS_kill || call == SYS_tkill) && sent[1] == SIGSTOP) ||
                 (call == SYS_tgkill && sent[2] == SIGSTOP);
    }
    if (threads)
        closedir(threads);
    return itself || !known;
}

/* Returns true if the child remains stopped. A batch system stops all processes of a job and
   continues them one after the other. */
static bool stays_stopped(void)
{
    siginfo_t info;
    enum { LOOKS = 20, MILLISECONDS = 25 };
    for (int i = 0; i < LOOKS; i++) {
        poll(NULL, 0, MILLISECONDS);
        info.si_pid = 0;
        waitid(P_PID, (id_t)child, &info, WCONTINUED | WEXITED | WNOHANG | WNOWAIT);
        if (info.si_pid)
            return false;
    }
    return true;
}

/* Waits for the child and returns its status. If a plugin has stopped the child, the child is
   killed, and the status of the stop is returned. If the status is lost, returns the exit code that
   the child left in shared memory, or FF_FAULT_RUN. */
static int wait_for_child(void)
{
    assert(child > 0 && words);
    int status = 0, stopped = 0;
    for (;;) {
        if (waitpid((pid_t)child, &status, WUNTRACED) < 0) {
            if (errno != EINTR)
                return (words->over || words->end.sentence[0] ? words->end.code : FF_FAULT_RUN)
                       << 8;
        } else if (!WIFSTOPPED(status)) {
            return stopped ? stopped : status;
        } else if (WSTOPSIG(status) == SIGSTOP && words->running.who[0] && has_stopped_itself() &&
                   stays_stopped()) {
            stopped = status;
            kill((pid_t)child, SIGKILL);
        }
    }
}

/* Sets code and sentence for a child that ended with this status. */
static void judge(int status, crash_end *end)
{
    int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    *end = words->end;
    end->sentence[sizeof end->sentence - 1] = '\0';
    if (end->sentence[0] && !words->over && !number && WEXITSTATUS(status) == end->code)
        return;
    /* a plugin has overwritten the sentence */
    end->sentence[0] = '\0';
    end->code = number ? FF_FAULT_RUN : WEXITSTATUS(status); /* a sanitizer may have changed the
                                                                code */
    if (words->over && !number)
        return;
    if (!(number && (number == forwarded || number == SIGXCPU)) &&
        crash_describe(&words->running, status, end->sentence, sizeof end->sentence)) {
        end->code = FF_FAULT_PLUGIN;
        if (number && crash_fault_name(number))
            crash_add_suspect(end->sentence, sizeof end->sentence);
    } else if (number) {
        signal(number, SIG_DFL);
        raise(number);
    }
}

/* Returns true under a debugger, which follows only one process, or under valgrind, which counts
   each process separately. The file is read without stdio, since stdio's memory would be allocated
   before the fork and copied after it. */
static bool is_watched(void)
{
    char status[1024] = ""; /* large enough for the line, which is near the top of the file */
    const char *preloaded = getenv("LD_PRELOAD");
    int fd = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
    if (fd >= 0) {
        if (read(fd, status, sizeof status - 1) < 0)
            status[0] = '\0';
        close(fd);
    }
    const char *tracer = strstr(status, "\nTracerPid:");
    return (tracer && !strstr(tracer, "TracerPid:\t0\n")) ||
           (preloaded && strstr(preloaded, "vgpreload"));
}

/* Called in a process that the child forks: it has no leading process, and its record of the
   running plugin is its own. */
static void step_down(void)
{
    words = NULL;
    crash_mark(&own);
}

/* Gives the child the terminal's foreground group if it may read from a terminal, otherwise a group
   of its own, so that a signal from a plugin to its group ends no other process. */
static void follow(pid_t leader)
{
    words->child = getpid();
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != leader)
        _exit(FF_FAULT_RUN);
    if (!isatty(STDIN_FILENO)) {
        setpgid(0, 0);
        signal(SIGTTOU, SIG_IGN);
    }
    crash_mark(&words->running);
}

bool crash_lead(crash_end *end)
{
    sigset_t all, before;
    pid_t leader = getpid(), made = -1;
    crash_mark(&own);
    if (is_watched())
        return false;
    words = mmap(NULL, sizeof *words, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    words = words == MAP_FAILED ? NULL : words;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all,
                &before);     /* signals are blocked until there is a child to receive them */
    signal(SIGCHLD, SIG_DFL); /* if ignored, the child's status would be lost */
    if (words)
        made = fork();
    if (made == 0)
        follow(leader);
    if (made > 0) {
        child = made;
        catch_signals();
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (made > 0) {
        judge(wait_for_child(), end);
        return true;
    }
    words = made < 0 ? NULL : words;
    pthread_atfork(NULL, NULL, step_down);
    return false;
}
