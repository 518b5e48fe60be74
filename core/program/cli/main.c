/* SPDX-License-Identifier: GPL-3.0-or-later */
/* flankfilm: how the vibration of a spur gear pair changes the oil film between its teeth. */
#include "command.h"

#include "../crash/alloc-watch.h"
#include "../crash/crash.h"
#include "../crash/lead.h"
#include "../memory/memory.h"
#include "../results/json.h"
#include "../terminal/answer.h"
#include "../terminal/terminal.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

static const cli_command commands[] = {
    {"run", "FILE", "run the pipeline or the study of a YAML file and write its results",
     "Runs the stages that the requested outputs need, prints these outputs in the order of the\n"
     "file, and writes result.json and a .npy file for each array. Earlier results of the same\n"
     "file are replaced, and files derived from them, such as the page, are removed. Results of\n"
     "another file are kept unless --replace is given; a directory with anything else in it is\n"
     "refused. With --json, results are written only if -o is given. A file with \"study\" has\n"
     "many cases. Each case is saved when it ends; after an interruption the same command\n"
     "continues. table.csv has a row for each case.\n",
     cli_run},
    {"plan", "FILE", "show what running a study would do",
     "Shows what is varied, how many cases are done, and how long the others will take.\n",
     cli_plan_study},
    {"check", "FILE", "report all errors in a YAML file without running it",
     "Reads the file and loads every model that it names, also those that no output needs.\n",
     cli_check},
    {"explain", "FILE", "show which stages would run and why, and where each value comes from",
     "Shows the stages in the order in which they run, the values in use, where each was given,\n"
     "and which stage feeds which. Stages that no requested output needs are not loaded.\n"
     "--yaml prints a file that gives the same results. In it, presets, automatic wires and\n"
     "values that another layer has replaced are comments.\n",
     cli_explain},
    {"cite", "FILE", "print the literature of the models that run, as BibTeX",
     "Prints each entry once, with the models that cite it.\n", cli_cite},
    {"fit", "KIND DATA", "find the parameters of laws from measured data",
     "Fits each law to the table, with 95 % confidence, compares the laws, and writes a card for\n"
     "pipelines, a plot, and a table of the residuals. KIND is what was measured: viscosity.\n"
     "The first line of DATA names the columns: pressure [GPa], viscosity [mPa s].\n",
     cli_fit_command},
    {"models", "[ID]", "list the models, or describe one",
     "ID is kind/name, as in the list; prints its parameters, inputs, outputs and literature.\n"
     "If only a kind is given, its models are listed.\n",
     cli_models},
    {"report", "DIR", "write a page that shows the results of a run or a study",
     "DIR is a directory written by run. The page includes its figures and needs no network. It\n"
     "is written to DIR/report.html unless -o names another file.\n",
     cli_write_report},
    {"compare", "A B...",
     "show the results of several designs side by side, with their differences",
     "Each design is a directory written by run, or DIR:3, case 3 of a study. Differences are\n"
     "relative to the first design and are printed with the errors of both; differences smaller\n"
     "than these errors are marked. Series along the path of contact are drawn over SAP, LPSTC,\n"
     "pitch point, HPSTC and tip.\n",
     cli_compare},
    {"export", "DIR", "write the results of a run or a study for other programs",
     "DIR is a directory written by run. NAME is csv (a directory) or netcdf (one file). Without\n"
     "-o the files are written to DIR. An interrupted export leaves no partial files.\n",
     cli_export},
    {"verify", "FILE.so", "test whether a plugin follows the rules",
     "Runs named tests, each in its own process, and prints the results in TAP. A law is tested\n"
     "with random parameters and inputs. If a stage refuses these, name a file whose pipeline\n"
     "uses it. FLANKFILM_VERIFY_LIMIT: seconds that a test may take (60). Exit code 3: a test\n"
     "failed.\n",
     cli_verify_command},
    {"new", "KIND/NAME", "write a plugin of your own, ready to build",
     "Makes the folder NAME (or DIR) with the source of a working model, its build file, a\n"
     "pipeline that uses it, and a README with the next three commands. The template is\n"
     "<kind>.template.c in a directory of plugins; if the kind has none, a general one for a "
     "stage\n"
     "without inputs.\n",
     cli_new},
    {"schema", "[FILE]", "print the JSON Schema of all models",
     "Editors use it to complete and check YAML files. It is printed, or written to FILE.\n",
     cli_schema},
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static void print_overview(void)
{
    printf("flankfilm predicts how the vibration of a spur gear pair changes the oil film\n"
           "between its teeth.\n\nusage: flankfilm COMMAND ...\n\n");
    for (size_t i = 0; i < COMMANDS; i++)
        printf("  %s %-*s %s\n", commands[i].name, 15 - (int)strlen(commands[i].name),
               commands[i].operand, commands[i].summary);
    printf("  %-16s %s\n", "help COMMAND", "describe a command");
    printf("\n  --version, --help\n\n"
           "exit codes: 0 success, 1 the run failed, 2 the input is wrong, "
           "3 a plugin is at fault,\n            4 cases of a study failed\n");
}

static void print_help(const cli_command *command)
{
    cli_print_usage(command, stdout);
    printf("\n\n%c%s.\n%s\noptions:\n", toupper(command->summary[0]), command->summary + 1,
           command->text);
    cli_print_options(command);
}

static bool find_command(cli_options *options, const char *word)
{
    const char *names[COMMANDS + 1];
    for (size_t i = 0; i < COMMANDS; i++) {
        names[i] = commands[i].name;
        if (!strcmp(names[i], word))
            options->command = &commands[i];
    }
    names[COMMANDS] = "help";
    const char *near = ff_nearest(word, names, COMMANDS + 1);
    if (options->command)
        return true;
    if (near && word[0] != '-')
        return cli_wrong_usage(options, "unknown command \"%s\"; did you mean \"%s\"?", word, near);
    return cli_wrong_usage(options, "unknown %s \"%s\"; flankfilm --help lists the commands",
                           word[0] == '-' ? "option" : "command", word);
}

/* Prints help; argv[1] is the command to describe, if given. */
static int help(cli_options *options, int argc, char **argv)
{
    if (argc > 2 && !cli_wrong_usage(options, "help takes one command"))
        return FF_FAULT_INPUT;
    if (argc == 2 && !find_command(options, argv[1]))
        return FF_FAULT_INPUT;
    if (options->command)
        print_help(options->command);
    else
        print_overview();
    return EXIT_SUCCESS;
}

static int execute(cli_options *options, int argc, char **argv)
{
    int code = EXIT_SUCCESS;
    if (!find_command(options, argv[0]) || !cli_options_parse(options, argc, argv)) {
        code = FF_FAULT_INPUT;
    } else if (cli_option(options, "help")) {
        print_help(options->command);
    } else {
        if (options->json)
            terminal_answer_begin();
        crash_install();
        crash_hunger_watch();
        code = options->command->run(options);
    }
    cli_options_free(options);
    return code;
}

static bool has_json_option(int argc, char **argv)
{
    bool json = false;
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        json = json || !strcmp(argv[i], "--json");
    return json;
}

static int dispatch(int argc, char **argv)
{
    cli_options options = {.command = NULL};
    const char *word = argc > 1 ? argv[1] : NULL;
    options.json = has_json_option(argc, argv);
    if (!word) {
        cli_wrong_usage(&options, "a command is missing; flankfilm --help lists them");
        return FF_FAULT_INPUT;
    }
    if (!strcmp(word, "--version")) {
        printf("flankfilm %s\n", CLI_VERSION);
        return EXIT_SUCCESS;
    }
    if (!strcmp(word, "help") || !strcmp(word, "--help") || !strcmp(word, "-h"))
        return help(&options, argc - 1, argv + 1);
    return execute(&options, argc - 1, argv + 1);
}

/* Opens a read-only file for each standard stream that is closed, since the next opened file would
 * get its number. Writing to it fails, as it should. */
static void hold_standard_streams(void)
{
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", O_RDONLY) != fd)
            _exit(FF_FAULT_RUN);
}

/* Whether nobody reads stdout any more, as after "| head" has ended. */
static bool is_abandoned(void)
{
    struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
    return poll(&out, 1, 0) == 1 && (out.revents & POLLERR);
}

/* Makes the run fail if its output could not be written, whatever else went well. */
static int close_output(int code)
{
    bool abandoned = is_abandoned();
    bool lost = ferror(stdout) != 0;
    errno = 0;
    if (terminal_answer_end() && fclose(stdout) == 0 && !lost)
        return code;
    if (abandoned)
        return FF_FAULT_RUN;
    fprintf(stderr, "flankfilm: the output could not be written%s%s\n", errno ? ": " : "",
            errno ? strerror(errno) : "");
    return FF_FAULT_RUN;
}

typedef struct command_line {
    int argc;
    char **argv;
    int code; /* the exit code */
} command_line;

/* Whether a word of the command line contains a control character, which may move the cursor.
 * YAML checks its values itself. */
static bool has_control(const char *word)
{
    for (const unsigned char *at = (const unsigned char *)word; *at; at++)
        if ((*at < 0x20 && *at != '\n' && *at != '\t') || *at == 0x7F ||
            (*at == 0xC2 && at[1] >= 0x80 && at[1] < 0xA0))
            return true;
    return false;
}

static bool refuse_control(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (!has_control(argv[i]))
            continue;
        char shown[256];
        ff_clean_text(shown, sizeof shown, argv[i]);
        fprintf(stderr,
                "flankfilm: a word contains a control character, such as the first of an escape "
                "sequence: \"%s\"\n",
                shown);
        return true;
    }
    return false;
}

