/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "crash.h"

#include "blame.h"
#include "lead.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

static const char crashed[] = " crashed during ", ended[] = " ended the program during ",
                  broke[] = " broke the rules during ";

enum { FAULTS = 5 };
static const int fault_signals[FAULTS] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/* The pointer is resolved at program start. If the dynamic linker faults while it loads a damaged
   file, resolving it then would fault again. */
static ff_guard_mark (*volatile const guard_bound)(void) = ff_guard_current;

/* A sentence that is built by functions a signal handler may call. */
typedef struct line {
    char text[CRASH_SENTENCE];
    size_t length;
} line;

static void add(line *l, const char *text)
{
    for (; *text && l->length + 1 < sizeof l->text; text++)
        l->text[l->length++] = *text;
}

static void add_mebibytes(line *l, unsigned long long bytes)
{
    char text[24];
    size_t at = sizeof text - 1;
    unsigned long long number = (bytes + 1048575) / 1048576;
    text[at] = '\0';
    do
        text[--at] = (char)('0' + number % 10);
    while ((number /= 10) > 0);
    add(l, text + at);
    add(l, " MiB");
}

/* Adds "; the address space of the process is limited to 98 MiB" if such a limit is set. Returns
   whether it is. */
static bool add_limit(line *l)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return false;
    add(l, "; the address space of the process is limited to ");
    add_mebibytes(l, limit.rlim_cur);
    return true;
}

void crash_starve(unsigned long long bytes)
{
    ff_guard_mark running = ff_guard_current();
    line sentence = {.length = 0};
    if (running.stage) {
        add(&sentence, running.stage);
        add(&sentence, ": ");
    }
    add(&sentence, "out of memory: a library ");
    if (running.path) {
        add(&sentence, "that the plugin ");
        add(&sentence, running.path);
        add(&sentence, " calls ");
    }
    add(&sentence, "cannot get ");
    add_mebibytes(&sentence, bytes);
    add_limit(&sentence);
    crash_say(sentence.text, FF_FAULT_RUN);
}

/* Makes "oil: the plugin oil.so crashed during evaluate of film: abort". `who` is NULL if any of
   the plugins involved may be the culprit. */
static line make_sentence(const ff_guard_mark *running, const ff_guard_mark *who, const char *verb,
                          const char *detail)
{
    line sentence = {.length = 0};
    if (who && who->stage) {
        add(&sentence, who->stage);
        add(&sentence, ": ");
    }
    add(&sentence, who ? "the plugin " : crash_running());
    add(&sentence, who ? who->path : "");
    add(&sentence, verb);
    add(&sentence, running->action ? running->action : "its work");
    if (who && who != running && running->stage) {
        add(&sentence, " of ");
        add(&sentence, running->stage);
    }
    add(&sentence, ": ");
    add(&sentence, detail);
    return sentence;
}

/* Lets one of several faulting threads report; the others wait. */
static void be_first(void)
{
    static atomic_flag dying = ATOMIC_FLAG_INIT;
    if (atomic_flag_test_and_set(&dying))
        for (;;)
            pause();
}

static _Noreturn void die(const ff_guard_mark *running, const ff_guard_mark *who, const char *verb,
                          const char *detail)
{
    be_first();
    line sentence = make_sentence(running, who, verb, detail);
    crash_say(sentence.text, FF_FAULT_PLUGIN);
}

/* Reports that a plugin's library called exit(). If the memory is limited, the reason is lack of
   memory. */
static _Noreturn void die_of_library(const ff_guard_mark *running, const crash_stack *stack,
                                     const char *library)
{
    be_first();
    line sentence =
        make_sentence(running, crash_stack_blame(stack, running), ended, "its library ");
    add(&sentence, library);
    add(&sentence, " called exit()");
    bool limited = add_limit(&sentence);
    crash_say(sentence.text, limited ? FF_FAULT_RUN : FF_FAULT_PLUGIN);
}

