/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of numbers: what is read, and what is refused at which place. */
#include "../../../core/engine/value/tables.h"

#include "value-check.h"

#include <fcntl.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const ff_param rows[] = {
    {.name = "time",
     .unit = "s",
     .doc = "of the instant",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_INCREASING},
    {.name = "angle",
     .unit = "deg",
     .doc = "of roll",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .group = "place",
     .min = -90,
     .max = 90},
    {.name = "length",
     .unit = "um",
     .doc = "along",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_MIN_OPEN | FF_MAX_OPEN,
     .group = "place",
     .min = 0,
     .max = 1e6},
    {.name = "gear", .unit = "1", .doc = "1 or 2", .type = FF_REALS, .flags = FF_WHOLE},
    {.name = "temperature", .unit = "K", .doc = "of the oil", .type = FF_REAL},
};
enum { TIME, ANGLE, LENGTH, GEAR, TEMPERATURE, COLUMNS };

static char path[64];
static const ff_table *table;
static ff_report *report;

static void set_up(void)
{
    strcpy(path, "/tmp/flankfilm-columns-XXXXXX");
    int file = mkstemp(path);
    ck_assert(file >= 0);
    close(file);
    report = ff_report_new();
}

static void tear_down(void)
{
    unlink(path);
    ff_columns_free(table);
    ff_report_free(report);
}

static void write_bytes(const char *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    ck_assert(file && fwrite(bytes, 1, length, file) == length && fclose(file) == 0);
}

static bool read_file(const char *file, const ff_param *asked, size_t count)
{
    ff_columns_free(table);
    table = ff_columns_read(file, asked, count, sizeof *asked, report);
    return table;
}

static bool read_rows(const ff_param *asked, size_t count)
{
    return read_file(path, asked, count);
}

static bool read_text(const char *text)
{
    write_bytes(text, strlen(text));
    return read_rows(rows, COLUMNS);
}

typedef struct form {
    const char *text;
} form;

/* 0 s at 10 deg, 0.5 s at 20 deg */
static const form forms[] = {
    {"time [s], angle [deg]\n0, 10\n0.5, 20\n"},
    {"time [s],angle [deg]\n0,10\n0.5,20"},
    {"time[s];angle[deg]\r\n0;10\r\n0.5;20\r\n"},
    {"time[s];angle[deg]\r0;10\r0.5;20\r"},
    {"angle [deg]\ttime [ms]\n10\t0\n20\t500\n"},
    {"  time [s]   angle [ deg ]\n 0   10 \n 0.5 20\n"},
    {"\xef\xbb\xbftime [s], angle [deg]\n0, 10\n0.5, 20\n"},
    {"\"time [s]\",\"angle [deg]\",\"x-who\"\n0,10,\"Ada\"\n\"0.5\",20,\"\"\n"},
    {"\"time [s]\" \"angle [deg]\"\n0 10\n0.5 20\n"},
    {"\"x-who; where\",time [s],angle [deg]\n\"b, c\",0,10\n\"a \"\"b\"\", c\",0.5,20\n"},
    {"time [s], angle [deg], \"x-a; b\"\n0, 10, \"\"\"so, so\"\"\"\n0.5, 20, 5\" or 6\"\n"},
    {"time [s] angle [deg] x-who\n0 10 \"Ada L.\"\n0.5 20 \"\"\n"},
    {"# a remark\n\n \t\ntime [s], angle [deg]\n# more\n0, 10\n\n0.5, 20\n#"},
    {"time [s], angle [mrad], x-who, x-when [day]\n0, 174.53292519943295, Ada, 3\n"
     "5e-1, 349.0658503988659, , none\n"},
    {"time [s], angle [deg]\n0; 10\n0.5 20\n"},
    {"time [s] angle [deg]\n0, 10\n0.5;20\n"},
    {"time [s]; angle [deg]\n+0; 1e1\n.5; 20.\n"},
};

