/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contradictory or unknown data must be reported at the parameter or output concerned. */
#include "check.h"
#include "stage.h"

#include <stdio.h>
#include <string.h>

typedef const char *const setting[2];

static stage *open_oil(const char *id, setting *set)
{
    stage *oil = stage_open(id);
    for (size_t i = 0; set[i][0]; i++)
        stage_set_text(oil, set[i][0], set[i][1]);
    return oil;
}

static void refused(const char *id, const char *item, setting *set)
{
    stage *oil = open_oil(id, set);
    ff_status status = stage_ready(oil);
    if (status == FF_OK)
        status = stage_run(oil);
    printf("%s: %s\n", stage_why_item(oil), stage_why(oil));
    check_true(item, status < FF_OK && !strcmp(stage_why_item(oil), item));
    stage_close(oil);
}

#define END                                                                                        \
    {                                                                                              \
        NULL, NULL                                                                                 \
    }
#define SHEET                                                                                      \
    {"nu_40", "220 cSt"}, {"nu_100", "19 cSt"},                                                    \
    {                                                                                              \
        "density_15", "890 kg/m3"                                                                  \
    }
#define POINT                                                                                      \
    {"eta0", "5 mPa s"}, {"at", "100 degC"},                                                       \
    {                                                                                              \
        "density", "918 kg/m3"                                                                     \
    }

static void contradictions(void)
{
    refused("lubricant/grade", "grade", (setting[]){{"grade", "ISO VG 221"}, END});
    refused("lubricant/grade", "nu_100",
            (setting[]){{"grade", "ISO VG 32"}, {"nu_100", "40 cSt"}, END});
    refused("lubricant/measured", "nu_40", (setting[]){{"density_15", "890 kg/m3"}, END});
    refused("lubricant/measured", "nu_40", (setting[]){{"nu_40", "220 cSt"}, END});
    refused("lubricant/measured", "eta0", (setting[]){{"eta0", "5 mPa s"}, END});
    refused("lubricant/measured", "at", (setting[]){SHEET, {"at", "100 degC"}, END});
    refused("lubricant/measured", "density_15",
            (setting[]){{"nu_40", "220 cSt"}, {"nu_100", "19 cSt"}, END});
    refused("lubricant/measured", "density",
            (setting[]){{"nu_40", "220 cSt"}, {"nu_100", "19 cSt"}, {"density", "890 kg/m3"}, END});
    refused("lubricant/measured", "alpha_at", (setting[]){SHEET, {"alpha", "20 1/GPa"}, END});
    refused("lubricant/measured", "alpha_at", (setting[]){SHEET, {"alpha_at", "40 degC"}, END});
    refused(
        "lubricant/measured", "eta0",
        (setting[]){{"eta0", "0.1 mPa s"}, {"at", "100 degC"}, {"density_15", "890 kg/m3"}, END});
}

static void temperatures(void)
{
    refused("lubricant/grade", "temperature", (setting[]){{"grade", "ISO VG 32"}, END});
    refused("lubricant/grade", "temperature",
            (setting[]){{"grade", "ISO VG 680"}, {"temperature", "-100 degC"}, END});
    /* data for one temperature must be used at this temperature only */
    refused("lubricant/measured", "eta0", (setting[]){POINT, {"temperature", "90 degC"}, END});
    stage *oil = open_oil("lubricant/grade",
                          (setting[]){{"grade", "ISO VG 32"}, {"temperature", "40 degC"}, END});
    stage_give_scalar(oil, "operating.oil_temperature", 353.15);
    check_true("temperature in two places",
               stage_run(oil) == FF_INVALID && !strcmp(stage_why_item(oil), "temperature") &&
                   strstr(stage_why(oil), "40 degC") && strstr(stage_why(oil), "80 degC"));
    stage_close(oil);
}

/* A request for unknown values must fail with their names; the other outputs must be given. */
static void unknown(void)
{
    static const char *const names[] = {"conductivity", "heat_capacity", "alpha"};
    stage *oil =
        open_oil("lubricant/measured", (setting[]){POINT, {"temperature", "100 degC"}, END});
    for (size_t i = 0; i < 3; i++)
        check_true(names[i], stage_run_wanted(oil, names[i]) == FF_UNSUPPORTED &&
                                 !strcmp(stage_why_item(oil), names[i]));
    check_true("the rest", stage_run(oil) == FF_OK);
    check_near("eta0", stage_scalar(oil, "eta0"), 5e-3, 1e-12);
    check_near("rho0", stage_scalar(oil, "rho0"), 918, 1e-12);
    stage_close(oil);
    oil = open_oil("lubricant/measured",
                   (setting[]){POINT, {"temperature", "100 degC"}, {"alpha", "11 1/GPa"}, END});
    check_true("alpha at the temperature of eta0", stage_run_wanted(oil, "alpha") == FF_OK);
    check_near("alpha", stage_scalar(oil, "alpha"), 11e-9, 1e-15);
    stage_close(oil);
}

static void far_temperatures_are_doubtful(void)
{
    stage *oil = open_oil("lubricant/grade",
                          (setting[]){{"grade", "ISO VG 32"}, {"temperature", "150 degC"}, END});
    check_true("runs", stage_run(oil) == FF_OK);
    check_true("within", stage_verdict(oil) == FF_GOOD);
    stage_close(oil);
    oil = open_oil("lubricant/grade",
                   (setting[]){{"grade", "ISO VG 32"}, {"temperature", "160 degC"}, END});
    check_true("runs", stage_run(oil) == FF_OK);
    check_true("beyond", stage_verdict(oil) == FF_DOUBTFUL);
    check_near("by 10 K", stage_quality(oil, "extrapolation"), 10, 1e-9);
    stage_close(oil);
}

int main(void)
{
    contradictions();
    temperatures();
    unknown();
    far_temperatures_are_doubtful();
    return check_done();
}
