/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies with the real program: what is run, kept, taken up again, and what failures leave. */
#include "cli-harness.h"

#include <string.h>
#include <unistd.h>

static void write_study(const char *name, const char *wave, const char *study)
{
    char text[2048];
    snprintf(text, sizeof text,
             "format: 2\npipeline:\n  wave: {use: toy/wave, amplitude: 2 mm%s}\n"
             "  sum: {use: toy/sum, wave: wave}\noutputs: [sum.sum]\nstudy: %s\n",
             wave, study);
    cli_write(name, text);
}

static void test_table(void)
{
    write_study("s.yaml", "", "{sweep: {wave.count: [1, 2, 3], wave.amplitude: [1 mm, 2 mm]}}");
    outcome r = cli("$F run s.yaml -j 2");
    cli_expect("runs", &r,
               r.code == 0 && cli_has(r.out, "6 of 6 cases done: ") &&
                   cli_has(r.out, "results/s/table.csv"));
    const char *table = cli_read("results/s/table.csv");
    check_true("head", cli_has(table, "case,key,status,wave.count,wave.amplitude [mm],sum.sum [m],"
                                      "verdict,reasons,reason\n1,"));
    check_true("the last axis is the fastest",
               cli_has(table, ",ok,2,1,0.000479425538604,good,,\n") &&
                   cli_has(table, ",ok,2,2,0.000958851077208,good,,\n6,") == false &&
                   cli_has(table, ",ok,2,2,0.000958851077208,good,,\n5,"));
    r = cli("$F run s.yaml && $F plan s.yaml --json");
    cli_expect("resumes", &r,
               r.code == 0 && cli_has(r.out, "6 of 6 cases done, 6 of them earlier"));
    r = cli("$F plan s.yaml --json");
    cli_expect("plan", &r,
               json_integer_value(cli_at(r.json, "done")) == 6 &&
                   json_integer_value(cli_at(r.json, "left")) == 0);
    r = cli("$F plan s.yaml --set wave.shape=b");
    cli_expect("says what has changed", &r,
               cli_has(r.out, "\nan earlier run did 6 of these with other inputs") &&
                   cli_has(r.out, "\n  wave.shape: not given -> b\n"));
}

static void test_same_physics(void)
{
    write_study("s.yaml", "  # a remark\n  , shape: a",
                "{sweep: {wave.amplitude: [0.1 cm, 2000 um, 3 mm], wave.count: [3, 2, 1]}}");
    outcome r = cli("$F plan s.yaml --json");
    cli_expect("another parameter", &r, json_integer_value(cli_at(r.json, "left")) == 9);
    write_study("s.yaml", "  # a remark\n ",
                "{sweep: {wave.amplitude: [0.1 cm, 2000 um, 3 mm], wave.count: [3, 2, 1]}}");
    r = cli("$F plan s.yaml --json");
    cli_expect("units, order and remarks change nothing", &r,
               json_integer_value(cli_at(r.json, "done")) == 6 &&
                   json_integer_value(cli_at(r.json, "left")) == 3);
    cli("$F run s.yaml");
    check_true(
        "one table for all",
        cli_has(cli_read("results/s/table.csv"), ",wave.amplitude,wave.count,sum.sum [m]") &&
            cli_has(cli_read("results/s/table.csv"), ",ok,0.1 cm,2,0.000479425538604,good,,\n"));
}

static void test_zip_and_use(void)
{
    write_study("z.yaml", "", "{zip: {wave.count: [1, 2], wave.amplitude: [1 mm, 4 mm]}}");
    outcome r = cli("$F run z.yaml && cat results/z/table.csv");
    cli_expect("zip", &r, r.code == 0 && cli_has(r.out, ",ok,2,4,0.00191770215442,good,,\n"));
    write_study("u.yaml", "",
                "{sweep: {wave: [{use: toy/wave, count: 2, amplitude: 1 mm}], "
                "sum.use: [toy/sum, toy/nothing]}}");
    r = cli("$F run u.yaml -j 1; echo $?; cat results/u/table.csv");
    cli_expect(
        "whole stages, and models", &r,
        cli_has(r.out, "\n4\n") && cli_has(r.out, ",toy/sum,0.000479425538604,good,,\n") &&
            cli_has(r.out, ",toy/nothing,,failed,invalid,\"there is no model \"\"toy/nothing\"\""));
}

