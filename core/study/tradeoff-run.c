/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run of a trade-off: a reference that is refined until it stands, then the candidates. */
#include "private.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct run {
    ff_campaign campaign; /* one case at a time */
    const ff_tradeoff *tradeoff;
    ff_report *report;
    ff_tally *tally;
    ff_point *points;
    json_t *records;
} run;

static bool refuse_field(const run *r, const ff_case *c)
{
    const ff_node *list = r->campaign.study->measure->request;
    for (size_t i = 0; i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        for (size_t k = 0; stage->needed && k < stage->loaded->model->output_count; k++) {
            const ff_result *result = &stage->results[k];
            if (result->asked && result->row->dims && strchr(result->row->dims, ' ') &&
                !strchr(result->row->dims, '?'))
                return ff_error(r->report, FF_EXIT_INPUT, list->place, NULL,
                                "tradeoff: %s.%s is a field; name scalars and series", stage->name,
                                result->row->name);
        }
    }
    return true;
}

/* Builds every point: what is wrong shows before anything runs. */
static bool open_points(run *r)
{
    const ff_tradeoff *t = r->tradeoff;
    ff_place wrong = FF_NOWHERE; /* what was said there need not be said of its other points */
    bool good = true;
    for (size_t p = 0; p < t->levels + t->candidates; p++) {
        ff_point *point = &r->points[p];
        ff_place place = t->places[p];
        ff_case c;
        if (wrong.source == place.source && wrong.line == place.line &&
            wrong.column == place.column && wrong.source)
            continue;
        ff_case_open(&c, &r->campaign, p);
        if (!ff_case_is_good(&c))
            good = ff_error(r->report, FF_EXIT_INPUT, t->places[p], NULL, "tradeoff: %s: %s",
                            t->labels[p], ff_first_error(c.report));
        else
            good = refuse_field(r, &c) && good;
        point->repeats = p < t->levels ? 1 : t->repeats;
        point->keys = ff_alloc(point->repeats * sizeof *point->keys);
        for (size_t i = 0; i < point->repeats; i++)
            snprintf(point->keys[i], sizeof point->keys[i], "%016llx",
                     (unsigned long long)ff_measure_print(c.print, i));
        if (!ff_case_is_good(&c))
            wrong = place;
        ff_case_close(&c);
    }
    return good;
}

static void add(ff_tally *all, const ff_tally *some)
{
    all->leads = some->leads;
    all->total += some->total;
    all->before += some->before;
    all->done += some->done;
    all->failed += some->failed;
    all->seconds += some->seconds;
    all->savings.computed += some->savings.computed;
    all->savings.reused += some->savings.reused;
    all->savings.spent += some->savings.spent;
    all->savings.saved += some->savings.saved;
}

static void reread(run *r)
{
    int directory = open(r->campaign.directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    json_decref(r->records);
    r->records = directory < 0 ? json_object() : ff_journal_read(directory);
    if (directory >= 0)
        close(directory);
    for (size_t p = 0; p < r->tradeoff->levels + r->tradeoff->candidates; p++) {
        ff_point *point = &r->points[p];
        point->record = json_object_get(r->records, point->keys[0]);
        if (!point->values && ff_record_is_ok(point->record))
            point->values = ff_measure_values(r->campaign.directory, point->keys[0]);
    }
}

static bool run_cases(run *r, size_t begin, size_t end)
{
    ff_tally tally;
    r->campaign.begin = begin;
    r->campaign.end = end;
    bool good = ff_study_run(&r->campaign, &tally, r->report);
    add(r->tally, &tally);
    if (good)
        reread(r);
    return good;
}

/* Every output differs from the level before by a tenth of the smallest error at most. */
static bool stands(const run *r, size_t level)
{
    const ff_measure *m = r->campaign.study->measure;
    ff_difference d;
    for (size_t i = 0; i < m->output_count; i++)
        if (!ff_point_compare(&r->points[level - 1], &r->points[level], m->request->items[i]->text,
                              &d) ||
            d.largest > r->tradeoff->accuracy / 10)
            return false;
    return true;
}

/* The number of levels that ran; 0 after an error. */
static size_t run_reference(run *r)
{
    for (size_t level = 0; level < r->tradeoff->levels; level++) {
        if (!run_cases(r, level, level + 1))
            return 0;
        const ff_point *point = &r->points[level];
        if (!point->values) {
            const char *reason = json_string_value(json_object_get(point->record, "reason"));
            ff_error(r->report, FF_EXIT_FAILED, r->tradeoff->places[level],
                     "a coarser reference, or fewer refinements, may do",
                     "tradeoff: the reference failed (%s): %s", r->tradeoff->labels[level],
                     reason ? reason : "what it gave is lost; --rerun all computes it anew");
            return 0;
        }
        if (level > 0 && stands(r, level))
            return level + 1;
    }
    return r->tradeoff->levels;
}

static void free_points(run *r)
{
    for (size_t p = 0; p < r->tradeoff->levels + r->tradeoff->candidates; p++) {
        free(r->points[p].keys);
        json_decref(r->points[p].values);
    }
    free(r->points);
    json_decref(r->records);
}

bool ff_tradeoff_run(const ff_campaign *campaign, ff_tally *tally, struct json_t **result,
                     ff_report *report)
{
    const ff_tradeoff *t = campaign->study->tradeoff;
    run r = {.campaign = *campaign, .tradeoff = t, .report = report, .tally = tally};
    size_t levels = 0;
    *tally = (ff_tally){.leads = true};
    *result = NULL;
    r.campaign.jobs = 1;
    r.points = ff_alloc((t->levels + t->candidates) * sizeof *r.points);
    if (campaign->executor || campaign->shards > 1)
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, "run it in one process on an idle machine",
                 "a trade-off measures costs, one case at a time: it cannot be spread");
    else if (open_points(&r) && (levels = run_reference(&r)) > 0 &&
             run_cases(&r, t->levels, campaign->study->count))
        *result = ff_tradeoff_result(campaign->study, r.points, levels, r.records);
    free_points(&r);
    return *result != NULL;
}
