/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors in a trace must be reported with their line and column. */
#include "trace-file.h"

#include <check.h>
#include <stage.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void expect(stage *s, const char *item, const char *sentence)
{
    ff_status status = stage_run(s);
    printf("%s: %s\n", stage_why_item(s), stage_why(s));
    check_true(sentence, status == FF_INVALID && !strcmp(stage_why_item(s), item) &&
                             strstr(stage_why(s), sentence));
    stage_close(s);
}

static void refuse_file(const char *text, const char *sentence)
{
    char path[PATH_ROOM];
    write_text(path, text);
    stage *s = stage_open("surface/measured");
    stage_set_text(s, "file_2", path);
    expect(s, "file_2", sentence);
    unlink(path);
}

static void test_files(void)
{
    refuse_file("", "the file has no header");
    refuse_file("# only this\n", "the file has no header");
    refuse_file("place [um], height [um]\n", ":1:1: no column is called \"place\"");
    refuse_file("position, height [um]\n", ":1:1: the column \"position\" needs its unit");
    refuse_file("position [s], height [um]\n", ":1:1: the column \"position\" is in \"s\"");
    refuse_file("position [µm], height [ell]\n", ":1:16: the unit \"ell\" ");
    refuse_file("position [um], height [um], more\n", ":1:29: no column is called \"more\"");
    refuse_file("position [um], height [um]\n0, 1\n", "must have at least 2 rows");
    refuse_file("position [um], height [um]\n0, 1\n1\n", ":3:1: 1 field in this line, but 2");
    refuse_file("position [um], height [um]\n0, 1\n1, x\n", ":3:4: \"x\" is not a number");
    refuse_file("position [um], height [um]\n0, 1\n1, nan\n", ":3:4: \"nan\" is not a number");
    refuse_file("position [um], height [um]\n0, 1e999\n", ":2:4: 1e999 is out of range");
    refuse_file("position [um], height [um]\n0, 1\n\n 1, 2 3\n", ":4:5: \"2 3\" is not a number");
    refuse_file("position [um], height [um]\n0, 1\n  0, 2\n", ":3:3: the positions must increase");
    refuse_file("position [mm], height [m]\n0, 1e300\n", ":2:4: height must be at most 1e+06 um");
    refuse_file("position [um], height [um]\n0,1\n1,2\n", "gives 2 points");
}

static void test_accepted_forms(void)
{
    char path[PATH_ROOM];
    write_text(path, "\xef\xbb\xbf# trace\nposition [mm] ; height [nm]\r\n0 ; 100\r\n"
                     "0.001\t-100\n0.002 0\n0.003,50");
    stage *s = stage_open("surface/measured");
    stage_set_text(s, "file_1", path);
    stage_set_text(s, "detrend", "none");
    check_true("runs", stage_run(s) == FF_OK);
    const double *z = stage_get(s, "height_1", NULL);
    check_near("nm", z[1], -100e-9, 1e-12);
    check_near("spacing", stage_get(s, "position", NULL)[1], 1e-6, 1e-9);
    stage_close(s);
    unlink(path);
}

static stage *open_short(char path[PATH_ROOM])
{
    write_text(path, "position [um], height [um]\n0,1\n1,2\n2,3\n3,1\n4,2\n5,7\n6,1\n");
    stage *s = stage_open("surface/measured");
    stage_set_text(s, "file_1", path);
    return s;
}

static void refuse(const char *param, const char *value, const char *sentence)
{
    char path[PATH_ROOM];
    stage *s = open_short(path);
    stage_set_text(s, param, value);
    expect(s, param, sentence);
    unlink(path);
}

static void test_too_many_points(void)
{
    char path[PATH_ROOM];
    write_text(path, "position [mm], height [um]\n0,1\n300,2\n");
    stage *s = stage_open("surface/measured");
    stage_set_text(s, "file_1", path);
    stage_set_text(s, "spacing", "1 um");
    expect(s, "spacing", "file_1 gives 262145 or more points");
    unlink(path);
}

static void test_parameters(void)
{
    expect(stage_open("surface/measured"), "file_1", "a trace is needed");
    refuse("cutoff_long", "8 um", "longer than the record of 7 um");
    refuse("cutoff_long", "2 um", "must be at least 5 um");
    refuse("cutoff_short", "2 um", "must be at least 5 um");
    refuse("spacing", "1 m", "gives 1 points");
}

int main(void)
{
    test_files();
    test_accepted_forms();
    test_parameters();
    test_too_many_points();
    return check_done();
}
