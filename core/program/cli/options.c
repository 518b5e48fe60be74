/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command.h"

#include "../../engine/value/memory.h"

#include <getopt.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_JOBS = 4096 };

static const struct option_row {
    char letter; /* its name in cli_command.accepts */
    const char *name;
    bool has_argument;
    const char *text;
} rows[] = {
    {'l', "law", true, "  --law NAME               fit this law, such as roelands; repeatable"},
    {'A', "at", true,
     "  --at QUANTITY            the data at \"80 degC\"; what the laws say at \"0.6 GPa\""},
    {'P', "pipeline", true,
     "  --pipeline FILE          parameters and inputs: those of the stage of that file that uses "
     "it"},
    {'s', "set", true,
     "  --set PATH=VALUE         use VALUE instead of what the file says; repeatable"},
    {'t', "to", true, "  --to NAME                the writer, such as netcdf"},
    {'x', "executor", true,
     "  --executor NAME          spread a study over the processes that this model joins, such as "
     "mpi"},
    {'w', "with", true, "  --with NAME=VALUE        a parameter of that model; repeatable"},
    {'o', "output", true,
     "  -o, --output DIR         write the results there (default: results/<name of the file>)"},
    {'j', "jobs", true,
     "  -j, --jobs N             worker processes of a study (default: all cores)"},
    {'S', "shard", true,
     "  --shard I/N              of a study, run case I and every N-th after it (default: "
     "Slurm's)"},
    {'r', "rerun", true,
     "  --rerun failed|all       of a study, also run cases again that failed, or all"},
    {'f', "fail-fast", false,
     "  --fail-fast              end a study at the first case that fails"},
    {'J', "json", false,
     "  --json                   print one JSON object, all values in SI, and nothing else"},
    {'M', "markdown", false, "  --markdown               print it as a page in Markdown"},
    {'p', "plugin-path", true,
     "  --plugin-path DIR        look for models there first; repeatable"},
    {'h', "help", false, "  -h, --help               print this"},
};
enum { ROWS = sizeof rows / sizeof rows[0] };

static bool accepts(const cli_command *command, int letter)
{
    return letter == 'h' || strchr(command->accepts, letter);
}

void cli_options_describe(const cli_command *command)
{
    for (size_t i = 0; i < ROWS; i++)
        if (accepts(command, rows[i].letter))
            puts(rows[i].text);
}

static bool take_count(const cli_options *options, size_t *count, const char *option, int most,
                       const char *text)
{
    int64_t value = 0;
    char why[160];
    bool good = fe_integer_parse(text, &value, why, sizeof why) && value >= 1 && value <= most;
    *count = good ? (size_t)value : 0;
    return good || cli_wrong_usage(options, "%s wants a whole number from 1 to %d, not \"%s\"",
                                   option, most, text);
}

/* "2/8": the second of eight parts. */
static bool take_shard(cli_options *options, const char *text)
{
    char rest;
    return (strspn(text, "0123456789/") == strlen(text) &&
            sscanf(text, "%6zu/%6zu%c", &options->shard, &options->shards, &rest) == 2 &&
            options->shard >= 1 && options->shard <= options->shards) ||
           cli_wrong_usage(options, "--shard wants I/N with I from 1 to N, not \"%s\"", text);
}

static bool take_rerun(cli_options *options, const char *text)
{
    options->rerun_failed = !strcmp(text, "failed");
    options->rerun_all = !strcmp(text, "all");
    return options->rerun_failed || options->rerun_all ||
           cli_wrong_usage(options, "--rerun wants failed or all, not \"%s\"", text);
}

static bool take_operand(cli_options *options, const char *text)
{
    bool two = strchr(options->command->operand, ' ') != NULL;
    if (!options->operand)
        options->operand = text;
    else if (two && !options->second)
        options->second = text;
    else
        return cli_wrong_usage(options, "%s takes one %s, but got \"%s\" as well",
                               options->command->name, options->command->operand, text);
    return true;
}

