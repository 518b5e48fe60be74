/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Histories from files: values that are read, and errors with their line. */
#include <check.h>
#include <stage.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_ROOM = 64 };

static void write_text(char path[PATH_ROOM], const char *text)
{
    strcpy(path, "/tmp/flankfilm-contact-XXXXXX");
    int descriptor = mkstemp(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        exit(2);
}

static stage *open_table(char path[PATH_ROOM], const char *text)
{
    write_text(path, text);
    stage *s = stage_open("contact/table");
    stage_set_text(s, "file", path);
    return s;
}

static const char three[] = "# twin discs\n"
                            "time [ms]; radius [mm]; speed_1 [m/s]; speed_2 [m/s]; "
                            "load_per_width [N/mm]\n"
                            "0; 12.8; 4.2; 3.8; 177\n"
                            "1; 12.8; 4.0; 4.0; 0\n"
                            "2.5; 13; 3.8; 4.2; 100\n";

static void test_rows_become_instants(void)
{
    char path[PATH_ROOM];
    size_t n;
    stage *s = open_table(path, three);
    check_true("runs", stage_run_wanted(s, "time equivalent_radius radius_1 speed_1 sliding_speed "
                                           "load_per_width gap reduced_modulus") == FF_OK);
    const double *time = stage_get(s, "time", &n);
    check_true("three instants", n == 3);
    check_near("time", time[2], 2.5e-3, 1e-12);
    check_near("radius", stage_get(s, "equivalent_radius", NULL)[2], 13e-3, 1e-12);
    check_near("both twice", stage_get(s, "radius_1", NULL)[0], 25.6e-3, 1e-12);
    check_near("speed", stage_get(s, "speed_1", NULL)[0], 4.2, 1e-12);
    check_near("sliding", stage_get(s, "sliding_speed", NULL)[2], -0.4, 1e-12);
    check_near("load", stage_get(s, "load_per_width", NULL)[0], 177e3, 1e-12);
    check_near("no gap", stage_get(s, "gap", NULL)[1], 0, 0);
    check_near("steel", stage_scalar(s, "reduced_modulus"), 226.4e9, 1e-12);
    stage_close(s);
    unlink(path);
}

/* A row must give the contact of contact/constant. */
static void test_a_row_is_a_constant_contact(void)
{
    static const char *const outputs[] = {"hertz_half_width",  "hertz_pressure", "slide_roll_ratio",
                                          "equivalent_radius", "moes_M",         "moes_L"};
    char path[PATH_ROOM];
    stage *oil = stage_open("viscosity/barus"), *constant = stage_open("contact/constant");
    stage_set_text(oil, "eta0", "5 mPa s");
    stage_set_text(oil, "alpha", "11 1/GPa");
    stage *s = open_table(path, "load_per_width [kN/m], radius_1 [m], radius_2 [um], "
                                "speed_2 [mm/s], speed_1 [m/s], time [s]\n"
                                "177, 0.02, 30000, 3800, 4.2, 0\n");
    stage_set_text(s, "elastic_modulus", "[206 GPa, 70 GPa]");
    stage_set_text(constant, "elastic_modulus", "[206 GPa, 70 GPa]");
    stage_set(constant, "radius_1", 0.02);
    stage_set(constant, "radius_2", 0.03);
    stage_set(constant, "speed_1", 4.2);
    stage_set(constant, "speed_2", 3.8);
    stage_set(constant, "load_per_width", 177e3);
    stage_link(s, "viscosity", oil);
    stage_link(constant, "viscosity", oil);
    check_true("run", stage_run(s) == FF_OK && stage_run(constant) == FF_OK);
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++)
        check_near(outputs[i], stage_scalar(s, outputs[i]), stage_scalar(constant, outputs[i]),
                   1e-12);
    stage_close(s);
    stage_close(constant);
    stage_close(oil);
    unlink(path);
}

static void test_gap_where_the_contact_is_lost(void)
{
    char path[PATH_ROOM];
    stage *s = open_table(path, "time [s],radius [mm],speed_1 [m/s],speed_2 [m/s],load_per_width "
                                "[N/mm],gap [um]\n0,10,1,1,5,0\n1,10,1,1,0,0\n1,10,1,1,0,7\n");
    check_true("runs", stage_run_wanted(s, "gap time") == FF_OK);
    check_near("gap", stage_get(s, "gap", NULL)[2], 7e-6, 1e-12);
    check_near("jump", stage_get(s, "time", NULL)[2] - stage_get(s, "time", NULL)[1], 0, 0);
    stage_close(s);
    unlink(path);
}

