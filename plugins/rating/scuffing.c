/* SPDX-License-Identifier: GPL-3.0-or-later */
/* rating/scuffing, a draft. It computes the scuffing safety by flash temperature and by integral
   temperature, as other sources quote ISO/TR 13989-1 and -2, and the contact temperature from the
   friction of the film. Where the standard uses mm and N/mm, the formulas here do, too. */
#include "pair.h"
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdlib.h>

static const double celsius = 273.15;
static const double lowest_load = 150;   /* N/mm; below it the friction formula of the integral
                                            method uses this load */
static const double highest_speed = 50;  /* m/s, for the friction of both methods */
static const double highest_ratio = 2.5; /* highest contact ratio for which the standard gives its
                                            equations */
static const double demanded = 50;       /* margin demanded by clause 10.5, K */

typedef struct scuffing {
    const ff_host *host;
    const ff_liquid *oil;
    rating_load load;
    int64_t stage, points;
    int32_t lubricant, supply;
    double structural, mesh_stiffness, tooth_stiffness;
    rating_heat heat;
    double test_temperature; /* K */
} scuffing;

static const ff_param params[] = {
    FF_COUNT("load_stage", scuffing, stage, FF_REQUIRED, NULL, NULL, 1, 14, 4, 14,
             "failure load stage of the oil in the FZG test A/8.3/90 (ISO 14635-1), from its data "
             "sheet; load stages of other test variants differ"),
    FF_ONE_OF("mineral|water-soluble-polyglycol|polyglycol|PAO|phosphate-ester|traction-fluid",
              "lubricant", scuffing, lubricant, 0, "mineral", "base oil: lubricant factor X_L"),
    FF_ONE_OF("dip|spray|submerged", "supply", scuffing, supply, 0, "dip",
              "oil supply to the mesh: factor X_S"),
    FF_QUANTITY("structural_factor", "1", scuffing, structural, 0, "1", NULL, 0.1, 5, 0.45, 1.5,
                "structural factor X_W: 1 for case-hardened steel with 10 to 20 % austenite, 1.5 "
                "for nitrided steel"),
    FF_QUANTITY("application_factor", "1", scuffing, load.application, 0, "1", NULL, 0.1, 10, 1,
                2.5, "K_A"),
    FF_QUANTITY("face_load_factor", "1", scuffing, load.face, 0, "1", NULL, 1, 10, 1, 2,
                "K_Hbeta = K_Bbeta"),
    FF_QUANTITY("transverse_load_factor", "1", scuffing, load.transverse, 0, "1", NULL, 1, 10, 1, 2,
                "K_Halpha = K_Balpha"),
    FF_COUNT_OR("auto", "quality_grade", scuffing, load.grade, 0, "auto", NULL, 1, 12, 0, 0,
                "flank tolerance class of ISO 1328-1, which affects the load sharing; auto: the "
                "coarser class of both gears, or 6 if they have no `quality`"),
    RATING_HEAT_ROWS(scuffing),
    FF_QUANTITY("mesh_stiffness", "N/(mm um)", scuffing, mesh_stiffness, 0, "20 N/(mm um)", NULL,
                0.1, 1000, 5, 40,
                "mesh stiffness c_gamma per face width; load over stiffness gives the optimal tip "
                "relief C_eff"),
    FF_QUANTITY("tooth_stiffness", "N/(mm um)", scuffing, tooth_stiffness, 0, "14 N/(mm um)", NULL,
                0.1, 1000, 5, 40,
                "stiffness c' of a single pair per face width; gives C_eff of the integral method"),
    FF_QUANTITY("test_contact_temperature", "degC", scuffing, test_temperature, 0, NULL, NULL, -50,
                2000, 0, 0,
                "reference of own_safety: contact_temperature_max computed by this program for the "
                "FZG A gears at the failure load stage of the oil (configs/fzg-a-scuffing.yaml)"),
    FF_COUNT("points", scuffing, points, FF_TUNABLE, "200", NULL, 4, 100000, 0, 0,
             "number of equal steps along the path of contact"),
};

enum { FLASH_METHOD, INTEGRAL_METHOD, METHODS };

enum {
    OUT_ROLL_ANGLE,
    OUT_FLASH,
    OUT_CONTACT,
    OUT_FRICTION,
    OUT_FLASH_MAX,
    OUT_FLASH_MAX_AT,
    OUT_BULK,
    OUT_CONTACT_MAX,
    OUT_INTEGRAL,
    OUT_PERMISSIBLE,
    OUT_SAFETY,
    OUT_MARGIN,
    OUT_OWN_CONTACT_MAX,
    OUT_OWN_SAFETY,
    OUTPUTS
};

