/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The geometry of a gear pair whose centres move: closed forms, derivatives, begin and end of tooth
   contact. */
#include "../../../plugins/dynamics/coupled/coupled-pair.h"

#include "check.h"

#include <math.h>

static const double position[DYNAMICS_COORDINATES] = {9, -0.4, 0.7, 1.1, -0.9};

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* Makes a trapezoidal stiffness with two levels, load fractions that do not depend on the load,
   contact ratio 1.6 and centre distance 2000 units. */
static void make(dynamics_excitation *mesh, dynamics_coupled *pair)
{
    static const double phase[] = {0, 0.6, 0.6, 1}, k[] = {1.2, 1.2, 0.7, 0.7};
    static const double cycle[] = {0, 0.6, 0.6, 1, 1, 1.6}, share[] = {0.4, 0.5, 1, 1, 0.5, 0.6};
    *mesh =
        (dynamics_excitation){.zeta = 0.01, .load = 1, .half_gap = 7, .stiffness = 1, .length = 1};
    dynamics_mesh_curves x = {4, phase, k, NULL};
    check_true("mesh", dynamics_excitation_build(mesh, &x));
    *pair = (dynamics_coupled){.excitation = mesh, .base = 1880, .centre = 2000, .base_1 = 940};
    pair->line = sqrt(2000.0 * 2000 - 1880.0 * 1880);
    pair->angle = atan2(pair->line, pair->base);
    pair->base_pitch = 118;
    check_true("stiffness", dynamics_coupled_pair_stiffness(pair, 6, cycle, share));
}

static void test_place(const dynamics_coupled *pair)
{
    dynamics_place place;
    dynamics_coupled_locate(pair, position, &place);
    double rx = position[DYNAMICS_X2] - position[DYNAMICS_X1],
           ry = position[DYNAMICS_Y2] - position[DYNAMICS_Y1];
    double C = hypot(2000 + rx, ry), angle = acos(1880 / C);
    double mounted = acos(1880.0 / 2000), longer = C * sin(angle) - 2000 * sin(mounted);
    check_near("centre distance", place.centre, C, 1e-15);
    check_near("pressure angle", place.angle, angle, 1e-13);
    check_near("turn", place.turn, atan2(ry, 2000 + rx), 1e-15);
    check_near("half gap", place.half_gap, 7 + 1880 * (involute(angle) - involute(mounted)), 1e-11);
    check_near("contact ratio", place.exit - place.entry, 1.6 - longer / 118, 1e-12);
    check_near("shift", place.shift, (angle - mounted) * 940 / 118, 1e-10);
}

/* The force must be the gradient of the overlap, so that the mesh conserves energy. */
static void test_gradient(const dynamics_coupled *pair)
{
    const double v[DYNAMICS_COORDINATES] = {0.3, 0.1, -0.2, 0.25, -0.15}, d = 1e-4;
    for (int side = -1; side <= 1; side++) {
        dynamics_place place;
        double x[DYNAMICS_COORDINATES], worst = 0, ends[2];
        dynamics_coupled_locate(pair, position, &place);
        dynamics_overlap o = dynamics_coupled_overlap(pair, &place, side, position, v, 0.2, 0.05);
        for (int i = 0; i <= DYNAMICS_COORDINATES; i++) {
            for (int sign = 0; sign < 2; sign++) {
                double step = sign ? -d : d, e = 0.2;
                for (int k = 0; k < DYNAMICS_COORDINATES; k++)
                    x[k] = position[k] + (i == DYNAMICS_COORDINATES ? step * v[k]
                                          : k == i                  ? step
                                                                    : 0);
                e += i == DYNAMICS_COORDINATES ? step * 0.05 : 0;
                dynamics_coupled_locate(pair, x, &place);
                ends[sign] = dynamics_coupled_overlap(pair, &place, side, x, v, e, 0.05).value;
            }
            double expected = i == DYNAMICS_COORDINATES ? o.rate : o.gradient[i];
            worst = fmax(worst, fabs((ends[0] - ends[1]) / (2 * d) - expected));
        }
        check_below("error of gradient and rate", worst, 1e-9);
    }
    dynamics_place place;
    dynamics_coupled_locate(pair, position, &place);
    dynamics_overlap driving = dynamics_coupled_overlap(pair, &place, 1, position, v, 0, 0);
    check_near("the force has one size",
               hypot(driving.gradient[DYNAMICS_X2], driving.gradient[DYNAMICS_Y2]), 1, 1e-14);
}

/* With centres at rest, the stiffness must not change; if they move apart, tooth contact must begin
   later and last for a shorter time. */
static void test_stiffness_change(const dynamics_coupled *pair)
{
    const double still[DYNAMICS_COORDINATES] = {0},
                 apart[DYNAMICS_COORDINATES] = {[DYNAMICS_X2] = 2};
    dynamics_place place, far;
    dynamics_coupled_locate(pair, still, &place);
    dynamics_coupled_locate(pair, apart, &far);
    double worst = 0, lost = 0;
    const int n = 100000;
    for (int i = 0; i < n; i++) {
        double phase = (i + 0.5) / n;
        dynamics_pairs mounted = dynamics_coupled_mounted_pairs(pair, phase);
        worst =
            fmax(worst, fabs(dynamics_coupled_stiffness_change(
                            pair, &place, phase, dynamics_coupled_pairs(&place, phase), mounted)));
        lost += dynamics_coupled_stiffness_change(pair, &far, phase,
                                                  dynamics_coupled_pairs(&far, phase), mounted) /
                n;
    }
    check_below("change while the centres stay", worst, 1e-15);
    /* the integral over a cycle for all pairs is that for one pair over its contact: only the part
       before the entry is lost, where the stiffness is 0.4 of 1.2 */
    check_near("lost stiffness", lost, -0.48 * far.entry, 0.05);
    dynamics_pairs both = dynamics_coupled_pairs(&place, 0.3),
                   one = dynamics_coupled_pairs(&place, 0.8);
    check_true("two pairs", both.youngest == 0 && both.oldest == 1);
    check_true("one pair", one.youngest == 0 && one.oldest == 0);
}

int main(void)
{
    dynamics_excitation mesh;
    dynamics_coupled pair;
    make(&mesh, &pair);
    test_place(&pair);
    test_gradient(&pair);
    test_stiffness_change(&pair);
    dynamics_coupled_free(&pair);
    dynamics_excitation_free(&mesh);
    return check_done();
}
