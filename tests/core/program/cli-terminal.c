/* SPDX-License-Identifier: GPL-3.0-or-later */
/* On a terminal: colour, the progress line, and the interrupt key. */
#include "cli-harness.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static char text[65536]; /* all that the terminal got */
static size_t length;
static double seconds; /* that the last program took */

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Reads until the terminal shows `part`; NULL: until it is closed. */
static void read_until(int master, const char *part)
{
    ssize_t got;
    while (length < sizeof text - 1 && !(part && cli_has(text, part)) &&
           (got = read(master, text + length, sizeof text - 1 - length)) > 0) {
        length += (size_t)got;
        text[length] = '\0';
    }
}

static pid_t start(int master, const char *line)
{
    pid_t child = fork();
    if (child == 0) {
        setsid();
        int slave = open(ptsname(master), O_RDWR);
        for (int fd = 0; fd < 3; fd++)
            dup2(slave, fd);
        close(master);
        execl("/bin/sh", "sh", "-c", line, (char *)NULL);
        _exit(99);
    }
    return child;
}

static bool to_group; /* interrupts go to the whole group of the program */

/* Runs the shell line on a terminal of its own. Sends an interrupt when the progress line is seen,
   and a second one when the first was heard. */
static int on_terminal(const char *line, int interrupts)
{
    int master = posix_openpt(O_RDWR | O_NOCTTY), status = 0;
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) {
        puts("needs a pseudo-terminal");
        exit(77);
    }
    double begin = now();
    length = 0;
    text[0] = '\0';
    pid_t child = start(master, line);
    for (int i = 0; i < interrupts; i++) {
        read_until(master, i == 0 ? "%" : "press again to end");
        if (i > 0)
            usleep(100000); /* a burst of signals counts once */
        kill(to_group ? -child : child, SIGINT);
        if (to_group && i == 0)
            kill(child, SIGINT); /* as timeout(1) does */
    }
    read_until(master, NULL);
    waitpid(child, &status, 0);
    seconds = now() - begin;
    close(master);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

static void expect(const char *what, bool condition)
{
    if (!check_true(what, condition))
        printf("  terminal: %.2000s\n", text);
}

static void test_colour(void)
{
    setenv("TERM", "xterm", 1);
    on_terminal("$F run pair.yaml --all", 0);
    expect("colour on a terminal", cli_has(text, "\033[32mgood\033[0m"));
    on_terminal("NO_COLOR=1 $F run pair.yaml", 0);
    expect("NO_COLOR", !cli_has(text, "\033["));
    on_terminal("NO_COLOR= $F run pair.yaml", 0);
    expect("an empty NO_COLOR does not count", cli_has(text, "\033["));
    on_terminal("TERM=dumb $F run pair.yaml", 0);
    expect("a dumb terminal", !cli_has(text, "\033["));
}

static void test_width(void)
{
    on_terminal("stty cols 60 <&1; $F models toy/wave", 0);
    expect("a narrow terminal", cli_has(text, "number of points, with which the\r\n"));
    on_terminal("stty cols 150 <&1; $F models toy/wave", 0);
    expect("a wide terminal", cli_has(text, "work would grow in a model that computes something"));
}

static void test_progress(void)
{
    int code = on_terminal("exec $F run pair.yaml --json --set wave.work='0.9 s' >file", 0);
    expect("a progress line on long work", code == 0 && cli_has(text, "wave (toy/wave)"));
    size_t draws = 0;
    for (const char *at = text; (at = strchr(at, '%')); at++)
        draws++;
    expect("at most ten times a second", draws >= 1 && (double)draws <= 1 + 10 * seconds);
    expect("cleared at the end", length > 4 && strcmp(text + length - 4, "\r\033[K") == 0);
    on_terminal("exec $F run pair.yaml --json --set wave.work='0.1 s' >file", 0);
    expect("none on short work", !cli_has(text, "wave"));
    outcome r = cli("$F run pair.yaml --json --set wave.work='0.7 s'");
    cli_expect("none without a terminal", &r, !*r.err);
}

static void test_interrupt(void)
{
    int code = on_terminal("exec $F run pair.yaml --set wave.work='5 s' -o stopped", 1);
    expect("the first interrupt stops the stages", code == 1 && cli_has(text, "was stopped"));
    expect("what there is was written",
           cli_has(cli_read("stopped/result.json"), "\"status\":\"stopped\""));
    code = on_terminal("exec $F run pair.yaml --set wave.work='5 s' --set wave.end=deaf", 2);
    expect("the second interrupt ends the program", code == 128 + SIGINT);
    to_group = true;
    code = on_terminal("exec $F run pair.yaml --set wave.work='5 s' -o stopped", 1);
    expect("one to the whole group counts once", code == 1 && cli_has(text, "was stopped"));
    code = on_terminal("exec $F run pair.yaml --set wave.work='5 s' --set wave.end=deaf", 2);
    expect("two count twice", code == 128 + SIGINT);
    to_group = false;
    code = on_terminal("exec $F run pair.yaml --json --set wave.work='5 s' >file", 1);
    expect("the same with --json", code == 1 && cli_has(cli_read("file"), "\"exit\":1"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_colour();
    test_width();
    test_progress();
    test_interrupt();
    return cli_close();
}
