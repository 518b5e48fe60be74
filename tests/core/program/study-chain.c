/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies whose cases start from their neighbours, with the real program; included files and named
   stages; what `plan` says has changed. */
#include "cli-harness.h"

#include <string.h>

static void write_walk(const char *name, const char *walk, const char *study)
{
    char text[2048];
    snprintf(text, sizeof text,
             "format: 2\npipeline:\n  walk: {use: toy/walk%s}\noutputs: [walk.place]\nstudy: %s\n",
             walk, study);
    cli_write(name, text);
}

static void test_ways(void)
{
    write_walk("w.yaml", "", "{sweep: {walk.step: {from: 1 m, to: 4 m, points: 4, follow: both}}}");
    outcome r = cli("$F run w.yaml -j 2 && cut -d, -f1,3- results/w/table.csv");
    cli_expect(
        "up and down", &r,
        r.code == 0 &&
            cli_has(r.out,
                    "case,status,follow,walk.step [m],walk.place [m],verdict,reasons,reason\n"
                    "1,ok,up,1,1,good,,\n2,ok,up,2,2.75,good,,\n3,ok,up,3,5.0625,good,,\n"
                    "4,ok,up,4,7.796875,good,,\n5,ok,down,1,5.875,good,,\n6,ok,down,2,6.5,good,,\n"
                    "7,ok,down,3,6,good,,\n8,ok,down,4,4,good,,\n"));
    cli_expect("nothing is taken over", &r, cli_has(r.out, "stages: 8 computed"));
    r = cli("$F run w.yaml && $F plan w.yaml");
    cli_expect("resumes", &r,
               cli_has(r.out, "8 of 8 cases done, 8 of them earlier") &&
                   cli_has(r.out, "1 m ... 4 m, each starts from its neighbour\n"));
    write_walk("v.yaml", "", "{sweep: {walk.step: {from: 4 m, to: 1 m, points: 4, follow: down}}}");
    r = cli("$F run v.yaml -o results/w --replace && cut -d, -f3- results/w/table.csv");
    cli_expect(
        "one way alone; the larger value is up", &r,
        cli_has(r.out, "\nok,4,4,good,,\nok,3,6,good,,\nok,2,6.5,good,,\nok,1,5.875,good,,\n") &&
            cli_has(r.out, "4 of 4 cases done, 4 of them earlier"));
}

static void test_shards(void)
{
    static const char study[] = "{sweep: {walk.foot: [1, 2, 3], walk.step: {from: 1 m, to: 9 m, "
                                "points: 5, follow: both}, walk.work: [0 s, 0.001 s]}}";
    write_walk("p.yaml", "", study);
    outcome r = cli("$F run p.yaml -o whole -j 1 && for i in 1 2 3; do "
                    "$F run p.yaml -o parts -j 2 --shard $i/3; done; "
                    "cmp whole/table.csv parts/table.csv && echo same");
    cli_expect("chains go to shards as a whole", &r,
               cli_has(r.out, "60 of 60 cases") && cli_has(r.out, "20 of 20 cases") &&
                   cli_has(r.out, "same\n"));
}

static void test_crash(void)
{
    static const char study[] = "{sweep: {walk.step: {from: 1 m, to: 5 m, points: 5, follow: up}}}";
    write_walk("c.yaml", ", trap: 3 m", study);
    outcome r = cli("$F run c.yaml; cut -d, -f3-5 results/c/table.csv");
    cli_expect("the chain goes on from the last good state", &r,
               cli_has(r.out, "5 of 5 cases done") &&
                   cli_has(r.out, "\nok,2,2.75\ncrashed,3,\nok,4,6.0625\nok,5,9.546875\n"));
    r = cli("$F run c.yaml -j 1");
    cli_expect(
        "a failure stays one", &r,
        cli_has(r.out, "5 of 5 cases done, 5 of them earlier: 4 good, 1 failed (crashed 1)"));
    r = cli("grep -c \"run 'c.yaml' --rerun failed -o 'results/c'\" results/c/journal.jsonl");
    cli_expect("the command repeats the case where it stands", &r, cli_has(r.out, "1\n"));
    r = cli("$F run c.yaml -o clean --set 'walk.trap=0 m'; head -n 2 clean/journal.jsonl >keep; "
            "mkdir torn; : >torn/.flankfilm-study; cat keep >torn/journal.jsonl; "
            "$F run c.yaml -o torn --set 'walk.trap=0 m'; cmp clean/table.csv torn/table.csv && "
            "echo same");
    cli_expect("goes on from the journal", &r,
               cli_has(r.out, "5 of 5 cases done, 2 of them earlier") && cli_has(r.out, "same\n"));
}

