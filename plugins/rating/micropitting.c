/* SPDX-License-Identifier: GPL-3.0-or-later */
/* rating/micropitting, a draft. It computes the specific film thickness lambda_GF by the formulas
   of ISO/TR 15144-1, method B, as other sources quote them, and from the film of this program
   (method A). */
#include "pair.h"
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdlib.h>

static const double celsius = 273.15;
static const double highest_ratio =
    2; /* contact ratio from which method B does not hold (clause 8.2) */

typedef struct micropitting {
    const ff_host *host;
    const ff_liquid *oil;
    rating_load load;
    int64_t points;
    int32_t base, supply, relieved;
    rating_heat heat;
    double test_lambda, test_own_lambda, material_factor, yield;
} micropitting;

static const ff_param params[] = {
    FF_ONE_OF("mineral|PAO|PAG", "base", micropitting, base, 0, "mineral",
              "base oil, which determines the pressure coefficient (formulas 9 to 11)"),
    FF_ONE_OF("dip|spray|submerged", "supply", micropitting, supply, 0, "dip",
              "oil supply to the mesh: factor X_S"),
    FF_QUANTITY("application_factor", "1", micropitting, load.application, 0, "1", NULL, 0.1, 10, 1,
                2.5, "K_A"),
    FF_QUANTITY("face_load_factor", "1", micropitting, load.face, 0, "1", NULL, 1, 10, 1, 2,
                "K_Hbeta"),
    FF_QUANTITY("transverse_load_factor", "1", micropitting, load.transverse, 0, "1", NULL, 1, 10,
                1, 2, "K_Halpha"),
    FF_COUNT_OR("auto", "quality_grade", micropitting, load.grade, 0, "auto", NULL, 1, 12, 0, 0,
                "flank tolerance class of ISO 1328-1, which affects the load sharing; auto: the "
                "coarser class of both gears, or 6 if they have no `quality`"),
    FF_SWITCH(
        "adequate_tip_relief", micropitting, relieved, "false",
        "whether the tip relief is adequate for the load, which lowers the tooth temperature"),
    RATING_HEAT_ROWS(micropitting),
    FF_QUANTITY("test_lambda", "1", micropitting, test_lambda, 0, NULL, NULL, 1e-4, 100, 0, 0,
                "limiting specific film thickness lambda_GFT: lambda_gf_min of the test gear FZG "
                "C-GF/8.3/90 at the failure load stage of the oil, by the same formulas "
                "(configs/fzg-cgf-micropitting.yaml)"),
    FF_QUANTITY("test_own_lambda", "1", micropitting, test_own_lambda, 0, NULL, NULL, 1e-4, 100, 0,
                0, "own_lambda_gf_min of the same test gear run, from the film of this program"),
    FF_QUANTITY("material_factor", "1", micropitting, material_factor, 0, "1", NULL, 0.1, 3, 0.5,
                1.5,
                "material factor W_W: 1 for case-hardened steel, the mean for two different "
                "steels; a published report has 0.75 for case-hardened on through-hardened"),
    FF_QUANTITY_UNLESS(
        "gear.yield_strength", "yield_strength", "MPa", micropitting, yield, 0, NULL, NULL, 1, 1e4,
        0, 0,
        "tensile yield strength of the flanks, if the gear stage gives none; the largest shear "
        "stress of the contact, 0.300 p_H, is compared with half of it, the yield stress in shear"),
    FF_COUNT("points", micropitting, points, FF_TUNABLE, "200", NULL, 4, 100000, 0, 0,
             "number of equal steps along the path of contact"),
};

enum {
    OUT_ROLL_ANGLE,
    OUT_LAMBDA,
    OUT_FILM,
    OUT_CONTACT,
    OUT_LAMBDA_MIN,
    OUT_LAMBDA_MIN_AT,
    OUT_BULK,
    OUT_FRICTION,
    OUT_LAMBDA_GFT,
    OUT_LAMBDA_GFP,
    OUT_PERMISSIBLE,
    OUT_SAFETY,
    OUT_OWN_LAMBDA_MIN,
    OUT_OWN_SAFETY,
    OUT_SHEAR_MAX,
    OUTPUTS
};