START_TEST(forms_that_are_read)
{
    ck_assert(read_text(forms[_i].text));
    ck_assert_uint_eq(ff_report_count(report), 0);
    ck_assert_uint_eq(table->row_count, 2);
    const double *const *column = table->columns;
    ck_assert_double_eq(column[TIME][0], 0);
    ck_assert_double_eq_tol(column[TIME][1], 0.5, 1e-16);
    ck_assert_double_eq_tol(column[ANGLE][0], 10 * M_PI / 180, 1e-15);
    ck_assert_double_eq_tol(column[ANGLE][1], 20 * M_PI / 180, 1e-15);
    ck_assert_ptr_null(column[LENGTH]);
    ck_assert_ptr_null(column[GEAR]);
}
END_TEST

START_TEST(units_of_all_kinds)
{
    ck_assert(read_text("time [µs]; length [\u03bcm]; gear; temperature [degC]\n"
                        "3; 7; 2; 80\n"));
    const double *const *column = table->columns;
    ck_assert_double_eq_tol(column[TIME][0], 3e-6, 1e-21);
    ck_assert_double_eq_tol(column[LENGTH][0], 7e-6, 1e-21);
    ck_assert_double_eq(column[GEAR][0], 2);
    ck_assert_double_eq_tol(column[TEMPERATURE][0], 353.15, 1e-12);
}
END_TEST

/* 90 deg is a limit, whichever unit it is written in. */
START_TEST(limits_are_met)
{
    ck_assert(read_text("time [s], angle [rad]\n0, 1.5707963267948966\n1, -1.5707963267948966\n"));
    ck_assert(table->columns[ANGLE][0] >= 90 * (M_PI / 180));
}
END_TEST

START_TEST(a_comma_is_no_point_in_any_locale)
{
    setlocale(LC_ALL, "de_DE.UTF-8");
    ck_assert(read_text("time [s]; angle [deg]\n0.25; 10\n"));
    ck_assert_double_eq(table->columns[TIME][0], 0.25);
    setlocale(LC_ALL, "C");
}
END_TEST

START_TEST(lines_and_places)
{
    ck_assert(read_text("# µ\ntime [s], angle [deg], gear\n\n0, 10, 1\n# b\n 0.5,  20, 2\n"));
    ck_assert_uint_eq(table->lines[0], 4);
    ck_assert_uint_eq(table->lines[1], 6);
    ff_place cell = ff_columns_place(table, 1, ANGLE);
    ck_assert(cell.line == 6 && cell.column == 8 && cell.width == 2);
    ff_place row = ff_columns_place(table, 0, SIZE_MAX);
    ck_assert(row.line == 4 && row.column == 1 && row.width == 8);
    ff_place head = ff_columns_place(table, SIZE_MAX, ANGLE);
    ck_assert(head.line == 2 && head.column == 11 && head.width == 11);
    ff_place all = ff_columns_place(table, SIZE_MAX, SIZE_MAX);
    ck_assert(all.source && all.line == 0);
    ff_place absent = ff_columns_place(table, 1, LENGTH);
    ck_assert(absent.line == 6 && absent.width == 11);
}
END_TEST

typedef struct refusal {
    const char *text, *said;
    uint32_t line, column, width;
} refusal;

#define HEAD "time [s], angle [deg]\n"