static const ff_port outputs[OUTPUTS] = {
    [OUT_ROLL_ANGLE] = {.name = "roll_angle",
                        .unit = "rad",
                        .doc = "roll angle of gear 1",
                        .dims = "station"},
    [OUT_FLASH] = {.name = "flash_temperature",
                   .unit = "K",
                   .doc = "draft: flash temperature: rise of the flanks above their bulk "
                          "temperature (13989-1, formula 5)",
                   .dims = "station",
                   .flags = FF_DIFFERENCE,
                   .max = INFINITY},
    [OUT_CONTACT] =
        {.name = "contact_temperature",
         .unit = "K",
         .doc = "draft: contact temperature: bulk plus flash temperature (13989-1, formula 1)",
         .dims = "station",
         .origin = "operating.oil_temperature"},
    [OUT_FRICTION] = {.name = "friction_coefficient",
                      .unit = "1",
                      .doc = "draft: mean coefficient of friction (13989-1, formula 25)",
                      .dims = ""},
    [OUT_FLASH_MAX] = {.name = "flash_temperature_max",
                       .unit = "K",
                       .doc = "draft: highest flash temperature",
                       .dims = "",
                       .flags = FF_DIFFERENCE,
                       .max = INFINITY},
    [OUT_FLASH_MAX_AT] = {.name = "flash_temperature_max_at",
                          .unit = "rad",
                          .doc = "roll angle of flash_temperature_max",
                          .dims = ""},
    [OUT_BULK] = {.name = "bulk_temperature",
                  .unit = "K",
                  .doc = "draft: bulk temperature of the teeth (13989-1, formula 22)",
                  .dims = "",
                  .origin = "operating.oil_temperature",
                  NUMERICS_BULK_QUANTITY},
    [OUT_CONTACT_MAX] = {.name = "contact_temperature_max",
                         .unit = "K",
                         .doc = "draft: highest contact temperature",
                         .dims = "",
                         .origin = "operating.oil_temperature"},
    [OUT_INTEGRAL] = {.name = "integral_temperature",
                      .unit = "K",
                      .doc = "draft: integral temperature (13989-2, formula 17)",
                      .dims = "",
                      .origin = "operating.oil_temperature"},
    [OUT_PERMISSIBLE] =
        {.name = "permissible_temperature",
         .unit = "K",
         .doc =
             "draft: scuffing temperature for the failure load stage of the oil, by flash "
             "temperature (13989-1, formula 99) and by integral temperature (13989-2, formula 94)",
         .dims = "method",
         .origin = "operating.oil_temperature"},
    [OUT_SAFETY] = {.name = "safety",
                    .unit = "1",
                    .doc = "draft: safety by flash temperature: permissible over highest contact "
                           "temperature, both above the oil temperature (13989-1, formula 100); "
                           "safety by integral temperature: ratio in degC (13989-2, formula 14)",
                    .dims = "method"},
    [OUT_MARGIN] =
        {.name = "margin",
         .unit = "K",
         .doc = "draft: permissible minus highest contact temperature, by flash temperature",
         .dims = "",
         .flags = FF_DIFFERENCE},
    [OUT_OWN_CONTACT_MAX] =
        {.name = "own_contact_temperature_max",
         .unit = "K",
         .doc = "highest contact temperature, computed from the friction of the film",
         .dims = "",
         .origin = "operating.oil_temperature"},
    [OUT_OWN_SAFETY] = {.name = "own_safety",
                        .unit = "1",
                        .doc = "draft: test_contact_temperature over own_contact_temperature_max, "
                               "both above the oil temperature",
                        .dims = ""},
};

/* Results; temperatures in degC. */
typedef struct rating {
    double friction, flash_max, flash_max_at, flash_mean, bulk, contact_max, permissible[METHODS],
        integral, margin;
    double safety[METHODS];
} rating;

/* Returns X_L for both parts of the standard; it is 1 for mineral oils. */
static double lubricant_factor(const scuffing *s)
{
    static const double factor[] = {1.0, 0.6, 0.7, 0.8, 1.3, 1.5};
    return factor[s->lubricant];
}

