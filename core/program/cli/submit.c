/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The script that runs a study under a scheduler. */
#include "command.h"

#include <errno.h>
#include <fcntl.h>
#include <flankfilm/scheduler.h>
#include <limits.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { USUAL_PARTS = 32 };

extern char **environ;

static char *quoted(const char *text)
{
    char *word = NULL;
    size_t length;
    FILE *out = fe_there(open_memstream(&word, &length));
    study_put_quoted(out, text);
    fclose(out);
    return word;
}

static void put_option(FILE *out, const char *option, const char *value)
{
    fprintf(out, " %s ", option);
    study_put_quoted(out, value);
}

/* What runs a part, up to its number. */
static char *command_of(const cli_options *options, const char *directory, size_t workers)
{
    char program[PATH_MAX], *text = NULL;
    size_t size;
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    FILE *out = fe_there(open_memstream(&text, &size));
    study_put_quoted(out, length > 0 ? program : "flankfilm");
    put_option(out, "run", options->operand);
    put_option(out, "-o", directory);
    fprintf(out, " -j %zu", workers);
    for (size_t i = 0; i < options->set_count; i++)
        put_option(out, "--set", options->sets[i]);
    for (size_t i = 0; i < options->plugin_path_count; i++)
        put_option(out, "--plugin-path", options->plugin_paths[i]);
    fputs(" --shard", out);
    fclose(out);
    return text;
}

/* The name of the file, of the characters that every scheduler takes. */
static char *name_of(const char *file)
{
    const char *base = strrchr(file, '/') ? strrchr(file, '/') + 1 : file;
    const char *dot = strrchr(base, '.');
    size_t length = dot && dot > base ? (size_t)(dot - base) : strlen(base);
    char *name = fe_copy_text(base, length);
    static const char legal[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "-_.";
    for (char *at = name + strspn(name, legal); *at; at += strspn(at, legal))
        *at = '-';
    return name;
}

/* A chain of cases is never cut. */
static size_t count_parts(const cli_options *options, const study_definition *study)
{
    size_t most = study_chains(study);
    size_t parts = options->tasks   ? options->tasks
                   : options->chunk ? (study->count - 1) / options->chunk + 1
                                    : USUAL_PARTS;
    return parts < most ? parts : most;
}

typedef struct writing {
    const ff_submission *job;
    FILE *out;
} writing;

static void put(void *ctx, const char *text)
{
    fputs(text, ctx);
}

static ff_status write_script(const void *table, void *ctx)
{
    const ff_scheduler *scheduler = table;
    const writing *w = ctx;
    if (!FF_HAS(scheduler, write) || !scheduler->write || !scheduler->send || !scheduler->send[0])
        return FF_BUG;
    return scheduler->write(scheduler->self, w->job, put, w->out);
}

static bool save(const fe_tool *tool, const ff_submission *job, const char *path, fe_report *report)
{
    FILE *out = fopen(path, "we");
    writing w = {.job = job, .out = out};
    bool told = out && fe_tool_call(tool, "write", write_script, &w, report);
    bool whole = out && !ferror(out);
    whole = out && fchmod(fileno(out), 0755) == 0 && whole;
    whole = out && fclose(out) == 0 && whole;
    if (whole || (out && !told))
        return told;
    return fe_error(report, FE_EXIT_FAILED, FE_NOWHERE, NULL, "%s could not be written: %s", path,
                    strerror(errno));
}

/* The scheduler's own program says what it thinks of the script. */
static bool send(const fe_tool *tool, char *path, fe_report *report)
{
    enum { MOST_WORDS = 32 };
    const ff_scheduler *scheduler = tool->table;
    char *words[MOST_WORDS + 2] = {NULL};
    size_t count = 0;
    int status = 0;
    pid_t pid;
    for (; scheduler->send[count] && count < MOST_WORDS; count++)
        words[count] = (char *)(size_t)scheduler->send[count];
    words[count] = path;
    fflush(NULL);
    int cause = posix_spawnp(&pid, words[0], NULL, NULL, words, environ);
    if (cause != 0)
        return fe_error(report, FE_EXIT_FAILED, FE_NOWHERE,
                        "the script is written; it can be sent from a machine of the cluster",
                        "%s cannot be started: %s", words[0], strerror(cause));
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
        ;
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           fe_error(report, FE_EXIT_FAILED, FE_NOWHERE, NULL, "%s did not take the script",
                    words[0]);
}

static void tell(const fe_tool *tool, const ff_submission *job, size_t cases, const char *path)
{
    const ff_scheduler *scheduler = tool->table;
    char *word = quoted(path);
    printf("%zu cases in %zu parts; send them with\n ", cases, job->parts);
    for (size_t i = 0; scheduler->send[i]; i++)
        printf(" %s", scheduler->send[i]);
    printf(" %s\n", word);
    free(word);
}

/* Absolute, though it need not be there yet; NULL with an error for one that no script can name. */
static char *whole_path(const char *path, const char *here, fe_report *report)
{
    char *whole = *path == '/' ? fe_print_text("%s", path) : fe_print_text("%s/%s", here, path);
    if (!strpbrk(whole, "\n\r\"%\\"))
        return whole;
    fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, "name another directory with -o",
             "\"%s\" cannot stand in the script", whole);
    free(whole);
    return NULL;
}

