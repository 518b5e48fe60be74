/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of all options of all commands. Parsing, usage and help are made from it. */
#include "options.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <getopt.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef enum { OPTIONAL, REPEATABLE, REQUIRED } occurrence;

/* An option may have several rows, each for different commands. */
typedef struct option_row {
    const char *name;
    char letter;          /* short form; 0: none */
    const char *argument; /* name of its argument in usage; NULL: it takes none */
    const char *commands; /* commands that accept it; NULL: all */
    const char *text;     /* description printed by help */
    occurrence occurrence;
    bool (*set)(cli_options *,
                const char *argument); /* sets a member; NULL: only cli_option finds the option */
} option_row;

static bool set_jobs(cli_options *options, const char *argument);
static bool set_directory(cli_options *options, const char *argument);
static bool set_shard(cli_options *options, const char *argument);
static bool set_rerun(cli_options *options, const char *argument);

static const option_row rows[] = {
    {"law", 0, "NAME", "fit", "fit this law, such as roelands; repeatable", REPEATABLE, NULL},
    {"at", 0, "QUANTITY", "fit",
     "fit only data at \"80 degC\"; print the laws' values at \"0.6 GPa\"", REPEATABLE, NULL},
    {"pipeline", 0, "FILE", "verify",
     "take parameters and inputs from the stage of that file that uses the model", OPTIONAL, NULL},
    {"only", 0, "TEST,...", "verify", "run only these tests", OPTIONAL, NULL},
    {"list", 0, NULL, "verify", "list the tests for this model without running them", OPTIONAL,
     NULL},
    {"set", 0, "NAME=VALUE", "fit",
     "keep this parameter fixed; NAME=free fits one that has a preset; repeatable", REPEATABLE,
     NULL},
    {"set", 0, "PATH=VALUE", "run plan check explain cite verify",
     "use VALUE instead of the file's; repeatable", REPEATABLE, NULL},
    {"to", 0, "NAME", "export", "csv or netcdf", REQUIRED, NULL},
    {"executor", 0, "NAME", "run",
     "distribute a study over the processes that this model connects, such as mpi", OPTIONAL, NULL},
    {"with", 0, "NAME=VALUE", "run", "a parameter of the --executor model; repeatable", REPEATABLE,
     NULL},
    {"output", 'o', "DIR", "run plan fit",
     "write the results to DIR (default: results/<name of the file>)", OPTIONAL, set_directory},
    {"output", 'o', "FILE", "report", "write the page to FILE (default: DIR/report.html)", OPTIONAL,
     set_directory},
    {"output", 'o', "NAME", "compare", "write a page NAME.html and a table NAME.csv", OPTIONAL,
     set_directory},
    {"output", 'o', "PATH", "export", "write to PATH (default: a file or a directory in DIR)",
     OPTIONAL, set_directory},
    {"template", 0, "FOLDER", "report compare",
     "use the files in this folder instead of those of the same name in share/flankfilm/template",
     OPTIONAL, NULL},
    {"best", 0, "OUTPUT=WORD", "report",
     "for a sweep over several axes: report where this output is least or largest; repeatable",
     REPEATABLE, NULL},
    {"output", 'o', "DIR", "new", "write to this folder (default: NAME)", OPTIONAL, set_directory},
    {"jobs", 'j', "N", "run plan", "worker processes of a study (default: all cores)", OPTIONAL,
     set_jobs},
    {"shard", 0, "I/N", "run plan",
     "for a study: run case I and every N-th after it (default: set by Slurm)", OPTIONAL,
     set_shard},
    {"rerun", 0, "failed|all", "run plan", "for a study: run failed cases again, or all cases",
     OPTIONAL, set_rerun},
    {"fail-fast", 0, NULL, "run", "stop a study when a case fails", OPTIONAL, NULL},
    {"strict", 0, NULL, "run check",
     "treat as failures: doubtful answers, limits that are not surely met, and warnings; the exit "
     "code is 1, for a study 4, for check 2",
     OPTIONAL, NULL},
    {"all", 0, NULL, "run",
     "for a single case: print everything that was computed, not only the requested outputs",
     OPTIONAL, NULL},
    {"replace", 0, NULL, "run", "replace results of another file in the directory", OPTIONAL, NULL},
    {"json", 0, NULL, "run plan check explain fit models report compare export verify",
     "print one JSON object, all values in SI, and nothing else", OPTIONAL, NULL},
    {"arrays", 0, NULL, "run",
     "with --json, for a single case: also print arrays of more than 10000 numbers", OPTIONAL,
     NULL},
    {"yaml", 0, NULL, "explain",
     "print one file that includes all included files and --set, with the origin of each value",
     OPTIONAL, NULL},
    {"drawing", 0, NULL, "explain",
     "print the table of a drawing of the gears: diameters, spans, pins, backlash", OPTIONAL, NULL},
    {"markdown", 0, NULL, "models", "print it as Markdown", OPTIONAL, NULL},
    {"plugin-path", 0, "DIR", "run plan check explain cite fit models report export new schema",
     "search this directory for models first; repeatable", REPEATABLE, NULL},
    {"help", 'h', NULL, NULL, "print this", OPTIONAL, NULL},
};
enum {
    ROWS = sizeof rows / sizeof rows[0],
    FIRST_CODE = 256 /* option codes, above all letters */
};

