/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Shows the fields of the contact at instants of the engagement. The frames go into the page as
 * 32-bit numbers in base64; a script draws the one that the slider stands at.
 */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDE = 30, FRAMES = 121, CELLS = 513, MOST_STAGES = 3 };

/* The fields, and the letters that script.js knows them by. */
enum { PRESSURE, FILM, ASPERITIES, ROUGHNESS, TEMPERATURE, FIELDS };
static const char *const field_outputs[FIELDS] = {"pressure", "film", "asperity_pressure",
                                                  "roughness", "temperature"};
static const char field_letters[] = "phart";

/* The fields of one stage; those of pressure and film are there, others have no data. */
typedef struct stage_fields {
    size_t stage;
    ff_array field[FIELDS], x, at; /* at: what the instants are named after */
    bool angle;                    /* at is an angle */
    size_t frames, cells;          /* of the fields */
    size_t peak, low;              /* the instants of the highest pressure and of the least film */
} stage_fields;

/* Loads a field, which is left out when it does not have the shape of the pressure. */
static void load_field(report_page *page, stage_fields *m, size_t f)
{
    int v = report_find_output(page->view, m->stage, field_outputs[f]);
    if (v < 0 || page->view->variables[v]->rank != 2)
        return;
    m->field[f] = report_load(page, v, 0);
    if (f != PRESSURE && report_array_size(&m->field[f]) != report_array_size(&m->field[PRESSURE]))
        report_release(page, &m->field[f]);
}

static bool load_fields(report_page *page, size_t stage, stage_fields *m)
{
    const results_view *view = page->view;
    int pressure = report_find_output(view, stage, field_outputs[PRESSURE]);
    *m = (stage_fields){.stage = stage};
    for (size_t f = 0; f < FIELDS && (f == 0 || m->field[PRESSURE].data); f++)
        load_field(page, m, f);
    if (report_array_size(&m->field[PRESSURE]) == 0 || !m->field[FILM].data)
        return false;
    int at = report_find_axis(view, (size_t)pressure, 0, 0);
    m->x = report_load(page, report_find_axis(view, (size_t)pressure, 1, 0), 0);
    m->at = report_load(page, at, 0);
    m->angle = m->at.data && !strcmp(view->variables[at]->unit, "rad");
    m->frames = m->field[PRESSURE].shape[0];
    m->cells = m->field[PRESSURE].shape[1];
    m->peak = report_find_extremes(&m->field[PRESSURE]).greatest / m->cells;
    m->low = report_find_extremes(&m->field[FILM]).least / m->cells;
    return true;
}

static void release_fields(report_page *page, stage_fields *m)
{
    for (size_t f = 0; f < FIELDS; f++)
        report_release(page, &m->field[f]);
    report_release(page, &m->x);
    report_release(page, &m->at);
}

/* Returns the index of point k of `kept` points that are spread over `count`. */
static size_t sample_index(size_t k, size_t kept, size_t count)
{
    return kept > 1 ? k * (count - 1) / (kept - 1) : 0;
}

/* The instants that are shown are spread evenly, but for those of the extremes, which are moved
   onto. */
static size_t frame_at(const stage_fields *m, size_t k, size_t kept)
{
    const size_t extremes[] = {m->peak, m->low};
    size_t frame = sample_index(k, kept, m->frames);
    for (size_t i = 0; i < 2 && kept > 1 && k > 0 && k + 1 < kept; i++) {
        size_t before = sample_index(k - 1, kept, m->frames);
        size_t after = sample_index(k + 1, kept, m->frames);
        if (2 * extremes[i] > before + frame && 2 * extremes[i] <= frame + after)
            frame = extremes[i];
    }
    return frame;
}

static void put_base64(FILE *out, const unsigned char *data, size_t size)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned bits = (unsigned)data[i] << 16 | (left > 1 ? (unsigned)data[i + 1] << 8 : 0) |
                        (left > 2 ? data[i + 2] : 0u);
        fputc(letters[bits >> 18], out);
        fputc(letters[bits >> 12 & 63], out);
        fputc(left > 1 ? letters[bits >> 6 & 63] : '=', out);
        fputc(left > 2 ? letters[bits & 63] : '=', out);
    }
}

