/* SPDX-License-Identifier: GPL-3.0-or-later */
/* flankfilm: how the vibration of a spur gear pair changes the oil film between its teeth. */
#include "command.h"
#include "json.h"

#include "../plugin/guard.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const ff_command commands[] = {
    {"run", "FILE", "sojJp", "run the pipeline of a YAML file and write its results",
     "Runs the stages that the requested outputs need, prints a summary and writes the results:\n"
     "result.json, one CSV per stage, and one per field. A directory that holds anything but\n"
     "results of flankfilm is refused. With --json nothing is written unless -o is given.\n",
     ff_run},
    {"check", "FILE", "sJp", "say all that is wrong with a YAML file, and run nothing",
     "Reads the file and loads every model that it names, also those that no output needs.\n",
     ff_check},
    {"explain", "FILE", "sJp", "say which stages would run and why, with every parameter's origin",
     "Shows the stages in the order in which they run, the values in use, where each was given,\n"
     "and which stage feeds which. Stages that no requested output needs are not loaded.\n",
     ff_explain},
    {"models", "[ID]", "Jp", "list the models, or describe one",
     "ID is kind/name, such as viscosity/barus: its parameters, inputs, outputs and literature.\n"
     "A kind alone lists the models of that kind.\n",
     ff_models},
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static void print_overview(FILE *stream)
{
    fprintf(stream,
            "flankfilm predicts how the vibration of a spur gear pair changes the oil film\n"
            "between its teeth.\n\nusage: flankfilm COMMAND ...\n\n");
    for (size_t i = 0; i < COMMANDS; i++) {
        char left[32];
        snprintf(left, sizeof left, "%s %s", commands[i].name, commands[i].operand);
        fprintf(stream, "  %-16s %s\n", left, commands[i].summary);
    }
    fprintf(stream, "  %-16s %s\n", "help COMMAND", "say more about a command");
    fprintf(stream, "\n  --version, --help\n\n"
                    "exit codes: 0 all well, 1 the run failed, 2 the input is wrong, "
                    "3 a plugin is at fault\n");
}

static void print_help(const ff_command *command)
{
    char usage[256];
    ff_options_usage(command, usage, sizeof usage);
    printf("usage: %s\n\n%c%s.\n%s\noptions:\n", usage, toupper(command->summary[0]),
           command->summary + 1, command->text);
    ff_options_describe(command, stdout);
}

/* One sentence about wrong usage, and the usage line. */
__attribute__((format(printf, 3, 4))) static int wrong_usage(bool json, const ff_command *command,
                                                             const char *format, ...)
{
    char sentence[512], usage[256] = "flankfilm COMMAND ...";
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    if (command)
        ff_options_usage(command, usage, sizeof usage);
    if (json) {
        char hint[300];
        snprintf(hint, sizeof hint, "usage: %s", usage);
        ff_report *report = ff_report_new();
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, hint, "%s", sentence);
        ff_json_refuse(report);
        ff_report_free(report);
    } else {
        fprintf(stderr, "flankfilm: %s\nusage: %s\n", sentence, usage);
    }
    return FF_EXIT_INPUT;
}

static const ff_command *find_command(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i].name, name) == 0)
            return &commands[i];
    return NULL;
}

static int unknown_command(bool json, const char *word)
{
    const char *names[COMMANDS + 1];
    for (size_t i = 0; i < COMMANDS; i++)
        names[i] = commands[i].name;
    names[COMMANDS] = "help";
    const char *near = ff_nearest(word, names, COMMANDS + 1);
    const char *what = word[0] == '-' ? "option" : "command";
    if (near && word[0] != '-')
        return wrong_usage(json, NULL, "unknown command \"%s\"; did you mean \"%s\"?", word, near);
    return wrong_usage(json, NULL, "unknown %s \"%s\"; flankfilm --help lists the commands", what,
                       word);
}

static int help(bool json, int argc, char **argv)
{
    if (argc > 2)
        return wrong_usage(json, NULL, "help takes one command");
    if (argc < 2) {
        print_overview(stdout);
        return FF_EXIT_OK;
    }
    const ff_command *command = find_command(argv[1]);
    if (!command)
        return unknown_command(json, argv[1]);
    print_help(command);
    return FF_EXIT_OK;
}

static int execute(bool json, const ff_command *command, int argc, char **argv)
{
    ff_options options;
    char why[512];
    int code = FF_EXIT_OK;
    if (!ff_options_parse(&options, command, argc, argv, why, sizeof why)) {
        code = wrong_usage(json, command, "%s", why);
    } else if (options.help) {
        print_help(command);
    } else {
        ff_guard_install(options.json);
        code = command->run(&options);
    }
    ff_options_free(&options);
    return code;
}

static bool asks_for_json(int argc, char **argv)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--json") == 0)
            return true;
    return false;
}

static int dispatch(int argc, char **argv)
{
    bool json = asks_for_json(argc, argv);
    const char *word = argc > 1 ? argv[1] : NULL;
    if (!word)
        return wrong_usage(json, NULL, "a command is missing; flankfilm --help lists them");
    if (strcmp(word, "--version") == 0) {
        printf("flankfilm %s\n", FF_VERSION);
        return FF_EXIT_OK;
    }
    if (strcmp(word, "help") == 0 || strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0)
        return help(json, argc - 1, argv + 1);
    const ff_command *command = find_command(word);
    return command ? execute(json, command, argc - 1, argv + 1) : unknown_command(json, word);
}

/* A closed standard stream would give its number to the next file that is opened. Writing to the
   stand-in fails, as it should. */
static void hold_standard_streams(void)
{
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", O_RDONLY) != fd)
            _exit(FF_EXIT_FAILED);
}

/* Output that could not be written makes the run fail, whatever else went well. */
static int close_output(int code)
{
    bool lost = ferror(stdout) != 0;
    errno = 0;
    if (fclose(stdout) == 0 && !lost)
        return code;
    fprintf(stderr, "flankfilm: the output could not be written%s%s\n", errno ? ": " : "",
            errno ? strerror(errno) : "");
    return FF_EXIT_FAILED;
}

int main(int argc, char **argv)
{
    hold_standard_streams();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe shows as a write error */
    return close_output(dispatch(argc, argv));
}