static void test_bad_state(void)
{
    write_walk("b.yaml", ", bulk: 1048577",
               "{sweep: {walk.step: {from: 1 m, to: 2 m, points: 2, follow: up}}}");
    outcome r = cli("$F run b.yaml; cut -d, -f3- results/b/table.csv");
    cli_expect("a state that is too large", &r,
               cli_has(r.out, "\nplugin fault,1,failed,plugin fault,walk: the plugin ") &&
                   cli_has(r.out, "gave a state of 1048577 bytes; at most 1048576 are possible\n"));
    write_walk("b.yaml", ", bulk: 0",
               "{sweep: {walk.step: {from: 1 m, to: 2 m, points: 2, follow: up}}}");
    r = cli("$F run b.yaml -o none && cut -d, -f3- none/table.csv");
    cli_expect("none at all", &r, cli_has(r.out, "\nok,1,1,good,,\nok,2,2,good,,\n"));
}

static void test_nothing_carried(void)
{
    cli_write("n.yaml",
              "format: 2\npipeline: {wave: {use: toy/wave, amplitude: 1 mm}}\n"
              "study: {sweep: {wave.amplitude: {from: 1 mm, to: 2 mm, points: 2, follow: up}}}\n");
    outcome r = cli("$F check n.yaml");
    cli_expect("no stage hands on a state", &r,
               r.code == 0 && cli_has(r.err, "none of the stages that run passes a state"));
    r = cli("$F check w.yaml");
    cli_expect("the walk does", &r, r.code == 0 && !cli_has(r.err, "passes a state"));
}

static void test_files(void)
{
    cli("mkdir -p cards");
    cli_write("cards/low.tide.yaml", "pipeline: {wave: {amplitude: 1 mm, count: 2}}\n");
    cli_write("cards/high.yaml", "pipeline: {wave: {amplitude: 3 mm, count: 2}}\n");
    cli_write("t.yaml", "format: 2\npipeline: {wave: {use: toy/wave, amplitude: 9 mm}}\n"
                        "outputs: [wave.total]\n"
                        "study: {sweep: {tide: {include: [cards/low.tide.yaml, cards/high.yaml]}, "
                        "wave.shape: [a]}}\n");
    outcome r = cli("$F run t.yaml && cut -d, -f3- results/t/table.csv");
    cli_expect("files are called by their names", &r,
               cli_has(r.out,
                       "status,tide,wave.shape,wave.total [m],verdict,reasons,reason\n"
                       "ok,low,a,0.000479425538604,good,,\nok,high,a,0.00143827661581,good,,\n"));
    r = cli("cd cards && $F run ../t.yaml -o away --set 'wave.amplitude=2 mm' && "
            "cut -d, -f3- away/table.csv");
    cli_expect(
        "--set stands above the files, whose place is the study's", &r,
        cli_has(r.out, "ok,low,a,0.000958851077208,good,,\nok,high,a,0.000958851077208,good,,\n"));
    r = cli("$F explain t.yaml --set 'wave.amplitude=2 mm'");
    cli_expect("explain, too", &r,
               cli_has(r.out, "2 mm") && cli_has(r.out, "stages: 2 computed in "));
    r = cli("$F check t.yaml --set 'study.sweep.tide.include=[cards/no.yaml]'");
    cli_expect("a file that is not there", &r,
               r.code == 2 && cli_has(r.err, "cannot read \"cards/no.yaml\""));
}

