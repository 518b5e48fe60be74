/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the gears of a pipeline as a drawing states them. If values have a tolerance, the gears
 * are evaluated for every combination of their limits, and each number is printed with its smallest
 * and largest value. */
#include "drawing.h"

#include "../accuracy/models.h"
#include "../memory/memory.h"
#include "../results/json.h"
#include "../run/run.h"
#include "../study/kinds/uncertainty/tolerances.h"
#include "../terminal/terminal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL = 40, VALUE = 32, MOST_TOLERANCES = 10 };

/* A row of the table: an output of the gears, doubled if it is a radius. */
typedef struct drawing_row {
    const char *label, *output, *unit;
    bool radius;
    int decimals;
} drawing_row;

static const drawing_row rows[] = {
    {"number of teeth z", "teeth", "", false, 0},
    {"module m_n", "module", "mm", false, 4},
    {"pressure angle alpha_n", "pressure_angle", "deg", false, 4},
    {"profile shift x", "profile_shift", "", false, 4},
    {"tip diameter d_a", "tip_radius", "mm", true, 4},
    {"reference diameter d", "reference_radius", "mm", true, 4},
    {"base diameter d_b", "base_radius", "mm", true, 4},
    {"active root diameter d_Nf", "active_root_radius", "mm", true, 4},
    {"root form diameter d_Ff", "root_form_radius", "mm", true, 4},
    {"root diameter d_f", "root_radius", "mm", true, 4},
    {"face width b", "face_width", "mm", false, 3},
    {"tooth thickness s, without allowance", "tooth_thickness", "mm", false, 4},
    {"tooth thickness allowance E_sn", "thickness_allowance", "um", false, 1},
    {"tooth thickness at the tip s_a", "tip_thickness", "mm", false, 4},
    {"span over k teeth: k", "span_teeth", "", false, 0},
    {"span measure W_k", "span", "mm", false, 4},
    {"pin diameter D_M", "pin_diameter", "mm", false, 4},
    {"measure over pins M_d", "over_pins", "mm", false, 4},
    {"base pitch p_b", "base_pitch", "mm", false, 4},
    {"tool tip radius over the module", "tool_tip_radius", "", false, 4},
    {"single pitch tolerance f_pt", "single_pitch_tolerance", "um", false, 1},
    {"total pitch tolerance F_p", "total_pitch_tolerance", "um", false, 1},
    {"profile form tolerance f_f_alpha", "profile_form_tolerance", "um", false, 1},
    {"profile slope tolerance f_H_alpha", "profile_slope_tolerance", "um", false, 1},
    {"profile tolerance F_alpha", "profile_tolerance", "um", false, 1},
    {"roughness Rq", "roughness", "um", false, 3},
    {"Young's modulus E", "elastic_modulus", "GPa", false, 1},
    {"Poisson's ratio", "poisson_ratio", "", false, 3},
    {"mass", "mass", "kg", false, 4},
    {"inertia", "inertia", "kg m2", false, 8},
    {"centre distance a", "centre_distance", "mm", false, 4},
    {"working pressure angle alpha_w", "working_pressure_angle", "deg", false, 4},
    {"working pitch diameter d_w", "pitch_radius", "mm", true, 4},
    {"contact ratio epsilon_alpha", "contact_ratio", "", false, 4},
    {"backlash, along the line of action j_bn", "backlash", "um", false, 1},
};
enum { ROWS = sizeof rows / sizeof rows[0] };

/* Parameters of the gears that are printed below the numbers. */
static const struct {
    const char *label, *param;
} words[] = {{"material", "material"},
             {"material of gear 2", "material_2"},
             {"tip relief", "tip_relief"},
             {"tip relief from the roll angle", "tip_relief_start"},
             {"tip relief from the diameter", "tip_relief_diameter"},
             {"length of the tip relief", "tip_relief_length"},
             {"shape of the tip relief", "tip_relief_shape"},
             {"root relief", "root_relief"},
             {"root relief from the roll angle", "root_relief_start"},
             {"root relief from the diameter", "root_relief_diameter"},
             {"length of the root relief", "root_relief_length"},
             {"shape of the root relief", "root_relief_shape"},
             {"profile crown", "crowning"},
             {"accuracy class of ISO 1328-1", "quality"},
             {"dedendum of the tool over the module", "dedendum"},
             {"protuberance", "protuberance"},
             {"machining allowance", "machining_allowance"}};
enum { WORDS = sizeof words / sizeof words[0], WORD = 120 };