static const refusal refusals[] = {
    {"", "the file has no header and no numbers", 0, 1, 0},
    {"# only\n\n", "the file has no header and no numbers", 0, 1, 0},
    {HEAD, "the file has no rows of numbers below its header", 0, 1, 0},
    {"tim [s], angle [deg]\n0,1\n", "no column is called \"tim\"", 1, 1, 7},
    {"µ [s], angle [deg]\n0,1\n", "no column is called \"µ\"", 1, 1, 5},
    {"time [s], angle [deg], time [s]\n0,1,2\n", "the column \"time\" occurs twice", 1, 24, 8},
    {"time [s], angle [deg],\n0,1,2\n", "no column is called \"\"", 1, 23, 0},
    {"time, angle [deg]\n0,1\n",
     "the column \"time\" needs its unit in brackets, such as \"time [s]\"", 1, 1, 4},
    {"time [s, angle [deg]\n0,1\n", "the unit belongs in brackets at the end, as in \"time [s]\"",
     1, 1, 7},
    {"gear [, time [s], angle [deg]\n0,1,1\n",
     "the unit belongs in brackets at the end, as in \"gear\"", 1, 1, 6},
    {"time [furlong], angle [deg]\n0,1\n", "the unit \"furlong\" ", 1, 1, 14},
    {"time [m], angle [deg]\n0,1\n",
     "the column \"time\" is in \"m\", but should be in a unit such as s", 1, 1, 8},
    {"time [s], angle\n0,1\n", "the column \"angle\" needs its unit", 1, 11, 5},
    {"angle [deg]\n1\n", "the column \"time [s]\" is missing: of the instant", 1, 1, 0},
    {"time [s]\n1\n", "the column \"angle [deg]\" or \"length [um]\" is missing: of roll", 1, 1, 0},
    {"time [s], angle [deg], length [um]\n1,2,3\n",
     "the columns \"angle\" and \"length\" exclude each other", 1, 24, 11},
    {HEAD "0\n", "1 field in this line, but 2 in the header", 2, 1, 1},
    {HEAD "0, 1, 2\n", "3 fields in this line, but 2 in the header", 2, 1, 7},
    {HEAD "0, 1\n\n# x\n1, 2,\n", "3 fields in this line, but 2 in the header", 5, 1, 5},
    {HEAD "0, \n", "angle has no number here", 2, 3, 0},
    {HEAD "0, x\n", "\"x\" is not a number", 2, 4, 1},
    {HEAD "0, 1e\n", "\"1e\" is not a number", 2, 4, 2},
    {HEAD "0, 0x10\n", "\"0x10\" is not a number", 2, 4, 4},
    {HEAD "0, 1 deg\n", "\"1 deg\" is not a number", 2, 4, 5},
    {HEAD "0, nan\n", "\"nan\" is not a number", 2, 4, 3},
    {HEAD "0, inf\n", "\"inf\" is not a number", 2, 4, 3},
    {HEAD "1e999, 1\n", "1e999 is out of range", 2, 1, 5},
    {"time [s]; angle [deg]\n0,5; 1\n", "\"0,5\" is not a number", 2, 1, 3},
    {HEAD "0, 90.5\n", "angle must be at most 90 deg, but is 90.5 deg", 2, 4, 4},
    {HEAD "0, -91\n", "angle must be at least -90 deg, but is -91 deg", 2, 4, 3},
    {"time [s], length [mm]\n0, 0\n", "length must be above 0 um, but is 0 um", 2, 4, 1},
    {"time [s], length [m]\n0, 1\n", "length must be below 1e+06 um, but is 1e+06 um", 2, 4, 1},
    {"time [s], angle [deg], gear\n0, 1, 1.5\n", "gear must be a whole number", 2, 7, 3},
    {HEAD "0, \"1\n", "this field begins with a quote, but does not end with it", 2, 4, 2},
    {HEAD "\"0\"5, 1\n", "this field begins with a quote, but does not end with it", 2, 1, 4},
    {"time [s], \"angle [deg]\n0, 1\n", "this field begins with a quote, but", 1, 11, 12},
    {HEAD "1, 1\n0.5, 1\n", "time must not decrease, but 0.5 s follows 1 s", 3, 1, 3},
};

