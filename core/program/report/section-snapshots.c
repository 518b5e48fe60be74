/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Shows pressure and film over the contact at instants of the engagement. The frames go into the
 * page as 32-bit numbers in base64; a script draws the one that the slider stands at.
 */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDE = 30, FRAMES = 121, CELLS = 513, MOST_STAGES = 3 };

/* The fields of one stage. */
typedef struct stage_fields {
    size_t stage;
    int pressure, film;
    ff_array p, h, x, at; /* at: what the instants are named after */
    bool angle;           /* at is an angle */
    size_t frames, cells; /* of the fields */
    size_t peak, low;     /* the instants of the highest pressure and of the least film */
} stage_fields;

static int find_field(const ff_view *view, size_t stage, const char *output)
{
    int v = report_find_output(view, stage, output);
    return v >= 0 && view->variables[v]->rank == 2 ? v : -1;
}

/* Finds the instants of the highest pressure and of the least film. */
static void find_extremes(stage_fields *m)
{
    size_t peak = 0, low = 0;
    for (size_t i = 1; i < m->frames * m->cells; i++) {
        peak = m->p.data[i] > m->p.data[peak] ? i : peak;
        low = m->h.data[i] < m->h.data[low] ? i : low;
    }
    m->peak = peak / m->cells;
    m->low = low / m->cells;
}

static bool load_fields(report_page *page, size_t stage, stage_fields *m)
{
    const ff_view *view = page->view;
    *m = (stage_fields){.stage = stage,
                        .pressure = find_field(view, stage, "pressure"),
                        .film = find_field(view, stage, "film")};
    if (m->pressure < 0 || m->film < 0)
        return false;
    int at = report_find_axis(view, (size_t)m->pressure, 0, 0);
    m->p = report_load(page, m->pressure, 0);
    m->h = report_load(page, m->film, 0);
    m->x = report_load(page, report_find_axis(view, (size_t)m->pressure, 1, 0), 0);
    m->at = report_load(page, at, 0);
    m->angle = m->at.data && !strcmp(view->variables[at]->unit, "rad");
    if (!m->p.data || !m->h.data || m->p.rank != 2 ||
        report_array_size(&m->p) != report_array_size(&m->h) || report_array_size(&m->p) == 0)
        return false;
    m->frames = m->p.shape[0];
    m->cells = m->p.shape[1];
    find_extremes(m);
    return true;
}

static void release_fields(report_page *page, stage_fields *m)
{
    report_release(page, &m->p);
    report_release(page, &m->h);
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

/* Writes numbers as little-endian floats. */
static void put_floats(FILE *out, const float *data, size_t count)
{
    unsigned char *bytes = memory_alloc(4 * count);
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &data[i], sizeof bits);
        for (int b = 0; b < 4; b++)
            bytes[4 * i + (size_t)b] = (unsigned char)(bits >> (8 * b));
    }
    fputc('"', out);
    put_base64(out, bytes, 4 * count);
    fputc('"', out);
    free(bytes);
}

static void put_field(FILE *out, const stage_fields *m, const ff_array *field,
                      const report_unit *unit, size_t frames, size_t cells)
{
    float *data = memory_alloc(frames * cells * sizeof *data);
    for (size_t k = 0; k < frames; k++)
        for (size_t i = 0; i < cells; i++)
            data[k * cells + i] = (float)report_convert(
                unit,
                field->data[frame_at(m, k, frames) * m->cells + sample_index(i, cells, m->cells)]);
    put_floats(out, data, frames * cells);
    free(data);
}

static void put_axis(FILE *out, const ff_array *axis, size_t count, size_t kept,
                     const report_unit *unit)
{
    float *data = memory_alloc(kept * sizeof *data);
    for (size_t i = 0; i < kept; i++) {
        size_t at = sample_index(i, kept, count);
        data[i] = (float)(axis->data ? report_convert(unit, axis->data[at]) : (double)at);
    }
    put_floats(out, data, kept);
    free(data);
}

static void put_instants(FILE *out, const stage_fields *m, size_t kept, const report_unit *unit)
{
    float *data = memory_alloc(kept * sizeof *data);
    for (size_t k = 0; k < kept; k++) {
        size_t at = frame_at(m, k, kept);
        data[k] = (float)(m->at.data ? report_convert(unit, m->at.data[at]) : (double)at);
    }
    put_floats(out, data, kept);
    free(data);
}

static double largest_value(const ff_array *array)
{
    double size = 0;
    for (size_t i = 0; i < report_array_size(array); i++)
        size = fmax(size, array->data[i]);
    return size;
}

/* Finds the largest film of all instants in the middle of the contact: away from it the gap is
   open. */
static double central_film(const stage_fields *m)
{
    double size = 0;
    for (size_t k = 0; k < m->frames; k++) {
        size_t peak = 0;
        for (size_t i = 1; i < m->cells; i++)
            if (m->p.data[k * m->cells + i] > m->p.data[k * m->cells + peak])
                peak = i;
        size = fmax(size, m->h.data[k * m->cells + peak]);
    }
    return size;
}

static double least_film(const stage_fields *m)
{
    double least = INFINITY;
    for (size_t i = 0; i < report_array_size(&m->h); i++)
        least = fmin(least, m->h.data[i]);
    return least;
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
    double least = 0.01 * largest_value(&m->p);
    for (size_t k = 0; k < m->frames; k++)
        for (size_t i = 0; i < m->cells; i++)
            if (m->p.data[k * m->cells + i] > least) {
                double x = m->x.data ? m->x.data[i] : (double)i;
                *from = fmin(*from, x);
                *to = fmax(*to, x);
            }
}

