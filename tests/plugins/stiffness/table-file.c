/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static spur_pair unity;
static char path[4096];

static void write_file(const char *text, size_t length)
{
    FILE *file = fopen(path, "w");
    if (!file || fwrite(text, 1, length, file) != length || fclose(file) != 0) {
        perror(path);
        exit(2);
    }
}

static stage *open_file(const char *text)
{
    write_file(text, strlen(text));
    stage *s = stage_open("stiffness/table");
    feed_path(s, &unity);
    stage_set_text(s, "file", path);
    return s;
}

static void test_stiffness_column(void)
{
    stage *s = open_file("\xef\xbb\xbf# measured\r\n\r\nphase ; stiffness [N/mm]\r\n"
                         "0 ; 3e5\r\n 0.25; 2.5e5\r\n\r\n0.5 ;2e5 \r\n");
    check_true("runs", stage_run(s) == FF_OK);
    check_near("mean", stage_scalar(s, "stiffness_mean"), 2.5e8, 1e-14);
    size_t n;
    const double *k = stage_get(s, "stiffness", &n);
    check_near("in SI", k[0], 3e8, 1e-15);
    check_near("period closed", k[n - 1], 3e8, 1e-15);
    stage_close(s);
}

/* At the table's phases, k must be F/(e_l - e), and both transmission errors as given. */
static void test_transmission_errors(void)
{
    stage *s = open_file("phase,loaded_transmission_error [um],transmission_error [um]\n"
                         "0,12,2\n0.4,15,2.5\n0.8,11,1\n");
    stage_set(s, "points", 5);
    check_true("runs", stage_run(s) == FF_OK);
    size_t n;
    const double *phase = stage_get(s, "phase", &n), *k = stage_get(s, "stiffness", NULL);
    const double *e = stage_get(s, "transmission_error", NULL);
    const double *loaded = stage_get(s, "loaded_transmission_error", NULL);
    size_t at = 0;
    while (phase[at] < 0.4)
        at++;
    check_near("phase", phase[at], 0.4, 0);
    check_near("k", k[at], unity.line_force / 12.5e-6, 1e-13);
    check_near("e", e[at], 2.5e-6, 1e-13);
    check_near("e_l", loaded[at], 15e-6, 1e-13);
    check_near("e at the end", e[n - 1], 2e-6, 1e-13);
    stage_get(s, "breakpoints", &n);
    check_true("three kinks", n == 3);
    stage_close(s);
    s = open_file("phase,transmission_error [um],loaded_transmission_error [um]\n0,2,12\n");
    const double none = 0;
    stage_give(s, "operating.line_force", 0, NULL, &none);
    check_true("needs a load",
               stage_run(s) < 0 && !strcmp(stage_why_item(s), "operating.line_force"));
    stage_close(s);
}

/* With the slope and both transmission errors in the table, the outputs must be as given. */
static void test_slope_and_errors(void)
{
    stage *s = open_file("phase,stiffness [N/um],transmission_error [um],"
                         "loaded_transmission_error [um]\n0,300,2,12\n0.5,280,2.5,15\n");
    stage_set_text(s, "definition", "tangent");
    stage_set(s, "points", 4);
    check_true("runs", stage_run(s) == FF_OK);
    check_near("k", stage_get(s, "stiffness", NULL)[2], 2.8e8, 1e-13);
    check_near("e", stage_get(s, "transmission_error", NULL)[2], 2.5e-6, 1e-13);
    check_near("e_l", stage_get(s, "loaded_transmission_error", NULL)[2], 15e-6, 1e-13);
    check_near("between", stage_get(s, "loaded_transmission_error", NULL)[1], 13.5e-6, 1e-13);
    stage_close(s);
}

/* With a stiffness and an error without load in the table, e_l must be e + F/k. */
static void test_error_beside_stiffness(void)
{
    stage *s = open_file("phase\tstiffness [N/um]\ttransmission_error [nm]\n0\t300\t1500\n");
    check_true("runs", stage_run(s) == FF_OK);
    check_near("e_l", stage_get(s, "loaded_transmission_error", NULL)[7],
               1.5e-6 + unity.line_force / 3e8, 1e-14);
    stage_close(s);
}

