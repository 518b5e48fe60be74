/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials by name: their values, and inputs that replace them. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <string.h>

static stage *open_pair(void)
{
    stage *gear = stage_open("gear/involute-spur");
    stage_set_text(gear, "module", "4 mm");
    stage_set_text(gear, "face_width", "40 mm");
    stage_set_text(gear, "teeth", "[20, 40]");
    return gear;
}

static double of(stage *gear, const char *output, int i)
{
    return stage_get(gear, output, NULL)[i];
}

/* Without a material, that of gear standards, steel, must be used. */
static void check_steel(void)
{
    stage *gear = open_pair();
    check_true("no material is said", stage_run(gear) == FF_OK);
    check_near("modulus", of(gear, "elastic_modulus", 1), 206e9, 0);
    check_near("mass", of(gear, "mass", 0), 7850 * M_PI * 0.04 * 0.04 * 0.04, 1e-12);
    check_near("no yield strength is known", of(gear, "yield_strength", 0), 0, 0);
    check_near("conductivity", of(gear, "thermal_conductivity", 0), 50, 0);
    check_near("specific heat", of(gear, "specific_heat", 1), 484, 0);
    check_near("hardness, 700 HV", of(gear, "hardness", 1), 7e9, 0);
    stage_close(gear);
}

static void check_two(void)
{
    stage *gear = open_pair();
    stage_set_text(gear, "material", "42CrMo4");
    stage_set_text(gear, "material_2", "EN-GJS-700-2");
    check_true("two materials", stage_run(gear) == FF_OK);
    check_near("modulus of gear 1", of(gear, "elastic_modulus", 0), 210e9, 0);
    check_near("modulus of gear 2", of(gear, "elastic_modulus", 1), 180e9, 0);
    check_near("2/E' is their sum", stage_scalar(gear, "reduced_modulus"),
               2 / (0.91 / 210e9 + 0.91 / 180e9), 1e-12);
    check_near("density of gear 2", of(gear, "mass", 1), 7200 * M_PI * 0.08 * 0.08 * 0.04, 1e-12);
    check_near("yield strength of gear 1", of(gear, "yield_strength", 0), 650e6, 0);
    check_near("yield strength of gear 2", of(gear, "yield_strength", 1), 420e6, 0);
    stage_close(gear);
}

/* The material of gear 1 must be used for both gears; a given number must replace that of the
   material. */
static void check_numbers(void)
{
    stage *gear = open_pair();
    stage_set_text(gear, "material", "EN-GJL-250");
    stage_set_text(gear, "elastic_modulus", "[115 GPa, 120 GPa]");
    check_true("a modulus beside a material", stage_run(gear) == FF_OK);
    check_near("the number", of(gear, "elastic_modulus", 1), 120e9, 0);
    check_near("of both", of(gear, "yield_strength", 1), 165e6, 0);
    stage_close(gear);
}

/* All materials, with values from their sources again: GPa, 1, kg/m3, W/(m K), J/(kg K), GPa,
   MPa. */
static void check_table(void)
{
    static const struct {
        const char *name;
        double E, nu, rho, k, c, hardness, yield;
    } table[] = {{"18CrNiMo7-6", 210, 0.3, 7800, 50, 484, 7, 0},
                 {"20MnCr5", 210, 0.3, 7800, 50, 484, 7, 0},
                 {"42CrMo4", 210, 0.3, 7800, 42.6, 484, 2.95, 650},
                 {"31CrMoV9", 210, 0.3, 7800, 50, 484, 7.85, 0},
                 {"EN-GJS-500-7", 170, 0.3, 7200, 35.2, 515, 1.96, 320},
                 {"EN-GJS-700-2", 180, 0.3, 7200, 31.1, 515, 2.6, 420},
                 {"EN-GJL-250", 115, 0.3, 7200, 46, 490, 1.77, 165},
                 {"CuSn12Ni2", 110, 0.34, 8700, 70, 370, 0.98, 200},
                 {"POM", 3.2, 0.35, 1415, 0.30, 1465, 0, 59.8},
                 {"PA66", 1.85, 0.3, 1140, 0.26, 1670, 0, 0},
                 {"PEEK", 3.88, 0.4, 1340, 0.299, 1410, 0, 97.1}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        stage *gear = open_pair();
        stage_set_text(gear, "material_2", table[i].name);
        if (check_true(table[i].name, stage_run(gear) == FF_OK)) {
            check_near("E", of(gear, "elastic_modulus", 1), 1e9 * table[i].E, 1e-15);
            check_near("nu", of(gear, "poisson_ratio", 1), table[i].nu, 1e-15);
            check_near("rho", of(gear, "density", 1), table[i].rho, 1e-15);
            check_near("k", of(gear, "thermal_conductivity", 1), table[i].k, 1e-15);
            check_near("c", of(gear, "specific_heat", 1), table[i].c, 1e-15);
            check_near("H", of(gear, "hardness", 1), 1e9 * table[i].hardness, 1e-15);
            check_near("yield", of(gear, "yield_strength", 1), 1e6 * table[i].yield, 1e-15);
            check_near("gear 1 keeps its own", of(gear, "thermal_conductivity", 0), 50, 0);
        }
        stage_close(gear);
    }
}

/* If the modulus is not that of steel, the thermal properties of the material must be unknown. */
static void check_contradiction(void)
{
    stage *gear = open_pair();
    stage_set_text(gear, "elastic_modulus", "[206 GPa, 2.8 GPa]");
    stage_set_text(gear, "density", "[7850 kg/m3, 1410 kg/m3]");
    check_true("another material", stage_run(gear) == FF_OK);
    check_near("steel stays steel", of(gear, "thermal_conductivity", 0), 50, 0);
    check_near("no conductivity of steel", of(gear, "thermal_conductivity", 1), 0, 0);
    check_near("no heat of steel", of(gear, "specific_heat", 1), 0, 0);
    check_near("no hardness of steel", of(gear, "hardness", 1), 0, 0);
    stage_set_text(gear, "thermal_conductivity", "[51 W/(m K), 0.31 W/(m K)]");
    stage_set_text(gear, "hardness", "[6 GPa, 0.15 GPa]");
    check_true("with what is known of it", stage_run(gear) == FF_OK);
    check_near("typed of steel", of(gear, "thermal_conductivity", 0), 51, 0);
    check_near("typed of the other", of(gear, "thermal_conductivity", 1), 0.31, 0);
    check_near("its hardness", of(gear, "hardness", 1), 0.15e9, 1e-15);
    stage_close(gear);
    gear = open_pair();
    stage_set_text(gear, "material", "POM");
    stage_set_text(gear, "elastic_modulus", "2.8 GPa");
    check_true("a grade of a polymer", stage_run(gear) == FF_OK);
    check_near("is that polymer", of(gear, "thermal_conductivity", 1), 0.30, 0);
    stage_close(gear);
    gear = open_pair();
    stage_set_text(gear, "material", "42CrMo4");
    stage_set_text(gear, "density", "7000 kg/m3");
    check_true("another density", stage_run(gear) == FF_OK);
    check_near("another steel", of(gear, "yield_strength", 0), 0, 0);
    stage_close(gear);
}

static void check_misspelt(void)
{
    stage *gear = open_pair();
    check_true("a misspelt name is refused",
               stage_try_text(gear, "material", "18CrNiMo7") != FF_OK);
    check_true("with the nearest", strstr(stage_why(gear), "18CrNiMo7-6") != NULL);
    stage_close(gear);
}

int main(void)
{
    check_steel();
    check_two();
    check_numbers();
    check_table();
    check_contradiction();
    check_misspelt();
    return check_done();
}