START_TEST(files_that_are_refused)
{
    const refusal *r = &refusals[_i];
    ck_assert(!read_text(r->text));
    ck_assert_uint_eq(ff_report_errors(report), 1);
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_INPUT);
    const ff_message *m = ff_report_at(report, 0);
    ck_assert_msg(!strncmp(m->text, r->said, strlen(r->said)), "%s", m->text);
    ck_assert_str_eq(m->place.source->name, path);
    ck_assert_uint_eq(m->place.line, r->line);
    if (r->line) {
        ck_assert_uint_eq(m->place.column, r->column);
        ck_assert_uint_eq(m->place.width, r->width);
    }
}
END_TEST

static const char *hint_of(const char *text)
{
    ck_assert(!read_text(text));
    return ff_report_at(report, ff_report_count(report) - 1)->hint;
}

START_TEST(hints)
{
    ck_assert_str_eq(hint_of("tiem [s], angle [deg]\n0,1\n"),
                     "did you mean \"time\"? The name of a column of your own begins with x-");
    ck_assert_str_eq(hint_of("time [s], angle [deg], whatever\n0,1,2\n"),
                     "the columns are time [s], angle [deg], length [um], gear, temperature [K]; "
                     "the name of a column of your own begins with x-");
    ck_assert_str_eq(hint_of("time [s]; angle [deg]\n0,5; 1\n"), "write a decimal point");
    ck_assert_str_eq(hint_of("time [s]; angle [foo]\n0;1\n"), "write for example \"angle [deg]\"");
}
END_TEST

START_TEST(all_that_is_wrong_comes_at_once_but_not_for_ever)
{
    ck_assert(!read_text("time [h], angle [m], more\n0, 1, 2\n"));
    ck_assert_uint_eq(ff_report_errors(report), 2); /* an hour is a time */
    ck_assert(!read_text(HEAD "x, 1\n1, y\n2, 91\n1, 3\n"));
    ck_assert_uint_eq(ff_report_errors(report), 6);
    char text[2000] = HEAD;
    for (int i = 0; i < 300; i++)
        strcat(text, "x, 1\n");
    ck_assert(!read_text(text));
    ck_assert_uint_eq(ff_report_errors(report), 26);
}
END_TEST

START_TEST(no_text)
{
    static const char zero[] = HEAD "0,1\0\n";
    write_bytes(zero, sizeof zero - 1);
    ck_assert(!read_rows(rows, COLUMNS));
    const ff_message *m = ff_report_at(report, 0);
    ck_assert_str_eq(m->text, "this is not a text file: it has a zero byte here");
    ck_assert(m->place.line == 2 && m->place.column == 4);
    static const char *const names[] = {"/tmp", "/dev/zero", "/dev/null", "/no/such/file"};
    for (size_t i = 0; i < ROWS(names); i++) {
        ck_assert(!read_file(names[i], rows, COLUMNS));
        m = ff_report_at(report, i + 1);
        ck_assert_str_eq(m->text, i < 3 ? "this is not a text file"
                                        : "the file cannot be read: No such file or directory");
    }
}
END_TEST

START_TEST(bounded_files)
{
    FILE *file = fopen(path, "w");
    ck_assert(file && fseek(file, 1 << 27, SEEK_SET) == 0 && fputc('x', file) == 'x');
    fclose(file);
    ck_assert(!read_rows(rows, COLUMNS));
    ck_assert_str_eq(ff_report_at(report, 0)->text, "the file is larger than 128 MiB");
    char header[1000] = "x-0";
    for (int i = 0; i < 100; i++)
        strcat(header, ",x-1");
    ck_assert(!read_text(header));
    ck_assert_str_eq(ff_report_at(report, 1)->text, "the header names more than 100 columns");
}
END_TEST