/* Writes chosen numbers as little-endian floats; of an array that is not there their ranks. */
static void put_floats(FILE *out, const ff_array *from, const size_t *chosen, size_t count,
                       const study_readable *unit)
{
    unsigned char *bytes = memory_alloc(4 * count);
    for (size_t i = 0; i < count; i++) {
        const float number =
            (float)(from->data ? report_convert(unit, from->data[chosen[i]]) : (double)chosen[i]);
        uint32_t bits;
        memcpy(&bits, &number, sizeof bits);
        for (int b = 0; b < 4; b++)
            bytes[4 * i + (size_t)b] = (unsigned char)(bits >> (8 * b));
    }
    fputc('"', out);
    put_base64(out, bytes, 4 * count);
    fputc('"', out);
    free(bytes);
}

/* Writes the instants, the places and the fields of a stage. */
static void put_stage(FILE *out, const stage_fields *m, size_t frames, size_t cells,
                      const study_readable *at, const study_readable *x,
                      const study_readable unit[FIELDS])
{
    size_t *chosen = memory_alloc(frames * cells * sizeof *chosen);
    for (size_t k = 0; k < frames; k++)
        chosen[k] = frame_at(m, k, frames);
    fputs(",\"at\":", out);
    put_floats(out, &m->at, chosen, frames, at);
    for (size_t i = 0; i < cells; i++)
        chosen[i] = sample_index(i, cells, m->cells);
    fputs(",\"x\":", out);
    put_floats(out, &m->x, chosen, cells, x);
    for (size_t k = 0; k < frames; k++)
        for (size_t i = 0; i < cells; i++)
            chosen[k * cells + i] =
                frame_at(m, k, frames) * m->cells + sample_index(i, cells, m->cells);
    for (size_t f = 0; f < FIELDS; f++)
        if (m->field[f].data) {
            fprintf(out, ",\"%c\":", field_letters[f]);
            put_floats(out, &m->field[f], chosen, frames * cells, &unit[f]);
        }
    free(chosen);
}

/* Finds the largest film of all instants in the middle of the contact: away from it the gap is
   open. */
static double central_film(const stage_fields *m)
{
    double size = 0;
    for (size_t k = 0; k < m->frames; k++) {
        const double *p = m->field[PRESSURE].data + k * m->cells;
        size_t peak = 0;
        for (size_t i = 1; i < m->cells; i++)
            peak = p[i] > p[peak] ? i : peak;
        size = fmax(size, m->field[FILM].data[k * m->cells + peak]);
    }
    return size;
}

/* Finds the frame nearest to the instant of the highest pressure. */
static size_t find_highest_pressure(const stage_fields *m, size_t frames)
{
    size_t best = 0;
    for (size_t k = 0; k < frames; k++)
        if (frame_at(m, k, frames) <= m->peak)
            best = k;
    return best;
}

/* Widens the range of x, in SI or cells, to where the pressure is above a hundredth of its peak. */
static void widen_to_contact(const stage_fields *m, double *from, double *to)
{
    const ff_array *p = &m->field[PRESSURE];
    double least = 0.01 * report_find_extremes(p).high;
    for (size_t i = 0; i < report_array_size(p); i++)
        if (p->data[i] > least) {
            size_t cell = i % m->cells;
            double x = m->x.data ? m->x.data[cell] : (double)cell;
            *from = fmin(*from, x);
            *to = fmax(*to, x);
        }
}

typedef struct snapshots {
    stage_fields stages[MOST_STAGES];
    size_t count, start; /* start: the frame at which the slider stands first */
    study_readable x, at, unit[FIELDS];
    double film;   /* the largest film in the middle of a contact, SI */
    double x0, x1; /* in the units of the figures */
} snapshots;

