/* SPDX-License-Identifier: GPL-3.0-or-later */
/* models: the list, and the manual page that a model's tables make. */
#include "cli-harness.h"

#include <stddef.h>
#include <string.h>

static void test_list(void)
{
    outcome r = cli("$F models");
    cli_expect("list", &r,
               r.code == 0 && cli_has(r.out, "toy\n") && cli_has(r.out, "toy/sum") &&
                   cli_has(r.out, "adds up a series"));
    r = cli("$F models toy");
    cli_expect("list of one kind", &r,
               r.code == 0 && strncmp(r.out, "toy\n  toy/sum", 13) == 0 &&
                   cli_has(r.out, "toy/wave"));
    r = cli("$F models toy --json");
    cli_expect("list as JSON", &r,
               r.code == 0 && strcmp(cli_text_at(r.json, "models/0/id"), "toy/sum") == 0 &&
                   cli_has(cli_text_at(r.json, "models/0/file"), "sum.so"));
}

static void test_page(void)
{
    static const char *const parts[] = {
        "toy/wave 1.2.3",
        "amplitude",
        "number in mm, required; above 0 to 10",
        "calibrated from",
        "one of good, doubtful, bad",
        "preset 8",
        "half the height of the wave",
        "m over t x",
        "Nobody 1900",
        "GPL-3.0-or-later",
        "wave.so",
        "1 to 3 numbers",
        "columns of its table",
        "mm, required; from 0 to 40",
        "of the water below",
    };
    outcome r = cli("$F models toy/wave");
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        cli_expect(parts[i], &r, r.code == 0 && cli_has(r.out, parts[i]));
    r = cli("$F models toy/sum");
    cli_expect("inputs", &r,
               r.code == 0 && cli_has(r.out, "wave.height") && cli_has(r.out, "from toy"));
    r = cli("$F models toy/wave --json");
    cli_expect("page as JSON", &r,
               r.code == 0 && strcmp(cli_text_at(r.json, "parameters/0/unit"), "mm") == 0 &&
                   json_is_true(cli_at(r.json, "parameters/0/required")) &&
                   json_number_value(cli_at(r.json, "parameters/0/limits/1")) == 10 &&
                   strcmp(cli_text_at(r.json, "outputs/4/dims"), "t x") == 0 &&
                   strcmp(cli_text_at(r.json, "columns/0/name"), "depth") == 0 &&
                   cli_has(cli_text_at(r.json, "bibtex"), "nobody1900"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_list();
    test_page();
    return cli_close();
}