START_TEST(number_of_rows)
{
    static const ff_param some[] = {
        {.name = "a", .unit = "1", .doc = "", .type = FF_REALS, .min_count = 2, .max_count = 3}};
    static const char *const texts[] = {"a\n1\n", "a\n1\n2\n", "a\n1\n2\n3\n",
                                        "a\n1\n2\n3\n4\n5\n"};
    for (size_t i = 0; i < ROWS(texts); i++) {
        write_bytes(texts[i], strlen(texts[i]));
        ck_assert(read_rows(some, 1) == (i == 1 || i == 2));
    }
    ck_assert_uint_eq(ff_report_errors(report), 2);
    ck_assert_str_eq(ff_report_at(report, 0)->text, "the table must have at least 2 rows");
    ck_assert_str_eq(ff_report_at(report, 1)->text, "the table has more than 3 rows");
    ck_assert_uint_eq(ff_report_at(report, 1)->place.line, 5);
}
END_TEST

START_TEST(a_unit_of_the_plugin_that_is_none)
{
    static const ff_param bad[] = {{.name = "a", .unit = "sek", .doc = "", .type = FF_REALS}};
    write_bytes("a\n1\n", 4);
    ck_assert(!read_rows(bad, 1));
    ck_assert_int_eq(ff_report_fault(report), FF_FAULT_PLUGIN);
}
END_TEST

/* The report can be printed when the table is gone. */
START_TEST(the_report_keeps_the_text)
{
    ff_report *other = ff_report_new();
    ck_assert(!read_text(HEAD "0, x\n1, y\n"));
    for (size_t i = 0; i < ff_report_count(report); i++)
        ff_error(other, FF_FAULT_INPUT, ff_report_at(report, i)->place, NULL, "%s",
                 ff_report_at(report, i)->text);
    ff_report_free(report);
    report = other;
    char *printed = ff_report_text(report, false);
    ck_assert_ptr_nonnull(strstr(printed, ":2:4: error: \"x\" is not a number\n    2 | 0, x\n"
                                          "      |    ^\n"));
    ck_assert_ptr_nonnull(strstr(printed, ":3:4: error: \"y\" is not a number\n    3 | 1, y\n"));
    ff_free(printed);
}
END_TEST

START_TEST(tables_of_an_instance)
{
    fe_tables tables = {.kept = NULL};
    const ff_table *first, *second, *third;
    char why[200], expected[200];
    write_bytes(HEAD "0, 1\n", strlen(HEAD) + 5);
    ck_assert(fe_tables_read(&tables, "one", path, rows, COLUMNS, sizeof *rows, &first) == FF_OK);
    write_bytes(HEAD "0, 2\n1, 2\n", strlen(HEAD) + 10);
    ck_assert(fe_tables_read(&tables, "two", path, rows, COLUMNS, sizeof *rows, &second) == FF_OK);
    ck_assert(first->row_count == 1 && second->row_count == 2 && !tables.errors);
    ck_assert(fe_tables_read(&tables, "none", "/no/such/file", rows, COLUMNS, sizeof *rows,
                             &third) == FF_INVALID);
    ck_assert(!third && tables.errors && !strcmp(tables.item, "none"));
    ck_assert(fe_tables_fail(&tables, first, 0, ANGLE, "too small") == FF_INVALID);
    fe_tables_print(&tables, why, sizeof why);
    snprintf(expected, sizeof expected, "%s:2:4: too small", path);
    ck_assert_str_eq(why, expected);
    ck_assert_str_eq(tables.item, "one");
    ck_assert(fe_tables_fail(&tables, second, 7, 99, "all of it") == FF_INVALID);
    fe_tables_print(&tables, why, sizeof why);
    snprintf(expected, sizeof expected, "%s: all of it", path);
    ck_assert_str_eq(why, expected);
    ck_assert(fe_tables_fail(&tables, &(ff_table){.size = 0}, 0, 0, "whose?") == FF_BUG);
    ck_assert(!tables.errors);
    fe_tables_free(&tables);
}
END_TEST

static const void *no_extension(void *ctx, const char *id)
{
    (void)ctx, (void)id;
    return NULL;
}

static ff_status keep_text(void *ctx, ff_status status, const char *item, const char *text)
{
    (void)item;
    snprintf(ctx, 200, "%s", text);
    return status;
}

