/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Successive engagements in a history must have the same films in any order. */
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { EACH = 40, MOST = 4000 };

static const char wanted[] =
    "time h_min p_max traction engagement load_per_width h_min_lowest h_min_lowest_mean "
    "h_min_lowest_spread engagements_judged";
static const double duration = 1e-4, largest = 177.4e3;

/* Returns a load that rises and falls, or a load that falls to 0 for some rows. */
static double load_of(int which, size_t i)
{
    double t = (double)i / (EACH - 1);
    return which == 0 ? largest * (0.5 + 0.5 * t) : largest * fmax(cos(M_PI * t), 0);
}

typedef struct films {
    size_t n;
    double time[MOST], h_min[MOST], p_max[MOST], traction[MOST], engagement[MOST];
    double lowest, mean, spread, judged, heating;
} films;

static void take(const line *c, const char *output, double *to, size_t *n)
{
    const double *from = stage_get(c->film, output, n);
    *n = *n < MOST ? *n : MOST;
    memcpy(to, from, *n * sizeof *to);
}

/* Returns the largest difference between the load that the film carries and that of the contact,
   over the largest load; only where the load is above 2 % of the largest, away from flanks that
   touch again. */
static double unborne(const line *c)
{
    size_t n, at = 0;
    const double *time = stage_get(c->film, "time", &n);
    const double *borne = stage_get(c->film, "load_per_width", NULL);
    double off = 0;
    for (size_t i = 0; i < n; i++) {
        while (at + 2 < c->count && c->time[at + 1] < time[i])
            at++;
        double part = (time[i] - c->time[at]) / (c->time[at + 1] - c->time[at]);
        double load = c->load[at] + part * (c->load[at + 1] - c->load[at]);
        if (load > 0.02 * largest)
            off = fmax(off, fabs(borne[i] - load));
    }
    return off / largest;
}

/* Runs the engagements that `order` names in succession, with or without the input that separates
   them. */
static int run(const film_model *m, const char *order, const char *steps, int apart, films *f)
{
    double number[LINE_INSTANTS];
    line c;
    model_open(m, &c);
    line_last(&c, strlen(order) * EACH, 1);
    for (size_t i = 0; i < c.count; i++) {
        size_t part = i / EACH, within = i % EACH;
        c.time[i] = duration * ((double)part + (double)within / (EACH - 1));
        c.load[i] = load_of(order[part] - 'A', within);
        c.gap[i] = c.load[i] > 0 ? 0 : 1e-7;
        double more = order[part] == 'A' ? 0.1 * c.u1[i] : 0; /* changes only the sliding */
        c.u1[i] += more;
        c.u2[i] -= more;
        number[i] = (double)part;
    }
    if (apart)
        stage_give_series(c.film, "contact.engagement", c.count, number);
    stage_set_text(c.film, "steps", steps);
    if (m->solves)
        stage_set(c.film, "tolerance", 1e-8);
    int good = line_run(&c, wanted) == FF_OK;
    if (good) {
        take(&c, "time", f->time, &f->n);
        take(&c, "h_min", f->h_min, &f->n);
        take(&c, "p_max", f->p_max, &f->n);
        take(&c, "traction", f->traction, &f->n);
        take(&c, "engagement", f->engagement, &f->n);
        f->lowest = line_value(&c, "h_min_lowest", 0);
        f->mean = line_value(&c, "h_min_lowest_mean", 0);
        f->spread = line_value(&c, "h_min_lowest_spread", 0);
        f->judged = line_value(&c, "engagements_judged", 0);
        check_below("the load is borne", order[1] ? 0 : unborne(&c), 1e-6);
        f->heating = stage_quality(c.film, "inlet_heating");
    } else
        printf("%s: %s\n", m->id, stage_why(c.film));
    line_close(&c);
    return good;
}

static double distance(size_t n, const double *x, const double *y)
{
    double worst = 0, most = 0;
    for (size_t i = 0; i < n; i++) {
        worst = fmax(worst, fabs(x[i] - y[i]));
        most = fmax(most, fabs(y[i]));
    }
    return most > 0 ? worst / most : worst;
}

/* Returns the largest difference between the steps of `all`, from row `at` on, and those of
   `one`. */
static double departure(const films *all, size_t at, const films *one)
{
    double worst = distance(one->n, all->h_min + at, one->h_min);
    worst = fmax(worst, distance(one->n, all->p_max + at, one->p_max));
    return fmax(worst, distance(one->n, all->traction + at, one->traction));
}

/* same: differences from rounding alone, since times that begin later give slightly different time
   steps. */
