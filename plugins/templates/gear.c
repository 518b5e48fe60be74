/* @ID@: a standard involute spur pair with a contact ratio from 1 to 2. Write your geometry into
   `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { STEPS = 60, COUNT = 3 * (STEPS + 1) };

typedef struct {
    const ff_host *host;
    int64_t teeth_1, teeth_2;
    double module, angle, width, backlash;
} stage;

static const ff_param params[] = {
    FF_COUNT("teeth_1", stage, teeth_1, FF_REQUIRED, NULL, NULL, 5, 1000, 0, 0, "teeth of gear 1"),
    FF_COUNT("teeth_2", stage, teeth_2, FF_REQUIRED, NULL, NULL, 5, 1000, 0, 0, "teeth of gear 2"),
    FF_QUANTITY("module", "mm", stage, module, FF_REQUIRED, NULL, NULL, 0.05, 100, 0, 0, "module"),
    FF_QUANTITY("pressure_angle", "deg", stage, angle, 0, "20 deg", NULL, 10, 35, 0, 0,
                "pressure angle"),
    FF_QUANTITY("face_width", "mm", stage, width, FF_REQUIRED, NULL, NULL, 0.1, 1e4, 0, 0,
                "width of the teeth"),
    FF_QUANTITY("backlash", "mm", stage, backlash, 0, "0 mm", NULL, 0, 10, 0, 0,
                "backlash along the line of action"),
};

enum { ROLL, RADIUS_1, RADIUS_2, TEETH, BASE, SAP, TIP, RATIO, WIDE, GAP, MASS, MODULUS };

static const ff_port outputs[] = {
    [ROLL] = {.name = "roll_angle",
              .unit = "rad",
              .dims = "station",
              .doc = "roll angle of gear 1; LPSTC and HPSTC appear twice"},
    [RADIUS_1] = {.name = "radius_1",
                  .unit = "m",
                  .dims = "station",
                  .doc = "radius of curvature of flank 1"},
    [RADIUS_2] = {.name = "radius_2",
                  .unit = "m",
                  .dims = "station",
                  .doc = "radius of curvature "
                         "of flank 2"},
    [TEETH] = {.name = "teeth", .unit = "1", .dims = "gear", .doc = "numbers of teeth"},
    [BASE] = {.name = "base_radius", .unit = "m", .dims = "gear", .doc = "base circle radii"},
    [SAP] = {.name = "roll_sap", .unit = "rad", .dims = "", .doc = "roll angle at SAP"},
    [TIP] = {.name = "roll_tip", .unit = "rad", .dims = "", .doc = "roll angle at the tip"},
    [RATIO] = {.name = "contact_ratio", .unit = "1", .dims = "", .doc = "contact ratio"},
    [WIDE] = {.name = "face_width", .unit = "m", .dims = "", .doc = "width of the teeth"},
    [GAP] = {.name = "backlash",
             .unit = "m",
             .dims = "",
             .doc = "backlash along the line of action"},
    [MASS] = {.name = "equivalent_mass",
              .unit = "kg",
              .dims = "",
              .doc = "equivalent mass of two solid steel discs"},
    [MODULUS] = {.name = "reduced_modulus",
                 .unit = "Pa",
                 .dims = "",
                 .doc = "reduced modulus E': 2/E' = sum (1 - nu^2)/E"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double pi = 3.141592653589793, m = s->module;
    const double z1 = (double)s->teeth_1, z2 = (double)s->teeth_2;
    double r1 = m * z1 / 2, r2 = m * z2 / 2;
    double b1 = r1 * cos(s->angle), b2 = r2 * cos(s->angle); /* base circles */
    double line = (b1 + b2) * tan(s->angle), pitch = 2 * pi * b1 / z1;
    double sap = line - sqrt(pow(r2 + m, 2) - b2 * b2);
    double tip = sqrt(pow(r1 + m, 2) - b1 * b1);
    double ratio = (tip - sap) / pitch;
    (void)wanted, (void)in;
    if (!(sap > 0 && tip < line))
        return ff_failf(s->host, FF_INVALID, "teeth_1", "a gear with so few teeth is undercut");
    if (!(ratio > 1 && ratio < 2))
        return ff_failf(s->host, FF_INVALID, "pressure_angle",
                        "the contact ratio is %g; it must be between 1 and 2", ratio);
    double *roll = ff_put_series(s->host, ROLL, COUNT);
    double *radius_1 = ff_put_series(s->host, RADIUS_1, COUNT);
    double *radius_2 = ff_put_series(s->host, RADIUS_2, COUNT);
    double *teeth = ff_put_series(s->host, TEETH, 2);
    double *base = ff_put_series(s->host, BASE, 2);
    if (!roll || !radius_1 || !radius_2 || !teeth || !base)
        return FF_NOMEM;
    teeth[0] = z1;
    teeth[1] = z2;
    base[0] = b1;
    base[1] = b2;
    const double ends[] = {sap, tip - pitch, sap + pitch, tip}; /* SAP, LPSTC, HPSTC, tip */
    for (int i = 0; i < COUNT; i++) {
        double from = ends[i / (STEPS + 1)], to = ends[i / (STEPS + 1) + 1];
        double share = (double)(i % (STEPS + 1)) / STEPS;
        radius_1[i] = (1 - share) * from + share * to;
        radius_2[i] = line - radius_1[i];
        roll[i] = radius_1[i] / b1;
    }
    double j1 = pi * 7850 * s->width * pow(r1, 4) / 2, j2 = pi * 7850 * s->width * pow(r2, 4) / 2;
    double mass = j1 * j2 / (j1 * b2 * b2 + j2 * b1 * b1);
    const double value[] = {
        sap / b1, tip / b1, ratio, s->width, s->backlash, mass, 2 / (2 * (1 - 0.09) / 206e9)};
    for (uint32_t i = SAP; i <= MODULUS; i++)
        if (ff_put_scalar(s->host, i, value[i - SAP]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