typedef struct snapshots {
    stage_fields stages[MOST_STAGES];
    size_t count, start; /* start: the frame at which the slider stands first */
    report_unit x, p, h, at;
    double film_top, film_bottom; /* in the units of the figures, as x0; no bottom: 0 */
    double x0, x1;
} snapshots;

static void draw_snapshot(report_page *page, const snapshots *s, bool film)
{
    static const char *const live[2][MOST_STAGES] = {{"p0", "p1", "p2"}, {"h0", "h1", "h2"}};
    report_plot plot = {.from_zero = true, .class = "live"};
    for (size_t m = 0; m < s->count; m++) {
        const stage_fields *of = &s->stages[m];
        size_t frame = frame_at(of, s->start, FRAMES < of->frames ? FRAMES : of->frames);
        const double *field = (film ? of->h.data : of->p.data) + frame * of->cells;
        report_curve *curve =
            report_plot_add(&plot, &s->x, of->x.data, film ? &s->h : &s->p, field, of->cells);
        if (!curve)
            continue;
        curve->dash = (int)m;
        curve->live = live[film][m];
        snprintf(curve->label, sizeof curve->label, "%s", page->view->stages[of->stage]->name);
    }
    plot.top = film ? s->film_top : 0;
    plot.bottom = film ? s->film_bottom : 0;
    plot.x0 = s->x0;
    plot.x1 = s->x1;
    for (size_t m = 0; m < s->count && !film; m++)
        plot.top = fmax(plot.top, 1.05 * report_convert(&s->p, largest_value(&s->stages[m].p)));
    snprintf(plot.title, sizeof plot.title, film ? "Film" : "Pressure");
    report_label(s->stages[0].x.data ? "position in the contact" : "cell of the contact", &s->x,
                 plot.x_label);
    report_label(film ? "film thickness" : "pressure", film ? &s->h : &s->p, plot.y_label);
    report_plot_write(page, &plot);
    report_plot_free(&plot);
}

static void write_frames(report_page *page, const snapshots *s)
{
    FILE *out = page->out;
    fprintf(out,
            "<script type=\"application/json\" class=\"frames\">{\"unit\":\"%s\",\"p\":\"%s\","
            "\"h\":\"%s\",\"stages\":[",
            s->stages[0].at.data ? s->at.unit : "", s->p.unit, s->h.unit);
    for (size_t m = 0; m < s->count; m++) {
        const stage_fields *of = &s->stages[m];
        size_t frames = of->frames < FRAMES ? of->frames : FRAMES;
        size_t cells = of->cells < CELLS ? of->cells : CELLS;
        page->thinned = page->thinned || frames < of->frames || cells < of->cells;
        fprintf(out, "%s{\"frames\":%zu,\"cells\":%zu,\"name\":", m ? "," : "", frames, cells);
        report_put_json_text(out, page->view->stages[of->stage]->name);
        fputs(",\"at\":", out);
        put_instants(out, of, frames, &s->at);
        fputs(",\"x\":", out);
        put_axis(out, &of->x, of->cells, cells, &s->x);
        fputs(",\"p\":", out);
        put_field(out, of, &of->p, &s->p, frames, cells);
        fputs(",\"h\":", out);
        put_field(out, of, &of->h, &s->h, frames, cells);
        fputc('}', out);
    }
    fputs("]}</script>\n", out);
}

static void write_player(report_page *page, snapshots *s)
{
    const stage_fields *first = &s->stages[0];
    double reach = 0, top = 0, bottom = INFINITY, from = INFINITY, to = -INFINITY;
    for (size_t i = 0; i < report_array_size(&first->x); i++)
        reach = fmax(reach, fabs(first->x.data[i]));
    s->x = first->x.data ? report_unit_for("m", reach) : (report_unit){1, 0, ""};
    for (size_t m = 0; m < s->count; m++)
        widen_to_contact(&s->stages[m], &from, &to);
    s->x0 = report_convert(&s->x, from - 0.2 * (to - from));
    s->x1 = report_convert(&s->x, to + 0.2 * (to - from));
    s->p = report_unit_for("Pa", largest_value(&first->p));
    for (size_t m = 0; m < s->count; m++)
        top = fmax(top, central_film(&s->stages[m]));
    s->h = report_unit_for("m", top);
    s->film_top = 3 * report_convert(&s->h, top);
    for (size_t m = 0; m < s->count; m++)
        bottom = fmin(bottom, least_film(&s->stages[m]));
    if (bottom > 0 && top > WIDE * bottom) /* at contact loss, the loaded film too */
        s->film_bottom = report_convert(&s->h, fmax(bottom, 1e-4 * top)) / 1.5;
    s->at =
        first->angle ? report_unit_for("rad", 1) : report_unit_for("s", largest_value(&first->at));
    size_t frames = first->frames < FRAMES ? first->frames : FRAMES;
    s->start = find_highest_pressure(first, frames);
    fprintf(page->out,
            "<section class=\"snapshots\"><h2>Pressure and film in the contact</h2>\n"
            "<p class=\"player\"><button type=\"button\" class=\"play\" aria-pressed=\"false\">"
            "play</button> <input type=\"range\" min=\"0\" max=\"%zu\" value=\"%zu\" "
            "aria-label=\"instant of the engagement\"> <output></output></p>\n"
            "<p class=\"note\">%zu of %zu instants; the film is cut off above three times its "
            "central thickness.</p>\n<p class=\"extremes\"></p>\n<div class=\"figures\">\n",
            frames - 1, s->start, frames, first->frames);
    draw_snapshot(page, s, false);
    draw_snapshot(page, s, true);
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
