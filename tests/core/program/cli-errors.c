/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whatever goes wrong: the exit code, and with --json one object and nothing else. */
#include "cli-harness.h"

#include <stdio.h>

/* A command line that fails without --json, and again with it. */
static void expect_failure(const char *line, int code, const char *status, const char *part)
{
    char with_json[512];
    outcome r = cli(line);
    cli_expect(line, &r, r.code == code && cli_has(r.err, part));
    snprintf(with_json, sizeof with_json, "%s --json", line);
    r = cli(with_json);
    json_int_t exit_code = json_integer_value(cli_at(r.json, "exit"));
    const json_t *errors = cli_at(r.json, "errors");
    bool said = false;
    for (size_t i = 0; i < json_array_size(errors); i++)
        said = said || cli_has(cli_text_at(json_array_get(errors, i), "message"), part);
    cli_expect(with_json, &r,
               r.code == code && r.json && !*r.err && exit_code == code && said &&
                   cli_has(cli_text_at(r.json, "status"), status) &&
                   json_is_array(cli_at(r.json, "warnings")));
}

static void test_input(void)
{
    cli_write("broken.yaml", "pipeline: {wave: [}\n");
    cli_write("empty.yaml", "");
    cli_write("typo.yaml", "format: 2\npipeline:\n  wave: {use: toy/wave, amplitud: 2 mm}\n");
    cli_write("nomodel.yaml", "format: 2\npipeline:\n  wave: {use: toy/nothing}\n");
    expect_failure("$F check missing.yaml", 2, "error", "missing.yaml");
    expect_failure("$F run broken.yaml", 2, "error", "a value is missing before");
    expect_failure("$F check empty.yaml", 2, "error", "the file is empty");
    expect_failure("$F check typo.yaml", 2, "error", "amplitud");
    expect_failure("$F explain typo.yaml", 2, "error", "amplitud");
    expect_failure("$F run nomodel.yaml", 2, "error", "toy/nothing");
    expect_failure("$F run pair.yaml --set wave.amplitude=2", 2, "error", "amplitude");
    expect_failure("$F run pair.yaml --set wave.amplitude='20 mm'", 2, "error", "amplitude");
    expect_failure("$F run pair.yaml --set nonsense", 2, "error", "needs a \"=\"");
    expect_failure("$F models toy/nothing", 2, "error", "toy/nothing");
    outcome r = cli("$F check typo.yaml --json");
    cli_expect("an error knows its place", &r,
               cli_has(cli_text_at(r.json, "errors/0/file"), "typo.yaml") &&
                   json_integer_value(cli_at(r.json, "errors/0/line")) == 3 &&
                   json_integer_value(cli_at(r.json, "errors/0/column")) > 0);
    cli_write("study.yaml", "format: 2\npipeline:\n  wave: {use: toy/wave, amplitude: 2 mm}\n"
                            "study: {sweep: {}}\n");
    expect_failure("$F run study.yaml", 2, "error", "expected a map from paths to values");
    cli_expect("nothing was written", &r, !cli_exists("results"));
}

/* Values of a sweep are tried by `check`, and errors lie where they are written. */
static void test_sweep(void)
{
    cli_write("sweep.yaml", "format: 2\npipeline:\n  wave: {use: toy/wave, amplitude: 2 mm}\n"
                            "study:\n  sweep:\n    wave.amplitude: [1 mm, 3 kg]\n");
    expect_failure("$F check sweep.yaml", 2, "error", "\"3 kg\" is a mass");
    outcome r = cli("$F check sweep.yaml --json");
    cli_expect("the value's place", &r,
               cli_has(cli_text_at(r.json, "errors/0/file"), "sweep.yaml") &&
                   json_integer_value(cli_at(r.json, "errors/0/line")) == 6 &&
                   json_integer_value(cli_at(r.json, "errors/0/column")) == 28);
    cli_write("sweep.yaml", "format: 2\npipeline:\n  wave: {use: toy/wave, amplitude: 2 mm}\n"
                            "study:\n  sweep:\n    wave.amplitud: [1 mm, 2 mm]\n");
    expect_failure("$F run sweep.yaml", 2, "error", "did you mean \"amplitude\"?");
    r = cli("$F run sweep.yaml --json");
    cli_expect("the path's place", &r,
               json_integer_value(cli_at(r.json, "errors/0/line")) == 6 &&
                   json_integer_value(cli_at(r.json, "errors/0/column")) == 5);
    cli_write("sweep.yaml", "format: 2\npipeline:\n  wave: {use: toy/wave, amplitude: 2 mm}\n"
                            "study:\n  sweep:\n    wave.amplitude: {from: 1 mm, to: 1 km, points: "
                            "100}\n");
    expect_failure("$F check sweep.yaml", 2, "error", "is too large");
}