static void dispatch_it(void *ctx)
{
    command_line *line = ctx;
    line->code = dispatch(line->argc, line->argv);
}

/* Reports how the child ended, and ends in the same way. */
static _Noreturn void conclude(const crash_end *end, bool json)
{
    if (end->sentence[0]) {
        ff_report *report = ff_report_new();
        ff_error(report, end->code, FF_NOWHERE, NULL, "%s", end->sentence);
        if (json)
            results_json_print(results_json_answer("error", end->code, report));
        terminal_print_messages(report, stderr, false);
        ff_report_free(report);
        fflush(NULL);
    }
    _exit(end->code);
}

/* The leak report of a sanitizer, if the program is built with one. */
__attribute__((weak)) void __lsan_do_leak_check(void);

int main(int argc, char **argv)
{
    command_line line = {argc, argv, FF_FAULT_RUN};
    crash_end end;
    hold_standard_streams();
    if (refuse_control(argc, argv))
        return FF_FAULT_INPUT;
    signal(SIGPIPE, SIG_IGN); /* so that a closed pipe shows as a write error */
    signal(SIGXFSZ, SIG_IGN); /* so that a limit on the size of files does, too */
    if (crash_lead(&end))
        conclude(&end, has_json_option(argc, argv));
    if (ff_protected(dispatch_it, &line) == FF_NOMEM)
        memory_require(NULL);
    int code = close_output(line.code);
    if (__lsan_do_leak_check)
        __lsan_do_leak_check();
    /* Leaves without the destructors of plugins, which could crash: everything is written. */
    crash_leave(code);
}
