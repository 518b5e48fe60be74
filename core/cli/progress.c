/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "progress.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static const double first_after = 0.5; /* s of work before the line appears */
static const double redraw_after = 0.1;

static volatile sig_atomic_t interrupts;

static void on_interrupt(int signal_number)
{
    static const char text[] = "\nstopping; once more to end at once\n";
    (void)signal_number;
    interrupts = 1;
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0)
        return; /* nobody is there to read it */
}

static double seconds_since(const struct timespec *then, const struct timespec *now)
{
    return (double)(now->tv_sec - then->tv_sec) + 1e-9 * (double)(now->tv_nsec - then->tv_nsec);
}

static void draw(ff_progress *progress, const struct timespec *now, double fraction)
{
    double seconds = seconds_since(&progress->started, now);
    if (seconds < first_after || seconds_since(&progress->drawn, now) < redraw_after)
        return;
    double share = fraction > 0 ? (fraction < 1 ? fraction : 1) : 0; /* NaN: 0 */
    fprintf(stderr, "\r\033[K%.32s (%.40s) %3.0f %%  %.1f s", progress->stage->name,
            progress->stage->use, 100 * share, seconds);
    fflush(stderr);
    progress->drawn = *now;
    progress->shown = true;
}

static void clear(ff_progress *progress)
{
    if (progress->shown)
        fputs("\r\033[K", stderr);
    progress->shown = false;
}

static int on_progress(void *ctx, const ff_stage *stage, double fraction)
{
    ff_progress *progress = ctx;
    if (progress->terminal) {
        struct timespec now;
        clock_gettime(CLOCK_MONOTONIC, &now);
        if (stage != progress->stage) {
            progress->stage = stage;
            progress->started = now;
            progress->drawn = (struct timespec){0};
        }
        draw(progress, &now, fraction);
    }
    return interrupts != 0;
}

static void on_log(void *ctx, const ff_stage *stage, int level, const char *text)
{
    ff_progress *progress = ctx;
    bool warning = level >= FF_LOG_WARNING;
    json_t *entry = json_object();
    json_object_set_new(entry, "stage", ff_json_text(stage->name));
    json_object_set_new(entry, "level", json_string(warning ? "warning" : "info"));
    json_object_set_new(entry, "text", ff_json_text(text));
    json_array_append_new(progress->log, entry);
    if (warning)
        ff_warn(progress->report, stage->place, "%s: %s", stage->name, text);
}

void ff_progress_begin(ff_progress *progress, ff_report *report)
{
    *progress = (ff_progress){.watch = {on_progress, on_log, progress},
                              .report = report,
                              .log = json_array(),
                              .terminal = isatty(STDERR_FILENO) != 0};
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
}

void ff_progress_end(ff_progress *progress)
{
    clear(progress);
    signal(SIGINT, SIG_DFL);
}

void ff_progress_free(ff_progress *progress)
{
    json_decref(progress->log);
}

bool ff_interrupted(void)
{
    return interrupts != 0;
}
