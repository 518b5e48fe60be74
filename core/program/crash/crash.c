/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "crash.h"

#include "blame.h"
#include "exits.h"
#include "hunger.h"
#include "meddling.h"

#include "../terminal/answer.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

static bool owes_json;
static pthread_t main_thread; /* calls the plugins */
/* What happened in another thread; the rest is written before verb, which is NULL otherwise. */
static _Atomic(const char *) foreign_verb;
static const char *foreign_detail;
static crash_stack foreign_stack;
static const char crashed[] = " crashed during ", ended[] = " ended the program during ",
                  broke[] = " broke the rules during ";
static atomic_flag dying = ATOMIC_FLAG_INIT;

enum { FAULTS = 5 };
static const int fault_signals[FAULTS] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
static const char *const fault_names[FAULTS] = {
    "segmentation fault", "bus error", "arithmetic fault such as an integer division by zero",
    "illegal processor instruction", "abort"};
static struct sigaction before[FAULTS];

/* Bound at program start: when the dynamic linker itself faults over a damaged file, a first call
   that goes through it would fault again. */
static ssize_t (*volatile const write_bound)(int, const void *, size_t) = write;
static ff_guard_mark (*volatile const guard_bound)(void) = ff_guard_current;

/* The sentence, made by functions that a signal handler may call. */
typedef struct line {
    char text[2048];
    size_t length;
} line;

static void add(line *l, const char *text)
{
    for (; *text && l->length < sizeof l->text; text++)
        l->text[l->length++] = *text;
}

static void put(int file, const char *text, size_t length)
{
    while (length > 0) {
        ssize_t written = write_bound(file, text, length);
        if (written <= 0)
            return;
        text += written;
        length -= (size_t)written;
    }
}

static void put_json(const line *sentence, int exit_code)
{
    static const char digits[] = "0123456789abcdef";
    static const char start[] = "{\"status\":\"error\",\"exit\":";
    static const char head[] = ",\"errors\":[{\"file\":null,"
                               "\"line\":null,\"column\":null,\"message\":\"";
    static const char tail[] = "\",\"hint\":null}],\"warnings\":[]}\n";
    int file = terminal_answer_file();
    put(file, start, sizeof start - 1);
    put(file, &digits[exit_code], 1);
    put(file, head, sizeof head - 1);
    for (size_t i = 0; i < sentence->length; i++) {
        unsigned char c = (unsigned char)sentence->text[i];
        char code[6] = {'\\', 'u', '0', '0', digits[c >> 4], digits[c & 15]};
        if (c < 0x20 || c == '"' || c == '\\')
            put(file, code, sizeof code);
        else
            put(file, sentence->text + i, 1);
    }
    put(file, tail, sizeof tail - 1);
}

static _Noreturn void report(const line *sentence, int code)
{
    put(STDERR_FILENO, "error: ", 7);
    put(STDERR_FILENO, sentence->text, sentence->length);
    put(STDERR_FILENO, "\n", 1);
    if (owes_json)
        put_json(sentence, code);
    crash_leave(code);
}

static void add_mebibytes(line *l, size_t bytes)
{
    char text[24];
    size_t at = sizeof text - 1, number = (bytes + 1048575) / 1048576;
    text[at] = '\0';
    do
        text[--at] = (char)('0' + number % 10);
    while ((number /= 10) > 0);
    add(l, text + at);
    add(l, " MiB");
}

/* "; the address space of the process is limited to 98 MiB", where it is. Returns whether. */
static bool add_limit(line *l)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return false;
    add(l, "; the address space of the process is limited to ");
    add_mebibytes(l, limit.rlim_cur);
    return true;
}

/* A library that a plugin calls asks for memory again and again, and would do so for ever. */
static void on_hunger(size_t bytes)
{
    ff_guard_mark running = ff_guard_current();
    line sentence = {.length = 0};
    if (!running.path || atomic_flag_test_and_set(&dying))
        return;
    if (running.stage) {
        add(&sentence, running.stage);
        add(&sentence, ": ");
    }
    add(&sentence, "out of memory: a library that the plugin ");
    add(&sentence, running.path);
    add(&sentence, " calls cannot get ");
    add_mebibytes(&sentence, bytes);
    add_limit(&sentence);
    report(&sentence, FF_FAULT_RUN);
}

/* "oil: the plugin oil.so crashed during evaluate of film: abort". `who` NULL: it may be any that
   takes part. */
static line make_sentence(const ff_guard_mark *running, const ff_guard_mark *who, const char *verb,
                          const char *detail)
{
    line sentence = {.length = 0};
    char services[700] = "";
    if (!who)
        ff_guard_print_services(running, ", or one that serves it (", services, sizeof services);
    who = who ? who : running;
    if (who->stage) {
        add(&sentence, who->stage);
        add(&sentence, ": ");
    }
    add(&sentence, "the plugin ");
    add(&sentence, who->path);
    add(&sentence, services);
    add(&sentence, services[0] ? ")," : "");
    add(&sentence, verb);
    add(&sentence, running->action ? running->action : "its work");
    if (who != running && running->stage) {
        add(&sentence, " of ");
        add(&sentence, running->stage);
    }
    add(&sentence, ": ");
    add(&sentence, detail);
    return sentence;
}

/* Of several threads with a fault one reports it. */
static void be_first(void)
{
    if (atomic_flag_test_and_set(&dying))
        for (;;)
            pause();
}

