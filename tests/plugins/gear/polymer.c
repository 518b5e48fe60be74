/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steel on POM and POM on POM: Hertz contact, film and flash temperature, computed here from the
   gear data. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>

enum { GEAR, DUTY, MESH, TOOTH, VISCOSITY, DENSITY, FLOW, FILM, LOSSES, STAGES };

static const char *const models[STAGES] = {
    "gear/involute-spur", "operating/steady", "stiffness/iso-6336",
    "contact/tooth-pair", "viscosity/barus",  "density/incompressible",
    "rheology/newtonian", "ehl/film-formula", "losses/tooth-mesh"};

static const struct {
    int stage;
    const char *param, *text;
} settings[] = {{GEAR, "teeth", "[23, 41]"},
                {GEAR, "module", "2 mm"},
                {GEAR, "face_width", "15 mm"},
                {GEAR, "backlash", "0.1 mm"},
                {DUTY, "torque", "4 N m"},
                {DUTY, "speed", "1000 rpm"},
                {DUTY, "oil_temperature", "40 degC"},
                {VISCOSITY, "eta0", "90 mPa s"},
                {VISCOSITY, "alpha", "20 1/GPa"},
                {FILM, "formula", "dowson-higginson"},
                {FILM, "pressure_coefficient", "ambient"},
                {DENSITY, "rho0", "870 kg/m3"}};

static const struct {
    int to, from;
    const char *wire;
} wires[] = {{DUTY, GEAR, "gear"},
             {MESH, GEAR, "gear"},
             {MESH, DUTY, "operating"},
             {TOOTH, GEAR, "gear"},
             {TOOTH, DUTY, "operating"},
             {TOOTH, MESH, "load"},
             {TOOTH, VISCOSITY, "viscosity"},
             {FILM, TOOTH, "contact"},
             {FILM, GEAR, "gear"},
             {FILM, VISCOSITY, "viscosity"},
             {FILM, DENSITY, "density"},
             {FILM, FLOW, "rheology"},
             {LOSSES, FILM, "ehl"},
             {LOSSES, GEAR, "gear"},
             {LOSSES, DUTY, "operating"}};

/* E, nu, k, rho, c from the literature. */
typedef struct material {
    const char *name;
    double E, nu, k, rho, c;
} material;

static const material steel = {"steel", 206e9, 0.3, 50, 7850, 484},
                      pom = {"POM", 3.2e9, 0.35, 0.30, 1415, 1465};

static void run(stage *chain[STAGES], const material *one, const material *two)
{
    for (int i = 0; i < STAGES; i++)
        chain[i] = stage_open(models[i]);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        stage_set_text(chain[settings[i].stage], settings[i].param, settings[i].text);
    stage_set_text(chain[GEAR], "material", one->name);
    stage_set_text(chain[GEAR], "material_2", two->name);
    for (size_t i = 0; i < sizeof wires / sizeof wires[0]; i++)
        stage_link(chain[wires[i].to], wires[i].wire, chain[wires[i].from]);
    const int ok =
        stage_run_wanted(chain[TOOTH],
                         "hertz_pressure load_per_width equivalent_radius speed_1 speed_2") ==
            FF_OK &&
        stage_run_wanted(chain[FILM], "h_min traction") == FF_OK &&
        stage_run(chain[LOSSES]) == FF_OK;
    if (!check_true("runs", ok))
        printf("%s: %s\n", stage_why_item(chain[LOSSES]), stage_why(chain[LOSSES]));
}

static void check_pair(const material *one, const material *two)
{
    stage *chain[STAGES];
    size_t n;
    printf("%s on %s\n", one->name, two->name);
    run(chain, one, two);
    const double *w = stage_get(chain[TOOTH], "load_per_width", &n);
    const double *R = stage_get(chain[TOOTH], "equivalent_radius", NULL);
    const double *p = stage_get(chain[TOOTH], "hertz_pressure", NULL);
    const double *u1 = stage_get(chain[TOOTH], "speed_1", NULL);
    const double *u2 = stage_get(chain[TOOTH], "speed_2", NULL);
    const double *traction = stage_get(chain[FILM], "traction", NULL);
    const double *flash = stage_get(chain[LOSSES], "flash_temperature", NULL);
    const double E = 2 / ((1 - one->nu * one->nu) / one->E + (1 - two->nu * two->nu) / two->E);
    const double B[2] = {sqrt(one->k * one->rho * one->c), sqrt(two->k * two->rho * two->c)};
    const double *h = stage_get(chain[FILM], "h_min", NULL);
    double hertz = 0, film = 0, heat = 0;
    for (size_t i = 0; i < n; i++) {
        const double a = sqrt(8 * w[i] * R[i] / (M_PI * E));
        const double rise = 1.11 * fabs(traction[i] * (u1[i] - u2[i])) /
                            ((B[0] * sqrt(u1[i]) + B[1] * sqrt(u2[i])) * sqrt(2 * a));
        const double U = 0.09 * 0.5 * (u1[i] + u2[i]) / (E * R[i]), W = w[i] / (E * R[i]);
        const double printed = 2.65 * R[i] * pow(20e-9 * E, 0.54) * pow(U, 0.7) * pow(W, -0.13);
        film = fmax(film, fabs(h[i] / printed - 1));
        hertz = fmax(hertz, fabs(p[i] / (2 * w[i] / (M_PI * a)) - 1));
        heat = fmax(heat, fabs(flash[i] - rise));
    }
    check_below("Hertz pressure 2 w/(pi a)", hertz, 1e-10);
    check_below("Dowson and Higginson's film", film, 1e-9);
    check_below("Blok's flash, K", heat,
                1e-6 * stage_scalar(chain[LOSSES], "flash_temperature_max"));
    printf("highest pressure %.4g MPa, film %.4g um, flash %.4g K\n", 1e-6 * p[n / 2],
           1e6 * h[n / 2], stage_scalar(chain[LOSSES], "flash_temperature_max"));
    for (int i = STAGES; i-- > 0;)
        stage_close(chain[i]);
}

int main(void)
{
    check_pair(&steel, &steel);
    check_pair(&steel, &pom);
    check_pair(&pom, &pom);
    return check_done();
}