/* Load fraction of the entering pair: 0.3 to 0.7 during double contact, 1 after it. */
static void test_load_share(void)
{
    char text[256];
    double exit = unity.contact_ratio - 1;
    snprintf(text, sizeof text,
             "phase,stiffness [N/m],load_share\n0,4e8,0.3\n%.17g,4e8,0.7\n%.17g,2e8,1\n1,2e8,1\n",
             exit, exit);
    stage *s = open_file(text);
    stage_set_text(s, "load_share", "file");
    stage_set_text(s, "ends", "jump");
    check_true("runs", stage_run(s) == FF_OK);
    const double *share = stage_get(s, "load_share", NULL);
    size_t low = unity.lpstc, high = unity.hpstc, tip = PAIR_STATIONS - 1;
    check_near("SAP", share[0], 0.3, 1e-12);
    check_near("LPSTC, two pairs", share[low], 0.7, 1e-12);
    check_near("LPSTC, alone", share[low + 1], 1, 1e-12);
    check_near("HPSTC, alone", share[high], 1, 1e-12);
    check_near("HPSTC, two pairs", share[high + 1], 0.7, 1e-12);
    check_near("tip", share[tip], 0.3, 1e-12);
    check_below("equilibrium", stage_quality(s, "equilibrium"), 1e-14);
    stage_close(s);

    s = open_file("phase,stiffness [N/m],load_share\n0,4e8,0.3\n0.5,3e8,0.6\n");
    stage_set_text(s, "load_share", "file");
    check_true("a share that is not this gear's", stage_run(s) == FF_OK);
    check_true("is doubted", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);

    spur_pair high_ratio = spur_pair_make(60, 60, 3e-3, 1.35, 0, 0);
    s = open_file("phase,stiffness [N/m],load_share\n0,4e8,0.3\n");
    feed_path(s, &high_ratio);
    stage_set_text(s, "load_share", "file");
    check_true("three pairs: not settled", stage_run(s) == FF_UNSUPPORTED);
    stage_close(s);
}

/* Transmission errors s = a(phase) F + b F^1.2 at five forces: checks s and its slope at the line
   force, half-way between two of them, and the forces of the tooth pairs at each. */
static double error_under(double phase, double force)
{
    return (3 + 0.5 * cos(2 * M_PI * phase)) * 1e-9 * force + 4e-11 * pow(force, 1.2);
}

static char *force_table(int slopes, const double *part, int forces)
{
    static char text[16384];
    char *end = text;
    double exit = unity.contact_ratio - 1;
    const double at[] = {0, exit / 2, exit, exit, 0.5 + exit / 2};
    end += sprintf(end, "force [N],phase,loaded_transmission_error [m],load_share%s\n",
                   slopes ? ",stiffness [N/m]" : "");
    for (int k = 0; k < forces; k++)
        for (int i = 0; i < 5; i++) {
            double F = part[k] * unity.line_force, h = 1e-4 * unity.line_force;
            double rate = (error_under(at[i], F + h) - error_under(at[i], fmax(F - h, 0))) /
                          (F > h ? 2 * h : h);
            end +=
                sprintf(end, "%.17g,%.17g,%.17g,%.17g", F, at[i],
                        1e-6 * (i < 3) + error_under(at[i], F), i < 3 ? 0.5 + 0.05 * part[k] : 1);
            end += slopes ? sprintf(end, ",%.17g\n", 1 / rate) : sprintf(end, "\n");
        }
    return text;
}