static void check_model(const film_model *m, const char *steps, double same)
{
    static films a, b, ab, ba, jump;
    if (!check_true(m->id, run(m, "A", steps, 1, &a) && run(m, "B", steps, 1, &b) &&
                               run(m, "AB", steps, 1, &ab) && run(m, "BA", steps, 1, &ba)))
        return;
    check_true("steps of both", ab.n == a.n + b.n && ba.n == ab.n);
    check_below("the first", departure(&ab, 0, &a), same);
    check_below("the second", departure(&ab, a.n, &b), same);
    check_below("the first as second", departure(&ba, b.n, &a), same);
    check_below("the second as first", departure(&ba, 0, &b), same);
    double hotter = fmax(a.heating, b.heating);
    check_true("one slides more", a.heating > 1.001 * b.heating);
    check_near("the inlet of the hotter one", ab.heating, hotter, 1e-12);
    check_near("the same in the other order", ba.heating, hotter, 1e-12);
    check_true("numbered", ab.engagement[a.n - 1] == 0 && ab.engagement[a.n] == 1);
    check_near("times go on", ab.time[a.n], duration, 1e-12);
    check_near("judged", ab.judged, 2, 0);
    check_near("alone", a.judged, 1, 0);
    check_near("no spread", a.spread, 0, 0);
    check_near("its own mean", a.mean, a.lowest, 0);
    check_near("lowest of all", ab.lowest, fmin(a.lowest, b.lowest), same);
    check_near("mean of the lowest", ab.mean, (a.lowest + b.lowest) / 2, same);
    check_near("spread of the lowest", ab.spread, fabs(a.lowest - b.lowest), 100 * same);
    if (m->solves && check_true("as one history", run(m, "AB", steps, 0, &jump)))
        check_true("the film of a jump is another one",
                   jump.n != ab.n || departure(&jump, 0, &ab) > 1e-3);
}

enum { LANDS = 35, TOP = 50, ROWS = 60 };

/* Makes a load that falls to 0, returns and rises to its first maximum, and a gap that opens and
   closes. second: row at which the second engagement begins, or 0 if there is only one. */
static void open_landing(line *c, size_t second)
{
    double number[ROWS];
    model_open(&film_models[2], c);
    line_last(c, ROWS, 2e-4);
    for (size_t i = 0; i < ROWS; i++) {
        double fall = fmax(1 - (double)i / 20, 0), rise = 0, flight = 0;
        if (i >= LANDS)
            rise = 1 - 0.004 * pow((double)i - TOP, 2);
        if (i > 20 && i < LANDS)
            flight = (double)((i - 20) * (LANDS - i)) / 56;
        c->load[i] = largest * (0.1 + 0.9 * fall) * (i <= 20) + largest * fmax(rise, 0);
        c->gap[i] = 2e-7 * flight;
        if (flight > 0)
            c->load[i] = 0;
        number[i] = second && i >= second;
    }
    stage_give_series(c->film, "contact.engagement", ROWS, number);
    stage_set_text(c->film, "steps", "auto");
}

/* Compares the film where the gap closes, and the largest pressure from there to the load's
   maximum, each with the error stated at its instant. */
static void test_landing(void)
{
    static const char outputs[] = "time h_min p_max h_min_error p_max_error film_at_landing "
                                  "film_at_landing_error p_max_at_landing p_max_at_landing_error";
    line c;
    size_t n, highest = 0;
    open_landing(&c, 0);
    check_true("runs", line_run(&c, outputs) == FF_OK);
    const double *time = stage_get(c.film, "time", &n), *p = stage_get(c.film, "p_max", NULL);
    for (size_t i = 0; i < n; i++)
        if (time[i] >= c.time[LANDS] && (i == 0 || time[i - 1] < c.time[TOP]))
            highest = highest == 0 || p[i] > p[highest] ? i : highest;
    check_true("one landing", stage_count(c.film, "film_at_landing") == 1);
    check_near("film", line_value(&c, "film_at_landing", 0), line_at(&c, "h_min", c.time[LANDS]),
               1e-12);
    check_near("pressure", line_value(&c, "p_max_at_landing", 0), p[highest], 0);
    check_near("its error", line_value(&c, "p_max_at_landing_error", 0),
               fabs(line_value(&c, "p_max_error", highest)), 0);
    double off = line_value(&c, "film_at_landing_error", 0);
    check_true("error of the film",
               off > 0 && off >= 0.999 * fabs(line_at(&c, "h_min_error", c.time[LANDS])));
    line_close(&c);
    open_landing(&c, LANDS);
    check_true("runs", line_run(&c, outputs) == FF_OK);
    check_true("another pair does not land", stage_count(c.film, "film_at_landing") == 0);
    line_close(&c);
    open_landing(&c, 0);
    for (size_t i = LANDS; i < ROWS; i++)
        c.load[i] = 0;
    check_true("runs", line_run(&c, outputs) == FF_OK);
    check_true("nor one that carries no load", stage_count(c.film, "film_at_landing") == 0);
    line_close(&c);
}

int main(void)
{
    for (int k = 0; k < FILM_MODELS; k++)
        if (strcmp(film_models[k].name, "dense-newton") != 0)
            check_model(&film_models[k], "60", 1e-6);
    check_model(&film_models[2], "auto", 1e-3);
    test_landing();
    return check_done();
}