static const ff_port outputs[OUTPUTS] = {
    [OUT_ROLL_ANGLE] = {.name = "roll_angle",
                        .unit = "rad",
                        .doc = "roll angle of gear 1",
                        .dims = "station"},
    [OUT_LAMBDA] =
        {.name = "lambda_gf",
         .unit = "1",
         .doc = "draft: specific film thickness: film over mean roughness Ra (15144-1, formula 2)",
         .dims = "station",
         .max = INFINITY},
    [OUT_FILM] = {.name = "film_thickness",
                  .unit = "m",
                  .doc = "draft: film thickness by the closed formula (15144-1, formula 4)",
                  .dims = "station"},
    [OUT_CONTACT] =
        {.name = "contact_temperature",
         .unit = "K",
         .doc = "draft: contact temperature: bulk plus flash temperature (15144-1, formula 79)",
         .dims = "station",
         .origin = "operating.oil_temperature"},
    [OUT_LAMBDA_MIN] = {.name = "lambda_gf_min",
                        .unit = "1",
                        .doc = "draft: minimum of lambda_gf",
                        .dims = "",
                        .max = INFINITY},
    [OUT_LAMBDA_MIN_AT] = {.name = "lambda_gf_min_at",
                           .unit = "rad",
                           .doc = "roll angle of lambda_gf_min",
                           .dims = ""},
    [OUT_BULK] = {.name = "bulk_temperature",
                  .unit = "K",
                  .doc = "draft: bulk temperature of the teeth (15144-1, formula 84)",
                  .dims = "",
                  .origin = "operating.oil_temperature",
                  NUMERICS_BULK_QUANTITY},
    [OUT_FRICTION] = {.name = "friction_coefficient",
                      .unit = "1",
                      .doc = "draft: mean coefficient of friction (15144-1, formula 86)",
                      .dims = ""},
    [OUT_LAMBDA_GFT] = {.name = "lambda_gft",
                        .unit = "1",
                        .doc =
                            "draft: limiting specific film thickness of the test gear: test_lambda",
                        .dims = "",
                        .max = INFINITY},
    [OUT_LAMBDA_GFP] = {.name = "lambda_gfp",
                        .unit = "1",
                        .doc = "draft: permissible specific film thickness, 1.4 W_W lambda_gft",
                        .dims = "",
                        .max = INFINITY},
    [OUT_PERMISSIBLE] = {.name = "permissible_lambda",
                         .unit = "1",
                         .doc = "draft: lambda_gfp",
                         .dims = "",
                         .max = INFINITY},
    [OUT_SAFETY] = {.name = "safety",
                    .unit = "1",
                    .doc = "draft: lambda_gf_min over lambda_gfp, both by the closed formulas "
                           "(15144-1, formula 1)",
                    .dims = "",
                    .max = INFINITY},
    [OUT_OWN_LAMBDA_MIN] = {.name = "own_lambda_gf_min",
                            .unit = "1",
                            .doc = "minimum film thickness of this program over mean roughness Ra",
                            .dims = "",
                            .max = INFINITY},
    [OUT_OWN_SAFETY] =
        {.name = "own_safety",
         .unit = "1",
         .doc =
             "own_lambda_gf_min over 1.4 W_W test_own_lambda, both from the film of this program",
         .dims = "",
         .max = INFINITY},
    [OUT_SHEAR_MAX] =
        {.name = "shear_max",
         .unit = "Pa",
         .doc = "largest shear stress below the flank, 0.300 of the highest Hertz pressure",
         .dims = ""},
};

typedef struct rating {
    double friction, bulk, viscosity,
        alpha; /* friction coefficient; bulk temperature, K; viscosity, Pa s, and pressure
                  coefficient, 1/Pa, at the bulk temperature */
    double alpha_38, shear;
    double least, least_at;
} rating;

/* Returns the pressure coefficient at 38 degC, 1/Pa, from the viscosity there, Pa s (formulas 9
 * to 11). */
static double alpha_at_38(const micropitting *s, double viscosity)
{
    static const struct {
        double factor, power;
    } of[] = {{2.657e-8, 0.1348}, {1.466e-8, 0.0507}, {1.392e-8, 0.1572}};
    return of[s->base].factor * pow(viscosity, of[s->base].power);
}

/* Returns the pressure coefficient at T, 1/Pa (formula 8). */
static double alpha_at(const rating *r, double T)
{
    return r->alpha_38 * (1 + 516 * (1 / T - 1.0 / 311));
}