static void test_forces(void)
{
    static const double with[] = {0, 0.4, 1, 2, 4}, without[] = {0, 0.7, 1.3, 2, 4};
    for (int i = 0; i < 4; i++) {
        stage *s = open_file(force_table(i & 1, i & 2 ? without : with, 5));
        stage_set_text(s, "load_share", "file");
        stage_set_text(s, "ends", "jump");
        stage_set_text(s, "definition", i & 1 ? "tangent" : "secant");
        check_true("runs", stage_run(s) == FF_OK);
        size_t levels, n, at = 0;
        const double *force = stage_get(s, "force_level", &levels);
        const double *phase = stage_get(s, "phase", &n), *k = stage_get(s, "stiffness", NULL);
        const double *e = stage_get(s, "transmission_error", NULL);
        const double *loaded = stage_get(s, "loaded_transmission_error", NULL);
        const double *row = stage_get(s, "level_error", NULL);
        const double *slope = stage_get(s, "level_stiffness", NULL);
        const double *teeth = stage_get(s, "level_tooth_force", NULL);
        double F = unity.line_force, way = error_under(0, F), h = 1e-4 * F;
        check_true("forces", levels == (i & 2 ? 6 : 5));
        while (force[at] < F * (1 - 1e-12))
            at++;
        check_near("the line force", force[at], F, 1e-12);
        check_near("phase", phase[0], 0, 0);
        check_near("e", e[0], 1e-6, 1e-12);
        check_near("its row", row[0], e[0], 0);
        check_near("row of the line force", row[at * n], loaded[0], 0);
        check_near("e_l", loaded[0] - e[0], way, i & 2 ? 1e-3 : 1e-12);
        double tangent = 2 * h / (error_under(0, F + h) - error_under(0, F - h));
        check_near("slope", slope[at * n], tangent, i & 1 ? 5e-3 : 3e-2);
        check_near("k", k[0], i & 1 ? slope[at * n] : F / (loaded[0] - e[0]), 1e-12);
        check_near("W of one pair at SAP", teeth[at * PAIR_STATIONS], 0.55 * F, 1e-12);
        check_near("and of both at LPSTC", teeth[at * PAIR_STATIONS + unity.lpstc], 0.55 * F,
                   1e-12);
        check_near("at the last force", teeth[(levels - 1) * PAIR_STATIONS], 0.7 * 4 * F, 1e-12);
        stage_close(s);
    }
    stage *chord = open_file("phase,force [N],loaded_transmission_error [um],stiffness [N/um]\n"
                             "0,0,1,1\n0.5,0,1.5,1\n0,500,3,250\n0.5,500,3.5,250\n"
                             "0,9000,11,900\n0.5,9000,11.5,900\n");
    stage_set_text(chord, "definition", "tangent");
    check_true("a chord for a slope", stage_ready(chord) == FF_INVALID &&
                                          strstr(stage_why(chord), ":4:9: in every row this is"));
    stage_close(chord);
    char closing[300];
    snprintf(closing, sizeof closing,
             "phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1\n"
             "0,%.17g,11\n0.5,%.17g,11\n0,%.17g,12\n0.5,%.17g,12\n",
             unity.line_force, unity.line_force, 2 * unity.line_force, 2 * unity.line_force);
    stage *stiff = open_file(closing);
    check_true("flanks that close at once", stage_run(stiff) == FF_OK);
    const double *level = stage_get(stiff, "level_stiffness", NULL);
    check_true("are not rigid above",
               level && level[4] > 0 && level[4] < 11 * unity.line_force / 1e-6);
    stage_close(stiff);
    static const double short_of[] = {0, 0.5};
    stage *s = open_file(force_table(0, short_of, 2));
    stage_set_text(s, "ends", "jump");
    check_true("a table that ends below the load",
               stage_run(s) == FF_INVALID &&
                   strstr(stage_why(s), ":7:1: the largest force of the table"));
    stage_close(s);
}

static void expect_refusal(const char *text, const char *word)
{
    stage *s = open_file(text);
    if (strstr(text, "load_share"))
        stage_set_text(s, "load_share", "file");
    int refused = stage_ready(s) < 0;
    check_true(word, refused && strstr(stage_why(s), word) && !strcmp(stage_why_item(s), "file"));
    if (!refused || !strstr(stage_why(s), word))
        printf("     said: %s\n", stage_why(s));
    stage_close(s);
}

