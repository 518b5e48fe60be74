/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a user is told of what the file says in vain, and of what a swapped model cannot take. */
#include "cli-harness.h"

#include <string.h>

static bool warns(const json_t *answer, const char *part)
{
    const json_t *warnings = cli_at(answer, "warnings"), *entry;
    size_t i;
    json_array_foreach(warnings, i, entry) if (cli_has(cli_text_at(entry, "message"), part) &&
                                               *cli_text_at(entry, "file")) return true;
    return false;
}

static void test_run(void)
{
    static const char idle[] = "one stage does not run, since no requested output needs it";
    cli_write("idle.yaml", "format: 2\npipeline:\n  a: {use: toy/wave, amplitude: 1 mm}\n"
                           "  b: {use: toy/wave, amplitude: 2 mm}\noutputs: [a.total]\n");
    outcome r = cli("$F run idle.yaml -o idle");
    cli_expect("at the end of a run", &r,
               r.code == 0 && cli_has(r.err, "idle.yaml:5:10: warning: ") && cli_has(r.err, idle) &&
                   cli_has(r.err, "b (idle.yaml:4:3)"));
    cli_expect("in its results", &r, cli_has(cli_read("idle/result.json"), idle));
    r = cli("$F run idle.yaml --json");
    cli_expect("in its answer", &r, r.code == 0 && warns(r.json, idle) && !*r.err);
    r = cli("$F check idle.yaml --json");
    cli_expect("in that of check", &r, r.code == 0 && warns(r.json, idle));
    r = cli("$F run idle.yaml --set b.count=4 --json");
    cli_expect("an assignment", &r, warns(r.json, "b.count changes nothing"));
    r = cli("$F run idle.yaml --set outputs='[a.total, b.total]' --json");
    cli_expect("nothing in vain", &r, json_array_size(cli_at(r.json, "warnings")) == 0);
}

static void test_swap(void)
{
    static const char left[] = "toy/wave cannot take values that are written for toy/walk";
    cli_write("walk.yaml", "format: 2\npipeline:\n  a: {use: toy/walk, step: 2 m, with: {toy/wave: "
                           "{amplitude: 1 mm}}}\n");
    outcome r = cli("$F run walk.yaml --set a.use=toy/wave --json");
    cli_expect("a swap", &r,
               r.code == 0 && warns(r.json, left) && warns(r.json, "\"step\" (walk.yaml:3:22)"));
    r = cli("$F run walk.yaml --set a.use=toy/wave --set a.step= --json");
    cli_expect("taken away before", &r,
               r.code == 0 && json_array_size(cli_at(r.json, "warnings")) == 0);
    cli_write("both.yaml", "format: 2\ninclude: walk.yaml\noutputs: [\"a.*\"]\n"
                           "pipeline: {c: {use: toy/walk}}\n"
                           "study: {sweep: {a.use: [toy/walk, toy/wave]}}\n");
    r = cli("$F check both.yaml");
    cli_expect("by a sweep, in a check", &r, r.code == 0 && cli_has(r.err, left));
    r = cli("$F run both.yaml -o both");
    const char *told = strstr(r.err, left);
    cli_expect("and in a run, once", &r,
               r.code == 0 && told && !cli_has(told + 1, left) &&
                   cli_has(r.out, "2 of 2 cases done"));
    const char *idle = strstr(r.err, "c (both.yaml:4:12)");
    cli_expect("what all cases have in vain is said once", &r,
               idle && !cli_has(idle + 1, "c (both.yaml:4:12)"));
    r = cli("$F explain walk.yaml --yaml --set a.step=");
    cli_expect("what was taken away", &r, cli_has(r.out, "--set, removed"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_run();
    test_swap();
    return cli_close();
}