static double lubricant_factor(const micropitting *s)
{
    static const double factor[] = {1.0, 0.8, 0.7};
    return factor[s->base];
}

/* Returns the loss factor H_v: the share of the power that is lost at a friction coefficient of 1
   (formulas 91 and 92). */
static double loss_factor(const rating_pair *p)
{
    const double e1 = rating_addendum_ratio(p, 0), e2 = rating_addendum_ratio(p, 1), all = e1 + e2;
    const double turns = M_PI * (1 / p->teeth[0] + 1 / p->teeth[1]);
    return turns * (all < 2 ? e1 * e1 + e2 * e2 + 1 - all : all / 2);
}

/* Sets friction coefficient and bulk temperature, from the oil at the oil temperature (formulas 84
   to 87 and 100). */
static ff_status set_bulk(const micropitting *s, const rating_pair *p, rating *r)
{
    static const double supply[] = {1.0, 1.2, 0.2};
    double viscosity, density, viscosity_38, density_38;
    ff_status status = rating_oil_at(s->host, p, p->oil_temperature, &viscosity, &density);
    if (status == FF_OK)
        status = rating_oil_at(s->host, p, 38 + celsius, &viscosity_38, &density_38);
    if (status != FF_OK)
        return status;
    const double radius = 1e3 * rating_radius(p, p->pitch_point),
                 load = 1e-3 * rating_line_load(p, &s->load);
    const double rough = 2.2 * pow(1e6 * p->roughness / radius, 0.25);
    const double sum = rating_speed(p, 0, p->pitch_point) + rating_speed(p, 1, p->pitch_point);
    r->friction = 0.045 * pow(load / (sum * radius), 0.2) * pow(1e3 * viscosity, -0.05) * rough *
                  lubricant_factor(s);
    const double e = fmax(rating_addendum_ratio(p, 0), rating_addendum_ratio(p, 1));
    const double relief =
        s->relieved && rating_grade(p, &s->load) <= 6 ? 1 + 0.24 * e + 0.71 * e * e : 1;
    const double power = 1e-3 * p->force * p->base[0] * p->omega; /* kW */
    const double heat =
        power * r->friction * loss_factor(p) / (1e6 * p->centre_distance * p->width);
    r->bulk = p->oil_temperature + 7400 * pow(heat, 0.72) * supply[s->supply] / (1.2 * relief);
    r->alpha_38 = alpha_at_38(s, viscosity_38);
    r->alpha = alpha_at(r, r->bulk);
    return rating_oil_at(s->host, p, r->bulk, &r->viscosity, &density);
}

typedef struct point {
    double film, contact;
} point;

/* Computes film and contact temperature at a place: h = 1.6 R G^0.6 U^0.7 W^-0.13 S^0.22
 * (formula 4, in SI), with the flash temperature of formula 80. */
static ff_status rate_at(const micropitting *s, const rating_pair *p, rating *r, double place,
                         point *at)
{
    const double radius = rating_radius(p, place), E = p->modulus;
    const double u1 = rating_speed(p, 0, place), u2 = rating_speed(p, 1, place);
    const double load = rating_line_load(p, &s->load) * rating_load_share(p, &s->load, place);
    const double pressure = sqrt(load * E / (2 * M_PI * radius)); /* formulas 24 and 25 */
    const double flash = sqrt(M_PI) / 2 * r->friction * pressure * fabs(u1 - u2) /
                         (p->contact[0] * sqrt(u1) + p->contact[1] * sqrt(u2)) *
                         sqrt(8 * radius * pressure / E);
    double viscosity, density;
    at->contact = r->bulk + flash;
    const ff_status status = rating_oil_at(s->host, p, at->contact, &viscosity, &density);
    if (status != FF_OK)
        return status;
    const double G = r->alpha * E, U = r->viscosity * (u1 + u2) / (2 * E * radius);
    const double W = 2 * M_PI * pressure * pressure / (E * E);
    const double S =
        alpha_at(r, at->contact) * viscosity / (r->alpha * r->viscosity); /* formula 27 */
    at->film = 1.6 * radius * pow(G, 0.6) * pow(U, 0.7) * pow(W, -0.13) * pow(S, 0.22);
    r->shear = fmax(r->shear,
                    0.300 * pressure); /* Johnson 1985, line contact: at 0.78 a below the surface */
    return FF_OK;
}

