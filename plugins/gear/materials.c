/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Values with their sources, which docs/guide.md repeats:
 * - steel: the modulus, ratio and density that gear standards calculate with.
 * - All others: E, nu, rho and the yield strength of castings from FreeCAD's material cards
 *   (src/Mod/Material/Resources/Materials/Standard/Metal/Steel, by M. Muench, which name EN 10084,
 *   EN 10083, EN 1563 and EN 1561). Its case-hardening steels (15CrNi6, 17CrNiMo6 = 18CrNiMo7-6,
 *   20NiCrMo2) have one modulus, ratio and density; 16MnCr5 and 20MnCr5 are given the same here. So
 *   are 42CrMo4 and 31CrMoV9 those of its heat-treatable steels (34CrNiMo6, 30CrNiMo8, C60E).
 * - Yield strength of 42CrMo4: EN 10083, quenched and tempered, 40 to 100 mm, from a data sheet
 *   (Key to Metals).
 * The strength that tables print of case-hardening and nitriding steels is that of the core; a
 * flank is loaded in its hard layer, so that theirs is left to the user.
 */
#include "materials.h"

#include <stddef.h>

static const gear_material materials[] = {
    {206e9, 0.3, 7850, 0},     /* steel */
    {210e9, 0.3, 7800, 0},     /* 16MnCr5 */
    {210e9, 0.3, 7800, 0},     /* 20MnCr5 */
    {210e9, 0.3, 7800, 0},     /* 15CrNi6 */
    {210e9, 0.3, 7800, 0},     /* 18CrNiMo7-6 */
    {210e9, 0.3, 7800, 0},     /* 20NiCrMo2 */
    {210e9, 0.3, 7800, 650e6}, /* 42CrMo4 */
    {210e9, 0.3, 7800, 0},     /* 31CrMoV9 */
    {170e9, 0.3, 7200, 320e6}, /* EN-GJS-500-7 */
    {180e9, 0.3, 7200, 420e6}, /* EN-GJS-700-2 */
    {115e9, 0.3, 7200, 165e6}, /* EN-GJL-250 */
};

gear_material gear_material_of(int64_t rank)
{
    const int64_t count = sizeof materials / sizeof *materials;
    return materials[rank >= 0 && rank < count ? rank : 0];
}