/* Returns the range of a field over all stages and instants; low > high: no stage has it. */
static void find_range(const snapshots *s, size_t f, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t m = 0; m < s->count; m++)
        if (s->stages[m].field[f].data) {
            const report_extremes found = report_find_extremes(&s->stages[m].field[f]);
            *low = fmin(*low, found.low);
            *high = fmax(*high, found.high);
        }
}

/* Adds a field of each stage at the instant at which the slider stands first. `letter` is that of
   the field, or that of the other flank above the rough one. */
static void add_field(const report_page *page, const snapshots *s, report_plot *plot, size_t f,
                      char letter, const char *words)
{
    for (size_t m = 0; m < s->count; m++) {
        const stage_fields *of = &s->stages[m];
        size_t frame = frame_at(of, s->start, FRAMES < of->frames ? FRAMES : of->frames);
        if (!of->field[f].data ||
            (f == ASPERITIES && !(report_find_extremes(&of->field[f]).high > 0)))
            continue;
        report_curve *curve = report_plot_add(plot, &s->x, of->x.data, &s->unit[f],
                                              of->field[f].data + frame * of->cells, of->cells);
        if (!curve)
            continue;
        curve->dash = (int)plot->count - 1;
        snprintf(curve->live, sizeof curve->live, "%c%zu", letter, m);
        snprintf(curve->label, sizeof curve->label, *words ? "%.90s: %.90s" : "%.90s%s",
                 page->view->stages[of->stage]->name, words);
    }
}

static void draw_panel(report_page *page, const snapshots *s, report_plot *plot, size_t f,
                       const char *title, const char *words)
{
    plot->class = "live";
    plot->x0 = s->x0;
    plot->x1 = s->x1;
    plot->y0 = report_convert(&s->unit[f], plot->y0);
    plot->y1 = report_convert(&s->unit[f], plot->y1);
    snprintf(plot->title, sizeof plot->title, "%s", title);
    report_label(s->stages[0].x.data ? "position in the contact" : "cell of the contact", &s->x,
                 plot->x_label);
    report_label(words, &s->unit[f], plot->y_label);
    report_plot_write(page, plot);
    report_plot_free(plot);
}

static void draw_panels(report_page *page, const snapshots *s)
{
    double low, high;
    find_range(s, PRESSURE, &low, &high);
    report_plot plot = {.y1 = 1.05 * high};
    add_field(page, s, &plot, PRESSURE, 'p', "");
    add_field(page, s, &plot, ASPERITIES, 'a', "of asperities");
    draw_panel(page, s, &plot, PRESSURE, "Pressure", "pressure");

    find_range(s, FILM, &low, &high);
    plot = (report_plot){.y1 = 3 * s->film};
    plot.y_decades = low > 0 && s->film > WIDE * low; /* at contact loss, the loaded film too */
    plot.y0 = plot.y_decades ? fmax(low, 1e-4 * s->film) / 1.5 : 0;
    add_field(page, s, &plot, FILM, 'h', "");
    draw_panel(page, s, &plot, FILM, "Film", "film thickness");

    find_range(s, ROUGHNESS, &low, &high);
    if (high > low) { /* the other flank, smooth and dented, stands a film above the rough one */
        plot = (report_plot){.y0 = low - 0.2 * (high - low), .y1 = high + 2 * s->film};
        add_field(page, s, &plot, ROUGHNESS, 'r', "heights of both flanks");
        add_field(page, s, &plot, ROUGHNESS, 'o', "other side of the film");
        draw_panel(page, s, &plot, ROUGHNESS, "Flanks", "height");
    }
    find_range(s, TEMPERATURE, &low, &high);
    if (high > low) {
        plot = (report_plot){.y0 = low, .y1 = high + 0.05 * (high - low)};
        add_field(page, s, &plot, TEMPERATURE, 't', "");
        draw_panel(page, s, &plot, TEMPERATURE, "Temperature", "mean across the film");
    }
}

