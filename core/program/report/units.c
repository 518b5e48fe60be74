/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Units and words that engineers use. */
#include <flankfilm/engine.h>

#include "../results/number.h"
#include "page.h"

#include <math.h>
#include <string.h>

static const char temperature[] = "K, not a difference";

/* The first row of a unit whose `from` is reached is used. */
static const struct {
    const char *si;
    double from;
    report_unit unit;
} rows[] = {
    {"m", 10, {1, 0, "m"}},
    {"m", 1e-3, {1e3, 0, "mm"}},
    {"m", 1e-7, {1e6, 0, "µm"}},
    {"m", 0, {1e9, 0, "nm"}},
    {"Pa", 5e7, {1e-9, 0, "GPa"}},
    {"Pa", 1e5, {1e-6, 0, "MPa"}},
    {"Pa", 0, {1e-3, 0, "kPa"}},
    {"rad", 0, {57.29577951308232, 0, "deg"}},
    {"s", 1, {1, 0, "s"}},
    {"s", 1e-3, {1e3, 0, "ms"}},
    {"s", 0, {1e6, 0, "µs"}},
    {"N", 1e4, {1e-3, 0, "kN"}},
    {"N/m", 2e7, {1e-6, 0, "N/µm"}},
    {"N/m", 0, {1e-3, 0, "N/mm"}},
    {"rad/s", 0, {9.549296585513721, 0, "rpm"}},
    {temperature, 0, {1, -273.15, "degC"}},
    {"W/m", 0, {1e-3, 0, "W/mm"}},
    {"Pa s", 0, {1e3, 0, "mPa s"}},
    {"1/Pa", 0, {1e9, 0, "1/GPa"}},
    {"m/s", 1e-2, {1, 0, "m/s"}},
    {"m/s", 0, {1e3, 0, "mm/s"}},
    {"m2/s", 0, {1e6, 0, "mm2/s"}},
    {"kg m2", 0, {1e6, 0, "kg mm2"}},
    {"1", 0, {1, 0, ""}},
};

const char *report_si_unit(const char *si_unit, const char *output)
{
    return results_is_temperature(output, si_unit) ? temperature : si_unit;
}

report_unit report_unit_for(const char *si_unit, double magnitude)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(rows[i].si, si_unit) && fabs(magnitude) >= rows[i].from)
            return rows[i].unit;
    return (report_unit){1, 0, si_unit};
}

double report_convert(const report_unit *unit, double si)
{
    return si * unit->factor + unit->offset;
}

void report_number_text(double value, char out[REPORT_TEXT_SIZE])
{
    if (isfinite(value))
        snprintf(out, REPORT_TEXT_SIZE, "%.4g", value);
    else
        strcpy(out, "–");
}

void report_quantity_text(const char *si_unit, double si, char out[REPORT_TEXT_SIZE])
{
    report_unit unit = report_unit_for(si_unit, si);
    report_number_text(report_convert(&unit, si), out);
    if (isfinite(si) && *unit.unit) {
        size_t length = strlen(out);
        snprintf(out + length, REPORT_TEXT_SIZE - length, " %s", unit.unit);
    }
}

