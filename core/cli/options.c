/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command.h"

#include "../value/memory.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_JOBS = 4096 };

typedef struct option_row {
    char letter; /* its name in ff_command.accepts */
    const char *name, *argument, *text;
} option_row;

/* Lower-case letters `o`, `j`, `h` are also short options. */
static const option_row rows[] = {
    {'s', "set", "PATH=VALUE", "use VALUE instead of what the file says; repeatable"},
    {'o', "output", "DIR", "write the results there (default: results/<name of the file>)"},
    {'j', "jobs", "N", "worker processes of a study"},
    {'J', "json", NULL, "print one JSON object, all values in SI, and nothing else"},
    {'p', "plugin-path", "DIR", "look for models there first; repeatable"},
    {'h', "help", NULL, "print this"},
};
enum { ROWS = sizeof rows / sizeof rows[0] };

static bool accepts(const ff_command *command, int letter)
{
    return letter == 'h' || strchr(command->accepts, letter);
}

static const option_row *row_of(int letter)
{
    for (size_t i = 0; i < ROWS; i++)
        if (rows[i].letter == letter)
            return &rows[i];
    return NULL;
}

void ff_options_usage(const ff_command *command, char *out, size_t size)
{
    size_t at =
        (size_t)snprintf(out, size, "flankfilm %s%s%s", command->name, command->operand ? " " : "",
                         command->operand ? command->operand : "");
    for (size_t i = 0; i < ROWS && at < size; i++) {
        const option_row *row = &rows[i];
        if (row->letter == 'h' || !accepts(command, row->letter))
            continue;
        bool repeats = row->letter == 's' || row->letter == 'p';
        if (row->letter == 'o' || row->letter == 'j')
            at += (size_t)snprintf(out + at, size - at, " [-%c %s]", row->letter, row->argument);
        else
            at += (size_t)snprintf(out + at, size - at, " [--%s%s%s]%s", row->name,
                                   row->argument ? " " : "", row->argument ? row->argument : "",
                                   repeats ? "..." : "");
    }
}

void ff_options_describe(const ff_command *command, FILE *stream)
{
    for (size_t i = 0; i < ROWS; i++) {
        const option_row *row = &rows[i];
        if (!accepts(command, row->letter))
            continue;
        char left[40], shorter[8] = "";
        if (row->letter == 'o' || row->letter == 'j' || row->letter == 'h')
            snprintf(shorter, sizeof shorter, "-%c, ", row->letter);
        snprintf(left, sizeof left, "%s--%s %s", shorter, row->name,
                 row->argument ? row->argument : "");
        fprintf(stream, "  %-24s %s\n", left, row->text);
    }
}

static bool parse_jobs(const char *text, long *jobs, char *why, size_t why_size)
{
    int64_t value = 0;
    char detail[160];
    if (ff_integer_parse(text, &value, detail, sizeof detail) && value >= 1 && value <= MAX_JOBS) {
        *jobs = (long)value;
        return true;
    }
    snprintf(why, why_size, "-j wants a whole number from 1 to %d, not \"%s\"", MAX_JOBS, text);
    return false;
}

static bool take_operand(ff_options *options, const ff_command *command, const char *text,
                         char *why, size_t why_size)
{
    if (!command->operand)
        snprintf(why, why_size, "%s takes no argument, but got \"%s\"", command->name, text);
    else if (options->operand)
        snprintf(why, why_size, "%s takes one %s, but got \"%s\" as well", command->name,
                 command->operand, text);
    else {
        options->operand = text;
        return true;
    }
    return false;
}

static bool unknown(const char *word, char *why, size_t why_size)
{
    if (optopt) {
        const option_row *row = row_of(optopt);
        if (row && strncmp(word, "--", 2) == 0)
            snprintf(why, why_size, "the option --%s takes no value", row->name);
        else
            snprintf(why, why_size, "unknown option -%c", optopt);
        return false;
    }
    const char *names[ROWS];
    char name[64];
    for (size_t i = 0; i < ROWS; i++)
        names[i] = rows[i].name;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    const char *near = ff_nearest(name, names, ROWS);
    if (near)
        snprintf(why, why_size, "unknown option --%s; did you mean --%s?", name, near);
    else
        snprintf(why, why_size, "unknown option --%s", name);
    return false;
}

static bool take(ff_options *options, const ff_command *command, int letter, char *why,
                 size_t why_size)
{
    if (!accepts(command, letter)) {
        snprintf(why, why_size, "%s takes no option --%s", command->name, row_of(letter)->name);
        return false;
    }
    switch (letter) {
    case 's':
        options->sets[options->set_count++] = optarg;
        return true;
    case 'p':
        options->plugin_paths[options->plugin_path_count++] = optarg;
        return true;
    case 'o':
        options->directory = optarg;
        if (*optarg)
            return true;
        snprintf(why, why_size, "-o wants the name of a directory");
        return false;
    case 'j':
        return parse_jobs(optarg, &options->jobs, why, why_size);
    case 'J':
        options->json = true;
        return true;
    default:
        options->help = true;
        return true;
    }
}

/* Leading '-': operands come in order as option 1, whatever POSIXLY_CORRECT says. */
static bool parse_all(ff_options *options, const ff_command *command, int argc, char **argv,
                      char *why, size_t why_size)
{
    struct option table[ROWS + 1] = {{0}};
    for (size_t i = 0; i < ROWS; i++)
        table[i] = (struct option){rows[i].name, rows[i].argument ? required_argument : no_argument,
                                   NULL, rows[i].letter};
    opterr = 0;
    int letter;
    while ((letter = getopt_long(argc, argv, "-:o:j:h", table, NULL)) != -1) {
        const char *word = argv[optind - 1];
        bool fine = true;
        if (letter == 1)
            fine = take_operand(options, command, optarg, why, why_size);
        else if (letter == '?')
            fine = unknown(word, why, why_size);
        else if (letter == ':') {
            snprintf(why, why_size, "the option %s wants a value", word);
            fine = false;
        } else
            fine = take(options, command, letter, why, why_size);
        if (!fine)
            return false;
    }
    for (; optind < argc; optind++)
        if (!take_operand(options, command, argv[optind], why, why_size))
            return false;
    return true;
}

bool ff_options_parse(ff_options *options, const ff_command *command, int argc, char **argv,
                      char *why, size_t why_size)
{
    size_t room = (size_t)argc; /* no option can be repeated more often */
    *options = (ff_options){.jobs = 1};
    options->sets = ff_alloc(room * sizeof *options->sets);
    options->plugin_paths = ff_alloc(room * sizeof *options->plugin_paths);
    if (!parse_all(options, command, argc, argv, why, why_size))
        return false;
    bool needs = command->operand && command->operand[0] != '[';
    if (needs && !options->operand && !options->help) {
        snprintf(why, why_size, "%s wants a %s", command->name, command->operand);
        return false;
    }
    return true;
}

void ff_options_free(ff_options *options)
{
    free(options->sets);
    free(options->plugin_paths);
}
