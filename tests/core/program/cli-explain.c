/* SPDX-License-Identifier: GPL-3.0-or-later */
/* check and explain: what would run, why, and where every value comes from. */
#include "cli-harness.h"

#include <string.h>

static void test_check(void)
{
    outcome r = cli("$F check pair.yaml");
    cli_expect("check", &r, r.code == 0 && strcmp(r.out, "pair.yaml: ok (3 stages)\n") == 0);
    r = cli("$F check pair.yaml --json");
    cli_expect("check --json", &r,
               r.code == 0 && r.json && json_integer_value(cli_at(r.json, "stages")) == 3);
    cli_write("idle.yaml", "format: 2\npipeline:\n  a: {use: toy/wave, amplitude: 1 mm}\n"
                           "  b: {use: toy/nothing}\noutputs: [a.total]\n");
    r = cli("$F check idle.yaml");
    cli_expect("check looks at idle stages too", &r,
               r.code == 2 && cli_has(r.err, "idle.yaml:4:") && cli_has(r.err, "1 error;"));
    r = cli("$F explain idle.yaml");
    cli_expect("explain does not load them", &r,
               r.code == 0 && cli_has(r.out, "b: toy/nothing") && cli_has(r.out, "not loaded"));
}

static void test_explain(void)
{
    outcome r = cli("$F explain pair.yaml --set wave.count=5");
    cli_expect("count of stages", &r, r.code == 0 && cli_has(r.out, "2 of 3 stages run"));
    cli_expect("origin in the file", &r, cli_has(r.out, "pair.yaml:4"));
    cli_expect("origin --set", &r, cli_has(r.out, "--set"));
    cli_expect("origin preset", &r, cli_has(r.out, "preset"));
    cli_expect("value in the row's unit", &r, cli_has(r.out, "2 mm"));
    cli_expect("idle stage", &r, cli_has(r.out, "idle: toy/wave") && cli_has(r.out, "not loaded"));
    r = cli("$F explain pair.yaml --set wave.count=5 --json");
    cli_expect("one object", &r, r.code == 0 && r.json && !*r.err);
    cli_expect("order of the run", &r, strcmp(cli_text_at(r.json, "stages/0/stage"), "wave") == 0);
    cli_expect("why", &r, *cli_text_at(r.json, "stages/0/why"));
    cli_expect("value in SI", &r,
               json_number_value(cli_at(r.json, "stages/0/parameters/amplitude/value")) == 2e-3);
    cli_expect("origins", &r,
               strcmp(cli_text_at(r.json, "stages/0/parameters/count/origin"), "--set") == 0 &&
                   strcmp(cli_text_at(r.json, "stages/0/parameters/end/origin"), "preset") == 0);
    cli_expect("a list", &r,
               strcmp(cli_text_at(r.json, "stages/0/parameters/factors/text"), "[1, 2]") == 0);
    cli_expect("a wire", &r,
               strcmp(cli_text_at(r.json, "stages/1/wires/wave/stage"), "wave") == 0 &&
                   json_is_false(cli_at(r.json, "stages/1/wires/wave/automatic")));
    r = cli("$F explain pair.yaml --set outputs='[wave.total]' --json");
    size_t running = 0, i;
    json_t *entry;
    json_array_foreach(cli_at(r.json, "stages"), i, entry) running +=
        json_is_true(json_object_get(entry, "runs"));
    cli_expect("only what is needed runs", &r, running == 1);
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_check();
    test_explain();
    return cli_close();
}