static void test_series(void)
{
    outcome r = cli("$F run s.yaml --set outputs='[wave.*, wave.field]' -o series; "
                    "LC_ALL=C ls -A series; grep -c '\"log\":' series/journal.jsonl");
    cli_expect("no file for a case", &r,
               cli_has(r.out, "\n.flankfilm-study\narrays.1.log\n") &&
                   cli_has(r.out, "\nstudy.json\ntable.csv\n9\n"));
}

static void test_failures(void)
{
    write_study("f.yaml", ", count: 2",
                "{sweep: {wave.end: [good, fail, invalid, crash, segv, quit, eat, bad, doubtful]}, "
                "memory_limit: 300}");
    outcome r = cli("$F run f.yaml -j 2");
    cli_expect("failed cases", &r, r.code == 4 && cli_has(r.out, "9 of 9 cases done"));
    r = cli("cat results/f/table.csv");
    cli_expect("the good ones are kept", &r,
               cli_has(r.out, ",ok,good,0.000958851077208,") &&
                   cli_has(r.out, ",ok,doubtful,0.000958851077208,"));
    cli_expect(
        "a failure has its reason and no number", &r,
        cli_has(r.out, ",failed,fail,,failed,,wave (toy/wave): the wave broke at step 3\n") &&
            cli_has(r.out,
                    ",invalid,invalid,,failed,invalid,wave.amplitude (toy/wave): the wave is") &&
            cli_has(r.out, ",failed,bad,,bad,residual,\"wave: its result cannot be trusted"));
    cli_expect("a crash, too", &r,
               cli_has(r.out, ",crashed,crash,,failed,crashed,wave: the plugin ") &&
                   cli_has(r.out, "crashed during evaluate: abort\n") &&
                   cli_has(r.out, ",crashed,segv,,failed,crashed,wave: the plugin ") &&
                   cli_has(r.out, "crashed during evaluate: segmentation fault\n") &&
                   cli_has(r.out, ",crashed,quit,,failed,crashed,wave: the plugin "));
#ifdef __SANITIZE_ADDRESS__ /* which ends the process where malloc would answer NULL */
    cli_expect("and hunger", &r, cli_has(r.out, ",crashed,eat,,failed,crashed,"));
#else
    cli_expect("and hunger", &r,
               cli_has(r.out, ",failed,eat,,failed,,wave (toy/wave): nothing left to eat\n"));
#endif
    r = cli("sed -n 's/.*\"flankfilm\\( run [^\"]*\\)\",.*/\\1/p' results/f/journal.jsonl | "
            "grep \"end=fail'\" >line; eval \"$F $(cat line)\"");
    cli_expect("the command repeats the case", &r, r.code == 1 && cli_has(r.err, "broke at step"));
    r = cli("$F plan f.yaml --rerun failed --json");
    cli_expect("rerun failed", &r, json_integer_value(cli_at(r.json, "left")) == 7);
    r = cli("$F run f.yaml --rerun failed --fail-fast -j 1");
    cli_expect("fail-fast", &r, r.code == 4 && cli_has(r.out, "2 of 9 cases done, 1 of them"));
}

static void test_reuse(void)
{
    cli_write("r.yaml", "format: 2\npipeline:\n  wave: {use: toy/wave, amplitude: 2 mm}\n"
                        "  same: {use: toy/wave, amplitude: 1 mm, work: 20 ms}\n"
                        "outputs: [wave.total, same.total]\n"
                        "study: {sweep: {wave.amplitude: [1 mm, 2 mm, 3 mm, 4 mm, 5 mm]}}\n");
    outcome r = cli("$F run r.yaml -j 2; cut -d, -f6 results/r/table.csv | uniq -c | wc -l");
    cli_expect("two workers compute a shared stage once", &r,
               cli_has(r.out, "stages: 6 computed in ") && cli_has(r.out, "\n2\n") &&
                   cli_has(r.out, ", 4 reused from other cases, which saved 0."));
    r = cli("for f in results/r/stages/*; do printf x >$f; done; $F run r.yaml -j 1 --rerun all");
    cli_expect("a damaged file is computed anew", &r,
               cli_has(r.out, "stages: 6 computed in ") && cli_has(r.out, ", 4 reused from"));
}