static _Noreturn void die(const ff_guard_mark *running, const ff_guard_mark *who, const char *verb,
                          const char *detail)
{
    be_first();
    line sentence = make_sentence(running, who, verb, detail);
    report(&sentence, FF_FAULT_PLUGIN);
}

/* A library of the plugin has called exit(): for want of memory, where that is limited. */
static _Noreturn void die_of_library(const ff_guard_mark *running, const crash_stack *stack,
                                     const char *library)
{
    be_first();
    line sentence =
        make_sentence(running, crash_stack_blame(stack, running), ended, "its library ");
    add(&sentence, library);
    add(&sentence, " called exit()");
    report(&sentence, add_limit(&sentence) ? FF_FAULT_RUN : FF_FAULT_PLUGIN);
}

/* What happened in a thread of which it is not known that a plugin runs there: the plugin may have
   started it. The main thread waits for it then, and is asked. Returns when no plugin runs. */
static void ask_main_thread(const crash_stack *stack, const char *verb, const char *detail)
{
    enum { TRIES = 100, MILLISECONDS = 10 };
    if (pthread_equal(pthread_self(), main_thread))
        return;
    foreign_stack = *stack;
    foreign_detail = detail;
    atomic_store(&foreign_verb, verb);
    pthread_kill(main_thread, SIGABRT);
    for (int i = 0; i < TRIES && atomic_load(&foreign_verb); i++)
        poll(NULL, 0, MILLISECONDS);
}

/* Answers another thread; false when none has asked. */
static bool answer_thread(const ff_guard_mark *running)
{
    const char *verb = atomic_load(&foreign_verb);
    if (!verb || !pthread_equal(pthread_self(), main_thread))
        return false;
    if (running->path)
        die(running, crash_stack_blame(&foreign_stack, running), verb, foreign_detail);
    atomic_store(&foreign_verb, NULL);
    return true;
}

/* The address of the instruction; after a call of nothing, that of the caller. */
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

/* Who switched a trap on may have returned long before it strikes. */
static bool is_trap(int number, const siginfo_t *info)
{
    return number == SIGFPE && info->si_code >= FPE_FLTDIV && info->si_code <= FPE_FLTSUB;
}

static void on_fault(int number, siginfo_t *info, void *context)
{
    int which = 0;
    crash_stack stack;
    while (which < FAULTS - 1 && fault_signals[which] != number)
        which++;
    ff_guard_mark running = guard_bound();
    if (answer_thread(&running))
        return;
    if (running.path && is_trap(number, info))
        die(&running, NULL, crashed, "a floating-point trap that it switched on");
    if (running.path && !running.code)
        die(&running, &running, crashed, fault_names[which]);
    crash_stack_read(&stack, place_of(context));
    if (running.path)
        die(&running, crash_stack_blame(&stack, &running), crashed, fault_names[which]);
    ask_main_thread(&stack, crashed, fault_names[which]);
    /* Not a plugin's: what stood before has it. A faulting instruction faults again on return;
       a signal that was sent is sent again. */
    sigaction(number, &before[which], NULL);
    if (info->si_code <= 0)
        raise(number);
}

static void on_exit_call(void)
{
    static const char detail[] = "it called exit()";
    crash_stack stack;
    ff_guard_mark running = ff_guard_current();
    crash_stack_read(&stack, NULL);
    const char *library = running.path ? crash_stack_library(&stack, &running) : NULL;
    if (library)
        die_of_library(&running, &stack, library);
    if (running.path)
        die(&running, crash_stack_blame(&stack, &running), ended, detail);
    ask_main_thread(&stack, ended, detail);
}

/* The libraries of a plugin may know what they do: an MPI starts helpers of its own. */
static void on_end(const char *function, const void *caller)
{
    char detail[64] = "it called ";
    ff_guard_mark running = ff_guard_current();
    const ff_guard_mark *who = running.path ? crash_address_blame(caller, &running) : NULL;
    if (who)
        die(&running, who, ended, strcat(detail, function));
}

/* While an object is loaded, the libraries that come with it may set up what they need. */
static void on_meddling(const char *function, const void *caller, bool ends)
{
    char detail[64] = "it called ";
    ff_guard_mark running = ff_guard_current();
    const ff_guard_mark *who = running.path ? crash_address_blame(caller, &running) : NULL;
    if (!who || (!running.code && !crash_address_is_in(caller, running.path)))
        return;
    strcat(strcat(detail, function), "()");
    die(&running, who, ends ? ended : broke, detail);
}

static void on_fork(void)
{
    crash_stack stack;
    ff_guard_mark running = ff_guard_current();
    if (!running.path)
        return;
    crash_stack_read(&stack, NULL);
    const ff_guard_mark *who = crash_stack_blame_caller(&stack, &running);
    if (who)
        die(&running, who, broke, "it called fork()");
}

void crash_install(bool json)
{
    static char stack[65536]; /* a stack overflow leaves none of the thread's own */
    stack_t alternative = {.ss_sp = stack, .ss_size = sizeof stack};
    owes_json = json;
    main_thread = pthread_self();
    sigaltstack(&alternative, NULL);
    struct sigaction action = {.sa_sigaction = on_fault, .sa_flags = SA_ONSTACK | SA_SIGINFO};
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < FAULTS; i++)
        sigaction(fault_signals[i], &action, &before[i]);
    crash_exits_watch(on_end);
    crash_meddling_watch(on_meddling);
    crash_hunger_watch(on_hunger);
    pthread_atfork(on_fork, NULL, NULL);
    atexit(on_exit_call);
    at_quick_exit(on_exit_call);
}
