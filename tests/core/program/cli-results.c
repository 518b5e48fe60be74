/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run leaves behind: the answer on stdout, and the files of the result directory. */
#include "cli-harness.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static void test_json(void)
{
    outcome r = cli("$F run pair.yaml --json");
    const json_t *height = cli_at(r.json, "outputs/wave.height");
    double sum = json_number_value(cli_at(r.json, "outputs/sum.sum/value")), expected = 0;
    for (int i = 0; i < 8; i++)
        expected += 2e-3 * sin(0.5 * i);
    cli_expect("one object", &r, r.code == 0 && r.json && !*r.err);
    cli_expect("status", &r, strcmp(cli_text_at(r.json, "status"), "ok") == 0);
    cli_expect("title", &r, strcmp(cli_text_at(r.json, "title"), "a pair of toys") == 0);
    cli_expect("version", &r, *cli_text_at(r.json, "flankfilm"));
    cli_expect("scalar in SI", &r, fabs(sum - expected) < 1e-11 * fabs(expected));
    cli_expect("unit", &r, strcmp(cli_text_at(r.json, "outputs/sum.sum/unit"), "m") == 0);
    cli_expect("dims", &r, strcmp(cli_text_at(height, "dims/0"), "t") == 0);
    cli_expect("shape", &r, json_integer_value(cli_at(height, "shape/0")) == 8);
    cli_expect("data", &r,
               json_array_size(cli_at(height, "data")) == 8 &&
                   fabs(json_number_value(cli_at(height, "data/3")) - 2e-3 * sin(1.5)) < 1e-14);
    cli_expect("only what was asked", &r, json_object_size(cli_at(r.json, "outputs")) == 2);
    cli_expect("stages", &r,
               json_array_size(cli_at(r.json, "stages")) == 3 &&
                   json_is_true(cli_at(r.json, "stages/0/ran")) &&
                   json_is_false(cli_at(r.json, "stages/2/ran")) &&
                   strcmp(cli_text_at(r.json, "stages/1/model"), "toy/sum") == 0);
    cli_expect("quality", &r,
               strcmp(cli_text_at(r.json, "stages/0/quality/residual/verdict"), "good") == 0);
    cli_expect("nothing written", &r, !cli_exists("results"));
}

static void test_summary(void)
{
    outcome r = cli("$F run pair.yaml --all");
    cli_expect("summary", &r,
               r.code == 0 && cli_has(r.out, "a pair of toys\n") && cli_has(r.out, "toy/wave") &&
                   cli_has(r.out, "\nsum\n  sum  7.233") && cli_has(r.out, " mm") &&
                   cli_has(r.out, "max at 3 ms (time)") && cli_has(r.out, "  cost ") &&
                   cli_has(r.out, "results in results/pair\n"));
    cli_expect("a line for each output", &r, cli_has(r.out, "with which the work would grow in a"));
    cli_expect("words are not cut", &r, !cli_has(r.out, "...\n") && cli_has(r.out, "something"));
    cli_expect("no colour into a file", &r, !cli_has(r.out, "\033"));
    cli_expect("files", &r,
               cli_exists("results/pair/result.json") &&
                   cli_exists("results/pair/wave.height.npy"));
    outcome hostile = cli("$F run pair.yaml --set title='\"a \\e[31m title\"'");
    cli_expect("no control characters from the file", &hostile,
               hostile.code == 0 && cli_has(hostile.out, "a ?[31m title\n"));
    r = cli("$F run pair.yaml --set wave.count=23");
    cli_expect("a range about 0", &r, cli_has(r.out, "-2 to 1.995 mm"));
    r = cli("$F run pair.yaml --set wave.end=noisy --set outputs='[wave.*, wave.field]'");
    size_t longest = 0;
    for (const char *at = r.out; *at; at += strcspn(at, "\n") + 1) {
        if (strcspn(at, "\n") > longest)
            longest = strcspn(at, "\n");
        if (!at[strcspn(at, "\n")])
            break;
    }
    cli_expect("at most 100 columns", &r, longest <= 100);
}