static double supply_factor(const scuffing *s)
{
    static const double factor[] = {1.0, 1.2, 0.2}; /* dip, spray, submerged */
    return factor[s->supply];
}

/* Returns the approach factor X_J, formulas 45 and 46: before the pitch point, the tip of the
   driven tooth strikes the driving flank if its relief is too small. */
static double approach_factor(const rating_pair *p, double place, double best_relief)
{
    double before = (p->pitch_point - place) / (p->end - p->sap);
    if (before <= 0)
        return 1;
    return fmax(1, 1 + 1e6 * (best_relief - p->tip_relief[1]) / 50 * before * before * before);
}

/* X_M = 1000 E_r^0.25/B_M, with B_M = sqrt(k rho c) in N/(mm^0.5 m^0.5 s^0.5 K), 10^-1.5 of the
 * SI unit; about 50 for steel (13989-1, formulas A.9 to A.14). Gears of different steels share
 * the heat in proportion to B_M sqrt(v), as in Blok's theory. */
static double thermoelastic_factor(const rating_pair *p, double place)
{
    const double v1 = sqrt(rating_speed(p, 0, place)), v2 = sqrt(rating_speed(p, 1, place));
    const double contact = (p->contact[0] * v1 + p->contact[1] * v2) / (v1 + v2);
    return 1000 * pow(1e-6 * p->modulus, 0.25) / (contact * pow(10, -1.5));
}

/* Flash temperature, formula 5: 2.52 mu (X_M/50) X_J (X_Gamma w)^0.75 (n1/60)^0.5 |rho1^0.5 -
 * (rho2/u)^0.5|/rho^0.25. */
static double flash_at(const scuffing *s, const rating_pair *p, double friction, double load,
                       double place)
{
    double best =
        s->load.application * p->force / (p->width * s->mesh_stiffness); /* C_eff, formula B.1 */
    double share = rating_load_share(p, &s->load, place) * load;
    double sliding = fabs(sqrt(1e3 * place) - sqrt(1e3 * (p->line - place) / p->ratio));
    return 2.52 * friction * thermoelastic_factor(p, place) / 50 * approach_factor(p, place, best) *
           pow(share, 0.75) * sqrt(p->omega / (2 * M_PI)) * sliding /
           pow(1e3 * rating_radius(p, place), 0.25);
}

static double place_of(const scuffing *s, const rating_pair *p, size_t i)
{
    return p->sap + (p->end - p->sap) * (double)i / (double)s->points;
}

/* Part 1: flash temperature along the path. mu = 0.060 (w/(v rho))^0.2 X_L X_R (formula 25), X_L =
   c eta^-0.05, X_R = Ra^0.25. The source contradicts itself: it has Ra^0.25 in its code and Ra^0.5
   in its notes. Ra^0.25 is also in DIN 3990-4. With it, the safety of the test gears at their
   failure stage is as close to 1 as with the integral method. */
static ff_status rate_by_flash(const scuffing *s, const rating_pair *p, double *flash, rating *r)
{
    double viscosity, density;
    const ff_status status = rating_oil_at(s->host, p, p->oil_temperature, &viscosity, &density);
    if (status != FF_OK)
        return status;
    const double load =
        1e-3 * rating_line_load(p, &s->load) * cos(p->pressure_angle); /* w_Bt, N/mm */
    const double speed = 2 * fmin(p->pitch_speed, highest_speed) * sin(p->working_angle);
    const double lubricant = lubricant_factor(s) * pow(1e3 * viscosity, -0.05);
    const double stage = (double)s->stage;
    r->friction = 0.060 * pow(load / (speed * 1e3 * rating_radius(p, p->pitch_point)), 0.2) *
                  lubricant * pow(1e6 * p->roughness, 0.25);
    for (size_t i = 0; i <= (size_t)s->points; i++) {
        double place = place_of(s, p, i), at = flash_at(s, p, r->friction, load, place);
        flash[i] = at;
        r->flash_mean += at / ((double)s->points + 1);
        if (at > r->flash_max) {
            r->flash_max = at;
            r->flash_max_at = rating_roll(p, place);
        }
    }
    const double oil = p->oil_temperature - celsius;
    r->bulk = oil + 0.47 * supply_factor(s) * r->flash_mean; /* formula 22 */
    r->contact_max = r->bulk + r->flash_max;
    r->permissible[FLASH_METHOD] =
        80 + (0.85 + 1.4 * s->structural) * lubricant * stage * stage; /* formula 99 */
    r->safety[FLASH_METHOD] = (r->permissible[FLASH_METHOD] - oil) / (r->contact_max - oil);
    r->margin = r->permissible[FLASH_METHOD] - r->contact_max;
    return FF_OK;
}