/* Writes the file as one that nobody has touched since the given second. */
static void write_long_ago(const char *text, time_t second)
{
    const struct timespec then[] = {{second, 0}, {second, 0}};
    write_bytes(text, strlen(text));
    ck_assert(utimensat(AT_FDCWD, path, then, 0) == 0);
}

static const ff_table *ask(fe_tables *tables, const ff_param *asked)
{
    const ff_table *got;
    ck_assert(fe_tables_read(tables, "one", path, asked, COLUMNS, sizeof *rows, &got) == FF_OK);
    return got;
}

/* The next instance gets the table of the one before, unless the file or the columns are others. */
START_TEST(tables_that_go_on)
{
    fe_tables tables = {.kept = NULL};
    ff_param others[COLUMNS];
    memcpy(others, rows, sizeof rows);
    others[ANGLE].max = 80;
    write_long_ago(HEAD "0, 1\n", 1000);
    const ff_table *first = ask(&tables, rows);
    const ff_table *beside = ask(&tables, rows);
    ck_assert(beside != first);
    fe_tables_release(&tables);
    const ff_table *again = ask(&tables, rows);
    ck_assert(again == first || again == beside);
    ck_assert(again->columns[ANGLE][0] > 0 && again->row_count == 1);
    fe_tables_release(&tables);
    ck_assert(ask(&tables, others) != again);
    fe_tables_release(&tables);
    write_long_ago(HEAD "0, 2\n", 1000); /* the size and the time of the first */
    double angle = ask(&tables, others)->columns[ANGLE][0];
    ck_assert(fabs(angle - 2 * acos(-1) / 180) < 1e-15);
    fe_tables_release(&tables);
    write_bytes(HEAD "0, 3\n", strlen(HEAD) + 5);
    ask(&tables, others); /* of a file so new that it may change unseen */
    fe_tables_release(&tables);
    write_bytes(HEAD "0, 4\n", strlen(HEAD) + 5);
    ck_assert(ask(&tables, others)->columns[ANGLE][0] > 3.5 * acos(-1) / 180);
    fe_tables_release(&tables);
    unlink(path);
    ck_assert(fe_tables_read(&tables, "one", path, rows, COLUMNS, sizeof *rows, &first) ==
              FF_INVALID);
    fe_tables_free(&tables);
}
END_TEST

START_TEST(a_host_without_tables)
{
    char text[200] = "";
    ff_host host = {.size = sizeof host, .ctx = text, .fail = keep_text, .extension = no_extension};
    const ff_table *none;
    ck_assert(ff_table_read(&host, "file", path, FF_TABLE(rows), &none) == FF_UNSUPPORTED);
    ck_assert_ptr_nonnull(strstr(text, "cannot read tables for models (flankfilm.table/1)"));
}
END_TEST

int main(void)
{
    static const TTest *const *const tests[] = {
        &units_of_all_kinds,
        &limits_are_met,
        &a_comma_is_no_point_in_any_locale,
        &lines_and_places,
        &hints,
        &all_that_is_wrong_comes_at_once_but_not_for_ever,
        &no_text,
        &bounded_files,
        &number_of_rows,
        &a_unit_of_the_plugin_that_is_none,
        &the_report_keeps_the_text,
        &tables_of_an_instance,
        &tables_that_go_on,
        &a_host_without_tables,
    };
    Suite *suite = suite_create("columns");
    TCase *group = tcase_create("tables");
    tcase_add_checked_fixture(group, set_up, tear_down);
    tcase_add_loop_test(group, forms_that_are_read, 0, (int)ROWS(forms));
    tcase_add_loop_test(group, files_that_are_refused, 0, (int)ROWS(refusals));
    for (size_t i = 0; i < ROWS(tests); i++)
        tcase_add_test(group, *tests[i]);
    suite_add_tcase(suite, group);
    return run_suite(suite);
}