static void test_time_limit(void)
{
    write_study("h.yaml", ", end: deaf",
                "{sweep: {wave.work: [0 s, 1000 s, 0.005 s]}, time_limit: 0.3 s}");
    outcome r = cli("$F run h.yaml -j 1; cat results/h/table.csv");
    cli_expect(
        "a hanging case", &r,
        cli_has(
            r.out,
            ",time limit,1000,,failed,time limit,the case took longer than its limit of 0.3 s\n") &&
            cli_has(r.out, "3 of 3 cases done") && cli_has(r.out, ",ok,0.005,"));
}

static void test_shards(void)
{
    cli("$F run s.yaml -o whole -j 1");
    outcome r =
        cli("$F run s.yaml -o parts --shard 1/2 -j 1; "
            "SLURM_ARRAY_TASK_ID=8 SLURM_ARRAY_TASK_MIN=7 SLURM_ARRAY_TASK_COUNT=2 "
            "$F run s.yaml -o parts -j 1; cmp whole/table.csv parts/table.csv && echo same");
    cli_expect("shards make one table", &r,
               cli_has(r.out, "5 of 5 cases") && cli_has(r.out, "4 of 4 cases") &&
                   cli_has(r.out, "same\n") && cli_has(r.err, "shard 2/2, from Slurm"));
    r = cli("SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MIN=2 SLURM_ARRAY_TASK_COUNT=2 "
            "SLURM_ARRAY_TASK_MAX=3 SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=1 $F plan s.yaml");
    cli_expect("tasks of an array", &r, cli_has(r.err, "shard 4/4, from Slurm"));
    r = cli("SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=7 "
            "SLURM_ARRAY_TASK_STEP=1 SLURM_ARRAY_TASK_COUNT=2 $F run s.yaml");
    cli_expect("an array with gaps", &r, r.code == 2 && cli_has(r.err, "--shard I/N"));
    r = cli("$F run s.yaml --shard 3/2");
    cli_expect("a wrong shard", &r, r.code == 2 && cli_has(r.err, "--shard needs I/N"));
}

/* The example for Slurm does without Slurm, too, when it is told the number of its part. */
static void test_array_script(void)
{
    outcome r =
        cli("mkdir -p 'a dir'; cp s.yaml \"a dir/it's.yaml\"; PATH=${F%/*}:$PATH; "
            "for i in 3 1 2; do PARTS=3 SLURM_ARRAY_TASK_ID=$i "
            "bash $FLANKFILM_TEST_SOURCE/configs/slurm-array.sh \"a dir/it's.yaml\" "
            "-o \"a dir/it's there\" --set wave.count=2 || exit; done; "
            "$F run s.yaml -o twos --set wave.count=2; cmp twos/table.csv a*/it*/table.csv");
    cli_expect("parts of an array make the whole", &r,
               r.code == 0 && cli_has(r.out, "3 of 3 cases done: "));
}

static void test_directories(void)
{
    write_study("w.yaml", "", "{sweep: {wave.work: [3 s, 3.1 s]}}");
    outcome r = cli("$F run w.yaml -j 1 -o busy >one 2>&1 & first=$!; "
                    "for i in $(seq 200); do [ -e busy/journal.jsonl ] || sleep 0.01; done; "
                    "$F run w.yaml -j 1 -o busy; code=$?; kill -9 $first; wait $first; exit $code");
    cli_expect("two runs in one directory", &r,
               r.code == 2 && cli_has(r.err, "another run is using the result directory") &&
                   !*r.out);
    r = cli("mkdir mine; echo precious >mine/file; $F run s.yaml -o mine");
    cli_expect("somebody else's directory", &r,
               r.code == 2 && cli_has(r.err, "not results of a study") && cli_exists("mine/file"));
    r = cli("$F run s.yaml -o /proc/study");
    cli_expect("no directory can be made", &r, r.code == 2 && cli_has(r.err, "cannot be used"));
}