static void test_refusals(void)
{
    expect_refusal("", "the file has no header");
    expect_refusal("# nothing\n\n", "the file has no header");
    expect_refusal("phase,stiffness [N/m]\n", "no rows");
    expect_refusal("phase,stiffness\n0,1e8\n", ":1:7: the column \"stiffness\" needs its unit");
    expect_refusal("phase,stiffness [furlong]\n0,1e8\n", ":1:7: the unit \"furlong\"");
    expect_refusal("phase,stiffness [N/m\n0,1e8\n", "brackets");
    expect_refusal("phase,stiffnes [N/m]\n0,1e8\n", ":1:7: no column is called \"stiffnes\"");
    expect_refusal("phase,phase\n0,1\n", ":1:7: the column \"phase\" occurs twice");
    expect_refusal("stiffness [N/m]\n1e8\n", ":1:1: the column \"phase\" is missing");
    expect_refusal("phase,transmission_error [m]\n0,1\n", "must name stiffness");
    expect_refusal("phase,stiffness [N/m],loaded_transmission_error [m]\n0,1,1\n",
                   ":1:23: the secant stiffness follows from this column");
    expect_refusal("phase,stiffness [N/m]\n0,1e8\n0.5\n", ":3:1: 1 field in this line, but 2");
    expect_refusal("phase,stiffness [N/m]\n0,1e8\n0.5,two\n", ":3:5: \"two\" is not a number");
    expect_refusal("phase,stiffness [N/m]\n0,\n", ":2:3: stiffness has no number here");
    expect_refusal("phase,stiffness [N/m]\n0,1e999\n", ":2:3: 1e999 is out of range");
    expect_refusal("phase,stiffness [N/m]\n0,nan\n", ":2:3: \"nan\" is not a number");
    expect_refusal("phase,stiffness [N/m]\n0,1e8\n\n# here\n0.5,-1e8\n", ":5:5: a stiffness");
    expect_refusal("phase,stiffness [N/m]\n0.5,1e8\n0.25,1e8\n", ":3:1: the phases must not");
    expect_refusal("phase,stiffness [N/um],transmission_error [um]\n0,300,0\n0.5,300,4\n1,300,2\n",
                   ":4:7: the transmission error without load is not periodic");
    expect_refusal("phase,stiffness [N/um]\n0,300\n0.5,320\n1,310\n",
                   ":4:3: the stiffness is not periodic");
    expect_refusal("phase,transmission_error [um],loaded_transmission_error [um]\n0,1,9\n0.5,1,8\n"
                   "1,1,7\n",
                   ":4:5: the loaded transmission error is not periodic");
    expect_refusal("phase,transmission_error [um],loaded_transmission_error [um]\n0,5,4\n",
                   ":2:5: the loaded");
    expect_refusal("phase,stiffness [N/m],load_share\n0,4e8,1.1\n0.5,3e8,1\n",
                   ":2:7: a load share lies between 0 and 1");
    expect_refusal("phase,stiffness [N/m],load_share\n0,4e8,1\n0.5,3e8,-0.1\n",
                   ":3:9: a load share lies between 0 and 1");
    expect_refusal("phase,torque [N m],loaded_transmission_error [um]\n0,0,1\n0,9,2\n",
                   ":1:7: give the mesh force, force [N], instead");
    expect_refusal("phase,force [N],stiffness [N/m]\n0,0,1\n",
                   ":1:7: a table with a column force also needs the column");
    expect_refusal(
        "phase,force [N],transmission_error [um],loaded_transmission_error [um]\n0,0,1,2\n",
        ":1:17: in a table with a column force, the rows of force 0");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1.1\n1,0,1\n"
                   "0,5,2\n0.5,5,2.1\n1,5,2.9\n0,9,3\n0.5,9,3.1\n1,9,3\n",
                   ":7:5: the loaded transmission error is not periodic");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,5,1\n",
                   ":2:3: the first rows must have the force 0");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1\n",
                   ":3:5: at least one force above 0 is needed");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0,5,2\n0,4,3\n",
                   ":4:3: the forces must increase; found 4");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1\n0,5,2\n"
                   "0.5,6,2\n",
                   ":5:5: every force must have as many rows");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1\n0,5,2\n",
                   ":4:3: every force must have as many rows as the first force, 2");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1\n0,5,2\n"
                   "0.6,5,2\n",
                   ":5:1: every force must have the phases");
    expect_refusal("phase,force [N],loaded_transmission_error [um]\n0,0,1\n0.5,0,1\n0,5,2\n"
                   "0.5,5,0.9\n",
                   ":5:7: the transmission error, in m, must exceed that under the previous");
    expect_refusal("phase,force [N],loaded_transmission_error [um],stiffness [N/um]\n0,0,0,1\n"
                   "0,5,2,2\n",
                   ":1:48: in a table with a column force, stiffness is the slope");
    expect_refusal("phase,stiffness [N/m],a,b,c,d,e,f,g,h,i,j,k,l,m,n,o\n0,1\n",
                   ":1:23: no column is called \"a\"");
}