static void write_frames(report_page *page, const snapshots *s)
{
    FILE *out = page->out;
    fprintf(out,
            "<script type=\"application/json\" class=\"frames\">{\"unit\":\"%s\",\"p\":\"%s\","
            "\"h\":\"%s\",\"stages\":[",
            s->stages[0].at.data ? s->at.unit : "", s->unit[PRESSURE].unit, s->unit[FILM].unit);
    for (size_t m = 0; m < s->count; m++) {
        const stage_fields *of = &s->stages[m];
        size_t frames = of->frames < FRAMES ? of->frames : FRAMES;
        size_t cells = of->cells < CELLS ? of->cells : CELLS;
        page->thinned = page->thinned || frames < of->frames || cells < of->cells;
        fprintf(out, "%s{\"frames\":%zu,\"cells\":%zu,\"name\":", m ? "," : "", frames, cells);
        report_put_json(out, results_json_text(page->view->stages[of->stage]->name));
        put_stage(out, of, frames, cells, &s->at, &s->x, s->unit);
        fputc('}', out);
    }
    fputs("]}</script>\n", out);
}

/* Chooses the units, the part of x that is shown, and the first instant. */
static void choose_view(snapshots *s)
{
    const stage_fields *first = &s->stages[0];
    double from = INFINITY, to = -INFINITY;
    const report_extremes along = report_find_extremes(&first->x);
    const double reach = fmax(fabs(along.low), fabs(along.high));
    s->x = first->x.data ? report_unit_for("", "m", reach) : (study_readable){1, 0, ""};
    for (size_t m = 0; m < s->count; m++) {
        widen_to_contact(&s->stages[m], &from, &to);
        s->film = fmax(s->film, central_film(&s->stages[m]));
    }
    s->x0 = report_convert(&s->x, from - 0.2 * (to - from));
    s->x1 = report_convert(&s->x, to + 0.2 * (to - from));
    s->unit[PRESSURE] = s->unit[ASPERITIES] =
        report_unit_for("", "Pa", report_find_extremes(&first->field[PRESSURE]).high);
    s->unit[FILM] = s->unit[ROUGHNESS] = report_unit_for("", "m", s->film);
    s->unit[TEMPERATURE] = report_unit_for("temperature", "K", 1);
    s->at = first->angle ? report_unit_for("", "rad", 1)
                         : report_unit_for("", "s", report_find_extremes(&first->at).high);
    s->start = find_highest_pressure(first, first->frames < FRAMES ? first->frames : FRAMES);
}

static void write_player(report_page *page, snapshots *s)
{
    const size_t all = s->stages[0].frames, frames = all < FRAMES ? all : FRAMES;
    choose_view(s);
    fprintf(page->out,
            "<section class=\"snapshots\"><h2>Pressure and film in the contact</h2>\n"
            "<p class=\"player\"><button type=\"button\" class=\"play\" aria-pressed=\"false\">"
            "play</button> <input type=\"range\" min=\"0\" max=\"%zu\" value=\"%zu\" "
            "aria-label=\"instant of the engagement\"> <output></output></p>\n"
            "<p class=\"note\">%zu of %zu instants; the film is cut off above three times its "
            "central thickness.</p>\n<p class=\"extremes\"></p>\n<div class=\"figures\">\n",
            frames - 1, s->start, frames, all);
    draw_panels(page, s);
    fputs("</div>\n", page->out);
    write_frames(page, s);
    fputs("</section>\n", page->out);
}

void report_write_snapshots(report_page *page)
{
    snapshots s = {.count = 0};
    if (page->view->study)
        return;
    for (size_t stage = 0; stage < page->view->stage_count && s.count < MOST_STAGES; stage++) {
        if (load_fields(page, stage, &s.stages[s.count]))
            s.count++;
        else
            release_fields(page, &s.stages[s.count]);
    }
    if (s.count > 0)
        write_player(page, &s);
    for (size_t m = 0; m < s.count; m++)
        release_fields(page, &s.stages[m]);
}