/* What the file asks for is printed in its order, and nothing else. */
static void test_answer(void)
{
    outcome r =
        cli("$F run pair.yaml --set outputs='[sum.sum, wave.level, wave.total, wave.field]'");
    const char *sum = strstr(r.out, "  sum.sum "), *level = strstr(r.out, "  wave.level ");
    const char *total = strstr(r.out, "  wave.total ");
    cli_expect("in the file's order", &r, sum && level && total && sum < level && level < total);
    cli_expect("a field is in the results", &r,
               cli_has(r.out, "only in the results: wave.field\n"));
    cli_expect("no stage, and no number besides", &r,
               !cli_has(r.out, "toy/wave") && !cli_has(r.out, "  cost ") &&
                   cli_has(r.out, "--all prints everything that was computed"));
    r = cli("$F run pair.yaml --json --set outputs='[sum.sum, wave.level, wave.total]'");
    cli_expect("in JSON, too", &r,
               r.json && strstr(r.out, "\"sum.sum\"") < strstr(r.out, "\"wave.level\"") &&
                   strstr(r.out, "\"wave.level\"") < strstr(r.out, "\"wave.total\""));
}

static void test_files(void)
{
    outcome r = cli("$F run pair.yaml -o deep/er --set outputs='[wave.field, wave.level]' "
                    "--set wave.count=3 && ls -A deep/er");
    cli_expect("exactly these files", &r,
               cli_has(r.out, ".flankfilm\nresult.json\nwave.field.npy\nwave.level.npy\n"
                              "wave.time.npy\nwave.x.npy\n"));
    r = cli("$F export deep/er --to csv -o tables && cat tables/wave-point.csv");
    cli_expect("series", &r, cli_has(r.out, "wave.level [1]\n1,0,0\n1,1,1\n"));
    r = cli("cat deep/er/result.json");
    cli_expect("result.json", &r,
               r.json && !cli_at(r.json, "outputs/wave.field/data") &&
                   strcmp(cli_text_at(r.json, "outputs/wave.field/file"), "wave.field.npy") == 0 &&
                   json_integer_value(cli_at(r.json, "outputs/wave.field/shape/1")) == 4 &&
                   !strcmp(cli_text_at(r.json, "computed/wave.x/file"), "wave.x.npy") &&
                   !cli_at(r.json, "computed/wave.height"));
    cli_expect("scalars on the way", &r,
               fabs(json_number_value(cli_at(r.json, "computed/wave.total/value")) -
                    0.002641793047) < 1e-12);
    cli_expect("what a next run looks at stands first", &r,
               !strncmp(r.out, "{\"format\":1,\"key\":\"", 19));
    cli_expect(
        "parameters with origin", &r,
        strcmp(cli_text_at(r.json, "stages/0/parameters/count/origin"), "--set") == 0 &&
            cli_has(cli_text_at(r.json, "stages/0/parameters/amplitude/origin"), "pair.yaml:4") &&
            strcmp(cli_text_at(r.json, "stages/0/parameters/amplitude/text"), "2 mm") == 0);
}

/* Arrays of more than 10000 numbers stand in no text. */
static void test_long(void)
{
    const char *args = "run pair.yaml --json --set wave.count=10001 --set "
                       "outputs=wave.height";
    char line[400];
    snprintf(line, sizeof line, "$F %s -o long", args);
    outcome r = cli(line);
    cli_expect("a long series is named", &r,
               r.json && !cli_at(r.json, "outputs/wave.height/data") &&
                   !strcmp(cli_text_at(r.json, "outputs/wave.height/file"), "wave.height.npy") &&
                   !strcmp(cli_text_at(r.json, "directory"), "long") && strlen(r.out) < 20000);
    r = cli("wc -c <long/wave.height.npy; wc -c <long/wave.time.npy; cat long/result.json | wc -c");
    cli_expect("but in a file, asked for or not", &r, cli_has(r.out, "80136\n80136\n"));
    snprintf(line, sizeof line, "$F %s", args);
    r = cli(line);
    cli_expect("no file without a directory", &r,
               r.json && json_is_null(cli_at(r.json, "outputs/wave.height/file")) &&
                   json_is_null(cli_at(r.json, "directory")));
    snprintf(line, sizeof line, "$F %s --arrays", args);
    r = cli(line);
    cli_expect("--arrays", &r,
               json_array_size(cli_at(r.json, "outputs/wave.height/data")) == 10001);
    r = cli("$F run pair.yaml --json --set wave.count=10000 --set outputs=wave.height");
    cli_expect("10000 numbers are printed", &r,
               json_array_size(cli_at(r.json, "outputs/wave.height/data")) == 10000);
}

