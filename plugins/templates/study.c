/* @ID@: where is a scalar least? A grid, then halfway around the best case; write your search into `run`. */
#include <flankfilm/author.h>
#include <flankfilm/study.h>

#include <stdlib.h>

typedef struct { ff_study_model service; const ff_written *outputs, *axes; long rounds; const ff_study_block *grid; } study;

static size_t ask(const study *s, const ff_study_desk *desk, double x, const char *unit)
{
    char text[200], *at = text + snprintf(text, sizeof text, "%.100s=", s->grid->paths[0]);
    snprintf(at, 80, "%.12g%.40s", x, unit);
    const ff_study_point point = {text, at};
    return desk->ask(desk->ctx, &(ff_study_case){.size = sizeof(ff_study_case), .points = &point, .label = at});
}

static ff_status plan(void *self, const ff_study_desk *desk, ff_study_plan *plan) /* reads, and asks for what is known beforehand */
{
    study *s = self;
    s->grid = desk->expand(desk->ctx, s->axes);
    if (!s->grid || s->grid->path_count != 1 || s->grid->case_count < 2 || s->outputs->text || s->outputs->keys || s->outputs->count != 1)
        return desk->refuse(desk->ctx, FF_INVALID, s->axes, NULL, "give one output, and one axis as a range of numbers");
    plan->flags = FF_STUDY_SCALARS, plan->paths = s->grid->paths, plan->path_count = 1, plan->outputs = s->outputs->items, plan->output_count = 1;
    plan->further = "and two in each round";
    for (size_t i = 0; i < s->grid->case_count; i++)
        desk->ask(desk->ctx, &(ff_study_case){.size = sizeof(ff_study_case), .points = &s->grid->points[i], .label = s->grid->points[i].name});
    return FF_OK;
}

static ff_status run(void *self, const ff_study_desk *desk)
{
    const study *s = self;
    char *unit, line[100];
    double first = strtod(s->grid->points[0].name, &unit), step = strtod(s->grid->points[1].name, NULL) - first, x = first, best = 0;
    size_t begin = 0, end = s->grid->case_count, seen = 0;
    for (long round = 0; round <= s->rounds; round++, step /= 2) {
        double middle = x;
        if (round) begin = ask(s, desk, middle - step / 2, unit), end = ask(s, desk, middle + step / 2, unit) + 1;
        ff_status status = desk->run(desk->ctx, begin, end);
        for (size_t i = begin; i < end && status == FF_OK; i++) {
            const double *value = desk->answer(desk->ctx, i)->outputs[0]->values;
            if (value && (seen++ == 0 || *value < best)) best = *value, x = round ? middle + (i == begin ? -step : step) / 2 : first + step * (double)i;
        }
        if (status != FF_OK) return status;
    }
    snprintf(line, sizeof line, seen ? "least: %.6g at %.6g%.20s" : "no case gave a number", best, x, unit);
    return desk->say(desk->ctx, 0, line), FF_OK;
}

static ff_status create(const ff_host *host, void **self) { study *s = calloc(1, sizeof *s); if (!s) return ff_failf(host, FF_NOMEM, NULL, "out of memory"); s->service = (ff_study_model){.size = sizeof s->service, .self = s, .verb = "searches", .plan = plan, .run = run}; *self = s; return FF_OK; }
static ff_status set(void *self, uint32_t param, const ff_value *value) { study *s = self; if (param == 0) s->outputs = value->tree; else if (param == 1) s->axes = value->tree; else s->rounds = (long)value->integer; return FF_OK; }
static const void *service(void *self, uint32_t output) { return output ? NULL : &((study *)self)->service; }

static const ff_param params[] = {{.name = "outputs", .unit = "", .type = FF_TREE, .flags = FF_REQUIRED, .doc = "list of the scalar that is to be least"}, {.name = "axes", .unit = "", .type = FF_TREE, .flags = FF_REQUIRED, .doc = "map from one path to a range"}, {.name = "rounds", .unit = "", .type = FF_INT, .preset = "4", .max = 40, .doc = "halvings around the best case"}};
static const ff_port outputs[] = {{.name = "study", .unit = "", .dims = "", .service = FF_STUDY_ID, .doc = "the search"}};
static const ff_model model = {.size = sizeof(ff_model), .abi_major = FF_ABI_MAJOR, .abi_minor = FF_ABI_MINOR, .id = "@ID@", .version = "0.1.0", .summary = "one line on what it is good for", .reference = "", .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs), .create = create, .set = set, .service = service, .destroy = free};

FF_EXPORT const ff_model *flankfilm_model_v1(void) { return &model; }