/* Contact ratio factor X_eps, formulas 39 to 44 of part 2, from the addendum contact ratios of
 * pinion and wheel. */
static double contact_ratio_factor(double e1, double e2)
{
    const double all = e1 + e2, k = 1 / (2 * all * e1);
    if (all >= 2)
        return e1 >= e2
                   ? k * (0.44 * e1 * e1 + 0.59 * e2 * e2 + 0.30 * e1 - 0.30 * e2 - 0.15 * e1 * e2)
                   : k * (0.59 * e1 * e1 + 0.44 * e2 * e2 - 0.30 * e1 + 0.30 * e2 - 0.15 * e1 * e2);
    if (e1 >= 1)
        return k * (0.18 * e1 * e1 + 0.70 * e2 * e2 + 0.82 * e1 - 0.52 * e2 - 0.30 * e1 * e2);
    if (e2 >= 1)
        return k * (0.70 * e1 * e1 + 0.18 * e2 * e2 - 0.52 * e1 + 0.82 * e2 - 0.30 * e1 * e2);
    return k * (0.70 * (e1 * e1 + e2 * e2) - 0.22 * all + 0.52 - 0.60 * e1 * e2);
}

/* Approach factor X_Q, from the addendum contact ratios of the driving and the driven gear. The
   driven gear enters contact with its addendum, and the driving gear leaves contact with its
   addendum. */
static double ingoing_factor(double driving, double driven)
{
    const double ratio = driven / driving;
    return ratio <= 1.5 ? 1 : ratio >= 3 ? 0.6 : 1.4 - 4.0 / 15 * ratio;
}

/* Tip relief factor X_Ca, formulas 32 to 38, from the addendum contact ratios of the driving and
 * the driven gear; only for class 6 and better. */
static double tip_relief_factor(const scuffing *s, const rating_pair *p, double driving,
                                double driven)
{
    if (rating_grade(p, &s->load) > 6)
        return 1;
    double best =
        s->load.application * p->force * cos(p->pressure_angle) / (p->width * s->tooth_stiffness);
    double share = fmin(1, p->tip_relief[driving > 1.5 * driven ? 0 : 1] / best),
           e = fmax(driving, driven);
    return 1 + (0.06 + 0.18 * share) * e + (0.02 + 0.69 * share) * e * e;
}

/* Part 2: theta_int = theta_M + 1.5 theta_E X_eps, from the flash temperature at the tip of the
 * pinion (formulas 17 to 19). */
static ff_status rate_by_integral(const scuffing *s, const rating_pair *p, rating *r)
{
    double viscosity, density, viscosity_40, density_40;
    ff_status status = rating_oil_at(s->host, p, p->oil_temperature, &viscosity, &density);
    if (status == FF_OK)
        status = rating_oil_at(s->host, p, 40 + celsius, &viscosity_40, &density_40);
    if (status != FF_OK)
        return status;
    const double load = 1e-3 * rating_line_load(p, &s->load) * cos(p->pressure_angle);
    const double speed =
        2 * fmin(p->pitch_speed, highest_speed) * tan(p->working_angle) * cos(p->pressure_angle);
    const double radius = 1e3 * rating_radius(p, p->pitch_point);
    const double rough = 2.2 * pow(1e6 * p->roughness / radius, 0.25); /* X_R, formula 7 */
    const double friction = 0.045 * pow(fmax(load, lowest_load) / (speed * radius), 0.2) *
                            pow(1e3 * viscosity, -0.05) * rough *
                            lubricant_factor(s); /* formula 1 */
    const double w = p->working_angle, a = p->pressure_angle;
    const double angle =
        1.22 * pow(sin(w) * cos(a), 0.25) / sqrt(cos(w) * cos(a)); /* X_alpha_beta, formula 13 */
    const int one = p->pinion, two = 1 - one;
    const double u = p->teeth[two] / p->teeth[one];
    const double rho1 = 1e3 * (one == 0 ? p->end : p->line - p->sap), rho2 = 1e3 * p->line - rho1;
    const double geometry =
        0.51 * sqrt(u + 1) * (sqrt(rho1) - sqrt(rho2 / u)) / pow(rho1 * rho2, 0.25); /* X_BE */
    const double e[2] = {rating_addendum_ratio(p, 0), rating_addendum_ratio(p, 1)};
    const double tip = friction * thermoelastic_factor(p, one == 0 ? p->end : p->sap) * geometry *
                       angle * pow(load, 0.75) * sqrt(p->pitch_speed) /
                       pow(1e3 * p->centre_distance, 0.25) /
                       (ingoing_factor(e[0], e[1]) * tip_relief_factor(s, p, e[0], e[1]));
    const double mean = tip * contact_ratio_factor(e[one], e[two]),
                 oil = p->oil_temperature - celsius;
    r->integral = oil + 0.7 * mean * supply_factor(s) + 1.5 * mean; /* formulas 20 and 17 */
    const double torque =
        3.726 * (double)s->stage * (double)s->stage; /* torque of the test gear, N m: formula 97 */
    const double viscosity_of_test = 1e6 * viscosity_40 / density_40; /* mm2/s */
    r->permissible[INTEGRAL_METHOD] = 80 + 0.23 * torque * lubricant_factor(s) +
                                      s->structural * 1.5 * 0.2 * torque *
                                          pow(100 / viscosity_of_test, 0.02) * lubricant_factor(s);
    r->safety[INTEGRAL_METHOD] = r->permissible[INTEGRAL_METHOD] / r->integral;
    return FF_OK;
}

