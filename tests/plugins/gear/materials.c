/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials by name: what they give, and what overrules them. */
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

/* Nothing said: the steel of gear standards. */
static void check_steel(void)
{
    stage *gear = open_pair();
    check_true("no material is said", stage_run(gear) == FF_OK);
    check_near("modulus", of(gear, "elastic_modulus", 1), 206e9, 0);
    check_near("mass", of(gear, "mass", 0), 7850 * M_PI * 0.04 * 0.04 * 0.04, 1e-12);
    check_near("no yield strength is known", of(gear, "yield_strength", 0), 0, 0);
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

/* The material of gear 1 is that of both; a number of the file overrules it. */
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
    check_misspelt();
    return check_done();
}