static void test_named_stages(void)
{
    cli_write("s.yaml",
              "format: 2\npipeline: {wave: {use: toy/wave, amplitude: 9 mm, count: 2}}\n"
              "outputs: [wave.total]\n"
              "study:\n  sweep:\n    wave: {calm: {amplitude: 1 mm}, rough: {amplitude: 4 mm}}\n");
    outcome r = cli("$F run s.yaml && cut -d, -f3- results/s/table.csv");
    cli_expect(
        "stages are called by their names", &r,
        cli_has(
            r.out,
            "status,wave,wave.total [m],verdict,reasons,reason\nok,calm,0.000479425538604,good,,\n"
            "ok,rough,0.00191770215442,good,,\n"));
}

static void test_changes(void)
{
    static const char study[] = "{sweep: {walk.step: [1 m, 2 m]}}";
    write_walk("g.yaml", "", study);
    cli("$F run g.yaml");
    outcome r = cli("$F plan g.yaml --set walk.foot=3 --set 'walk.work=1 ms'");
    cli_expect("old and new values", &r,
               cli_has(r.out, "\n0 done, 0 failed, 2 to run, about ") &&
                   cli_has(r.out, "\nan earlier run did 2 of these with other inputs; changes of "
                                  "the first:\n") &&
                   cli_has(r.out, "\n  walk.work: 0 s -> 0.001 s\n") &&
                   cli_has(r.out, "\n  walk.foot: not given -> 3\n"));
    write_walk("g.yaml", "", "{sweep: {walk.step: [1 m, 2 m, 3 m]}}");
    r = cli("$F plan g.yaml");
    cli_expect("a new case is no change", &r,
               cli_has(r.out, "2 done, 0 failed, 1 to run, about") && !cli_has(r.out, "otherwise"));
    write_walk("g.yaml", "", study);
    r = cli("$F plan g.yaml --set walk.foot=3 --json");
    cli_expect("as JSON", &r,
               json_integer_value(cli_at(r.json, "again")) == 2 &&
                   json_array_size(cli_at(r.json, "changed")) == 1);
}

static void test_messages(void)
{
    static const char *const wrong[][2] = {
        {"{from: 1 m, to: 3 m, points: 3, follow: sideways}",
         "\"follow\" must be up, down or both"},
        {"{from: 1 m, to: 3 m, points: 3, follow: [up]}", "\"follow\" must be up, down or both"},
        {"{include: walk.yaml}", "expected a list of files"},
        {"{include: []}", "expected a list of files"},
        {"{include: [a.yaml], points: 3}", "expected a list of files"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char study[256];
        snprintf(study, sizeof study, "{sweep: {walk.step: %s}}", wrong[i][0]);
        write_walk("m.yaml", "", study);
        outcome r = cli("$F check m.yaml");
        cli_expect(wrong[i][0], &r, r.code == 2 && cli_has(r.err, wrong[i][1]));
    }
    write_walk("m.yaml", "",
               "{sweep: {walk.step: {from: 1 m, to: 3 m, points: 3, follow: up}, "
               "walk.work: {from: 0 s, to: 1 s, points: 2, follow: up}}}");
    outcome r = cli("$F check m.yaml");
    cli_expect("two followed", &r, r.code == 2 && cli_has(r.err, "only one range"));
    write_walk("m.yaml", "",
               "{sample: {sobol: 4}, sweep: {walk.step: {from: 1 m, to: 3 m, follow: up}}}");
    r = cli("$F check m.yaml");
    cli_expect("a sample", &r, r.code == 2 && cli_has(r.err, "cannot be followed"));
}

int main(int argc, char **argv)
{
    cli_open(argc, argv);
    test_ways();
    test_shards();
    test_crash();
    test_bad_state();
    test_nothing_carried();
    test_files();
    test_named_stages();
    test_changes();
    test_messages();
    return cli_close();
}