static double place_of(const micropitting *s, const rating_pair *p, size_t i)
{
    return p->sap + (p->end - p->sap) * (double)i / (double)s->points;
}

static ff_status rate(const micropitting *s, const rating_pair *p, point *points, rating *r)
{
    ff_status status = set_bulk(s, p, r);
    r->least = HUGE_VAL;
    for (size_t i = 0; i <= (size_t)s->points && status == FF_OK; i++) {
        double place = place_of(s, p, i);
        status = rate_at(s, p, r, place, &points[i]);
        if (status == FF_OK && !(isfinite(points[i].film) && points[i].film > 0))
            return ff_failf(s->host, FF_INVALID, outputs[OUT_FILM].name,
                            "the film is not a finite number: the inputs do not describe a gear");
        if (status == FF_OK && points[i].film / p->roughness < r->least) {
            r->least = points[i].film / p->roughness;
            r->least_at = rating_roll(p, place);
        }
    }
    return status;
}

static ff_status write_series(const micropitting *s, const rating_pair *p, const point *points,
                              uint64_t wanted)
{
    const size_t count = (size_t)s->points + 1;
    for (uint32_t row = OUT_ROLL_ANGLE; row <= OUT_CONTACT; row++) {
        double *to = wanted & FF_BIT(row) ? ff_put_series(s->host, row, count) : NULL;
        if (wanted & FF_BIT(row) && !to)
            return FF_NOMEM;
        for (size_t i = 0; to && i < count; i++)
            to[i] = row == OUT_ROLL_ANGLE ? rating_roll(p, place_of(s, p, i))
                    : row == OUT_LAMBDA   ? points[i].film / p->roughness
                    : row == OUT_FILM     ? points[i].film
                                          : points[i].contact;
    }
    return FF_OK;
}

/* lambda_GFP = 1.4 W_W lambda_GFT (ISO/TR 15144-1, clause 5.4). The published example has 1.4 x
 * 1.00 x 0.102 = 0.143 and 1.4 x 0.75 x 0.102 = 0.107. */
static double permissible(const micropitting *s, double of_test)
{
    return 1.4 * s->material_factor * of_test;
}

static const char no_film[] = "this output needs a film, a stage of the kind ehl";
static const char no_test[] =
    "this output needs test_lambda, which configs/fzg-cgf-micropitting.yaml gives";
static const char no_own_test[] =
    "this output needs test_own_lambda, which configs/fzg-cgf-micropitting.yaml gives";

static ff_status ready(void *self)
{
    const micropitting *s = self;
    static const ff_need needs[] = {
        {1, "ehl.h_min", "own_lambda_gf_min|own_safety", no_film},
        {1, "test_own_lambda", "own_safety", no_own_test},
        {1, "test_lambda", "lambda_gft|lambda_gfp|permissible_lambda|safety", no_test},
    };
    ff_tell_needs(s->host, needs, sizeof needs / sizeof needs[0]);
    return FF_OK;
}

/* Writes the ratio of lambda to its permissible value by the same method. Refuses the output if the
   test value is not given. */
static ff_status write_ratio(const micropitting *s, uint64_t wanted, uint32_t row, double lambda,
                             double of_test, const char *text)
{
    if (!(wanted & FF_BIT(row)))
        return FF_OK;
    if (isnan(of_test))
        return s->host->fail(s->host->ctx, FF_UNSUPPORTED, outputs[row].name, text);
    return ff_put_scalar(s->host, row, lambda / permissible(s, of_test));
}

static ff_status write_own(const micropitting *s, const rating_pair *p, const ff_array *film,
                           uint64_t wanted)
{
    const uint32_t row = wanted & FF_BIT(OUT_OWN_LAMBDA_MIN) ? OUT_OWN_LAMBDA_MIN : OUT_OWN_SAFETY;
    if (!(wanted & FF_BIT(row)))
        return FF_OK;
    if (!film->data)
        return s->host->fail(s->host->ctx, FF_UNSUPPORTED, outputs[row].name, no_film);
    double least = HUGE_VAL;
    for (size_t i = 0; i < film->shape[0]; i++)
        least = fmin(least, film->data[i]);
    least /= p->roughness;
    if (wanted & FF_BIT(OUT_OWN_LAMBDA_MIN) &&
        ff_put_scalar(s->host, OUT_OWN_LAMBDA_MIN, least) != FF_OK)
        return FF_NOMEM;
    return write_ratio(s, wanted, OUT_OWN_SAFETY, least, s->test_own_lambda, no_own_test);
}