static void test_plugin(void)
{
    cli_write("plugins/toy/garbage.so", "this is no shared object\n");
    cli_write("garbage.yaml", "format: 2\npipeline:\n  g: {use: toy/garbage}\n");
    expect_failure("$F run garbage.yaml", 3, "error", "garbage.so");
    expect_failure("$F check garbage.yaml", 3, "error", "garbage.so");
    expect_failure("$F models toy/garbage", 3, "error", "garbage.so");
    outcome r = cli("$F models");
    cli_expect("models lists what cannot be loaded", &r,
               r.code == 0 && cli_has(r.out, "toy/garbage") && cli_has(r.out, "cannot be loaded") &&
                   cli_has(r.out, "toy/wave"));
}

/* The guard speaks when the program cannot any more. */
static void test_crash(void)
{
    static const char *const ends[] = {"quit", "crash"};
    for (size_t i = 0; i < 2; i++) {
        char line[128];
        snprintf(line, sizeof line, "$F run pair.yaml --json --set wave.end=%s", ends[i]);
        outcome r = cli(line);
        cli_expect(ends[i], &r,
                   r.code == 3 && r.json && json_integer_value(cli_at(r.json, "exit")) == 3 &&
                       cli_has(cli_text_at(r.json, "errors/0/message"), "wave.so") &&
                       cli_has(r.err, "wave.so"));
    }
}

static void test_numbers(void)
{
    expect_failure("$F run pair.yaml --set wave.end=fail", 1, "failed", "the wave broke at step 3");
    outcome r = cli("$F run pair.yaml --set wave.end=fail --json");
    cli_expect("a failed stage says so", &r,
               cli_has(cli_text_at(r.json, "stages/0/status"), "no convergence"));
    expect_failure("$F run pair.yaml --set wave.end=invalid", 2, "error", "too high for its bed");
    expect_failure("$F run pair.yaml --set wave.end=bad", 1, "failed", "residual");
    r = cli("$F run pair.yaml --set wave.end=bad --json");
    cli_expect("results of a bad run are kept", &r,
               json_is_number(cli_at(r.json, "outputs/sum.sum/value")) &&
                   cli_has(cli_text_at(r.json, "stages/0/quality/residual/verdict"), "bad"));
    r = cli("$F run pair.yaml --set wave.end=doubtful");
    cli_expect("a doubtful run is no failure", &r,
               r.code == 0 && cli_has(r.out, "doubtful, what is left over"));
}

static void test_warnings(void)
{
    outcome r = cli("$F run pair.yaml --set wave.end=noisy --json");
    bool told = false;
    for (size_t i = 0; i < json_array_size(cli_at(r.json, "warnings")); i++)
        told =
            told || cli_has(cli_text_at(json_array_get(cli_at(r.json, "warnings"), i), "message"),
                            "a word of caution");
    cli_expect("a model's warning", &r, r.code == 0 && told && !*r.err);
    cli_expect("a model's remark", &r, cli_has(cli_text_at(r.json, "log/0/text"), "in passing"));
    r = cli("$F run pair.yaml --set wave.end=noisy");
    cli_expect("the same for people", &r,
               r.code == 0 && cli_has(r.err, "a word of caution") && cli_has(r.out, "in passing"));
}

static void test_directory(void)
{
    cli_write("mine.txt", "precious\n");
    expect_failure("$F run pair.yaml -o .", 2, "error", "not results of flankfilm");
    expect_failure("$F run pair.yaml -o mine.txt", 2, "error", "cannot be used");
    expect_failure("$F run pair.yaml -o mine.txt/deeper", 2, "error", "cannot be used");
    expect_failure("$F run pair.yaml -o /proc/nowhere", 2, "error", "cannot be used");
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_input();
    test_sweep();
    test_plugin();
    test_crash();
    test_numbers();
    test_warnings();
    test_directory();
    return cli_close();
}
