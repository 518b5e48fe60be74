/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law-data.h"

#include <math.h>
#include <string.h>

static const double reference = 313.15; /* K */

static ff_status oil_eval(const void *self, int32_t property, size_t n, const double *T,
                          double *value, double *slope)
{
    (void)self;
    for (size_t i = 0; i < n; i++) {
        double warm = T[i] - reference, by = 0;
        switch (property) {
        case FF_LIQUID_LN_ETA0:
            by = -0.03, value[i] = log(0.08) + by * warm;
            break;
        case FF_LIQUID_RHO0:
            by = -870 * 7e-4, value[i] = 870 + by * warm;
            break;
        case FF_LIQUID_CONDUCTIVITY:
            value[i] = 0.14;
            break;
        case FF_LIQUID_HEAT_CAPACITY:
            by = 4, value[i] = 1900 + by * warm;
            break;
        case FF_LIQUID_PRESSURE_COEFFICIENT:
            by = -4e-11, value[i] = 2e-8 + by * warm;
            break;
        case FF_LIQUID_REFERENCE_TEMPERATURE:
            value[i] = reference;
            break;
        case FF_LIQUID_BASE:
            value[i] = FF_BASE_MINERAL;
            break;
        default:
            return FF_UNSUPPORTED;
        }
        if (slope)
            slope[i] = by;
    }
    return FF_OK;
}

const ff_liquid conformance_oil = {sizeof conformance_oil, NULL, oil_eval};

double conformance_oil_at(int32_t property, double T)
{
    double value = NAN;
    oil_eval(NULL, property, 1, &T, &value, NULL);
    return value;
}

const void *conformance_open_law(const ff_fixture *fixture, const char *service, void **instance)
{
    const ff_model *model = fixture->model;
    *instance = fixture->open(fixture->ctx);
    for (size_t i = 0; *instance && i < model->output_count; i++) {
        const ff_port *row =
            (const void *)((const char *)model->outputs + i * model->output_stride);
        if (row->service && !strcmp(row->service, service))
            return fixture->service(fixture->ctx, *instance, (uint32_t)i);
    }
    return NULL;
}

/* The common first members of both service tables. */
typedef struct law_table {
    size_t size;
    const void *self;
    conformance_pT *eval;
} law_table;

double conformance_law_at(conformance_pT *eval, const void *self, double p, const double *T,
                          double *by_p)
{
    double value, slope_p, slope_T;
    eval(self, 1, &p, T, &value, by_p ? by_p : &slope_p, &slope_T);
    return value;
}

static const char *name_of(int32_t property)
{
    return property == FF_LIQUID_RHO0 ? "rho" : "ln_eta";
}

static bool follows(const ff_fixture *fixture, const law_table *law, int32_t property,
                    double within)
{
    static const double pressures[] = {0, 1e8, 3e8, 1e9};
    for (double T = 300; T < 371; T += 10) {
        double oil = conformance_oil_at(property, T),
               found = conformance_law_at(law->eval, law->self, 0, &T, NULL);
        if (!(fabs(found - oil) <= within))
            return ff_check_failf(fixture,
                                  "%s is %.6g at p = 0, T = %g K, but the wired oil has %.6g",
                                  name_of(property), found, T, oil);
        double cooler = T - 10;
        for (size_t i = 0; i < sizeof pressures / sizeof *pressures; i++) {
            double warm, cool;
            if (law->eval(law->self, 1, &pressures[i], &T, &warm, NULL, NULL) != FF_OK ||
                law->eval(law->self, 1, &pressures[i], &cooler, &cool, NULL, NULL) != FF_OK)
                continue; /* the law is outside its range */
            if (warm > cool)
                return ff_check_failf(
                    fixture,
                    "%s rises from %.6g at %g K to %.6g at %g K, p = %g Pa; it must decrease with "
                    "temperature, as that of the wired oil does",
                    name_of(property), cool, cooler, warm, T, pressures[i]);
        }
    }
    return true;
}

bool conformance_is_oil(const ff_fixture *fixture, const char *service, int32_t property,
                        double within)
{
    void *instance;
    if (!fixture->serve(fixture->ctx, "oil", &conformance_oil))
        return true;
    const law_table *law = conformance_open_law(fixture, service, &instance);
    bool good = law && follows(fixture, law, property, within);
    fixture->close(fixture->ctx, instance);
    return good;
}

bool conformance_is_as_set(const ff_fixture *fixture, const char *service, const char *param,
                           const char *text, double value, double within)
{
    void *instance;
    fixture->serve(fixture->ctx, "oil", NULL);
    if (!fixture->set(fixture->ctx, param, text))
        return true;
    const law_table *law = conformance_open_law(fixture, service, &instance);
    double found = law ? conformance_law_at(law->eval, law->self, 0, NULL, NULL) : value;
    bool good = law != NULL;
    if (!(fabs(found - value) <= within))
        good = ff_check_failf(fixture, "with %s = %s the value at p = 0 is %.6g, but must be %.6g",
                              param, text, found, value);
    fixture->close(fixture->ctx, instance);
    return good;
}