static void test_again(void)
{
    outcome r = cli("$F run pair.yaml -o again --set outputs='[wave.field]' && "
                    "echo note >again/note.txt && $F run pair.yaml -o again");
    cli_expect("a directory of ours is used again", &r, r.code == 0);
    cli_expect("nothing of the earlier run is left", &r, !cli_exists("again/wave.field.npy"));
    cli_expect("what is not ours stays", &r, cli_exists("again/note.txt"));
    r = cli("$F run pair.yaml -o again --set wave.end=fail");
    cli_expect("a failed run says so in its directory", &r,
               r.code == 1 && cli_has(cli_read("again/result.json"), "\"status\":\"failed\""));
    r = cli("mkdir empty && $F run pair.yaml -o empty");
    cli_expect("an empty directory is taken", &r, r.code == 0 && cli_exists("empty/result.json"));
    r = cli("mkdir foreign && echo x >foreign/x && $F run pair.yaml -o foreign");
    cli_expect("a foreign directory is refused", &r, r.code == 2);
    r = cli("ls -A foreign");
    cli_expect("and left as it was", &r, strcmp(r.out, "x\n") == 0);
    r = cli("$F run pair.yaml --json -o both");
    cli_expect("--json with -o does both", &r, r.json && cli_exists("both/result.json"));
}

/* The limit of a file's size stands for a full disk. */
static void test_full_disk(void)
{
    outcome r = cli("$F run pair.yaml -o full && cp full/result.json before && "
                    "(trap '' XFSZ; ulimit -f 8; $F run pair.yaml -o full "
                    "--set outputs='[wave.field]' --set wave.count=100)");
    cli_expect("a file that cannot be written", &r,
               r.code == 1 && cli_has(r.err, "could not be written: File too large"));
    r = cli("cmp before full/result.json && ls full/*.part");
    cli_expect("the earlier results are in place", &r, !*r.out && cli_has(r.err, "No such file"));
}

static void test_in_use(void)
{
    outcome r = cli("$F run pair.yaml -o used --set wave.work='1 s' >/dev/null & "
                    "until [ -e used/.flankfilm ]; do sleep 0.01; done; "
                    "$F run pair.yaml -o used; echo $?; wait");
    cli_expect("two runs do not mix", &r,
               strcmp(r.out, "2\n") == 0 && cli_has(r.err, "another run"));
}

/* The code of a plugin is the file, as long as it runs. */
static void test_written_over(void)
{
    cli("cp -rL $FLANKFILM_PLUGIN_PATH own");
    outcome r = cli("FLANKFILM_PLUGIN_PATH=own; $F run pair.yaml --set wave.work='0.6 s' & "
                    "sleep 0.3; cp own/toy/wave.so new && mv new own/toy/wave.so; wait $!");
    cli_expect("a file in its place does no harm", &r, r.code == 0);
    r = cli("FLANKFILM_PLUGIN_PATH=own; $F run pair.yaml --set wave.work='0.6 s' & "
            "sleep 0.3; touch own/toy/wave.so; wait $!");
    cli_expect("nor the same bytes", &r, r.code == 0);
    r = cli("FLANKFILM_PLUGIN_PATH=own; $F run pair.yaml --set wave.work='0.6 s' & "
            "sleep 0.3; printf x >>own/toy/wave.so; wait $!");
    cli_expect("other bytes are told at the end", &r,
               r.code == 3 && cli_has(r.err, "wave: the plugin") &&
                   cli_has(r.err, "wave.so was overwritten while it was in use, so"));
    r = cli("cp -rL $FLANKFILM_PLUGIN_PATH gone; FLANKFILM_PLUGIN_PATH=gone; "
            "$F run pair.yaml --set wave.work='5 s' & sleep 0.3; : >gone/toy/wave.so; wait $!");
    cli_expect("a fault over it is told, too", &r,
               r.code == 3 && cli_has(r.err, "crashed during evaluate: its file was overwritten"));
}

/* As batch systems and debuggers do with a process that they look at. */
static void test_stopped_from_outside(void)
{
    outcome r = cli("$F run pair.yaml --set wave.work='0.6 s' -o slept & leader=$!; sleep 0.3; "
                    "child=$(pgrep -P $leader); kill -STOP $child; sleep 0.8; kill -CONT $child; "
                    "wait $leader");
    cli_expect("it goes on", &r, r.code == 0 && cli_exists("slept/result.json"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_json();
    test_summary();
    test_answer();
    test_files();
    test_long();
    test_again();
    test_full_disk();
    test_in_use();
    test_written_over();
    test_stopped_from_outside();
    return cli_close();
}