/* Whether the word is in a list whose words are separated by blanks. */
static bool holds(const char *words, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = words; (at = strstr(at, word)); at += length)
        if ((at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length]))
            return true;
    return false;
}

static bool accepts(const cli_command *command, const option_row *row)
{
    return !row->commands || holds(row->commands, command->name);
}

/* Returns the first row of the option, whose index identifies it for all commands. */
static size_t find_option(const char *name)
{
    for (size_t i = 0; i < ROWS; i++)
        if (!strcmp(rows[i].name, name))
            return i;
    abort(); /* the caller's mistake: no such option in the table */
}

const char *cli_option(const cli_options *options, const char *name)
{
    cli_words all = cli_option_words(options, name);
    return all.count ? all.words[all.count - 1] : NULL;
}

cli_words cli_option_words(const cli_options *options, const char *name)
{
    return options->given[find_option(name)];
}

/* Prints an option in usage: " [-o DIR]". */
static void print_option(const option_row *row, FILE *out)
{
    fputs(row->occurrence == REQUIRED ? " " : " [", out);
    if (row->letter)
        fprintf(out, "-%c", row->letter);
    else
        fprintf(out, "--%s", row->name);
    fprintf(out, "%s%s", row->argument ? " " : "", row->argument ? row->argument : "");
    fputs(row->occurrence == REQUIRED ? "" : row->occurrence == REPEATABLE ? "]..." : "]", out);
}

void cli_print_usage(const cli_command *command, FILE *out)
{
    fprintf(out, "usage: flankfilm %s %s", command ? command->name : "COMMAND",
            command ? command->operand : "...");
    for (size_t i = 0; command && i < ROWS; i++)
        if (rows[i].commands && accepts(command, &rows[i]))
            print_option(&rows[i], out);
}

void cli_print_options(const cli_command *command)
{
    enum { WIDTH = 26 };
    for (const option_row *row = rows; row < rows + ROWS; row++) {
        if (!accepts(command, row))
            continue;
        int column = row->letter ? printf("  -%c, --%s", row->letter, row->name)
                                 : printf("  --%s", row->name);
        if (row->argument)
            column += printf(" %s", row->argument);
        printf("%*s %s\n", column < WIDTH ? WIDTH - column : 0, "", row->text);
    }
}

bool cli_wrong_usage(const cli_options *options, const char *format, ...)
{
    char *sentence = NULL, *usage = NULL;
    size_t length;
    va_list args;
    va_start(args, format);
    memory_require(vasprintf(&sentence, format, args) < 0 ? NULL : sentence);
    va_end(args);
    FILE *stream = memory_require(open_memstream(&usage, &length));
    cli_print_usage(options->command, stream);
    fclose(stream);
    if (options->json) {
        ff_report *report = ff_report_new();
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, usage, "%s", sentence);
        results_json_print(results_json_answer("error", FF_FAULT_INPUT, report));
        ff_report_free(report);
    } else {
        fprintf(stderr, "flankfilm: %s\n%s\n", sentence, usage);
    }
    free(sentence);
    free(usage);
    return false;
}

static bool set_jobs(cli_options *options, const char *argument)
{
    enum { MOST = 4096 };
    int64_t jobs = 0;
    char why[160];
    bool good = ff_integer_parse(argument, &jobs, why, sizeof why) && jobs >= 1 && jobs <= MOST;
    options->jobs = good ? (size_t)jobs : 0;
    return good || cli_wrong_usage(options, "-j needs a whole number from 1 to %d, not \"%s\"",
                                   MOST, argument);
}

static bool set_directory(cli_options *options, const char *argument)
{
    options->directory = argument;
    return *argument || cli_wrong_usage(options, "-o needs the name of a file or directory");
}

/* Reads the part of a study: "2/8" is the second of eight. */
static bool set_shard(cli_options *options, const char *argument)
{
    char rest;
    return (strspn(argument, "0123456789/") == strlen(argument) &&
            sscanf(argument, "%6zu/%6zu%c", &options->shard, &options->shards, &rest) == 2 &&
            options->shard >= 1 && options->shard <= options->shards) ||
           cli_wrong_usage(options, "--shard needs I/N with I from 1 to N, not \"%s\"", argument);
}

static bool set_rerun(cli_options *options, const char *argument)
{
    options->rerun_failed = !strcmp(argument, "failed");
    options->rerun_all = !strcmp(argument, "all");
    return options->rerun_failed || options->rerun_all ||
           cli_wrong_usage(options, "--rerun needs failed or all, not \"%s\"", argument);
}