/* At rest, M and the slide-roll ratio have no value; this must not be an error. */
static void test_at_rest(void)
{
    char path[PATH_ROOM];
    stage *s = open_table(path, "time [s], radius [mm], speed_1 [m/s], speed_2 [m/s], "
                                "load_per_width [N/mm]\n0, 12.8, 0, 0, 177\n1, 12.8, 4, 4, 177\n");
    check_true("the ratio is refused", stage_run_wanted(s, "slide_roll_ratio") == FF_INVALID);
    check_true("because there is no entrainment",
               strstr(stage_why(s), "since the entrainment speed is 0") != NULL);
    check_true("the rest is there", stage_run_wanted(s, "time sliding_speed") == FF_OK);
    stage_close(s);
    unlink(path);
}

static void refuse(const char *text, const char *sentence)
{
    char path[PATH_ROOM];
    stage *s = open_table(path, text);
    ff_status status = stage_run_wanted(s, "time");
    printf("%s\n", stage_why(s));
    check_true(sentence, status == FF_INVALID && !strcmp(stage_why_item(s), "file") &&
                             strstr(stage_why(s), sentence));
    stage_close(s);
    unlink(path);
}

#define HEADER "time [s], radius [mm], speed_1 [m/s], speed_2 [m/s], load_per_width [N/mm]\n"

static void test_refused_headers(void)
{
    refuse("", "the file has no header");
    refuse("when [s]\n", ":1:1: no column is called \"when\"");
    refuse("time [s, radius [mm]\n", ":1:1: the unit belongs in brackets at the end");
    refuse("time, radius [mm]\n", ":1:1: the column \"time\" needs its unit");
    refuse("time [furlong]\n", ":1:1: the unit \"furlong\" ");
    refuse("time [m]\n",
           ":1:1: the column \"time\" is in \"m\", but should be in a unit such as s");
    refuse("time [s], time [s]\n", ":1:11: the column \"time\" occurs twice");
    refuse("time [s]\n0\n", ":1:1: the column \"radius [mm]\" or \"radius_1 [mm]\" is missing");
    refuse("time [s], radius [mm], speed_1 [m/s]\n0,1,1\n",
           ":1:1: the column \"speed_2 [m/s]\" is missing: speed of surface 2");
    refuse("time [s], speed_1 [m/s], speed_2 [m/s], load_per_width [N/mm], radius_1 [mm]\n"
           "0,1,1,1,1\n",
           ":1:64: the header must name either radius, or radius_1 and radius_2");
    refuse("time [s], speed_1 [m/s], speed_2 [m/s], load_per_width [N/mm], radius [mm], "
           "radius_2 [mm]\n0,1,1,1,1,1\n",
           ":1:77: the header must name either radius, or radius_1 and radius_2");
    refuse("time [s], speed_1 [m/s], speed_2 [m/s], load_per_width [N/mm], radius [mm], "
           "radius_1 [mm]\n0,1,1,1,1,1\n",
           ":1:77: the columns \"radius\" and \"radius_1\" exclude each other");
    refuse(HEADER, "the file has no rows of numbers");
}

static void test_refused_rows(void)
{
    refuse(HEADER "0, 10, 1, 1\n", ":2:1: 4 fields in this line, but 5 in the header");
    refuse(HEADER "0, 10, 1, 1, 1, 1, 1, 1, 1, 1\n", ":2:1: 10 fields in this line, but 5");
    refuse(HEADER "0, 10, 1, 1, nan\n", ":2:14: \"nan\" is not a number");
    refuse(HEADER "0, 10, 1, 1, 1e308\n", ":2:14: 1e308 is out of range");
    refuse(HEADER "0, 10, 1, 1, 5\n\n-1, 10, 1, 1, 5\n", ":4:1: time must not decrease, but -1 s");
    refuse(HEADER "0,10,1,1,5\n0,10,1,1,5\n0,10,1,1,5\n",
           ":4:1: a jump has two rows with the same time");
    refuse(HEADER "0,10,1,1,5\n0,10,1,1,5\n", ":1:1: all rows have the same time");
    refuse(HEADER "0, 0, 1, 1, 5\n", ":2:4: radius must be at least 1e-06 mm, but is 0 mm");
    refuse(HEADER "0, 10, 1, 1, -5\n", ":2:14: load_per_width must be at least 0 N/mm, but is -5");
}

int main(void)
{
    test_rows_become_instants();
    test_a_row_is_a_constant_contact();
    test_gap_where_the_contact_is_lost();
    test_at_rest();
    test_refused_headers();
    test_refused_rows();
    return check_done();
}
