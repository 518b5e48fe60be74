/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whatever the library is asked, it prints nothing, and leaves the process as it was. */
#include <flankfilm/engine.h>

#include <check.h>

#include <fcntl.h>
#include <fenv.h>
#include <locale.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SIGNALS = 32, MOST = 1 << 16 };

extern char **environ;

/* Of the process. */
typedef struct state {
    char locale[256], folder[4096], environment[MOST];
    sighandler_t handlers[SIGNALS];
    sigset_t blocked;
    mode_t mask;
    int rounding, traps, files;
} state;

static void look(state *s)
{
    size_t used = 0;
    memset(s, 0, sizeof *s);
    snprintf(s->locale, sizeof s->locale, "%s", setlocale(LC_ALL, NULL));
    if (!getcwd(s->folder, sizeof s->folder))
        exit(2);
    for (char **at = environ; *at && used < MOST; at++)
        used += (size_t)snprintf(s->environment + used, MOST - used, "%s\n", *at);
    for (int i = 1; i < SIGNALS; i++) {
        struct sigaction action;
        sigaction(i, NULL, &action);
        s->handlers[i] = action.sa_handler;
    }
    sigprocmask(SIG_BLOCK, NULL, &s->blocked);
    s->mask = umask(0);
    umask(s->mask);
    s->rounding = fegetround();
    s->traps = fegetexcept();
    for (int fd = 0; fd < 64; fd++)
        s->files += fcntl(fd, F_GETFD) != -1;
}

static void run(const char *file)
{
    const char *directory = getenv("FLANKFILM_TEST_BAD");
    const ff_engine_options options = {sizeof options, &directory, 1};
    ff_engine *engine;
    ff_run *run;
    if (ff_engine_new(&options, &engine) != FF_OK)
        exit(2);
    if (ff_run_open(engine, file, NULL, &run) == FF_OK)
        ff_run_start(run, NULL);
    ff_run_close(run);
    ff_engine_close(engine);
}

/* Runs each file with what is printed going to a file. */
static long count_printed(void)
{
    static const char *const files[] = {"toys.yaml", "wrong.yaml", "laws.yaml", "absent.yaml"};
    FILE *file = tmpfile();
    int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO);
    fflush(stdout);
    dup2(fileno(file), STDOUT_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        run(files[i]);
    fflush(stdout);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    struct stat about;
    fstat(fileno(file), &about);
    fclose(file);
    close(out);
    close(err);
    return about.st_size;
}

static void on_signal(int number)
{
    (void)number;
}

int main(void)
{
    static state before, after;
    char folder[4096];
    snprintf(folder, sizeof folder, "%s/tests/core/engine/scenes", getenv("FLANKFILM_TEST_SOURCE"));
    if (chdir(folder) != 0)
        return 2;
    /* not as a process starts */
    setlocale(LC_ALL, "C.UTF-8");
    umask(027);
    signal(SIGUSR1, on_signal);
    signal(SIGSEGV, on_signal);
    fesetround(FE_DOWNWARD);
    look(&before);
    check_true("nothing is printed", count_printed() == 0);
    look(&after);
    check_true("locale", !strcmp(before.locale, after.locale));
    check_true("folder", !strcmp(before.folder, after.folder));
    check_true("environment", !strcmp(before.environment, after.environment));
    check_true("signal handlers", !memcmp(before.handlers, after.handlers, sizeof before.handlers));
    check_true("blocked signals", !memcmp(&before.blocked, &after.blocked, sizeof before.blocked));
    check_true("mask of new files", before.mask == after.mask);
    check_true("rounding", before.rounding == after.rounding);
    check_true("floating-point traps", before.traps == after.traps);
    check_true("open files", before.files == after.files);
    return check_done();
}
