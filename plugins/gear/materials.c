/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values and sources, which docs/guide/your-gear.md repeats: - steel: modulus, Poisson's ratio and
   density as in gear standards; heat data of case-hardened steel as quoted from ISO/TR 13989-2,
   clause 5.3 (50 W/(m K) and 3.8 MJ/(m3 K), which agrees with the B_M of 13.780 printed in
   gfsReboucas/Drivetrain, stage_03.rtf); hardness 700 HV. Heat data and hardness are used for all
   steels without their own. - E, nu, rho of the other steels and of castings, and the yield
   strength of castings: FreeCAD's material cards
   (src/Mod/Material/Resources/Materials/Standard/Metal/Steel, by M. Muench, which name EN 10084, EN
   10083, EN 1563 and EN 1561). Its case-hardening steels (15CrNi6, 17CrNiMo6 = 18CrNiMo7-6,
   20NiCrMo2) share one modulus, ratio and density; 16MnCr5 and 20MnCr5 are given the same values
   here. 42CrMo4 and 31CrMoV9 have those of its heat-treatable steels (34CrNiMo6, 30CrNiMo8, C60E).
   - 42CrMo4: yield strength EN 10083, quenched and tempered, 40 to 100 mm, from a data sheet (Key
   to Metals); conductivity from a data sheet (Meusburger, 1.7225); hardness the middle of 271 to
   331 HBW for that size (Lucefin, ISO 683-2). 31CrMoV9: 800 HV nitrided, from a data sheet. -
   Castings: conductivity and hardness from data sheets (iron-foundry.com, EN 1563; MakeItFrom,
   EN-JL 1040); specific heat, and the conductivity of EN-GJS-700-2, by EN 1563 from memory.
   Hardness is the middle of the range. - CuSn12Ni2: MakeItFrom, EN CC484K. - POM, PA66: the
   material library of cfernandesFEUP/GEARpie; yield strength of POM from FreeCAD's card
   (copolymer). PEEK: FreeCAD's card; Poisson's ratio from memory. Case-hardening and nitriding
   steels have no yield strength here: tables print that of the core, but the hard layer carries the
   load of a flank, so the user must give it. */
#include "materials.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static const gear_material materials[] = {
    {206e9, 0.3, 7850, 50, 484, 7e9, 0},          /* steel */
    {210e9, 0.3, 7800, 50, 484, 7e9, 0},          /* 16MnCr5 */
    {210e9, 0.3, 7800, 50, 484, 7e9, 0},          /* 20MnCr5 */
    {210e9, 0.3, 7800, 50, 484, 7e9, 0},          /* 15CrNi6 */
    {210e9, 0.3, 7800, 50, 484, 7e9, 0},          /* 18CrNiMo7-6 */
    {210e9, 0.3, 7800, 50, 484, 7e9, 0},          /* 20NiCrMo2 */
    {210e9, 0.3, 7800, 42.6, 484, 2.95e9, 650e6}, /* 42CrMo4 */
    {210e9, 0.3, 7800, 50, 484, 7.85e9, 0},       /* 31CrMoV9 */
    {170e9, 0.3, 7200, 35.2, 515, 1.96e9, 320e6}, /* EN-GJS-500-7 */
    {180e9, 0.3, 7200, 31.1, 515, 2.6e9, 420e6},  /* EN-GJS-700-2 */
    {115e9, 0.3, 7200, 46, 490, 1.77e9, 165e6},   /* EN-GJL-250 */
    {110e9, 0.34, 8700, 70, 370, 0.98e9, 200e6},  /* CuSn12Ni2 */
    {3.2e9, 0.35, 1415, 0.30, 1465, 0, 59.8e6},   /* POM */
    {1.85e9, 0.3, 1140, 0.26, 1670, 0, 0},        /* PA66 */
    {3.88e9, 0.4, 1340, 0.299, 1410, 0, 97.1e6},  /* PEEK */
};

/* Returns whether modulus and density agree with those of the named material: within 10 % for
   metals, and within 30 % for polymers, whose grades differ by that much. */
static bool is_alike(const gear_material *m, const gear_material *named)
{
    const double alike = named->modulus < 10e9 ? 0.3 : 0.1;
    return fabs(m->modulus / named->modulus - 1) <= alike &&
           fabs(m->density / named->density - 1) <= alike;
}

gear_material gear_material_of(int64_t rank)
{
    const int64_t count = sizeof materials / sizeof *materials;
    return materials[rank >= 0 && rank < count ? rank : 0];
}

static double either(const ff_reals *said, int g, double of_material)
{
    return said->count > 0 ? ff_of_both(said, g) : of_material;
}

gear_material gear_material_make(const gear_material_spec *s, int g)
{
    const gear_material named = gear_material_of(s->name[g == 1 && s->name[1] >= 0 ? 1 : 0]);
    gear_material m = named;
    m.modulus = either(&s->modulus, g, named.modulus);
    m.poisson = either(&s->poisson, g, named.poisson);
    m.density = either(&s->density, g, named.density);
    if (!is_alike(&m, &named))
        m.conductivity = m.specific_heat = m.hardness = m.yield = 0;
    m.conductivity = either(&s->conductivity, g, m.conductivity);
    m.specific_heat = either(&s->specific_heat, g, m.specific_heat);
    m.hardness = either(&s->hardness, g, m.hardness);
    m.yield = either(&s->yield, g, m.yield);
    return m;
}