static bool prepare(const cli_session *session, const cli_options *options, const fe_tool *tool)
{
    char here[PATH_MAX];
    fe_report *report = session->report;
    if (!getcwd(here, sizeof here))
        return fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL,
                        "the working directory is not known: %s", strerror(errno));
    char *directory = options->directory ? fe_print_text("%s", options->directory)
                                         : cli_default_directory(options->operand);
    char *whole = whole_path(directory, here, report);
    char *logs = fe_print_text("%s/log", whole ? whole : ""), *place = quoted(here);
    char *path = fe_print_text("%s/submit.sh", directory), *name = name_of(options->operand);
    size_t workers = options->jobs ? options->jobs : 1, cases = session->study->count;
    char *command = command_of(options, directory, workers);
    ff_submission job = {.size = sizeof job,
                         .name = name,
                         .parts = count_parts(options, session->study),
                         .workers = workers,
                         .logs = logs,
                         .directory = place,
                         .command = command};
    bool good = whole && study_claim_directory(directory, report);
    if (good && !study_make_path(logs))
        good = fe_error(report, FE_EXIT_INPUT, FE_NOWHERE, NULL, "%s cannot be used: %s", logs,
                        strerror(errno));
    good = good && save(tool, &job, path, report);
    if (good && options->now)
        good = send(tool, path, report);
    else if (good)
        tell(tool, &job, cases, path);
    char *texts[] = {directory, whole, logs, place, path, name, command};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        free(texts[i]);
    return good;
}

int cli_submit(const cli_options *options)
{
    cli_session session;
    fe_tool tool = {.table = NULL};
    fe_tool_choice choice = {.option = "--to",
                             .interface = FF_SCHEDULER_ID,
                             .name = options->to,
                             .settings = options->withs,
                             .setting_count = options->with_count};
    if (!options->to || (options->chunk && options->tasks)) {
        cli_wrong_usage(options, options->to ? "one of --chunk and --tasks says it all"
                                             : "submit wants --to, such as --to slurm");
        return FE_EXIT_INPUT;
    }
    bool good = cli_session_open(&session, options, false);
    if (good && !session.study)
        good = fe_error(session.report, FE_EXIT_INPUT, FE_NOWHERE, "run it in a job of its own",
                        "%s has no study", options->operand);
    good = good && fe_tool_open(&tool, session.library, &choice, session.report) &&
           prepare(&session, options, &tool);
    int code = good ? FE_EXIT_OK : cli_refuse(session.report, options, "nothing was sent");
    fe_tool_close(&tool);
    cli_session_close(&session);
    return code;
}
