/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "crash.h"

#include <flankfilm/engine.h>

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

static bool owes_json;
static pthread_t main_thread; /* calls the plugins */
/* What happened in another thread; detail is written before verb, which is NULL otherwise. */
static _Atomic(const char *) foreign_verb;
static const char *foreign_detail;
static const char crashed[] = " crashed during ", ended[] = " ended the program during ";
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
static void (*volatile const exit_bound)(int) = _exit;
static ff_guard_mark (*volatile const guard_bound)(void) = ff_guard_current;

/* The sentence, made by functions that a signal handler may call. */
typedef struct line {
    char text[1024];
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

static void put_json(const line *sentence)
{
    static const char digits[] = "0123456789abcdef";
    static const char head[] = "{\"status\":\"error\",\"exit\":3,\"errors\":[{\"file\":null,"
                               "\"line\":null,\"column\":null,\"message\":\"";
    static const char tail[] = "\",\"hint\":null}],\"warnings\":[]}\n";
    put(STDOUT_FILENO, head, sizeof head - 1);
    for (size_t i = 0; i < sentence->length; i++) {
        unsigned char c = (unsigned char)sentence->text[i];
        char code[6] = {'\\', 'u', '0', '0', digits[c >> 4], digits[c & 15]};
        if (c < 0x20 || c == '"' || c == '\\')
            put(STDOUT_FILENO, code, sizeof code);
        else
            put(STDOUT_FILENO, sentence->text + i, 1);
    }
    put(STDOUT_FILENO, tail, sizeof tail - 1);
}

static _Noreturn void die(ff_guard_mark who, const char *what, const char *detail)
{
    if (atomic_flag_test_and_set(&dying))
        for (;;)
            pause(); /* another thread reports the fault */
    line sentence = {.length = 0};
    if (who.stage) {
        add(&sentence, who.stage);
        add(&sentence, ": ");
    }
    add(&sentence, "the plugin ");
    add(&sentence, who.path);
    add(&sentence, what);
    add(&sentence, who.action ? who.action : "its work");
    add(&sentence, ": ");
    add(&sentence, detail);
    put(STDERR_FILENO, "error: ", 7);
    put(STDERR_FILENO, sentence.text, sentence.length);
    put(STDERR_FILENO, "\n", 1);
    if (owes_json)
        put_json(&sentence);
    for (;;)
        exit_bound(FF_FAULT_PLUGIN);
}

/* What happened in a thread of which it is not known that a plugin runs there: the plugin may have
   started it. The main thread waits for it then, and is asked. Returns when no plugin runs. */
static void ask_main_thread(const char *verb, const char *detail)
{
    enum { TRIES = 100, MILLISECONDS = 10 };
    if (pthread_equal(pthread_self(), main_thread))
        return;
    foreign_detail = detail;
    atomic_store(&foreign_verb, verb);
    pthread_kill(main_thread, SIGABRT);
    for (int i = 0; i < TRIES && atomic_load(&foreign_verb); i++)
        poll(NULL, 0, MILLISECONDS);
}

static void on_fault(int number, siginfo_t *info, void *context)
{
    (void)context;
    int which = 0;
    while (which < FAULTS - 1 && fault_signals[which] != number)
        which++;
    ff_guard_mark who = guard_bound();
    const char *verb = atomic_load(&foreign_verb);
    bool asked = verb && pthread_equal(pthread_self(), main_thread);
    if (who.path)
        die(who, asked ? verb : crashed, asked ? foreign_detail : fault_names[which]);
    if (asked) {
        atomic_store(&foreign_verb, NULL);
        return;
    }
    ask_main_thread(crashed, fault_names[which]);
    /* Not a plugin's: what stood before has it. A faulting instruction faults again on return;
       a signal that was sent is sent again. */
    sigaction(number, &before[which], NULL);
    if (info->si_code <= 0)
        raise(number);
}

static void on_exit_call(void)
{
    ff_guard_mark who = guard_bound();
    if (who.path)
        die(who, ended, "it called exit()");
    ask_main_thread(ended, "it called exit()");
}

void cli_crash_install(bool json)
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
    atexit(on_exit_call);
    at_quick_exit(on_exit_call);
}
