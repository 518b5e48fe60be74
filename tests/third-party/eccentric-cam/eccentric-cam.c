/* SPDX-License-Identifier: MIT */
/*
 * contact/eccentric-cam: a round disc on an eccentric shaft against a flat follower, over one turn.
 *
 * The disc's centre is at e (cos theta, sin theta) from the shaft, theta = omega t, and so is the
 * place of contact along the face. The lift is e sin theta. Seen from the place of contact the
 * cam's surface moves with omega r, the follower's with -e omega sin theta (Dowson, Taylor & Zhu
 * 1992). The load is that of spring and inertia: k (preload_length + e + lift) + m lift''.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

typedef struct stage {
    const ff_host *host;
    double radius, eccentricity, width, speed, stiffness, preload, mass, modulus;
    int64_t points;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("radius", "mm", stage, radius, FF_REQUIRED, NULL, NULL, 0.1, 1e4, 0, 0,
                "radius of the disc"),
    FF_QUANTITY("eccentricity", "mm", stage, eccentricity, FF_REQUIRED, NULL, NULL, 0, 1e4, 0, 0,
                "of its centre from the shaft: half of the stroke"),
    FF_QUANTITY("width", "mm", stage, width, FF_REQUIRED, NULL, NULL, 0.1, 1e4, 0, 0,
                "width of the contact"),
    FF_QUANTITY("speed", "rpm", stage, speed, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1e5, 0, 0,
                "speed of the shaft"),
    FF_QUANTITY("spring", "N/mm", stage, stiffness, FF_REQUIRED, NULL, NULL, 1e-3, 1e6, 0, 0,
                "stiffness of the spring on the follower"),
    FF_QUANTITY("preload", "N", stage, preload, 0, "0 N", NULL, 0, 1e7, 0, 0,
                "force of the spring at the lowest lift"),
    FF_QUANTITY("mass", "kg", stage, mass, FF_REQUIRED, NULL, NULL, 0, 1e3, 0, 0,
                "what moves with the follower"),
    FF_QUANTITY("reduced_modulus", "GPa", stage, modulus, 0, "226.4 GPa", NULL, 1e-3, 1e5, 0, 0,
                "E' of 2/E' = sum (1 - nu^2)/E"),
    FF_COUNT("points", stage, points, FF_TUNABLE, "360", NULL, 16, 1e6, 0, 0,
             "instants of the turn"),
};

enum { TIME, RADIUS, SPEED_1, SPEED_2, ENTRAINMENT, SLIDING, LOAD, WIDTH, PRESSURE, MODULUS };
enum { SERIES = MODULUS };

static const ff_port outputs[] = {
    [TIME] = {.name = "time", .unit = "s", .dims = "t", .doc = "time, from the middle lift on"},
    [RADIUS] = {.name = "equivalent_radius", .unit = "m", .dims = "t", .doc = "that of the disc"},
    [SPEED_1] = {.name = "speed_1", .unit = "m/s", .dims = "t", .doc = "surface speed of the cam"},
    [SPEED_2] = {.name = "speed_2", .unit = "m/s", .dims = "t", .doc = "of the follower"},
    [ENTRAINMENT] = {.name = "entrainment_speed", .unit = "m/s", .dims = "t", .doc = "(u1 + u2)/2"},
    [SLIDING] = {.name = "sliding_speed", .unit = "m/s", .dims = "t", .doc = "u1 - u2"},
    [LOAD] = {.name = "load_per_width", .unit = "N/m", .dims = "t", .doc = "load per width"},
    [WIDTH] = {.name = "hertz_half_width", .unit = "m", .dims = "t", .doc = "dry half width"},
    [PRESSURE] = {.name = "hertz_pressure", .unit = "Pa", .dims = "t", .doc = "dry pressure"},
    [MODULUS] = {.name = "reduced_modulus", .unit = "Pa", .dims = "", .doc = "E'"},
};

static ff_status ready(void *self)
{
    const stage *s = self;
    double e = s->eccentricity;
    if (!(e < s->radius))
        return ff_failf(s->host, FF_INVALID, "eccentricity",
                        "the shaft must lie within the disc: less than %g m", s->radius);
    /* W/b is linear in sin theta: its least value is that of the lowest or of the highest lift */
    double top = s->preload + 2 * s->stiffness * e - s->mass * e * s->speed * s->speed;
    if (top < 0)
        return ff_failf(s->host, FF_INVALID, "speed",
                        "the follower flies off at the top of its lift, where spring and inertia "
                        "leave %g N",
                        top);
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const size_t count = (size_t)s->points + 1;
    double *out[SERIES];
    (void)wanted, (void)in;
    for (uint32_t i = 0; i < SERIES; i++)
        if (!(out[i] = ff_put_series(s->host, i, count)))
            return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        double theta = 2 * PI * (double)i / (double)s->points, rise = s->eccentricity * sin(theta);
        double force = s->preload + s->stiffness * (s->eccentricity + rise) -
                       s->mass * rise * s->speed * s->speed;
        double load = fmax(force, 0) / s->width;
        out[TIME][i] = theta / s->speed;
        out[RADIUS][i] = s->radius;
        out[SPEED_1][i] = s->speed * s->radius;
        out[SPEED_2][i] = -s->speed * rise;
        out[ENTRAINMENT][i] = (out[SPEED_1][i] + out[SPEED_2][i]) / 2;
        out[SLIDING][i] = out[SPEED_1][i] - out[SPEED_2][i];
        out[LOAD][i] = load;
        out[WIDTH][i] = sqrt(8 * load * s->radius / (PI * s->modulus));
        out[PRESSURE][i] = load > 0 ? 2 * load / (PI * out[WIDTH][i]) : 0;
    }
    return ff_put_scalar(s->host, MODULUS, s->modulus);
}

FF_MODEL(model, stage, .id = "contact/eccentric-cam", .version = "1.0.0",
         .summary = "a round eccentric cam against a flat follower, over one turn",
         .reference = "Dowson, Taylor & Zhu 1992, J. Phys. D: Appl. Phys. 25, A313-A320",
         .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .ready = ready, .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