static void report(const scuffing *s, const rating_pair *p, const rating *r)
{
    const ff_host *host = s->host;
    const double ratio = (p->end - p->sap) / p->base_pitch;
    rating_report_draft(host, "ISO/TR 13989-1 and -2",
                        "they were not compared with a published example");
    host->quality(host->ctx, "margin", r->margin, demanded,
                  r->margin >= demanded ? FF_GOOD : FF_RANGE,
                  "margin between the highest contact temperature and the scuffing temperature, K; "
                  "13989-1 demands 50 K");
    host->quality(host->ctx, "contact_ratio", ratio, highest_ratio,
                  ratio <= highest_ratio ? FF_GOOD : FF_RANGE,
                  "contact ratio; the equations hold up to 2.5");
    host->quality(host->ctx, "pitch_speed", p->pitch_speed, 1,
                  p->pitch_speed >= 1 && p->pitch_speed <= highest_speed ? FF_GOOD : FF_RANGE,
                  "speed of the pitch circle, m/s; the friction formula holds from 1 to 50 m/s");
}

static ff_status write_series(const scuffing *s, const rating_pair *p, const double *flash,
                              const rating *r, uint64_t wanted)
{
    const size_t count = (size_t)s->points + 1;
    for (uint32_t row = OUT_ROLL_ANGLE; row <= OUT_CONTACT; row++) {
        double *to = wanted & FF_BIT(row) ? ff_put_series(s->host, row, count) : NULL;
        if (wanted & FF_BIT(row) && !to)
            return FF_NOMEM;
        for (size_t i = 0; to && i < count; i++)
            to[i] = row == OUT_ROLL_ANGLE ? rating_roll(p, place_of(s, p, i))
                    : row == OUT_FLASH    ? flash[i]
                                          : flash[i] + r->bulk + celsius;
    }
    return FF_OK;
}

static ff_status write_methods(const scuffing *s, const rating *r, uint64_t wanted)
{
    const double *const from[] = {r->permissible, r->safety};
    for (uint32_t k = 0; k < 2; k++) {
        if (!(wanted & FF_BIT(OUT_PERMISSIBLE + k)))
            continue;
        double *to = ff_put_series(s->host, OUT_PERMISSIBLE + k, METHODS);
        if (!to)
            return FF_NOMEM;
        for (size_t i = 0; i < METHODS; i++)
            to[i] = from[k][i] + (k == 0 ? celsius : 0);
    }
    return FF_OK;
}

static const char no_losses[] =
    "this output needs the contact temperature of a stage of the kind losses";
static const char no_test[] =
    "this output needs test_contact_temperature, which configs/fzg-a-scuffing.yaml gives";

static ff_status ready(void *self)
{
    const scuffing *s = self;
    static const ff_need needs[] = {
        {1, "losses.contact_temperature_max", "own_contact_temperature_max|own_safety", no_losses},
        {1, "test_contact_temperature", "own_safety", no_test},
    };
    ff_tell_needs(s->host, needs, sizeof needs / sizeof needs[0]);
    return FF_OK;
}

