/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands and options: what is understood, and one sentence for what is not. */
#include "cli-harness.h"

#include <stddef.h>
#include <string.h>

static void test_help(void)
{
    outcome r = cli("$F --version");
    cli_expect("--version", &r, r.code == 0 && cli_has(r.out, "flankfilm 0."));
    r = cli("$F --help");
    cli_expect("--help names every command", &r,
               r.code == 0 && cli_has(r.out, "run FILE") && cli_has(r.out, "check FILE") &&
                   cli_has(r.out, "explain FILE") && cli_has(r.out, "models [ID]"));
    outcome same = cli("$F --help >a; $F help >b; cmp a b");
    cli_expect("help equals --help", &same, same.code == 0);
    r = cli("$F help run");
    cli_expect("help of a command", &r,
               r.code == 0 && cli_has(r.out, "usage: flankfilm run FILE") &&
                   cli_has(r.out, "--plugin-path"));
    same = cli("$F help run >a; $F run --help >b; cmp a b");
    cli_expect("help run equals run --help", &same, same.code == 0);
}

/* Each line is wrong in one way; the sentence holds `part`. */
static void test_wrong_usage(void)
{
    static const struct {
        const char *line, *part;
    } cases[] = {
        {"$F", "command is missing"},
        {"$F rnu pair.yaml", "did you mean \"run\"?"},
        {"$F chekc pair.yaml", "did you mean \"check\"?"},
        {"$F report", "report needs a DIR"},
        {"$F export d", "export needs --to NAME"},
        {"$F fit viscosity", "fit needs a KIND DATA"},
        {"$F ''", "unknown command \"\""},
        {"$F --jsno", "unknown option"},
        {"$F help nothing", "unknown command \"nothing\""},
        {"$F run", "run needs a FILE"},
        {"$F run --set a=1", "run needs a FILE"},
        {"$F run a.yaml b.yaml", "\"b.yaml\""},
        {"$F run -- a.yaml b.yaml", "\"b.yaml\""},
        {"$F run pair.yaml --jsno", "did you mean --json?"},
        {"$F run pair.yaml -z", "unknown option -z"},
        {"$F run pair.yaml --json=1", "--json takes no value"},
        {"$F run pair.yaml --set", "needs a value"},
        {"$F run pair.yaml -j 0", "-j needs a whole number"},
        {"$F run pair.yaml -j 1.5", "-j needs a whole number"},
        {"$F run pair.yaml -o ''", "-o needs the name"},
        {"$F check pair.yaml -o d", "check has no option --output"},
        {"$F models --set a=1", "models has no option --set"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        outcome r = cli(cases[i].line);
        cli_expect(cases[i].line, &r,
                   r.code == 2 && !*r.out && cli_has(r.err, cases[i].part) &&
                       cli_has(r.err, "\nusage: flankfilm "));
    }
}

static void test_json_usage(void)
{
    static const char *const lines[] = {
        "$F --json",
        "$F rnu pair.yaml --json",
        "$F run --json",
        "$F run --json --unknown pair.yaml",
        "$F run pair.yaml --unknown --json",
        "$F check a b --json",
        "$F models --json -o d",
        "$F help nothing --json",
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        outcome r = cli(lines[i]);
        cli_expect(lines[i], &r,
                   r.code == 2 && r.json && !*r.err &&
                       cli_has(cli_text_at(r.json, "status"), "error") &&
                       json_integer_value(cli_at(r.json, "exit")) == 2 &&
                       *cli_text_at(r.json, "errors/0/message") &&
                       cli_has(cli_text_at(r.json, "errors/0/hint"), "usage: "));
    }
}

static void test_spellings(void)
{
    static const char *const lines[] = {
        "$F check -- pair.yaml",
        "POSIXLY_CORRECT=1 $F check pair.yaml --set wave.amplitude='3 mm'",
        "$F check --set=wave.amplitude='3 mm' pair.yaml",
        "unset FLANKFILM_PLUGIN_PATH; $F check pair.yaml --plugin-path . --plugin-path plugins",
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        outcome r = cli(lines[i]);
        cli_expect(lines[i], &r, r.code == 0 && cli_has(r.out, "pair.yaml: ok (3 stages)"));
    }
}

static void test_lost_output(void)
{
    static const char *const lines[] = {
        "$F --version >/dev/full",
        "$F --help >/dev/full",
        "$F models >/dev/full",
        "$F check pair.yaml >/dev/full",
        "$F explain pair.yaml >/dev/full",
        "$F run pair.yaml >/dev/full",
        "$F run pair.yaml --json >/dev/full",
        "$F models toy/wave >/dev/full",
        "$F models >&-",
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        outcome r = cli(lines[i]);
        cli_expect(lines[i], &r, r.code == 1 && cli_has(r.err, "output could not be written"));
    }
    outcome r = cli("{ sleep 0.1; $F models; echo code $? >&2; } | true; sleep 0.3");
    cli_expect("a closed pipe", &r, !strcmp(r.err, "code 1\n"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_help();
    test_wrong_usage();
    test_json_usage();
    test_spellings();
    test_lost_output();
    return cli_close();
}