/* A limit on the size of files stands for a full disk. */
static void test_full_disk(void)
{
    write_study("d.yaml", "", "{sweep: {wave.count: {from: 1, to: 40, points: 40}}}");
    cli("$F run d.yaml -o roomy");
    outcome r = cli("(trap '' XFSZ; ulimit -f 8; $F run d.yaml -o full)");
    cli_expect("the journal does not fit", &r,
               r.code == 1 && cli_has(r.err, "the journal could not be written: File too large"));
    r = cli("tail -c 1 full/journal.jsonl | od -An -tx1; $F run d.yaml -o full; "
            "cmp roomy/table.csv full/table.csv && echo same");
    cli_expect("nothing is lost", &r,
               cli_has(r.out, " 0a\n") && cli_has(r.out, "40 of 40 cases done, ") &&
                   cli_has(r.out, "same\n"));
}

static void test_interrupt(void)
{
    write_study("i.yaml", "", "{sweep: {wave.work: [0.5 s, 0.6 s]}}");
    outcome r = cli("$F run i.yaml -j 1 -o stop & first=$!; "
                    "for i in $(seq 200); do [ -e stop/journal.jsonl ] || sleep 0.01; done; "
                    "sleep 0.1; kill -TERM $first; wait $first");
    cli_expect("stops after the case at hand", &r,
               r.code == 1 && cli_has(r.err, "the study was stopped") &&
                   cli_has(r.err, "the same command continues") &&
                   cli_has(r.out, "1 of 2 cases done"));
}

static void test_messages(void)
{
    static const char *const wrong[][2] = {
        {"{sweep: {wave.count: 3}}", "expected a list of values"},
        {"{sweep: {wave.count: []}}", "expected a list of values"},
        {"{sweep: {wave.count: {from: 1, to: 3}}}", "a range needs \"points\""},
        {"{sweep: {wave.count: {from: 1, to: 3, points: 1}}}", "from 2 to 1000000"},
        {"{sweep: {wave.amplitude: {from: 1 mm, to: 3 s, points: 3}}}",
         "units of different dimensions"},
        {"{sweep: {wave.amplitude: {from: 1 mm, to: 3 furlong, points: 3}}}", "furlong"},
        {"{sweep: {wave.amplitude: {from: 0 mm, to: 3 mm, points: 3, spacing: log}}}", "positive"},
        {"{sweep: {wave.amplitude: {from: 1 mm, to: 3 mm, pionts: 3}}}", "did you mean \"points\""},
        {"{zip: {wave.count: [1, 2], wave.amplitude: [1 mm]}}", "equally long"},
        {"{sweep: {wave.count: [1]}, zip: {wave.count: [2]}}", "varied twice"},
        {"{sample: {sobol: 4}, sweep: {wave.count: [1]}}", "no range to sample"},
        {"{sample: {sobol: 4}}", "there is nothing to vary"},
        {"{sweep: {wave.nonsense: [1]}}", "unknown key \"nonsense\""},
        {"{sweep: {wave.amplitude: [20 mm]}}", "wave.amplitude"},
        {"[1]", "there is nothing to vary"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        write_study("m.yaml", "", wrong[i][0]);
        outcome r = cli("$F check m.yaml");
        cli_expect(wrong[i][0], &r, r.code == 2 && cli_has(r.err, wrong[i][1]));
    }
    outcome r = cli("$F plan pair.yaml");
    cli_expect("no study", &r, r.code == 2 && cli_has(r.err, "pair.yaml has no study"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_table();
    test_same_physics();
    test_zip_and_use();
    test_series();
    test_failures();
    test_reuse();
    test_time_limit();
    test_shards();
    test_array_script();
    test_directories();
    test_full_disk();
    test_interrupt();
    test_messages();
    return cli_close();
}