/* Returns the address of the faulting instruction. After a call of a NULL function it is the
   address of the caller. */
static const void *place_of(const void *context)
{
#ifdef __x86_64__
    const greg_t *registers = ((const ucontext_t *)context)->uc_mcontext.gregs;
    return registers[REG_RIP] > 4095 ? (const void *)registers[REG_RIP]
                                     : *(const void *const *)registers[REG_RSP];
#else
    (void)context;
    return NULL;
#endif
}

/* Returns whether the signal is a floating-point trap. The code that enabled the trap may have
   returned long before. */
static bool is_trap(int number, const siginfo_t *info)
{
    return number == SIGFPE && info->si_code >= FPE_FLTDIV && info->si_code <= FPE_FLTSUB;
}

/* Returns the plugin at fault as far as it can be determined, or NULL if any of those involved may
   be it. The stack is read only if a function that ends the program was called, since after a fault
   it may be overwritten. A fault in the code of a stage may also be caused by a service that has
   overwritten its data. */
static const ff_guard_mark *culprit(const ff_guard_mark *running, int number, const void *context)
{
    crash_stack stack;
    if (number != SIGABRT)
        return crash_address_blame(place_of(context), running);
    crash_stack_read(&stack);
    return crash_stack_blame(&stack, running);
}

/* Writes the sentence if the leading process cannot determine it, and leaves other cases to that
   process. If this handler crashes, the leading process still finds out which plugin was
   running. */
static void on_fault(int number, siginfo_t *info, void *context)
{
    ff_guard_mark running = guard_bound();
    if (running.path && is_trap(number, info))
        die(&running, NULL, crashed, "a floating-point trap that it switched on");
    const ff_guard_mark *touched = running.path ? ff_guard_written_over(&running) : NULL;
    if (touched)
        die(&running, touched, crashed, "its file was overwritten while it was in use");
    const ff_guard_mark *who =
        running.path && running.code ? culprit(&running, number, context) : NULL;
    if (who && who != &running)
        die(&running, who, crashed, crash_fault_name(number));
    /* a faulting instruction faults again on return; a sent signal is sent again here */
    signal(number, SIG_DFL);
    if (info->si_code <= 0)
        raise(number);
}

static void on_exit_call(void)
{
    static const char detail[] = "it called exit()";
    crash_stack stack;
    ff_guard_mark running = ff_guard_current();
    if (!running.path)
        return;
    crash_stack_read(&stack);
    const char *library = crash_stack_library(&stack, &running);
    if (library)
        die_of_library(&running, &stack, library);
    die(&running, crash_stack_blame(&stack, &running), ended, detail);
}

static void on_fork(void)
{
    crash_stack stack;
    ff_guard_mark running = ff_guard_current();
    if (!running.path)
        return;
    crash_stack_read(&stack);
    const ff_guard_mark *who = crash_stack_blame_caller(&stack, &running);
    if (who)
        die(&running, who, broke, "it called fork()");
}

/* Ends the process when a plugin ends the main thread with pthread_exit(). Otherwise the program
   would wait for the other threads. */
static void on_thread_end(void *nothing)
{
    ff_guard_mark running = ff_guard_current();
    (void)nothing;
    if (running.path)
        die(&running, NULL, ended, "it called pthread_exit()");
}

void crash_install(void)
{
    static char stack[65536]; /* after a stack overflow the thread's own stack has no room */
    stack_t alternative = {.ss_sp = stack, .ss_size = sizeof stack};
    struct sigaction action = {.sa_sigaction = on_fault, .sa_flags = SA_ONSTACK | SA_SIGINFO};
    pthread_key_t key;
    sigaltstack(&alternative, NULL);
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < FAULTS; i++)
        sigaction(fault_signals[i], &action, NULL);
    if (pthread_key_create(&key, on_thread_end) == 0)
        pthread_setspecific(key, stack);
    pthread_atfork(on_fork, NULL, NULL);
    atexit(on_exit_call);
    at_quick_exit(on_exit_call);
}