static ff_status write_scalars(const micropitting *s, const rating *r, uint64_t wanted)
{
    const struct {
        uint32_t row;
        double value;
    } scalars[] = {{OUT_LAMBDA_MIN, r->least},
                   {OUT_LAMBDA_MIN_AT, r->least_at},
                   {OUT_BULK, r->bulk},
                   {OUT_FRICTION, r->friction},
                   {OUT_SHEAR_MAX, r->shear}};
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0]; i++)
        if (wanted & FF_BIT(scalars[i].row) &&
            ff_put_scalar(s->host, scalars[i].row, scalars[i].value) != FF_OK)
            return FF_NOMEM;
    const double limits[] = {s->test_lambda, permissible(s, s->test_lambda),
                             permissible(s, s->test_lambda)};
    for (uint32_t row = OUT_LAMBDA_GFT; row <= OUT_PERMISSIBLE; row++) {
        if (!(wanted & FF_BIT(row)))
            continue;
        if (isnan(s->test_lambda))
            return s->host->fail(s->host->ctx, FF_UNSUPPORTED, outputs[row].name, no_test);
        if (ff_put_scalar(s->host, row, limits[row - OUT_LAMBDA_GFT]) != FF_OK)
            return FF_NOMEM;
    }
    return write_ratio(s, wanted, OUT_SAFETY, r->least, s->test_lambda, no_test);
}

static void report(const micropitting *s, const rating_pair *p, const rating *r)
{
    const ff_host *host = s->host;
    const double ratio = (p->end - p->sap) / p->base_pitch;
    rating_report_draft(host, "ISO/TR 15144-1", "they agree with three published reports");
    host->quality(host->ctx, "contact_ratio", ratio, highest_ratio,
                  ratio <= highest_ratio ? FF_GOOD : FF_RANGE,
                  "contact ratio; the closed formulas hold below 2 only (clause 8.2)");
    host->quality(host->ctx, "pitch_speed", p->pitch_speed, 2,
                  p->pitch_speed >= 2 && p->pitch_speed <= 60 ? FF_GOOD : FF_RANGE,
                  "speed of the pitch circle, m/s; the method was developed for 8 to 60 m/s and "
                  "agrees with others above 2 m/s");
    const double yield = isnan(s->yield) ? p->yield : s->yield;
    if (!isnan(yield))
        host->quality(host->ctx, "shear_over_yield", 2 * r->shear / yield, 1,
                      2 * r->shear <= yield ? FF_GOOD : FF_RANGE,
                      "largest shear stress of the contact over the yield stress in shear; above 1 "
                      "the steel yields");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const micropitting *s = self;
    rating_pair p;
    rating r = {0};
    ff_status status = rating_pair_read(s->host, "ISO/TR 15144-1", in + 1, &s->heat, s->oil, &p);
    point *points = status == FF_OK ? malloc(((size_t)s->points + 1) * sizeof *points) : NULL;
    if (status == FF_OK && !points)
        status = FF_NOMEM;
    if (status == FF_OK)
        status = rate(s, &p, points, &r);
    if (status == FF_OK)
        status = write_series(s, &p, points, wanted);
    if (status == FF_OK)
        status = write_scalars(s, &r, wanted);
    if (status == FF_OK)
        status = write_own(s, &p, in, wanted);
    if (status == FF_OK)
        report(s, &p, &r);
    free(points);
    return status;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    if (input == 1 + RATING_IN_OIL)
        ((micropitting *)self)->oil = service;
    return FF_OK;
}

FF_MODEL(rating_micropitting, micropitting, .id = "rating/micropitting", .version = "0.1.0",
         .summary = "draft: specific film thickness along the path of contact, by closed formulas "
                    "and from the film of this program",
         .reference = "ISO/TR 15144-1:2014, method B, as quoted by a public implementation; the "
                      "text of the standard was not available",
         .bibtex = BIB_iso15144, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = rating_inputs, .input_count = RATING_INPUTS + 1,
         .input_stride = sizeof rating_inputs[0], .outputs = FF_TABLE(outputs), .wire = wire,
         .ready = ready, .evaluate = evaluate, .destroy = free);