static bool take_operand(cli_options *options, const char *text)
{
    bool two = strchr(options->command->operand, ' ') != NULL;
    if (!options->operand)
        options->operand = text;
    else if (two && !options->second)
        options->second = text;
    else if (two && strstr(options->command->operand, "...")) {
        cli_words *more = &options->further;
        more->words = memory_resize(more->words, (more->count + 1) * sizeof *more->words);
        more->words[more->count++] = text;
    } else
        return cli_wrong_usage(options, "%s takes one %s, but got \"%s\" as well",
                               options->command->name, options->command->operand, text);
    return true;
}

/* Takes an option with its argument; `index` is that of the option's first row. */
static bool take_option(cli_options *options, size_t index, const char *argument)
{
    const char *name = rows[index].name;
    cli_words *given = &options->given[index];
    const option_row *row = rows + index;
    while (row < rows + ROWS && (strcmp(row->name, name) != 0 || !accepts(options->command, row)))
        row++;
    if (row == rows + ROWS)
        return cli_wrong_usage(options, "%s has no option --%s", options->command->name, name);
    given->words = memory_resize(given->words, (given->count + 1) * sizeof *given->words);
    given->words[given->count++] = argument ? argument : "";
    return !row->set || row->set(options, argument);
}

/* Refuses an option. `code` is the option's code if it was given a value but takes none, an
 * unknown letter, or 0 for the unknown long option in `word`. */
static bool refuse_unknown(const cli_options *options, const char *word, int code)
{
    const char *names[ROWS];
    char name[64];
    if (code >= FIRST_CODE)
        return cli_wrong_usage(options, "the option --%s takes no value",
                               rows[code - FIRST_CODE].name);
    if (code)
        return cli_wrong_usage(options, "unknown option -%c", code);
    for (size_t i = 0; i < ROWS; i++)
        names[i] = rows[i].name;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    const char *near = ff_nearest(name, names, ROWS);
    return cli_wrong_usage(options, "unknown option --%s%s%s%s", name,
                           near ? "; did you mean --" : "", near ? near : "", near ? "?" : "");
}

/* Refuses a command without its operands or its required options. */
static bool check_missing(const cli_options *options)
{
    const cli_command *command = options->command;
    bool two = strchr(command->operand, ' ') != NULL;
    if ((!options->operand || (two && !options->second)) && command->operand[0] != '[')
        return cli_wrong_usage(options, "%s needs %s%s", command->name,
                               strstr(command->operand, "...") ? "" : "a ", command->operand);
    for (const option_row *row = rows; row < rows + ROWS; row++)
        if (row->occurrence == REQUIRED && accepts(command, row) && !cli_option(options, row->name))
            return cli_wrong_usage(options, "%s needs --%s %s", command->name, row->name,
                                   row->argument);
    return true;
}

static bool check_plugin_paths(const cli_options *options)
{
    struct stat status;
    for (size_t i = 0; i < options->plugin_path_count; i++)
        if (stat(options->plugin_paths[i], &status) != 0 || !S_ISDIR(status.st_mode))
            return cli_wrong_usage(options, "--plugin-path: no directory %s",
                                   options->plugin_paths[i]);
    return true;
}

bool cli_options_parse(cli_options *options, int argc, char **argv)
{
    struct option table[ROWS + 1] = {{0}};
    char letters[3 * ROWS] = "-:"; /* '-' makes getopt return operands in order, as option 1 */
    bool good = true;
    int code;
    for (size_t i = 0; i < ROWS; i++) {
        const option_row *row = &rows[i];
        table[i] = (struct option){row->name, row->argument ? required_argument : no_argument, NULL,
                                   FIRST_CODE + (int)find_option(row->name)};
        if (row->letter)
            snprintf(letters + strlen(letters), 3, "%c%s", row->letter, row->argument ? ":" : "");
    }
    options->given = memory_alloc(ROWS * sizeof *options->given);
    opterr = 0;
    while (good && (code = getopt_long(argc, argv, letters, table, NULL)) != -1) {
        for (size_t i = 0; i < ROWS; i++)
            if (rows[i].letter && code == rows[i].letter)
                code = FIRST_CODE + (int)find_option(rows[i].name);
        if (code == 1)
            good = take_operand(options, optarg);
        else if (code == '?')
            good = refuse_unknown(options, argv[optind - 1], optopt);
        else if (code == ':')
            good = cli_wrong_usage(options, "the option %s needs a value", argv[optind - 1]);
        else
            good = take_option(options, (size_t)(code - FIRST_CODE), optarg);
    }
    for (; good && optind < argc; optind++)
        good = take_operand(options, argv[optind]);
    if (!good)
        return false;
    options->sets = cli_option_words(options, "set").words;
    options->set_count = cli_option_words(options, "set").count;
    options->plugin_paths = cli_option_words(options, "plugin-path").words;
    options->plugin_path_count = cli_option_words(options, "plugin-path").count;
    return cli_option(options, "help") || (check_plugin_paths(options) && check_missing(options));
}

void cli_options_free(cli_options *options)
{
    for (size_t i = 0; options->given && i < ROWS; i++)
        free(options->given[i].words);
    free(options->given);
    free(options->further.words);
}