/* Writes the contact temperature from the friction of the film, and compares it with the test gear
   computed in the same way. */
static ff_status write_own(const scuffing *s, const rating_pair *p, const ff_array *in,
                           uint64_t wanted)
{
    const uint32_t row =
        wanted & FF_BIT(OUT_OWN_CONTACT_MAX) ? OUT_OWN_CONTACT_MAX : OUT_OWN_SAFETY;
    if (!(wanted & FF_BIT(row)))
        return FF_OK;
    if (!in[RATING_INPUTS].data)
        return s->host->fail(s->host->ctx, FF_UNSUPPORTED, outputs[row].name, no_losses);
    const double own = in[RATING_INPUTS].data[0];
    if (wanted & FF_BIT(OUT_OWN_CONTACT_MAX) &&
        ff_put_scalar(s->host, OUT_OWN_CONTACT_MAX, own) != FF_OK)
        return FF_NOMEM;
    if (!(wanted & FF_BIT(OUT_OWN_SAFETY)))
        return FF_OK;
    if (isnan(s->test_temperature))
        return s->host->fail(s->host->ctx, FF_UNSUPPORTED, outputs[OUT_OWN_SAFETY].name, no_test);
    if (!(own > p->oil_temperature))
        return ff_failf(s->host, FF_INVALID, "losses.contact_temperature_max",
                        "the flanks are not warmer than the oil, so this ratio is not defined");
    return ff_put_scalar(s->host, OUT_OWN_SAFETY,
                         (s->test_temperature - p->oil_temperature) / (own - p->oil_temperature));
}

static ff_status write_outputs(const scuffing *s, const rating_pair *p, const ff_array *in,
                               const double *flash, const rating *r, uint64_t wanted)
{
    const struct {
        uint32_t row;
        double value;
    } scalars[] = {{OUT_FRICTION, r->friction},
                   {OUT_FLASH_MAX, r->flash_max},
                   {OUT_FLASH_MAX_AT, r->flash_max_at},
                   {OUT_BULK, r->bulk + celsius},
                   {OUT_CONTACT_MAX, r->contact_max + celsius},
                   {OUT_INTEGRAL, r->integral + celsius},
                   {OUT_MARGIN, r->margin}};
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0]; i++) {
        if (!isfinite(scalars[i].value))
            return ff_failf(s->host, FF_INVALID, outputs[scalars[i].row].name,
                            "%s is not a finite number: the inputs do not describe a gear",
                            outputs[scalars[i].row].name);
        if (wanted & FF_BIT(scalars[i].row) &&
            ff_put_scalar(s->host, scalars[i].row, scalars[i].value) != FF_OK)
            return FF_NOMEM;
    }
    ff_status status = write_series(s, p, flash, r, wanted);
    if (status == FF_OK)
        status = write_methods(s, r, wanted);
    return status == FF_OK ? write_own(s, p, in, wanted) : status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const scuffing *s = self;
    rating_pair p;
    rating r = {0};
    ff_status status = rating_pair_read(s->host, "ISO/TR 13989", in, &s->heat, s->oil, &p);
    double *flash = status == FF_OK ? malloc(((size_t)s->points + 1) * sizeof *flash) : NULL;
    if (status == FF_OK && !flash)
        status = FF_NOMEM;
    if (status == FF_OK)
        status = rate_by_flash(s, &p, flash, &r);
    if (status == FF_OK)
        status = rate_by_integral(s, &p, &r);
    if (status == FF_OK)
        status = write_outputs(s, &p, in, flash, &r, wanted);
    if (status == FF_OK)
        report(s, &p, &r);
    free(flash);
    return status;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    if (input == RATING_IN_OIL)
        ((scuffing *)self)->oil = service;
    return FF_OK;
}

FF_MODEL(rating_scuffing, scuffing, .id = "rating/scuffing", .version = "0.1.0",
         .summary = "draft: scuffing by flash and integral temperature, and the contact "
                    "temperature from the friction of the film",
         .reference = "ISO/TR 13989-1:2000 and -2:2000 as quoted by a public implementation; the "
                      "texts of the standard were not available",
         .bibtex = BIB_iso13989, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = &rating_inputs[1], .input_count = RATING_INPUTS + 1,
         .input_stride = sizeof rating_inputs[0], .outputs = FF_TABLE(outputs), .wire = wire,
         .ready = ready, .evaluate = evaluate, .destroy = free);
