/* losses/sliding: how much of the loss of a pair of teeth is friction times sliding, from the
   history of the film and that of its contact, which have instants of their own. */
#include <flankfilm/author.h>
#include <flankfilm/history.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double bearings;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("bearing_loss", "W", stage, bearings, 0, "0 W", NULL, 0, 1e9, 0, 0,
                "loss beside the mesh"),
};

enum { FILM_T, ROLL, LOSS, TRACTION, CONTACT_T, SLIP, FACE, TEETH, TORQUE, SPEED };

static const ff_port inputs[] = {
    [FILM_T] = {.name = "ehl.time", .unit = "s", .dims = "t", .doc = "steps of the film"},
    [ROLL] = {.name = "ehl.roll_angle", .unit = "rad", .dims = "t", .doc = "roll angles"},
    [LOSS] = {.name = "ehl.power_loss", .unit = "W/m", .dims = "t", .doc = "loss per width"},
    [TRACTION] = {.name = "ehl.traction", .unit = "N/m", .dims = "t", .doc = "friction per width"},
    [CONTACT_T] = {.name = "contact.time", .unit = "s", .dims = "t", .doc = "instants of the load"},
    [SLIP] = {.name = "contact.sliding_speed", .unit = "m/s", .dims = "t", .doc = "u1 - u2"},
    [FACE] = {.name = "gear.face_width", .unit = "m", .dims = "", .doc = "width in contact"},
    [TEETH] = {.name = "gear.teeth", .unit = "1", .dims = "gear", .doc = "numbers of teeth"},
    [TORQUE] = {.name = "operating.torque", .unit = "N m", .dims = "", .doc = "of gear 1"},
    [SPEED] = {.name = "operating.speed", .unit = "rad/s", .dims = "", .doc = "of gear 1"},
};

enum { MEAN, SLIDING, INPUT, EFFICIENCY, SERIES };

static const ff_port outputs[] = {
    [MEAN] = {.name = "power_loss_mean", .unit = "W", .dims = "", .doc = "mean loss"},
    [SLIDING] = {.name = "sliding_mean", .unit = "W", .dims = "", .doc = "friction times sliding"},
    [INPUT] = {.name = "power_input", .unit = "W", .dims = "", .doc = "power that comes in"},
    [EFFICIENCY] = {.name = "efficiency", .unit = "1", .dims = "", .doc = "power out over in"},
    [SERIES] = {.name = "sliding", .unit = "W/m", .dims = "ehl.t", .doc = "the same of one pair"},
};

static int is_tame(double value)
{
    return value > -1e12 && value < 1e12;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double *roll = in[ROLL].data, *loss = in[LOSS].data, *traction = in[TRACTION].data,
                 pitch = in[TEETH].shape[0] ? 6.283185307179586 / in[TEETH].data[0] : 0,
                 power = in[TORQUE].data[0] * in[SPEED].data[0], width = in[FACE].data[0];
    const size_t n = in[FILM_T].shape[0], instants = in[CONTACT_T].shape[0];
    double work = 0, slid = 0, *sliding = ff_put_series(s->host, SERIES, n);
    ff_status status = FF_OK;
    (void)wanted;
    if (!sliding)
        status = FF_NOMEM;
    else if (!(pitch > 1e-4 && pitch < 3))
        status = ff_failf(s->host, FF_INVALID, "gear.teeth", "no gear has so many teeth");
    else if (!(power > 1e-9 && power < 1e15))
        status = ff_failf(s->host, FF_INVALID, "operating.torque", "it must bring power");
    else if (!(width > 0 && width < 1e3))
        status = ff_failf(s->host, FF_INVALID, "gear.face_width", "no gear is so wide");
    if (status == FF_OK && ff_history_at(instants, in[CONTACT_T].data, in[SLIP].data, n,
                                         in[FILM_T].data, sliding) == FF_INVALID)
        status = ff_failf(s->host, FF_INVALID, "contact.time", "the instants must rise");
    for (size_t i = 0; status == FF_OK && i < n; i++) {
        double step = i ? roll[i] - roll[i - 1] : 0;
        if (!(step >= 0 && step < 7 && is_tame(loss[i]) && is_tame(traction[i]) &&
              is_tame(sliding[i]))) {
            status = ff_failf(s->host, FF_INVALID, "ehl.roll_angle",
                              "the roll angles of one pair must rise, with a loss at each");
            break;
        }
        sliding[i] = fabs(traction[i] * sliding[i]);
        work += i ? step * (loss[i] + loss[i - 1]) / 2 : 0;
        slid += i ? step * (sliding[i] + sliding[i - 1]) / 2 : 0;
    }
    const double mean = width * work / pitch + s->bearings,
                 values[] = {mean, width * slid / pitch, power, 1 - mean / power};
    for (uint32_t k = MEAN; status == FF_OK && k <= EFFICIENCY; k++)
        status = ff_put_scalar(s->host, k, values[k]);
    return status;
}

FF_MODEL(model, stage, .id = "losses/sliding", .version = "1.0.0",
         .summary = "loss of a mesh, and what of it is friction times sliding", .reference = "",
         .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
