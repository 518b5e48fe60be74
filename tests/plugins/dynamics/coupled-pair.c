/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The geometry of a pair whose centres move: closed forms, derivatives, tooth pairs that come and
   go. */
#include "../../../plugins/dynamics/coupled-pair.h"

#include "host.h"

#include <math.h>

static const double position[FF_COORDINATES] = {9, -0.4, 0.7, 1.1, -0.9};

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* Trapezoid of two levels and rigid shares, contact ratio 1.6; centre distance 2000 units. */
static void make(ff_mesh *mesh, ff_coupled *pair)
{
    static const double phase[] = {0, 0.6, 0.6, 1}, k[] = {1.2, 1.2, 0.7, 0.7};
    static const double cycle[] = {0, 0.6, 0.6, 1, 1, 1.6}, share[] = {0.4, 0.5, 1, 1, 0.5, 0.6};
    *mesh = (ff_mesh){.zeta = 0.01, .load = 1, .half_gap = 7, .stiffness = 1, .length = 1};
    ff_excitation x = {4, phase, k, NULL};
    check_true("mesh", ff_mesh_build(mesh, &x));
    *pair = (ff_coupled){.mesh = mesh, .base = 1880, .centre = 2000, .base_1 = 940};
    pair->line = sqrt(2000.0 * 2000 - 1880.0 * 1880);
    pair->angle = atan2(pair->line, pair->base);
    pair->base_pitch = 118;
    check_true("stiffness", ff_coupled_pair_stiffness(pair, 6, cycle, share));
}

static void test_place(const ff_coupled *pair)
{
    ff_place place;
    ff_coupled_locate(pair, position, &place);
    double rx = position[FF_X2] - position[FF_X1], ry = position[FF_Y2] - position[FF_Y1];
    double C = hypot(2000 + rx, ry), angle = acos(1880 / C);
    double mounted = acos(1880.0 / 2000), longer = C * sin(angle) - 2000 * sin(mounted);
    check_near("centre distance", place.centre, C, 1e-15);
    check_near("pressure angle", place.angle, angle, 1e-13);
    check_near("turn", place.turn, atan2(ry, 2000 + rx), 1e-15);
    check_near("half gap", place.half_gap, 7 + 1880 * (involute(angle) - involute(mounted)), 1e-11);
    check_near("contact ratio", place.exit - place.entry, 1.6 - longer / 118, 1e-12);
    check_near("shift", place.shift, (angle - mounted) * 940 / 118, 1e-10);
}

/* The force is the gradient of the overlap, so that the mesh keeps its energy. */
static void test_gradient(const ff_coupled *pair)
{
    const double v[FF_COORDINATES] = {0.3, 0.1, -0.2, 0.25, -0.15}, d = 1e-4;
    for (int side = -1; side <= 1; side++) {
        ff_place place;
        double x[FF_COORDINATES], worst = 0, ends[2];
        ff_coupled_locate(pair, position, &place);
        ff_overlap o = ff_coupled_overlap(pair, &place, side, position, v, 0.2, 0.05);
        for (int i = 0; i <= FF_COORDINATES; i++) {
            for (int sign = 0; sign < 2; sign++) {
                double step = sign ? -d : d, e = 0.2;
                for (int k = 0; k < FF_COORDINATES; k++)
                    x[k] = position[k] + (i == FF_COORDINATES ? step * v[k] : k == i ? step : 0);
                e += i == FF_COORDINATES ? step * 0.05 : 0;
                ff_coupled_locate(pair, x, &place);
                ends[sign] = ff_coupled_overlap(pair, &place, side, x, v, e, 0.05).value;
            }
            double expected = i == FF_COORDINATES ? o.rate : o.gradient[i];
            worst = fmax(worst, fabs((ends[0] - ends[1]) / (2 * d) - expected));
        }
        check_below("error of gradient and rate", worst, 1e-9);
    }
    ff_place place;
    ff_coupled_locate(pair, position, &place);
    ff_overlap driving = ff_coupled_overlap(pair, &place, 1, position, v, 0, 0);
    check_near("the force has one size", hypot(driving.gradient[FF_X2], driving.gradient[FF_Y2]), 1,
               1e-14);
}

/* Nothing changes while the centres stay; further apart a pair comes later and stays shorter. */
static void test_stiffness_change(const ff_coupled *pair)
{
    const double still[FF_COORDINATES] = {0}, apart[FF_COORDINATES] = {[FF_X2] = 2};
    ff_place place, far;
    ff_coupled_locate(pair, still, &place);
    ff_coupled_locate(pair, apart, &far);
    double worst = 0, lost = 0;
    const int n = 100000;
    for (int i = 0; i < n; i++) {
        double phase = (i + 0.5) / n;
        ff_pairs mounted = ff_coupled_mounted_pairs(pair, phase);
        worst = fmax(worst, fabs(ff_coupled_stiffness_change(
                                pair, &place, phase, ff_coupled_pairs(&place, phase), mounted)));
        lost +=
            ff_coupled_stiffness_change(pair, &far, phase, ff_coupled_pairs(&far, phase), mounted) /
            n;
    }
    check_below("change while the centres stay", worst, 1e-15);
    /* the integral over a cycle of all pairs is that of one pair over its contact: only what lies
       before the entry is lost, 0.4 of 1.2 there */
    check_near("lost stiffness", lost, -0.48 * far.entry, 0.05);
    ff_pairs both = ff_coupled_pairs(&place, 0.3), one = ff_coupled_pairs(&place, 0.8);
    check_true("two pairs", both.youngest == 0 && both.oldest == 1);
    check_true("one pair", one.youngest == 0 && one.oldest == 0);
}

int main(void)
{
    ff_mesh mesh;
    ff_coupled pair;
    make(&mesh, &pair);
    test_place(&pair);
    test_gradient(&pair);
    test_stiffness_change(&pair);
    ff_coupled_free(&pair);
    ff_mesh_free(&mesh);
    return check_done();
}