/* The numbers of a row in SI: one, or one for each gear. */
typedef struct drawing_numbers {
    size_t count;
    double value[2], low[2], high[2];
} drawing_numbers;

typedef struct drawing {
    const cli_options *options;
    cli_session *session;
    const char *stage;
    const study_toleranced *toleranced[MOST_TOLERANCES];
    size_t toleranced_count;
    drawing_numbers numbers[ROWS];
    char words[WORDS][WORD]; /* "" if the parameter is not given */
} drawing;

static bool is_pair(const ff_stage *stage)
{
    for (size_t i = 0; i < ROWS; i++)
        if (!stage->loaded || ff_model_find_output(stage->loaded->model, rows[i].output) < 0)
            return false;
    return true;
}

/* Sets a value to one end of its tolerance. */
static void set_end(ff_run *run, const study_toleranced *t, bool high)
{
    char *text = memory_print_text("%s=%.17g %s", t->path,
                                   high ? t->tolerance.high : t->tolerance.low, t->tolerance.unit);
    run_set(run, text, NULL, NULL);
    free(text);
}

/* Records the numbers of a run. The first run gives the values; later runs widen the ranges of the
   numbers. */
static void take(drawing *d, ff_run *run, bool first)
{
    for (size_t i = 0; i < ROWS; i++) {
        const ff_result *result;
        drawing_numbers *n = &d->numbers[i];
        char *path = memory_print_text("%s.%s", d->stage, rows[i].output);
        const bool there = ff_run_result(run, path, &result) == FF_OK;
        n->count = !there ? 0 : result->count < 2 ? result->count : 2;
        free(path);
        for (size_t g = 0; g < n->count; g++) {
            double value = result->data[g];
            n->value[g] = first ? value : n->value[g];
            n->low[g] = first ? value : fmin(n->low[g], value);
            n->high[g] = first ? value : fmax(n->high[g], value);
        }
    }
}

/* Stores the parameters as they are written in the file; "[15 um]", one value for both gears,
 * becomes "15 um". */
static void keep_words(drawing *d, const ff_stage *stage)
{
    for (size_t i = 0; i < WORDS; i++) {
        int at = ff_model_find_param(stage->loaded->model, words[i].param);
        char text[WORD];
        if (at < 0 || !stage->params[at].present)
            continue;
        ff_bound_print(stage, (size_t)at, text, sizeof text);
        size_t length = strlen(text);
        bool one = length > 2 && text[0] == '[' && text[length - 1] == ']' && !strchr(text, ',');
        snprintf(d->words[i], WORD, "%.*s", (int)(one ? length - 2 : length), text + one);
    }
}

/* Reads the file and applies --set, but not the cases of a study. */
static ff_run *read_file(const cli_session *session, const cli_options *options)
{
    ff_run *run = run_read(session->engine, options->operand);
    run_set_all(run, options->sets, options->set_count);
    return run;
}

/* Evaluates the gears. Bit k of `corner` says which end of its range the k-th value with a
 * tolerance takes; a negative `corner` leaves all at their middle. */
static bool evaluate(drawing *d, long corner)
{
    ff_run *run = read_file(d->session, d->options);
    for (size_t i = 0; corner >= 0 && i < d->toleranced_count; i++)
        set_end(run, d->toleranced[i], corner >> i & 1);
    char *outputs = memory_print_text("outputs=[%s.*]", d->stage);
    run_set(run, outputs, NULL, NULL);
    free(outputs);
    const ff_pipeline *pipeline = accuracy_build_alone(run, d->session->engine, false);
    const char *rest;
    const ff_stage *stage = pipeline ? ff_stage_of(pipeline, d->stage, &rest) : NULL;
    bool good = stage && !run_has_errors(run) && run_start(run, NULL);
    if (good)
        take(d, run, corner < 0);
    if (good && corner < 0)
        keep_words(d, stage);
    if (!good)
        terminal_print_messages(ff_run_report(run), stderr, terminal_colour(stderr));
    ff_run_close(run);
    return good;
}

static void write_number(const drawing_row *row, const drawing_numbers *n, size_t g,
                         char out[VALUE * 2])
{
    ff_unit unit;
    char why[200];
    const double si[] = {n->value[g], n->low[g], n->high[g]};
    double number[3];
    ff_unit_parse(row->unit, &unit, why, sizeof why);
    for (int i = 0; i < 3; i++)
        number[i] = ff_unit_from_si(&unit, row->radius ? 2 * si[i] : si[i]);
    int used = snprintf(out, VALUE, "%.*f", row->decimals, number[0]);
    if (number[2] - number[1] > 0.5 * pow(10, -row->decimals))
        snprintf(out + used, VALUE, " (%.*f to %.*f)", row->decimals, number[1], row->decimals,
                 number[2]);
}