static void test_no_text(void)
{
    static const char binary[] = "phase,stiffness [N/m]\n0,1\0e8\n0.5,2e8\n";
    write_file(binary, sizeof binary - 1);
    stage *s = stage_open("stiffness/table");
    feed_path(s, &unity);
    stage_set_text(s, "file", path);
    check_true("a NUL",
               stage_ready(s) < 0 && strstr(stage_why(s), ":2:4: this is not a text file"));
    stage_close(s);
    s = stage_open("stiffness/table");
    feed_path(s, &unity);
    check_true("a directory", stage_try_text(s, "file", ".") == FF_INVALID &&
                                  strstr(stage_why(s), "it is not a regular file"));
    stage_close(s);
    static char blank[10000];
    memset(blank, 'x', sizeof blank);
    write_file(blank, sizeof blank);
    s = stage_open("stiffness/table");
    feed_path(s, &unity);
    stage_set_text(s, "file", path);
    check_true("an endless line",
               stage_ready(s) < 0 && strstr(stage_why(s), ":1:1: no column is called"));
    stage_close(s);
}

/* Returns the text of a smooth table with a number of rows. */
static char *long_table(int rows)
{
    char *text = malloc(48 * (size_t)rows + 64), *end = text;
    if (!text)
        exit(2);
    end += sprintf(end, "phase,stiffness [N/m]\n");
    for (int i = 0; i < rows; i++)
        end += sprintf(end, "%.12f,%.6f\n", (double)i / rows,
                       3e8 + 1e8 * cos(2 * M_PI * (double)i / rows));
    return text;
}

static void test_long_files(void)
{
    char *text = long_table(100000);
    stage *s = open_file(text);
    check_true("1e5 rows run", stage_run(s) == FF_OK);
    check_near("mean", stage_scalar(s, "stiffness_mean"), 3e8, 1e-9);
    check_near("harmonic", stage_get(s, "stiffness_harmonics", NULL)[0], 1e8, 1e-8);
    stage_close(s);
    free(text);
    text = long_table(100001);
    expect_refusal(text, "more than 100000 rows");
    free(text);
}

int main(void)
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/stiffness-table-XXXXXX", folder ? folder : P_tmpdir);
    int file = mkstemp(path);
    if (file < 0) {
        perror(path);
        return 2;
    }
    close(file);
    unity = spur_pair_make(50, 50, 3e-3, 1, 0, 0);
    test_stiffness_column();
    test_transmission_errors();
    test_slope_and_errors();
    test_error_beside_stiffness();
    test_load_share();
    test_forces();
    test_refusals();
    test_no_text();
    test_long_files();
    unlink(path);
    return check_done();
}