const char *report_output_words(const char *output, char out[REPORT_TEXT_SIZE])
{
    static const char *const words[][2] = {
        {"h_min", "least film thickness"},
        {"h_min_lowest", "least film thickness of the engagement"},
        {"h_central", "central film thickness"},
        {"p_max", "highest pressure"},
        {"p_max_highest", "highest pressure of the engagement"},
        {"hertz_pressure", "Hertz pressure"},
        {"dte", "dynamic transmission error"},
        {"dte_rms", "dynamic transmission error, rms"},
        {"dte_mean", "dynamic transmission error, mean"},
        {"dte_peak_to_peak", "dynamic transmission error, peak to peak"},
        {"transmission_error", "unloaded transmission error"},
        {"loaded_transmission_error", "loaded static transmission error"},
        {"stiffness", "mesh stiffness"},
        {"stiffness_mean", "mean mesh stiffness"},
        {"load_per_width", "load per width"},
        {"tooth_force", "tooth force"},
        {"mesh_force", "mesh force"},
        {"load_share", "load share of a tooth pair"},
        {"speed_1", "surface speed of gear 1"},
        {"speed_2", "surface speed of gear 2"},
        {"entrainment_speed", "entrainment speed"},
        {"sliding_speed", "sliding speed"},
        {"friction_coefficient", "friction coefficient"},
        {"power_loss", "power loss"},
        {"mesh_power_loss", "power loss of the mesh"},
        {"flash_temperature", "flash temperature rise"},
        {"contact_temperature", "temperature of the contact"},
        {"lambda_ratio", "lambda ratio"},
        {"asperity_load_share", "asperities' share of the load"},
        {"roll_angle", "roll angle of gear 1"},
        {"phase", "phase in mesh cycles"},
        {"x", "position in the contact"},
        {"mesh_frequency", "mesh frequency"},
        {"atlas_frequency", "mesh frequency"},
        {"height_1", "height of flank 1"},
        {"height_2", "height of flank 2"},
        {"arc", "position along the flank"},
        {"h_min_lowest_at", "where the film is least"},
        {"p_max_highest_at", "where the pressure is highest"},
        {"lambda_ratio_lowest", "lowest lambda ratio"},
        {"power_loss_mean", "mean power loss of the mesh"},
        {"flash_temperature_max", "highest flash temperature rise"},
        {"contact_temperature_max", "highest temperature of the contact"},
        {"dynamic_factor_tooth", "largest dynamic over static tooth force"},
        {"dynamic_factor_mesh", "largest over static mesh force"},
        {"stable_motions", "number of stable motions"},
        {"efficiency", "efficiency of the mesh"},
        {"contact_loss", "share of the time without contact"},
        {"back_contact", "share of the time in back contact"},
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcmp(words[i][0], output))
            return words[i][1];
    snprintf(out, REPORT_TEXT_SIZE, "%s", output);
    for (char *at = out; *at; at++)
        if (*at == '_')
            *at = ' ';
    return out;
}

const char *report_axis_word(const results_view_axis *axis, size_t point,
                             char out[REPORT_TEXT_SIZE])
{
    enum { LONG = 14 };
    double number;
    const char *word = axis->words[point], *end;
    if (strlen(word) < LONG)
        return word;
    if (axis->values)
        report_quantity_text(report_si_unit(axis->unit, axis->path), axis->values[point], out);
    else if (ff_number_parse(word, &number, &end) && (*end == ' ' || !*end))
        snprintf(out, REPORT_TEXT_SIZE, "%.4g%.40s", number, end);
    else
        return word;
    return out;
}

void report_label(const char *words, const report_unit *unit, char out[REPORT_TEXT_SIZE])
{
    snprintf(out, REPORT_TEXT_SIZE, *unit->unit ? "%s (%s)" : "%s", words, unit->unit);
}

/* Numbers need a name where several are varied; words speak for themselves. */
static const char *name_of_number(const results_view_axis *axis, const char *value, bool several,
                                  char out[REPORT_TEXT_SIZE])
{
    double number;
    const char *end, *dot = strrchr(axis->path, '.');
    out[0] = '\0';
    if (several && ff_number_parse(value, &number, &end)) {
        char words[REPORT_TEXT_SIZE];
        snprintf(out, REPORT_TEXT_SIZE, "%.60s ",
                 report_output_words(dot ? dot + 1 : axis->path, words));
    }
    return out;
}

void report_name_case(const results_view *view, size_t index, size_t a, int b,
                      char out[REPORT_TEXT_SIZE])
{
    size_t length = 0;
    char word[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    size_t varied = 0;
    for (size_t k = 0; k < view->axis_count; k++)
        varied += view->lengths[view->axes[k]->dimension] > 1;
    out[0] = '\0';
    for (size_t k = 0; k < view->axis_count && length < REPORT_TEXT_SIZE; k++) {
        const results_view_axis *axis = view->axes[k];
        size_t d = axis->dimension;
        const char *value = report_axis_word(axis, results_view_point(view, index, d), word);
        if (d != a && (int)d != b && view->lengths[d] > 1 && *value)
            length += (size_t)snprintf(out + length, REPORT_TEXT_SIZE - length, "%s%s%.80s",
                                       length ? ", " : "",
                                       name_of_number(axis, value, varied > 1, name), value);
    }
}
