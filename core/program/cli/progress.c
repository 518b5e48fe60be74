/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "progress.h"

#include "../crash/lead.h"
#include "../study/store/journal.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static const double first_after = 0.5; /* the line appears after this time, s */
static const double redraw_after = 0.1;

static volatile sig_atomic_t interrupts;

static void on_interrupt(int signal_number, siginfo_t *info, void *context)
{
    static const char text[] = "\nstopping; press again to end at once\n";
    (void)context;
    if (crash_is_echo(info))
        return;
    if (interrupts) {
        signal(signal_number, SIG_DFL);
        raise(signal_number);
    }
    interrupts = 1;
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0)
        return; /* stderr is no terminal */
}

static int on_progress(void *ctx, const ff_stage *stage, double fraction)
{
    cli_progress *progress = ctx;
    const double now = study_seconds_now();
    if (stage != progress->stage) {
        progress->stage = stage;
        progress->started = now;
    }
    if (progress->terminal && now - progress->started >= first_after &&
        now - progress->drawn >= redraw_after) {
        fprintf(stderr, "\r\033[K%s%s%.32s (%.40s) %3.0f %%  %.1f s", progress->text,
                *progress->text ? "; " : "", stage->name, stage->use, 100 * fraction,
                now - progress->started);
        progress->drawn = now;
    }
    return interrupts != 0;
}

static void on_log(void *ctx, const ff_stage *stage, int level, const char *text)
{
    cli_progress *progress = ctx;
    bool warning = level >= FF_LOG_WARNING;
    json_array_append_new(progress->log,
                          json_pack("{s:s, s:s, s:o}", "stage", stage->name, "level",
                                    warning ? "warning" : "info", "text", results_json_text(text)));
    if (warning)
        ff_warn(progress->report, stage->place, "%s: %s", stage->name, text);
}

void cli_progress_begin(cli_progress *progress, ff_report *report)
{
    *progress = (cli_progress){.watch = {.size = sizeof progress->watch,
                                         .ctx = progress,
                                         .progress = on_progress,
                                         .log = on_log},
                               .report = report,
                               .log = json_array(),
                               .terminal = isatty(STDERR_FILENO) != 0};
    struct sigaction action = {.sa_sigaction = on_interrupt, .sa_flags = SA_SIGINFO};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
}

void cli_progress_end(cli_progress *progress)
{
    if (progress->drawn > 0)
        fputs("\r\033[K", stderr);
    if (!interrupts) /* in case the terminal echoed "^C" on the line */
        signal(SIGINT, SIG_DFL);
}

bool cli_interrupted(void)
{
    return interrupts != 0;
}