static bool refuse_unknown(const cli_options *options, const char *word)
{
    const char *names[ROWS];
    char name[64];
    for (size_t i = 0; i < ROWS; i++) {
        names[i] = rows[i].name;
        if (rows[i].letter == optopt && !strncmp(word, "--", 2))
            return cli_wrong_usage(options, "the option --%s takes no value", rows[i].name);
    }
    if (optopt)
        return cli_wrong_usage(options, "unknown option -%c", optopt);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + 2, "="), word + 2);
    const char *near = fe_nearest(name, names, ROWS);
    return cli_wrong_usage(options, "unknown option --%s%s%s%s", name,
                           near ? "; did you mean --" : "", near ? near : "", near ? "?" : "");
}

static bool take(cli_options *options, int letter)
{
    for (size_t i = 0; i < ROWS && !accepts(options->command, letter); i++)
        if (rows[i].letter == letter)
            return cli_wrong_usage(options, "%s takes no option --%s", options->command->name,
                                   rows[i].name);
    if (letter == 's')
        options->sets[options->set_count++] = optarg;
    else if (letter == 'p')
        options->plugin_paths[options->plugin_path_count++] = optarg;
    else if (letter == 'P')
        options->pipeline = optarg;
    else if (letter == 'j')
        return take_count(options, &options->jobs, "-j", MOST_JOBS, optarg);
    else if (letter == 'x')
        options->executor = optarg;
    else if (letter == 't')
        options->to = optarg;
    else if (letter == 'w')
        options->withs[options->with_count++] = optarg;
    else if (letter == 'l')
        options->laws[options->law_count++] = optarg;
    else if (letter == 'A')
        options->ats[options->at_count++] = optarg;
    else if (letter == 'S')
        return take_shard(options, optarg);
    else if (letter == 'r')
        return take_rerun(options, optarg);
    else if (letter == 'f')
        options->fail_fast = true;
    else if (letter == 'M')
        options->markdown = true;
    else if (letter == 'o' && !*optarg)
        return cli_wrong_usage(options, "-o wants the name of a file or directory");
    else if (letter == 'o')
        options->directory = optarg;
    else if (letter == 'h')
        options->help = true;
    return true;
}

bool cli_options_parse(cli_options *options, int argc, char **argv)
{
    struct option table[ROWS + 1] = {{0}};
    bool good = true;
    int letter;
    for (size_t i = 0; i < ROWS; i++)
        table[i] =
            (struct option){rows[i].name, rows[i].has_argument ? required_argument : no_argument,
                            NULL, rows[i].letter};
    options->sets = fe_alloc((size_t)argc * sizeof *options->sets);
    options->plugin_paths = fe_alloc((size_t)argc * sizeof *options->plugin_paths);
    options->withs = fe_alloc((size_t)argc * sizeof *options->withs);
    options->laws = fe_alloc((size_t)argc * sizeof *options->laws);
    options->ats = fe_alloc((size_t)argc * sizeof *options->ats);
    opterr = 0;
    /* Leading '-': operands come in order as option 1, whatever POSIXLY_CORRECT says. */
    while (good && (letter = getopt_long(argc, argv, "-:o:j:h", table, NULL)) != -1) {
        if (letter == 1)
            good = take_operand(options, optarg);
        else if (letter == '?')
            good = refuse_unknown(options, argv[optind - 1]);
        else if (letter == ':')
            good = cli_wrong_usage(options, "the option %s wants a value", argv[optind - 1]);
        else
            good = take(options, letter);
    }
    for (; good && optind < argc; optind++)
        good = take_operand(options, argv[optind]);
    bool two = strchr(options->command->operand, ' ') != NULL;
    bool missing = !options->operand || (two && !options->second);
    if (good && missing && !options->help && options->command->operand[0] != '[')
        good = cli_wrong_usage(options, "%s wants a %s", options->command->name,
                               options->command->operand);
    return good;
}

void cli_options_free(cli_options *options)
{
    free(options->sets);
    free(options->plugin_paths);
    free(options->withs);
    free(options->laws);
    free(options->ats);
}
