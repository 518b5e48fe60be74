/* @ID@: the loss of all pairs in mesh from the film of one pair. Write your loss into
   `evaluate`. */
#include <flankfilm/author.h>

#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double bearings;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("bearing_loss", "W", stage, bearings, 0, "0 W", NULL, 0, 1e9, 0, 0,
                "power loss outside the mesh"),
};

enum { ROLL, LOSS, FACE, TEETH, TORQUE, SPEED };

static const ff_port inputs[] = {
    [ROLL] = {.name = "ehl.roll_angle", .unit = "rad", .dims = "t", .doc = "roll angles"},
    [LOSS] = {.name = "ehl.power_loss", .unit = "W/m", .dims = "t", .doc = "loss per width"},
    [FACE] = {.name = "gear.face_width", .unit = "m", .dims = "", .doc = "width in contact"},
    [TEETH] = {.name = "gear.teeth", .unit = "1", .dims = "gear", .doc = "numbers of teeth"},
    [TORQUE] = {.name = "operating.torque", .unit = "N m", .dims = "", .doc = "of gear 1"},
    [SPEED] = {.name = "operating.speed", .unit = "rad/s", .dims = "", .doc = "of gear 1"},
};

enum { MEAN, INPUT, EFFICIENCY };

static const ff_port outputs[] = {
    [MEAN] = {.name = "power_loss_mean", .unit = "W", .dims = "", .doc = "mean loss"},
    [INPUT] = {.name = "power_input", .unit = "W", .dims = "", .doc = "input power"},
    [EFFICIENCY] = {.name = "efficiency",
                    .unit = "1",
                    .dims = "",
                    .doc = "efficiency: output power over input power"},
};

/* The work lost by a pair occurs once per pitch. `wanted` has one bit per output. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double *roll = in[ROLL].data, *loss = in[LOSS].data;
    double pitch = in[TEETH].shape[0] ? 6.283185307179586 / in[TEETH].data[0] : 0,
           power = in[TORQUE].data[0] * in[SPEED].data[0], work = 0;
    (void)wanted;
    if (!(pitch > 1e-4 && pitch < 3))
        return ff_failf(s->host, FF_INVALID, "gear.teeth", "the number of teeth is out of range");
    if (!(power > 1e-9 && power < 1e15))
        return ff_failf(s->host, FF_INVALID, "operating.torque", "the torque must be positive");
    if (!(in[FACE].data[0] > 0 && in[FACE].data[0] < 1e3))
        return ff_failf(s->host, FF_INVALID, "gear.face_width", "the face width is out of range");
    for (size_t i = 0; i < in[ROLL].shape[0]; i++) {
        double step = i ? roll[i] - roll[i - 1] : 0;
        if (!(step >= 0 && step < 7 && loss[i] > -1e12 && loss[i] < 1e12))
            return ff_failf(s->host, FF_INVALID, "ehl.roll_angle",
                            "the roll angles of one pair must increase, and each needs a loss");
        work += i ? step * (loss[i] + loss[i - 1]) / 2 : 0;
    }
    double mean = in[FACE].data[0] * work / pitch + s->bearings;
    if (ff_put_scalar(s->host, MEAN, mean) != FF_OK ||
        ff_put_scalar(s->host, INPUT, power) != FF_OK)
        return FF_NOMEM;
    return ff_put_scalar(s->host, EFFICIENCY, 1 - mean / power);
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
