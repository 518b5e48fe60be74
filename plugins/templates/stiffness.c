/* @ID@: all pairs in contact are equal linear springs. Write your stiffness into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { POINTS = 100 };

typedef struct {
    const ff_host *host;
    double pair;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("pair_stiffness", "N/um", stage, pair, FF_MIN_OPEN, "280 N/um", NULL, 0, 1e6, 0, 0,
                "stiffness of one pair along the line of action"),
};

enum { ROLL, SAP, TIP, TEETH, FORCE };

static const ff_port inputs[] = {
    [ROLL] = {.name = "gear.roll_angle",
              .unit = "rad",
              .dims = "station",
              .doc = "roll angle of gear 1"},
    [SAP] = {.name = "gear.roll_sap", .unit = "rad", .dims = "", .doc = "roll angle at SAP"},
    [TIP] = {.name = "gear.roll_tip", .unit = "rad", .dims = "", .doc = "roll angle at the tip"},
    [TEETH] = {.name = "gear.teeth", .unit = "1", .dims = "gear", .doc = "numbers of teeth"},
    [FORCE] = {.name = "operating.line_force",
               .unit = "N",
               .dims = "",
               .doc = "force along the line of action"},
};

enum { PHASE, K, LTE, TE, PAIRS, MEAN, BREAKS, LOAD, SHARE };

static const ff_port outputs[] = {
    [PHASE] = {.name = "phase",
               .unit = "1",
               .dims = "phase",
               .doc = "phase of the mesh cycle, 0 to 1; a repeated phase is a jump"},
    [K] = {.name = "stiffness", .unit = "N/m", .dims = "phase", .doc = "mesh stiffness"},
    [LTE] = {.name = "loaded_transmission_error",
             .unit = "m",
             .dims = "phase",
             .doc = "loaded transmission error F/k"},
    [TE] = {.name = "transmission_error",
            .unit = "m",
            .dims = "phase",
            .doc = "unloaded "
                   "transmission "
                   "error: 0"},
    [PAIRS] = {.name = "pairs_in_contact",
               .unit = "1",
               .dims = "phase",
               .doc = "number of pairs that carry load"},
    [MEAN] = {.name = "stiffness_mean", .unit = "N/m", .dims = "", .doc = "mean mesh stiffness"},
    [BREAKS] = {.name = "breakpoints", .unit = "1", .dims = "breakpoint", .doc = "phases of jumps"},
    [LOAD] = {.name = "tooth_force",
              .unit = "N",
              .dims = "gear.station",
              .doc = "force on one pair"},
    [SHARE] = {.name = "load_share",
               .unit = "1",
               .dims = "gear.station",
               .doc = "share of the line force on one pair"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double *roll = in[ROLL].data, sap = in[SAP].data[0], force = in[FORCE].data[0],
                 turns = in[TEETH].shape[0] ? in[TEETH].data[0] / 6.283185307179586 : 0;
    size_t stations = in[ROLL].shape[0];
    /* contact ratio: whole + 1 pairs are in contact up to the phase `left`, then `whole` pairs */
    double ratio = (in[TIP].data[0] - sap) * turns, whole = floor(ratio), left = ratio - whole;
    (void)wanted;
    if (!(ratio > 1 && ratio < 10 && left > 1e-6 && left < 1 - 1e-6))
        return ff_failf(s->host, FF_INVALID, "gear.roll_tip",
                        "a contact ratio of %g is not "
                        "supported",
                        ratio);
    if (!(fabs(force) < 1e12))
        return ff_failf(s->host, FF_INVALID, "operating.line_force", "%g N is not a valid force",
                        force);
    double *phase = ff_put_series(s->host, PHASE, 2 * POINTS);
    double *k = ff_put_series(s->host, K, 2 * POINTS);
    double *lte = ff_put_series(s->host, LTE, 2 * POINTS);
    double *te = ff_put_series(s->host, TE, 2 * POINTS);
    double *pairs = ff_put_series(s->host, PAIRS, 2 * POINTS);
    double *breaks = ff_put_series(s->host, BREAKS, 2);
    double *load = ff_put_series(s->host, LOAD, stations);
    double *share = ff_put_series(s->host, SHARE, stations);
    if (!phase || !k || !lte || !te || !pairs || !breaks || !load || !share ||
        ff_put_scalar(s->host, MEAN, s->pair * ratio) != FF_OK)
        return FF_NOMEM;
    breaks[0] = 0;
    breaks[1] = left;
    for (int i = 0; i < 2 * POINTS; i++) {
        double part = (double)(i % POINTS) / (POINTS - 1);
        phase[i] = i < POINTS ? part * left : left + part * (1 - left);
        pairs[i] = i < POINTS ? whole + 1 : whole;
        k[i] = s->pair * pairs[i];
        lte[i] = force / k[i];
        te[i] = 0;
    }
    for (size_t i = 0; i < stations; i++) {
        /* the first of two equal angles belongs to the state before the jump */
        int before = i + 1 == stations || (i > 0 && roll[i] == roll[i + 1]);
        double x = (roll[i] - sap) * turns + (before ? -1e-9 : 1e-9);
        share[i] = 1 / (x - floor(x) < left ? whole + 1 : whole);
        load[i] = share[i] * force;
    }
    return FF_OK;
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