static void print_row(const drawing_row *row, const drawing_numbers *n)
{
    char text[VALUE * 2];
    printf("  %-*s", LABEL, row->label);
    for (size_t g = 0; g < n->count; g++) {
        write_number(row, n, g, text);
        printf("  %-*s", g + 1 < n->count ? VALUE : 0, text);
    }
    printf("%s%s\n", *row->unit ? " " : "", row->unit);
}

static void print_table(const drawing *d)
{
    char title[400];
    const ff_pipeline *pipeline = d->session->pipeline;
    ff_clean_text(title, sizeof title, pipeline->title ? pipeline->title : d->options->operand);
    printf("%s\n\n%-*s  %-*s  gear 2\n", title, LABEL + 2, d->stage, VALUE, "gear 1");
    for (size_t i = 0; i < ROWS; i++)
        if (d->numbers[i].count > 0) /* 0 if the drawing does not have this row */
            print_row(&rows[i], &d->numbers[i]);
    for (size_t i = 0; i < WORDS; i++)
        if (*d->words[i])
            printf("  %-*s  %s\n", LABEL, words[i].label, d->words[i]);
    if (d->toleranced_count)
        printf("\nIn brackets: the smallest and the largest value within the tolerances of the "
               "file.\n");
}

static json_t *list_of(const double *numbers, size_t count)
{
    json_t *list = json_array();
    for (size_t g = 0; g < count; g++)
        json_array_append_new(list, json_real(numbers[g]));
    return list;
}

/* Returns {output: {value, lowest, highest}} in SI, each for one or for both gears, with radii
 * in place of diameters. */
static json_t *describe(const drawing *d)
{
    json_t *object = json_object();
    for (size_t i = 0; i < ROWS; i++) {
        const drawing_numbers *n = &d->numbers[i];
        if (n->count == 0)
            continue;
        json_object_set_new(object, rows[i].output,
                            json_pack("{s:o, s:o, s:o}", "value", list_of(n->value, n->count),
                                      "lowest", list_of(n->low, n->count), "highest",
                                      list_of(n->high, n->count)));
    }
    return object;
}

/* Finds the values of the stage that have a tolerance; false if there are too many. */
static bool find_toleranced(drawing *d, const study_toleranced *list, size_t count)
{
    size_t length = strlen(d->stage);
    for (size_t i = 0; i < count; i++) {
        if (strncmp(list[i].path, d->stage, length) != 0 || list[i].path[length] != '.')
            continue;
        if (d->toleranced_count == MOST_TOLERANCES) {
            fprintf(stderr, "%s has more than %d values with a tolerance\n", d->stage,
                    MOST_TOLERANCES);
            return false;
        }
        d->toleranced[d->toleranced_count++] = &list[i];
    }
    return true;
}

static bool measure(drawing *d)
{
    if (!evaluate(d, -1))
        return false;
    for (long corner = 0; d->toleranced_count && corner < 1L << d->toleranced_count; corner++)
        if (!evaluate(d, corner)) {
            fprintf(stderr, "%s: some gears within the tolerances of the file cannot be made\n",
                    d->stage);
            return false;
        }
    return true;
}

int cli_print_drawing(cli_session *session, const cli_options *options)
{
    memory_arena arena = {.blocks = NULL};
    const ff_pipeline *pipeline = session->pipeline;
    json_t *answer = json_object();
    size_t count, tables = 0;
    ff_run *file = read_file(session, options);
    const study_toleranced *list = study_find_toleranced(ff_run_root(file), &arena, &count);
    bool good = true;
    for (size_t i = 0; i < pipeline->count && good; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        drawing d = {.options = options, .session = session, .stage = stage->name};
        if (!is_pair(stage))
            continue;
        good = find_toleranced(&d, list, count) && measure(&d);
        if (good && options->json)
            json_object_set_new(answer, stage->name, describe(&d));
        else if (good)
            print_table(&d);
        tables++;
    }
    if (!tables)
        fprintf(stderr, "none of the stages that run is a pair of gears\n");
    if (good && tables && options->json)
        results_json_print(json_incref(answer));
    json_decref(answer);
    ff_run_close(file);
    memory_arena_free(&arena);
    return good && tables ? EXIT_SUCCESS : FF_FAULT_INPUT;
}
